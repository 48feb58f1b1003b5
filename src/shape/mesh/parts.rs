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

use super::cross::{self, Contact, Face};
use super::inside::{self, Extent, Field, MOST_OPEN};
use super::topology::Union;
use crate::error::{Result, filled};
use crate::math::Vec3;
use crate::run::Run;

/// A mean thickness (volume over area, unit frame) below this is rounding.
pub const THIN: f64 = 1e-9;

/// An open part with less than this of the greatest part's volume is a scrap.
const SCRAP: f64 = 1e-3;

/// Patches of one surface may be this far apart (unit frame).
const NEAR: f64 = 1e-3;

/// How many corners of a part are looked up in another.
const PROBES: usize = 64;

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
    lo: Vec3,
    hi: Vec3,
}

impl Part {
    /// Whether it encloses something.
    pub fn is_solid(&self) -> bool {
        self.openness <= MOST_OPEN && self.extent.volume.abs() > THIN * self.extent.area
    }

    /// Volume with the sign after turning.
    pub fn volume(&self) -> f64 {
        if self.turn { -self.extent.volume } else { self.extent.volume }
    }

    fn new() -> Part {
        Part {
            faces: Vec::new(),
            extent: Extent::default(),
            openness: 0.0,
            turn: false,
            body: None,
            lo: Vec3::repeat(f64::MAX),
            hi: Vec3::repeat(f64::MIN),
        }
    }

    /// Adds the faces of another part; the volume is to be found anew.
    fn take(&mut self, other: Part) {
        self.faces.extend(other.faces);
        self.faces.sort_unstable();
        self.extent.area += other.extent.area;
        self.lo = self.lo.inf(&other.lo);
        self.hi = self.hi.sup(&other.hi);
    }

    fn boxes_meet(&self, other: &Part, slack: f64) -> bool {
        (0..3).all(|k| self.lo[k] <= other.hi[k] + slack && other.lo[k] <= self.hi[k] + slack)
    }

    fn box_holds(&self, other: &Part) -> bool {
        (0..3).all(|k| self.lo[k] <= other.lo[k] && other.hi[k] <= self.hi[k])
    }
}

/// The parts of a surface, numbered by `of`, with their extents. Open parts are judged
/// by their openness, alone and in the field of all.
pub fn parts(
    faces: &[[u32; 3]],
    points: &[Vec3],
    of: &[u32],
    extents: &[Extent],
    run: &Run,
) -> Result<Vec<Part>> {
    let mut parts = filled("parts", extents.len(), Part::new())?;
    for (i, (f, &p)) in faces.iter().zip(of).enumerate() {
        let part = &mut parts[p as usize];
        part.faces.push(i as u32);
        for &v in f {
            part.lo = part.lo.inf(&points[v as usize]);
            part.hi = part.hi.sup(&points[v as usize]);
        }
    }
    for (part, extent) in parts.iter_mut().zip(extents) {
        part.extent = *extent;
    }
    join_patches(parts, faces, points, run)
}

