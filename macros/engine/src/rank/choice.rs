//! Which equations to leave out, so that the others stay independent all along a motion.
//!
//! With a basis `Y` of the combinations of rows that vanish, `Y^T D = 0`, the rows outside a set
//! `S` are independent where the determinant of the rows `S` of `Y` is not zero. Its sign counts
//! too: where it changes between two stops of a sweep, it is zero between them.
//!
//! Where the rows that are kept are independent at a stop, the others are combinations of them,
//! which are all that is needed (`Exchanges`). Where they are not, the basis is worked out.

use super::dense::{Direction, Matrix, determinant, dot, norm, orthonormal, remove_all, transpose};
use super::normal::Normal;
use super::span::independent;
use super::sparse::{Row, Rows, width};

/// A choice whose determinant falls to this fraction of its largest is looked at again.
const STEADY: f64 = 0.1;

/// The rows to keep of those of `D` along a sweep: those given if they do all along, else the best
/// that exchanges lead to.
pub(super) fn steady(kept: Vec<usize>, sweep: &[Rows], tolerance: f64) -> Vec<usize> {
    let count = sweep.first().map_or(0, Vec::len);
    let left_out: Vec<usize> = (0..count).filter(|row| !kept.contains(row)).collect();
    if left_out.is_empty() {
        return kept;
    }
    let exchanged = Exchanges::along(sweep, &kept, &left_out, tolerance)
        .and_then(|exchanges| exchanges.best(tolerance));
    exchanged.unwrap_or_else(|| steady_by_bases(kept, left_out, sweep, tolerance))
}

/// The least determinant of some rows along a sweep over the largest, negative where it changes its
/// sign: how far they are from a place where they depend on each other, while others do not.
pub(super) fn steadiness(kept: &[usize], sweep: &[Rows], tolerance: f64) -> f64 {
    let count = sweep.first().map_or(0, Vec::len);
    let left_out: Vec<usize> = (0..count).filter(|row| !kept.contains(row)).collect();
    if left_out.is_empty() {
        return f64::INFINITY;
    }
    let exchanges = Exchanges::along(sweep, kept, &left_out, tolerance);
    let found = match exchanges {
        Some(exchanges) => Determinants::of(exchanges.stops.iter().map(|stop| stop.determinant)),
        None => determinants(&combinations(sweep, kept.len(), tolerance), &left_out),
    };
    found.map_or(f64::INFINITY, |found| found.least / found.largest)
}

/// Whether a determinant with the given values is better than one whose least value is given.
fn is_better(least: f64, than: f64, tolerance: f64) -> bool {
    least > than * (1.0 + tolerance) + tolerance
}

/// What the rows that are left out are made of, stop by stop.
struct Exchanges {
    kept: Vec<usize>,
    left_out: Vec<usize>,
    stops: Vec<Stop>,
}

struct Stop {
    /// The shares of the kept rows, by their places, in each that is left out.
    shares: Rows,
    /// Of `Y`, an orthonormal basis turned like that of the stop before.
    determinant: f64,
}

impl Exchanges {
    /// `None` where the kept rows hardly stand out from each other although others do. Stops of
    /// less than the rank are passed over.
    fn along(sweep: &[Rows], kept: &[usize], left_out: &[usize], tolerance: f64) -> Option<Self> {
        let mut stops: Vec<Stop> = Vec::new();
        for rows in sweep {
            let basis: Rows = kept.iter().map(|&row| rows[row].clone()).collect();
            let Some(normal) = sound(&basis) else {
                if independent(std::slice::from_ref(rows), tolerance).len() < kept.len() {
                    continue;
                }
                return None;
            };
            let length = width(rows);
            let shares = left_out.iter().map(|&row| {
                let shares = shares(&basis, &normal, &rows[row], length, tolerance)?;
                Some(Row::of(&shares))
            });
            // Where there are none, the rank is more than that of the kept rows.
            if let Some(shares) = shares.collect::<Option<Rows>>() {
                let stop = Stop::new(shares, stops.last(), kept.len())?;
                stops.push(stop);
            }
        }
        Some(Self {
            kept: kept.to_vec(),
            left_out: left_out.to_vec(),
            stops,
        })
    }

    /// The rows to keep; `None` where the way leads through a choice that is singular.
    fn best(mut self, tolerance: f64) -> Option<Vec<usize>> {
        let determinants = self.stops.iter().map(|stop| stop.determinant);
        let Some(Determinants { mut least, largest }) = Determinants::of(determinants) else {
            return Some(self.kept);
        };
        if least > STEADY * largest {
            return Some(self.kept);
        }
        while let Some((better, place, slot)) = self.best_exchange()
            && is_better(better, least, tolerance)
        {
            least = better;
            for stop in &mut self.stops {
                stop.exchange(place, slot, self.kept.len())?;
            }
            std::mem::swap(&mut self.left_out[place], &mut self.kept[slot]);
        }
        self.kept.sort_unstable();
        Some(self.kept)
    }

