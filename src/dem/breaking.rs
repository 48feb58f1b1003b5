//! How an engine breaks its bodies.

use super::built;
use super::contact::Calls;
use super::effects::fragmentation::{
    BreakRecord, Breaker, Energies, Fragmentation, Pieces, Shard, Touching, motion_of,
};
use super::energy;
use super::engine::Engine;
use super::narrow::ContactRecord;
use super::template::Template;
use crate::error::{Error, Result, push};
use crate::math::{Sphere, Vec3};
use crate::run::Run;
use crate::serial::{fragment_from_bytes, fragment_to_bytes};
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::Arc;

/// What a checkpoint keeps of breakage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Broken {
    impulse: Vec<f64>,
    shards: Vec<Option<Kept>>,
}

/// What a template is a piece of; a region in the bytes of the room for such.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Kept {
    parent: usize,
    region: Option<Vec<u8>>,
    center: Vec3,
    axes: [f64; 4],
    generation: u32,
}

/// How many contacts there are, and how deep.
fn touching<'a>(contacts: impl Iterator<Item = &'a ContactRecord>) -> Touching {
    contacts.fold(Touching::default(), |t, c| Touching {
        count: t.count + 1,
        deepest: t.deepest.max(c.overlap),
    })
}

/// Mass, momentum, and angular momentum about the origin.
pub(super) type Motion = (f64, Vec3, Vec3);

/// What parts have more than the whole, and the sums of the sizes of their own.
pub(super) fn differences(parts: &[Motion], whole: &Motion) -> (Motion, [f64; 3]) {
    let mass: f64 = parts.iter().map(|p| p.0).sum();
    let push: Vec3 = parts.iter().map(|p| p.1).sum();
    let turn: Vec3 = parts.iter().map(|p| p.2).sum();
    let sizes =
        [mass, parts.iter().map(|p| p.1.norm()).sum(), parts.iter().map(|p| p.2.norm()).sum()];
    ((mass - whole.0, push - whole.1, turn - whole.2), sizes)
}

/// The same as parts of those sizes; 0 where nothing moves.
pub(super) fn errors((mass, push, turn): &Motion, sizes: &[f64; 3]) -> [f64; 3] {
    let [m, p, l] = *sizes;
    let part = |error: f64, size: f64| if size > 0.0 { error / size } else { 0.0 };
    [part(mass.abs(), m), part(push.norm(), p), part(turn.norm(), l)]
}

impl Engine {
    /// Lets bodies break. After [`Engine::resume`] with the same fragmentation as before: pieces break on as they
    /// would have.
    pub fn break_by(&mut self, setup: Fragmentation) -> Result<()> {
        built::check("fragmentation", true)?;
        let mut breaker = Breaker::new(setup, &self.state)?;
        if let Some(broken) = self.broken.take() {
            let damaged = || Error::Format("the checkpoint's pieces do not agree".into());
            if broken.impulse.len() != breaker.impulse.len() {
                return Err(damaged());
            }
            breaker.impulse = broken.impulse;
            for (slot, kept) in breaker.shards.iter_mut().zip(broken.shards) {
                let Some(k) = kept else {
                    *slot = None;
                    continue;
                };
                let of = breaker.setup.breakable.get(k.parent).ok_or_else(damaged)?;
                let region = match &k.region {
                    Some(bytes) => Some(fragment_from_bytes(&of.parent, bytes)?.region),
                    None => None,
                };
                let Kept { parent, center, axes, generation, .. } = k;
                *slot = Some(Shard { parent, region, center, axes, generation });
            }
        }
        self.breaker = Some(breaker);
        Ok(())
    }

    /// The breaks so far.
    pub fn breaks(&self) -> &[BreakRecord] {
        self.breaker.as_ref().map_or(&[], |b| &b.log)
    }

    /// Breaks body `label` now, whatever its load.
    pub fn break_now(&mut self, label: u64, run: &Run) -> Result<()> {
        let Ok(i) = self.state.label.binary_search(&label) else {
            return Err(Error::IndexOutOfRange(format!("there is no body {label}")));
        };
        let known = |b: &Breaker| {
            b.shards.get(self.state.template[i] as usize).is_some_and(Option::is_some)
        };
        if !self.breaker.as_ref().is_some_and(known) {
            return Err(Error::InvalidArgument(format!("body {label} cannot break")));
        }
        self.start(run)?;
        self.shatter(i, run)
    }

