//! The kinds of places at which a ball is its own image under some elements of a group: everywhere,
//! on planes, on lines, in a point.

use super::group::{EXACT, Group, Matrix, SAME, Set, bits, find};

/// Where balls are that some elements leave as they are.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Kind {
    /// Onto the line, plane or point about the centre.
    pub projector: Matrix,
    /// Of an orbit: every ball's place from that of the first, the identity first.
    pub images: Vec<Matrix>,
    /// The first kind that some element carries into this one.
    pub class: usize,
    /// Elements that leave the place as it is.
    pub(super) fixing: Set,
}

impl Group {
    /// All kinds of places, the general one first, then by falling number of images.
    pub(super) fn kinds(&self) -> Vec<Kind> {
        let mut sets = vec![1 as Set];
        for g in 0..self.len() {
            let fixing = self.fixing(self.closure(1 << g));
            if !sets.contains(&fixing) {
                sets.push(fixing);
            }
        }
        // Places that lie in several.
        let mut k = 0;
        while k < sets.len() {
            for j in 0..k {
                let fixing = self.fixing(self.closure(sets[j] | sets[k]));
                if !sets.contains(&fixing) {
                    sets.push(fixing);
                }
            }
            k += 1;
        }
        sets.sort_by_key(|s| s.count_ones());
        let mut kinds: Vec<Kind> = sets.iter().map(|&fixing| self.kind(fixing)).collect();
        for (k, kind) in kinds.iter_mut().enumerate() {
            let same = |s: &Set| self.carried(*s).any(|q| q == kind.fixing);
            kind.class = sets.iter().position(same).unwrap_or(k);
        }
        kinds
    }

    /// The mean of a subgroup's elements: onto what they all leave as it is.
    fn projector(&self, part: Set) -> Matrix {
        let sum: Matrix = bits(part).map(|i| self.elements()[i]).sum();
        (sum / f64::from(part.count_ones())).map(|x| if x.abs() < EXACT { 0.0 } else { x })
    }

    /// All elements that leave what a subgroup leaves as it is.
    fn fixing(&self, part: Set) -> Set {
        let p = self.projector(part);
        let same = |g: &Matrix| (g * p - p).amax() < SAME;
        (0..self.len()).filter(|&i| same(&self.elements()[i])).fold(0, |all, i| all | 1 << i)
    }

    fn kind(&self, fixing: Set) -> Kind {
        let projector = self.projector(fixing);
        let (mut images, mut places) = (Vec::new(), Vec::new());
        for g in self.elements() {
            // Of several with one place, the first.
            let place = g * projector;
            if find(&places, &place, SAME).is_none() {
                places.push(place);
                images.push(*g);
            }
        }
        Kind { projector, images, class: 0, fixing }
    }
}

impl Kind {
    /// Balls of an orbit.
    pub(super) fn len(&self) -> usize {
        self.images.len()
    }

    /// Whether it is a point: one orbit fits there.
    pub(super) fn is_point(&self) -> bool {
        self.projector.amax() == 0.0
    }
}
