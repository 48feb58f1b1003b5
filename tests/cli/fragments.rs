//! `morula break`.

use super::*;

const STONE: &str = "sample:stone,seed=7";

fn vector(v: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| v[i].as_f64().unwrap())
}

/// Broken into a folder, with what `fragments.json` holds.
fn breaks(to: &Path, input: &str, more: &[&str]) -> Value {
    let words = ["break", input, "-N", "20", "-n", "6", "--cells", "32", "-o", text(to)];
    let words: Vec<&str> = match input.ends_with(".raw") {
        true => words.iter().filter(|w| !["--cells", "32"].contains(*w)).copied().collect(),
        false => words.to_vec(),
    };
    assert_eq!(succeeds(&[&words[..], more].concat()), "");
    serde_json::from_str(&std::fs::read_to_string(to.join("fragments.json")).unwrap()).unwrap()
}

/// Rows of a file of numbers under a header.
fn numbers(path: &Path) -> (String, Vec<Vec<f64>>) {
    let csv = std::fs::read_to_string(path).unwrap();
    let (header, rows) = csv.split_once('\n').unwrap();
    let row = |l: &str| l.split(',').map(|x| x.parse().unwrap()).collect();
    (header.into(), rows.lines().map(row).collect())
}

#[test]
fn a_stone_breaks_into_files_and_nothing_is_lost() {
    let out = folder("break").join("out");
    let moves = ["--velocity", "1,0,-2", "--angular-velocity", "0,3,-1", "--density", "2650"];
    let more = [&["--voronoi", "5", "--seed", "3", "--gap", "0.001"], &moves[..]].concat();
    let v = breaks(&out, STONE, &[&more[..], &["--size", "400x220"]].concat());
    assert_eq!(
        (&v["cut"], &v["seed"], &v["parent"]["n"]),
        (&"voronoi".into(), &3.into(), &20.into())
    );
    for (name, residual) in v["conservation"].as_object().unwrap() {
        let scale = if name == "energy_difference" { 1e4 } else { 1.0 };
        let all = residual.as_f64().map_or_else(|| vector(residual).to_vec(), |x| vec![x]);
        assert!(all.iter().all(|x| x.abs() < 1e-12 * scale), "{name}: {residual}");
    }
    let fragments = v["fragments"].as_array().unwrap();
    assert_eq!((fragments.len(), v["dust"].as_array().unwrap().len()), (5, 0));
    // Sums by hand, of the numbers that were written.
    let (mut mass, mut momentum) = (0.0, [0.0; 3]);
    let mut clumps: Vec<Vec<Vec<f64>>> = Vec::new();
    for f in fragments {
        let m = f["mass"].as_f64().unwrap();
        mass += m;
        let velocity = vector(&f["velocity"]);
        (0..3).for_each(|k| momentum[k] += m * velocity[k]);
        let (header, rows) = numbers(&out.join(f["spheres"].as_str().unwrap()));
        assert_eq!(
            (header.as_str(), rows.len()),
            ("x,y,z,r,mass", f["n"].as_u64().unwrap() as usize)
        );
        let sum: f64 = rows.iter().map(|r| r[4]).sum();
        assert!(f["mass_status"] != "exact" || (sum / m - 1.0).abs() < 1e-9);
        clumps.push(rows);
        let stl = out.join(f["mesh"].as_str().unwrap());
        let info: Value = serde_json::from_str(&succeeds(&["info", text(&stl), "--json"])).unwrap();
        let (volume, told) = (info["volume"].as_f64().unwrap(), f["volume"].as_f64().unwrap());
        assert!((volume / told - 1.0).abs() < 1e-4, "{volume} {told}");
    }
    let whole = v["parent"]["mass"].as_f64().unwrap();
    assert!((mass / whole - 1.0).abs() < 1e-12);
    let wanted = [1.0, 0.0, -2.0].map(|x| x * whole);
    assert!((0..3).all(|k| (momentum[k] - wanted[k]).abs() < 1e-11 * whole), "{momentum:?}");
    for (i, a) in clumps.iter().enumerate() {
        for b in clumps[..i].iter().flatten() {
            for a in a {
                let apart = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
                assert!(apart >= a[3] + b[3] + 0.001 * (1.0 - 1e-9), "{a:?} {b:?}");
            }
        }
    }
    assert_eq!(pixels(&out.join("fragments.png")).0, (400, 220));
    // The same files on one thread.
    let again = folder("break-again").join("deep/out");
    let size = ["--size", "400x220", "--threads", "1"];
    breaks(&again, STONE, &[&more[..], &size[..]].concat());
    let mut count = 0;
    for entry in std::fs::read_dir(&out).unwrap() {
        let name = entry.unwrap().file_name();
        let [a, b] = [&out, &again].map(|folder| std::fs::read(folder.join(&name)).unwrap());
        assert!(a == b || name == "fragments.json", "{name:?}");
        count += 1;
    }
    assert_eq!(count, 12);
}

