//! Shapes, clumps and fragments from bytes.

use super::files::look;
use super::reads::{read_body, read_clump, read_fragments};
use super::*;
use std::ptr::{null, null_mut};
use std::sync::OnceLock;

fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |sum, b| {
        (0..8).fold(sum ^ u32::from(*b), |s, _| (s >> 1) ^ (0xedb8_8320 & (s & 1).wrapping_neg()))
    })
}

/// The beginning of bytes that this version of the library makes.
fn beginning() -> &'static [u8] {
    static BEGINNING: OnceLock<Vec<u8>> = OnceLock::new();
    BEGINNING.get_or_init(|| unsafe {
        let (mut shape, mut size) = (null_mut(), 0);
        let (name, p) = (c"box".as_ptr(), null());
        assert!(ok(morula_shape_from_primitive(name, p, null(), 0, 0, 0, null(), &mut shape)));
        assert!(ok(morula_shape_serialize(shape, 0, null_mut(), &mut size)));
        let mut all = vec![0; size];
        assert!(ok(morula_shape_serialize(shape, size, all.as_mut_ptr(), &mut size)));
        morula_shape_free(shape);
        all.truncate(10);
        all
    })
}

/// The bytes with a header that is right for them, so that what follows it is read.
fn with_header(kind: u8, body: &[u8]) -> Vec<u8> {
    let mut all = beginning().to_vec();
    all.extend([kind, 0]);
    all.extend(crc(body).to_le_bytes());
    all.extend((body.len() as u64).to_le_bytes());
    all.extend(body);
    all
}

/// A parent that all fragments of this place belong to.
struct Shared(*mut morula_parent);
// It is only read, which the header allows at the same time.
unsafe impl Send for Shared {}
unsafe impl Sync for Shared {}

fn parent() -> *const morula_parent {
    static PARENT: OnceLock<Shared> = OnceLock::new();
    PARENT
        .get_or_init(|| unsafe {
            let (mut shape, mut solid, mut parent) = (null_mut(), null_mut(), null_mut());
            let name = c"box".as_ptr();
            assert!(ok(morula_shape_from_primitive(
                name,
                null(),
                null(),
                0,
                0,
                0,
                null(),
                &mut shape
            )));
            let mut grid: morula_solid_options = sized();
            assert!(ok(morula_solid_options_init(&mut grid, size_of_val(&grid))));
            grid.cells = 12;
            assert!(ok(morula_solid_from_shape(shape, &grid, &mut solid)));
            let ball = [0.0, 0.0, 0.0, 0.5];
            assert!(ok(morula_parent_from_solid(solid, ball.as_ptr(), 1, 1, &mut parent)));
            morula_solid_free(solid);
            morula_shape_free(shape);
            Shared(parent)
        })
        .0
}

/// The first byte tells what the bytes are to hold, and whether they bring their own header. Whether they were read.
pub fn serial(data: &[u8]) -> bool {
    let mut input = Input(data);
    let choice = input.byte();
    let kind = choice % 3 + 1;
    let bytes = if choice & 64 == 0 { with_header(kind, input.0) } else { input.0.to_vec() };
    unsafe {
        match kind {
            1 => {
                let mut shape = null_mut();
                let read = ok(morula_shape_deserialize(bytes.as_ptr(), bytes.len(), &mut shape));
                if read {
                    look(shape);
                    morula_shape_free(shape);
                }
                read
            }
            2 => {
                let mut clump = null_mut();
                let read = ok(morula_clump_deserialize(bytes.as_ptr(), bytes.len(), &mut clump));
                if read {
                    look_at_clump(clump);
                    morula_clump_free(clump);
                }
                read
            }
            _ => {
                let (mut held, mut fragments) = (sized(), null_mut());
                let (p, q) = (null(), null());
                assert!(ok(morula_parent_held(
                    parent(),
                    1.0,
                    1.0,
                    p,
                    q,
                    null(),
                    null(),
                    &mut held
                )));
                let read = ok(morula_fragments_deserialize(
                    parent(),
                    bytes.as_ptr(),
                    bytes.len(),
                    &held,
                    &mut fragments,
                ));
                if read {
                    look_at_fragments(fragments);
                    let mut again = null_mut();
                    // What the bytes say of the piece need not be true of the parent: any status.
                    if ok(morula_parent_break(null(), fragments, 0, &held, null(), &mut again)) {
                        look_at_fragments(again);
                        morula_fragments_free(again);
                    }
                    morula_fragments_free(fragments);
                }
                read
            }
        }
    }
}

