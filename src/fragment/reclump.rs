//! Spheres for a fragment: greedy cover by medial balls, warm from the parent's, then a climb by
//! feasible steps. Serial, small in memory, and exact where it counts: the radius of every sphere
//! is the least of its exact depths, less half the gap and what rounding may take.

use super::climb::{Climb, Visit};
use super::cloud::{self, Cloud};
use super::map::ParentMap;
use super::parent::{Parent, Within, local, step_of};
use super::region::Region;
use super::room::{Ball, Parts, Room, Wall};
use super::spread::{Random, spread};
use crate::clump::Stopped;
use crate::error::{Error, Result, collected, figure, reserve};
use crate::generate::HalfSpace;
use crate::mass::{Body, union_moments};
use crate::math::{Sphere, UnitFrame, Vec3};
use crate::run::Run;

/// Most spheres of a fragment.
const MOST: usize = 10_000;
/// Least radius, of the fragment's size.
const LEAST: f64 = 0.005;
/// What the rounding of coordinates of unit size may take of a radius.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// What is asked of a fragment's spheres.
#[derive(Debug, Clone, PartialEq)]
pub struct ReclumpOptions {
    /// Most spheres.
    pub spheres: usize,
    /// Least radius, in the caller's unit.
    pub min_radius: f64,
    /// The spheres stay half of this off the cuts, the surface and the walls, so that those of
    /// two fragments are this far apart at least; in the caller's unit.
    pub gap: f64,
    /// Whether the spheres stay within the union of the parent's, which neighbours touch.
    pub union: bool,
    /// Further half-spaces that no sphere may leave, in the caller's frame.
    pub walls: Vec<HalfSpace>,
    /// Whether centres and radii are numbers of single precision in the caller's frame, so that
    /// nothing changes when a solver reads them as such. Where the frame's origin is far away,
    /// spheres move and shrink by what single precision leaves there.
    pub single: bool,
    /// Whether the share of the volume that is covered and the time step are wanted; a cancelled
    /// call has neither.
    pub quality: bool,
}

impl Default for ReclumpOptions {
    fn default() -> Self {
        ReclumpOptions {
            spheres: 20,
            min_radius: 0.0,
            gap: 0.0,
            union: true,
            walls: Vec::new(),
            single: false,
            quality: true,
        }
    }
}

/// Spheres of a fragment.
#[derive(Debug, Clone, PartialEq)]
pub struct Reclump {
    /// The spheres, largest first, in the caller's frame, the parent as it was handed in.
    pub spheres: Vec<Sphere>,
    /// Why there are no more.
    pub stopped: Stopped,
    /// Which of the parent's spheres each comes from.
    pub map: ParentMap,
    /// Share of the fragment's volume that is covered; 0 where not wanted.
    pub coverage: f64,
    /// Volume of the union of the spheres, over the volume of the parent's solid; 0 where not
    /// wanted.
    pub volume_share: f64,
    /// The time step that the rigid clump allows over that of the parent's, for the same spring
    /// and density; `None` where the parent has no spheres or it is not wanted.
    pub step_factor: Option<f64>,
}

/// How much work.
#[derive(Debug, Clone, Copy)]
struct Plan {
    points: usize,
    candidates: usize,
    sweeps: usize,
    tries: usize,
}

impl Plan {
    fn of(n: usize) -> Plan {
        // Few balls have far to go, many are placed well by the greedy cover.
        let (sweeps, tries) = if n <= 20 { (3, 12) } else { (2, 14) };
        Plan {
            points: (1000 + 30 * n).max(50 * n).min(12_000),
            candidates: (24 * n).clamp(300, 4000),
            sweeps,
            tries,
        }
    }

    /// When the deadline has passed before the work begins.
    fn least() -> Plan {
        Plan { points: 256, candidates: 64, sweeps: 0, tries: 0 }
    }
}

