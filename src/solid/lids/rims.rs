//! The rims of a mesh's openings: the border cut into closed ways that pass no vertex twice.

use crate::error::{Result, collected, filled, push};
use crate::math::Vec3;
use crate::shape::Mesh;

const WHAT: &str = "the rims of openings";
const NONE: u32 = u32::MAX;

pub(super) struct Rims {
    /// Rim `i` owns `all[starts[i]..starts[i + 1]]`, in the direction of the faces beside it.
    all: Vec<u32>,
    starts: Vec<usize>,
    /// Whether each of its edges has exactly one face.
    plain: Vec<bool>,
}

impl Rims {
    /// Of the border of a mesh: as many of its edges lead to a vertex as away from it, so that every
    /// way ends where it began. Where several openings meet in a vertex it is cut there.
    pub fn of(mesh: &Mesh, border: &[[u32; 2]]) -> Result<Rims> {
        let mut edges = collected(WHAT, border.iter().copied())?;
        edges.sort_unstable();
        let mut used = filled(WHAT, edges.len(), false)?;
        // Places of the vertices on the way so far, by the first edge that leads away.
        let first = |v: u32| edges.partition_point(|e| e[0] < v);
        let mut place = filled(WHAT, edges.len(), NONE)?;
        // The next edge to look at, by the same.
        let mut next = collected(WHAT, 0..edges.len())?;
        let mut rims = Rims { all: Vec::new(), starts: vec![0], plain: Vec::new() };
        let mut way: Vec<u32> = Vec::new();
        for start in 0..edges.len() {
            if used[start] {
                continue;
            }
            let mut v = edges[start][0];
            loop {
                let k = first(v);
                if k >= edges.len() || edges[k][0] != v {
                    // Not the border of anything; its edges stay open.
                    break;
                }
                if place[k] != NONE {
                    let from = place[k] as usize;
                    for &u in &way[from..] {
                        push(WHAT, &mut rims.all, u)?;
                        place[first(u)] = NONE;
                    }
                    way.truncate(from);
                    push(WHAT, &mut rims.starts, rims.all.len())?;
                }
                let mut at = next[k];
                while edges.get(at).is_some_and(|e| e[0] == v) && used[at] {
                    at += 1;
                }
                next[k] = at;
                if edges.get(at).is_none_or(|e| e[0] != v) {
                    break;
                }
                used[at] = true;
                place[k] = way.len() as u32;
                push(WHAT, &mut way, v)?;
                v = edges[at][1];
            }
            for u in way.drain(..) {
                place[first(u)] = NONE;
            }
        }
        rims.mark(mesh, border)?;
        Ok(rims)
    }

    /// Finds the rims along which each edge has one face.
    fn mark(&mut self, mesh: &Mesh, border: &[[u32; 2]]) -> Result<()> {
        let key = |a: u32, b: u32| [a.min(b), a.max(b)];
        let mut keys = collected(WHAT, border.iter().map(|&[a, b]| key(a, b)))?;
        keys.sort_unstable();
        let mut on = filled(WHAT, mesh.vertices.len(), false)?;
        border.iter().flatten().for_each(|&v| on[v as usize] = true);
        let mut faces = filled(WHAT, keys.len(), 0u32)?;
        for &[a, b, c] in &mesh.faces {
            for (a, b) in [(a, b), (b, c), (c, a)] {
                if on[a as usize] && on[b as usize] {
                    let i = keys.partition_point(|k| *k < key(a, b));
                    if keys.get(i) == Some(&key(a, b)) {
                        faces[i] += 1;
                    }
                }
            }
        }
        let single = |a: u32, b: u32| {
            faces.get(keys.partition_point(|k| *k < key(a, b))).is_some_and(|&n| n == 1)
        };
        for i in 0..self.len() {
            let rim = self.vertices(i);
            let ends = rim.iter().zip(rim.iter().skip(1).chain(rim.first()));
            let plain = rim.len() > 2 && ends.into_iter().all(|(&a, &b)| single(a, b));
            push(WHAT, &mut self.plain, plain)?;
        }
        Ok(())
    }

    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub fn vertices(&self, i: usize) -> &[u32] {
        self.all.get(self.starts[i]..self.starts[i + 1]).unwrap_or_default()
    }

    pub fn points(&self, mesh: &Mesh, i: usize) -> Result<Vec<Vec3>> {
        collected(WHAT, self.vertices(i).iter().map(|&v| mesh.vertices[v as usize]))
    }

    pub fn plain(&self, i: usize) -> bool {
        self.plain[i]
    }
}
