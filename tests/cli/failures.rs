//! What fails, and how it is said.

use super::*;

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
