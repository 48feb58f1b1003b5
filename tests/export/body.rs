//! A body that is known exactly: solid spheres of given masses, overlapping, added up.

use morula::Sphere;
use morula::export::Record;
use morula::math::{Inertia, PrincipalFrame, Vec3};

/// Centres (mm), radii (mm) and masses (mg) without any symmetry.
const SPHERES: [[f64; 5]; 6] = [
    [0.35, 0.82, -1.10, 0.80, 6.1],
    [-0.54, 0.36, 0.45, 1.00, 9.7],
    [0.91, -0.45, 0.58, 0.70, 5.2],
    [0.32, 0.04, 0.30, 1.10, 9.3],
    [-1.27, -0.16, -0.29, 0.60, 5.9],
    [0.04, 0.60, -0.02, 0.90, 8.1],
];

/// The record in SI, with its frame turned and shifted against the spheres above.
pub fn record() -> Record {
    let masses = SPHERES.map(|s| s[4] * 1e-6);
    let centers = SPHERES.map(|s| Vec3::new(s[0], s[1], s[2]) * 1e-3);
    let radii = SPHERES.map(|s| s[3] * 1e-3);
    let mass: f64 = masses.iter().sum();
    let center = centers.iter().zip(masses).map(|(c, m)| c * m).sum::<Vec3>() / mass;
    let mut tensor = nalgebra::Matrix3::zeros();
    for i in 0..6 {
        let d = centers[i] - center;
        let own = 0.4 * radii[i] * radii[i] + d.norm_squared();
        tensor += masses[i] * (own * nalgebra::Matrix3::identity() - d * d.transpose());
    }
    let frame = PrincipalFrame::of(&Inertia::from_matrix(&tensor));
    let turned = |i: usize| Sphere::new(frame.axes.transpose() * (centers[i] - center), radii[i]);
    Record {
        name: "six spheres".into(),
        spheres: (0..6).map(turned).collect(),
        masses: masses.into(),
        mass,
        volume: mass / 2500.0,
        moments: frame.moments,
        center,
        axes: frame.axes,
        quaternion: frame.quaternion,
    }
}
