//! What must come of each case, as far as that is known.

use morula::ffi::*;
use std::collections::BTreeMap;

/// What must come out.
#[derive(Debug, Clone, Copy)]
pub enum Expect {
    /// A clump.
    Good,
    /// One of these statuses.
    Refused(&'static [i32]),
    /// A clump or any clear status.
    Either,
}

use Expect::{Either, Good, Refused};

const FORMAT: &[i32] = &[MORULA_STATUS_FORMAT];
const NOTHING: &[i32] = &[MORULA_STATUS_FORMAT, MORULA_STATUS_EMPTY];
const INDICES: &[i32] = &[MORULA_STATUS_FORMAT, MORULA_STATUS_INDEX_OUT_OF_RANGE];
const FLAT: &[i32] = &[MORULA_STATUS_ZERO_VOLUME, MORULA_STATUS_OPEN_SURFACE, MORULA_STATUS_EMPTY];
const SEVERAL: &[i32] = &[MORULA_STATUS_SEVERAL_BODIES];
const NUMBERS: &[i32] = &[MORULA_STATUS_NOT_FINITE, MORULA_STATUS_FORMAT];

/// What the manifest of the files says of them, as far as it decides the outcome.
pub fn expectations() -> BTreeMap<&'static str, Expect> {
    BTreeMap::from([
        // Nothing in them, or not what they say.
        ("assimp_empty.ply", Refused(NOTHING)),
        ("assimp_invalid.off", Refused(INDICES)),
        ("assimp_malformed.obj", Refused(INDICES)),
        ("assimp_OutOfMemory.off", Refused(FORMAT)),
        ("trimesh_empty.stl", Refused(NOTHING)),
        ("trimesh_points_ascii.ply", Refused(NOTHING)),
        ("trimesh_stl_empty_ascii.stl", Refused(NOTHING)),
        ("trimesh_stl_empty_bin.stl", Refused(NOTHING)),
        // Without an inside.
        ("assimp_triangle_with_empty_solid.stl", Refused(FLAT)),
        ("assimp_triangle_with_two_solids.stl", Refused(FLAT)),
        ("cgal_degtri_sliding.off", Refused(FLAT)),
        (
            "trimesh_notenoughindices.obj",
            Refused(&[MORULA_STATUS_ZERO_VOLUME, MORULA_STATUS_OPEN_SURFACE, MORULA_STATUS_FORMAT]),
        ),
        // Several bodies, told by their count.
        ("manifold_Offset2.obj", Refused(SEVERAL)),
        ("trimesh_two_objects_mixed_case_names.stl", Refused(SEVERAL)),
        // Odd, but sound.
        ("assimp_sphereWithHole.stl", Good),
        ("cgal_blobby-shuffled.off", Good),
        ("cgal_elephant-with-holes.off", Good),
        ("cgal_mech-holes-shark.off", Good),
        ("cgal_open_cube.off", Good),
        ("cgal_pig.off", Good),
        ("epfl_compare_iphone_lidar.stl", Good),
        ("manifold_self_intersectA.obj", Good),
        ("trimesh_nancolor.obj", Good),
        ("trimesh_negative_indices.obj", Good),
        ("trimesh_suzanne.ply", Good),
        ("trimesh_whitespace.off", Good),
    ])
}

/// Bodies without thin parts, that ten spheres come close to, whatever is wrong with their file.
pub fn compact(name: &str) -> bool {
    let stem = name.rsplit('/').next().unwrap_or(name);
    let starts = [
        "all_ones",
        "anisotropic_ball",
        "ascii_cube",
        "ball_0_255",
        "ball_with_dust",
        "box_unit",
        "cube_quadfan",
        "cube_t_junction",
        "duplicated_faces",
        "inverted_sphere",
        "mixed_winding_sphere",
        "mm_spheroid",
        "open_box",
        "open_hemisphere",
        "open_sphere",
        "overlapping_bodies",
        "sliver_",
        "solid_header",
        "sphere_",
        "tablet_",
        "touch_at_face",
        "unwelded_jitter",
        "zero_area",
    ];
    starts.iter().any(|s| stem.starts_with(s))
}

/// What the index of the generated cases says: "ok …", "named error …", "warn …".
pub fn generated(path: &str, words: &str) -> Expect {
    let name = path.rsplit('/').next().unwrap();
    match name {
        "nan_vertex.stl" | "inf_vertex.stl" => Refused(NUMBERS),
        "single_triangle.stl" | "flat_square_two_sided.stl" => Refused(FLAT),
        "empty_file.stl" | "header_only.stl" | "all_zeros.npy" | "empty_axis.npy"
        | "empty_file.npy" => Refused(NOTHING),
        "truncated.stl" | "count_too_big.stl" | "truncated.npy" => Refused(FORMAT),
        "two_d.npy" => Refused(&[MORULA_STATUS_FORMAT, MORULA_STATUS_UNSUPPORTED]),
        "two_disjoint.stl" | "two_blobs.npy" | "checkerboard.npy" | "diagonal_line_26.npy" => {
            Refused(SEVERAL)
        }
        _ if words == "ok" => Good,
        _ => Either,
    }
}
