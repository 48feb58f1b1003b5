//! Files of each format, from memory.

use super::*;
use std::ptr::null;

fn imports(choice: u8) -> morula_import_options {
    let mut options: morula_import_options = sized();
    assert!(ok(unsafe { morula_import_options_init(&mut options, size_of_val(&options)) }));
    options.memory_limit = LIMIT;
    options.bodies = i32::from(choice % 3);
    options.weld_tolerance = [1e-6, 0.0, 0.1][usize::from(choice / 3 % 3)];
    options
}

fn defaults() -> morula_file_options {
    let mut file: morula_file_options = sized();
    assert!(ok(unsafe { morula_file_options_init(&mut file, size_of_val(&file)) }));
    file
}

/// Reads, and looks at all that a shape tells; made again from its bytes it is the same.
fn read(bytes: &[u8], import: &morula_import_options, file: &morula_file_options) {
    let mut shape = std::ptr::null_mut();
    unsafe {
        if !ok(morula_shape_from_bytes(
            bytes.as_ptr(),
            bytes.len(),
            null(),
            import,
            file,
            &mut shape,
        )) {
            assert!(shape.is_null());
            return;
        }
        MADE.set(MADE.get() + 1);
        look(shape);
        morula_shape_free(shape);
    }
}

/// All that a shape tells.
pub(super) unsafe fn look(shape: *const morula_shape) {
    let mut report: morula_report = sized();
    let mut moments: morula_moments = sized();
    let (mut count, mut size) = (0, 0);
    unsafe {
        assert!(ok(morula_shape_report(shape, &mut report)));
        finite(&[report.volume, report.area, report.length_unit, report.threshold]);
        finite(&report.box_min);
        finite(&report.box_max);
        assert!(ok(morula_shape_note_count(shape, &mut count)));
        for i in 0..count {
            let mut text = [0; 1024];
            ok(morula_shape_copy_note(
                shape,
                i,
                1024,
                text.as_mut_ptr(),
                null::<usize>().cast_mut(),
            ));
        }
        // The grid and the winding number of a large mesh take too long for this place.
        if report.faces < 300
            && report.solid_cells < 4096
            && ok(morula_shape_moments(shape, 1.0, &mut moments))
        {
            moments_are_real(&moments);
        }
        assert!(ok(morula_shape_serialize(shape, 0, std::ptr::null_mut(), &mut size)));
        let mut bytes = vec![0; size];
        assert!(ok(morula_shape_serialize(shape, size, bytes.as_mut_ptr(), &mut size)));
        let mut again = std::ptr::null_mut();
        assert!(ok(morula_shape_deserialize(bytes.as_ptr(), size, &mut again)));
        let mut other = vec![0; size];
        assert!(ok(morula_shape_serialize(again, size, other.as_mut_ptr(), &mut size)));
        assert_eq!(bytes, other);
        morula_shape_free(again);
    }
}

/// The first byte chooses the format, the second options.
pub fn meshes(data: &[u8]) {
    let mut input = Input(data);
    let mut file = defaults();
    file.format = i32::from(input.byte() % 5);
    let import = imports(input.byte());
    read(input.0, &import, &file);
}

/// npy, TIFF and raw volumes, as shapes and as labels.
pub fn voxels(data: &[u8]) {
    let mut input = Input(data);
    let mut file = defaults();
    let choice = input.byte();
    file.format = [MORULA_FORMAT_NPY, MORULA_FORMAT_TIFF, MORULA_FORMAT_RAW, MORULA_FORMAT_AUTO]
        [usize::from(choice % 4)];
    file.meaning = i32::from(choice / 4 % 4);
    file.npy_xyz = i32::from(choice / 16 % 2);
    file.raw_type = i32::from(choice / 32 % 3);
    let more = input.byte();
    let import = imports(more);
    file.threshold = f64::from(more) / 2.0;
    file.label = u32::from(more % 4);
    if file.format == MORULA_FORMAT_RAW {
        for d in &mut file.raw_dims {
            let b = input.byte();
            // Mostly small, now and then far too large.
            *d = if b == 255 { input.word() } else { u64::from(b % 32) };
        }
        file.raw_skip = u64::from(input.byte() % 8);
    }
    read(input.0, &import, &file);
    let mut count = 0;
    let (bytes, len) = (input.0.as_ptr(), input.0.len());
    unsafe {
        let nothing = std::ptr::null_mut();
        if !ok(morula_labels_from_bytes(
            bytes,
            len,
            null(),
            &import,
            &file,
            0,
            nothing,
            std::ptr::null_mut(),
            std::ptr::null_mut(),
            std::ptr::null_mut(),
            &mut count,
        )) {
            return;
        }
        let (mut ids, mut cells) = (vec![0; count], vec![0; count]);
        let (mut boxes, mut touches) = (vec![0; 6 * count], vec![0; count]);
        assert!(ok(morula_labels_from_bytes(
            bytes,
            len,
            null(),
            &import,
            &file,
            count,
            ids.as_mut_ptr(),
            cells.as_mut_ptr(),
            boxes.as_mut_ptr(),
            touches.as_mut_ptr(),
            &mut count,
        )));
        assert!(ids.windows(2).all(|w| w[0] < w[1]) && cells.iter().all(|&c| c > 0));
    }
}
