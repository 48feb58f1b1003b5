//! What options hold before the caller sets them, and the size that each struct
//! had in the first release.

use super::choices::*;
use super::cost_structs::*;
use super::fragment_structs::*;
use super::mass_structs::*;
use super::options::Versioned;
use super::structs::*;

macro_rules! versioned {
    ($name:ident, $first:expr $(, added $($end:expr),*)?; $defaults:expr) => {
        unsafe impl Versioned for $name {
            const NAME: &'static str = stringify!($name);
            const FIRST: usize = $first;
            $(const ADDED: &'static [usize] = &[$($end),*];)?
            fn defaults() -> Self {
                $defaults
            }
        }
        // On 64-bit systems, where sizes are part of the promise.
        #[cfg(target_pointer_width = "64")]
        const _: () = assert!(size_of::<$name>() >= $first);
    };
}

versioned!(
    morula_import_options, 64;
    morula_import_options {
        struct_size: size_of::<Self>(),
        weld_tolerance: 1e-6,
        length_unit: 1.0,
        memory_limit: 2 << 30,
        bodies: MORULA_BODIES_REFUSE,
        index_base: 0,
        threads: 1,
        reserved: 0,
        progress: None,
        user: std::ptr::null_mut(),
    }
);
versioned!(
    morula_file_options, 120;
    morula_file_options {
        struct_size: size_of::<Self>(),
        format: MORULA_FORMAT_AUTO,
        meaning: MORULA_MEANING_AUTO,
        threshold: 0.0,
        label: 1,
        npy_xyz: 0,
        spacing: [1.0; 3],
        origin: [0.0; 3],
        raw_dims: [0; 3],
        raw_skip: 0,
        raw_type: MORULA_RAW_U8,
        reserved: 0,
    }
);
versioned!(
    morula_solid_options, 56;
    morula_solid_options {
        struct_size: size_of::<Self>(),
        resolution: MORULA_RESOLUTION_CELLS_LONGEST,
        cells: 64,
        cell_size: 0.0,
        memory_limit: 2 << 30,
        padding: 4,
        threads: 1,
        progress: None,
        user: std::ptr::null_mut(),
    }
);
versioned!(
    morula_clump_options, 120, added 128, 152, 168, 240;
    morula_clump_options {
        struct_size: size_of::<Self>(),
        spheres: 50,
        mismatch: 0.0,
        min_radius: 0.0,
        min_distance: 0.0,
        radius_offset: 0.0,
        deadline_seconds: 0.0,
        seed: 0,
        method: MORULA_METHOD_BEST,
        confine: 0,
        threads: 1,
        frame: MORULA_FRAME_INPUT,
        wants: MORULA_WANT_MOMENTS,
        quality_columns: 0,
        plane_tolerances: std::ptr::null(),
        plane_tolerance_count: 0,
        progress: None,
        user: std::ptr::null_mut(),
        effort: MORULA_EFFORT_NORMAL,
        reserved: 0,
        coverage: 0.0,
        ends: MORULA_ENDS_SURFACE,
        candidates: MORULA_CANDIDATES_THINNED,
        thinning_cells: 60,
        cells_inside: 50,
        tolerance: 0.0,
        overlap: crate::generate::OVERLAP,
        overshoot_weight: 1.0,
        max_protrusion: 0.0,
        max_radius: 0.0,
        smoothness: 0.0,
        connected: 0,
        equal_volume: 0,
        symmetry: MORULA_SYMMETRY_NONE,
        symmetry_plane_count: 0,
        half_spaces: std::ptr::null(),
        half_space_count: 0,
        symmetry_planes: std::ptr::null(),
    }
);
versioned!(
    morula_mass_options, 64;
    morula_mass_options {
        struct_size: size_of::<Self>(),
        density: 1.0,
        m_min: -1.0,
        m_max: 0.0,
        target: MORULA_TARGET_SOLID,
        objective: MORULA_OBJECTIVE_EVEN,
        infeasible: MORULA_INFEASIBLE_REFUSE,
        threads: 1,
        progress: None,
        user: std::ptr::null_mut(),
    }
);
versioned!(
    morula_contact_options, 48;
    morula_contact_options {
        struct_size: size_of::<Self>(),
        stiffness: 0.0,
        young: 0.0,
        poisson: 0.3,
        speed: 1.0,
        contacts: 1,
        reserved: 0,
    }
);
versioned!(
    morula_export_options, 40, added 48;
    morula_export_options {
        struct_size: size_of::<Self>(),
        length: 1.0,
        mass: 1.0,
        placed: 0,
        facets: 3,
        name: std::ptr::null(),
        precision: MORULA_PRECISION_F64,
        reserved: 0,
    }
);
versioned!(
    morula_break_options, 224;
    morula_break_options {
        struct_size: size_of::<Self>(),
        half_spaces: std::ptr::null(),
        half_space_count: 0,
        points: std::ptr::null(),
        weights: std::ptr::null(),
        point_count: 0,
        walls: std::ptr::null(),
        wall_count: 0,
        cells: 4,
        point: [0.0; 3],
        direction: [1.0, 0.0, 0.0],
        seed: 0,
        least_volume: 0.0,
        spheres: 20,
        min_radius: 0.0,
        gap: 0.0,
        m_min: -1.0,
        deadline_seconds: 0.0,
        kind: MORULA_CUT_SEEDED,
        within_union: 1,
        precision: MORULA_PRECISION_F64,
        quality: 1,
        masses: 0,
        objective: MORULA_OBJECTIVE_EVEN,
        infeasible: MORULA_INFEASIBLE_REFUSE,
        threads: 1,
        progress: None,
        user: std::ptr::null_mut(),
    }
);
versioned!(
    morula_held, 200;
    morula_held {
        struct_size: size_of::<Self>(),
        mass: 0.0,
        centre: [0.0; 3],
        inertia: [0.0; 6],
        scale: 1.0,
        position: [0.0; 3],
        quaternion: [1.0, 0.0, 0.0, 0.0],
        velocity: [0.0; 3],
        angular_velocity: [0.0; 3],
    }
);
versioned!(
    morula_cost_options, 120;
    morula_cost_options {
        struct_size: size_of::<Self>(),
        counts: std::ptr::null(),
        count: 0,
        most: 100,
        seconds: 0.0,
        density: 1.0,
        contact: std::ptr::null(),
        step: crate::cost::StepModel::LAMMPS.step,
        lists: crate::cost::StepModel::LAMMPS.lists,
        rebuild: crate::cost::StepModel::LAMMPS.rebuild,
        levels: MORULA_LEVELS_FREE,
        surface: 1,
        masses: 1,
        quality_columns: 0,
    }
);
versioned!(
    morula_cost_bounds, 72;
    morula_cost_bounds {
        struct_size: size_of::<Self>(),
        spheres: 0,
        mismatch: 0.0,
        coverage: 0.0,
        surface: 0.0,
        seconds: 0.0,
        step_cost: 0.0,
        time_cost: 0.0,
        goal: MORULA_GOAL_KNEE,
        reserved: 0,
    }
);
versioned!(
    morula_sweep_options, 64;
    morula_sweep_options {
        struct_size: size_of::<Self>(),
        resolutions: std::ptr::null(),
        resolution_count: 0,
        methods: std::ptr::null(),
        efforts: std::ptr::null(),
        method_count: 0,
        deadlines: std::ptr::null(),
        deadline_count: 0,
    }
);
/// All-zero structs: every field of these is a number.
macro_rules! filled {
    ($($name:ident $first:literal $($end:literal)*),*) => {$(
        versioned!($name, $first, added $($end),*; unsafe { std::mem::zeroed() });
    )*};
}
filled!(
    morula_report 216, morula_moments 232, morula_overlap 112, morula_surface 64 80,
    morula_counters 112, morula_masses 80, morula_timestep 56 64,
    morula_fragment 368, morula_break_totals 48, morula_cost_point 168, morula_swept 80, morula_cache_counts 48
);

#[cfg(all(test, target_pointer_width = "64"))]
mod tests {
    use super::*;

    /// The size of today's struct is the last that is listed.
    fn listed<T: Versioned>() {
        assert_eq!(size_of::<T>(), *T::ADDED.last().unwrap_or(&T::FIRST), "{}", T::NAME);
    }

    #[test]
    fn what_was_appended_since_the_first_release_is_listed() {
        listed::<morula_import_options>();
        listed::<morula_file_options>();
        listed::<morula_solid_options>();
        listed::<morula_clump_options>();
        listed::<morula_report>();
        listed::<morula_moments>();
        listed::<morula_overlap>();
        listed::<morula_surface>();
        listed::<morula_counters>();
        listed::<morula_mass_options>();
        listed::<morula_masses>();
        listed::<morula_contact_options>();
        listed::<morula_timestep>();
        listed::<morula_export_options>();
        listed::<morula_break_options>();
        listed::<morula_held>();
        listed::<morula_fragment>();
        listed::<morula_break_totals>();
        listed::<morula_cache_counts>();
        listed::<morula_cost_options>();
        listed::<morula_cost_point>();
        listed::<morula_cost_bounds>();
        listed::<morula_sweep_options>();
        listed::<morula_swept>();
    }
}
