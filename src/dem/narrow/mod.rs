//! Contacts of one pair of bodies, or of a wall and a body.
//!
//! A pair keeps a list of the spheres that were nearer than a skin when it was made. It holds until the two bodies
//! have really moved against each other by the skin: then their trees are searched again. Of this list a short
//! one is kept of those that are nearer than what the bodies can move in some tens of steps, each with its gap; until they have
//! moved by that gap two spheres cannot touch and are not looked at. What a step does is thus in
//! proportion to the spheres that are about to touch, not to those of a body.
//!
//! Forces depend on the state alone, never on when a list was made: contacts are summed in the order of their
//! spheres, in the frame of the first body.

mod lists;
mod surface;

pub(crate) use surface::{Meeting, Surface};

use crate::dem::built::built;
use crate::dem::contact::{Action, Law, Motion};
use crate::dem::effects::averaging::Average;
use crate::dem::effects::{Coefficients, Touch};
use crate::dem::kernel::{Context, End, Scratch};
use crate::dem::small::{between, mul, tr_mul};
use crate::dem::state::Kin;
use crate::dem::tree::Near;
use crate::math::Vec3;
use nalgebra::Matrix3;

/// Force and torques on the two bodies of a pair, along the axes of space.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Wrench {
    /// On the second; the first has the opposite.
    pub force: Vec3,
    pub torques: [Vec3; 2],
}

/// Two bodies that are near each other, or a wall `a` and a body `b`.
#[derive(Debug, Clone)]
pub(crate) struct Pair {
    pub a: u32,
    pub b: u32,
    /// Contacts of the last step.
    pub touching: u32,
    /// Until they have moved so far together nothing touches.
    pub wake: f64,
    /// Until they have moved so far together the short list holds, made when they had moved so far.
    expire: f64,
    made: f64,
    /// Whether there is a long list, its skin, and the place and turn of the second in the frame of the first when
    /// it was made.
    listed: bool,
    skin: f64,
    shift: Vec3,
    turn: Matrix3<f64>,
    /// Steps that the next long list should last: many where searches are dear.
    life: f64,
    near: Vec<Near>,
    short: Vec<Short>,
    memory: Vec<f64>,
    pub average: Average,
    /// Of this step, where it is not given to the bodies at once.
    pub wrench: Option<Wrench>,
}

/// One of the short list: its gap, its number in the long one, the two spheres, and whether it may remember something.
#[derive(Debug, Clone, Copy)]
struct Short {
    gap: f64,
    k: u32,
    a: u32,
    b: u32,
    live: bool,
}

/// One contact, for those who look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactRecord {
    /// The first body, or the number of the wall.
    pub a: u32,
    /// The second body.
    pub b: u32,
    /// The sphere of the first (in the order of its template), or the feature of the wall.
    pub sphere_a: u32,
    /// The sphere of the second.
    pub sphere_b: u32,
    /// Where, in space.
    pub point: Vec3,
    /// From the first to the second, in space.
    pub normal: Vec3,
    /// How deep.
    pub overlap: f64,
    /// What its springs hold; of averaged contacts its part of the work that was put into all of the pair.
    pub energy: f64,
}

/// What a contact remembers that has only been pressed.
const UNSTRETCHED: [f64; 16] = [0.0; 16];

impl Pair {
    /// A pair of which nothing is known.
    pub fn new(a: u32, b: u32) -> Pair {
        Pair {
            a,
            b,
            touching: 0,
            wake: -1.0,
            expire: -1.0,
            made: 0.0,
            listed: false,
            skin: 0.0,
            shift: Vec3::zeros(),
            turn: Matrix3::identity(),
            life: lists::FIRST_LIFE,
            near: Vec::new(),
            short: Vec::new(),
            memory: Vec::new(),
            average: Average::default(),
            wrench: None,
        }
    }