    /// The least determinant of the best exchange, with the place of the row that is kept from then
    /// on, and of the one that is not.
    ///
    /// The determinant is the former one times the share of the one row in the other.
    fn best_exchange(&self) -> Option<(f64, usize, usize)> {
        let mut slots: Vec<usize> = (0..self.kept.len()).collect();
        slots.sort_unstable_by_key(|&slot| self.kept[slot]);
        let mut best: Option<(f64, usize, usize)> = None;
        for place in 0..self.left_out.len() {
            let mut values = vec![Vec::new(); self.kept.len()];
            for stop in &self.stops {
                for &(slot, share) in stop.shares[place].entries() {
                    values[slot].push(stop.determinant * share);
                }
            }
            for &slot in &slots {
                let values = &mut values[slot];
                if values.is_empty() {
                    // Of nothing but dependent rows.
                    continue;
                }
                values.resize(self.stops.len(), 0.0);
                let least = Determinants::of(values.iter().copied())?.least;
                if best.is_none_or(|(most, ..)| least > most) {
                    best = Some((least, place, slot));
                }
            }
        }
        best
    }
}

/// The factors of rows that stand out from each other so far that sums of them are known well.
fn sound(rows: &Rows) -> Option<Normal> {
    const SOUND: f64 = 1e-3;
    let normal = Normal::new(rows, 0.0)?;
    let stand_out = normal.diagonal().iter().all(|length| *length > SOUND);
    stand_out.then_some(normal)
}

/// The shares of rows in one that depends on them; `None` of one that does not.
fn shares(
    basis: &Rows,
    normal: &Normal,
    row: &Row,
    length: usize,
    tolerance: f64,
) -> Option<Vec<f64>> {
    /// Shares below this are round-off.
    const ROUND_OFF: f64 = 1e-12;
    let mut shares = normal.solve(&normal.products(row));
    let mut left = row.dense(length);
    for (other, share) in basis.iter().zip(&mut shares) {
        if share.abs() <= ROUND_OFF {
            *share = 0.0;
        } else {
            other.add_to(-*share, &mut left);
        }
    }
    (norm(&left) <= tolerance).then_some(shares)
}

impl Stop {
    /// With the shares `T`, the rows of `[-T I]` vanish with those of `D`, and all others that do
    /// are sums of them: `det (I + T T^T)` is the square of the volume that they span.
    fn new(shares: Rows, before: Option<&Self>, kept: usize) -> Option<Self> {
        let volume: f64 = Normal::new(&shares, 1.0)?.diagonal().iter().product();
        let sign = before.map_or(1.0, |before| {
            let turned = determinant(before.products(&shares, kept));
            turned.signum() * before.determinant.signum()
        });
        Some(Self {
            shares,
            determinant: sign / volume,
        })
    }

    /// `I + T T'^T` with the shares of another stop.
    fn products(&self, others: &Rows, kept: usize) -> Matrix {
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); kept];
        for (place, row) in others.iter().enumerate() {
            for &(slot, share) in row.entries() {
                columns[slot].push((place, share));
            }
        }
        let rows = self.shares.iter().enumerate().map(|(place, row)| {
            let mut products = vec![0.0; others.len()];
            products[place] = 1.0;
            for &(slot, share) in row.entries() {
                for &(other, value) in &columns[slot] {
                    products[other] += share * value;
                }
            }
            products
        });
        rows.collect()
    }

    /// Keeps a row that was left out, for one of which it has a share; `None` if that vanishes.
    fn exchange(&mut self, place: usize, slot: usize, kept: usize) -> Option<()> {
        let share = self.shares[place].at(slot);
        if share == 0.0 {
            return None;
        }
        self.determinant *= share;
        let mut row = self.shares[place].dense(kept);
        row[slot] = -1.0;
        row.iter_mut().for_each(|x| *x /= -share);
        for (other, shares) in self.shares.iter_mut().enumerate() {
            let factor = shares.at(slot);
            if other == place {
                *shares = Row::of(&row);
            } else if factor != 0.0 {
                let mut changed = shares.dense(kept);
                changed[slot] = 0.0;
                for (x, y) in changed.iter_mut().zip(&row) {
                    *x += factor * y;
                }
                *shares = Row::of(&changed);
            }
        }
        Some(())
    }
}

/// The same with bases of the combinations that vanish.
fn steady_by_bases(
    kept: Vec<usize>,
    mut left_out: Vec<usize>,
    sweep: &[Rows],
    tolerance: f64,
) -> Vec<usize> {
    let count = kept.len() + left_out.len();
    let combinations = combinations(sweep, kept.len(), tolerance);
    let Some(Determinants { mut least, largest }) = determinants(&combinations, &left_out) else {
        return kept;
    };
    if least > STEADY * largest {
        return kept;
    }
    while let Some((better, exchanged)) = best_exchange(&combinations, &left_out, count, tolerance)
        && is_better(better, least, tolerance)
    {
        (least, left_out) = (better, exchanged);
    }
    (0..count).filter(|row| !left_out.contains(row)).collect()
}

