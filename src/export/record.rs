use crate::error::{Error, Result, collected, figure};
use crate::mass::Body;
use crate::math::{Sphere, Vec3};
use nalgebra::Matrix3;

/// Bytes of a name in a comment.
const TITLE: usize = 100;

/// What every format is written from: a clump with its masses in the frame of the body (origin at
/// the centre of mass, principal axes, right-handed, moments ascending), and where that frame
/// lies in the caller's.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Name of the template.
    pub name: String,
    /// Component spheres, frame of the body.
    pub spheres: Vec<Sphere>,
    /// Mass of each sphere. Where a solver adds them up as solid spheres it finds `mass`, the
    /// centre and the moments, as far as the correction of masses could have it.
    pub masses: Vec<f64>,
    /// Mass of the body.
    pub mass: f64,
    /// Volume of the body.
    pub volume: f64,
    /// Principal moments of inertia, ascending.
    pub moments: [f64; 3],
    /// Centre of mass, the caller's frame.
    pub center: Vec3,
    /// Columns are the axes of the body in the caller's frame.
    pub axes: Matrix3<f64>,
    /// The same rotation, body to caller, `w, x, y, z`.
    pub quaternion: [f64; 4],
}

impl Record {
    /// The record of spheres in the caller's frame that stand for `body`, with a mass for each.
    pub fn new(name: &str, spheres: &[Sphere], masses: &[f64], body: &Body) -> Result<Record> {
        let record = Record {
            name: name.into(),
            spheres: body.to_body(spheres),
            masses: collected("masses of a file", masses.iter().copied())?,
            mass: body.mass,
            volume: body.volume,
            moments: body.principal.moments,
            center: body.center,
            axes: body.principal.axes,
            quaternion: body.principal.quaternion,
        };
        record.check()?;
        Ok(record)
    }

    /// Refuses what no file could hold.
    pub fn check(&self) -> Result<()> {
        if let Some(bad) = self.name.chars().find(|c| c.is_control()) {
            return Err(Error::InvalidArgument(format!("the name holds the character {bad:?}")));
        }
        if self.spheres.is_empty() {
            return Err(Error::Empty("the clump has no sphere".into()));
        }
        if self.spheres.len() != self.masses.len() {
            return Err(Error::InvalidArgument(format!(
                "{} spheres have {} masses",
                self.spheres.len(),
                self.masses.len()
            )));
        }
        for (i, (s, m)) in self.spheres.iter().zip(&self.masses).enumerate() {
            let all = [s.center.x, s.center.y, s.center.z, s.radius, *m];
            if let Some(bad) = all.iter().find(|v| !v.is_finite()) {
                return Err(Error::NotFinite(format!("sphere {i} holds {bad}")));
            }
            if s.radius <= 0.0 {
                return Err(Error::InvalidArgument(format!(
                    "sphere {i} has the radius {}",
                    figure(s.radius)
                )));
            }
            if *m <= 0.0 {
                return Err(Error::InvalidArgument(format!(
                    "sphere {i} has the mass {}",
                    figure(*m)
                )));
            }
        }
        let whole = [("mass", self.mass), ("volume", self.volume)];
        let moments = self.moments.map(|m| ("principal moment", m));
        for (what, value) in whole.into_iter().chain(moments) {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::InvalidArgument(format!("the {what} is {}", figure(value))));
            }
        }
        let pose = self.center.iter().chain(self.axes.iter()).chain(&self.quaternion);
        if let Some(bad) = pose.into_iter().find(|v| !v.is_finite()) {
            return Err(Error::NotFinite(format!("the pose of the body holds {bad}")));
        }
        Ok(())
    }

    /// The same in units of which one of the caller's has so many, for lengths and masses.
    pub fn in_units(mut self, length: f64, mass: f64) -> Result<Record> {
        for (what, factor) in [("length", length), ("mass", mass)] {
            if !(factor.is_finite() && factor > 0.0) {
                return Err(Error::InvalidArgument(format!(
                    "the factor of {what} is {factor}, not a positive number"
                )));
            }
        }
        for s in &mut self.spheres {
            *s = Sphere::new(s.center * length, s.radius * length);
        }
        self.masses.iter_mut().for_each(|m| *m *= mass);
        self.mass *= mass;
        self.volume *= length * length * length;
        self.moments = self.moments.map(|m| m * mass * length * length);
        self.center *= length;
        self.check().map_err(|e| e.about("in the units asked for"))?;
        Ok(self)
    }

    /// The name as far as a line of a comment has room for it: LAMMPS reads 255 bytes of the first
    /// line of a molecule, and takes what follows for the next.
    pub(super) fn title(&self) -> &str {
        let fits = (0..=TITLE).rev().find_map(|end| self.name.get(..end));
        if self.name.len() <= TITLE { &self.name } else { fits.unwrap_or_default() }
    }

    /// Density of the body.
    pub fn density(&self) -> f64 {
        self.mass / self.volume
    }

    /// Diameter of the ball about the centre of mass that holds all spheres.
    pub fn diameter(&self) -> f64 {
        2.0 * self.spheres.iter().fold(0.0, |most: f64, s| most.max(s.center.norm() + s.radius))
    }

    /// The spheres in the caller's frame.
    pub fn placed(&self) -> Result<Vec<Sphere>> {
        let place = |s: &Sphere| Sphere::new(self.axes * s.center + self.center, s.radius);
        collected("spheres of a file", self.spheres.iter().map(place))
    }
}
