//! Prepared parents that are used again: the caller's own, with a bound; nothing is global.

use super::Parent;
use super::hash::hash;
use crate::error::Result;
use crate::math::Sphere;
use crate::run::Run;
use crate::shape::Shape;
use crate::solid::{Resolution, Solid, SolidOptions};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What a cache has done, and what it holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CacheCounters {
    /// Parents that were there.
    pub hits: u64,
    /// Parents that were made.
    pub misses: u64,
    /// Parents that had to go, or that were too large to stay.
    pub evicted: u64,
    /// Parents that are held.
    pub parents: usize,
    /// Bytes of these, solids and all; those that the caller still uses stay in memory beside it.
    pub bytes: u64,
}

/// Prepared [`Parent`]s by shape, grid, spheres and seed, those used last within a bound of bytes.
///
/// Threads may use one at the same time. What it gives does not depend on what it holds.
pub struct Cache {
    limit: u64,
    held: Mutex<Held>,
}

#[derive(Default)]
struct Held {
    /// The one used last is the last.
    parents: Vec<(u128, Arc<Parent>)>,
    counters: CacheCounters,
}

impl Cache {
    /// An empty one that holds so many bytes at most.
    pub fn new(limit: u64) -> Cache {
        Cache { limit, held: Mutex::default() }
    }

    /// The parent of a shape on a grid with the spheres of its clump (caller's frame): the one that
    /// was made before, else a new one. Errors: those of [`Solid::new`] and [`Parent::new`].
    pub fn parent(
        &self,
        shape: &Shape,
        options: &SolidOptions,
        spheres: &[Sphere],
        run: &Run,
    ) -> Result<Arc<Parent>> {
        let (kind, size) = match options.resolution {
            Resolution::CellsLongest(n) => (0u8, f64::from(n)),
            Resolution::CellsShortest(n) => (1, f64::from(n)),
            Resolution::CellsDiameter(n) => (2, f64::from(n)),
            Resolution::CellSize(h) => (3, h),
        };
        let grid = (kind, size, options.padding, options.memory_limit);
        // The candidates are drawn by the seed.
        let key = hash(&(shape.frame, shape.body.as_ref(), grid, spheres, run.seed()))?;
        if let Some(parent) = self.lock().find(key) {
            return Ok(parent);
        }
        // Others need not wait for it.
        let solid = Arc::new(Solid::new(shape, options, run)?);
        let parent = Arc::new(Parent::new(solid, spheres, run)?);
        Ok(self.lock().insert(key, parent, self.limit))
    }

    /// What it has done, and what it holds.
    pub fn counters(&self) -> CacheCounters {
        let held = self.lock();
        CacheCounters { parents: held.parents.len(), ..held.counters }
    }

    /// Lets all of them go; what was counted stays.
    pub fn clear(&self) {
        let mut held = self.lock();
        held.parents.clear();
        held.counters.bytes = 0;
    }

    fn lock(&self) -> MutexGuard<'_, Held> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Held {
    fn find(&mut self, key: u128) -> Option<Arc<Parent>> {
        let at = self.parents.iter().position(|(k, _)| *k == key)?;
        // The last from now on.
        self.parents[at..].rotate_left(1);
        self.counters.hits += 1;
        self.parents.last().map(|(_, parent)| parent.clone())
    }

    fn insert(&mut self, key: u128, parent: Arc<Parent>, limit: u64) -> Arc<Parent> {
        self.counters.misses += 1;
        if let Some((_, there)) = self.parents.iter().find(|(k, _)| *k == key) {
            // Another thread was faster.
            return there.clone();
        }
        let bytes = parent.all_bytes();
        if bytes > limit {
            self.counters.evicted += 1;
            return parent;
        }
        while self.counters.bytes > limit - bytes && !self.parents.is_empty() {
            let (_, gone) = self.parents.remove(0);
            self.counters.bytes -= gone.all_bytes();
            self.counters.evicted += 1;
        }
        self.counters.bytes += bytes;
        self.parents.push((key, parent.clone()));
        parent
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::shape::{ImportOptions, Primitive};

    fn stone(seed: u64) -> Shape {
        let mut stone = Primitive::from_name("stone").unwrap();
        stone.set("seed", seed as f64).unwrap();
        Shape::from_primitive(&stone, 12, &ImportOptions::default(), &Run::serial()).unwrap()
    }

    fn coarse(n: u32) -> SolidOptions {
        SolidOptions { resolution: Resolution::CellsLongest(n), ..SolidOptions::default() }
    }

    #[test]
    fn parents_are_made_once_and_the_one_longest_unused_goes() {
        let run = Run::serial();
        let shapes = [1, 2, 3].map(stone);
        let spheres = [Sphere::new(Vec3::zeros(), 0.2)];
        let alone = |i: usize| {
            let cache = Cache::new(u64::MAX);
            cache.parent(&shapes[i], &coarse(16), &spheres, &run).unwrap();
            cache.counters().bytes
        };
        let sizes = [0, 1, 2].map(alone);
        let cache = Cache::new(sizes.iter().sum::<u64>() - 1);
        let get = |i: usize| cache.parent(&shapes[i], &coarse(16), &spheres, &run).unwrap();
        let counts = || {
            let c = cache.counters();
            [c.hits, c.misses, c.evicted, c.parents as u64]
        };
        let first = get(0);
        assert!(Arc::ptr_eq(&first, &get(0)));
        get(1);
        assert_eq!(counts(), [1, 2, 0, 2]);
        get(0);
        // There is no room for all three: 1 was used before 0.
        get(2);
        assert_eq!(counts(), [2, 3, 1, 2]);
        assert_eq!(cache.counters().bytes, sizes[0] + sizes[2]);
        assert!(Arc::ptr_eq(&first, &get(0)));
        get(1);
        assert_eq!(counts(), [3, 4, 2, 2]);
        cache.clear();
        assert_eq!((cache.counters().bytes, counts()), (0, [3, 4, 2, 0]));
        // What was made again is the same.
        assert_eq!(get(0).unit_spheres(), first.unit_spheres());
        assert!(!Arc::ptr_eq(&first, &get(1)));
    }

    #[test]
    fn other_grids_spheres_and_seeds_are_other_parents() {
        let run = Run::serial();
        let (shape, cache) = (stone(1), Cache::new(u64::MAX));
        let mut sphere = Sphere::new(Vec3::zeros(), 0.2);
        cache.parent(&shape, &coarse(16), &[sphere], &run).unwrap();
        cache.parent(&shape, &coarse(17), &[sphere], &run).unwrap();
        cache.parent(&shape, &coarse(16), &[], &run).unwrap();
        cache.parent(&shape, &coarse(16), &[sphere], &Run::serial().with_seed(1)).unwrap();
        sphere.radius = sphere.radius.next_up();
        cache.parent(&shape, &coarse(16), &[sphere], &run).unwrap();
        assert_eq!((cache.counters().hits, cache.counters().misses), (0, 5));
        // Too large to stay.
        let small = Cache::new(100);
        small.parent(&shape, &coarse(16), &[], &run).unwrap();
        let c = small.counters();
        assert_eq!((c.misses, c.evicted, c.parents, c.bytes), (1, 1, 0, 0));
        assert!(cache.parent(&shape, &coarse(0), &[], &run).is_err());
    }
}
