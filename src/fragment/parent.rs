//! What is made once of a particle that may break, and read by every break.

use super::field::{self, Field};
use super::lookup::Depths;
use super::room::{Ball, Parts, Room};
use super::spread::{Random, spread};
use super::union::Union;
use crate::error::{Result, collected, fits, reserve};
use crate::mass::{Body, Contact, ContactOptions, time_step};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::solid::Solid;
use crate::solid::nearest::Surface;
use std::sync::{Arc, OnceLock};

/// Balls about the medial axis that are kept as candidates.
const CANDIDATES: usize = 3000;

/// A particle that may break: its solid, with the distance field and the tree over the surface,
/// the spheres of its clump with the union's depth, and balls about its medial axis.
///
/// In the unit frame of the solid. It is read only and may be shared by threads.
pub struct Parent {
    solid: Arc<Solid>,
    spheres: Vec<Sphere>,
    /// Balls that no larger one within the surface holds, nearly.
    medial: Vec<Sphere>,
    /// Missing where the distances alone serve.
    field: Option<Field>,
    narrow: Option<Narrow>,
    step: Option<f64>,
    bytes: u64,
    /// Of the solid's arrays.
    held: u64,
    hash: OnceLock<u128>,
}

/// What the surface and the union of the spheres have in common.
pub(super) struct Narrow {
    pub union: Union,
    pub field: Field,
    pub medial: Vec<Sphere>,
}

/// What the spheres of a fragment stay in.
pub(super) struct Within<'a> {
    pub depths: Depths<'a>,
    pub union: Option<&'a Union>,
    pub medial: &'a [Sphere],
}

impl Parent {
    /// Of a solid and the spheres of its clump (caller's frame), of which there may be none.
    ///
    /// Makes the solid's distance field and surface tree where it has none yet, a field of 8 bytes
    /// a cell with the depth and the way in which it grows, and with spheres
    /// another: the depth in solid and union together. Refused: spheres
    /// that are not finite or have no radius, and what goes beyond the solid's memory limit.
    pub fn new(solid: Arc<Solid>, spheres: &[Sphere], run: &Run) -> Result<Parent> {
        run.check(0.0, "measuring the distances of cells")?;
        let distance = solid.distance(run)?;
        let surface = solid.surface(run)?;
        let held = 5 * solid.grid().len() as u64 + surface.bytes();
        let own = 2 * (CANDIDATES * size_of::<Sphere>()) as u64;
        let fields = if spheres.is_empty() { 1 } else { 2 };
        let own = own + fields * field::BYTES * solid.grid().len() as u64;
        let room = solid.memory_limit().saturating_sub(held);
        fits(format_args!("a parent of fragments"), own, room)?;
        let frame = solid.frame();
        let spheres = collected("spheres", spheres.iter().map(|s| frame.sphere_to_unit(s)))?;
        run.check(0.2, "looking for what is nearest to cells")?;
        let field = field::of_solid(solid.grid(), distance, surface, run)?;
        run.check(0.4, "looking for medial balls")?;
        let medial = medial(&solid, &field, surface, None, run)?;
        let mut narrow = None;
        if !spheres.is_empty() {
            let union = Union::new(&spheres)?;
            run.check(0.5, "measuring the depth in the union of the spheres")?;
            let field = field::narrowed(solid.grid(), &field, &union, run)?;
            let mut own = self::medial(&solid, &field, surface, Some(&union), run)?;
            // The spheres themselves, as far as they are within the surface.
            let room = whole(&solid, Depths::Field(&field), surface, Some(&union))?;
            let kept = spheres.iter().map(|s| room.sphere(s.center));
            own.extend(kept.filter(|s| s.radius > 0.0));
            narrow = Some(Narrow { union, field, medial: own });
        }
        let sizes = |n: &Narrow| n.union.bytes() + n.field.bytes() + (32 * n.medial.len()) as u64;
        let bytes = (32 * (spheres.len() + medial.len())) as u64
            + field.bytes()
            + narrow.as_ref().map_or(0, sizes);
        let step = if spheres.is_empty() {
            None
        } else {
            let input = collected("spheres", spheres.iter().map(|s| frame.sphere_to_input(s)))?;
            Body::of_solid(&solid, 1.0).ok().and_then(|body| step_of(&input, &body))
        };
        run.count(|c| c.peak_bytes = c.peak_bytes.max(held + bytes));
        let hash = OnceLock::new();
        let field = Some(field);
        Ok(Parent { solid, spheres, medial, field, narrow, step, bytes, held, hash })
    }

    /// Of a solid of a new shape and the spheres of its old clump (caller's frame), which are what
    /// the search for new ones begins with; nothing keeps those within the old.
    ///
    /// Nothing is made of the solid but its distance field and surface tree, where it has none yet:
    /// once [`Solid::distance`] and [`Solid::surface`] were called it is ready, and this takes some
    /// hundred microseconds, where [`Parent::new`] makes fields and looks for balls all over the
    /// inside.
    pub fn reshaped(solid: Arc<Solid>, spheres: &[Sphere], run: &Run) -> Result<Parent> {
        let (distance, surface) = (solid.distance(run)?, solid.surface(run)?);
        let held = 5 * solid.grid().len() as u64 + surface.bytes();
        let own = 64 * spheres.len() as u64;
        let room = solid.memory_limit().saturating_sub(held);
        fits(format_args!("a parent of fragments"), own, room)?;
        let frame = solid.frame();
        let spheres = collected("spheres", spheres.iter().map(|s| frame.sphere_to_unit(s)))?;
        let inside = whole(&solid, Depths::Distance(distance), surface, None)?;
        let kept = spheres.iter().map(|s| inside.sphere(s.center));
        let medial = collected("candidates", kept.filter(|s| s.radius > 0.0))?;
        let bytes = (32 * (spheres.len() + medial.len())) as u64;
        let input = collected("spheres", spheres.iter().map(|s| frame.sphere_to_input(s)))?;
        let body = Body::of_solid(&solid, 1.0).ok().filter(|_| !input.is_empty());
        let step = body.and_then(|body| step_of(&input, &body));
        run.count(|c| c.peak_bytes = c.peak_bytes.max(held + bytes));
        let hash = OnceLock::new();
        let field = None;
        Ok(Parent { solid, spheres, medial, field, narrow: None, step, bytes, held, hash })
    }

