//! What a composition of laws does with all pairs.

use super::built::built;
use super::contact::{Calls, Law};
use super::effects::Coefficients;
use super::narrow::{ContactRecord, Pair, Wrench};
use super::state::Kin;
use super::template::Template;
use super::tree::Near;
use super::walls::Wall;
use crate::math::Vec3;

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
    /// How far springs move on: not at all where forces are reckoned once more.
    pub dt: f64,
    pub step: f64,
    /// Whether damping goes by the mass that the contact feels.
    pub felt: bool,
    pub averaging: bool,
}

/// Room that searches use again and again.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    pub near: Vec<Near>,
    pub memory: Vec<f64>,
    pub stack: Vec<[u32; 2]>,
    pub calls: Calls,
    pub contacts: u64,
    pub searches: u64,
}

/// One end of a pair.
pub(crate) struct End<'a> {
    pub kin: &'a Kin,
    pub moved: f64,
    pub stride: f64,
    pub inverse_mass: f64,
    pub inertia: Vec3,
}

impl Context<'_> {
    pub fn template(&self, i: u32) -> &Template {
        &self.templates[self.template[i as usize] as usize]
    }

    #[inline(always)]
    fn body(&self, i: u32) -> End<'_> {
        let (at, t) = (i as usize, self.template(i));
        let (inverse_mass, inertia) =
            if self.fixed[at] { (0.0, Vec3::zeros()) } else { (t.inverse_mass(), *t.inverse()) };
        End {
            kin: &self.kin[at],
            moved: self.moved[at],
            stride: self.stride[at],
            inverse_mass,
            inertia,
        }
    }

    #[inline(always)]
    fn wall(&self, i: u32) -> End<'_> {
        let w = &self.walls[i as usize];
        let (inverse_mass, inertia) = (0.0, Vec3::zeros());
        End { kin: &w.kin, moved: w.moved, stride: w.stride, inverse_mass, inertia }
    }
}

/// What one composition of laws does with all pairs of a list.
pub(crate) trait Kernel: Send + Sync {
    /// How many numbers a contact remembers.
    fn width(&self) -> usize;
    /// How many of them are of friction, rolling resistance and cohesion.
    fn widths(&self) -> [usize; 3];
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
    /// Sizes of the forces on each body, where an effect asks for them.
    pub load: Option<&'a mut [f64]>,
}

impl Sums<'_> {
    #[inline(always)]
    pub fn bodies(&mut self, pair: &Pair, w: &Wrench) {
        let (a, b) = (pair.a as usize, pair.b as usize);
        self.force[a] -= w.force;
        self.force[b] += w.force;
        self.torque[a] += w.torques[0];
        self.torque[b] += w.torques[1];
        if const { built("fragmentation") }
            && let Some(load) = &mut self.load
        {
            let size = w.force.norm();
            load[a] += size;
            load[b] += size;
        }
    }

    #[inline(always)]
    pub fn wall(&mut self, pair: &Pair, w: &Wrench) {
        let (a, b) = (pair.a as usize, pair.b as usize);
        self.wall_force[a] -= w.force;
        self.wall_torque[a] += w.torques[0];
        self.force[b] += w.force;
        self.torque[b] += w.torques[1];
        if const { built("fragmentation") }
            && let Some(load) = &mut self.load
        {
            load[b] += w.force.norm();
        }
    }
}

/// A kernel for a law.
pub(crate) struct Of<L>(pub std::marker::PhantomData<L>);

impl<L: Law> Kernel for Of<L> {
    fn width(&self) -> usize {
        L::WIDTH
    }

    fn widths(&self) -> [usize; 3] {
        L::WIDTHS
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
