//! Checks of what the caller hands in, before any work.

use crate::error::{Error, Result, count, figure, reserve};
use crate::math::{UnitFrame, Vec3};
use crate::shape::ImportOptions;

/// Lengths outside of this range would overflow or vanish in an inertia (length⁵).
const SIZES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// The options lie in their ranges.
pub fn options(options: &ImportOptions) -> Result<()> {
    let t = options.weld_tolerance;
    if !(0.0..=1e-3).contains(&t) {
        return Err(Error::InvalidArgument(format!(
            "weld_tolerance is {}, outside of 0 to 0.001 of the longest edge",
            figure(t)
        )));
    }
    let u = options.length_unit;
    if !(u.is_finite() && SIZES.contains(&u)) {
        return Err(Error::InvalidArgument(format!(
            "length_unit is {}, not a length between {:e} and {:e}",
            figure(u),
            SIZES.start(),
            SIZES.end()
        )));
    }
    Ok(())
}

/// How finely the caller's coordinates tell places apart, in the unit frame. Far from the
/// origin that is coarser than the rounding of the work itself, and what is nearer than
/// a few such steps cannot be told from what touches.
#[derive(Debug, Clone, Copy)]
pub struct Grain(f64);

impl Grain {
    /// The grain in `frame`.
    pub fn of(frame: &UnitFrame) -> Grain {
        Grain(4.0 * f64::EPSILON * (1.0 + frame.offset.amax() / frame.scale))
    }

    /// What is nearer than this may be in one place.
    pub fn rounding(self) -> f64 {
        self.0
    }

    /// Parts nearer than this touch.
    pub fn touch(self) -> f64 {
        self.0.max(1e-9)
    }

    /// A face lower than this has no area: the rounding of coordinates of size one, with room
    /// for a few operations.
    pub fn flat(self) -> f64 {
        self.0.max(1e-12)
    }
}

/// There are faces, no more than can be indexed, and memory for them beside the `held` bytes
/// of a file.
pub fn counts(vertices: usize, faces: usize, held: u64, options: &ImportOptions) -> Result<()> {
    if faces == 0 {
        return Err(Error::Empty(format!(
            "the mesh has {} but no faces",
            count(vertices as u64, "vertex")
        )));
    }
    let most = (u32::MAX / 4) as usize;
    if vertices > most || faces > most {
        return Err(Error::TooLarge(format!(
            "{vertices} vertices and {faces} faces are more than the {most} that can be indexed"
        )));
    }
    // While welding: points, unit points, a table, a tree. Later: edges, neighbours, parts,
    // trees over faces.
    let (v, f) = (vertices as u64, faces as u64);
    let bytes = u64::max(v * 120 + f * 24, v * 60 + f * 200);
    if bytes.saturating_add(held) > options.memory_limit {
        let beside = if held > 0 { format!(" beside the {held} as read") } else { String::new() };
        return Err(Error::MemoryLimit(format!(
            "{vertices} vertices and {faces} faces need about {bytes} bytes{beside}, the limit \
             is {}",
            options.memory_limit
        )));
    }
    Ok(())
}

/// The vertices in the caller's unit, after `length_unit`.
pub fn scaled(vertices: &[[f64; 3]], unit: f64) -> Result<Vec<Vec3>> {
    let mut points = reserve("vertices", vertices.len())?;
    for (i, v) in vertices.iter().enumerate() {
        for (axis, &x) in ["x", "y", "z"].iter().zip(v) {
            if !x.is_finite() {
                return Err(Error::NotFinite(format!("vertex {i} has {axis} = {x}")));
            }
            if x.abs() > *SIZES.end() / unit.max(1.0) {
                return Err(Error::InvalidArgument(format!(
                    "vertex {i} has {axis} = {x:e}, beyond {:e}",
                    SIZES.end()
                )));
            }
        }
        points.push(Vec3::from(*v) * unit);
    }
    Ok(points)
}

/// Every face names vertices that exist.
pub fn indices(faces: &[[u32; 3]], vertices: usize) -> Result<()> {
    for (i, f) in faces.iter().enumerate() {
        if let Some(v) = f.iter().find(|&&v| v as usize >= vertices) {
            return Err(Error::IndexOutOfRange(format!(
                "face {i} names vertex {v}, but the mesh has only {} (counted from 0)",
                count(vertices as u64, "vertex")
            )));
        }
    }
    Ok(())
}

/// The unit frame of the vertices that the faces use.
pub fn frame_of(points: &[Vec3], faces: &[[u32; 3]]) -> Result<UnitFrame> {
    let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    for &v in faces.iter().flatten() {
        lo = lo.inf(&points[v as usize]);
        hi = hi.sup(&points[v as usize]);
    }
    let edge = (hi - lo).max();
    if edge > 0.0 && !SIZES.contains(&edge) {
        return Err(Error::InvalidArgument(format!(
            "the longest edge of the bounding box is {edge:e}, outside of {:e} to {:e}",
            SIZES.start(),
            SIZES.end()
        )));
    }
    UnitFrame::of_box(lo, hi).ok_or_else(|| {
        let faces = count(faces.len() as u64, "face");
        Error::ZeroVolume(format!("the mesh of {faces} is a single point: no volume"))
    })
}
