//! The cap that closes a cut surface: loops of edges in the plane, sorted into outlines and the
//! holes in them.

use crate::error::{Result, collected, filled, push, reserve};
use crate::math::{Vec3, turn};

/// An outline and the holes in it, as vertices: counter-clockwise seen from outside, holes
/// clockwise.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Cap {
    pub loops: Vec<Vec<u32>>,
}

impl Cap {
    /// The edges of all loops.
    pub fn edges(&self) -> impl Iterator<Item = [u32; 2]> {
        self.loops
            .iter()
            .flat_map(|l| l.iter().zip(l.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]))
    }

    /// A fan about the first corner, each triangle with its sign: its integrals are those of the
    /// cap.
    pub fn fan(&self) -> impl Iterator<Item = [u32; 3]> {
        let apex = self.loops.first().and_then(|l| l.first()).copied();
        apex.into_iter().flat_map(move |p| {
            self.edges().filter(move |[a, b]| *a != p && *b != p).map(move |[a, b]| [p, a, b])
        })
    }
}

/// The two coordinates of points in a plane that tell turns, seen from where `normal` points.
pub(super) struct Flat<'a> {
    vertices: &'a [Vec3],
    axes: [usize; 2],
}

impl Flat<'_> {
    pub fn new<'a>(vertices: &'a [Vec3], normal: &Vec3) -> Flat<'a> {
        let axis = normal.iamax();
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let axes = if normal[axis] > 0.0 { [u, v] } else { [v, u] };
        Flat { vertices, axes }
    }

    #[inline]
    pub fn at(&self, v: u32) -> [f64; 2] {
        let p = &self.vertices[v as usize];
        [p[self.axes[0]], p[self.axes[1]]]
    }
}

/// The caps of directed edges in a plane with the given outward normal; as many edges end in each
/// vertex as start there.
pub(super) fn caps(mut edges: Vec<[u32; 2]>, vertices: &[Vec3], normal: &Vec3) -> Result<Vec<Cap>> {
    cancel(&mut edges)?;
    let flat = Flat::new(vertices, normal);
    let loops = loops(edges, &flat)?;
    nest(loops, &flat)
}

/// Takes out pairs of edges that run against each other.
fn cancel(edges: &mut Vec<[u32; 2]>) -> Result<()> {
    edges.sort_unstable_by_key(|&[a, b]| (a.min(b), a.max(b), a));
    let key = |e: &[u32; 2]| (e[0].min(e[1]), e[0].max(e[1]));
    if edges.windows(2).all(|w| key(&w[0]) != key(&w[1])) && edges.iter().all(|[a, b]| a != b) {
        return Ok(());
    }
    let mut kept = reserve("edges of a cap", edges.len())?;
    for same in edges.chunk_by(|a, b| key(a) == key(b)) {
        let Some(&[a, b]) = same.first().filter(|[a, b]| a != b) else { continue };
        let forward = same.iter().filter(|e| e[0] == a).count();
        let backward = same.len() - forward;
        let (edge, n) = if forward > backward {
            ([a, b], forward - backward)
        } else {
            ([b, a], backward - forward)
        };
        kept.extend(std::iter::repeat_n(edge, n));
    }
    *edges = kept;
    Ok(())
}

/// Follows the edges round. Where several start at one vertex, the sharpest turn to the left is
/// taken, so that loops that touch stay apart.
fn loops(mut edges: Vec<[u32; 2]>, flat: &Flat) -> Result<Vec<Vec<u32>>> {
    edges.sort_unstable();
    let mut used = filled("edges of a cap", edges.len(), false)?;
    let mut loops = Vec::new();
    for first in 0..edges.len() {
        if used[first] {
            continue;
        }
        let mut ring = Vec::new();
        let mut at = first;
        loop {
            used[at] = true;
            let [from, to] = edges[at];
            push("corners of a cap", &mut ring, from)?;
            let start = edges.partition_point(|e| e[0] < to);
            let out = (start..edges.len()).take_while(|&i| edges[i][0] == to);
            let mut free = out.filter(|&i| !used[i]);
            let Some(next) = free.next() else { break };
            at = match free.next() {
                None => next,
                Some(second) => {
                    let mut best = next;
                    for i in std::iter::once(second).chain(free) {
                        if more_left(flat, from, to, edges[i][1], edges[best][1]) {
                            best = i;
                        }
                    }
                    best
                }
            };
            // Round once more through the first edge's start is another loop's affair.
            if edges[at][0] == edges[first][0] && closes(flat, &edges, from, first, at) {
                break;
            }
        }
        push("loops of a cap", &mut loops, ring)?;
    }
    Ok(loops)
}

