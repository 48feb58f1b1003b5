//! Needles, plates, shells, corners: bodies whose thinnest part is far below their size.

use super::bodies::{Arrays, Ask, METHODS, inverted, joined, mismatch, moved, solid, spheres};
use super::{About, Bound, Found, Matrix, Miss};
use morula::error::Error;
use morula::generate::{Method, generate};
use morula::math::Sphere;
use morula::measure::{QualityOptions, quality};
use morula::run::Run;
use morula::shape::{ImportOptions, Layout, Primitive, Shape};
use morula::solid::moments::moments;
use morula::solid::{Solid, SolidOptions};
use std::f64::consts::PI;

const ROW: About = About {
    measure: "D over that of n balls of the least thickness, apart",
    bound: Bound::AtMost(1.05),
    why: "a row of balls as thick as the body is what any method can nearly find, at draft effort",
};

const BEYOND: About = About {
    measure: "greatest radius beyond the exact depth, in sizes",
    bound: Bound::AtMost(1e-12),
    why: "an inscribed sphere crosses no triangle by more than rounding",
};

const VOLUME: About = About {
    measure: "|volume - exact| over the volume of the box",
    bound: Bound::AtMost(1e-14),
    why: "the integrals of a closed mesh are exact to rounding of what encloses it, however thin it is",
};

const SOUND: About = About {
    measure: "faulty spheres over ten methods",
    bound: Bound::AtMost(0.0),
    why: "at least one sphere, at most those asked for, all finite, positive, near the body; or a refusal \
          with a reason",
};

const OUTSIDE: About = About {
    measure: "protrusion, in sizes",
    bound: Bound::AtMost(2e-4),
    why: "the measure itself is sure to 1e-4 of an edge",
};

pub fn run(m: &mut Matrix) {
    thin(m);
    shells(m);
    every_method(m);
    numbers(m);
}

fn cuboid(edges: [f64; 3]) -> Result<Arrays, Miss> {
    Ok(Primitive::Box { edges }.mesh(8)?)
}

/// D of `n` balls of this diameter that lie apart within a body.
fn apart(n: usize, diameter: f64, volume: f64) -> f64 {
    let balls = (n as f64 * PI / 6.0 * diameter.powi(3)).min(volume);
    1.0 - 2.0 * balls / (balls + volume)
}

fn beyond(solid: &Solid, found: &[Sphere]) -> Found {
    let run = Run::serial();
    let surface = solid.surface(&run)?;
    let over = |s: &Sphere| {
        let s = solid.frame().sphere_to_unit(s);
        s.radius + surface.signed_distance(&s.center)
    };
    Ok(found.iter().map(over).fold(0.0, f64::max))
}

fn thin(m: &mut Matrix) {
    for aspect in [10.0, 100.0, 1000.0] {
        for (kind, edges) in [("needle", [aspect, 1.0, 1.0]), ("plate", [aspect, aspect, 1.0])] {
            for (name, method) in [("best", Method::Best), ("inscribed", Method::Inscribed)] {
                // As many as lie apart with room to spare.
                let n = f64::min(0.8 * aspect, 30.0) as usize;
                m.case(format!("{kind} 1:{aspect}, {name}, {n} spheres"), &ROW, || {
                    let solid = solid(&cuboid(edges)?, 64)?;
                    let found = spheres(&solid, &Ask::new(method, n))?;
                    let simple = apart(n, 1.0, edges.iter().product());
                    Ok(mismatch(&solid, &found)? / simple)
                });
            }
            m.case(format!("{kind} 1:{aspect}, inscribed"), &BEYOND, || {
                let solid = solid(&cuboid(edges)?, 64)?;
                beyond(&solid, &spheres(&solid, &Ask::new(Method::Inscribed, 30))?)
            });
        }
    }
    m.case("torus, tube a hundredth of its ring, inscribed", &BEYOND, || {
        let solid = solid(&Primitive::Torus { major: 1.0, minor: 0.01 }.mesh(48)?, 64)?;
        beyond(&solid, &spheres(&solid, &Ask::new(Method::Inscribed, 30))?)
    });
}

