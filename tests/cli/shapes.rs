//! `morula info` and `morula sample`.

use super::*;
use morula::shape::Primitive;

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
pub fn npy(shape: &str, data: &[u8]) -> Vec<u8> {
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

    // Lengths that were scaled are said to be, as for a mesh.
    let printed = succeeds(&["info", text(&path), "--label", "1", "--length-unit", "0.001"]);
    assert!(printed.contains("lengths were multiplied by 0.001 on import"), "{printed}");
}

#[test]
fn labels_that_were_not_asked_for_are_heard_of() {
    let folder = folder("labels");
    let path = folder.join("labels.npy");
    let data: Vec<u8> = (0..6 * 6 * 6).map(|i| [0, 0, 3, 3, 3, 5][i % 6]).collect();
    std::fs::write(&path, npy("(6, 6, 6)", &data)).unwrap();
    let clump = ["clump", text(&path), "-n", "3"];
    let output = morula(&clump);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.starts_with("note: ") && said.lines().count() == 1, "{said}");
    assert!(said.contains("--labels") && said.contains("--label takes one"), "{said}");
    for more in [["--label", "3"], ["--threshold", "otsu"]] {
        succeeds(&[&clump[..], &more].concat());
    }
    succeeds(&[&clump[..], &["-q"]].concat());
}

#[test]
fn raw_is_raw_whatever_it_looks_like() {
    let path = folder("raw").join("mask.npy");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.resize(64, 1);
    std::fs::write(&path, bytes).unwrap();
    let printed = succeeds(&["info", text(&path), "--raw", "4x4x4", "--threshold", "0", "--json"]);
    let v: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(v["report"]["solid_cells"], 63);
    fails(&["info", text(&path), "--threshold", "0"], 1);
}

#[test]
fn counts_and_zeros_read_well() {
    let words = succeeds(&["info", "sample:box"]);
    assert!(words.contains("1 (1 component)\n") && !words.contains("-0.000000e0"), "{words}");
}

#[test]
fn a_seed_reaches_the_stone() {
    let area = |arguments: &[&str]| -> f64 {
        let all = [&["info", "--json"], arguments].concat();
        let v: Value = serde_json::from_str(&succeeds(&all)).unwrap();
        v["report"]["area"].as_f64().unwrap()
    };
    let seventh = area(&["sample:stone,seed=7"]);
    assert_eq!(area(&["sample:stone", "--seed", "7"]), seventh);
    assert_ne!(area(&["sample:stone"]), seventh);
    // What the name says itself stands.
    assert_eq!(area(&["sample:stone,seed=7", "--seed", "8"]), seventh);
    // MSS draws no numbers of its own.
    let clump = |input: &str, more: &[&str]| {
        succeeds(&[&["clump", input, "-n", "3", "--cells", "16", "--method", "mss"], more].concat())
    };
    assert_eq!(clump("sample:stone", &["--seed", "7"]), clump("sample:stone,seed=7", &[]));
    assert_ne!(clump("sample:stone", &[]), clump("sample:stone,seed=7", &[]));
}

#[test]
fn samples_read_back_in_every_format() {
    let folder = folder("samples");
    let list = succeeds(&["sample", "--list"]);
    for name in ["tablet", "mandm", "stone", "ellipsoid"] {
        assert!(list.lines().any(|l| l.starts_with(name)), "{list}");
    }
    for p in Primitive::from_name("capsule").unwrap().parameters() {
        let of =
            |l: &str| l.contains(&format!(" {}={:?} ", p.key, p.value)) && l.ends_with(p.meaning);
        assert!(list.lines().any(of), "{list}");
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
