//! `morula simulate` and `morula converge`.

use super::*;

const BALL: &str = r#"
title = "A ball bounces"
[run]
end = 0.05
[effects]
gravity = [0, 0, -9.81]
normal = "linear"
damping = "contact"
[materials.steel]
stiffness = 1e4
restitution = 0.6
[templates.ball]
ball = 0.01
density = 2500
material = "steel"
[[walls]]
plane = { normal = [0, 0, 1], offset = 0 }
material = "steel"
[[bodies]]
template = "ball"
position = [0, 0, 0.0101]
velocity = [0, 0, -1]
[output]
every = 1e-3
frames = 2e-2
checkpoint = 1e-2
average = 0.02
measures = ["time", "vz:0", "top"]
"#;

fn written(name: &str) -> (PathBuf, String) {
    let folder = folder(name);
    let scene = folder.join("ball.toml");
    std::fs::write(&scene, BALL).unwrap();
    let scene = text(&scene).to_owned();
    (folder, scene)
}

#[test]
fn a_run_that_was_cut_short_goes_on_to_the_same_bytes() {
    let (folder, scene) = written("simulate");
    let (whole, cut) = (folder.join("whole"), folder.join("cut"));
    let said = succeeds(&["simulate", &scene, "-o", text(&whole)]);
    for words in
        ["A ball bounces", "1 body of 1 sphere", "up to the end at 0.05", "means from 0.02 on"]
    {
        assert!(said.contains(words), "{words} is not in {said}");
    }
    succeeds(&["simulate", &scene, "-o", text(&cut), "--set", "run.end=0.023", "-q"]);
    succeeds(&["simulate", &scene, "-o", text(&cut), "--resume", "-q"]);
    for file in ["measures.csv", "checkpoint.bin", "frame_000002.vtp"] {
        let read = |folder: &Path| std::fs::read(folder.join(file)).unwrap();
        // The line that a shorter run ends with is one of its own.
        assert!(read(&whole) == read(&cut), "{file} differs");
    }
}

#[test]
fn values_are_taken_until_the_measure_settles() {
    let (folder, scene) = written("converge");
    let out = folder.join("out");
    let over = "run.step=1e-5,9e-6,8e-6,7e-6";
    let base = ["converge", &scene, "--measure", "top", "--over", over, "-o", text(&out)];
    let said = succeeds(&base);
    assert!(said.contains("settled: from 1e-5 to 9e-6") && !said.contains("8e-6 "), "{said}");
    let all = succeeds(&[&base[..], &["--all"]].concat());
    let lines: Vec<&str> = all.lines().collect();
    assert_eq!(lines.len(), 6, "{all}");
    let table = std::fs::read_to_string(out.join("converge.csv")).unwrap();
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|l| l.split(',').map(|v| v.parse().unwrap_or(-1.0)).collect())
        .collect();
    assert_eq!(rows.len(), 4);
    // What is told is the mean of the lines from 0.02 on.
    let lines = std::fs::read_to_string(out.join("1e_5_seed1/measures.csv")).unwrap();
    let tops: Vec<f64> = lines
        .lines()
        .skip(1)
        .map(|l| l.split(',').map(|v| v.parse::<f64>().unwrap()).collect::<Vec<_>>())
        .filter(|l| l[0] >= 0.02)
        .map(|l| l[2])
        .collect();
    let mean = tops.iter().sum::<f64>() / tops.len() as f64;
    assert!((rows[0][1] - mean).abs() < 1e-15 && rows[0][2] > 0.0, "{rows:?} {mean}");
    // Without a mean no error is known, and nothing settles.
    let lone = ["converge", &scene, "--measure", "top", "--over", "run.step=1e-5,9e-6", "--set"];
    let said = succeeds(&[&lone[..], &["output.average=0.049"]].concat());
    assert!(said.contains("not settled: no error is known") || said.contains("settled"), "{said}");
}

#[test]
fn what_cannot_be_converged_is_said() {
    let (_, scene) = written("converge-bad");
    let base = ["converge", &scene, "--measure"];
    let said = fails(&[&base[..], &["angle", "--over", "run.seed=1"]].concat(), 1);
    assert!(said.contains("does not measure angle") && said.contains("time, vz:0, top"), "{said}");
    let said = fails(&[&base[..], &["top", "--over", "run.seed=1,,2"]].concat(), 2);
    assert!(said.contains("an empty value"), "{said}");
    fails(&[&base[..], &["top", "--over", "n"]].concat(), 2);
}
