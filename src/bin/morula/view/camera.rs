//! Where the picture is taken from: an orthographic camera.

use morula::math::Vec3;

/// An orthographic camera that looks at `centre`; z is up.
#[derive(Clone, Copy)]
pub struct Camera {
    /// Rightwards in the picture.
    pub right: Vec3,
    /// Upwards in the picture.
    pub up: Vec3,
    /// Towards the viewer.
    pub toward: Vec3,
    /// The point in the middle of each panel.
    pub centre: Vec3,
    /// Pixels to one unit of length.
    pub scale: f64,
}

impl Camera {
    /// `azimuth` turns the viewer about z from the +x direction, `elevation`
    /// raises the viewer above the xy plane; degrees.
    pub fn new(azimuth: f64, elevation: f64) -> Camera {
        let (a, e) = (azimuth.to_radians(), elevation.to_radians());
        let toward = Vec3::new(e.cos() * a.cos(), e.cos() * a.sin(), e.sin());
        let right = Vec3::new(-a.sin(), a.cos(), 0.0);
        Camera { right, up: toward.cross(&right), toward, centre: Vec3::zeros(), scale: 1.0 }
    }

    /// Aims at what spans these (point, radius) pairs so that it fills `pixels`.
    pub fn frame(&mut self, balls: impl Iterator<Item = (Vec3, f64)>, pixels: [f64; 2]) {
        let axes = [self.right, self.up, self.toward];
        let mut lo = [f64::MAX; 3];
        let mut hi = [f64::MIN; 3];
        for (p, r) in balls {
            for (i, axis) in axes.iter().enumerate() {
                lo[i] = lo[i].min(axis.dot(&p) - r);
                hi[i] = hi[i].max(axis.dot(&p) + r);
            }
        }
        if lo[0] > hi[0] {
            return;
        }
        self.centre = (0..3).map(|i| axes[i] * (0.5 * (lo[i] + hi[i]))).sum();
        let span = [0, 1].map(|i| (hi[i] - lo[i]).max(1e-300));
        self.scale = (pixels[0] / span[0]).min(pixels[1] / span[1]);
    }

    /// Right, up and towards the viewer, from the centre, in pixels.
    pub fn project(&self, p: &Vec3) -> [f64; 3] {
        let d = (p - self.centre) * self.scale;
        [self.right.dot(&d), self.up.dot(&d), self.toward.dot(&d)]
    }

    /// The point at (right, up, toward) pixels from the centre.
    pub fn unproject(&self, q: [f64; 3]) -> Vec3 {
        self.centre + (self.right * q[0] + self.up * q[1] + self.toward * q[2]) / self.scale
    }

    /// A direction in (right, up, toward).
    pub fn direction(&self, v: &Vec3) -> [f32; 3] {
        [self.right.dot(v) as f32, self.up.dot(v) as f32, self.toward.dot(v) as f32]
    }
}
