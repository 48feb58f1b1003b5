//! `morula compare`.

use super::*;

const METHODS: [&str; 11] = [
    "mss",
    "best-draft",
    "best",
    "inscribed",
    "cover",
    "surface-fit",
    "euclidean",
    "ferellec-mcdowell",
    "favier",
    "uniform-grid",
    "packed",
];

fn compare<'a>(input: &'a str, extra: &[&'a str]) -> Vec<&'a str> {
    [&["compare", input, "--cells", "20", "--threads", "1"], extra].concat()
}

#[test]
fn every_method_has_a_line_in_table_json_and_csv() {
    let folder = folder("compare");
    let (csv, png) = (folder.join("c.csv"), folder.join("c.png"));
    let files = ["--csv", text(&csv), "-o", text(&png), "--size", "600x500"];
    let n = ["-n", "6", "--json"];
    let printed = succeeds(&compare("sample:ellipsoid", &[&files[..], &n].concat()));
    assert_eq!(printed.lines().count(), 1);
    let v: Value = serde_json::from_str(&printed).unwrap();
    for key in ["input", "equivalent_diameter", "cells", "threads", "seconds", "notes", "clumps"] {
        assert!(!v[key].is_null(), "{key}");
    }
    let clumps = v["clumps"].as_array().unwrap();
    let names: Vec<&str> = clumps.iter().map(|c| c["method"].as_str().unwrap()).collect();
    assert_eq!(names, METHODS);
    for c in clumps {
        for key in ["D", "coverage", "overshoot", "protrusion", "rms_distance", "wall_seconds"] {
            assert!(c[key].is_f64(), "{key} of {c}");
        }
        assert!(c["error"].is_null() && c["asked"] == 6, "{c}");
        assert!((1..=6).contains(&c["n"].as_u64().unwrap()), "{c}");
        assert!(["spheres", "exhausted"].contains(&c["stopped"].as_str().unwrap()), "{c}");
        if cfg!(target_os = "linux") {
            assert!(c["cpu_seconds"].as_f64().unwrap() >= 0.0, "{c}");
        }
    }

    // The same figures as `morula clump` has.
    let best = ["clump", "sample:ellipsoid", "--cells", "20", "--threads", "1", "-n", "6"];
    let best = succeeds(&[&best[..], &["--method", "best", "--json"]].concat());
    let best: Value = serde_json::from_str(&best).unwrap();
    for key in ["D", "coverage", "overshoot", "protrusion", "rms_distance", "n", "stopped"] {
        assert_eq!(clumps[2][key], best[key], "{key}");
    }

    let csv = std::fs::read_to_string(csv).unwrap();
    let lines: Vec<Vec<&str>> = csv.lines().map(|l| l.split(',').collect()).collect();
    assert!(lines.iter().all(|l| l.len() == lines[0].len()), "{csv}");
    let rows: Vec<&str> = lines[1..].iter().map(|l| l[0]).collect();
    assert_eq!(rows, METHODS);
    let d = lines[0].iter().position(|c| *c == "D").unwrap();
    assert_eq!(lines[3][d].parse::<f64>().unwrap(), clumps[2]["D"].as_f64().unwrap());

    let (size, pixels) = pixels(&png);
    assert_eq!(size, (600, 500));
    // A grid of 4 x 3 panels: all hold something, bluish or reddish but for the target.
    for panel in 0..12 {
        let (mut drawn, mut coloured) = (0, 0);
        for (i, p) in pixels.chunks_exact(3).enumerate() {
            let (x, y) = (i % 600, i / 600);
            if x / 150 == panel % 4 && (y.saturating_sub(20)) / 148 == panel / 4 && y < 440 {
                drawn += usize::from(p != [255, 255, 255]);
                coloured += usize::from(p[2] > p[0].saturating_add(20));
            }
        }
        assert!(drawn > 2000, "panel {panel}: {drawn} pixels are drawn");
        assert!((coloured > 20) == (panel > 0), "panel {panel}: {coloured} pixels are coloured");
    }
}

#[test]
fn the_table_has_the_methods_and_numbers_asked_for() {
    let what = ["-n", "3,5", "--methods", "mss,best-draft", "--no-picture"];
    let table = succeeds(&compare("sample:tablet", &what));
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split_whitespace().collect()).collect();
    assert_eq!(rows[1][..4], ["method", "n", "D", "coverage"]);
    let names: Vec<[&str; 2]> = rows[3..].iter().map(|r| [r[0], r[1]]).collect();
    assert_eq!(names, [["mss", "3"], ["mss", "5"], ["best-draft", "3"], ["best-draft", "5"]]);
    for row in &rows[3..] {
        let d: f64 = row[2].parse().unwrap();
        assert!(d > 0.0 && d < 1.0 && row.len() == 10, "{row:?}");
    }
}

#[test]
fn a_method_that_fails_has_its_sentence_and_the_others_go_on() {
    let folder = folder("compare-fails");
    let (csv, png) = (folder.join("c.csv"), folder.join("c.png"));
    // The axis of a torus runs outside of it.
    let what = ["--methods", "favier,best-draft", "-n", "4", "--csv", text(&csv), "-o", text(&png)];
    let table = succeeds(&compare("sample:torus", &what));
    let rows: Vec<&str> = table.lines().skip(3).collect();
    assert_eq!(rows.len(), 2, "{table}");
    assert!(rows[0].starts_with("favier") && rows[0].ends_with(']'), "{table}");
    assert!(rows[1].starts_with("best-draft") && rows[1].ends_with("spheres"), "{table}");
    let csv = std::fs::read_to_string(csv).unwrap();
    assert!(csv.lines().nth(1).unwrap().starts_with("favier,4,,,,,,,,,,\""), "{csv}");
    assert!(png.exists());
    // When none has a clump, the command fails, and writes nothing.
    std::fs::remove_file(&png).unwrap();
    let alone = ["--methods", "favier", "-n", "4", "-o", text(&png)];
    let said = fails(&compare("sample:torus", &alone), 1);
    assert!(said.contains("sample:torus") && !png.exists(), "{said}");
}

#[test]
fn what_does_not_fit_together_is_refused() {
    let folder = folder("compare-usage");
    let (off, mesh) = (folder.join("box.off"), folder.join("box.png"));
    succeeds(&["sample", "box", "-o", text(&off)]);
    std::fs::rename(off, &mesh).unwrap();
    let before = std::fs::read(&mesh).unwrap();
    for wrong in [
        &["-n", "0"][..],
        &["-n", "3,x"],
        &["--methods", "bset"],
        &["-o", "c.jpg"],
        &["-o", text(&mesh)],
        &["--no-picture", "--csv", text(&mesh)],
        &["--no-picture", "--csv", "-"],
        &["--no-picture", "-o", "c.png"],
        &["--methods", "mss", "--thorough"],
    ] {
        fails(&compare(text(&mesh), wrong), 2);
    }
    assert_eq!(std::fs::read(&mesh).unwrap(), before);
}
