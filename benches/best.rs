//! What the method `best` costs from the arrays of a mesh to a clump: check, moments, grid and
//! generator, on one thread and two, and the memory beyond the mesh; beside the peer `multisphere`
//! from the same mesh when `MORULA_PEER_PYTHON` names a Python that has it. The shapes of the
//! benchmark need `MORULA_DATA`.
//!
//!     MORULA_DATA=… cargo bench --bench best [-- draft | normal | thorough | many | peer [SHAPE …]]

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use morula::generate::{Effort, GenerateOptions, Method, generate};
use morula::measure::{QualityOptions, quality};
use morula::run::{STAGES, Stage};
use morula::shape::read::FileOptions;
use morula::shape::{Bodies, Body, ImportOptions, Primitive};
use morula::solid::SolidOptions;
use morula::{Run, Shape, Solid, Sphere};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// A mesh as a caller hands it in.
struct Arrays {
    name: String,
    vertices: Vec<[f64; 3]>,
    faces: Vec<[u32; 3]>,
}

/// About 20 000 triangles each.
const BUILT_IN: [(&str, usize); 4] =
    [("ellipsoid", 142), ("torus", 172), ("stone", 156), ("cylinder", 122)];
const READ: [&str; 4] = ["femur", "teapot", "swiss_cheese", "bunny"];

fn import() -> ImportOptions {
    ImportOptions { bodies: Bodies::Largest, ..ImportOptions::default() }
}

fn data() -> Option<PathBuf> {
    std::env::var_os("MORULA_DATA").map(|d| Path::new(&d).join("benchmark"))
}

fn arrays(name: &str) -> Option<Arrays> {
    if let Some(&(_, segments)) = BUILT_IN.iter().find(|b| b.0 == name) {
        let (vertices, faces) = Primitive::from_name(name).unwrap().mesh(segments).unwrap();
        return Some(Arrays { name: name.into(), vertices, faces });
    }
    let options = FileOptions { import: import(), ..FileOptions::default() };
    let path = data()?.join(format!("{name}.stl"));
    let shape = Shape::from_file(&path, &options, &Run::serial()).unwrap();
    let Body::Mesh(mesh) = &*shape.body else { return None };
    let vertices = mesh.vertices.iter().map(|v| [v.x, v.y, v.z]).collect();
    Some(Arrays { name: name.into(), vertices, faces: mesh.faces.clone() })
}

fn shapes(asked: &[String]) -> Vec<Arrays> {
    let names = BUILT_IN.iter().map(|b| b.0).chain(READ);
    let wanted = |n: &&str| asked.is_empty() || asked.iter().any(|a| a == n);
    names.filter(wanted).filter_map(arrays).collect()
}

/// CPU seconds of this process.
fn cpu() -> f64 {
    // Fields 14 and 15 of the line, in hundredths; threads that have ended count.
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap();
    let (_, rest) = stat.rsplit_once(") ").unwrap();
    let ticks: f64 = rest.split(' ').skip(11).take(2).map(|t| t.parse::<f64>().unwrap()).sum();
    ticks / 100.0
}

/// A line of `/proc/self/status`, in KiB.
fn status(name: &str) -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = text.lines().find_map(|l| l.strip_prefix(name)).unwrap();
    line.trim_start_matches(':').trim_end_matches("kB").trim().parse().unwrap()
}

fn make(a: &Arrays, spheres: usize, effort: Effort, run: &Run) -> (Solid, Vec<Sphere>) {
    let shape = Shape::from_mesh(&a.vertices, &a.faces, &import(), run).unwrap();
    let solid = Solid::new(&shape, &SolidOptions::default(), run).unwrap();
    let options = GenerateOptions { method: Method::Best, spheres, effort, ..Default::default() };
    let clump = generate(&solid, &options, run).unwrap();
    assert_eq!(clump.spheres.len(), spheres);
    (solid, clump.spheres)
}

#[derive(Clone, Copy)]
struct Times {
    wall: f64,
    /// Of this thread.
    cpu: f64,
    stages: [f64; STAGES],
    /// As the library counts it.
    bytes: u64,
}

/// CPU seconds of this thread.
fn own() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    text.split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-9
}

