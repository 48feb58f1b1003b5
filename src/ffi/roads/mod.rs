//! Calls of each kind that work long enough to fail on the way, small enough to be made often.

// The macros call what they are given at once.
#![allow(clippy::redundant_closure_call, clippy::type_complexity)]

use super::failing::message;
use super::*;
use crate::error::faults::{self, Kind};
use std::ffi::c_void;
use std::ptr::{null, null_mut};

/// The inputs of the calls: made once, read by all.
pub struct Given {
    pub threads: i32,
    shape: *mut morula_shape,
    solid: *mut morula_solid,
    clump: *mut morula_clump,
    parent: *mut morula_parent,
    held: morula_held,
    fragments: *mut morula_fragments,
    body: *mut morula_body,
}

/// A call with progress and a deadline (0: none): its status, and what it made, in bytes.
pub struct Call {
    pub name: &'static str,
    pub run: fn(&Given, morula_progress, *mut c_void, f64) -> (i32, Option<Vec<u8>>),
}

/// Every struct of options begins with its size and is filled by its init.
macro_rules! options {
    ($kind:ty, $init:ident) => {{
        let mut o: $kind = sized();
        assert_eq!(unsafe { $init(&mut o, size_of::<$kind>()) }, 0);
        o
    }};
}

/// Makes a handle, has it written down, frees it.
macro_rules! made {
    ($call:expr, $bytes:expr, $free:ident) => {{
        let mut out = null_mut();
        let status = unsafe { $call(&mut out) };
        if status == 0 {
            let bytes = in_peace(|| $bytes(out.cast_const()));
            unsafe { $free(out) };
            (0, Some(bytes))
        } else {
            assert!(out.is_null() && !message().is_empty());
            (status, None)
        }
    }};
}

/// Looks at what was made: no failure is for this.
fn in_peace<T>(work: impl FnOnce() -> T) -> T {
    faults::with(Kind::Panic, 0, work).0
}

fn sized<T>() -> T {
    let mut value: T = unsafe { std::mem::zeroed() };
    unsafe { (&raw mut value).cast::<usize>().write(size_of::<T>()) };
    value
}

mod after;
mod images;
mod many;

const CORNERS: [f64; 24] = [
    0., 0., 0., 2., 0., 0., 0., 1., 0., 2., 1., 0., 0., 0., 1., 2., 0., 1., 0., 1., 1., 2., 1., 1.,
];
const FACES: [u32; 36] = [
    0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3,
    5, 3, 7, 5,
];
#[cfg(feature = "io")]
const OFF: &[u8] = b"OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

impl Given {
    pub fn new() -> Given {
        let (mut shape, mut solid, mut clump) = (null_mut(), null_mut(), null_mut());
        let (mut parent, mut held) = (null_mut(), sized::<morula_held>());
        let grid = grid();
        let mut o = options!(morula_clump_options, morula_clump_options_init);
        (o.spheres, o.effort) = (3, MORULA_EFFORT_DRAFT);
        unsafe {
            let name = c"stone".as_ptr();
            let status =
                morula_shape_from_primitive(name, null(), null(), 0, 8, 2, null(), &mut shape);
            assert_eq!(status, 0);
            assert_eq!(morula_solid_from_shape(shape, &grid, &mut solid), 0);
            assert_eq!(morula_clump_from_solid(solid, &o, &mut clump), 0);
            assert_eq!(morula_parent_from_clump(solid, clump, 1, &mut parent), 0);
            let p = null();
            assert_eq!(morula_parent_held(parent, 1.0, 1.0, p, p, p, p, &mut held), 0);
        }
        let (mut fragments, mut body) = (null_mut(), null_mut());
        let mut cut = options!(morula_break_options, morula_break_options_init);
        (cut.cells, cut.spheres) = (2, 3);
        let mut masses = options!(morula_mass_options, morula_mass_options_init);
        masses.infeasible = MORULA_INFEASIBLE_LEAST_ERROR;
        unsafe {
            let status = morula_parent_break(parent, null(), 0, &held, &cut, &mut fragments);
            assert_eq!(status, 0);
            assert_eq!(morula_body_from_clump(clump, &masses, &mut body), 0);
        }
        Given { threads: 1, shape, solid, clump, parent, held, fragments, body }
    }
}

impl Drop for Given {
    fn drop(&mut self) {
        unsafe {
            morula_body_free(self.body);
            morula_fragments_free(self.fragments);
            morula_parent_free(self.parent);
            morula_clump_free(self.clump);
            morula_solid_free(self.solid);
            morula_shape_free(self.shape);
        }
    }
}

fn grid() -> morula_solid_options {
    let mut o = options!(morula_solid_options, morula_solid_options_init);
    o.cells = 10;
    o
}

fn of_shape(shape: *const morula_shape) -> Vec<u8> {
    let mut size = 0;
    unsafe {
        assert_eq!(morula_shape_serialize(shape, 0, null_mut(), &mut size), 0);
        let mut bytes = vec![0; size];
        assert_eq!(morula_shape_serialize(shape, size, bytes.as_mut_ptr(), &mut size), 0);
        bytes
    }
}

