//! What clumps of the method best must keep to.

use crate::input::parse::{not_negative, numbers, positive};
use clap::ValueEnum;
use morula::generate::{BestOptions, HalfSpace, Symmetry};
use morula::math::Vec3;

#[derive(clap::Args)]
#[command(next_help_heading = "Method best")]
pub struct Demands {
    /// How many times as much as shape that is not covered, clump beyond the shape counts
    #[arg(long, value_name = "WEIGHT", default_value_t = 1.0, value_parser = positive)]
    overshoot_weight: f64,
    /// How far a sphere may reach beyond the surface, in your length unit
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    max_protrusion: Option<f64>,
    /// Greatest radius, in your length unit
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    max_radius: Option<f64>,
    /// Keep all spheres where NX x + NY y + NZ z <= D; may be given more than once
    #[arg(long, value_name = "NX,NY,NZ,D", value_parser = numbers::<4>, allow_hyphen_values = true)]
    half_space: Vec<[f64; 4]>,
    /// Let the spheres hang together by overlaps
    #[arg(long)]
    connected: bool,
    /// Give the clump the volume of the shape
    #[arg(long)]
    equal_volume: bool,
    /// Weight of the distance between the surfaces against D
    #[arg(long, value_name = "WEIGHT", default_value_t = 0.0, value_parser = not_negative)]
    smoothness: f64,
    /// Exact symmetry of the clump [default: none]
    #[arg(long, value_enum, conflicts_with = "symmetry_plane")]
    symmetry: Option<SymmetryArg>,
    /// Normal of a mirror plane through the centre of mass; may be given more than once
    #[arg(long, value_name = "NX,NY,NZ", value_parser = numbers::<3>, allow_hyphen_values = true)]
    symmetry_plane: Vec<[f64; 3]>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum SymmetryArg {
    /// None but by chance
    None,
    /// The shape's own mirror planes and exchanges of axes
    Auto,
}

impl Demands {
    pub fn options(&self) -> BestOptions {
        BestOptions {
            overshoot_weight: self.overshoot_weight,
            max_protrusion: self.max_protrusion.unwrap_or(0.0),
            max_radius: self.max_radius.unwrap_or(0.0),
            half_spaces: self
                .half_space
                .iter()
                .map(|&[x, y, z, offset]| HalfSpace { normal: Vec3::new(x, y, z), offset })
                .collect(),
            connected: self.connected,
            equal_volume: self.equal_volume,
            smoothness: self.smoothness,
            symmetry: match self.symmetry {
                Some(SymmetryArg::Auto) => Symmetry::Auto,
                _ if self.symmetry_plane.is_empty() => Symmetry::None,
                _ => {
                    let normals = self.symmetry_plane.iter().map(|n| Vec3::from(*n));
                    Symmetry::Planes(normals.collect())
                }
            },
        }
    }
}
