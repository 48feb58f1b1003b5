//! Which spheres of the parent those of a fragment come from, so that a solver can carry the
//! history of contacts over.

use crate::error::{Result, push, reserve};
use crate::math::Sphere;
use std::f64::consts::PI;

/// For each sphere of a fragment the spheres of the parent that it overlaps, the most common
/// volume first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParentMap {
    /// Those of sphere i are the entries `starts[i]` up to `starts[i + 1]`.
    pub starts: Vec<u32>,
    /// Numbers of the parent's spheres.
    pub parents: Vec<u32>,
    /// Common volume over the volume of the fragment's sphere.
    pub shares: Vec<f64>,
}

impl ParentMap {
    /// Of spheres in one frame: which of `parents` those of a fragment come from.
    pub fn between(parents: &[Sphere], spheres: &[Sphere]) -> Result<ParentMap> {
        let mut map =
            ParentMap { starts: reserve("the map", spheres.len() + 1)?, ..Self::default() };
        map.starts.push(0);
        let mut of: Vec<(f64, u32)> = Vec::new();
        for s in spheres {
            of.clear();
            for (k, p) in (0u32..).zip(parents) {
                let share = common(s, p) / s.volume();
                if share > 0.0 {
                    push("the map", &mut of, (share, k))?;
                }
            }
            of.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            for &(share, k) in &of {
                push("the map", &mut map.parents, k)?;
                push("the map", &mut map.shares, share)?;
            }
            map.starts.push(map.parents.len() as u32);
        }
        Ok(map)
    }

    /// The parent's spheres that sphere `i` overlaps.
    pub fn of(&self, i: usize) -> &[u32] {
        let at = |k: usize| self.starts.get(k).map_or(0, |&s| s as usize);
        self.parents.get(at(i)..at(i + 1)).unwrap_or(&[])
    }
}

/// Volume that two balls have in common.
fn common(a: &Sphere, b: &Sphere) -> f64 {
    let d = (a.center - b.center).norm();
    let (r, q) = (a.radius, b.radius);
    if d >= r + q {
        return 0.0;
    }
    if d <= (r - q).abs() {
        return if r < q { a.volume() } else { b.volume() };
    }
    let deep = r + q - d;
    let square = d * d + 2.0 * d * (r + q) - 3.0 * (r - q) * (r - q);
    (PI * deep * deep * square / (12.0 * d)).clamp(0.0, a.volume())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn the_most_common_volume_comes_first() {
        let ball = |x: f64, r: f64| Sphere::new(Vec3::new(x, 0.0, 0.0), r);
        let parents = [ball(-2.0, 0.5), ball(0.0, 1.0), ball(1.0, 0.5), ball(0.3, 0.2)];
        let map = ParentMap::between(&parents, &[ball(0.5, 0.5), ball(9.0, 1.0)]).unwrap();
        assert_eq!((map.of(0), map.of(1), map.of(2)), (&[1, 2, 3][..], &[][..], &[][..]));
        assert_eq!(map.shares[0], 1.0);
        assert!((map.shares[2] - 0.064).abs() < 1e-12);
        // Two unit balls at a distance of 1 share 5π/12.
        assert!((common(&ball(0.0, 1.0), &ball(1.0, 1.0)) - 5.0 * PI / 12.0).abs() < 1e-12);
    }
}
