//! The same body in another unit, elsewhere, turned or written down otherwise has the same clump.

use super::bodies::{
    Arrays, Ask, apart, images_apart, inverted, made, mismatch, moved, rotation, same_number,
    shuffled, subdivided, three, three_as_made,
};
use super::{About, Bound, Found, Matrix, Miss};
use morula::generate::{Effort, Method};
use morula::math::{Sphere, Vec3};

pub(super) const BITS: About = About {
    measure: "greatest difference of spheres, in sizes",
    bound: Bound::AtMost(0.0),
    why: "work is done in a unit frame scaled by a power of two, so an exact change changes no bit",
};

pub(super) const PLACES: About = About {
    measure: "greatest difference of spheres, in roundings of the place",
    bound: Bound::AtMost(1.0),
    why: "the same clump; its centres are rounded once where they are written down",
};

pub(super) const PERCENT: About = About {
    measure: "|D/D0 - 1|, same n",
    bound: Bound::AtMost(0.01),
    why: "one rounding may change a choice of a greedy search, never the quality beyond 1 %",
};

pub(super) const ANOTHER: About = About {
    measure: "|D/D0 - 1|, same n, normal effort",
    bound: Bound::AtMost(0.03),
    why: "what single precision sees makes another run of the search: no farther off than runs of other seeds",
};

pub(super) const IMAGED: About = About {
    measure: "greatest difference of spheres from their images, in sizes",
    bound: Bound::AtMost(1e-14),
    why: "methods see the same bytes of a body and its image: exchanged and mirrored exactly but for the last \
          rounding of a coordinate",
};

const SET: About = About {
    measure: "greatest distance to the nearest sphere of the other, in roundings",
    bound: Bound::AtMost(17.0),
    why: "packed keeps 16 roundings of the place free, lest balls overlap; nearly equal radii change order",
};

pub(super) const TURNED: About = About {
    measure: "(greatest D - least D) / mean over 6 rotations",
    bound: Bound::AtMost(0.03),
    why: "the grid does not turn with the body: the search starts from other cells",
};

pub fn run(m: &mut Matrix) {
    let bodies = match three() {
        Ok(bodies) => bodies,
        Err(error) => return m.case("bodies", &BITS, || Err(error.into())),
    };
    for (name, mesh) in &bodies {
        unit(m, name, mesh);
        place(m, name, mesh);
        description(m, name, mesh);
        turns(m, name, mesh);
        threads(m, name, mesh);
    }
    super::particles::run(m);
    super::voxels::run(m);
    methods(m, &bodies);
    match three_as_made() {
        Ok(bodies) => rounded(m, &bodies),
        Err(error) => return m.case("bodies", &PERCENT, || Err(error.into())),
    }
    super::found::run(m);
    super::symmetry::run(m);
}

/// What the method finds of the body as it stands, and of the changed one.
fn both(mesh: &Arrays, changed: &Arrays, ask: &Ask) -> Result<[(Vec<Sphere>, f64); 2], Miss> {
    let one = |m: &Arrays| -> Result<(Vec<Sphere>, f64), Miss> {
        let (solid, spheres) = made(m, ask)?;
        let d = mismatch(&solid, &spheres)?;
        Ok((spheres, d))
    };
    Ok([one(mesh)?, one(changed)?])
}

/// Change of D.
pub(super) fn change(mesh: &Arrays, changed: &Arrays, ask: &Ask) -> Found {
    let [(a, da), (b, db)] = both(mesh, changed, ask)?;
    same_number(&a, &b)?;
    Ok((db / da - 1.0).abs())
}

fn exactly(mesh: &Arrays, ask: &Ask, scale: f64, shift: [f64; 3]) -> Found {
    let put = moved(mesh, |p| [0, 1, 2].map(|i| p[i] * scale + shift[i]));
    apart(&made(&put, ask)?.1, &made(mesh, ask)?.1, scale, shift)
}

fn unit(m: &mut Matrix, name: &str, mesh: &Arrays) {
    let ask = Ask::new(Method::Best, 20);
    for k in [-40, 40] {
        m.case(format!("{name} times 2^{k}"), &BITS, || {
            exactly(mesh, &ask, 2f64.powi(k), [0.0; 3])
        });
    }
    for scale in [1e-12, 1e-3, 7.7, 1e12] {
        m.case(format!("{name} times {scale:e}"), &PERCENT, || {
            change(mesh, &moved(mesh, |p| p.map(|x| x * scale)), &ask)
        });
    }
}

