//! Invariance of bodies that once missed it: what random ones of `tests/stability/properties.rs` showed, and
//! mirrored stones.

use super::bodies::{Ask, inverted, moved, on_lattice};
use super::invariance::{IMAGED, PERCENT, change, images};
use super::{Matrix, Miss};
use morula::generate::{Effort, Method};
use morula::shape::Primitive;

pub fn run(m: &mut Matrix) {
    use Method::*;
    let lattice = |p: Primitive, n| Ok::<_, Miss>(on_lattice(p.mesh(n)?));
    let ask = |method, n| Ask { cells: 16, effort: Effort::Normal, ..Ask::new(method, n) };
    let stone = Primitive::Stone { seed: 674, diameter: 1.0, roughness: 0.2808474133692786 };
    for (name, method) in [("surface_fit", SurfaceFit), ("ferellec_mcdowell", FerellecMcDowell)] {
        m.case(format!("{name}, stone 674, corners of triangles turned"), &PERCENT, || {
            let mesh = lattice(stone, 13)?;
            let turned = mesh.1.iter().map(|f| [f[1], f[2], f[0]]).collect();
            change(&mesh, &(mesh.0.clone(), turned), &ask(method, 11))
        });
    }
    // Those that were farthest off while methods followed the caller's axes.
    for (name, method) in [
        ("surface_fit", SurfaceFit),
        ("euclidean", Euclidean),
        ("ferellec_mcdowell", FerellecMcDowell),
    ] {
        for seed in [5, 9] {
            let stone = Primitive::Stone { seed, diameter: 1.0, roughness: 0.4 };
            match lattice(stone, 16) {
                Ok(mesh) => images(m, &format!("{name}, stone {seed}"), &mesh, &ask(method, 20)),
                Err(miss) => m.case(name, &IMAGED, || Err(miss)),
            }
        }
    }
    // Bodies in which the second moments or the centre of mass say nothing of an axis or a side.
    for (name, edges, slant) in [
        ("parallelepiped", [0.75, 0.5, 0.375], 0.25),
        ("needle", [1.0, 1.0 / 512.0, 1.0 / 1024.0], 0.0),
    ] {
        for (what, order) in [("mirrored", [0, 1, 2]), ("mirrored, axes exchanged", [0, 2, 1])] {
            m.case(format!("{name}, {what}"), &PERCENT, || {
                let lean = |p: [f64; 3]| [p[0] + slant * (p[1] + p[2]), p[1] + slant * p[2], p[2]];
                let body = moved(&lattice(Primitive::Box { edges }, 16)?, lean);
                let image = moved(&body, |p| [-p[order[0]], p[order[1]], p[order[2]]]);
                let image = if order[1] == 1 { inverted(&image) } else { image };
                change(&body, &image, &ask(Best, 20))
            });
        }
    }
    let torus = |minor| Primitive::Torus { major: 0.5, minor };
    let cuboid = |edges| Primitive::Box { edges };
    for (name, method, p, cut, n, scale, about) in [
        (
            "euclidean, torus",
            Euclidean,
            torus(0.26106235195636146),
            9,
            8,
            85.0295906993677,
            &PERCENT,
        ),
        (
            "euclidean, torus again",
            Euclidean,
            torus(0.2652253558215911),
            9,
            4,
            62.678996429107755,
            &PERCENT,
        ),
        (
            "cover, box",
            Cover,
            cuboid([0.9198631464446606, 0.5648998341321958, 0.8271321346404767]),
            12,
            5,
            0.18877109632493283,
            &PERCENT,
        ),
        (
            "cover, torus",
            Cover,
            torus(0.24251226694505246),
            13,
            9,
            1.4869868886306338e-12,
            &PERCENT,
        ),
        (
            "inscribed, stone 151",
            Inscribed,
            Primitive::Stone { seed: 151, diameter: 1.0, roughness: 0.49106004971180617 },
            9,
            11,
            3.973999044039824e-5,
            &PERCENT,
        ),
    ] {
        m.case(format!("{name} of {n} spheres times {scale:.2e}"), about, || {
            let mesh = lattice(p, cut)?;
            change(&mesh, &moved(&mesh, |p| p.map(|x| scale * x)), &ask(method, n))
        });
    }
}
