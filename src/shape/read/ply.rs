//! PLY, through `ply-rs-bw`: ascii, little- and big-endian; any properties
//! beside x, y, z and the faces' `vertex_indices` are passed over. Elements may come in
//! any order. It is handed one element at a time, so that memory and cancel are ours.

use super::{RawMesh, Reading, polygon, text};
use crate::error::{Error, Result, push};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};

/// Reads PLY.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<RawMesh> {
    let bytes = text::without_bom(bytes);
    // Comments may hold any bytes, but the reader takes text only.
    let end = header_end(bytes)?;
    let head = String::from_utf8_lossy(&bytes[..end]).into_owned();
    let payload = &bytes[end..];
    let parser = Parser::<Element>::new();
    let header = parser.read_header(&mut Reader::new(head.as_bytes())).map_err(fault)?;
    check_counts(&header, payload.len())?;

    let count = |name| header.elements.get(name).map_or(0, |e| e.count);
    let mut mesh = reading.mesh(count("vertex"), count("face"))?;
    let vertices = count("vertex");
    // Faces that come before the vertices wait: their corners, and how many each has.
    let mut early: (Vec<u32>, Vec<u32>) = Default::default();
    let mut corners: Vec<u32> = Vec::new();
    let before = head.bytes().filter(|&b| b == b'\n').count();
    let mut source = Payload { parser, encoding: header.encoding, rest: payload, line: before };
    for (name, element) in &header.elements {
        for i in 0..element.count {
            reading.tick(i, &mesh)?;
            let found = source.next(element, i)?;
            match name.as_str() {
                "vertex" => push("vertices", &mut mesh.vertices, found.point)?,
                "face" => {
                    corners.clear();
                    for &c in &found.corners {
                        if c < 0 || c >= vertices as i64 {
                            return Err(Error::IndexOutOfRange(format!(
                                "PLY face {i} names vertex {c}, but there are only {vertices} \
                                 vertices"
                            )));
                        }
                        push("corners", &mut corners, c as u32)?;
                    }
                    if mesh.vertices.len() == vertices {
                        polygon::triangulate(&corners, &mesh.vertices, &mut mesh.faces)?;
                    } else {
                        for &c in &corners {
                            push("corners", &mut early.0, c)?;
                        }
                        push("faces", &mut early.1, corners.len() as u32)?;
                        let bytes = 4 * (early.0.capacity() + early.1.capacity()) as u64;
                        reading.tick_with(i, bytes + mesh.bytes(), "the faces of the PLY file")?;
                    }
                }
                _ => {}
            }
        }
    }
    let mut rest = early.0.as_slice();
    for (i, &n) in early.1.iter().enumerate() {
        reading.tick(i, &mesh)?;
        let Some((face, tail)) = rest.split_at_checked(n as usize) else { break };
        polygon::triangulate(face, &mesh.vertices, &mut mesh.faces)?;
        rest = tail;
    }
    Ok(mesh)
}

/// The bytes after the header.
struct Payload<'a> {
    parser: Parser<Element>,
    encoding: Encoding,
    rest: &'a [u8],
    /// Lines that were taken, of an ascii file.
    line: usize,
}

impl Payload<'_> {
    /// Element number `i` of its kind. Blank lines are passed over.
    fn next(&mut self, of: &ElementDef, i: usize) -> Result<Element> {
        let broken = |at: String, e: ParseError| {
            let why = first_line(&e);
            Error::Format(format!(
                "the PLY file is broken: {at}element {i} of {} {}: {why}",
                of.count, of.name
            ))
        };
        match self.encoding {
            Encoding::Ascii => loop {
                if self.rest.is_empty() {
                    return Err(Error::Format(format!(
                        "the PLY file is broken: Line {}: end of file before element {i} of {} {}",
                        self.line, of.count, of.name
                    )));
                }
                let end = self.rest.iter().position(|&b| b == b'\n').unwrap_or(self.rest.len());
                let line = self.rest[..end].trim_ascii();
                self.rest = self.rest.get(end + 1..).unwrap_or_default();
                self.line += 1;
                if !line.is_empty() {
                    let line = String::from_utf8_lossy(line);
                    let found = self.parser.read_ascii_element(&line, of);
                    return found.map_err(|e| broken(format!("Line {}: ", self.line), e));
                }
            },
            Encoding::BinaryBigEndian => self.parser.read_big_endian_element(&mut self.rest, of),
            Encoding::BinaryLittleEndian => {
                self.parser.read_little_endian_element(&mut self.rest, of)
            }
        }
        .map_err(|e| match self.rest.is_empty() {
            true => Error::Format(format!(
                "the PLY file is broken: end of file in element {i} of {} {}",
                of.count, of.name
            )),
            false => broken(String::new(), e),
        })
    }
}

