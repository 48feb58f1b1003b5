//! NumPy's `.npy` format, versions 1 to 3
//! (numpy.org/doc/stable/reference/generated/numpy.lib.format.html).

use super::numbers::Numbers;
use super::{FileOptions, RawVoxels, Reading};
use crate::error::{Error, Result, filled};
use crate::shape::Layout;

/// The voxels of an npy file. An array of shape (a, b, c) is taken as (z, y, x),
/// or as (x, y, z) when `npy_xyz` says so.
pub(super) fn read(bytes: &[u8], options: &FileOptions, reading: &Reading) -> Result<RawVoxels> {
    let header = Header::parse(bytes)?;
    let [a, b, c] = <[usize; 3]>::try_from(header.shape.as_slice()).map_err(|_| {
        Error::Unsupported(format!("the npy array has {} axes, voxels need 3", header.shape.len()))
    })?;
    let dims = if options.npy_xyz { [a, b, c] } else { [c, b, a] };
    // In C order the last axis is the fastest, in Fortran order the first.
    let transposed = header.fortran != options.npy_xyz;

    let count = a.checked_mul(b).and_then(|n| n.checked_mul(c));
    let count = count.ok_or_else(|| {
        Error::TooLarge(format!("{a} x {b} x {c} voxels are more than can be counted"))
    })?;
    if count == 0 {
        // Before any loop over the axes: one of them may be huge.
        return Err(Error::Empty(format!("an array of {a} x {b} x {c} voxels holds none")));
    }
    let end = count as u128 * header.size as u128 + header.data as u128;
    if end != bytes.len() as u128 {
        return Err(Error::Format(format!(
            "the npy header says {a} x {b} x {c} values of {} bytes, up to byte {end}, but the \
             file ends at byte {}",
            header.size,
            bytes.len()
        )));
    }
    super::voxels::limit(
        count,
        if header.is_plain() { header.size } else { header.size + 4 },
        reading,
    )?;
    let data = bytes.get(header.data..).unwrap_or_default();
    let order = Order { dims, transposed };
    let numbers = match (header.kind, header.size) {
        (b'b' | b'u', 1) => Numbers::U8(order.gather(data, header.big, |[b]| b)?),
        (b'i', 1) => Numbers::I8(order.gather(data, header.big, i8::from_le_bytes)?),
        (b'u', 2) => Numbers::U16(order.gather(data, header.big, u16::from_le_bytes)?),
        (b'i', 2) => Numbers::I16(order.gather(data, header.big, i16::from_le_bytes)?),
        (b'u', 4) => Numbers::U32(order.gather(data, header.big, u32::from_le_bytes)?),
        (b'i', 4) => Numbers::I32(order.gather(data, header.big, i32::from_le_bytes)?),
        (b'u', 8) => Numbers::U64(order.gather(data, header.big, u64::from_le_bytes)?),
        (b'i', 8) => Numbers::I64(order.gather(data, header.big, i64::from_le_bytes)?),
        (b'f', 4) => Numbers::F32(order.gather(data, header.big, f32::from_le_bytes)?),
        (b'f', 8) => Numbers::F64(order.gather(data, header.big, f64::from_le_bytes)?),
        _ => return Err(Error::Internal("an npy type was not refused".into())),
    };
    let mut notes = Vec::new();
    let values = numbers.plain(&mut notes)?;
    let layout = Layout { dims, spacing: options.spacing, origin: options.origin };
    Ok(RawVoxels { layout, values, notes })
}

/// How the values of the file become x fastest.
struct Order {
    dims: [usize; 3],
    transposed: bool,
}

impl Order {
    fn gather<const N: usize, T: Copy + Default>(
        &self,
        data: &[u8],
        big: bool,
        number: impl Fn([u8; N]) -> T,
    ) -> Result<Vec<T>> {
        let (raw, _) = data.as_chunks::<N>();
        let number = |mut c: [u8; N]| {
            if big {
                c.reverse();
            }
            number(c)
        };
        let mut out = filled("voxel values", raw.len(), T::default())?;
        if !self.transposed {
            for (v, &c) in out.iter_mut().zip(raw) {
                *v = number(c);
            }
            return Ok(out);
        }
        // Tiles keep both sides in the cache.
        const TILE: usize = 64;
        let [nx, ny, nz] = self.dims;
        for j in 0..ny {
            for k0 in (0..nz).step_by(TILE) {
                for i0 in (0..nx).step_by(TILE) {
                    for k in k0..nz.min(k0 + TILE) {
                        for i in i0..nx.min(i0 + TILE) {
                            out[i + nx * (j + ny * k)] = number(raw[k + nz * (j + ny * i)]);
                        }
                    }
                }
            }
        }
        Ok(out)
    }
}

#[derive(Debug, PartialEq)]
struct Header {
    /// b, i, u or f.
    kind: u8,
    /// Bytes of one value.
    size: usize,
    big: bool,
    fortran: bool,
    shape: Vec<usize>,
    /// Where the values begin.
    data: usize,
}

impl Header {
    fn is_plain(&self) -> bool {
        matches!((self.kind, self.size), (b'b' | b'u', 1 | 2 | 4) | (b'f', 4))
    }

