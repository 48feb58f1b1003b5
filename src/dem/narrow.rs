//! Contacts of one pair of bodies, or of a wall and a body.
//!
//! A pair keeps the spheres that were nearer than a skin when its list was made, each with its gap, and how far the
//! bodies may have moved since. Until they have moved by the gap two spheres cannot touch and are not looked at; until they have
//! moved by the skin the list holds. Only then how far they have really moved against each other
//! is reckoned, and only if that is much are the two trees searched again. What a step does is thus in proportion to the spheres that
//! are about to touch, not to those of a body.
//!
//! Forces depend on the state alone, never on when a list was made: contacts are summed in the order of their
//! spheres, in the frame of the first body.

use super::contact::{Action, Calls, Law, Motion};
use super::effects::averaging::Average;
use super::effects::{Coefficients, Touch};
use super::state::Kin;
use super::template::Template;
use super::tree::Near;
use super::walls::Wall;
use crate::math::Vec3;
use nalgebra::Matrix3;

/// In so many steps a list should be used up.
const LIFE: f64 = 64.0;
/// The least and the greatest skin, as parts of the smaller bound.
const SKIN: [f64; 2] = [1e-4, 0.1];

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
    /// Until they have moved so far together the list holds.
    expire: f64,
    /// Gaps are those of this.
    built: f64,
    /// Place and turn of the second in the frame of the first when the list was made.
    shift: Vec3,
    turn: Matrix3<f64>,
    near: Vec<Near>,
    memory: Vec<f64>,
    pub average: Average,
    /// Of this step, where it is not given to the bodies at once.
    pub wrench: Option<Wrench>,
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
    /// What its springs hold.
    pub energy: f64,
}

/// What a pair needs to know of everything else.
pub(crate) struct Context<'a> {
    pub kin: &'a [Kin],
    pub moved: &'a [f64],
    pub stride: &'a [f64],
    pub templates: &'a [std::sync::Arc<Template>],
    pub template: &'a [u32],
    pub material: &'a [u32],
    pub fixed: &'a [bool],
    pub walls: &'a [Wall],
    pub materials: usize,
    pub coefficients: &'a [Coefficients],
    /// How far beyond touching a contact may act, and a little more for rounding: whether two spheres touch is
    /// never decided by a list.
    pub range: f64,
    pub dt: f64,
    /// Whether damping goes by the mass that the contact feels.
    pub felt: bool,
    pub averaging: bool,
}

/// Room that searches use again and again.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    near: Vec<Near>,
    memory: Vec<f64>,
    stack: Vec<[u32; 2]>,
    pub calls: Calls,
    pub contacts: u64,
    pub searches: u64,
}

/// One end of a pair.
pub(crate) struct End<'a> {
    kin: &'a Kin,
    moved: f64,
    stride: f64,
    inverse_mass: f64,
    inertia: Vec3,
}

impl Context<'_> {
    fn template(&self, i: u32) -> &Template {
        &self.templates[self.template[i as usize] as usize]
    }

    fn body(&self, i: u32) -> End<'_> {
        let (at, t) = (i as usize, self.template(i));
        let (inverse_mass, inertia) =
            if self.fixed[at] { (0.0, Vec3::zeros()) } else { (1.0 / t.mass(), *t.inverse()) };
        End {
            kin: &self.kin[at],
            moved: self.moved[at],
            stride: self.stride[at],
            inverse_mass,
            inertia,
        }
    }

    fn wall(&self, i: u32) -> End<'_> {
        let w = &self.walls[i as usize];
        let (inverse_mass, inertia) = (0.0, Vec3::zeros());
        End { kin: &w.kin, moved: w.moved, stride: w.stride, inverse_mass, inertia }
    }
}

/// Where two surfaces are nearest: normal from the first to the second, gap, effective radius, place.
pub(crate) struct Meeting {
    pub normal: Vec3,
    pub gap: f64,
    pub radius: f64,
    pub point: Vec3,
}

/// What the first of a pair is, in its own frame.
pub(crate) trait Surface {
    /// Whether it turns so that no length bounds how far its parts move.
    fn turns(&self) -> bool {
        false
    }
    /// A lower bound of the gap to a ball.
    fn far(&self, center: &Vec3, radius: f64) -> f64;
    /// Finds what of it is nearer than `reach` to which spheres of `body`.
    fn search(
        &self,
        body: &Template,
        place: (&Vec3, &Matrix3<f64>),
        reach: f64,
        stack: &mut Vec<[u32; 2]>,
        found: &mut Vec<Near>,
    );
    /// How feature `a` of it meets a sphere; `None` where another feature does.
    fn meet(&self, a: u32, center: &Vec3, radius: f64) -> Option<Meeting>;
}

