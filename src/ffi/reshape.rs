//! New spheres for what a model of the host's has made: a label volume of pieces, a new shape.

use super::callbacks::log_notes;
use super::choices::*;
use super::fragment::{Asked, asked, held_of, morula_fragments, run_of, wrap};
use super::fragment_structs::*;
use super::guard::{borrow, give, guard, require};
use super::options::read;
use super::parent::checked_spheres;
use super::solid::{morula_solid, solid_options};
use super::structs::morula_solid_options;
use super::voxels::{cells, layout};
use crate::error::Result;
use crate::fragment::{reshape, shatter_labels};
use std::sync::Arc;

/// Breaks a particle into the pieces of a label volume, as a fracture model of the host's gives them:
/// fills each with spheres and hands mass, place and velocities over, as morula_parent_break() does.
/// A label of several pieces, which share no face, makes a fragment of each; its cell is its label.
///
/// Parameters: `labels`, `dims`, `spacing` and `origin` as morula_shape_from_label(), in the frame and
/// unit of the particle's shape; 0 is background; `solid_options` is for the grids of the pieces, NULL:
/// the defaults; `xyzr` holds the `count` spheres of the particle's clump, x, y, z and radius each,
/// within the union of which those of the fragments stay, or none; `held` is the body as the solver
/// holds it; `options` may be NULL for the defaults: what they say of the cut is not read.
/// Returns: as morula_parent_break(); EMPTY (no label); the statuses of morula_shape_from_label() and
/// morula_solid_from_shape().
/// Ownership: inputs stay the caller's and may be freed at once; free *fragments with
/// morula_fragments_free(). *fragments is written only on success. Each fragment is the whole of a
/// parent of its own, which *fragments keeps: to break one again, `parent` is NULL.
/// Threads: any thread. The same bytes come out for any number of threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_fragments_from_labels(
    labels: *const u32,
    dims: *const usize,
    spacing: *const f64,
    origin: *const f64,
    solid_options: *const morula_solid_options,
    xyzr: *const f64,
    count: usize,
    held: *const morula_held,
    options: *const morula_break_options,
    fragments: *mut *mut morula_fragments,
) -> i32 {
    guard(|| {
        require(fragments, "fragments")?;
        require(held, "held")?;
        let layout = unsafe { layout(dims, spacing, origin)? };
        let labels = unsafe { cells(labels, layout.dims, "labels")? };
        let grid = self::solid_options(&unsafe { read(solid_options)? })?;
        let spheres = unsafe { checked_spheres(xyzr, count, "xyzr")? };
        let held = held_of(&unsafe { read(held)? });
        let o = unsafe { read(options)? };
        let Asked { options, .. } =
            unsafe { asked(&morula_break_options { kind: MORULA_CUT_SEEDED, ..o })? };
        let run = run_of(&o)?;
        let (parents, found) =
            shatter_labels(labels, &layout, &grid, &spheres, &held, &options, &run)?;
        unsafe { give_logged(fragments, wrap(parents, &held, found)?) }
    })
}

unsafe fn give_logged(to: *mut *mut morula_fragments, made: morula_fragments) -> Result<()> {
    log_notes(&made.found.notes);
    unsafe { give(to, made) };
    Ok(())
}

/// New spheres for a particle whose shape has changed without breaking: dented, worn, grown.
///
/// The old spheres are the start of the search, the map tells which of them each new one comes
/// from, and mass, momentum and angular momentum of the held body are kept.
///
/// Parameters: `xyzr` holds the `count` old spheres (there may be none) in the frame of the new
/// `solid`, x, y, z and radius each; `held` is the body as the solver holds it, in that frame;
/// `options` may be NULL for the defaults: half_spaces, if any, are what bounds the body (flats
/// pressed into it), kind is not read, and within_union is not heeded.
/// Returns: as morula_parent_break(). *fragments holds one fragment, or as many as the half-spaces
/// leave components.
/// Ownership: inputs stay the caller's and may be freed at once; free *fragments with
/// morula_fragments_free(). *fragments is written only on success.
/// Threads: any thread; the solid is only read. The same bytes come out for any number of threads.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_reclump_shape(
    solid: *const morula_solid,
    xyzr: *const f64,
    count: usize,
    held: *const morula_held,
    options: *const morula_break_options,
    fragments: *mut *mut morula_fragments,
) -> i32 {
    guard(|| {
        let solid = unsafe { borrow(solid, "solid")? };
        require(fragments, "fragments")?;
        require(held, "held")?;
        let old = unsafe { checked_spheres(xyzr, count, "xyzr")? };
        let held = held_of(&unsafe { read(held)? });
        let o = unsafe { read(options)? };
        let o = morula_break_options { kind: MORULA_CUT_WITHIN, ..o };
        let Asked { cut, options, .. } = unsafe { asked(&o)? };
        let run = run_of(&o)?;
        let (parent, found) = reshape(Arc::clone(&solid.inner), &old, &held, &cut, &options, &run)?;
        unsafe { give_logged(fragments, wrap(vec![Arc::new(parent)], &held, found)?) }
    })
}
