//! Calls that make much at once, shapes from images, and what is kept from one call to the next.

use super::calls::{Host, put, tick};
use super::files::look;
use super::serial::{look_at_body, look_at_clump, look_at_fragments};
use super::*;
use std::ptr::{null, null_mut};

impl Host<'_> {
    /// Looks at each part that was made, and frees it.
    unsafe fn parts<T>(
        &self,
        status: i32,
        all: &[*mut T],
        statuses: &[i32],
        look: impl Fn(*mut T),
        free: unsafe extern "C" fn(*mut T),
    ) {
        let first = statuses.iter().find(|s| **s != 0).copied().unwrap_or(0);
        assert!(first == status || statuses.iter().all(|s| *s < 0), "{statuses:?}, {status}");
        for (one, own) in all.iter().zip(statuses) {
            assert_eq!(*own == 0, !one.is_null());
            if !one.is_null() {
                MADE.set(MADE.get() + 1);
                look(*one);
                unsafe { free(*one) };
            }
        }
    }

    unsafe fn solid_options(&mut self) -> morula_solid_options {
        let mut o: morula_solid_options = sized();
        assert!(ok(unsafe { morula_solid_options_init(&mut o, size_of_val(&o)) }));
        o.cells = 2 + self.small(12) as u32;
        o.memory_limit = LIMIT;
        o
    }

    pub(super) unsafe fn many_shapes(&mut self) {
        unsafe {
            let (o, grid) = (self.clump_options(), self.solid_options());
            let shape = self.shape.cast_const();
            let second = if self.input.byte() == 255 { null() } else { shape };
            let (shapes, mut all, mut statuses) = ([shape, second], [null_mut(); 2], [-1; 2]);
            let (from, to) = (shapes.as_ptr(), all.as_mut_ptr());
            let status = morula_clumps_from_shapes(from, 2, &grid, &o, to, statuses.as_mut_ptr());
            ok(status);
            self.parts(status, &all, &statuses, |c| look_at_clump(c), morula_clump_free);
            let counts = [self.small(6), self.small(6)];
            let mut all = [null_mut(); 2];
            let made =
                ok(morula_clumps_from_solid(self.solid, &o, counts.as_ptr(), 2, all.as_mut_ptr()));
            let statuses = [if made { 0 } else { -1 }; 2];
            self.parts(0, &all, &statuses, |c| look_at_clump(c), morula_clump_free);
        }
    }

    pub(super) unsafe fn labels(&mut self) {
        let dims =
            [1 + self.small(5) as usize, 1 + self.small(5) as usize, 1 + self.small(5) as usize];
        let mut labels = vec![0; dims.iter().product()];
        let given = self.input.take(labels.len());
        for (label, b) in labels.iter_mut().zip(given) {
            *label = if *b == 255 { u32::MAX } else { u32::from(b % 4) };
        }
        let (labels, dims) = (labels.as_ptr(), dims.as_ptr());
        let spacing = if self.input.byte() > 200 { self.numbers(3) } else { vec![1.0; 3] };
        let at = spacing.as_ptr();
        unsafe {
            let (mut ids, mut cells, mut boxes) = ([0; 8], [0; 8], [0; 48]);
            let mut borders = [0; 8];
            let mut n = 0;
            ok(morula_labels_count(labels, dims, &mut n));
            ok(morula_labels_copy(
                labels,
                dims,
                8,
                ids.as_mut_ptr(),
                cells.as_mut_ptr(),
                boxes.as_mut_ptr(),
                borders.as_mut_ptr(),
            ));
            let label = self.small(5) as u32;
            put!(
                self.shape,
                morula_shape_free,
                |new| morula_shape_from_label(labels, dims, at, null(), label, null(), new),
                |s| look(s)
            );
            let (o, grid) = (self.clump_options(), self.solid_options());
            let (wanted, mut all, mut statuses) = ([label, 1], [null_mut(); 2], [-1; 2]);
            let status = morula_clumps_from_labels(
                labels,
                dims,
                at,
                null(),
                wanted.as_ptr(),
                2,
                null(),
                &grid,
                &o,
                all.as_mut_ptr(),
                statuses.as_mut_ptr(),
            );
            ok(status);
            self.parts(status, &all, &statuses, |c| look_at_clump(c), morula_clump_free);
            let mut held: morula_held = sized();
            assert!(ok(morula_held_init(&mut held, size_of_val(&held))));
            [held.scale, held.mass] = [1.0, 1.0];
            let mut o: morula_break_options = sized();
            assert!(ok(morula_break_options_init(&mut o, size_of_val(&o))));
            (o.spheres, o.deadline_seconds) = (self.small(6), 0.5);
            put!(
                self.fragments,
                morula_fragments_free,
                |new| morula_fragments_from_labels(
                    labels,
                    dims,
                    at,
                    null(),
                    &grid,
                    null(),
                    0,
                    &held,
                    &o,
                    new
                ),
                |f| look_at_fragments(f)
            );
        }
    }

    pub(super) unsafe fn silhouettes(&mut self) {
        let count = 1 + self.small(3) as usize;
        let sides = [1 + self.small(9) as usize; 3];
        let given = self.input.take(count * sides[0] * sides[0]);
        let mut masks = vec![0; count * sides[0] * sides[0]];
        masks[..given.len()].copy_from_slice(given);
        // Along the axes, unless they are changed.
        let half = sides[0] as f64 / 2.0;
        let mut cameras = vec![0.0; 36];
        for (k, camera) in cameras.chunks_mut(12).enumerate() {
            (camera[(k + 1) % 3], camera[3]) = (half, half);
            (camera[4 + (k + 2) % 3], camera[7], camera[11]) = (half, half, 1.0);
        }
        for _ in 0..self.small(4) {
            cameras[self.input.byte() as usize % 36] = self.input.number();
        }
        let (cells, carve) = (3 + self.small(8) as usize, self.choice(1));
        unsafe {
            put!(
                self.shape,
                morula_shape_free,
                |new| morula_shape_from_silhouettes(
                    count,
                    masks.as_ptr(),
                    sides.as_ptr(),
                    sides.as_ptr(),
                    cameras.as_ptr(),
                    cells,
                    carve,
                    null(),
                    new
                ),
                |s| look(s)
            );
        }
    }

    /// A cache that lives through a few calls.
    pub(super) unsafe fn cache(&mut self) {
        unsafe {
            let mut cache = null_mut();
            let limit = if self.input.byte() & 1 == 0 { LIMIT } else { self.input.word() };
            assert!(ok(morula_cache_new(limit, &mut cache)));
            let n = self.small(4) as usize;
            let (mut xyzr, grid) = (self.numbers(4 * n), self.solid_options());
            let shape = self.shape;
            for again in 0..3 {
                if again == 2 && n > 0 {
                    xyzr[3] = self.input.number();
                }
                put!(
                    self.parent,
                    morula_parent_free,
                    |new| morula_cache_parent(cache, shape, &grid, xyzr.as_ptr(), n, new),
                    |_| ()
                );
            }
            let mut counted: morula_cache_counts = sized();
            assert!(ok(morula_cache_counters(cache, &mut counted)));
            assert!(counted.hits + counted.misses <= 3);
            assert!(ok(morula_cache_clear(cache)));
            morula_cache_free(cache);
        }
    }

    pub(super) unsafe fn sweep(&mut self) {
        unsafe {
            let (o, grid) = (self.clump_options(), self.solid_options());
            let mut c: morula_cost_options = sized();
            assert!(ok(morula_cost_options_init(&mut c, size_of_val(&c))));
            (c.most, c.surface, c.quality_columns) = (1 + self.small(3), 0, 8);
            let mut what: morula_sweep_options = sized();
            assert!(ok(morula_sweep_options_init(&mut what, size_of_val(&what))));
            let small = self.input.byte() < 200;
            let cells = if small { vec![2.0 + self.small(8) as f64] } else { self.numbers(2) };
            let (methods, seconds) = ([o.method, self.choice(16)], [self.input.number(), 0.1]);
            (what.resolutions, what.resolution_count) = (cells.as_ptr(), cells.len());
            (what.methods, what.method_count) = (methods.as_ptr(), 1 + self.small(2) as usize);
            (what.deadlines, what.deadline_count) = (seconds[1..].as_ptr(), 1);
            if self.input.byte() > 200 {
                what.deadlines = seconds.as_ptr();
            }
            let (mut sweep, mut count) = (null_mut(), 0);
            if !ok(morula_sweep_from_shape(self.shape, &grid, &o, &c, &what, &mut sweep)) {
                assert!(sweep.is_null());
                return;
            }
            assert!(ok(morula_sweep_count(sweep, &mut count)));
            let mut lists: Vec<morula_swept> = (0..count).map(|_| sized()).collect();
            assert!(ok(morula_sweep_copy(sweep, count, lists.as_mut_ptr())));
            for list in &lists {
                assert!(!CStr::from_ptr(morula_status_name(list.status)).is_empty());
            }
            for k in 0..=count {
                put!(self.cost, morula_cost_free, |new| morula_sweep_curve(sweep, k, new), |_| ());
            }
            morula_sweep_free(sweep);
        }
    }

    /// What is asked of a price list.
    pub(super) unsafe fn choose(&mut self) {
        unsafe {
            let mut b: morula_cost_bounds = sized();
            assert!(ok(morula_cost_bounds_init(&mut b, size_of_val(&b))));
            b.goal = self.choice(5);
            if self.input.byte() & 1 == 1 {
                [b.mismatch, b.coverage, b.step_cost] =
                    [self.input.number(), self.input.number(), self.input.number()];
            }
            let (mut index, mut text, mut length) = (0, [0; 512], 0);
            ok(morula_cost_choose(self.cost, &b, &mut index, 512, text.as_mut_ptr(), &mut length));
            let cost = self.cost;
            put!(self.clump, morula_clump_free, |new| morula_cost_clump(cost, index, new), |c| {
                look_at_clump(c)
            });
        }
    }

    /// What a solver does with the fragments that it has.
    pub(super) unsafe fn pieces(&mut self) {
        unsafe {
            let (index, n) = (self.small(3) as usize, self.numbers(6));
            let mut xyzr = vec![0.0; 4 * 64];
            let frame = self.choice(2);
            let room = xyzr.as_mut_ptr();
            if ok(morula_fragments_grow(
                self.fragments,
                index,
                n[0],
                n.as_ptr().add(1),
                1,
                n[5],
                frame,
                64,
                room,
            )) {
                finite(&xyzr);
            }
            let fragments = self.fragments;
            put!(
                self.shape,
                morula_shape_free,
                |new| morula_fragments_shape(fragments, index, new),
                |s| look(s)
            );
            let (mut size, mut held) = (0, sized::<morula_held>());
            let p = null();
            if ok(morula_fragments_serialize(fragments, index, 0, null_mut(), &mut size))
                && ok(morula_fragments_held(fragments, index, p, p, p, p, &mut held))
            {
                let mut bytes = vec![0; size];
                let to = bytes.as_mut_ptr();
                assert!(ok(morula_fragments_serialize(fragments, index, size, to, &mut size)));
                let parent = self.parent;
                put!(
                    self.fragments,
                    morula_fragments_free,
                    |new| morula_fragments_deserialize(parent, bytes.as_ptr(), size, &held, new),
                    |f| look_at_fragments(f)
                );
            }
        }
    }

    /// Breaks of two parents at once, and new spheres for the second.
    pub(super) unsafe fn breaks(&mut self) {
        unsafe {
            let mut o: morula_break_options = sized();
            assert!(ok(morula_break_options_init(&mut o, size_of_val(&o))));
            (o.cells, o.spheres, o.seed) = (self.small(5), self.small(6), self.small(9));
            o.deadline_seconds = 0.5;
            self.ticks = i32::from(self.input.byte());
            o.progress = Some(tick);
            o.user = (&raw mut self.ticks).cast();
            let (mut held, p, v) = (sized::<morula_held>(), null(), self.numbers(3));
            if !ok(morula_parent_held(self.parent, 1.0, 1.0, p, p, v.as_ptr(), p, &mut held)) {
                return;
            }
            let parents = [self.parent.cast_const(), null()];
            let count = 1 + self.small(2) as usize;
            let (helds, options) = ([held; 2], [o; 2]);
            let (mut all, mut statuses) = ([null_mut(); 2], [-1; 2]);
            let status = morula_parents_break(
                parents.as_ptr(),
                null(),
                null(),
                helds.as_ptr(),
                options.as_ptr(),
                count,
                all.as_mut_ptr(),
                statuses.as_mut_ptr(),
            );
            ok(status);
            let (all, statuses) = (&all[..count], &statuses[..count]);
            self.parts(status, all, statuses, |f| look_at_fragments(f), morula_fragments_free);
            let (old, solid) = (self.numbers(4), self.solid);
            put!(
                self.fragments,
                morula_fragments_free,
                |new| morula_reclump_shape(solid, old.as_ptr(), 1, &held, &o, new),
                |f| look_at_fragments(f)
            );
        }
    }

    /// A clump put elsewhere, and its time step.
    pub(super) unsafe fn moved(&mut self) {
        let n = self.numbers(12);
        let (mut o, mut c) = (sized::<morula_mass_options>(), sized::<morula_contact_options>());
        let mut t: morula_timestep = sized();
        unsafe {
            assert!(ok(morula_mass_options_init(&mut o, size_of_val(&o))));
            self.masses(&mut o);
            let (clump, at, turn) = (self.clump, n.as_ptr(), n[3..].as_ptr());
            put!(
                self.body,
                morula_body_free,
                |new| morula_clump_transform(clump, &o, n[7], at, turn, new),
                |b| look_at_body(b)
            );
            assert!(ok(morula_contact_options_init(&mut c, size_of_val(&c))));
            [c.stiffness, c.young, c.poisson, c.speed] = [n[8], n[9], n[10], n[11]];
            if ok(morula_clump_timestep(clump, &o, &c, &mut t)) {
                finite(&[t.clump, t.effective_mass, t.stiffness, t.rayleigh, t.overlap]);
                finite(&[t.together]);
            }
        }
    }
}
