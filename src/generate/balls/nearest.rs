//! The ball whose surface is nearest to each of many points, by what is left of the balls in ever
//! smaller boxes of points.

/// A point, or a ball's centre and radius.
pub(crate) type Point = [f32; 3];

/// Boxes of so few points, or of so few balls, are not halved.
const POINTS: usize = 16;
const BALLS: usize = 6;
/// Room for rounding, as a part of a distance.
const ROUNDING: f32 = 1e-5;

/// Buffers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Nearest {
    order: Vec<u32>,
    lists: Vec<u32>,
    away: Vec<f32>,
}

/// Points and balls.
struct All<'a> {
    points: &'a [Point],
    balls: &'a [(Point, f32)],
}

impl Nearest {
    /// Calls `f(point, balls)` for each point with the numbers of some balls, ascending, among
    /// which is the one with the least distance from its centre less its radius.
    pub(crate) fn each(
        &mut self,
        points: &[Point],
        balls: &[(Point, f32)],
        mut f: impl FnMut(usize, &[u32]),
    ) {
        let Nearest { order, lists, away } = self;
        order.clear();
        order.extend(0..points.len() as u32);
        lists.clear();
        lists.extend(0..balls.len() as u32);
        halve(&All { points, balls }, order, (lists, 0), away, &mut f);
    }
}

/// The balls for the points of `some` are those listed from `first` on.
fn halve(
    all: &All,
    some: &mut [u32],
    (lists, first): (&mut Vec<u32>, usize),
    away: &mut Vec<f32>,
    f: &mut impl FnMut(usize, &[u32]),
) {
    let last = lists.len();
    if some.is_empty() {
        return;
    }
    if some.len() <= POINTS || last - first <= BALLS {
        some.iter().for_each(|&k| f(k as usize, &lists[first..last]));
        return;
    }
    let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
    for p in some.iter().map(|&k| all.points[k as usize]) {
        for a in 0..3 {
            low[a] = low[a].min(p[a]);
            high[a] = high[a].max(p[a]);
        }
    }
    // A ball that is farther from the middle than the nearest by more than the box's diagonal
    // is the nearest of no point in it.
    let middle = [0, 1, 2].map(|a| 0.5 * (low[a] + high[a]));
    let norm = |v: Point| v.iter().map(|x| x * x).sum::<f32>().sqrt();
    let reach = norm([0, 1, 2].map(|a| 0.5 * (high[a] - low[a])));
    away.clear();
    let (mut least, mut size) = (f32::MAX, reach);
    for &j in &lists[first..last] {
        let (center, radius) = all.balls[j as usize];
        let distance = norm([0, 1, 2].map(|a| center[a] - middle[a]));
        least = least.min(distance - radius);
        size = size.max(distance + radius);
        away.push(distance - radius);
    }
    let most = least + 2.0 * reach + ROUNDING * size;
    for (k, &away) in away.iter().enumerate() {
        if away <= most {
            lists.push(lists[first + k]);
        }
    }
    let extent = |a: usize| high[a] - low[a];
    let longest = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let half = some.len() / 2;
    let key = |k: &u32| all.points[*k as usize][longest];
    some.select_nth_unstable_by(half, |i, j| key(i).total_cmp(&key(j)).then(i.cmp(j)));
    let (one, other) = some.split_at_mut(half);
    halve(all, one, (lists, last), away, f);
    halve(all, other, (lists, last), away, f);
    lists.truncate(last);
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    #[test]
    fn the_nearest_is_among_few() {
        let mut random = Random::new(4, 4);
        for (n, m) in [(1, 1), (30, 3), (2000, 40), (3000, 800)] {
            let mut point = || [0; 3].map(|_| random.unit() as f32);
            let points: Vec<Point> = (0..n).map(|_| point()).collect();
            let balls: Vec<(Point, f32)> =
                (0..m).map(|j| (point(), [0.02, 0.1, 0.3][j % 3])).collect();
            let (mut seen, mut looks) = (vec![0; n], 0);
            Nearest::default().each(&points, &balls, |k, some| {
                seen[k] += 1;
                looks += some.len();
                assert!(some.is_sorted());
                let away = |j: u32| {
                    let (center, radius) = balls[j as usize];
                    let square = |a: usize| (center[a] - points[k][a]).powi(2);
                    (square(0) + square(1) + square(2)).sqrt() - radius
                };
                let least = (0..m as u32).min_by(|&i, &j| away(i).total_cmp(&away(j))).unwrap();
                assert!(some.contains(&least), "{k}");
            });
            assert!(seen.iter().all(|&s| s == 1));
            assert!(n < 3000 || looks < n * m / 8, "{looks}");
        }
    }
}