fn of_clump(clump: *const morula_clump) -> Vec<u8> {
    let mut n = 0;
    unsafe {
        assert_eq!(morula_clump_sphere_count(clump, &mut n), 0);
        let mut xyzr = vec![0.0; 4 * n];
        assert_eq!(morula_clump_copy_spheres(clump, n, xyzr.as_mut_ptr()), 0);
        xyzr.iter().flat_map(|x| x.to_le_bytes()).collect()
    }
}

fn of_fragments(fragments: *const morula_fragments) -> Vec<u8> {
    let mut n = 0;
    unsafe {
        assert_eq!(morula_fragments_count(fragments, &mut n), 0);
        (0..n)
            .flat_map(|i| {
                let mut f: morula_fragment = sized();
                assert_eq!(morula_fragments_get(fragments, i, &mut f), 0);
                let numbers = [f.mass, f.centre[0], f.volume, f.sphere_count as f64];
                numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>()
            })
            .collect()
    }
}

fn clump(
    method: i32,
    g: &Given,
    progress: morula_progress,
    user: *mut c_void,
    late: f64,
) -> (i32, Option<Vec<u8>>) {
    let mut o = options!(morula_clump_options, morula_clump_options_init);
    (o.method, o.spheres) = (method, 4);
    if method == MORULA_METHOD_BEST || method == MORULA_METHOD_INSCRIBED {
        o.effort = MORULA_EFFORT_DRAFT;
    }
    (o.threads, o.progress, o.user, o.deadline_seconds) = (g.threads, progress, user, late);
    o.quality_columns = 12;
    o.wants = MORULA_WANT_OVERLAP | MORULA_WANT_MOMENTS;
    made!(|out| morula_clump_from_solid(g.solid, &o, out), of_clump, morula_clump_free)
}

fn breaking(
    g: &Given,
    progress: morula_progress,
    user: *mut c_void,
    late: f64,
) -> morula_break_options {
    let mut o = options!(morula_break_options, morula_break_options_init);
    (o.cells, o.spheres, o.masses) = (3, 4, 1);
    (o.threads, o.progress, o.user, o.deadline_seconds) = (g.threads, progress, user, late);
    o
}

macro_rules! method {
    ($name:literal, $method:expr) => {
        Call { name: $name, run: |g, progress, user, late| clump($method, g, progress, user, late) }
    };
}

/// All of them.
pub fn roads() -> impl Iterator<Item = &'static Call> {
    [ROADS, many::ROADS, images::ROADS, after::ROADS].into_iter().flatten()
}

