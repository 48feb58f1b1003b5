//! Raw voxel data: dimensions and type are declared by the caller.

use super::{FileOptions, RawType, RawValues, RawVoxels, Reading};
use crate::error::{Error, Result, reserve};
use crate::shape::Layout;

/// The voxels of raw bytes, which must be as long as declared.
pub(super) fn read(bytes: &[u8], options: &FileOptions, reading: &Reading) -> Result<RawVoxels> {
    let Some((dims, kind, skip)) = options.raw else {
        return Err(Error::InvalidArgument(
            "raw data need dimensions, element type and bytes to skip".into(),
        ));
    };
    let size = match kind {
        RawType::U8 => 1,
        RawType::U16 => 2,
        RawType::F32 => 4,
    };
    let [nx, ny, nz] = dims;
    let cells = nx.checked_mul(ny).and_then(|n| n.checked_mul(nz));
    let cells = cells.ok_or_else(|| {
        Error::TooLarge(format!("{nx} x {ny} x {nz} voxels are more than can be counted"))
    })?;
    let expected = cells as u128 * size as u128 + skip as u128;
    if expected != bytes.len() as u128 {
        return Err(Error::Format(format!(
            "{nx} x {ny} x {nz} voxels of {size} bytes after {skip} bytes end at byte {expected}, \
             but the file ends at byte {}",
            bytes.len()
        )));
    }
    super::voxels::limit(cells, size, reading)?;
    let data = bytes.get(skip..).unwrap_or_default();
    let values = match kind {
        RawType::U8 => RawValues::U8(gather(data, |[b]| b)?),
        RawType::U16 => RawValues::U16(gather(data, u16::from_le_bytes)?),
        RawType::F32 => RawValues::F32(gather(data, f32::from_le_bytes)?),
    };
    let layout = Layout { dims, spacing: options.spacing, origin: options.origin };
    Ok(RawVoxels { layout, values, notes: Vec::new() })
}

fn gather<const N: usize, T>(data: &[u8], number: impl Fn([u8; N]) -> T) -> Result<Vec<T>> {
    let (chunks, _) = data.as_chunks::<N>();
    let mut out = reserve("voxel values", chunks.len())?;
    out.extend(chunks.iter().map(|&c| number(c)));
    Ok(out)
}
