//! Another Rust library in the same program, with an own copy of what Rust needs:
//! its allocator, its threads, its panics.

/// The sum of the squares below `n`, by way of the heap, a map, a thread and a caught panic.
#[unsafe(no_mangle)]
pub extern "C" fn other_sum_of_squares(n: u32) -> u64 {
    let work = move || {
        let map: std::collections::HashMap<u32, u64> =
            (0..n).map(|i| (i, u64::from(i).pow(2))).collect();
        map.values().sum()
    };
    std::panic::set_hook(Box::new(|_| {}));
    let panics = std::panic::catch_unwind(|| assert_eq!(format!("{n}"), "no number"));
    match std::thread::spawn(work).join() {
        Ok(sum) if panics.is_err() => sum,
        _ => 0,
    }
}
