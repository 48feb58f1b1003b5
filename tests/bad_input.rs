//! Bad input through the C ABI: every known-bad file from the wild and every
//! generated hard case gives a good clump, or one clear status with a sentence
//! that names the fault. None panics, hangs, takes more than 2 GiB or yields NaN.
//!
//! Daily: 10 spheres, 32 cells, a deadline of 2 seconds. With `MORULA_FULL=1`
//! the defaults. `--nocapture` prints the table; `MORULA_TABLE=file.csv` writes it.

#![allow(unsafe_code)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

use morula::ffi::*;
use std::collections::BTreeMap;
use std::ffi::{CStr, CString};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Longer than this is a hang.
const HANG_SECONDS: f64 = 20.0;

fn full() -> bool {
    std::env::var_os("MORULA_FULL").is_some()
}

/// What one case gave.
#[derive(Debug, Clone)]
struct Outcome {
    status: i32,
    message: String,
    spheres: usize,
    mismatch: f64,
    /// Most memory that the process of the case held.
    peak_kib: u64,
    /// What is wrong with the clump itself; empty when it is good.
    fault: String,
}

impl Outcome {
    fn name(&self) -> String {
        unsafe { CStr::from_ptr(morula_status_name(self.status)) }.to_str().unwrap().to_owned()
    }
}

fn failed(status: i32) -> Outcome {
    let message = unsafe { CStr::from_ptr(morula_last_error_message()) };
    Outcome {
        status,
        message: message.to_str().unwrap().to_owned(),
        spheres: 0,
        mismatch: 0.0,
        peak_kib: 0,
        fault: String::new(),
    }
}

/// The main road for one file: shape, clump, spheres, figures.
unsafe fn road(path: &Path, bodies: i32) -> Outcome {
    unsafe {
        let path = CString::new(path.to_str().unwrap()).unwrap();
        let mut import: morula_import_options = std::mem::zeroed();
        let mut solid: morula_solid_options = std::mem::zeroed();
        let mut options: morula_clump_options = std::mem::zeroed();
        assert_eq!(morula_import_options_init(&mut import, size_of_val(&import)), 0);
        assert_eq!(morula_solid_options_init(&mut solid, size_of_val(&solid)), 0);
        assert_eq!(morula_clump_options_init(&mut options, size_of_val(&options)), 0);
        import.bodies = bodies;
        options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_MOMENTS;
        if !full() {
            solid.cells = 32;
            options.spheres = 10;
            options.deadline_seconds = 2.0;
        }
        let mut shape = std::ptr::null_mut();
        let status = morula_shape_from_file(path.as_ptr(), &import, std::ptr::null(), &mut shape);
        if status != 0 {
            assert!(shape.is_null());
            return failed(status);
        }
        let mut clump = std::ptr::null_mut();
        let status = morula_clump_from_shape(shape, &solid, &options, &mut clump);
        if status != 0 {
            assert!(clump.is_null());
            let outcome = failed(status);
            morula_shape_free(shape);
            return outcome;
        }
        let outcome = judge(shape, clump);
        morula_clump_free(clump);
        morula_shape_free(shape);
        outcome
    }
}

