//! `morula clump`.

use super::*;

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

/// Scripts read these keys: none may go, and none comes unnoticed.
#[test]
fn the_keys_of_json_are_these() {
    let figures = "n D coverage overshoot protrusion seconds stopped spheres input eta iou \
         error_bound union_volume volume_error centroid_error moment_errors inertia_error \
         inertia_error_of_coverage rms_distance hausdorff \
         distance_bound roughness never_exposed asymmetry symmetry_planes plane_contacts note notes \
         warnings volume \
         equivalent_diameter cells frame position quaternion stages peak_bytes";
    let folder = folder("keys");
    let file = folder.join("c.csv");
    let keys = |extra: &[&str]| -> Vec<String> {
        let v: Value = serde_json::from_str(&succeeds(&strs(&clump(extra)))).unwrap();
        let mut keys: Vec<String> = v.as_object().unwrap().keys().cloned().collect();
        keys.sort();
        keys
    };
    let expected = |all: String| {
        let mut all: Vec<String> = all.split_whitespace().map(str::to_string).collect();
        all.sort();
        all
    };
    assert_eq!(keys(&["--json"]), expected(figures.into()));
    let masses = ["--json", "--density", "2"];
    assert_eq!(
        keys(&masses),
        expected(format!(
            "{figures} density mass centre inertia principal_moments masses mass_status \
             mass_residual centre_residual inertia_residual mass_spread min_mass largest_min_mass binding"
        ))
    );
    // The spheres go where they are asked to go, once.
    let summary = keys(&["--json", "-o", text(&file)]);
    assert_eq!(summary, expected(figures.replace("spheres ", "")));
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

#[test]
fn surface_fit_finds_its_own_number() {
    let fit = |more: &[&str]| {
        let fixed = ["clump", "sample:stone", "--method", "surface-fit", "--json", "--quality"];
        let args: Vec<&str> = [&fixed[..], &["none", "--threads", "1"], more].concat();
        serde_json::from_str::<Value>(&succeeds(&args)).unwrap()
    };
    let free = fit(&[]);
    let n = free["n"].as_u64().unwrap();
    assert!((4..40).contains(&n) && free["stopped"] == "exhausted", "{free}");
    assert_eq!(fit(&["-n", "0"])["spheres"], free["spheres"]);
    let three = fit(&["-n", "3"]);
    assert!(three["n"] == 3 && three["stopped"] == "spheres", "{three}");
}

#[test]
fn a_coverage_ends_the_set_cover() {
    let printed = succeeds(&strs(&[
        "clump".into(),
        "sample:ellipsoid".into(),
        "--method=cover".into(),
        "--coverage=0.85".into(),
        "--thinning-cells=24".into(),
        "--cells-inside=20".into(),
        "--candidates=analytic".into(),
        "--quality=overlap".into(),
        "--json".into(),
    ]));
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(v["stopped"], "coverage");
    assert!(
        v["coverage"].as_f64().unwrap() > 0.83 && v["overshoot"].as_f64().unwrap() < 1e-3,
        "{v}"
    );
}

#[test]
fn demands_on_clumps_are_kept() {
    let make = |extra: &[&str]| -> Value {
        let all = [&["clump", "sample:stone", "-n", "15", "--method", "best", "--json"], extra];
        serde_json::from_str(&succeeds(&all.concat())).unwrap()
    };
    let free = make(&[]);
    let v = make(&["--max-protrusion", "0.01"]);
    assert!(v["protrusion"].as_f64().unwrap() <= 0.01 * (1.0 + 1e-9), "{}", v["protrusion"]);
    assert!(free["protrusion"].as_f64().unwrap() > 0.02, "{}", free["protrusion"]);
    let v =
        make(&["--half-space", "0,0,2,0.3", "--half-space", "-3,4,0,1.5", "--max-radius", "0.2"]);
    for s in v["spheres"].as_array().unwrap() {
        let s: Vec<f64> = s.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
        assert!(s[2] + s[3] <= 0.15 + 1e-12 && s[3] <= 0.2, "{s:?}");
        assert!((4.0 * s[1] - 3.0 * s[0]) / 5.0 + s[3] <= 0.3 + 1e-12, "{s:?}");
    }
    let v = make(&["--equal-volume"]);
    assert!(v["volume_error"].as_f64().unwrap().abs() < 2e-4, "{}", v["volume_error"]);
    let v = make(&["--overshoot-weight", "5"]);
    let overshoot = |v: &Value| v["overshoot"].as_f64().unwrap();
    assert!(overshoot(&v) < 0.5 * overshoot(&free), "{} {}", v["overshoot"], free["overshoot"]);
    let v = make(&["--smoothness", "1"]);
    let rms = |v: &Value| v["rms_distance"].as_f64().unwrap();
    assert!(rms(&v) < rms(&free), "{} {}", v["rms_distance"], free["rms_distance"]);
    let said = fails(&["clump", "sample:stone", "--half-space", "0,0,1,-9"], 1);
    assert!(said.contains("half-spaces leave nothing"), "{said}");
}
