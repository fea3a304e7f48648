//! What an integration keeps from step to step, as numbers: written, and read again.

use crate::math::scalar::Real;
use crate::math::without_bounds::opaque;
use crate::state::vector::Vector;

/// Where numbers go, or come from: each is handed over in its place.
pub(crate) trait Tape<S> {
    /// Takes the number, or replaces it.
    fn number(&mut self, number: &mut S);

    /// Takes the count, or replaces it.
    fn count(&mut self, count: &mut usize);

    /// Refuses what is read.
    fn refuse(&mut self) {}
}

/// What an integration keeps from step to step, on its way into a checkpoint or out of one: see
/// [`Integration::remember`](super::Integration::remember).
///
/// One function names everything that is kept, in one order. The same calls write it and read it.
pub struct Memory<'m, S> {
    tape: &'m mut dyn Tape<S>,
}

impl<'m, S> Memory<'m, S> {
    pub(crate) fn new(tape: &'m mut dyn Tape<S>) -> Self {
        Self { tape }
    }
}

opaque!([S] Memory<'_, S>, "Memory");

impl<S: Real> Memory<'_, S> {
    /// A number, which must be finite.
    pub fn number(&mut self, number: &mut S) {
        self.tape.number(number);
    }

    /// A count, or the place of a variant.
    pub fn count(&mut self, count: &mut usize) {
        self.tape.count(count);
    }

    /// The place of a variant among so many.
    pub(crate) fn variant(&mut self, place: &mut usize, of: usize) {
        self.count(place);
        if *place >= of {
            self.tape.refuse();
        }
    }

    /// A flag.
    pub fn flag(&mut self, flag: &mut bool) {
        let mut count = usize::from(*flag);
        self.count(&mut count);
        *flag = count != 0;
    }

    /// A number that may be unknown.
    pub fn optional(&mut self, number: &mut Option<S>) {
        let mut is_known = number.is_some();
        self.flag(&mut is_known);
        let mut value = number.unwrap_or(S::zero());
        self.number(&mut value);
        *number = is_known.then_some(value);
    }

    /// A number that must be as it was.
    pub(crate) fn same(&mut self, number: S) {
        let mut read = number;
        self.number(&mut read);
        if read != number {
            self.tape.refuse();
        }
    }

    /// A name that must be as it was.
    pub(crate) fn label(&mut self, name: &str) {
        // That of Fowler, Noll and Vo, in 31 bits: a count wherever the file is read.
        let hash = name.bytes().fold(0x811c_9dc5_u32, |hash, byte| {
            (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
        });
        let hash = (hash >> 1) as usize;
        let mut read = hash;
        self.count(&mut read);
        if read != hash {
            self.tape.refuse();
        }
    }

    /// A state or a slope, element by element, with what it has counted.
    pub fn vector<X: Vector<S>>(&mut self, vector: &mut X) {
        *vector = vector.zip(vector, |mut element, _| {
            self.number(&mut element);
            element
        });
        for counted in vector.turns_mut() {
            self.number(counted);
        }
    }
}

/// Reads what was written.
pub(crate) struct Reader<'r, S> {
    numbers: core::slice::Iter<'r, S>,
    counts: core::slice::Iter<'r, usize>,
    /// Whether more was asked for than there is, or something else.
    lacks: bool,
}

impl<'r, S> Reader<'r, S> {
    pub(crate) fn new(numbers: &'r [S], counts: &'r [usize]) -> Self {
        Self {
            numbers: numbers.iter(),
            counts: counts.iter(),
            lacks: false,
        }
    }

    /// Whether all was read, and no more was asked for.
    pub(crate) fn is_done(&self) -> bool {
        !self.lacks && self.numbers.as_slice().is_empty() && self.counts.as_slice().is_empty()
    }
}

impl<S: Real> Tape<S> for Reader<'_, S> {
    fn number(&mut self, number: &mut S) {
        match self.numbers.next() {
            Some(&read) => *number = read,
            None => self.lacks = true,
        }
    }

    fn count(&mut self, count: &mut usize) {
        match self.counts.next() {
            Some(&read) => *count = read,
            None => self.lacks = true,
        }
    }

    fn refuse(&mut self) {
        self.lacks = true;
    }
}
