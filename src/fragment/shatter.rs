//! A break in one call: a parent is cut, its pieces get spheres, and the solver's body is handed
//! over to them.

use super::cut::{CutOptions, Dust, cut, cut_region};
use super::motion::{Held, Moving};
use super::reclump::{Reclump, ReclumpOptions, reclump};
use super::{Cut, Parent, ParentMap, Region};
use crate::clump::Stopped;
use crate::error::{Error, Result, count, push, reserve};
use crate::generate::each;
use crate::mass::{Body, MassOptions, Masses, correct};
use crate::math::{Moments, PrincipalFrame, Sphere};
use crate::run::Run;

/// What is asked of a break.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ShatterOptions {
    /// What is too small to be a fragment.
    pub cut: CutOptions,
    /// The spheres of each fragment.
    pub reclump: ReclumpOptions,
    /// A mass for each sphere, where wanted.
    pub masses: Option<MassOptions>,
}

/// A fragment: a template in the frame of the parent's shape, and how it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Fragment {
    /// What of the first parent it is.
    pub region: Region,
    /// Its spheres, frame and unit of the shape.
    pub clump: Reclump,
    /// What it takes over of the parent's body.
    pub moving: Moving,
    /// Masses of its spheres, where wanted and where there are any: their status and ε say
    /// whether they add up to `moving`, which is exact in any case.
    pub masses: Option<Masses>,
    /// Why there are none although they were wanted; else empty.
    pub no_masses: String,
}

/// What is too small for a sphere or for the volume asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crumb {
    /// What it is.
    pub dust: Dust,
    /// What it takes over of the parent's body.
    pub moving: Moving,
}

/// A parent in pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct Shattered {
    /// The fragments, by the numbers of their cells.
    pub fragments: Vec<Fragment>,
    /// The dust.
    pub dust: Vec<Crumb>,
    /// Kinetic energy of all pieces less the parent's: rounding, where the solver's inertia is that
    /// of the solid.
    pub energy: f64,
    /// The greatest difference of the solver's inertia from that of the pieces, over its greatest;
    /// the greatest number where the solver's body has none.
    pub inertia_error: f64,
    /// How far the solver's centre lies from the pieces', frame and unit of the shape.
    pub shift: crate::math::Vec3,
    /// What a user should know.
    pub notes: Vec<String>,
}

/// One break among many.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// What breaks.
    pub parent: &'a Parent,
    /// The part of it that does, when it is a fragment itself.
    pub region: Option<&'a Region>,
    /// As the solver holds it.
    pub held: &'a Held,
    /// How.
    pub cut: &'a Cut,
    /// Of the random points of its cut and of its spheres.
    pub seed: u64,
}

/// Breaks a body: see [`cut`], [`reclump`] and [`Held::hand_over`], whose errors are its own. Pieces
/// in which no sphere of the least radius fits are dust; that there is no other piece is an error.
///
/// The fragments of one break are made side by side by the run's threads; the bytes do not depend
/// on them.
pub fn shatter(
    parent: &Parent,
    region: Option<&Region>,
    held: &Held,
    by: &Cut,
    options: &ShatterOptions,
    run: &Run,
) -> Result<Shattered> {
    let solid = parent.solid();
    let frame = solid.frame();
    let pieces = match region {
        None => cut(solid, by, &options.cut, run)?,
        Some(region) => cut_region(solid, region, by, &options.cut, run)?,
    };
    let (dust, notes) = (pieces.dust, pieces.notes);
    let regions = pieces.regions;
    let clumps = each(regions.len(), run, |k, run| {
        let region = regions.get(k).ok_or_else(|| Error::Internal("a piece is missing".into()))?;
        reclump(parent, region, &options.reclump, run)
    });
    let pieces = regions.into_iter().zip(clumps).map(|(region, clump)| {
        let moments = region.moments(frame);
        (region, moments, clump)
    });
    hand_over(pieces, dust, notes, held, frame.noise(), options, run)
}