/// The first line of a message of the library says enough, but for the reason at its end.
fn first_line(e: &ParseError) -> String {
    let text = e.to_string();
    let said: String = text.lines().next().unwrap_or_default().chars().take(200).collect();
    match text.lines().rev().find_map(|l| l.trim().strip_prefix("Error: ")) {
        Some(why) => {
            let why: String = why.chars().take(200).collect();
            format!("{} ({why})", said.trim_end_matches('.'))
        }
        None => said,
    }
}

fn fault(e: ParseError) -> Error {
    Error::Format(format!("the PLY file is broken: {}", first_line(&e)))
}

/// Where the payload begins.
fn header_end(bytes: &[u8]) -> Result<usize> {
    let mut at = 0;
    for line in bytes.split_inclusive(|&b| b == b'\n') {
        at += line.len();
        if line.trim_ascii() == b"end_header" {
            return Ok(at);
        }
    }
    Err(Error::Format(format!("the PLY file has no end_header line in its {} bytes", bytes.len())))
}

/// Compares what the header declares with the bytes that follow it.
fn check_counts(header: &Header, payload: usize) -> Result<()> {
    let mut least: u64 = 0;
    for (name, e) in &header.elements {
        if e.count > 0 && e.properties.is_empty() {
            return Err(Error::Format(format!(
                "the PLY header declares {} elements {name} without properties",
                e.count
            )));
        }
        let each: u64 = match header.encoding {
            // A character and a space or line end for each number.
            Encoding::Ascii => 2 * e.properties.len() as u64,
            _ => e.properties.iter().map(|(_, p)| bytes_of(&p.data_type)).sum(),
        };
        least = least.saturating_add(each.saturating_mul(e.count as u64));
        // The last line may lack its end.
        if least > payload as u64 + 1 {
            return Err(Error::Format(format!(
                "the PLY header declares {} elements {name}, which need at least {least} bytes, \
                 but only {payload} follow the header",
                e.count
            )));
        }
    }
    check_properties(header)
}

/// The least bytes of a property: an empty list for a list.
fn bytes_of(p: &PropertyType) -> u64 {
    let (PropertyType::Scalar(s) | PropertyType::List(s, _)) = p;
    match s {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

fn check_properties(header: &Header) -> Result<()> {
    let has = |e: &ElementDef, names: &[&str], list: bool| {
        e.properties.iter().any(|(k, p)| {
            names.contains(&k.as_str()) && matches!(p.data_type, PropertyType::List(..)) == list
        })
    };
    let Some(vertex) = header.elements.get("vertex") else {
        return Err(Error::Format("the PLY header has no element vertex".into()));
    };
    for axis in ["x", "y", "z"] {
        if !has(vertex, &[axis], false) {
            return Err(Error::Format(format!("the PLY element vertex has no property {axis}")));
        }
    }
    match header.elements.get("face") {
        Some(face) if face.count > 0 && !has(face, &INDICES, true) => {
            Err(Error::Format("the PLY element face has no list property vertex_indices".into()))
        }
        Some(_) => Ok(()),
        None => Err(Error::Empty(format!(
            "the PLY file has {} vertices but no faces: points alone have no inside",
            vertex.count
        ))),
    }
}

const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// A vertex or a face.
#[derive(Debug, Default)]
struct Element {
    point: [f64; 3],
    corners: Vec<i64>,
}

impl PropertyAccess for Element {
    fn new() -> Self {
        Element::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        use Property as P;
        let axis = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            _ if INDICES.contains(&name) => {
                self.corners = match property {
                    P::ListChar(v) => v.into_iter().map(i64::from).collect(),
                    P::ListUChar(v) => v.into_iter().map(i64::from).collect(),
                    P::ListShort(v) => v.into_iter().map(i64::from).collect(),
                    P::ListUShort(v) => v.into_iter().map(i64::from).collect(),
                    P::ListInt(v) => v.into_iter().map(i64::from).collect(),
                    P::ListUInt(v) => v.into_iter().map(i64::from).collect(),
                    _ => return PropertyAccessResult::UnsupportedType,
                };
                return PropertyAccessResult::Set;
            }
            _ => return PropertyAccessResult::Ignored,
        };
        self.point[axis] = match property {
            P::Char(v) => v.into(),
            P::UChar(v) => v.into(),
            P::Short(v) => v.into(),
            P::UShort(v) => v.into(),
            P::Int(v) => v.into(),
            P::UInt(v) => v.into(),
            P::Float(v) => v.into(),
            P::Double(v) => v,
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}
