//! Voxel values of any number type, brought to the few types that the library keeps.

use super::RawValues;
use crate::error::{Error, Result, reserve};

/// Values as a file holds them.
pub(super) enum Numbers {
    U8(Vec<u8>),
    U16(Vec<u16>),
    U32(Vec<u32>),
    U64(Vec<u64>),
    I8(Vec<i8>),
    I16(Vec<i16>),
    I32(Vec<i32>),
    I64(Vec<i64>),
    F32(Vec<f32>),
    F64(Vec<f64>),
}

/// Whole numbers up to this are exact in single precision.
const EXACT: i64 = 1 << 24;

impl Numbers {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Numbers::U8(v) => v.len(),
            Numbers::U16(v) => v.len(),
            Numbers::U32(v) => v.len(),
            Numbers::U64(v) => v.len(),
            Numbers::I8(v) => v.len(),
            Numbers::I16(v) => v.len(),
            Numbers::I32(v) => v.len(),
            Numbers::I64(v) => v.len(),
            Numbers::F32(v) => v.len(),
            Numbers::F64(v) => v.len(),
        }
    }

    /// Adds values of the same type.
    pub fn append(&mut self, more: Numbers) -> Result<()> {
        match (self, more) {
            (Numbers::U8(a), Numbers::U8(b)) => grow(a, b),
            (Numbers::U16(a), Numbers::U16(b)) => grow(a, b),
            (Numbers::U32(a), Numbers::U32(b)) => grow(a, b),
            (Numbers::U64(a), Numbers::U64(b)) => grow(a, b),
            (Numbers::I8(a), Numbers::I8(b)) => grow(a, b),
            (Numbers::I16(a), Numbers::I16(b)) => grow(a, b),
            (Numbers::I32(a), Numbers::I32(b)) => grow(a, b),
            (Numbers::I64(a), Numbers::I64(b)) => grow(a, b),
            (Numbers::F32(a), Numbers::F32(b)) => grow(a, b),
            (Numbers::F64(a), Numbers::F64(b)) => grow(a, b),
            _ => Err(Error::Format("holds another type of number than those before".into())),
        }
    }

    /// The values in a type that holds them; conversions that a user should know
    /// are said in `notes`.
    pub fn plain(self, notes: &mut Vec<String>) -> Result<RawValues> {
        Ok(match self {
            Numbers::U8(v) => RawValues::U8(v),
            Numbers::U16(v) => RawValues::U16(v),
            Numbers::U32(v) => RawValues::U32(v),
            Numbers::F32(v) => RawValues::F32(v),
            Numbers::I8(v) => whole(&v, RawValues::U8, notes)?,
            Numbers::I16(v) => whole(&v, RawValues::U16, notes)?,
            Numbers::I32(v) => whole(&v, RawValues::U32, notes)?,
            Numbers::I64(v) => whole(&v, RawValues::U32, notes)?,
            Numbers::U64(v) => RawValues::U32(map(&v, |i, x| {
                u32::try_from(x).map_err(|_| {
                    Error::Unsupported(format!("voxel {i} is {x}, more than 32 bits hold"))
                })
            })?),
            Numbers::F64(v) => {
                let values = map(&v, |i, x: f64| {
                    if !x.is_finite() {
                        return Err(Error::NotFinite(format!("voxel {i} is {x}")));
                    }
                    if x.abs() > f64::from(f32::MAX) {
                        return Err(Error::Unsupported(format!(
                            "voxel {i} is {x:e}, beyond single precision"
                        )));
                    }
                    Ok(x as f32)
                })?;
                if v.iter().zip(&values).any(|(&x, &y)| x != f64::from(y)) {
                    notes.push("voxel values were rounded from double to single precision".into());
                }
                RawValues::F32(values)
            }
        })
    }
}

fn grow<T: Copy>(all: &mut Vec<T>, more: Vec<T>) -> Result<()> {
    all.try_reserve(more.len())
        .map_err(|_| Error::OutOfMemory(format!("no memory for {} more voxels", more.len())))?;
    all.extend_from_slice(&more);
    Ok(())
}

fn map<T: Copy, U>(values: &[T], f: impl Fn(usize, T) -> Result<U>) -> Result<Vec<U>> {
    let mut out = reserve("voxel values", values.len())?;
    for (i, &v) in values.iter().enumerate() {
        out.push(f(i, v)?);
    }
    Ok(out)
}

/// Whole numbers in the unsigned type if it holds them all, else in single precision.
fn whole<T: Copy + Into<i64>, U: TryFrom<i64>>(
    values: &[T],
    unsigned: fn(Vec<U>) -> RawValues,
    notes: &mut Vec<String>,
) -> Result<RawValues> {
    let fit = |&v: &T| U::try_from(v.into()).ok();
    if values.iter().all(|v| fit(v).is_some()) {
        let mut out = reserve("voxel values", values.len())?;
        out.extend(values.iter().filter_map(fit));
        return Ok(unsigned(out));
    }
    if values.iter().any(|&v| !(-EXACT..=EXACT).contains(&v.into())) {
        notes.push(format!(
            "voxel values beyond 2^24 were rounded from {}-bit integers to single precision",
            8 * size_of::<T>()
        ));
    }
    Ok(RawValues::F32(map(values, |_, v| Ok(v.into() as f32))?))
}
