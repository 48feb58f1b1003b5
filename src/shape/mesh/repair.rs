//! Faces that are no faces: without area, or present more than once.

use super::check::Grain;
use super::flat;
use super::topology::{Edges, Union};
use super::tree::Bounds;
use super::weld;
use crate::error::{Result, filled, reserve};
use crate::math::Vec3;

/// A weld reaches no farther than this times the median edge: a vertex far away makes
/// the box, and the tolerance with it, larger than the faces of the body.
const MOST_OF_EDGE: f64 = 0.25;

/// The faces that are left, and what was dropped.
#[derive(Default)]
pub struct Kept {
    /// Faces by welded vertices.
    pub faces: Vec<[u32; 3]>,
    /// Their edges, where these are known.
    pub edges: Option<Edges>,
    /// Faces without area.
    pub degenerate: u64,
    /// Faces present more than once.
    pub duplicate: u64,
    /// Of these, faces of opposed pairs that were both taken out.
    pub walls: u64,
    /// Vertices that are one with another.
    pub welded: u64,
    /// Of these, vertices that are not equal to the other.
    pub moved: u64,
}

/// Welds no more than closes the surface: not at all when it is closed as it was
/// handed in, else equal points, and of the vertices at edges without exactly two faces
/// those within `tolerance` times the longest edge of the box, when that leaves
/// fewer such edges. Welding more would pinch thin parts together and join bodies
/// that only touch.
pub fn close(faces: &[[u32; 3]], points: &[Vec3], tolerance: f64, grain: Grain) -> Result<Kept> {
    let mut used = filled("vertex flags", points.len(), false)?;
    faces.iter().flatten().for_each(|&v| used[v as usize] = true);
    let equal = weld::equal(points, &used)?;
    let exact = attempt(faces, &used, &equal, &equal)?;
    let mut best = None;
    let welds = (0..points.len()).any(|i| used[i] && equal[i] as usize != i);
    if welds && used.iter().filter(|&&u| u).count() < faces.len() * 2 {
        let mut as_is = reserve("vertices", points.len())?;
        as_is.extend(0..points.len() as u32);
        let first = attempt(faces, &used, &as_is, &equal)?;
        // Equal points at one face, or in two faces at one place, need welding.
        let plain = first.1 == 0 && first.0.degenerate == exact.0.degenerate;
        best = (plain && first.0.duplicate == exact.0.duplicate).then_some(first);
    }
    let mut best = best.unwrap_or(exact);
    let used_points = points.iter().zip(&used).filter(|p| *p.1).map(|p| p.0);
    let most = tolerance * longest(&Bounds::of(used_points));
    let low = flat::may_be_low(&best.0.faces, points, most.max(grain.flat()));
    if best.1 == 0 && !low {
        return Ok(best.0);
    }
    let reach = reach_of(&best.0.faces, points, most)?;
    if best.1 > 0 && reach > 0.0 {
        let mut loose = filled("loose vertices", points.len(), false)?;
        let edges = match &best.0.edges {
            Some(edges) => edges,
            None => &Edges::of(&best.0.faces)?,
        };
        for e in edges.iter().filter(|e| e.len() != 2) {
            loose[(e[0].key >> 32) as usize] = true;
            loose[e[0].key as u32 as usize] = true;
        }
        let root = weld::near(points, &equal, &loose, reach)?;
        drop(loose);
        let near = attempt(faces, &used, &root, &equal)?;
        // An edge that goes with its face is not closed: faces that shrink to points
        // count as open as they were.
        let shrinks = |f: &&[u32; 3]| {
            let one = |root: &[u32]| {
                root[f[0] as usize] == root[f[1] as usize]
                    && root[f[0] as usize] == root[f[2] as usize]
            };
            one(&root) && !one(&equal)
        };
        let shrunk = faces.iter().filter(shrinks).count() as u64;
        if near.1 + 3 * shrunk < best.1 {
            best = near;
        }
    }
    let mut kept = best.0;
    // Where no face is low none is dropped, nor changed.
    if flat::may_be_low(&kept.faces, points, reach.max(grain.flat())) {
        kept.edges = None;
        kept.degenerate += flat::drop_flat(&mut kept.faces, points, reach, grain.flat())?;
    }
    Ok(kept)
}

fn longest(bounds: &Bounds) -> f64 {
    (bounds.hi - bounds.lo).max().max(0.0)
}

/// How far welding reaches: `most`, but no more than a part of the median edge.
fn reach_of(faces: &[[u32; 3]], points: &[Vec3], most: f64) -> Result<f64> {
    let mut edges: Vec<f64> = reserve("edge lengths", faces.len() * 3)?;
    for f in faces {
        let at = |v: u32| points[v as usize];
        let (a, b, c) = (at(f[0]), at(f[1]), at(f[2]));
        edges.extend([(b - a).norm_squared(), (c - b).norm_squared(), (a - c).norm_squared()]);
    }
    if edges.is_empty() {
        return Ok(0.0);
    }
    let middle = edges.len() / 2;
    let (_, median, _) = edges.select_nth_unstable_by(middle, f64::total_cmp);
    Ok(most.min(MOST_OF_EDGE * median.sqrt()))
}

