//! Laws of contact, composed at compile time: one instance for each combination that makes sense, chosen
//! once for a scene.

use super::built::built;
use super::effects::cohesion::{Cohesion, Dry, Jkr, Stress};
use super::effects::damping::{Damping, Elasticity, Restitution, dashpot};
use super::effects::normal::{Hertz, Linear, Normal, brief};
use super::effects::rolling::{Free, Resistance, Rolling};
use super::effects::tangential::{NoSlip, Smooth, Spring, Tangential, Viscous};
use super::effects::{Coefficients, Touch};
use crate::error::{Error, Result};
use crate::math::Vec3;
use nalgebra::Matrix3;
use std::marker::PhantomData;

/// How bodies push each other along the normal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NormalLaw {
    /// A linear spring.
    Linear,
    /// Hertz (1882).
    Hertz,
}

/// Which mass damping goes by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DampingLaw {
    /// No damping.
    None,
    /// That of the bodies: 1/(1/m_a + 1/m_b). A blow beside the centre then rebounds too slowly.
    Bodies,
    /// What the contact feels: 1/Σ(1/m + (r × n)·I⁻¹(r × n)).
    Contact,
}

/// Friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TangentialLaw {
    /// None.
    None,
    /// Viscous, up to μ N.
    Viscous,
    /// A spring with history: Mindlin's stiffness with Hertz, a constant one with a linear law.
    Mindlin,
    /// Hertz–Mindlin no-slip: increments of the force.
    NoSlip,
}

/// Cohesion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CohesionLaw {
    /// None.
    None,
    /// A stress on the area of contact.
    Linear,
    /// Johnson, Kendall and Roberts (1971).
    Jkr,
}

/// The laws that a scene names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Laws {
    /// Repulsion.
    pub normal: NormalLaw,
    /// Damping.
    pub damping: DampingLaw,
    /// Friction.
    pub tangential: TangentialLaw,
    /// Resistance to rolling.
    pub rolling: bool,
    /// Cohesion.
    pub cohesion: CohesionLaw,
    /// Contact averaging per pair of bodies: see [`super::effects::averaging`].
    pub averaging: bool,
}

impl Laws {
    /// Repulsion alone.
    pub fn elastic(normal: NormalLaw) -> Laws {
        Laws {
            normal,
            damping: DampingLaw::None,
            tangential: TangentialLaw::None,
            rolling: false,
            cohesion: CohesionLaw::None,
            averaging: false,
        }
    }
}

/// How two bodies move against each other, in the frame of the first: shared by all their contacts.
pub(crate) struct Motion {
    /// The second's axes in the first's.
    pub turn: Matrix3<f64>,
    /// Velocities, at the end and in the middle of the step: of the second centre from the first, and both spins.
    pub v: Vec3,
    pub wa: Vec3,
    pub wb: Vec3,
    pub vh: Vec3,
    pub wah: Vec3,
    pub wbh: Vec3,
    /// One over the moments of each, along its own axes.
    pub inertia: [Vec3; 2],
    /// 1/m_a + 1/m_b, and one over that.
    pub inverse_mass: f64,
    pub mass: f64,
    /// What dashpots are multiplied by: less than 1 where many springs are averaged that did not come at once.
    pub ease: f64,
}

/// What a contact does.
pub(crate) struct Action {
    /// Force on the second body at the place of contact.
    pub force: Vec3,
    /// Couple on the second body.
    pub couple: Vec3,
    /// Elastic force.
    pub elastic: f64,
}

/// How often each law was asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Calls {
    /// Repulsion.
    pub normal: u64,
    /// Damping.
    pub damping: u64,
    /// Friction.
    pub tangential: u64,
    /// Resistance to rolling.
    pub rolling: u64,
    /// Cohesion.
    pub cohesion: u64,
    /// Averaging.
    pub averaging: u64,
}

