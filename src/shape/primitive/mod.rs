//! Analytic particles: the built-in demo and test shapes.

mod moments;
mod parameters;
mod stone;
mod tessellate;

use super::{ImportOptions, Shape};
use crate::error::{Error, Result, figure};
use crate::math::Moments;
use crate::run::Run;
pub use parameters::Parameter;

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

    /// Checks every parameter, and those that must fit each other.
    fn check(&self) -> Result<()> {
        let mut copy = *self;
        for slot in copy.slots() {
            slot.range.check(self.name(), slot.key, *slot.value)?;
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
