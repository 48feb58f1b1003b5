//! Held against what others measured and against formulas and brute force.

use super::bodies::Random;
use super::bodies::{Ask, mismatch, solid_of, spheres};
use super::{About, Bound, Found, Matrix, Miss};
use morula::generate::Method;
use morula::mass::union_moments;
use morula::math::{PrincipalFrame, Sphere, Vec3};
use morula::run::{Pool, Run};
use morula::shape::read::FileOptions;
use morula::shape::{Body, Shape};
use morula::solid::edt::squared_distance;
use morula::solid::moments::moments;
use std::f64::consts::PI;
use std::path::Path;

const VOLUME: About = About {
    measure: "|volume / NIST's - 1|",
    bound: Bound::AtMost(0.015),
    why: "the meshes are inscribed in the surface that NIST integrates: up to 0.7 % low",
};

const AREA: About = About { measure: "|area / NIST's - 1|", ..VOLUME };

const LENGTH: About = About {
    measure: "|longest chord / NIST's length - 1|",
    bound: Bound::AtMost(0.02),
    why: "NIST looks along a grid of directions, the mesh has the vertices of an icosphere",
};

const WIDTH: About = About {
    measure: "width / NIST's width",
    bound: Bound::Told,
    why: "greatest extent across the longest chord; NIST's is a chord of the body across it",
};

const THICKNESS: About = About {
    measure: "thickness / NIST's thickness",
    bound: Bound::Told,
    why: "extent across both; NIST's is a chord of the body across both",
};

const TWIN: About = About {
    measure: "|volume of voxels / of mesh - 1|",
    bound: Bound::AtMost(0.015),
    why: "cells whose centres are inside, a twentieth of the body's width or smaller",
};

const TWIN_MOMENTS: About = About {
    measure: "greatest |principal moment of voxels / of mesh - 1|",
    bound: Bound::AtMost(0.03),
    why: "as the volume, by the fifth power of lengths where that goes by the third",
};

const TWIN_CLUMP: About = About {
    measure: "|D against voxels - D against mesh|",
    bound: Bound::AtMost(0.03),
    why: "the staircase of cells is what one image has more than the other",
};

const UNION: About = About {
    measure: "greatest |union volume / formula - 1|",
    bound: Bound::AtMost(1e-10),
    why: "integrals along arcs, to a stated 1e-10",
};

const EDT: About = About {
    measure: "greatest |distance / brute force - 1|",
    bound: Bound::AtMost(1.2e-7),
    why: "exact, then rounded once to single precision",
};

pub fn run(m: &mut Matrix) {
    grains(m);
    twins(m);
    m.case("500 pairs of spheres", &UNION, pairs);
    m.case("400 triples of spheres", &UNION, triples);
    m.case("20 random grids, cubic cells", &EDT, || edt([1.0; 3]));
    m.case("20 random grids, oblong cells", &EDT, || edt([1.0, 0.37, 2.9]));
}

/// A column of a CSV file without quotes, and the first.
fn table(text: &str, names: &[&str]) -> Result<Vec<Vec<String>>, Miss> {
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().unwrap_or("").split(',').collect();
    let at: Option<Vec<usize>> = names.iter().map(|n| head.iter().position(|h| h == n)).collect();
    let at = at.ok_or(Miss(format!("{names:?} are not in the head of the table")))?;
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        at.iter().map(|i| cells.get(*i).copied().unwrap_or("").to_owned()).collect()
    };
    Ok(lines.map(row).collect())
}

fn read(path: &Path, origin: [f64; 3]) -> Result<Shape, Miss> {
    Ok(Shape::from_file(path, &FileOptions { origin, ..FileOptions::default() }, &Run::serial())?)
}

fn grains(m: &mut Matrix) {
    let all = [&VOLUME, &AREA, &LENGTH, &WIDTH, &THICKNESS];
    let Some(data) = m.data.clone() else {
        return all.iter().for_each(|about| m.skip("cement grains", about, "no data"));
    };
    let columns = ["path", "volume_um3", "area_um2", "length_um", "width_um", "thickness_um"];
    let rows = std::fs::read_to_string(data.join("nist_reference.csv"))
        .map_err(|e| Miss(e.to_string()))
        .and_then(|text| table(&text, &columns));
    let rows = match rows {
        Ok(rows) => rows,
        Err(miss) => return m.case("cement grains", &VOLUME, || Err(miss)),
    };
    for row in rows {
        let [path, theirs @ ..] = &row[..] else { continue };
        let theirs: Vec<f64> = theirs.iter().map(|v| v.parse().unwrap_or(f64::NAN)).collect();
        let name = Path::new(path).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let ours = read(&data.join(path), [0.0; 3]).and_then(|shape| figures(&shape));
        let ours = match ours {
            Ok(ours) => ours,
            Err(miss) => {
                m.case(name, &VOLUME, || Err(miss));
                continue;
            }
        };
        for (k, about) in all.iter().enumerate() {
            let ratio = ours[k] / theirs[k];
            let told = about.bound == Bound::Told;
            m.case(name.clone(), about, || Ok(if told { ratio } else { (ratio - 1.0).abs() }));
        }
    }
}

