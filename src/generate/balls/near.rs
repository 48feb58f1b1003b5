//! Which balls may hide parts of which: lists that stay right while no ball has moved and grown
//! by more than half of a slack, so that they are made anew only now and then.

use crate::generate::ball::Ball;

/// Up to so many balls, all are compared with all.
const FEW: usize = 96;
/// Of more balls than this, no list is longer than this part of them: where more meet, it is as
/// good to look at all.
const MANY: usize = 512;
const PART: usize = 4;

/// For each of some balls, those that meet it or may soon.
#[derive(Debug, Default, Clone)]
pub(crate) struct Near {
    starts: Vec<u32>,
    lists: Vec<u32>,
    /// The balls without a list, as too many meet them.
    all: Vec<bool>,
    /// Balls looked at while making the lists.
    pub looks: u64,
    cells: Cells,
}

/// Balls by the cells of a grid that their boxes touch.
#[derive(Debug, Default, Clone)]
struct Cells {
    low: [f32; 3],
    inverse: f32,
    dims: [usize; 3],
    starts: Vec<u32>,
    members: Vec<u32>,
    /// The last ball that each ball was seen for.
    seen: Vec<u32>,
}

impl Near {
    /// The lists of the balls `of` among all `balls`, ascending.
    pub(crate) fn make(&mut self, balls: &[Ball], of: &[u32], slack: f32) {
        self.list(balls, of, slack, usize::MAX);
        for k in 0..of.len() {
            let list = self.starts[k] as usize..self.starts[k + 1] as usize;
            self.lists[list].sort_unstable();
        }
    }

    /// The same in any order, and no list where very many balls meet one.
    pub(crate) fn short(&mut self, balls: &[Ball], of: &[u32], slack: f32) {
        let most = if balls.len() > MANY { balls.len() / PART } else { usize::MAX };
        self.list(balls, of, slack, most);
    }

    /// Lists of at most so many.
    fn list(&mut self, balls: &[Ball], of: &[u32], slack: f32, most: usize) {
        self.starts.clear();
        self.lists.clear();
        self.all.clear();
        self.all.resize(of.len(), false);
        self.starts.push(0);
        if balls.len() <= FEW || of.len() * 8 < balls.len() {
            self.looks += (of.len() * balls.len()) as u64;
            for (&i, all) in of.iter().zip(&mut self.all) {
                let ball = &balls[i as usize];
                let first = self.lists.len();
                for (j, other) in (0u32..).zip(balls) {
                    if j != i && ball.meets(other, slack) {
                        self.lists.push(j);
                    }
                }
                *all = self.lists.len() - first > most;
                if *all {
                    self.lists.truncate(first);
                }
                self.starts.push(self.lists.len() as u32);
            }
            return;
        }
        self.cells.sort(balls, slack);
        for (&i, all) in of.iter().zip(&mut self.all) {
            let ball = &balls[i as usize];
            let first = self.lists.len();
            let Cells { low, inverse, dims, starts, members, seen } = &mut self.cells;
            let cells = Cells::over(low, *inverse, dims, ball, slack);
            'cells: for z in cells[2][0]..=cells[2][1] {
                for y in cells[1][0]..=cells[1][1] {
                    let row = dims[0] * (y + dims[1] * z);
                    for c in row + cells[0][0]..=row + cells[0][1] {
                        for &j in &members[starts[c] as usize..starts[c + 1] as usize] {
                            self.looks += 1;
                            if std::mem::replace(&mut seen[j as usize], i) != i
                                && j != i
                                && ball.meets(&balls[j as usize], slack)
                            {
                                self.lists.push(j);
                            }
                        }
                        if self.lists.len() - first > most {
                            *all = true;
                            break 'cells;
                        }
                    }
                }
            }
            if *all {
                self.lists.truncate(first);
            }
            self.starts.push(self.lists.len() as u32);
        }
    }

    /// Whether so many balls meet the ball that came `k`th that it has no list.
    #[inline(always)]
    pub(crate) fn all(&self, k: usize) -> bool {
        self.all[k]
    }

    /// Bytes that it holds.
    pub(crate) fn bytes(&self) -> u64 {
        let Cells { starts, members, seen, .. } = &self.cells;
        let own = self.starts.capacity() + self.lists.capacity();
        4 * (own + starts.capacity() + members.capacity() + seen.capacity()) as u64
    }

    /// The list of the ball that came `k`th.
    #[inline(always)]
    pub(crate) fn of(&self, k: usize) -> &[u32] {
        &self.lists[self.starts[k] as usize..self.starts[k + 1] as usize]
    }
}

