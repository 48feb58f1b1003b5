//! Faces without area: taken out so that nothing opens.

use super::topology::{Edges, Union};
use crate::error::{Result, collected, filled, push};
use crate::math::Vec3;

/// What is reserved.
const WHAT: &str = "faces without area";

/// Passes at most: one does for chains of such faces; more where some lie at edges with more than
/// two faces.
const PASSES: usize = 32;
/// A face cuts others at most so often in a pass: it is a handful of times in a chain of hundreds.
const CUTS: u8 = 32;

/// What an edge is short to, in heights of faces without area: cut so near to its end, a face
/// leaves a part without area again, for all but sharp corners.
const SHORT: f64 = 16.0;

/// Height over the longest edge, and which corner is opposite to it.
fn height(f: &[u32; 3], points: &[Vec3]) -> (f64, usize) {
    let at = |v: u32| points[v as usize];
    let (a, b, c) = (at(f[0]), at(f[1]), at(f[2]));
    let edges = [(c - b).norm(), (a - c).norm(), (b - a).norm()];
    let mut apex = 0;
    for k in 1..3 {
        if edges[k] > edges[apex] {
            apex = k;
        }
    }
    let double_area = (b - a).cross(&(c - a)).norm();
    if double_area > 0.0 { (double_area / edges[apex], apex) } else { (0.0, apex) }
}

/// Whether a face may be lower than `than`: no, when none is lower by a wide margin.
pub fn may_be_low(faces: &[[u32; 3]], points: &[Vec3], than: f64) -> bool {
    faces.iter().any(|f| {
        let at = |v: u32| points[v as usize];
        let (a, b, c) = (at(f[0]), at(f[1]), at(f[2]));
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let longest2 = ab.norm_squared().max(bc.norm_squared()).max(ca.norm_squared());
        // Height times longest edge is twice the area.
        let area2 = ab.cross(&ca).norm_squared();
        area2.is_nan() || area2 <= 1.01 * than * than * longest2
    })
}

/// Takes out faces whose corners lie on a line; how many. Where two of them are one place, they
/// become one vertex. Else the apex of such a face lies on its longest edge; when one other face is
/// there, that one is cut in two at the apex, so that nothing opens. Faces lower than `reach` that only hang on to
/// others (more of their edges are free than shared by two) are taken out, too.
/// A face lower than `no_area` has none.
pub fn drop_flat(
    faces: &mut Vec<[u32; 3]>,
    points: &[Vec3],
    reach: f64,
    no_area: f64,
) -> Result<u64> {
    let mut dropped = faces.iter().filter(|f| height(f, points).0 <= no_area).count() as u64;
    dropped += collapse(faces, points, no_area)?;
    for _ in 0..PASSES {
        let is_low = |&i: &u32| height(&faces[i as usize], points).0 <= reach.max(no_area);
        let low = collected(WHAT, (0..faces.len() as u32).filter(is_low))?;
        if low.is_empty() {
            return Ok(dropped);
        }
        let at = at_edges(faces, &Edges::of(faces)?)?;
        let gone = filled(WHAT, faces.len(), false)?;
        let cuts = filled(WHAT, faces.len(), 0)?;
        let mut pass = Pass { faces, points, reach, no_area, at, gone, cuts };
        for &i in &low {
            dropped += pass.peel(i)?;
        }
        for &i in &low {
            pass.heal(i)?;
        }
        let Pass { gone, cuts, .. } = pass;
        let mut left = gone.iter();
        faces.retain(|_| !left.next().is_some_and(|&g| g));
        if !gone.contains(&true) && cuts.iter().all(|&c| c == 0) {
            break;
        }
    }
    // What could not be healed by cutting goes.
    faces.retain(|f| height(f, points).0 > no_area);
    Ok(dropped)
}

/// Makes one vertex of those that the short edges of faces without area join; the faces there
/// vanish: how many of them have an area.
fn collapse(faces: &mut Vec<[u32; 3]>, points: &[Vec3], no_area: f64) -> Result<u64> {
    let is_flat = |f: &[u32; 3]| height(f, points).0 <= no_area;
    let length = |a: u32, b: u32| (points[a as usize] - points[b as usize]).norm();
    let mut union = Union::new(points.len())?;
    for &[a, b, c] in faces.iter().filter(|f| is_flat(f)) {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            if length(p, q) <= SHORT * no_area {
                union.join(p, q);
            }
        }
    }
    let root = union.roots();
    let mut count = 0;
    faces.retain_mut(|f| {
        let flat = is_flat(f);
        *f = f.map(|v| root[v as usize]);
        let stays = f[0] != f[1] && f[1] != f[2] && f[2] != f[0];
        count += u64::from(!stays && !flat);
        stays
    });
    Ok(count)
}

/// What a pass knows of the faces.
struct Pass<'a> {
    faces: &'a mut [[u32; 3]],
    points: &'a [Vec3],
    reach: f64,
    no_area: f64,
    /// As [`at_edges`] gives it, kept up to date where one or two faces are at an edge.
    at: Vec<[(usize, u32); 3]>,
    gone: Vec<bool>,
    /// How often each face without area has cut another.
    cuts: Vec<u8>,
}

