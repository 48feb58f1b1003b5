use super::Vec3;

/// A component sphere of a clump.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Sphere {
    /// Centre.
    pub center: Vec3,
    /// Radius, greater than zero.
    pub radius: f64,
}

impl Sphere {
    /// The sphere about `center`.
    pub fn new(center: Vec3, radius: f64) -> Self {
        Sphere { center, radius }
    }

    /// Whether `point` lies in the closed ball.
    pub fn contains(&self, point: &Vec3) -> bool {
        (point - self.center).norm_squared() <= self.radius * self.radius
    }

    /// Volume of the ball.
    pub fn volume(&self) -> f64 {
        4.0 / 3.0 * std::f64::consts::PI * self.radius.powi(3)
    }
}
