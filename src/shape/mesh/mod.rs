//! Triangle meshes from arrays: checked, welded, repaired where that is safe,
//! or refused with the reason.

mod check;
mod cross;
mod field;
mod flat;
mod inside;
mod orient;
mod parts;
mod patches;
mod repair;
mod topology;
pub(crate) mod tree;
mod weld;

use super::{Bodies, Body, ImportOptions, Report, Shape};
use crate::error::{Error, Result, count, filled, push, reserve};
use crate::math::{UnitFrame, Vec3};
use crate::run::{Run, Stage};
use check::Grain;
use parts::Part;
use std::sync::Arc;
use topology::Edges;

/// A triangle mesh after checks, in the unit frame.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
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
    /// Bytes of its arrays.
    pub(crate) fn bytes(&self) -> u64 {
        (24 * self.vertices.len() + 12 * self.faces.len()) as u64
    }

    /// The corners of face `i`.
    #[inline]
    pub fn corners(&self, i: usize) -> [Vec3; 3] {
        let [a, b, c] = self.faces[i];
        [self.vertices[a as usize], self.vertices[b as usize], self.vertices[c as usize]]
    }

    /// Whether its numbers are those of a mesh after checks.
    pub(crate) fn check(&self) -> Result<()> {
        check::indices(&self.faces, self.vertices.len())?;
        let far = |v: &Vec3| !v.iter().all(|x| (-1.0..=2.0).contains(x));
        if let Some(i) = self.vertices.iter().position(far) {
            let v = self.vertices[i];
            return Err(Error::InvalidArgument(format!(
                "vertex {i} at {}, {}, {} is not in the unit frame",
                v.x, v.y, v.z
            )));
        }
        if self.faces.is_empty() {
            return Err(Error::Empty("a mesh without a face".into()));
        }
        let edges = Edges::of(&self.faces)?;
        if self.clean && edges.faulty() + edges.misoriented > 0 {
            return Err(Error::InvalidArgument("a closed mesh that is not closed".into()));
        }
        Ok(())
    }
}

impl Shape {
    /// A shape from a triangle mesh: `vertices` as x, y, z in the caller's unit
    /// and frame, `faces` as 0-based vertex indices.
    ///
    /// What is done to it, each with a count and a sentence in the [`Report`]:
    /// - vertices are welded as far as that closes the surface: equal ones, then those at
    ///   edges without exactly two faces within `weld_tolerance` of the longest edge of
    ///   the box (and a quarter of the median edge of the faces);
    /// - faces without area and faces present more than once are dropped, opposed ones
    ///   between two parts (inner walls) both;
    /// - neighbours are made to agree, and each part is turned outward; a part within
    ///   the solid of another that faces inward is a cavity, one that faces outward
    ///   is filled (non-zero rule);
    /// - loose sheets beside solid parts are dropped.
    ///
    /// Bodies: parts whose surfaces cross or lie on each other are one body, with the
    /// cavities in them. Parts that touch in points or along lines only are separate, as
    /// no material joins them; so is a part in another's cavity.
    ///
    /// A surface may be open where the generalised winding number still tells inside
    /// from outside. The measure is the mean over the surface of the fraction of all
    /// directions that are seen through openings: 0 when closed, 0.10 for a box
    /// without a lid, 0.19 for a hemisphere, ½ for a flat sheet. Above 0.4 the inside
    /// is not defined.
    ///
    /// Far from the origin coordinates are coarse: what is nearer than four of their steps
    /// touches, and faces lower than that have no area.
    ///
    /// Errors: `Empty`, `NotFinite`, `IndexOutOfRange`, `TooLarge`, `MemoryLimit`,
    /// `InvalidArgument` (options, or sizes outside of 1e-60 to 1e60), `ZeroVolume`,
    /// `OpenSurface`, `SeveralBodies`, `Cancelled`.
    pub fn from_mesh(
        vertices: &[[f64; 3]],
        faces: &[[u32; 3]],
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        Shape::from_read_mesh(vertices, faces, options, 0, run)
    }

    /// As [`Shape::from_mesh`], of arrays that a reader holds: `held` bytes of the limit.
    pub(crate) fn from_read_mesh(
        vertices: &[[f64; 3]],
        faces: &[[u32; 3]],
        options: &ImportOptions,
        held: u64,
        run: &Run,
    ) -> Result<Shape> {
        run.time(Stage::Check, || import(vertices, faces, options, held, run))
    }
}

