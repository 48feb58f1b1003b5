//! A crushed stone: a convex body cut by random planes, its edges a little
//! worn, stretched, with band-limited roughness.
//!
//! The surface is a radial function over the directions of a subdivided
//! icosahedron, so it cannot cross itself. Only +, −, ×, ÷ and √ are used, which
//! are correctly rounded everywhere: the same seed gives the same bytes on every
//! platform.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);
type Point = [f64; 3];

/// The stone `seed`, of the volume of a sphere of `diameter`, its centroid on the origin.
pub(super) fn mesh(seed: u64, diameter: f64, roughness: f64, segments: usize) -> Mesh {
    let mut random = Random(Pcg64::new(u128::from(seed), 0x6d6f_7275_6c61));
    // Long, intermediate and short axis, as gravels and ballast have them.
    let middle = 0.72 + 0.22 * random.unit();
    let axes = [1.0, middle, middle * (0.66 + 0.26 * random.unit())];
    let planes = planes(&mut random, 34 - (20.0 * roughness) as usize);
    let noise = Noise(random.0.next_u64());

    let (mut vertices, faces) = icosphere(segments.div_ceil(5).max(2));
    for p in &mut vertices {
        let r = facets(&planes, p) * (1.0 + roughness * noise.at(p));
        *p = [0, 1, 2].map(|a| p[a] * r * axes[a]);
    }
    let (volume, centroid) = volume_and_centroid(&vertices, &faces);
    // π d³ / 6 over the volume so far.
    let stretch = diameter * cube_root(std::f64::consts::FRAC_PI_6 / volume);
    for p in &mut vertices {
        *p = [0, 1, 2].map(|a| (p[a] - centroid[a]) * stretch);
    }
    (vertices, faces)
}

struct Random(Pcg64);

impl Random {
    /// From 0 to 1, 53 bits.
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / 9_007_199_254_740_992.0
    }

    /// A direction, by rejection from the cube.
    fn direction(&mut self) -> Point {
        loop {
            let p = [self.unit(), self.unit(), self.unit()].map(|v| 2.0 * v - 1.0);
            let n = dot(&p, &p);
            if n > 0.01 && n <= 1.0 {
                return p.map(|v| v / n.sqrt());
            }
        }
    }
}

fn dot(a: &Point, b: &Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Cutting planes as normal over distance. Each normal is, of eight drawn, the
/// one farthest from those before: spread, but not evenly.
fn planes(random: &mut Random, count: usize) -> Vec<Point> {
    let mut normals: Vec<Point> = Vec::new();
    for _ in 0..count {
        let mut best = (2.0, [1.0, 0.0, 0.0]);
        for _ in 0..8 {
            let n = random.direction();
            let nearest = normals.iter().map(|m| dot(m, &n)).fold(-1.0, f64::max);
            if nearest < best.0 {
                best = (nearest, n);
            }
        }
        normals.push(best.1);
    }
    normals
        .into_iter()
        .map(|n| {
            let distance = 0.72 + 0.28 * random.unit();
            n.map(|v| v / distance)
        })
        .collect()
}

/// Distance to the cut body along a direction: the least over the planes, as a
/// 64-norm, which wears the edges.
fn facets(planes: &[Point], d: &Point) -> f64 {
    // No farther than this, where planes leave a corner open.
    let mut sum = power_64(1.0 / 1.4);
    for p in planes {
        let inverse = dot(p, d);
        if inverse > 0.0 {
            sum += power_64(inverse);
        }
    }
    let mut root = sum;
    for _ in 0..6 {
        root = root.sqrt();
    }
    1.0 / root
}

fn power_64(x: f64) -> f64 {
    let mut p = x;
    for _ in 0..6 {
        p *= p;
    }
    p
}

/// Value noise of three octaves on a lattice, in about ±0.1.
struct Noise(u64);

impl Noise {
    fn at(&self, p: &Point) -> f64 {
        [(2.5, 0.1), (6.0, 0.045), (13.0, 0.02)]
            .iter()
            .enumerate()
            .map(|(octave, (frequency, size))| {
                size * self.octave(octave as u64, &p.map(|v| (v + 2.0) * frequency))
            })
            .sum()
    }

    /// Between −1 and 1, smooth to the second derivative.
    fn octave(&self, octave: u64, p: &Point) -> f64 {
        let cell = p.map(|v| v as u64);
        let t = [0, 1, 2].map(|a| p[a] - cell[a] as f64);
        let w = t.map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
        let mut sum = 0.0;
        for corner in 0..8u64 {
            let mut weight = 1.0;
            let mut key = self.0 ^ octave;
            for a in 0..3 {
                let up = corner >> a & 1;
                weight *= if up == 1 { w[a] } else { 1.0 - w[a] };
                key = mix(key.wrapping_add(cell[a] + up));
            }
            sum += weight * ((key >> 11) as f64 / 4_503_599_627_370_496.0 - 1.0);
        }
        sum
    }
}

/// The finaliser of splitmix64.
fn mix(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

/// The icosahedron with each edge in `n` parts, on the unit sphere.
fn icosphere(n: usize) -> Mesh {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let corners = [
        [-1.0, g, 0.0],
        [1.0, g, 0.0],
        [-1.0, -g, 0.0],
        [1.0, -g, 0.0],
        [0.0, -1.0, g],
        [0.0, 1.0, g],
        [0.0, -1.0, -g],
        [0.0, 1.0, -g],
        [g, 0.0, -1.0],
        [g, 0.0, 1.0],
        [-g, 0.0, -1.0],
        [-g, 0.0, 1.0],
    ];
    const FACES: [[usize; 3]; 20] = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let (mut vertices, mut faces) = Mesh::default();
    // A vertex is known by the shares of the corners that make it.
    let mut numbers = std::collections::BTreeMap::new();
    for [a, b, c] in FACES {
        let mut vertex = |i: usize, j: usize| {
            let mut key =
                [(a, n - i - j), (b, i), (c, j)].map(|(v, w)| if w == 0 { (0, 0) } else { (v, w) });
            key.sort();
            *numbers.entry(key).or_insert_with(|| {
                let mut p = [0.0; 3];
                for (v, share) in key {
                    for (x, corner) in p.iter_mut().zip(corners[v]) {
                        *x += share as f64 * corner;
                    }
                }
                let length = dot(&p, &p).sqrt();
                vertices.push(p.map(|x| x / length));
                vertices.len() as u32 - 1
            })
        };
        for i in 0..n {
            for j in 0..n - i {
                faces.push([vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)]);
                if i + j + 1 < n {
                    faces.push([vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]);
                }
            }
        }
    }
    (vertices, faces)
}

/// By signed tetrahedra from the origin, which lies inside.
fn volume_and_centroid(vertices: &[Point], faces: &[[u32; 3]]) -> (f64, Point) {
    let (mut volume, mut first) = (0.0, [0.0; 3]);
    for f in faces {
        let [a, b, c] = f.map(|v| vertices[v as usize]);
        let cross =
            [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        let v = dot(&a, &cross) / 6.0;
        volume += v;
        for (sum, i) in first.iter_mut().zip(0..3) {
            *sum += v * (a[i] + b[i] + c[i]) / 4.0;
        }
    }
    (volume, first.map(|m| m / volume))
}

/// Newton's iteration: the library's cube root may differ between platforms.
fn cube_root(v: f64) -> f64 {
    let mut x = 1.0;
    for _ in 0..64 {
        x = (2.0 * x + v / (x * x)) / 3.0;
    }
    x
}
