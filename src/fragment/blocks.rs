//! Bodies of cells cut by planes, cell by cell: whole ones as they are, those that a plane cuts as
//! the polyhedron that is left of them.
//!
//! What convex half-spaces leave of a cell is convex, so it is of one component; neighbours are of
//! the same one where what is left of the face between them has an area.

use super::piece::Piece;
use super::region::no_part;
use super::{Mark, Region};
use crate::error::{Result, collected, filled, fits, push, reserve};
use crate::generate::Plane;
use crate::math::Vec3;
use crate::shape::Voxels;
use crate::solid::Solid;
use crate::solid::moments::Sums;

/// As near to a plane as this in the unit frame counts as on it.
pub(super) const ON: f64 = 1e-14;
/// Share of a cell, or of the face between two, below which nothing is left.
const NOTHING: f64 = 1e-12;
/// No node.
const NONE: u32 = u32::MAX;

/// Solid cells of a lattice, x fastest.
pub(super) struct Blocks<'a> {
    pub origin: Vec3,
    pub spacing: Vec3,
    pub dims: [usize; 3],
    pub cells: &'a [u8],
    /// Most bytes for one piece.
    pub limit: u64,
}

/// A cell of which something is left: the whole, or less.
struct Node {
    /// In the lattice.
    cell: usize,
    /// About its own middle, with its box, where a plane cuts it.
    cut: Option<Box<(Sums, [Vec3; 2])>>,
}

/// What planes leave of the cells, and what hangs together.
pub(super) struct Found {
    nodes: Vec<Node>,
    /// The component of each node, numbered by their first nodes.
    of: Vec<u32>,
    pub count: usize,
    /// First cell, cells along the axes, and the node of each cell.
    first: [usize; 3],
    dims: [usize; 3],
    at: Vec<u32>,
}

impl Found {
    /// The cells of which something is left, and whether that is less than the whole.
    pub fn cells(&self) -> impl Iterator<Item = (usize, bool)> {
        self.nodes.iter().map(|n| (n.cell, n.cut.is_some()))
    }

    /// The component of a cell of the lattice, if anything of it is left.
    pub fn component(&self, at: [usize; 3]) -> Option<usize> {
        let mut local = [0; 3];
        for a in 0..3 {
            local[a] = at[a].checked_sub(self.first[a]).filter(|&i| i < self.dims[a])?;
        }
        let i = local[0] + self.dims[0] * (local[1] + self.dims[1] * local[2]);
        let node = *self.at.get(i)?;
        self.of.get(node as usize).map(|&c| c as usize)
    }
}