/// All that a clump tells.
pub(super) unsafe fn look_at_clump(clump: *const morula_clump) {
    unsafe {
        let (mut n, mut stopped, mut body) = (0, 0, null_mut());
        assert!(ok(morula_clump_sphere_count(clump, &mut n)));
        let mut xyzr = vec![0.0; 4 * n];
        assert!(ok(morula_clump_copy_spheres(clump, n, xyzr.as_mut_ptr())));
        spheres_are_real(&xyzr);
        read_clump(clump);
        assert!(ok(morula_clump_stopped(clump, &mut stopped)));
        let mut moments: morula_moments = sized();
        if ok(morula_clump_moments(clump, 1.0, &mut moments)) {
            moments_are_real(&moments);
        }
        let mut areas = vec![0.0; n];
        ok(morula_clump_copy_exposed_areas(clump, n, areas.as_mut_ptr()));
        ok(morula_clump_overlap(clump, &mut sized()));
        ok(morula_clump_surface(clump, &mut sized()));
        // Weighing takes the union of all spheres: of a few.
        if n <= 32 && ok(morula_body_from_clump(clump, null(), &mut body)) {
            look_at_body(body);
            morula_body_free(body);
        }
    }
}

/// All that a body tells.
pub(super) unsafe fn look_at_body(body: *const morula_body) {
    unsafe {
        let mut n = 0;
        assert!(ok(morula_body_sphere_count(body, &mut n)));
        read_body(body);
        let mut masses = vec![0.0; n];
        assert!(ok(morula_body_copy_masses(body, n, masses.as_mut_ptr())));
        finite(&masses);
        let (mut moments, mut result) = (sized::<morula_moments>(), sized::<morula_masses>());
        assert!(ok(morula_body_moments(body, &mut moments)));
        moments_are_real(&moments);
        assert!(ok(morula_body_masses(body, &mut result)));
        finite(&[
            result.mass_residual,
            result.centre_residual,
            result.inertia_residual,
            result.spread,
        ]);
        for frame in [MORULA_FRAME_INPUT, MORULA_FRAME_BODY] {
            let mut xyzr = vec![0.0; 4 * n];
            assert!(ok(morula_body_copy_spheres(body, frame, n, xyzr.as_mut_ptr())));
            spheres_are_real(&xyzr);
        }
    }
}

/// All that fragments tell.
pub(super) unsafe fn look_at_fragments(fragments: *const morula_fragments) {
    unsafe {
        let mut count = 0;
        assert!(ok(morula_fragments_count(fragments, &mut count)));
        read_fragments(fragments);
        for i in 0..count {
            let mut f: morula_fragment = sized();
            assert!(ok(morula_fragments_get(fragments, i, &mut f)));
            finite(&[f.mass, f.volume, f.coverage, f.volume_share, f.step_factor]);
            finite(&f.centre);
            finite(&f.velocity);
            finite(&f.quaternion);
            let n = f.sphere_count as usize;
            let mut xyzr = vec![0.0; 4 * n];
            for frame in [MORULA_FRAME_INPUT, MORULA_FRAME_BODY, MORULA_FRAME_WORLD] {
                assert!(ok(morula_fragments_copy_spheres(
                    fragments,
                    i,
                    frame,
                    n,
                    xyzr.as_mut_ptr()
                )));
                spheres_are_real(&xyzr);
            }
            let none = null();
            ok(morula_fragments_grow(fragments, i, 0.5, none, 0, 0.0, 0, n, xyzr.as_mut_ptr()));
            let mut shape = null_mut();
            if ok(morula_fragments_shape(fragments, i, &mut shape)) {
                morula_shape_free(shape);
            }
        }
    }
}
