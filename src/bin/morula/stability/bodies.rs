//! Bodies and clumps that the cases start from.

use super::Miss;
use morula::error::Result;
use morula::generate::{Effort, GenerateOptions, Method, generate};
use morula::math::{Sphere, Vec3};
use morula::measure::{QualityOptions, quality};
use morula::run::Run;
use morula::shape::{Bodies, ImportOptions, Primitive, Shape};
use morula::solid::{Resolution, Solid, SolidOptions};

/// Vertices and triangles.
pub type Arrays = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Multiples of 2⁻²⁰: shifts by whole numbers up to 2³² are exact.
pub fn on_lattice(mesh: Arrays) -> Arrays {
    let unit = 1048576.0;
    (mesh.0.into_iter().map(|p| p.map(|x| (x * unit).round() / unit)).collect(), mesh.1)
}

/// A mesh whose vertices are moved.
pub fn moved(mesh: &Arrays, map: impl Fn([f64; 3]) -> [f64; 3]) -> Arrays {
    (mesh.0.iter().map(|p| map(*p)).collect(), mesh.1.clone())
}

/// Inside out.
pub fn inverted(mesh: &Arrays) -> Arrays {
    (mesh.0.clone(), mesh.1.iter().map(|f| [f[0], f[2], f[1]]).collect())
}

/// Each triangle cut at the middles of its edges, which every triangle has of its own.
pub fn subdivided(mesh: &Arrays) -> Arrays {
    let mut out: Arrays = (mesh.0.clone(), Vec::new());
    for f in &mesh.1 {
        let base = out.0.len() as u32;
        for k in 0..3 {
            let (a, b) = (mesh.0[f[k] as usize], mesh.0[f[(k + 1) % 3] as usize]);
            out.0.push([0, 1, 2].map(|i| 0.5 * (a[i] + b[i])));
        }
        let [x, y, z] = [base, base + 1, base + 2];
        out.1.extend([[f[0], x, z], [x, f[1], y], [z, y, f[2]], [x, y, z]]);
    }
    out
}

/// The second mesh added to the first.
pub fn joined(mut a: Arrays, b: &Arrays) -> Arrays {
    let base = a.0.len() as u32;
    a.0.extend(&b.0);
    a.1.extend(b.1.iter().map(|f| f.map(|v| v + base)));
    a
}

/// A stone, an ellipsoid and a box of unlike edges, all near 1.
pub fn three() -> Result<Vec<(&'static str, Arrays)>> {
    Ok(three_as_made()?.into_iter().map(|(name, mesh)| (name, on_lattice(mesh))).collect())
}

/// The same with coordinates of all bits, which single precision and places far away round.
pub fn three_as_made() -> Result<Vec<(&'static str, Arrays)>> {
    let stone = Primitive::Stone { seed: 3, diameter: 1.0, roughness: 0.4 };
    let ellipsoid = Primitive::Ellipsoid { axes: [0.5, 0.35, 0.2] };
    let cuboid = Primitive::Box { edges: [1.0, 0.7, 0.45] };
    [("stone", stone), ("ellipsoid", ellipsoid), ("box", cuboid)]
        .into_iter()
        .map(|(name, p)| Ok((name, p.mesh(20)?)))
        .collect()
}

/// Every method.
pub const METHODS: [Method; 10] = [
    Method::Mss,
    Method::Best,
    Method::SurfaceFit,
    Method::Inscribed,
    Method::Cover,
    Method::Packed,
    Method::Euclidean,
    Method::FerellecMcDowell,
    Method::Favier,
    Method::UniformGrid,
];

/// How a clump is made.
#[derive(Debug, Clone, Copy)]
pub struct Ask {
    pub method: Method,
    pub spheres: usize,
    pub cells: u32,
    pub threads: usize,
    pub effort: Effort,
    pub seed: u64,
}

impl Ask {
    pub fn new(method: Method, spheres: usize) -> Ask {
        Ask { method, spheres, cells: 32, threads: 1, effort: Effort::Draft, seed: 0 }
    }

