//! Efforts that hold, where others are multiples of them: the friction of what slides on a contact.
//!
//! With `x = T h`, a row for each effort that holds and none for those that follow them, `W T` is
//! square over what holds. It is symmetric without followers alone.

use crate::math::scalar::Real;

/// Rounds of refinement at the most: they take out the floor on the diagonal.
const ROUNDS: usize = 16;

/// Residuals of so many `EPSILON` of their terms are zero.
const ENOUGH: f64 = 4.0;

/// A round that leaves more than this part of the residuals gains nothing. What is left then is
/// round-off of the offsets up to so many `EPSILON` of their terms: to refine it further would
/// change shares alone.
const STALLED: f64 = 0.5;
const INCONSISTENT: f64 = 1e3;

/// The largest floor of what yields most: refinement then gains two digits a round.
const YIELDING: f64 = 1e-2;

/// Friction bears little of what normal efforts can bear: so many times what it can bear itself, or
/// its normal effort where that is less.
const LEAVES: f64 = 0.01;

/// Floors on the diagonal of unit scale. How what depends on each other shares is known to
/// `EPSILON` over the floor; refinement gains as many digits a round as the floor has, less those
/// of the condition. The second one is for what the first does not end for.
pub(super) fn floors<S: Real>() -> [S; 2] {
    [S::EPSILON.powf(1.0 / 3.0), S::EPSILON.sqrt()]
}

/// How much more freely one of several that depend on each other yields, at the most.
fn most_freely<S: Real>() -> S {
    let [_, least] = floors::<S>();
    S::constant(YIELDING).quotient(least)
}

/// What holds, and what follows it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tied<S, const K: usize> {
    pub(super) holds: [bool; K],
    /// The effort that it is a multiple of, and the factor.
    pub(super) follows: [Option<(usize, S)>; K],
    /// What those that follow have beside that.
    pub(super) beside: [S; K],
}

impl<S: Real, const K: usize> Tied<S, K> {
    /// Nothing.
    pub(super) fn nothing() -> Self {
        Self {
            holds: [false; K],
            follows: [None; K],
            beside: [S::zero(); K],
        }
    }

    /// Sets all efforts that follow others.
    pub(super) fn follow(&self, efforts: &mut [S; K]) {
        for (index, follows) in self.follows.iter().enumerate() {
            if let Some((of, factor)) = *follows {
                efforts[index] = factor.fused(at(efforts, of), self.beside[index]);
            }
        }
    }

    /// The factors of what holds. Of efforts that depend on each other each gets a share in
    /// proportion to its weight.
    pub(super) fn factors(&self, matrix: &[[S; K]; K], weights: &[S; K], floor: S) -> Lu<S, K> {
        let largest = weights.iter().fold(
            S::zero(),
            |most, &weight| {
                if weight > most { weight } else { most }
            },
        );
        let mut scales = [S::zero(); K];
        for index in 0..K {
            let diagonal = matrix[index][index];
            if self.holds[index] && diagonal > S::zero() {
                scales[index] = diagonal.sqrt().reciprocal();
            }
        }
        let mut square = *matrix;
        for (index, follows) in self.follows.iter().enumerate() {
            if let Some((of, factor)) = *follows {
                for (row, from) in square.iter_mut().zip(matrix) {
                    if let Some(element) = row.get_mut(of) {
                        *element = factor.fused(from[index], *element);
                    }
                }
            }
        }
        for (i, row) in square.iter_mut().enumerate() {
            for (element, &scale) in row.iter_mut().zip(&scales) {
                *element = *element * scales[i] * scale;
            }
            let yields = largest.quotient(weights[i].max(S::smallest()));
            let yields = yields.min(most_freely());
            row[i] = row[i] + floor * yields.max(S::one());
        }
        Lu::of(&square, scales)
    }

    /// The determinant of the equations of what holds, where something follows; zero elsewhere. It
    /// passes through zero where these efforts pass through infinity.
    pub(super) fn determinant(&self, matrix: &[[S; K]; K]) -> S {
        if self.follows.iter().all(Option::is_none) {
            return S::zero();
        }
        let [_, floor] = floors();
        self.factors(matrix, &[S::one(); K], floor).determinant()
    }

