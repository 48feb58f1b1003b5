//! Shapes from silhouettes, rendered here by tracing the ray of each pixel.

#![allow(clippy::unwrap_used)]

use morula::math::Vec3;
use morula::shape::{Body, Carve, ImportOptions, Silhouette, Voxels};
use morula::{Error, Run, Shape, Sphere};
use nalgebra::Matrix3;

const WIDTH: usize = 160;
const HEIGHT: usize = 140;

/// A camera at `from` that looks at `at`: its matrix, its centre, and the ray of a pixel.
struct Camera {
    matrix: [f64; 12],
    center: Vec3,
    back: Matrix3<f64>,
}

impl Camera {
    fn new(from: Vec3, at: Vec3, focal: f64) -> Camera {
        let z = (at - from).normalize();
        let x = z.cross(&Vec3::new(0.2, 0.3, 0.9)).normalize();
        let turn = Matrix3::from_rows(&[x.transpose(), z.cross(&x).transpose(), z.transpose()]);
        let inner = Matrix3::new(
            focal,
            0.0,
            WIDTH as f64 / 2.0,
            0.0,
            focal,
            HEIGHT as f64 / 2.0,
            0.0,
            0.0,
            1.0,
        );
        let left = inner * turn;
        let right = -(left * from);
        let entry = |k: usize| if k % 4 < 3 { left[(k / 4, k % 4)] } else { right[k / 4] };
        let back = left.try_inverse().unwrap();
        Camera { matrix: std::array::from_fn(entry), center: from, back }
    }

    /// Pixels of which some part shows one of the spheres, to a quarter of a pixel.
    fn see(&self, body: &[Sphere]) -> Vec<u8> {
        let mut mask = Vec::new();
        for n in 0..WIDTH * HEIGHT {
            let hit = (0..25).any(|k| {
                let at = [n % WIDTH, n / WIDTH];
                let u = at[0] as f64 + (k % 5) as f64 / 4.0;
                let v = at[1] as f64 + (k / 5) as f64 / 4.0;
                let ray = (self.back * Vec3::new(u, v, 1.0)).normalize();
                body.iter().any(|s| {
                    let to = s.center - self.center;
                    (to - ray * to.dot(&ray)).norm() <= s.radius
                })
            });
            mask.push(u8::from(hit));
        }
        mask
    }
}

/// Directions spread over the sphere, the first ones as well as all.
fn directions() -> Vec<Vec3> {
    let t = (1.0 + 5f64.sqrt()) / 2.0;
    let first = [[1.0, 0.1, 0.2], [-0.1, 1.0, 0.15], [0.1, -0.2, 1.0]];
    let next = [[t, 1.0, -0.4], [-1.0, t, 0.9], [0.6, -1.2, t]];
    let last = [
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
        [1.0, 1.0, -1.0],
        [t, 0.0, 1.0],
        [0.0, -t, 1.0],
    ];
    first.iter().chain(&next).chain(&last).map(|d| Vec3::from(*d).normalize()).collect()
}

fn cameras(body: &[Sphere], size: f64) -> Vec<Camera> {
    let at = body.iter().map(|s| s.center).sum::<Vec3>() / body.len() as f64;
    directions().iter().map(|d| Camera::new(at + d * (4.0 * size), at, 200.0)).collect()
}

fn hull(cameras: &[Camera], masks: &[Vec<u8>], cells: usize, carve: Carve) -> Shape {
    let seen: Vec<Silhouette> = cameras
        .iter()
        .zip(masks)
        .map(|(c, mask)| Silhouette { mask, width: WIDTH, height: HEIGHT, camera: c.matrix })
        .collect();
    let options = ImportOptions::default();
    Shape::from_silhouettes(&seen, cells, carve, &options, &Run::serial()).unwrap()
}

fn solid_at(v: &Voxels, p: &Vec3) -> bool {
    let c = [0, 1, 2].map(|a| (p[a] / v.spacing[a]).floor());
    (0..3).all(|a| c[a] >= 0.0 && c[a] < v.dims[a] as f64)
        && v.cells[c[0] as usize + v.dims[0] * (c[1] as usize + v.dims[1] * c[2] as usize)] != 0
}

