//! Wavefront OBJ, through `tobj`. Only vertices and faces are handed to it, one
//! line at a time, without what a shape has no use for (materials, normals,
//! texture coordinates, colours, weights): so a missing material or a colour that
//! is not a number is no fault, and the line at fault is known.

use super::{RawMesh, Reading, polygon, text};
use crate::error::{Error, Result, count, push};
use std::fmt::Write;
use std::io::BufRead;

/// What `tobj` takes for a vertex, a face and a corner of a face.
const VERTEX: u64 = 120;
const FACE: u64 = 130;
const CORNER: u64 = 40;

/// Reads OBJ.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<RawMesh> {
    if let Some(order) = text::utf16(bytes) {
        return Err(Error::Format(format!("the OBJ file is {order} text: save it as UTF-8")));
    }
    let mut source = Source::new(text::without_bom(bytes), reading);
    let options = tobj::LoadOptions { single_index: false, ..Default::default() };
    let loaded = tobj::load_obj_buf(&mut source, &options, |_| Ok(Default::default()));
    if let Some(fault) = source.fault {
        return Err(fault);
    }
    let (models, _) = loaded.map_err(|e| {
        text::fault(source.line, &format!("\"{}\" is not understood ({e})", source.shown))
    })?;
    let mut mesh = RawMesh::default();
    for m in models.iter().map(|m| &m.mesh) {
        let base = mesh.vertices.len();
        let (points, _) = m.positions.as_chunks::<3>();
        for v in points {
            push("vertices", &mut mesh.vertices, *v)?;
        }
        let u32_of = |i: u32| {
            u32::try_from(base + i as usize)
                .map_err(|_| Error::TooLarge(format!("more than {} vertices", u32::MAX)))
        };
        let mut rest = m.indices.as_slice();
        let triangles = if m.face_arities.is_empty() { m.indices.len() / 3 } else { 0 };
        let mut corners: Vec<u32> = Vec::new();
        let arities = m.face_arities.iter().copied().chain(std::iter::repeat_n(3, triangles));
        for (n, k) in arities.enumerate() {
            reading.tick(n, &mesh)?;
            let Some((face, tail)) = rest.split_at_checked(k as usize) else { break };
            corners.clear();
            for &i in face {
                push("corners", &mut corners, u32_of(i)?)?;
            }
            polygon::triangulate(&corners, &mesh.vertices, &mut mesh.faces)?;
            rest = tail;
        }
    }
    Ok(mesh)
}

/// The lines that `tobj` is given, made when it asks for them.
struct Source<'a, 'r> {
    rest: &'a [u8],
    /// The byte that ends lines.
    end: u8,
    reading: &'a Reading<'a, 'r>,
    /// Bytes that `tobj` takes for what it was given.
    taken: u64,
    /// Lines taken so far, from 1.
    line: usize,
    /// The first line of a statement that is continued.
    now: String,
    at: usize,
    shown: String,
    vertices: u64,
    /// The greatest index that was named, with its line: vertices may come later.
    greatest: (u64, usize),
    fault: Option<Error>,
}

impl<'a, 'r> Source<'a, 'r> {
    fn new(bytes: &'a [u8], reading: &'a Reading<'a, 'r>) -> Self {
        Source {
            rest: bytes,
            end: text::line_end(bytes),
            reading,
            taken: 0,
            line: 0,
            now: String::new(),
            at: 0,
            shown: String::new(),
            vertices: 0,
            greatest: (0, 0),
            fault: None,
        }
    }

