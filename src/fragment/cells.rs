//! What a body is cut into: planes, and cells of points, as half-spaces in the unit frame.

use super::Region;
use super::piece::Piece;
use crate::error::{Error, Result, collected, figure, reserve};
use crate::generate::{HalfSpace, Plane, Random};
use crate::math::{UnitFrame, Vec3};
use crate::run::Run;
use crate::solid::Solid;

/// How a body is cut. Points, directions and half-spaces are in the caller's frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Cut {
    /// Both sides of each plane: all cells of the arrangement that meet the body.
    Planes(Vec<HalfSpace>),
    /// What lies within all of them; the rest is left out.
    Within(Vec<HalfSpace>),
    /// The Voronoi cells of points; with weights (as many as points, in squares of the caller's
    /// unit) their power cells: x belongs to the point for which |x − p|² − w is least.
    Points {
        /// The points, anywhere.
        points: Vec<Vec3>,
        /// None, or one a point.
        weights: Vec<f64>,
    },
    /// The Voronoi cells of so many points spread evenly over the body by the run's seed.
    Seeded {
        /// How many.
        count: usize,
    },
    /// The Voronoi cells of so many points that are the denser the nearer to an impact: their
    /// distances from it are the body's size times the squares of evenly spread numbers.
    Impact {
        /// Where the body is hit.
        point: Vec3,
        /// Where to: the points lie before the impact. Of any length but 0.
        direction: Vec3,
        /// How many.
        count: usize,
    },
}

/// Most points.
const MOST_POINTS: usize = 1 << 16;
/// Points that are nearer than this in the unit frame have no plane between them.
const SAME: f64 = 1e-12;
/// Random places that are tried for each point.
const TRIES: usize = 2000;
/// The stream of the points' random numbers.
const STREAM: u64 = 0x63_7574;

/// What is cut, in the unit frame.
pub(super) enum Cells {
    /// All cells of planes.
    Arranged(Vec<Plane>),
    /// Convex cells, each by its own planes; `None` where a cell does not meet the body's box.
    Convex(Vec<Option<Vec<Plane>>>),
}

impl Cells {
    /// The cells of a cut of a solid, or of a region of it, that lies in a box.
    pub fn of(
        cut: &Cut,
        solid: &Solid,
        region: Option<&Region>,
        [lo, hi]: &[Vec3; 2],
        notes: &mut Vec<String>,
        run: &Run,
    ) -> Result<Cells> {
        let frame = solid.frame();
        let planes = |all: &[HalfSpace]| -> Result<Vec<Plane>> {
            all.iter().enumerate().try_for_each(|(i, h)| h.check(i))?;
            collected("planes", all.iter().map(|h| h.plane(frame)))
        };
        let points = match cut {
            Cut::Planes(all) => return Ok(Cells::Arranged(planes(all)?)),
            Cut::Within(all) => return Ok(Cells::Convex(vec![Some(planes(all)?)])),
            Cut::Points { points, weights } => {
                return Cells::of_points(
                    &given(points, frame)?,
                    &scaled(points, weights, frame)?,
                    [lo, hi],
                    run,
                );
            }
            Cut::Seeded { count } => {
                most(*count)?;
                let mut random = Random::new(run.seed(), STREAM);
                let draw = || Vec3::from_fn(|a, _| random.between(lo[a], hi[a]));
                seeds(*count, draw, solid, region)?
            }
            Cut::Impact { point, direction, count } => {
                most(*count)?;
                finite("the direction of impact", direction)?;
                let size = direction.amax();
                if size == 0.0 {
                    return Err(Error::InvalidArgument(
                        "the direction of impact has length 0".into(),
                    ));
                }
                let about = |e: Error| e.about("the impact");
                let at =
                    given(&[*point], frame).map_err(about)?.first().copied().unwrap_or_default();
                let way = direction / size;
                let far = Vec3::from_fn(|a, _| (at[a] - lo[a]).abs().max((at[a] - hi[a]).abs()));
                let far = far.norm();
                let mut random = Random::new(run.seed(), STREAM + 1);
                let draw = || {
                    let u = direction_of(&mut random);
                    let u = if u.dot(&way) < 0.0 { -u } else { u };
                    let t = random.unit();
                    at + u * (far * t * t)
                };
                seeds(*count, draw, solid, region)?
            }
        };
        let asked = match cut {
            Cut::Seeded { count } | Cut::Impact { count, .. } => *count,
            _ => points.len(),
        };
        if points.len() < asked {
            notes
                .push(format!("only {} of {asked} points found a place in the body", points.len()));
        }
        let weights = vec![0.0; points.len()];
        Cells::of_points(&points, &weights, [lo, hi], run)
    }