/// Whether a clump is one: finite, positive radii, about where the shape is.
unsafe fn judge(shape: *const morula_shape, clump: *const morula_clump) -> Outcome {
    unsafe {
        let mut n = 0;
        assert_eq!(morula_clump_sphere_count(clump, &mut n), 0);
        let mut xyzr = vec![[0.0; 4]; n];
        assert_eq!(morula_clump_copy_spheres(clump, n, xyzr.as_mut_ptr().cast()), 0);
        let mut report: morula_report = std::mem::zeroed();
        let mut overlap: morula_overlap = std::mem::zeroed();
        let mut moments: morula_moments = std::mem::zeroed();
        report.struct_size = size_of_val(&report);
        overlap.struct_size = size_of_val(&overlap);
        moments.struct_size = size_of_val(&moments);
        assert_eq!(morula_shape_report(shape, &mut report), 0);
        let measured = morula_clump_overlap(clump, &mut overlap);
        assert_eq!(morula_clump_moments(clump, 2.0, &mut moments), 0);

        let mut fault = String::new();
        let edge = (0..3).map(|a| report.box_max[a] - report.box_min[a]).fold(0.0, f64::max);
        for (i, s) in xyzr.iter().enumerate() {
            let inside = (0..3).all(|a| {
                s[a] >= report.box_min[a] - 0.1 * edge && s[a] <= report.box_max[a] + 0.1 * edge
            });
            if !s.iter().all(|v| v.is_finite()) || s[3] <= 0.0 || s[3] > edge || !inside {
                fault = format!("sphere {i} is {s:?}");
            }
        }
        let figures = [overlap.mismatch, overlap.coverage, overlap.overshoot, overlap.eta];
        let body = [moments.mass, moments.principal[0], moments.quaternion[0], moments.centre[0]];
        if n == 0 {
            fault = "no sphere".into();
        } else if measured != 0 {
            fault = "the quality was not measured".into();
        } else if !figures.iter().chain(&body).all(|v| v.is_finite()) || moments.mass <= 0.0 {
            fault = format!("figures {figures:?}, body {body:?}");
        } else if !(0.0..=1.0).contains(&overlap.mismatch) {
            fault = format!("D = {}", overlap.mismatch);
        }
        Outcome {
            status: 0,
            message: String::new(),
            spheres: n,
            mismatch: overlap.mismatch,
            peak_kib: 0,
            fault,
        }
    }
}

/// One case in a process of its own, so that a hang can be ended, a crash is one
/// case's, and its memory can be told. The tests below start it.
#[test]
fn one_case() {
    let Some(path) = std::env::var_os("MORULA_CASE") else { return };
    let bodies = std::env::var("MORULA_BODIES").unwrap().parse().unwrap();
    let o = unsafe { road(Path::new(&path), bodies) };
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status
        .lines()
        .find_map(|l| l.strip_prefix("VmHWM:"))
        .and_then(|v| v.split_whitespace().next()?.parse::<u64>().ok())
        .unwrap_or(0);
    let (message, fault) = (o.message.replace('\n', "\\n"), o.fault);
    println!("\nOUTCOME\t{}\t{}\t{}\t{peak}\t{fault}\t{message}", o.status, o.spheres, o.mismatch);
}

