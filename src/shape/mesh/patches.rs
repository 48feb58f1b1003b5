//! Patches: open parts that close each other's openings.

use super::check::Grain;
use super::field::Field;
use super::inside;
use super::parts::Part;
use super::topology::Union;
use super::tree::{Bounds, Tree};
use crate::error::{Result, filled, push, reserve};
use crate::math::Vec3;
use crate::run::Run;

/// Patches of one surface may be this far apart (unit frame).
const NEAR: f64 = 1e-3;

/// After this many looks at faces the parts that are left, the smallest, are taken to be as
/// most of the others: a heap of triangles across one another has no near and far.
const MOST_LOOKS: u64 = 20_000_000;

/// Parts between two questions whether to go on.
const OFTEN: usize = 64;

/// Rounds of joining; in each one most groups at least double.
const ROUNDS: usize = 32;

/// Judges the open parts by their openness, alone and in the field of all, and makes one of
/// those that close each other's openings: a part that is twice as closed among the others as
/// alone goes to the next larger one that is near, and with what has joined it again to the
/// next larger group.
pub fn join(
    mut parts: Vec<Part>,
    faces: &[[u32; 3]],
    points: &[Vec3],
    grain: Grain,
    run: &Run,
) -> Result<Vec<Part>> {
    let mut open: Vec<u32> = reserve("open parts", parts.len())?;
    open.extend((0..parts.len() as u32).filter(|&i| parts[i as usize].extent.open));
    let closed = closed_by_others(&mut parts, &open, faces, points, grain, run)?;
    if closed.contains(&true) {
        let union = groups(&parts, &open, &closed, NEAR.max(grain.touch()))?;
        for i in unite(&mut parts, union, &open)? {
            run.check(0.6, "judging the openings of the mesh")?;
            let part = &mut parts[i as usize];
            let mine = part.faces.iter().map(|&f| &faces[f as usize]);
            part.extent.volume = inside::volume_of_patches(mine.clone(), points);
            let field = Field::new(&part.faces, faces, points, grain)?;
            part.openness =
                inside::openness(&inside::samples(mine, points)?, &field, run.pool(), &mut 0);
        }
    }
    parts.retain(|p| !p.faces.is_empty());
    parts.sort_by_key(|p| p.faces[0]);
    Ok(parts)
}

/// Finds the openness of the open parts, and whether the others close them; by part.
fn closed_by_others(
    parts: &mut [Part],
    open: &[u32],
    faces: &[[u32; 3]],
    points: &[Vec3],
    grain: Grain,
    run: &Run,
) -> Result<Vec<bool>> {
    let mut closed = filled("parts", parts.len(), false)?;
    let mut together = None;
    if open.len() > 1 {
        let mut all: Vec<u32> = Vec::new();
        for &f in open.iter().flat_map(|&i| &parts[i as usize].faces) {
            push("open faces", &mut all, f)?;
        }
        together = Some(Field::new(&all, faces, points, grain)?);
    }
    // The largest first; those of one size in their order.
    let mut order: Vec<u32> = reserve("open parts", open.len())?;
    order.extend(open);
    let area = |i: u32| parts[i as usize].extent.area;
    order.sort_unstable_by(|&a, &b| area(b).total_cmp(&area(a)).then(a.cmp(&b)));
    let (mut looks, mut yes) = (0, 0);
    for (k, &i) in order.iter().enumerate() {
        if k.is_multiple_of(OFTEN) {
            run.check(0.5, "judging the openings of the mesh")?;
        }
        let part = &mut parts[i as usize];
        let at = inside::samples(part.faces.iter().map(|&f| &faces[f as usize]), points)?;
        let alone = Field::new(&part.faces, faces, points, grain)?;
        part.openness = inside::openness(&at, &alone, run.pool(), &mut 0);
        if let Some(together) = &together {
            closed[i as usize] = if looks < MOST_LOOKS {
                let all = inside::openness(&at, together, run.pool(), &mut looks);
                all <= 0.5 * part.openness
            } else {
                2 * yes > k
            };
            yes += usize::from(closed[i as usize]);
        }
    }
    Ok(closed)
}

/// Some open parts that are one.
#[derive(Clone, Copy)]
struct Group {
    /// One of its parts.
    part: u32,
    bounds: Bounds,
    area: f64,
    /// Whether the others close its largest part.
    closed: bool,
}