fn place(m: &mut Matrix, name: &str, mesh: &Arrays) {
    let ask = Ask::new(Method::Best, 20);
    let shift = [1e8, -3e7, 17.0];
    m.case(format!("{name} 1e8 sizes away, exactly"), &PLACES, || {
        Ok(exactly(mesh, &ask, 1.0, shift)? / (1e8 * 0.5 * f64::EPSILON))
    });
}

/// Coordinates that are rounded where they are written down: by 1e-8 of the size, or by 1e-16.
fn rounded(m: &mut Matrix, bodies: &[(&'static str, Arrays)]) {
    for (name, mesh) in bodies {
        let ask = Ask { effort: Effort::Normal, ..Ask::new(Method::Best, 20) };
        for (far, about) in [(1e4, &PERCENT), (1e8, &ANOTHER)] {
            let shift = [far / 3.0, -far / 7.0, far / 1.1];
            m.case(format!("{name} {far:e} sizes away, rounded"), about, || {
                change(mesh, &moved(mesh, |p| [0, 1, 2].map(|i| p[i] + shift[i])), &ask)
            });
        }
        m.case(format!("{name}, rounded to single precision"), &ANOTHER, || {
            change(mesh, &moved(mesh, |p| p.map(|x| f64::from(x as f32))), &ask)
        });
    }
}

fn description(m: &mut Matrix, name: &str, mesh: &Arrays) {
    let ask = Ask::new(Method::Best, 20);
    let mut case = |what: &str, changed: Arrays| {
        m.case(format!("{name}, {what}"), &PERCENT, || change(mesh, &changed, &ask));
    };
    let faces = shuffled(mesh.1.len(), 1).into_iter().map(|i| mesh.1[i as usize]);
    case("triangles in another order", (mesh.0.clone(), faces.collect()));
    let order = shuffled(mesh.0.len(), 2);
    let mut at = vec![0; order.len()];
    order.iter().enumerate().for_each(|(i, o)| at[*o as usize] = i as u32);
    let vertices = order.iter().map(|i| mesh.0[*i as usize]).collect();
    let faces = mesh.1.iter().map(|f| f.map(|v| at[v as usize])).collect();
    case("vertices in another order", (vertices, faces));
    case("corners of triangles turned", {
        (mesh.0.clone(), mesh.1.iter().map(|f| [f[1], f[2], f[0]]).collect())
    });
    case("inside out", inverted(mesh));
    let half = |(i, f): (usize, &[u32; 3])| if i % 3 == 1 { [f[1], f[0], f[2]] } else { *f };
    case("every third triangle inside out", {
        (mesh.0.clone(), mesh.1.iter().enumerate().map(half).collect())
    });
    let corners = mesh.1.iter().flatten().map(|v| mesh.0[*v as usize]).collect();
    let own = (0..mesh.1.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    case("vertices of each triangle its own", (corners, own));
    m.case(format!("{name}, each triangle cut in four"), &ANOTHER, || {
        let ask = Ask { effort: Effort::Normal, ..ask };
        change(mesh, &subdivided(mesh), &ask)
    });
}

fn turns(m: &mut Matrix, name: &str, mesh: &Arrays) {
    let ask = Ask { effort: Effort::Normal, ..Ask::new(Method::Best, 20) };
    // Images of a symmetric body are the body itself, with its corners in another order.
    if name == "stone" {
        images(m, name, mesh, &ask);
    } else {
        m.case(format!("{name}, axes exchanged"), &PERCENT, || {
            change(mesh, &moved(mesh, |p| [p[2], p[0], p[1]]), &ask)
        });
        m.case(format!("{name}, mirrored"), &PERCENT, || {
            change(mesh, &inverted(&moved(mesh, |p| [-p[0], p[1], p[2]])), &ask)
        });
    }
    m.case(format!("{name}, turned"), &TURNED, || turned(mesh, &ask));
}

/// Exchanged and mirrored bodies of coordinates that this does not round.
pub(super) fn images(m: &mut Matrix, name: &str, mesh: &Arrays, ask: &Ask) {
    type Image = fn([f64; 3]) -> [f64; 3];
    for (what, odd, image) in [
        ("axes exchanged", false, (|p| [p[2], p[0], p[1]]) as Image),
        ("mirrored", true, |p| [p[0], -p[1], p[2]]),
        ("two axes exchanged", true, |p| [p[1], p[0], p[2]]),
    ] {
        m.case(format!("{name}, {what}"), &IMAGED, || {
            let put = moved(mesh, image);
            let put = if odd { inverted(&put) } else { put };
            images_apart(&made(&put, ask)?.1, &made(mesh, ask)?.1, image)
        });
    }
}

/// How far D differs over six rotations.
pub(super) fn turned(mesh: &Arrays, ask: &Ask) -> Found {
    let ds: Result<Vec<f64>, Miss> = (0..6)
        .map(|k| {
            let rows = rotation(k);
            let turn = |p: [f64; 3]| [0, 1, 2].map(|i| rows[i].dot(&Vec3::from(p)));
            let (solid, spheres) = made(&moved(mesh, turn), ask)?;
            Ok(mismatch(&solid, &spheres)?)
        })
        .collect();
    let ds = ds?;
    let (lo, hi) = ds.iter().fold((f64::MAX, 0.0f64), |(l, h), d| (l.min(*d), h.max(*d)));
    Ok((hi - lo) * ds.len() as f64 / ds.iter().sum::<f64>())
}

fn threads(m: &mut Matrix, name: &str, mesh: &Arrays) {
    m.case(format!("{name} on 2 to 8 threads"), &BITS, || {
        let ask = Ask { effort: Effort::Normal, ..Ask::new(Method::Best, 12) };
        let one = made(mesh, &ask)?.1;
        let mut worst = 0.0f64;
        for threads in 2..=8 {
            let many = made(mesh, &Ask { threads, ..ask })?.1;
            worst = worst.max(apart(&many, &one, 1.0, [0.0; 3])?);
        }
        Ok(worst)
    });
}

/// Every method, on a body that it takes.
fn methods(m: &mut Matrix, bodies: &[(&'static str, Arrays)]) {
    use Method::*;
    let [(_, stone), (_, ellipsoid), ..] = bodies else { return };
    for (name, method) in [
        ("mss", Mss),
        ("surface_fit", SurfaceFit),
        ("inscribed", Inscribed),
        ("cover", Cover),
        ("packed", Packed),
        ("euclidean", Euclidean),
        ("ferellec_mcdowell", FerellecMcDowell),
        ("favier", Favier),
        ("uniform_grid", UniformGrid),
    ] {
        let mesh = if method == Favier { ellipsoid } else { stone };
        let ask = Ask { cells: 24, ..Ask::new(method, 12) };
        let scale = 2f64.powi(-40);
        m.case(format!("{name} times 2^-40"), &BITS, || exactly(mesh, &ask, scale, [0.0; 3]));
        let shift = [scale * 1e8, -scale * 3e7, scale * 17.0];
        let far = format!("{name} times 2^-40 and 1e8 sizes away");
        let rounding = 1e8 * 0.5 * f64::EPSILON;
        if method == Packed {
            m.case(far, &SET, || {
                let put = moved(mesh, |p| [0, 1, 2].map(|i| p[i] * scale + shift[i]));
                let all: Vec<Sphere> = made(&put, &ask)?.1;
                let back = |s: &Sphere| {
                    Sphere::new((s.center - Vec3::from(shift)) / scale, s.radius / scale)
                };
                let all: Vec<Sphere> = all.iter().map(back).collect();
                Ok(unlike(&all, &made(mesh, &ask)?.1) / rounding)
            });
        } else {
            m.case(far, &PLACES, || Ok(exactly(mesh, &ask, scale, shift)? / rounding));
        }
        m.case(format!("{name} on 3 threads"), &BITS, || {
            let many = made(mesh, &Ask { threads: 3, ..ask })?.1;
            apart(&many, &made(mesh, &ask)?.1, 1.0, [0.0; 3])
        });
        for scale in [1e-12, 7.7] {
            m.case(format!("{name} times {scale:e}"), &PERCENT, || {
                change(mesh, &moved(mesh, |p| p.map(|x| scale * x)), &ask)
            });
        }
        if method == Favier {
            m.case(format!("{name}, axes exchanged"), &PERCENT, || {
                change(mesh, &moved(mesh, |p| [p[2], p[0], p[1]]), &ask)
            });
        } else {
            images(m, name, mesh, &ask);
        }
        m.case(format!("{name}, triangles in another order"), &PERCENT, || {
            let faces = shuffled(mesh.1.len(), 5).into_iter().map(|i| mesh.1[i as usize]);
            change(mesh, &(mesh.0.clone(), faces.collect()), &ask)
        });
    }
}

/// How far spheres are from the nearest of others.
fn unlike(spheres: &[Sphere], others: &[Sphere]) -> f64 {
    let nearest = |s: &Sphere| {
        let off = |t: &Sphere| (t.center - s.center).amax().max((t.radius - s.radius).abs());
        others.iter().map(off).fold(f64::MAX, f64::min)
    };
    spheres.iter().map(nearest).fold(0.0, f64::max)
}
