//! The peer `multisphere` beside it.

use super::breaks::{median, pieces};
use super::latency::timed;
use morula::fragment::{Region, shape};
use morula::shape::Body;
use morula::{Run, Solid};
use std::process::Command;

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

pub fn peer(cuts: usize) {
    println!("| n | ms | `multisphere` ms | its spheres | times as long, median |");
    println!("| ---: | ---: | ---: | ---: | ---: |");
    let mut all: Vec<[Vec<f64>; 4]> = vec![Default::default(); 2];
    pieces(cuts, |solid, parent, region| {
        for (i, n) in [10, 50].into_iter().enumerate() {
            let Some((_, [ours, _])) = timed(parent, region, n, true) else { continue };
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