impl<'a> Blocks<'a> {
    /// Of voxels.
    pub fn of(v: &'a Voxels, limit: u64) -> Blocks<'a> {
        let (spacing, dims, cells) = (v.spacing, v.dims, v.cells.as_slice());
        Blocks { origin: Vec3::zeros(), spacing, dims, cells, limit }
    }

    /// Of the cells inside a solid.
    pub fn of_grid(solid: &'a Solid) -> Result<Blocks<'a>> {
        let (grid, cells, limit) = (solid.grid(), solid.inside()?, solid.memory_limit());
        Ok(Blocks { origin: grid.origin, spacing: grid.spacing, dims: grid.dims, cells, limit })
    }
}

impl Blocks<'_> {
    pub fn place(&self, cell: usize) -> [usize; 3] {
        let [nx, ny, _] = self.dims;
        [cell % nx, cell / nx % ny, cell / (nx * ny)]
    }

    /// Corners of a cell.
    pub fn corners(&self, at: [usize; 3]) -> [Vec3; 2] {
        [0, 1]
            .map(|up| Vec3::from_fn(|a, _| self.origin[a] + (at[a] + up) as f64 * self.spacing[a]))
    }

    /// The cells that a box touches, along one axis.
    fn span(&self, axis: usize, from: f64, to: f64) -> [usize; 2] {
        let n = self.dims[axis];
        let at = |x: f64| ((x - self.origin[axis]) / self.spacing[axis]).clamp(0.0, n as f64);
        let first = (at(from) - 1e-9).max(0.0) as usize;
        [first.min(n), ((at(to) + 1e-9).ceil() as usize).min(n)]
    }

    /// What planes leave of the cells in a box.
    pub fn within(&self, planes: &[Plane], [lo, hi]: &[Vec3; 2]) -> Result<Found> {
        let spans = [0, 1, 2].map(|a| self.span(a, lo[a], hi[a]));
        let first = spans.map(|s| s[0]);
        let dims = spans.map(|[from, to]| to.saturating_sub(from));
        let n = dims[0] * dims[1] * dims[2];
        fits(format_args!("the cells of a piece"), 16 * n as u64, self.limit)?;
        let mut found = Found {
            nodes: Vec::new(),
            of: Vec::new(),
            count: 0,
            first,
            dims,
            at: filled("cells of a piece", n, NONE)?,
        };
        let mut through: Vec<Plane> = reserve("planes", planes.len())?;
        for k in 0..dims[2] {
            for j in 0..dims[1] {
                let [from, to] = self.row(planes, [first[0], first[1] + j, first[2] + k], dims[0]);
                for i in from..to {
                    let at = [first[0] + i, first[1] + j, first[2] + k];
                    let cell = at[0] + self.dims[0] * (at[1] + self.dims[1] * at[2]);
                    let solid = self.cells.get(cell).is_some_and(|&c| c != 0);
                    if !solid {
                        continue;
                    }
                    let Some(node) = self.node(cell, at, planes, &mut through)? else { continue };
                    let local = i + dims[0] * (j + dims[1] * k);
                    found.at[local] = found.nodes.len() as u32;
                    push("cells of a piece", &mut found.nodes, node)?;
                }
            }
        }
        self.join(planes, &mut found)?;
        Ok(found)
    }

    /// The cells of a row that may lie within the planes, counted from `at`; some more at its ends.
    fn row(&self, planes: &[Plane], at: [usize; 3], n: usize) -> [usize; 2] {
        let (mut from, mut to) = (0.0f64, n as f64);
        let [lo, hi] = self.corners(at);
        for plane in planes {
            let middle = plane.normal.dot(&((lo + hi) * 0.5)) - plane.offset;
            let reach = 0.5 * plane.normal.abs().dot(&self.spacing);
            let step = plane.normal.x * self.spacing.x;
            // The cells i with middle + i step < reach.
            let room = reach - middle;
            if step.abs() * (n as f64 + 1.0) < 1e-12 {
                if room < -1e-12 {
                    return [0, 0];
                }
            } else if step > 0.0 {
                to = to.min(room / step + 2.0);
            } else {
                from = from.max(room / step - 2.0);
            }
        }
        let clamp = |x: f64| x.clamp(0.0, n as f64);
        [clamp(from.floor()) as usize, clamp(to.ceil()) as usize]
    }

    /// What is left of a cell.
    fn node(
        &self,
        cell: usize,
        at: [usize; 3],
        planes: &[Plane],
        through: &mut Vec<Plane>,
    ) -> Result<Option<Node>> {
        let [lo, hi] = self.corners(at);
        let middle = (lo + hi) * 0.5;
        if !self.through(planes, &middle, through) {
            return Ok(None);
        }
        if through.is_empty() {
            return Ok(Some(Node { cell, cut: None }));
        }
        let Some(piece) = Piece::cuboid(&lo, &hi).within(through)? else { return Ok(None) };
        let sums = piece.sums(&middle);
        let whole = self.spacing.x * self.spacing.y * self.spacing.z;
        if sums.volume <= NOTHING * whole {
            return Ok(None);
        }
        Ok(Some(Node { cell, cut: Some(Box::new((sums, *piece.bounds()))) }))
    }

    /// The planes that cut the cell about a point; whether anything of it lies within them all.
    pub fn through(&self, planes: &[Plane], middle: &Vec3, through: &mut Vec<Plane>) -> bool {
        through.clear();
        for plane in planes {
            let h = plane.normal.dot(middle) - plane.offset;
            let reach = 0.5 * plane.normal.abs().dot(&self.spacing);
            if h >= reach - ON {
                return false;
            }
            if h > ON - reach {
                through.push(*plane);
            }
        }
        true
    }

    /// Finds what hangs together.
    fn join(&self, planes: &[Plane], found: &mut Found) -> Result<()> {
        let mut up: Vec<u32> = reserve("cells of a piece", found.nodes.len())?;
        up.extend(0..found.nodes.len() as u32);
        fn root(up: &mut [u32], mut v: u32) -> u32 {
            while up[v as usize] != v {
                let over = up[up[v as usize] as usize];
                up[v as usize] = over;
                v = over;
            }
            v
        }
        let [nx, ny, nz] = found.dims;
        let strides = [1, nx, nx * ny];
        for local in 0..found.at.len() {
            let a = found.at[local];
            if a == NONE {
                continue;
            }
            let at = [local % nx, local / nx % ny, local / (nx * ny)];
            for axis in 0..3 {
                if at[axis] + 1 >= [nx, ny, nz][axis] {
                    continue;
                }
                let b = found.at[local + strides[axis]];
                if b == NONE {
                    continue;
                }
                let (ra, rb) = (root(&mut up, a), root(&mut up, b));
                if ra == rb {
                    continue;
                }
                let whole = |n: u32| found.nodes[n as usize].cut.is_none();
                if whole(a) && whole(b)
                    || self.open(self.place(found.nodes[a as usize].cell), axis, planes)
                {
                    up[ra.max(rb) as usize] = ra.min(rb);
                }
            }
        }
        for v in 0..up.len() {
            if up[v] as usize == v {
                up[v] = found.count as u32;
                found.count += 1;
            } else {
                up[v] = up[up[v] as usize];
            }
        }
        found.of = up;
        Ok(())
    }

    /// Whether planes leave an area of the upper face of a cell along an axis.
    fn open(&self, at: [usize; 3], axis: usize, planes: &[Plane]) -> bool {
        let [lo, hi] = self.corners(at);
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let corner = |a: &Vec3, b: &Vec3| {
            let mut p = hi;
            p[u] = a[u];
            p[v] = b[v];
            p
        };
        let mut face = vec![corner(&lo, &lo), corner(&hi, &lo), corner(&hi, &hi), corner(&lo, &hi)];
        let mut next = Vec::new();
        for plane in planes {
            let height = |p: &Vec3| plane.normal.dot(p) - plane.offset;
            next.clear();
            for (p, q) in face.iter().zip(face.iter().cycle().skip(1)) {
                let (a, b) = (height(p), height(q));
                if a <= 0.0 {
                    next.push(*p);
                }
                if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
                    next.push((p * b.abs() + q * a.abs()) / (a.abs() + b.abs()));
                }
            }
            std::mem::swap(&mut face, &mut next);
        }
        let Some(first) = face.first() else { return false };
        let area: f64 = face.windows(2).map(|w| (w[0] - first).cross(&(w[1] - first)).norm()).sum();
        area > NOTHING * self.spacing[u] * self.spacing[v]
    }

