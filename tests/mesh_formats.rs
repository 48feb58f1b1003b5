//! STL, OBJ, PLY and OFF in memory: every variant, every fault, arbitrary bytes.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use morula::shape::read::{FileOptions, Format};
use morula::{Error, Run, Shape};
use proptest::prelude::*;

const CORNERS: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 2.0, 0.0],
    [0.0, 2.0, 0.0],
    [0.0, 0.0, 3.0],
    [1.0, 0.0, 3.0],
    [1.0, 2.0, 3.0],
    [0.0, 2.0, 3.0],
];
const QUADS: [[usize; 4]; 6] =
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn triangles() -> Vec<[usize; 3]> {
    QUADS.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect()
}

fn read(bytes: &[u8], name: &str) -> Result<Shape, Error> {
    Shape::from_bytes(bytes, name, &FileOptions::default(), &Run::serial())
}

/// Reads a box of 1 × 2 × 3.
fn is_box(bytes: &[u8], name: &str) {
    let s = read(bytes, name).unwrap_or_else(|e| panic!("{name}: {e}"));
    let r = &s.report;
    assert!(r.watertight && r.oriented && r.notes.is_empty(), "{name}: {:?}", r.notes);
    assert_eq!((r.vertices, r.faces, r.input_faces), (8, 12, 12), "{name}");
    assert!((r.volume - 6.0).abs() < 1e-12 && (r.area - 22.0).abs() < 1e-12, "{name}");
    assert_eq!(r.box_max, [1.0, 2.0, 3.0], "{name}");
}

/// The error of a file: its arm, and words that its sentence must have.
fn fails(bytes: &[u8], name: &str, status: i32, words: &str) {
    match read(bytes, name) {
        Ok(_) => panic!("{name} was read, but should say: {words}"),
        Err(e) => {
            assert!(e.to_string().contains(words), "{name}: \"{e}\" does not say \"{words}\"");
            assert_eq!(e.status(), status, "{name}: {e}");
        }
    }
}

const INDEX: i32 = 4;
const EMPTY: i32 = 5;
const FORMAT: i32 = 9;
const UNSUPPORTED: i32 = 10;

fn stl_binary(header: &[u8]) -> Vec<u8> {
    let mut out = header.to_vec();
    out.resize(80, b' ');
    out.extend(12u32.to_le_bytes());
    for t in triangles() {
        out.extend([0u8; 12]);
        for c in t.iter().flat_map(|&i| CORNERS[i]) {
            out.extend((c as f32).to_le_bytes());
        }
        out.extend([0u8; 2]);
    }
    out
}

fn stl_ascii() -> String {
    let mut out = String::from("solid a box\n");
    for t in triangles() {
        out += " facet normal 0 0 nan\n  outer loop\n";
        for i in t {
            let [x, y, z] = CORNERS[i];
            out += &format!("   vertex {x:e} {y:.3} +{z}\n");
        }
        out += "  endloop\n endfacet\n";
    }
    out + "endsolid a box\n"
}

fn obj() -> String {
    let mut out = String::from("# a box\nmtllib none.mtl\no box\n");
    for [x, y, z] in CORNERS {
        out += &format!("v {x} {y} {z} 0.5 nan 1\n");
    }
    out += "vn 0 0 1\ng side\nusemtl none\n";
    for q in QUADS {
        out += &format!("f {}/7 {}//1 {} {}/1/1\n", q[0] + 1, q[1] + 1, q[2] + 1, q[3] as i64 - 8);
    }
    out
}

fn ply_header(format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment a box\nelement vertex 8\nproperty uchar red\n\
         property float x\nproperty double y\nproperty float z\nelement face 6\n\
         property list uchar int vertex_indices\nproperty short flags\nend_header\n"
    )
}

