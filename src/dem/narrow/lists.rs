//! The long list and the short one of a pair, made anew where they no longer hold, and what contacts remember carried
//! over.

use super::surface::Surface;
use super::{Pair, Short};
use crate::dem::kernel::{Context, Scratch};
use crate::dem::small::mul;
use crate::dem::template::Template;
use crate::dem::tree::Near;
use crate::math::Vec3;
use nalgebra::Matrix3;

/// In so many steps the long list should be used up: the least, and the most.
const LIFE: [f64; 2] = [128.0, 8192.0];
/// What a sphere of the long list costs in a step, of what a search does to look at two balls: they are looked at
/// once in [`SHORT`] steps.
const KEPT: f64 = 0.03;
/// In so many steps the short list should be used up.
const SHORT: f64 = 48.0;
/// The least and the greatest skin, as parts of the bound.
const SKIN: [f64; 2] = [1e-4, 0.1];

/// What a new pair begins with.
pub(super) const FIRST_LIFE: f64 = 4.0 * LIFE[0];

/// Forgets a contact.
#[inline(always)]
fn clear(memory: &mut [f64]) {
    if memory.iter().any(|m| *m != 0.0) {
        memory.fill(0.0);
    }
}

impl Pair {
    /// Makes the short list anew from the long one, and that too where the bodies have really moved far.
    #[allow(clippy::too_many_arguments)]
    #[inline(never)]
    pub(super) fn renew<S: Surface>(
        &mut self,
        first: &S,
        body: &Template,
        (shift, turn): (&Vec3, &Matrix3<f64>),
        moved: f64,
        stride: f64,
        width: usize,
        context: &Context,
        scratch: &mut Scratch,
    ) {
        let bound = body.bound();
        // No point of the second moves farther than its centre does and the turn takes the farthest.
        let turned = (turn - self.turn).norm() * std::f64::consts::FRAC_1_SQRT_2;
        let mut really = ((shift - self.shift).norm() + turned * body.reach()) * (1.0 + 1e-12);
        let mut more = (SHORT * stride).max(0.25 * SKIN[0] * bound);
        if !(self.listed && really + more <= self.skin) {
            let far = first.far(shift, bound) - context.range;
            let skin = (self.life * stride).clamp(SKIN[0] * bound, SKIN[1] * bound);
            self.short.clear();
            if far > skin {
                // Too far for any of their spheres: nothing until they have come that near.
                (self.wake, self.expire, self.listed) = (moved + far, moved + far, false);
                self.near.clear();
                self.memory.clear();
                return;
            }
            self.list(first, body, (shift, turn), skin, width, context.range, scratch);
            really = 0.0;
        }
        // What is not in the long list is farther than this.
        more = more.min(self.skin - really);
        self.short.clear();
        let mut least = f64::MAX;
        for (k, near) in self.near.iter().enumerate() {
            let mut gap = near.gap - really;
            if gap <= more + context.range {
                let s = &body.spheres()[near.b as usize];
                gap = first.gap(near.a, &(mul(turn, &s.center) + shift), s.radius);
                if gap <= more + context.range {
                    let (k, a, b) = (k as u32, near.a, near.b);
                    self.short.push(Short { gap, k, a, b, live: width > 0 });
                }
            }
            least = least.min(gap);
            if width > 0 && gap > context.range {
                clear(&mut self.memory[k * width..(k + 1) * width]);
            }
        }
        self.made = moved;
        self.expire = moved + more;
        if self.short.is_empty() {
            // Nothing is that near: until the nearest may be.
            self.expire = moved + (least - context.range).min(self.skin - really).max(more);
        }
        self.wake = self.expire.min(moved + (least - context.range));
    }

    /// Makes the long list anew.
    #[allow(clippy::too_many_arguments)]
    fn list<S: Surface>(
        &mut self,
        first: &S,
        body: &Template,
        (shift, turn): (&Vec3, &Matrix3<f64>),
        skin: f64,
        width: usize,
        range: f64,
        scratch: &mut Scratch,
    ) {
        (self.listed, self.skin, self.shift, self.turn) = (true, skin, *shift, *turn);
        scratch.near.clear();
        scratch.searches += 1;
        let near = &mut scratch.near;
        let looked = first.search(body, (shift, turn), skin + range, &mut scratch.stack, near);
        // Where a search costs as much as its list does while it lasts.
        let wanted = looked as f64 / (1.0 + KEPT * near.len() as f64);
        self.life = (0.5 * (self.life + wanted)).clamp(LIFE[0], LIFE[1]);
        near.sort_unstable_by_key(|n| (n.b, n.a));
        if width > 0 {
            self.carry(width, range, scratch);
        }
        std::mem::swap(&mut self.near, &mut scratch.near);
    }

    /// Takes what contacts remember over to the new list; both are in order.
    fn carry(&mut self, width: usize, range: f64, scratch: &mut Scratch) {
        scratch.memory.clear();
        scratch.memory.resize(scratch.near.len() * width, 0.0);
        let mut old = self.near.iter().zip(self.memory.chunks(width)).peekable();
        for (new, to) in scratch.near.iter().zip(scratch.memory.chunks_mut(width)) {
            while old.next_if(|(o, _)| (o.b, o.a) < (new.b, new.a)).is_some() {}
            // What is surely open has ended.
            if new.gap > range {
                continue;
            }
            if let Some((_, memory)) = old.next_if(|(o, _)| (o.b, o.a) == (new.b, new.a)) {
                to.copy_from_slice(memory);
            }
        }
        std::mem::swap(&mut self.memory, &mut scratch.memory);
    }

    /// Where a sphere has gone from one feature of a wall to the next, so does what its contact remembers.
    #[inline(never)]
    pub(super) fn hand_on<S: Surface>(
        &mut self,
        first: &S,
        body: &Template,
        (shift, turn): (&Vec3, &Matrix3<f64>),
        width: usize,
    ) {
        let touches = |near: &Near| {
            let s = &body.spheres()[near.b as usize];
            first
                .meet(near.a, &(mul(turn, &s.center) + shift), s.radius)
                .is_some_and(|m| m.gap < 0.0)
        };
        let free = |memory: &[f64]| memory.iter().all(|m| *m == 0.0);
        for k in 0..self.near.len() {
            let near = self.near[k];
            if free(&self.memory[k * width..(k + 1) * width]) || touches(&near) {
                continue;
            }
            let from = self.near[..k].iter().rposition(|n| n.b != near.b).map_or(0, |p| p + 1);
            let group = (from..self.near.len()).take_while(|&j| self.near[j].b == near.b);
            let next = group.into_iter().find(|&j| {
                j != k && free(&self.memory[j * width..(j + 1) * width]) && touches(&self.near[j])
            });
            if let Some(j) = next {
                self.memory.copy_within(k * width..(k + 1) * width, j * width);
                self.memory[k * width..(k + 1) * width].fill(0.0);
            }
        }
    }
}
