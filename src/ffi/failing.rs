//! What a call leaves behind that fails at any of its steps: cancelled at each tick, late from each
//! look at the deadline on, without memory at each reservation, or with a panic at any step. The
//! handles that it was given are as good as before, its own are freed, nothing is lost.

use super::roads::{self, Call, Given, roads};
use super::*;
use crate::error::faults::{self, Kind};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::ffi::{CStr, c_void};

thread_local! {
    /// Bytes that this thread has taken and not given back.
    static LIVE: Cell<i64> = const { Cell::new(0) };
}

struct Counting;

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let new = unsafe { System.alloc(layout) };
        if !new.is_null() {
            let _ = LIVE.try_with(|live| live.set(live.get() + layout.size() as i64));
        }
        new
    }

    unsafe fn dealloc(&self, old: *mut u8, layout: Layout) {
        let _ = LIVE.try_with(|live| live.set(live.get() - layout.size() as i64));
        unsafe { System.dealloc(old, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// Bytes of this thread, without the message of its last failure.
fn live() -> i64 {
    let mut held = std::mem::MaybeUninit::uninit();
    assert_eq!(unsafe { morula_held_init(held.as_mut_ptr(), size_of::<morula_held>()) }, 0);
    LIVE.get()
}

pub(super) fn message() -> String {
    unsafe { CStr::from_ptr(morula_last_error_message()) }.to_str().unwrap().to_owned()
}

/// Ticks so far, and which of them cancels.
struct Ticks {
    seen: u64,
    at: u64,
}

unsafe extern "C" fn tick(_: f64, user: *mut c_void) -> i32 {
    let ticks = unsafe { &mut *user.cast::<Ticks>() };
    ticks.seen += 1;
    i32::from(ticks.seen == ticks.at)
}

/// Runs a call whose k-th turn fails, or none for 0: its status, what it made, the turns there were.
fn attempt(road: &Call, given: &Given, kind: Option<Kind>, at: u64) -> (i32, Option<Vec<u8>>, u64) {
    let mut ticks = Ticks { seen: 0, at: if kind.is_none() { at } else { 0 } };
    let user = (&raw mut ticks).cast();
    // A deadline that does not pass by itself.
    let late = if kind == Some(Kind::Deadline) { 1e6 } else { 0.0 };
    let call = || (road.run)(given, Some(tick), user, late);
    match kind {
        None => {
            let (status, made) = call();
            (status, made, ticks.seen)
        }
        Some(kind) => {
            let ((status, made), turns) = faults::with(kind, at, call);
            (status, made, turns)
        }
    }
}

/// All turns where they are few, else the first and others up to the last.
fn chosen(turns: u64) -> Vec<u64> {
    let most = if std::env::var_os("MORULA_FULL").is_some() { 400 } else { 24 };
    let first = turns.min(most / 2);
    let rest = turns - first;
    let others = rest.min(most / 2);
    (1..=first).chain((1..=others).map(|i| first + i * rest / others)).collect()
}

/// `least`: calls that must have failed, or come out otherwise. `partial`: what a call ended early may give.
fn everywhere(kind: Option<Kind>, least: u64, partial: bool, right: fn(i32) -> bool) {
    let (mut tried, mut failed, mut other, mut wrong) = (0, 0, 0, Vec::new());
    for road in roads() {
        let (status, whole, turns) = attempt(road, &Given::new(), kind, 0);
        assert_eq!(status, 0, "{}: {}", road.name, message());
        for at in chosen(turns) {
            // What a handle makes once and keeps is still to be made.
            let before = live();
            let given = Given::new();
            let (status, made, _) = attempt(road, &given, kind, at);
            let (said, done, otherwise) = (message(), made.is_some(), made != whole);
            let (later, again, _) = attempt(road, &given, kind, 0);
            let same = later == 0 && again == whole;
            drop((made, again, given));
            let lost = live() - before - said.capacity() as i64;
            tried += 1;
            other += u64::from(otherwise);
            failed += u64::from(status != 0);
            let good = right(status) && (partial || otherwise == (status != 0));
            if !good || done != (status == 0) || lost != 0 || !same {
                wrong.push(format!(
                    "{}, turn {at} of {turns}: {status}, {lost} bytes lost, then {later}, the same: \
                     {same}; {said:?}",
                    road.name
                ));
            }
        }
    }
    println!(
        "{kind:?}: {tried} calls with a failure inside, {failed} failed, {other} came out otherwise"
    );
    assert!(other >= least, "{other} of {tried} calls felt it");
    assert!(wrong.is_empty(), "{} of {tried}:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn a_cancel_at_each_tick() {
    everywhere(None, 60, true, |status| status == 0 || status == MORULA_STATUS_CANCELLED);
}

#[test]
fn a_deadline_at_each_look() {
    // A clump that has no sphere yet says so.
    everywhere(Some(Kind::Deadline), 20, true, |status| {
        status == 0 || status == MORULA_STATUS_NO_SPHERES
    });
}

#[test]
fn no_memory_at_each_reservation() {
    everywhere(Some(Kind::Memory), 200, false, |status| {
        status == 0 || status == MORULA_STATUS_OUT_OF_MEMORY
    });
}

#[test]
fn a_panic_at_any_step() {
    everywhere(Some(Kind::Panic), 200, false, |status| {
        status == 0 || status == MORULA_STATUS_INTERNAL
    });
}

#[test]
fn a_panic_on_a_worker() {
    let mut caught = 0;
    for road in roads() {
        let mut given = Given::new();
        given.threads = 3;
        let (status, whole, turns) = attempt(road, &given, Some(Kind::Panic), 0);
        assert_eq!(status, 0, "{}: {}", road.name, message());
        for at in chosen(turns).into_iter().step_by(4) {
            let (status, made, _) = attempt(road, &given, Some(Kind::Panic), at);
            assert!(status == 0 || status == MORULA_STATUS_INTERNAL, "{}: {status}", road.name);
            assert_eq!(status == 0, made.is_some(), "{}, turn {at}", road.name);
            caught += u64::from(status == MORULA_STATUS_INTERNAL);
        }
        let (status, again, _) = attempt(road, &given, Some(Kind::Panic), 0);
        assert!(status == 0 && again == whole, "{}: another result after panics", road.name);
    }
    assert!(caught > 20, "{caught} panics");
}

/// Each limit of memory from a byte to enough: refused with its status, or done.
#[test]
fn a_limit_of_memory_at_each_size() {
    let (mut refused, mut done) = (0, 0);
    for bits in 0..26 {
        for part in [4, 5, 6, 7] {
            let limit = (1u64 << bits) * part / 4;
            let before = live();
            let status = roads::whole_road(limit);
            let said = message();
            match status {
                0 => done += 1,
                MORULA_STATUS_MEMORY_LIMIT => refused += 1,
                other => panic!("limit {limit}: {other}, {said}"),
            }
            drop(said);
            assert_eq!(live(), before, "limit {limit}: bytes lost");
        }
    }
    assert!(refused > 40 && done > 8, "{refused} refused, {done} done");
}
