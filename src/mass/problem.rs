//! The ten equations of the mass correction (Yuan 2019, eqs 2–5), without units: in the body
//! frame of the target, lengths over its radius of gyration, masses over the mean one.

use super::body::Body;
use super::pile::Pile;
use crate::error::{Error, Result, filled, reserve};
use crate::math::{Sphere, Vec3};

/// Equations: mass, centre (3), principal moments (3), products (3).
pub(super) const ROWS: usize = 10;
/// The first of them that speak of inertia.
pub(super) const INERTIA: usize = 4;
/// How many sizes of the target a sphere may be away from its centre, or large.
const FAR: f64 = 1e3;

/// The masses x_i, in multiples of the mean, that make `rows` · x = `target`, within bounds.
#[derive(Debug, Clone)]
pub(super) struct Problem {
    /// Number of spheres.
    pub n: usize,
    /// The equations, one after the other: 1/n times what a sphere of unit mass adds to the mass,
    /// the centre over the radius of gyration, and I_jk / √(J_j J_k), J the target's moments.
    pub rows: Vec<Vec<f64>>,
    /// 1; 0, 0, 0; 1, 1, 1; 0, 0, 0, the last six to rounding.
    pub target: [f64; ROWS],
    /// Least x.
    pub least: f64,
    /// Greatest x, where there is one.
    pub most: Option<f64>,
}

/// Spheres of the caller's frame, without units: in the body frame, over the radius of gyration.
pub(super) fn unitless(spheres: &[Sphere], body: &Body) -> Result<Vec<Sphere>> {
    let (turn, length) = (body.principal.axes.transpose(), body.gyration());
    let mut out = reserve("spheres", spheres.len())?;
    for (i, s) in spheres.iter().enumerate() {
        let away = s.center - body.center;
        // Compared before divided, so that nothing overflows.
        if away.amax() > FAR * length || s.radius > FAR * length {
            return Err(Error::InvalidArgument(format!(
                "sphere {i} has radius {:e} and lies {:e} from the centre of mass of a target \
                 whose radius of gyration is {length:e}: out of proportion",
                s.radius,
                away.amax()
            )));
        }
        out.push(Sphere::new(turn * away / length, s.radius / length));
    }
    Ok(out)
}

impl Problem {
    /// The equations of the spheres of a pile, made by [`unitless`].
    pub(super) fn new(pile: &Pile, body: &Body, least: f64, most: Option<f64>) -> Result<Problem> {
        let n = pile.spheres.len();
        let share = 1.0 / n as f64;
        // Moments of a unit of mass, over the radius of gyration squared: their sum is 2.
        let sum = body.principal.moments.iter().sum::<f64>();
        let root = body.principal.moments.map(|m| (2.0 * m / sum).sqrt());
        let mut rows = reserve("equations", ROWS)?;
        for _ in 0..ROWS {
            rows.push(filled("equations", n, 0.0)?);
        }
        for (i, s) in pile.spheres.iter().enumerate() {
            for (row, value) in rows.iter_mut().zip(one(&s.center, s.radius, &root)) {
                row[i] = value * share;
            }
        }
        // Axes of equal moments are chosen, not found, so that the tensor need not be quite
        // diagonal in them.
        let turn = body.principal.axes;
        let j = turn.transpose() * body.inertia.matrix() * turn * (2.0 / sum);
        let of = |a: usize, b: usize| j[(a, b)] / (root[a] * root[b]);
        let [p, q] = [[of(0, 0), of(1, 1), of(2, 2)], [of(0, 1), of(0, 2), of(1, 2)]];
        let target = [1.0, 0.0, 0.0, 0.0, p[0], p[1], p[2], q[0], q[1], q[2]];
        Ok(Problem { n, rows, target, least, most })
    }

    /// What is missing of each equation.
    pub(super) fn residuals(&self, x: &[f64]) -> [f64; ROWS] {
        let mut r = self.target.map(|t| -t);
        for (r, row) in r.iter_mut().zip(&self.rows) {
            *r += row.iter().zip(x).map(|(a, x)| a * x).sum::<f64>();
        }
        r
    }

    /// x within the bounds.
    pub(super) fn clamp(&self, x: f64) -> f64 {
        x.min(self.most.unwrap_or(f64::MAX)).max(self.least)
    }
}

/// The ten figures of a ball of unit mass: each is a solid sphere, 2/5 r² about its own centre.
fn one(d: &Vec3, radius: f64, root: &[f64; 3]) -> [f64; ROWS] {
    let own = 0.4 * radius * radius;
    let [x, y, z] = [d.x, d.y, d.z];
    let [a, b, c] = *root;
    [
        1.0,
        x,
        y,
        z,
        (own + y * y + z * z) / (a * a),
        (own + x * x + z * z) / (b * b),
        (own + x * x + y * y) / (c * c),
        -x * y / (a * b),
        -x * z / (a * c),
        -y * z / (b * c),
    ]
}

/// The greatest of the figures that lie in a range of equations.
pub(super) fn greatest(r: &[f64]) -> f64 {
    r.iter().fold(0.0, |m, r| m.max(r.abs()))
}
