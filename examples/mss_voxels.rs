//! MSS on a voxel mask from a `.npy` file, for `scripts/compare_mss.py`:
//! `mss_voxels MASK.npy OUT.csv SPHERES RADIUS_OFFSET [THREADS]`. Writes the spheres in cells (the
//! centre of cell (0, 0, 0) is the origin) and prints one line of figures. The CPU time is
//! that of the calling thread (Linux): distance transform to spheres, as for the peer.

use morula::generate::{GenerateOptions, Method, generate};
use morula::shape::{Bodies, read::FileOptions};
use morula::solid::SolidOptions;
use morula::{Run, Shape, Solid};
use std::fmt::Write;
use std::path::Path;

type Failure = Box<dyn std::error::Error>;

fn cpu_seconds() -> Result<f64, Failure> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat")?;
    let nanoseconds: f64 = text.split_whitespace().next().unwrap_or("0").parse()?;
    Ok(nanoseconds * 1e-9)
}

fn main() -> Result<(), Failure> {
    let args: Vec<String> = std::env::args().collect();
    let [_, input, output, spheres, offset, rest @ ..] = args.as_slice() else {
        return Err("usage: mss_voxels MASK.npy OUT.csv SPHERES RADIUS_OFFSET [THREADS]".into());
    };
    let run = Run::new(rest.first().map_or(Ok(1), |t| t.parse())?)?;
    let mut file = FileOptions::default();
    file.import.bodies = Bodies::All;
    file.npy_xyz = true;
    let shape = Shape::from_file(Path::new(input), &file, &run)?;
    let before = cpu_seconds()?;
    let solid = Solid::new(&shape, &SolidOptions { padding: 2, ..SolidOptions::default() }, &run)?;
    let made = cpu_seconds()?;
    let options = GenerateOptions {
        method: Method::Mss,
        spheres: spheres.parse()?,
        radius_offset: offset.parse()?,
        ..GenerateOptions::default()
    };
    let clump = generate(&solid, &options, &run)?;
    let done = cpu_seconds()?;
    let mut csv = String::from("x,y,z,r\n");
    for s in &clump.spheres {
        let c = s.center;
        writeln!(csv, "{},{},{},{}", c.x - 0.5, c.y - 0.5, c.z - 0.5, s.radius)?;
    }
    std::fs::write(output, csv)?;
    let counters = clump.counters;
    let line = format!(
        "{{\"n\": {}, \"solid_s\": {:.4}, \"mss_s\": {:.4}, \"cells\": {}, \"bytes\": {}, \
         \"tried\": {}, \"transforms\": {}, \"stopped\": \"{}\", \"note\": \"{}\"}}\n",
        clump.spheres.len(),
        made - before,
        done - made,
        solid.grid().len(),
        counters.peak_bytes,
        counters.spheres_tried,
        counters.transforms,
        clump.stopped.name(),
        clump.note,
    );
    std::io::Write::write_all(&mut std::io::stdout(), line.as_bytes())?;
    Ok(())
}
