//! Checkpoints of an engine, and how it goes on from one.

use super::{Engine, Setup};
use crate::dem::snapshot::{self, Bodies, Snapshot};
use crate::error::{Error, Result};

impl Engine {
    /// A checkpoint: with the same setup it goes on to the same bytes.
    pub fn checkpoint(&self) -> Result<Vec<u8>> {
        let width = self.kernel.as_ref().map_or(0, |k| k.width());
        Snapshot {
            step: self.step,
            put_in: self.put_in,
            inserted: self.inserted.clone(),
            bodies: Bodies::of(&self.state),
            pairs: snapshot::memories(&self.broad.pairs, width),
            walls: snapshot::memories(&self.wall_pairs, width),
            wall_force: self.wall_force.clone(),
            wall_torque: self.wall_torque.clone(),
            broken: self.broken()?,
            worn: self.wearer.as_ref().map(|w| w.worn.clone()),
        }
        .to_bytes()
    }

    /// Goes on from a checkpoint of the same setup, which must have been started. Refused: what is none, is damaged, is of another
    /// version, or of another number of walls or insertions.
    pub fn resume(setup: Setup, checkpoint: &[u8]) -> Result<Engine> {
        let s = Snapshot::of_bytes(checkpoint)?;
        let mut engine = Engine::new(setup, s.bodies.state()?)?;
        if s.wall_force.len() != engine.walls.len() || s.inserted.len() != engine.inserted.len() {
            return Err(Error::InvalidArgument(format!(
                "the checkpoint has {} walls and {} insertions, the scene {} and {}",
                s.wall_force.len(),
                s.inserted.len(),
                engine.walls.len(),
                engine.inserted.len()
            )));
        }
        let width = engine.kernel.as_ref().map_or(0, |k| k.width());
        engine.broad.pairs = snapshot::recalled(s.pairs, width);
        engine.wall_pairs = snapshot::recalled(s.walls, width);
        (engine.wall_force, engine.wall_torque) = (s.wall_force, s.wall_torque);
        (engine.step, engine.put_in, engine.inserted) = (s.step, s.put_in, s.inserted);
        let (time, dt) = (engine.time(), engine.setup.dt);
        for wall in &mut engine.walls {
            wall.to(time, dt);
        }
        (engine.broken, engine.worn) = (s.broken, s.worn);
        engine.started = true;
        Ok(engine)
    }
}
