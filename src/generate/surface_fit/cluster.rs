//! Spheres that are nearly one, brought together (Price et al. 2007, section 2.1.3).

use crate::error::{Result, push};
use crate::math::Sphere;

/// Spheres and their mean.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cluster {
    /// Mean of centres and of radii.
    pub mean: Sphere,
    /// How many there are.
    pub members: usize,
}

/// Distance between spheres in centre and radius (eq 10).
pub(super) fn difference(a: &Sphere, b: &Sphere) -> f64 {
    ((a.center - b.center).norm_squared() + (a.radius - b.radius).powi(2)).sqrt()
}

/// Each sphere, in order, joins the nearest cluster whose mean is nearer than `merge`, or begins
/// one. The clusters of most members come first; of as many, the older.
pub(super) fn clusters(spheres: &[Sphere], merge: f64) -> Result<Vec<Cluster>> {
    let mut all: Vec<Cluster> = Vec::new();
    for s in spheres {
        let mut nearest: Option<(f64, &mut Cluster)> = None;
        for c in &mut all {
            let d = difference(&c.mean, s);
            if d < merge && nearest.as_ref().is_none_or(|n| d < n.0) {
                nearest = Some((d, c));
            }
        }
        if let Some((_, c)) = nearest {
            c.members += 1;
            let share = 1.0 / c.members as f64;
            c.mean.center += (s.center - c.mean.center) * share;
            c.mean.radius += (s.radius - c.mean.radius) * share;
        } else {
            push("clusters of spheres", &mut all, Cluster { mean: *s, members: 1 })?;
        }
    }
    all.sort_by_key(|c| std::cmp::Reverse(c.members));
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    fn sphere(x: f64, radius: f64) -> Sphere {
        Sphere::new(Vec3::new(x, 0.0, 0.0), radius)
    }

    #[test]
    fn spheres_join_the_nearest_cluster_by_centre_and_radius() {
        let all = [
            sphere(0.0, 1.0),
            sphere(5.0, 1.0),
            sphere(5.0, 2.0),
            sphere(5.1, 1.1),
            sphere(5.2, 0.9),
            sphere(4.9, 2.2),
        ];
        let found = clusters(&all, 0.5).unwrap();
        let members: Vec<usize> = found.iter().map(|c| c.members).collect();
        assert_eq!(members, [3, 2, 1]);
        assert!((found[0].mean.center.x - 5.1).abs() < 1e-12);
        assert!((found[0].mean.radius - 1.0).abs() < 1e-12);
        assert!((found[1].mean.center.x - 4.95).abs() < 1e-12);
        assert!((found[1].mean.radius - 2.1).abs() < 1e-12);
        assert_eq!(found[2].mean, all[0]);
        assert_eq!(difference(&sphere(0.0, 1.0), &sphere(3.0, 5.0)), 5.0);
    }

    #[test]
    fn nothing_is_nothing_and_of_equals_the_older_comes_first() {
        assert!(clusters(&[], 1.0).unwrap().is_empty());
        let found = clusters(&[sphere(3.0, 1.0), sphere(0.0, 1.0)], 1.0).unwrap();
        assert_eq!(found[0].mean.center.x, 3.0);
    }
}
