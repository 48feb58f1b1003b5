//! Wavefront OBJ, through `tobj`. Only vertices and faces are handed to it, one
//! line at a time, without what a shape has no use for (materials, normals,
//! texture coordinates, colours, weights): so a missing material or a colour that
//! is not a number is no fault, and the line at fault is known.

use super::{RawMesh, polygon, text};
use crate::error::{Error, Result};
use std::fmt::Write;
use std::io::BufRead;

/// Reads OBJ.
pub fn read(bytes: &[u8]) -> Result<RawMesh> {
    if let Some(order) = text::utf16(bytes) {
        return Err(Error::Format(format!("the OBJ file is {order} text: save it as UTF-8")));
    }
    let mut source = Source::new(text::without_bom(bytes));
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
        mesh.vertices.extend(m.positions.chunks_exact(3).map(|v| [v[0], v[1], v[2]]));
        let u32_of = |i: u32| {
            u32::try_from(base + i as usize)
                .map_err(|_| Error::TooLarge(format!("more than {} vertices", u32::MAX)))
        };
        let mut rest = m.indices.as_slice();
        let triangles = if m.face_arities.is_empty() { m.indices.len() / 3 } else { 0 };
        for k in m.face_arities.iter().copied().chain(std::iter::repeat_n(3, triangles)) {
            let Some((face, tail)) = rest.split_at_checked(k as usize) else { break };
            let face = face.iter().map(|&i| u32_of(i)).collect::<Result<Vec<u32>>>()?;
            polygon::triangulate(&face, &mesh.vertices, &mut mesh.faces);
            rest = tail;
        }
    }
    Ok(mesh)
}

/// The lines that `tobj` is given, made when it asks for them.
struct Source<'a> {
    rest: &'a [u8],
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

impl<'a> Source<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Source {
            rest: bytes,
            line: 0,
            now: String::new(),
            at: 0,
            shown: String::new(),
            vertices: 0,
            greatest: (0, 0),
            fault: None,
        }
    }

    /// The next statement, lines that end with a backslash joined; `None` at the end.
    fn statement(&mut self) -> Option<Vec<u8>> {
        let mut joined = Vec::new();
        while !self.rest.is_empty() {
            let end = self.rest.iter().position(|&b| b == b'\n').unwrap_or(self.rest.len());
            let line = self.rest[..end].trim_ascii_end();
            self.rest = self.rest.get(end + 1..).unwrap_or_default();
            self.line += 1;
            match line.strip_suffix(b"\\") {
                Some(part) => {
                    joined.extend_from_slice(part);
                    joined.push(b' ');
                }
                None => {
                    joined.extend_from_slice(line);
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
            let code = statement.split(|&b| b == b'#').next().unwrap_or_default();
            let mut words = text::words(code);
            match words.next() {
                Some(b"v") => {
                    self.vertices += 1;
                    self.now.push('v');
                    words.take(3).for_each(|w| self.push(w));
                }
                Some(b"f") => {
                    self.now.push('f');
                    let mut corners = 0;
                    for w in words {
                        let index = w.split(|&b| b == b'/').next().unwrap_or_default();
                        self.check_index(index)?;
                        self.push(index);
                        corners += 1;
                    }
                    if corners < 3 {
                        let what = format!("a face with {corners} corners");
                        return Err(text::fault(self.line, &what));
                    }
                }
                _ => continue,
            }
            self.shown = text::short(code.trim_ascii());
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
            "line {line}: a face names vertex {index}, but there are {} vertices, counted from 1",
            self.vertices
        ))
    }
}

impl std::io::Read for Source<'_> {
    fn read(&mut self, out: &mut [u8]) -> std::io::Result<usize> {
        let n = self.fill_buf()?.len().min(out.len());
        out[..n].copy_from_slice(&self.now.as_bytes()[self.at..self.at + n]);
        self.consume(n);
        Ok(n)
    }
}

impl BufRead for Source<'_> {
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
