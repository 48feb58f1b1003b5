//! Height, solid fraction and slope of a bed of bodies.

use crate::dem::engine::Engine;
use crate::dem::walls::WallShape;
use crate::error::{Error, Result};
use crate::math::{Sphere, Vec3};

/// Upright columns across the wider side of a container, for height and solid fraction.
const COLUMNS: usize = 128;
/// Points of a profile, over this part of the drum's width.
const POINTS: usize = 80;
const WIDTH: f64 = 0.7;
/// A profile of fewer points has no slope.
const LEAST: usize = 50;

/// An upright container: what is over `floor` and within its cross-section.
struct Container {
    /// Axes of the cross-section, and up.
    axes: [Vec3; 3],
    /// Middle of the cross-section, and half its sides.
    middle: [f64; 2],
    half: [f64; 2],
    round: bool,
    /// Least height, where a wall has one.
    floor: Option<f64>,
}

impl Container {
    fn area(&self) -> f64 {
        let [a, b] = self.half;
        if self.round { std::f64::consts::PI * a * b } else { 4.0 * a * b }
    }
}

/// What the bodies fall against: against gravity, or along z without it.
pub(super) fn up(engine: &Engine) -> Vec3 {
    engine.setup().gravity.map_or(Vec3::z(), |g| (-g / g.amax()).normalize())
}

/// Along `v` but for rounding.
fn along(v: &Vec3, w: &Vec3) -> bool {
    (v.dot(w).abs() / v.norm() - 1.0).abs() < 1e-9
}

fn container(engine: &Engine) -> Option<Container> {
    let up = up(engine);
    let walls = &engine.setup().walls;
    let mut found = walls.iter().find_map(|w| match &w.shape {
        WallShape::Cylinder { center, axis, radius, length } if along(axis, &up) => {
            let across = if up.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() };
            let e = (across - up * up.dot(&across)).normalize();
            let axes = [e, up.cross(&e), up];
            Some(Container {
                middle: [axes[0].dot(center), axes[1].dot(center)],
                half: [*radius; 2],
                round: true,
                floor: length.map(|l| up.dot(center) - 0.5 * l),
                axes,
            })
        }
        WallShape::Box { lo, hi } => {
            let k = (0..3).find(|k| along(&up, &Vec3::ith(*k, 1.0)))?;
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let side = |i: usize| (0.5 * (lo[i] + hi[i]), 0.5 * (hi[i] - lo[i]));
            let ((x, a), (y, b)) = (side(i), side(j));
            Some(Container {
                axes: [Vec3::ith(i, 1.0), Vec3::ith(j, 1.0), up],
                middle: [x, y],
                half: [a, b],
                round: false,
                floor: Some(if up[k] > 0.0 { lo[k] } else { -hi[k] }),
            })
        }
        _ => None,
    })?;
    for w in walls {
        if let WallShape::Plane { normal, offset } = &w.shape
            && along(normal, &up)
            && normal.dot(&up) > 0.0
        {
            found.floor = Some(found.floor.map_or(*offset, |f| f.max(*offset)));
        }
    }
    Some(found)
}

/// Refuses scenes that have no container.
pub(super) fn needs_container(name: &str, engine: &Engine) -> Result<()> {
    match container(engine) {
        Some(_) => Ok(()),
        None => Err(Error::InvalidArgument(format!(
            "the measure {name} needs a wall that is an upright cylinder or box"
        ))),
    }
}

/// Refuses scenes that have no drum.
pub(super) fn needs_drum(name: &str, engine: &Engine) -> Result<()> {
    match drum(engine) {
        Some(_) => Ok(()),
        None => Err(Error::InvalidArgument(format!(
            "the measure {name} needs a wall that is a cylinder with a level axis and a length"
        ))),
    }
}

fn spheres(engine: &Engine) -> impl Iterator<Item = Sphere> + '_ {
    let s = engine.state();
    (0..s.len()).flat_map(move |i| {
        let r = s.orientation[i].matrix();
        let all = s.template_of(i).spheres().iter();
        all.map(move |sphere| Sphere::new(s.position[i] + r * sphere.center, sphere.radius))
    })
}

/// The highest point of any sphere; 0 without bodies.
pub(super) fn top(engine: &Engine) -> f64 {
    let up = up(engine);
    spheres(engine).map(|s| up.dot(&s.center) + s.radius).reduce(f64::max).unwrap_or(0.0)
}

/// Height of the surface, and solid fraction under it.
///
/// The height is the mean, over the columns of a lattice that meet a sphere, of the highest point in each, from the floor;
/// the solid fraction is the volume of the union of all spheres, by exact chords of the same columns, over area times
/// height.
pub(super) fn bed(engine: &Engine) -> Option<[f64; 2]> {
    let c = container(engine)?;
    let cell = 2.0 * c.half[0].max(c.half[1]) / COLUMNS as f64;
    let counts = c.half.map(|h| ((2.0 * h / cell).ceil() as usize).max(1));
    let steps = [2.0 * c.half[0] / counts[0] as f64, 2.0 * c.half[1] / counts[1] as f64];
    let place = |k: usize, i: usize| c.middle[k] - c.half[k] + (i as f64 + 0.5) * steps[k];
    let mut chords: Vec<Vec<[f64; 2]>> = vec![Vec::new(); counts[0] * counts[1]];
    let mut lowest = f64::MAX;
    for s in spheres(engine) {
        let at = [c.axes[0].dot(&s.center), c.axes[1].dot(&s.center), c.axes[2].dot(&s.center)];
        lowest = lowest.min(at[2] - s.radius);
        let range = |k: usize| {
            let first = (at[k] - s.radius - c.middle[k] + c.half[k]) / steps[k] - 0.5;
            let last = (at[k] + s.radius - c.middle[k] + c.half[k]) / steps[k] - 0.5;
            (first.ceil().max(0.0) as usize, (last.floor() + 1.0).max(0.0) as usize)
        };
        let (rows, columns) = (range(0), range(1));
        for i in rows.0..rows.1.min(counts[0]) {
            for j in columns.0..columns.1.min(counts[1]) {
                let (x, y) = (place(0, i) - at[0], place(1, j) - at[1]);
                let rest = s.radius * s.radius - x * x - y * y;
                if rest > 0.0 {
                    let half = rest.sqrt();
                    chords[i * counts[1] + j].push([at[2] - half, at[2] + half]);
                }
            }
        }
    }
    let floor = c.floor.unwrap_or(lowest);
    let (mut height, mut filled, mut met) = (0.0, 0.0, 0.0);
    for column in &mut chords {
        column.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let mut end = f64::MIN;
        for [a, b] in column.iter() {
            filled += (b - a.max(end)).max(0.0);
            end = end.max(*b);
        }
        if !column.is_empty() {
            height += end - floor;
            met += 1.0;
        }
    }
    if met == 0.0 || height <= 0.0 {
        return None;
    }
    let height = height / met;
    Some([height, filled * steps[0] * steps[1] / (c.area() * height)])
}

