//! Analytic particles: the built-in demo and test shapes.

mod moments;
mod stone;
mod tessellate;

use super::{ImportOptions, Shape};
use crate::error::{Error, Result, figure};
use crate::math::Moments;
use crate::run::Run;

/// An analytic particle, centred on the origin, axis of revolution along z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive {
    /// Sphere.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// Ellipsoid.
    Ellipsoid {
        /// Semi-axes along x, y, z.
        axes: [f64; 3],
    },
    /// Superellipsoid `(|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) = 1`.
    Superellipsoid {
        /// Semi-axes along x, y, z.
        axes: [f64; 3],
        /// Exponents (e1, e2), each in [0.1, 2.5]; (1, 1) is an ellipsoid, smaller is boxier.
        exponents: [f64; 2],
    },
    /// Box.
    Box {
        /// Edge lengths along x, y, z.
        edges: [f64; 3],
    },
    /// Cylinder.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Height along z.
        height: f64,
    },
    /// Capsule: a cylinder with hemispherical caps.
    Capsule {
        /// Radius.
        radius: f64,
        /// Height of the cylindrical part.
        height: f64,
    },
    /// Torus about z.
    Torus {
        /// Radius of the centre line.
        major: f64,
        /// Radius of the tube.
        minor: f64,
    },
    /// Cone with its base below; its centroid is on the origin.
    Cone {
        /// Radius of the base.
        radius: f64,
        /// Height along z.
        height: f64,
    },
    /// Bi-convex tablet (Yuan 2019, table 1: band radius 5.675 mm, band height 4.0 mm, cap height 1.23 mm).
    Tablet {
        /// Radius of the band.
        band_radius: f64,
        /// Height of the band.
        band_height: f64,
        /// Height of each spherical cap.
        cap_height: f64,
    },
    /// M&M: an oblate spheroid.
    Mandm {
        /// Equatorial radius.
        radius: f64,
        /// Ratio of the short axis to the long one.
        flatness: f64,
    },
    /// A rough, angular, watertight stone; each seed gives another.
    Stone {
        /// Which stone.
        seed: u64,
        /// Diameter of the sphere of equal volume.
        diameter: f64,
        /// Size of the facets and roughness in [0, 1].
        roughness: f64,
    },
}

impl Primitive {
    /// Every name that [`Primitive::from_name`] takes.
    pub const NAMES: [&'static str; 11] = [
        "sphere",
        "ellipsoid",
        "superellipsoid",
        "box",
        "cylinder",
        "capsule",
        "torus",
        "cone",
        "tablet",
        "mandm",
        "stone",
    ];

    /// A primitive by name with its default parameters: lengths about 1, but for
    /// the tablet (Yuan 2019, table 1) and the M&M (Donev et al., Science 303, 2004:
    /// diameters 13.40 and 6.93), which are in millimetres.
    pub fn from_name(name: &str) -> Result<Primitive> {
        Ok(match name {
            "sphere" => Primitive::Sphere { radius: 1.0 },
            "ellipsoid" => Primitive::Ellipsoid { axes: [1.0, 0.75, 0.5] },
            "superellipsoid" => {
                Primitive::Superellipsoid { axes: [1.0, 0.75, 0.5], exponents: [0.5, 0.5] }
            }
            "box" => Primitive::Box { edges: [1.0, 1.0, 1.0] },
            "cylinder" => Primitive::Cylinder { radius: 0.5, height: 1.0 },
            "capsule" => Primitive::Capsule { radius: 0.5, height: 1.0 },
            "torus" => Primitive::Torus { major: 1.0, minor: 0.4 },
            "cone" => Primitive::Cone { radius: 1.0, height: 2.0 },
            "tablet" => {
                Primitive::Tablet { band_radius: 5.675, band_height: 4.0, cap_height: 1.23 }
            }
            "mandm" => Primitive::Mandm { radius: 6.7, flatness: 6.93 / 13.4 },
            "stone" => Primitive::Stone { seed: 1, diameter: 1.0, roughness: 0.5 },
            _ => {
                return Err(Error::Unsupported(format!(
                    "no analytic particle is called {name:?}; there are {}",
                    Primitive::NAMES.join(", ")
                )));
            }
        })
    }