/// Seconds of CPU time that a process has used; 0 where the system does not tell.
fn cpu_seconds(pid: u32) -> f64 {
    let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    fields.skip(11).take(2).filter_map(|t| t.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// Runs one case; an error when it hangs or dies. A machine with other work to
/// do is no hang: what counts is the case's own time on a processor.
fn run(path: &Path, bodies: i32) -> Result<Outcome, String> {
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "one_case", "--nocapture", "--test-threads=1"])
        .env("MORULA_CASE", path)
        .env("MORULA_BODIES", bodies.to_string())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        let used = cpu_seconds(child.id());
        if used > HANG_SECONDS || start.elapsed().as_secs_f64() > 15.0 * HANG_SECONDS {
            child.kill().unwrap();
            child.wait().unwrap();
            return Err(format!("hangs ({used:.0} s)"));
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let out = child.wait_with_output().unwrap();
    let (text, errors) =
        (String::from_utf8_lossy(&out.stdout), String::from_utf8_lossy(&out.stderr));
    let line = text.lines().find_map(|l| l.strip_prefix("OUTCOME\t"));
    let cells: Vec<&str> = line.map(|l| l.splitn(6, '\t').collect()).unwrap_or_default();
    let [status, spheres, mismatch, peak, fault, message] = cells[..] else {
        return Err(format!("died: {} {errors}", out.status));
    };
    if errors.contains("panicked") {
        return Err(format!("prints a panic: {errors}"));
    }
    Ok(Outcome {
        status: status.parse().unwrap(),
        message: message.to_owned(),
        spheres: spheres.parse().unwrap(),
        mismatch: mismatch.parse().unwrap(),
        peak_kib: peak.parse().unwrap(),
        fault: fault.to_owned(),
    })
}

/// What must come out.
#[derive(Debug, Clone, Copy)]
enum Expect {
    /// A clump.
    Good,
    /// One of these statuses.
    Refused(&'static [i32]),
    /// A clump or any clear status.
    Either,
}
use Expect::{Either, Good, Refused};

const FORMAT: &[i32] = &[MORULA_STATUS_FORMAT];
const NOTHING: &[i32] = &[MORULA_STATUS_FORMAT, MORULA_STATUS_EMPTY];
const INDICES: &[i32] = &[MORULA_STATUS_FORMAT, MORULA_STATUS_INDEX_OUT_OF_RANGE];
const FLAT: &[i32] = &[MORULA_STATUS_ZERO_VOLUME, MORULA_STATUS_OPEN_SURFACE, MORULA_STATUS_EMPTY];
const SEVERAL: &[i32] = &[MORULA_STATUS_SEVERAL_BODIES];
const NUMBERS: &[i32] = &[MORULA_STATUS_NOT_FINITE, MORULA_STATUS_FORMAT];

struct Table {
    rows: Vec<String>,
    faults: Vec<String>,
    peak_kib: u64,
}

impl Table {
    fn new() -> Self {
        Table {
            rows: vec!["case,bodies,outcome,spheres,D,message".into()],
            faults: Vec::new(),
            peak_kib: 0,
        }
    }

    fn case(&mut self, name: &str, path: &Path, expect: Expect) {
        // First as it comes, then, where bodies were refused, all of them and the largest.
        let first = self.one(name, path, MORULA_BODIES_REFUSE, expect);
        if first == Some(MORULA_STATUS_SEVERAL_BODIES) {
            self.one(name, path, MORULA_BODIES_ALL, Either);
            self.one(name, path, MORULA_BODIES_LARGEST, Either);
        }
    }

    fn one(&mut self, name: &str, path: &Path, bodies: i32, expect: Expect) -> Option<i32> {
        let choice = ["refuse", "largest", "all"][bodies as usize];
        let o = match run(path, bodies) {
            Ok(outcome) => outcome,
            Err(what) => {
                println!("{name},{choice} {what}");
                self.faults.push(format!("{name} ({choice}): {what}"));
                return None;
            }
        };
        self.peak_kib = self.peak_kib.max(o.peak_kib);
        let row = format!("{name},{choice},{},{},{:.4}", o.name(), o.spheres, o.mismatch);
        println!("{row} {}", o.message);
        self.rows.push(format!("{row},\"{}\"", o.message.replace('"', "'")));
        let mut fault = |what: &str| self.faults.push(format!("{name} ({choice}): {what}: {o:?}"));
        if o.status == 0 {
            if !o.fault.is_empty() {
                fault("a bad clump");
            }
            if compact(name) && o.mismatch > 0.25 {
                fault("ten spheres should come closer to a compact body");
            }
        } else if o.status == MORULA_STATUS_INTERNAL {
            fault("a defect of the library");
        } else if o.message.split_whitespace().count() < 3 || o.message.contains("\\n") {
            fault("no clear sentence");
        }
        match expect {
            Good if o.status != 0 => fault("a clump was expected"),
            Refused(statuses) if !statuses.contains(&o.status) => fault("another status expected"),
            _ => {}
        }
        Some(o.status)
    }

    fn finish(self, part: &str) {
        if let Some(file) = std::env::var_os("MORULA_TABLE") {
            let mut path = PathBuf::from(file);
            let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
            path.set_file_name(format!("{stem}_{part}.csv"));
            std::fs::write(path, self.rows.join("\n") + "\n").unwrap();
        }
        let peak = self.peak_kib;
        println!("{part}: {} rows, peak memory of a case {peak} KiB", self.rows.len() - 1);
        assert!(peak < 2 << 20, "peak memory {peak} KiB");
        assert!(self.faults.is_empty(), "{}", self.faults.join("\n"));
    }
}

/// What the manifest of the files says of them, as far as it decides the outcome.
fn expectations() -> BTreeMap<&'static str, Expect> {
    BTreeMap::from([
        // Nothing in them, or not what they say.
        ("assimp_empty.ply", Refused(NOTHING)),
        ("assimp_invalid.off", Refused(INDICES)),
        ("assimp_malformed.obj", Refused(INDICES)),
        ("assimp_OutOfMemory.off", Refused(FORMAT)),
        ("trimesh_empty.stl", Refused(NOTHING)),
        ("trimesh_points_ascii.ply", Refused(NOTHING)),
        ("trimesh_stl_empty_ascii.stl", Refused(NOTHING)),
        ("trimesh_stl_empty_bin.stl", Refused(NOTHING)),
        // Without an inside.
        ("assimp_triangle_with_empty_solid.stl", Refused(FLAT)),
        ("assimp_triangle_with_two_solids.stl", Refused(FLAT)),
        ("cgal_degtri_sliding.off", Refused(FLAT)),
        (
            "trimesh_notenoughindices.obj",
            Refused(&[MORULA_STATUS_ZERO_VOLUME, MORULA_STATUS_OPEN_SURFACE, MORULA_STATUS_FORMAT]),
        ),
        // Several bodies, told by their count.
        ("manifold_Offset2.obj", Refused(SEVERAL)),
        ("trimesh_two_objects_mixed_case_names.stl", Refused(SEVERAL)),
        // Odd, but sound.
        ("assimp_sphereWithHole.stl", Good),
        ("cgal_blobby-shuffled.off", Good),
        ("cgal_elephant-with-holes.off", Good),
        ("cgal_mech-holes-shark.off", Good),
        ("cgal_open_cube.off", Good),
        ("cgal_pig.off", Good),
        ("epfl_compare_iphone_lidar.stl", Good),
        ("manifold_self_intersectA.obj", Good),
        ("trimesh_nancolor.obj", Good),
        ("trimesh_negative_indices.obj", Good),
        ("trimesh_suzanne.ply", Good),
        ("trimesh_whitespace.off", Good),
    ])
}

fn data() -> Option<PathBuf> {
    let data = std::env::var_os("MORULA_DATA").map(PathBuf::from);
    if data.is_none() {
        println!("skipped: MORULA_DATA is not set");
    }
    data
}

#[test]
fn files_from_the_wild() {
    let Some(data) = data() else { return };
    let mut expected = expectations();
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(data.join("bad")).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    let mut table = Table::new();
    for path in &files {
        let name = path.file_name().unwrap().to_str().unwrap();
        let expect = expected.remove(name).unwrap_or(Either);
        table.case(name, path, expect);
    }
    assert!(expected.is_empty(), "no such files: {expected:?}");
    assert!(files.len() >= 50);
    table.finish("wild");
}

/// Bodies without thin parts, that ten spheres come close to, whatever is wrong with their file.
fn compact(name: &str) -> bool {
    let stem = name.rsplit('/').next().unwrap_or(name);
    let starts = [
        "all_ones",
        "anisotropic_ball",
        "ascii_cube",
        "ball_0_255",
        "ball_with_dust",
        "box_unit",
        "cube_quadfan",
        "cube_t_junction",
        "duplicated_faces",
        "inverted_sphere",
        "mixed_winding_sphere",
        "mm_spheroid",
        "open_box",
        "open_hemisphere",
        "open_sphere",
        "overlapping_bodies",
        "sliver_",
        "solid_header",
        "sphere_",
        "tablet_",
        "touch_at_face",
        "unwelded_jitter",
        "zero_area",
    ];
    starts.iter().any(|s| stem.starts_with(s))
}

/// What the index of the generated cases says: "ok …", "named error …", "warn …".
fn generated(path: &str, words: &str) -> Expect {
    let name = path.rsplit('/').next().unwrap();
    match name {
        "nan_vertex.stl" | "inf_vertex.stl" => Refused(NUMBERS),
        "single_triangle.stl" | "flat_square_two_sided.stl" => Refused(FLAT),
        "empty_file.stl" | "header_only.stl" | "all_zeros.npy" | "empty_axis.npy"
        | "empty_file.npy" => Refused(NOTHING),
        "truncated.stl" | "count_too_big.stl" | "truncated.npy" => Refused(FORMAT),
        "two_d.npy" => Refused(&[MORULA_STATUS_FORMAT, MORULA_STATUS_UNSUPPORTED]),
        "two_disjoint.stl" | "two_blobs.npy" | "checkerboard.npy" | "diagonal_line_26.npy" => {
            Refused(SEVERAL)
        }
        _ if words == "ok" => Good,
        _ => Either,
    }
}

#[test]
fn generated_hard_cases() {
    let Some(data) = data() else { return };
    let python = std::env::var("MORULA_PYTHON").unwrap_or("python3".into());
    let numpy = Command::new(&python).args(["-c", "import numpy"]).output();
    if !numpy.is_ok_and(|o| o.status.success()) {
        println!("skipped: {python} with numpy is not installed (MORULA_PYTHON names another)");
        return;
    }
    let out = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("hard");
    let made = Command::new(&python).arg(data.join("gen_hard.py")).arg(&out).output().unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let index = std::fs::read_to_string(out.join("INDEX.csv")).unwrap();
    let mut table = Table::new();
    let mut count = 0;
    for line in index.lines().skip(1) {
        let cells = split_csv(line);
        table.case(&cells[0], &out.join(&cells[0]), generated(&cells[0], &cells[6]));
        count += 1;
    }
    assert!(count >= 80, "{count} cases");
    table.finish("generated");
}

/// Cells of a line of comma-separated values, in which a cell may be quoted.
fn split_csv(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            c => cells.last_mut().unwrap().push(c),
        }
    }
    cells
}