impl Calls {
    pub(crate) fn add(&mut self, more: &Calls) {
        self.normal += more.normal;
        self.damping += more.damping;
        self.tangential += more.tangential;
        self.rolling += more.rolling;
        self.cohesion += more.cohesion;
        self.averaging += more.averaging;
    }
}

/// A composition of laws.
pub(crate) trait Law: Copy + Send + Sync + 'static {
    /// How many numbers a contact remembers.
    const WIDTH: usize;
    /// Of these: friction, rolling resistance, cohesion.
    const WIDTHS: [usize; 3];
    /// Whether contacts may last beyond touching.
    const FAR: bool;
    /// What one contact does; `None` where it is none any more.
    fn act(t: &Touch, felt: bool, memory: &mut [f64], calls: &mut Calls) -> Option<Action>;
    /// What its springs hold.
    fn energy(c: &Coefficients, overlap: f64, radius: f64, memory: &[f64]) -> f64;
}

/// Normal, damping, tangential, rolling, cohesion. A contact remembers what friction, then rolling, then cohesion do.
pub(crate) struct Composed<N, D, T, R, C>(PhantomData<(N, D, T, R, C)>);

impl<N, D, T, R, C> Clone for Composed<N, D, T, R, C> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N, D, T, R, C> Copy for Composed<N, D, T, R, C> {}

impl<N: Normal, D: Damping, T: Tangential, R: Rolling, C: Cohesion> Law
    for Composed<N, D, T, R, C>
{
    const WIDTH: usize = T::WIDTH + R::WIDTH + C::WIDTH;
    const WIDTHS: [usize; 3] = [T::WIDTH, R::WIDTH, C::WIDTH];
    const FAR: bool = C::FAR;

    #[inline(always)]
    fn act(t: &Touch, felt: bool, memory: &mut [f64], calls: &mut Calls) -> Option<Action> {
        let c = t.coefficients;
        let mut push = N::push(c, t.overlap.max(0.0), t.radius);
        // Where the law along the normal takes no energy, none may come or go by how steps fall on blows.
        if const { !D::ON && !C::ON } && t.overlap < t.stride {
            push.force = brief::<N>(t, push.force);
        }
        calls.normal += 1;
        let (friction, memory) = memory.split_at_mut(T::WIDTH);
        let (rolling, cohesion) = memory.split_at_mut(R::WIDTH);
        if C::ON {
            calls.cohesion += 1;
        }
        let e = C::pull(c, t.overlap, t.radius, push, cohesion)?;
        let (mut force, mut damper) = (e.force, 0.0);
        if D::ON {
            calls.damping += 1;
            let mass = if felt { t.felt_mass() } else { t.motion.mass };
            damper = t.motion.ease * dashpot(c, mass, e.stiffness);
            // The dashpot never makes a contact pull.
            force = (force - damper * t.velocity.dot(&t.normal)).max(e.force.min(0.0));
        }
        let mut whole = t.normal * force;
        if T::ON {
            calls.tangential += 1;
            whole += T::hold(t, &e, force + e.pull, damper, friction);
        }
        let mut couple = Vec3::zeros();
        if R::ON {
            calls.rolling += 1;
            couple = R::resist(t, &e, force + e.pull, rolling);
        }
        Some(Action { force: whole, couple, elastic: e.force })
    }

    fn energy(c: &Coefficients, overlap: f64, radius: f64, memory: &[f64]) -> f64 {
        let touch = overlap.max(0.0);
        let push = N::push(c, touch, radius);
        let (friction, rest) = memory.split_at(T::WIDTH);
        let (rolling, cohesion) = rest.split_at(R::WIDTH);
        let mut own = cohesion.first().copied().map_or([0.0], |m| [m]);
        let Some(e) = C::pull(c, overlap, radius, push, &mut own) else { return 0.0 };
        C::energy(c, overlap, radius, N::energy(c, touch, radius))
            + T::energy(c, &e, friction)
            + R::energy(&e, rolling)
    }
}

/// What is done with the laws of a scene once they are known as a type.
pub(crate) trait Visitor {
    type Out;
    fn visit<L: Law>(self) -> Self::Out;
}