    /// The efforts that make the residuals of all that holds zero. Friction that sticks, of which
    /// the contact and the coefficient are known, has a share in proportion to what that can bear.
    pub(super) fn shared(
        &self,
        matrix: &[[S; K]; K],
        offset: &[S; K],
        sticking: &[Option<(usize, S)>; K],
    ) -> [S; K] {
        self.shared_beside(matrix, (offset, &[S::zero(); K]), sticking)
    }

    /// The same beside efforts that are given.
    pub(super) fn shared_beside(
        &self,
        matrix: &[[S; K]; K],
        (offset, given): (&[S; K], &[S; K]),
        sticking: &[Option<(usize, S)>; K],
    ) -> [S; K] {
        let mut weights = [S::one(); K];
        let efforts = self.weighted(matrix, (offset, given), &weights);
        let mut contacts = sticking.iter().flatten().map(|(contact, _)| *contact);
        let first = contacts.next();
        if contacts.all(|contact| Some(contact) == first) {
            return efforts;
        }
        let mut normal = S::zero();
        for (contact, _) in sticking.iter().flatten() {
            normal = normal.max(at(&efforts, *contact).abs());
        }
        if normal <= S::zero() {
            return efforts;
        }
        for (weight, one) in weights.iter_mut().zip(sticking) {
            if let Some((contact, coefficient)) = *one {
                let bears = at(&efforts, contact).abs().quotient(normal);
                *weight = S::constant(LEAVES) * coefficient.min(S::one()) * bears;
            }
        }
        self.weighted(matrix, (offset, given), &weights)
    }

    fn weighted(
        &self,
        matrix: &[[S; K]; K],
        (offset, given): (&[S; K], &[S; K]),
        weights: &[S; K],
    ) -> [S; K] {
        let mut efforts = *given;
        let least = weights
            .iter()
            .fold(S::one(), |least, &weight| least.min(weight));
        let freely = least.max(S::smallest()).reciprocal().min(most_freely());
        for floor in floors::<S>() {
            let floor = floor.min(S::constant(YIELDING).quotient(freely));
            efforts = *given;
            let factors = self.factors(matrix, weights, floor);
            if self.complete((matrix, &factors), offset, &mut efforts) {
                break;
            }
        }
        efforts
    }

    /// Adds to efforts what makes the residuals `W x + a` of all that holds zero; whether it has.
    pub(super) fn complete(
        &self,
        (matrix, factors): (&[[S; K]; K], &Lu<S, K>),
        offset: &[S; K],
        efforts: &mut [S; K],
    ) -> bool {
        self.follow(efforts);
        let mut before = S::constant(f64::INFINITY);
        for _ in 0..ROUNDS {
            let mut left = [S::zero(); K];
            let mut worst = S::zero();
            for index in 0..K {
                if factors.scales[index] > S::zero() {
                    let (mut sum, mut size) = (offset[index], offset[index].abs());
                    for (&w, &x) in matrix[index].iter().zip(&*efforts) {
                        (sum, size) = (w.fused(x, sum), w.abs().fused(x.abs(), size));
                    }
                    left[index] = sum;
                    worst = worst.max(sum.abs().quotient(size.max(S::smallest())));
                }
            }
            if worst <= S::constant(ENOUGH) * S::EPSILON {
                return true;
            }
            if worst > S::constant(STALLED) * before {
                return worst <= S::constant(INCONSISTENT) * S::EPSILON;
            }
            before = worst;
            for (effort, change) in efforts.iter_mut().zip(factors.solve(&left)) {
                *effort = *effort - change;
            }
            self.follow(efforts);
        }
        false
    }
}

/// `W x + a`.
pub(super) fn residuals<S: Real, const K: usize>(
    matrix: &[[S; K]; K],
    offset: &[S; K],
    efforts: &[S; K],
) -> [S; K] {
    let mut residuals = *offset;
    for (residual, row) in residuals.iter_mut().zip(matrix) {
        let terms = row.iter().zip(efforts);
        *residual = terms.fold(*residual, |sum, (&w, &x)| w.fused(x, sum));
    }
    residuals
}