    /// The solid.
    pub fn solid(&self) -> &Arc<Solid> {
        &self.solid
    }

    /// Spheres of the clump, unit frame.
    pub fn unit_spheres(&self) -> &[Sphere] {
        &self.spheres
    }

    /// Bytes that it holds beside the solid.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The same with the solid.
    pub(super) fn all_bytes(&self) -> u64 {
        self.bytes + self.held + self.solid.body().bytes()
    }

    /// By what fragments know the first parent: FNV-1a, 128 bits, of its body in the unit frame and
    /// of that frame; of meshes that are open or cross themselves the grid too, by whose cells they
    /// are cut. Made when first asked for.
    pub fn hash(&self) -> Result<u128> {
        if let Some(&hash) = self.hash.get() {
            return Ok(hash);
        }
        let (solid, grid) = (&self.solid, self.solid.grid());
        let mesh = matches!(solid.body(), crate::shape::Body::Mesh(_));
        let by_cells = mesh && solid.unit_moments().relative_error != 0.0;
        let cells = by_cells.then_some((grid.dims, grid.origin, grid.spacing));
        let found = super::hash::hash(&(solid.frame(), solid.body(), cells))?;
        Ok(*self.hash.get_or_init(|| found))
    }

    /// The rigid clump's time step for a unit spring, where there are spheres.
    pub(super) fn step(&self) -> Option<f64> {
        self.step
    }

    /// What spheres stay in, the union of the parent's among it if wanted and there are any.
    pub(super) fn within(&self, union: bool, run: &Run) -> Result<Within<'_>> {
        if let Some(n) = self.narrow.as_ref().filter(|_| union) {
            let depths = Depths::Field(&n.field);
            return Ok(Within { depths, union: Some(&n.union), medial: &n.medial });
        }
        let depths = match &self.field {
            Some(field) => Depths::Field(field),
            None => Depths::Distance(self.solid.distance(run)?),
        };
        Ok(Within { depths, union: None, medial: &self.medial })
    }
}

/// The time step that a rigid clump allows with a spring of stiffness 1.
pub(super) fn step_of(spheres: &[Sphere], body: &Body) -> Option<f64> {
    let contact = ContactOptions { contact: Contact::Stiffness(1.0), speed: 0.0, contacts: 1 };
    time_step(spheres, &[], body, &contact).ok().map(|s| s.clump)
}

/// The room of the whole solid.
fn whole<'a>(
    solid: &'a Solid,
    depths: Depths<'a>,
    surface: &'a Surface,
    union: Option<&'a Union>,
) -> Result<Room<'a>> {
    let grid = solid.grid();
    let edges = Vec3::from(grid.dims.map(|n| n as f64)).component_mul(&grid.spacing);
    let (lo, hi) = (grid.origin, grid.origin + edges);
    let parts = Parts { grid, depths, surface, union, walls: &[], less: 0.0, lo, hi };
    Room::new(parts, solid.unit_moments().volume)
}

/// Balls grown from points all over the inside, with their exact depths.
fn medial(
    solid: &Solid,
    field: &Field,
    surface: &Surface,
    union: Option<&Union>,
    run: &Run,
) -> Result<Vec<Sphere>> {
    let room = whole(solid, Depths::Field(field), surface, union)?;
    let grid = solid.grid();
    let half = [0, 1, 2].map(|a| (0.5 * grid.dims[a] as f64 * grid.spacing[a]) as f32);
    let mut random = Random::new(run.seed());
    let points = spread(&room, &half, CANDIDATES, &mut random, |_| true)?;
    let chunks: Vec<&[[f32; 3]]> = points.chunks(64).collect();
    let found = run.pool().map(chunks.len(), |i| {
        let some = chunks.get(i).copied().unwrap_or_default();
        let of = |p: &[f32; 3]| room.sphere(room.global(&room.grown(*p).center));
        some.iter().map(of).collect::<Vec<Sphere>>()
    });
    let mut out = reserve("candidates", points.len() + 64)?;
    out.extend(found.into_iter().flatten().filter(|s| s.radius > 0.0));
    // In an order by chance, so that the first of those in a fragment are all over it.
    for i in (1..out.len()).rev() {
        out.swap(i, (random.unit() * (i + 1) as f32) as usize % (i + 1));
    }
    Ok(out)
}

/// A ball of a room as a sphere of the unit frame, and back.
pub(super) fn local(s: &Sphere, middle: &Vec3) -> Ball {
    let c = s.center - middle;
    Ball { center: [c.x as f32, c.y as f32, c.z as f32], radius: s.radius as f32 }
}
