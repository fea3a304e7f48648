//! Which equations to leave out, so that the others stay independent all along a motion.
//!
//! With a basis `Y` of the combinations of rows that vanish, `Y^T D = 0`, the rows outside a set `S` are independent where the determinant of
//! the rows `S` of `Y` is not zero. Its sign counts too: where it changes between two stops of a tour, it is zero between them.

use super::dense::{Direction, Rows, determinant, dot, norm, orthonormal, remove_all, transpose};

/// A choice whose determinant falls to this fraction of its largest is looked at again.
const STEADY: f64 = 0.1;

/// The rows to keep of those of `D` along a tour: those given if they do all along, else the best that exchanges lead to.
pub(super) fn steady(kept: Vec<usize>, tour: &[Rows], tolerance: f64) -> Vec<usize> {
    let count = tour.first().map_or(0, Vec::len);
    let combinations = combinations(tour, kept.len(), tolerance);
    let mut left_out: Vec<usize> = (0..count).filter(|row| !kept.contains(row)).collect();
    let Some(determinants) = Determinants::of(&combinations, &left_out) else {
        return kept;
    };
    if determinants.least > STEADY * determinants.largest {
        return kept;
    }
    let mut least = determinants.least;
    while let Some((better, exchanged)) = best_exchange(&combinations, &left_out, count)
        && better > least * (1.0 + tolerance) + tolerance
    {
        (least, left_out) = (better, exchanged);
    }
    (0..count).filter(|row| !left_out.contains(row)).collect()
}

fn best_exchange(
    combinations: &[Rows],
    left_out: &[usize],
    count: usize,
) -> Option<(f64, Vec<usize>)> {
    let mut best: Option<(f64, Vec<usize>)> = None;
    for place in 0..left_out.len() {
        for row in (0..count).filter(|row| !left_out.contains(row)) {
            let mut exchanged = left_out.to_vec();
            exchanged[place] = row;
            let least = Determinants::of(combinations, &exchanged)?.least;
            if best.as_ref().is_none_or(|(most, _)| least > *most) {
                best = Some((least, exchanged));
            }
        }
    }
    best
}

/// Determinants along a tour, with the sign that most of them have.
struct Determinants {
    least: f64,
    largest: f64,
}

impl Determinants {
    fn of(combinations: &[Rows], left_out: &[usize]) -> Option<Self> {
        let values: Vec<f64> = combinations
            .iter()
            .map(|basis| {
                let rows = basis
                    .iter()
                    .map(|vector| left_out.iter().map(|&row| vector[row]).collect());
                determinant(rows.collect())
            })
            .collect();
        let positive = values.iter().filter(|value| **value > 0.0).count();
        let sign = if 2 * positive >= values.len() {
            1.0
        } else {
            -1.0
        };
        let signed = || values.iter().map(|value| sign * value);
        Some(Self {
            least: signed().reduce(f64::min)?,
            largest: signed().reduce(f64::max)?,
        })
    }
}

/// The combinations of rows that vanish, stop by stop: unit vectors at right angles to each other, turned like those before.
/// Stops of less than the rank are passed over.
fn combinations(tour: &[Rows], rank: usize, tolerance: f64) -> Vec<Rows> {
    let mut bases: Vec<Rows> = Vec::new();
    for rows in tour {
        let columns = orthonormal(&transpose(rows), tolerance);
        if columns.len() != rank {
            continue;
        }
        let mut basis = complement(&columns, rows.len());
        if let Some(before) = bases.last() {
            let products = basis.iter().map(|a| before.iter().map(|b| dot(a, b)));
            if determinant(products.map(Iterator::collect).collect()) < 0.0 {
                basis[0].iter_mut().for_each(|x| *x = -*x);
            }
        }
        bases.push(basis);
    }
    bases
}

/// What is at right angles to all of some unit vectors at right angles to each other.
fn complement(vectors: &[Direction], length: usize) -> Rows {
    let mut rest: Rows = (0..length)
        .map(|place| {
            let mut unit = vec![0.0; length];
            unit[place] = 1.0;
            remove_all(&mut unit, vectors);
            unit
        })
        .collect();
    let mut basis: Vec<Direction> = Vec::new();
    let mut sizes: Vec<f64> = rest.iter().map(|vector| norm(vector)).collect();
    for _ in vectors.len()..length {
        let longest = (0..length).max_by(|&a, &b| sizes[a].total_cmp(&sizes[b]));
        let Some(longest) = longest else { break };
        let size = sizes[longest];
        let mut direction: Vec<f64> = rest[longest].iter().map(|x| x / size).collect();
        remove_all(&mut direction, &basis);
        let direction = Direction::unit(direction);
        for (vector, size) in rest.iter_mut().zip(&mut sizes) {
            if direction.remove_from(vector) {
                *size = norm(vector);
            }
        }
        basis.push(direction);
    }
    basis
        .into_iter()
        .map(|direction| direction.values)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three rows in a plane of two dimensions, the third a sum of the others with weights that turn.
    fn turning(stops: usize) -> Vec<Rows> {
        (0..stops)
            .map(|k| {
                let angle = 0.3 * k as f64;
                let weight = 1.5 + angle.cos();
                let third = vec![angle.sin(), weight];
                let length = norm(&third);
                let third = third.iter().map(|x| x / length).collect();
                vec![vec![1.0, 0.0], vec![0.0, 1.0], third]
            })
            .collect()
    }

    #[test]
    fn a_choice_that_turns_singular_is_exchanged() {
        // The second and third row are in line whenever the sine is zero.
        assert_eq!(steady(vec![1, 2], &turning(30), 1e-7), [0, 1]);
    }

    #[test]
    fn a_choice_that_does_is_kept() {
        assert_eq!(steady(vec![0, 2], &turning(30), 1e-7), [0, 2]);
        assert_eq!(steady(vec![0, 1], &turning(30), 1e-7), [0, 1]);
        assert_eq!(steady(vec![0, 1], &[], 1e-7), [0, 1]);
    }
}
