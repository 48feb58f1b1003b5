//! Parts and bodies: which connected pieces of the surface enclose something,
//! which way is out, which of them are one body.
//!
//! - A part that is closed, or open so little that the winding number still tells
//!   inside from outside, is solid. Open parts that close each other's openings
//!   (a surface made of patches) count as one part. What is left are loose sheets, and
//!   so are open parts with less than a thousandth of the largest part's volume.
//! - A solid part that lies in no other, or in the cavity of one, faces outward. One
//!   within the solid of another is a cavity when it faces inward, else it is
//!   filled (non-zero rule).
//! - Parts whose surfaces cross or lie on each other, and parts within the solid of
//!   another, are one body, with its cavities. Parts that only touch in points or
//!   along lines are separate, as no material joins them; so is a part in a cavity.

use super::check::Grain;
use super::cross::{self, Contact};
use super::field::Field;
use super::inside::{Extent, MOST_OPEN};
use super::topology::Union;
use super::tree::{Bounds, Tree};
use crate::error::{Error, Result, filled, push, reserve};
use crate::math::Vec3;
use crate::run::Run;

/// An open part with less than this of the greatest part's volume is a scrap.
const SCRAP: f64 = 1e-3;

/// How many corners of a part are looked up in another.
const PROBES: usize = 64;

/// Parts that need more looks at faces than this are too entangled: seconds of work.
const MOST_LOOKS: u64 = 100_000_000;

/// What a pair of parts costs beside the faces.
const PAIR: u64 = 40;

/// One connected piece of the surface, or several that close each other's openings.
#[derive(Debug, Clone)]
pub struct Part {
    /// Its faces, ascending.
    pub faces: Vec<u32>,
    /// Volume, area, open or not.
    pub extent: Extent,
    /// Mean openness (0 when closed).
    pub openness: f64,
    /// Whether it is to be turned inside out.
    pub turn: bool,
    /// Its body; `None` for loose sheets.
    pub body: Option<u32>,
    /// The box about it.
    pub bounds: Bounds,
}

impl Part {
    /// Whether it encloses something: its mean thickness (volume over area) is more than
    /// what touches.
    pub fn is_solid(&self, grain: Grain) -> bool {
        self.openness <= MOST_OPEN && self.extent.volume.abs() > grain.touch() * self.extent.area
    }

    /// Volume with the sign after turning.
    pub fn volume(&self) -> f64 {
        if self.turn { -self.extent.volume } else { self.extent.volume }
    }

    /// No faces yet.
    pub fn new() -> Part {
        Part {
            faces: Vec::new(),
            extent: Extent::default(),
            openness: 0.0,
            turn: false,
            body: None,
            bounds: Bounds::empty(),
        }
    }
}

/// The parts of a surface, numbered by `of`, with their extents.
pub fn parts(
    faces: &[[u32; 3]],
    points: &[Vec3],
    of: &[u32],
    extents: &[Extent],
) -> Result<Vec<Part>> {
    let mut parts = filled("parts", extents.len(), Part::new())?;
    for (i, (f, &p)) in faces.iter().zip(of).enumerate() {
        let part = &mut parts[p as usize];
        push("faces of a part", &mut part.faces, i as u32)?;
        let bounds = &mut part.bounds;
        for &v in f {
            let p = &points[v as usize];
            (bounds.lo, bounds.hi) = (bounds.lo.inf(p), bounds.hi.sup(p));
        }
    }
    for (part, extent) in parts.iter_mut().zip(extents) {
        part.extent = *extent;
    }
    Ok(parts)
}

/// What was found when the parts were sorted into bodies.
pub struct Bodies {
    /// Volume of each body, in the order of their first faces.
    pub volumes: Vec<f64>,
    /// Whether parts cross one another, or lie within the solid of another.
    pub overlap: bool,
}

