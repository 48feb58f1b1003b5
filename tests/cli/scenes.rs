//! `morula simulate` with scenes that are many runs.

use super::*;
use std::collections::BTreeMap;

fn scene(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    text(&path).to_owned()
}

/// The rows of a table by its columns.
fn table(path: &Path) -> Vec<BTreeMap<String, String>> {
    let csv = std::fs::read_to_string(path).unwrap();
    let mut lines = csv.lines().map(|l| l.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    lines.map(|l| head.iter().cloned().zip(l).collect()).collect()
}

fn number(row: &BTreeMap<String, String>, key: &str) -> f64 {
    row[key].parse().unwrap_or_else(|_| panic!("{key} of {row:?}"))
}

#[test]
fn a_tablet_rebounds_the_better_the_more_spheres_it_has() {
    let folder = folder("tablet");
    succeeds(&["simulate", &scene("tablet_wall.toml"), "--quick", "-o", text(&folder)]);
    let rows = table(&folder.join("sweep.csv"));
    assert_eq!(rows.len(), 8);
    let of = |method: &str, n: &str| {
        let found = rows
            .iter()
            .find(|r| r["method"] == method && r["spheres"] == n && r["averaging"] == "true");
        found.unwrap()
    };
    for row in &rows {
        // The tablet itself in the same hands.
        assert!(number(row, "floor_v") < 0.006 && number(row, "floor_w") < 0.006, "{row:?}");
        assert!(number(row, "worst_v") >= number(row, "rms_v") - 1e-12, "{row:?}");
        assert!(number(row, "rms_v") < 0.24 && number(row, "rms_w") < 0.45, "{row:?}");
    }
    let (few, more) = (of("best", "10"), of("best", "30"));
    assert!(number(more, "rms_v") < 0.9 * number(few, "rms_v"), "{few:?} {more:?}");
    assert!(number(more, "rms_v") < number(of("mss", "30"), "rms_v"), "{rows:?}");
    // 8 runs of 20 tilts and 12 azimuths.
    assert_eq!(table(&folder.join("impacts.csv")).len(), 1920);
}

#[test]
fn throws_and_sweeps_that_cannot_be_are_refused() {
    let tablet = scene("tablet_wall.toml");
    let says = |set: &str, words: &str| {
        let said = fails(&["simulate", &tablet, "--quick", "--set", set], 1);
        assert!(said.contains(words), "{set}: {said}");
    };
    says("bodies.0.velocity=[0,0,1]", "does not lead there");
    says("impacts.tilts=[0,181]", "impacts.tilts has 181");
    says("impacts.poses=3", "tilts or poses, one of them");
    says("impacts.compare=[\"tilt\"]", "impacts.compare names tilt");
    says("templates.tablet.shape=cylinder", "cylinder");
    says("sweep.0.values=[]", "sweep 0 needs a path");
    says("sweep.0.values=[\"bets\"]", "unknown choice bets; the nearest is best");
    says("walls.0.plane.normal=[0,0,0]", "normal");
    fails(&["simulate", &tablet, "--quick", "--resume", "-o", "x"], 2);
}

#[test]
fn scenes_that_have_run_stand_on_one_page() {
    let folder = folder("scenes");
    let run = |name: &str| {
        let out = folder.join(name);
        let only = ["--only", "contact", "--only", "plate"];
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        let first = ["scenes", text(&scenes), "--quick", "-o", text(&out)];
        succeeds(&[&first[..], &only].concat());
        out
    };
    let (a, b) = (run("a"), run("b"));
    let read = |p: &Path, name: &str| std::fs::read_to_string(p.join(name)).unwrap();
    let page = read(&a, "index.md");
    let line = |start: &str| page.lines().find(|l| l.starts_with(start)).unwrap().to_owned();
    assert!(line("| contact | rebound of a ball | 0.600 asked | ").contains("| yes | 1 |"));
    assert!(line("| plate | rebound, 4 contacts averaged").contains("| yes | 100 |"));
    // What the quick variant does not run is not claimed.
    assert!(!page.contains("3600 contacts") && page.contains("![plate](plate.svg)"), "{page}");
    let svg = read(&a, "plate.svg");
    assert!(svg.starts_with("<svg") && svg.contains("step_part") && svg.contains("plain"), "{svg}");
    // All but the times is the same.
    for name in ["contact.csv", "plate.svg"] {
        assert_eq!(read(&a, name), read(&b, name), "{name}");
    }
    for row in table(&a.join("plate.csv")) {
        let (e, part) = (number(&row, "vz:0"), number(&row, "step_part"));
        let n = number(&row, "contacts");
        match row["sum"].as_str() {
            "averaged" if part <= 0.05 => assert!((e - 0.6).abs() < 0.005, "{row:?}"),
            "averaged" => assert!((e - 0.6).abs() < 0.02, "{row:?}"),
            // Four contacts damp the plate four times as much.
            _ => assert!(if n == 4.0 { e < 0.5 } else { (e - 0.6).abs() > 0.3 }, "{row:?}"),
        }
    }
    // How the effects share the time, where that is asked for.
    assert!(!page.contains("Where the time"), "{page}");
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let out = folder.join("c");
    succeeds(&[
        "scenes",
        text(&scenes),
        "--quick",
        "--only",
        "contact",
        "--shares",
        "-o",
        text(&out),
    ]);
    let page = read(&out, "index.md");
    assert!(page.contains("| scene | damping | normal | bodies |"), "{page}");
    assert!(read(&out, "shares.svg").contains("damping"));
    fails(&["scenes", text(&folder), "-o", text(&folder)], 2);
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let said = fails(&["scenes", text(&scenes), "--only", "plat", "-o", text(&folder)], 2);
    assert!(said.contains("there is no scene plat"), "{said}");
}

#[test]
fn stones_are_told_how_far_they_are_from_finer_ones_and_from_another_law() {
    let folder = folder("stones");
    succeeds(&["simulate", &scene("stone_plate.toml"), "--quick", "-o", text(&folder)]);
    let rows = table(&folder.join("sweep.csv"));
    assert_eq!(rows.len(), 24);
    for row in &rows {
        let last = row["spheres"] == "30";
        assert_eq!(number(row, "dv_spheres") == 0.0, last, "{row:?}");
        assert_eq!(number(row, "dv_law") == 0.0, row["law"] == "no-slip", "{row:?}");
        // No throw comes back faster than it went.
        assert!((0.0..1.0).contains(&number(row, "speed")), "{row:?}");
    }
}

#[test]
fn bodies_may_be_given_spheres() {
    let folder = folder("given");
    let csv = folder.join("two.csv");
    std::fs::write(&csv, "x,y,z,r\n-1,0,0,1\n1,0,0,1\n").unwrap();
    let toml = folder.join("two.toml");
    let scene = "title = \"two\"\n[run]\nend = 1.0\nstep = 0.01\n[templates.two]\nspheres_file = \"two.csv\"\n\
        scale = 0.5\ndensity = 3.0\nmaterial = \"m\"\n[materials.m]\n[[bodies]]\ntemplate = \"two\"\n\
        position = [0, 0, 0]\nvelocity = [1, 0, 0]\n[output]\nmeasures = [\"translation\", \"x:0\"]\n";
    std::fs::write(&toml, scene).unwrap();
    succeeds(&["simulate", text(&toml), "-o", text(&folder)]);
    let rows = table(&folder.join("measures.csv"));
    let mass = 3.0 * 2.0 * 4.0 / 3.0 * std::f64::consts::PI / 8.0;
    assert!((number(&rows[0], "translation") / (0.5 * mass) - 1.0).abs() < 1e-6, "{rows:?}");
    let says = |from: &str, to: &str, words: &str| {
        std::fs::write(&toml, scene.replace(from, to)).unwrap();
        let said = fails(&["simulate", text(&toml)], 1);
        assert!(said.contains(words), "{to}: {said}");
    };
    let file = "spheres_file = \"two.csv\"";
    says(file, "spheres_file = \"three.csv\"", "three.csv");
    says(file, "grid = { count = [0, 1], spacing = 1, radius = 1 }", "grid.count is 0 by 1");
    says(file, "grid = { count = [1, 1], spacing = 0, radius = 1 }", "grid.spacing is 0");
    says(
        file,
        "grid = { count = [1, 1], spaces = 1, radius = 1 }",
        "unknown key spaces; the nearest is spacing",
    );
    says(file, &format!("{file}\nshape = \"box\""), "needs one of ball, shape, file");
    says(file, "shape = \"box\"\nstretch = [1, 0, 1]", "stretch has 0");
    says(file, "shape = \"stone\"\ninertia = \"exact\"", "no formulas for its inertia");
}