impl Cells {
    /// Cells about as wide as the mean ball.
    fn sort(&mut self, balls: &[Ball], slack: f32) {
        let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
        let mut sum = 0.0f64;
        for b in balls {
            for a in 0..3 {
                low[a] = low[a].min(b.center[a] - b.radius - slack);
                high[a] = high[a].max(b.center[a] + b.radius + slack);
            }
            sum += f64::from(b.radius);
        }
        let edge = (2.0 * sum / balls.len().max(1) as f64) as f32;
        let longest = (0..3).map(|a| high[a] - low[a]).fold(0.0, f32::max);
        // Never more than 64 cells along an edge.
        let edge = edge.max(longest / 64.0).max(f32::MIN_POSITIVE);
        self.low = low;
        self.inverse = 1.0 / edge;
        self.dims = [0, 1, 2].map(|a| ((high[a] - low[a]) * self.inverse) as usize + 1);
        let total = self.dims[0] * self.dims[1] * self.dims[2];
        self.starts.clear();
        self.starts.resize(total + 2, 0);
        self.seen.clear();
        self.seen.resize(balls.len(), u32::MAX);
        let (low, inverse, dims) = (self.low, self.inverse, self.dims);
        let each = |f: &mut dyn FnMut(u32, usize)| {
            for (i, b) in (0u32..).zip(balls) {
                let r = Cells::over(&low, inverse, &dims, b, 0.0);
                for z in r[2][0]..=r[2][1] {
                    for y in r[1][0]..=r[1][1] {
                        let row = dims[0] * (y + dims[1] * z);
                        (row + r[0][0]..=row + r[0][1]).for_each(|c| f(i, c));
                    }
                }
            }
        };
        let starts = &mut self.starts;
        each(&mut |_, c| starts[c + 2] += 1);
        for c in 2..starts.len() {
            starts[c] += starts[c - 1];
        }
        self.members.clear();
        self.members.resize(starts.last().map_or(0, |&n| n as usize), 0);
        let members = &mut self.members;
        each(&mut |i, c| {
            members[starts[c + 1] as usize] = i;
            starts[c + 1] += 1;
        });
    }

    /// First and last cell along each axis that a ball's box touches.
    fn over(
        low: &[f32; 3],
        inverse: f32,
        dims: &[usize; 3],
        b: &Ball,
        slack: f32,
    ) -> [[usize; 2]; 3] {
        [0, 1, 2].map(|a| {
            [b.center[a] - b.radius - slack, b.center[a] + b.radius + slack]
                .map(|x| (((x - low[a]) * inverse).max(0.0) as usize).min(dims[a] - 1))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    fn balls(n: usize, seed: u64) -> Vec<Ball> {
        let mut random = Random::new(seed, 0);
        let size = 0.6 / (n as f64).cbrt();
        (0..n)
            .map(|_| Ball {
                center: [0; 3].map(|_| random.unit() as f32),
                radius: (size * random.between(0.05, 1.5)) as f32,
            })
            .collect()
    }

    #[test]
    fn lists_by_cells_are_those_by_comparing_all() {
        for n in [97, 200, 700] {
            let balls = balls(n, n as u64);
            let of: Vec<u32> = (0..n as u32).collect();
            let mut near = Near::default();
            near.make(&balls, &of, 0.02);
            for i in 0..n {
                let all: Vec<u32> = (0..n as u32)
                    .filter(|&j| j as usize != i && balls[i].meets(&balls[j as usize], 0.02))
                    .collect();
                assert_eq!(near.of(i), all, "{i} of {n}");
            }
        }
    }

    #[test]
    fn where_very_many_meet_a_ball_it_has_no_list() {
        let n = 1000;
        let mut balls = balls(n, 4);
        balls.iter_mut().step_by(3).for_each(|b| b.radius = 0.7);
        let of: Vec<u32> = (0..n as u32).collect();
        for of in [of.as_slice(), &of[..20]] {
            let mut near = Near::default();
            near.short(&balls, of, 0.01);
            let (mut with, mut without) = (0, 0);
            for (k, &i) in of.iter().enumerate() {
                let meets = |&j: &u32| j != i && balls[i as usize].meets(&balls[j as usize], 0.01);
                let all: Vec<u32> = (0..n as u32).filter(meets).collect();
                let mut list = near.of(k).to_vec();
                list.sort_unstable();
                assert_eq!(near.all(k), all.len() > n / PART);
                assert_eq!(list, if near.all(k) { Vec::new() } else { all });
                if near.all(k) { without += 1 } else { with += 1 }
            }
            assert!(with > 0 && without > 0, "{with} {without}");
        }
    }

    #[test]
    fn looks_grow_with_the_number_of_balls() {
        let looks = |n: usize| {
            let balls = balls(n, 5);
            let of: Vec<u32> = (0..n as u32).collect();
            let mut near = Near::default();
            near.make(&balls, &of, 0.0);
            near.looks as f64 / n as f64
        };
        let (few, many) = (looks(600), looks(4800));
        assert!(many < 2.0 * few, "{few} {many}");
    }
}
