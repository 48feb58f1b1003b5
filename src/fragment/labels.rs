//! Pieces that a fracture model of the caller's has marked in a label volume.

use super::cut::{CutOptions, Dust};
use crate::error::{Error, Result, filled, push};
use crate::run::Run;
use crate::shape::voxels::list_labels;
use crate::shape::{ImportOptions, Layout, Shape};
use crate::solid::moments::moments;
use crate::solid::{Solid, SolidOptions};

/// A piece of a label.
pub struct Labelled {
    /// Its label.
    pub label: u32,
    /// The piece, of the volume's own cells.
    pub solid: Solid,
}

/// One solid for each face-connected piece of each label (0 is background), by ascending labels and
/// then by first cells; and the pieces of less than `least_volume` as dust, the cell of which is the
/// label. What they are made of is theirs alone: each has its own distance transform.
///
/// Errors: those of [`Shape::from_label`] and [`Solid::new`].
pub fn label_solids(
    labels: &[u32],
    layout: &Layout,
    options: &CutOptions,
    solid_options: &SolidOptions,
    run: &Run,
) -> Result<(Vec<Labelled>, Vec<Dust>)> {
    let infos = list_labels(labels, layout)?;
    let [nx, ny, nz] = layout.dims;
    let strides = [1, nx, nx * ny];
    let mut piece = filled("pieces of labels", labels.len(), 0u32)?;
    // Pieces are numbered label by label, so that their numbers ascend with the labels.
    let mut of: Vec<(u32, u64)> = Vec::new();
    let mut next: Vec<usize> = Vec::new();
    for info in &infos {
        let [first, last] = [info.first, info.last];
        for k in first[2]..=last[2] {
            for j in first[1]..=last[1] {
                for i in first[0]..=last[0] {
                    let start = i + nx * (j + ny * k);
                    if labels[start] != info.label || piece[start] != 0 {
                        continue;
                    }
                    let number = u32::try_from(of.len() + 1)
                        .map_err(|_| Error::TooLarge("more than 2^32 pieces of labels".into()))?;
                    let mut cells = 0;
                    piece[start] = number;
                    push("cells of a label", &mut next, start)?;
                    while let Some(c) = next.pop() {
                        cells += 1;
                        let at = [c % nx, c / nx % ny, c / (nx * ny)];
                        for axis in 0..3 {
                            let below = (at[axis] > 0).then(|| c - strides[axis]);
                            let above =
                                (at[axis] + 1 < [nx, ny, nz][axis]).then(|| c + strides[axis]);
                            for d in [below, above].into_iter().flatten() {
                                if labels[d] == info.label && piece[d] == 0 {
                                    piece[d] = number;
                                    push("cells of a label", &mut next, d)?;
                                }
                            }
                        }
                    }
                    push("pieces of labels", &mut of, (info.label, cells))?;
                }
            }
        }
    }
    let cell: f64 = layout.spacing.iter().product();
    let import = ImportOptions { memory_limit: solid_options.memory_limit, ..Default::default() };
    let (mut made, mut dust) = (Vec::new(), Vec::new());
    let boxes = list_labels(&piece, layout)?;
    for (i, info) in boxes.iter().enumerate() {
        run.check(i as f64 / boxes.len() as f64, "making solids of labels")?;
        let (label, cells) = of
            .get((info.label as usize).wrapping_sub(1))
            .ok_or_else(|| Error::Internal("a piece of a label is lost".into()))?;
        let shape = Shape::from_listed_label(&piece, layout, info, &import, run)?;
        if (*cells as f64 * cell) < options.least_volume {
            let moments = shape.frame.moments_to_input(&moments(&shape.body, run)?);
            push("dust", &mut dust, Dust { moments, cell: *label as usize })?;
            continue;
        }
        let solid = Solid::new(&shape, solid_options, run)?;
        push("pieces of labels", &mut made, Labelled { label: *label, solid })?;
    }
    Ok((made, dust))
}
