//! A piece of a mesh while planes are cut through it.

use super::cap::Cap;
use super::clip::{CAP, Side, Surface, View, cut};
use super::ears::triangulate;
use super::parts::{Part, Parts};
use super::region::no_part;
use super::{Mark, Region};
use crate::error::{Error, Result, collected, count, filled, fits, push, reserve};
use crate::generate::Plane;
use crate::math::{Vec3, solid_angle};
use crate::run::Run;
use crate::shape::Mesh;
use crate::solid::moments::Sums;

/// The surface of a piece: the parent's, or one of its own.
enum Held<'a> {
    Parent(View<'a>),
    Own(Surface),
}

/// A piece: what some planes have left of the parent.
pub(super) struct Piece<'a> {
    held: Held<'a>,
    /// Caps that are not yet triangles, in the last plane.
    caps: Vec<Cap>,
    /// The planes that cut it, each with its normal out of the piece.
    pub planes: Vec<Plane>,
    /// Corners of the box about it, and about the whole parent.
    box_of: [Vec3; 2],
    parent: [Vec3; 2],
}

impl<'a> Piece<'a> {
    /// All of a mesh.
    pub fn whole(mesh: &'a Mesh) -> Piece<'a> {
        let view = View { vertices: &mesh.vertices, faces: &mesh.faces, tags: None };
        Piece::new(Held::Parent(view), Vec::new(), Vec::new(), None)
    }

    fn new(
        held: Held<'a>,
        caps: Vec<Cap>,
        planes: Vec<Plane>,
        parent: Option<[Vec3; 2]>,
    ) -> Piece<'a> {
        let vertices = match &held {
            Held::Parent(view) => view.vertices,
            Held::Own(surface) => &surface.vertices,
        };
        let first = vertices.first().copied().unwrap_or_default();
        let box_of = vertices.iter().fold([first, first], |[l, h], v| [l.inf(v), h.sup(v)]);
        Piece { held, caps, planes, box_of, parent: parent.unwrap_or(box_of) }
    }

