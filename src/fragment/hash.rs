//! By what the same parent is known on another rank, or in another run.

use crate::error::{Error, Result};
use serde::Serialize;

/// FNV-1a of 128 bits (Fowler, Noll, Vo; RFC 9923).
struct Fnv(u128);

impl Extend<u8> for Fnv {
    fn extend<T: IntoIterator<Item = u8>>(&mut self, bytes: T) {
        const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
        for b in bytes {
            self.0 = (self.0 ^ u128::from(b)).wrapping_mul(PRIME);
        }
    }
}

/// The hash of the bytes of a value, which are not kept.
pub(super) fn hash(value: &impl Serialize) -> Result<u128> {
    const START: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    let made = postcard::to_extend(value, Fnv(START));
    made.map(|h| h.0).map_err(|e| Error::Internal(format!("no bytes could be made: {e}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_those_of_the_standard() {
        // "a" and "foobar" of its test vectors; a tuple of bytes has no length before it.
        assert_eq!(hash(&(b'a',)).unwrap(), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
        let foobar = (b'f', b'o', b'o', b'b', b'a', b'r');
        assert_eq!(hash(&foobar).unwrap(), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
    }
}