impl Surface for Template {
    #[inline]
    fn far(&self, center: &Vec3, radius: f64) -> f64 {
        center.norm() - radius - self.bound()
    }

    fn search(
        &self,
        body: &Template,
        (shift, turn): (&Vec3, &Matrix3<f64>),
        reach: f64,
        stack: &mut Vec<[u32; 2]>,
        found: &mut Vec<Near>,
    ) {
        let (own, other) = (self.spheres(), body.spheres());
        self.tree().pairs(body.tree(), (shift, turn), reach, stack, |i, j| {
            let (s, t) = (&own[i as usize], &other[j as usize]);
            let gap = (turn * t.center + shift - s.center).norm() - s.radius - t.radius;
            if gap < reach {
                found.push(Near { a: i, b: j, gap });
            }
        });
    }

    #[inline(always)]
    fn meet(&self, a: u32, center: &Vec3, radius: f64) -> Option<Meeting> {
        let s = &self.spheres()[a as usize];
        let d = center - s.center;
        let distance = d.norm();
        // Concentric spheres are driven along the line between the bodies' origins.
        let normal = if distance > 0.0 {
            d / distance
        } else {
            -s.center.try_normalize(0.0).unwrap_or(Vec3::z())
        };
        let both = s.radius + radius;
        let gap = distance - both;
        let point = s.center + normal * (s.radius + 0.5 * gap);
        Some(Meeting { normal, gap, radius: s.radius * radius / both, point })
    }
}

impl Pair {
    /// A pair of which nothing is known.
    pub fn new(a: u32, b: u32) -> Pair {
        Pair {
            a,
            b,
            touching: 0,
            wake: -1.0,
            expire: -1.0,
            built: 0.0,
            shift: Vec3::zeros(),
            turn: Matrix3::identity(),
            near: Vec::new(),
            memory: Vec::new(),
            average: Average::default(),
            wrench: None,
        }
    }

    /// Forgets its list, not its contacts.
    pub fn forget(&mut self) {
        (self.wake, self.expire) = (-1.0, -1.0);
    }

    /// Whether there is anything that a later step needs.
    pub fn remembers(&self) -> bool {
        self.average.active() || self.memory.iter().any(|m| *m != 0.0)
    }

