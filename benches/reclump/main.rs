//! Spheres of fragments: how long they take from a parent in memory, how much of the fragment they
//! cover beside the full generator `inscribed` under the same constraints; how long a whole break
//! takes, and a shape that changes without one; how the times compare with the peer `multisphere`
//! on the same body where `MORULA_PEER_PYTHON` names a Python that has it; and `check`, which
//! counts what crosses over many breaks. `times` is `latency` without the full generator; without
//! a word all of them follow each other. The particles are those of `MORULA_DATA`, or built-in
//! stones.
//!
//!     MORULA_DATA=… MORULA_PEER_PYTHON=… cargo bench --bench reclump [-- latency [CUTS] |
//!         times [CUTS] | whole [BREAKS] | reshape [DENTS] | peer [CUTS] | check [BREAKS]]

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

mod breaks;
mod check;
mod latency;
mod peer;
mod reshape;

use check::check;
use latency::{latency, whole};
use peer::peer;
use reshape::reshaped;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let count = |none: usize| args.get(1).and_then(|n| n.parse().ok()).unwrap_or(none);
    match args.first().map(String::as_str) {
        Some("latency") => latency(count(100), true),
        Some("times") => latency(count(100), false),
        Some("whole") => whole(count(100)),
        Some("reshape") => reshaped(count(100)),
        Some("peer") => peer(count(20)),
        Some("check") => check(count(10_000)),
        _ => {
            latency(100, true);
            whole(100);
            reshaped(100);
            peer(20);
            check(10_000);
        }
    }
}
