//! Cells as bits, for bytes that are handed on: eight a byte, the first lowest.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

pub fn serialize<S: Serializer>(cells: &[u8], to: S) -> Result<S::Ok, S::Error> {
    let byte = |eight: &[u8]| (0u32..).zip(eight).fold(0u8, |b, (k, c)| b | (c & 1) << k);
    let bits: Vec<u8> = cells.chunks(8).map(byte).collect();
    (cells.len() as u64, bits).serialize(to)
}

pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<u8>, D::Error> {
    let (count, bits) = <(u64, Vec<u8>)>::deserialize(from)?;
    if count.div_ceil(8) != bits.len() as u64 {
        let found = bits.len();
        return Err(D::Error::custom(format!("{count} cells in {found} bytes")));
    }
    let mut cells: Vec<u8> = Vec::new();
    if cells.try_reserve_exact(8 * bits.len()).is_err() {
        return Err(D::Error::custom(format!("no memory for {count} cells")));
    }
    cells.extend(bits.iter().flat_map(|b| (0..8).map(move |k| b >> k & 1)));
    cells.truncate(count as usize);
    Ok(cells)
}
