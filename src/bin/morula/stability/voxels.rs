//! Invariance of voxel bodies, with cells of unlike edges.

use super::bodies::{Ask, apart, images_apart, mismatch, solid_of, spheres};
use super::invariance::{BITS, IMAGED, PERCENT};
use super::{Matrix, Miss};
use morula::generate::Method;
use morula::math::Sphere;
use morula::run::Run;
use morula::shape::voxels::Layout;
use morula::shape::{ImportOptions, Shape};
use morula::solid::Solid;

/// Cells, x fastest, and where they stand.
struct Volume {
    cells: Vec<u8>,
    layout: Layout,
}

impl Volume {
    /// A bean: a ball and a smaller one askew to it.
    fn bean() -> Volume {
        let dims = [30, 22, 26];
        let spacing = [0.03125, 0.046875, 0.0390625];
        let at = |i: usize, a: usize| (i as f64 + 0.5) * spacing[a];
        let within = |p: [f64; 3], c: [f64; 3], r: f64| {
            (0..3).map(|a| (p[a] - c[a]).powi(2)).sum::<f64>() < r * r
        };
        let mut cells = Vec::new();
        for k in 0..dims[2] {
            for j in 0..dims[1] {
                for i in 0..dims[0] {
                    let p = [at(i, 0), at(j, 1), at(k, 2)];
                    let solid = within(p, [0.375, 0.4375, 0.4375], 0.34375)
                        || within(p, [0.65625, 0.6875, 0.625], 0.21875);
                    cells.push(u8::from(solid));
                }
            }
        }
        Volume { cells, layout: Layout { dims, spacing, origin: [0.0; 3] } }
    }

    fn scaled(&self, by: f64) -> Volume {
        let spacing = self.layout.spacing.map(|h| h * by);
        Volume { cells: self.cells.clone(), layout: Layout { spacing, ..self.layout } }
    }

    /// With its axes exchanged, x in the place of y and so on, and then mirrored along x.
    fn image(&self, mirrored: bool) -> Volume {
        let Layout { dims: [nx, ny, nz], spacing: [hx, hy, hz], .. } = self.layout;
        let dims = [nz, nx, ny];
        let mut cells = vec![0; self.cells.len()];
        for (n, cell) in self.cells.iter().enumerate() {
            let [i, j, k] = [n % nx, n / nx % ny, n / nx / ny];
            let first = if mirrored { nz - 1 - k } else { k };
            cells[first + nz * (i + nx * j)] = *cell;
        }
        let origin = [if mirrored { -(nz as f64) * hz } else { 0.0 }, 0.0, 0.0];
        Volume { cells, layout: Layout { dims, spacing: [hz, hx, hy], origin } }
    }

    fn made(&self, ask: &Ask) -> Result<(Solid, Vec<Sphere>), Miss> {
        let options = ImportOptions::default();
        let shape = Shape::from_mask(&self.cells, &self.layout, &options, &Run::serial())?;
        let solid = solid_of(&shape, ask.cells)?;
        let spheres = spheres(&solid, ask)?;
        Ok((solid, spheres))
    }
}

pub fn run(m: &mut Matrix) {
    use Method::*;
    let bean = Volume::bean();
    for (name, method) in [
        ("best", Best),
        ("mss", Mss),
        ("inscribed", Inscribed),
        ("cover", Cover),
        ("packed", Packed),
        ("euclidean", Euclidean),
        ("uniform_grid", UniformGrid),
    ] {
        let ask = Ask::new(method, 12);
        m.case(format!("voxels, {name} times 2^-40"), &BITS, || {
            let small = 2f64.powi(-40);
            let put = bean.scaled(small).made(&ask)?.1;
            apart(&put, &bean.made(&ask)?.1, small, [0.0; 3])
        });
        m.case(format!("voxels, {name} times 7.7e5"), &PERCENT, || {
            let [a, b] = [bean.made(&ask)?, bean.scaled(7.7e5).made(&ask)?];
            let [a, b] = [mismatch(&a.0, &a.1)?, mismatch(&b.0, &b.1)?];
            Ok((b / a - 1.0).abs())
        });
        m.case(format!("voxels, {name} on 3 threads"), &BITS, || {
            let many = bean.made(&Ask { threads: 3, ..ask })?.1;
            apart(&many, &bean.made(&ask)?.1, 1.0, [0.0; 3])
        });
        for (what, mirrored) in [("axes exchanged", false), ("exchanged and mirrored", true)] {
            m.case(format!("voxels, {name}, {what}"), &IMAGED, || {
                let sign = if mirrored { -1.0 } else { 1.0 };
                images_apart(&bean.image(mirrored).made(&ask)?.1, &bean.made(&ask)?.1, |p| {
                    [sign * p[2], p[0], p[1]]
                })
            });
        }
    }
}
