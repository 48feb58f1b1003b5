//! What many contacts do to a clump at the same time.

use crate::math::{Sphere, Vec3};
use nalgebra::Matrix3;

/// The greatest stable step of two equal bodies that touch in `contacts` contacts along one normal, each on
/// a sphere of its own (on all of them equally, where there are fewer): √(2/λ), λ the greatest
/// eigenvalue of Σ k w wᵀ, w = (n/√M, I^-½ (c × n)). Over which spheres, which normal n and which
/// motion u: by turns, each the best for the others, from several normals.
///
/// `spheres` and `moments` in the body frame; `spring` is the stiffness of a contact of a sphere.
pub(super) fn together(
    spheres: &[Sphere],
    mass: f64,
    moments: [f64; 3],
    spring: impl Fn(&Sphere) -> f64,
    contacts: u32,
) -> f64 {
    let root = Vec3::from(moments).map(|i| 1.0 / i.sqrt());
    let n = spheres.len().min(contacts as usize).max(1);
    let times = f64::from(contacts) / n as f64;
    let springs: Vec<f64> = spheres.iter().map(spring).collect();
    let mut all: Vec<u32> = (0..spheres.len() as u32).collect();
    let mut most = 0.0f64;
    for start in STARTS {
        let mut normal = Vec3::from(start).normalize();
        // What a push where it is felt most does.
        let push = |i: &u32| {
            let turned = spheres[*i as usize].center.cross(&normal).component_mul(&root);
            (normal / mass.sqrt(), turned)
        };
        let felt = |i: &u32| springs[*i as usize] * push(i).1.norm_squared();
        let Some(first) = (0..spheres.len() as u32).max_by(|i, j| felt(i).total_cmp(&felt(j)))
        else {
            break;
        };
        let (mut v, mut w) = push(&first);
        let size = (v.norm_squared() + w.norm_squared()).sqrt();
        (v, w) = (v / size, w / size);
        for turn in 0..TURNS {
            let pushed = |i: &u32| {
                let turned = spheres[*i as usize].center.cross(&normal).component_mul(&root);
                (normal / mass.sqrt(), turned)
            };
            let held = |i: &u32| {
                let (a, b) = pushed(i);
                springs[*i as usize] * (a.dot(&v) + b.dot(&w)).powi(2)
            };
            if n < all.len() {
                all.select_nth_unstable_by(n - 1, |i, j| {
                    held(j).total_cmp(&held(i)).then(i.cmp(j))
                });
            }
            let chosen = all.get(..n).unwrap_or(&all);
            most = most.max(chosen.iter().map(held).sum());
            let (mut next_v, mut next_w) = (Vec3::zeros(), Vec3::zeros());
            let mut along = Matrix3::zeros();
            for i in chosen {
                let (a, b) = pushed(i);
                let part = springs[*i as usize] * (a.dot(&v) + b.dot(&w));
                next_v += a * part;
                next_w += b * part;
                let g =
                    v / mass.sqrt() + w.component_mul(&root).cross(&spheres[*i as usize].center);
                along += g * g.transpose() * springs[*i as usize];
            }
            let size = (next_v.norm_squared() + next_w.norm_squared()).sqrt();
            if size <= 0.0 {
                break;
            }
            (v, w) = (next_v / size, next_w / size);
            // The motion settles between two turns of the normal.
            if turn % 4 == 3 {
                let eigen = along.symmetric_eigen();
                normal = eigen.eigenvectors.column(eigen.eigenvalues.imax()).normalize();
            }
        }
    }
    if most > 0.0 { (2.0 / (times * most)).sqrt() } else { f64::MAX }
}

/// Normals to start from: half of the corners, edges and faces of a cube.
const STARTS: [[f64; 3]; 13] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

const TURNS: usize = 24;
