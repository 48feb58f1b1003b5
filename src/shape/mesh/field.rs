//! The winding number of a set of faces, far ones as dipoles.

use super::check::Grain;
use super::tree::{Bounds, Tree};
use crate::error::{Result, reserve};
use crate::math::{Vec3, solid_angle};
use std::f64::consts::PI;

/// Faces are taken as one dipole from this many of their radii.
const FAR: f64 = 4.0;

struct Dipole {
    center: Vec3,
    radius: f64,
    /// Sum of the area vectors.
    area: Vec3,
    /// Sum of the areas.
    weight: f64,
}

/// Some faces as a tree: their winding number, good to a few thousandths, which is
/// enough to judge openness and nesting, and which of them are in a box.
pub struct Field<'a> {
    faces: &'a [[u32; 3]],
    points: &'a [Vec3],
    tree: Tree,
    /// One for each node.
    dipoles: Vec<Dipole>,
    grain: Grain,
}

impl<'a> Field<'a> {
    /// The field of some faces.
    pub fn new(
        some: &[u32],
        faces: &'a [[u32; 3]],
        points: &'a [Vec3],
        grain: Grain,
    ) -> Result<Field<'a>> {
        let corners = |f: u32| {
            let [a, b, c] = faces[f as usize];
            [points[a as usize], points[b as usize], points[c as usize]]
        };
        // Asked for again and again.
        let bounds = |f: u32| {
            let [a, b, c] = faces[f as usize];
            let (a, b, c) = (&points[a as usize], &points[b as usize], &points[c as usize]);
            Bounds { lo: a.inf(b).inf(c), hi: a.sup(b).sup(c) }
        };
        let tree = Tree::new(some.iter().copied(), bounds)?;
        let mut dipoles: Vec<Dipole> = reserve("a field", tree.nodes().len())?;
        // Halves come after their node: from the last to the first, then turned around.
        let last = tree.nodes().len();
        for (at, node) in tree.nodes().iter().enumerate().rev() {
            let (mut area, mut center, mut weight) = (Vec3::zeros(), Vec3::zeros(), 0.0);
            if let Some(halves) = node.halves(at) {
                for half in halves.map(|h| &dipoles[last - 1 - h]) {
                    area += half.area;
                    center += half.center * half.weight;
                    weight += half.weight;
                }
            } else {
                for [a, b, c] in tree.items(node).iter().map(|&f| corners(f)) {
                    let n = (b - a).cross(&(c - a)) / 2.0;
                    let w = n.norm();
                    area += n;
                    center += (a + b + c) / 3.0 * w;
                    weight += w;
                }
            }
            let Bounds { lo, hi } = node.bounds;
            let center = if weight > 0.0 { center / weight } else { (lo + hi) / 2.0 };
            let radius = (center - lo).sup(&(hi - center)).norm();
            dipoles.push(Dipole { center, radius, area, weight });
        }
        dipoles.reverse();
        Ok(Field { faces, points, tree, dipoles, grain })
    }

    /// The corners of a face.
    pub fn corners(&self, face: u32) -> [Vec3; 3] {
        let [a, b, c] = self.faces[face as usize];
        [self.points[a as usize], self.points[b as usize], self.points[c as usize]]
    }

    /// The winding number of `p`. A face in whose plane `p` lies adds nothing: on the
    /// surface this is the mean of both sides.
    /// `looks` counts the faces and dipoles that were looked at.
    pub fn at(&self, p: &Vec3, looks: &mut u64) -> f64 {
        self.sum(0, p, looks) / (4.0 * PI)
    }

    fn sum(&self, at: usize, p: &Vec3, looks: &mut u64) -> f64 {
        let (Some(node), Some(dipole)) = (self.tree.nodes().get(at), self.dipoles.get(at)) else {
            return 0.0;
        };
        *looks += 1;
        let d = dipole.center - p;
        let r = d.norm();
        if r > FAR * dipole.radius {
            return dipole.area.dot(&d) / (r * r * r);
        }
        match node.halves(at) {
            Some([a, b]) => self.sum(a, p, looks) + self.sum(b, p, looks),
            None => {
                let items = self.tree.items(node);
                *looks += items.len() as u64;
                items.iter().map(|&f| facing(&self.corners(f), p, self.grain)).sum()
            }
        }
    }

    /// Calls `enough` with the faces that may meet a box, until it says yes.
    pub fn within(&self, bounds: &Bounds, mut enough: impl FnMut(u32) -> bool) {
        self.tree.descend(
            |node| node.bounds.meets(bounds, self.grain.touch()),
            |leaf| leaf.iter().any(|&f| enough(f)),
        );
    }
}

/// The solid angle, zero for points in the plane of the face.
fn facing(t: &[Vec3; 3], p: &Vec3, grain: Grain) -> f64 {
    let [a, b, c] = [t[0] - p, t[1] - p, t[2] - p];
    let normal = (b - a).cross(&(c - a));
    let volume = a.dot(&normal);
    // Relative to the product of the lengths: the centroid of the face itself.
    let rounding = 1e-12 * a.norm() * b.norm() * c.norm();
    let in_plane = volume.abs() <= rounding.max(grain.rounding() * normal.norm());
    if in_plane { 0.0 } else { solid_angle(t, p) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::UnitFrame;

    #[test]
    fn far_faces_are_close_to_the_sum_of_all() {
        // A bumpy sphere without its north.
        let (n, m) = (24, 48);
        let mut points = Vec::new();
        for i in 0..=n {
            for j in 0..m {
                let (t, f) = (PI * i as f64 / n as f64, 2.0 * PI * j as f64 / m as f64);
                let r = 0.4 + 0.05 * (5.0 * f).sin() * t.sin();
                points.push(
                    Vec3::repeat(0.5)
                        + Vec3::new(t.sin() * f.cos(), t.sin() * f.sin(), t.cos()) * r,
                );
            }
        }
        let at = |i: usize, j: usize| (i * m + j % m) as u32;
        let mut faces = Vec::new();
        for i in 4..n {
            for j in 0..m {
                faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        let some: Vec<u32> = (0..faces.len() as u32).collect();
        let grain = Grain::of(&UnitFrame {
            offset: Vec3::zeros(),
            scale: 1.0,
            axes: crate::math::Axes::default(),
        });
        let field = Field::new(&some, &faces, &points, grain).unwrap();
        for k in 0..200 {
            let g = |a: f64| (f64::from(k) * a).fract();
            let p = Vec3::new(g(0.618), g(0.414), g(0.732));
            let all: f64 = some.iter().map(|&f| facing(&field.corners(f), &p, grain)).sum();
            let error = (field.at(&p, &mut 0) - all / (4.0 * PI)).abs();
            assert!(error < 5e-3, "{error} at {p}");
        }
    }
}
