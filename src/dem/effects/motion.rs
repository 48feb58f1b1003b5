//! Walls that move as told, whatever pushes them.

use crate::dem::state::Kin;
use crate::error::{Error, Result};
use crate::math::Vec3;
use nalgebra::{Rotation3, Unit};
use std::f64::consts::TAU;

/// How a wall moves.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum WallMotion {
    /// Not at all.
    #[default]
    Still,
    /// With this velocity.
    Slide(Vec3),
    /// Its surface moves with this velocity, the wall stays: a conveyor.
    Convey(Vec3),
    /// To and fro: amplitude sin(2π frequency t).
    Shake {
        /// Greatest shift.
        amplitude: Vec3,
        /// Oscillations in a unit of time.
        frequency: f64,
    },
    /// Turns about an axis. With `spin` it turns in itself, as a drum about its own axis: its surface moves, its place does not
    /// change.
    Turn {
        /// A point of the axis.
        center: Vec3,
        /// Along the axis, any length but 0; counter-clockwise about it.
        axis: Vec3,
        /// Angle in a unit of time.
        rate: f64,
        /// Whether the wall is a body of revolution about this axis.
        spin: bool,
    },
}

impl WallMotion {
    pub(crate) fn check(&self, i: usize) -> Result<()> {
        let zero = Vec3::zeros();
        let (vectors, number) = match self {
            WallMotion::Still => return Ok(()),
            WallMotion::Slide(v) | WallMotion::Convey(v) => ([v, &zero], 0.0),
            WallMotion::Shake { amplitude, frequency } => ([amplitude, &zero], *frequency),
            WallMotion::Turn { center, axis, rate, .. } => {
                if axis.amax() == 0.0 {
                    return Err(Error::InvalidArgument(format!(
                        "wall {i} turns about the axis (0, 0, 0)"
                    )));
                }
                ([center, axis], *rate)
            }
        };
        if vectors.iter().all(|v| v.iter().all(|c| c.is_finite())) && number.is_finite() {
            return Ok(());
        }
        Err(Error::NotFinite(format!("wall {i} moves by {self:?}")))
    }

    /// The origin of the wall's frame at the start.
    pub(crate) fn origin(&self) -> Vec3 {
        match self {
            WallMotion::Turn { center, .. } => *center,
            _ => Vec3::zeros(),
        }
    }

    /// Whether parts of the wall turn to other places.
    pub(crate) fn turns(&self) -> bool {
        matches!(self, WallMotion::Turn { spin: false, .. })
    }

    /// Place and velocities at `time`, `dt` after the last.
    pub(crate) fn place(&self, time: f64, dt: f64, k: &mut Kin) {
        match self {
            WallMotion::Still => {}
            WallMotion::Slide(v) => (k.x, k.v, k.vh) = (v * time, *v, *v),
            WallMotion::Convey(v) => (k.v, k.vh) = (*v, *v),
            WallMotion::Shake { amplitude, frequency } => {
                let rate = TAU * frequency;
                k.x = amplitude * (rate * time).sin();
                k.v = amplitude * (rate * (rate * time).cos());
                k.vh = amplitude * (rate * (rate * (time - 0.5 * dt)).cos());
            }
            WallMotion::Turn { axis, rate, spin, .. } => {
                let axis = Unit::new_normalize(axis / axis.amax());
                if !spin {
                    k.r = Rotation3::from_axis_angle(&axis, rate * time).into_inner();
                }
                k.w = axis.into_inner() * *rate;
                k.wh = k.w;
            }
        }
    }
}
