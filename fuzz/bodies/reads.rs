//! The rest that handles tell: what is asked of them when nothing went wrong, and grey values.

use super::calls::{Host, put};
use super::files::look;
use super::serial::look_at_clump;
use super::*;
use std::ffi::c_char;
use std::ptr::{null, null_mut};

/// A sentence of a handle's; its length is that of the text.
fn sentence(get: impl FnOnce(usize, *mut c_char, *mut usize) -> i32) {
    let (mut text, mut length) = ([0; 2048], 0);
    if ok(get(text.len(), text.as_mut_ptr(), &mut length)) {
        let said = unsafe { CStr::from_ptr(text.as_ptr()) }.to_str().unwrap();
        assert_eq!(said.len(), length);
    }
}

/// Warnings, note and counters; and the clump again from its bytes, which gives the same bytes.
pub(super) unsafe fn read_clump(clump: *const morula_clump) {
    unsafe {
        let (mut n, mut count, mut size) = (0, 0, 0);
        assert!(ok(morula_clump_sphere_count(clump, &mut n)));
        assert!(ok(morula_clump_warning_count(clump, &mut count)));
        let (mut codes, mut figures) = (vec![0; count], vec![0.0; count]);
        let mut bounds = vec![0.0; count];
        assert!(ok(morula_clump_copy_warnings(
            clump,
            count,
            codes.as_mut_ptr(),
            figures.as_mut_ptr(),
            bounds.as_mut_ptr()
        )));
        finite(&figures);
        finite(&bounds);
        for (i, code) in codes.iter().enumerate() {
            assert_ne!(CStr::from_ptr(morula_warning_name(*code)), c"unknown");
            sentence(|room, text, length| morula_clump_copy_warning(clump, i, room, text, length));
        }
        sentence(|room, text, length| morula_clump_copy_note(clump, room, text, length));
        assert!(ok(morula_clump_counters(clump, &mut sized())));
        let mut contacts = vec![0; 3 * n];
        ok(morula_clump_copy_plane_contacts(clump, contacts.len(), contacts.as_mut_ptr()));
        assert!(ok(morula_clump_serialize(clump, 0, null_mut(), &mut size)));
        let (mut bytes, mut same) = (vec![0; size], vec![0; size]);
        assert!(ok(morula_clump_serialize(clump, size, bytes.as_mut_ptr(), &mut size)));
        let mut again = null_mut();
        assert!(ok(morula_clump_deserialize(bytes.as_ptr(), size, &mut again)));
        assert!(ok(morula_clump_serialize(again, same.len(), same.as_mut_ptr(), &mut size)));
        assert!(bytes == same, "a clump changed on its way through bytes");
        morula_clump_free(again);
    }
}

/// Spheres in single precision, where it can hold them, and which masses are at a bound.
pub(super) unsafe fn read_body(body: *const morula_body) {
    unsafe {
        let (mut n, mut result) = (0, sized::<morula_masses>());
        assert!(ok(morula_body_sphere_count(body, &mut n)));
        for frame in [MORULA_FRAME_INPUT, MORULA_FRAME_BODY] {
            let mut single = vec![0f32; 4 * n];
            if ok(morula_body_copy_spheres_f32(body, frame, n, single.as_mut_ptr())) {
                assert!(single.iter().all(|x| x.is_finite()), "{single:?}");
            }
        }
        assert!(ok(morula_body_masses(body, &mut result)));
        assert_ne!(CStr::from_ptr(morula_masses_status_name(result.status)), c"unknown");
        let mut binding = vec![u32::MAX; result.binding as usize];
        assert!(ok(morula_body_copy_binding(body, binding.len(), binding.as_mut_ptr())));
        assert!(binding.iter().all(|i| (*i as usize) < n), "{binding:?} of {n}");
    }
}

/// Maps, masses and half-spaces of each fragment; dust, totals and notes of the break.
pub(super) unsafe fn read_fragments(fragments: *const morula_fragments) {
    unsafe {
        let (mut count, mut dust, mut notes) = (0, 0, 0);
        let (mut f, mut totals) = (sized::<morula_fragment>(), sized::<morula_break_totals>());
        assert!(ok(morula_fragments_count(fragments, &mut count)));
        for i in 0..count {
            assert!(ok(morula_fragments_get(fragments, i, &mut f)));
            let (n, pairs) = (f.sphere_count as usize, f.map_count as usize);
            let (mut starts, mut parents) = (vec![0; n + 1], vec![0; pairs]);
            let mut shares = vec![0.0; pairs];
            let (from, to) = (starts.as_mut_ptr(), parents.as_mut_ptr());
            let part = shares.as_mut_ptr();
            assert!(ok(morula_fragments_copy_map(fragments, i, from, pairs, to, part)));
            assert!(starts.is_sorted() && starts[n] as usize == pairs, "{starts:?}, {pairs}");
            finite(&shares);
            let mut masses = vec![0.0; n];
            if ok(morula_fragments_copy_masses(fragments, i, n, masses.as_mut_ptr())) {
                finite(&masses);
            }
            let mut planes = vec![0.0; 4 * f.half_space_count as usize];
            let room = f.half_space_count as usize;
            assert!(ok(morula_fragments_copy_half_spaces(fragments, i, room, planes.as_mut_ptr())));
            finite(&planes);
        }
        assert!(ok(morula_fragments_dust_count(fragments, &mut dust)));
        for i in 0..dust {
            assert!(ok(morula_fragments_dust(fragments, i, &mut f)));
            finite(&[f.mass, f.volume]);
            finite(&f.velocity);
        }
        assert!(!ok(morula_fragments_dust(fragments, dust, &mut f)));
        assert!(ok(morula_fragments_totals(fragments, &mut totals)));
        finite(&[totals.energy, totals.inertia_error]);
        finite(&totals.shift);
        assert!(ok(morula_fragments_note_count(fragments, &mut notes)));
        for i in 0..notes {
            sentence(|room, text, len| morula_fragments_copy_note(fragments, i, room, text, len));
        }
    }
}

