//! What a reader runs with: cancel, and the memory that is left.

use super::RawMesh;
use crate::error::{Error, Result, reserve};
use crate::run::Run;

/// Lines or elements between two questions whether to go on.
const OFTEN: usize = 4096;

/// The run and the memory of one reading.
pub(super) struct Reading<'r, 'a> {
    /// The call that reads.
    pub run: &'r Run<'a>,
    /// Most bytes that all arrays may take together.
    pub limit: u64,
    /// Bytes that are held already: the file, when it was loaded.
    pub held: u64,
}

impl Reading<'_, '_> {
    /// Refuses what would take more than the limit, together with what is held.
    pub fn allow(&self, bytes: u128, what: impl FnOnce() -> String) -> Result<()> {
        if bytes.saturating_add(self.held.into()) > self.limit.into() {
            return Err(Error::MemoryLimit(format!(
                "{} need {bytes} bytes{}, the limit is {}",
                what(),
                beside(self.held),
                self.limit
            )));
        }
        Ok(())
    }

    /// Every few thousand lines or elements: cancel, and what the mesh takes by now.
    pub fn tick(&self, count: usize, mesh: &RawMesh) -> Result<()> {
        if !count.is_multiple_of(OFTEN) {
            return Ok(());
        }
        self.run.check(0.0, "reading the file")?;
        self.allow(mesh.bytes().into(), || self.arrays(mesh.vertices.len(), mesh.faces.len()))
    }

    /// As [`Reading::tick`], for a reader that holds `bytes` of its own.
    pub fn tick_with(&self, count: usize, bytes: u64, what: &str) -> Result<()> {
        if !count.is_multiple_of(OFTEN) {
            return Ok(());
        }
        self.run.check(0.0, "reading the file")?;
        self.allow(bytes.into(), || what.to_owned())
    }

    /// An empty mesh with room for so many vertices and faces.
    pub fn mesh(&self, vertices: usize, faces: usize) -> Result<RawMesh> {
        let bytes = vertices as u128 * VERTEX as u128 + faces as u128 * FACE as u128;
        self.allow(bytes, || self.arrays(vertices, faces))?;
        Ok(RawMesh { vertices: reserve("vertices", vertices)?, faces: reserve("faces", faces)? })
    }

    fn arrays(&self, vertices: usize, faces: usize) -> String {
        format!("{vertices} vertices and {faces} faces")
    }
}

/// What is held beside, for a message.
pub(super) fn beside(held: u64) -> String {
    if held > 0 { format!(" beside the {held} of the file") } else { String::new() }
}

const VERTEX: usize = size_of::<[f64; 3]>();
const FACE: usize = size_of::<[u32; 3]>();

impl RawMesh {
    /// What its arrays take.
    pub(super) fn bytes(&self) -> u64 {
        (self.vertices.capacity() * VERTEX + self.faces.capacity() * FACE) as u64
    }
}
