//! Densities, `morula measure` and `morula export`.

use super::*;

const STONE: &str = "sample:stone";

fn list(v: &Value) -> Vec<f64> {
    v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

#[test]
fn a_density_gives_each_sphere_a_mass_and_they_add_up_to_the_body() {
    let folder = folder("masses");
    let csv = folder.join("stone.csv");
    let printed = succeeds(&[
        "clump",
        STONE,
        "-n",
        "40",
        "--effort",
        "draft",
        "--density",
        "2500",
        "--quality",
        "none",
        "--json",
        "-o",
        text(&csv),
    ]);
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(v["mass_status"], "exact");
    let (masses, centre, inertia) = (list(&v["masses"]), list(&v["centre"]), list(&v["inertia"]));
    let written = std::fs::read_to_string(&csv).unwrap();
    let mut lines = written.lines();
    assert_eq!(lines.next(), Some("x,y,z,r,mass"));
    let rows: Vec<Vec<f64>> =
        lines.map(|l| l.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    assert_eq!(rows.iter().map(|r| r[4]).collect::<Vec<_>>(), masses);
    let mass = v["mass"].as_f64().unwrap();
    assert!((masses.iter().sum::<f64>() / mass - 1.0).abs() < 1e-12);
    let mut sum = [0.0; 6];
    for r in &rows {
        let d = [0, 1, 2].map(|k| r[k] - centre[k]);
        let own = 0.4 * r[3] * r[3] + d.iter().map(|x| x * x).sum::<f64>();
        let each = [
            own - d[0] * d[0],
            own - d[1] * d[1],
            own - d[2] * d[2],
            -d[0] * d[1],
            -d[0] * d[2],
            -d[1] * d[2],
        ];
        sum.iter_mut().zip(each).for_each(|(s, e)| *s += r[4] * e);
    }
    for k in 0..6 {
        assert!((sum[k] - inertia[k]).abs() < 1e-9 * inertia[0], "{k}: {sum:?} {inertia:?}");
    }
    // Other wishes, other masses; the same sums.
    let wished = |wish: &str| {
        let words = ["clump", STONE, "-n", "40", "--effort", "draft", "--density", "2500"];
        let more = ["--quality", "none", "--json", "--masses", wish];
        let v: Value = serde_json::from_str(&succeeds(&[&words[..], &more[..]].concat())).unwrap();
        list(&v["masses"])
    };
    let least = |m: &[f64]| m.iter().copied().fold(f64::MAX, f64::min);
    let raised = wished("max_min");
    assert!(least(&raised) > least(&masses));
    assert!(wished("max_last")[39] > raised[39]);
    let none = succeeds(&["clump", STONE, "-n", "5", "--density", "1", "--masses", "none"]);
    assert!(none.starts_with("x,y,z,r\n"));
}

#[test]
fn masses_that_cannot_be_are_refused_in_a_sentence() {
    // One sphere is never where the centre of a stone is.
    let one = ["clump", STONE, "-n", "1", "--density", "2500"];
    let said = fails(&one, 1);
    assert!(said.contains("--least-error") && said.contains("NO_MASSES"), "{said}");
    let kept = succeeds(&[&one[..], &["--least-error", "--json"]].concat());
    let v: Value = serde_json::from_str(&kept).unwrap();
    assert_eq!(v["mass_status"], "mass_only");
    assert!((list(&v["masses"])[0] / v["mass"].as_f64().unwrap() - 1.0).abs() < 1e-12);
    for option in [["--masses", "even"], ["--min-mass", "1"], ["--target", "union"]] {
        let said = fails(&[&["clump", STONE][..], &option[..]].concat(), 2);
        assert!(said.contains("--density"), "{said}");
    }
    let much = ["clump", STONE, "-n", "10", "--density", "1", "--min-mass", "1"];
    assert!(fails(&much, 1).contains("INVALID_ARGUMENT"));
}

#[test]
fn the_union_may_be_what_is_weighed() {
    let words = ["clump", STONE, "-n", "40", "--effort", "draft", "--density", "2500", "--json"];
    let v: Value =
        serde_json::from_str(&succeeds(&[&words[..], &["--target", "union"]].concat())).unwrap();
    let mass = v["mass"].as_f64().unwrap();
    let union = 2500.0 * v["union_volume"].as_f64().unwrap();
    // Columns against arcs.
    assert!((mass / union - 1.0).abs() < 1e-3, "{mass} {union}");
    assert!((mass / (2500.0 * v["volume"].as_f64().unwrap()) - 1.0).abs() > 1e-6);
    assert_eq!(v["mass_status"], "exact");
    // What the union lacks of the stone's inertia stands beside what its coverage alone would.
    let stone: Value = serde_json::from_str(&succeeds(&words)).unwrap();
    let trace = |v: &Value| list(&v["inertia"])[..3].iter().sum::<f64>();
    let lacking = 1.0 - trace(&v) / trace(&stone);
    assert!(lacking > 1e-3 && (stone["inertia_error"].as_f64().unwrap() - lacking).abs() < 1e-9);
    let rule = 1.0 - stone["coverage"].as_f64().unwrap().powf(5.0 / 3.0);
    assert!((stone["inertia_error_of_coverage"].as_f64().unwrap() - rule).abs() < 1e-12);
}

#[test]
fn clumps_are_exported_and_measured_again() {
    let folder = folder("export");
    let csv = folder.join("stone.csv");
    succeeds(&["clump", STONE, "-n", "30", "--effort", "draft", "-o", text(&csv)]);
    let measure = |path: &Path| -> Value {
        let words = ["measure", text(path), "--target", STONE, "--json"];
        serde_json::from_str(&succeeds(&words)).unwrap()
    };
    let first = measure(&csv);
    assert_eq!(first["n"], 30);
    let formats = [
        "mercury",
        "lammps",
        "lammps-rigid",
        "liggghts",
        "yade",
        "deme",
        "mfix",
        "kratos",
        "pfc",
        "edem",
        "csv",
        "json",
        "vtp",
        "ply",
        "stl",
    ];
    for to in formats {
        let out = folder.join(to);
        let words = ["export", text(&csv), "--target", STONE, "--density", "2500", "--to", to];
        assert_eq!(succeeds(&[&words[..], &["-o", text(&out)]].concat()), "", "{to}");
        assert!(out.exists(), "{to}");
    }
    assert!(folder.join("liggghts.in").exists() && folder.join("mercury/Clump/Clump.txt").exists());
    // Files that say that they are in the frame of the body are brought back.
    for to in ["mercury", "kratos", "json"] {
        let again = measure(&folder.join(to));
        for key in ["D", "coverage", "protrusion"] {
            let (a, b) = (first[key].as_f64().unwrap(), again[key].as_f64().unwrap());
            assert!((a / b - 1.0).abs() < 1e-3, "{to} {key}: {a} {b}");
        }
    }
    let lammps = folder.join("lammps");
    let words = ["measure", text(&lammps), "--json", "--density", "2500"];
    let alone: Value = serde_json::from_str(&succeeds(&words)).unwrap();
    let volume = first["union_volume"].as_f64().unwrap();
    assert!((alone["union_volume"].as_f64().unwrap() / volume - 1.0).abs() < 1e-9);
    assert!((alone["mass"].as_f64().unwrap() / (2500.0 * volume) - 1.0).abs() < 1e-9);
    let table = succeeds(&["measure", text(&lammps)]);
    assert!(table.contains("30 spheres") && table.contains("volume of their union"), "{table}");
}

/// Files that may not grow as they must are as a disk that is full half-way.
#[cfg(unix)]
#[test]
fn a_disk_that_fills_leaves_what_was_there() {
    let folder = folder("full");
    let csv = folder.join("stone.csv");
    succeeds(&["clump", STONE, "-n", "12", "--effort", "draft", "-o", text(&csv)]);
    let out = folder.join("out.stl");
    let within = |words: &[&str]| {
        let limited = "ulimit -f 16; trap '' XFSZ; exec \"$0\" \"$@\"";
        let mut command = Command::new("sh");
        command.args(["-c", limited, env!("CARGO_BIN_EXE_morula")]).args(words);
        command.stdin(Stdio::null()).output().unwrap()
    };
    let ply = folder.join("out.ply");
    for (path, words) in [
        (&out, vec!["export", text(&csv), "--density", "1", "--to", "stl", "-o", text(&out)]),
        (&ply, vec!["clump", STONE, "-n", "12", "--effort", "draft", "-o", text(&ply)]),
    ] {
        std::fs::write(path, "what was there").unwrap();
        let output = within(&words);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        assert!(stderr(&output).contains("[IO]"), "{}", stderr(&output));
        assert_eq!(std::fs::read_to_string(path).unwrap(), "what was there");
        // Without the limit they are written.
        succeeds(&words);
        assert!(std::fs::metadata(path).unwrap().len() > 100_000);
    }
    let mut left: Vec<_> =
        std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name()).collect();
    left.sort();
    assert_eq!(left, ["out.ply", "out.stl", "stone.csv"]);
}

#[test]
fn exports_and_measures_that_make_no_sense_are_refused() {
    let folder = folder("export-bad");
    let csv = folder.join("stone.csv");
    succeeds(&["clump", STONE, "-n", "12", "--effort", "draft", "-o", text(&csv)]);
    let out = folder.join("out");
    let export = |more: &[&str], code: i32| {
        let words = ["export", text(&csv), "--density", "2500", "-o", text(&out)];
        let said = fails(&[&words[..], more].concat(), code);
        assert!(!out.exists(), "{more:?}");
        said
    };
    assert!(export(&["--to", "mercury", "--placed"], 1).contains("mercury"));
    export(&["--to", "nothing"], 2);
    export(&["--to", "csv", "--masses", "none"], 2);
    export(&["--to", "csv", "--cells", "32"], 2);
    export(&["--to", "csv", "--spacing", "2"], 2);
    export(&["--to", "stl", "--facets", "9"], 1);
    let over = ["export", text(&csv), "--density", "1", "--to", "csv", "-o", text(&csv)];
    assert!(fails(&over, 2).contains("overwritten"));
    let nowhere = folder.join("none/out.csv");
    let words = ["export", text(&csv), "--density", "1", "--to", "csv", "-o", text(&nowhere)];
    assert!(fails(&words, 1).contains("IO"));
    let broken = folder.join("broken.csv");
    std::fs::write(&broken, "x,y,z,r\n1,2,3,4\n1,2,oops,4\n").unwrap();
    assert!(fails(&["measure", text(&broken)], 1).contains("line 3"));
    fails(&["measure", text(&csv), "--columns", "64"], 2);
    fails(&["measure", text(&csv), "--label", "1"], 2);
}
