//! The built program: what it prints, writes and returns.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

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

#[test]
fn spheres_come_as_csv_on_stdout() {
    let csv = succeeds(&strs(&clump(&[])));
    let spheres = spheres_of_csv(&csv);
    assert_eq!(spheres.len(), 10);
    for s in &spheres {
        assert!(s.iter().all(|v| v.is_finite()) && s[3] > 0.0, "{s:?}");
        // The ellipsoid has the semi-axes 1, 0.75, 0.5.
        assert!(s[0].abs() < 1.0 && s[1].abs() < 0.75 && s[2].abs() < 0.5 && s[3] < 0.6, "{s:?}");
    }
}

#[test]
fn threads_do_not_change_a_byte() {
    let one = succeeds(&strs(&clump(&[])));
    let mut three = clump(&[]);
    let at = three.iter().position(|a| a == "--threads").unwrap();
    three[at + 1] = "3".into();
    assert_eq!(one, succeeds(&strs(&three)));
}

#[test]
fn json_is_one_object_with_the_promised_keys() {
    let printed = succeeds(&strs(&clump(&["--json", "--density", "2"])));
    assert_eq!(printed.lines().count(), 1);
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(v["n"], 10);
    for key in ["D", "coverage", "overshoot", "protrusion", "seconds", "mass"] {
        assert!(v[key].is_f64(), "{key} is {}", v[key]);
    }
    assert_eq!(v["stopped"], "spheres");
    assert_eq!(v["spheres"].as_array().unwrap().len(), 10);
    let d = v["D"].as_f64().unwrap();
    let (c, o) = (v["coverage"].as_f64().unwrap(), v["overshoot"].as_f64().unwrap());
    assert!(d > 0.0 && d < 0.3 && c > 0.7 && c <= 1.0 && (0.0..0.3).contains(&o), "{v}");
    // D, coverage and overshoot are one relation: |C| = coverage + overshoot, in units of |S|.
    assert!((d - (1.0 - 2.0 * c / (1.0 + c + o))).abs() < 1e-9, "{v}");

    // Mass, centre and inertia of the true ellipsoid at density 2, to the mesh's fineness.
    let (a, b, h) = (1.0, 0.75, 0.5);
    let mass = 2.0 * 4.0 / 3.0 * std::f64::consts::PI * a * b * h;
    assert!((v["mass"].as_f64().unwrap() / mass - 1.0).abs() < 0.01, "{}", v["mass"]);
    let list = |key: &str| -> Vec<f64> {
        v[key].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    assert!(list("centre").iter().all(|x| x.abs() < 1e-9));
    let inertia = list("inertia");
    let expected = [b * b + h * h, a * a + h * h, a * a + b * b].map(|s| mass * s / 5.0);
    for (i, e) in expected.iter().enumerate() {
        assert!((inertia[i] / e - 1.0).abs() < 0.02, "{inertia:?} {expected:?}");
    }
    assert!(inertia[3..].iter().all(|p| p.abs() < 1e-9), "{inertia:?}");
}

#[test]
fn without_a_density_there_is_no_mass_and_without_quality_no_figure() {
    let printed = succeeds(&strs(&clump(&["--json", "--quality", "none"])));
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert!(v.get("mass").is_none() && v["D"].is_null() && v["protrusion"].is_null());
    let printed = succeeds(&strs(&clump(&["--json", "--quality", "overlap"])));
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert!(v["D"].is_f64() && v["protrusion"].is_null() && v["distance_bound"].is_null());
}

#[test]
fn plane_contacts_are_counted_for_any_quality() {
    let counts = |quality: &str| -> Value {
        let tolerances = ["--plane-tolerance", "0.01", "--plane-tolerance", "0.1"];
        let mut all = clump(&["--json", "--quality", quality]);
        all.extend(tolerances.map(str::to_string));
        serde_json::from_str(&succeeds(&strs(&all))).unwrap()
    };
    let full = counts("full");
    let most: Vec<u64> =
        full["plane_contacts"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
    assert!(most.len() == 2 && most[0] >= 1 && most[1] >= most[0], "{most:?}");
    assert!(full["distance_bound"].as_f64().unwrap() >= 0.0);
    assert_eq!(counts("overlap")["plane_contacts"], full["plane_contacts"]);
    let none = counts("none");
    assert_eq!(none["plane_contacts"], full["plane_contacts"]);
    assert!(none["D"].is_null() && none["coverage"].is_null() && none["protrusion"].is_null());
    let v: Value = serde_json::from_str(&succeeds(&strs(&clump(&["--json"])))).unwrap();
    assert!(v["plane_contacts"].is_null());
}

#[test]
fn no_stage_is_timed_twice() {
    let folder = folder("stages");
    let path = folder.join("stone.stl");
    succeeds(&["sample", "stone", "--segments", "200", "-o", text(&path)]);
    let printed = succeeds(&["clump", text(&path), "-n", "5", "--cells", "48", "--json"]);
    let v: Value = serde_json::from_str(&printed).unwrap();
    let stages = v["stages"].as_object().unwrap();
    assert_eq!(stages.len(), 6);
    for (name, seconds) in stages {
        assert!(seconds.as_f64().unwrap() > 0.0, "{name} was not timed: {v}");
    }
    let sum: f64 = stages.values().map(|s| s.as_f64().unwrap()).sum();
    assert!(sum <= v["seconds"].as_f64().unwrap(), "{v}");
}

#[test]
fn every_format_reads_back_the_same_spheres() {
    let folder = folder("formats");
    let expected = spheres_of_csv(&succeeds(&strs(&clump(&[]))));
    for name in ["c.csv", "c.json", "c.vtp", "c.ply", "c.txt"] {
        let path = folder.join(name);
        let said = succeeds(&strs(&clump(&["-o", text(&path)])));
        assert_eq!(said, "", "not silent in a pipe");
    }
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    assert_eq!(spheres_of_csv(&read("c.csv")), expected);
    // An unknown extension is CSV.
    assert_eq!(read("c.txt"), read("c.csv"));

    let json: Value = serde_json::from_str(&read("c.json")).unwrap();
    for (s, e) in json["spheres"].as_array().unwrap().iter().zip(&expected) {
        let s: Vec<f64> = s.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
        assert_eq!(s, e);
    }

    let vtp = read("c.vtp");
    assert!(vtp.contains("NumberOfPoints=\"10\"") && vtp.trim_end().ends_with("</VTKFile>"));
    let array = |name: &str| -> Vec<f64> {
        let at = vtp.find(&format!("Name=\"{name}\"")).unwrap();
        let body = &vtp[at + vtp[at..].find('>').unwrap() + 1..];
        let body = &body[..body.find('<').unwrap()];
        body.split_whitespace().map(|x| x.parse().unwrap()).collect()
    };
    assert_eq!(array("radius"), expected.iter().map(|e| e[3]).collect::<Vec<_>>());
    assert_eq!(array("points"), expected.iter().flat_map(|e| e[..3].to_vec()).collect::<Vec<_>>());

    // The mesh of the first sphere reads back as a ball of its own volume.
    let one = folder.join("one.ply");
    succeeds(&["clump", "sample:sphere", "-n", "1", "--cells", "24", "-o", text(&one), "-q"]);
    let about = succeeds(&["info", text(&one), "--json"]);
    let v: Value = serde_json::from_str(&about).unwrap();
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    assert!((v["volume"].as_f64().unwrap() / ball - 1.0).abs() < 0.05, "{}", v["volume"]);
    assert_eq!(v["report"]["faces"], 1280);
}

#[test]
fn the_body_frame_puts_the_clump_on_its_axes() {
    // A box off the origin, longest along y: the body's first axis (least moment) is y.
    let folder = folder("body");
    let path = folder.join("box.obj");
    let mut obj = String::new();
    for i in 0..8 {
        let at = |bit: usize, size: f64| if i >> bit & 1 == 1 { size } else { 0.0 };
        let (x, y, z) = (10.0 + at(0, 1.0), -20.0 + at(1, 3.0), 5.0 + at(2, 2.0));
        obj += &format!("v {x} {y} {z}\n");
    }
    for f in ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"] {
        obj += &format!("f {f}\n");
    }
    std::fs::write(&path, obj).unwrap();
    let run = |frame: &str| -> Value {
        let printed = succeeds(&[
            "clump",
            text(&path),
            "-n",
            "12",
            "--cells",
            "24",
            "--json",
            "--frame",
            frame,
            "--density",
            "1",
        ]);
        serde_json::from_str(&printed).unwrap()
    };
    let (input, body) = (run("input"), run("body"));
    let rows = |v: &Value| -> Vec<Vec<f64>> {
        let list = v["spheres"].as_array().unwrap().iter();
        list.map(|s| s.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()).collect()
    };
    let centre = [10.5, -18.5, 6.0];
    for (a, b) in rows(&input).iter().zip(rows(&body)) {
        assert_eq!(a[3], b[3]);
        // Principal axes: y, z, x, up to the signs that make a right-handed frame.
        for (i, axis) in [1, 2, 0].into_iter().enumerate() {
            assert!(((a[axis] - centre[axis]).abs() - b[i].abs()).abs() < 1e-9, "{a:?} {b:?}");
        }
    }
    // And back: as the picture of either clump shows.
    let mut pictures = Vec::new();
    for frame in ["input", "body"] {
        let clump = folder.join(format!("{frame}.csv"));
        let png = folder.join(format!("{frame}.png"));
        let grid = ["--cells", "24", "--frame", frame, "-q", "-o"];
        succeeds(&[&["clump", text(&path), "-n", "12"], &grid[..], &[text(&clump)]].concat());
        let size = ["--size", "300x160"];
        succeeds(
            &[&["view", text(&path), text(&clump)], &size[..], &grid[..], &[text(&png)]].concat(),
        );
        pictures.push(pixels(&png).1);
    }
    let differ = pictures[0].iter().zip(&pictures[1]).filter(|(a, b)| a.abs_diff(**b) > 8).count();
    assert!(differ < pictures[0].len() / 500, "{differ} of {}", pictures[0].len());
    assert_eq!(body["centre"], serde_json::json!([0.0, 0.0, 0.0]));
    let moments: Vec<f64> =
        body["inertia"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let expected = [1.0 + 4.0, 1.0 + 9.0, 4.0 + 9.0].map(|s| 6.0 * s / 12.0);
    for (m, e) in moments.iter().zip(expected) {
        assert!((m - e).abs() < 1e-9, "{moments:?}");
    }
}

#[test]
fn info_tells_report_and_moments() {
    let words = succeeds(&["info", "sample:box"]);
    assert!(words.contains("watertight        yes") && words.contains("quaternion"), "{words}");
    let v: Value = serde_json::from_str(&succeeds(&["info", "sample:box,a=2", "--json"])).unwrap();
    assert!((v["volume"].as_f64().unwrap() - 2.0).abs() < 1e-12);
    assert_eq!(v["report"]["watertight"], true);
    assert_eq!(v["quaternion"].as_array().unwrap().len(), 4);
    let scaled = succeeds(&["info", "sample:box", "--json", "--length-unit", "0.5"]);
    let v: Value = serde_json::from_str(&scaled).unwrap();
    assert!((v["volume"].as_f64().unwrap() - 0.125).abs() < 1e-12);
}

/// A version 1.0 .npy file of unsigned bytes in C order.
fn npy(shape: &str, data: &[u8]) -> Vec<u8> {
    let mut header = format!("{{'descr': '|u1', 'fortran_order': False, 'shape': {shape}, }}");
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

#[test]
fn voxels_and_labels_are_read() {
    let folder = folder("voxels");
    let path = folder.join("labels.npy");
    // Two boxes in 10 × 9 × 8 cells (x, y, z): label 1 of 4 × 4 × 4, label 7 at the border.
    let mut data = vec![0u8; 10 * 9 * 8];
    for (z, y, x) in (0..8).flat_map(|z| (0..9).flat_map(move |y| (0..10).map(move |x| (z, y, x))))
    {
        let cell = &mut data[x + 10 * (y + 9 * z)];
        if (1..5).contains(&x) && (2..6).contains(&y) && (3..7).contains(&z) {
            *cell = 1;
        } else if x >= 7 {
            *cell = 7;
        }
    }
    std::fs::write(&path, npy("(8, 9, 10)", &data)).unwrap();
    let printed = succeeds(&["info", text(&path), "--labels", "--json"]);
    let v: Value = serde_json::from_str(&printed).unwrap();
    let labels = v["labels"].as_array().unwrap();
    assert_eq!(labels.len(), 2, "{v}");
    assert_eq!((&labels[0]["label"], &labels[0]["cells"]), (&1.into(), &64.into()));
    assert_eq!(labels[0]["first"], serde_json::json!([1, 2, 3]));
    assert_eq!((&labels[1]["label"], &labels[1]["touches_border"]), (&7.into(), &true.into()));
    let table = succeeds(&["info", text(&path), "--labels"]);
    assert_eq!(table.lines().count(), 3, "{table}");

    let printed = succeeds(&["info", text(&path), "--label", "1", "--spacing", "1,2,3", "--json"]);
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert!((v["volume"].as_f64().unwrap() - 64.0 * 6.0).abs() < 1e-9, "{v}");
    let raw = folder.join("mask.raw");
    std::fs::write(&raw, &data).unwrap();
    let printed = succeeds(&[
        "info",
        text(&raw),
        "--raw",
        "10x9x8:u8",
        "--threshold",
        "0",
        "--bodies",
        "all",
        "--json",
    ]);
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(v["report"]["solid_cells"], 64 + 3 * 9 * 8);
}

#[test]
fn samples_read_back_in_every_format() {
    let folder = folder("samples");
    let list = succeeds(&["sample", "--list"]);
    for name in ["tablet", "mandm", "stone", "ellipsoid"] {
        assert!(list.lines().any(|l| l.starts_with(name)), "{list}");
    }
    let mut volumes = Vec::new();
    for file in ["t.stl", "t.ply", "t.off", "t.obj"] {
        let path = folder.join(file);
        let said = succeeds(&["sample", "tablet", "--segments", "48", "-o", text(&path)]);
        assert_eq!(said, "", "not silent in a pipe");
        let v: Value = serde_json::from_str(&succeeds(&["info", text(&path), "--json"])).unwrap();
        assert_eq!(v["report"]["watertight"], true, "{file}");
        volumes.push(v["volume"].as_f64().unwrap());
    }
    for v in &volumes {
        assert!((v / volumes[0] - 1.0).abs() < 1e-6, "{volumes:?}");
        assert!((v / 531.104 - 1.0).abs() < 0.01, "{volumes:?}");
    }
    let stone = |seed: &str, file: &str| {
        let path = folder.join(file);
        succeeds(&["sample", "stone", "--seed", seed, "-o", text(&path), "-q"]);
        std::fs::read(path).unwrap()
    };
    assert_eq!(stone("7", "a.ply"), stone("7", "b.ply"));
    assert_ne!(stone("7", "a.ply"), stone("8", "c.ply"));
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

#[test]
fn pictures_have_their_size_and_show_something() {
    let folder = folder("pictures");
    let csv = folder.join("c.csv");
    succeeds(&strs(&clump(&["-o", text(&csv), "-q"])));
    let png = folder.join("p.png");
    succeeds(&[
        "view",
        "sample:ellipsoid",
        text(&csv),
        "-o",
        text(&png),
        "--size",
        "600x260",
        "--cells",
        "24",
        "--azimuth",
        "-30",
        "--elevation",
        "40",
    ]);
    let (size, pixels) = pixels(&png);
    assert_eq!(size, (600, 260));
    assert_eq!(pixels.len(), 3 * 600 * 260);
    // Each third of the picture holds dark, coloured and white pixels.
    for third in 0..3 {
        let (mut white, mut other) = (0, 0);
        for (i, p) in pixels.chunks_exact(3).enumerate() {
            if i % 600 / 200 == third {
                if p == [255, 255, 255] { white += 1 } else { other += 1 }
            }
        }
        assert!(white > 2000 && other > 2000, "third {third}: {white} white, {other} other");
    }
    // JSON clumps are drawn as well, and the same.
    let json = folder.join("c.json");
    succeeds(&strs(&clump(&["-o", text(&json), "-q"])));
    let again = folder.join("again.png");
    succeeds(&[
        "view",
        "sample:ellipsoid",
        text(&json),
        "-o",
        text(&again),
        "--size",
        "600x260",
        "--cells",
        "24",
        "--azimuth",
        "-30",
        "--elevation",
        "40",
        "--threads",
        "1",
    ]);
    assert_eq!(std::fs::read(png).unwrap(), std::fs::read(again).unwrap());
}

#[test]
fn errors_are_one_sentence_with_a_status_and_name_the_file() {
    let folder = folder("errors");
    let missing = folder.join("missing.stl");
    let said = fails(&["clump", text(&missing)], 1);
    assert!(said.contains("missing.stl") && said.contains("[IO]"), "{said}");
    let open = folder.join("open.off");
    std::fs::write(&open, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").unwrap();
    let said = fails(&["info", text(&open)], 1);
    assert!(said.contains("open.off") && said.contains('['), "{said}");
    let rubbish = folder.join("rubbish.ply");
    std::fs::write(&rubbish, "ply\nformat ascii 1.0\nelement vertex 99999999999\n").unwrap();
    let said = fails(&["clump", text(&rubbish), "--json"], 1);
    assert!(said.contains("rubbish.ply"), "{said}");
    let broken = folder.join("broken.csv");
    std::fs::write(&broken, "x,y,z,r\n1,2,3,4\n1,2,oops,4\n").unwrap();
    let picture = folder.join("p.png");
    let said = fails(&["view", "sample:box", text(&broken), "-o", text(&picture)], 1);
    assert!(said.contains("broken.csv") && said.contains("line 3"), "{said}");
    assert!(!picture.exists());
    let nowhere = folder.join("no/such/folder/out.csv");
    let said = fails(&strs(&clump(&["-o", text(&nowhere)])), 1);
    assert!(said.contains("out.csv"), "{said}");
    fails(&["sample", "dodecahedron", "-o", text(&folder.join("d.stl"))], 1);
    fails(&["sample", "box", "--set", "colour=3", "-o", text(&folder.join("d.stl"))], 1);
    fails(&["clump", "sample:box", "--memory-limit", "10KiB"], 1);
}

#[test]
fn wrong_usage_is_2() {
    for arguments in [
        &["clump"][..],
        &["clamp", "sample:box"],
        &["clump", "sample:box", "--cells", "0"],
        &["clump", "sample:box", "--cells", "64", "--cell-size", "0.1"],
        &["clump", "sample:box", "--density", "-1"],
        &["clump", "sample:box", "--mismatch", "nan"],
        &["clump", "sample:box", "--json", "-o", "-"],
        &["clump", "sample:box", "--threshold", "bright"],
        &["clump", "sample:box", "--format", "docx"],
        &["clump", "sample:box,a", "-n", "3"],
        &["clump", "sample:box", "-n", "0"],
        &["info", "sample:box", "--spacing", "1,2"],
        &["sample", "box"],
        &["sample", "stone", "--seed", "9007199254740993", "-o", "s.stl"],
        &["sample", "box", "-o", "box.step"],
        &["view", "sample:box"],
        &["view", "sample:box", "c.csv", "-o", "p.png", "--size", "9x9"],
    ] {
        if arguments.contains(&"bright") {
            fails(&["clump", "x.npy", "--threshold", "bright"], 2);
        } else {
            fails(arguments, 2);
        }
    }
}

#[test]
fn help_and_version_succeed() {
    assert!(succeeds(&["--version"]).starts_with("morula 0."));
    for arguments in [&["--help"][..], &["clump", "--help"], &["view", "--help"]] {
        assert!(succeeds(arguments).contains("Usage"), "{arguments:?}");
    }
    assert_eq!(morula(&[]).status.code(), Some(2));
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_morula"))
        .args(["clump", "sample:ellipsoid", "-n", "10", "--cells", "24"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(stderr(&output), "");
}

#[test]
fn a_deadline_and_a_mismatch_stop_with_spheres() {
    let printed = succeeds(&strs(&clump(&["--json", "--deadline", "0"])));
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(v["stopped"], "deadline", "{v}");
    assert!(v["n"].as_u64().unwrap() >= 1);
    // Alone, it leaves the default number; with -n 0 it is the only criterion.
    let about = |extra: &[&str]| -> Value {
        let mut all = vec!["clump", "sample:ellipsoid", "--cells", "24", "--json"];
        all.extend(extra);
        serde_json::from_str(&succeeds(&all)).unwrap()
    };
    let v = about(&["--deadline", "1000"]);
    assert_eq!((&v["n"], &v["stopped"]), (&50.into(), &"spheres".into()));
    let v = about(&["-n", "0", "--deadline", "0"]);
    assert_eq!(v["stopped"], "deadline", "{v}");
    assert!(v["n"].as_u64().unwrap() >= 1);
    let printed =
        succeeds(&["clump", "sample:ellipsoid", "--cells", "24", "--mismatch", "0.2", "--json"]);
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(v["stopped"], "mismatch", "{v}");
}
