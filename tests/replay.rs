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
    replay("calls", 20, bodies::calls);
}

/// The same of files and calls: how much is made of each at least.
#[test]
fn what_fuzzing_begins_from_is_made() {
    for (name, body, least) in [
        ("meshes/obj", bodies::meshes as fn(&[u8]), 1),
        ("meshes/off", bodies::meshes, 1),
        ("meshes/ply_ascii", bodies::meshes, 1),
        ("meshes/ply_binary", bodies::meshes, 1),
        ("meshes/stl_ascii", bodies::meshes, 1),
        ("meshes/stl_binary", bodies::meshes, 1),
        ("meshes/told_by_content", bodies::meshes, 1),
        ("voxels/npy_fortran", bodies::voxels, 1),
        ("voxels/npy_grey", bodies::voxels, 1),
        ("voxels/npy_label", bodies::voxels, 1),
        ("voxels/npy_mask", bodies::voxels, 1),
        ("voxels/raw", bodies::voxels, 1),
        ("voxels/tiff", bodies::voxels, 1),
        ("calls/breaks", bodies::calls, 6),
        ("calls/cache", bodies::calls, 4),
        ("calls/grey", bodies::calls, 6),
        ("calls/labels", bodies::calls, 5),
        ("calls/many_shapes", bodies::calls, 7),
        ("calls/mask", bodies::calls, 3),
        ("calls/mesh", bodies::calls, 1),
        ("calls/method_0", bodies::calls, 8),
        ("calls/method_9", bodies::calls, 8),
        ("calls/moved", bodies::calls, 4),
        ("calls/pieces", bodies::calls, 7),
        ("calls/prices", bodies::calls, 4),
        ("calls/silhouettes", bodies::calls, 2),
        ("calls/spheres", bodies::calls, 1),
        ("calls/sweep", bodies::calls, 3),
    ] {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fuzz_regressions/");
        let made = bodies::made(body, &std::fs::read(format!("{path}{name}")).unwrap());
        assert!(made >= least, "{name}: {made} of {least}");
    }
}