/// Volume, area, longest chord, extent across it, and across both.
fn figures(shape: &Shape) -> Result<[f64; 5], Miss> {
    let Body::Mesh(mesh) = &*shape.body else { return Err(Miss("no mesh".into())) };
    let unit = moments(&shape.body, &Run::serial())?;
    let volume = shape.frame.moments_to_input(&unit).volume;
    let points = &mesh.vertices;
    let [a, b] = longest(points, &unit.centroid);
    let along = (b - a).normalize();
    let extent = |u: &Vec3| {
        let (lo, hi) = points
            .iter()
            .map(|p| p.dot(u))
            .fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        hi - lo
    };
    let helper = if along.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() };
    let e = along.cross(&helper).normalize();
    let f = along.cross(&e);
    let turned = |k: u32| {
        let t = PI * f64::from(k) / 360.0;
        e * t.cos() + f * t.sin()
    };
    let widest = (0..360).map(turned).map(|u| (extent(&u), u));
    let (width, across) =
        widest.fold((0.0, e), |best, next| if next.0 > best.0 { next } else { best });
    let scale = shape.frame.scale;
    let thickness = extent(&along.cross(&across));
    Ok([volume, shape.report.area, (b - a).norm() * scale, width * scale, thickness * scale])
}

/// The two points that are farthest from each other.
fn longest(points: &[Vec3], middle: &Vec3) -> [Vec3; 2] {
    let mut far: Vec<(f64, Vec3)> = points.iter().map(|p| ((p - middle).norm(), *p)).collect();
    far.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (mut most, mut best) = (0.0, [Vec3::zeros(); 2]);
    for (i, (r, p)) in far.iter().enumerate() {
        for (s, q) in &far[i + 1..] {
            // Those that follow are nearer to the middle still.
            if r + s <= most {
                break;
            }
            let d = (p - q).norm();
            if d > most {
                (most, best) = (d, [*p, *q]);
            }
        }
    }
    best
}

fn twins(m: &mut Matrix) {
    let all = [&TWIN, &TWIN_MOMENTS, &TWIN_CLUMP];
    let Some(data) = m.data.clone() else {
        return all.iter().for_each(|about| m.skip("voxel twins", about, "no data"));
    };
    for (name, origin) in [
        ("cement133_00137_flat", [-20.0, -18.0, -9.0]),
        ("cement140_02475_rough", [-23.0, -41.0, -18.0]),
        ("ma160_01731_equant", [-18.0, -18.0, -17.0]),
    ] {
        let both = || -> Result<[Shape; 2], Miss> {
            let mesh = data.join(format!("particles/cement/{name}.stl"));
            let cells = data.join(format!("voxels/{name}_1um.npy"));
            Ok([read(&mesh, [0.0; 3])?, read(&cells, origin)?])
        };
        let own = |shape: &Shape| -> Result<_, Miss> {
            Ok(shape.frame.moments_to_input(&moments(&shape.body, &Run::serial())?))
        };
        m.case(name, &TWIN, || {
            let [mesh, cells] = both()?;
            Ok((own(&cells)?.volume / own(&mesh)?.volume - 1.0).abs())
        });
        m.case(name, &TWIN_MOMENTS, || {
            let [mesh, cells] = both()?;
            let of = |shape: &Shape| -> Result<_, Miss> {
                Ok(PrincipalFrame::of(&own(shape)?.inertia).moments)
            };
            let (a, b) = (of(&cells)?, of(&mesh)?);
            Ok((0..3).map(|k| (a[k] / b[k] - 1.0).abs()).fold(0.0, f64::max))
        });
        m.case(name, &TWIN_CLUMP, || {
            let [mesh, cells] = both()?;
            let (mesh, cells) = (solid_of(&mesh, 48)?, solid_of(&cells, 48)?);
            let found = spheres(&mesh, &Ask::new(Method::Best, 30))?;
            Ok((mismatch(&cells, &found)? - mismatch(&mesh, &found)?).abs())
        });
    }
}

fn ball(r: f64) -> f64 {
    4.0 / 3.0 * PI * r * r * r
}

/// The volume of the lens of two balls.
fn lens(r: f64, s: f64, d: f64) -> f64 {
    let both = r + s - d;
    PI * both * both * (d * d + 2.0 * d * (r + s) - 3.0 * (r - s) * (r - s)) / (12.0 * d)
}

fn against(spheres: &[Sphere], volume: f64) -> Found {
    Ok((union_moments(spheres, &Run::serial())?.volume / volume - 1.0).abs())
}

