//! Triangle meshes from arrays: checked, welded, repaired where that is safe,
//! or refused with the reason.

mod repair;
mod topology;
mod weld;

use super::{Body, ImportOptions, Report, Shape};
use crate::error::{Error, Result, reserve};
use crate::math::{UnitFrame, Vec3};
use crate::run::{Run, Stage};
use topology::Edges;

/// A triangle mesh after checks, in the unit frame.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// Vertices.
    pub vertices: Vec<Vec3>,
    /// Vertex indices of each face, counter-clockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
    /// Watertight, oriented and manifold at its edges: crossings along a line may be
    /// counted. Otherwise inside is decided by the winding number.
    pub clean: bool,
}

impl Mesh {
    /// The corners of face `i`.
    pub fn corners(&self, i: usize) -> [Vec3; 3] {
        self.faces[i].map(|v| self.vertices[v as usize])
    }
}

impl Shape {
    /// A shape from a triangle mesh: `vertices` as x, y, z in the caller's unit
    /// and frame, `faces` as 0-based vertex indices.
    pub fn from_mesh(
        vertices: &[[f64; 3]],
        faces: &[[u32; 3]],
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        run.time(Stage::Check, || import(vertices, faces, options, run))
    }
}

/// Lengths outside of this range would overflow or vanish in an inertia (length⁵).
const SIZES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

fn import(
    vertices: &[[f64; 3]],
    faces: &[[u32; 3]],
    options: &ImportOptions,
    run: &Run,
) -> Result<Shape> {
    check_options(options)?;
    check_counts(vertices.len(), faces.len(), options)?;
    run.check(0.0, "checking the mesh")?;
    let points = scaled(vertices, options.length_unit)?;
    check_indices(faces, points.len())?;

    let mut report = Report {
        input_vertices: points.len() as u64,
        input_faces: faces.len() as u64,
        length_unit: options.length_unit,
        ..Report::default()
    };
    if options.length_unit != 1.0 {
        report.notes.push(format!("lengths were multiplied by {} on import", options.length_unit));
    }

    // A frame for the repair; the body's own follows when it is known what stays.
    let frame = frame_of(&points, faces)?;
    let unit: Vec<Vec3> = points.iter().map(|p| frame.to_unit(p)).collect();
    let root = weld::weld(&unit, faces, options.weld_tolerance)?;
    let mut used = vec![false; points.len()];
    faces.iter().flatten().for_each(|&v| used[v as usize] = true);
    report.welded_vertices =
        (0..points.len()).filter(|&i| used[i] && root[i] as usize != i).count() as u64;
    let mut kept: Vec<[u32; 3]> = reserve("faces", faces.len())?;
    kept.extend(faces.iter().map(|f| f.map(|v| root[v as usize])));
    run.check(0.3, "welding the mesh")?;

    report.degenerate_faces = repair::drop_degenerate(&mut kept, &unit)?;
    report.duplicate_faces = repair::drop_duplicates(&mut kept)?;
    if kept.is_empty() {
        return Err(Error::ZeroVolume(format!(
            "none of the {} faces encloses anything: {} have no area, {} cancel each other",
            faces.len(),
            report.degenerate_faces,
            report.duplicate_faces
        )));
    }
    let edges = Edges::of(&kept)?;
    let patches = topology::patches(&kept, &edges)?;
    run.check(0.6, "orienting the mesh")?;
    repair::orient(&mut kept, &unit, &edges, &patches, &mut report)?;
    let edges = Edges::of(&kept)?;
    report.boundary_edges = edges.boundary;
    report.nonmanifold_edges = edges.nonmanifold;
    report.watertight = edges.boundary == 0 && edges.nonmanifold == 0;
    report.oriented = edges.misoriented == 0;
    report.components = patches.count as u64;
    report.bodies = patches.count as u64;

    finish(&points, kept, report)
}