/// The least of some runs, each with threads of its own.
fn quickest(a: &Arrays, n: usize, effort: Effort, threads: usize, runs: usize) -> Times {
    let timed = (0..runs).map(|_| {
        let (start, before) = (Instant::now(), own());
        let run = Run::new(threads).unwrap();
        drop(make(a, n, effort, &run));
        let counters = run.counters();
        drop(run);
        let (wall, cpu) = (start.elapsed().as_secs_f64(), own() - before);
        Times { wall, cpu, stages: counters.seconds, bytes: counters.peak_bytes }
    });
    let least = |x: Times, y: Times| Times {
        wall: x.wall.min(y.wall),
        cpu: x.cpu.min(y.cpu),
        stages: std::array::from_fn(|k| x.stages[k].min(y.stages[k])),
        bytes: x.bytes.max(y.bytes),
    };
    timed.reduce(least).unwrap()
}

/// Memory beyond the mesh in MB, of a process that does nothing else.
fn memory(name: &str, n: usize, effort: Effort) -> f64 {
    let mut child = Command::new(std::env::current_exe().unwrap());
    child.args(["memory", name, &n.to_string(), &format!("{effort:?}")]);
    let out = child.output().unwrap().stdout;
    String::from_utf8(out).unwrap().trim().parse().unwrap()
}

fn memory_here(args: &[String]) {
    let effort = match args[2].as_str() {
        "Draft" => Effort::Draft,
        "Thorough" => Effort::Thorough,
        _ => Effort::Normal,
    };
    let a = arrays(&args[0]).unwrap();
    // What reading took is given back first, as far as the system lets it.
    std::fs::write("/proc/self/clear_refs", "5").unwrap();
    let before = status("VmRSS");
    drop(make(&a, args[1].parse().unwrap(), effort, &Run::new(2).unwrap()));
    println!("{:.1}", (status("VmHWM") - before) * 1024.0 / 1e6);
}

fn head() {
    println!(
        "| shape | triangles | n | effort | D | check ms | moments | grid | generate | \
         one thread | its CPU | two threads | bound | counted MB | taken MB |"
    );
    println!("| --- |{}", " ---: |".repeat(14));
}

fn row(a: &Arrays, n: usize, effort: Effort, bound: f64, runs: usize) {
    let (solid, spheres) = make(a, n, effort, &Run::new(2).unwrap());
    let options = QualityOptions { surface: false, columns: 512, ..QualityOptions::default() };
    let d = quality(&solid, &spheres, &options, &Run::new(2).unwrap()).unwrap().mismatch;
    drop(solid);
    let [one, two] = [1, 2].map(|threads| quickest(a, n, effort, threads, runs));
    let stage = |s: Stage| one.stages[s as usize] * 1e3;
    println!(
        "| {} | {} | {n} | {effort:?} | {d:.4} | {:.1} | {:.1} | {:.1} | {:.1} | {:.1} | {:.1} | {:.1} | \
         {bound:.0} | {:.1} | {:.1} |",
        a.name,
        a.faces.len(),
        stage(Stage::Check),
        stage(Stage::Moments),
        stage(Stage::Solid),
        stage(Stage::Generate),
        one.wall * 1e3,
        one.cpu * 1e3,
        two.wall * 1e3,
        one.bytes as f64 / 1e6,
        memory(&a.name, n, effort),
    );
}

fn time(asked: &[String], efforts: &[Effort]) {
    head();
    for a in shapes(asked) {
        for (n, effort, bound) in [
            (10, Effort::Draft, 20.0),
            (50, Effort::Draft, 20.0),
            (10, Effort::Normal, 150.0),
            (100, Effort::Normal, 150.0),
            (100, Effort::Thorough, 2500.0),
        ] {
            if efforts.contains(&effort) {
                let runs = match effort {
                    Effort::Draft => 15,
                    Effort::Normal => 5,
                    Effort::Thorough => 1,
                };
                row(&a, n, effort, bound, runs);
            }
        }
    }
}

fn many(asked: &[String]) {
    head();
    for a in shapes(asked) {
        row(&a, 1000, Effort::Normal, 3000.0, 1);
        row(&a, 5000, Effort::Draft, f64::NAN, 1);
    }
}

const PEER: &str = "
import contextlib, io, resource, sys, time
import numpy as np
def cpu():
    u = resource.getrusage(resource.RUSAGE_SELF)
    return u.ru_utime + u.ru_stime