fn pairs() -> Found {
    let mut random = Random::new(11);
    let mut worst = 0.0f64;
    for _ in 0..500 {
        let (r, s) = (random.between(0.05, 1.0), random.between(0.05, 1.0));
        let d = random.between((r - s).abs(), r + s);
        let at = Vec3::new(random.between(-2.0, 2.0), random.between(-2.0, 2.0), 0.3);
        let two = [Sphere::new(at, r), Sphere::new(at + random.direction() * d, s)];
        let d = (two[1].center - two[0].center).norm();
        worst = worst.max(against(&two, ball(r) + ball(s) - lens(r, s, d))?);
    }
    Ok(worst)
}

/// The part of all directions that the corner at `o` of a tetrahedron takes.
fn corner(o: &Vec3, others: [&Vec3; 3]) -> f64 {
    let [a, b, c] = others.map(|p| p - o);
    let [x, y, z] = [a.norm(), b.norm(), c.norm()];
    let above = x * y * z + a.dot(&b) * z + b.dot(&c) * x + c.dot(&a) * y;
    2.0 * a.dot(&b.cross(&c)).abs().atan2(above) / (4.0 * PI)
}

/// The part of a full turn between the faces of a tetrahedron that meet in the edge `p`, `q`.
fn edge(p: &Vec3, q: &Vec3, others: [&Vec3; 2]) -> f64 {
    let along = (q - p).normalize();
    let [u, v] = others.map(|o| (o - p) - along * along.dot(&(o - p)));
    u.cross(&v).norm().atan2(u.dot(&v)) / (2.0 * PI)
}

/// The centres and a point where all three surfaces meet span a tetrahedron that the balls cover:
/// by inclusion and exclusion within it (Edelsbrunner 1995), half of what is common to all three.
fn triples() -> Found {
    let mut random = Random::new(12);
    let (mut worst, mut seen) = (0.0f64, 0);
    for _ in 0..4000 {
        let r = [0; 3].map(|_| random.between(0.7, 1.2));
        let (x1, x2, y2) = (random.between(0.2, 1.2), random.unit(), random.between(0.2, 1.2));
        let p = [Vec3::zeros(), Vec3::new(x1, 0.0, 0.0), Vec3::new(x2, y2, 0.0)];
        let d = |i: usize, j: usize| (p[i] - p[j]).norm();
        let pairs = [(0, 1, 2), (0, 2, 1), (1, 2, 0)];
        let x = (r[0] * r[0] - r[1] * r[1] + x1 * x1) / (2.0 * x1);
        let y = (r[0] * r[0] - r[2] * r[2] + x2 * x2 + y2 * y2 - 2.0 * x2 * x) / (2.0 * y2);
        let z2 = r[0] * r[0] - x * x - y * y;
        let within = |&(i, j, _): &(usize, usize, usize)| (r[i] - r[j]).abs() >= d(i, j);
        if z2 <= 0.0 || pairs.iter().any(within) {
            continue;
        }
        let top = Vec3::new(x, y, z2.sqrt());
        let mut half = x1 * y2 * top.z / 6.0;
        let mut union: f64 = r.map(ball).iter().sum();
        for (i, j, k) in pairs {
            half -= corner(&p[k], [&p[i], &p[j], &top]) * ball(r[k]);
            half += edge(&p[i], &p[j], [&p[k], &top]) * lens(r[i], r[j], d(i, j));
            union -= lens(r[i], r[j], d(i, j));
        }
        union += 2.0 * half;
        worst = worst.max(against(&[0, 1, 2].map(|i| Sphere::new(p[i], r[i])), union)?);
        seen += 1;
        if seen == 400 {
            return Ok(worst);
        }
    }
    Err(Miss(format!("only {seen} triples meet in points")))
}

/// Random grids of up to 40³ cells, some nearly empty, some nearly full.
fn edt(spacing: [f64; 3]) -> Found {
    let mut random = Random::new(13);
    let mut worst = 0.0f64;
    for _ in 0..20 {
        let dims = [0; 3].map(|_| 1 + random.below(40));
        let share = 10f64.powf(random.between(-3.0, -0.5));
        let mask: Vec<u8> =
            (0..dims.iter().product()).map(|_| u8::from(random.unit() > share)).collect();
        let found = squared_distance(&mask, dims, spacing, &Pool::serial())?;
        let at = |c: usize| [c % dims[0], c / dims[0] % dims[1], c / dims[0] / dims[1]];
        let background: Vec<[usize; 3]> =
            (0..mask.len()).filter(|c| mask[*c] == 0).map(at).collect();
        // Brute force at one cell of seven.
        for c in (0..mask.len()).step_by(7).filter(|_| !background.is_empty()) {
            let here = at(c);
            let apart = |b: &[usize; 3]| -> f64 {
                (0..3).map(|a| (here[a].abs_diff(b[a]) as f64 * spacing[a]).powi(2)).sum()
            };
            let nearest = background.iter().map(apart).fold(f64::MAX, f64::min);
            let nearest = if mask[c] == 0 { 0.0 } else { nearest };
            let off = (f64::from(found[c]) - nearest).abs() / nearest.max(1e-3);
            worst = worst.max(off);
        }
    }
    Ok(worst)
}