#[test]
fn cuts_are_read_from_files_and_options() {
    let folder = folder("break-cuts");
    let (planes, points) = (folder.join("planes.txt"), folder.join("points.csv"));
    std::fs::write(&planes, "# two\nnx,ny,nz,offset\n0,0,1,0\n\n1 0 0  0.05\n").unwrap();
    std::fs::write(&points, "-0.3,0,0\n0.3,0,0\n0,0.2,0\n").unwrap();
    let out = folder.join("out");
    let count = |more: &[&str]| {
        let v = breaks(&out, "sample:box", &[more, &["--no-picture"]].concat());
        v["fragments"].as_array().unwrap().len()
    };
    assert_eq!(count(&["--planes", text(&planes)]), 4);
    assert_eq!(count(&["--points", text(&points), "--no-union", "--precision", "f32"]), 3);
    for r in numbers(&out.join("fragment_000.csv")).1.iter().flatten() {
        assert_eq!(f64::from(*r as f32), *r);
    }
    assert_eq!(count(&["--impact", "0.5,0,0,-1,0,0,4", "--deadline", "0"]), 4);
    // Weights so great that one cell is all; then a limit that makes dust of all.
    std::fs::write(&points, "-0.3,0,0,0\n0.3,0,0,100\n").unwrap();
    assert_eq!(count(&["--points", text(&points)]), 1);
    let all = ["break", "sample:box", "--voronoi", "3", "--least-volume", "5", "-o", text(&out)];
    assert!(fails(&all, 1).contains("NO_SPHERES"));
    // The standard output has what the file has.
    let words = ["break", "sample:box", "--voronoi", "2", "-n", "3", "--parent", "inscribed"];
    let printed = succeeds(&[&words[..], &["-o", text(&out), "--json", "--no-picture"]].concat());
    let [a, b]: [Value; 2] =
        [printed, std::fs::read_to_string(out.join("fragments.json")).unwrap()]
            .map(|text| serde_json::from_str(&text).unwrap());
    assert_eq!(a, b);
}

#[test]
fn voxels_break_into_meshes() {
    let folder = folder("break-voxels");
    let raw = folder.join("ball.raw");
    let far = |i: usize| (i as f64 - 9.5).powi(2);
    let solid = |i: usize| far(i % 20) + far(i / 20 % 20) + far(i / 400) < 90.0;
    std::fs::write(&raw, (0..8000).map(|i| u8::from(solid(i))).collect::<Vec<u8>>()).unwrap();
    let out = folder.join("out");
    let v = breaks(&out, text(&raw), &["--raw", "20x20x20", "--voronoi", "3", "--size", "300x200"]);
    for f in v["fragments"].as_array().unwrap() {
        let stl = out.join(f["mesh"].as_str().unwrap());
        let info: Value = serde_json::from_str(&succeeds(&["info", text(&stl), "--json"])).unwrap();
        let (volume, told) = (info["volume"].as_f64().unwrap(), f["volume"].as_f64().unwrap());
        assert!((volume / told - 1.0).abs() < 1e-4, "{volume} {told}");
    }
    assert_eq!(v["notes"].as_array().unwrap().len(), 0);
}

#[test]
fn breaks_that_make_no_sense_are_refused_and_write_nothing() {
    let folder = folder("break-bad");
    let (out, file) = (folder.join("out"), folder.join("p.csv"));
    let says = |content: &str, option: &str, code: i32, words: &str| {
        std::fs::write(&file, content).unwrap();
        let said = fails(&["break", "sample:box", option, text(&file), "-o", text(&out)], code);
        assert!(said.contains(words), "{said}");
        assert!(!out.exists());
    };
    says("0,0,1\n", "--planes", 1, "line 1: 3 numbers");
    says("0,0,1\n0,0,oops\n", "--points", 1, "line 2: oops");
    says("0,0,1\n0,0,1,2\n", "--points", 1, "line 2: 4 numbers");
    says("x,y,z\n", "--points", 1, "no line");
    says("0,0,1\n0,0,1\n", "--points", 1, "points 0 and 1");
    says("0,0,0,1\n", "--planes", 1, "half-space 0");
    for more in [
        &[][..],
        &["--voronoi", "2", "--impact", "0,0,0,1,0,0,3"],
        &["--impact", "1,2,3"],
        &["--voronoi", "x"],
        &["--voronoi", "2", "--masses", "even"],
        &["--voronoi", "2", "--velocity", "1"],
        &["--voronoi", "2", "--gap", "-1"],
    ] {
        fails(&[&["break", "sample:box", "-o", text(&out)], more].concat(), 2);
    }
    for more in [["--voronoi", "0"], ["--impact", "0,0,0,0,0,0,3"]] {
        fails(&[&["break", "sample:box", "-o", text(&out)], &more[..]].concat(), 1);
    }
    fails(&["break", "sample:box", "--voronoi", "2", "-o", "-"], 2);
    assert!(!out.exists());
    // The input may have the name of an output.
    let stl = folder.join("fragment_001.stl");
    succeeds(&["sample", "box", "-o", text(&stl)]);
    let before = std::fs::read(&stl).unwrap();
    let said = fails(&["break", text(&stl), "--voronoi", "3", "-n", "2", "-o", text(&folder)], 2);
    assert!(said.contains("overwritten"), "{said}");
    assert_eq!(std::fs::read(&stl).unwrap(), before);
    assert!(!folder.join("fragment_000.csv").exists());
}