    fn of_points(
        points: &[Vec3],
        weights: &[f64],
        [lo, hi]: [&Vec3; 2],
        run: &Run,
    ) -> Result<Cells> {
        // Twins are told by their numbers whether or not their cells meet the body.
        let mut order = collected("points", 0..points.len())?;
        let by = |i: &usize| <[f64; 3]>::from(points[*i]);
        order.sort_by(|i, j| {
            let ([a, b, c], [d, e, f]) = (by(i), by(j));
            a.total_cmp(&d).then(b.total_cmp(&e)).then(c.total_cmp(&f)).then(i.cmp(j))
        });
        for w in order.windows(2) {
            if (points[w[0]] - points[w[1]]).norm() <= SAME {
                return Err(twins(w[0], w[1]));
            }
        }
        let room = Vec3::repeat(0.01 * (hi - lo).amax());
        let (lo, hi) = (lo - room, hi + room);
        let mut cells = reserve("cells of points", points.len())?;
        const TOGETHER: usize = 64;
        for first in (0..points.len()).step_by(TOGETHER) {
            run.check(0.1 * first as f64 / points.len() as f64, "making cells of points")?;
            let n = TOGETHER.min(points.len() - first);
            for cell in run.pool().map(n, |k| cell(first + k, points, weights, &lo, &hi)) {
                cells.push(cell?);
            }
        }
        Ok(Cells::Convex(cells))
    }
}

/// The planes that bound the cell of point `i` in a box; those that the cell does not touch are
/// left out.
fn cell(
    i: usize,
    points: &[Vec3],
    weights: &[f64],
    lo: &Vec3,
    hi: &Vec3,
) -> Result<Option<Vec<Plane>>> {
    let mut planes: Vec<(f64, Plane)> = reserve("planes of a cell", points.len())?;
    for j in (0..points.len()).filter(|&j| j != i) {
        let plane = between(i.min(j), i.max(j), points, weights)?;
        let plane =
            if i < j { plane } else { Plane { normal: -plane.normal, offset: -plane.offset } };
        planes.push((plane.offset - plane.normal.dot(&points[i]), plane));
    }
    planes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut cell = Piece::cuboid(lo, hi);
    let reach = |cell: &Piece| {
        let distances = cell.view().vertices.iter().map(|v| (v - points[i]).norm());
        distances.fold(0.0, f64::max)
    };
    let mut far = reach(&cell);
    for (distance, plane) in planes {
        // All that follow are as far away.
        if distance > far {
            break;
        }
        match cell.below(&plane)? {
            Some(below) => cell = below,
            None => return Ok(None),
        }
        far = reach(&cell);
    }
    Ok(Some(cell.touched()))
}

/// The plane between two points, the same for both to the last bit; the first lies below.
fn between(i: usize, j: usize, points: &[Vec3], weights: &[f64]) -> Result<Plane> {
    let (p, q) = (&points[i], &points[j]);
    let d = q - p;
    let length = d.norm();
    if length <= SAME {
        return Err(twins(i, j));
    }
    let normal = d / length;
    let lift = (weights[i] - weights[j]) / (2.0 * length);
    Ok(Plane { normal, offset: normal.dot(&((p + q) * 0.5)) + lift })
}