/// A ball with a concentric hole.
fn shell(outer: f64, inner: f64) -> Result<Arrays, Miss> {
    let ball = |radius| Primitive::Sphere { radius }.mesh(32);
    Ok(joined(ball(outer)?, &inverted(&ball(inner)?)))
}

/// Volume that closed triangles hold, summed by tetrahedra.
fn held(mesh: &Arrays) -> f64 {
    let at = |v: u32| morula::math::Vec3::from(mesh.0[v as usize]);
    mesh.1.iter().map(|f| at(f[0]).dot(&at(f[1]).cross(&at(f[2]))) / 6.0).sum()
}

fn shells(m: &mut Matrix) {
    for wall in [0.1, 1e-3, 1e-6] {
        m.case(format!("ball with a wall of {wall}"), &VOLUME, || {
            let mesh = shell(1.0, 1.0 - wall)?;
            let run = Run::serial();
            let shape = Shape::from_mesh(&mesh.0, &mesh.1, &ImportOptions::default(), &run)?;
            let unit = moments(&shape.body, &run)?;
            Ok((shape.frame.moments_to_input(&unit).volume - held(&mesh)).abs() / 8.0)
        });
    }
    for wall in [0.1, 0.03, 0.01] {
        m.case(format!("ball with a wall of {wall}, inscribed"), &BEYOND, || {
            let solid = solid(&shell(1.0, 1.0 - wall)?, 32)?;
            beyond(&solid, &spheres(&solid, &Ask::new(Method::Inscribed, 40))?)
        });
    }
    m.case("shell in a shell around a core", &VOLUME, || {
        let inner = shell(0.6, 0.5)?;
        let core = Primitive::Sphere { radius: 0.2 }.mesh(16)?;
        let mesh = joined(joined(shell(1.0, 0.9)?, &inner), &core);
        Ok((solid(&mesh, 32)?.moments().volume - held(&mesh)).abs() / 8.0)
    });
    m.case("a wall of one cell in voxels, inscribed", &OUTSIDE, || {
        let solid = hollow(14)?;
        let found = spheres(&solid, &Ask::new(Method::Inscribed, 60))?;
        let options = QualityOptions { overlap: false, ..QualityOptions::default() };
        let q = quality(&solid, &found, &options, &Run::serial())?;
        Ok(q.protrusion / 14.0)
    });
}

/// A hollow cube of cells: walls of one cell.
fn hollow(n: usize) -> Result<Solid, Miss> {
    let at = |c: usize| [c % n, c / n % n, c / n / n];
    let wall = |c: usize| u8::from(at(c).iter().any(|&i| i == 0 || i == n - 1));
    voxels([n; 3], &(0..n * n * n).map(wall).collect::<Vec<_>>())
}

fn voxels(dims: [usize; 3], cells: &[u8]) -> Result<Solid, Miss> {
    let run = Run::serial();
    let layout = Layout { dims, spacing: [1.0; 3], origin: [0.0; 3] };
    let shape = Shape::from_mask(cells, &layout, &ImportOptions::default(), &run)?;
    Ok(Solid::new(&shape, &SolidOptions::default(), &run)?)
}

/// Those that take every body: a refusal is a fault.
const TAKE_ALL: [Method; 4] = [Method::Mss, Method::Best, Method::Inscribed, Method::Cover];

/// Faulty spheres of all methods.
fn faults(solid: &Solid, n: usize) -> Found {
    let moments = solid.moments();
    let grid = solid.grid();
    let reach = (0..3).map(|i| grid.dims[i] as f64 * grid.spacing[i]).fold(0.0, f64::max);
    let reach = reach * solid.frame().scale;
    let mut faults = 0;
    for method in METHODS {
        let made = generate(solid, &Ask::new(method, n).options(), &Run::serial());
        let found = match made {
            Ok(clump) => clump.spheres,
            Err(Error::Internal(text)) => return Err(Miss(format!("{method:?}: {text}"))),
            // Cells as fine as thin walls need do not fit into the memory that may be taken.
            Err(Error::MemoryLimit(_)) => continue,
            Err(e) if TAKE_ALL.contains(&method) => return Err(Miss(format!("{method:?}: {e}"))),
            Err(_) => continue,
        };
        if found.is_empty() || found.len() > n {
            return Err(Miss(format!("{method:?} makes {} spheres for {n}", found.len())));
        }
        let sound = |s: &Sphere| {
            let off = (s.center - moments.centroid).norm();
            s.radius.is_finite()
                && s.radius > 0.0
                && off.is_finite()
                && off + s.radius < 3.0 * reach
        };
        faults += found.iter().filter(|s| !sound(s)).count();
    }
    Ok(faults as f64)
}

