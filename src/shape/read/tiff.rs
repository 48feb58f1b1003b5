//! Multi-page TIFF: each page is a plane of constant z, the first one the
//! lowest; columns are x, rows are y.

use super::numbers::Numbers;
use super::{FileOptions, RawVoxels, Reading};
use crate::error::{Error, Result};
use crate::shape::Layout;
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::{ColorType, TiffError};

/// The voxels of a TIFF file.
pub(super) fn read(bytes: &[u8], options: &FileOptions, reading: &Reading) -> Result<RawVoxels> {
    let most = reading.limit.saturating_sub(reading.held);
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    let mut limits = Limits::default();
    limits.decoding_buffer_size = most;
    limits.intermediate_buffer_size = most;
    let mut decoder =
        Decoder::new(Cursor::new(bytes)).map_err(|e| failed(e, 0, options))?.with_limits(limits);

    let mut stack: Option<(u32, u32, Numbers)> = None;
    let mut pages = 0usize;
    loop {
        let size = decoder.dimensions().map_err(|e| failed(e, pages, options))?;
        let colour = decoder.colortype().map_err(|e| failed(e, pages, options))?;
        let bits = match colour {
            ColorType::Gray(bits @ (1 | 8 | 16 | 32 | 64)) => bits,
            other => {
                return Err(Error::Unsupported(format!(
                    "page {pages} of the TIFF is {other:?}; voxels are grey, of 1, 8, 16, 32 or 64 bits"
                )));
            }
        };
        if size.0 == 0 || size.1 == 0 {
            return Err(Error::Empty(format!(
                "page {pages} of the TIFF is {} x {}",
                size.0, size.1
            )));
        }
        if let Some((w, h, _)) = &stack
            && size != (*w, *h)
        {
            return Err(Error::Format(format!(
                "page {pages} of the TIFF is {} x {}, but the first is {w} x {h}",
                size.0, size.1
            )));
        }
        // What is there with this page, and a conversion of it.
        let plane = size.0 as usize * size.1 as usize;
        let each = usize::from(bits).div_ceil(8) + 4;
        super::voxels::limit(plane.saturating_mul(pages + 1), each, reading)?;
        reading.run.check(0.0, "reading the TIFF")?;
        let page = decoder.read_image().map_err(|e| failed(e, pages, options))?;
        let page = numbers(page, bits, size)?;
        if page.len() != plane {
            return Err(Error::Format(format!(
                "page {pages} of the TIFF holds {} values, not {} x {}",
                page.len(),
                size.0,
                size.1
            )));
        }
        match &mut stack {
            None => stack = Some((size.0, size.1, page)),
            Some((_, _, all)) => all.append(page).map_err(|e| match e {
                Error::Format(why) => Error::Format(format!("page {pages} of the TIFF {why}")),
                e => e,
            })?,
        }
        pages += 1;
        if !decoder.more_images() {
            break;
        }
        decoder.next_image().map_err(|e| failed(e, pages, options))?;
    }
    let Some((width, height, all)) = stack else {
        return Err(Error::Empty("the TIFF has no page".into()));
    };
    let mut notes = Vec::new();
    let values = all.plain(&mut notes)?;
    let dims = [width as usize, height as usize, pages];
    let layout = Layout { dims, spacing: options.spacing, origin: options.origin };
    Ok(RawVoxels { layout, values, notes })
}

fn numbers(page: DecodingResult, bits: u8, size: (u32, u32)) -> Result<Numbers> {
    Ok(match page {
        DecodingResult::U8(v) if bits == 1 => Numbers::U8(unpack(&v, size)?),
        DecodingResult::U8(v) => Numbers::U8(v),
        DecodingResult::U16(v) => Numbers::U16(v),
        DecodingResult::U32(v) => Numbers::U32(v),
        DecodingResult::U64(v) => Numbers::U64(v),
        DecodingResult::I8(v) => Numbers::I8(v),
        DecodingResult::I16(v) => Numbers::I16(v),
        DecodingResult::I32(v) => Numbers::I32(v),
        DecodingResult::I64(v) => Numbers::I64(v),
        DecodingResult::F32(v) => Numbers::F32(v),
        DecodingResult::F64(v) => Numbers::F64(v),
        DecodingResult::F16(_) => {
            return Err(Error::Unsupported("TIFF of 16-bit floating point is not read".into()));
        }
    })
}

/// One bit for each voxel, rows filled up to a byte, first voxel in the highest bit.
fn unpack(packed: &[u8], (width, height): (u32, u32)) -> Result<Vec<u8>> {
    let (width, height) = (width as usize, height as usize);
    let row = width.div_ceil(8);
    let mut out = crate::error::reserve("voxel values", width * height)?;
    for line in packed.chunks(row).take(height) {
        out.extend((0..width).filter_map(|i| Some(line.get(i / 8)? >> (7 - i % 8) & 1)));
    }
    Ok(out)
}

fn failed(error: TiffError, page: usize, options: &FileOptions) -> Error {
    match error {
        TiffError::UnsupportedError(e) => {
            Error::Unsupported(format!("page {page} of the TIFF cannot be read: {e}"))
        }
        TiffError::LimitsExceeded => Error::MemoryLimit(format!(
            "page {page} of the TIFF needs more memory than the limit of {} bytes",
            options.import.memory_limit
        )),
        e => Error::Format(format!("page {page} of the TIFF is malformed: {e}")),
    }
}