    fn parse(bytes: &[u8]) -> Result<Header> {
        if !bytes.starts_with(b"\x93NUMPY") {
            return Err(Error::Format("byte 0 does not begin an npy file".into()));
        }
        let short = |at: usize| {
            Error::Format(format!("the npy header is cut off: the file ends at byte {at}"))
        };
        let version = *bytes.get(6).ok_or_else(|| short(bytes.len()))?;
        let (start, length) = match version {
            1 => {
                let n = bytes.get(8..10).ok_or_else(|| short(bytes.len()))?;
                (10, usize::from(u16::from_le_bytes([n[0], n[1]])))
            }
            2 | 3 => {
                let n = bytes.get(8..12).ok_or_else(|| short(bytes.len()))?;
                (12, u32::from_le_bytes([n[0], n[1], n[2], n[3]]) as usize)
            }
            v => {
                return Err(Error::Format(format!("byte 6 names npy version {v}, not 1, 2 or 3")));
            }
        };
        let data = start + length;
        let text = bytes.get(start..data).ok_or_else(|| {
            Error::Format(format!(
                "the npy header says that it ends at byte {data}, but the file ends at byte {}",
                bytes.len()
            ))
        })?;
        Literal { text, at: 0, start }.header(data)
    }
}

/// Reads the Python literal in the header.
struct Literal<'a> {
    text: &'a [u8],
    at: usize,
    /// Where the text begins in the file.
    start: usize,
}

impl Literal<'_> {
    fn wrong<T>(&self, expected: &str) -> Result<T> {
        Err(Error::Format(format!(
            "byte {} of the npy header is not {expected}",
            self.start + self.at
        )))
    }

    fn peek(&mut self) -> Option<u8> {
        while self.text.get(self.at).is_some_and(|b| b.is_ascii_whitespace()) {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }

    fn expect(&mut self, byte: u8) -> Result<()> {
        if self.peek() != Some(byte) {
            return self.wrong(&format!("{:?}", byte as char));
        }
        self.at += 1;
        Ok(())
    }

    fn string(&mut self) -> Result<String> {
        let quote = match self.peek() {
            Some(q @ (b'\'' | b'"')) => q,
            _ => return self.wrong("a string"),
        };
        let rest = &self.text[self.at + 1..];
        let Some(n) = rest.iter().position(|&b| b == quote) else {
            return self.wrong("a string that ends");
        };
        let s = String::from_utf8_lossy(&rest[..n]).into_owned();
        self.at += n + 2;
        Ok(s)
    }

    fn boolean(&mut self) -> Result<bool> {
        self.peek();
        for (word, value) in [("True", true), ("False", false)] {
            if self.text[self.at..].starts_with(word.as_bytes()) {
                self.at += word.len();
                return Ok(value);
            }
        }
        self.wrong("True or False")
    }

    fn tuple(&mut self) -> Result<Vec<usize>> {
        self.expect(b'(')?;
        let mut all = Vec::new();
        while self.peek() != Some(b')') {
            let digits = self.text[self.at..].iter().take_while(|b| b.is_ascii_digit()).count();
            if digits == 0 {
                return self.wrong("a number");
            }
            let number = self.text[self.at..self.at + digits].iter().try_fold(0usize, |n, &d| {
                n.checked_mul(10).and_then(|n| n.checked_add(usize::from(d - b'0')))
            });
            let Some(number) = number else {
                return self.wrong("a number that can be counted");
            };
            // NumPy has 64 axes at most.
            if all.len() == 64 {
                return self.wrong("one of 64 axes at most");
            }
            all.push(number);
            self.at += digits;
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(b')') => {}
                _ => return self.wrong("',' or ')'"),
            }
        }
        self.at += 1;
        Ok(all)
    }

    fn header(&mut self, data: usize) -> Result<Header> {
        let (mut kind, mut fortran, mut shape) = (None, None, None);
        self.expect(b'{')?;
        while self.peek() != Some(b'}') {
            let at = self.at;
            let key = self.string()?;
            self.expect(b':')?;
            let again = match key.as_str() {
                "descr" => kind.replace(self.descr()?).is_some(),
                "fortran_order" => fortran.replace(self.boolean()?).is_some(),
                "shape" => shape.replace(self.tuple()?).is_some(),
                _ => true,
            };
            if again {
                self.at = at;
                return self.wrong("one of descr, fortran_order and shape, each once");
            }
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(b'}') => {}
                _ => return self.wrong("',' or '}'"),
            }
        }
        self.at += 1;
        if self.peek().is_some() {
            return self.wrong("the end of the header");
        }
        let (Some((kind, size, big)), Some(fortran), Some(shape)) = (kind, fortran, shape) else {
            return Err(Error::Format(
                "the npy header lacks one of descr, fortran_order and shape".into(),
            ));
        };
        Ok(Header { kind, size, big, fortran, shape, data })
    }

    /// Kind, bytes and whether the byte order is big-endian.
    fn descr(&mut self) -> Result<(u8, usize, bool)> {
        if self.peek() == Some(b'[') {
            return Err(Error::Unsupported(
                "the npy array has a structured type; voxels are plain numbers".into(),
            ));
        }
        let text = self.string()?;
        let bytes = text.as_bytes();
        let (order, rest) = match bytes.first() {
            Some(o @ (b'<' | b'>' | b'|' | b'=')) => (*o, &bytes[1..]),
            _ => (b'<', bytes),
        };
        let known = match rest {
            b"b1" | b"?" => Some((b'b', 1)),
            [k @ (b'i' | b'u'), n @ (b'1' | b'2' | b'4' | b'8')] => {
                Some((*k, usize::from(n - b'0')))
            }
            [b'f', n @ (b'4' | b'8')] => Some((b'f', usize::from(n - b'0'))),
            _ => None,
        };
        let Some((kind, size)) = known else {
            return Err(Error::Unsupported(format!(
                "the npy array has the type {text:?}; voxels are b1, u1, i1, u2, i2, u4, i4, u8, \
                 i8, f4 or f8"
            )));
        };
        Ok((kind, size, order == b'>'))
    }
}
