//! Spheres of fragments: how long they take from a parent in memory, how much of the fragment they
//! cover beside the full generator `inscribed` on the clipped body, and how the times compare with
//! the peer `multisphere` on the same body where `MORULA_PEER_PYTHON` names a Python that has it;
//! and `check`, which counts what crosses over many breaks. The particles are those of
//! `MORULA_DATA`, or built-in stones.
//!
//!     MORULA_DATA=… cargo bench --bench reclump [-- latency [CUTS] | peer [CUTS] | check [BREAKS]]

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use morula::fragment::{
    Cut, CutOptions, Parent, Reclump, ReclumpOptions, Region, cut, reclump, shape,
};
use morula::generate::{Effort, GenerateOptions, HalfSpace, Method, generate};
use morula::mass::{single_precision, union_moments};
use morula::math::Vec3;
use morula::shape::read::FileOptions;
use morula::shape::{Bodies, Body, ImportOptions, Primitive};
use morula::solid::SolidOptions;
use morula::{Error, Run, Shape, Solid, Sphere};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;

/// Random numbers (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
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

    fn plane(&mut self, solid: &Solid) -> HalfSpace {
        let normal = self.direction();
        HalfSpace { normal, offset: normal.dot(&self.place(solid, 0.4)) }
    }

    /// A way to break.
    fn cut(&mut self, solid: &Solid) -> Cut {
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
fn particles() -> Vec<(String, Arc<Solid>)> {
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

fn parent(solid: &Arc<Solid>) -> Parent {
    let run = Run::serial();
    let options =
        GenerateOptions { spheres: 50, effort: Effort::Draft, ..GenerateOptions::default() };
    let spheres = generate(solid, &options, &run).unwrap().spheres;
    Parent::new(Arc::clone(solid), &spheres, &run).unwrap()
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(0.0)
}

fn mean(all: &[f64]) -> f64 {
    all.iter().sum::<f64>() / all.len().max(1) as f64
}

/// Pieces of at least a fiftieth of the volume, one of each cut.
fn pieces(cuts: usize, mut f: impl FnMut(&Arc<Solid>, &Parent, &Region)) {
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

/// The clump and the least of five times, in seconds: other work on the machine only adds.
fn timed(parent: &Parent, region: &Region, n: usize, union: bool) -> Option<(Reclump, f64)> {
    let options = ReclumpOptions { spheres: n, union, quality: false, ..ReclumpOptions::default() };
    let mut least = f64::MAX;
    let mut found = None;
    for _ in 0..5 {
        let run = Run::serial();
        let start = Instant::now();
        let made = reclump(parent, region, &options, &run);
        least = least.min(start.elapsed().as_secs_f64());
        found = made.ok();
    }
    found.map(|made| (made, least))
}

fn volume(spheres: &[Sphere]) -> f64 {
    union_moments(spheres, &Run::serial()).map_or(0.0, |m| m.volume)
}

fn latency(cuts: usize) {
    println!(
        "| n | within the union | median ms | 90 % ms | coverage | of `inscribed` | least difference | mean |"
    );
    println!("| ---: | --- |{}", " ---: |".repeat(6));
    // Of both numbers without and with the union: times, coverage, that of the full generator.
    let mut all: Vec<[Vec<f64>; 3]> = vec![Default::default(); 4];
    pieces(cuts, |solid, parent, region| {
        let whole = region.moments(solid.frame()).volume;
        let run = Run::serial();
        let clipped = shape(solid, region, &run)
            .and_then(|s| Solid::new(&s, &SolidOptions::default(), &run))
            .unwrap();
        for (i, n) in [10, 50].into_iter().enumerate() {
            let options = GenerateOptions {
                method: Method::Inscribed,
                spheres: n,
                ..GenerateOptions::default()
            };
            let full = generate(&clipped, &options, &run).unwrap();
            for union in [false, true] {
                let [times, coverage, theirs] = &mut all[2 * i + usize::from(union)];
                let Some((made, time)) = timed(parent, region, n, union) else { continue };
                times.push(time * 1e3);
                coverage.push(volume(&made.spheres) / whole);
                theirs.push(volume(&full.spheres) / whole);
            }
        }
    });
    for (i, [times, coverage, theirs]) in all.iter_mut().enumerate() {
        let less: Vec<f64> = coverage.iter().zip(theirs.iter()).map(|(a, b)| a - b).collect();
        let worst = less.iter().copied().fold(f64::MAX, f64::min);
        let middle = median(times);
        let late = times.get(times.len() * 9 / 10).copied().unwrap_or(0.0);
        let (n, union) = ([10, 50][i / 2], ["no", "yes"][i % 2]);
        println!(
            "| {n} | {union} | {middle:.3} | {late:.3} | {:.4} | {:.4} | {worst:.4} | {:.4} |",
            mean(coverage),
            mean(theirs),
            mean(&less)
        );
    }
}

const PEER: &str = "
import contextlib, io, sys, time, warnings
warnings.filterwarnings('ignore')
import multisphere as mss
with contextlib.redirect_stdout(io.StringIO()):
    start = time.perf_counter()
    made = mss.multisphere_from_mesh(mss.load_mesh(sys.argv[1]), div=50, min_center_distance_vox=4, max_spheres=int(sys.argv[2]), confine_mesh=True)
    seconds = time.perf_counter() - start
print(seconds, len(made.radii))
";

/// Seconds and spheres of the peer for the clipped body.
fn peer_of(solid: &Solid, region: &Region, n: usize) -> Option<(f64, usize)> {
    let python = std::env::var("MORULA_PEER_PYTHON").ok()?;
    let shape = shape(solid, region, &Run::serial()).ok()?;
    let Body::Mesh(mesh) = &*shape.body else { return None };
    let mut text = String::new();
    mesh.vertices.iter().for_each(|v| text += &format!("v {} {} {}\n", v.x, v.y, v.z));
    mesh.faces.iter().for_each(|f| text += &format!("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1));
    let path = std::env::temp_dir().join(format!("morula-fragment-{}.obj", std::process::id()));
    std::fs::write(&path, text).unwrap();
    let out = Command::new(python)
        .args(["-c", PEER, path.to_str()?, &n.to_string()])
        .env("OMP_NUM_THREADS", "1")
        .env("OPENBLAS_NUM_THREADS", "1")
        .output()
        .ok()?;
    std::fs::remove_file(&path).unwrap();
    let text = String::from_utf8(out.stdout).ok()?;
    let (seconds, count) = text.trim().split_once(' ')?;
    Some((seconds.parse().ok()?, count.parse().ok()?))
}

fn peer(cuts: usize) {
    println!("| n | ms | `multisphere` ms | its spheres | times as long, median |");
    println!("| ---: | ---: | ---: | ---: | ---: |");
    let mut all: Vec<[Vec<f64>; 4]> = vec![Default::default(); 2];
    pieces(cuts, |solid, parent, region| {
        for (i, n) in [10, 50].into_iter().enumerate() {
            let Some((_, ours)) = timed(parent, region, n, true) else { continue };
            let Some((theirs, count)) = peer_of(solid, region, n) else { continue };
            let row = [ours * 1e3, theirs * 1e3, count as f64, theirs / ours];
            all[i].iter_mut().zip(row).for_each(|(to, v)| to.push(v));
        }
    });
    for (n, [ours, theirs, count, ratio]) in [10, 50].into_iter().zip(&mut all) {
        println!(
            "| {n} | {:.3} | {:.0} | {:.0} | {:.0} |",
            median(ours),
            median(theirs),
            median(count),
            median(ratio)
        );
    }
}

/// What crosses: how often, and by how much at most, in parents' sizes; not above 0 is none.
#[derive(Default)]
struct Crossing {
    name: &'static str,
    count: usize,
    worst: Option<f64>,
}

impl Crossing {
    fn see(&mut self, by: f64, allowed: f64) {
        self.count += usize::from(by > allowed);
        self.worst = Some(self.worst.map_or(by, |w| w.max(by)));
    }
}

fn check(breaks: usize) {
    let particles = particles();
    let mut random = Random(2);
    let (mut pieces, mut spheres, mut dust, mut none) = (0usize, 0usize, 0usize, 0usize);
    let mut found = [
        "overlap of siblings",
        "protrusion",
        "beyond a cut",
        "overlap, as numbers of single precision",
        "overlap, rounded within",
    ]
    .map(|name| Crossing { name, ..Crossing::default() });
    for (k, (_, solid)) in particles.iter().enumerate() {
        let parent = parent(solid);
        let run = Run::serial();
        let frame = *solid.frame();
        let surface = solid.surface(&run).unwrap();
        for b in (k..breaks).step_by(particles.len()) {
            let made = cut(solid, &random.cut(solid), &CutOptions::default(), &run).unwrap();
            dust += made.dust.len();
            let (n, union) = ([5, 10, 25][b % 3], b % 2 == 0);
            for single in [false, true] {
                let options = ReclumpOptions {
                    spheres: n,
                    union,
                    single,
                    quality: false,
                    ..ReclumpOptions::default()
                };
                let mut clumps: Vec<Vec<Sphere>> = Vec::new();
                for region in &made.regions {
                    pieces += 1;
                    match reclump(&parent, region, &options, &run) {
                        Ok(made) => clumps.push(made.spheres),
                        Err(Error::NoSpheres(_)) => {
                            none += 1;
                            continue;
                        }
                        Err(e) => {
                            println!("{e}");
                            continue;
                        }
                    }
                    let planes = region.half_spaces(&frame);
                    let Some(last) = clumps.last() else { continue };
                    for s in last {
                        spheres += 1;
                        let unit = frame.sphere_to_unit(s);
                        let inside = surface.contains(&unit.center);
                        let depth = surface.nearest(&unit.center).distance;
                        let depth = if inside { depth } else { -depth };
                        found[1].see(unit.radius - depth, 0.0);
                        for p in &planes {
                            let out = p.normal.dot(&s.center) + s.radius - p.offset;
                            // The offset in the caller's frame is rounded too.
                            found[2].see(out / frame.scale, 1e-14 + 4.0 * frame.noise());
                        }
                    }
                }
                let mut overlaps = |clumps: &[Vec<Sphere>], which: usize| {
                    for (i, a) in clumps.iter().enumerate() {
                        for (s, t) in
                            a.iter().flat_map(|s| clumps[..i].iter().flatten().map(move |t| (s, t)))
                        {
                            let deep = s.radius + t.radius - (s.center - t.center).norm();
                            found[which].see(deep / frame.scale, 0.0);
                        }
                    }
                };
                if single {
                    let cast = |s: &Sphere| {
                        let c = s.center.map(|x| f64::from(x as f32));
                        Sphere::new(c, f64::from(s.radius as f32))
                    };
                    let cast: Vec<Vec<Sphere>> =
                        clumps.iter().map(|c| c.iter().map(cast).collect()).collect();
                    overlaps(&cast, 3);
                } else {
                    let within = |c: &Vec<Sphere>| -> Vec<Sphere> {
                        let of = |v: &[f32; 4]| {
                            let [x, y, z, r] = v.map(f64::from);
                            Sphere::new(Vec3::new(x, y, z), r)
                        };
                        single_precision(c).unwrap_or_default().iter().map(of).collect()
                    };
                    let within: Vec<Vec<Sphere>> = clumps.iter().map(within).collect();
                    overlaps(&clumps, 0);
                    overlaps(&within, 4);
                }
            }
        }
    }
    println!(
        "{breaks} breaks, each in double and single precision: {pieces} pieces, {spheres} spheres, \
         {none} pieces without room for one, {dust} crumbs"
    );
    println!("| what | how often | worst, of the parent's size |");
    println!("| --- | ---: | ---: |");
    for c in found {
        println!("| {} | {} | {:.2e} |", c.name, c.count, c.worst.unwrap_or(0.0));
    }
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let count = |none: usize| args.get(1).and_then(|n| n.parse().ok()).unwrap_or(none);
    match args.first().map(String::as_str) {
        Some("latency") => latency(count(100)),
        Some("peer") => peer(count(20)),
        Some("check") => check(count(10_000)),
        _ => {
            latency(100);
            peer(10);
            check(1000);
        }
    }
}
