//! What is wrong with a file is said with its byte or line.

use super::files::*;
use super::*;

#[test]
fn faults_of_stl() {
    fails(b"", "none.stl", EMPTY, "none.stl is empty");
    let good = stl_binary(b"x");
    fails(&good[..50], "head.stl", FORMAT, "ends at byte 50, within its header");
    fails(&good[..300], "cut.stl", FORMAT, "ends at byte 300 in face 4");
    let mut lie = good.clone();
    lie[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    fails(&lie, "lie.stl", FORMAT, "declares 4294967295 faces");
    lie[80..84].copy_from_slice(&3u32.to_le_bytes());
    fails(&lie, "few.stl", FORMAT, "declares 3 faces");
    lie[80..84].copy_from_slice(&0u32.to_le_bytes());
    fails(&lie[..84], "zero.stl", EMPTY, "no faces");
    let text = stl_ascii();
    breaks(&text, ["0.000", "zero"], "word.stl", FORMAT, "line 4: y of the vertex is \"zero\"");
    breaks(&text, ["endsolid a box", ""], "open.stl", FORMAT, "without endsolid");
    breaks(
        &text,
        ["  endloop\n", "  vertex 0 0 0\n  endloop\n"],
        "four.stl",
        FORMAT,
        "line 7: the facet has more than 3",
    );
    breaks(&text, ["   vertex", "#  vertex"], "odd.stl", FORMAT, "line 4: \"#\" is not expected");
    fails(&text.as_bytes()[..text.len() / 2], "half.stl", FORMAT, "it is cut off");
    let wide: Vec<u8> = text.bytes().flat_map(|b| [b, 0]).collect();
    fails(&wide, "wide.stl", FORMAT, "UTF-16 (little-endian)");
}

#[test]
fn faults_of_obj() {
    let good = obj();
    breaks(&good, ["v 1 0 0 0.5 nan 1", "v 1 0"], "short.obj", FORMAT, "line 5:");
    breaks(&good, ["v 1 0 0 ", "v 1 0 x "], "word.obj", FORMAT, "line 5: \"v 1 0 x");
    breaks(&good, ["f 1/7", "f 9/7"], "high.obj", INDEX, "line 15: a face names vertex 9");
    breaks(&good, ["f 1/7", "f 0/7"], "zero.obj", INDEX, "line 15: a face names vertex 0");
    breaks(&good, ["f 1/7", "f -9/7"], "low.obj", INDEX, "line 15: a face names vertex -9");
    breaks(
        &good,
        ["f 1/7", "f 1e3"],
        "odd.obj",
        FORMAT,
        "line 15: the vertex of a face is \"1e3\"",
    );
    fails(b"v 0 0 0\nv 1 0 0\nf 1 2\n", "two.obj", FORMAT, "line 3: a face with 2 corners");
    fails(b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "points.obj", EMPTY, "no faces");
    let wide: Vec<u8> = [0xfe, 0xff].into_iter().chain(good.bytes().flat_map(|b| [0, b])).collect();
    fails(&wide, "wide.obj", FORMAT, "UTF-16 (big-endian)");
    // A face may name vertices that come later.
    is_box(
        {
            let (faces, rest): (Vec<&str>, Vec<&str>) =
                good.lines().partition(|l| l.starts_with("f "));
            let faces: String = faces.iter().map(|f| format!("{f}\n")).collect();
            let fixed =
                (1..=8).fold(faces, |f, i| f.replace(&format!(" {}/1/1", i - 9), &format!(" {i}")));
            fixed + &rest.join("\n")
        }
        .as_bytes(),
        "forward.obj",
    );
}

#[test]
fn faults_of_ply() {
    let good = ply_ascii();
    breaks(&good, ["end_header\n", ""], "head.ply", FORMAT, "no end_header");
    breaks(
        &good,
        ["vertex 8", "vertex 88888888888"],
        "lie.ply",
        FORMAT,
        "declares 88888888888 elements vertex",
    );
    breaks(&good, ["vertex 8", "vertex 9"], "nine.ply", FORMAT, "the PLY file is broken: Line");
    breaks(&good, ["property double y\n", ""], "flat.ply", FORMAT, "no property y");
    breaks(
        &good,
        ["vertex_indices", "corners"],
        "list.ply",
        FORMAT,
        "no list property vertex_indices",
    );
    breaks(&good, ["4 0 3 2 1", "4 0 3 2 8"], "index.ply", INDEX, "PLY face 0 names vertex 8");
    breaks(&good, ["4 0 3 2 1", "4 0 3 2 -1"], "minus.ply", INDEX, "PLY face 0 names vertex -1");
    breaks(&good, ["element face 6", "element face 0"], "points.ply", EMPTY, "no faces");
    breaks(&good, ["format ascii", "format morse"], "morse.ply", FORMAT, "Line 2");
    for big in [false, true] {
        let bytes = ply_binary(big);
        fails(&bytes[..bytes.len() - 30], "cut.ply", FORMAT, "end of file");
        fails(&bytes[..bytes.len() - 150], "short.ply", FORMAT, "follow the header");
    }
    let nothing = "ply\nformat binary_little_endian 1.0\nelement ghost 4000000000\nend_header\n";
    fails(nothing.as_bytes(), "ghost.ply", FORMAT, "elements ghost without properties");
}

#[test]
fn faults_of_off() {
    let good = off("OFF");
    breaks(
        &good,
        ["8 6 0", "8000000000000 6 0"],
        "lie.off",
        FORMAT,
        "declares 8000000000000 vertices",
    );
    breaks(
        &good,
        ["8 6 0", "8 7 0"],
        "seven.off",
        FORMAT,
        "ends before the number of corners of face 6",
    );
    breaks(
        &good,
        ["4  0 3 2 1", "4  0 3 2 8"],
        "index.off",
        INDEX,
        "line 12: face 0 names vertex 8",
    );
    breaks(&good, ["4  0 3 2 1", "4000000000  0 3 2 1"], "corners.off", FORMAT, "corner");
    breaks(
        &good,
        ["8 6 0", "eight 6 0"],
        "word.off",
        FORMAT,
        "line 3: the number of vertices is \"eight\"",
    );
    breaks(&good, ["OFF", "4OFF"], "four.off", UNSUPPORTED, "4OFF files are not read");
    fails(b"OFF\n", "head.off", FORMAT, "ends before the number of vertices");
    fails(b"OFF 0 0 0\n", "none.off", EMPTY, "no faces");
    fails(&off("OFF").as_bytes()[..60], "cut.off", FORMAT, "declares 8 vertices");
}