    /// The next statement, without its comment, lines that end with a backslash joined;
    /// `None` at the end.
    fn statement(&mut self) -> Option<Vec<u8>> {
        let mut joined = Vec::new();
        while !self.rest.is_empty() {
            let end = self.rest.iter().position(|&b| b == self.end).unwrap_or(self.rest.len());
            let line = &self.rest[..end];
            self.rest = self.rest.get(end + 1..).unwrap_or_default();
            self.line += 1;
            // A backslash in a comment continues nothing.
            let code = line.split(|&b| b == b'#').next().unwrap_or_default();
            let goes_on = code.len() == line.len() && line.trim_ascii_end().ends_with(b"\\");
            match code.trim_ascii_end().strip_suffix(b"\\") {
                Some(part) if goes_on => {
                    joined.extend_from_slice(part);
                    joined.push(b' ');
                }
                _ => {
                    joined.extend_from_slice(code);
                    return Some(joined);
                }
            }
        }
        (!joined.is_empty()).then_some(joined)
    }

    /// Makes the next line for `tobj`; at the end or at a fault there is none.
    fn fill(&mut self) -> Result<()> {
        self.now.clear();
        self.at = 0;
        while let Some(statement) = self.statement() {
            self.reading.tick_with(
                self.line,
                self.taken,
                "the vertices and faces of the OBJ file",
            )?;
            let mut words = text::words(&statement);
            match words.next() {
                Some(b"v") => {
                    self.vertices += 1;
                    self.taken += VERTEX;
                    self.now.push('v');
                    for (w, axis) in words.zip(["x", "y", "z"]) {
                        self.check_finite(w, axis)?;
                        self.push(w);
                    }
                }
                Some(b"f") => {
                    self.taken += FACE;
                    self.now.push('f');
                    let mut corners = 0;
                    for w in words {
                        let index = w.split(|&b| b == b'/').next().unwrap_or_default();
                        self.check_index(index)?;
                        self.push(index);
                        corners += 1;
                        self.taken += CORNER;
                    }
                    if corners < 3 {
                        let what = format!("a face with {corners} corners");
                        return Err(text::fault(self.line, &what));
                    }
                }
                _ => continue,
            }
            self.shown = text::short(statement.trim_ascii());
            self.now.push('\n');
            return Ok(());
        }
        let (index, line) = self.greatest;
        if index > self.vertices {
            return Err(self.out_of_range(&index.to_string(), line));
        }
        Ok(())
    }

    fn push(&mut self, word: &[u8]) {
        let _ = write!(self.now, " {}", String::from_utf8_lossy(word));
    }

    /// What is not a number at all is left to `tobj`.
    fn check_finite(&self, word: &[u8], axis: &str) -> Result<()> {
        let x: f64 = text::number(Some(word), self.line, axis).unwrap_or_default();
        if x.is_finite() {
            return Ok(());
        }
        Err(Error::NotFinite(format!(
            "line {}: vertex {}, counted from 1, has {axis} = {x}",
            self.line, self.vertices
        )))
    }

    fn check_index(&mut self, word: &[u8]) -> Result<()> {
        let i: i64 = text::number(Some(word), self.line, "the vertex of a face")?;
        if i == 0 || i < 0 && i.unsigned_abs() > self.vertices {
            return Err(self.out_of_range(&i.to_string(), self.line));
        }
        if i > 0 && i as u64 > self.greatest.0 {
            self.greatest = (i as u64, self.line);
        }
        Ok(())
    }

    fn out_of_range(&self, index: &str, line: usize) -> Error {
        Error::IndexOutOfRange(format!(
            "line {line}: a face names vertex {index}, but the file has {} (counted from 1)",
            count(self.vertices, "vertex")
        ))
    }
}

impl std::io::Read for Source<'_, '_> {
    fn read(&mut self, out: &mut [u8]) -> std::io::Result<usize> {
        let n = self.fill_buf()?.len().min(out.len());
        out[..n].copy_from_slice(&self.now.as_bytes()[self.at..self.at + n]);
        self.consume(n);
        Ok(n)
    }
}

impl BufRead for Source<'_, '_> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        if self.at >= self.now.len()
            && let Err(e) = self.fill()
        {
            self.now.clear();
            self.at = 0;
            self.rest = &[];
            self.fault.get_or_insert(e);
        }
        Ok(&self.now.as_bytes()[self.at..])
    }

    fn consume(&mut self, n: usize) {
        self.at = (self.at + n).min(self.now.len());
    }
}
