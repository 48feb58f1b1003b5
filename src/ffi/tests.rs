//! What crosses the border, called as C calls it.

use super::*;
use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

fn message() -> String {
    unsafe { CStr::from_ptr(morula_last_error_message()) }.to_str().unwrap().to_owned()
}

fn primitive(name: &CStr, options: *const morula_import_options) -> *mut morula_shape {
    let mut shape = null_mut();
    let status = unsafe {
        morula_shape_from_primitive(name.as_ptr(), null(), null(), 0, 24, 0, options, &mut shape)
    };
    assert_eq!(status, MORULA_STATUS_OK, "{}", message());
    shape
}

fn sized<T>() -> T {
    // Numbers and a size: the structs that the library fills.
    let mut value: T = unsafe { std::mem::zeroed() };
    unsafe { (&raw mut value).cast::<usize>().write(size_of::<T>()) };
    value
}

fn counters(clump: *const morula_clump) -> morula_counters {
    let mut c: morula_counters = sized();
    assert_eq!(unsafe { morula_clump_counters(clump, &mut c) }, 0);
    c
}

#[cfg(feature = "io")]
#[test]
fn counters_cover_the_whole_road() {
    const OFF: &[u8] =
        b"OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
    let path = std::env::temp_dir().join(format!("morula_counters_{}.off", std::process::id()));
    std::fs::write(&path, OFF).unwrap();
    let name = CString::new(path.to_str().unwrap()).unwrap();
    let (mut shape, mut solid) = (null_mut(), null_mut());
    let (mut first, mut second) = (null_mut(), null_mut());
    let mut options: morula_clump_options = sized();
    unsafe {
        assert_eq!(morula_shape_from_file(name.as_ptr(), null(), null(), &mut shape), 0);
        std::fs::remove_file(&path).unwrap();
        morula_clump_options_init(&mut options, size_of::<morula_clump_options>());
        options.spheres = 4;
        options.method = MORULA_METHOD_MSS;
        options.wants = MORULA_WANT_NOTHING;
        assert_eq!(morula_clump_from_shape(shape, null(), &options, &mut first), 0);
        options.wants = MORULA_WANT_OVERLAP;
        options.quality_columns = 32;
        assert_eq!(morula_solid_from_shape(shape, null(), &mut solid), 0);
        assert_eq!(morula_clump_from_solid(solid, &options, &mut second), 0);
    }
    // Each handle tells of the calls that led to it, and of no later one.
    let (mut s, mut g): (morula_counters, morula_counters) = (sized(), sized());
    assert_eq!(unsafe { morula_shape_counters(shape, &mut s) }, 0);
    assert_eq!(unsafe { morula_solid_counters(solid, &mut g) }, 0);
    assert!(s.seconds_read > 0.0 && s.seconds_check > 0.0);
    assert_eq!((s.seconds_solid, s.cells, s.seconds_moments), (0.0, 0, 0.0));
    assert_eq!((g.seconds_read, g.seconds_check), (s.seconds_read, s.seconds_check));
    assert!(g.seconds_solid > 0.0 && g.cells > 0 && g.seconds_moments > 0.0);
    assert_eq!((g.seconds_generate, g.transforms, g.spheres_tried), (0.0, 0, 0));
    let (a, b) = (counters(first), counters(second));
    for c in [a, b] {
        assert!(c.seconds_read > 0.0 && c.seconds_check > 0.0 && c.seconds_solid > 0.0);
        assert!(c.seconds_generate > 0.0 && c.seconds_moments > 0.0);
        assert!(c.cells > 0 && c.peak_bytes >= c.cells && c.transforms > 0 && c.maxima > 0);
    }
    // What was not wanted costs nothing.
    assert_eq!((a.seconds_measure, a.columns), (0.0, 0));
    assert_eq!(a.exact_distances, b.exact_distances);
    assert!(b.seconds_measure > 0.0 && b.columns > 0);
    // The same work, counted once on either road.
    assert_eq!(
        (a.cells, a.seconds_read, a.seconds_check),
        (b.cells, b.seconds_read, b.seconds_check)
    );
    unsafe {
        morula_clump_free(first);
        morula_clump_free(second);
        morula_solid_free(solid);
        morula_shape_free(shape);
    }
}

