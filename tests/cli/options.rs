//! Options that do not fit: what they would have done is not done silently.

use super::*;

#[test]
fn options_without_effect_are_refused() {
    let folder = folder("effect");
    let (mesh, mask) = (folder.join("box.off"), folder.join("mask.npy"));
    succeeds(&["sample", "box", "-o", text(&mesh)]);
    std::fs::write(&mask, shapes::npy("(4, 4, 4)", &[1; 64])).unwrap();
    let (mesh, mask) = (text(&mesh), text(&mask));
    for (command, input, option) in [
        ("clump", mask, ["--cells", "9"]),
        ("clump", mask, ["--cells-along", "shortest"]),
        ("clump", mask, ["--cell-size", "0.5"]),
        ("info", mask, ["--weld", "0"]),
        ("info", mesh, ["--label", "1"]),
        ("info", mesh, ["--threshold", "otsu"]),
        ("clump", mesh, ["--spacing", "2"]),
        ("clump", mesh, ["--origin", "-1,2,3"]),
        ("info", mesh, ["--axes", "xyz"]),
        ("info", mesh, ["--segments", "9"]),
        ("info", mesh, ["--seed", "9"]),
        ("info", "sample:box", ["--seed", "9"]),
        ("clump", "sample:box", ["--label", "1"]),
        ("clump", "sample:box", ["--raw", "4x4x4"]),
    ] {
        let said = fails(&[&[command, input], &option[..]].concat(), 2);
        assert!(said.contains(option[0]) && said.contains("no effect"), "{said}");
    }
    fails(&["info", mask, "--labels", "--label", "1"], 2);
    fails(&["info", mask, "--labels", "--density", "1"], 2);
    fails(&["info", mask, "--raw", "4x4x4", "--axes", "xyz"], 2);
    fails(&["clump", mesh, "--plane-tolerance", "0.1", "-o", "c.csv"], 2);
    fails(&["clump", mesh, "--columns", "64", "--quality", "none"], 2);
    fails(&["clump", mesh, "-n", "1", "--cells", "8", "--columns", "7"], 1);
    let said = fails(&["info", "sample:box", "--labels"], 2);
    assert!(said.contains("built-in"), "{said}");
    let json = ["clump", "sample:box", "-n", "1", "--cells", "8", "--json", "--format"];
    fails(&[&json[..], &["csv"]].concat(), 2);
    succeeds(&[&json[..], &["json"]].concat());
    fails(&["view", "sample:box", "c.csv", "-o", "p.jpg"], 2);
}

#[test]
fn an_input_is_never_overwritten() {
    let folder = folder("overwritten");
    let (mesh, clump) = (folder.join("box.off"), folder.join("c.csv"));
    succeeds(&["sample", "box", "-o", text(&mesh)]);
    let before = std::fs::read(&mesh).unwrap();
    let roundabout = folder.join("../cli-overwritten/box.off");
    let said = fails(&["clump", text(&mesh), "-n", "2", "-o", text(&roundabout)], 2);
    assert!(said.contains("overwritten"), "{said}");
    succeeds(&["clump", text(&mesh), "-n", "2", "--cells", "8", "-o", text(&clump)]);
    for output in [&mesh, &clump] {
        fails(&["view", text(&mesh), text(&clump), "-o", text(output)], 2);
    }
    assert_eq!(std::fs::read(&mesh).unwrap(), before);
}

#[test]
fn the_frame_of_a_json_clump_is_its_own() {
    let folder = folder("frame");
    let input = "sample:ellipsoid,a=0.5,c=1";
    let draw = |name: &str, made: &[&str], drawn: &[&str]| {
        let (clump, png) = (folder.join(name), folder.join("p.png"));
        let grid = [input, "--cells", "16", "-o"];
        succeeds(&[&["clump", "-n", "3"], made, &grid, &[text(&clump)]].concat());
        let view = ["view", input, text(&clump), "--cells", "16", "--size", "300x160"];
        succeeds(&[&view, drawn, &["-o", text(&png)]].concat());
        pixels(&png).1
    };
    let told = draw("told.csv", &["--frame", "body"], &["--frame", "body"]);
    assert_eq!(draw("said.json", &["--frame", "body"], &[]), told);
    assert_ne!(draw("untold.csv", &["--frame", "body"], &[]), told);
    let clump = folder.join("said.json");
    let said = fails(&["view", input, text(&clump), "-o", "p.png", "--frame", "input"], 2);
    assert!(said.contains("frame body"), "{said}");
}

#[test]
fn numbers_out_of_range_are_named() {
    for (option, value) in [
        ("-n", "-3"),
        ("--threads", "-1"),
        ("--seed", "-1"),
        ("--seed", "1.5"),
        ("--cells", "-4"),
        ("--cell-size", "-4"),
        ("--density", "-2"),
        ("--mismatch", "-0.5"),
        ("--deadline", "-1"),
        ("--min-radius", "-1"),
        ("--length-unit", "-1"),
        ("--spacing", "-1"),
        ("--spacing", "1,0,1"),
        ("--label", "-1"),
        ("--segments", "-8"),
        ("--memory-limit", "-1"),
    ] {
        let said = fails(&["clump", "sample:box", option, value], 2);
        assert!(said.contains("invalid value") && said.contains(value), "{option}: {said}");
    }
    fails(&["clump", "sample:stone", "--seed", "9007199254740993"], 2);
    let empty = fails(&["clump", ""], 2);
    assert!(empty.contains("path of the input is empty"), "{empty}");
    fails(&["clump", "sample:box", "-o", ""], 2);
    fails(&["sample", "box", "-o", ""], 2);
}

#[test]
fn sentences_quote_numbers_as_people_do() {
    for (arguments, word) in [
        (&["sample", "box", "--set", "a=1e-300", "-o", "b.off"][..], "is 1e-300,"),
        (&["info", "sample:box", "--length-unit", "1e-200"], "is 1e-200,"),
        (&["info", "sample:box", "--length-unit", "1e300"], "is 1e300,"),
        (&["clump", "sample:box", "--min-radius", "10"], "a radius of 10 or more"),
        (&["clump", "sample:box", "--cell-size", "10"], "larger than the shape"),
        (&["clump", "sample:box", "--method", "mss", "--min-radius", "10"], "of 10 or more"),
        (&["clump", "sample:box", "--radius-offset", "1e9", "-n", "1"], "is an option of"),
        (
            &["clump", "sample:box", "--method", "mss", "--radius-offset", "1e9", "-n", "1"],
            "sphere 0 has radius",
        ),
    ] {
        let said = fails(arguments, 1);
        assert!(said.contains(word) && said.len() < 250, "{said}");
    }
}
