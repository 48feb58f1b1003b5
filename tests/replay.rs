//! What fuzzing found once, and a few files of each kind that it began from, go through the bodies of
//! the fuzz targets again.

#![cfg(feature = "io")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

#[path = "../fuzz/bodies/mod.rs"]
mod bodies;

use std::path::Path;

fn replay(name: &str, least: usize, body: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz_regressions").join(name);
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() >= least, "{} files of {name}", paths.len());
    for path in paths {
        println!("{}", path.display());
        let bytes = std::fs::read(&path).unwrap();
        body(&bytes);
        // Cut short, and with one byte changed.
        for cut in [0, 1, 2, bytes.len() / 3, bytes.len() / 2, bytes.len().saturating_sub(1)] {
            body(&bytes[..cut.min(bytes.len())]);
        }
        for at in (0..bytes.len()).step_by(1 + bytes.len() / 20) {
            let mut changed = bytes.clone();
            changed[at] ^= 0x51;
            body(&changed);
        }
    }
}

#[test]
fn meshes() {
    replay("meshes", 5, bodies::meshes);
}

#[test]
fn voxels() {
    replay("voxels", 4, bodies::voxels);
}

#[test]
fn serial() {
    replay("serial", 3, |bytes| {
        bodies::serial(bytes);
    });
}

/// The files that fuzzing begins from are of today's format, else it would get no farther than the header.
#[test]
fn serial_begins_from_what_is_read() {
    for name in ["shape", "voxels", "clump", "clump_plain", "fragment", "shape_with_header"] {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fuzz_regressions/serial/");
        assert!(bodies::serial(&std::fs::read(format!("{path}{name}")).unwrap()), "{name}");
    }
}

#[test]
fn calls() {
    replay("calls", 4, bodies::calls);
}