/// Turns the solid parts outward and sorts them into bodies.
pub fn bodies(
    parts: &mut [Part],
    faces: &[[u32; 3]],
    points: &[Vec3],
    grain: Grain,
    run: &Run,
) -> Result<Bodies> {
    let mut solid: Vec<usize> = reserve("parts", parts.len())?;
    solid.extend((0..parts.len()).filter(|&i| parts[i].is_solid(grain)));
    let greatest = solid.iter().map(|&i| parts[i].extent.volume.abs()).fold(0.0, f64::max);
    solid.retain(|&i| !parts[i].extent.open || parts[i].extent.volume.abs() >= SCRAP * greatest);
    // Containers first: they have more volume than what is in them.
    solid.sort_by(|&a, &b| {
        parts[b].extent.volume.abs().total_cmp(&parts[a].extent.volume.abs()).then(a.cmp(&b))
    });
    let n = solid.len();
    let mut union = Union::new(n)?;
    let mut overlap = false;
    // For each part, those larger ones that it lies in, with their winding number there.
    let mut holders: Vec<Vec<(usize, f64)>> = filled("parts", n, Vec::new())?;
    let mut fields: Vec<Option<Field>> = reserve("parts", n)?;
    fields.resize_with(n, || None);
    let mut looks = 0;
    let tree = Tree::new(0..n as u32, |k| parts[solid[k as usize]].bounds)?;
    let mut larger: Vec<usize> = reserve("parts", n)?;
    for j in 0..n {
        run.check(0.7, "sorting the mesh into bodies")?;
        pairs(parts, &solid, &tree, j, grain, &mut larger);
        for &i in &larger {
            if looks > MOST_LOOKS {
                return Err(Error::TooLarge(format!(
                    "the {n} closed parts of the mesh lie so much in each other's boxes that sorting \
                 them into bodies takes too many comparisons"
                )));
            }
            looks += PAIR;
            let (big, small) = (&parts[solid[i]], &parts[solid[j]]);
            for (k, part) in [(i, big), (j, small)] {
                if fields[k].is_none() {
                    fields[k] = Some(Field::new(&part.faces, faces, points, grain)?);
                }
            }
            let (Some(field), Some(own)) = (&fields[i], &fields[j]) else { continue };
            // Only faces in the other's box can meet it: a large part may hold many small ones.
            let touch = grain.touch();
            let contact = if big.faces.len() < small.faces.len() {
                cross::contact(&big.faces, field, own, &small.bounds, touch, &mut looks)
            } else {
                cross::contact(&small.faces, own, field, &big.bounds, touch, &mut looks)
            };
            let step = small.faces.len().div_ceil(PROBES);
            let mut probes = [0.0; PROBES];
            let mut count = 0;
            for (w, &f) in probes.iter_mut().zip(small.faces.iter().step_by(step)) {
                *w = field.at(&own.corners(f)[0], &mut looks);
                count += 1;
            }
            let probes = &probes[..count];
            // Edges that run just through other edges cross no face: the corners tell. Between
            // these figures a corner lies on the surface, or near an opening.
            let split =
                probes.iter().any(|w| w.abs() > 0.75) && probes.iter().any(|w| w.abs() < 0.25);
            let crosses = contact == Contact::Cross || split;
            let mean = probes.iter().sum::<f64>() / probes.len() as f64;
            if crosses || contact == Contact::Wall {
                union.join(i as u32, j as u32);
                overlap |= crosses;
            } else if mean.abs() > 0.5 && big.bounds.holds(&small.bounds) {
                push("holders", &mut holders[j], (i, mean))?;
            }
        }
    }
    let mut held: Vec<Vec<usize>> = filled("parts", n, Vec::new())?;
    for (k, h) in holders.iter().enumerate() {
        for &(j, _) in h {
            push("holders", &mut held[j], k)?;
        }
    }
    for j in 0..n {
        // What a holder adds has changed its sign when the holder was turned.
        let around: f64 = holders[j]
            .iter()
            .map(|&(i, w)| if parts[solid[i]].turn { -w.round() } else { w.round() })
            .sum();
        if parts[solid[j]].volume() < 0.0 && around < 0.5 {
            // The whole nest is inside out: what is in it turns with it.
            parts[solid[j]].turn ^= true;
            for &k in &held[j] {
                parts[solid[k]].turn ^= true;
            }
        }
        if around > 0.5 {
            // The smallest outward part around it comes last.
            let near = holders[j].iter().rev().find(|h| parts[solid[h.0]].volume() > 0.0);
            if let Some(&(i, _)) = near {
                union.join(i as u32, j as u32);
                overlap |= parts[solid[j]].volume() > 0.0;
            }
        }
    }
    let root = union.roots();
    // Number the bodies by their first faces, not by size.
    let mut firsts: Vec<(usize, u32)> = reserve("bodies", n)?;
    firsts.extend((0..n).map(|j| (solid[j], root[j])));
    firsts.sort_unstable();
    let mut number = filled("bodies", n, u32::MAX)?;
    let mut volumes = reserve("bodies", n)?;
    for (i, r) in firsts {
        let r = r as usize;
        if number[r] == u32::MAX {
            number[r] = volumes.len() as u32;
            volumes.push(0.0);
        }
        parts[i].body = Some(number[r]);
        volumes[number[r] as usize] += parts[i].volume();
    }
    Ok(Bodies { volumes, overlap })
}

/// The larger parts whose boxes meet that of part `j`, as places in `solid`, by falling size.
fn pairs(
    parts: &[Part],
    solid: &[usize],
    tree: &Tree,
    j: usize,
    grain: Grain,
    larger: &mut Vec<usize>,
) {
    let bounds = |k: usize| parts[solid[k]].bounds;
    let own = bounds(j);
    larger.clear();
    tree.descend(
        |node| node.bounds.meets(&own, grain.touch()),
        |leaf| {
            let all = leaf.iter().map(|&k| k as usize);
            larger.extend(all.filter(|&k| k < j && bounds(k).meets(&own, grain.touch())));
            false
        },
    );
    larger.sort_unstable();
}