/// Which open parts are one.
fn groups(parts: &[Part], open: &[u32], closed: &[bool], reach: f64) -> Result<Union> {
    let mut union = Union::new(parts.len())?;
    let mut groups: Vec<Group> = reserve("open parts", open.len())?;
    groups.extend(open.iter().map(|&i| {
        let part = &parts[i as usize];
        let (bounds, area) = (part.bounds, part.extent.area);
        Group { part: i, bounds, area, closed: closed[i as usize] }
    }));
    for _ in 0..ROUNDS {
        groups.sort_unstable_by(|a, b| b.area.total_cmp(&a.area).then(a.part.cmp(&b.part)));
        let mut next = filled("open parts", groups.len(), None)?;
        let mut larger = Larger::new(&groups)?;
        for (k, g) in groups.iter().enumerate() {
            if g.closed {
                next[k] = larger.latest(0, &g.bounds, reach, None);
            }
            larger.add(k as u32);
        }
        // Larger ones come first, so from the last on each has all that goes to it.
        let mut any = false;
        for k in (0..groups.len()).rev() {
            if let Some(j) = next[k].map(|j| j as usize) {
                any = true;
                union.join(groups[k].part, groups[j].part);
                groups[j].bounds = groups[j].bounds.join(&groups[k].bounds);
                groups[j].area += groups[k].area;
            }
        }
        if !any {
            break;
        }
        let mut it = next.iter();
        groups.retain(|_| it.next().is_some_and(|n| n.is_none()));
    }
    Ok(union)
}

/// Groups that have been added, of which the latest in a place is asked for.
struct Larger<'a> {
    groups: &'a [Group],
    tree: Tree,
    /// The latest of each node.
    latest: Vec<Option<u32>>,
    /// Where each group is in the tree.
    place: Vec<u32>,
}

impl<'a> Larger<'a> {
    fn new(groups: &'a [Group]) -> Result<Larger<'a>> {
        let tree = Tree::new(0..groups.len() as u32, |k| groups[k as usize].bounds)?;
        let mut place = filled("open parts", groups.len(), 0)?;
        if let Some(root) = tree.nodes().first() {
            for (at, &k) in tree.items(root).iter().enumerate() {
                place[k as usize] = at as u32;
            }
        }
        let latest = filled("nodes of a tree", tree.nodes().len(), None)?;
        Ok(Larger { groups, tree, latest, place })
    }

    /// Adds a group, which is later than all before.
    fn add(&mut self, k: u32) {
        let mut at = 0;
        loop {
            self.latest[at] = Some(k);
            match self.tree.nodes()[at].halves(at) {
                Some([_, b]) if self.tree.nodes()[b].first() <= self.place[k as usize] => at = b,
                Some([a, _]) => at = a,
                None => return,
            }
        }
    }

    /// The latest group below a node that is near to `own`, if it is later than `best`.
    fn latest(&self, at: usize, own: &Bounds, reach: f64, best: Option<u32>) -> Option<u32> {
        let node = &self.tree.nodes()[at];
        if self.latest[at] <= best || !node.bounds.meets(own, reach) {
            return best;
        }
        match node.halves(at) {
            Some([a, b]) => {
                let first = if self.latest[a] > self.latest[b] { [a, b] } else { [b, a] };
                first.into_iter().fold(best, |best, half| self.latest(half, own, reach, best))
            }
            None => {
                // Those that were not added yet are later than the latest.
                let near = |k: &&u32| {
                    Some(**k) <= self.latest[at]
                        && self.groups[**k as usize].bounds.meets(own, reach)
                };
                best.max(self.tree.items(node).iter().filter(near).max().copied())
            }
        }
    }
}

/// Gives the faces of each set of parts to the first of them; which have grown.
fn unite(parts: &mut [Part], mut union: Union, open: &[u32]) -> Result<Vec<u32>> {
    let mut grown: Vec<u32> = Vec::new();
    for &i in open {
        let first = union.root(i);
        if first == i {
            continue;
        }
        let small = std::mem::replace(&mut parts[i as usize], Part::new());
        let part = &mut parts[first as usize];
        for f in small.faces {
            push("faces of a part", &mut part.faces, f)?;
        }
        part.extent.area += small.extent.area;
        part.bounds = part.bounds.join(&small.bounds);
        push("parts", &mut grown, first)?;
    }
    grown.sort_unstable();
    grown.dedup();
    for &i in &grown {
        parts[i as usize].faces.sort_unstable();
    }
    Ok(grown)
}
