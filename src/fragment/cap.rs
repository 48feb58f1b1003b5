//! The cap that closes a cut surface: loops of edges in the plane, sorted into outlines and the
//! holes in them, and cut into triangles where that is asked for.
//!
//! Whatever loops there are, triangles that are made of them have them as their border: a surface
//! stays closed even where rounding makes an outline cross itself.

use crate::error::{Result, collected, filled, push, reserve};
use crate::math::Vec3;

/// More corners than this are cut as a fan.
const MOST_EARS: usize = 1 << 15;
/// A corner turns left when the triangle there has more than this area, in units of the size.
const LEFT: f64 = 1e-14;

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
struct Flat<'a> {
    vertices: &'a [Vec3],
    axes: [usize; 2],
}

impl Flat<'_> {
    fn new<'a>(vertices: &'a [Vec3], normal: &Vec3) -> Flat<'a> {
        let axis = normal.iamax();
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let axes = if normal[axis] > 0.0 { [u, v] } else { [v, u] };
        Flat { vertices, axes }
    }

    #[inline]
    fn at(&self, v: u32) -> [f64; 2] {
        let p = &self.vertices[v as usize];
        [p[self.axes[0]], p[self.axes[1]]]
    }
}

/// Twice the area of a triangle, positive when it turns left.
#[inline]
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
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

/// Cuts a cap into triangles.
pub(super) fn triangulate(
    cap: &Cap,
    vertices: &[Vec3],
    normal: &Vec3,
    out: &mut Vec<[u32; 3]>,
) -> Result<()> {
    let flat = Flat::new(vertices, normal);
    let Some((outline, holes)) = cap.loops.split_first() else { return Ok(()) };
    let mut ring = collected("corners of a cap", outline.iter().copied())?;
    let right = |h: &Vec<u32>| {
        let by = |i: &usize, j: &usize| flat.at(h[*i])[0].total_cmp(&flat.at(h[*j])[0]);
        (0..h.len()).max_by(by).unwrap_or(0)
    };
    let mut order: Vec<(usize, &Vec<u32>)> = reserve("holes of a cap", holes.len())?;
    order.extend(holes.iter().map(|h| (right(h), h)));
    // From the right: a bridge then meets no hole that has none yet.
    order.sort_by(|(i, g), (j, h)| flat.at(h[*j])[0].total_cmp(&flat.at(g[*i])[0]));
    for (at, hole) in order {
        match bridge(&ring, flat.at(hole[at]), &flat) {
            Some(k) => {
                let mut whole = reserve("corners of a cap", ring.len() + hole.len() + 2)?;
                whole.extend_from_slice(&ring[..=k]);
                whole.extend_from_slice(&hole[at..]);
                whole.extend_from_slice(&hole[..=at]);
                whole.extend_from_slice(&ring[k..]);
                ring = whole;
            }
            None => ears(hole, &flat, out)?,
        }
    }
    ears(&ring, &flat, out)
}

/// The corner of a ring that a point sees (Eberly 2002): that at the next edge to the right, or the
/// hollow corner that hides it.
fn bridge(ring: &[u32], p: [f64; 2], flat: &Flat) -> Option<usize> {
    let n = ring.len();
    let mut best: Option<(f64, usize)> = None;
    for i in 0..n {
        let j = (i + 1) % n;
        let (a, b) = (flat.at(ring[i]), flat.at(ring[j]));
        // An edge of an outline on the right runs upward.
        if a[1] <= p[1] && p[1] <= b[1] && a[1] < b[1] {
            let x = a[0] + (b[0] - a[0]) * ((p[1] - a[1]) / (b[1] - a[1]));
            if x >= p[0] && best.is_none_or(|(least, _)| x < least) {
                best = Some((x, if a[0] > b[0] { i } else { j }));
            }
        }
    }
    let (x, corner) = best?;
    let (hit, q) = ([x, p[1]], flat.at(ring[corner]));
    // Corners in the triangle of the point, the hit and the edge's end hide the end.
    let [a, b, c] = if turn(p, hit, q) >= 0.0 { [p, hit, q] } else { [p, q, hit] };
    let slope = |s: [f64; 2]| (s[1] - p[1]).abs() / (s[0] - p[0]);
    let mut found: Option<(f64, f64, usize)> = None;
    for (k, &v) in ring.iter().enumerate() {
        let s = flat.at(v);
        let within = turn(a, b, s) >= 0.0 && turn(b, c, s) >= 0.0 && turn(c, a, s) >= 0.0;
        if within && s[0] > p[0] {
            let (before, after) = (flat.at(ring[(k + n - 1) % n]), flat.at(ring[(k + 1) % n]));
            // Of places that a bridge has made twice, the one whose corner opens to the point.
            if !opens(before, s, after, p) {
                continue;
            }
            let steep = slope(s);
            if found.is_none_or(|(least, x, _)| steep < least || steep == least && s[0] < x) {
                found = Some((steep, s[0], k));
            }
        }
    }
    Some(found.map_or(corner, |(_, _, k)| k))
}

/// Whether a point lies in the angle of a corner.
fn opens(before: [f64; 2], at: [f64; 2], after: [f64; 2], p: [f64; 2]) -> bool {
    let (in_first, in_second) = (turn(before, at, p) >= 0.0, turn(at, after, p) >= 0.0);
    if turn(before, at, after) > 0.0 { in_first && in_second } else { in_first || in_second }
}