/// Lengths at the ends of the range and far from the origin: no absolute tolerance bites.
#[test]
fn tiny_huge_and_far_bodies() {
    for (size, offset) in [(1e-12, 0.0), (1e12, 0.0), (1.0, 1e8), (1e-9, 0.1), (3e-5, -1e3)] {
        let corner = |i: usize| -> [f64; 3] {
            [i & 1, i >> 1 & 1, i >> 2 & 1].map(|b| offset + size * b as f64)
        };
        let vertices: Vec<[f64; 3]> = (0..8).map(corner).collect();
        let quads =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces: Vec<[u32; 3]> =
            quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        unsafe {
            let mut shape = std::ptr::null_mut();
            let status = morula_shape_from_mesh(
                vertices.as_ptr().cast(),
                8,
                faces.as_ptr().cast(),
                12,
                std::ptr::null(),
                &mut shape,
            );
            assert_eq!(status, 0, "{:?}", failed(status));
            let mut options: morula_clump_options = std::mem::zeroed();
            assert_eq!(morula_clump_options_init(&mut options, size_of_val(&options)), 0);
            options.spheres = 9;
            options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_MOMENTS;
            let mut clump = std::ptr::null_mut();
            let status = morula_clump_from_shape(shape, std::ptr::null(), &options, &mut clump);
            assert_eq!(status, 0, "{:?}", failed(status));
            let o = judge(shape, clump);
            assert!(o.fault.is_empty() && o.mismatch < 0.3, "size {size}, offset {offset}: {o:?}");
            morula_clump_free(clump);
            morula_shape_free(shape);
        }
    }
}
