//! The bits of a mark, for bytes that are handed on: lengths of runs, or the bits as they are
//! where those are fewer bytes.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Most words of a mark.
const MOST: u64 = 1 << 13;

pub fn serialize<S: Serializer>(words: &[u64], to: S) -> Result<S::Ok, S::Error> {
    let bit = |i: usize| words.get(i / 64).map(|w| w >> (i % 64) & 1);
    let (mut runs, mut at, mut last) = (Vec::new(), 0u32, 0);
    for i in 0..64 * words.len() {
        if bit(i) != Some(last) {
            runs.push(at);
            (at, last) = (0, 1 - last);
        }
        at += 1;
    }
    runs.push(at);
    let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
    let length = |n: &u32| 1 + (32 - (n | 1).leading_zeros() as usize - 1) / 7;
    let (runs, bytes) = match runs.iter().map(length).sum::<usize>() < bytes.len() {
        true => (runs, Vec::new()),
        false => (Vec::new(), bytes),
    };
    (words.len() as u64, runs, bytes).serialize(to)
}

pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<u64>, D::Error> {
    let (count, runs, bytes) = <(u64, Vec<u32>, Vec<u8>)>::deserialize(from)?;
    let total: u64 = runs.iter().map(|&n| u64::from(n)).sum();
    let fits = if runs.is_empty() { 8 * count == bytes.len() as u64 } else { 64 * count == total };
    if count > MOST || !fits || !(runs.is_empty() || bytes.is_empty()) {
        return Err(D::Error::custom(format!("a mark of {count} words is not whole")));
    }
    if runs.is_empty() {
        let word = |b: &[u8]| b.iter().rev().fold(0u64, |w, &b| w << 8 | u64::from(b));
        return Ok(bytes.chunks(8).map(word).collect());
    }
    let mut words = vec![0u64; count as usize];
    let mut at = 0usize;
    for (k, &n) in runs.iter().enumerate() {
        let end = at + n as usize;
        for i in (at..end).filter(|_| k % 2 == 1) {
            if let Some(word) = words.get_mut(i / 64) {
                *word |= 1 << (i % 64);
            }
        }
        at = end;
    }
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize, Deserialize, PartialEq, Debug)]
    struct Bits(#[serde(with = "super")] Vec<u64>);

    #[test]
    fn runs_and_noise_come_back() {
        let noise: Vec<u64> = (1..=64u64).map(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15)).collect();
        let runs = vec![0, 0, u64::MAX, 0xffff_0000, u64::MAX, 0, 1 << 63];
        for (words, most) in
            [(vec![], 4), (noise, 64 * 8 + 8), (runs, 30), (vec![u64::MAX; 4096], 12)]
        {
            let bytes = postcard::to_allocvec(&Bits(words.clone())).unwrap();
            assert!(bytes.len() <= most, "{} bytes", bytes.len());
            assert_eq!(postcard::from_bytes::<Bits>(&bytes).unwrap(), Bits(words));
        }
        for bad in
            [&(1u64, vec![63u32], vec![0u8; 0]), &(1 << 40, vec![], vec![1]), &(1, vec![], vec![])]
        {
            let bytes = postcard::to_allocvec(bad).unwrap();
            assert!(postcard::from_bytes::<Bits>(&bytes).is_err());
        }
    }
}