/// Whether a way that is back at the start of its first edge ends there rather than go on by
/// another one: the first edge has the sharper turn.
fn closes(flat: &Flat, edges: &[[u32; 2]], from: u32, first: usize, other: usize) -> bool {
    let at = edges[first][0];
    !more_left(flat, from, at, edges[other][1], edges[first][1])
}

/// Whether going from `a` over `b` to `c` turns more to the left than to `d`.
fn more_left(flat: &Flat, a: u32, b: u32, c: u32, d: u32) -> bool {
    let [a, b, c, d] = [a, b, c, d].map(|v| flat.at(v));
    let (lc, ld) = (turn(a, b, c), turn(a, b, d));
    // Among those on one side of the line the one to whose left the other does not lie.
    match (lc > 0.0, ld > 0.0) {
        (true, false) => true,
        (false, true) => false,
        _ => turn(b, d, c) > 0.0,
    }
}

/// A loop with what is asked of it.
struct Ring {
    corners: Vec<u32>,
    area: f64,
    lo: [f64; 2],
    hi: [f64; 2],
}

impl Ring {
    fn new(corners: Vec<u32>, flat: &Flat) -> Ring {
        let first = corners.first().map_or([0.0; 2], |&v| flat.at(v));
        let (mut lo, mut hi, mut area) = (first, first, 0.0);
        for w in corners.windows(2) {
            let [p, q] = [flat.at(w[0]), flat.at(w[1])];
            area += turn(first, p, q);
            for k in 0..2 {
                lo[k] = lo[k].min(q[k]);
                hi[k] = hi[k].max(q[k]);
            }
        }
        Ring { corners, area, lo, hi }
    }

    fn boxes(&self, other: &Ring) -> bool {
        (0..2).all(|k| self.lo[k] <= other.lo[k] && other.hi[k] <= self.hi[k])
    }

    /// Whether it goes round a point: crossings of a ray.
    fn holds(&self, flat: &Flat, p: [f64; 2]) -> bool {
        let mut inside = false;
        for (a, b) in self.corners.iter().zip(self.corners.iter().cycle().skip(1)) {
            let (a, b) = (flat.at(*a), flat.at(*b));
            if (a[1] > p[1]) != (b[1] > p[1]) {
                let (lower, upper) = if a[1] < b[1] { (a, b) } else { (b, a) };
                inside ^= turn(lower, upper, p) > 0.0;
            }
        }
        inside
    }
}

/// Puts holes to the smallest outline that each lies in.
fn nest(loops: Vec<Vec<u32>>, flat: &Flat) -> Result<Vec<Cap>> {
    let rings = collected("loops of a cap", loops.into_iter().map(|l| Ring::new(l, flat)))?;
    let (mut outlines, holes): (Vec<Ring>, Vec<Ring>) =
        rings.into_iter().partition(|r| r.area > 0.0);
    outlines.sort_by(|a, b| a.area.total_cmp(&b.area));
    let mut held: Vec<Vec<Vec<u32>>> = filled("caps", outlines.len(), Vec::new())?;
    let mut alone = Vec::new();
    for hole in holes {
        // The middle of an edge lies on no other loop's corner.
        let middle = match hole.corners.as_slice() {
            [a, b, ..] => [0, 1].map(|k| 0.5 * (flat.at(*a)[k] + flat.at(*b)[k])),
            _ => continue,
        };
        let around = outlines.iter().position(|o| o.boxes(&hole) && o.holds(flat, middle));
        match around.and_then(|i| held.get_mut(i)) {
            Some(held) => push("holes of a cap", held, hole.corners)?,
            None => push("caps", &mut alone, Cap { loops: vec![hole.corners] })?,
        }
    }
    let mut caps = reserve("caps", outlines.len() + alone.len())?;
    for (outline, mut holes) in outlines.into_iter().zip(held) {
        holes.insert(0, outline.corners);
        caps.push(Cap { loops: holes });
    }
    caps.extend(alone);
    Ok(caps)
}
