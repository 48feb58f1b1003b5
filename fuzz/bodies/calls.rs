//! A sequence of calls as a host might make them: any options, in any order, on whatever handles
//! there are.

use super::files::look;
use super::serial::{look_at_body, look_at_clump};
use super::*;
use std::ffi::c_void;
use std::ptr::{null, null_mut};

/// The last handle of each kind; NULL where there is none yet, which the library refuses.
pub(super) struct Host<'a> {
    pub(super) input: Input<'a>,
    pub(super) shape: *mut morula_shape,
    pub(super) solid: *mut morula_solid,
    pub(super) clump: *mut morula_clump,
    pub(super) body: *mut morula_body,
    pub(super) parent: *mut morula_parent,
    pub(super) fragments: *mut morula_fragments,
    pub(super) cost: *mut morula_cost,
    /// After how many ticks the callback cancels.
    pub(super) ticks: i32,
    pub(super) points: Vec<f64>,
}

pub(super) unsafe extern "C" fn tick(fraction: f64, user: *mut c_void) -> i32 {
    assert!((0.0..=1.0).contains(&fraction));
    let left = unsafe { &mut *user.cast::<i32>() };
    *left -= 1;
    i32::from(*left == 0)
}

/// Puts a new handle in the place of the old one, which is freed.
macro_rules! put {
    ($slot:expr, $free:ident, $call:expr, $look:expr) => {{
        let mut new = null_mut();
        if ok($call(&mut new)) {
            $free($slot);
            $slot = new;
            MADE.set(MADE.get() + 1);
            $look(new);
        } else {
            assert!(new.is_null());
        }
    }};
}
pub(super) use put;

pub fn calls(data: &[u8]) {
    let mut host = Host {
        input: Input(data),
        shape: null_mut(),
        solid: null_mut(),
        clump: null_mut(),
        body: null_mut(),
        parent: null_mut(),
        fragments: null_mut(),
        cost: null_mut(),
        ticks: 0,
        points: Vec::new(),
    };
    for _ in 0..12 {
        if host.input.0.is_empty() {
            break;
        }
        host.points = Vec::new();
        unsafe { host.step() };
    }
    unsafe {
        host.read_all();
        morula_shape_free(host.shape);
        morula_solid_free(host.solid);
        morula_clump_free(host.clump);
        morula_body_free(host.body);
        morula_parent_free(host.parent);
        morula_fragments_free(host.fragments);
        morula_cost_free(host.cost);
    }
}