    /// What a checkpoint keeps.
    pub(super) fn broken(&self) -> Result<Option<Broken>> {
        let Some(b) = &self.breaker else { return Ok(None) };
        let mut shards = Vec::new();
        for shard in &b.shards {
            let Some(s) = shard else {
                shards.push(None);
                continue;
            };
            let parent = &b.setup.breakable[s.parent].parent;
            let region = match &s.region {
                Some(region) => Some(fragment_to_bytes(parent, region, &[])?),
                None => None,
            };
            let (center, axes) = (s.center, s.axes);
            let (parent, generation) = (s.parent, s.generation);
            shards.push(Some(Kept { parent, region, center, axes, generation }));
        }
        Ok(Some(Broken { impulse: b.impulse.clone(), shards }))
    }

    /// Breaks what is due.
    pub(super) fn break_due(&mut self, run: &Run) -> Result<()> {
        let (step, dt) = (self.steps(), self.setup.dt);
        let Some(b) = &mut self.breaker else { return Ok(()) };
        let due = b.due(&self.state, step, dt);
        // From the last, so that the numbers of those before stay.
        for i in due.into_iter().rev() {
            self.shatter(i, run)?;
        }
        Ok(())
    }

    pub(super) fn energies(&self) -> Energies {
        let [a, b] = energy::kinetic(&self.state);
        let stored = self.contacts().iter().flatten().map(|c| c.energy).fold(0.0, |a, b| a + b);
        Energies { kinetic: a + b, potential: self.potential(), stored }
    }

    /// That of body `i` as it stands.
    pub(super) fn motion(&self, i: usize) -> Motion {
        let s = &self.state;
        let push = s.velocity[i] * s.mass(i);
        (s.mass(i), push, s.momentum[i] + s.position[i].cross(&push))
    }

    /// Contacts of these bodies with others and with walls: how many, how deep, and what their springs hold.
    pub(super) fn around(&self, those: Range<usize>) -> (Touching, f64) {
        let [bodies, walls] = self.contacts();
        let own = |i: u32| those.contains(&(i as usize));
        let all = bodies.iter().filter(|c| own(c.a) != own(c.b));
        let all = all.chain(walls.iter().filter(|c| own(c.b)));
        (touching(all.clone()), all.map(|c| c.energy).sum())
    }

    fn shatter(&mut self, i: usize, run: &Run) -> Result<()> {
        let [bodies, walls] = self.contacts();
        let of_bodies = bodies.iter().filter(|c| c.a as usize == i || c.b as usize == i);
        let inward = of_bodies
            .map(|c| (c.overlap, c.point, if c.b as usize == i { c.normal } else { -c.normal }));
        let of_walls = walls.iter().filter(|c| c.b as usize == i);
        let all = inward.chain(of_walls.map(|c| (c.overlap, c.point, c.normal)));
        let hit = all.max_by(|x, y| x.0.total_cmp(&y.0)).map(|(_, p, n)| (p, n));
        let before = self.energies();
        let (pressed, held) = self.around(i..i + 1);
        let Some(breaker) = &mut self.breaker else { return Ok(()) };
        let found = match breaker.pieces(&self.state, i, hit) {
            Ok(p) if p.fragments.len() + p.shattered.dust.len() > 1 => p,
            // What cannot be cut stays whole for ever.
            Ok(_) | Err(Error::NoSpheres(_) | Error::Empty(_)) => {
                breaker.shards[self.state.template[i] as usize] = None;
                return Ok(());
            }
            Err(e) => return Err(e.about(&format!("body {}", self.state.label[i]))),
        };
        let Pieces { fragments, shattered } = found;
        let (whole, label) = (self.motion(i), self.state.label[i]);
        let g = self.setup.gravity.unwrap_or_default();
        let mut dust = Energies::default();
        let mut parts: Vec<(f64, Vec3, Vec3)> = Vec::new();
        for crumb in &shattered.dust {
            let m = &crumb.moving;
            let at = (m.position, m.velocity, m.angular_velocity);
            let own = motion_of(m.mass, m.principal.moments, m.rotation, at);
            dust.kinetic += own.3;
            dust.potential -= m.mass * g.dot(&m.position);
            push("pieces", &mut parts, (own.0, own.1, own.2))?;
        }
        let lost = parts.iter().fold(0.0, |sum, p| sum + p.0);
        let energy_in = self.put_in;
        self.remove(label)?;
        let mut labels = Vec::new();
        for (template, shard, mut placed) in fragments {
            placed.template = self.add_template(template);
            if let Some(b) = &mut self.breaker {
                b.shards.resize(placed.template as usize, None);
                b.shards.push(Some(shard));
            }
            labels.push(self.add(&placed)?);
        }
        let first = self.state.len() - labels.len();
        for k in first..self.state.len() {
            push("pieces", &mut parts, self.motion(k))?;
        }
        // Nothing is put in by a break, and what dust takes away is gone.
        self.put_in = energy_in - dust.kinetic - dust.potential;
        let pieces = first..self.state.len();
        self.settle(pieces.clone(), (pressed, held), run)?;
        let mut after = self.energies();
        after.kinetic += dust.kinetic;
        after.potential += dust.potential;
        let bodies = &self.contacts()[0];
        let own = |c: &&ContactRecord| c.a as usize >= first && c.b as usize >= first;
        let ((mass, momentum, angular_momentum), sizes) = differences(&parts, &whole);
        let record = BreakRecord {
            step: self.steps(),
            label,
            fragments: labels,
            dust: lost,
            before,
            after,
            mass,
            momentum,
            angular_momentum,
            sizes,
            between: touching(bodies.iter().filter(own)),
            around: [pressed, self.around(pieces).0],
        };
        if let Some(b) = &mut self.breaker {
            push("breaks", &mut b.log, record)?;
        }
        Ok(())
    }