/// The faces by `root`, and how many of their edges do not have exactly two faces.
fn attempt(faces: &[[u32; 3]], used: &[bool], root: &[u32], exact: &[u32]) -> Result<(Kept, u64)> {
    let mut kept = Kept { faces: reserve("faces", faces.len())?, ..Kept::default() };
    let at = |v: u32| root[v as usize];
    kept.faces.extend(faces.iter().map(|f| [at(f[0]), at(f[1]), at(f[2])]));
    kept.faces.retain(|f| f[0] != f[1] && f[1] != f[2] && f[2] != f[0]);
    kept.degenerate = (faces.len() - kept.faces.len()) as u64;
    let mut edges = Edges::of(&kept.faces)?;
    if edges.has_twins(&kept.faces) {
        drop_duplicates(&mut kept)?;
        edges = Edges::of(&kept.faces)?;
    }
    let is = |i: &usize| used[*i] && root[*i] as usize != *i;
    kept.welded = (0..used.len()).filter(is).count() as u64;
    let moved = |i: &usize| exact[*i] != exact[root[*i] as usize];
    kept.moved = (0..used.len()).filter(is).filter(moved).count() as u64;
    let faulty = edges.faulty();
    kept.edges = Some(edges);
    Ok((kept, faulty))
}

/// Keeps one of the faces with the same three vertices, with the sense of the most.
/// Those that oppose each other in equal numbers are kept as one face where that
/// fills a hole or where there is nothing else (a surface handed in twice), and
/// taken out where both sides are closed without them (a wall between two parts).
fn drop_duplicates(kept: &mut Kept) -> Result<()> {
    let faces = &kept.faces;
    let mut order: Vec<([u32; 3], u32)> = reserve("faces", faces.len())?;
    for (i, f) in faces.iter().enumerate() {
        let mut s = *f;
        s.sort_unstable();
        order.push((s, i as u32));
    }
    order.sort_unstable();
    let mut keep = filled("faces", faces.len(), true)?;
    let mut opposed = filled("faces", faces.len(), false)?;
    let mut any = false;
    for group in order.chunk_by(|a, b| a.0 == b.0).filter(|g| g.len() > 1) {
        let even = |i: u32| {
            let f = faces[i as usize];
            (0..3).any(|k| [f[k], f[(k + 1) % 3], f[(k + 2) % 3]] == group[0].0)
        };
        let forward = group.iter().filter(|g| even(g.1)).count();
        let sense = 2 * forward >= group.len();
        let stays = group.iter().find(|g| even(g.1) == sense).map_or(group[0].1, |g| g.1);
        group.iter().for_each(|g| keep[g.1 as usize] = g.1 == stays);
        opposed[stays as usize] = 2 * forward == group.len();
        any |= opposed[stays as usize];
    }
    if any {
        kept.walls = take_out_walls(faces, &mut keep, &opposed)?;
    }
    let before = faces.len();
    let mut it = keep.iter();
    kept.faces.retain(|_| it.next().is_some_and(|&k| k));
    kept.duplicate = (before - kept.faces.len()) as u64;
    Ok(())
}

/// Decides for each connected sheet of opposed pairs by the edges at which it meets
/// other faces; how many faces the input had there.
fn take_out_walls(faces: &[[u32; 3]], keep: &mut [bool], opposed: &[bool]) -> Result<u64> {
    let mut kept: Vec<u32> = reserve("faces", faces.len())?;
    kept.extend((0..faces.len() as u32).filter(|&i| keep[i as usize]));
    let mut once: Vec<[u32; 3]> = reserve("faces", kept.len())?;
    once.extend(kept.iter().map(|&i| faces[i as usize]));
    let edges = Edges::of(&once)?;
    let is = |k: u32| opposed[kept[k as usize] as usize];
    let mut union = Union::new(kept.len())?;
    for e in edges.iter() {
        if let [a, b] = e
            && is(a.face)
            && is(b.face)
        {
            union.join(a.face, b.face);
        }
    }
    let sheet = union.roots();
    let mut votes = filled("sheets", kept.len(), 0i64)?;
    for e in edges.iter() {
        let plain = e.iter().filter(|s| !is(s.face)).count();
        if plain > 0 {
            let vote = if plain % 2 == 1 { 1 } else { -1 };
            e.iter()
                .filter(|s| is(s.face))
                .for_each(|s| votes[sheet[s.face as usize] as usize] += vote);
        }
    }
    let mut walls = 0;
    for (k, &i) in kept.iter().enumerate() {
        if opposed[i as usize] && votes[sheet[k] as usize] < 0 {
            keep[i as usize] = false;
            walls += 2;
        }
    }
    Ok(walls)
}
