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
