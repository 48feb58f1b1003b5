//! What an engine holds, and what each effect did.

use super::{EffectReport, Engine};
use crate::dem::effects::fragmentation::Breaker;
use crate::dem::effects::insertion::Insertion;
use crate::dem::effects::wear::Wearer;
use crate::dem::narrow::Pair;
use crate::dem::walls::Wall;

impl Engine {
    /// Bytes that all of it holds.
    pub fn bytes(&self) -> u64 {
        let templates: u64 = self.state.templates.iter().map(|t| t.bytes()).sum();
        let walls: u64 = self.walls.iter().map(Wall::bytes).sum();
        let pairs: u64 = self.wall_pairs.iter().map(|p| p.bytes() + p.memory_bytes()).sum();
        let held: u64 = self.broad.pairs.iter().map(Pair::memory_bytes).sum();
        self.state.bytes() + templates + walls + pairs + held + self.broad.bytes()
    }

    /// What each effect did and holds.
    pub fn effects(&self) -> Vec<EffectReport> {
        let (c, w) = (&self.work.calls, &self.work);
        let held: u64 =
            self.broad.pairs.iter().chain(&self.wall_pairs).map(Pair::memory_bytes).sum();
        // A contact's memory is of several effects.
        let widths = self.kernel.as_ref().map_or([0; 3], |k| k.widths());
        let each = held / (widths.iter().sum::<usize>() as u64).max(1);
        let [friction, rolling, cohesion] = widths.map(|w| w as u64 * each);
        let insertion = self.setup.insertion.capacity() * (size_of::<Insertion>() + 8);
        let moving = self.walls.iter().filter(|w| w.moves()).count() * size_of::<Wall>();
        [
            ("gravity", w.gravity, 0),
            ("normal", c.normal, 0),
            ("damping", c.damping, 0),
            ("tangential", c.tangential, friction),
            ("rolling", c.rolling, rolling),
            ("cohesion", c.cohesion, cohesion),
            ("averaging", c.averaging, 0),
            ("drag", w.drag, 0),
            ("insertion", w.insertion, insertion as u64),
            ("motion", w.motion, moving as u64),
            (
                "fragmentation",
                self.breaker.as_ref().map_or(0, |b| b.calls),
                self.breaker.as_ref().map_or(0, Breaker::bytes),
            ),
            (
                "wear",
                self.wearer.as_ref().map_or(0, |w| w.calls),
                self.wearer.as_ref().map_or(0, Wearer::bytes),
            ),
        ]
        .map(|(name, calls, bytes)| EffectReport { name, calls, bytes })
        .to_vec()
    }
}