impl Host<'_> {
    unsafe fn step(&mut self) {
        unsafe {
            // The one call that came later: all other bytes mean what they meant.
            let choice = self.input.byte();
            if choice == 255 {
                return self.grey();
            }
            match choice % 23 {
                0 => self.primitive(),
                1 => self.mesh(),
                2 => self.mask(),
                3 => self.make_solid(),
                4 => self.make_clump(),
                5 => {
                    let mut o: morula_mass_options = sized();
                    assert!(ok(morula_mass_options_init(&mut o, size_of_val(&o))));
                    self.masses(&mut o);
                    let clump = self.clump;
                    put!(
                        self.body,
                        morula_body_free,
                        |new| morula_body_from_clump(clump, &o, new),
                        |b| look_at_body(b)
                    );
                }
                6 => {
                    let numbers: Vec<f64> = self.numbers(8);
                    let (position, quaternion) = (numbers[..3].as_ptr(), numbers[3..7].as_ptr());
                    let (body, scale, density) = (self.body, self.input.number(), numbers[7]);
                    put!(
                        self.body,
                        morula_body_free,
                        |new| morula_body_transform(
                            body, scale, position, quaternion, density, new
                        ),
                        |_| ()
                    );
                }
                7 => self.spheres(),
                8 => {
                    let (solid, clump) = (self.solid, self.clump);
                    put!(
                        self.parent,
                        morula_parent_free,
                        |new| morula_parent_from_clump(solid, clump, 1, new),
                        |_| ()
                    );
                }
                9 => self.fracture(),
                10 => self.export(),
                11 => self.time_step(),
                12 => self.distances(),
                13 => self.prices(),
                14 => self.many_shapes(),
                15 => self.labels(),
                16 => self.silhouettes(),
                17 => self.cache(),
                18 => self.sweep(),
                19 => self.choose(),
                20 => self.pieces(),
                21 => self.breaks(),
                _ => self.moved(),
            }
        }
    }

    pub(super) fn numbers(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.input.number()).collect()
    }

    pub(super) fn small(&mut self, most: u8) -> u64 {
        u64::from(self.input.byte() % most)
    }

    /// Now and then a choice beyond those that there are.
    pub(super) fn choice(&mut self, most: u8) -> i32 {
        i32::from(self.input.byte() % (most + 1)) - i32::from(self.input.byte() == 255)
    }

    unsafe fn primitive(&mut self) {
        let index = self.small(12) as usize;
        let (seed, set) = (self.small(8), self.input.byte());
        let value = if set & 1 == 1 { self.input.number() } else { 1.0 };
        unsafe {
            let name = morula_primitive_name(index);
            let mut key = [0; 64];
            if name.is_null()
                || !ok(morula_primitive_copy_parameter(
                    name,
                    0,
                    64,
                    key.as_mut_ptr(),
                    null_mut(),
                    null_mut(),
                ))
            {
                return;
            }
            let keys = [key.as_ptr()];
            let count = usize::from(set & 1);
            put!(
                self.shape,
                morula_shape_free,
                |new| morula_shape_from_primitive(
                    name,
                    keys.as_ptr(),
                    &value,
                    count,
                    8,
                    seed,
                    null(),
                    new
                ),
                |s| look(s)
            );
        }
    }

    unsafe fn mesh(&mut self) {
        let n = 4 + self.small(12) as usize;
        let vertices = self.numbers(3 * n);
        let faces = 4 + self.small(16) as usize;
        let triangles: Vec<u32> = (0..3 * faces)
            .map(|_| match u32::from(self.input.byte()) {
                255 => u32::MAX,
                b => b % (n as u32 + u32::from(b == 254)),
            })
            .collect();
        let mut o: morula_import_options = sized();
        unsafe {
            assert!(ok(morula_import_options_init(&mut o, size_of_val(&o))));
            o.bodies = self.choice(3);
            o.memory_limit = LIMIT;
            o.index_base = self.choice(1);
            if self.input.byte() > 200 {
                o.weld_tolerance = self.input.number();
                o.length_unit = self.input.number();
            }
            put!(
                self.shape,
                morula_shape_free,
                |new| morula_shape_from_mesh(
                    vertices.as_ptr(),
                    n,
                    triangles.as_ptr(),
                    faces,
                    &o,
                    new
                ),
                |s| look(s)
            );
        }
    }

    unsafe fn mask(&mut self) {
        let dims =
            [1 + self.small(6) as usize, 1 + self.small(6) as usize, 1 + self.small(6) as usize];
        let mut cells = vec![0; dims.iter().product()];
        let given = self.input.take(cells.len());
        for (cell, b) in cells.iter_mut().zip(given) {
            *cell = b & 1;
        }
        let spacing = if self.input.byte() > 200 { self.numbers(3) } else { vec![1.0; 3] };
        unsafe {
            put!(
                self.shape,
                morula_shape_free,
                |new| morula_shape_from_mask(
                    cells.as_ptr(),
                    dims.as_ptr(),
                    spacing.as_ptr(),
                    null(),
                    null(),
                    new
                ),
                |s| look(s)
            );
        }
    }

    unsafe fn make_solid(&mut self) {
        let mut o: morula_solid_options = sized();
        unsafe {
            assert!(ok(morula_solid_options_init(&mut o, size_of_val(&o))));
            o.cells = 2 + self.small(16) as u32;
            o.padding = self.small(6) as u32;
            o.resolution = self.choice(3);
            o.cell_size = self.input.number();
            o.memory_limit = if self.input.byte() == 0 { self.input.word() % LIMIT } else { LIMIT };
            o.threads = 1 + i32::from(self.input.byte() > 250);
            self.ticks = i32::from(self.input.byte());
            o.progress = Some(tick);
            o.user = (&raw mut self.ticks).cast();
            let shape = self.shape;
            put!(
                self.solid,
                morula_solid_free,
                |new| morula_solid_from_shape(shape, &o, new),
                |_| ()
            );
        }
    }

    pub(super) unsafe fn clump_options(&mut self) -> morula_clump_options {
        let mut o: morula_clump_options = sized();
        unsafe {
            assert!(ok(morula_clump_options_init(&mut o, size_of_val(&o))));
        }
        o.method = match self.input.byte() % 12 {
            b @ 0..6 => i32::from(b),
            b @ 6..10 => i32::from(b) + 4,
            10 => MORULA_METHOD_BEST,
            _ => self.choice(20),
        };
        o.spheres = self.small(12);
        o.wants = u32::from(self.input.byte() & 7);
        o.quality_columns = 8;
        if o.method == MORULA_METHOD_BEST || o.method == MORULA_METHOD_INSCRIBED {
            o.effort = MORULA_EFFORT_DRAFT;
        }
        o.deadline_seconds = 0.5;
        let changes = self.input.byte();
        if changes & 1 != 0 {
            o.mismatch = self.input.number();
            o.min_radius = self.input.number();
        }
        if changes & 2 != 0 {
            o.max_radius = self.input.number();
            o.max_protrusion = self.input.number();
            o.overshoot_weight = self.input.number();
            o.smoothness = self.input.number();
        }
        if changes & 4 != 0 {
            o.connected = self.choice(1);
            o.equal_volume = self.choice(1);
            o.symmetry = self.choice(2);
            o.frame = self.choice(2);
            o.confine = self.choice(1);
        }
        if changes & 8 != 0 {
            self.points = self.numbers(8);
            (o.half_spaces, o.half_space_count) = (self.points.as_ptr(), 2);
        }
        if changes & 16 != 0 {
            o.coverage = self.input.number();
            o.tolerance = self.input.number();
            o.overlap = self.input.number();
            o.min_distance = self.input.number();
            o.radius_offset = self.input.number();
        }
        if changes & 32 != 0 {
            o.ends = self.choice(1);
            o.candidates = self.choice(1);
            o.thinning_cells = self.small(24) as u32;
            o.cells_inside = self.small(24) as u32;
        }
        self.ticks = if changes & 64 != 0 { i32::from(self.input.byte()) } else { 0 };
        o.progress = Some(tick);
        o.user = (&raw mut self.ticks).cast();
        o
    }

    unsafe fn make_clump(&mut self) {
        unsafe {
            let o = self.clump_options();
            let solid = self.solid;
            put!(
                self.clump,
                morula_clump_free,
                |new| morula_clump_from_solid(solid, &o, new),
                |c| look_at_clump(c)
            );
        }
    }

    pub(super) fn masses(&mut self, o: &mut morula_mass_options) {
        o.target = self.choice(1);
        o.objective = self.choice(2);
        o.infeasible = self.choice(1);
        if self.input.byte() > 128 {
            [o.density, o.m_min, o.m_max] =
                [self.input.number(), self.input.number(), self.input.number()];
        }
    }
}