/// Directions from which a container is looked at, and places across it.
const SIDES: usize = 12;
const ACROSS: usize = 101;

/// Height of the bed as it is seen from the side: the mean over 101 places across the container of the highest point of
/// any sphere in the line of sight, from the floor, and over twelve directions around it.
pub(super) fn profile(engine: &Engine) -> Option<f64> {
    let c = container(engine)?;
    let floor = c.floor.or_else(|| {
        spheres(engine).map(|s| c.axes[2].dot(&s.center) - s.radius).reduce(f64::min)
    })?;
    let mut tops = [[None::<f64>; ACROSS]; SIDES];
    let turned: [(f64, f64); SIDES] =
        std::array::from_fn(|k| (std::f64::consts::PI * k as f64 / SIDES as f64).sin_cos());
    for s in spheres(engine) {
        let from = [0, 1].map(|k| c.axes[k].dot(&s.center) - c.middle[k]);
        let z = c.axes[2].dot(&s.center) - floor;
        for (tops, (sin, cos)) in tops.iter_mut().zip(turned) {
            let half = if c.round { c.half[0] } else { c.half[0] * cos.abs() + c.half[1] * sin };
            let x = from[0] * cos + from[1] * sin;
            for (i, top) in tops.iter_mut().enumerate() {
                let at = half * (2.0 * (i as f64 + 0.5) / ACROSS as f64 - 1.0);
                let rest = s.radius * s.radius - (at - x) * (at - x);
                if rest > 0.0 {
                    let here = z + rest.sqrt();
                    *top = Some(top.map_or(here, |t: f64| t.max(here)));
                }
            }
        }
    }
    let met: Vec<f64> = tops.iter().flatten().filter_map(|t| *t).collect();
    (!met.is_empty()).then(|| met.iter().sum::<f64>() / met.len() as f64)
}

/// A drum: its middle, axis, half its length, and radius.
fn drum(engine: &Engine) -> Option<(Vec3, Vec3, f64, f64)> {
    let up = up(engine);
    engine.setup().walls.iter().find_map(|w| match &w.shape {
        WallShape::Cylinder { center, axis, radius, length: Some(length) }
            if axis.dot(&up).abs() < 1e-6 * axis.norm() =>
        {
            Some((*center, axis.normalize(), 0.5 * length, *radius))
        }
        _ => None,
    })
}

/// Angle of repose in a drum, in degrees: the slope of the lines through the profiles at its two ends, mean of both.
///
/// A profile is what is seen through an end: the highest point, at each of 80 places over the middle 0.7 of the drum's
/// width, of the spheres that are no farther from that end than the widest body is wide. The line is by least squares.
pub(super) fn repose(engine: &Engine) -> Option<f64> {
    let (center, axis, half, radius) = drum(engine)?;
    let up = up(engine);
    let side = axis.cross(&up).normalize();
    let deep = 2.0 * engine.state().templates.iter().map(|t| t.bound()).fold(0.0, f64::max);
    let mut tops = [[None::<f64>; POINTS]; 2];
    let place = |i: usize| radius * WIDTH * (2.0 * (i as f64 + 0.5) / POINTS as f64 - 1.0);
    for s in spheres(engine) {
        let from = s.center - center;
        let (a, x, z) = (axis.dot(&from), side.dot(&from), up.dot(&from));
        for (profile, near) in tops.iter_mut().zip([half - a, half + a]) {
            if near > deep {
                continue;
            }
            for (i, top) in profile.iter_mut().enumerate() {
                let rest = s.radius * s.radius - (place(i) - x) * (place(i) - x);
                if rest > 0.0 {
                    let here = z + rest.sqrt();
                    *top = Some(top.map_or(here, |t: f64| t.max(here)));
                }
            }
        }
    }
    let slope = |profile: &[Option<f64>; POINTS]| {
        let found = profile.iter().enumerate().filter_map(|(i, t)| t.map(|t| (place(i), t)));
        let points: Vec<(f64, f64)> = found.collect();
        if points.len() < LEAST {
            return None;
        }
        let n = points.len() as f64;
        let mean = points.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
        let of = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
            points.iter().map(|p| f(p.0 - mean.0, p.1 - mean.1)).sum()
        };
        Some(of(&|x, z| x * z) / of(&|x, _| x * x))
    };
    let [a, b] = [slope(&tops[0])?, slope(&tops[1])?];
    Some((0.5 * (a.atan() + b.atan())).to_degrees().abs())
}
