//! The time step that a scene allows, by the library's own figure; with several contacts at once by
//! what they do together.

use super::contact::{DampingLaw, Laws, NormalLaw};
use super::effects::Coefficients;
use super::state::State;
use super::template::Template;
use crate::error::Result;
use crate::error::figure;
use crate::mass::{Body, Contact, ContactOptions, time_step};
use crate::math::{Inertia, PrincipalFrame, Sphere, Vec3};
use nalgebra::Matrix3;

/// The part of the greatest stable step that is advised.
pub const SAFE: f64 = 0.2;

/// No limit for several contacts is more than this times that of all of them at the worst point, so
/// that the advice is stable there, too, at 0.8 of that limit.
const MOST: f64 = 4.0;

/// What is advised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advice {
    /// Beyond this step a contact gains energy without bound.
    pub limit: f64,
    /// The step that is advised: [`SAFE`] times that.
    pub step: f64,
    /// The template that demands it.
    pub template: u32,
    /// Its sphere, of those handed in.
    pub sphere: u32,
    /// The greatest overlap over the least radius at the speed given.
    pub overlap: f64,
}

/// The template as the room of masses sees a body.
fn body(t: &Template) -> Body {
    let [a, b, c] = t.moments();
    let volume: f64 = t.spheres().iter().map(Sphere::volume).sum();
    Body {
        density: t.mass() / volume,
        volume,
        mass: t.mass(),
        center: Vec3::zeros(),
        inertia: Inertia { xx: a, yy: b, zz: c, ..Inertia::default() },
        principal: PrincipalFrame {
            moments: t.moments(),
            axes: Matrix3::identity(),
            quaternion: [1.0, 0.0, 0.0, 0.0],
        },
        relative_error: 0.0,
    }
}

/// The step for these bodies: two of the worst template that meet with `speed`, in `contacts` contacts at once that push the
/// same way (1 with contact averaging): on as many of its spheres, those that together are stiffest.
///
/// Refused: what [`time_step`] refuses, such as a speed of 0 with Hertz.
pub fn advise(
    laws: &Laws,
    coefficients: &[Coefficients],
    state: &State,
    speed: f64,
    contacts: u32,
) -> Result<Option<Advice>> {
    let stiffest = coefficients.iter().map(|c| c.stiffness).fold(0.0, f64::max);
    // Of one material, 1/E is (1 − ν²)/Y twice: Poisson's ratio is in E already.
    let contact = match laws.normal {
        NormalLaw::Linear => Contact::Stiffness(stiffest),
        NormalLaw::Hertz => Contact::Material { young: 2.0 * stiffest, poisson: 0.0 },
    };
    let contacts = if laws.averaging { 1 } else { contacts };
    let options = ContactOptions { contact, speed, contacts };
    let mut found: Option<Advice> = None;
    for (k, t) in state.templates.iter().enumerate() {
        let own = time_step(t.spheres(), &[], &body(t), &options)?;
        let limit = if contacts > 1 {
            // Hertz at the overlap of that speed: as the radius to the power 0.4.
            let worst = t.spheres().get(own.sphere as usize).map_or(1.0, |s| s.radius);
            let power = if laws.normal == NormalLaw::Hertz { 0.4 } else { 0.0 };
            let spring = |s: &Sphere| own.stiffness * (s.radius / worst).powf(power);
            own.clump.max(together(t, spring, contacts).min(MOST * own.clump))
        } else {
            own.clump
        };
        if found.is_none_or(|f| limit < f.limit) {
            let sphere = t.order().get(own.sphere as usize).copied().unwrap_or(own.sphere);
            found = Some(Advice {
                limit,
                step: SAFE * limit,
                template: k as u32,
                sphere,
                overlap: own.overlap,
            });
        }
    }
    Ok(found)
}

