//! A break along the labels of the caller's own fracture model.

use super::Region;
use super::cells::Cut;
use super::cut::{CutOptions, cut};
use super::labels::{Labelled, label_solids};
use super::motion::Held;
use super::parent::{Parent, step_of};
use super::reclump::{Reclump, reclump};
use super::shatter::{ShatterOptions, Shattered, hand_over};
use crate::error::{Error, Result, push, reserve};
use crate::generate::each;
use crate::mass::Body;
use crate::math::{Inertia, Moments, Sphere};
use crate::run::Run;
use crate::shape::Layout;
use crate::solid::SolidOptions;
use std::sync::Arc;

/// Breaks a body into the pieces of a label volume, which is in the frame of its shape: as
/// [`shatter`](super::shatter), with [`label_solids`] in the place of a cut. `spheres` are those of
/// the body's clump in that frame, within the union of which those of the fragments stay where the
/// options say so; there may be none.
///
/// Each fragment is the whole of a parent of its own, which is given beside it, in their order: it
/// breaks again as that. Its cell is its label.
pub fn shatter_labels(
    labels: &[u32],
    layout: &Layout,
    solid_options: &SolidOptions,
    spheres: &[Sphere],
    held: &Held,
    options: &ShatterOptions,
    run: &Run,
) -> Result<(Vec<Arc<Parent>>, Shattered)> {
    let (pieces, dust) = label_solids(labels, layout, &options.cut, solid_options, run)?;
    let mut all: Vec<Moments> = reserve("pieces", pieces.len() + dust.len())?;
    all.extend(pieces.iter().map(|p| p.solid.moments()));
    all.extend(dust.iter().map(|d| d.moments));
    if all.is_empty() {
        return Err(Error::Empty("no cell of the labels holds one".into()));
    }
    let whole = Body::of_moments(&sum(&all), 1.0)?;
    let quality = options.reclump.quality && !spheres.is_empty();
    let step = if quality { step_of(spheres, &whole) } else { None };
    let mut solids = reserve("pieces", pieces.len())?;
    solids.extend(pieces.into_iter().map(|Labelled { label, solid }| (label, Arc::new(solid))));
    let made = each(solids.len(), run, |k, run| -> Result<_> {
        let missing = || Error::Internal("a piece of a label is missing".into());
        let (label, solid) = solids.get(k).ok_or_else(missing)?;
        let parent = Parent::new(Arc::clone(solid), spheres, run)?;
        let found = cut(solid, &Cut::Within(Vec::new()), &CutOptions::default(), run)?;
        let mut region = found.regions.into_iter().next().ok_or_else(missing)?;
        region.cell = *label as usize;
        let clump = reclump(&parent, &region, &options.reclump, run).map(|clump| {
            let own = Body::of_moments(&solid.moments(), 1.0).ok();
            let own = own.and_then(|body| step_of(&clump.spheres, &body));
            Reclump {
                volume_share: clump.coverage * solid.moments().volume / whole.volume,
                step_factor: own.zip(step).map(|(own, whole)| own / whole),
                ..clump
            }
        });
        Ok((Arc::new(parent), region, clump))
    });
    let mut parents = Vec::new();
    let mut found: Vec<(Region, Moments, Result<Reclump>)> = reserve("pieces", made.len())?;
    let mut noise = 0.0f64;
    for one in made {
        let (parent, region, clump) = one?;
        let frame = parent.solid().frame();
        noise = noise.max(frame.noise());
        found.push((region, parent.solid().moments(), clump));
        if found.last().is_some_and(|f| f.2.is_ok()) {
            push("parents", &mut parents, parent)?;
        }
    }
    let broken = hand_over(found.into_iter(), dust, Vec::new(), held, noise, options, run)?;
    Ok((parents, broken))
}

/// The moments of all pieces together.
fn sum(pieces: &[Moments]) -> Moments {
    let volume = pieces.iter().map(|p| p.volume).sum::<f64>();
    let mut centroid = crate::math::Vec3::zeros();
    for p in pieces {
        centroid += p.centroid * (p.volume / volume);
    }
    let about = |p: &Moments| p.inertia.shifted(p.volume, &(p.centroid - centroid)).matrix();
    let inertia = pieces.iter().map(about).sum();
    Moments { volume, centroid, inertia: Inertia::from_matrix(&inertia), relative_error: 0.0 }
}
