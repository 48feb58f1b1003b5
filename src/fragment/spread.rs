//! Points spread evenly over a fragment: a lattice turned so that it lies along nothing, as dense as
//! the volume asks for, line by line and each line cut by the half-spaces first.

use super::room::{Room, along, dot, times};
use crate::error::{Result, push, reserve};
use crate::math::Vec3;

/// Lines tried at most for each point wanted, and in all.
const LINES: (usize, usize) = (12, 20_000);
/// The lattice's axes, by rows.
const AXES: [[f32; 3]; 3] = [
    [0.4667334, -0.7533767, -0.4632316],
    [0.4424212, 0.6524262, -0.6153077],
    [0.7657829, 0.0822411, 0.6378189],
];

/// Random numbers (Steele, Lea and Flood 2014), the same on every machine.
#[derive(Debug, Clone)]
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Random {
        Random(seed ^ 0x6a09_e667_f3bc_c909)
    }

    /// From 0 to 1, without 1.
    #[inline]
    pub(super) fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 40) as f32 / (1u64 << 24) as f32
    }

    /// A direction.
    #[inline]
    pub(super) fn direction(&mut self) -> [f32; 3] {
        loop {
            let (x, y, z) = (self.unit(), self.unit(), self.unit());
            let d = [2.0 * x - 1.0, 2.0 * y - 1.0, 2.0 * z - 1.0];
            let square = dot(&d, &d);
            if square <= 1.0 && square > 1e-4 {
                return times(&d, 1.0 / square.sqrt());
            }
        }
    }
}

/// Points of the room that also satisfy `holds`, about its middle; about `wanted` where the room
/// has the volume that it states. `half`: half the edges of the box about the middle.
///
/// The lattice is cubic, with a point in the middle of each cube.
pub(super) fn spread(
    room: &Room,
    half: &[f32; 3],
    wanted: usize,
    random: &mut Random,
    holds: impl Fn(&Vec3) -> bool,
) -> Result<Vec<[f32; 3]>> {
    let mut out = reserve("points", wanted + wanted / 4)?;
    let reach = AXES.map(|a| (0..3).map(|k| a[k].abs() * half[k]).sum::<f32>());
    let mut step = room.size * (2.0 / wanted.max(1) as f32).cbrt();
    let lines = (LINES.0 * wanted).min(LINES.1) as f32;
    // So that there are not too many lines.
    step = step.max((8.0 * reach[1] * reach[2] / lines).sqrt());
    if !(step > 0.0 && step.is_finite()) {
        return Ok(out);
    }
    let phase = [random.unit(), random.unit(), random.unit()];
    let count = [1, 2].map(|a| (2.0 * reach[a] / step) as usize + 1);
    for layer in 0..2u8 {
        let shift = 0.5 * f32::from(layer);
        for j in 0..count[1] {
            let b = (j as f32 + (phase[2] + shift).fract()) * step - reach[2];
            for i in 0..count[0] {
                let a = (i as f32 + (phase[1] + shift).fract()) * step - reach[1];
                let base = along(&times(&AXES[1], a), b, &AXES[2]);
                let Some([from, to]) = piece(&base, &AXES[0], room.walls(), half, reach[0]) else {
                    continue;
                };
                let first = (from / step - phase[0] - shift).ceil() + phase[0] + shift;
                let mut t = first * step;
                while t < to && out.len() < 2 * wanted {
                    let p = along(&base, t, &AXES[0]);
                    t += step;
                    if room.open(&p) && holds(&room.global(&p)) {
                        push("points", &mut out, p)?;
                    }
                }
            }
        }
    }
    Ok(out)
}

/// The part of a line that is within the box and the half-spaces.
fn piece(
    base: &[f32; 3],
    way: &[f32; 3],
    walls: &[[f32; 4]],
    half: &[f32; 3],
    reach: f32,
) -> Option<[f32; 2]> {
    let (mut from, mut to) = (-reach, reach);
    let mut clip = |n: [f32; 3], offset: f32| {
        let along = dot(&n, way);
        let room = offset - dot(&n, base);
        if along.abs() < 1e-9 {
            if room < 0.0 {
                to = from;
            }
        } else if along > 0.0 {
            to = to.min(room / along);
        } else {
            from = from.max(room / along);
        }
    };
    for a in 0..3 {
        let mut n = [0.0; 3];
        n[a] = 1.0;
        clip(n, half[a]);
        n[a] = -1.0;
        clip(n, half[a]);
    }
    walls.iter().for_each(|w| clip([w[0], w[1], w[2]], w[3]));
    (from < to).then_some([from, to])
}
