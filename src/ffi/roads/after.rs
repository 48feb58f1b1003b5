//! What a solver asks for once it has a clump: these have no progress, but memory and steps.

use super::*;

fn of_body(body: *const morula_body) -> Vec<u8> {
    let (mut n, mut moments) = (0, sized::<morula_moments>());
    unsafe {
        assert_eq!(morula_body_sphere_count(body, &mut n), 0);
        assert_eq!(morula_body_moments(body, &mut moments), 0);
        let mut masses = vec![0.0; n];
        assert_eq!(morula_body_copy_masses(body, n, masses.as_mut_ptr()), 0);
        masses.push(moments.mass);
        masses.iter().flat_map(|m| m.to_le_bytes()).collect()
    }
}

fn of_files(files: *const morula_files) -> Vec<u8> {
    let (mut n, mut all) = (0, Vec::new());
    unsafe {
        assert_eq!(morula_files_count(files, &mut n), 0);
        for k in 0..n {
            let mut size = 0;
            assert_eq!(morula_files_size(files, k, &mut size), 0);
            let mut bytes = vec![0; size];
            assert_eq!(morula_files_copy_bytes(files, k, size, bytes.as_mut_ptr()), 0);
            all.extend(bytes);
        }
    }
    all
}

fn of_parent(parent: *const morula_parent) -> Vec<u8> {
    let mut bytes = 0;
    assert_eq!(unsafe { morula_parent_bytes(parent, &mut bytes) }, 0);
    bytes.to_le_bytes().to_vec()
}

fn masses(g: &Given, progress: morula_progress, user: *mut c_void) -> morula_mass_options {
    let mut o = options!(morula_mass_options, morula_mass_options_init);
    (o.threads, o.progress, o.user) = (g.threads, progress, user);
    o.infeasible = MORULA_INFEASIBLE_LEAST_ERROR;
    o
}

const SPHERES: [f64; 8] = [0.0, 0.0, 0.0, 0.4, 0.3, 0.0, 0.0, 0.3];

macro_rules! exported {
    ($name:literal, $format:expr) => {
        Call {
            name: $name,
            run: |g, _, _, _| {
                made!(
                    |out| morula_body_export(g.body, $format, null(), out),
                    of_files,
                    morula_files_free
                )
            },
        }
    };
}

pub const ROADS: &[Call] = &[
    Call {
        name: "body_from_spheres",
        run: |g, progress, user, _| {
            let o = masses(g, progress, user);
            let xyzr = SPHERES.as_ptr();
            made!(
                |out| morula_body_from_spheres(xyzr, 2, null(), &o, out),
                of_body,
                morula_body_free
            )
        },
    },
    Call {
        name: "clump_transform",
        run: |g, progress, user, _| {
            let o = masses(g, progress, user);
            let (at, turn) = ([1.0, 2.0, 3.0], [0.6, 0.0, 0.8, 0.0]);
            let (at, turn) = (at.as_ptr(), turn.as_ptr());
            made!(
                |out| morula_clump_transform(g.clump, &o, 2.0, at, turn, out),
                of_body,
                morula_body_free
            )
        },
    },
    Call {
        name: "clump_timestep",
        run: |g, progress, user, _| {
            let (o, mut t) = (masses(g, progress, user), sized::<morula_timestep>());
            let mut c = options!(morula_contact_options, morula_contact_options_init);
            c.stiffness = 1e4;
            let status = unsafe { morula_clump_timestep(g.clump, &o, &c, &mut t) };
            assert!(status == 0 || !message().is_empty());
            (status, (status == 0).then(|| t.clump.to_le_bytes().to_vec()))
        },
    },
    exported!("export, mercury", MORULA_EXPORT_MERCURY),
    exported!("export, lammps", MORULA_EXPORT_LAMMPS),
    exported!("export, json", MORULA_EXPORT_JSON),
    exported!("export, vtp", MORULA_EXPORT_VTP),
    exported!("export, stl", MORULA_EXPORT_STL),
    Call {
        name: "parent_from_solid",
        run: |g, _, _, _| {
            let xyzr = SPHERES.as_ptr();
            made!(
                |out| morula_parent_from_solid(g.solid, xyzr, 2, g.threads, out),
                of_parent,
                morula_parent_free
            )
        },
    },
    Call {
        name: "cache_parent",
        run: |g, _, _, _| {
            let mut cache = null_mut();
            let mut o = grid();
            o.threads = g.threads;
            let status = unsafe { morula_cache_new(1 << 30, &mut cache) };
            assert_eq!(status == 0, !cache.is_null());
            if status != 0 {
                return (status, None);
            }
            let xyzr = SPHERES.as_ptr();
            let one = || {
                made!(
                    |out| morula_cache_parent(cache, g.shape, &o, xyzr, 2, out),
                    of_parent,
                    morula_parent_free
                )
            };
            let first = one();
            // What failed left the cache good.
            let second = in_peace(one);
            assert!(second.0 == 0 && (first.0 != 0 || first.1 == second.1));
            let mut counted = sized::<morula_cache_counts>();
            assert_eq!(unsafe { morula_cache_counters(cache, &mut counted) }, 0);
            assert_eq!((counted.parents, counted.hits), (1, u64::from(first.0 == 0)));
            unsafe { morula_cache_free(cache) };
            first
        },
    },
    Call {
        name: "fragments_shape",
        run: |g, _, _, _| {
            made!(|out| morula_fragments_shape(g.fragments, 0, out), of_shape, morula_shape_free)
        },
    },
    Call {
        name: "fragments_grow",
        run: |g, _, _, _| {
            let (mut one, mut n) = (sized::<morula_fragment>(), 0);
            unsafe {
                assert_eq!(in_peace(|| morula_fragments_get(g.fragments, 0, &mut one)), 0);
                n += one.sphere_count as usize;
            }
            let mut xyzr = vec![0.0; 4 * n];
            let (others, room) = (SPHERES.as_ptr(), xyzr.as_mut_ptr());
            let status = unsafe {
                morula_fragments_grow(
                    g.fragments,
                    0,
                    0.5,
                    others,
                    2,
                    0.0,
                    MORULA_FRAME_INPUT,
                    n,
                    room,
                )
            };
            let bytes = || xyzr.iter().flat_map(|x| x.to_le_bytes()).collect();
            (status, (status == 0).then(bytes))
        },
    },
    Call {
        name: "shape_deserialize",
        run: |g, _, _, _| {
            let bytes = in_peace(|| of_shape(g.shape));
            let (at, size) = (bytes.as_ptr(), bytes.len());
            made!(|out| morula_shape_deserialize(at, size, out), of_shape, morula_shape_free)
        },
    },
    Call {
        name: "clump_deserialize",
        run: |g, _, _, _| {
            let (mut bytes, mut size) = (Vec::new(), 0);
            in_peace(|| unsafe {
                assert_eq!(morula_clump_serialize(g.clump, 0, null_mut(), &mut size), 0);
                bytes.resize(size, 0);
                let room = bytes.as_mut_ptr();
                assert_eq!(morula_clump_serialize(g.clump, size, room, &mut size), 0);
            });
            let at = bytes.as_ptr();
            made!(|out| morula_clump_deserialize(at, size, out), of_clump, morula_clump_free)
        },
    },
];
