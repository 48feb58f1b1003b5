//! What each point of a panel shows: depth, normal and which surface, found
//! with a depth buffer for triangles and in closed form for spheres.

use super::camera::Camera;
use super::surface::Triangle;
use morula::Sphere;
use morula::run::Pool;

/// Nothing is nearer than this.
pub const FAR: f32 = f32::MIN;

/// What one sample shows.
#[derive(Clone, Copy)]
pub struct Sample {
    /// Towards the viewer, in samples; [`FAR`] for the background.
    pub depth: f32,
    /// Outward normal in (right, up, toward).
    pub normal: [f32; 3],
    /// Which sphere or facet group.
    pub id: u32,
}

impl Sample {
    /// Whether a surface is seen here.
    pub fn hit(&self) -> bool {
        self.depth > FAR
    }
}

/// The samples of one panel, row by row from the top.
pub struct Buffer {
    pub width: usize,
    pub height: usize,
    pub samples: Vec<Sample>,
    /// The camera in samples instead of pixels.
    pub camera: Camera,
}

impl Buffer {
    /// `fine` samples along each edge of a pixel.
    pub fn new(width: usize, height: usize, fine: usize, camera: &Camera) -> morula::Result<Self> {
        let (width, height) = (width * fine, height * fine);
        let empty = Sample { depth: FAR, normal: [0.0; 3], id: 0 };
        let samples = morula::error::filled("the picture's samples", width * height, empty)?;
        let camera = Camera { scale: camera.scale * fine as f64, ..*camera };
        Ok(Buffer { width, height, samples, camera })
    }

    /// Column and row (with fractions) of a projected point.
    fn place(&self, q: [f64; 3]) -> [f64; 2] {
        [q[0] + 0.5 * self.width as f64 - 0.5, 0.5 * self.height as f64 - 0.5 - q[1]]
    }

    /// The (right, up) of the sample at column `x`, row `y`.
    pub fn plane(&self, x: usize, y: usize) -> [f64; 2] {
        [x as f64 + 0.5 - 0.5 * self.width as f64, 0.5 * self.height as f64 - 0.5 - y as f64]
    }

    /// Draws triangles.
    pub fn triangles(&mut self, triangles: impl Iterator<Item = Triangle>) {
        for t in triangles {
            let q = t.corners.map(|p| self.camera.project(&p));
            let [a, b, c] = q.map(|q| self.place(q));
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            if area.abs() < 1e-12 {
                continue;
            }
            // Seen from behind (through a hole of an open mesh): lit from this side.
            let side = if area < 0.0 { 1.0 } else { -1.0 };
            let normals = t.normals.map(|n| self.camera.direction(&n).map(|v| side * v));
            let range = |i: usize, n: usize| {
                let lo = a[i].min(b[i]).min(c[i]).ceil().clamp(0.0, n as f64);
                let hi = (a[i].max(b[i]).max(c[i]).floor() + 1.0).clamp(0.0, n as f64);
                lo as usize..hi as usize
            };
            for y in range(1, self.height) {
                for x in range(0, self.width) {
                    let p = [x as f64, y as f64];
                    let edge = |u: [f64; 2], v: [f64; 2]| {
                        ((u[0] - p[0]) * (v[1] - p[1]) - (u[1] - p[1]) * (v[0] - p[0])) / area
                    };
                    let w = [edge(b, c), edge(c, a), edge(a, b)];
                    if w.iter().any(|&w| w < -1e-9) {
                        continue;
                    }
                    let depth = (w[0] * q[0][2] + w[1] * q[1][2] + w[2] * q[2][2]) as f32;
                    let s = &mut self.samples[x + self.width * y];
                    if depth > s.depth {
                        let mut n = [0f32; 3];
                        for (w, m) in w.iter().zip(&normals) {
                            for i in 0..3 {
                                n[i] += *w as f32 * m[i];
                            }
                        }
                        // A smoothed normal may turn away at the outline.
                        n[2] = n[2].max(0.0);
                        *s = Sample { depth, normal: unit(n), id: t.id };
                    }
                }
            }
        }
    }

    /// Draws spheres; the id is the number of the sphere plus one.
    pub fn spheres(&mut self, spheres: &[Sphere], pool: &Pool) {
        let discs: Vec<([f64; 2], f64, f64)> = spheres
            .iter()
            .map(|s| {
                let q = self.camera.project(&s.center);
                (self.place(q), q[2], s.radius * self.camera.scale)
            })
            .collect();
        let width = self.width;
        pool.chunks_mut(&mut self.samples, width, |y, row| {
            for (i, &([cx, cy], cz, r)) in discs.iter().enumerate() {
                let dy = y as f64 - cy;
                let half2 = r * r - dy * dy;
                if half2 <= 0.0 {
                    continue;
                }
                let half = half2.sqrt();
                let lo = (cx - half).ceil().clamp(0.0, width as f64) as usize;
                let hi = ((cx + half).floor() + 1.0).clamp(0.0, width as f64) as usize;
                for (x, s) in row.iter_mut().enumerate().take(hi).skip(lo) {
                    let dx = x as f64 - cx;
                    let dz = (half2 - dx * dx).max(0.0).sqrt();
                    let depth = (cz + dz) as f32;
                    if depth > s.depth {
                        let normal = [(dx / r) as f32, (-dy / r) as f32, (dz / r) as f32];
                        *s = Sample { depth, normal, id: i as u32 + 1 };
                    }
                }
            }
        });
    }
}

fn unit(n: [f32; 3]) -> [f32; 3] {
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    if length > 0.0 { n.map(|v| v / length) } else { [0.0, 0.0, 1.0] }
}
