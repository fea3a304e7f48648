//! Eigenvalues of any matrix with as many vectors as they have: of equal ones, independent ones.
//!
//! Where eigenvalues are near to each other, the vectors of each are not determined, and what
//! spans those of all is. So they are brought together in Schur's form, and the small matrix of
//! what they span is looked at by itself, in its own units. It is a multiple of one: then any
//! vectors do. Or it has eigenvalues that are apart there. Or they have fewer vectors than there
//! are: the matrix is defective.

use std::vec::Vec;

use nalgebra::{Complex, ComplexField as _, DMatrix, Schur};

type C = Complex<f64>;

/// Eigenvalues that are one, and what spans their vectors.
pub(super) struct Eigenspace {
    pub(super) value: C,
    /// How many eigenvalues they are: more than vectors, where the matrix is defective.
    pub(super) multiplicity: usize,
    /// Orthonormal columns.
    pub(super) vectors: DMatrix<C>,
}

/// Far more than an eigenvalue takes.
const ITERATIONS: usize = 10_000;

/// How far apart eigenvalues may come by round-off that are one of so many with one vector, over
/// the size of the matrix: the root of that power of it, some times.
fn apart(epsilon: f64, count: usize) -> f64 {
    10.0 * epsilon.powf(1.0 / count as f64)
}

/// The largest number of eigenvalues with one vector that is looked for.
const CHAIN: usize = 4;

/// The eigenvalues of a matrix whose numbers are right to `epsilon` of the largest, and their
/// vectors; nothing where the iteration does not converge.
pub(super) fn spectrum(matrix: &DMatrix<f64>, epsilon: f64) -> Vec<Eigenspace> {
    let complex = matrix.map(|entry| C::new(entry, 0.0));
    let Some(schur) = Schur::try_new(complex, f64::EPSILON, ITERATIONS) else {
        return Vec::new();
    };
    let (vectors, mut triangle) = schur.unpack();
    triangle.fill_lower_triangle(C::new(0.0, 0.0), 1);
    let noise = 30.0 * matrix.nrows() as f64 * epsilon * matrix.amax();
    let mut found = Found {
        spaces: Vec::new(),
        noise,
        epsilon,
    };
    found.split(&triangle, &vectors, (C::new(0.0, 0.0), 1.0), false);
    found.spaces
}

struct Found {
    spaces: Vec<Eigenspace>,
    /// The round-off of an entry.
    noise: f64,
    epsilon: f64,
}

impl Found {
    /// Takes the eigenvalues `base + scale t` of a triangle, with an orthonormal basis of what
    /// they span. `is_within` says that the triangle is what is left of one that they came from.
    fn split(
        &mut self,
        triangle: &DMatrix<C>,
        basis: &DMatrix<C>,
        (base, scale): (C, f64),
        is_within: bool,
    ) {
        let size = largest(triangle).max(f64::MIN_POSITIVE);
        let values: Vec<C> = triangle.diagonal().iter().copied().collect();
        let all: Vec<usize> = (0..values.len()).collect();
        for group in groups(&values, all, size, CHAIN, self.epsilon) {
            let (mut own, mut spanning) = (triangle.clone(), basis.clone());
            bring_to_front(&mut own, &mut spanning, &group);
            let count = group.len();
            let vectors = spanning.columns(0, count).into_owned();
            let own = own.view((0, 0), (count, count)).into_owned();
            let mean = own.diagonal().iter().sum::<C>() / count as f64;
            let mut rest = own;
            for place in 0..count {
                rest[(place, place)] -= mean;
            }
            let mut value = base + mean * scale;
            // Zero, or of a real matrix a real one.
            if value.modulus() <= self.noise {
                value = C::new(0.0, 0.0);
            }
            if value.im.abs() <= apart(self.epsilon, 2) * size * scale {
                value.im = 0.0;
            }
            let left = largest(&rest);
            let vectors = if count == 1 || left * scale <= self.noise {
                vectors
            } else if is_within && count == values.len() {
                let kept = kernel(&rest, 1e-5 * left);
                vectors * kept
            } else {
                let rest = rest / C::new(left, 0.0);
                self.split(&rest, &vectors, (base + mean * scale, scale * left), true);
                continue;
            };
            self.spaces.push(Eigenspace {
                value,
                multiplicity: count,
                vectors,
            });
        }
    }
}