fn ply_ascii() -> String {
    let mut out = ply_header("ascii");
    for [x, y, z] in CORNERS {
        out += &format!("7 {x} {y} {z}\n");
    }
    for q in QUADS {
        out += &format!("4 {} {} {} {} -1\n", q[0], q[1], q[2], q[3]);
    }
    out
}

fn ply_binary(big: bool) -> Vec<u8> {
    let mut out =
        ply_header(if big { "binary_big_endian" } else { "binary_little_endian" }).into_bytes();
    let mut put = |bytes: &[u8]| {
        let mut b = bytes.to_vec();
        if big {
            b.reverse();
        }
        out.extend(b);
    };
    for [x, y, z] in CORNERS {
        put(&[7]);
        put(&(x as f32).to_le_bytes());
        put(&y.to_le_bytes());
        put(&(z as f32).to_le_bytes());
    }
    for q in QUADS {
        put(&[4]);
        q.iter().for_each(|&i| put(&(i as i32).to_le_bytes()));
        put(&(-1i16).to_le_bytes());
    }
    out
}

fn off(word: &str) -> String {
    let mut out = format!("{word} # a box\n\n8 6 0\n");
    let normal = if word.contains('N') { "0 0 1" } else { "" };
    let colour = if word.contains('C') { "255 0 0" } else { "" };
    for [x, y, z] in CORNERS {
        out += &format!(" {x} {y}\t{z} {normal} {colour}\n");
    }
    for q in QUADS {
        out += &format!("4  {} {} {} {}  0.5 0.5 0.5 # face\n", q[0], q[1], q[2], q[3]);
    }
    out
}

#[test]
fn every_variant_is_the_same_box() {
    is_box(&stl_binary(b"made by a test"), "binary.stl");
    is_box(&stl_binary(b"solid made by a test"), "solid.stl");
    is_box(stl_ascii().as_bytes(), "ascii.stl");
    is_box(stl_ascii().to_uppercase().replace('\n', "\r\n").as_bytes(), "upper.stl");
    is_box(format!("\u{feff}{}", stl_ascii()).as_bytes(), "mark.stl");
    is_box(obj().as_bytes(), "box.obj");
    is_box(obj().replace('\n', "\r\n").as_bytes(), "crlf.obj");
    is_box(obj().replace("f ", "f \\\n ").as_bytes(), "continued.obj");
    is_box(ply_ascii().as_bytes(), "ascii.ply");
    is_box(&ply_binary(false), "little.ply");
    is_box(&ply_binary(true), "big.ply");
    for word in ["OFF", "COFF", "NOFF", "CNOFF"] {
        is_box(off(word).as_bytes(), word);
    }
    is_box(off("OFF").replace("OFF # a box\n\n", "OFF").as_bytes(), "glued.off");
    // Latin-1 in a comment or a name is no fault.
    let latin = |text: String| text.replace("a box", "\u{1}").into_bytes();
    let swap =
        |b: Vec<u8>| b.into_iter().map(|c| if c == 1 { 0xe9 } else { c }).collect::<Vec<_>>();
    is_box(&swap(latin(obj())), "latin.obj");
    is_box(&swap(latin(ply_ascii())), "latin.ply");
    is_box(&swap(latin(off("OFF"))), "latin.off");
    is_box(&swap(latin(stl_ascii())), "latin.stl");
}

#[test]
fn content_goes_before_the_name() {
    for (bytes, name) in [
        (stl_binary(b""), "wrong.obj"),
        (stl_ascii().into_bytes(), "wrong.ply"),
        (obj().into_bytes(), "wrong.off"),
        (ply_ascii().into_bytes(), "wrong.stl"),
        (off("COFF").into_bytes(), "without a dot"),
    ] {
        is_box(&bytes, name);
    }
    let forced = FileOptions { format: Some(Format::Off), ..FileOptions::default() };
    let e = Shape::from_bytes(obj().as_bytes(), "x.obj", &forced, &Run::serial()).unwrap_err();
    assert_eq!(e.status(), FORMAT, "{e}");
    fails(b"\x01\x02\x03\x04 something else", "mystery.dat", UNSUPPORTED, "mystery.dat is none of");
}