/// The pieces of a break with their moments (caller's frame) and spheres, and its dust, as they take
/// the body over. Pieces without room for a sphere become dust.
pub(super) fn hand_over(
    pieces: impl Iterator<Item = (Region, Moments, Result<Reclump>)>,
    mut dust: Vec<Dust>,
    mut notes: Vec<String>,
    held: &Held,
    noise: f64,
    options: &ShatterOptions,
    run: &Run,
) -> Result<Shattered> {
    let mut kept: Vec<(Region, Reclump)> = Vec::new();
    let mut moments = Vec::new();
    let mut empty = 0;
    for (region, own, clump) in pieces {
        match clump {
            Ok(clump) => {
                push("fragments", &mut kept, (region, clump))?;
                push("fragments", &mut moments, own)?;
            }
            Err(Error::NoSpheres(_)) => {
                empty += 1;
                push("dust", &mut dust, Dust { moments: own, cell: region.cell() })?;
            }
            Err(e) => return Err(e),
        }
    }
    if kept.is_empty() {
        return Err(Error::NoSpheres(format!(
            "none of {} holds a sphere of the least radius",
            count(dust.len() as u64, "piece")
        )));
    }
    if empty > 0 {
        let pieces = count(empty, "piece");
        notes.push(format!("{pieces} without room for a sphere became dust"));
    }
    for crumb in &dust {
        push("pieces", &mut moments, crumb.moments)?;
    }
    let over = held.hand_over(&moments, noise)?;
    let (first, rest) = over.pieces.split_at(kept.len());
    let mut fragments: Vec<Fragment> = reserve("fragments", kept.len())?;
    for (((region, clump), moving), m) in kept.into_iter().zip(first).zip(&moments) {
        let (mut masses, mut no_masses) = (None, String::new());
        if let Some(wanted) = &options.masses {
            let body = body(moving, m.volume, held.scale);
            match correct(&clump.spheres, &body, wanted, run) {
                Ok(found) => masses = Some(found),
                Err(Error::NoMasses(why)) => no_masses = why,
                Err(e) => return Err(e),
            }
        }
        fragments.push(Fragment { region, clump, moving: *moving, masses, no_masses });
    }
    let mut crumbs: Vec<Crumb> = reserve("dust", dust.len())?;
    crumbs.extend(dust.into_iter().zip(rest).map(|(dust, m)| Crumb { dust, moving: *m }));
    Ok(Shattered {
        fragments,
        dust: crumbs,
        energy: over.energy,
        inertia_error: over.inertia,
        shift: over.shift,
        notes,
    })
}

/// What a fragment takes over as a body in the unit of the shape.
fn body(m: &Moving, volume: f64, scale: f64) -> Body {
    let square = scale * scale;
    let mut inertia = m.inertia;
    for entry in [
        &mut inertia.xx,
        &mut inertia.yy,
        &mut inertia.zz,
        &mut inertia.xy,
        &mut inertia.xz,
        &mut inertia.yz,
    ] {
        *entry /= square;
    }
    let moments = m.principal.moments.map(|m| m / square);
    Body {
        density: m.mass / volume,
        volume,
        mass: m.mass,
        center: m.center,
        inertia,
        principal: PrincipalFrame { moments, ..m.principal },
        relative_error: 0.0,
    }
}

/// A fragment that was handed on: its part of the first parent, its spheres (frame and unit of the
/// shape), and the body as the solver holds it now, which it takes over whole. It has no masses, map
/// or quality. Errors: those of [`Held::hand_over`].
pub fn restore(
    parent: &Parent,
    region: Region,
    spheres: Vec<Sphere>,
    held: &Held,
) -> Result<Shattered> {
    let frame = parent.solid().frame();
    let over = held.hand_over(&[region.moments(frame)], frame.noise())?;
    let missing = || Error::Internal("a piece is missing".into());
    let moving = *over.pieces.first().ok_or_else(missing)?;
    let clump = Reclump {
        stopped: Stopped::Exhausted,
        map: ParentMap::between(&[], &spheres)?,
        coverage: 0.0,
        volume_share: 0.0,
        step_factor: None,
        spheres,
    };
    let fragment = Fragment { region, clump, moving, masses: None, no_masses: String::new() };
    let mut fragments = reserve("fragments", 1)?;
    fragments.push(fragment);
    Ok(Shattered {
        fragments,
        dust: Vec::new(),
        energy: over.energy,
        inertia_error: over.inertia,
        shift: over.shift,
        notes: Vec::new(),
    })
}

/// Many breaks of one time step, in this order, side by side; each is, byte for byte, what a call
/// of its own gives on one thread, and one that fails does not stop the others.
pub fn shatter_many(jobs: &[Job], options: &ShatterOptions, run: &Run) -> Vec<Result<Shattered>> {
    each(jobs.len(), run, |k, run| {
        let Job { parent, region, held, cut, seed } = jobs[k];
        shatter(parent, region, held, cut, options, &run.part().run().with_seed(seed))
    })
}

#[cfg(test)]
#[path = "shatter_tests.rs"]
mod tests;
