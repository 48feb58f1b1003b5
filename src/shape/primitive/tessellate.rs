//! Meshes of the analytic particles. Every mesh has the mirror planes of its
//! body: points are computed in one quadrant and reflected, and the triangles
//! are laid out the same way on both sides.

use super::Primitive;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// The mesh of any particle but the stone; parameters have been checked.
pub(super) fn mesh(primitive: &Primitive, segments: usize) -> Mesh {
    // Edges in a quarter turn.
    let n = segments.div_ceil(4).max(2);
    match *primitive {
        Primitive::Sphere { radius } => ball(n, [radius; 3]),
        Primitive::Ellipsoid { axes } => ball(n, axes),
        Primitive::Mandm { radius, flatness } => ball(n, [radius, radius, radius * flatness]),
        Primitive::Superellipsoid { axes, exponents } => superellipsoid(n, axes, exponents),
        Primitive::Box { edges } => {
            let longest = edges.iter().copied().fold(0.0, f64::max);
            let cells =
                edges.map(|e| 2 * (((n as f64 * e / longest) / 2.0).round() as usize).max(1));
            let (mut vertices, faces) = box_grid(cells);
            scale(&mut vertices, edges.map(|e| e / 2.0));
            (vertices, faces)
        }
        Primitive::Cylinder { radius, height } => {
            let mut rows = Rows::default();
            let disc = |i: usize| radius * (i as f64 / n as f64);
            for i in 0..=n {
                rows.push(Ring::Whole(i), disc(i), height / 2.0);
            }
            rows.band(n, radius, height);
            for i in (0..n).rev() {
                rows.push(Ring::Whole(i), disc(i), -height / 2.0);
            }
            rows.mesh
        }
        Primitive::Capsule { radius, height } => capped(n, radius, height, |i| {
            let (c, s) = quarter(i, n);
            (radius * s, height / 2.0 + radius * c)
        }),
        Primitive::Tablet { band_radius, band_height, cap_height } => {
            // The cap's sphere, and its half angle by the tangent of half of it.
            let sphere = (band_radius.powi(2) + cap_height.powi(2)) / (2.0 * cap_height);
            let half = (cap_height / band_radius).atan();
            capped(n, band_radius, band_height, |i| {
                if i == n {
                    return (band_radius, band_height / 2.0);
                }
                let (s, c) = (half * i as f64 / n as f64).sin_cos();
                (2.0 * sphere * s * c, band_height / 2.0 + cap_height - 2.0 * sphere * s * s)
            })
        }
        Primitive::Torus { major, minor } => torus(n, major, minor),
        Primitive::Cone { radius, height } => {
            let mut rows = Rows::default();
            for i in 0..=n {
                let t = i as f64 / n as f64;
                rows.push(Ring::Whole(i), radius * t, height * (0.75 - t));
            }
            for i in (0..n).rev() {
                rows.push(Ring::Whole(i), radius * (i as f64 / n as f64), -0.25 * height);
            }
            rows.mesh
        }
        // Made in stone.rs.
        Primitive::Stone { .. } => Mesh::default(),
    }
}

/// Cosine and sine of the part `i / n` of a right angle. The two change places
/// exactly when `i` becomes `n − i`.
fn quarter(i: usize, n: usize) -> (f64, f64) {
    if i == 0 {
        return (1.0, 0.0);
    }
    match (2 * i).cmp(&n) {
        std::cmp::Ordering::Less => {
            let (s, c) = (FRAC_PI_2 * (i as f64 / n as f64)).sin_cos();
            (c, s)
        }
        std::cmp::Ordering::Equal => (FRAC_1_SQRT_2, FRAC_1_SQRT_2),
        std::cmp::Ordering::Greater => {
            let (c, s) = quarter(n - i, n);
            (s, c)
        }
    }
}

/// A horizontal ring of vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Ring {
    /// `4 i` vertices, the first on the x axis; a pole for 0.
    Whole(usize),
    /// `4 i` vertices, turned by half a step.
    Turned(usize),
}

/// Rings stitched one below the other, from the top to the bottom.
#[derive(Default)]
struct Rows {
    mesh: Mesh,
    last: Option<(u32, Ring)>,
}

