//! Several clumps in one call: of one solid with several numbers of spheres, of many shapes, of the
//! labels of a volume. Each is, byte for byte, what a call of its own gives; one that fails
//! does not stop the others.

use super::{GenerateOptions, generate};
use crate::clump::Clump;
use crate::error::{Error, Result};
use crate::run::Run;
use crate::shape::voxels::{LabelInfo, Layout, list_labels};
use crate::shape::{ImportOptions, Shape};
use crate::solid::{Solid, SolidOptions};

/// Bodies for each thread between two looks at cancel.
const ROUND: usize = 4;

/// Levels of detail: a clump for each number of spheres in `counts`, in this order.
///
/// The deadline is one for all: a level that is late is what the method has at its first
/// checkpoint. After a cancel the levels that were not begun are [`Error::Cancelled`].
pub fn levels(
    solid: &Solid,
    options: &GenerateOptions,
    counts: &[usize],
    run: &Run,
) -> Vec<Result<Clump>> {
    let part = |k: usize| k as f64 / counts.len() as f64;
    let level = |(k, &spheres)| {
        run.count_anew();
        run.within([part(k), part(k + 1)], || {
            run.check(0.0, "making levels of detail")?;
            generate(solid, &GenerateOptions { spheres, ..options.clone() }, run)
        })
    };
    counts.iter().enumerate().map(level).collect()
}

/// A clump of each shape, in this order; threads share the shapes, so that many small ones cost
/// little more than their work.
///
/// `solid`, and its memory limit, is for each shape by itself. Deadline and cancel are for all of
/// them, as in [`levels`].
pub fn batch(
    shapes: &[&Shape],
    solid: &SolidOptions,
    options: &GenerateOptions,
    run: &Run,
) -> Vec<Result<Clump>> {
    each(shapes.len(), run, |k, run| generate(&Solid::new(shapes[k], solid, run)?, options, run))
}

/// A clump of each label in `wanted` of a label volume, in this order; empty: of all labels,
/// ascending. With each comes its label.
///
/// As [`batch`] otherwise; of each label only its box is looked at. An error of the whole is one of
/// the volume itself.
pub fn batch_labels(
    labels: &[u32],
    layout: &Layout,
    wanted: &[u32],
    import: &ImportOptions,
    solid: &SolidOptions,
    options: &GenerateOptions,
    run: &Run,
) -> Result<Vec<(u32, Result<Clump>)>> {
    let all: Vec<u32>;
    let wanted = match wanted {
        [] => {
            all = list_labels(labels, layout)?.iter().map(|info| info.label).collect();
            &all
        }
        some => some,
    };
    let made = each_label(labels, layout, wanted, import, run, |shape, run| {
        generate(&Solid::new(shape, solid, run)?, options, run)
    })?;
    Ok(wanted.iter().copied().zip(made).collect())
}

/// `one` of the shape of each label in `wanted`, as [`each`].
pub(crate) fn each_label<T: Send>(
    labels: &[u32],
    layout: &Layout,
    wanted: &[u32],
    import: &ImportOptions,
    run: &Run,
    one: impl Fn(&Shape, &Run) -> Result<T> + Sync,
) -> Result<Vec<Result<T>>> {
    let there = list_labels(labels, layout)?;
    Ok(each(wanted.len(), run, |k, run| {
        let info = find(&there, wanted[k])?;
        one(&Shape::from_listed_label(labels, layout, info, import, run)?, run)
    }))
}

fn find(there: &[LabelInfo], label: u32) -> Result<&LabelInfo> {
    let at = there.binary_search_by_key(&label, |info| info.label);
    at.ok().and_then(|at| there.get(at)).ok_or_else(|| match label {
        0 => Error::InvalidArgument("label 0 is the background, not a particle".into()),
        _ => Error::IndexOutOfRange(format!("label {label} is not in the volume")),
    })
}

/// `one(0), one(1), …`, each on one thread with a run of its own.
pub(crate) fn each<T: Send>(
    n: usize,
    run: &Run,
    one: impl Fn(usize, &Run) -> Result<T> + Sync,
) -> Vec<Result<T>> {
    let part = run.part();
    let round = ROUND * run.pool().threads();
    let mut out = Vec::with_capacity(n);
    while out.len() < n {
        let first = out.len();
        if let Err(e) = run.check(first as f64 / n as f64, "making clumps of many bodies") {
            out.resize_with(n, || Err(e.clone()));
            break;
        }
        out.extend(run.pool().map(round.min(n - first), |k| one(first + k, &part.run())));
    }
    out
}
