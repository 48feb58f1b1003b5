//! Spheres for codes that read single precision.

use super::pile::check;
use crate::error::{Error, Result, figure, reserve};
use crate::math::Sphere;

/// The spheres as `x, y, z, r` in single precision, each within the sphere it stands for: what
/// was inside before is inside after. Centres are rounded to the nearest, radii down, and less by
/// as much as the centre moved: of spheres in the body frame about 1e-7 of the clump's size.
///
/// Refused: no sphere, a sphere that is not finite or has no radius; a sphere that single
/// precision cannot hold (beyond 3e38, or so small or so far from the origin that no radius is
/// left).
pub fn single_precision(spheres: &[Sphere]) -> Result<Vec<[f32; 4]>> {
    check(spheres)?;
    let mut out = reserve("spheres", spheres.len())?;
    for (i, s) in spheres.iter().enumerate() {
        let center = s.center.map(|x| x as f32);
        let moved = (s.center - center.map(f64::from)).norm();
        // A little more for the rounding of this sum itself.
        let room = s.radius - moved * (1.0 + 1e-14) - s.radius * 1e-15;
        let radius = room as f32;
        let radius = if f64::from(radius) > room { radius.next_down() } else { radius };
        let held = room <= f64::from(f32::MAX) && center.iter().all(|x| x.is_finite());
        if !(held && radius.is_normal() && radius > 0.0) {
            return Err(Error::InvalidArgument(format!(
                "single precision cannot hold sphere {i}, of radius {} about ({:e}, {:e}, {:e})",
                figure(s.radius),
                s.center.x,
                s.center.y,
                s.center.z
            )));
        }
        out.push([center.x, center.y, center.z, radius]);
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::super::correct::tests::scattered;
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn rounded_spheres_lie_within() {
        for (scale, away) in [(1.0, 0.0), (1e-9, 0.0), (1e6, 0.0), (1.0, 300.0), (1e-3, -0.7)] {
            let of = |s: &Sphere| Sphere::new(s.center.add_scalar(away) * scale, s.radius * scale);
            let spheres: Vec<_> = scattered(500, 1.0).iter().map(of).collect();
            let rounded = single_precision(&spheres).unwrap();
            for (s, &[x, y, z, r]) in spheres.iter().zip(&rounded) {
                let c = Vec3::new(x.into(), y.into(), z.into());
                let out = (c - s.center).norm() + f64::from(r) - s.radius;
                assert!(out <= 0.0, "{out:e} of {s:?}");
                let size = s.center.amax() + s.radius;
                assert!(out > -4e-7 * size, "{out:e} of {s:?}");
            }
        }
    }

    #[test]
    fn what_it_cannot_hold_is_refused() {
        let ball = |x: f64, r: f64| Sphere::new(Vec3::new(x, 0.0, 0.0), r);
        for bad in [ball(1e39, 1e38), ball(1.0, 1e39), ball(0.0, 1e-40), ball(1.234_567_89, 1e-9)] {
            let e = single_precision(&[ball(0.0, 1.0), bad]).unwrap_err().to_string();
            assert!(e.starts_with("single precision cannot hold sphere 1"), "{e}");
        }
        assert_eq!(single_precision(&[ball(0.5, 0.25)]).unwrap()[0][0], 0.5);
    }
}
