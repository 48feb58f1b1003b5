//! What a call runs with: its own threads, seed, deadline, progress and cancel,
//! and the stage times and counters that it leaves behind.
//!
//! This is the only file that names rayon: a process-wide pool would hang in a
//! forked child and fight with a host's MPI ranks, so each call owns its pool,
//! and nothing runs on a pool that the call did not build.

#[cfg(test)]
use crate::error::faults;
use crate::error::{Error, Result};
use rayon::prelude::*;
use std::cell::{Cell, RefCell};
use std::time::{Duration, Instant};

/// The threads of one call. Work is always split the same way, whatever the
/// number of threads, so that results are the same bytes.
pub struct Pool {
    pool: Option<rayon::ThreadPool>,
    /// The pool's threads: rayon only tells them to stop, so that without
    /// joining they could outlive the call by a moment.
    workers: Vec<std::thread::JoinHandle<()>>,
}

thread_local! {
    /// Whether a panic on this thread is reported to the caller as a status, so
    /// that nothing is printed. Workers take it over from the thread that made the pool.
    pub(crate) static QUIET: Cell<bool> = const { Cell::new(false) };
}

impl Drop for Pool {
    fn drop(&mut self) {
        drop(self.pool.take());
        for worker in self.workers.drain(..) {
            let _ = worker.join();
        }
    }
}

impl Pool {
    /// A pool of `threads`; 0 means all cores, 1 runs on the calling thread.
    pub fn new(threads: usize) -> Result<Self> {
        let threads = match threads {
            0 => std::thread::available_parallelism().map_or(1, |n| n.get()),
            n => n,
        };
        if threads == 1 {
            return Ok(Pool::serial());
        }
        if threads > 1024 {
            return Err(Error::InvalidArgument(format!("threads is {threads}, more than 1024")));
        }
        let quiet = QUIET.get();
        #[cfg(test)]
        let plan = faults::plan();
        let mut workers = Vec::with_capacity(threads);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .spawn_handler(|thread| {
                let name = format!("morula-{}", thread.index());
                #[cfg(test)]
                let plan = plan.clone();
                workers.push(std::thread::Builder::new().name(name).spawn(move || {
                    QUIET.set(quiet);
                    #[cfg(test)]
                    faults::take_over(plan);
                    thread.run();
                })?);
                Ok(())
            })
            .build();
        match pool {
            Ok(pool) => Ok(Pool { pool: Some(pool), workers }),
            Err(e) => {
                drop(Pool { pool: None, workers });
                Err(Error::OutOfMemory(format!("{threads} threads could not be started: {e}")))
            }
        }
    }

    /// A pool that runs everything on the calling thread.
    pub fn serial() -> Self {
        Pool { pool: None, workers: Vec::new() }
    }

    /// How many threads work.
    pub fn threads(&self) -> usize {
        self.pool.as_ref().map_or(1, |p| p.current_num_threads())
    }

    /// `f(0), f(1), …, f(n−1)`, in this order whatever the number of threads.
    pub fn map<T: Send>(&self, n: usize, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
        #[cfg(test)]
        let f = |i| {
            faults::step();
            f(i)
        };
        match &self.pool {
            Some(p) if n > 1 => {
                // Few tasks may differ much: whoever is done first takes the next.
                let most = (n / 64).max(1);
                p.install(|| (0..n).into_par_iter().with_max_len(most).map(f).collect())
            }
            _ => (0..n).map(f).collect(),
        }
    }

    /// Calls `f(index of the chunk, chunk)` for each run of `len` elements.
    pub fn chunks_mut<T: Send>(
        &self,
        data: &mut [T],
        len: usize,
        f: impl Fn(usize, &mut [T]) + Sync + Send,
    ) {
        let len = len.max(1);
        #[cfg(test)]
        let f = |i, chunk: &mut [T]| {
            faults::step();
            f(i, chunk)
        };
        match &self.pool {
            Some(p) if data.len() > len => {
                p.install(|| data.par_chunks_mut(len).enumerate().for_each(|(i, c)| f(i, c)));
            }
            _ => data.chunks_mut(len).enumerate().for_each(|(i, c)| f(i, c)),
        }
    }
}