impl Pass<'_> {
    fn height(&self, i: u32) -> (f64, usize) {
        height(&self.faces[i as usize], self.points)
    }

    /// Takes out the face `i` if it only hangs on to others, then those that hung on to it; how
    /// many of them have an area.
    fn peel(&mut self, i: u32) -> Result<u64> {
        let mut count = 0;
        let mut next = collected(WHAT, [i])?;
        while let Some(i) = next.pop() {
            let (h, _) = self.height(i);
            let at = self.at[i as usize];
            let of = |n: usize| at.iter().filter(|e| e.0 == n).count();
            if self.gone[i as usize] || h > self.reach.max(self.no_area) || of(1) <= of(2) {
                continue;
            }
            self.gone[i as usize] = true;
            count += u64::from(h > self.no_area);
            let [a, b, c] = self.faces[i as usize];
            for (edge, e) in [[b, c], [c, a], [a, b]].into_iter().zip(at).filter(|(_, e)| e.0 == 2)
            {
                self.tell(e, edge, (1, e.1));
                push(WHAT, &mut next, e.1)?;
            }
        }
        Ok(count)
    }

    /// The other face at an edge with two faces is told what it meets there.
    fn tell(&mut self, (count, other): (usize, u32), edge: [u32; 2], meets: (usize, u32)) {
        if count == 2 {
            let corner = opposite(&self.faces[other as usize], edge);
            self.at[other as usize][corner] = meets;
        }
    }

    /// Cuts what lies at the longest edge of the face `i`, when that has no area, and goes on
    /// with what comes to lie beside the parts.
    fn heal(&mut self, i: u32) -> Result<()> {
        let mut next = collected(WHAT, [i])?;
        while let Some(i) = next.pop() {
            let (h, apex) = self.height(i);
            if self.gone[i as usize] || h > self.no_area || self.cuts[i as usize] == CUTS {
                continue;
            }
            let (count, o) = self.at[i as usize][apex];
            if count != 2 {
                self.gone[i as usize] = true;
                continue;
            }
            // When the other one has no area and a longer edge, that is cut first.
            let (h, longest) = self.height(o);
            let waits = h <= self.no_area && self.at[o as usize][longest] != (2, i);
            if self.gone[o as usize] || waits {
                continue;
            }
            self.cuts[i as usize] += 1;
            self.cut(i, apex, o);
            for part in [i, o] {
                push(WHAT, &mut next, part)?;
                for (count, n) in self.at[part as usize] {
                    if count == 2 {
                        push(WHAT, &mut next, n)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Cuts the face `o`, at the longest edge of the face `i`, at the apex of that one: the two
    /// are the parts then.
    fn cut(&mut self, i: u32, apex: usize, o: u32) {
        let [m, a, b] = [0, 1, 2].map(|k| self.faces[i as usize][(apex + k) % 3]);
        let face = self.faces[o as usize];
        if face.contains(&m) {
            self.gone[i as usize] = true;
            return;
        }
        // The other face is a, b, x in either sense: a, m, x stays there, m, b, x comes here.
        let with = |from: u32| face.map(|v| if v == from { m } else { v });
        let at_x = opposite(&face, [a, b]);
        let x = face[at_x];
        let [at_a, at_b] = [[b, x], [a, x]].map(|edge| opposite(&face, edge));
        let [_, bm, ma] = [0, 1, 2].map(|k| self.at[i as usize][(apex + k) % 3]);
        let bx = self.at[o as usize][at_a];
        self.tell(ma, [m, a], (2, o));
        self.tell(bx, [b, x], (2, i));
        (self.faces[o as usize], self.faces[i as usize]) = (with(b), with(a));
        let there = &mut self.at[o as usize];
        (there[at_x], there[at_a]) = (ma, (2, i));
        let here = &mut self.at[i as usize];
        (here[at_x], here[at_a], here[at_b]) = (bm, bx, (2, o));
    }
}

/// The corner of a face that is not on an edge of it.
fn opposite(face: &[u32; 3], edge: [u32; 2]) -> usize {
    face.iter().position(|v| !edge.contains(v)).unwrap_or(0)
}

/// For each face and corner: how many faces are at the edge opposite to the corner,
/// and another one of them.
fn at_edges(faces: &[[u32; 3]], edges: &Edges) -> Result<Vec<[(usize, u32); 3]>> {
    let mut at = filled("edges of faces", faces.len(), [(0, 0); 3])?;
    for e in edges.iter() {
        for s in e {
            let corner = opposite(&faces[s.face as usize], [(s.key >> 32) as u32, s.key as u32]);
            let other = e.iter().find(|t| t.face != s.face).map_or(s.face, |t| t.face);
            at[s.face as usize][corner] = (e.len(), other);
        }
    }
    Ok(at)
}
