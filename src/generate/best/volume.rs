//! Clumps whose union has the volume of the target.
//!
//! In the search: one more refinement with weights that a condition on the volume adds a multiplier
//! to, and what is left by the same change of all radii. At the end, such a change once more, with
//! the volume of the union by columns as fine as those of the quality figures.

use super::limits::Exact;
use super::search::Search;
use super::watch::Watch;
use crate::error::Result;
use crate::generate::ball::Ball;
use crate::math::{Sphere, UnitFrame, Vec3};
use crate::run::Pool;
use crate::solid::columns::{Lattice, Rows};

/// Columns across the clump.
const COLUMNS: usize = 512;
/// Refinements with a multiplier.
const ROUNDS: usize = 4;
/// What a clump is charged whose volume a change of all radii cannot reach, for a unit of excess,
/// and for each of its parts where it must hang together.
const CHARGE: f64 = 10.0;
/// Share of the volume to which the end is solved, and to which it must be.
const SOLVED: f64 = 1e-7;
const GOOD: f64 = 1e-5;

/// A change of all radii in the search.
fn grown(balls: &[Ball], room: &[f32], by: f64, [least, most]: [f32; 2]) -> Vec<Ball> {
    let each = balls.iter().zip(room).map(|(b, &room)| {
        let radius = (b.radius + (by as f32).min(room)).max(least).min(most);
        Ball { radius, ..*b }
    });
    each.collect()
}

/// Changes the search's clump to one of the target's volume by its own columns: of those from
/// several multipliers that of the least goal.
pub(super) fn swell(search: &mut Search, polish: [usize; 2]) -> Result<()> {
    let start = search.state.balls.clone();
    let first = search.state.excess();
    let mut best = even(search)?;
    let weights = search.state.weights();
    let [inside, outside] = [weights.inside, weights.outside].map(f64::from);
    let sum = inside + outside;
    // Where distances are spread evenly over twice their mean.
    let slope = -8.0 * search.state.mismatch().max(1e-4) / sum;
    let range = [0.05 * sum - outside, inside - 0.05 * sum];
    let mut known = (0.0, first);
    let mut shift = -first / slope;
    for _ in 0..ROUNDS {
        shift = shift.clamp(range[0], range[1]);
        search.put(start.clone())?;
        let balls = search.swollen(polish, shift);
        if !search.watch.go() {
            break;
        }
        search.put_joined(balls)?;
        let excess = search.state.excess();
        let found = even(search)?;
        if found.0 < best.0 {
            best = found;
        }
        let (run, rise) = (shift - known.0, excess - known.1);
        known = (shift, excess);
        if excess.abs() < 1e-4 || run.abs() < 1e-6 || rise.abs() < 1e-6 {
            break;
        }
        shift -= excess * run / rise;
    }
    search.put(best.1)?;
    search.state.parts = search.state.pieces();
    Ok(())
}

/// Gives the search's clump the target's volume by a change of all radii; how far it then is from
/// what is wanted.
fn even(search: &mut Search) -> Result<(f64, Vec<Ball>)> {
    let start = search.state.balls.clone();
    let ground = search.state.ground;
    let room: Vec<f32> = start.iter().map(|b| ground.limits.room(ground.field, b)).collect();
    let ends = [ground.radii.least, ground.radii.most];
    let (width, watch) = (f64::from(search.state.width), search.watch);
    let mut excess = |by: f64| {
        search.put(grown(&start, &room, by, ends))?;
        Ok(search.state.excess())
    };
    solve(&mut excess, width, 1e-5, watch)?;
    let missed = (search.state.excess().abs() - 1e-4).max(0.0);
    let parts = search.state.pieces() as f64;
    Ok((search.state.goal() + CHARGE * (missed + parts), search.state.balls.clone()))
}

/// A place where `excess`, which rises, is about 0, or the last one tried, which is also what is
/// given when the search stops; and the excess there.
fn solve(
    excess: &mut dyn FnMut(f64) -> Result<f64>,
    width: f64,
    good: f64,
    watch: &Watch,
) -> Result<(f64, f64)> {
    let mut at = (0.0, excess(0.0)?);
    if at.1.abs() <= good {
        return Ok(at);
    }
    // Until the sign changes, ever further.
    let mut by = -width * at.1.signum();
    let mut other = at;
    for _ in 0..24 {
        if !watch.go() {
            return Ok(other);
        }
        other = (other.0 + by, excess(other.0 + by)?);
        if other.1.abs() <= good || other.1.signum() != at.1.signum() {
            break;
        }
        at = other;
        by *= 2.0;
    }
    if other.1.signum() == at.1.signum() {
        return Ok(other);
    }
    // Illinois' false position.
    let (mut a, mut b) = (at, other);
    for _ in 0..40 {
        if !watch.go() || b.1.abs() <= good || (b.0 - a.0).abs() <= 1e-15 * b.0.abs() {
            break;
        }
        let x = b.0 - b.1 * (b.0 - a.0) / (b.1 - a.1);
        let y = excess(x)?;
        if y.signum() == b.1.signum() {
            a.1 *= 0.5;
        } else {
            a = b;
        }
        b = (x, y);
    }
    Ok(b)
}