/// The parts of the work that are timed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Reading a file.
    Read,
    /// Checks, welding and repair.
    Check,
    /// The solid: grid, inside, distance.
    Solid,
    /// The generator.
    Generate,
    /// Quality figures.
    Measure,
    /// Exact moments.
    Moments,
}

/// Number of [`Stage`]s.
pub const STAGES: usize = 6;

/// What a call did. All zero for work that was not asked for.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Counters {
    /// Wall-clock seconds of each [`Stage`], in the order of the enum.
    pub seconds: [f64; STAGES],
    /// Grid cells made.
    pub cells: u64,
    /// Greatest number of bytes that the large arrays held at once (estimate from their sizes).
    pub peak_bytes: u64,
    /// Distance transforms run.
    pub transforms: u64,
    /// Exact point–surface distances that the generator and the quality figures asked for.
    pub exact_distances: u64,
    /// Local maxima looked at.
    pub maxima: u64,
    /// Spheres tried.
    pub spheres_tried: u64,
    /// Columns measured.
    pub columns: u64,
}

impl Counters {
    /// The counters of this call and a later one: sums, and the greater of the peaks.
    pub fn then(&self, later: &Counters) -> Counters {
        let mut seconds = self.seconds;
        for (sum, more) in seconds.iter_mut().zip(later.seconds) {
            *sum += more;
        }
        Counters {
            seconds,
            cells: self.cells.saturating_add(later.cells),
            peak_bytes: self.peak_bytes.max(later.peak_bytes),
            transforms: self.transforms.saturating_add(later.transforms),
            exact_distances: self.exact_distances.saturating_add(later.exact_distances),
            maxima: self.maxima.saturating_add(later.maxima),
            spheres_tried: self.spheres_tried.saturating_add(later.spheres_tried),
            columns: self.columns.saturating_add(later.columns),
        }
    }
}

/// What a call runs with. It lives on the calling thread; only its [`Pool`] is shared.
pub struct Run<'a> {
    pool: Pool,
    seed: u64,
    started: Instant,
    deadline: Cell<Option<Instant>>,
    progress: RefCell<Option<Progress<'a>>>,
    fraction: Cell<f64>,
    /// Where the work's own fractions 0 and 1 lie in the whole.
    span: Cell<[f64; 2]>,
    cancelled: Cell<bool>,
    counters: RefCell<Counters>,
}

/// What parts of a call on other threads take over.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RunPart {
    seed: u64,
    started: Instant,
    deadline: Option<Instant>,
}

impl RunPart {
    /// A run of a part, on the thread that asks.
    pub(crate) fn run(self) -> Run<'static> {
        let RunPart { seed, started, deadline } = self;
        Run { seed, started, deadline: Cell::new(deadline), ..Run::serial() }
    }
}

/// Called on the caller's thread with a fraction in [0, 1] that never falls;
/// returns `true` to cancel.
pub type Progress<'a> = Box<dyn FnMut(f64) -> bool + 'a>;

impl Default for Run<'_> {
    fn default() -> Self {
        Run::serial()
    }
}

impl<'a> Run<'a> {
    /// A run on `threads` threads (0: all cores).
    pub fn new(threads: usize) -> Result<Self> {
        Ok(Run { pool: Pool::new(threads)?, ..Run::serial() })
    }

    /// A run on the calling thread.
    pub fn serial() -> Self {
        Run {
            pool: Pool::serial(),
            seed: 0,
            started: Instant::now(),
            deadline: Cell::new(None),
            progress: RefCell::new(None),
            fraction: Cell::new(0.0),
            span: Cell::new([0.0, 1.0]),
            cancelled: Cell::new(false),
            counters: RefCell::new(Counters::default()),
        }
    }

    /// Sets the seed of every random choice.
    pub fn with_seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Sets the deadline, in seconds from now; it only decides between fixed
    /// checkpoints. Not finite or absurdly far means none.
    pub fn with_deadline(self, seconds: f64) -> Self {
        let after = Duration::try_from_secs_f64(seconds).ok();
        self.deadline.set(after.and_then(|d| self.started.checked_add(d)));
        self
    }

