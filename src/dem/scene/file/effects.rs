//! Effects, and what materials do to each other.

use serde::Deserialize;

/// The effects.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EffectsPart {
    /// Acceleration of gravity.
    pub gravity: Option<[f64; 3]>,
    /// Repulsion along the normal.
    pub normal: Option<NormalName>,
    /// Damping along the normal by restitution, and which mass it goes by.
    pub damping: Option<DampingName>,
    /// Friction.
    pub tangential: Option<TangentialName>,
    /// Resistance to rolling.
    #[serde(default)]
    pub rolling: bool,
    /// Cohesion.
    pub cohesion: Option<CohesionName>,
    /// Contact averaging per pair of bodies.
    #[serde(default)]
    pub averaging: bool,
    /// A fluid that slows bodies down.
    pub drag: Option<DragPart>,
}

/// A fluid.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DragPart {
    /// Dynamic viscosity.
    pub viscosity: f64,
    /// Density.
    #[serde(default)]
    pub density: f64,
    /// Drag coefficient of the quadratic part.
    #[serde(default)]
    pub coefficient: f64,
    /// Velocity of the fluid.
    #[serde(default)]
    pub flow: [f64; 3],
}

/// Repulsion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NormalName {
    /// A spring.
    Linear,
    /// Hertz.
    Hertz,
}

/// Damping.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DampingName {
    /// By the masses of the bodies.
    Bodies,
    /// By the mass that the contact feels.
    Contact,
}

/// Friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TangentialName {
    /// Against the sliding, without memory.
    Viscous,
    /// A spring with history.
    Mindlin,
    /// Hertz–Mindlin, no slip.
    NoSlip,
}

/// Cohesion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CohesionName {
    /// A stress on the area of contact.
    Linear,
    /// Johnson, Kendall and Roberts.
    Jkr,
}

/// A material, and what two bodies of it do to each other.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialPart {
    /// Young's modulus, for Hertz.
    pub young: Option<f64>,
    /// Poisson's ratio, for Hertz.
    pub poisson: Option<f64>,
    /// Spring of a contact of two bodies of it, for the linear law.
    pub stiffness: Option<f64>,
    /// Speed after a central blow over that before, 0 to 1.
    pub restitution: Option<f64>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
    /// Force over speed, for viscous friction.
    pub viscosity: Option<f64>,
    /// Stiffness in the plane of contact over that along the normal, for the linear law with friction; 0.8 without.
    pub shear: Option<f64>,
    /// Coefficient of resistance to rolling.
    pub rolling: Option<f64>,
    /// Stress, or with jkr the work of adhesion per area.
    pub cohesion: Option<f64>,
}

/// Two materials.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairPart {
    /// Their names.
    pub between: [String; 2],
    /// Spring of their contact, for the linear law.
    pub stiffness: Option<f64>,
    /// Speed after a central blow over that before, 0 to 1.
    pub restitution: Option<f64>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
    /// Force over speed, for viscous friction.
    pub viscosity: Option<f64>,
    /// Stiffness in the plane of contact over that along the normal, for the linear law with friction; 0.8 without.
    pub shear: Option<f64>,
    /// Coefficient of resistance to rolling.
    pub rolling: Option<f64>,
    /// Stress, or with jkr the work of adhesion per area.
    pub cohesion: Option<f64>,
}
