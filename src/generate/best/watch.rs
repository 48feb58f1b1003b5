//! Whether a search goes on: the caller's cancel and the deadline, asked for between its steps.

use crate::clump::Stopped;
use crate::run::Run;
use std::cell::Cell;

/// A run, whatever its callback borrows.
trait Ask {
    fn asked(&self, done: f64) -> Option<Stopped>;
}

impl Ask for Run<'_> {
    fn asked(&self, done: f64) -> Option<Stopped> {
        if self.cancelled(done) {
            Some(Stopped::Cancelled)
        } else {
            self.late().then_some(Stopped::Deadline)
        }
    }
}

/// Looks at both, on the calling thread.
pub(super) struct Watch<'r> {
    run: &'r dyn Ask,
    done: Cell<f64>,
    stopped: Cell<Option<Stopped>>,
}

impl<'r> Watch<'r> {
    pub(super) fn new(run: &'r Run) -> Self {
        Watch { run, done: Cell::new(0.0), stopped: Cell::new(None) }
    }

    /// Why the search stops, if it does.
    pub(super) fn stopped(&self) -> Option<Stopped> {
        self.stopped.get()
    }

    /// Whether to go on, with so much done.
    pub(super) fn at(&self, done: f64) -> bool {
        self.done.set(done);
        self.go()
    }

    /// The same with as much done as before. Once it is no, it stays no.
    pub(super) fn go(&self) -> bool {
        if self.stopped.get().is_none() {
            self.stopped.set(self.run.asked(self.done.get()));
        }
        self.stopped.get().is_none()
    }
}