    /// Sets the progress callback.
    pub fn with_progress(mut self, progress: Progress<'a>) -> Self {
        self.progress = RefCell::new(Some(progress));
        self
    }

    /// A part of the work on one thread, with the same seed and deadline and counters of its own.
    /// It tells no progress: that is called on the thread of the whole alone.
    pub(crate) fn part(&self) -> RunPart {
        RunPart { seed: self.seed, started: self.started, deadline: self.deadline.get() }
    }

    /// The threads.
    pub fn pool(&self) -> &Pool {
        &self.pool
    }

    /// The seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Does one of several pieces of work: its fractions 0 and 1 are `span` of what is done around it.
    pub(crate) fn within<T>(&self, span: [f64; 2], work: impl FnOnce() -> T) -> T {
        let outer = self.span.get();
        self.span.set(span.map(|f| outer[0] + (outer[1] - outer[0]) * f));
        let result = work();
        self.span.set(outer);
        result
    }

    /// Does a piece of work with a deadline of its own, so many seconds from now, or the whole's
    /// where that is earlier; 0: none of its own.
    pub(crate) fn in_seconds<T>(&self, seconds: f64, work: impl FnOnce() -> T) -> T {
        let outer = self.deadline.get();
        let own = Duration::try_from_secs_f64(seconds).ok().filter(|d| !d.is_zero());
        let own = own.and_then(|d| Instant::now().checked_add(d));
        self.deadline.set(own.map(|own| outer.map_or(own, |o| o.min(own))).or(outer));
        let result = work();
        self.deadline.set(outer);
        result
    }

    /// Sets the counters back, for work that is to be counted by itself.
    pub(crate) fn count_anew(&self) {
        self.counters.replace(Counters::default());
    }

    /// Reports progress in [0, 1]. Smaller values than the last are raised to it.
    /// After a cancel this stays `true`.
    pub fn cancelled(&self, fraction: f64) -> bool {
        #[cfg(test)]
        faults::step();
        if self.cancelled.get() {
            return true;
        }
        let [from, to] = self.span.get();
        let f = from + (to - from) * if fraction.is_finite() { fraction } else { 0.0 };
        let f = f.clamp(self.fraction.get(), 1.0);
        self.fraction.set(f.max(self.fraction.get()));
        // A callback that calls back into the library finds the cell taken: no progress then.
        if let Ok(mut slot) = self.progress.try_borrow_mut()
            && let Some(progress) = slot.as_mut()
            && progress(self.fraction.get())
        {
            self.cancelled.set(true);
        }
        self.cancelled.get()
    }

    /// As [`Run::cancelled`], as an error for work that has no partial result.
    pub fn check(&self, fraction: f64, what: &str) -> Result<()> {
        if self.cancelled(fraction) {
            return Err(Error::Cancelled(format!("cancelled by the caller while {what}")));
        }
        Ok(())
    }

    /// Whether a deadline or the caller can end the work.
    pub fn can_stop(&self) -> bool {
        self.deadline.get().is_some() || self.progress.try_borrow().map_or(true, |p| p.is_some())
    }

    /// Whether the deadline has passed.
    pub fn late(&self) -> bool {
        #[cfg(test)]
        if self.deadline.get().is_some() && faults::turn(faults::Kind::Deadline) {
            return true;
        }
        self.deadline.get().is_some_and(|d| Instant::now() >= d)
    }

    /// Times `work` under `stage`. Nested stages count twice: keep them apart.
    pub fn time<T>(&self, stage: Stage, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.counters.borrow_mut().seconds[stage as usize] += start.elapsed().as_secs_f64();
        result
    }

    /// Changes the counters.
    pub fn count(&self, change: impl FnOnce(&mut Counters)) {
        change(&mut self.counters.borrow_mut());
    }

    /// The counters so far.
    pub fn counters(&self) -> Counters {
        *self.counters.borrow()
    }
}