#[test]
fn double_precision_is_kept() {
    // A box a thousand kilometres away: single precision has steps of 0.06 there.
    let far = |text: String| text.replace("v 0 ", "v 1000000 ").replace("v 1 ", "v 1000001 ");
    assert!((read(far(obj()).as_bytes(), "far.obj").unwrap().report.volume - 6.0).abs() < 1e-9);
    let text =
        stl_ascii().replace("vertex 0e0", "vertex 1e6").replace("vertex 1e0", "vertex 1000001");
    assert!((read(text.as_bytes(), "far.stl").unwrap().report.volume - 6.0).abs() < 1e-9);
}

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
    fails(
        text.replacen("0.000", "zero", 1).as_bytes(),
        "word.stl",
        FORMAT,
        "line 4: y of the vertex is \"zero\"",
    );
    fails(text.replace("endsolid a box", "").as_bytes(), "open.stl", FORMAT, "without endsolid");
    fails(
        text.replacen("  endloop\n", "  vertex 0 0 0\n  endloop\n", 1).as_bytes(),
        "four.stl",
        FORMAT,
        "line 7: the facet has more than 3",
    );
    fails(
        text.replacen("   vertex", "#  vertex", 1).as_bytes(),
        "odd.stl",
        FORMAT,
        "line 4: \"#\" is not expected",
    );
    fails(&text.as_bytes()[..text.len() / 2], "half.stl", FORMAT, "it is cut off");
    let wide: Vec<u8> = text.bytes().flat_map(|b| [b, 0]).collect();
    fails(&wide, "wide.stl", FORMAT, "UTF-16 (little-endian)");
}