/// The instances: for each damping, normal × tangential × rolling × cohesion.
macro_rules! instances {
    ($($normal:ident $tangential:ident $rolling:ident $cohesion:ident: $n:ident $t:ident $r:ident $c:ident;)*) => {
        /// How many compositions are built: for each of the two dampings those of the table.
        pub const INSTANCES: usize = 2 * [$(stringify!($n $t $r $c)),*].len();

        fn compose<V: Visitor, D: Damping>(laws: &Laws, v: V) -> Option<V::Out> {
            match (laws.normal, laws.tangential, laws.rolling, laws.cohesion) {
                $((NormalLaw::$normal, TangentialLaw::$tangential, $rolling, CohesionLaw::$cohesion)
                    if const { is_built::<$t, $r, $c>() } =>
                {
                    Some(v.visit::<Composed<$n, D, $t, $r, $c>>())
                })*
                _ => None,
            }
        }
    };
}

instances! {
    Linear None false None: Linear Smooth Free Dry;
    Linear None false Linear: Linear Smooth Free Stress;
    Linear Viscous false None: Linear Viscous Free Dry;
    Linear Mindlin false None: Linear Spring Free Dry;
    Linear Mindlin false Linear: Linear Spring Free Stress;
    Linear Mindlin true None: Linear Spring Resistance Dry;
    Linear Mindlin true Linear: Linear Spring Resistance Stress;
    Hertz None false None: Hertz Smooth Free Dry;
    Hertz None false Linear: Hertz Smooth Free Stress;
    Hertz None false Jkr: Hertz Smooth Free Jkr;
    Hertz Viscous false None: Hertz Viscous Free Dry;
    Hertz Mindlin false None: Hertz Spring Free Dry;
    Hertz Mindlin false Linear: Hertz Spring Free Stress;
    Hertz Mindlin false Jkr: Hertz Spring Free Jkr;
    Hertz Mindlin true None: Hertz Spring Resistance Dry;
    Hertz Mindlin true Linear: Hertz Spring Resistance Stress;
    Hertz Mindlin true Jkr: Hertz Spring Resistance Jkr;
    Hertz NoSlip false None: Hertz NoSlip Free Dry;
    Hertz NoSlip false Linear: Hertz NoSlip Free Stress;
    Hertz NoSlip false Jkr: Hertz NoSlip Free Jkr;
}

/// Whether all these laws are.
const fn is_built<T: Tangential, R: Rolling, C: Cohesion>() -> bool {
    (!T::ON || const { built("tangential") })
        && (!R::ON || const { built("rolling") })
        && (!C::ON || const { built("cohesion") })
}

/// Calls `v` with the type of these laws. Refused: combinations that are not built.
pub(crate) fn choose<V: Visitor>(laws: &Laws, v: V) -> Result<V::Out> {
    if laws.averaging && laws.cohesion == CohesionLaw::Jkr {
        return Err(Error::Unsupported("contact averaging does not go with JKR cohesion".into()));
    }
    let found = match laws.damping {
        DampingLaw::None => compose::<V, Elasticity>(laws, v),
        _ if const { built("damping") } => compose::<V, Restitution>(laws, v),
        _ => None,
    };
    found.ok_or_else(|| {
        Error::Unsupported(match (laws.normal, laws.tangential, laws.rolling, laws.cohesion) {
            (NormalLaw::Linear, TangentialLaw::NoSlip, ..) => {
                "no-slip friction needs the hertz law".into()
            }
            (NormalLaw::Linear, _, _, CohesionLaw::Jkr) => {
                "jkr cohesion needs the hertz law".into()
            }
            (_, TangentialLaw::Viscous, _, c) if c != CohesionLaw::None => {
                "viscous friction does not go with cohesion".into()
            }
            _ => "rolling resistance needs mindlin friction".into(),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_most_forty_compositions_are_built() {
        const { assert!(INSTANCES <= 40) };
    }
}
