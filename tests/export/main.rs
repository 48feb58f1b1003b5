//! What the DEM codes read from the files written for them: mass and moments, and a free rotation
//! held against Euler's equations. A program that is not installed is named and left out.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

mod beside;
mod body;
mod files;
mod lammps;
mod liggghts;
mod rotation;
mod wild;
mod yade;

use std::path::{Path, PathBuf};
use std::process::Command;

/// A fresh folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("export").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs a program of others in a folder; none where it is not installed.
fn run(program: &str, words: &[&str], folder: &Path) -> Option<String> {
    let mut command = Command::new(program);
    command.args(words).current_dir(folder).env("OMP_NUM_THREADS", "1");
    // A container's only user may start two ranks.
    for name in ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] {
        command.env(name, "1");
    }
    let output = match command.output() {
        Ok(output) => output,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => {
            println!("skipped: {program} is not installed");
            return None;
        }
        Err(e) => panic!("{program}: {e}"),
    };
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{program} failed:\n{said}\n{errors}");
    Some(said)
}

fn numbers(line: &str) -> Vec<f64> {
    line.split_whitespace().filter_map(|w| w.parse().ok()).collect()
}

fn close(a: f64, b: f64, relative: f64, what: &str) {
    assert!((a - b).abs() <= relative * a.abs().max(b.abs()), "{what}: {a:e} and {b:e}");
}
