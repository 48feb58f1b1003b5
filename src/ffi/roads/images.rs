//! Shapes from images: grey values, labels, silhouettes.

use super::many::DIMS;
use super::*;

fn import(g: &Given, progress: morula_progress, user: *mut c_void) -> morula_import_options {
    let mut o = options!(morula_import_options, morula_import_options_init);
    (o.threads, o.progress, o.user) = (g.threads, progress, user);
    o
}

/// Along x and along y on a square of the image.
const CAMERAS: [f64; 24] = [
    0., 4., 0., 8., 0., 0., 4., 8., 0., 0., 0., 1., //
    4., 0., 0., 8., 0., 0., 4., 8., 0., 0., 0., 1.,
];

pub const ROADS: &[Call] = &[
    Call {
        name: "shape_from_label",
        run: |g, progress, user, _| {
            let o = import(g, progress, user);
            let labels: Vec<u32> = (0..360).map(|i| u32::from(i % 10 > 3 && i / 60 > 1)).collect();
            let (labels, p) = (labels.as_ptr(), null());
            made!(
                |out| morula_shape_from_label(labels, DIMS.as_ptr(), p, p, 1, &o, out),
                of_shape,
                morula_shape_free
            )
        },
    },
    Call {
        name: "shape_from_grey_f32",
        run: |g, progress, user, _| {
            let o = import(g, progress, user);
            let values: Vec<f32> = (0..360).map(|i| (i % 10) as f32 * 0.3).collect();
            let (values, p) = (values.as_ptr(), null());
            made!(
                |out| morula_shape_from_grey_f32(values, DIMS.as_ptr(), p, p, p, &o, out),
                of_shape,
                morula_shape_free
            )
        },
    },
    Call {
        name: "shape_from_silhouettes",
        run: |g, progress, user, _| {
            let o = import(g, progress, user);
            let mask = |i: usize| u8::from((3..13).contains(&(i % 16)) && i / 16 % 16 > 4);
            let masks: Vec<u8> = (0..512).map(mask).collect();
            let sides = [16, 16];
            let (masks, sides, cameras) = (masks.as_ptr(), sides.as_ptr(), CAMERAS.as_ptr());
            made!(
                |out| morula_shape_from_silhouettes(
                    2,
                    masks,
                    sides,
                    sides,
                    cameras,
                    8,
                    MORULA_CARVE_TOUCHED,
                    &o,
                    out
                ),
                of_shape,
                morula_shape_free
            )
        },
    },
    #[cfg(feature = "io")]
    Call {
        name: "labels_from_bytes",
        run: |g, progress, user, _| {
            let o = import(g, progress, user);
            let mut file = options!(morula_file_options, morula_file_options_init);
            (file.format, file.raw_dims, file.raw_type) =
                (MORULA_FORMAT_RAW, [3, 2, 2], MORULA_RAW_U8);
            let (bytes, mut ids, mut n) = ([0u8, 1, 1, 0, 2, 2, 0, 1, 0, 0, 2, 0], [0; 4], 0);
            let status = unsafe {
                morula_labels_from_bytes(
                    bytes.as_ptr(),
                    12,
                    c"labels.raw".as_ptr(),
                    &o,
                    &file,
                    4,
                    ids.as_mut_ptr(),
                    null_mut(),
                    null_mut(),
                    null_mut(),
                    &mut n,
                )
            };
            let bytes = || ids[..n].iter().flat_map(|i| i.to_le_bytes()).collect();
            assert!(status == 0 || !message().is_empty());
            (status, (status == 0).then(bytes))
        },
    },
];
