//! Calls that make much at once: each part has a status of its own.

use super::*;

/// What a call made of each of its parts: bytes where its status says so, nothing else.
fn parts<T>(
    status: i32,
    handles: &[*mut T],
    statuses: &[i32],
    bytes: impl Fn(*const T) -> Vec<u8>,
    free: unsafe extern "C" fn(*mut T),
) -> (i32, Option<Vec<u8>>) {
    let said = message();
    assert_eq!(status == 0, said.is_empty(), "{status}: {said}");
    // Before the first part nothing is written.
    let begun = statuses.iter().all(|s| *s >= 0);
    if status == 5 {
        println!("{said}");
    }
    assert!(begun || status != 0 && statuses.iter().all(|s| *s < 0));
    let failed = statuses.iter().find(|s| **s > 0);
    assert!(!begun || failed.map_or(status == 0, |s| *s == status), "{statuses:?}, {status}");
    let mut all = Vec::new();
    for (handle, own) in handles.iter().zip(statuses) {
        assert_eq!(*own == 0, !handle.is_null(), "{statuses:?}");
        if *own == 0 {
            all.extend(in_peace(|| bytes(handle.cast_const())));
            unsafe { free(*handle) };
        }
    }
    (status, (status == 0).then_some(all))
}

fn small(
    g: &Given,
    progress: morula_progress,
    user: *mut c_void,
    late: f64,
) -> morula_clump_options {
    let mut o = options!(morula_clump_options, morula_clump_options_init);
    (o.method, o.spheres, o.wants) = (MORULA_METHOD_EUCLIDEAN, 3, 0);
    (o.threads, o.progress, o.user, o.deadline_seconds) = (g.threads, progress, user, late);
    o
}

/// Two boxes in a volume of labels.
fn labels() -> Vec<u32> {
    (0..10 * 6 * 6)
        .map(|i| match (i % 10, i / 10 % 6, i / 60) {
            (1..=3, 1..5, 1..5) => 3,
            (5..=8, 1..5, 1..4) => 7,
            _ => 0,
        })
        .collect()
}

pub const DIMS: [usize; 3] = [10, 6, 6];

fn of_lists(sweep: *const morula_sweep) -> Vec<u8> {
    let mut n = 0;
    unsafe {
        assert_eq!(morula_sweep_count(sweep, &mut n), 0);
        let mut lists: Vec<morula_swept> = (0..n).map(|_| sized()).collect();
        assert_eq!(morula_sweep_copy(sweep, n, lists.as_mut_ptr()), 0);
        for (k, list) in lists.iter().enumerate() {
            let mut curve = null_mut();
            let status = morula_sweep_curve(sweep, k, &mut curve);
            assert_eq!(status, list.status, "list {k}");
            assert_eq!(status == 0, !curve.is_null());
            morula_cost_free(curve);
        }
        lists.iter().flat_map(|l| [l.status as u8, l.lines as u8, l.cut as u8]).collect()
    }
}

pub const ROADS: &[Call] = &[
    Call {
        name: "clumps_from_shapes",
        run: |g, progress, user, late| {
            let (o, grid) = (small(g, progress, user, late), grid());
            let (shapes, mut all) = ([g.shape.cast_const(); 3], [null_mut(); 3]);
            let mut statuses = [-1; 3];
            let status = unsafe {
                let (shapes, all) = (shapes.as_ptr(), all.as_mut_ptr());
                morula_clumps_from_shapes(shapes, 3, &grid, &o, all, statuses.as_mut_ptr())
            };
            parts(status, &all, &statuses, of_clump, morula_clump_free)
        },
    },
    Call {
        name: "clumps_from_labels",
        run: |g, progress, user, late| {
            let (o, labels) = (small(g, progress, user, late), labels());
            let (wanted, mut all, mut statuses) = ([7, 3], [null_mut(); 2], [-1; 2]);
            let status = unsafe {
                morula_clumps_from_labels(
                    labels.as_ptr(),
                    DIMS.as_ptr(),
                    null(),
                    null(),
                    wanted.as_ptr(),
                    2,
                    null(),
                    null(),
                    &o,
                    all.as_mut_ptr(),
                    statuses.as_mut_ptr(),
                )
            };
            parts(status, &all, &statuses, of_clump, morula_clump_free)
        },
    },
    Call {
        name: "parents_break",
        run: |g, progress, user, late| {
            let o = [breaking(g, progress, user, late); 2];
            let (held, parents) = ([g.held; 2], [g.parent.cast_const(); 2]);
            let (mut all, mut statuses) = ([null_mut(); 2], [-1; 2]);
            let status = unsafe {
                morula_parents_break(
                    parents.as_ptr(),
                    null(),
                    null(),
                    held.as_ptr(),
                    o.as_ptr(),
                    2,
                    all.as_mut_ptr(),
                    statuses.as_mut_ptr(),
                )
            };
            parts(status, &all, &statuses, of_fragments, morula_fragments_free)
        },
    },
    Call {
        name: "fragments_from_labels",
        run: |g, progress, user, late| {
            let (o, labels) = (breaking(g, progress, user, late), labels());
            made!(
                |out| morula_fragments_from_labels(
                    labels.as_ptr(),
                    DIMS.as_ptr(),
                    null(),
                    null(),
                    null(),
                    null(),
                    0,
                    &g.held,
                    &o,
                    out
                ),
                of_fragments,
                morula_fragments_free
            )
        },
    },
    Call {
        name: "sweep_from_shape",
        run: |g, progress, user, late| {
            let (o, grid) = (small(g, progress, user, late), grid());
            let mut c = options!(morula_cost_options, morula_cost_options_init);
            (c.most, c.surface, c.quality_columns) = (2, 0, 8);
            let mut what = options!(morula_sweep_options, morula_sweep_options_init);
            let (resolutions, seconds) = ([8.0, 10.0], [0.0]);
            let methods = [MORULA_METHOD_EUCLIDEAN, MORULA_METHOD_MSS];
            (what.resolutions, what.resolution_count) = (resolutions.as_ptr(), 2);
            (what.methods, what.method_count) = (methods.as_ptr(), 2);
            (what.deadlines, what.deadline_count) = (seconds.as_ptr(), 1);
            let (status, lists) = made!(
                |out| morula_sweep_from_shape(g.shape, &grid, &o, &c, &what, out),
                of_lists,
                morula_sweep_free
            );
            // Each list has a status of its own.
            let own = lists.iter().flatten().step_by(3).find(|s| **s != 0);
            match own {
                Some(own) => (i32::from(*own), None),
                None => (status, lists),
            }
        },
    },
];
