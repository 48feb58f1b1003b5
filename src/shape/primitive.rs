//! Analytic particles: the built-in demo and test shapes.

use super::{ImportOptions, Shape};
use crate::error::{Error, Result};
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
    /// Bi-convex tablet (paper 000, table 1: band radius 5.675 mm, band height 4.0 mm, cap height 1.23 mm).
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

    /// A primitive by name with its default parameters (the tablet is paper 000's, in millimetres).
    pub fn from_name(name: &str) -> Result<Primitive> {
        Err(Error::Unsupported(format!("no analytic particle is called {name}")))
    }

    /// The names and values of the parameters, in order (a vector gives `a`, `b`, `c` …).
    pub fn parameters(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

    /// Sets one parameter by name.
    pub fn set(&mut self, key: &str, value: f64) -> Result<()> {
        Err(Error::InvalidArgument(format!("no parameter {key} (value {value})")))
    }

    /// A watertight mesh with about `segments` edges around the body (vertices, faces).
    #[allow(clippy::type_complexity)]
    pub fn mesh(&self, segments: usize) -> Result<(Vec<[f64; 3]>, Vec<[u32; 3]>)> {
        let _ = segments;
        Err(Error::Internal("analytic particles are not built yet".into()))
    }

    /// Exact moments of the ideal body, where a formula exists (not for the stone).
    pub fn moments(&self) -> Option<Moments> {
        None
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