impl Rows {
    /// Adds a ring of radius `r` at height `z` and the triangles from the last one to it.
    fn push(&mut self, ring: Ring, r: f64, z: f64) {
        let start = self.mesh.0.len() as u32;
        match ring {
            Ring::Whole(0) => self.mesh.0.push([0.0, 0.0, z]),
            Ring::Whole(i) | Ring::Turned(i) => {
                for j in 0..4 * i {
                    let (c, s) = match ring {
                        Ring::Whole(_) => quarter(j % i, i),
                        Ring::Turned(_) => quarter(2 * (j % i) + 1, 2 * i),
                    };
                    let (x, y) = [(c, s), (-s, c), (-c, -s), (s, -c)][j / i];
                    self.mesh.0.push([r * x, r * y, z]);
                }
            }
        }
        if let Some((from, above)) = self.last {
            stitch(&mut self.mesh.1, (from, above), (start, ring));
        }
        self.last = Some((start, ring));
    }

    /// The rings of a cylinder between two `Whole(n)` rings of the same radius,
    /// the upper one already there; ends with the lower one.
    fn band(&mut self, n: usize, radius: f64, height: f64) {
        // Even, so that the middle is a mirror; equilateral triangles where that
        // does not make too many.
        let edge = FRAC_PI_2 * radius / n as f64;
        let rows = (height / (edge * 0.75f64.sqrt()) / 2.0).round().clamp(1.0, 8.0 * n as f64);
        let rows = 2 * rows as usize;
        for k in 1..=rows {
            let z = height / 2.0 * ((rows as f64 - 2.0 * k as f64) / rows as f64);
            let ring = if k % 2 == 0 { Ring::Whole(n) } else { Ring::Turned(n) };
            self.push(ring, radius, z);
        }
    }
}

/// Triangles between a ring and the one below it, counter-clockwise from outside.
fn stitch(faces: &mut Vec<[u32; 3]>, above: (u32, Ring), below: (u32, Ring)) {
    use Ring::{Turned, Whole};
    let at = |(start, ring): (u32, Ring), q: usize, j: usize| match ring {
        Whole(0) => start,
        Whole(i) | Turned(i) => start + ((q * i + j) % (4 * i)) as u32,
    };
    for q in 0..4 {
        let t = |j| at(above, q, j);
        let b = |j| at(below, q, j);
        match (above.1, below.1) {
            (Whole(i), Whole(k)) if k == i + 1 => {
                faces.extend((0..k).map(|j| [t(j), b(j), b(j + 1)]));
                faces.extend((0..i).map(|j| [t(j), b(j + 1), t(j + 1)]));
            }
            (Whole(i), Whole(k)) if i == k + 1 => {
                faces.extend((0..i).map(|j| [t(j), b(j), t(j + 1)]));
                faces.extend((0..k).map(|j| [t(j + 1), b(j), b(j + 1)]));
            }
            (Whole(i), _) => {
                for j in 0..i {
                    faces.push([t(j), b(j), t(j + 1)]);
                    faces.push([t(j + 1), b(j), b(j + 1)]);
                }
            }
            (Turned(i), _) => {
                for j in 0..i {
                    faces.push([t(j), b(j), b(j + 1)]);
                    faces.push([t(j), b(j + 1), t(j + 1)]);
                }
            }
        }
    }
}

/// A body of revolution with a cap, a band and the mirrored cap; `cap(i)` is the
/// radius and height of ring `i`, from the pole to the band.
fn capped(n: usize, radius: f64, height: f64, cap: impl Fn(usize) -> (f64, f64)) -> Mesh {
    let mut rows = Rows::default();
    for i in 0..=n {
        let (r, z) = cap(i);
        rows.push(Ring::Whole(i), r, z);
    }
    rows.band(n, radius, height);
    for i in (0..n).rev() {
        let (r, z) = cap(i);
        rows.push(Ring::Whole(i), r, -z);
    }
    rows.mesh
}

