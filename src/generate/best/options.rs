//! What a clump by [`Method::Best`](crate::generate::Method::Best) must keep to, beside the number
//! of spheres.

use crate::error::{Error, Result, figure};
use crate::generate::balls::Plane;
use crate::math::{UnitFrame, Vec3};

/// The points p with normal · p ≤ offset, in the caller's unit and frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// Points out of the half-space; of any length but 0.
    pub normal: Vec3,
    /// normal · p of the points on its plane.
    pub offset: f64,
}

impl HalfSpace {
    /// Whether the half-space of the number `i` is one.
    pub(crate) fn check(&self, i: usize) -> Result<()> {
        if !self.offset.is_finite() {
            return Err(Error::InvalidArgument(format!(
                "half-space {i} has the offset {}, not a number",
                figure(self.offset)
            )));
        }
        direction(&self.normal, "half-space", i)
    }

    /// The same one with a normal of length 1.
    pub(crate) fn unit(&self) -> (Vec3, f64) {
        // By parts: squares of the caller's lengths may overflow or vanish.
        let most = self.normal.amax();
        let part = self.normal / most;
        let norm = part.norm();
        // Offsets that would overflow are far beyond any body.
        let far = self.offset.abs() * 1e-290 > most;
        let offset = if far { 1e290 * self.offset.signum() } else { self.offset / most / norm };
        (part / norm, offset)
    }

    /// The same one in the unit frame.
    pub(crate) fn plane(&self, frame: &UnitFrame) -> Plane {
        let (normal, offset) = self.unit();
        let (normal, offset) = frame.plane_to_unit(&normal, offset);
        Plane { normal, offset: offset.clamp(-FAR, FAR) }
    }
}

/// Which symmetry a clump has exactly.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Symmetry {
    /// None but by chance.
    #[default]
    None,
    /// That of the target: its mirror planes through the centre of mass and exchanges of axes, or
    /// the largest part of them that costs no more than a tenth of D; the note says when it is a
    /// part.
    Auto,
    /// Mirror planes through the centre of mass, by their normals in the caller's frame. Where
    /// spheres and their images cannot be as many as asked for, they are fewer.
    Planes(Vec<Vec3>),
}

/// Beyond so many sizes a plane says nothing more.
const FAR: f64 = 1e6;

/// Above it, a weight leaves nothing of the rest to single precision.
const MOST_WEIGHT: f64 = 1e6;

/// Demands on a clump. The defaults demand nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct BestOptions {
    /// How many times as much as target that is not covered, clump beyond the target counts:
    /// what is made least is (|S∖C| + w |C∖S|) / (|S| + |S∩C| + w |C∖S|), which is D at w = 1.
    pub overshoot_weight: f64,
    /// How far a sphere may reach beyond the surface, in the caller's unit; 0: as far as is best.
    /// Kept by depth: no radius is above this and the depth of the centre.
    pub max_protrusion: f64,
    /// Greatest radius, in the caller's unit; 0: as large as is best.
    pub max_radius: f64,
    /// No sphere reaches out of any of these, and what they leave of the target is what is covered.
    /// Quality is still that against the whole target.
    pub half_spaces: Vec<HalfSpace>,
    /// Whether the spheres must hang together by overlaps.
    pub connected: bool,
    /// Whether the union of the spheres has the volume of the target, or of what half-spaces leave
    /// of it, as far as other demands allow.
    pub equal_volume: bool,
    /// Weight s of the distance between the surfaces against D: 3 s × its root mean square, both
    /// ways, over the target's equivalent diameter is added to what is made least. 0: D alone.
    pub smoothness: f64,
    /// Exact symmetry of the clump.
    pub symmetry: Symmetry,
}

impl Default for BestOptions {
    fn default() -> Self {
        BestOptions {
            overshoot_weight: 1.0,
            max_protrusion: 0.0,
            max_radius: 0.0,
            half_spaces: Vec::new(),
            connected: false,
            equal_volume: false,
            smoothness: 0.0,
            symmetry: Symmetry::None,
        }
    }
}

