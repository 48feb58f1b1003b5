//! Hands the candidates of a brick on to its eight parts.
//!
//! A feature is not handed on to a part when its region (see [`super::regions`]) misses
//! the part, or when the part's witness (a point w of the surface near its middle) is nearer
//! everywhere in the part. The squared distances to a plane, to a line and to a point are all
//! |x|² plus a concave function of x, and so is |x − w|² with a linear one: their difference
//! is concave, and least at a corner of the part. So eight points decide, exactly. Nothing
//! that is nearest anywhere is ever dropped.

use super::features::Features;
use super::regions::{self, Feature, LANES, Lanes, Points};
use super::space::{Parts, Space};
use crate::error::{Error, Result, reserve};
use crate::math::Vec3;
use std::ops::Range;

/// The features of a brick, by kind.
#[derive(Debug, Default)]
pub(super) struct Candidates {
    pub faces: Vec<u32>,
    pub edges: Vec<u32>,
    pub corners: Vec<u32>,
}

impl Candidates {
    pub(super) fn clear(&mut self) {
        self.faces.clear();
        self.edges.clear();
        self.corners.clear();
    }

    /// What they take.
    pub(super) fn bytes(&self) -> u64 {
        let names = self.faces.capacity() + self.edges.capacity() + self.corners.capacity();
        4 * names as u64
    }
}

/// The candidates of a brick's parts, and for each candidate of the brick the parts that its
/// region touches.
#[derive(Debug, Default)]
pub(super) struct Lists {
    pub parts: [Candidates; 8],
    marks: Vec<u8>,
}

impl Lists {
    /// What they take.
    pub(super) fn bytes(&self) -> u64 {
        self.marks.capacity() as u64 + self.parts.iter().map(Candidates::bytes).sum::<u64>()
    }
}

/// For each part, the candidate nearest to its middle: three times its index, and 0, 1, 2 for a
/// face, an edge, a corner.
struct Nearest {
    squared: Lanes,
    name: [u32; LANES],
}

/// The corners of each part (cell centres), and their distances from its witness.
struct Limits {
    corners: [Points; 8],
    near: [Lanes; 8],
    squared: [Lanes; 8],
}

impl Limits {
    fn new(space: &Space, parts: &Parts, witnesses: &[Vec3; 8]) -> Limits {
        let mut limits = Limits {
            corners: [Points::default(); 8],
            near: [Lanes::ZERO; 8],
            squared: [Lanes::ZERO; 8],
        };
        for (k, part) in parts.bricks.iter().enumerate() {
            limits.corners[k] = space.corners(part);
            let w = regions::single(&witnesses[k]);
            let near = regions::from_point(&w, &limits.corners[k]).sqrt() + parts.middle.slack();
            limits.near[k] = near;
            limits.squared[k] = near * near;
        }
        limits
    }

    /// Of the marked parts, those where something in the ball may be nearer than the witness. What
    /// is nearer to one point than to another by some length lies within a sheet of a
    /// hyperboloid, which is convex: the corners decide here too.
    #[inline(always)]
    fn may_hold(&self, center: &[f32; 3], radius: f32, marks: u8) -> u8 {
        let mut kept = 0;
        for k in 0..LANES {
            let near = self.near[k] + radius;
            let squared = regions::from_point(center, &self.corners[k]);
            kept |= u8::from(regions::bits(near * near - squared) != 0) << k;
        }
        kept & marks
    }
}

/// The clusters of a brick's parts, for parts that are large; and the parts' witnesses.
pub(super) fn split_clusters(
    features: &Features,
    space: &Space,
    parts: &Parts,
    clusters: &[u32],
    witness: &Vec3,
) -> Result<([Vec3; 8], Vec<u8>)> {
    let mut nearest = [(f32::MAX, u32::MAX); LANES];
    for &c in clusters {
        let ball = &features.clusters[c as usize];
        let squared = regions::from_point(&ball.center, &parts.middle).to_array();
        for (nearest, d) in nearest.iter_mut().zip(squared) {
            if d < nearest.0 {
                *nearest = (d, c);
            }
        }
    }
    let mut witnesses = [*witness; 8];
    for (k, part) in parts.bricks.iter().enumerate() {
        let m = space.middle(part);
        let Some(ball) = features.clusters.get(nearest[k].1 as usize) else { continue };
        for i in ball.faces.clone() {
            let q = features.on_face(i, &m);
            if (q - m).norm_squared() < (witnesses[k] - m).norm_squared() {
                witnesses[k] = q;
            }
        }
    }
    let limits = Limits::new(space, parts, &witnesses);
    let mut marks = reserve("the candidates of a brick", clusters.len())?;
    marks.extend(clusters.iter().map(|&c| {
        let ball = &features.clusters[c as usize];
        limits.may_hold(&ball.center, ball.radius, parts.there)
    }));
    Ok((witnesses, marks))
}

/// Hands the features of clusters to the parts that `marks` allow.
pub(super) fn open(
    features: &Features,
    space: &Space,
    parts: &Parts,
    clusters: &[u32],
    marks: &[u8],
    witnesses: &[Vec3; 8],
    lists: &mut [Candidates; 8],
) -> Result<()> {
    let limits = Limits::new(space, parts, witnesses);
    let f = features;
    for (&c, &mark) in clusters.iter().zip(marks) {
        if mark == 0 {
            continue;
        }
        let c = &f.clusters[c as usize];
        open_one(&f.faces, &c.faces, mark, parts, &limits, lists, |c| &mut c.faces)?;
        open_one(&f.edges, &c.edges, mark, parts, &limits, lists, |c| &mut c.edges)?;
        open_one(&f.corners, &c.corners, mark, parts, &limits, lists, |c| &mut c.corners)?;
    }
    Ok(())
}

