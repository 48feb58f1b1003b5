//! Label volumes: one shape for each label; 0 is background.

use super::mask::{CellBox, build};
use super::{LabelInfo, Layout};
use crate::error::{Error, Result, reserve};
use crate::run::{Run, Stage};
use crate::shape::{ImportOptions, Shape};
use std::collections::BTreeMap;

impl Shape {
    /// The shape of one label of a label volume.
    pub fn from_label(
        labels: &[u32],
        layout: &Layout,
        label: u32,
        options: &ImportOptions,
        run: &Run,
    ) -> Result<Shape> {
        layout.check(labels.len())?;
        if label == 0 {
            return Err(Error::InvalidArgument("label 0 is the background, not a particle".into()));
        }
        run.time(Stage::Check, || {
            let solid = |i: usize| labels.get(i).is_some_and(|&l| l == label);
            build(&solid, layout, options, run).map_err(|e| match e {
                Error::Empty(_) => {
                    Error::IndexOutOfRange(format!("label {label} is not in the volume"))
                }
                e => e,
            })
        })
    }
}

/// The labels of a volume, ascending, without 0.
pub fn list_labels(labels: &[u32], layout: &Layout) -> Result<Vec<LabelInfo>> {
    layout.check(labels.len())?;
    let [nx, ny, _] = layout.dims;
    let mut found: BTreeMap<u32, (u64, CellBox)> = BTreeMap::new();
    for (r, row) in labels.chunks(nx).enumerate() {
        let (j, k) = (r % ny, r / ny);
        let mut i = 0;
        // One look-up for each run of equal labels.
        while i < nx {
            let label = row[i];
            let end = row[i..].iter().position(|&l| l != label).map_or(nx, |n| i + n);
            if label != 0 {
                let run = CellBox { first: [i, j, k], last: [end - 1, j, k] };
                let entry = found.entry(label).or_insert((0, run));
                *entry = (entry.0 + (end - i) as u64, entry.1.join(run));
            }
            i = end;
        }
    }
    Ok(found
        .into_iter()
        .map(|(label, (cells, b))| LabelInfo {
            label,
            cells,
            first: b.first,
            last: b.last,
            touches_border: b.touches(layout.dims),
        })
        .collect())
}

/// Labels of 8 or 16 bits as the 32-bit ones that the other functions take.
pub fn widen_labels<T: Copy + Into<u32>>(labels: &[T]) -> Result<Vec<u32>> {
    let mut wide = reserve("labels", labels.len())?;
    wide.extend(labels.iter().map(|&l| l.into()));
    Ok(wide)
}
