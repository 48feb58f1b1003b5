//! From the voxels of a file to a shape, by what the values mean.

use super::{FileOptions, Format, Meaning, RawValues, RawVoxels, Reading, npy, raw, tiff};
use crate::error::{Error, Result, reserve};
use crate::run::Run;
use crate::shape::Shape;
use crate::shape::voxels::{Grey, Threshold, widen_labels};

/// The voxels of a file.
pub(super) fn read(
    bytes: &[u8],
    format: Format,
    options: &FileOptions,
    reading: &Reading,
) -> Result<RawVoxels> {
    reading.run.check(0.0, "reading the voxels")?;
    match format {
        Format::Npy => npy::read(bytes, options, reading),
        Format::Tiff => tiff::read(bytes, options, reading),
        Format::Raw => raw::read(bytes, options, reading),
        _ => Err(Error::Internal(format!("{format:?} is no voxel format"))),
    }
}

/// Refuses `cells` values that take more than the limit, at `each` bytes.
pub(super) fn limit(cells: usize, each: usize, reading: &Reading) -> Result<()> {
    reading.allow(cells as u128 * each as u128, || format!("{cells} voxels"))
}

/// The shape of the voxels of a file.
pub(super) fn shape(voxels: RawVoxels, options: &FileOptions, run: &Run) -> Result<Shape> {
    let RawVoxels { layout, values, notes } = voxels;
    let import = &options.import;
    // What is held while the shape is made: the values, and a mask or labels made of them.
    let bytes = values.bytes();
    let (cells, limit) = (values.len() as u64, import.memory_limit);
    let more = match (&values, options.meaning) {
        (RawValues::U8(_), Meaning::Auto) => 0,
        (RawValues::U32(_), Meaning::Label(_)) => 0,
        (_, Meaning::Label(_)) => 4 * cells,
        (RawValues::U32(_), _) => 4 * cells,
        (_, Meaning::Auto) => cells,
        (_, Meaning::Grey(_)) => 0,
    };
    within(cells, bytes.saturating_add(more), limit)?;
    let bytes = bytes + more;
    let label_like = match options.meaning {
        Meaning::Auto if !is_mask(&values) => label_like(&values),
        _ => 0,
    };
    let make = |mask: &[u8]| Shape::from_read_mask(mask, &layout, import, bytes, run);
    let mut shape = match options.meaning {
        Meaning::Label(label) => {
            let labels = as_labels(values)?;
            Shape::from_read_label(&labels, &layout, label, import, bytes, run)
        }
        Meaning::Auto if is_mask(&values) => match &values {
            RawValues::U8(v) => make(v),
            RawValues::U16(v) => make(&mask(v)?),
            RawValues::U32(v) => make(&mask(v)?),
            RawValues::F32(v) => make(&mask(v)?),
        },
        Meaning::Auto | Meaning::Grey(_) => {
            let threshold = match options.meaning {
                Meaning::Grey(threshold) => threshold,
                _ => Threshold::Otsu,
            };
            let grey =
                |values| Shape::from_read_grey(values, &layout, threshold, import, bytes, run);
            match &values {
                RawValues::U8(v) => grey(Grey::U8(v)),
                RawValues::U16(v) => grey(Grey::U16(v)),
                RawValues::F32(v) => grey(Grey::F32(v)),
                RawValues::U32(v) => match v.iter().all(|&x| x <= u32::from(u16::MAX)) {
                    true => grey(Grey::U16(&convert(v, |x| x as u16)?)),
                    false => grey(Grey::F32(&convert(v, |x| x as f32)?)),
                },
            }
        }
    }
    .map_err(|e| match e {
        Error::SeveralBodies(text) if label_like > 0 => Error::SeveralBodies(format!(
            "{text}, or one label, if its {label_like} different whole values are labels"
        )),
        e => e,
    })?;
    shape.report.notes.splice(0..0, notes);
    if label_like > 0 {
        shape.report.label_like = label_like;
        shape.report.notes.push(format!(
            "the volume holds {label_like} different whole values and may be one of labels: if it is, \
             say which label is the particle"
        ));
    }
    Ok(shape)
}