    /// The convex body of a box.
    pub fn cuboid(lo: &Vec3, hi: &Vec3) -> Piece<'a> {
        const QUADS: [[u32; 4]; 6] =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let corner = |c: usize| Vec3::from_fn(|a, _| if c >> a & 1 == 1 { hi[a] } else { lo[a] });
        let both = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
        let surface = Surface {
            vertices: (0..8).map(corner).collect(),
            faces: QUADS.into_iter().flat_map(both).collect(),
            tags: (0..12).collect(),
        };
        Piece::new(Held::Own(surface), Vec::new(), Vec::new(), None)
    }

    /// The same piece again, closed, for another cut.
    pub fn lend(&self) -> Result<Piece<'_>> {
        let planes = collected("planes", self.planes.iter().copied())?;
        let (box_of, parent) = (self.box_of, self.parent);
        Ok(Piece { held: Held::Parent(self.view()), caps: Vec::new(), planes, box_of, parent })
    }

    /// Its surface, without the caps that are not yet triangles.
    pub fn view(&self) -> View<'_> {
        match &self.held {
            Held::Parent(view) => *view,
            Held::Own(surface) => surface.view(),
        }
    }

    /// Bytes that cutting a surface of so many vertices and faces takes: what is left of it on one
    /// side, twice while one replaces the other, the heights and new numbers of vertices, and what
    /// finding its bodies takes.
    pub fn cutting(vertices: usize, faces: usize) -> u64 {
        let surface = 24 * vertices as u64 + 16 * faces as u64;
        2 * surface + 20 * vertices as u64
    }

    /// The same of this one.
    fn own_cutting(&self) -> u64 {
        let view = self.view();
        Piece::cutting(view.vertices.len(), view.faces.len())
    }

    /// Corners of the box about it.
    pub fn bounds(&self) -> &[Vec3; 2] {
        &self.box_of
    }

    /// The number of the last plane.
    fn last(&self) -> u32 {
        self.planes.len().saturating_sub(1) as u32
    }

    /// Makes triangles of its caps.
    pub fn close(&mut self) -> Result<()> {
        let (tag, plane) = (CAP | self.last(), self.planes.last().copied());
        let (Held::Own(surface), Some(plane)) = (&mut self.held, plane) else { return Ok(()) };
        for cap in self.caps.drain(..) {
            triangulate(&cap, &surface.vertices, &plane.normal, &mut surface.faces)?;
        }
        let more = surface.faces.len().saturating_sub(surface.tags.len());
        surface
            .tags
            .try_reserve(more)
            .map_err(|_| Error::OutOfMemory(format!("no memory for {more} faces of a cap")))?;
        surface.tags.resize(surface.faces.len(), tag);
        Ok(())
    }

    /// Whether the plane's lower and upper side may hold some of it, by its box.
    fn sides(&self, plane: &Plane) -> [bool; 2] {
        let [lo, hi] = &self.box_of;
        let (mut least, mut most) = (-plane.offset, -plane.offset);
        for a in 0..3 {
            let n = plane.normal[a];
            let (x, y) = (n * lo[a], n * hi[a]);
            least += x.min(y);
            most += x.max(y);
        }
        [least < 0.0, most > 0.0]
    }

    /// What lies below and above a plane: `None` for nothing. The second part of the answer tells
    /// whether the plane has cut it.
    pub fn split(self, plane: &Plane) -> Result<([Option<Piece<'a>>; 2], bool)> {
        self.cut(plane, [true, true])
    }

    /// What lies below a plane.
    pub fn below(self, plane: &Plane) -> Result<Option<Piece<'a>>> {
        let ([below, _], _) = self.cut(plane, [true, false])?;
        Ok(below)
    }

    fn cut(mut self, plane: &Plane, wanted: [bool; 2]) -> Result<([Option<Piece<'a>>; 2], bool)> {
        match self.sides(plane) {
            [true, true] => {}
            [_, false] => return Ok(([Some(self), None], false)),
            [false, true] => return Ok(([None, Some(self)], false)),
        }
        self.close()?;
        let sides = cut(self.view(), plane, wanted)?;
        let turned = Plane { normal: -plane.normal, offset: -plane.offset };
        match sides {
            [Side::Whole, _] => Ok(([Some(self), None], false)),
            [_, Side::Whole] => Ok(([None, Some(self)], false)),
            [low, high] => {
                let part = |side, plane| -> Result<Option<Piece<'a>>> {
                    let Side::Part(surface, caps) = side else { return Ok(None) };
                    let mut planes = reserve("planes", self.planes.len() + 1)?;
                    planes.extend_from_slice(&self.planes);
                    planes.push(plane);
                    Ok(Some(Piece::new(Held::Own(surface), caps, planes, Some(self.parent))))
                };
                Ok(([part(low, *plane)?, part(high, turned)?], true))
            }
        }
    }

    /// What lies below all of some planes.
    pub fn within(self, planes: &[Plane]) -> Result<Option<Piece<'a>>> {
        let mut piece = self;
        for plane in planes {
            match piece.below(plane)? {
                Some(below) => piece = below,
                None => return Ok(None),
            }
        }
        Ok(Some(piece))
    }

    /// The planes that it touches, of a convex piece those that bound it.
    pub fn touched(&self) -> Vec<Plane> {
        let mut touched = vec![false; self.planes.len()];
        let last = (!self.caps.is_empty()).then_some(CAP | self.last());
        let view = self.view();
        let tags = (0..view.faces.len()).map(|i| view.tag(i)).chain(last);
        for tag in tags.filter(|tag| tag & CAP != 0) {
            if let Some(t) = touched.get_mut((tag & !CAP) as usize) {
                *t = true;
            }
        }
        self.planes.iter().zip(touched).filter(|(_, t)| *t).map(|(p, _)| *p).collect()
    }

    /// What a region's planes leave of the parent, closed, and which of it is the region.
    pub fn of_region(mesh: &'a Mesh, region: &Region) -> Result<(Piece<'a>, Kin)> {
        let mut piece = Piece::whole(mesh).within(&region.planes)?.ok_or_else(no_part)?;
        piece.close()?;
        let Some(anchor) = region.anchor else { return Ok((piece, Kin(None))) };
        let view = piece.view();
        let parts = Parts::of(view, &[])?;
        let at = (0..view.faces.len()).find(|&i| u64::from(view.tag(i)) == anchor);
        let body = parts.body(view.faces.get(at.ok_or_else(no_part)?).ok_or_else(no_part)?);
        let mut faces = filled("faces of a region", mesh.faces.len(), false)?;
        for (i, _) in view.faces.iter().enumerate().filter(|(_, f)| parts.body(f) == body) {
            if let Some(face) = faces.get_mut(view.tag(i) as usize) {
                *face = true;
            }
        }
        Ok((piece, Kin(Some((parts, body, faces)))))
    }

    /// The surface of the region alone.
    pub fn own(&self, kin: &Kin) -> Result<Surface> {
        let view = self.view();
        match &kin.0 {
            Some((parts, body, _)) => parts.extract(view, *body as usize),
            None => Ok(Surface {
                vertices: collected("vertices of a piece", view.vertices.iter().copied())?,
                faces: collected("faces of a piece", view.faces.iter().copied())?,
                tags: Vec::new(),
            }),
        }
    }

    /// The planes that bound it among those that cut it: of a convex body as large as the parent's
    /// box they leave the same.
    pub fn bounding(&self) -> Result<Vec<Plane>> {
        bounding(&self.planes, &self.parent)
    }

    /// The integrals over it about a point.
    pub fn sums(&self, about: &Vec3) -> Sums {
        let view = self.view();
        let mut sums = Sums::default();
        for f in view.faces.iter().copied().chain(self.caps.iter().flat_map(Cap::fan)) {
            sums.tetrahedron(view.corners(&f).map(|p| p - about));
        }
        sums
    }

    /// Its bodies, each a region, as far as they are of the `kin` of a region in `base`; `least`:
    /// those of less volume are left without a mark.
    pub fn regions(
        mut self,
        cell: usize,
        least: f64,
        base: &Piece,
        kin: &Kin,
    ) -> Result<Vec<Region>> {
        let mut parts = Parts::of(self.view(), &self.caps)?;
        let several = parts.parts.len() > 1;
        if several {
            self.close()?;
        }
        if several || kin.0.is_some() {
            parts.find_anchors(self.view())?;
        }
        // A plane that no part touches may still be what keeps one from others.
        let planes = self.bounding()?;
        let mut regions = reserve("regions", parts.parts.len())?;
        for (i, part) in parts.parts.iter().enumerate() {
            let Part { moments, lo, hi, anchor } = part;
            if !kin.holds(base, part) {
                continue;
            }
            let mark = if several && moments.volume >= least {
                let own = parts.triangles(self.view(), i, false);
                let others = parts.triangles(self.view(), i, true);
                Some(Mark::of_triangles(lo, hi, own, others)?)
            } else {
                None
            };
            regions.push(Region {
                planes: collected("planes", planes.iter().copied())?,
                mark,
                moments: *moments,
                lo: *lo,
                hi: *hi,
                anchor: anchor.filter(|_| several).map(u64::from),
                cell,
            });
        }
        Ok(regions)
    }
}