/// An element by an index of a list, all of which are below `K`.
pub(super) fn at<S: Real, const K: usize>(elements: &[S; K], index: usize) -> S {
    elements.get(index).copied().unwrap_or(S::zero())
}

fn exchange<T: Copy, const K: usize>(elements: &mut [T; K], first: usize, second: usize) {
    if let (Some(&a), Some(&b)) = (elements.get(first), elements.get(second)) {
        for (index, value) in [(first, b), (second, a)] {
            if let Some(element) = elements.get_mut(index) {
                *element = value;
            }
        }
    }
}

/// Triangular factors of a matrix, with exchanged rows, of those unknowns that have a scale.
pub(super) struct Lu<S, const K: usize> {
    /// How many unknowns there are, and which.
    count: usize,
    unknowns: [usize; K],
    factors: [[S; K]; K],
    rows: [usize; K],
    /// Each exchange of two rows turns the sign of the determinant.
    sign: S,
    /// What rows and columns are multiplied by; zero of what is no unknown.
    scales: [S; K],
}

impl<S: Real, const K: usize> Lu<S, K> {
    /// Of a matrix in its scales.
    pub(super) fn of(matrix: &[[S; K]; K], scales: [S; K]) -> Self {
        let mut unknowns = [0; K];
        let mut count = 0;
        for (index, &scale) in scales.iter().enumerate() {
            if let (true, Some(place)) = (scale > S::zero(), unknowns.get_mut(count)) {
                *place = index;
                count += 1;
            }
        }
        let (mut rows, mut sign) = (unknowns, S::one());
        let mut factors = [[S::zero(); K]; K];
        for (row, &from) in factors.iter_mut().zip(&unknowns).take(count) {
            if let Some(from) = matrix.get(from) {
                for (element, &column) in row.iter_mut().zip(&unknowns).take(count) {
                    *element = at(from, column);
                }
            }
        }
        for k in 0..count.min(K) {
            let mut largest = k;
            for i in k + 1..count.min(K) {
                if factors[i][k].abs() > factors[largest][k].abs() {
                    largest = i;
                }
            }
            if largest != k {
                sign = -sign;
            }
            exchange(&mut factors, k, largest);
            exchange(&mut rows, k, largest);
            let row = factors[k];
            let reciprocal = row[k].reciprocal();
            for below in factors.iter_mut().take(count).skip(k + 1) {
                let factor = below[k] * reciprocal;
                below[k] = factor;
                for (element, &above) in below.iter_mut().zip(&row).take(count).skip(k + 1) {
                    *element = *element - factor * above;
                }
            }
        }
        Self {
            count,
            unknowns,
            factors,
            rows,
            sign,
            scales,
        }
    }

    /// The determinant of the matrix in its scales.
    fn determinant(&self) -> S {
        let pivots = self.factors.iter().enumerate().take(self.count);
        pivots.fold(self.sign, |product, (index, row)| product * row[index])
    }

    /// The solution, in the units of the matrix without its scales; zero of what is no unknown.
    pub(super) fn solve(&self, right: &[S; K]) -> [S; K] {
        let count = self.count.min(K);
        let mut x: [S; K] = self
            .rows
            .map(|from| at(right, from) * at(&self.scales, from));
        for i in 0..count {
            for k in 0..i {
                x[i] = x[i] - self.factors[i][k] * x[k];
            }
        }
        for i in (0..count).rev() {
            for k in i + 1..count {
                x[i] = x[i] - self.factors[i][k] * x[k];
            }
            x[i] = x[i].quotient(self.factors[i][i]);
        }
        let mut solution = [S::zero(); K];
        for (&x, &index) in x.iter().zip(&self.unknowns).take(count) {
            if let Some(place) = solution.get_mut(index) {
                *place = x * at(&self.scales, index);
            }
        }
        solution
    }
}
