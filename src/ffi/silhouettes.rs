//! Shapes from silhouettes.

use super::choices::{MORULA_CARVE_CENTRES, MORULA_CARVE_TOUCHED};
use super::guard::slice;
use super::shape::{make, morula_shape};
use super::structs::morula_import_options;
use crate::error::{Error, Result, reserve};
use crate::run::Run;
use crate::shape::{Carve, ImportOptions, Shape, Silhouette};

/// One mask of the caller's row of masks.
fn part<'a>(i: usize, masks: &mut &'a [u8], width: usize, height: usize) -> Result<&'a [u8]> {
    let pixels = width.checked_mul(height).filter(|n| *n <= masks.len()).ok_or_else(|| {
        Error::TooLarge(format!("silhouette {i} has {width} x {height} pixels, too many to count"))
    })?;
    let (mask, rest) = masks.split_at(pixels);
    *masks = rest;
    Ok(mask)
}

/// Makes a shape from silhouettes of a particle seen by calibrated cameras: the
/// visual hull, carved out of voxels. It contains the body, and comes closer with
/// more cameras; a dent that no outline shows stays filled.
///
/// Parameters: `count` silhouettes. `masks` holds all of them one behind the other,
/// a byte for each pixel, row by row: not 0 where the particle is seen. Silhouette k
/// has `widths[k]` columns and `heights[k]` rows; the pixel of column i and row j is
/// element i + j times width and covers [i, i+1] x [j, j+1]. Space outside an image
/// is empty; a silhouette that touches the border of its image is noted. `cameras`
/// holds 12 numbers for each, the 3 x 4 matrix P row by row: (u, v, w) = P (x, y, z, 1)
/// is seen at column u/w and row v/w, with w > 0 in front of the camera. `cells`
/// along the longest edge of the hull's box, 4 to 2048. `carve` is one of
/// MORULA_CARVE_*. `options` may be NULL for the defaults.
/// Returns: MORULA_STATUS_OK; NULL_POINTER; INVALID_ARGUMENT (no pixel, cells,
/// carve, a camera without rank 3, cameras that bound no body, an option);
/// NOT_FINITE (a camera); EMPTY (a silhouette without particle, or no point lies
/// within all of them); SEVERAL_BODIES; STRUCT_SIZE; TOO_LARGE; MEMORY_LIMIT;
/// OUT_OF_MEMORY; CANCELLED; INTERNAL.
/// Ownership: the arrays are copied; free *shape with morula_shape_free().
/// *shape is written only on success.
/// Threads: any thread; calls are independent of each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_shape_from_silhouettes(
    count: usize,
    masks: *const u8,
    widths: *const usize,
    heights: *const usize,
    cameras: *const f64,
    cells: usize,
    carve: i32,
    options: *const morula_import_options,
    shape: *mut *mut morula_shape,
) -> i32 {
    let from = |import: &ImportOptions, run: &Run| {
        let carve = match carve {
            MORULA_CARVE_TOUCHED => Carve::Touched,
            MORULA_CARVE_CENTRES => Carve::Centres,
            other => {
                return Err(Error::InvalidArgument(format!("carve is {other}, no choice")));
            }
        };
        let widths = unsafe { slice(widths, count, "widths")? };
        let heights = unsafe { slice(heights, count, "heights")? };
        let sizes = || widths.iter().zip(heights);
        let pixels = sizes().try_fold(0usize, |n, (w, h)| n.checked_add(w.checked_mul(*h)?));
        let pixels = pixels.ok_or_else(|| {
            Error::TooLarge(format!("{count} silhouettes have more pixels than can be counted"))
        })?;
        let mut masks = unsafe { slice(masks, pixels, "masks")? };
        let numbers = count.checked_mul(12).ok_or_else(|| {
            Error::TooLarge(format!("{count} cameras have more numbers than can be counted"))
        })?;
        let (cameras, _) = unsafe { slice(cameras, numbers, "cameras")? }.as_chunks::<12>();
        let mut silhouettes = reserve("silhouettes", count)?;
        for (i, ((&width, &height), camera)) in sizes().zip(cameras).enumerate() {
            let mask = part(i, &mut masks, width, height)?;
            silhouettes.push(Silhouette { mask, width, height, camera: *camera });
        }
        Shape::from_silhouettes(&silhouettes, cells, carve, import, run)
    };
    unsafe { make(options, shape, from) }
}
