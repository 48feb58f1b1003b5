//! How an engine wears its bodies down.

use super::breaking::{differences, errors};
use super::built;
use super::effects::fragmentation::{Energies, motion_of};
use super::effects::wear::{Flat, Wear, WearRecord, Wearer};
use super::engine::Engine;
use super::rotate::Orientation;
use crate::error::{Error, Result, push};
use crate::run::Run;

impl Engine {
    /// Lets bodies wear. After [`Engine::resume`] with the same as before: they wear on as they would have.
    pub fn wear_by(&mut self, setup: Vec<Wear>) -> Result<()> {
        built::check("wear", true)?;
        let mut wearer = Wearer::new(setup, &self.state)?;
        if let Some(worn) = self.worn.take() {
            let templates = self.state.templates.len();
            let there = worn.iter().all(|w| w.own.is_none_or(|t| (t as usize) < templates));
            if worn.len() != wearer.worn.len() || !there {
                return Err(Error::Format("the checkpoint's worn bodies do not agree".into()));
            }
            wearer.worn = worn;
        }
        self.wearer = Some(wearer);
        Ok(())
    }

    /// The flats so far.
    pub fn flats(&self) -> &[WearRecord] {
        self.wearer.as_ref().map_or(&[], |w| &w.log)
    }

    /// Wears down what is due.
    pub(super) fn wear_due(&mut self, run: &Run) -> Result<()> {
        let step = self.steps();
        let Some(wearer) = &mut self.wearer else { return Ok(()) };
        for (k, i) in wearer.due(&self.state, step) {
            self.flatten(k, i, run)?;
        }
        Ok(())
    }

    fn flatten(&mut self, k: usize, i: usize, run: &Run) -> Result<()> {
        let (pressed, held) = self.around(i..i + 1);
        let before = self.energies();
        let whole = self.motion(i);
        let label = self.state.label[i];
        let Some(wearer) = &mut self.wearer else { return Ok(()) };
        let flat = wearer.flat(k, &self.state, i, run);
        let flat = flat.map_err(|e| e.about(&format!("body {label}")))?;
        let Some(Flat { template, moving, coverage, dust }) = flat else { return Ok(()) };
        let spheres = template.spheres().len();
        let number = match wearer.worn[k].own {
            Some(number) => {
                self.state.templates[number as usize] = template;
                number
            }
            None => self.add_template(template),
        };
        if let Some(wearer) = &mut self.wearer {
            wearer.worn[k].own = Some(number);
        }
        let s = &mut self.state;
        s.template[i] = number;
        s.position[i] = moving.position;
        s.orientation[i] = Orientation::new(moving.rotation)
            .ok_or_else(|| Error::Internal("a worn body has no rotation".into()))?;
        s.set_velocity(i, moving.velocity, moving.angular_velocity);
        let mut parts = vec![self.motion(i)];
        let mut lost = Energies::default();
        let g = self.setup.gravity.unwrap_or_default();
        for m in &dust {
            let at = (m.position, m.velocity, m.angular_velocity);
            let own = motion_of(m.mass, m.principal.moments, m.rotation, at);
            lost.kinetic += own.3;
            lost.potential -= m.mass * g.dot(&m.position);
            push("dust", &mut parts, (own.0, own.1, own.2))?;
        }
        // Nothing is put in, and what dust takes away is gone.
        self.put_in -= lost.kinetic + lost.potential;
        self.forget(i..i + 1);
        self.settle(i..i + 1, (pressed, held), run)?;
        let mut after = self.energies();
        after.kinetic += lost.kinetic;
        after.potential += lost.potential;
        let (more, sizes) = differences(&parts, &whole);
        let around = [pressed, self.around(i..i + 1).0];
        let record = WearRecord {
            step: self.steps(),
            label,
            spheres,
            mass: parts[0].0,
            dust: parts[1..].iter().map(|p| p.0).sum(),
            coverage,
            errors: errors(&more, &sizes),
            before,
            after,
            around,
        };
        if let Some(wearer) = &mut self.wearer {
            push("flats", &mut wearer.log, record)?;
        }
        Ok(())
    }
}