/// An ellipsoid: rings of equal latitude on the unit sphere, stretched.
fn ball(n: usize, axes: [f64; 3]) -> Mesh {
    let mut rows = Rows::default();
    for i in 0..=n {
        let (c, s) = quarter(i, n);
        rows.push(Ring::Whole(i), s, c);
    }
    for i in (0..n).rev() {
        let (c, s) = quarter(i, n);
        rows.push(Ring::Whole(i), s, -c);
    }
    let (mut vertices, faces) = rows.mesh;
    scale(&mut vertices, axes);
    (vertices, faces)
}

fn torus(n: usize, major: f64, minor: f64) -> Mesh {
    // Rings in a quarter of the tube: as far apart as the vertices of the outer ring,
    // but enough to keep a thin tube round.
    let equilateral = n as f64 * minor / (major + minor) / 0.75f64.sqrt();
    let around = (equilateral.round() as usize).max(n.div_ceil(4)).max(2);
    let mut rows = Rows::default();
    let mut first = None;
    for k in 0..4 * around {
        // From the top over the outside down: cos and sin of the tube's angle.
        let (c, s) = quarter(k % around, around);
        let (x, z) = [(s, c), (c, -s), (-s, -c), (-c, s)][k / around];
        let ring = if k % 2 == 0 { Ring::Whole(n) } else { Ring::Turned(n) };
        rows.push(ring, major + minor * x, minor * z);
        first = first.or(rows.last);
    }
    if let (Some(first), Some(last)) = (first, rows.last) {
        stitch(&mut rows.mesh.1, last, first);
    }
    rows.mesh
}

/// Every direction on a fixed mesh, moved to the surface along its ray. Boxy ones
/// start from a cube, whose vertices lie along the edges; others from a sphere.
fn superellipsoid(n: usize, axes: [f64; 3], [e1, e2]: [f64; 2]) -> Mesh {
    let (mut vertices, faces) =
        if e1.max(e2) < 0.75 { box_grid([2 * n.div_ceil(2); 3]) } else { ball(n, [1.0; 3]) };
    for p in &mut vertices {
        let [x, y, z] = p.map(f64::abs);
        let largest = x.max(y).max(z);
        let [x, y, z] = [x / largest, y / largest, z / largest];
        // The gauge is homogeneous of degree one: the surface is at p / gauge.
        let flat = (x.powf(2.0 / e2) + y.powf(2.0 / e2)).powf(e2 / e1);
        let gauge = (flat + z.powf(2.0 / e1)).powf(e1 / 2.0) * largest;
        *p = p.map(|v| v / gauge);
    }
    scale(&mut vertices, axes);
    (vertices, faces)
}

/// The surface of the cube [−1, 1]³ as a grid of even numbers of cells, each
/// cut in two along the diagonal that points to the middle of its face.
fn box_grid(cells: [usize; 3]) -> Mesh {
    let (mut vertices, mut faces) = Mesh::default();
    let mut numbers = BTreeMap::new();
    let mut vertex = |p: [usize; 3]| {
        *numbers.entry(p).or_insert_with(|| {
            let at = |a: usize| (2.0 * p[a] as f64 - cells[a] as f64) / cells[a] as f64;
            vertices.push([at(0), at(1), at(2)]);
            vertices.len() as u32 - 1
        })
    };
    for a in 0..3 {
        let (b, c) = ((a + 1) % 3, (a + 2) % 3);
        for side in [0, cells[a]] {
            for v in 0..cells[c] {
                for u in 0..cells[b] {
                    let mut corner = |du: usize, dv: usize| {
                        let mut p = [0; 3];
                        (p[a], p[b], p[c]) = (side, u + du, v + dv);
                        vertex(p)
                    };
                    let [p, q, r, s] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                    let rising = (2 * u < cells[b]) == (2 * v < cells[c]);
                    let two = if rising { [[p, q, r], [p, r, s]] } else { [[p, q, s], [q, r, s]] };
                    faces
                        .extend(two.map(|[i, j, k]| if side == 0 { [i, k, j] } else { [i, j, k] }));
                }
            }
        }
    }
    (vertices, faces)
}

fn scale(vertices: &mut [[f64; 3]], by: [f64; 3]) {
    for p in vertices {
        *p = [p[0] * by[0], p[1] * by[1], p[2] * by[2]];
    }
}
