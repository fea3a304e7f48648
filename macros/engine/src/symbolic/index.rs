//! Where each node of an arena stands, by its key. Every operation is looked up here, by a macro
//! that is compiled without optimisation in the crates of users: loops over places, and nothing
//! generic.

/// A node in two words.
#[derive(Clone, Copy, Debug)]
pub(super) struct Key {
    kind: u64,
    value: u64,
}

impl Key {
    #[inline(always)]
    pub(super) const fn new(kind: u64, value: u64) -> Self {
        Self { kind, value }
    }

    #[inline(always)]
    const fn is(self, other: Self) -> bool {
        self.kind == other.kind && self.value == other.value
    }

    #[inline(always)]
    const fn hash(self) -> usize {
        let mixed = (self.value ^ self.kind.rotate_left(59)).wrapping_mul(0xf135_7aea_2e62_a9c5);
        (mixed ^ mixed >> 32) as usize
    }
}

/// Keys by number, in the order in which they were added, and the way back by linear probing.
///
/// Only the last keys can be removed. What was added before them does not stand behind them in a
/// sequence of probes, so that a place can be cleared.
#[derive(Clone, Debug)]
pub(super) struct Index {
    keys: Vec<Key>,
    /// Numbers of keys, [`EMPTY`] elsewhere. As long as a power of two, and at most half full.
    places: Vec<u32>,
}

const EMPTY: u32 = u32::MAX;

impl Default for Index {
    fn default() -> Self {
        Self {
            keys: Vec::new(),
            places: vec![EMPTY; 16],
        }
    }
}

impl Index {
    /// The number of a key.
    pub(super) fn find(&self, key: Key) -> Option<u32> {
        let found = self.places[self.probe(key)];
        if found == EMPTY { None } else { Some(found) }
    }

    /// Adds a key that is not there.
    pub(super) fn push(&mut self, key: Key) {
        if 2 * (self.keys.len() + 1) > self.places.len() {
            self.places = vec![EMPTY; 2 * self.places.len()];
            for number in 0..self.keys.len() {
                self.enter(number);
            }
        }
        self.keys.push(key);
        self.enter(self.keys.len() - 1);
    }

    /// Removes all keys but the first.
    pub(super) fn truncate(&mut self, len: usize) {
        while self.keys.len() > len {
            let last = self.keys[self.keys.len() - 1];
            let place = self.probe(last);
            self.places[place] = EMPTY;
            self.keys.pop();
        }
    }

    fn enter(&mut self, number: usize) {
        let place = self.probe(self.keys[number]);
        self.places[place] = number as u32;
    }

    /// The place of a key, or the empty one where it would stand.
    fn probe(&self, key: Key) -> usize {
        let (places, keys) = (self.places.as_slice(), self.keys.as_slice());
        let mask = places.len() - 1;
        let mut place = key.hash() & mask;
        loop {
            let number = places[place];
            if number == EMPTY || keys[number as usize].is(key) {
                return place;
            }
            place = (place + 1) & mask;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Index, Key};

    fn keys() -> impl Iterator<Item = Key> {
        (0..1000_u64).map(|bits| Key::new(0, (bits * bits) << 20))
    }

    #[test]
    fn what_was_added_is_found_until_it_is_removed() {
        let mut index = Index::default();
        for (number, key) in keys().enumerate() {
            assert_eq!(index.find(key), None);
            index.push(key);
            assert_eq!(index.find(key), Some(number as u32));
        }
        for kept in [999, 500, 17, 0] {
            index.truncate(kept);
            for (number, key) in keys().enumerate() {
                let known = (number < kept).then_some(number as u32);
                assert_eq!(index.find(key), known);
            }
        }
    }
}
