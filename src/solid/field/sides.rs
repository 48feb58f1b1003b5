//! The sides of faces, put together where they are one edge.

use super::features::{Triangle, WHAT};
use crate::error::{Result, filled};

/// A side of a face, by its greater end and twice the face's number, and 1 if the face has the
/// greater end before the lesser one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    pub other: u32,
    of: u32,
}

impl Side {
    pub(super) fn face(&self) -> usize {
        self.of as usize / 2
    }

    pub(super) fn turned(&self) -> bool {
        self.of & 1 == 1
    }
}

/// The sides of all faces, by their lesser ends, then by their greater ones.
pub(super) struct Sides {
    starts: Vec<u32>,
    all: Vec<Side>,
}

impl Sides {
    pub(super) fn new(faces: &[Triangle], points: usize) -> Result<Sides> {
        let sides = |f: &Triangle| [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])];
        let mut starts = filled(WHAT, points + 1, 0u32)?;
        for (a, b) in faces.iter().flat_map(sides) {
            starts[a.min(b) as usize + 1] += u32::from(a != b);
        }
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        let mut next = filled(WHAT, points, 0u32)?;
        next.copy_from_slice(&starts[..points]);
        let mut all = filled(WHAT, starts[points] as usize, Side::default())?;
        for (i, f) in faces.iter().enumerate() {
            for (a, b) in sides(f) {
                if a != b {
                    let next = &mut next[a.min(b) as usize];
                    all[*next as usize] =
                        Side { other: a.max(b), of: 2 * i as u32 + u32::from(a > b) };
                    *next += 1;
                }
            }
        }
        for range in starts.windows(2) {
            all[range[0] as usize..range[1] as usize].sort_unstable();
        }
        Ok(Sides { starts, all })
    }

    /// The sides that lie together, with their lesser end.
    pub(super) fn groups(&self) -> impl Iterator<Item = (u32, &[Side])> {
        self.starts.windows(2).enumerate().flat_map(|(first, range)| {
            let of = &self.all[range[0] as usize..range[1] as usize];
            of.chunk_by(|a, b| a.other == b.other).map(move |group| (first as u32, group))
        })
    }
}