    /// Forces of bodies that are new at this time, with what touched before and what its springs held; springs do not move on.
    pub(super) fn settle(
        &mut self,
        those: Range<usize>,
        before: (Touching, f64),
        run: &Run,
    ) -> Result<()> {
        let calls: Calls = self.work.calls;
        self.forces(run, 0.0);
        self.yield_to_neighbours(those, before)?;
        self.forces(run, 0.0);
        self.work.calls = calls;
        Ok(())
    }

    /// Where the springs of these bodies hold more energy than before, or are pressed deeper (pieces of a piece may reach
    /// beyond its spheres), the spheres that press are made smaller by a part of their overlaps: with overlaps s times
    /// as deep no spring holds more than s² times as much.
    fn yield_to_neighbours(
        &mut self,
        those: Range<usize>,
        (before, held): (Touching, f64),
    ) -> Result<()> {
        let [bodies, walls] = self.contacts();
        // (body, sphere, overlap) of each contact that is theirs, at both ends where both are.
        let mut pressed: Vec<(usize, u32, f64)> = Vec::new();
        let mut now = 0.0;
        for (k, c) in bodies.iter().chain(&walls).enumerate() {
            let ends = [(c.a as usize, c.sphere_a), (c.b as usize, c.sphere_b)];
            let ends = if k < bodies.len() { &ends[..] } else { &ends[1..] };
            let own = ends.iter().filter(|e| those.contains(&e.0));
            now += if own.clone().count() > 0 { c.energy } else { 0.0 };
            pressed.extend(own.map(|e| (e.0, e.1, c.overlap)));
        }
        let deepest = pressed.iter().map(|p| p.2).fold(0.0, f64::max);
        if now <= held && deepest <= before.deepest {
            return Ok(());
        }
        let less = if now > held { 1.0 - (1.0 - 1e-9) * (held.max(0.0) / now).sqrt() } else { 0.0 };
        for i in those.clone() {
            let number = self.state.template[i] as usize;
            let t = self.state.templates[number].clone();
            let mut spheres = t.spheres().to_vec();
            for (k, s) in t.spheres().iter().enumerate() {
                let own = pressed.iter().filter(|p| p.0 == i && p.1 as usize == k);
                let deepest = own.map(|p| p.2).fold(0.0, f64::max);
                let less = (less * deepest).max(deepest - before.deepest);
                let radius = (s.radius - less).max(1e-3 * s.radius);
                if let Some(at) = t.order().get(k)
                    && let Some(slot) = spheres.get_mut(*at as usize)
                {
                    *slot = Sphere::new(s.center, radius);
                }
            }
            let smaller = Template::new(&spheres, t.mass(), t.moments())?;
            self.state.templates[number] = Arc::new(smaller);
        }
        self.forget(those);
        Ok(())
    }
}