/// Points all over the spheres' surfaces, the hidden ones too.
fn points(body: &[Sphere]) -> Vec<Vec3> {
    let on = |s: &Sphere| {
        let s = *s;
        (0..2000).map(move |i| {
            let z = (2 * i + 1) as f64 / 2000.0 - 1.0;
            let (sin, cos) = (2.399963 * i as f64).sin_cos();
            let t = (1.0 - z * z).sqrt();
            s.center + Vec3::new(t * cos, t * sin, z) * s.radius
        })
    };
    body.iter().flat_map(on).collect()
}

/// Volume of a union by counting.
fn volume(body: &[Sphere]) -> f64 {
    let r = Vec3::repeat(2.0);
    let (at, n) = (body[0].center, 120);
    let step = 4.0 / n as f64;
    let inside = (0..n * n * n).filter(|i| {
        let c = Vec3::new((i % n) as f64, (i / n % n) as f64, (i / n / n) as f64);
        let p = at - r + (c + Vec3::repeat(0.5)) * step;
        body.iter().any(|s| s.contains(&p))
    });
    inside.count() as f64 * step.powi(3)
}

#[test]
fn the_hull_contains_the_body_and_its_excess_falls_with_more_cameras() {
    let bodies: [&[Sphere]; 2] = [
        &[Sphere { center: Vec3::new(5.0, -2.0, 9.0), radius: 1.0 }],
        &[
            Sphere { center: Vec3::new(0.0, 0.0, 0.0), radius: 0.8 },
            Sphere { center: Vec3::new(0.9, 0.3, 0.1), radius: 0.5 },
            Sphere { center: Vec3::new(-0.2, 0.9, 0.4), radius: 0.45 },
        ],
    ];
    for body in bodies {
        let true_volume = volume(body);
        let all = cameras(body, 1.5);
        let masks: Vec<Vec<u8>> = all.iter().map(|c| c.see(body)).collect();
        let mut last = f64::MAX;
        for n in [2, 3, 6, 12] {
            let shape = hull(&all[..n], &masks[..n], 48, Carve::Touched);
            let Body::Voxels(voxels) = &*shape.body else { panic!() };
            for p in points(body) {
                assert!(solid_at(voxels, &shape.frame.to_unit(&p)), "{n} cameras: {p}");
            }
            let excess = shape.report.volume / true_volume - 1.0;
            assert!(excess > 0.0 && excess < 0.97 * last, "{n} cameras: {excess} {last}");
            last = excess;
            assert!(!shape.report.touches_border);
            assert!(shape.report.notes.iter().all(|n| n.contains("speck")));
            // By centres it is closer, and no cell stays that the other way would not keep.
            let centres = hull(&all[..n], &masks[..n], 48, Carve::Centres);
            assert!(centres.report.volume < shape.report.volume);
            let close = centres.report.volume / true_volume - 1.0;
            assert!(n < 6 || (0.0..0.25).contains(&close), "{n} cameras: {close}");
        }
        assert!(last < 0.32, "{last}");
    }
}

#[test]
fn the_same_cells_stay_for_any_number_of_threads_and_in_any_unit() {
    let body = [Sphere::new(Vec3::new(0.3, 0.2, 0.1), 1.0)];
    let make = |threads: usize, by: f64| {
        let body = body.map(|s| Sphere::new(s.center * by, s.radius * by));
        let all = cameras(&body, 1.2 * by);
        let masks: Vec<Vec<u8>> = all[..3].iter().map(|c| c.see(&body)).collect();
        let seen: Vec<Silhouette> = (0..3)
            .map(|i| Silhouette {
                mask: &masks[i],
                width: WIDTH,
                height: HEIGHT,
                camera: all[i].matrix,
            })
            .collect();
        let run = Run::new(threads).unwrap();
        let o = ImportOptions::default();
        let shape = Shape::from_silhouettes(&seen, 40, Carve::Touched, &o, &run).unwrap();
        let Body::Voxels(v) = &*shape.body else { panic!() };
        (v.dims, v.cells.clone())
    };
    let one = make(1, 1.0);
    assert_eq!(one, make(2, 1.0));
    assert_eq!(one, make(8, 1.0));
    for k in [-30, 30] {
        assert_eq!(one, make(1, 2f64.powi(k)));
    }
}

