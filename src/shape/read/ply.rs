//! PLY, through `ply-rs-bw`: ascii, little- and big-endian; any properties
//! beside x, y, z and the faces' `vertex_indices` are passed over.

use super::{RawMesh, polygon, text};
use crate::error::{Error, Result};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};
use std::io::Read;

/// Reads PLY.
pub fn read(bytes: &[u8]) -> Result<RawMesh> {
    let bytes = text::without_bom(bytes);
    // Comments may hold any bytes, but the reader takes text only.
    let end = header_end(bytes)?;
    let head = String::from_utf8_lossy(&bytes[..end]).into_owned();
    let payload = &bytes[end..];
    let parser = Parser::<Element>::new();
    let mut reader = Reader::new(std::io::BufReader::new(head.as_bytes().chain(payload)));
    let header = parser.read_header(&mut reader).map_err(fault)?;
    check_counts(&header, payload.len())?;

    let mut mesh = RawMesh::default();
    for (name, element) in &header.elements {
        let found =
            parser.read_payload_for_element(&mut reader, element, &header).map_err(fault)?;
        match name.as_str() {
            "vertex" => mesh.vertices = found.iter().map(|e| e.point).collect(),
            "face" => faces(&found, &mut mesh)?,
            _ => {}
        }
    }
    Ok(mesh)
}

fn fault(e: ParseError) -> Error {
    // The message of the library has several lines, of which the first says enough.
    let text = e.to_string();
    let mut said: String = text.lines().next().unwrap_or_default().chars().take(200).collect();
    if let Some(why) = text.lines().rev().find_map(|l| l.trim().strip_prefix("Error: ")) {
        said = format!(
            "{} ({})",
            said.trim_end_matches('.'),
            why.chars().take(200).collect::<String>()
        );
    }
    Error::Format(format!("the PLY file is broken: {said}"))
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

fn faces(found: &[Element], mesh: &mut RawMesh) -> Result<()> {
    let n = mesh.vertices.len();
    let mut corners: Vec<u32> = Vec::new();
    for (i, e) in found.iter().enumerate() {
        corners.clear();
        for &c in &e.corners {
            if c < 0 || c >= n as i64 {
                return Err(Error::IndexOutOfRange(format!(
                    "PLY face {i} names vertex {c}, but there are only {n} vertices"
                )));
            }
            corners.push(c as u32);
        }
        polygon::triangulate(&corners, &mesh.vertices, &mut mesh.faces);
    }
    Ok(())
}

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
