//! What a scene says of its materials, made into coefficients of the laws that it names.

use super::contact::{CohesionLaw, DampingLaw, Laws, NormalLaw, TangentialLaw};
use super::effects::Coefficients;
use super::effects::damping::ratio;
use crate::error::{Error, Result, figure};

/// A material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus.
    pub young: f64,
    /// Poisson's ratio, −1 to ½, without −1.
    pub poisson: f64,
}

/// What is between two materials. What is `None` is not named.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Between {
    /// Stiffness of a linear spring.
    pub stiffness: Option<f64>,
    /// Stiffness in the plane of contact over that along the normal, of a linear law; else 2/7·…: 0.8 where nothing is
    /// said.
    pub shear: Option<f64>,
    /// Coefficient of restitution, 0 to 1.
    pub restitution: Option<f64>,
    /// μ.
    pub friction: Option<f64>,
    /// Force over speed of viscous friction.
    pub viscosity: Option<f64>,
    /// μ_r.
    pub rolling: Option<f64>,
    /// Stress of cohesion, or work of adhesion per area of JKR.
    pub cohesion: Option<f64>,
}

impl Coefficients {
    /// The coefficients of two materials under these laws. Hertz takes the materials, a linear law the stiffness.
    ///
    /// Refused: what a law needs and is not there, what is there and no law needs, a restitution outside 0 to 1, a modulus that is not
    /// above 0, a Poisson's ratio that is none, anything negative.
    pub fn of(laws: &Laws, materials: Option<[Material; 2]>, b: &Between) -> Result<Coefficients> {
        let needed = |what: &str, law: bool, v: Option<f64>, why: &str| match (law, v) {
            (true, Some(v)) if v.is_finite() && v >= 0.0 => Ok(v),
            (true, Some(v)) => Err(Error::InvalidArgument(format!(
                "the {what} is {}, not a number of 0 or more",
                figure(v)
            ))),
            (true, None) => {
                Err(Error::InvalidArgument(format!("{why} needs a {what}, and there is none")))
            }
            (false, Some(v)) => Err(Error::InvalidArgument(format!(
                "a {what} of {} does nothing without {why}",
                figure(v)
            ))),
            (false, None) => Ok(0.0),
        };
        let mut c = Coefficients::default();
        let linear = laws.normal == NormalLaw::Linear;
        let held = matches!(laws.tangential, TangentialLaw::Mindlin | TangentialLaw::NoSlip);
        let stiffness = needed("stiffness", linear, b.stiffness, "a linear law")?;
        if linear {
            if stiffness == 0.0 {
                return Err(Error::InvalidArgument("the stiffness is 0".into()));
            }
            c.stiffness = stiffness;
            if held {
                let shear = b.shear.unwrap_or(0.8);
                c.shear = stiffness * needed("shear", true, Some(shear), "friction")?;
            }
        } else {
            let Some(both) = materials else {
                return Err(Error::InvalidArgument(
                    "the hertz law needs a Young's modulus and a Poisson's ratio".into(),
                ));
            };
            let (mut normal, mut shear) = (0.0, 0.0);
            for m in both {
                if !(m.young.is_finite() && m.young > 0.0) {
                    let y = figure(m.young);
                    return Err(Error::InvalidArgument(format!(
                        "Young's modulus is {y}, not a number above 0"
                    )));
                }
                if !(m.poisson > -1.0 && m.poisson <= 0.5) {
                    let p = figure(m.poisson);
                    return Err(Error::InvalidArgument(format!(
                        "Poisson's ratio is {p}, not between -1 and 0.5"
                    )));
                }
                normal += (1.0 - m.poisson * m.poisson) / m.young;
                shear += 2.0 * (2.0 - m.poisson) * (1.0 + m.poisson) / m.young;
            }
            c.stiffness = 1.0 / normal;
            if held {
                c.shear = 8.0 / shear;
            }
        }
        if b.shear.is_some() && !(linear && held) {
            return Err(Error::InvalidArgument(
                "a shear stiffness does nothing without a linear law and friction".into(),
            ));
        }
        let damped = laws.damping != DampingLaw::None;
        let e = needed("restitution", damped, b.restitution, "damping")?;
        if damped {
            if e > 1.0 {
                let e = figure(e);
                return Err(Error::InvalidArgument(format!("the restitution is {e}, above 1")));
            }
            c.damping = if linear { 2.0 } else { 5f64.sqrt() } * ratio(e);
            c.tangential_damping = if held { 1.0 } else { 0.0 };
        }
        let rubs = laws.tangential != TangentialLaw::None;
        c.friction = needed("friction", rubs, b.friction, "a tangential law")?;
        let viscous = laws.tangential == TangentialLaw::Viscous;
        c.viscosity = needed("viscosity", viscous, b.viscosity, "viscous friction")?;
        c.rolling = needed("rolling resistance", laws.rolling, b.rolling, "a rolling law")?;
        let sticks = laws.cohesion != CohesionLaw::None;
        c.cohesion = needed("cohesion", sticks, b.cohesion, "a law of cohesion")?;
        Ok(c)
    }
}
