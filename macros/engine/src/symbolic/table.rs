//! Tables of what is interned: looked up at every operation, so that hashing decides how long an
//! expansion takes.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A hash table whose keys nobody chooses to collide. Its order must not matter to anyone, as for
/// any hash table.
pub(crate) type Table<K, V> = HashMap<K, V, BuildHasherDefault<Multiplier>>;

/// Hashes word by word: by a sum and a multiplication with an odd number without a pattern.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Multiplier(u64);

impl Multiplier {
    const fn add(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0xf135_7aea_2e62_a9c5);
    }
}

impl Hasher for Multiplier {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.add(u64::from_le_bytes(word));
        }
    }

    fn write_u8(&mut self, word: u8) {
        self.add(u64::from(word));
    }

    fn write_u32(&mut self, word: u32) {
        self.add(u64::from(word));
    }

    fn write_u64(&mut self, word: u64) {
        self.add(word);
    }

    fn write_usize(&mut self, word: usize) {
        self.add(word as u64);
    }

    fn write_isize(&mut self, word: isize) {
        self.add(word.cast_unsigned() as u64);
    }

    fn finish(&self) -> u64 {
        // The high bits depend on all others: the table looks at low ones first.
        self.0.rotate_left(26)
    }
}