/// Along z and along x, without perspective: what is seen at x + 1, y + 1 and z + 1, y + 1.
const FRONT: [f64; 12] = [1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
const SIDE: [f64; 12] = [0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

fn pair<'a>(front: &'a [u8], side: &'a [u8]) -> [Silhouette<'a>; 2] {
    let of = |mask, width, camera| Silhouette { mask, width, height: 3, camera };
    [of(front, 4, FRONT), of(side, 5, SIDE)]
}

const BOX: ([u8; 12], [u8; 15]) =
    ([0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0]);

fn carved(seen: &[Silhouette], cells: usize) -> morula::Result<Shape> {
    let options = ImportOptions::default();
    Shape::from_silhouettes(seen, cells, Carve::Centres, &options, &Run::serial())
}

#[test]
fn cameras_without_perspective_carve_a_box() {
    let shape = carved(&pair(&BOX.0, &BOX.1), 12).unwrap();
    assert!((shape.report.volume - 6.0).abs() < 1e-6, "{}", shape.report.volume);
    for (a, hi) in [2.0, 1.0, 3.0].into_iter().enumerate() {
        assert!(
            shape.report.box_min[a].abs() < 1e-6 && (shape.report.box_max[a] - hi).abs() < 1e-6
        );
    }
}

#[test]
fn what_cannot_be_a_silhouette_is_refused_with_a_sentence() {
    let good = pair(&BOX.0, &BOX.1);
    let refused = |change: &dyn Fn(&mut Vec<Silhouette>), cells: usize| {
        let mut seen = good.to_vec();
        change(&mut seen);
        carved(&seen, cells).unwrap_err()
    };
    let with = |k: usize, x: f64| refused(&|s| s[1].camera[k] = x, 12);
    for (error, status, words) in [
        (
            refused(&|s| s[1].width = 6, 12),
            2,
            "silhouette 1 has 15 values, but 6 x 3 pixels are 18",
        ),
        (refused(&|s| s[0].height = 0, 12), 2, "silhouette 0 has 4 x 0 pixels"),
        (refused(&|s| s[0].width = usize::MAX, 12), 17, "silhouette 0"),
        (refused(&|s| s[0].mask = &[0; 12], 12), 5, "silhouette 0 shows no particle"),
        (refused(&|s| s.truncate(1), 12), 2, "1 silhouette does not bound"),
        (refused(&|s| s.clear(), 12), 2, "0 silhouettes do not bound"),
        (refused(&|s| s[1].camera = FRONT, 12), 2, "2 silhouettes do not bound"),
        (refused(&|_| (), 3), 2, "cells is 3"),
        (refused(&|_| (), 4096), 2, "cells is 4096"),
        (with(6, f64::NAN), 3, "camera 1 has NaN in row 1, column 2"),
        (with(3, f64::INFINITY), 3, "camera 1 has inf in row 0, column 3"),
        (with(0, 1e200), 2, "camera 1 has 1e200"),
        (refused(&|s| s[1].camera = [0.0; 12], 12), 2, "camera 1 does not see two directions"),
        // It looks past the body.
        (with(7, 40.0), 5, "within all of 2 silhouettes"),
    ] {
        assert_eq!(error.status(), status, "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
    let tight = ImportOptions { memory_limit: 1000, ..ImportOptions::default() };
    let refused = Shape::from_silhouettes(&good, 64, Carve::Touched, &tight, &Run::serial());
    assert!(matches!(refused, Err(Error::MemoryLimit(_))));
    let stop = Run::serial().with_progress(Box::new(|_| true));
    let o = ImportOptions::default();
    let refused = Shape::from_silhouettes(&good, 64, Carve::Touched, &o, &stop);
    assert!(matches!(refused, Err(Error::Cancelled(_))));
}

#[test]
fn a_silhouette_that_is_cut_off_is_noted() {
    let mut front = BOX.0;
    front[4] = 1;
    let shape = carved(&pair(&front, &BOX.1), 12).unwrap();
    assert!((shape.report.volume - 9.0).abs() < 1e-6);
    assert_eq!(
        shape.report.notes,
        ["silhouette 0 touches the border of its image: the hull may be cut off there"]
    );
}