/// Those of some planes that bound what they leave of a box somewhat larger than the given one.
pub(super) fn bounding(planes: &[Plane], [lo, hi]: &[Vec3; 2]) -> Result<Vec<Plane>> {
    let room = Vec3::repeat(0.01 * (hi - lo).amax());
    // The last first: they are the nearer ones, beyond which the others have nothing left.
    let mut cell = Piece::cuboid(&(lo - room), &(hi + room));
    for plane in planes.iter().rev() {
        match cell.below(plane)? {
            Some(below) => cell = below,
            None => return Ok(Vec::new()),
        }
    }
    let mut touched = cell.touched();
    touched.reverse();
    Ok(touched)
}

/// Which of the bodies that some planes leave is a region: the bodies, the region's among them, and
/// the faces of the parent that it has; nothing where there is no other.
pub(super) struct Kin(pub Option<(Parts, u32, Vec<bool>)>);

impl Kin {
    /// Whether a part of `base`, cut further, is of the region.
    fn holds(&self, base: &Piece, part: &Part) -> bool {
        let Some((parts, body, faces)) = &self.0 else { return true };
        match part.anchor {
            Some(face) => faces.get(face as usize).is_some_and(|&own| own),
            // It touches no face of the parent, so it is convex and holds its centroid.
            None => {
                let own = parts.triangles(base.view(), *body as usize, false);
                let turns: f64 = own.map(|t| solid_angle(&t, &part.moments.centroid)).sum();
                turns > 2.0 * std::f64::consts::PI
            }
        }
    }
}

/// Most cells that planes may cut a body into.
const MOST_CELLS: usize = 1 << 14;

/// All cells of an arrangement of planes that meet a piece, and which planes cut it.
///
/// `limit`: most bytes for all of them together.
pub(super) fn arrange<'a>(
    piece: Piece<'a>,
    planes: &[Plane],
    limit: u64,
    run: &Run,
) -> Result<(Vec<Piece<'a>>, Vec<bool>)> {
    let mut pieces = vec![piece];
    let mut cuts = reserve("planes", planes.len())?;
    for plane in planes {
        run.check(0.1, "cutting by planes")?;
        let mut next = reserve("cells of planes", 2 * pieces.len())?;
        let mut met = false;
        for piece in pieces {
            let (sides, cut) = piece.split(plane)?;
            met |= cut;
            for side in sides.into_iter().flatten() {
                push("cells of planes", &mut next, side)?;
            }
        }
        if next.len() > MOST_CELLS {
            return Err(Error::TooLarge(format!(
                "the {} planes cut the body into more than {MOST_CELLS} cells",
                planes.len()
            )));
        }
        pieces = next;
        let held = pieces.iter().map(Piece::own_cutting).sum();
        fits(format_args!("{} of a cut mesh", count(pieces.len() as u64, "piece")), held, limit)?;
        cuts.push(met);
    }
    Ok((pieces, cuts))
}
