//! What is joined to what: the edge table and the patches of a mesh.

use crate::error::{Result, filled, push, reserve};

/// Sets that grow together; the lowest member stands for each.
pub struct Union {
    parent: Vec<u32>,
}

impl Union {
    /// `n` sets of one.
    pub fn new(n: usize) -> Result<Union> {
        let mut parent = reserve("sets", n)?;
        parent.extend(0..n as u32);
        Ok(Union { parent })
    }

    /// The lowest member of the set of `i`.
    pub fn root(&mut self, mut i: u32) -> u32 {
        while self.parent[i as usize] != i {
            let up = self.parent[self.parent[i as usize] as usize];
            self.parent[i as usize] = up;
            i = up;
        }
        i
    }

    /// Makes one set of two.
    pub fn join(&mut self, i: u32, j: u32) {
        let (a, b) = (self.root(i), self.root(j));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// The lowest member of each one's set.
    pub fn roots(mut self) -> Vec<u32> {
        for i in 0..self.parent.len() as u32 {
            self.parent[i as usize] = self.root(i);
        }
        self.parent
    }

    /// A number for each one's set, in the order of their lowest members, and how many sets.
    pub fn numbered(self) -> (Vec<u32>, usize) {
        let mut of = self.roots();
        let mut count = 0;
        for i in 0..of.len() {
            if of[i] as usize == i {
                of[i] = count;
                count += 1;
            } else {
                of[i] = of[of[i] as usize];
            }
        }
        (of, count as usize)
    }
}

/// One face's side of an edge.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// One vertex in the upper half, the other in the lower half.
    pub key: u64,
    /// The face.
    pub face: u32,
    /// Whether the face runs from the one vertex to the other.
    pub forward: bool,
}

/// All edges of a mesh.
#[derive(Debug)]
pub struct Edges {
    sides: Vec<Side>,
    /// Edges with one face.
    pub boundary: u64,
    /// Edges with more than two faces.
    pub nonmanifold: u64,
    /// Edges whose two faces run the same way (of more than two: that do not balance).
    pub misoriented: u64,
}

impl Edges {
    /// The edges of `faces` (three different vertices each).
    pub fn of(faces: &[[u32; 3]]) -> Result<Edges> {
        let each = |f: &[u32; 3]| [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])];
        // By the lesser vertex first, counting; then few lie together.
        let most = faces.iter().flatten().max().map_or(0, |&v| v as usize + 1);
        let mut starts = filled("edges", most + 1, 0u32)?;
        for (a, b) in faces.iter().flat_map(each) {
            starts[a.min(b) as usize + 1] += 1;
        }
        for v in 0..most {
            starts[v + 1] += starts[v];
        }
        let mut sides = filled("edges", faces.len() * 3, Side::default())?;
        for (i, f) in faces.iter().enumerate() {
            for (a, b) in each(f) {
                let key = (u64::from(a.min(b)) << 32) | u64::from(a.max(b));
                let next = &mut starts[a.min(b) as usize];
                sides[*next as usize] = Side { key, face: i as u32, forward: a < b };
                *next += 1;
            }
        }
        // Each start has become an end.
        let mut first = 0;
        for &end in &starts[..most] {
            sides[first..end as usize].sort_unstable();
            first = end as usize;
        }
        let mut edges = Edges { sides, boundary: 0, nonmanifold: 0, misoriented: 0 };
        let (mut boundary, mut nonmanifold, mut misoriented) = (0, 0, 0);
        for e in edges.iter() {
            let forward = e.iter().filter(|s| s.forward).count();
            match e.len() {
                1 => boundary += 1,
                n => {
                    nonmanifold += u64::from(n > 2);
                    misoriented += u64::from(n % 2 == 0 && 2 * forward != n);
                }
            }
        }
        edges.boundary = boundary;
        edges.nonmanifold = nonmanifold;
        edges.misoriented = misoriented;
        Ok(edges)
    }

    /// Gives the vertices other numbers.
    pub fn renumber(&mut self, index: &[u32]) {
        for s in &mut self.sides {
            let (from, to) = (index[(s.key >> 32) as usize], index[s.key as u32 as usize]);
            s.key = (u64::from(from) << 32) | u64::from(to);
        }
    }

    /// Edges that do not have exactly two faces.
    pub fn faulty(&self) -> u64 {
        self.boundary + self.nonmanifold
    }

    /// Whether two of `faces`, whose edges these are, have the same three vertices.
    pub fn has_twins(&self, faces: &[[u32; 3]]) -> bool {
        let third = |s: &Side| {
            let [a, b, c] = faces[s.face as usize];
            a ^ b ^ c ^ (s.key >> 32) as u32 ^ s.key as u32
        };
        self.iter().any(|e| match e {
            [a, b] => third(a) == third(b),
            e => (1..e.len()).any(|k| e[..k].iter().any(|s| third(s) == third(&e[k]))),
        })
    }

    /// The faces at each edge.
    pub fn iter(&self) -> impl Iterator<Item = &[Side]> {
        self.sides.chunk_by(|a, b| a.key == b.key)
    }
}

/// Which faces hang together.
pub struct Patches {
    /// The patch of each face, numbered in the order of their first faces.
    pub of: Vec<u32>,
    /// How many there are.
    pub count: usize,
}

/// Faces joined through edges with exactly two faces. Patches that are not closed
/// by themselves are then joined to those that they meet at an edge: so two cubes
/// that touch along an edge stay two, while three sheets that meet in one are one.
pub fn patches(faces: &[[u32; 3]], edges: &Edges) -> Result<Patches> {
    let mut union = Union::new(faces.len())?;
    for e in edges.iter() {
        if let [a, b] = e {
            union.join(a.face, b.face);
        }
    }
    // A patch is open where it has an odd number of faces at an edge.
    if edges.nonmanifold == 0 {
        let (of, count) = union.numbered();
        return Ok(Patches { of, count });
    }
    let mut open = filled("open patches", faces.len(), false)?;
    let mut here: Vec<u32> = Vec::new();
    for e in edges.iter().filter(|e| e.len() > 2) {
        here.clear();
        for s in e {
            push("patches", &mut here, union.root(s.face))?;
        }
        here.sort_unstable();
        for same in here.chunk_by(|a, b| a == b) {
            open[same[0] as usize] |= same.len() % 2 == 1;
        }
    }
    let mut roots: Vec<u32> = reserve("patches", faces.len())?;
    roots.extend((0..faces.len() as u32).map(|f| union.root(f)));
    for e in edges.iter().filter(|e| e.len() > 2) {
        let mut first = None;
        for r in e.iter().map(|s| roots[s.face as usize]).filter(|&r| open[r as usize]) {
            union.join(*first.get_or_insert(r), r);
        }
    }
    let (of, count) = union.numbered();
    Ok(Patches { of, count })
}
