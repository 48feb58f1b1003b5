//! The main road for one file through the C ABI, and whether what came out is a clump.

use morula::ffi::*;
use std::ffi::{CStr, CString};
use std::path::Path;

/// What one case gave.
#[derive(Debug, Clone, Default)]
pub struct Outcome {
    pub status: i32,
    pub message: String,
    pub spheres: usize,
    pub mismatch: f64,
    /// Most memory that the process of the case held.
    pub peak_kib: u64,
    /// What is wrong with the clump itself; empty when it is good.
    pub fault: String,
}

impl Outcome {
    pub fn name(&self) -> String {
        unsafe { CStr::from_ptr(morula_status_name(self.status)) }.to_str().unwrap().to_owned()
    }
}

pub fn failed(status: i32) -> Outcome {
    let message = unsafe { CStr::from_ptr(morula_last_error_message()) };
    let message = message.to_str().unwrap().to_owned();
    Outcome { status, message, ..Outcome::default() }
}

/// The main road for one file: shape, clump, spheres, all figures.
pub unsafe fn road(path: &Path, bodies: i32, full: bool) -> Outcome {
    unsafe {
        let path = CString::new(path.to_str().unwrap()).unwrap();
        let mut import: morula_import_options = std::mem::zeroed();
        let mut solid: morula_solid_options = std::mem::zeroed();
        let mut options: morula_clump_options = std::mem::zeroed();
        assert_eq!(morula_import_options_init(&mut import, size_of_val(&import)), 0);
        assert_eq!(morula_solid_options_init(&mut solid, size_of_val(&solid)), 0);
        assert_eq!(morula_clump_options_init(&mut options, size_of_val(&options)), 0);
        import.bodies = bodies;
        if !full {
            solid.cells = 32;
            options.spheres = 10;
            options.deadline_seconds = 2.0;
        }
        let mut shape = std::ptr::null_mut();
        let status = morula_shape_from_file(path.as_ptr(), &import, std::ptr::null(), &mut shape);
        if status != 0 {
            assert!(shape.is_null());
            return failed(status);
        }
        let outcome = clump_of(shape, &solid, &mut options);
        morula_shape_free(shape);
        outcome
    }
}

/// A clump of the shape with every figure wanted, judged.
pub unsafe fn clump_of(
    shape: *const morula_shape,
    solid: *const morula_solid_options,
    options: &mut morula_clump_options,
) -> Outcome {
    unsafe {
        let mut report: morula_report = std::mem::zeroed();
        report.struct_size = size_of_val(&report);
        assert_eq!(morula_shape_report(shape, &mut report), 0);
        let planes = [0.0, 0.01, 0.1, 10.0].map(|t| t * longest_edge(&report));
        options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS;
        options.plane_tolerances = planes.as_ptr();
        options.plane_tolerance_count = planes.len();
        let mut clump = std::ptr::null_mut();
        let status = morula_clump_from_shape(shape, solid, options, &mut clump);
        if status != 0 {
            assert!(clump.is_null());
            return failed(status);
        }
        let outcome = judge(&report, clump, planes.len());
        morula_clump_free(clump);
        outcome
    }
}

fn longest_edge(report: &morula_report) -> f64 {
    (0..3).map(|a| report.box_max[a] - report.box_min[a]).fold(0.0, f64::max)
}

/// Whether a clump is one: finite, positive radii, about where the shape is, with figures
/// that can be.
unsafe fn judge(report: &morula_report, clump: *const morula_clump, planes: usize) -> Outcome {
    unsafe {
        let mut n = 0;
        assert_eq!(morula_clump_sphere_count(clump, &mut n), 0);
        let mut xyzr = vec![[0.0; 4]; n];
        assert_eq!(morula_clump_copy_spheres(clump, n, xyzr.as_mut_ptr().cast()), 0);
        let mut overlap: morula_overlap = std::mem::zeroed();
        let mut surface: morula_surface = std::mem::zeroed();
        let mut moments: morula_moments = std::mem::zeroed();
        overlap.struct_size = size_of_val(&overlap);
        surface.struct_size = size_of_val(&surface);
        moments.struct_size = size_of_val(&moments);
        let mut areas = vec![f64::NAN; n];
        let mut touched = vec![u32::MAX; planes];
        let measured = [
            morula_clump_overlap(clump, &mut overlap),
            morula_clump_surface(clump, &mut surface),
            morula_clump_copy_exposed_areas(clump, n, areas.as_mut_ptr()),
            morula_clump_copy_plane_contacts(clump, planes, touched.as_mut_ptr()),
            morula_clump_moments(clump, 2.0, &mut moments),
        ];
        let fault = if n == 0 {
            "no sphere".into()
        } else if measured != [0; 5] {
            format!("not everything was measured: {measured:?}")
        } else {
            spheres_at_fault(report, &xyzr)
                .or_else(|| volumes_at_fault(&overlap, &moments))
                .or_else(|| surface_at_fault(report, &surface, &xyzr, &areas))
                .or_else(|| planes_at_fault(&touched, n))
                .unwrap_or_default()
        };
        Outcome { spheres: n, mismatch: overlap.mismatch, fault, ..Outcome::default() }
    }
}

