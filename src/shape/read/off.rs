//! OFF: the word OFF (with any of ST, C, N before it), counts, vertices, faces;
//! `#` begins a comment. Each vertex and each face may have its line, with its colour at
//! the end; or the numbers stand anywhere between white space, without colours.

use super::{RawMesh, Reading, polygon, text};
use crate::error::{Error, Result, count, push};

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

/// How the numbers lie in the lines.
#[derive(Clone, Copy, PartialEq)]
enum Lines {
    /// A line for each vertex and each face; the rest of it is a colour.
    Own,
    /// Anywhere, and there are no others; the number of edges, often missing, is there.
    FreeWithEdges,
    /// … or is not.
    Free,
    /// A vertex or face may go on in the next line; what follows it on its last is a colour.
    Over,
}

/// The words of a file with their lines, without comments.
#[derive(Clone)]
struct Words<'a> {
    bytes: &'a [u8],
    /// The byte that ends lines.
    end: u8,
    at: usize,
    line: usize,
}

impl<'a> Words<'a> {
    /// The next word; on this line only when `here`.
    fn next(&mut self, here: bool) -> Option<&'a [u8]> {
        loop {
            match self.bytes.get(self.at)? {
                b if *b == self.end && here => return None,
                b if *b == self.end => {
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
        self.at += rest.iter().position(|&b| b == self.end).unwrap_or(rest.len());
    }

    /// A number, on this line only when `here`.
    fn number<T: std::str::FromStr>(&mut self, here: bool, what: &str) -> Result<T> {
        let word = self.next(here);
        if word.is_none() {
            return Err(self.ends_before(what));
        }
        text::number(word, self.line, what)
    }

    fn ends_before(&self, what: &str) -> Error {
        text::fault(self.line, &format!("the OFF file ends before {what}"))
    }
}

/// Reads OFF, COFF, NOFF, CNOFF and their ST forms.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<RawMesh> {
    if let Some(order) = text::utf16(bytes) {
        return Err(Error::Format(format!("the OFF file is {order} text: save it as ASCII")));
    }
    let bytes = text::without_bom(bytes);
    let mut words = Words { bytes, end: text::line_end(bytes), at: 0, line: 1 };
    let extra = first_word(&mut words)?;
    let n: u64 = words.number(false, "the number of vertices")?;
    let m: u64 = words.number(false, "the number of faces")?;
    let left = (words.bytes.len() - words.at) as u64;
    // Each number takes at least a character and a space, but for the last.
    let least = n.saturating_mul(2 * (3 + extra as u64)).saturating_add(m.saturating_mul(2));
    if least > left.saturating_add(1) {
        return Err(text::fault(
            words.line,
            &format!(
                "the OFF header declares {} and {}, which take at least {least} bytes, but only \
                 {left} follow",
                count(n, "vertex"),
                count(m, "face")
            ),
        ));
    }
    let counts = [n, m, extra as u64];
    for lines in [Lines::Own, Lines::FreeWithEdges, Lines::Free] {
        match elements(words.clone(), counts, lines, reading) {
            Err(Error::Format(_) | Error::IndexOutOfRange(_) | Error::NotFinite(_)) => {}
            done => return done,
        }
    }
    elements(words, counts, Lines::Over, reading)
}

/// The vertices and faces after the counts.
fn elements(
    mut words: Words,
    [n, m, extra]: [u64; 3],
    lines: Lines,
    reading: &Reading,
) -> Result<RawMesh> {
    let free = matches!(lines, Lines::FreeWithEdges | Lines::Free);
    let here = lines == Lines::Own;
    if lines == Lines::FreeWithEdges {
        words.number::<f64>(false, "the number of edges")?;
    } else if !free {
        words.skip_line();
    }
    let mut mesh = reading.mesh(n as usize, m as usize)?;
    for i in 0..n {
        reading.tick(i as usize, &mesh)?;
        let mut v = [0.0; 3];
        for (k, (x, axis)) in v.iter_mut().zip(["x", "y", "z"]).enumerate() {
            let word = words.next(here && k > 0);
            let what = format!("{axis} of vertex {i}");
            if word.is_none() {
                return Err(words.ends_before(&what));
            }
            *x = text::coordinate(word, words.line, &what)?;
        }
        for _ in 0..extra {
            words.number::<f64>(here, &format!("the normal or texture of vertex {i}"))?;
        }
        if !free {
            words.skip_line();
        }
        push("vertices", &mut mesh.vertices, v)?;
    }
    let mut corners: Vec<u32> = Vec::new();
    for i in 0..m {
        reading.tick(i as usize, &mesh)?;
        let k: u64 = words.number(false, &format!("the number of corners of face {i}"))?;
        corners.clear();
        for j in 0..k {
            let c: i64 = words.number(here, &format!("corner {j} of face {i}"))?;
            if c < 0 || c as u64 >= n {
                return Err(Error::IndexOutOfRange(format!(
                    "line {}: face {i} names vertex {c}, but the file has only {}",
                    words.line,
                    count(n, "vertex")
                )));
            }
            push("corners", &mut corners, c as u32)?;
        }
        if !free {
            words.skip_line();
        }
        polygon::triangulate(&corners, &mesh.vertices, &mut mesh.faces)?;
    }
    match free.then(|| words.next(false)).flatten() {
        Some(_) => Err(text::fault(words.line, "there are numbers after the last face")),
        None => Ok(mesh),
    }
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