/// Gives spheres of the caller's frame the volume (unit frame) by the same change of all radii as
/// far as limits allow; a sentence when they do not allow enough. `sizes`: how many at a time are
/// images of each other.
pub(super) fn fit(
    spheres: &mut [Sphere],
    sizes: &[usize],
    frame: &UnitFrame,
    exact: &Exact,
    volume: f64,
    (pool, watch): (&Pool, &Watch),
) -> Result<String> {
    let start: Vec<Sphere> = spheres.iter().map(|s| frame.sphere_to_unit(s)).collect();
    let mut ends: Vec<[f64; 2]> = spheres
        .iter()
        .map(|s| [exact.least(), exact.greatest(&s.center)].map(|r| r / frame.scale))
        .collect();
    let mut rest = ends.as_mut_slice();
    for &size in sizes {
        let (orbit, others) = rest.split_at_mut(size.min(rest.len()));
        let most = orbit.iter().map(|e| e[1]).fold(f64::MAX, f64::min);
        orbit.iter_mut().for_each(|e| e[1] = most);
        rest = others;
    }
    let Some(lattice) = lattice(&start) else { return Ok(String::new()) };
    let mut now = start.clone();
    let mut excess = |by: f64| {
        for ((s, start), [least, most]) in now.iter_mut().zip(&start).zip(&ends) {
            s.radius = (start.radius + by).max(*least).min(*most);
        }
        Ok(union(&now, lattice, pool)? / volume - 1.0)
    };
    let (by, left) = solve(&mut excess, 1e-4 * volume.cbrt(), SOLVED, watch)?;
    for ((s, start), [least, most]) in spheres.iter_mut().zip(&start).zip(&ends) {
        s.radius = (start.radius + by).max(*least).min(*most) * frame.scale;
    }
    Ok(if left.abs() <= GOOD {
        String::new()
    } else {
        format!("the limits allow {:.4} times the volume of the target", 1.0 + left)
    })
}

/// Columns through the spheres and some room about them.
fn lattice(spheres: &[Sphere]) -> Option<Lattice> {
    let first = spheres.first()?;
    let mut ends = [first.center, first.center];
    for s in spheres {
        let r = Vec3::repeat(s.radius);
        ends = [ends[0].inf(&(s.center - r)), ends[1].sup(&(s.center + r))];
    }
    let edges = ends[1] - ends[0];
    let axis = (0..3).rev().min_by(|&i, &j| edges[i].total_cmp(&edges[j]))?;
    let room = Vec3::repeat(0.1 * edges.max());
    let [low, high] = [ends[0] - room, ends[1] + room];
    let corner = |p: Vec3| [p[(axis + 1) % 3], p[(axis + 2) % 3]];
    Some(Lattice::slanted(axis, COLUMNS, corner(low), corner(high)))
}

/// The volume of a union by columns.
fn union(spheres: &[Sphere], lattice: Lattice, pool: &Pool) -> Result<f64> {
    let rows = Rows::of_spheres(spheres, lattice)?;
    let bands = pool.map(rows.bands(), |i| {
        let band = rows.band(i)?;
        Ok(band.columns().flatten().map(|i| i[1] - i[0]).sum::<f64>())
    });
    let mut sum = 0.0;
    for band in bands {
        sum += band?;
    }
    Ok(sum * lattice.area())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Run;

    #[test]
    fn volumes_of_unions_are_those_of_formulas() {
        let ball = |x: f64, r: f64| Sphere::new(Vec3::new(x, 0.3, -0.2), r);
        let lens =
            |d: f64, r: f64| std::f64::consts::PI * (4.0 * r + d) * (2.0 * r - d).powi(2) / 12.0;
        for d in [0.2, 0.5, 0.9] {
            let two = [ball(0.0, 0.5), ball(d, 0.5), ball(0.01, 0.2)];
            let lattice = lattice(&two).unwrap();
            let volume = union(&two, lattice, &Pool::serial()).unwrap();
            let exact = 2.0 * ball(0.0, 0.5).volume() - lens(d, 0.5);
            assert!((volume / exact - 1.0).abs() < 1e-5, "{d}: {volume} {exact}");
        }
    }

    #[test]
    fn rising_functions_are_solved_or_followed_to_their_end() {
        let run = Run::serial();
        let watch = Watch::new(&run);
        for (power, root) in [(1, 0.3), (3, -0.7), (5, 4.0), (1, 0.0)] {
            let mut looks = 0;
            let mut f = |x: f64| {
                looks += 1;
                Ok((1.0 + x - root).powi(power) - 1.0)
            };
            let (x, _) = solve(&mut f, 0.01, 1e-9, &watch).unwrap();
            assert!((x - root).abs() < 1e-6, "{power} {root}: {x}");
            assert!(looks < 60);
        }
        let (x, y) = solve(&mut |x: f64| Ok(x.min(0.5) - 0.6), 0.01, 1e-9, &watch).unwrap();
        assert!(x >= 0.5 && (y + 0.1).abs() < 1e-12);
    }
}