fn spheres_at_fault(report: &morula_report, xyzr: &[[f64; 4]]) -> Option<String> {
    let edge = longest_edge(report);
    xyzr.iter().enumerate().find_map(|(i, s)| {
        let inside = (0..3).all(|a| {
            s[a] >= report.box_min[a] - 0.1 * edge && s[a] <= report.box_max[a] + 0.1 * edge
        });
        let good = s.iter().all(|v| v.is_finite()) && s[3] > 0.0 && s[3] <= edge && inside;
        (!good).then(|| format!("sphere {i} is {s:?}"))
    })
}

fn volumes_at_fault(o: &morula_overlap, m: &morula_moments) -> Option<String> {
    let figures = [
        [o.mismatch, o.error_bound, o.eta, o.iou, o.coverage, o.overshoot],
        [o.target_volume, o.union_volume, o.volume_error, o.centroid_error, 0.0, 0.0],
    ];
    let body = [m.mass, m.principal[0], m.quaternion[0], m.centre[0], m.relative_error];
    let all = figures.iter().flatten().chain(&o.moment_errors).chain(&body);
    let good = all.into_iter().all(|v| v.is_finite())
        && m.mass > 0.0
        && [o.mismatch, o.coverage, o.iou].iter().all(|v| (0.0..=1.0).contains(v))
        && [o.error_bound, o.eta, o.overshoot].iter().all(|v| *v >= 0.0);
    (!good).then(|| format!("{figures:?}, moments {:?}, body {body:?}", o.moment_errors))
}

fn surface_at_fault(
    report: &morula_report,
    s: &morula_surface,
    xyzr: &[[f64; 4]],
    areas: &[f64],
) -> Option<String> {
    let lengths = [s.protrusion, s.rms_distance, s.hausdorff, s.distance_bound];
    let most = 4.0 * longest_edge(report);
    let good = lengths.iter().all(|v| v.is_finite() && (0.0..=most).contains(v))
        && s.hausdorff >= s.rms_distance
        && s.hausdorff >= s.protrusion
        && (0.0..=std::f64::consts::PI).contains(&s.roughness)
        && s.samples > 0;
    if !good {
        return Some(format!("lengths {lengths:?}, roughness {}, {}", s.roughness, s.samples));
    }
    let whole = |s: &[f64; 4]| 4.0 * std::f64::consts::PI * s[3] * s[3];
    let odd = areas.iter().zip(xyzr).position(|(a, s)| !(0.0..=1.001 * whole(s)).contains(a));
    let unseen = areas.iter().filter(|a| **a == 0.0).count();
    match odd {
        Some(i) => Some(format!("sphere {i} of {:?} has the exposed area {}", xyzr[i], areas[i])),
        None if unseen != s.never_exposed as usize || unseen == areas.len() => {
            Some(format!("{unseen} areas are 0, {} spheres never exposed", s.never_exposed))
        }
        None => None,
    }
}

/// One plane touches at least one sphere, more the farther it reaches, and in the end all.
fn planes_at_fault(touched: &[u32], spheres: usize) -> Option<String> {
    let good = touched.first().is_some_and(|&t| t >= 1)
        && touched.is_sorted()
        && touched.last().is_some_and(|&t| t as usize == spheres);
    (!good).then(|| format!("planes touch {touched:?} of {spheres} spheres"))
}
