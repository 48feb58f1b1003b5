//! Gravity: the same acceleration for every body that moves.

use crate::dem::state::State;
use crate::math::Vec3;

/// Adds m g to the force on each body.
pub(crate) fn pull(state: &mut State, g: &Vec3) {
    for i in 0..state.len() {
        if !state.fixed[i] {
            state.force[i] += g * state.templates[state.template[i] as usize].mass();
        }
    }
}