fn every_method(m: &mut Matrix) {
    let touching = |p: [f64; 3]| [p[0] + 2.0, p[1], p[2]];
    let octahedron: Arrays = (
        (0..6)
            .map(|k| [0, 1, 2].map(|a| if a == k / 2 { 1.0 - 2.0 * (k % 2) as f64 } else { 0.0 }))
            .collect(),
        vec![
            [0, 2, 4],
            [2, 1, 4],
            [1, 3, 4],
            [3, 0, 4],
            [2, 0, 5],
            [1, 2, 5],
            [3, 1, 5],
            [0, 3, 5],
        ],
    );
    let pair = joined(octahedron.clone(), &moved(&octahedron, touching));
    let of = |p: Primitive, n: u32| p.mesh(n as usize);
    let bodies = [
        ("octahedron", Ok(octahedron)),
        ("two octahedra that touch at a corner", Ok(pair)),
        ("needle 1:20", of(Primitive::Box { edges: [20.0, 1.0, 1.0] }, 8)),
        ("plate 1:20", of(Primitive::Box { edges: [20.0, 20.0, 1.0] }, 8)),
        ("cone 1:50", of(Primitive::Cone { radius: 1.0, height: 50.0 }, 24)),
        ("star with cusps", {
            of(Primitive::Superellipsoid { axes: [1.0; 3], exponents: [2.5, 2.5] }, 24)
        }),
        ("nearly a box", {
            of(Primitive::Superellipsoid { axes: [1.0; 3], exponents: [0.1, 0.1] }, 24)
        }),
        ("fractal stone", of(Primitive::Stone { seed: 7, diameter: 1.0, roughness: 1.0 }, 32)),
    ];
    // Fine grids, minutes in all.
    let thinnest = [
        ("needle 1:100", of(Primitive::Box { edges: [100.0, 1.0, 1.0] }, 8)),
        ("plate 1:100", of(Primitive::Box { edges: [100.0, 100.0, 1.0] }, 8)),
        ("torus, tube a fiftieth of its ring", {
            of(Primitive::Torus { major: 1.0, minor: 0.02 }, 24)
        }),
        ("ball with a wall of 0.02", shell(1.0, 0.98).map_err(|Miss(e)| Error::Internal(e))),
    ];
    let thinnest = thinnest.into_iter().filter(|_| m.full);
    for (name, mesh) in bodies.into_iter().chain(thinnest).collect::<Vec<_>>() {
        m.case(format!("{name}, 12 spheres"), &SOUND, || faults(&solid(&mesh?, 24)?, 12));
    }
    m.case("ball with a wall of 0.2, 12 spheres", &SOUND, || {
        faults(&solid(&shell(1.0, 0.8)?, 24)?, 12)
    });
    m.case("hollow cube of cells, walls of one, 12 spheres", &SOUND, || faults(&hollow(12)?, 12));
}

/// From one sphere to more than there can be.
fn numbers(m: &mut Matrix) {
    m.case("stone, 1 sphere", &SOUND, || {
        let stone = Primitive::Stone { seed: 7, diameter: 1.0, roughness: 0.5 };
        faults(&solid(&stone.mesh(24)?, 24)?, 1)
    });
    m.case("one cell, 100 spheres", &SOUND, || faults(&voxels([1; 3], &[1])?, 100));
    m.case("two cells, 100 spheres", &SOUND, || faults(&voxels([2, 1, 1], &[1, 1])?, 100));
    let most = if m.full { 5000 } else { 200 };
    m.case(format!("tetrahedron, {most} spheres"), &SOUND, || {
        let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        faults(&solid(&(corners, faces), 24)?, most)
    });
}