    pub fn bytes(&self) -> u64 {
        (size_of::<Pair>() + self.near.capacity() * size_of::<Near>()) as u64
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
    pub fn recall(&mut self, width: usize, memories: &[((u32, u32), Vec<f64>)]) {
        self.near.clear();
        self.memory.clear();
        for ((a, b), memory) in memories {
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
        let turn = ka.r.transpose() * kb.r;
        let shift = ka.r.tr_mul(&(kb.x - ka.x));
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
        let to = |v: Vec3| ka.r.tr_mul(&v);
        let inverse_mass = a.inverse_mass + b.inverse_mass;
        let motion = Motion {
            shift,
            turn,
            v: to(kb.v - ka.v),
            wa: to(ka.w),
            wb: to(kb.w),
            vh: to(kb.vh - ka.vh),
            wah: to(ka.wh),
            wbh: to(kb.wh),
            inertia: [a.inertia, b.inertia],
            inverse_mass,
            mass: 1.0 / inverse_mass,
        };
        let used = moved - self.built + context.range;
        let spheres = body.spheres();
        let (mut force, mut torques) = (Vec3::zeros(), [Vec3::zeros(); 2]);
        let (mut count, mut elastic, mut closest) = (0u32, 0.0, f64::MAX);
        for (k, near) in self.near.iter().enumerate() {
            if near.gap > used {
                closest = closest.min(near.gap - used);
                continue;
            }
            let s = &spheres[near.b as usize];
            let center = turn * s.center + shift;
            let memory = &mut self.memory[k * L::WIDTH..(k + 1) * L::WIDTH];
            let Some(m) = first.meet(near.a, &center, s.radius) else {
                if L::WIDTH > 0 {
                    memory.fill(0.0);
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
                };
                action = L::act(&touch, context.felt, memory, &mut scratch.calls);
            }
            let Some(Action { force: f, couple, elastic: e }) = action else {
                closest = closest.min(m.gap - context.range);
                if L::WIDTH > 0 {
                    memory.fill(0.0);
                }
                continue;
            };
            count += 1;
            elastic += e;
            force += f;
            torques[0] -= m.point.cross(&f) + couple;
            torques[1] += (m.point - shift).cross(&f) + couple;
        }
        if count == 0 {
            self.wake = (moved + closest.max(0.0)).min(self.expire);
            self.idle();
            return None;
        }
        self.touching = count;
        scratch.contacts += u64::from(count);
        if context.averaging {
            scratch.calls.averaging += 1;
            let share = self.average.share(count, elastic);
            force *= share;
            torques = torques.map(|t| t * share);
        }
        Some(Wrench { force: ka.r * force, torques: torques.map(|t| ka.r * t) })
    }

    #[inline]
    fn idle(&mut self) {
        if self.touching > 0 {
            self.touching = 0;
            self.average = Average::default();
        }
    }

    /// Finds out how far the two have really moved, and searches again where that is much.
    #[allow(clippy::too_many_arguments)]
    #[inline(never)]
    fn renew<S: Surface>(
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
        let skin = self.expire - self.built;
        if self.expire >= 0.0 && skin > 0.0 {
            // No point of the second moves farther than its centre does and the turn takes the farthest.
            let turned = (turn - self.turn).norm() * std::f64::consts::FRAC_1_SQRT_2;
            let really = (shift - self.shift).norm() + turned * body.reach();
            let really = really * (1.0 + 1e-12);
            if really < 0.5 * skin {
                self.built = moved - really;
                self.expire = self.built + skin;
                if width > 0 {
                    let used = really + context.range;
                    for (near, memory) in self.near.iter().zip(self.memory.chunks_mut(width)) {
                        if near.gap > used {
                            memory.fill(0.0);
                        }
                    }
                }
                let least = self.near.iter().map(|n| n.gap).fold(f64::MAX, f64::min);
                self.wake = (self.built + least - context.range).min(self.expire);
                return;
            }
        }
        (self.built, self.shift, self.turn) = (moved, *shift, *turn);
        let bound = body.bound();
        let skin = (LIFE * stride).clamp(SKIN[0] * bound, SKIN[1] * bound);
        let far = first.far(shift, bound) - context.range;
        scratch.near.clear();
        if far > skin {
            // Too far for any of their spheres: nothing until they have come that near.
            (self.wake, self.expire) = (moved + far, moved + far);
            self.near.clear();
            self.memory.clear();
            // The skin says nothing of such a list.
            self.built = self.expire;
            return;
        }
        scratch.searches += 1;
        let reach = skin + context.range;
        first.search(body, (shift, turn), reach, &mut scratch.stack, &mut scratch.near);
        scratch.near.sort_unstable_by_key(|n| (n.b, n.a));
        if width > 0 {
            self.carry(width, context.range, scratch);
        }
        std::mem::swap(&mut self.near, &mut scratch.near);
        self.expire = moved + skin;
        let least = self.near.iter().map(|n| n.gap).fold(f64::MAX, f64::min);
        self.wake = (moved + least - context.range).min(self.expire);
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
        let turn = a.r.transpose() * b.r;
        let shift = a.r.tr_mul(&(b.x - a.x));
        for (k, near) in self.near.iter().enumerate() {
            let s = &context.template(self.b).spheres()[near.b as usize];
            let center = turn * s.center + shift;
            let memory = &self.memory[k * L::WIDTH..(k + 1) * L::WIDTH];
            let Some(m) = first.meet(near.a, &center, s.radius) else { continue };
            let lasting =
                L::FAR && m.gap < context.range && memory.last().is_some_and(|m| *m != 0.0);
            if m.gap < 0.0 || lasting {
                found.push(ContactRecord {
                    a: self.a,
                    b: self.b,
                    sphere_a: near.a,
                    sphere_b: near.b,
                    point: a.x + a.r * m.point,
                    normal: a.r * m.normal,
                    overlap: -m.gap,
                    energy: L::energy(c, -m.gap, m.radius, memory),
                });
            }
        }
    }
}

/// What one composition of laws does with all pairs of a list.
pub(crate) trait Kernel: Send + Sync {
    /// How many numbers a contact remembers.
    fn width(&self) -> usize;
    /// Forces of pairs of bodies; each is given to `give`, or kept with its pair where there is none.
    fn bodies(
        &self,
        pairs: &mut [Pair],
        context: &Context,
        scratch: &mut Scratch,
        give: Option<&mut Sums>,
    );
    /// Forces of walls on bodies.
    fn walls(
        &self,
        pairs: &mut [Pair],
        context: &Context,
        scratch: &mut Scratch,
        give: Option<&mut Sums>,
    );
    /// The contacts as they are.
    fn records(
        &self,
        bodies: &[Pair],
        walls: &[Pair],
        context: &Context,
    ) -> [Vec<ContactRecord>; 2];
}

/// Forces and torques of all bodies, and of all walls about their origins.
pub(crate) struct Sums<'a> {
    pub force: &'a mut [Vec3],
    pub torque: &'a mut [Vec3],
    pub wall_force: &'a mut [Vec3],
    pub wall_torque: &'a mut [Vec3],
}

impl Sums<'_> {
    #[inline(always)]
    pub fn bodies(&mut self, pair: &Pair, w: &Wrench) {
        let (a, b) = (pair.a as usize, pair.b as usize);
        self.force[a] -= w.force;
        self.force[b] += w.force;
        self.torque[a] += w.torques[0];
        self.torque[b] += w.torques[1];
    }

