//! Label volumes: one shape for each label; 0 is background.

use super::mask::{CellBox, build};
use super::{LabelInfo, Layout};
use crate::error::{Error, Result, push, reserve};
use crate::run::{Run, Stage};
use crate::shape::{ImportOptions, Shape};
use std::collections::HashMap;

impl Shape {
    /// The shape of one label of a label volume.
    pub fn from_label(
        labels: &[u32],
        layout: &Layout,
        label: u32,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        Shape::from_read_label(labels, layout, label, options, 0, run)
    }

    /// As [`Shape::from_label`], beside `held` bytes of a file's values.
    pub(crate) fn from_read_label(
        labels: &[u32],
        layout: &Layout,
        label: u32,
        options: &ImportOptions,
        held: u64,
        run: &Run,
    ) -> Result<Shape> {
        layout.check(labels.len())?;
        if label == 0 {
            return Err(Error::InvalidArgument("label 0 is the background, not a particle".into()));
        }
        run.time(Stage::Check, || {
            let solid = |i: usize| labels.get(i).is_some_and(|&l| l == label);
            build(&solid, layout, None, options, held, run).map_err(|e| match e {
                Error::Empty(_) => {
                    Error::IndexOutOfRange(format!("label {label} is not in the volume"))
                }
                e => e,
            })
        })
    }

    /// As [`Shape::from_label`] of a label that [`list_labels`] found there: only its box is
    /// looked at.
    pub(crate) fn from_listed_label(
        labels: &[u32],
        layout: &Layout,
        of: &LabelInfo,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        layout.check(labels.len())?;
        run.time(Stage::Check, || {
            let solid = |i: usize| labels.get(i).is_some_and(|&l| l == of.label);
            let known = CellBox { first: of.first, last: of.last };
            build(&solid, layout, Some(known), options, 0, run)
        })
    }
}

/// The labels of a volume, ascending, without 0.
pub fn list_labels(labels: &[u32], layout: &Layout) -> Result<Vec<LabelInfo>> {
    layout.check(labels.len())?;
    let [nx, ny, _] = layout.dims;
    // Where each label is in the list; its order plays no part.
    let mut place: HashMap<u32, usize> = HashMap::new();
    let mut found: Vec<LabelInfo> = Vec::new();
    for (r, row) in labels.chunks(nx).enumerate() {
        let (j, k) = (r % ny, r / ny);
        let mut i = 0;
        // One look-up for each run of equal labels.
        while i < nx {
            let label = row[i];
            let end = row[i..].iter().position(|&l| l != label).map_or(nx, |n| i + n);
            if label != 0 {
                let run = CellBox { first: [i, j, k], last: [end - 1, j, k] };
                let known = place.get(&label).and_then(|&at| found.get_mut(at));
                if let Some(info) = known {
                    let all = CellBox { first: info.first, last: info.last }.join(run);
                    (info.first, info.last) = (all.first, all.last);
                    info.cells += (end - i) as u64;
                } else {
                    place.try_reserve(1).map_err(|_| {
                        Error::OutOfMemory(format!(
                            "no memory for more than {} labels",
                            place.len()
                        ))
                    })?;
                    place.insert(label, found.len());
                    let (first, last, cells) = (run.first, run.last, (end - i) as u64);
                    let info = LabelInfo { label, cells, first, last, touches_border: false };
                    push("labels", &mut found, info)?;
                }
            }
            i = end;
        }
    }
    for info in &mut found {
        let all = CellBox { first: info.first, last: info.last };
        info.touches_border = all.touches(layout.dims);
    }
    found.sort_unstable_by_key(|info| info.label);
    Ok(found)
}

/// Labels of 8 or 16 bits as the 32-bit ones that the other functions take.
pub fn widen_labels<T: Copy + Into<u32>>(labels: &[T]) -> Result<Vec<u32>> {
    let mut wide = reserve("labels", labels.len())?;
    wide.extend(labels.iter().map(|&l| l.into()));
    Ok(wide)
}