#[test]
fn the_bound_of_the_distances_comes_through() {
    let shape = primitive(c"ellipsoid", null());
    let (mut clump, mut surface) = (null_mut(), sized::<morula_surface>());
    let mut options: morula_clump_options = sized();
    unsafe {
        morula_clump_options_init(&mut options, size_of::<morula_clump_options>());
        options.spheres = 3;
        options.wants = MORULA_WANT_SURFACE;
        assert_eq!(morula_clump_from_shape(shape, null(), &options, &mut clump), 0);
        assert_eq!(morula_clump_surface(clump, &mut surface), 0);
        let q = (*clump).inner.quality.as_ref().unwrap();
        assert!(surface.distance_bound > 0.0 && surface.distance_bound == q.distance_bound);
        assert_eq!((surface.hausdorff, surface.roughness), (q.hausdorff, q.roughness));
        morula_clump_free(clump);
        morula_shape_free(shape);
    }
}

#[test]
fn a_density_that_overflows_is_refused() {
    let mut import: morula_import_options = sized();
    unsafe { morula_import_options_init(&mut import, size_of::<morula_import_options>()) };
    import.length_unit = 1e30;
    let shape = primitive(c"ellipsoid", &import);
    let mut solid = null_mut();
    let mut m: morula_moments = sized();
    unsafe {
        assert_eq!(morula_solid_from_shape(shape, null(), &mut solid), 0);
        assert_eq!(morula_shape_moments(shape, 1e100, &mut m), 0, "{}", message());
        assert!(m.inertia.iter().chain(&m.principal).all(|v| v.is_finite()));
        let before = m.mass;
        // The mass alone still fits at the first of them.
        for density in [1e200, 1e300] {
            for status in [
                morula_shape_moments(shape, density, &mut m),
                morula_solid_moments(solid, density, &mut m),
            ] {
                assert_eq!(status, MORULA_STATUS_INVALID_ARGUMENT);
                assert!(message().contains("density is 1"), "{}", message());
                assert_eq!(m.mass, before);
            }
        }
        morula_solid_free(solid);
        morula_shape_free(shape);
    }
}

#[test]
fn labels_are_written_to_all_arrays_or_to_none() {
    let (labels, dims) = ([0u32, 7, 7, 3], [4usize, 1, 1]);
    let (mut ids, mut cells) = ([9u32; 2], [9u64; 2]);
    let (mut boxes, mut touches) = ([9u64; 13], [9i32; 2]);
    unsafe {
        let askew = boxes.as_mut_ptr().cast::<u8>().add(1).cast();
        let copy = |boxes, ids: &mut [u32; 2], cells: &mut [u64; 2], touches: &mut [i32; 2]| {
            let (i, c, t) = (ids.as_mut_ptr(), cells.as_mut_ptr(), touches.as_mut_ptr());
            morula_labels_copy(labels.as_ptr(), dims.as_ptr(), 2, i, c, boxes, t)
        };
        let status = copy(askew, &mut ids, &mut cells, &mut touches);
        assert_eq!(status, MORULA_STATUS_INVALID_ARGUMENT);
        assert!(message().contains("boxes"), "{}", message());
        assert_eq!((ids, cells, touches), ([9; 2], [9; 2], [9; 2]));
        assert_eq!(copy(boxes.as_mut_ptr(), &mut ids, &mut cells, &mut touches), 0);
    }
    assert_eq!((ids, cells, touches), ([3, 7], [1, 2], [1, 1]));
    assert_eq!(boxes, [3, 0, 0, 3, 0, 0, 1, 0, 0, 2, 0, 0, 9]);
}

#[test]
fn a_parameter_s_default_can_be_asked_for_alone() {
    let copy = |capacity, key, length, value| unsafe {
        morula_primitive_copy_parameter(c"sphere".as_ptr(), 0, capacity, key, length, value)
    };
    let (mut value, mut length, mut key) = ([0.0f64; 2], 99usize, [1 as std::ffi::c_char; 64]);
    assert_eq!(copy(0, null_mut(), null_mut(), value.as_mut_ptr()), 0);
    assert!(value[0] > 0.0);
    assert_eq!(copy(0, null_mut(), null_mut(), null_mut()), 0);
    // Nothing is written when one of the others cannot be.
    let askew = unsafe { value.as_mut_ptr().cast::<u8>().add(1).cast() };
    assert_eq!(copy(64, key.as_mut_ptr(), &mut length, askew), MORULA_STATUS_INVALID_ARGUMENT);
    assert_eq!((length, key[0]), (99, 1));
    assert_eq!(copy(64, null_mut(), &mut length, null_mut()), MORULA_STATUS_NULL_POINTER);
    assert_eq!(length, 99);
}

#[test]
fn a_struct_size_beyond_any_release_is_refused() {
    let mut options = [sized::<morula_clump_options>(); 40];
    for (size, status) in [(4096, 0), (4097, MORULA_STATUS_STRUCT_SIZE)] {
        assert_eq!(unsafe { morula_clump_options_init(options.as_mut_ptr(), size) }, status);
    }
}