fn best_exchange(
    combinations: &[Matrix],
    left_out: &[usize],
    count: usize,
    tolerance: f64,
) -> Option<(f64, Vec<usize>)> {
    let mut best: Option<(f64, Vec<usize>)> = None;
    for place in 0..left_out.len() {
        for row in (0..count).filter(|row| !left_out.contains(row)) {
            let mut exchanged = left_out.to_vec();
            exchanged[place] = row;
            let Determinants { least, largest } = determinants(combinations, &exchanged)?;
            // Rows that depend on each other everywhere are no choice, not even where all others
            // depend on each other somewhere.
            if least.abs().max(largest) <= tolerance {
                continue;
            }
            if best.as_ref().is_none_or(|(most, _)| least > *most) {
                best = Some((least, exchanged));
            }
        }
    }
    best
}

/// Determinants along a sweep, with the sign that most of them have.
struct Determinants {
    least: f64,
    largest: f64,
}

impl Determinants {
    fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let values: Vec<f64> = values.collect();
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

fn determinants(combinations: &[Matrix], left_out: &[usize]) -> Option<Determinants> {
    Determinants::of(combinations.iter().map(|basis| {
        let rows = basis
            .iter()
            .map(|vector| left_out.iter().map(|&row| vector[row]).collect());
        determinant(rows.collect())
    }))
}

/// The combinations of rows that vanish, stop by stop: unit vectors at right angles to each other,
/// turned like those before. Stops of less than the rank are passed over.
fn combinations(sweep: &[Rows], rank: usize, tolerance: f64) -> Vec<Matrix> {
    let mut bases: Vec<Matrix> = Vec::new();
    for rows in sweep {
        let length = width(rows);
        let dense: Matrix = rows.iter().map(|row| row.dense(length)).collect();
        let columns = orthonormal(&transpose(&dense), tolerance);
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
fn complement(vectors: &[Direction], length: usize) -> Matrix {
    let mut rest: Matrix = (0..length)
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

    /// Three rows in a plane of two dimensions, the third a sum of the others with weights that
    /// turn.
    fn turning(stops: usize) -> Vec<Rows> {
        (0..stops)
            .map(|k| {
                let angle = 0.3 * k as f64;
                let weight = 1.5 + angle.cos();
                let mut third = Row::of(&[angle.sin(), weight]);
                third.scale(third.norm().recip());
                vec![Row::of(&[1.0, 0.0]), Row::of(&[0.0, 1.0]), third]
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

    #[test]
    fn rows_that_hold_nothing_are_never_chosen() {
        // One of three that turn, all of which vanish somewhere, and one of round-off.
        let sweep = |stops: usize| -> Vec<Rows> {
            (0..stops)
                .map(|k| {
                    let angle = 0.1 + 0.3 * k as f64;
                    let [a, b, c] = [0.0, 1.0, 2.0].map(|phase| (angle + phase).cos());
                    [a, b, 1e-17 * c, c].map(|x| Row::of(&[x])).to_vec()
                })
                .collect()
        };
        for stops in [1, 2, 5, 30, 200] {
            for kept in [0, 1, 3] {
                let left_out = (0..4).filter(|&row| row != kept).collect();
                let by_bases = steady_by_bases(vec![kept], left_out, &sweep(stops), 1e-7);
                assert_ne!(by_bases, [2], "{stops} stops");
                assert_ne!(
                    steady(vec![kept], &sweep(stops), 1e-7),
                    [2],
                    "{stops} stops"
                );
            }
        }
    }

    /// Seven rows in a space of four dimensions, with weights of different speeds; some are sums of
    /// two or three others only.
    fn tumbling(seed: usize) -> Vec<Rows> {
        let weight = |stop: usize, row: usize, place: usize| {
            let phase = ((seed + 3) * (7 * row + place) % 17) as f64;
            let speed = 0.02 * ((seed + row * place) % 5) as f64;
            let is_left = (seed + row + place).is_multiple_of(3);
            if is_left && row > 3 {
                0.0
            } else {
                (phase + speed * stop as f64).sin()
            }
        };
        (0..40)
            .map(|stop| {
                let rows = (0..7).map(|row| {
                    let values = [0, 1, 2, 3].map(|place| weight(stop, row, place));
                    let mut row = Row::of(&values);
                    row.scale(row.norm().recip());
                    row
                });
                rows.collect()
            })
            .collect()
    }

    /// Two ways to the same choice: by shares of rows, and by bases of what vanishes.
    #[test]
    fn exchanges_lead_to_what_bases_lead_to() {
        let mut changed = 0;
        let mut decided = 0;
        for seed in 0..200 {
            let sweep = tumbling(seed);
            let kept = independent(&sweep[..1], 1e-7);
            let left_out: Vec<usize> = (0..7).filter(|row| !kept.contains(row)).collect();
            if kept.len() < 4 {
                continue;
            }
            let by_bases = steady_by_bases(kept.clone(), left_out.clone(), &sweep, 1e-7);
            let exchanges = Exchanges::along(&sweep, &kept, &left_out, 1e-7);
            let Some(found) = exchanges.and_then(|exchanges| exchanges.best(1e-7)) else {
                continue;
            };
            assert_eq!(found, by_bases, "seed {seed}");
            decided += 1;
            changed += usize::from(found != kept);
        }
        assert!(decided > 100 && changed > 30, "{changed} of {decided}");
    }
}
