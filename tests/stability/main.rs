//! Hard cases stay numerically stable: the short ones of `morula selftest`, a test for each group.
#![cfg(all(feature = "cli", feature = "dem"))]
#![allow(clippy::panic, clippy::print_stdout, clippy::unwrap_used)]

#[cfg(all(target_os = "linux", any(target_arch = "x86_64", target_arch = "aarch64")))]
mod flags;
mod properties;
#[path = "../../src/bin/morula/stability/mod.rs"]
mod stability;

use stability::{Case, Options, run};
use std::path::PathBuf;

/// Runs one group and names every case that misses its bound.
fn holds(group: &str) {
    let data = std::env::var_os("MORULA_DATA").map(PathBuf::from);
    let options = Options { full: false, groups: vec![group.into()], data };
    let mut cases: Vec<Case> = Vec::new();
    run(&options, |case| cases.push(case));
    assert!(cases.len() >= 5, "{group} has {} cases", cases.len());
    for case in &cases {
        println!(
            "{:?} {} {} {:?} {:.2} s",
            case.pass(),
            case.name,
            case.bound,
            case.outcome,
            case.seconds
        );
    }
    let missed: Vec<&Case> = cases.iter().filter(|c| !c.pass()).collect();
    assert!(missed.is_empty(), "{missed:#?}");
}

#[test]
fn invariance() {
    holds("invariance");
}

#[test]
fn shapes() {
    holds("shapes");
}

#[test]
fn algebra() {
    holds("algebra");
}

#[test]
fn references() {
    holds("references");
}

#[test]
fn convergence() {
    holds("convergence");
}

#[test]
fn accumulation() {
    holds("accumulation");
}

#[test]
fn stiffness() {
    holds("stiffness");
}

#[test]
fn every_group_has_its_test() {
    let text = include_str!("main.rs");
    for group in stability::groups() {
        assert!(text.contains(&format!("holds(\"{group}\")")), "{group}");
    }
}

fn selftest(arguments: &[&str]) -> (Option<i32>, serde_json::Value) {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_morula"))
        .args(["selftest", "--json"])
        .args(arguments)
        .output()
        .unwrap();
    (output.status.code(), serde_json::from_slice(&output.stdout).unwrap())
}

#[test]
fn the_program_says_what_it_found_and_misses_end_it_with_1() {
    let (code, found) = selftest(&["--group", "algebra"]);
    assert_eq!((code, &found["missed"]), (Some(0), &0.into()));
    let cases = found["cases"].as_array().unwrap();
    assert!(cases.len() > 20 && cases.iter().all(|c| c["value"].is_f64() && c["why"].is_string()));
    // A folder without the particles: the miss is a line, the other cases are run.
    let (code, found) = selftest(&["--group", "references", "--data", "src"]);
    assert_eq!(code, Some(1));
    let missed = found["missed"].as_u64().unwrap();
    assert!(missed >= 1 && missed < found["cases"].as_array().unwrap().len() as u64);
}