fn twins(i: usize, j: usize) -> Error {
    let (i, j) = (i.min(j), i.max(j));
    Error::InvalidArgument(format!("points {i} and {j} are at the same place"))
}

fn finite(what: &str, v: &Vec3) -> Result<()> {
    for (axis, x) in ["x", "y", "z"].iter().zip(v.iter()) {
        if !x.is_finite() {
            return Err(Error::NotFinite(format!("{what} has {axis} = {}", figure(*x))));
        }
    }
    Ok(())
}

fn most(count: usize) -> Result<()> {
    if count == 0 {
        return Err(Error::InvalidArgument("the number of points is 0".into()));
    }
    if count > MOST_POINTS {
        return Err(Error::TooLarge(format!("{count} points are more than {MOST_POINTS}")));
    }
    Ok(())
}

/// The caller's points in the unit frame.
fn given(points: &[Vec3], frame: &UnitFrame) -> Result<Vec<Vec3>> {
    most(points.len())?;
    // Farther away nothing changes but the precision.
    const FAR: f64 = 1e6;
    for (i, p) in points.iter().enumerate() {
        finite(&format!("point {i}"), p)?;
        if (p.amax() * 0.5 - frame.offset.amax() * 0.5).abs() > 0.5 * FAR * frame.scale
            || frame.to_unit(p).amax() > FAR
        {
            return Err(Error::InvalidArgument(format!(
                "point {i} is more than {FAR:e} sizes of the body away from it"
            )));
        }
    }
    collected("points", points.iter().map(|p| frame.to_unit(p)))
}

/// The weights in the unit frame.
fn scaled(points: &[Vec3], weights: &[f64], frame: &UnitFrame) -> Result<Vec<f64>> {
    if weights.is_empty() {
        return Ok(vec![0.0; points.len()]);
    }
    if weights.len() != points.len() {
        return Err(Error::InvalidArgument(format!(
            "{} weights were given for {} points",
            weights.len(),
            points.len()
        )));
    }
    for (i, w) in weights.iter().enumerate() {
        if !w.is_finite() {
            return Err(Error::NotFinite(format!("weight {i} is {}", figure(*w))));
        }
    }
    const FAR: f64 = 1e12;
    let unit = |w: &f64| {
        let far = w.abs() > FAR * frame.scale * frame.scale;
        if far { FAR.copysign(*w) } else { w / frame.scale / frame.scale }
    };
    collected("weights", weights.iter().map(unit))
}

/// A direction, all of them alike.
fn direction_of(random: &mut Random) -> Vec3 {
    loop {
        let v = Vec3::from_fn(|_, _| random.between(-1.0, 1.0));
        let s = v.norm_squared();
        if s > 1e-6 && s <= 1.0 {
            return v / s.sqrt();
        }
    }
}

/// Points in the body and the region, as far as they are found.
fn seeds(
    count: usize,
    mut draw: impl FnMut() -> Vec3,
    solid: &Solid,
    region: Option<&Region>,
) -> Result<Vec<Vec3>> {
    let (grid, inside) = (solid.grid(), solid.inside()?);
    let in_body = |p: &Vec3| {
        let at = (p - grid.origin).component_div(&grid.spacing);
        let fits = (0..3).all(|a| at[a] >= 0.0 && at[a] < grid.dims[a] as f64);
        fits && inside
            .get(grid.index(at.x as usize, at.y as usize, at.z as usize))
            .is_some_and(|&c| c != 0)
    };
    let mut found: Vec<Vec3> = reserve("points", count)?;
    let mut tries = 0;
    while found.len() < count && tries < TRIES.saturating_mul(count) {
        tries += 1;
        let p = draw();
        let apart = || found.iter().all(|q| (q - p).norm() > 1e3 * SAME);
        if in_body(&p) && region.is_none_or(|r| r.holds(&p)) && apart() {
            found.push(p);
        }
    }
    if found.is_empty() {
        // One cell: the whole.
        let middle = region.map_or(solid.unit_moments().centroid, |r| r.moments.centroid);
        found.push(middle);
    }
    Ok(found)
}
