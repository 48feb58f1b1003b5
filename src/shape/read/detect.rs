//! Which format a file has: by content first, then by name.

use super::{Format, stl, text};
use crate::error::{Error, Result};

/// The format of `bytes`; `raw`: whether the caller described raw data.
pub fn format(bytes: &[u8], name: &str, raw: bool) -> Result<Format> {
    if bytes.is_empty() {
        return Err(empty(name));
    }
    if bytes.starts_with(b"\x93NUMPY") {
        return Ok(Format::Npy);
    }
    if [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"].iter().any(|m| bytes.starts_with(*m)) {
        return Ok(Format::Tiff);
    }
    let head = text::without_bom(&bytes[..bytes.len().min(1 << 14)]);
    if head.starts_with(b"ply") && head.get(3).is_some_and(u8::is_ascii_whitespace) {
        return Ok(Format::Ply);
    }
    if stl::is_binary_by_size(bytes) {
        return Ok(Format::Stl);
    }
    let by_name = by_extension(name);
    if raw && matches!(by_name, None | Some(Format::Raw)) {
        return Ok(Format::Raw);
    }
    if let Some(order) = text::utf16(bytes) {
        return Err(Error::Format(format!(
            "{} is {order} text: save it as UTF-8 or ASCII",
            quoted(name)
        )));
    }
    if let Some(format) = by_words(head) {
        return Ok(format);
    }
    by_name.ok_or_else(|| {
        Error::Unsupported(format!(
            "{} is none of STL, OBJ, PLY, OFF, npy, TIFF (it begins with \"{}\")",
            quoted(name),
            bytes[..bytes.len().min(16)].escape_ascii()
        ))
    })
}

/// A file without bytes.
pub fn empty(name: &str) -> Error {
    Error::Empty(format!("{} is empty: 0 bytes", quoted(name)))
}

fn quoted(name: &str) -> String {
    if name.is_empty() { "the file".into() } else { format!("the file {name}") }
}

fn by_extension(name: &str) -> Option<Format> {
    match name.rsplit_once('.')?.1.to_ascii_lowercase().as_str() {
        "stl" => Some(Format::Stl),
        "obj" => Some(Format::Obj),
        "ply" => Some(Format::Ply),
        "off" | "coff" | "noff" | "cnoff" => Some(Format::Off),
        "npy" => Some(Format::Npy),
        "tif" | "tiff" => Some(Format::Tiff),
        "raw" | "bin" => Some(Format::Raw),
        _ => None,
    }
}

/// The format of a text by the first words of its lines.
fn by_words(head: &[u8]) -> Option<Format> {
    for line in head.split(|&b| b == b'\n' || b == b'\r') {
        let line = line.trim_ascii_start();
        let end = line.iter().position(|b| b.is_ascii_whitespace()).unwrap_or(line.len());
        let word = &line[..end];
        match word {
            w if w.is_empty() || w.starts_with(b"#") => continue,
            w if w.eq_ignore_ascii_case(b"solid") => return Some(Format::Stl),
            w if super::off::magic(w).is_some() => return Some(Format::Off),
            b"v" | b"vn" | b"vt" | b"vp" | b"f" | b"o" | b"g" | b"s" | b"l" | b"p" | b"mtllib"
            | b"usemtl" => return Some(Format::Obj),
            _ => return None,
        }
    }
    None
}