fn convert<T: Copy, U>(values: &[T], f: impl Fn(T) -> U) -> Result<Vec<U>> {
    let mut out = reserve("voxel values", values.len())?;
    out.extend(values.iter().map(|&v| f(v)));
    Ok(out)
}

fn mask<T: Copy + Default + PartialEq>(values: &[T]) -> Result<Vec<u8>> {
    convert(values, |v| u8::from(v != T::default()))
}

/// Whether there is one value only, or 0 and another.
fn is_mask(values: &RawValues) -> bool {
    fn of<T: Copy + Default + PartialEq>(values: &[T]) -> bool {
        let zero = T::default();
        let Some(&first) = values.first() else { return true };
        let Some(&other) = values.iter().find(|&&v| v != first) else { return true };
        (first == zero || other == zero) && values.iter().all(|&v| v == first || v == other)
    }
    match values {
        RawValues::U8(v) => of(v),
        RawValues::U16(v) => of(v),
        RawValues::U32(v) => of(v),
        RawValues::F32(v) => v.iter().all(|x| x.is_finite()) && of(v),
    }
}

/// Most different values of a volume that is taken for one of labels: few beside the 256 or
/// more of a scan.
const FEW: usize = 64;

/// How many different values there are, if they may be labels: whole numbers, not negative, and
/// few. Else 0.
fn label_like(values: &RawValues) -> u64 {
    fn of<T: Copy + PartialOrd>(values: &[T], whole: impl Fn(T) -> bool) -> u64 {
        let mut seen: Vec<T> = Vec::new();
        let mut last = None;
        for &v in values {
            // Labels come in runs.
            if last == Some(v) {
                continue;
            }
            last = Some(v);
            let at = seen.partition_point(|&x| x < v);
            if seen.get(at) != Some(&v) {
                if seen.len() == FEW || !whole(v) {
                    return 0;
                }
                seen.insert(at, v);
            }
        }
        seen.len() as u64
    }
    match values {
        RawValues::U8(v) => of(v, |_| true),
        RawValues::U16(v) => of(v, |_| true),
        RawValues::U32(v) => of(v, |_| true),
        RawValues::F32(v) => of(v, |x| (0.0..4_294_967_296.0).contains(&x) && x.fract() == 0.0),
    }
}

/// The values as labels, both within the limit.
pub(super) fn labels(values: RawValues, limit: u64) -> Result<Vec<u32>> {
    let cells = values.len() as u64;
    let more = if matches!(values, RawValues::U32(_)) { 0 } else { 4 * cells };
    within(cells, values.bytes().saturating_add(more), limit)?;
    as_labels(values)
}

/// Refuses voxels that take more than the limit, with what is made of them.
fn within(cells: u64, bytes: u64, limit: u64) -> Result<()> {
    if bytes <= limit {
        return Ok(());
    }
    Err(Error::MemoryLimit(format!(
        "{cells} voxels and what is made of them need {bytes} bytes, the limit is {limit}"
    )))
}

/// The values as labels.
fn as_labels(values: RawValues) -> Result<Vec<u32>> {
    match values {
        RawValues::U8(v) => widen_labels(&v),
        RawValues::U16(v) => widen_labels(&v),
        RawValues::U32(v) => Ok(v),
        RawValues::F32(v) => {
            // Below 2^32, whole and not negative.
            let bad =
                v.iter().position(|&x| !((0.0..4_294_967_296.0).contains(&x) && x.fract() == 0.0));
            match bad {
                Some(i) => Err(Error::InvalidArgument(format!(
                    "voxel {i} is {}, not a label: labels are whole numbers from 0 to 2^32 - 1",
                    v[i]
                ))),
                None => convert(&v, |x| x as u32),
            }
        }
    }
}
