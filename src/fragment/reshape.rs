//! Shapes that change without breaking: dented, worn or grown particles get new spheres, and keep
//! mass and motion.

use super::{Cut, Held, Parent, ShatterOptions, Shattered, shatter};
use crate::error::Result;
use crate::math::Sphere;
use crate::run::Run;
use crate::solid::Solid;
use std::sync::Arc;

/// New spheres for a body of a new shape: what `by` leaves of the `solid`, starting from the `old`
/// spheres (caller's frame), which may reach beyond it. The held body is handed over as at a
/// break, and the map tells which old spheres the new ones come from.
///
/// Errors: as those of [`Parent::new`] and [`shatter`].
pub fn reshape(
    solid: Arc<Solid>,
    old: &[Sphere],
    held: &Held,
    by: &Cut,
    options: &ShatterOptions,
    run: &Run,
) -> Result<(Parent, Shattered)> {
    let parent = Parent::reshaped(solid, old, run)?;
    let found = shatter(&parent, None, held, by, options, run)?;
    Ok((parent, found))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragment::Parent;
    use crate::generate::{GenerateOptions, HalfSpace, Method, generate};
    use crate::mass::Body;
    use crate::math::Vec3;
    use crate::shape::{ImportOptions, Primitive, Shape};
    use crate::solid::SolidOptions;

    #[test]
    fn a_dented_stone_keeps_mass_and_motion() {
        let run = Run::serial();
        let stone = Primitive::from_name("stone").unwrap();
        let shape = Shape::from_primitive(&stone, 30, &ImportOptions::default(), &run).unwrap();
        let solid = Arc::new(Solid::new(&shape, &SolidOptions::default(), &run).unwrap());
        let wanted = GenerateOptions {
            method: Method::Inscribed,
            spheres: 30,
            ..GenerateOptions::default()
        };
        let old = generate(&solid, &wanted, &run).unwrap().spheres;
        let body = Body::of_solid(&solid, 2.0).unwrap();
        let held = Held {
            angular_velocity: Vec3::new(1.0, 2.0, 3.0),
            ..Held::of_body(&body, 1.0).unwrap()
        };
        // A flat pressed into it.
        let reach = old.iter().map(|s| s.center.x + s.radius).fold(f64::MIN, f64::max);
        let offset = 0.7 * reach + 0.3 * body.center.x;
        let flat = Cut::Within(vec![HalfSpace { normal: Vec3::x(), offset }]);
        let mut options = ShatterOptions::default();
        options.reclump.spheres = 30;
        let (parent, found) =
            reshape(Arc::clone(&solid), &old, &held, &flat, &options, &run).unwrap();
        assert_eq!((found.fragments.len(), found.dust.len()), (1, 0));
        let f = &found.fragments[0];
        assert!((f.moving.mass / held.mass - 1.0).abs() < 1e-14);
        assert!(f.clump.spheres.iter().all(|s| s.center.x + s.radius <= offset));
        assert_eq!(f.clump.spheres.len(), 30);
        // Nothing but the old spheres and the new shape is kept, and the spheres are as good as
        // those of a parent that was searched for its medial balls.
        let searched = Parent::new(solid, &old, &run).unwrap();
        assert!(parent.bytes() < searched.bytes() / 2);
        options.reclump.union = false;
        let as_good = shatter(&searched, None, &held, &flat, &options, &run).unwrap();
        assert!(f.clump.coverage > as_good.fragments[0].clump.coverage - 0.02);
        assert!((0..30).all(|i| !f.clump.map.of(i).is_empty()));
        let momentum = |inertia: crate::math::Inertia, w: Vec3| inertia.matrix() * w;
        let (a, b) = (
            momentum(held.inertia, held.angular_velocity),
            momentum(f.moving.inertia, f.moving.angular_velocity),
        );
        assert!((a - b).norm() < 1e-12 * a.norm() && found.inertia_error > 0.01);
    }
}
