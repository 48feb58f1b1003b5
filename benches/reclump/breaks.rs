//! Random breaks of particles.

use morula::fragment::{Cut, CutOptions, Parent, Region, cut};
use morula::generate::{Effort, GenerateOptions, HalfSpace, generate};
use morula::math::Vec3;
use morula::shape::read::FileOptions;
use morula::shape::{Bodies, ImportOptions, Primitive};
use morula::solid::SolidOptions;
use morula::{Run, Shape, Solid};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Random numbers (Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let d = Vec3::from([0, 1, 2].map(|_| 2.0 * self.unit() - 1.0));
            if d.norm() < 1.0 && d.norm() > 0.1 {
                return d.normalize();
            }
        }
    }

    /// A place about the body's middle.
    fn place(&mut self, solid: &Solid, reach: f64) -> Vec3 {
        let m = solid.moments();
        m.centroid + self.direction() * (reach * self.unit() * m.volume.cbrt())
    }

    pub fn plane(&mut self, solid: &Solid) -> HalfSpace {
        let normal = self.direction();
        HalfSpace { normal, offset: normal.dot(&self.place(solid, 0.4)) }
    }

    /// A way to break.
    pub fn cut(&mut self, solid: &Solid) -> Cut {
        match self.below(4) {
            0 => Cut::Planes((0..=self.below(3)).map(|_| self.plane(solid)).collect()),
            1 | 2 => {
                let count = 2 + self.below(7);
                let points = (0..count).map(|_| self.place(solid, 0.8)).collect();
                Cut::Points { points, weights: Vec::new() }
            }
            _ => {
                let direction = self.direction();
                let point = solid.moments().centroid - direction * solid.moments().volume.cbrt();
                Cut::Impact { point, direction, count: 3 + self.below(6) }
            }
        }
    }
}

fn files(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, out);
        } else if path.extension().is_some_and(|e| e == "obj" || e == "stl") {
            out.push(path);
        }
    }
}

/// Closed particles.
pub fn particles() -> Vec<(String, Arc<Solid>)> {
    let run = Run::serial();
    let mut shapes = Vec::new();
    if let Some(data) = std::env::var_os("MORULA_DATA") {
        let mut paths = Vec::new();
        files(&Path::new(&data).join("particles"), &mut paths);
        paths.sort();
        let import = ImportOptions { bodies: Bodies::Largest, ..ImportOptions::default() };
        let options = FileOptions { import, ..FileOptions::default() };
        for path in paths {
            if let Ok(shape) = Shape::from_file(&path, &options, &run) {
                shapes.push((path.file_stem().unwrap().to_string_lossy().into_owned(), shape));
            }
        }
    }
    if shapes.is_empty() {
        for segments in [20, 40, 80] {
            let stone = Primitive::from_name("stone").unwrap();
            let options = ImportOptions::default();
            let shape = Shape::from_primitive(&stone, segments, &options, &run).unwrap();
            shapes.push((format!("stone {segments}"), shape));
        }
    }
    let solid = |shape: &Shape| Solid::new(shape, &SolidOptions::default(), &run).unwrap();
    let all = shapes.iter().map(|(name, shape)| (name.clone(), Arc::new(solid(shape))));
    all.filter(|(_, s)| s.moments().relative_error == 0.0).collect()
}

pub fn parent(solid: &Arc<Solid>) -> Parent {
    let run = Run::serial();
    let options =
        GenerateOptions { spheres: 50, effort: Effort::Draft, ..GenerateOptions::default() };
    let spheres = generate(solid, &options, &run).unwrap().spheres;
    Parent::new(Arc::clone(solid), &spheres, &run).unwrap()
}

pub fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(0.0)
}

pub fn mean(all: &[f64]) -> f64 {
    all.iter().sum::<f64>() / all.len().max(1) as f64
}

/// Pieces of at least a fiftieth of the volume, one of each cut.
pub fn pieces(cuts: usize, mut f: impl FnMut(&Arc<Solid>, &Parent, &Region)) {
    let particles = particles();
    let mut random = Random(1);
    for (k, (_, solid)) in particles.iter().enumerate() {
        let parent = parent(solid);
        let least = CutOptions { least_volume: 0.02 * solid.moments().volume };
        for _ in (k..cuts).step_by(particles.len()) {
            let by = random.cut(solid);
            let made = cut(solid, &by, &least, &Run::serial()).unwrap();
            let Some(last) = made.regions.len().checked_sub(1) else { continue };
            f(solid, &parent, &made.regions[random.below(last + 1).min(last)]);
        }
    }
}
