//! Hard cases stay numerically stable: the short ones of `morula selftest`, a test for each group.
#![cfg(all(feature = "cli", feature = "dem"))]
#![allow(clippy::panic, clippy::print_stdout)]

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