fn largest(matrix: &DMatrix<C>) -> f64 {
    matrix
        .iter()
        .fold(0.0, |most, entry| entry.modulus().max(most))
}

/// Groups of eigenvalues that may be one: at least as many as come so far apart.
fn groups(
    values: &[C],
    mut members: Vec<usize>,
    size: f64,
    count: usize,
    epsilon: f64,
) -> Vec<Vec<usize>> {
    let near = apart(epsilon, count) * size;
    let mut found = Vec::new();
    while let Some(first) = members.pop() {
        let mut group = std::vec![first];
        let mut place = 0;
        while let Some(&member) = group.get(place) {
            let is_near = |other: &usize| (values[*other] - values[member]).modulus() <= near;
            group.extend(members.extract_if(.., |other| is_near(other)));
            place += 1;
        }
        if group.len() >= count || count <= 2 {
            // Of two that are further apart, each is by itself.
            found.push(group);
        } else {
            found.extend(groups(values, group, size, count - 1, epsilon));
        }
    }
    found
}

/// Orders the eigenvalues of a triangle so that some are the first, in its basis too.
///
/// Bai and Demmel, *On swapping diagonal blocks in real Schur form*, Linear Algebra and its
/// Applications 186 (1993); as LAPACK's `ZTREXC`.
fn bring_to_front(triangle: &mut DMatrix<C>, basis: &mut DMatrix<C>, group: &[usize]) {
    let mut group = group.to_vec();
    group.sort_unstable();
    for (front, place) in group.into_iter().enumerate() {
        for upper in (front..place).rev() {
            swap(triangle, basis, upper);
        }
    }
}

/// Exchanges an eigenvalue with the next one.
fn swap(triangle: &mut DMatrix<C>, basis: &mut DMatrix<C>, upper: usize) {
    let lower = upper + 1;
    let (first, second) = (triangle[(upper, upper)], triangle[(lower, lower)]);
    let (f, g) = (triangle[(upper, lower)], second - first);
    let size = f.modulus().hypot(g.modulus());
    if size <= 0.0 {
        return;
    }
    let cosine = f.modulus() / size;
    let phase = if f.modulus() > 0.0 {
        f / f.modulus()
    } else {
        C::new(1.0, 0.0)
    };
    let sine = phase * g.conj() / size;
    let turn = |x: &mut C, y: &mut C, sine: C| {
        let (a, b) = (*x, *y);
        *x = a * cosine + b * sine;
        *y = b * cosine - a * sine.conj();
    };
    for column in lower + 1..triangle.ncols() {
        let [mut x, mut y] = [upper, lower].map(|row| triangle[(row, column)]);
        turn(&mut x, &mut y, sine);
        (triangle[(upper, column)], triangle[(lower, column)]) = (x, y);
    }
    for (matrix, rows) in [(&mut *triangle, upper), (&mut *basis, usize::MAX)] {
        for row in 0..rows.min(matrix.nrows()) {
            let [mut x, mut y] = [upper, lower].map(|column| matrix[(row, column)]);
            turn(&mut x, &mut y, sine.conj());
            (matrix[(row, upper)], matrix[(row, lower)]) = (x, y);
        }
    }
    (triangle[(upper, upper)], triangle[(lower, lower)]) = (second, first);
}

/// An orthonormal basis of what a matrix takes to less than that.
fn kernel(matrix: &DMatrix<C>, least: f64) -> DMatrix<C> {
    let svd = matrix.clone().svd(false, true);
    let Some(rows) = svd.v_t else {
        return DMatrix::identity(matrix.ncols(), 0);
    };
    let kept: Vec<usize> = (0..matrix.ncols())
        .filter(|&place| svd.singular_values[place] <= least)
        .collect();
    // A triangle without a diagonal has one at least.
    DMatrix::from_fn(matrix.ncols(), kept.len(), |row, column| {
        rows[(kept[column], row)].conj()
    })
}
