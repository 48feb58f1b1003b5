//! STL. Binary files are read by `stl_io`; its ascii reader is not used: it
//! keeps single precision, stops after the first solid, and knows neither upper
//! case nor line numbers.

use super::{RawMesh, Reading, text};
use crate::error::{Error, Result, count, push};

const HEADER: usize = 84;
const FACE: usize = 50;

/// Whether the size is just what the count after the 80-byte header asks for. A
/// binary file whose header says `solid` is told apart in this way.
pub fn is_binary_by_size(bytes: &[u8]) -> bool {
    declared(bytes).is_some_and(|n| n.checked_mul(FACE) == Some(bytes.len() - HEADER))
}

fn declared(bytes: &[u8]) -> Option<usize> {
    let n = bytes.get(80..HEADER)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(n)).ok()
}

/// Reads STL of either kind.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<RawMesh> {
    if is_binary_by_size(bytes) {
        return binary(bytes, reading);
    }
    if let Some(order) = text::utf16(bytes) {
        return Err(Error::Format(format!("the STL is {order} text: save it as ASCII")));
    }
    let body = text::without_bom(bytes);
    let start = body.trim_ascii_start();
    let says_solid = start.get(..5).is_some_and(|w| w.eq_ignore_ascii_case(b"solid"));
    // A text has no zeros and no bytes beyond ASCII in its keywords; names may be anything.
    let head = &bytes[..bytes.len().min(512)];
    if says_solid && !head.contains(&0) { ascii(body, reading) } else { binary(bytes, reading) }
}

fn binary(bytes: &[u8], reading: &Reading) -> Result<RawMesh> {
    let n = declared(bytes).ok_or_else(|| {
        Error::Format(format!(
            "the binary STL ends at byte {}, within its header of {HEADER} bytes",
            bytes.len()
        ))
    })?;
    let there = bytes.len() - HEADER;
    if n as u64 * FACE as u64 > there as u64 {
        return Err(Error::Format(format!(
            "the binary STL declares {}, up to byte {}, but ends at byte {} in face {}",
            count(n as u64, "face"),
            n as u64 * FACE as u64 + HEADER as u64,
            bytes.len(),
            there / FACE
        )));
    }
    // Less than a face is padding; more is a count that lies.
    if there - n * FACE >= FACE {
        return Err(Error::Format(format!(
            "the binary STL declares {}, up to byte {}, but has {} bytes",
            count(n as u64, "face"),
            HEADER + n * FACE,
            bytes.len()
        )));
    }
    // `stl_io` takes a file that begins with "solid " for text: hand it another header.
    let mut header = [0u8; HEADER];
    header[80..].copy_from_slice(&bytes[80..HEADER]);
    let mut source = Joined { head: &header, tail: &bytes[HEADER..], at: 0 };
    let broken = |e: std::io::Error| Error::Format(format!("the binary STL is broken: {e}"));
    if n > u32::MAX as usize / 3 {
        return Err(Error::TooLarge(format!("{n} faces have more corners than 2³²")));
    }
    let mut mesh = reading.mesh(3 * n, n)?;
    for (i, t) in stl_io::create_stl_reader(&mut source).map_err(broken)?.enumerate() {
        reading.tick(i, &mesh)?;
        let t = t.map_err(broken)?;
        mesh.vertices.extend(t.vertices.map(|v| v.0.map(f64::from)));
        let k = 3 * i as u32;
        mesh.faces.push([k, k + 1, k + 2]);
    }
    Ok(mesh)
}

/// Two pieces of bytes as one source.
struct Joined<'a> {
    head: &'a [u8],
    tail: &'a [u8],
    at: usize,
}

impl std::io::Read for Joined<'_> {
    fn read(&mut self, out: &mut [u8]) -> std::io::Result<usize> {
        let rest = match self.at.checked_sub(self.head.len()) {
            None => &self.head[self.at..],
            Some(i) => self.tail.get(i..).unwrap_or_default(),
        };
        let n = rest.len().min(out.len());
        out[..n].copy_from_slice(&rest[..n]);
        self.at += n;
        Ok(n)
    }
}

impl std::io::Seek for Joined<'_> {
    fn seek(&mut self, to: std::io::SeekFrom) -> std::io::Result<u64> {
        match to {
            std::io::SeekFrom::Start(i) => self.at = i as usize,
            _ => return Err(std::io::ErrorKind::Unsupported.into()),
        }
        Ok(self.at as u64)
    }
}

/// Facets of any number of solids; keywords in any case, normals not looked at.
fn ascii(bytes: &[u8], reading: &Reading) -> Result<RawMesh> {
    let mut mesh = RawMesh::default();
    let (mut open, mut corners, mut ended, mut last) = (false, 0, false, 0);
    for (n, line) in text::lines(bytes) {
        reading.tick(n, &mesh)?;
        let mut words = text::words(line);
        let Some(word) = words.next() else { continue };
        last = n;
        match word.to_ascii_lowercase().as_slice() {
            b"solid" => ended = false,
            b"endsolid" if !open => ended = true,
            b"facet" if !open => (open, corners) = (true, 0),
            b"outer" | b"endloop" if open => {}
            b"vertex" if open && corners < 3 => {
                let mut v = [0.0; 3];
                for (x, axis) in v.iter_mut().zip(["x", "y", "z"]) {
                    *x = text::coordinate(words.next(), n, &format!("{axis} of the vertex"))?;
                }
                push("vertices", &mut mesh.vertices, v)?;
                corners += 1;
            }
            b"vertex" if open => return Err(text::fault(n, "the facet has more than 3 vertices")),
            b"endfacet" if open => {
                if corners != 3 {
                    let what = format!("the facet has {corners} vertices, not 3");
                    return Err(text::fault(n, &what));
                }
                let k = u32::try_from(mesh.vertices.len()).map_err(|_| {
                    Error::TooLarge(format!("line {n}: more than {} vertices", u32::MAX))
                })?;
                push("faces", &mut mesh.faces, [k - 3, k - 2, k - 1])?;
                open = false;
            }
            _ => {
                let what = format!("\"{}\" is not expected here", text::short(word));
                return Err(text::fault(n, &what));
            }
        }
    }
    if open || !ended {
        return Err(text::fault(last, "the ascii STL ends without endsolid: it is cut off"));
    }
    Ok(mesh)
}
