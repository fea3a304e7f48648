//! Calls by tables: what a kernel does for many joints or bodies in the same way is one function,
//! and where its arguments are stands in a table.

use crate::math::scalar::Scalar;
use crate::mechanism::readout::AngleParts;

/// Where the arguments of calls are.
///
/// A code says in its upper four bits among what: 0 the results of earlier calls, 1 to 4 what is
/// given, 5 the numbers. The next bit turns the sign; the others are the place.
#[derive(Clone, Copy, Debug)]
pub struct Sources<'a, S> {
    /// The arrays that are given.
    pub given: [&'a [S]; 4],
    /// The numbers.
    pub literals: &'static [f64],
}

const SOURCE: u32 = 28;
const TURNED: u32 = 1 << 27;

impl<S: Scalar> Sources<'_, S> {
    #[inline]
    fn value(&self, values: &[S], code: u32) -> S {
        let place = (code & (TURNED - 1)) as usize;
        let value = match (code >> SOURCE).checked_sub(1) {
            None => values.get(place).copied(),
            Some(source) => match self.given.get(source as usize) {
                Some(given) => given.get(place).copied(),
                None => self.literals.get(place).map(|&value| S::constant(value)),
            },
        };
        let value = value.unwrap_or(S::zero());
        if code & TURNED == 0 { value } else { -value }
    }

    /// What codes stand for.
    #[inline]
    #[must_use]
    pub fn gathered<const N: usize>(&self, values: &[S], codes: &[u32]) -> [S; N] {
        let mut gathered = [S::zero(); N];
        for (element, &code) in gathered.iter_mut().zip(codes) {
            *element = self.value(values, code);
        }
        gathered
    }

    /// Calls a function, writes its results behind those of earlier calls, and returns how many
    /// there are now.
    pub fn call<const N: usize, const R: usize>(
        &self,
        (values, next): (&mut [S], usize),
        codes: &[u32],
        function: fn(&[S; N]) -> [S; R],
    ) -> usize {
        let results = function(&self.gathered(values, codes));
        let places = values.iter_mut().skip(next);
        places
            .zip(results)
            .for_each(|(place, result)| *place = result);
        next + R
    }
}

/// Cosine, sine, rate, and the count of turns where there are four outputs; of a joint without an
/// angle none.
#[must_use]
pub fn angle_of<S: Scalar, const N: usize>(outputs: Option<([S; N], usize)>) -> AngleParts<S> {
    let Some((outputs, count)) = outputs else {
        return AngleParts {
            cosine: S::one(),
            sine: S::zero(),
            rate: S::zero(),
            turns: None,
        };
    };
    let [cosine, sine, rate, turns] =
        [0, 1, 2, 3].map(|k| outputs.get(k).copied().unwrap_or(S::zero()));
    AngleParts {
        cosine,
        sine,
        rate,
        turns: (count > 3).then_some(turns),
    }
}

/// The least of what a joint says of its side; 1 where it says nothing.
#[must_use]
pub fn least<S: Scalar, const N: usize>(outputs: Option<([S; N], usize)>) -> S {
    let Some((outputs, count)) = outputs else {
        return S::one();
    };
    let outputs = outputs.into_iter().take(count);
    outputs.reduce(S::min).unwrap_or(S::one())
}
