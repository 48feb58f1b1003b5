//! Which bodies may touch: a grid of cells over the centres, renewed when some body has used up its part of the skin.

use super::narrow::Pair;
use super::state::State;
use crate::math::Vec3;

/// The skin of bounds, as a part of the greatest bound.
const SKIN: f64 = 0.3;

/// The pairs of bodies whose bounds come near each other.
#[derive(Debug, Default)]
pub(crate) struct Broad {
    /// In the order of (a, b).
    pub pairs: Vec<Pair>,
    /// `moved` of each body when the list was made.
    at: Vec<f64>,
    skin: f64,
    cells: Vec<(u64, u32)>,
    found: Vec<(u32, u32)>,
    spare: Vec<Pair>,
    /// How often the list was made.
    pub renewed: u64,
}

impl Broad {
    /// Makes the list anew where it may lack a pair.
    pub fn update(&mut self, state: &State) {
        let moved = &state.moved;
        let half = 0.5 * self.skin;
        if self.at.len() == moved.len()
            && self.skin > 0.0
            && self.at.iter().zip(moved).all(|(a, m)| m - a <= half)
        {
            return;
        }
        self.renew(state);
    }

    /// The list will be made anew.
    pub fn forget(&mut self) {
        self.at.clear();
        self.skin = 0.0;
        self.pairs.iter_mut().for_each(Pair::forget);
    }

    /// Body `i` is gone; the later ones have moved up by one.
    pub fn remove(&mut self, i: u32) {
        self.at.clear();
        self.pairs.retain_mut(|p| {
            let keep = p.a != i && p.b != i;
            p.a -= u32::from(p.a > i);
            p.b -= u32::from(p.b > i);
            keep
        });
    }

    pub fn bytes(&self) -> u64 {
        let own = self.at.capacity() * 8 + self.cells.capacity() * 16 + self.found.capacity() * 8;
        own as u64 + self.pairs.iter().map(Pair::bytes).sum::<u64>()
    }

    fn renew(&mut self, state: &State) {
        self.renewed += 1;
        self.at.clear();
        self.at.extend_from_slice(&state.moved);
        let used = (0..state.len()).map(|i| state.template_of(i).bound());
        let most = used.fold(0.0, f64::max);
        self.skin = SKIN * most;
        self.find(state, most);
        // The old list and the new are both in order: what is in both keeps its contacts.
        self.found.sort_unstable();
        std::mem::swap(&mut self.pairs, &mut self.spare);
        self.pairs.clear();
        let mut old = self.spare.drain(..).peekable();
        for &(a, b) in &self.found {
            while old.next_if(|p| (p.a, p.b) < (a, b)).is_some() {}
            self.pairs.push(match old.next_if(|p| (p.a, p.b) == (a, b)) {
                Some(kept) => kept,
                None => Pair::new(a, b),
            });
        }
    }

    /// All pairs by cells at least as wide as two bodies can be apart.
    fn find(&mut self, state: &State, most: f64) {
        self.found.clear();
        let n = state.len();
        if n < 2 {
            return;
        }
        let (mut lo, mut hi) = (state.position[0], state.position[0]);
        for x in &state.position {
            lo = lo.inf(x);
            hi = hi.sup(x);
        }
        let size = hi - lo;
        // Not many more cells along an axis than bodies, and no more than a number holds.
        let cell = (2.0 * most + self.skin).max(size.max() / (n as f64 + 1.0).min(1e5));
        let place = |x: &Vec3| ((x - lo) / cell).map(|c| c as u64);
        let counts = place(&hi).map(|c| c + 1);
        let key = |c: [u64; 3]| (c[2] * counts.y + c[1]) * counts.x + c[0];
        self.cells.clear();
        for (i, x) in state.position.iter().enumerate() {
            let c = place(x);
            self.cells.push((key([c.x, c.y, c.z]), i as u32));
        }
        self.cells.sort_unstable();
        let cells = std::mem::take(&mut self.cells);
        for (k, &(own, i)) in cells.iter().enumerate() {
            for &(other, j) in &cells[k + 1..] {
                if other != own {
                    break;
                }
                self.meet(state, i, j);
            }
            let c = place(&state.position[i as usize]);
            for (dx, dy, dz) in FORWARD {
                let at = [c.x as i64 + dx, c.y as i64 + dy, c.z as i64 + dz];
                let inside = |k: usize| at[k] >= 0 && (at[k] as u64) < counts[k];
                if !(inside(0) && inside(1) && inside(2)) {
                    continue;
                }
                let other = key(at.map(|v| v as u64));
                let from = cells.partition_point(|(key, _)| *key < other);
                for &(key, j) in &cells[from..] {
                    if key != other {
                        break;
                    }
                    self.meet(state, i, j);
                }
            }
        }
        self.cells = cells;
    }

    fn meet(&mut self, state: &State, i: u32, j: u32) {
        let (a, b) = (i.min(j) as usize, i.max(j) as usize);
        if state.fixed[a] && state.fixed[b] {
            return;
        }
        let far = state.template_of(a).bound() + state.template_of(b).bound() + self.skin;
        if (state.position[a] - state.position[b]).norm_squared() < far * far {
            self.found.push((a as u32, b as u32));
        }
    }
}

/// Half of the cells around one.
const FORWARD: [(i64, i64, i64); 13] = [
    (1, 0, 0),
    (-1, 1, 0),
    (0, 1, 0),
    (1, 1, 0),
    (-1, -1, 1),
    (0, -1, 1),
    (1, -1, 1),
    (-1, 0, 1),
    (0, 0, 1),
    (1, 0, 1),
    (-1, 1, 1),
    (0, 1, 1),
    (1, 1, 1),
];