/// The shape of what stays: compact vertices, own unit frame, volume, area, box.
fn finish(points: &[Vec3], kept: Vec<[u32; 3]>, mut report: Report) -> Result<Shape> {
    let frame = frame_of(points, &kept)?;
    let mut index = crate::error::filled("vertex indices", points.len(), u32::MAX)?;
    let mut mesh =
        Mesh { vertices: Vec::new(), faces: kept, clean: report.watertight && report.oriented };
    let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    for corner in mesh.faces.iter_mut().flatten() {
        let old = *corner as usize;
        if index[old] == u32::MAX {
            index[old] = mesh.vertices.len() as u32;
            mesh.vertices.push(frame.to_unit(&points[old]));
            lo = lo.inf(&points[old]);
            hi = hi.sup(&points[old]);
        }
        *corner = index[old];
    }
    let (volume, area) = repair::volume_and_area(&mesh.vertices, &mesh.faces);
    report.vertices = mesh.vertices.len() as u64;
    report.faces = mesh.faces.len() as u64;
    report.volume = volume * frame.scale.powi(3);
    report.area = area * frame.scale * frame.scale;
    report.box_min = lo.into();
    report.box_max = hi.into();
    // A mean thickness below this is rounding: flat, or folded onto itself.
    if report.watertight && volume <= 1e-12 * area {
        return Err(Error::ZeroVolume(format!(
            "the {} faces enclose no volume ({:e} with an area of {:e})",
            report.faces, report.volume, report.area
        )));
    }
    Ok(Shape { body: Body::Mesh(mesh), frame, report })
}

fn check_options(options: &ImportOptions) -> Result<()> {
    let t = options.weld_tolerance;
    if !(0.0..=1e-3).contains(&t) {
        return Err(Error::InvalidArgument(format!(
            "weld_tolerance is {t}, outside of 0 to 0.001 of the longest edge"
        )));
    }
    let u = options.length_unit;
    if !(u.is_finite() && SIZES.contains(&u)) {
        return Err(Error::InvalidArgument(format!(
            "length_unit is {u}, not a length between {:e} and {:e}",
            SIZES.start(),
            SIZES.end()
        )));
    }
    Ok(())
}

fn check_counts(vertices: usize, faces: usize, options: &ImportOptions) -> Result<()> {
    if faces == 0 {
        return Err(Error::Empty(format!("the mesh has {vertices} vertices but no faces")));
    }
    let most = (u32::MAX / 4) as usize;
    if vertices > most || faces > most {
        return Err(Error::TooLarge(format!(
            "{vertices} vertices and {faces} faces are more than the {most} that can be indexed"
        )));
    }
    // Points, unit points, roots and sorting keys; faces, their edges and patches.
    let bytes = vertices as u64 * 120 + faces as u64 * 160;
    if bytes > options.memory_limit {
        return Err(Error::MemoryLimit(format!(
            "{vertices} vertices and {faces} faces need about {bytes} bytes, the limit is {}",
            options.memory_limit
        )));
    }
    Ok(())
}

/// The vertices in the caller's unit, after `length_unit`.
fn scaled(vertices: &[[f64; 3]], unit: f64) -> Result<Vec<Vec3>> {
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

fn check_indices(faces: &[[u32; 3]], vertices: usize) -> Result<()> {
    for (i, f) in faces.iter().enumerate() {
        if let Some(v) = f.iter().find(|&&v| v as usize >= vertices) {
            return Err(Error::IndexOutOfRange(format!(
                "face {i} names vertex {v}, but there are only {vertices} vertices (0 to {})",
                vertices as i64 - 1
            )));
        }
    }
    Ok(())
}

/// The unit frame of the vertices that the faces use.
fn frame_of(points: &[Vec3], faces: &[[u32; 3]]) -> Result<UnitFrame> {
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
    UnitFrame::of_box(lo, hi)
        .ok_or_else(|| Error::ZeroVolume(format!("all {} faces lie in one point", faces.len())))
}
