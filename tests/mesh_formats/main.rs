//! STL, OBJ, PLY and OFF in memory: every variant, every fault, arbitrary bytes.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod faults;
mod files;
mod unusual;

use files::*;
use morula::shape::read::{FileOptions, Format};
use morula::{Error, Run, Shape};
use proptest::prelude::*;

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

/// The error of a good file in which the first `from` is `to`.
fn breaks(good: &str, [from, to]: [&str; 2], name: &str, status: i32, words: &str) {
    assert!(good.contains(from), "{name}: there is no \"{from}\"");
    fails(good.replacen(from, to, 1).as_bytes(), name, status, words);
}

const NOT_FINITE: i32 = 3;
const INDEX: i32 = 4;
const EMPTY: i32 = 5;
const FORMAT: i32 = 9;
const UNSUPPORTED: i32 = 10;

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