    /// The cells of the component that a region is, or nothing where it is all that there is.
    pub fn members(&self, region: &Region) -> Result<Option<Vec<bool>>> {
        let Some(anchor) = region.anchor else { return Ok(None) };
        let found = self.within(&region.planes, &[region.lo, region.hi])?;
        let own = found.component(self.place(anchor as usize)).ok_or_else(no_part)?;
        let mut members = filled("cells of a region", self.cells.len(), false)?;
        for (node, &c) in found.nodes.iter().zip(&found.of) {
            if let Some(m) = members.get_mut(node.cell).filter(|_| c as usize == own) {
                *m = true;
            }
        }
        Ok(Some(members))
    }

    /// The regions of what was found, each with a cell that is its own; `least`: those of less
    /// volume have no mark.
    pub fn regions(
        &self,
        found: &Found,
        planes: &[Plane],
        cell: usize,
        least: f64,
    ) -> Result<Vec<Region>> {
        let empty = Region {
            planes: Vec::new(),
            mark: None,
            moments: Sums::default().moments(&Vec3::zeros()),
            lo: Vec3::repeat(f64::MAX),
            hi: Vec3::repeat(f64::MIN),
            anchor: None,
            cell,
        };
        let mut regions = filled("regions", found.count, empty)?;
        for (node, &c) in found.nodes.iter().zip(&found.of) {
            let [lo, hi] = self.box_of(node);
            let r = &mut regions[c as usize];
            (r.lo, r.hi) = (r.lo.inf(&lo), r.hi.sup(&hi));
        }
        let mut sums = filled("regions", found.count, Sums::default())?;
        let mut most = filled("regions", found.count, 0.0f64)?;
        let volume = self.spacing.x * self.spacing.y * self.spacing.z;
        let mut i = 0;
        while let (Some(node), Some(&c)) = (found.nodes.get(i), found.of.get(i)) {
            let r = &mut regions[c as usize];
            let middle = (r.lo + r.hi) * 0.5;
            let [lo, mut hi] = self.corners(self.place(node.cell));
            let mut held = volume;
            match &node.cut {
                Some(cut) => {
                    held = cut.0.volume;
                    sums[c as usize].add(&cut.0.shifted(&((lo + hi) * 0.5 - middle)));
                    i += 1;
                }
                None => {
                    // A run of whole cells is one box.
                    let mut end = i + 1;
                    let row = |cell: usize| cell / self.dims[0].max(1);
                    while let (Some(next), Some(&d)) = (found.nodes.get(end), found.of.get(end)) {
                        let follows = next.cell == node.cell + (end - i)
                            && row(next.cell) == row(node.cell)
                            && next.cut.is_none()
                            && d == c;
                        if !follows {
                            break;
                        }
                        end += 1;
                    }
                    hi.x = self.corners(self.place(node.cell + (end - i) - 1))[1].x;
                    sums[c as usize].cuboid(&(lo - middle), &(hi - middle));
                    i = end;
                }
            }
            if held > most[c as usize] {
                most[c as usize] = held;
                r.anchor = Some(node.cell as u64);
            }
        }
        for (r, sums) in regions.iter_mut().zip(&sums) {
            r.moments = sums.moments(&((r.lo + r.hi) * 0.5));
            r.planes = collected("planes", planes.iter().copied())?;
        }
        self.mark(found, &mut regions, least)?;
        Ok(regions)
    }

    /// Gives regions their marks, where there are several.
    fn mark(&self, found: &Found, regions: &mut [Region], least: f64) -> Result<()> {
        if found.count < 2 {
            return Ok(());
        }
        for (c, r) in regions.iter_mut().enumerate().filter(|(_, r)| r.moments.volume >= least) {
            let others = found.nodes.iter().zip(&found.of).filter(|(_, of)| **of as usize != c);
            r.mark = Some(Mark::of_boxes(&r.lo, &r.hi, others.map(|(n, _)| self.box_of(n)))?);
        }
        Ok(())
    }

    fn box_of(&self, node: &Node) -> [Vec3; 2] {
        node.cut.as_ref().map_or_else(|| self.corners(self.place(node.cell)), |cut| cut.1)
    }

    /// A cell that holds a point, or that next to the lattice's border.
    pub fn cell_of(&self, p: &Vec3) -> [usize; 3] {
        [0, 1, 2].map(|a| {
            let x = (p[a] - self.origin[a]) / self.spacing[a];
            (x.max(0.0) as usize).min(self.dims[a].saturating_sub(1))
        })
    }
}