fn import(
    vertices: &[[f64; 3]],
    faces: &[[u32; 3]],
    options: &ImportOptions,
    held: u64,
    run: &Run,
) -> Result<Shape> {
    check::options(options)?;
    check::counts(vertices.len(), faces.len(), held, options)?;
    run.check(0.0, "checking the mesh")?;
    let points = check::scaled(vertices, options.length_unit)?;
    check::indices(faces, points.len())?;

    let mut report = Report {
        input_vertices: points.len() as u64,
        input_faces: faces.len() as u64,
        length_unit: options.length_unit,
        notes: options.unit_note().into_iter().collect(),
        ..Report::default()
    };

    // A frame for the repair; the body's own follows when it is known what stays.
    let frame = check::frame_of(&points, faces)?;
    let mut unit: Vec<Vec3> = reserve("vertices", points.len())?;
    // 0 and -0 are one place.
    unit.extend(points.iter().map(|p| frame.to_unit(p).map(|x| x + 0.0)));
    let grain = Grain::of(&frame);
    run.check(0.2, "welding the mesh")?;
    let mut kept = repair::close(faces, &unit, options.weld_tolerance, grain)?;
    note_repairs(&kept, options, &mut report);
    let edges = kept.edges.take();
    let mut kept = kept.faces;
    if kept.is_empty() {
        return Err(Error::ZeroVolume(format!(
            "the mesh of {} encloses nothing: faces without area: {}, that cancel each other: {}",
            count(faces.len() as u64, "face"),
            report.degenerate_faces,
            report.duplicate_faces
        )));
    }

    run.check(0.4, "orienting the mesh")?;
    let edges = match edges {
        Some(edges) => edges,
        None => Edges::of(&kept)?,
    };
    report.boundary_edges = edges.boundary;
    report.nonmanifold_edges = edges.nonmanifold;
    let orient::Agreement { mut turn, one_sided } = orient::agree(&kept, &unit, &edges)?;
    let edges = if turn.contains(&true) {
        apply(&mut kept, &turn);
        Edges::of(&kept)?
    } else {
        edges
    };
    let topology::Patches { of, count } = topology::patches(&kept, &edges)?;
    report.components = count as u64;
    let extents = inside::extents(&kept, &unit, &of, count, &edges)?;
    let parts = parts::parts(&kept, &unit, &of, &extents)?;
    let mut parts = patches::join(parts, &kept, &unit, grain, run)?;
    let bodies = parts::bodies(&mut parts, &kept, &unit, grain, run)?;
    refuse_without_inside(&parts, &kept, &unit, one_sided, grain)?;
    let mut same = true;
    for part in parts.iter().filter(|p| p.turn) {
        same = false;
        for &f in &part.faces {
            kept[f as usize].swap(1, 2);
            turn[f as usize] ^= true;
        }
    }
    let stays = choose(&parts, &bodies, &frame, kept.len(), options.bodies, &mut report)?;
    let mut it = stays.iter();
    kept.retain(|_| it.next().is_some_and(|&s| s));
    let mut it = stays.iter();
    turn.retain(|_| it.next().is_some_and(|&s| s));
    note_turns(&turn, one_sided, &mut report);
    same &= stays.iter().all(|&s| s);
    finish(&points, kept, same.then_some(edges), report)
}

fn apply(faces: &mut [[u32; 3]], turn: &[bool]) {
    faces.iter_mut().zip(turn).filter(|f| *f.1).for_each(|f| f.0.swap(1, 2));
}

fn note_repairs(kept: &repair::Kept, options: &ImportOptions, report: &mut Report) {
    report.welded_vertices = kept.welded;
    report.degenerate_faces = kept.degenerate;
    report.duplicate_faces = kept.duplicate;
    let mut note = |n: u64, what: String| {
        if n > 0 {
            report.notes.push(what);
        }
    };
    note(
        kept.moved,
        format!(
            "welded {} that lay within {:e} of the longest edge to others",
            count(kept.moved, "vertex"),
            options.weld_tolerance
        ),
    );
    note(kept.degenerate, format!("dropped {} without area", count(kept.degenerate, "face")));
    let twice = kept.duplicate - kept.walls.min(kept.duplicate);
    note(twice, format!("dropped {} as copies of others", count(twice, "face")));
    note(kept.walls, format!("took out {} opposed faces that form inner walls", kept.walls));
}

fn note_turns(turn: &[bool], one_sided: bool, report: &mut Report) {
    let turned = turn.iter().filter(|&&t| t).count();
    report.inverted = turned > 0 && turned == turn.len();
    if report.inverted {
        report.notes.push("the whole surface was inside out and was turned".into());
    } else if turned > 0 {
        report.faces_turned = turned as u64;
        report.notes.push(format!(
            "turned {} to run as the neighbours do",
            count(report.faces_turned, "face")
        ));
    }
    if one_sided {
        report.notes.push(
            "the surface has places where neighbours cannot agree on a side (it is one-sided \
             there): inside is where the winding number is above ½"
                .into(),
        );
    }
}

/// The error when no part has an inside, or too much of the surface has none.
fn refuse_without_inside(
    parts: &[Part],
    faces: &[[u32; 3]],
    points: &[Vec3],
    one_sided: bool,
    grain: Grain,
) -> Result<()> {
    let area = |solid: bool| -> f64 {
        parts.iter().filter(|p| p.body.is_some() == solid).map(|p| p.extent.area).sum()
    };
    let (solid, loose) = (area(true), area(false));
    if loose <= solid && solid > 0.0 {
        return Ok(());
    }
    let n = count(faces.len() as u64, "face");
    if inside::is_flat(faces, points, grain) {
        return Err(Error::ZeroVolume(format!("the mesh of {n} lies in one plane: no volume")));
    }
    let thin = |p: &Part| p.openness <= inside::MOST_OPEN;
    if parts.iter().all(thin) {
        return Err(Error::ZeroVolume(format!(
            "the mesh of {n} encloses no volume: the surface lies folded on itself"
        )));
    }
    let (mut sum, mut all) = (0.0, 0.0);
    for p in parts {
        sum += p.openness * p.extent.area;
        all += p.extent.area;
    }
    let what = if one_sided { "open or one-sided" } else { "open" };
    Err(Error::OpenSurface(format!(
        "the surface is too {what} to have an inside: from its {n} {:.0} % of all \
         directions are seen through openings on average, more than {:.0} %",
        100.0 * sum / all,
        100.0 * inside::MOST_OPEN
    )))
}