#[test]
fn faults_of_obj() {
    let good = obj();
    fails(
        good.replacen("v 1 0 0 0.5 nan 1", "v 1 0", 1).as_bytes(),
        "short.obj",
        FORMAT,
        "line 5:",
    );
    fails(
        good.replacen("v 1 0 0 ", "v 1 0 x ", 1).as_bytes(),
        "word.obj",
        FORMAT,
        "line 5: \"v 1 0 x",
    );
    fails(
        good.replacen("f 1/7", "f 9/7", 1).as_bytes(),
        "high.obj",
        INDEX,
        "line 15: a face names vertex 9",
    );
    fails(
        good.replacen("f 1/7", "f 0/7", 1).as_bytes(),
        "zero.obj",
        INDEX,
        "line 15: a face names vertex 0",
    );
    fails(
        good.replacen("f 1/7", "f -9/7", 1).as_bytes(),
        "low.obj",
        INDEX,
        "line 15: a face names vertex -9",
    );
    fails(
        good.replacen("f 1/7", "f 1e3", 1).as_bytes(),
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
    fails(good.replace("end_header\n", "").as_bytes(), "head.ply", FORMAT, "no end_header");
    fails(
        good.replace("vertex 8", "vertex 88888888888").as_bytes(),
        "lie.ply",
        FORMAT,
        "declares 88888888888 elements vertex",
    );
    fails(
        good.replace("vertex 8", "vertex 9").as_bytes(),
        "nine.ply",
        FORMAT,
        "the PLY file is broken: Line",
    );
    fails(good.replace("property double y\n", "").as_bytes(), "flat.ply", FORMAT, "no property y");
    fails(
        good.replace("vertex_indices", "corners").as_bytes(),
        "list.ply",
        FORMAT,
        "no list property vertex_indices",
    );
    fails(
        good.replace("4 0 3 2 1", "4 0 3 2 8").as_bytes(),
        "index.ply",
        INDEX,
        "PLY face 0 names vertex 8",
    );
    fails(
        good.replace("4 0 3 2 1", "4 0 3 2 -1").as_bytes(),
        "minus.ply",
        INDEX,
        "PLY face 0 names vertex -1",
    );
    fails(
        good.replace("element face 6", "element face 0").as_bytes(),
        "points.ply",
        EMPTY,
        "no faces",
    );
    fails(good.replace("format ascii", "format morse").as_bytes(), "morse.ply", FORMAT, "Line 2");
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
    fails(
        good.replace("8 6 0", "8000000000000 6 0").as_bytes(),
        "lie.off",
        FORMAT,
        "declares 8000000000000 vertices",
    );
    fails(
        good.replace("8 6 0", "8 7 0").as_bytes(),
        "seven.off",
        FORMAT,
        "ends before the number of corners of face 6",
    );
    fails(
        good.replace("4  0 3 2 1", "4  0 3 2 8").as_bytes(),
        "index.off",
        INDEX,
        "line 12: face 0 names vertex 8",
    );
    fails(
        good.replace("4  0 3 2 1", "4000000000  0 3 2 1").as_bytes(),
        "corners.off",
        FORMAT,
        "corner",
    );
    fails(
        good.replace("8 6 0", "eight 6 0").as_bytes(),
        "word.off",
        FORMAT,
        "line 3: the number of vertices is \"eight\"",
    );
    fails(
        good.replace("OFF", "4OFF").as_bytes(),
        "four.off",
        UNSUPPORTED,
        "4OFF files are not read",
    );
    fails(b"OFF\n", "head.off", FORMAT, "ends before the number of vertices");
    fails(b"OFF 0 0 0\n", "none.off", EMPTY, "no faces");
    fails(&off("OFF").as_bytes()[..60], "cut.off", FORMAT, "declares 8 vertices");
}

#[test]
fn large_files_are_refused_before_they_are_read() {
    let path = std::env::temp_dir().join(format!("morula-mesh-{}.off", std::process::id()));
    std::fs::write(&path, off("OFF")).unwrap();
    let mut options = FileOptions::default();
    let read = |o: &FileOptions| Shape::from_file(&path, o, &Run::serial());
    assert_eq!(read(&options).unwrap().report.volume, 6.0);
    options.import.memory_limit = 100;
    let e = read(&options).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    assert!(matches!(&e, Error::MemoryLimit(s) if s.contains("the limit is 100")), "{e}");
    let e = read(&options).unwrap_err();
    assert!(matches!(&e, Error::Io(s) if s.contains("cannot be read")), "{e}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..Default::default() })]
    /// Damaged files of every format give a shape or an error, never a panic.
    #[test]
    fn damage_never_panics(
        which in 0usize..8,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        cut in any::<prop::sample::Index>(),
        whole in any::<bool>(),
        twice in any::<prop::sample::Index>(),
    ) {
        let files = [
            stl_binary(b"x"), stl_ascii().into_bytes(), obj().into_bytes(), ply_ascii().into_bytes(),
            ply_binary(false), ply_binary(true), off("OFF").into_bytes(), off("CNOFF").into_bytes(),
        ];
        let names = ["a.stl", "a.stl", "a.obj", "a.ply", "a.ply", "a.ply", "a.off", "a.off"];
        let mut bytes = files[which].clone();
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if !whole {
            bytes.truncate(cut.index(bytes.len()));
            let from = twice.index(bytes.len().max(1));
            bytes.extend_from_within(from.min(bytes.len())..);
        }
        if let Ok(s) = read(&bytes, names[which]) {
            prop_assert!(s.report.volume.is_finite() && s.report.area.is_finite());
        }
    }

    /// Nor do bytes at random, whatever format they are taken for.
    #[test]
    fn bytes_at_random_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        for format in [Format::Stl, Format::Obj, Format::Ply, Format::Off] {
            let options = FileOptions { format: Some(format), ..FileOptions::default() };
            let _ = Shape::from_bytes(&bytes, "x", &options, &Run::serial());
        }
    }
}