/// Spheres within a region of the parent.
///
/// Refused: no sphere or more than 10 000 asked for; lengths that are not numbers of 0 or more; a
/// wall without a direction. `NoSpheres` where no ball of the least radius was found: such a
/// fragment is dust. A deadline that has passed gives a coarse clump.
pub fn reclump(
    parent: &Parent,
    region: &Region,
    options: &ReclumpOptions,
    run: &Run,
) -> Result<Reclump> {
    check(options)?;
    run.check(0.0, "looking for the spheres of a fragment")?;
    let solid = parent.solid();
    let frame = solid.frame();
    let walls = walls(region, &options.walls, frame)?;
    let Within { depths, union, medial } = parent.within(options.union, run)?;
    let rounding = 8.0 * frame.noise() + ROUNDING;
    let less = 0.5 * options.gap / frame.scale + rounding;
    let (grid, surface) = (solid.grid(), solid.surface(run)?);
    let (lo, hi) = (region.lo, region.hi);
    let parts = Parts { grid, depths, surface, union, walls: &walls, less, lo, hi };
    let volume = region.moments.volume.max(0.0);
    let room = Room::new(parts, volume)?;
    let size = f64::from(room.size);
    let least = (LEAST * size).max(options.min_radius / frame.scale);

    let n = options.spheres;
    let late = run.late();
    let plan = if late { Plan::least() } else { Plan::of(n) };
    let mut random = Random::new(run.seed());
    let half = (hi - lo) * 0.5;
    let half = [half.x as f32, half.y as f32, half.z as f32];
    let holds = |p: &Vec3| region.mark.is_none() || region.holds(p);
    let points = spread(&room, &half, plan.points, &mut random, holds)?;
    let of_region = |s: &Sphere| region.mark.is_none() || region.holds_ball(&s.center, s.radius);
    let candidates = candidates(&room, medial, &points, &plan, least as f32, &of_region)?;
    let mut cloud = Cloud::new(&points, half)?;
    let dense = points.len() as f32 / (room.size * room.size * room.size).max(f32::MIN_POSITIVE);
    // A ball holds about as many points as its volume has, and none more than there are.
    let bound = |b: &Ball| {
        let about = 4.6 * b.radius * b.radius * b.radius * dense;
        about.min(1e9) as u32 + 3
    };
    let chosen = cloud::choose(&mut cloud, &candidates, n, bound)?;
    let mut balls = reserve("spheres", chosen.len())?;
    balls.extend(chosen.iter().filter_map(|&i| candidates.get(i).copied()));
    let mut stopped = if late { Stopped::Deadline } else { Stopped::Spheres };
    let spacing = dense.max(f32::MIN_POSITIVE).cbrt().recip();
    let mut climb = Climb::new(&room, &cloud, balls, spacing, least as f32)?;
    for k in 0..plan.sweeps {
        if run.cancelled(0.2 + 0.8 * k as f64 / plan.sweeps as f64) {
            stopped = Stopped::Cancelled;
        } else if run.late() {
            stopped = Stopped::Deadline;
        }
        if stopped != Stopped::Spheres {
            break;
        }
        climb.sweep(&Visit { tries: plan.tries }, &mut random);
    }
    // A ball within the parent and the planes is of the fragment where it meets the mark.
    let holds = |p: &Vec3, radius: f64| region.mark.is_none() || region.holds_ball(p, radius);
    let mut spheres = finished(&room, &climb.balls, least, options.single, frame, &holds)?;
    if spheres.is_empty() {
        return Err(Error::NoSpheres(format!(
            "no ball with a radius of {:e} or more was found in the fragment",
            least * frame.scale
        )));
    }
    spheres.sort_by(|a, b| b.radius.total_cmp(&a.radius));
    if spheres.len() < n && stopped == Stopped::Spheres {
        stopped = Stopped::Exhausted;
    }
    let unit = collected("spheres", spheres.iter().map(|s| frame.sphere_to_unit(s)))?;
    let map = ParentMap::between(parent.unit_spheres(), &unit)?;
    let mut found =
        Reclump { spheres, stopped, map, coverage: 0.0, volume_share: 0.0, step_factor: None };
    if options.quality && stopped != Stopped::Cancelled {
        // A cancel from now on would lose the spheres.
        let union = union_moments(&unit, &Run::serial())?.volume;
        found.coverage = if volume > 0.0 { union / volume } else { 0.0 };
        found.volume_share = union / solid.unit_moments().volume;
        let body = Body::of_moments(&frame.moments_to_input(&region.moments), 1.0).ok();
        let own = body.and_then(|b| step_of(&found.spheres, &b));
        found.step_factor = own.zip(parent.step()).map(|(own, whole)| own / whole);
    }
    run.count(|c| {
        c.spheres_tried += candidates.len() as u64;
        c.exact_distances += climb.balls.len() as u64;
    });
    Ok(found)
}

