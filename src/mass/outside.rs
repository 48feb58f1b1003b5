//! Why no masses give a clump the centre of mass that it is to have.

use super::body::Body;
use super::pile::Pile;
use super::problem::Problem;
use super::relax::{Demand, least_error, least_squares};
use crate::error::{Error, Result, figure};
use crate::math::Vec3;
use nalgebra::Matrix3;

/// Mass alone exactly, the centre as well as it can be.
const CENTER: Demand = Demand { hard: 1, soft: 4 };

/// The error to return for spheres whose centre of mass cannot be the target's.
pub(super) fn outside(p: &Problem, pile: &Pile, body: &Body) -> Result<Error> {
    let free = Problem { least: 0.0, most: None, ..p.clone() };
    let hull = least_error(&free, CENTER)?;
    let length = body.gyration();
    let n = p.n;
    let lie = match dimensions(pile) {
        0 => ", which are all in one place",
        1 => ", which lie on one line",
        2 => ", which lie in one plane",
        _ => "",
    };
    let text = match hull {
        // Somewhat more than what the solver leaves.
        Some((off, x)) if off > 3e-10 => {
            // That is the greatest component; the nearest point of the hull is where the sum of
            // their squares is least.
            let r = free.residuals(&least_squares(&free, CENTER)?.unwrap_or(x));
            let towards = -Vec3::new(r[1], r[2], r[3]);
            let distance = towards.norm().clamp(off, 3f64.sqrt() * off);
            let reach = |i: &usize| pile.spheres[*i].center.dot(&towards);
            let nearest = (0..n).max_by(|i, j| reach(i).total_cmp(&reach(j))).unwrap_or(0);
            let nearest = pile.order.get(nearest).copied().unwrap_or(0);
            format!(
                "the centre of mass of the target lies {:.3e} outside the hull of the {n} sphere \
                 centres{lie}; sphere {nearest} reaches farthest towards it: no masses give the \
                 clump that centre",
                distance * length
            )
        }
        _ => format!(
            "no masses between m_min = {} and m_max = {} give the {n} spheres the centre of mass \
             of the target: the bounds are too narrow{lie}",
            figure(p.least * body.mass / n as f64),
            figure(p.most.unwrap_or(n as f64) * body.mass / n as f64)
        ),
    };
    Ok(Error::NoMasses(text))
}

/// How many dimensions the centres fill.
fn dimensions(pile: &Pile) -> usize {
    let n = pile.spheres.len() as f64;
    let middle = pile.spheres.iter().fold(Vec3::zeros(), |m, s| m + s.center) / n;
    let mut spread = Matrix3::zeros();
    for s in &pile.spheres {
        let d = s.center - middle;
        spread += d * d.transpose() / n;
    }
    let size = pile.spheres.iter().map(|s| s.radius).fold(0.0, f64::max);
    spread.symmetric_eigenvalues().iter().filter(|e| **e > 1e-18 * size * size).count()
}
