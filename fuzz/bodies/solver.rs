//! The calls on solids, bodies and parents: what a solver asks for once it has a clump.

use super::calls::{Host, put, tick};
use super::reads::read_files;
use super::serial::{look_at_body, look_at_fragments};
use super::*;
use std::ptr::{null, null_mut};

impl Host<'_> {
    pub(super) unsafe fn spheres(&mut self) {
        let n = self.small(6) as usize;
        let xyzr = self.numbers(4 * n);
        let mut o: morula_mass_options = sized();
        unsafe {
            assert!(ok(morula_mass_options_init(&mut o, size_of_val(&o))));
            self.masses(&mut o);
            let solid = if self.input.byte() & 1 == 0 { null() } else { self.solid.cast_const() };
            put!(
                self.body,
                morula_body_free,
                |new| morula_body_from_spheres(xyzr.as_ptr(), n, solid, &o, new),
                |b| look_at_body(b)
            );
        }
    }

    pub(super) unsafe fn fracture(&mut self) {
        let mut o: morula_break_options = sized();
        let mut held: morula_held = sized();
        let (planes, points) = (self.numbers(8), self.numbers(9));
        unsafe {
            assert!(ok(morula_break_options_init(&mut o, size_of_val(&o))));
            o.kind = self.choice(4);
            (o.half_spaces, o.half_space_count) = (planes.as_ptr(), 2);
            (o.points, o.point_count) = (points.as_ptr(), 3);
            if self.input.byte() > 200 {
                (o.walls, o.wall_count) = (planes.as_ptr(), 1);
                o.weights = points[3..].as_ptr();
                [o.least_volume, o.min_radius, o.gap] = [points[6], points[7], points[8]];
            }
            o.point = [points[0], points[1], points[2]];
            o.cells = self.small(6);
            o.seed = self.small(4);
            o.spheres = self.small(8);
            o.masses = self.choice(1);
            o.infeasible = self.choice(1);
            o.within_union = self.choice(1);
            o.precision = self.choice(1);
            o.deadline_seconds = 0.5;
            self.ticks = i32::from(self.input.byte());
            o.progress = Some(tick);
            o.user = (&raw mut self.ticks).cast();
            let numbers = self.numbers(3);
            let again = self.input.byte() & 1 == 1 && !self.fragments.is_null();
            let (parent, from, index) = if again {
                let index = self.small(4) as usize;
                let p = null();
                if !ok(morula_fragments_held(self.fragments, index, p, p, p, p, &mut held)) {
                    return;
                }
                (null(), self.fragments.cast_const(), index)
            } else {
                let (p, velocity) = (null(), numbers.as_ptr());
                if !ok(morula_parent_held(self.parent, 1.0, 1.0, p, p, velocity, p, &mut held)) {
                    return;
                }
                (self.parent.cast_const(), null(), 0)
            };
            put!(
                self.fragments,
                morula_fragments_free,
                |new| morula_parent_break(parent, from, index, &held, &o, new),
                |f| look_at_fragments(f)
            );
        }
    }

    pub(super) unsafe fn export(&mut self) {
        let mut o: morula_export_options = sized();
        let mut files = null_mut();
        unsafe {
            assert!(ok(morula_export_options_init(&mut o, size_of_val(&o))));
            o.facets = self.small(3) as u32;
            o.placed = self.choice(1);
            o.precision = self.choice(1);
            if self.input.byte() > 200 {
                [o.length, o.mass] = [self.input.number(), self.input.number()];
            }
            if ok(morula_body_export(self.body, self.choice(15), &o, &mut files)) {
                let mut count = 0;
                assert!(ok(morula_files_count(files, &mut count)));
                assert!(count > 0);
                read_files(files);
                morula_files_free(files);
            }
        }
    }

    pub(super) unsafe fn time_step(&mut self) {
        let mut o: morula_contact_options = sized();
        let mut t: morula_timestep = sized();
        let n = self.numbers(4);
        unsafe {
            assert!(ok(morula_contact_options_init(&mut o, size_of_val(&o))));
            [o.stiffness, o.young, o.poisson, o.speed] = [n[0], n[1], n[2], n[3]];
            if ok(morula_body_timestep(self.body, &o, &mut t)) {
                finite(&[t.clump, t.effective_mass, t.stiffness, t.rayleigh, t.overlap]);
            }
        }
    }

    pub(super) unsafe fn distances(&mut self) {
        let points = self.numbers(6);
        let mut distances = [0.0; 2];
        unsafe {
            if ok(morula_solid_distance(self.solid, 2, points.as_ptr(), distances.as_mut_ptr())) {
                finite(&distances);
            }
            let mut moments: morula_moments = sized();
            if ok(morula_solid_moments(self.solid, points[0], &mut moments)) {
                moments_are_real(&moments);
            }
        }
    }

    pub(super) unsafe fn prices(&mut self) {
        unsafe {
            let o = self.clump_options();
            let mut c: morula_cost_options = sized();
            assert!(ok(morula_cost_options_init(&mut c, size_of_val(&c))));
            c.most = 1 + self.small(4);
            c.quality_columns = 8;
            c.surface = 0;
            let solid = self.solid;
            put!(self.cost, morula_cost_free, |new| morula_cost_curve(solid, &o, &c, new), |_| ());
        }
    }
}