    /// The name that [`Primitive::from_name`] takes.
    pub fn name(&self) -> &'static str {
        match self {
            Primitive::Sphere { .. } => "sphere",
            Primitive::Ellipsoid { .. } => "ellipsoid",
            Primitive::Superellipsoid { .. } => "superellipsoid",
            Primitive::Box { .. } => "box",
            Primitive::Cylinder { .. } => "cylinder",
            Primitive::Capsule { .. } => "capsule",
            Primitive::Torus { .. } => "torus",
            Primitive::Cone { .. } => "cone",
            Primitive::Tablet { .. } => "tablet",
            Primitive::Mandm { .. } => "mandm",
            Primitive::Stone { .. } => "stone",
        }
    }

    /// The names and values of the parameters, in order (a vector gives `a`, `b`, `c`;
    /// the exponents are `e1`, `e2`).
    pub fn parameters(&self) -> Vec<(&'static str, f64)> {
        let mut copy = *self;
        let seed = if let Primitive::Stone { seed, .. } = self { Some(*seed as f64) } else { None };
        seed.map(|s| ("seed", s))
            .into_iter()
            .chain(copy.slots().into_iter().map(|(key, _, slot)| (key, *slot)))
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
        for (known, range, slot) in self.slots() {
            if known == key {
                range.check(name, key, value)?;
                *slot = value;
                return Ok(());
            }
        }
        let known: Vec<_> = self.parameters().iter().map(|p| p.0).collect();
        Err(Error::InvalidArgument(format!(
            "the {name} has no parameter {key:?}; it has {}",
            known.join(", ")
        )))
    }

    /// The real-valued parameters with their ranges.
    fn slots(&mut self) -> Vec<(&'static str, Range, &mut f64)> {
        use Range::{Exponent, Fraction, Length, Ratio};
        match self {
            Primitive::Sphere { radius } => vec![("radius", Length, radius)],
            Primitive::Ellipsoid { axes: [a, b, c] } | Primitive::Box { edges: [a, b, c] } => {
                vec![("a", Length, a), ("b", Length, b), ("c", Length, c)]
            }
            Primitive::Superellipsoid { axes: [a, b, c], exponents: [e1, e2] } => vec![
                ("a", Length, a),
                ("b", Length, b),
                ("c", Length, c),
                ("e1", Exponent, e1),
                ("e2", Exponent, e2),
            ],
            Primitive::Cylinder { radius, height }
            | Primitive::Capsule { radius, height }
            | Primitive::Cone { radius, height } => {
                vec![("radius", Length, radius), ("height", Length, height)]
            }
            Primitive::Torus { major, minor } => {
                vec![("major", Length, major), ("minor", Length, minor)]
            }
            Primitive::Tablet { band_radius, band_height, cap_height } => vec![
                ("band_radius", Length, band_radius),
                ("band_height", Length, band_height),
                ("cap_height", Length, cap_height),
            ],
            Primitive::Mandm { radius, flatness } => {
                vec![("radius", Length, radius), ("flatness", Ratio, flatness)]
            }
            Primitive::Stone { diameter, roughness, .. } => {
                vec![("diameter", Length, diameter), ("roughness", Fraction, roughness)]
            }
        }
    }

    /// Checks every parameter, and those that must fit each other.
    fn check(&self) -> Result<()> {
        let mut copy = *self;
        for (key, range, slot) in copy.slots() {
            range.check(self.name(), key, *slot)?;
        }
        match *self {
            Primitive::Torus { major, minor } if minor >= major => {
                Err(Error::InvalidArgument(format!(
                    "minor of the torus is {}, not less than major, {}",
                    figure(minor),
                    figure(major)
                )))
            }
            Primitive::Tablet { band_radius, cap_height, .. } if cap_height > band_radius => {
                Err(Error::InvalidArgument(format!(
                    "cap_height of the tablet is {}, more than band_radius, {}",
                    figure(cap_height),
                    figure(band_radius)
                )))
            }
            _ => Ok(()),
        }
    }

    /// A watertight mesh with about `segments` edges around the body (vertices,
    /// faces), outward oriented, its vertices on the ideal surface. It has the
    /// mirror planes of the body, to the last bit.
    #[allow(clippy::type_complexity)]
    pub fn mesh(&self, segments: usize) -> Result<(Vec<[f64; 3]>, Vec<[u32; 3]>)> {
        if !(8..=2048).contains(&segments) {
            return Err(Error::InvalidArgument(format!(
                "segments is {segments}, not from 8 to 2048"
            )));
        }
        self.check()?;
        match *self {
            Primitive::Stone { seed, diameter, roughness } => {
                Ok(stone::mesh(seed, diameter, roughness, segments))
            }
            _ => Ok(tessellate::mesh(self, segments)),
        }
    }

    /// Exact moments of the ideal body, where a formula exists (not for the stone);
    /// `None` for parameters that [`Primitive::mesh`] refuses.
    pub fn moments(&self) -> Option<Moments> {
        self.check().ok()?;
        moments::of(self)
    }
}

/// What a parameter may be.
#[derive(Debug, Clone, Copy)]
enum Range {
    Length,
    Exponent,
    Ratio,
    Fraction,
}

impl Range {
    fn check(self, name: &str, key: &str, value: f64) -> Result<()> {
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

impl Shape {
    /// The shape of an analytic particle: the mesh of [`Primitive::mesh`].
    pub fn from_primitive(
        primitive: &Primitive,
        segments: usize,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        let (vertices, faces) = primitive.mesh(segments)?;
        Shape::from_mesh(&vertices, &faces, options, run)
    }
}
