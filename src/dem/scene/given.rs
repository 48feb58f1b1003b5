//! Templates of given spheres: a file, or a flat grid.

use super::file::{GridPart, TemplatePart};
use crate::error::{Error, Result, figure, reserve};
use crate::mass::Body;
use crate::math::{Inertia, Moments, Sphere, Vec3};
use crate::run::Run;
use std::path::Path;

/// The most spheres of a grid.
const MOST: u64 = 1_000_000;

/// The spheres that a template is given and the body that they are; `None` where it is made of a shape.
pub(super) fn given(
    part: &TemplatePart,
    folder: &Path,
    run: &Run,
) -> Result<Option<(Vec<Sphere>, Body)>> {
    let made = (part.ball.is_some(), part.grid.as_ref(), part.spheres_file.as_ref());
    let mut spheres = match made {
        (true, ..) => vec![Sphere::new(Vec3::zeros(), part.ball.unwrap_or_default())],
        (_, Some(grid), _) => of_grid(grid)?,
        (.., Some(name)) => crate::export::read::read(&folder.join(name))?.spheres,
        _ => return Ok(None),
    };
    if !(part.scale.is_finite() && part.scale > 0.0) {
        let scale = figure(part.scale);
        return Err(Error::InvalidArgument(format!("scale is {scale}, not a number above 0")));
    }
    if !made.0 {
        for s in &mut spheres {
            *s = Sphere::new(s.center * part.scale, s.radius * part.scale);
        }
    }
    let body = match part.grid {
        // Side by side their moments add up.
        Some(g) if g.spacing >= 2.0 * g.radius => Body::of_moments(&apart(&spheres), part.density)?,
        _ => Body::of_union(&spheres, part.density, run)?,
    };
    Ok(Some((spheres, body)))
}

fn of_grid(g: &GridPart) -> Result<Vec<Sphere>> {
    for (what, v) in [("spacing", g.spacing), ("radius", g.radius)] {
        if !(v.is_finite() && v > 0.0) {
            let v = figure(v);
            return Err(Error::InvalidArgument(format!(
                "grid.{what} is {v}, not a number above 0"
            )));
        }
    }
    let [x, y] = g.count;
    let n = u64::from(x) * u64::from(y);
    if n == 0 || n > MOST {
        return Err(Error::InvalidArgument(format!(
            "grid.count is {x} by {y}, not from 1 to {MOST} spheres"
        )));
    }
    let mut spheres = reserve("a grid of spheres", n as usize)?;
    let place = |i: u32, n: u32| (f64::from(i) - 0.5 * f64::from(n - 1)) * g.spacing;
    for j in 0..y {
        for i in 0..x {
            spheres.push(Sphere::new(Vec3::new(place(i, x), place(j, y), 0.0), g.radius));
        }
    }
    Ok(spheres)
}

/// The moments of spheres that do not overlap, about their own centre.
fn apart(spheres: &[Sphere]) -> Moments {
    let volume: f64 = spheres.iter().map(Sphere::volume).sum();
    let centroid =
        spheres.iter().map(|s| s.center * s.volume()).fold(Vec3::zeros(), |a, b| a + b) / volume;
    let mut all = nalgebra::Matrix3::zeros();
    for s in spheres {
        let own = 0.4 * s.volume() * s.radius * s.radius;
        let own = Inertia { xx: own, yy: own, zz: own, ..Inertia::default() };
        all += own.shifted(s.volume(), &(s.center - centroid)).matrix();
    }
    Moments { volume, centroid, inertia: Inertia::from_matrix(&all), relative_error: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_a_grid_are_those_of_its_union() {
        let grid = GridPart { count: [4, 3], spacing: 0.5, radius: 0.25 };
        let spheres = of_grid(&grid).unwrap();
        let (sum, union) =
            (apart(&spheres), crate::mass::union_moments(&spheres, &Run::serial()).unwrap());
        assert!((sum.volume / union.volume - 1.0).abs() < 1e-9);
        assert!((sum.centroid - union.centroid).norm() < 1e-9);
        for (a, b) in sum.inertia.to_array().iter().zip(union.inertia.to_array()) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
    }
}