    /// Forgets its list, not its contacts.
    pub fn forget(&mut self) {
        (self.wake, self.expire, self.listed) = (-1.0, -1.0, false);
    }

    /// Whether there is anything that a later step needs.
    pub fn remembers(&self) -> bool {
        self.average.active() || self.memory.iter().any(|m| *m != 0.0)
    }

    pub fn bytes(&self) -> u64 {
        let lists =
            self.near.capacity() * size_of::<Near>() + self.short.capacity() * size_of::<Short>();
        (size_of::<Pair>() + lists) as u64
    }

    pub fn memory_bytes(&self) -> u64 {
        (self.memory.capacity() * 8) as u64
    }

    /// The contacts that remember something: spheres and what they remember.
    pub fn memories(&self, width: usize) -> impl Iterator<Item = (u32, u32, &[f64])> {
        let live = self.near.iter().zip(self.memory.chunks(width.max(1)));
        live.filter(|(_, m)| m.iter().any(|v| *v != 0.0)).map(|(n, m)| (n.a, n.b, m))
    }

    /// Takes over what contacts remember: (spheres, numbers), in order.
    pub fn recall(&mut self, width: usize, memories: &[(u32, u32, Vec<f64>)]) {
        self.near.clear();
        self.memory.clear();
        for (a, b, memory) in memories.iter().filter(|m| m.2.len() == width) {
            // A list that has expired, of contacts of which only the memory counts.
            self.near.push(Near { a: *a, b: *b, gap: 0.0 });
            self.memory.extend(memory.iter().take(width));
        }
        self.forget();
    }

    /// What the first and the second do to each other in this step.
    #[inline(always)]
    pub fn act<L: Law, S: Surface>(
        &mut self,
        first: &S,
        (a, b): (&End, &End),
        context: &Context,
        coefficients: &Coefficients,
        scratch: &mut Scratch,
    ) -> Option<Wrench> {
        let moved = a.moved + b.moved;
        let (ka, kb) = (a.kin, b.kin);
        let turn = between(&ka.r, &kb.r);
        let shift = tr_mul(&ka.r, &(kb.x - ka.x));
        let body = context.template(self.b);
        if moved > self.expire || S::turns(first) {
            self.renew(
                first,
                body,
                (&shift, &turn),
                moved,
                a.stride + b.stride,
                L::WIDTH,
                context,
                scratch,
            );
            if self.wake >= moved {
                self.idle();
                return None;
            }
        }
        let to = |v: Vec3| tr_mul(&ka.r, &v);
        let inverse_mass = a.inverse_mass + b.inverse_mass;
        let motion = Motion {
            turn,
            v: to(kb.v - ka.v),
            wa: to(ka.w),
            wb: to(kb.w),
            vh: to(kb.vh - ka.vh),
            wah: to(ka.wh),
            wbh: to(kb.wh),
            inertia: [a.inertia, b.inertia],
            inverse_mass,
            // A body that is fixed against a wall has none to damp.
            mass: if inverse_mass > 0.0 { 1.0 / inverse_mass } else { 0.0 },
            ease: if const { built("averaging") } && context.averaging {
                self.average.ease()
            } else {
                1.0
            },
        };
        let used = moved - self.made + context.range;
        let stride = if context.averaging { 0.0 } else { a.stride + b.stride };
        let spheres = body.spheres();
        if L::WIDTH > 0 && first.parts() {
            self.hand_on(first, body, (&shift, &turn), L::WIDTH);
        }
        let (mut force, mut torques) = (Vec3::zeros(), [Vec3::zeros(); 2]);
        let (mut count, mut elastic, mut closest) = (0u32, 0.0, self.expire - moved);
        let mut alone = 0.0;
        for short in &mut self.short {
            if short.gap > used {
                closest = closest.min(short.gap - used);
                continue;
            }
            let s = &spheres[short.b as usize];
            let center = mul(&turn, &s.center) + shift;
            let at = short.k as usize * L::WIDTH;
            let memory = &mut self.memory;
            let Some(m) = first.meet(short.a, &center, s.radius) else {
                if L::WIDTH > 0 && short.live {
                    memory[at..at + L::WIDTH].fill(0.0);
                    short.live = false;
                }
                closest = closest.min(0.0);
                continue;
            };
            let mut action = None;
            if m.gap < 0.0 || (L::FAR && m.gap < context.range) {
                let arms = [m.point, m.point - shift];
                let touch = Touch {
                    normal: m.normal,
                    overlap: -m.gap,
                    radius: m.radius,
                    arms,
                    velocity: motion.v + motion.wb.cross(&arms[1]) - motion.wa.cross(&arms[0]),
                    coefficients,
                    motion: &motion,
                    dt: context.dt,
                    step: context.step,
                    stride,
                };
                short.live = true;
                let own = &mut memory[at..at + L::WIDTH];
                action = L::act(&touch, context.felt, own, &mut scratch.calls);
            }
            let Some(Action { force: f, couple, elastic: e }) = action else {
                closest = closest.min(m.gap - context.range);
                if L::WIDTH > 0 && short.live {
                    memory[at..at + L::WIDTH].fill(0.0);
                    short.live = false;
                }
                continue;
            };
            count += 1;
            elastic += e;
            if const { built("averaging") } && context.averaging {
                alone += L::energy(coefficients, -m.gap, m.radius, &UNSTRETCHED[..L::WIDTH]);
            }
            force += f;
            torques[0] -= m.point.cross(&f) + couple;
            torques[1] += (m.point - shift).cross(&f) + couple;
        }
        if count == 0 {
            self.wake = moved + closest.max(0.0);
            self.idle();
            return None;
        }
        self.touching = count;
        scratch.contacts += u64::from(count);
        if const { built("averaging") } && context.averaging {
            scratch.calls.averaging += 1;
            let share = self.average.share(count, elastic, alone);
            force *= share;
            torques = [torques[0] * share, torques[1] * share];
        }
        Some(Wrench {
            force: mul(&ka.r, &force),
            torques: [mul(&ka.r, &torques[0]), mul(&ka.r, &torques[1])],
        })
    }

