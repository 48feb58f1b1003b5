//! Velocity-Verlet for rigid bodies.

use super::rotate::{exact, split};
use super::small::{mul, tr_mul};
use super::state::{Kin, State};

/// Half a kick, then the whole drift: positions and orientations at the end of the step, velocities in its middle, and as
/// far as the old forces tell also at its end (damping evaluated there is of second order).
pub(crate) fn drift(state: &mut State, dt: f64, exactly: bool) {
    let half = 0.5 * dt;
    for i in 0..state.position.len() {
        let t = &state.templates[state.template[i] as usize];
        if state.fixed[i] {
            let v = state.velocity[i];
            state.position[i] += v * dt;
            let stride = v.norm() * dt;
            state.stride[i] = stride;
            state.moved[i] += stride;
            state.kin[i].x = state.position[i];
            continue;
        }
        let (force, torque) = (state.force[i], state.torque[i]);
        let kick = force * (half * t.inverse_mass());
        let vh = state.velocity[i] + kick;
        let lh = state.momentum[i] + torque * half;
        state.velocity[i] = vh;
        state.momentum[i] = lh;
        state.position[i] += vh * dt;
        let body = tr_mul(&state.kin[i].r, &lh);
        let turn =
            if exactly { exact(&body, t.inverse(), dt) } else { split(&body, t.inverse(), dt) };
        state.orientation[i].turn(&turn);
        let [_, x, y, z] = turn;
        // Chord of the arc that the farthest centre goes along.
        let arc = 2.0 * t.reach() * (x * x + y * y + z * z).sqrt();
        let stride = (vh.norm() * dt + arc) * (1.0 + 1e-12);
        state.stride[i] = stride;
        state.moved[i] += stride;
        let r = state.orientation[i].matrix();
        let spin = |l| mul(&r, &t.inverse().component_mul(&tr_mul(&r, &l)));
        let (w, wh) = (spin(lh + torque * half), spin(lh));
        state.kin[i] = Kin { x: state.position[i], r, v: vh + kick, w, vh, wh };
    }
}

/// The other half of the kick.
pub(crate) fn kick(state: &mut State, dt: f64) {
    let half = 0.5 * dt;
    for i in 0..state.position.len() {
        if !state.fixed[i] {
            let inverse = state.templates[state.template[i] as usize].inverse_mass();
            state.velocity[i] += state.force[i] * (half * inverse);
            state.momentum[i] += state.torque[i] * half;
        }
    }
}