/// Judges the open parts, and makes one of those that close each other's openings.
fn join_patches(
    mut parts: Vec<Part>,
    faces: &[[u32; 3]],
    points: &[Vec3],
    run: &Run,
) -> Result<Vec<Part>> {
    let field = |list: &[u32]| Field::new(list.iter().map(|&i| &faces[i as usize]), points);
    let spots =
        |part: &Part| inside::samples(part.faces.iter().map(|&i| &faces[i as usize]), points);
    let mut open: Vec<usize> = (0..parts.len()).filter(|&i| parts[i].extent.open).collect();
    let all: Vec<u32> = open.iter().flat_map(|&i| parts[i].faces.iter().copied()).collect();
    let together = field(&all);
    let mut closed_by_others = filled("parts", parts.len(), false)?;
    for &i in &open {
        run.check(0.5, "judging the openings of the mesh")?;
        let at = spots(&parts[i]);
        parts[i].openness = inside::openness(&at, &field(&parts[i].faces), run.pool());
        if open.len() > 1 {
            let all = inside::openness(&at, &together, run.pool());
            closed_by_others[i] = all <= 0.5 * parts[i].openness;
        }
    }
    // Each such part goes to the next larger one that is near; the largest last.
    open.sort_by(|&a, &b| parts[a].extent.area.total_cmp(&parts[b].extent.area).then(b.cmp(&a)));
    let mut grown = filled("parts", parts.len(), false)?;
    for k in 0..open.len() {
        let i = open[k];
        if !closed_by_others[i] {
            continue;
        }
        let near = open[k + 1..].iter().copied().find(|&j| parts[i].boxes_meet(&parts[j], NEAR));
        let Some(j) = near else { continue };
        let small = std::mem::replace(&mut parts[i], Part::new());
        parts[j].take(small);
        grown[j] = true;
        grown[i] = false;
    }
    for i in (0..parts.len()).filter(|&i| grown[i]) {
        run.check(0.6, "judging the openings of the mesh")?;
        let mine = parts[i].faces.iter().map(|&f| &faces[f as usize]);
        parts[i].extent.volume = inside::volume_of_patches(mine, points);
        parts[i].openness =
            inside::openness(&spots(&parts[i]), &field(&parts[i].faces), run.pool());
    }
    parts.retain(|p| !p.faces.is_empty());
    parts.sort_by_key(|p| p.faces[0]);
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
    run: &Run,
) -> Result<Bodies> {
    let mut solid: Vec<usize> = (0..parts.len()).filter(|&i| parts[i].is_solid()).collect();
    let greatest = solid.iter().map(|&i| parts[i].extent.volume.abs()).fold(0.0, f64::max);
    solid.retain(|&i| !parts[i].extent.open || parts[i].extent.volume.abs() >= SCRAP * greatest);
    // Containers first: they have more volume than what is in them.
    solid.sort_by(|&a, &b| {
        parts[b].extent.volume.abs().total_cmp(&parts[a].extent.volume.abs()).then(a.cmp(&b))
    });
    let n = solid.len();
    let corners = |i: u32| faces[i as usize].map(|v| points[v as usize]);
    let mut union = Union::new(n)?;
    let mut overlap = false;
    // For each part, those larger ones that it lies in, with their winding number there.
    let mut holders: Vec<Vec<(usize, f64)>> = filled("parts", n, Vec::new())?;
    let mut fields: Vec<Option<Field>> = (0..n).map(|_| None).collect();
    for (i, j) in pairs(parts, &solid) {
        let (big, small) = (&parts[solid[i]], &parts[solid[j]]);
        run.check(0.7, "sorting the mesh into bodies")?;
        // Only faces in the other's box can meet it: a large part may hold many small ones.
        let boxed = |p: &Part, other: &Part| {
            let near = |c: &[Vec3; 3]| {
                (0..3).all(|k| {
                    c[0][k].min(c[1][k]).min(c[2][k]) <= other.hi[k] + cross::TOUCH
                        && c[0][k].max(c[1][k]).max(c[2][k]) >= other.lo[k] - cross::TOUCH
                })
            };
            p.faces.iter().map(|&f| corners(f)).filter(near).map(Face::new).collect::<Vec<_>>()
        };
        let contact = cross::contact(&boxed(big, small), &boxed(small, big));
        let field = fields[i].get_or_insert_with(|| {
            Field::new(big.faces.iter().map(|&f| &faces[f as usize]), points)
        });
        let probes: Vec<f64> = small
            .faces
            .iter()
            .step_by(small.faces.len().div_ceil(PROBES))
            .map(|&f| field.at(&corners(f)[0]))
            .collect();
        // Edges that run just through other edges cross no face: the corners tell. Between
        // these figures a corner lies on the surface, or near an opening.
        let split = probes.iter().any(|w| w.abs() > 0.75) && probes.iter().any(|w| w.abs() < 0.25);
        let crosses = contact == Contact::Cross || split;
        let mean = probes.iter().sum::<f64>() / probes.len() as f64;
        if crosses || contact == Contact::Wall {
            union.join(i as u32, j as u32);
            overlap |= crosses;
        } else if mean.abs() > 0.5 && big.box_holds(small) {
            holders[j].push((i, mean));
        }
    }
    let mut held: Vec<Vec<usize>> = filled("parts", n, Vec::new())?;
    for (k, h) in holders.iter().enumerate() {
        h.iter().for_each(|&(j, _)| held[j].push(k));
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
    let mut firsts: Vec<(usize, u32)> = (0..n).map(|j| (solid[j], root[j])).collect();
    firsts.sort_unstable();
    let mut number = filled("bodies", n, u32::MAX)?;
    let mut volumes = Vec::new();
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

/// Pairs of solid parts whose boxes meet, as places in `solid`, the larger part first;
/// ordered so that for each smaller part the larger ones come by falling size.
fn pairs(parts: &[Part], solid: &[usize]) -> Vec<(usize, usize)> {
    let mut by_x: Vec<usize> = (0..solid.len()).collect();
    by_x.sort_by(|&a, &b| parts[solid[a]].lo.x.total_cmp(&parts[solid[b]].lo.x).then(a.cmp(&b)));
    let mut found = Vec::new();
    for (k, &a) in by_x.iter().enumerate() {
        let end = parts[solid[a]].hi.x;
        for &b in by_x[k + 1..].iter().take_while(|&&b| parts[solid[b]].lo.x <= end) {
            if parts[solid[a]].boxes_meet(&parts[solid[b]], 0.0) {
                found.push((a.max(b), a.min(b)));
            }
        }
    }
    found.sort_unstable();
    found.into_iter().map(|(small, big)| (big, small)).collect()
}
