//! Checkpoints: all that a later step depends on, so that a run that goes on from one gives the same bytes as
//! one that never stopped.

use super::breaking::Broken;
use super::effects::averaging::Average;
use super::effects::wear::Worn;
use super::narrow::Pair;
use super::rotate::Orientation;
use super::state::{Kin, State};
use super::template::Template;
use crate::error::{Error, Result};
use crate::math::{Sphere, Vec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What the first bytes of a checkpoint are.
const MAGIC: &[u8; 8] = b"MORULADE";
/// Checkpoints of another number are not read.
pub const VERSION: u32 = 4;

/// A template, its spheres as they were handed in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Shape {
    spheres: Vec<Sphere>,
    mass: f64,
    moments: [f64; 3],
}

/// What one pair remembers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Memory {
    pub a: u32,
    pub b: u32,
    pub touching: u32,
    pub average: Average,
    /// (sphere or feature of the first, sphere of the second), and the numbers.
    pub contacts: Vec<(u32, u32, Vec<f64>)>,
}

/// The bodies, arrays as in [`State`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Bodies {
    shapes: Vec<Shape>,
    template: Vec<u32>,
    material: Vec<u32>,
    position: Vec<Vec3>,
    velocity: Vec<Vec3>,
    orientation: Vec<Orientation>,
    momentum: Vec<Vec3>,
    force: Vec<Vec3>,
    torque: Vec<Vec3>,
    fixed: Vec<bool>,
    label: Vec<u64>,
    next: u64,
}

/// All of a run that a scene does not say.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Snapshot {
    pub step: u64,
    pub put_in: f64,
    pub inserted: Vec<u64>,
    pub bodies: Bodies,
    pub pairs: Vec<Memory>,
    pub walls: Vec<Memory>,
    pub wall_force: Vec<Vec3>,
    pub wall_torque: Vec<Vec3>,
    pub broken: Option<Broken>,
    pub worn: Option<Vec<Worn>>,
}

impl Snapshot {
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        let body = postcard::to_stdvec(self)
            .map_err(|e| Error::OutOfMemory(format!("a checkpoint could not be written: {e}")))?;
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(crc32fast::hash(&body).to_le_bytes());
        bytes.extend(body);
        Ok(bytes)
    }

    pub fn of_bytes(bytes: &[u8]) -> Result<Snapshot> {
        let Some((head, body)) = bytes.split_at_checked(16) else {
            return Err(Error::Format(format!("a checkpoint of {} bytes is cut off", bytes.len())));
        };
        let (magic, numbers) = head.split_at(8);
        if magic != MAGIC {
            return Err(Error::Format("this is no checkpoint of a simulation".into()));
        }
        let number = |at: usize| {
            let mut four = [0; 4];
            four.copy_from_slice(&numbers[at..at + 4]);
            u32::from_le_bytes(four)
        };
        if number(0) != VERSION {
            return Err(Error::Unsupported(format!(
                "the checkpoint is of version {}, this program reads {VERSION}",
                number(0)
            )));
        }
        if number(4) != crc32fast::hash(body) {
            return Err(Error::Format("the checkpoint is damaged: its checksum is another".into()));
        }
        postcard::from_bytes(body)
            .map_err(|e| Error::Format(format!("the checkpoint is damaged: {e}")))
    }
}

impl Bodies {
    pub fn of(s: &State) -> Bodies {
        let shape = |t: &Arc<Template>| {
            let mut spheres = t.spheres().to_vec();
            for (s, at) in t.spheres().iter().zip(t.order()) {
                spheres[*at as usize] = *s;
            }
            Shape { spheres, mass: t.mass(), moments: t.moments() }
        };
        Bodies {
            shapes: s.templates.iter().map(shape).collect(),
            template: s.template.clone(),
            material: s.material.clone(),
            position: s.position.clone(),
            velocity: s.velocity.clone(),
            orientation: s.orientation.clone(),
            momentum: s.momentum.clone(),
            force: s.force.clone(),
            torque: s.torque.clone(),
            fixed: s.fixed.clone(),
            label: s.label.clone(),
            next: s.next,
        }
    }

    /// The bodies again; lists of what is near begin anew.
    pub fn state(self) -> Result<State> {
        let templates: Result<Vec<Arc<Template>>> = self
            .shapes
            .iter()
            .map(|s| Ok(Arc::new(Template::new(&s.spheres, s.mass, s.moments)?)))
            .collect();
        let templates = templates?;
        let n = self.position.len();
        let lengths = [
            self.template.len(),
            self.material.len(),
            self.velocity.len(),
            self.orientation.len(),
            self.momentum.len(),
            self.force.len(),
            self.torque.len(),
            self.fixed.len(),
            self.label.len(),
        ];
        if lengths.iter().any(|l| *l != n)
            || self.template.iter().any(|t| *t as usize >= templates.len())
        {
            return Err(Error::Format("the checkpoint is damaged: its bodies do not agree".into()));
        }
        let zero = Vec3::zeros();
        let mut state = State {
            templates,
            template: self.template,
            material: self.material,
            position: self.position,
            velocity: self.velocity,
            orientation: self.orientation,
            momentum: self.momentum,
            force: self.force,
            torque: self.torque,
            fixed: self.fixed,
            label: self.label,
            next: self.next,
            moved: vec![0.0; n],
            stride: vec![0.0; n],
            kin: Vec::new(),
        };
        let none = nalgebra::Matrix3::identity();
        state.kin.resize(n, Kin { x: zero, r: none, v: zero, w: zero, vh: zero, wh: zero });
        (0..n).for_each(|i| state.refresh(i));
        Ok(state)
    }
}

/// What pairs remember.
pub(crate) fn memories(pairs: &[Pair], width: usize) -> Vec<Memory> {
    let of = |p: &Pair| Memory {
        a: p.a,
        b: p.b,
        touching: p.touching,
        average: p.average,
        contacts: p.memories(width).map(|(a, b, m)| (a, b, m.to_vec())).collect(),
    };
    pairs.iter().filter(|p| p.touching > 0 || p.remembers()).map(of).collect()
}

/// Pairs that remember it.
pub(crate) fn recalled(memories: Vec<Memory>, width: usize) -> Vec<Pair> {
    let of = |m: Memory| {
        let mut pair = Pair::new(m.a, m.b);
        (pair.touching, pair.average) = (m.touching, m.average);
        pair.recall(width, &m.contacts);
        pair
    };
    memories.into_iter().map(of).collect()
}