/// Balls about the medial axis of the room: the parent's, as they are where no half-space cuts
/// them, and new ones.
fn candidates(
    room: &Room,
    medial: &[Sphere],
    points: &[[f32; 3]],
    plan: &Plan,
    least: f32,
    holds: &dyn Fn(&Sphere) -> bool,
) -> Result<Vec<Ball>> {
    let mut out = reserve("candidates", plan.candidates)?;
    for s in medial {
        let below = room.wall(&s.center);
        let within = Sphere::new(s.center, s.radius.min(below));
        if below <= 0.0 || out.len() >= plan.candidates / 2 || !holds(&within) {
            continue;
        }
        let ball = local(s, &room.middle);
        let ball = if below >= s.radius { room.ball(ball.center) } else { room.grown(ball.center) };
        if ball.radius >= least {
            out.push(ball);
        }
    }
    let missing = plan.candidates.saturating_sub(out.len()).max(1);
    for p in points.iter().step_by(points.len().div_ceil(missing).max(1)) {
        let ball = room.grown(*p);
        if ball.radius >= least && out.len() < plan.candidates {
            out.push(ball);
        }
    }
    Ok(out)
}

/// The spheres in the caller's frame, each with the exact depth of the centre that it is given
/// there.
fn finished(
    room: &Room,
    balls: &[Ball],
    least: f64,
    single: bool,
    frame: &UnitFrame,
    holds: &dyn Fn(&Vec3, f64) -> bool,
) -> Result<Vec<Sphere>> {
    let mut out = reserve("spheres", balls.len())?;
    for ball in balls {
        let mut center = frame.to_input(&room.settled(room.global(&ball.center)).center);
        if single {
            center = center.map(|x| f64::from(x as f32));
        }
        let unit = frame.to_unit(&center);
        if !unit.iter().all(|x| x.is_finite()) {
            continue;
        }
        let depth = room.sphere(unit).radius;
        if depth <= 0.0 || !holds(&unit, depth) {
            continue;
        }
        let mut radius = depth * frame.scale;
        if single && radius > 0.0 {
            let near = radius as f32;
            let down = if f64::from(near) > radius { near.next_down() } else { near };
            radius = f64::from(down);
        }
        if radius >= least * frame.scale && radius > 0.0 {
            out.push(Sphere::new(center, radius));
        }
    }
    Ok(out)
}

/// The half-spaces of the region and further ones, unit frame.
pub(super) fn walls(
    region: &Region,
    further: &[HalfSpace],
    frame: &UnitFrame,
) -> Result<Vec<Wall>> {
    let mut out = reserve("half-spaces", region.planes.len() + further.len())?;
    out.extend(region.planes.iter().map(|p| Wall { normal: p.normal, offset: p.offset }));
    for w in further {
        // In two steps, so that neither tiny nor huge normals overflow.
        let normal = w.normal / w.normal.amax();
        let length = normal.norm();
        let offset = w.offset / w.normal.amax() / length;
        let normal = normal / length;
        out.push(Wall { normal, offset: (offset - normal.dot(&frame.offset)) / frame.scale });
    }
    Ok(out)
}

fn check(o: &ReclumpOptions) -> Result<()> {
    if o.spheres == 0 || o.spheres > MOST {
        return Err(Error::InvalidArgument(format!(
            "{} spheres are asked of a fragment, and it has 1 to {MOST}",
            o.spheres
        )));
    }
    for (name, value) in [("min_radius", o.min_radius), ("gap", o.gap)] {
        if !(value.is_finite() && value >= 0.0) {
            return Err(Error::InvalidArgument(format!(
                "{name} is {}, not a number ≥ 0",
                figure(value)
            )));
        }
    }
    for (i, w) in o.walls.iter().enumerate() {
        if !(w.normal.iter().all(|x| x.is_finite()) && w.offset.is_finite()) {
            return Err(Error::NotFinite(format!(
                "wall {i} has normal ({}, {}, {}) and offset {}",
                w.normal.x, w.normal.y, w.normal.z, w.offset
            )));
        }
        if w.normal.amax() < 1e-290 {
            return Err(Error::InvalidArgument(format!("wall {i} has a normal of length 0")));
        }
    }
    Ok(())
}

#[cfg(test)]
#[path = "reclump_tests.rs"]
mod tests;
