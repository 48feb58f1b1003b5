//! Which caps of a sphere matter: of the many that hide parts of a sphere deep in a clump, nearly
//! all hide only what others hide anyway.
//!
//! The directions are cut into spherical triangles, again and again. One that lies in a cap is
//! hidden, and that cap stays for it; where none holds it whole, all stay that reach into it. So
//! in every direction those that stay hide what all hide.

use super::union::Cap;
use crate::math::Vec3;

/// Caps that are asked first whether they hold a triangle: the most hiding ones.
const GREAT: usize = 24;
/// A triangle is not cut into which no more caps reach, or that is cut so often already.
const FEW: usize = 12;
const CUTS: usize = 6;
/// Room for rounding, in the cosine.
const ROUNDING: f64 = 1e-12;

/// Buffers.
#[derive(Default)]
pub(super) struct Matter {
    caps: Vec<Cap>,
    /// Lists of caps that reach into a triangle and into those that hold it, one after the other.
    lists: Vec<u32>,
    stay: Vec<bool>,
}

impl Matter {
    pub(super) fn begin(&mut self) {
        self.caps.clear();
    }

    pub(super) fn add(&mut self, cap: Cap) {
        self.caps.push(cap);
    }

    /// Those that matter, the most hiding first, and whether they hide all directions as far as
    /// this can tell.
    pub(super) fn take(&mut self) -> (Vec<Cap>, bool) {
        let Matter { caps, lists, stay } = self;
        let hides = |x: &Cap, y: &Cap| x.cos.total_cmp(&y.cos).then(x.by.cmp(&y.by));
        let mut hidden = false;
        if caps.len() > FEW {
            if caps.len() > GREAT {
                caps.select_nth_unstable_by(GREAT, hides);
            }
            stay.clear();
            stay.resize(caps.len(), false);
            lists.clear();
            lists.extend(0..caps.len() as u32);
            hidden = true;
            for k in 0..8 {
                let side = |a: usize| if k >> a & 1 == 1 { 1.0 } else { -1.0 };
                let corners = [Vec3::x() * side(0), Vec3::y() * side(1), Vec3::z() * side(2)];
                hidden &= look(corners, 0, caps, (lists, 0), stay);
            }
            let mut k = 0;
            caps.retain(|_| {
                k += 1;
                stay[k - 1]
            });
        }
        caps.sort_unstable_by(hides);
        (caps.clone(), hidden)
    }
}

/// Marks the caps that matter to a triangle of directions, of those listed from `first` on;
/// whether they are seen to hide it.
fn look(
    corners: [Vec3; 3],
    cuts: usize,
    caps: &[Cap],
    (lists, first): (&mut Vec<u32>, usize),
    stay: &mut [bool],
) -> bool {
    let last = lists.len();
    let middle = (corners[0] + corners[1] + corners[2]).normalize();
    let cos = corners.iter().map(|v| v.dot(&middle)).fold(1.0, f64::min);
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let of = |k: usize, lists: &[u32]| caps[lists[k] as usize];
    for k in first..last.min(first + GREAT) {
        if of(k, lists).holds(&middle, cos, ROUNDING) {
            stay[lists[k] as usize] = true;
            return true;
        }
    }
    for k in first..last {
        let cap = of(k, lists);
        let x = middle.dot(&cap.axis).clamp(-1.0, 1.0);
        let across = (1.0 - x * x).sqrt() * sin;
        // The greatest cosine to the cap's middle in the triangle, and the least.
        let most = if x >= cos { 1.0 } else { x * cos + across };
        if most < cap.cos - ROUNDING {
            continue;
        }
        if x > -cos && x * cos - across > cap.cos + ROUNDING {
            stay[lists[k] as usize] = true;
            lists.truncate(last);
            return true;
        }
        lists.push(lists[k]);
    }
    let hidden = if lists.len() - last <= FEW || cuts == CUTS {
        lists[last..].iter().for_each(|&k| stay[k as usize] = true);
        false
    } else {
        let [a, b, c] = corners;
        let [x, y, z] = [a + b, b + c, c + a].map(|m| m.normalize());
        let mut all = true;
        for part in [[a, x, z], [x, b, y], [z, y, c], [x, y, z]] {
            all &= look(part, cuts + 1, caps, (lists, last), stay);
        }
        all
    };
    lists.truncate(last);
    hidden
}

#[cfg(test)]
mod tests {
    use super::super::surface::direction;
    use super::*;

    /// Caps above a slanted plane, of which many small ones lie in a few great ones.
    fn caps(n: u32, seed: f64) -> Vec<Cap> {
        (0..n)
            .map(|i| {
                let t = f64::from(i) + seed;
                let axis = direction((37 * i as usize + 5) % n as usize, n as usize);
                let cos = if i % 9 == 0 { 0.2 } else { 0.9 + 0.1 * (t * 0.617).fract() };
                Cap { axis, cos, by: i }
            })
            .filter(|c| c.axis.dot(&Vec3::new(0.6, 0.0, 0.8)) > -0.3)
            .collect()
    }

    #[test]
    fn those_that_stay_hide_what_all_hide() {
        for (n, more) in [(5, 0.0), (40, 0.3), (300, 0.25), (1500, 0.1), (1500, -0.8)] {
            let mut all = caps(n, 0.3);
            all.iter_mut().for_each(|c| c.cos = (c.cos + more).min(0.999));
            let mut matter = Matter::default();
            matter.begin();
            all.iter().for_each(|c| matter.add(*c));
            let (left, hidden) = matter.take();
            assert!(left.is_sorted_by(|x, y| x.cos <= y.cos));
            let mut seen = 0;
            for k in 0..20_000 {
                let d = direction(k, 20_000);
                let hides = |c: &Cap| d.dot(&c.axis) > c.cos;
                assert_eq!(all.iter().any(hides), left.iter().any(hides));
                seen += usize::from(!left.iter().any(hides));
            }
            assert!(!hidden || seen == 0, "{n}");
            if n == 1500 {
                assert!(left.len() < 600, "{} of {n}", left.len());
                assert_eq!(hidden, more < 0.0);
            }
        }
    }
}
