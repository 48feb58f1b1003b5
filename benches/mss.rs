//! What MSS costs on the two benchmarks of its paper, in CPU time on one thread and in bytes a
//! voxel (of the large arrays) and of the whole process at its peak, beside the reference implementation (the PyPI package `multisphere`) on the same
//! voxels in the same run, when `MORULA_PEER_PYTHON` names a Python that has it. The
//! femur needs `MORULA_DATA`, and is then the peer's own grid, on which the paper's
//! figures stand; without the peer it is ours.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use morula::generate::{GenerateOptions, Method, generate};
use morula::shape::read::FileOptions;
use morula::shape::{Bodies, ImportOptions, Layout};
use morula::solid::{Resolution, SolidOptions};
use morula::{Run, Shape, Solid};
use std::path::Path;
use std::process::Command;

/// Seconds on the processor of this thread (Linux).
fn cpu() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    text.split_whitespace().next().unwrap().parse::<f64>().unwrap() * 1e-9
}

struct Voxels {
    name: &'static str,
    spheres: usize,
    dims: [usize; 3],
    mask: Vec<u8>,
}

/// The ellipsoid of 205 × 103 × 103 cells in 209 × 107 × 107.
fn ellipsoid() -> Voxels {
    let dims = [209, 107, 107];
    let mut mask = Vec::new();
    for n in 0..dims.iter().product() {
        let cell = [n % dims[0], n / dims[0] % dims[1], n / dims[0] / dims[1]];
        let q: f64 = (0..3)
            .map(|a| {
                let half = 0.5 * (dims[a] as f64 - 4.0);
                ((cell[a] as f64 + 0.5 - 0.5 * dims[a] as f64) / half).powi(2)
            })
            .sum();
        mask.push(u8::from(q <= 1.0));
    }
    Voxels { name: "ellipsoid", spheres: 10, dims, mask }
}

const GRID: &str = "
import contextlib, io, sys
import numpy as np
import multisphere as mss
from multisphere.multisphere_io import _mesh_to_voxel_grid
with contextlib.redirect_stdout(io.StringIO()):
    grid = _mesh_to_voxel_grid(mss.load_mesh(sys.argv[1]), div=102, padding=2)
print(*grid.data.shape)
np.asfortranarray(grid.data.astype(np.uint8)).T.tofile(sys.argv[2])
";

/// The femur with 102 cells on its shortest side.
fn femur() -> Option<Voxels> {
    let data = std::env::var("MORULA_DATA").ok()?;
    let path = Path::new(&data).join("benchmark/femur.stl");
    if let Ok(python) = std::env::var("MORULA_PEER_PYTHON") {
        let raw = std::env::temp_dir().join(format!("morula-grid-{}.raw", std::process::id()));
        let out = Command::new(python).args(["-c", GRID]).args([&path, &raw]).output().ok()?;
        let mask = std::fs::read(&raw);
        let text = String::from_utf8(out.stdout).ok()?;
        let dims: Vec<usize> = text.split_whitespace().filter_map(|n| n.parse().ok()).collect();
        if let (Ok(mask), &[x, y, z]) = (mask, dims.as_slice()) {
            std::fs::remove_file(&raw).unwrap();
            return Some(Voxels { name: "femur", spheres: 70, dims: [x, y, z], mask });
        }
    }
    let run = Run::serial();
    let shape = Shape::from_file(&path, &FileOptions::default(), &run).ok()?;
    let options = SolidOptions {
        resolution: Resolution::CellsShortest(102),
        padding: 2,
        ..SolidOptions::default()
    };
    let solid = Solid::new(&shape, &options, &run).unwrap();
    let mask = solid.inside().unwrap().to_vec();
    Some(Voxels { name: "femur", spheres: 70, dims: solid.grid().dims, mask })
}