/// Cuts a ring into triangles, ear by ear; what has none becomes a fan.
fn ears(ring: &[u32], flat: &Flat, out: &mut Vec<[u32; 3]>) -> Result<()> {
    let n = ring.len();
    let mut left: Vec<usize> = Vec::new();
    if n > 3 && n <= MOST_EARS {
        let mut ears = Ears::new(ring, flat)?;
        while let Some(t) = ears.cut() {
            push("faces of a cap", out, t.map(|i| ring[i]))?;
        }
        ears.left(&mut left)?;
    } else {
        left = collected("corners of a cap", 0..n)?;
    }
    if let [a, rest @ ..] = left.as_slice() {
        for w in rest.windows(2) {
            push("faces of a cap", out, [*a, w[0], w[1]].map(|i| ring[i]))?;
        }
    }
    Ok(())
}

/// A ring whose ears are cut off. What is an ear changes only beside the cut, and only corners that
/// do not turn left can lie in one.
struct Ears {
    at: Vec<[f64; 2]>,
    before: Vec<usize>,
    after: Vec<usize>,
    count: usize,
    ear: Vec<bool>,
    hollow: Vec<usize>,
    is_hollow: Vec<bool>,
    next: usize,
}

impl Ears {
    fn new(ring: &[u32], flat: &Flat) -> Result<Ears> {
        let n = ring.len();
        let first = flat.at(ring[0]);
        let size = ring
            .iter()
            .map(|&v| flat.at(v))
            .fold(0.0f64, |m, p| m.max((p[0] - first[0]).abs()).max((p[1] - first[1]).abs()));
        let scale = if size > 1e-150 { 1.0 / size } else { 1.0 };
        let unit = |&v: &u32| {
            let p = flat.at(v);
            [(p[0] - first[0]) * scale, (p[1] - first[1]) * scale]
        };
        let mut ears = Ears {
            at: collected("corners of a cap", ring.iter().map(unit))?,
            before: collected("corners of a cap", (0..n).map(|i| (i + n - 1) % n))?,
            after: collected("corners of a cap", (0..n).map(|i| (i + 1) % n))?,
            count: n,
            ear: filled("corners of a cap", n, false)?,
            hollow: reserve("corners of a cap", n)?,
            is_hollow: filled("corners of a cap", n, false)?,
            next: 0,
        };
        (0..n).for_each(|i| ears.judge_turn(i));
        (0..n).for_each(|i| ears.judge_ear(i));
        Ok(ears)
    }

    fn corner(&self, b: usize) -> [[f64; 2]; 3] {
        [self.before[b], b, self.after[b]].map(|i| self.at[i])
    }

    fn judge_turn(&mut self, b: usize) {
        let [p, q, r] = self.corner(b);
        let hollow = turn(p, q, r) <= LEFT;
        if hollow && !self.is_hollow[b] {
            self.hollow.push(b);
        }
        self.is_hollow[b] = hollow;
    }

    fn judge_ear(&mut self, b: usize) {
        self.ear[b] = false;
        if self.is_hollow[b] {
            return;
        }
        let [p, q, r] = self.corner(b);
        let lo = [0, 1].map(|k| p[k].min(q[k]).min(r[k]));
        let hi = [0, 1].map(|k| p[k].max(q[k]).max(r[k]));
        self.ear[b] = self.hollow.iter().all(|&i| {
            let s = self.at[i];
            s[0] < lo[0]
                || s[0] > hi[0]
                || s[1] < lo[1]
                || s[1] > hi[1]
                || !self.is_hollow[i]
                // Corners at one place, as at the ends of a bridge, do not count.
                || s == p
                || s == q
                || s == r
                || turn(p, q, s) < 0.0
                || turn(q, r, s) < 0.0
                || turn(r, p, s) < 0.0
        });
    }

    /// Cuts an ear off; `None` at the last triangle, or where there is no ear.
    fn cut(&mut self) -> Option<[usize; 3]> {
        if self.count <= 3 {
            return None;
        }
        let mut b = self.next;
        for _ in 0..self.count {
            if self.ear[b] {
                break;
            }
            b = self.after[b];
        }
        if !self.ear[b] {
            return None;
        }
        let (a, c) = (self.before[b], self.after[b]);
        self.after[a] = c;
        self.before[c] = a;
        self.count -= 1;
        self.is_hollow[b] = false;
        // A corner farther on: triangles stay broader than those of a fan.
        self.next = self.after[c];
        self.judge_turn(a);
        self.judge_turn(c);
        self.judge_ear(a);
        self.judge_ear(c);
        if self.hollow.len() > 64 && self.count.is_multiple_of(32) {
            let is_hollow = &self.is_hollow;
            self.hollow.retain(|&i| is_hollow[i]);
        }
        Some([a, b, c])
    }

    /// The corners that are left.
    fn left(&self, left: &mut Vec<usize>) -> Result<()> {
        let mut i = self.next;
        for _ in 0..self.count {
            push("corners of a cap", left, i)?;
            i = self.after[i];
        }
        Ok(())
    }
}