import multisphere as mss
with contextlib.redirect_stdout(io.StringIO()):
    mesh = mss.load_mesh(sys.argv[1])
    start, clock = cpu(), time.perf_counter()
    made = mss.multisphere_from_mesh(mesh, div=100, padding=2, min_center_distance_vox=4,
                                     max_spheres=int(sys.argv[2]))
    seconds, clock = cpu() - start, time.perf_counter() - clock
print(seconds, clock)
for c, r in zip(np.asarray(made.centers), np.ravel(made.radii)):
    print(*c, r)
";

/// Seconds of the peer from the mesh to the clump, of CPU and of the clock, and its spheres.
fn peer_of(a: &Arrays, n: usize) -> Option<([f64; 2], Vec<Sphere>)> {
    let python = std::env::var("MORULA_PEER_PYTHON").ok()?;
    let path = std::env::temp_dir().join(format!("morula-{}-{}.obj", a.name, std::process::id()));
    let mut text = String::new();
    a.vertices.iter().for_each(|v| text += &format!("v {} {} {}\n", v[0], v[1], v[2]));
    a.faces.iter().for_each(|f| text += &format!("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1));
    std::fs::write(&path, text).unwrap();
    let out = Command::new(python)
        .args(["-c", PEER, path.to_str()?, &n.to_string()])
        .env("OMP_NUM_THREADS", "1")
        .env("OPENBLAS_NUM_THREADS", "1")
        .output()
        .ok()?;
    std::fs::remove_file(&path).unwrap();
    let text = String::from_utf8(out.stdout).ok()?;
    let mut lines = text.lines();
    let (cpu, clock) = lines.next()?.split_once(' ')?;
    let seconds = [cpu.parse().ok()?, clock.parse().ok()?];
    let sphere = |line: &str| {
        let v: Vec<f64> = line.split(' ').filter_map(|x| x.parse().ok()).collect();
        Sphere::new(morula::math::Vec3::new(v[0], v[1], v[2]), v[3])
    };
    Some((seconds, lines.map(sphere).collect()))
}

fn peer(asked: &[String]) {
    println!(
        "| shape | n | effort | D | CPU s, one thread | wall s, two | `multisphere` spheres | its D | \
         its CPU s | its wall s | times as long, CPU | wall | D over its D |"
    );
    println!("| --- | ---: | --- |{}", " ---: |".repeat(10));
    for a in shapes(asked) {
        for n in [30, 100] {
            let Some((seconds, theirs)) = peer_of(&a, n) else { continue };
            for effort in [Effort::Draft, Effort::Normal] {
                // Many runs: the system counts CPU time in hundredths of a second.
                let (run, runs, start) = (Run::serial(), 5, cpu());
                (0..runs).for_each(|_| drop(make(&a, n, effort, &Run::serial())));
                let ours = (cpu() - start) / f64::from(runs);
                let clock = Instant::now();
                (0..runs).for_each(|_| drop(make(&a, n, effort, &Run::new(2).unwrap())));
                let wall = clock.elapsed().as_secs_f64() / f64::from(runs);
                let (solid, spheres) = make(&a, n, effort, &run);
                let options =
                    QualityOptions { surface: false, columns: 512, ..QualityOptions::default() };
                let d = [&spheres, &theirs]
                    .map(|s| quality(&solid, s, &options, &run).unwrap().mismatch);
                println!(
                    "| {} | {n} | {effort:?} | {:.4} | {ours:.3} | {wall:.3} | {} | {:.4} | \
                     {:.2} | {:.2} | {:.0} | {:.0} | {:.2} |",
                    a.name,
                    d[0],
                    theirs.len(),
                    d[1],
                    seconds[0],
                    seconds[1],
                    seconds[0] / ours,
                    seconds[1] / wall,
                    d[0] / d[1]
                );
            }
        }
    }
}

fn main() {
    let mut args: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let part = if args.is_empty() { "all".into() } else { args.remove(0) };
    match part.as_str() {
        "memory" => memory_here(&args),
        "draft" => time(&args, &[Effort::Draft]),
        "normal" => time(&args, &[Effort::Normal]),
        "thorough" => time(&args, &[Effort::Thorough]),
        "many" => many(&args),
        "peer" => peer(&args),
        _ => {
            time(&[], &[Effort::Draft, Effort::Normal, Effort::Thorough]);
            many(&[]);
            peer(&[]);
        }
    }
}
