//! Solids of cells given by a formula, for the tests of MSS.

#![allow(missing_docs, dead_code, clippy::unwrap_used)]

use morula::generate::{GenerateOptions, Method, generate};
use morula::shape::{Bodies, ImportOptions, Layout};
use morula::solid::SolidOptions;
use morula::{Clump, Run, Shape, Solid, Sphere};

pub type Cell<'a> = &'a dyn Fn([f64; 3]) -> bool;

/// A solid of the cells whose centres satisfy `inside`; cell (i, j, k) has its centre at
/// `(i, j, k) * spacing`.
pub fn cells(dims: [usize; 3], spacing: [f64; 3], inside: Cell) -> (Solid, Vec<u8>) {
    let mut mask = Vec::new();
    for k in 0..dims[2] {
        for j in 0..dims[1] {
            for i in 0..dims[0] {
                let p = [i as f64 * spacing[0], j as f64 * spacing[1], k as f64 * spacing[2]];
                mask.push(u8::from(inside(p)));
            }
        }
    }
    let layout = Layout { dims, spacing, origin: spacing.map(|s| -0.5 * s) };
    let options = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    let run = Run::serial();
    let shape = Shape::from_mask(&mask, &layout, &options, &run).unwrap();
    (Solid::new(&shape, &SolidOptions::default(), &run).unwrap(), mask)
}

pub fn ask(n: usize) -> GenerateOptions {
    GenerateOptions { method: Method::Mss, spheres: n, ..GenerateOptions::default() }
}

pub fn make(solid: &Solid, options: &GenerateOptions) -> Clump {
    generate(solid, options, &Run::serial()).unwrap()
}

pub fn square(p: [f64; 3], c: [f64; 3]) -> f64 {
    (0..3).map(|a| (p[a] - c[a]).powi(2)).sum()
}

/// D on the cells of the array.
pub fn mismatch(mask: &[u8], dims: [usize; 3], spacing: [f64; 3], spheres: &[Sphere]) -> f64 {
    let (mut both, mut clump, mut target) = (0.0, 0.0, 0.0);
    for (n, m) in mask.iter().enumerate() {
        let p = [
            (n % dims[0]) as f64 * spacing[0],
            (n / dims[0] % dims[1]) as f64 * spacing[1],
            (n / dims[0] / dims[1]) as f64 * spacing[2],
        ];
        let c = spheres.iter().any(|s| s.contains(&p.into()));
        clump += f64::from(u8::from(c));
        target += f64::from(*m);
        both += f64::from(u8::from(c && *m != 0));
    }
    1.0 - 2.0 * both / (clump + target)
}

pub fn balls(list: &[([f64; 3], f64)]) -> impl Fn([f64; 3]) -> bool {
    move |p| list.iter().any(|(c, r)| square(p, *c) <= r * r)
}