/// The greatest stable step of two such bodies that touch in `contacts` contacts along one normal, each on
/// a sphere of its own (on all of them equally, where there are fewer): √(2/λ), λ the greatest
/// eigenvalue of Σ k w wᵀ, w = (n/√M, I^-½ (c × n)). Over which spheres, which normal n and which
/// motion u: by turns, each the best for the others, from several normals.
fn together(t: &Template, spring: impl Fn(&Sphere) -> f64, contacts: u32) -> f64 {
    let (spheres, mass) = (t.spheres(), t.mass());
    let root = Vec3::from(t.moments()).map(|i| 1.0 / i.sqrt());
    let n = spheres.len().min(contacts as usize).max(1);
    let times = f64::from(contacts) / n as f64;
    let springs: Vec<f64> = spheres.iter().map(spring).collect();
    let mut all: Vec<u32> = (0..spheres.len() as u32).collect();
    let mut most = 0.0f64;
    for start in STARTS {
        let mut normal = Vec3::from(start).normalize();
        // What a push where it is felt most does.
        let push = |i: &u32| {
            let turned = spheres[*i as usize].center.cross(&normal).component_mul(&root);
            (normal / mass.sqrt(), turned)
        };
        let felt = |i: &u32| springs[*i as usize] * push(i).1.norm_squared();
        let Some(first) = (0..spheres.len() as u32).max_by(|i, j| felt(i).total_cmp(&felt(j)))
        else {
            break;
        };
        let (mut v, mut w) = push(&first);
        let size = (v.norm_squared() + w.norm_squared()).sqrt();
        (v, w) = (v / size, w / size);
        for turn in 0..TURNS {
            let pushed = |i: &u32| {
                let turned = spheres[*i as usize].center.cross(&normal).component_mul(&root);
                (normal / mass.sqrt(), turned)
            };
            let held = |i: &u32| {
                let (a, b) = pushed(i);
                springs[*i as usize] * (a.dot(&v) + b.dot(&w)).powi(2)
            };
            if n < all.len() {
                all.select_nth_unstable_by(n - 1, |i, j| {
                    held(j).total_cmp(&held(i)).then(i.cmp(j))
                });
            }
            let chosen = all.get(..n).unwrap_or(&all);
            most = most.max(chosen.iter().map(held).sum());
            let (mut next_v, mut next_w) = (Vec3::zeros(), Vec3::zeros());
            let mut along = Matrix3::zeros();
            for i in chosen {
                let (a, b) = pushed(i);
                let part = springs[*i as usize] * (a.dot(&v) + b.dot(&w));
                next_v += a * part;
                next_w += b * part;
                let g =
                    v / mass.sqrt() + w.component_mul(&root).cross(&spheres[*i as usize].center);
                along += g * g.transpose() * springs[*i as usize];
            }
            let size = (next_v.norm_squared() + next_w.norm_squared()).sqrt();
            if size <= 0.0 {
                break;
            }
            (v, w) = (next_v / size, next_w / size);
            // The motion settles between two turns of the normal.
            if turn % 4 == 3 {
                let eigen = along.symmetric_eigen();
                normal = eigen.eigenvectors.column(eigen.eigenvalues.imax()).normalize();
            }
        }
    }
    if most > 0.0 { (2.0 / (times * most)).sqrt() } else { f64::MAX }
}

/// Normals to start from: half of the corners, edges and faces of a cube.
const STARTS: [[f64; 3]; 13] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

const TURNS: usize = 24;

impl Advice {
    /// What to say of a step that is larger than the advice, once.
    pub fn warning(&self, dt: f64, laws: &Laws) -> Option<String> {
        let unstable = dt > self.limit;
        if dt <= self.step * (1.0 + 1e-9) {
            return None;
        }
        let what = if unstable { "is unstable beyond" } else { "is allowed, at most" };
        let damped = if laws.damping == DampingLaw::None { "" } else { ", damping aside" };
        Some(format!(
            "the time step {} is larger than the {} advised; template {} {what} {}{damped}",
            figure(dt),
            figure(self.step),
            self.template,
            figure(self.limit)
        ))
    }
}
