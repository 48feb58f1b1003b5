//! What the readers of text formats share.

use crate::error::{Error, Result};

/// `bytes` without the mark of UTF-8.
pub fn without_bom(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The name of the encoding when `bytes` is UTF-16: by its mark, or by zeros
/// in every other byte of its beginning.
pub fn utf16(bytes: &[u8]) -> Option<&'static str> {
    let head = &bytes[..bytes.len().min(64) & !1];
    let zeros = |odd: usize| {
        head.len() >= 8 && head.chunks_exact(2).all(|p| p[odd] == 0 && p[1 - odd] != 0)
    };
    if bytes.starts_with(b"\xfe\xff") || zeros(0) {
        Some("UTF-16 (big-endian)")
    } else if bytes.starts_with(b"\xff\xfe") || zeros(1) {
        Some("UTF-16 (little-endian)")
    } else {
        None
    }
}

/// The byte that ends the lines of a text: CR only where there is no LF, as a CR before
/// an LF ends no line of its own.
pub fn line_end(bytes: &[u8]) -> u8 {
    if bytes.contains(&b'\n') { b'\n' } else { b'\r' }
}

/// Lines with their numbers from 1; the end of line may be LF, CRLF or CR.
pub fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let end = line_end(bytes);
    bytes.split(move |&b| b == end).enumerate().map(|(i, l)| (i + 1, l.trim_ascii()))
}

/// The words of a line.
pub fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty())
}

/// A number of a file, or an error that names line and word.
pub fn number<T: std::str::FromStr>(word: Option<&[u8]>, line: usize, what: &str) -> Result<T> {
    let word = word.ok_or_else(|| fault(line, &format!("{what} is missing")))?;
    std::str::from_utf8(word)
        .ok()
        .and_then(|s| s.parse().ok())
        .ok_or_else(|| fault(line, &format!("{what} is \"{}\", not a number", short(word))))
}

/// As [`number`], for a coordinate, which must be finite.
pub fn coordinate(word: Option<&[u8]>, line: usize, what: &str) -> Result<f64> {
    let x: f64 = number(word, line, what)?;
    if x.is_finite() {
        return Ok(x);
    }
    Err(Error::NotFinite(format!("line {line}: {what} is {x}")))
}

/// The beginning of a word, printable.
pub fn short(word: &[u8]) -> String {
    let cut = word.len().min(40);
    format!("{}{}", word[..cut].escape_ascii(), if word.len() > cut { "…" } else { "" })
}

/// A fault of a line.
pub fn fault(line: usize, what: &str) -> Error {
    Error::Format(format!("line {line}: {what}"))
}