impl BestOptions {
    /// Whether all values are in their range, and fit a least radius.
    pub(in crate::generate) fn check(&self, min_radius: f64) -> Result<()> {
        for (name, value) in [
            ("max_protrusion", self.max_protrusion),
            ("max_radius", self.max_radius),
            ("smoothness", self.smoothness),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(Error::InvalidArgument(format!(
                    "{name} is {}, not a number ≥ 0",
                    figure(value)
                )));
            }
        }
        for (name, weight) in
            [("overshoot_weight", self.overshoot_weight), ("smoothness", self.smoothness)]
        {
            if weight > MOST_WEIGHT {
                return Err(Error::InvalidArgument(format!(
                    "{name} is {}, more than {MOST_WEIGHT}",
                    figure(weight)
                )));
            }
        }
        let w = self.overshoot_weight;
        if !(w.is_finite() && w > 0.0) {
            return Err(Error::InvalidArgument(format!(
                "overshoot_weight is {}, not a number > 0",
                figure(w)
            )));
        }
        if self.max_radius > 0.0 && self.max_radius < min_radius {
            return Err(Error::InvalidArgument(format!(
                "max_radius is {}, less than min_radius {}",
                figure(self.max_radius),
                figure(min_radius)
            )));
        }
        for (i, h) in self.half_spaces.iter().enumerate() {
            h.check(i)?;
        }
        if let Symmetry::Planes(normals) = &self.symmetry {
            for (i, n) in normals.iter().enumerate() {
                direction(n, "symmetry plane", i)?;
            }
        }
        Ok(())
    }
}

/// Whether a vector is a direction.
fn direction(v: &Vec3, name: &str, i: usize) -> Result<()> {
    for (axis, x) in ["x", "y", "z"].iter().zip(v.iter()) {
        if !x.is_finite() {
            return Err(Error::InvalidArgument(format!(
                "{name} {i} has a normal with {axis} = {}",
                figure(*x)
            )));
        }
    }
    if v.amax() == 0.0 {
        return Err(Error::InvalidArgument(format!("{name} {i} has a normal of length 0")));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(o: &BestOptions, words: &[&str]) {
        let Err(Error::InvalidArgument(text)) = o.check(0.1) else { panic!("{o:?} was taken") };
        assert!(words.iter().all(|w| text.contains(w)), "{text}");
    }

    #[test]
    fn values_out_of_range_are_named() {
        let o = BestOptions::default();
        assert!(o.check(0.1).is_ok());
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            refused(&BestOptions { max_protrusion: bad, ..o.clone() }, &["max_protrusion"]);
            refused(&BestOptions { max_radius: bad, ..o.clone() }, &["max_radius"]);
            refused(&BestOptions { smoothness: bad, ..o.clone() }, &["smoothness"]);
            refused(&BestOptions { overshoot_weight: bad, ..o.clone() }, &["overshoot_weight"]);
        }
        refused(&BestOptions { overshoot_weight: 0.0, ..o.clone() }, &["overshoot_weight is 0"]);
        refused(
            &BestOptions { overshoot_weight: 1e39, ..o.clone() },
            &["overshoot_weight is 1e39"],
        );
        refused(&BestOptions { smoothness: 1e39, ..o.clone() }, &["smoothness is 1e39"]);
        refused(&BestOptions { max_radius: 0.05, ..o.clone() }, &["0.05", "min_radius 0.1"]);
        let plane = HalfSpace { normal: Vec3::z(), offset: 1.0 };
        let with = |h| BestOptions { half_spaces: vec![plane, h], ..o.clone() };
        assert!(with(plane).check(0.0).is_ok());
        refused(&with(HalfSpace { offset: f64::NAN, ..plane }), &["half-space 1", "NaN"]);
        refused(&with(HalfSpace { normal: Vec3::zeros(), ..plane }), &["half-space 1", "length 0"]);
        let normal = Vec3::new(0.0, f64::INFINITY, 0.0);
        refused(&with(HalfSpace { normal, ..plane }), &["half-space 1", "y = inf"]);
        let symmetry = Symmetry::Planes(vec![Vec3::x(), Vec3::zeros()]);
        refused(&BestOptions { symmetry, ..o }, &["symmetry plane 1", "length 0"]);
    }
}
