//! OFF: the word OFF (with any of ST, C, N before it), counts, vertices, faces.
//! Numbers may stand anywhere between white space, as long as what follows a
//! face (its colour) stays on its line; `#` begins a comment.

use super::{RawMesh, polygon, text};
use crate::error::{Error, Result};

/// How many numbers each vertex has after x, y, z, when `word` is the magic word
/// of a variant that is read; `None` when it is not one.
pub fn magic(word: &[u8]) -> Option<usize> {
    let prefix = word.strip_suffix(b"OFF")?;
    let (texture, rest) = prefix.strip_prefix(b"ST").map_or((0, prefix), |rest| (2, rest));
    match rest {
        b"" | b"C" => Some(texture),
        b"N" | b"CN" => Some(texture + 3),
        _ => None,
    }
}

/// The words of a file with their lines, without comments.
struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Words<'a> {
    /// The next word; on this line only when `here`.
    fn next(&mut self, here: bool) -> Option<&'a [u8]> {
        loop {
            match self.bytes.get(self.at)? {
                b'\n' if here => return None,
                b'\n' => {
                    self.line += 1;
                    self.at += 1;
                }
                b'#' => self.skip_line(),
                b if b.is_ascii_whitespace() => self.at += 1,
                _ => break,
            }
        }
        let rest = &self.bytes[self.at..];
        let end =
            rest.iter().position(|b| b.is_ascii_whitespace() || *b == b'#').unwrap_or(rest.len());
        self.at += end;
        Some(&rest[..end])
    }

    fn skip_line(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
    }

    fn number<T: std::str::FromStr>(&mut self, what: &str) -> Result<T> {
        let word = self.next(false);
        if word.is_none() {
            return Err(text::fault(self.line, &format!("the OFF file ends before {what}")));
        }
        text::number(word, self.line, what)
    }
}

/// Reads OFF, COFF, NOFF, CNOFF and their ST forms.
pub fn read(bytes: &[u8]) -> Result<RawMesh> {
    if let Some(order) = text::utf16(bytes) {
        return Err(Error::Format(format!("the OFF file is {order} text: save it as ASCII")));
    }
    let mut words = Words { bytes: text::without_bom(bytes), at: 0, line: 1 };
    let extra = first_word(&mut words)?;
    let n: u64 = words.number("the number of vertices")?;
    let m: u64 = words.number("the number of faces")?;
    // The number of edges is often missing; nothing depends on it.
    words.skip_line();
    let left = (words.bytes.len() - words.at) as u64;
    // Each number takes at least a character and a space, but for the last.
    let least = n.saturating_mul(2 * (3 + extra as u64)).saturating_add(m.saturating_mul(2));
    if least > left.saturating_add(1) {
        return Err(text::fault(
            words.line,
            &format!(
                "the OFF header declares {n} vertices and {m} faces, which take at least {least} \
                 bytes, but only {left} follow"
            ),
        ));
    }
    let mut mesh = RawMesh::default();
    for i in 0..n {
        let mut v = [0.0; 3];
        for (x, axis) in v.iter_mut().zip(["x", "y", "z"]) {
            *x = words.number(&format!("{axis} of vertex {i}"))?;
        }
        for _ in 0..extra {
            words.number::<f64>(&format!("the normal or texture of vertex {i}"))?;
        }
        // A colour of the vertex.
        words.skip_line();
        mesh.vertices.push(v);
    }
    let mut corners: Vec<u32> = Vec::new();
    for i in 0..m {
        let k: u64 = words.number(&format!("the number of corners of face {i}"))?;
        corners.clear();
        for j in 0..k {
            let c: i64 = words.number(&format!("corner {j} of face {i}"))?;
            if c < 0 || c as u64 >= n {
                return Err(Error::IndexOutOfRange(format!(
                    "line {}: face {i} names vertex {c}, but there are only {n} vertices",
                    words.line
                )));
            }
            corners.push(c as u32);
        }
        words.skip_line();
        polygon::triangulate(&corners, &mesh.vertices, &mut mesh.faces);
    }
    Ok(mesh)
}

/// The magic word; the counts may follow it without a space.
fn first_word(words: &mut Words) -> Result<usize> {
    let word = words.next(false).unwrap_or_default();
    let end = word.windows(3).position(|w| w == b"OFF").map_or(0, |i| i + 3);
    let (name, rest) = word.split_at(end);
    words.at -= rest.len();
    let fault = |what: String| Err(text::fault(words.line, &what));
    match magic(name) {
        Some(_) if rest.first().is_some_and(|b| !b.is_ascii_digit()) => {
            fault(format!("\"{}\" is not the word OFF", text::short(word)))
        }
        Some(extra) => Ok(extra),
        None if end > 0 => Err(Error::Unsupported(format!(
            "{} files are not read, only OFF, COFF, NOFF and CNOFF",
            text::short(name)
        ))),
        None => fault(format!("the OFF file begins with \"{}\"", text::short(word))),
    }
}
