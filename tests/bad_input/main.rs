//! Bad input through the C ABI: every known-bad file from the wild and every
//! generated hard case gives a good clump, or one clear status with a sentence
//! that names the fault. None panics, hangs, takes more than 2 GiB or yields NaN.
//!
//! Daily: 10 spheres, 32 cells, a deadline of 2 seconds. With `MORULA_FULL=1`
//! the defaults. `--nocapture` prints the table; `MORULA_TABLE=file.csv` writes it.

#![allow(unsafe_code)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

#[path = "../common/mod.rs"]
mod common;
mod expect;
mod road;
mod table;

use common::{cube, data};
use expect::{Expect, expectations, generated};
use morula::ffi::*;
use road::{clump_of, failed, road};
use std::path::{Path, PathBuf};
use std::process::Command;
use table::{Table, split_csv};

fn full() -> bool {
    std::env::var_os("MORULA_FULL").is_some()
}

/// One case in a process of its own, so that a hang can be ended, a crash is one
/// case's, and its memory can be told. The tests below start it.
#[test]
fn one_case() {
    let Some(path) = std::env::var_os("MORULA_CASE") else { return };
    let bodies = std::env::var("MORULA_BODIES").unwrap().parse().unwrap();
    let o = unsafe { road(Path::new(&path), bodies, full()) };
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status
        .lines()
        .find_map(|l| l.strip_prefix("VmHWM:"))
        .and_then(|v| v.split_whitespace().next()?.parse::<u64>().ok())
        .unwrap_or(0);
    let (message, fault) = (o.message.replace('\n', "\\n"), o.fault);
    println!("\nOUTCOME\t{}\t{}\t{}\t{peak}\t{fault}\t{message}", o.status, o.spheres, o.mismatch);
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
        let expect = expected.remove(name).unwrap_or(Expect::Either);
        table.case(name, path, expect);
    }
    assert!(expected.is_empty(), "no such files: {expected:?}");
    assert!(files.len() >= 50);
    table.finish("wild");
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

/// Lengths at the ends of the range and far from the origin: no absolute tolerance bites.
#[test]
fn tiny_huge_and_far_bodies() {
    for (size, offset) in [(1e-12, 0.0), (1e12, 0.0), (1.0, 1e8), (1e-9, 0.1), (3e-5, -1e3)] {
        let (vertices, faces) = cube([offset; 3], size);
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
            let o = clump_of(shape, std::ptr::null(), &mut options);
            assert!(o.status == 0 && o.fault.is_empty(), "size {size}, offset {offset}: {o:?}");
            assert!(o.mismatch < 0.3, "size {size}, offset {offset}: {o:?}");
            morula_shape_free(shape);
        }
    }
}
