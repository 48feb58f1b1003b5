//! The built program: what it prints, writes and returns.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod clumps;
mod compare;
#[cfg(feature = "dem")]
mod converge;
mod cost;
mod failures;
mod fragments;
mod masses;
mod options;
mod pictures;
#[cfg(feature = "dem")]
mod scenes;
mod shapes;

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn morula(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_morula"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .expect("the program starts")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Runs what must succeed without a word on stderr, and gives stdout.
fn succeeds(arguments: &[&str]) -> String {
    let output = morula(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    assert_eq!(stderr(&output), "", "{arguments:?} is not silent in a pipe");
    stdout(&output)
}

/// Runs what must fail with `code`, nothing on stdout and one sentence on stderr.
fn fails(arguments: &[&str], code: i32) -> String {
    let output = morula(arguments);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
    assert_eq!(stdout(&output), "", "{arguments:?}");
    assert_eq!(said.trim_end().lines().count(), 1, "{arguments:?} says more than one line: {said}");
    assert!(said.starts_with("morula: ") && !said.contains("panicked"), "{said}");
    said
}

/// A folder of its own for each test, fresh.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("cli-{name}"));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Options for a small quick clump.
const QUICK: [&str; 6] = ["-n", "10", "--cells", "24", "--threads", "1"];

fn clump(extra: &[&str]) -> Vec<String> {
    let mut all = vec!["clump".to_string(), "sample:ellipsoid".to_string()];
    all.extend(QUICK.iter().chain(extra).map(|s| s.to_string()));
    all
}

fn strs(v: &[String]) -> Vec<&str> {
    v.iter().map(String::as_str).collect()
}

fn spheres_of_csv(csv: &str) -> Vec<[f64; 4]> {
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("x,y,z,r"));
    lines
        .map(|l| {
            let v: Vec<f64> = l.split(',').map(|x| x.parse().unwrap()).collect();
            v.try_into().unwrap()
        })
        .collect()
}

/// Size and RGB bytes of a picture.
fn pixels(png: &Path) -> ((u32, u32), Vec<u8>) {
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(png).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let size = (reader.info().width, reader.info().height);
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    (size, pixels)
}
