//! The bodies that the programs are given.

use morula::export::Record;
use morula::generate::{GenerateOptions, generate};
use morula::mass::{Body, MassOptions, MassStatus, Placement, correct};
use morula::math::{Inertia, PrincipalFrame, Vec3};
use morula::shape::read::FileOptions;
use morula::shape::{ImportOptions, Primitive, Shape};
use morula::solid::SolidOptions;
use morula::{Run, Solid, Sphere};

/// A body, and whether its spheres add up to it.
pub struct Case {
    pub name: &'static str,
    pub record: Record,
    pub exact: bool,
}

/// Six spheres of given masses, the three of a published comparison, and a stone.
pub fn cases() -> [Case; 3] {
    let (three, status) = three();
    let (stone, found) = stone();
    assert_eq!((status, found), (MassStatus::Relaxed, MassStatus::Exact));
    [
        Case { name: "six", record: record(), exact: true },
        Case { name: "three", record: three, exact: false },
        Case { name: "stone", record: stone, exact: true },
    ]
}

/// Three overlapping spheres of 1.0, 0.8 and 0.7 mm and density 2500: 1.40732e-5 kg and 6.0007,
/// 7.4178, 8.2472 e-12 kg m² by a fine grid of cells, which adding up whole spheres makes 38 % too
/// heavy. No masses of three spheres have the inertia.
pub fn three() -> (Record, MassStatus) {
    let rows = [[0.0, 0.0, 1.0], [0.7986, 0.0, 0.8], [0.3172, 0.6335, 0.7]];
    let spheres = rows.map(|[x, y, r]| Sphere::new(Vec3::new(x, y, 0.0) * 1e-3, r * 1e-3));
    let body = Body::of_union(&spheres, 2500.0, &Run::serial()).unwrap();
    let m = correct(&spheres, &body, &MassOptions::default(), &Run::serial()).unwrap();
    println!("three spheres: ε {:.3} by masses of {:?} kg", m.residuals.inertia, m.masses);
    (Record::new("three spheres", &spheres, &m.masses, &body).unwrap(), m.status)
}

/// A clump of a scanned stone of about 5 mm (or, without the data, of the built-in one), with the mass and
/// inertia of the stone.
pub fn stone() -> (Record, MassStatus) {
    let run = Run::serial();
    let shape = match std::env::var_os("MORULA_DATA") {
        Some(data) => {
            let path = std::path::Path::new(&data).join("particles/stone/stone_10.stl");
            Shape::from_file(&path, &FileOptions::default(), &run).unwrap()
        }
        None => {
            let stone = Primitive::from_name("stone").unwrap();
            Shape::from_primitive(&stone, 64, &ImportOptions::default(), &run).unwrap()
        }
    };
    let solid = Solid::new(&shape, &SolidOptions::default(), &run).unwrap();
    let options = GenerateOptions { spheres: 50, ..GenerateOptions::default() };
    let spheres = generate(&solid, &options, &run).unwrap().spheres;
    let whole = Body::of_solid(&solid, 1.0).unwrap();
    let place = Placement { scale: 4e-3 / whole.volume.cbrt(), ..Placement::default() };
    let (spheres, body) = (place.spheres(&spheres).unwrap(), place.body(&whole, 2650.0).unwrap());
    let m = correct(&spheres, &body, &MassOptions::default(), &run).unwrap();
    (Record::new("stone", &spheres, &m.masses, &body).unwrap(), m.status)
}

/// Centres (mm), radii (mm) and masses (mg) without any symmetry.
const SPHERES: [[f64; 5]; 6] = [
    [0.35, 0.82, -1.10, 0.80, 6.1],
    [-0.54, 0.36, 0.45, 1.00, 9.7],
    [0.91, -0.45, 0.58, 0.70, 5.2],
    [0.32, 0.04, 0.30, 1.10, 9.3],
    [-1.27, -0.16, -0.29, 0.60, 5.9],
    [0.04, 0.60, -0.02, 0.90, 8.1],
];

/// Solid spheres of given masses, overlapping, added up, in SI, with its frame turned and shifted against the spheres above.
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

#[test]
fn the_three_spheres_are_those_of_the_comparison() {
    let (r, _) = three();
    for (found, cells) in [
        (r.mass, 1.40732e-5),
        (r.moments[0], 6.0007e-12),
        (r.moments[1], 7.4178e-12),
        (r.moments[2], 8.2472e-12),
    ] {
        // Cells of a grid, and centres that were found from these figures.
        assert!((found / cells - 1.0).abs() < 3e-4, "{found} {cells}");
    }
    let sum: f64 = r.spheres.iter().map(|s| 2500.0 * s.volume()).sum();
    assert!((sum / r.mass - 1.38).abs() < 1e-3 && (sum / 1.9426e-5 - 1.0).abs() < 1e-4);
    assert!((r.masses.iter().sum::<f64>() / r.mass - 1.0).abs() < 1e-14);
}
