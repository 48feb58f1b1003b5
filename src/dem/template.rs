//! A clump in its body frame, shared by all bodies that are made of it.

use super::tree::Tree;
use crate::error::{Error, Result, figure, reserve};
use crate::mass::Body;
use crate::math::{Sphere, Vec3};

/// A clump in its body frame: origin at the centre of mass, axes principal. Made once and shared; its
/// spheres stand in the order of its tree.
#[derive(Debug, Clone)]
pub struct Template {
    spheres: Vec<Sphere>,
    order: Vec<u32>,
    tree: Tree,
    mass: f64,
    inverse_mass: f64,
    moments: [f64; 3],
    inverse: Vec3,
    reach: f64,
    bound: f64,
    least: f64,
}

impl Template {
    /// The template of spheres in the body frame.
    ///
    /// Refused: no sphere, a sphere that is not finite or has no radius, a mass or moment that is not a
    /// number above 0, moments that no body has.
    pub fn new(spheres: &[Sphere], mass: f64, moments: [f64; 3]) -> Result<Template> {
        if spheres.is_empty() {
            return Err(Error::Empty("a template needs a sphere".into()));
        }
        if spheres.len() > u32::MAX as usize {
            return Err(Error::TooLarge(format!("a template of {} spheres", spheres.len())));
        }
        for (i, s) in spheres.iter().enumerate() {
            if !(s.center.iter().all(|c| c.is_finite()) && s.radius.is_finite()) {
                return Err(Error::NotFinite(format!(
                    "sphere {i} is at ({}, {}, {}) with radius {}",
                    s.center.x, s.center.y, s.center.z, s.radius
                )));
            }
            if s.radius <= 0.0 {
                let radius = figure(s.radius);
                return Err(Error::InvalidArgument(format!("sphere {i} has radius {radius}")));
            }
        }
        if !(mass.is_finite() && mass > 0.0) {
            let mass = figure(mass);
            return Err(Error::InvalidArgument(format!(
                "the mass of a template is {mass}, not a number above 0"
            )));
        }
        let [a, b, c] = moments;
        if !(moments.iter().all(|m| m.is_finite() && *m > 0.0)
            && 2.0 * a.max(b).max(c) <= (a + b + c) * (1.0 + 1e-9))
        {
            return Err(Error::InvalidArgument(format!(
                "no body has the principal moments {}, {}, {}",
                figure(a),
                figure(b),
                figure(c)
            )));
        }
        let mut own = reserve("a template", spheres.len())?;
        own.extend_from_slice(spheres);
        let mut order = reserve("a template", spheres.len())?;
        order.extend(0..spheres.len() as u32);
        let tree = Tree::new(&mut own, &mut order)?;
        let most = |of: &dyn Fn(&Sphere) -> f64| own.iter().map(of).fold(0.0, f64::max);
        let reach = most(&|s| s.center.norm());
        let bound = most(&|s| s.center.norm() + s.radius);
        let inverse = Vec3::from(moments.map(|m| 1.0 / m));
        let least = own.iter().map(|s| s.radius).fold(f64::MAX, f64::min);
        Ok(Template {
            spheres: own,
            order,
            tree,
            mass,
            inverse_mass: 1.0 / mass,
            moments,
            inverse,
            reach,
            bound,
            least,
        })
    }

    /// The template of spheres in the caller's frame that stand for `body`.
    pub fn of_body(spheres: &[Sphere], body: &Body) -> Result<Template> {
        Template::new(&body.to_body(spheres), body.mass, body.principal.moments)
    }

    /// A single sphere of a density.
    pub fn ball(radius: f64, density: f64) -> Result<Template> {
        let ball = Sphere::new(Vec3::zeros(), radius);
        let mass = density * ball.volume();
        Template::new(&[ball], mass, [0.4 * mass * radius * radius; 3])
    }

    /// The spheres, in the order of the tree.
    pub fn spheres(&self) -> &[Sphere] {
        &self.spheres
    }

    /// Which of the spheres handed in each of [`Template::spheres`] is.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    pub(crate) fn tree(&self) -> &Tree {
        &self.tree
    }

    /// Mass.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    #[inline]
    pub(crate) fn inverse_mass(&self) -> f64 {
        self.inverse_mass
    }

    /// Principal moments about the body axes.
    pub fn moments(&self) -> [f64; 3] {
        self.moments
    }

    /// One over each of them.
    #[inline]
    pub(crate) fn inverse(&self) -> &Vec3 {
        &self.inverse
    }

    /// How far the farthest centre of a sphere is from the centre of mass.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// How far the farthest point of a sphere is from the centre of mass.
    pub fn bound(&self) -> f64 {
        self.bound
    }

    /// The least radius.
    pub fn least_radius(&self) -> f64 {
        self.least
    }

    /// Bytes of the spheres and their tree.
    pub fn bytes(&self) -> u64 {
        let spheres = self.spheres.capacity() * size_of::<Sphere>() + self.order.capacity() * 4;
        spheres as u64 + self.tree.bytes()
    }
}