/// Seconds and bytes a voxel of ours: from the solid's cells to spheres, least of three.
fn ours(v: &Voxels) -> (f64, f64) {
    let layout = Layout { dims: v.dims, spacing: [1.0; 3], origin: [0.0; 3] };
    let import = ImportOptions { bodies: Bodies::All, ..ImportOptions::default() };
    let mut best = (f64::INFINITY, 0.0);
    for _ in 0..3 {
        let run = Run::serial();
        let start = cpu();
        let shape = Shape::from_mask(&v.mask, &layout, &import, &run).unwrap();
        let options = SolidOptions { padding: 2, ..SolidOptions::default() };
        let solid = Solid::new(&shape, &options, &run).unwrap();
        let asked = GenerateOptions {
            method: Method::Mss,
            spheres: v.spheres,
            ..GenerateOptions::default()
        };
        let clump = generate(&solid, &asked, &run).unwrap();
        let seconds = cpu() - start;
        assert_eq!(clump.spheres.len(), v.spheres);
        let bytes = clump.counters.peak_bytes as f64 / solid.grid().len() as f64;
        best = (seconds.min(best.0), bytes);
    }
    best
}

const PEER: &str = "
import contextlib, io, resource, sys
def cpu():
    u = resource.getrusage(resource.RUSAGE_SELF)
    return u.ru_utime + u.ru_stime
import multisphere as mss
with contextlib.redirect_stdout(io.StringIO()):
    grid = mss.load_voxels_from_npy(sys.argv[1])
    start = cpu()
    mss.multisphere_from_voxels(grid, min_center_distance_vox=4, max_spheres=int(sys.argv[2]))
    seconds = cpu() - start
print(seconds, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
";

/// Seconds and peak memory in KiB of the peer on the same voxels; `None` when it is not installed.
fn peer(v: &Voxels) -> Option<(f64, f64)> {
    let python = std::env::var("MORULA_PEER_PYTHON").ok()?;
    let path = std::env::temp_dir().join(format!("morula-{}-{}.npy", v.name, std::process::id()));
    let [x, y, z] = v.dims;
    let mut header =
        format!("{{'descr': '|u1', 'fortran_order': True, 'shape': ({x}, {y}, {z}), }}");
    while (header.len() + 11) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend(&v.mask);
    std::fs::write(&path, bytes).unwrap();
    let out = Command::new(python)
        .args(["-c", PEER, path.to_str()?, &v.spheres.to_string()])
        .env("OMP_NUM_THREADS", "1")
        .env("OPENBLAS_NUM_THREADS", "1")
        .output()
        .ok();
    std::fs::remove_file(&path).unwrap();
    let text = String::from_utf8(out?.stdout).ok()?;
    let mut numbers = text.split_whitespace().map_while(|n| n.parse().ok());
    Some((numbers.next()?, numbers.next()?))
}

/// Most memory that this process has had at one time, in KiB (Linux).
fn peak() -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:")).unwrap();
    line.trim_end_matches("kB").trim().parse().unwrap()
}

fn main() {
    println!(
        "{:<10} {:>15} {:>4} {:>9} {:>9} {:>7} {:>13} {:>9} {:>9}",
        "shape", "voxels", "n", "ours s", "peer s", "ratio", "bytes/voxel", "ours MiB", "peer MiB"
    );
    for v in std::iter::once(ellipsoid()).chain(femur()) {
        let (seconds, bytes) = ours(&v);
        let dims = v.dims.map(|n| n.to_string()).join("x");
        let (of_peer, ratio, memory) = match peer(&v) {
            Some((s, kib)) => {
                (format!("{s:.3}"), format!("{:.1}", s / seconds), format!("{:.0}", kib / 1024.0))
            }
            None => ("-".into(), "-".into(), "-".into()),
        };
        println!(
            "{:<10} {dims:>15} {:>4} {seconds:>9.3} {of_peer:>9} {ratio:>7} {bytes:>13.1} {:>9.0} {memory:>9}",
            v.name,
            v.spheres,
            peak() / 1024.0
        );
    }
    if std::env::var("MORULA_PEER_PYTHON").is_err() {
        println!("the peer is not installed: MORULA_PEER_PYTHON is not set");
    }
    if std::env::var("MORULA_DATA").is_err() {
        println!("the femur is left out: MORULA_DATA is not set");
    }
}