    pub fn options(&self) -> GenerateOptions {
        // Others refuse an effort.
        let reads = matches!(self.method, Method::Best | Method::Inscribed);
        GenerateOptions {
            method: self.method,
            spheres: self.spheres,
            effort: if reads { self.effort } else { Effort::Normal },
            ..GenerateOptions::default()
        }
    }
}

/// The solid of a mesh.
pub fn solid(mesh: &Arrays, cells: u32) -> Result<Solid> {
    let run = Run::serial();
    let options = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    solid_of(&Shape::from_mesh(&mesh.0, &mesh.1, &options, &run)?, cells)
}

/// The solid of a shape.
pub fn solid_of(shape: &Shape, cells: u32) -> Result<Solid> {
    let resolution = Resolution::CellsLongest(cells);
    Solid::new(shape, &SolidOptions { resolution, ..SolidOptions::default() }, &Run::serial())
}

/// Spheres of a solid.
pub fn spheres(solid: &Solid, ask: &Ask) -> Result<Vec<Sphere>> {
    let run = Run::new(ask.threads)?.with_seed(ask.seed);
    Ok(generate(solid, &ask.options(), &run)?.spheres)
}

/// A solid and spheres of a mesh.
pub fn made(mesh: &Arrays, ask: &Ask) -> Result<(Solid, Vec<Sphere>)> {
    let solid = solid(mesh, ask.cells)?;
    let spheres = spheres(&solid, ask)?;
    Ok((solid, spheres))
}

/// D of spheres against a solid.
pub fn mismatch(solid: &Solid, spheres: &[Sphere]) -> Result<f64> {
    let options = QualityOptions { columns: 128, surface: false, ..QualityOptions::default() };
    Ok(quality(solid, spheres, &options, &Run::serial())?.mismatch)
}

/// Greatest difference of centres and radii; the second's are scaled, then shifted.
pub fn apart(
    a: &[Sphere],
    b: &[Sphere],
    scale: f64,
    shift: [f64; 3],
) -> std::result::Result<f64, Miss> {
    same_number(a, b)?;
    let pairs = a.iter().zip(b);
    Ok(pairs.fold(0.0, |most: f64, (a, b)| {
        let off = |i: usize| ((a.center[i] - shift[i]) / scale - b.center[i]).abs();
        let radius = (a.radius / scale - b.radius).abs();
        (0..3).map(off).fold(most, f64::max).max(radius)
    }))
}

/// The greatest distance of spheres, and difference of radii, from the images of others, in this order.
pub fn images_apart(
    a: &[Sphere],
    of: &[Sphere],
    image: impl Fn([f64; 3]) -> [f64; 3],
) -> std::result::Result<f64, Miss> {
    let images: Vec<Sphere> =
        of.iter().map(|s| Sphere::new(image(s.center.into()).into(), s.radius)).collect();
    apart(a, &images, 1.0, [0.0; 3])
}

/// Whether two clumps have as many spheres.
pub fn same_number(a: &[Sphere], b: &[Sphere]) -> std::result::Result<(), Miss> {
    if a.len() != b.len() {
        return Err(Miss(format!("{} spheres for {}", a.len(), b.len())));
    }
    Ok(())
}

/// Random numbers, the same on every machine (Steele, Lea and Flood 2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0xd134_2543_de82_ef95))
    }

    /// From 0 to 1, without 1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ x >> 31) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    pub fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n.saturating_sub(1))
    }

    /// A direction, uniform over the sphere.
    pub fn direction(&mut self) -> Vec3 {
        let (z, t) = (self.between(-1.0, 1.0), self.between(0.0, std::f64::consts::TAU));
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * t.cos(), r * t.sin(), z)
    }
}

/// The rows of rotation number `k` of a fixed lot.
pub fn rotation(k: u64) -> [Vec3; 3] {
    let mut random = Random::new(k + 1);
    let x = random.direction();
    let y = x.cross(&random.direction()).normalize();
    [x, y, x.cross(&y)]
}

/// 0 to n − 1 in a fixed order that is none.
pub fn shuffled(n: usize, seed: u64) -> Vec<u32> {
    let mut random = Random::new(seed);
    let mut order: Vec<u32> = (0..n as u32).collect();
    for i in (1..n).rev() {
        order.swap(i, random.below(i + 1));
    }
    order
}