const ROADS: &[Call] = &[
    Call {
        name: "shape_from_mesh",
        run: |g, progress, user, _| {
            let mut o = options!(morula_import_options, morula_import_options_init);
            (o.threads, o.progress, o.user) = (g.threads, progress, user);
            let (v, t) = (CORNERS.as_ptr(), FACES.as_ptr());
            made!(|out| morula_shape_from_mesh(v, 8, t, 12, &o, out), of_shape, morula_shape_free)
        },
    },
    #[cfg(feature = "io")]
    Call {
        name: "shape_from_bytes",
        run: |g, progress, user, _| {
            let mut o = options!(morula_import_options, morula_import_options_init);
            (o.threads, o.progress, o.user) = (g.threads, progress, user);
            let (bytes, n) = (OFF.as_ptr(), OFF.len());
            made!(
                |out| morula_shape_from_bytes(bytes, n, null(), &o, null(), out),
                of_shape,
                morula_shape_free
            )
        },
    },
    Call {
        name: "shape_from_mask",
        run: |g, progress, user, _| {
            let mut o = options!(morula_import_options, morula_import_options_init);
            (o.threads, o.progress, o.user) = (g.threads, progress, user);
            let cells: Vec<u8> = (0..216).map(|i| u8::from(i % 6 > 1 && i / 36 > 0)).collect();
            let dims = [6, 6, 6];
            made!(
                |out| morula_shape_from_mask(
                    cells.as_ptr(),
                    dims.as_ptr(),
                    null(),
                    null(),
                    &o,
                    out
                ),
                of_shape,
                morula_shape_free
            )
        },
    },
    Call {
        name: "solid_from_shape",
        run: |g, progress, user, _| {
            let mut o = grid();
            (o.threads, o.progress, o.user) = (g.threads, progress, user);
            let bytes = |solid| {
                let mut at = [0.0; 1];
                let status =
                    unsafe { morula_solid_distance(solid, 1, [0.1; 3].as_ptr(), at.as_mut_ptr()) };
                assert_eq!(status, 0);
                at[0].to_le_bytes().to_vec()
            };
            made!(|out| morula_solid_from_shape(g.shape, &o, out), bytes, morula_solid_free)
        },
    },
    method!("mss", MORULA_METHOD_MSS),
    method!("best", MORULA_METHOD_BEST),
    method!("surface_fit", MORULA_METHOD_SURFACE_FIT),
    method!("inscribed", MORULA_METHOD_INSCRIBED),
    method!("cover", MORULA_METHOD_COVER),
    method!("packed", MORULA_METHOD_PACKED),
    method!("euclidean", MORULA_METHOD_EUCLIDEAN),
    method!("ferellec_mcdowell", MORULA_METHOD_FERELLEC_MCDOWELL),
    method!("favier", MORULA_METHOD_FAVIER),
    method!("uniform_grid", MORULA_METHOD_UNIFORM_GRID),
    Call {
        name: "clump_from_shape",
        run: |g, progress, user, late| {
            let mut o = options!(morula_clump_options, morula_clump_options_init);
            (o.spheres, o.effort, o.quality_columns) = (3, MORULA_EFFORT_DRAFT, 12);
            (o.threads, o.progress, o.user, o.deadline_seconds) = (g.threads, progress, user, late);
            o.wants = MORULA_WANT_SURFACE;
            let grid = grid();
            made!(
                |out| morula_clump_from_shape(g.shape, &grid, &o, out),
                of_clump,
                morula_clump_free
            )
        },
    },
    Call {
        name: "clumps_from_solid",
        run: |g, progress, user, late| {
            let mut o = options!(morula_clump_options, morula_clump_options_init);
            (o.effort, o.wants) = (MORULA_EFFORT_DRAFT, 0);
            (o.threads, o.progress, o.user, o.deadline_seconds) = (g.threads, progress, user, late);
            let (counts, mut all) = ([2u64, 3], [null_mut(); 2]);
            let status = unsafe {
                morula_clumps_from_solid(g.solid, &o, counts.as_ptr(), 2, all.as_mut_ptr())
            };
            if status != 0 {
                assert!(all.iter().all(|c| c.is_null()));
                return (status, None);
            }
            let bytes = in_peace(|| all.iter().flat_map(|c| of_clump(*c)).collect());
            all.iter().for_each(|c| unsafe { morula_clump_free(*c) });
            (0, Some(bytes))
        },
    },
    Call {
        name: "body_from_clump",
        run: |g, progress, user, _| {
            let mut o = options!(morula_mass_options, morula_mass_options_init);
            (o.threads, o.progress, o.user) = (g.threads, progress, user);
            o.infeasible = MORULA_INFEASIBLE_LEAST_ERROR;
            let bytes = |body| {
                let mut masses = [0.0; 3];
                let status = unsafe { morula_body_copy_masses(body, 3, masses.as_mut_ptr()) };
                assert_eq!(status, 0);
                masses.iter().flat_map(|m| m.to_le_bytes()).collect()
            };
            made!(|out| morula_body_from_clump(g.clump, &o, out), bytes, morula_body_free)
        },
    },
    Call {
        name: "parent_break",
        run: |g, progress, user, late| {
            let o = breaking(g, progress, user, late);
            made!(
                |out| morula_parent_break(g.parent, null(), 0, &g.held, &o, out),
                of_fragments,
                morula_fragments_free
            )
        },
    },
    Call {
        name: "reclump_shape",
        run: |g, progress, user, late| {
            let o = breaking(g, progress, user, late);
            let old = [0.0, 0.0, 0.0, 0.3];
            made!(
                |out| morula_reclump_shape(g.solid, old.as_ptr(), 1, &g.held, &o, out),
                of_fragments,
                morula_fragments_free
            )
        },
    },
    Call {
        name: "cost_curve",
        run: |g, progress, user, late| {
            let mut o = options!(morula_clump_options, morula_clump_options_init);
            (o.effort, o.quality_columns) = (MORULA_EFFORT_DRAFT, 12);
            (o.threads, o.progress, o.user, o.deadline_seconds) = (g.threads, progress, user, late);
            let mut c = options!(morula_cost_options, morula_cost_options_init);
            (c.most, c.surface, c.quality_columns) = (2, 0, 12);
            let bytes = |cost| {
                let mut n = 0;
                assert_eq!(unsafe { morula_cost_count(cost, &mut n) }, 0);
                vec![n as u8]
            };
            made!(|out| morula_cost_curve(g.solid, &o, &c, out), bytes, morula_cost_free)
        },
    },
];

/// From a shape to a clump and its surface within a limit of memory.
pub fn whole_road(limit: u64) -> i32 {
    let mut import = options!(morula_import_options, morula_import_options_init);
    let mut o = options!(morula_clump_options, morula_clump_options_init);
    let mut grid = grid();
    (import.memory_limit, grid.memory_limit) = (limit, limit);
    (o.spheres, o.effort, o.quality_columns) = (3, MORULA_EFFORT_DRAFT, 12);
    o.wants = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE;
    let (mut shape, mut solid, mut clump) = (null_mut(), null_mut(), null_mut());
    unsafe {
        let (v, t) = (CORNERS.as_ptr(), FACES.as_ptr());
        let mut status = morula_shape_from_mesh(v, 8, t, 12, &import, &mut shape);
        if status == 0 {
            status = morula_solid_from_shape(shape, &grid, &mut solid);
        }
        if status == 0 {
            status = morula_clump_from_solid(solid, &o, &mut clump);
        }
        morula_clump_free(clump);
        morula_solid_free(solid);
        morula_shape_free(shape);
        status
    }
}
