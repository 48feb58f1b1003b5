//! Which directions of a ball are exposed among very many others.
//!
//! Most balls of a deep clump are hidden by a few, and most directions of the others, too: those
//! few are asked first, and what no one of them hides is looked at with all, eight at a time. What
//! is found is to the last bit what [`super::exposed`] finds with all of them at once.

use crate::generate::ball::Ball;
use wide::f32x8;

/// How many are remembered.
const KEPT: usize = 8;

/// The balls that hid most of a ball's directions when they were last looked at.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Hiders {
    balls: [u32; KEPT],
    count: usize,
}

/// Directions of which some are still exposed, and a bit for each that is hidden.
type Open = ([f32x8; 3], u32);

/// Buffers of [`among`].
#[derive(Debug, Default, Clone)]
pub(crate) struct Buffers {
    open: Vec<Open>,
    /// How many directions a ball hid, and its number.
    hid: Vec<(u32, u32)>,
}

/// Caps of eight balls: axes, and the cosine, which is 2 where a ball hides nothing.
struct Caps {
    axis: [[f32; 8]; 3],
    cos: [f32; 8],
    /// Whether one hides all.
    all: bool,
}

impl Caps {
    /// As one by one in [`super::exposed`]; `some`: at most eight.
    #[inline(always)]
    fn of(ball: &Ball, balls: &[Ball], some: &[u32]) -> Caps {
        let mut lanes = [[0.0f32; 8]; 4];
        for (l, &j) in some.iter().enumerate() {
            let other = &balls[j as usize];
            let [x, y, z] = other.center;
            (lanes[0][l], lanes[1][l], lanes[2][l], lanes[3][l]) = (x, y, z, other.radius);
        }
        let [x, y, z, r] = lanes.map(f32x8::new);
        let (x, y, z) = (x - ball.center[0], y - ball.center[1], z - ball.center[2]);
        let apart = x * x + y * y + z * z;
        let r2 = f32x8::splat(ball.radius * ball.radius);
        let along = (r2 + apart - r * r) / f32x8::splat(2.0 * ball.radius);
        let distance = apart.sqrt();
        let inverse = f32x8::splat(1.0) / distance.fast_max(f32x8::splat(f32::MIN_POSITIVE));
        let there = 0xff >> (8 - some.len());
        let nothing = along.simd_ge(distance).to_bitmask() | !there;
        let all = along.simd_lt(-distance).to_bitmask() & !nothing != 0;
        let mut cos = (along * inverse).to_array();
        for (l, cos) in cos.iter_mut().enumerate() {
            if nothing >> l & 1 == 1 {
                *cos = 2.0;
            }
        }
        let axis = [x * inverse, y * inverse, z * inverse].map(|a| a.to_array());
        Caps { axis, cos, all }
    }
}

/// The exposed directions of `ball` among those with the numbers in `others`, into `out`, and how
/// many there are. `hiders`: some of `balls` other than this one; they are put in order.
pub(crate) fn among(
    ball: &Ball,
    balls: &[Ball],
    others: [&[u32]; 2],
    directions: &[[f32x8; 3]],
    hiders: &mut Hiders,
    buffers: &mut Buffers,
    out: &mut [Vec<f32>; 3],
) -> usize {
    let Buffers { open, hid } = buffers;
    open.clear();
    open.extend(directions.iter().map(|d| (*d, 0)));
    hid.clear();
    let before = &hiders.balls[..hiders.count.min(KEPT)];
    let mut done = hide(ball, balls, before, open, hid);
    for list in others {
        for some in list.chunks(8) {
            if done {
                break;
            }
            done = hide(ball, balls, some, open, hid);
        }
    }
    // Those that hid most first; of equal ones the first.
    hid.sort_by_key(|x| std::cmp::Reverse(x.0));
    hiders.count = hid.len().min(KEPT);
    for (to, from) in hiders.balls.iter_mut().zip(hid.iter()) {
        *to = from.1;
    }
    if done { 0 } else { pack(open, out) }
}

/// Hides directions behind some balls; whether none is left.
#[inline(always)]
fn hide(
    ball: &Ball,
    balls: &[Ball],
    some: &[u32],
    open: &mut Vec<Open>,
    hid: &mut Vec<(u32, u32)>,
) -> bool {
    if some.is_empty() {
        return open.is_empty();
    }
    let caps = Caps::of(ball, balls, some);
    if caps.all {
        open.clear();
        return true;
    }
    for (l, &j) in some.iter().enumerate() {
        let cos = caps.cos[l];
        if cos > 1.5 {
            continue;
        }
        let [x, y, z] = [caps.axis[0][l], caps.axis[1][l], caps.axis[2][l]];
        let cos = f32x8::splat(cos);
        let (mut more, mut whole) = (0, false);
        for (d, hidden) in open.iter_mut() {
            let dot = d[0] * x + d[1] * y + d[2] * z;
            let bits = dot.simd_gt(cos).to_bitmask();
            more += (bits & !*hidden).count_ones();
            *hidden |= bits;
            whole |= *hidden == 0xff;
        }
        if more > 0 {
            hid.push((more, j));
        }
        if whole {
            open.retain(|o| o.1 != 0xff);
            if open.is_empty() {
                return true;
            }
        }
    }
    false
}

/// The directions that are left, one after the other.
fn pack(open: &[Open], out: &mut [Vec<f32>; 3]) -> usize {
    for v in out.iter_mut() {
        v.clear();
        v.resize(8 * open.len() + 8, 0.0);
    }
    let mut n = 0;
    for (d, hidden) in open {
        let d = d.map(|v| v.to_array());
        for l in (0..8).filter(|l| !hidden >> l & 1 == 1) {
            for (v, d) in out.iter_mut().zip(&d) {
                v[n] = d[l];
            }
            n += 1;
        }
    }
    n
}
