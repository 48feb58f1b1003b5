//! Failures on purpose: a test has the k-th turn of a kind fail, to see what is left behind.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// What fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Any step of the work panics.
    Panic,
    /// A reservation finds no memory.
    Memory,
    /// The deadline passes, and stays passed.
    Deadline,
}

/// What is to fail on this thread and the workers of its calls.
#[derive(Debug)]
pub(crate) struct Plan {
    kind: Kind,
    /// From 1; 0: none fails, they are only counted.
    at: u64,
    turns: AtomicU64,
}

thread_local! {
    static PLAN: RefCell<Option<Arc<Plan>>> = const { RefCell::new(None) };
}

/// Does the work with a plan; how many turns there were.
pub(crate) fn with<T>(kind: Kind, at: u64, work: impl FnOnce() -> T) -> (T, u64) {
    let plan = Arc::new(Plan { kind, at, turns: AtomicU64::new(0) });
    let before = PLAN.replace(Some(Arc::clone(&plan)));
    let result = work();
    PLAN.set(before);
    (result, plan.turns.load(Ordering::Relaxed))
}

/// The plan of this thread, which a worker takes over.
pub(crate) fn plan() -> Option<Arc<Plan>> {
    PLAN.with_borrow(Clone::clone)
}

/// Sets the plan of a worker.
pub(crate) fn take_over(plan: Option<Arc<Plan>>) {
    PLAN.set(plan);
}

/// Takes a turn: whether it fails.
pub(crate) fn turn(kind: Kind) -> bool {
    PLAN.with_borrow(|plan| {
        plan.as_ref().filter(|p| p.kind == kind).is_some_and(|p| {
            let now = p.turns.fetch_add(1, Ordering::Relaxed) + 1;
            p.at > 0 && (now == p.at || kind == Kind::Deadline && now > p.at)
        })
    })
}

/// A step of the work.
#[allow(clippy::panic)]
pub(crate) fn step() {
    if turn(Kind::Panic) {
        panic!("a failure on purpose");
    }
}