/// Names and bytes of files.
pub(super) unsafe fn read_files(files: *const morula_files) {
    unsafe {
        let (mut count, mut size) = (0, 0);
        assert!(ok(morula_files_count(files, &mut count)));
        for i in 0..count {
            sentence(|room, text, length| morula_files_copy_name(files, i, room, text, length));
            assert!(ok(morula_files_size(files, i, &mut size)));
            let mut bytes = vec![0; size];
            assert!(ok(morula_files_copy_bytes(files, i, size, bytes.as_mut_ptr())));
        }
    }
}

/// The lines of a price list.
pub(super) unsafe fn read_cost(cost: *const morula_cost) {
    unsafe {
        let (mut count, mut cut) = (0, 0);
        assert!(ok(morula_cost_count(cost, &mut count)));
        assert!(ok(morula_cost_cut(cost, &mut cut)));
        let mut lines: Vec<morula_cost_point> = (0..count).map(|_| sized()).collect();
        assert!(count > 0 && ok(morula_cost_copy(cost, count, lines.as_mut_ptr())));
        for line in &lines {
            assert!(line.spheres > 0, "a line of no sphere");
            assert!(line.mismatch.is_finite(), "a mismatch of {}", line.mismatch);
        }
    }
}

impl Host<'_> {
    /// Asks all handles that there are at the end. No bytes are taken: the others mean what they meant.
    pub(super) unsafe fn read_all(&mut self) {
        unsafe {
            if !self.clump.is_null() {
                read_clump(self.clump);
            }
            if !self.cost.is_null() {
                read_cost(self.cost);
            }
            ok(morula_parent_bytes(self.parent, &mut 0));
            ok(morula_shape_counters(self.shape, &mut sized()));
            ok(morula_solid_counters(self.solid, &mut sized()));
            let (mut dims, mut spacing, mut origin) = ([0; 3], [0.0; 3], [0.0; 3]);
            let (d, s, o) = (dims.as_mut_ptr(), spacing.as_mut_ptr(), origin.as_mut_ptr());
            let mut notes = 0;
            if ok(morula_solid_grid(self.solid, d, s, o)) {
                let told = dims.iter().all(|n| *n > 0) && spacing.iter().all(|h| *h > 0.0);
                assert!(told, "{dims:?}, {spacing:?}");
                finite(&spacing);
                finite(&origin);
                assert!(ok(morula_solid_note_count(self.solid, &mut notes)));
            }
            for i in 0..notes {
                let solid = self.solid;
                sentence(|room, text, length| morula_solid_copy_note(solid, i, room, text, length));
            }
        }
    }

    /// Grey values of each kind, with a threshold or Otsu's; turns; and a clump of what came out.
    pub(super) unsafe fn grey(&mut self) {
        let dims =
            [1 + self.small(6) as usize, 1 + self.small(6) as usize, 1 + self.small(6) as usize];
        let mut values = vec![0u8; dims.iter().product()];
        let given = self.input.take(values.len());
        values[..given.len()].copy_from_slice(given);
        let wide: Vec<u16> = values.iter().map(|v| u16::from(*v) * 257).collect();
        let single: Vec<f32> = values.iter().map(|v| f32::from(*v) / 16.0 - 8.0).collect();
        let mut single = single;
        if self.input.byte() > 200 {
            single[0] = self.input.number() as f32;
        }
        let (limit, choice) = (self.input.number(), self.input.byte());
        let limit = if choice & 1 == 0 { null() } else { &raw const limit };
        let spacing = if choice > 200 { self.numbers(3) } else { vec![1.0; 3] };
        let (d, s, p) = (dims.as_ptr(), spacing.as_ptr(), null());
        let mut turns = [0.0; 12];
        unsafe {
            put!(
                self.shape,
                morula_shape_free,
                |new| match choice / 2 % 3 {
                    0 => morula_shape_from_grey_u8(values.as_ptr(), d, s, p, limit, null(), new),
                    1 => morula_shape_from_grey_u16(wide.as_ptr(), d, s, p, limit, null(), new),
                    _ => morula_shape_from_grey_f32(single.as_ptr(), d, s, p, limit, null(), new),
                },
                |s| look(s)
            );
            assert!(ok(morula_random_orientations(u64::from(choice), 3, turns.as_mut_ptr())));
            finite(&turns);
            let (o, mut grid) = (self.clump_options(), sized::<morula_solid_options>());
            assert!(ok(morula_solid_options_init(&mut grid, size_of_val(&grid))));
            (grid.cells, grid.memory_limit) = (2 + self.small(12) as u32, LIMIT);
            let shape = self.shape;
            put!(
                self.clump,
                morula_clump_free,
                |new| morula_clump_from_shape(shape, &grid, &o, new),
                |c| look_at_clump(c)
            );
        }
    }
}