/// Which faces stay.
fn choose(
    parts: &[Part],
    bodies: &parts::Bodies,
    frame: &UnitFrame,
    faces: usize,
    choice: Bodies,
    report: &mut Report,
) -> Result<Vec<bool>> {
    let several = bodies.volumes.len();
    report.bodies = several as u64;
    let mut largest = 0;
    for (i, v) in bodies.volumes.iter().enumerate() {
        if *v > bodies.volumes[largest] {
            largest = i;
        }
    }
    let volume_of = |i: usize| bodies.volumes[i] * frame.scale.powi(3);
    if several > 1 {
        match choice {
            Bodies::Refuse => {
                let mut by_size: Vec<f64> = reserve("bodies", several)?;
                by_size.extend((0..several).map(volume_of));
                by_size.sort_by(|a, b| b.total_cmp(a));
                return Err(Error::SeveralBodies(format!(
                    "the mesh is {several} separate bodies (the largest have volumes {:.6e} and \
                     {:.6e}): choose to keep the largest or all",
                    by_size[0], by_size[1]
                )));
            }
            Bodies::Largest => {
                report.bodies_dropped = several as u64 - 1;
                report.notes.push(format!(
                    "of {several} bodies the largest was kept (volume {:.6e}), {} dropped",
                    volume_of(largest),
                    several - 1
                ));
            }
            Bodies::All => {
                report.notes.push(format!("{several} separate bodies were kept as one particle"));
            }
        }
    }
    let keeps = |b: u32| choice != Bodies::Largest || b as usize == largest;
    let mut stays = filled("faces", faces, false)?;
    let (mut loose, mut openness, mut area, mut volume) = (0, 0.0, 0.0, 0.0);
    for part in parts {
        match part.body {
            None => loose += part.faces.len(),
            Some(b) if keeps(b) => {
                part.faces.iter().for_each(|&f| stays[f as usize] = true);
                openness += part.openness * part.extent.area;
                area += part.extent.area;
                volume += part.volume();
            }
            Some(_) => {}
        }
    }
    report.volume = volume * frame.scale.powi(3);
    report.area = area * frame.scale * frame.scale;
    if loose > 0 {
        report.notes.push(format!(
            "dropped {} of loose sheets that enclose nothing",
            count(loose as u64, "face")
        ));
    }
    if bodies.overlap {
        report.notes.push(
            "parts of the surface cross or lie within one another: inside is where the winding \
             number is above ½, and `volume` counts overlaps more than once"
                .into(),
        );
    }
    if openness > 1e-4 * area {
        report.notes.push(format!(
            "the surface is open: from its faces {:.2} % of all directions are seen through \
             openings on average",
            100.0 * openness / area
        ));
    }
    Ok(stays)
}

/// The shape of what stays: compact vertices, own unit frame, volume, area, box.
/// `edges`: those of `kept`, if they are known.
fn finish(
    points: &[Vec3],
    kept: Vec<[u32; 3]>,
    edges: Option<Edges>,
    mut report: Report,
) -> Result<Shape> {
    let frame = check::frame_of(points, &kept)?;
    let mut index = filled("vertex indices", points.len(), u32::MAX)?;
    let mut mesh = Mesh { vertices: Vec::new(), faces: kept, clean: false };
    let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    for corner in mesh.faces.iter_mut().flatten() {
        let old = *corner as usize;
        if index[old] == u32::MAX {
            index[old] = mesh.vertices.len() as u32;
            push("vertices", &mut mesh.vertices, frame.to_unit(&points[old]))?;
            lo = lo.inf(&points[old]);
            hi = hi.sup(&points[old]);
        }
        *corner = index[old];
    }
    let edges = match edges {
        Some(mut edges) => {
            edges.renumber(&index);
            edges
        }
        None => Edges::of(&mesh.faces)?,
    };
    report.watertight = edges.faulty() == 0;
    report.oriented = edges.misoriented == 0;
    mesh.clean = report.watertight && report.oriented;
    report.vertices = mesh.vertices.len() as u64;
    report.faces = mesh.faces.len() as u64;
    report.box_min = lo.into();
    report.box_max = hi.into();
    if !report.watertight {
        report.notes.push(format!(
            "edges with one face: {}, with more than two: {}; openings get lids, and where they cannot \
             inside is where the winding number is above ½",
            edges.boundary, edges.nonmanifold
        ));
    }
    Ok(Shape { body: Arc::new(Body::Mesh(mesh)), frame, report })
}
