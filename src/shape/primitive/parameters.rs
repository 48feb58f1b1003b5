//! The parameters of analytic particles by name: what each means, what it may be.

use super::Primitive;
use crate::error::{Error, Result, figure};

/// One parameter of a [`Primitive`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Its name, for [`Primitive::set`].
    pub key: &'static str,
    /// Its value; that of [`Primitive::from_name`] is the default.
    pub value: f64,
    /// What it is.
    pub meaning: &'static str,
}

const SEED: &str = "which stone, a whole number from 0 to 2^53";

/// A real-valued parameter in its place.
pub(super) struct Slot<'a> {
    pub key: &'static str,
    pub range: Range,
    pub value: &'a mut f64,
    meaning: &'static str,
}

/// What a parameter may be.
#[derive(Debug, Clone, Copy)]
pub(super) enum Range {
    Length,
    Exponent,
    Ratio,
    Fraction,
}

impl Range {
    pub fn check(self, name: &str, key: &str, value: f64) -> Result<()> {
        if !value.is_finite() {
            return Err(Error::NotFinite(format!("{key} of the {name} is {value}")));
        }
        let (ok, range) = match self {
            // The fifth power of a length (an inertia) must be a normal number.
            Range::Length => ((1e-60..=1e60).contains(&value), "from 1e-60 to 1e60"),
            Range::Exponent => ((0.1..=2.5).contains(&value), "from 0.1 to 2.5"),
            Range::Ratio => ((1e-6..=1.0).contains(&value), "from 1e-6 to 1"),
            Range::Fraction => ((0.0..=1.0).contains(&value), "from 0 to 1"),
        };
        if ok {
            return Ok(());
        }
        let value = figure(value);
        Err(Error::InvalidArgument(format!("{key} of the {name} is {value}, not {range}")))
    }
}

impl Primitive {
    /// The parameters, in order.
    pub fn parameters(&self) -> Vec<Parameter> {
        let mut copy = *self;
        let seed = match self {
            // As far as f64 counts without gaps.
            Primitive::Stone { seed, .. } => Some(*seed as f64),
            _ => None,
        };
        seed.map(|value| Parameter { key: "seed", value, meaning: SEED })
            .into_iter()
            .chain(copy.slots().into_iter().map(|s| Parameter {
                key: s.key,
                value: *s.value,
                meaning: s.meaning,
            }))
            .collect()
    }

    /// Sets one parameter by name. A value out of its own range is refused here,
    /// one that does not fit the others by [`Primitive::mesh`].
    pub fn set(&mut self, key: &str, value: f64) -> Result<()> {
        let name = self.name();
        if let Primitive::Stone { seed, .. } = self
            && key == "seed"
        {
            // Whole numbers that f64 counts without gaps.
            if !(value.is_finite() && (0.0..=9_007_199_254_740_992.0).contains(&value))
                || value.fract() != 0.0
            {
                return Err(Error::InvalidArgument(format!(
                    "seed of the stone is {}, not a whole number from 0 to 2^53",
                    figure(value)
                )));
            }
            *seed = value as u64;
            return Ok(());
        }
        for slot in self.slots() {
            if slot.key == key {
                slot.range.check(name, key, value)?;
                *slot.value = value;
                return Ok(());
            }
        }
        let known: Vec<_> = self.parameters().iter().map(|p| p.key).collect();
        Err(Error::InvalidArgument(format!(
            "the {name} has no parameter {key:?}; it has {}",
            known.join(", ")
        )))
    }

    /// The real-valued parameters: the one table of their names, ranges and meanings.
    pub(super) fn slots(&mut self) -> Vec<Slot<'_>> {
        use Range::{Exponent, Fraction, Length, Ratio};
        let slot = |key, range, value, meaning| Slot { key, range, value, meaning };
        match self {
            Primitive::Sphere { radius } => vec![slot("radius", Length, radius, "radius")],
            Primitive::Ellipsoid { axes: [a, b, c] } => vec![
                slot("a", Length, a, "semi-axis along x"),
                slot("b", Length, b, "semi-axis along y"),
                slot("c", Length, c, "semi-axis along z"),
            ],
            Primitive::Superellipsoid { axes: [a, b, c], exponents: [e1, e2] } => vec![
                slot("a", Length, a, "semi-axis along x"),
                slot("b", Length, b, "semi-axis along y"),
                slot("c", Length, c, "semi-axis along z"),
                slot("e1", Exponent, e1, "exponent along z, 0.1 to 2.5; 1 is round, less boxier"),
                slot("e2", Exponent, e2, "exponent in the xy plane, likewise"),
            ],
            Primitive::Box { edges: [a, b, c] } => vec![
                slot("a", Length, a, "edge along x"),
                slot("b", Length, b, "edge along y"),
                slot("c", Length, c, "edge along z"),
            ],
            Primitive::Cylinder { radius, height } => vec![
                slot("radius", Length, radius, "radius"),
                slot("height", Length, height, "height along z"),
            ],
            Primitive::Capsule { radius, height } => vec![
                slot("radius", Length, radius, "radius, also of the caps"),
                slot("height", Length, height, "height along z of the cylinder, without the caps"),
            ],
            Primitive::Torus { major, minor } => vec![
                slot("major", Length, major, "radius of the centre line, about z"),
                slot("minor", Length, minor, "radius of the tube, less than major"),
            ],
            Primitive::Cone { radius, height } => vec![
                slot("radius", Length, radius, "radius of the base, which is below"),
                slot("height", Length, height, "height along z; the centroid is at the origin"),
            ],
            Primitive::Tablet { band_radius, band_height, cap_height } => vec![
                slot("band_radius", Length, band_radius, "radius of the band"),
                slot("band_height", Length, band_height, "height of the band along z"),
                slot("cap_height", Length, cap_height, "height of each cap, at most band_radius"),
            ],
            Primitive::Mandm { radius, flatness } => vec![
                slot("radius", Length, radius, "equatorial radius"),
                slot(
                    "flatness",
                    Ratio,
                    flatness,
                    "short axis (along z) over the long one, at most 1",
                ),
            ],
            Primitive::Stone { diameter, roughness, .. } => vec![
                slot("diameter", Length, diameter, "diameter of the sphere of equal volume"),
                slot("roughness", Fraction, roughness, "size of the facets and roughness, 0 to 1"),
            ],
        }
    }
}