/// Features of one kind in one cluster.
#[inline(always)]
fn open_one<F: Feature>(
    features: &[F],
    range: &Range<u32>,
    marks: u8,
    parts: &Parts,
    limits: &Limits,
    lists: &mut [Candidates; 8],
    list: impl Fn(&mut Candidates) -> &mut Vec<u32>,
) -> Result<()> {
    for i in range.clone() {
        let feature = &features[i as usize];
        let mark = regions::bits(feature.touches(&parts.middle, parts.half)) & marks;
        hand_on(feature, i, mark, limits, lists, &list)?;
    }
    Ok(())
}

/// Hands the candidates of a brick to its parts; returns their witnesses.
pub(super) fn split(
    features: &Features,
    space: &Space,
    parts: &Parts,
    candidates: &Candidates,
    witness: &Vec3,
    lists: &mut Lists,
) -> Result<[Vec3; 8]> {
    let from = regions::from_point(&regions::single(witness), &parts.middle);
    let mut nearest = Nearest { squared: from, name: [u32::MAX; LANES] };
    let f = features;
    lists.marks.clear();
    touch(&f.faces, &candidates.faces, 0, parts, &mut nearest, &mut lists.marks)?;
    touch(&f.edges, &candidates.edges, 1, parts, &mut nearest, &mut lists.marks)?;
    touch(&f.corners, &candidates.corners, 2, parts, &mut nearest, &mut lists.marks)?;
    let mut witnesses = [*witness; 8];
    for (k, part) in parts.bricks.iter().enumerate() {
        lists.parts[k].clear();
        let c = space.middle(part);
        let q = match (nearest.name[k] / 3, nearest.name[k] % 3) {
            _ if nearest.name[k] == u32::MAX => continue,
            (i, 0) => f.on_face(i, &c),
            (i, 1) => f.on_edge(i, &c),
            (i, _) => f.on_corner(i),
        };
        if (q - c).norm_squared() < (witness - c).norm_squared() {
            witnesses[k] = q;
        }
    }
    let limits = Limits::new(space, parts, &witnesses);
    let (faces, marks) = lists.marks.split_at(candidates.faces.len());
    let (edges, corners) = marks.split_at(candidates.edges.len());
    let to = &mut lists.parts;
    hand_all(&f.faces, &candidates.faces, faces, &limits, to, |c| &mut c.faces)?;
    hand_all(&f.edges, &candidates.edges, edges, &limits, to, |c| &mut c.edges)?;
    hand_all(&f.corners, &candidates.corners, corners, &limits, to, |c| &mut c.corners)?;
    Ok(witnesses)
}

/// Marks the parts that the regions of candidates of one kind touch, and finds the nearest.
#[inline(never)]
fn touch<F: Feature>(
    features: &[F],
    candidates: &[u32],
    kind: u32,
    parts: &Parts,
    nearest: &mut Nearest,
    marks: &mut Vec<u8>,
) -> Result<()> {
    marks.try_reserve(candidates.len()).map_err(|_| out_of_memory())?;
    let (middle, half, there) = (parts.middle, parts.half, parts.there);
    let mut least = nearest.squared;
    for &i in candidates {
        let feature = &features[i as usize];
        let (touches, bound) = feature.touches_within(&middle, half);
        let mark = regions::bits(touches) & there;
        marks.push(mark);
        // Seldom: the nearest so far changes some times in a long list.
        if mark == 0 || mark & !regions::bits(bound - least) == 0 {
            continue;
        }
        let within = feature.within(&middle);
        let nearer = mark & !regions::bits(within - least);
        if nearer != 0 {
            let (within, mut all) = (within.to_array(), least.to_array());
            for k in 0..LANES {
                if nearer >> k & 1 == 1 {
                    all[k] = within[k];
                    nearest.name[k] = i * 3 + kind;
                }
            }
            least = Lanes::new(all);
        }
    }
    nearest.squared = least;
    Ok(())
}

/// Hands candidates of one kind on to the marked parts that they may be nearest in.
#[inline(never)]
fn hand_all<F: Feature>(
    features: &[F],
    candidates: &[u32],
    marks: &[u8],
    limits: &Limits,
    lists: &mut [Candidates; 8],
    list: impl Fn(&mut Candidates) -> &mut Vec<u32>,
) -> Result<()> {
    for (&i, &mark) in candidates.iter().zip(marks) {
        hand_on(&features[i as usize], i, mark, limits, lists, &list)?;
    }
    Ok(())
}

#[inline(always)]
fn hand_on<F: Feature>(
    feature: &F,
    name: u32,
    marks: u8,
    limits: &Limits,
    lists: &mut [Candidates; 8],
    list: impl Fn(&mut Candidates) -> &mut Vec<u32>,
) -> Result<()> {
    let mut mark = marks;
    while mark != 0 {
        let k = mark.trailing_zeros() as usize & 7;
        mark &= mark - 1;
        let bound = feature.bound(&limits.corners[k]);
        if regions::bits(limits.squared[k] - bound) == 0 {
            continue;
        }
        let to = list(&mut lists[k]);
        if to.len() == to.capacity() {
            to.try_reserve(to.len().max(64)).map_err(|_| out_of_memory())?;
        }
        to.push(name);
    }
    Ok(())
}

fn out_of_memory() -> Error {
    Error::OutOfMemory("no memory for the candidates of a brick".into())
}