    #[inline(always)]
    pub fn wall(&mut self, pair: &Pair, w: &Wrench) {
        let (a, b) = (pair.a as usize, pair.b as usize);
        self.wall_force[a] -= w.force;
        self.wall_torque[a] += w.torques[0];
        self.force[b] += w.force;
        self.torque[b] += w.torques[1];
    }
}

/// A kernel for a law.
pub(crate) struct Of<L>(pub std::marker::PhantomData<L>);

impl<L: Law> Kernel for Of<L> {
    fn width(&self) -> usize {
        L::WIDTH
    }

    fn bodies(
        &self,
        pairs: &mut [Pair],
        context: &Context,
        scratch: &mut Scratch,
        mut give: Option<&mut Sums>,
    ) {
        for pair in pairs {
            let (a, b) = (pair.a as usize, pair.b as usize);
            if context.moved[a] + context.moved[b] <= pair.wake {
                pair.wrench = None;
                continue;
            }
            let row = context.material[a] as usize * context.materials;
            let c = &context.coefficients[row + context.material[b] as usize];
            let ends = (&context.body(pair.a), &context.body(pair.b));
            let wrench =
                pair.act::<L, Template>(context.template(pair.a), ends, context, c, scratch);
            match (&mut give, wrench) {
                (Some(sums), Some(w)) => sums.bodies(pair, &w),
                _ => pair.wrench = wrench,
            }
        }
    }

    fn walls(
        &self,
        pairs: &mut [Pair],
        context: &Context,
        scratch: &mut Scratch,
        mut give: Option<&mut Sums>,
    ) {
        for pair in pairs {
            let (a, b) = (pair.a as usize, pair.b as usize);
            let wall = &context.walls[a];
            if wall.moved + context.moved[b] <= pair.wake && !wall.turning {
                pair.wrench = None;
                continue;
            }
            let row = wall.material as usize * context.materials;
            let c = &context.coefficients[row + context.material[b] as usize];
            let ends = (&context.wall(pair.a), &context.body(pair.b));
            let wrench = pair.act::<L, Wall>(wall, ends, context, c, scratch);
            match (&mut give, wrench) {
                (Some(sums), Some(w)) => sums.wall(pair, &w),
                _ => pair.wrench = wrench,
            }
        }
    }

    fn records(
        &self,
        bodies: &[Pair],
        walls: &[Pair],
        context: &Context,
    ) -> [Vec<ContactRecord>; 2] {
        let mut found = [Vec::new(), Vec::new()];
        let c = |a: u32, b: u32| &context.coefficients[a as usize * context.materials + b as usize];
        for p in bodies {
            let (a, b) = (p.a as usize, p.b as usize);
            let kin = (&context.kin[a], &context.kin[b]);
            let c = c(context.material[a], context.material[b]);
            p.records::<L, Template>(context.template(p.a), kin, context, c, &mut found[0]);
        }
        for p in walls {
            let (wall, b) = (&context.walls[p.a as usize], p.b as usize);
            let kin = (&wall.kin, &context.kin[b]);
            let c = c(wall.material, context.material[b]);
            p.records::<L, Wall>(wall, kin, context, c, &mut found[1]);
        }
        found
    }
}
