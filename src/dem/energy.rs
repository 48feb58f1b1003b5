//! Energies and momenta of the bodies, and the guard against more of it than was put in.

use super::state::State;
use crate::math::Vec3;

/// Kinetic energy of the bodies that move: of the centres, and of rotation.
pub fn kinetic(state: &State) -> [f64; 2] {
    let (mut straight, mut turning) = (0.0, 0.0);
    for i in (0..state.len()).filter(|&i| !state.fixed[i]) {
        straight += 0.5 * state.mass(i) * state.velocity[i].norm_squared();
        let spin = state.angular_velocity(i);
        turning += 0.5 * spin.dot(&state.momentum[i]);
    }
    [straight, turning]
}

/// Potential energy in a field g of the bodies that move, 0 at the origin.
pub fn potential(state: &State, g: &Vec3) -> f64 {
    let moving = (0..state.len()).filter(|&i| !state.fixed[i]);
    moving.map(|i| -state.mass(i) * g.dot(&state.position[i])).sum()
}

/// Momentum of the bodies that move.
pub fn momentum(state: &State) -> Vec3 {
    let moving = (0..state.len()).filter(|&i| !state.fixed[i]);
    moving.map(|i| state.velocity[i] * state.mass(i)).sum()
}

/// Their angular momentum about the origin.
pub fn angular_momentum(state: &State) -> Vec3 {
    let moving = (0..state.len()).filter(|&i| !state.fixed[i]);
    let about = |i: usize| state.position[i].cross(&(state.velocity[i] * state.mass(i)));
    moving.map(|i| state.momentum[i] + about(i)).sum()
}