    #[inline]
    fn idle(&mut self) {
        if self.touching > 0 {
            self.touching = 0;
            self.average = Average::default();
        }
    }

    /// Its contacts as they are, with what their springs hold.
    pub fn records<L: Law, S: Surface>(
        &self,
        first: &S,
        (a, b): (&Kin, &Kin),
        context: &Context,
        c: &Coefficients,
        found: &mut Vec<ContactRecord>,
    ) {
        if self.touching == 0 {
            return;
        }
        let turn = between(&a.r, &b.r);
        let shift = tr_mul(&a.r, &(b.x - a.x));
        for (k, near) in self.near.iter().enumerate() {
            let s = &context.template(self.b).spheres()[near.b as usize];
            let center = mul(&turn, &s.center) + shift;
            let memory = &self.memory[k * L::WIDTH..(k + 1) * L::WIDTH];
            let Some(m) = first.meet(near.a, &center, s.radius) else { continue };
            let lasting =
                L::FAR && m.gap < context.range && memory.last().is_some_and(|m| *m != 0.0);
            if m.gap < 0.0 || lasting {
                let normal = L::energy(c, -m.gap, m.radius, &UNSTRETCHED[..L::WIDTH]);
                let whole = L::energy(c, -m.gap, m.radius, memory);
                let energy = if context.averaging {
                    (whole - normal) * self.average.part() + normal * self.average.scale()
                } else {
                    whole
                };
                found.push(ContactRecord {
                    a: self.a,
                    b: self.b,
                    sphere_a: near.a,
                    sphere_b: near.b,
                    point: a.x + a.r * m.point,
                    normal: a.r * m.normal,
                    overlap: -m.gap,
                    energy,
                });
            }
        }
    }
}
