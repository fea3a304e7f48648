//! Symbolic elimination of a symmetric system with pivots of one to four unknowns, or of many that
//! are not coupled, in a given order: `L D L^T`.
//!
//! Accelerations that follow each other and are not coupled are eliminated together, and so are
//! accelerations that follow each other with the rows that carry them: what they add to an entry is
//! summed before, so that entries share it.

use super::Pivot;
use super::augmented::Share;
use super::collect::{common, sum_of_products, through};
use super::inverse::{Inverse, by_determined, dot, invert, invert_forbidden};
use super::symmetric::Symmetric;
use crate::symbolic::arena::{Arena, Expr};

/// One step of the elimination: `x_P = P^-1 (rhs_P - sum A_iP^T x_i)`.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) unknowns: Vec<usize>,
    pub(super) inverse: Inverse,
    /// What an unknown that is coupled to the pivot by a column `(u; v)` needs of it:
    /// `P^-1 (u; v)`, or where rows determine their accelerations, `x = C^-1 v` and what they
    /// leave, `z = u - A x`. That `C^-T z` are multipliers matters at the very end: until then
    /// `C^-T z . v' = z . x'`.
    lower: Vec<(usize, Vec<Expr>)>,
}

/// A pivot that depends on the state, and what it is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Check {
    /// The unknown.
    pub unknown: usize,
    /// The pivot.
    pub pivot: Expr,
    /// What it is compared with: for a multiplier its diagonal element of `D M^-1 D^T` over the
    /// bodies eliminated so far, for a forbidden motion the determinant at the start.
    pub before: Expr,
}

/// A factorised symmetric matrix.
#[derive(Clone, Debug)]
pub struct Factors {
    pub(super) steps: Vec<Step>,
    /// The pivots that depend on the state and are not safe by themselves.
    pub checks: Vec<Check>,
    /// Where the matrix is that of augmented bodies: what makes of its solutions those of the
    /// original.
    pub(super) shares: Vec<Share>,
}

/// Factorises a matrix.
///
/// `about_centres` is the same system with accelerations of centres of mass: pivots are compared
/// with what rows would be in it. `determinants` are those of the blocks [`Pivot::Forbidden`] at
/// the start, in order. Whatever the plan says, the result solves the system: a block that an
/// earlier step has filled, so that it is not what its kind of pivot is safe for, is eliminated one
/// unknown after the other, and a multiplier waits until its pivot is not zero by structure. What
/// is zero to the end is zero because rows depend on each other, and is recorded.
///
/// # Panics
/// If the plan does not eliminate every unknown once, or lacks a determinant.
pub fn factorise(
    arena: &mut Arena,
    matrix: Symmetric,
    about_centres: Symmetric,
    pivots: &[Pivot],
    determinants: &[f64],
) -> Factors {
    factorise_within(
        arena,
        matrix,
        about_centres,
        (pivots, determinants),
        usize::MAX,
    )
    .expect("there is no bound")
}

/// The same; `None` if it takes more than so many nodes.
pub(super) fn factorise_within(
    arena: &mut Arena,
    matrix: Symmetric,
    about_centres: Symmetric,
    (pivots, determinants): (&[Pivot], &[f64]),
    most: usize,
) -> Option<Factors> {
    let before = arena.len();
    let size = matrix.size();
    let mut turn = vec![usize::MAX; size];
    for (place, unknown) in pivots.iter().flat_map(|p| p.unknowns()).enumerate() {
        turn[unknown] = place;
    }
    let mut elimination = Elimination {
        turn,
        about_centres,
        matrix,
        step: vec![None; size],
        waiting: Vec::new(),
        factors: Factors {
            steps: Vec::new(),
            checks: Vec::new(),
            shares: Vec::new(),
        },
    };
    let mut determinants = determinants.iter();
    let mut place = 0;
    while let Some(&pivot) = pivots.get(place) {
        let together = elimination.mutually_uncoupled(&pivots[place..]);
        if together.len() > 1 {
            place += together.len();
            elimination.take_uncoupled(arena, together);
            if arena.len() - before > most {
                return None;
            }
            continue;
        }
        let carried = elimination.carried(&pivots[place..]);
        if carried.len() > 1 {
            place += carried.len();
            elimination.take_carried(arena, &carried);
            if arena.len() - before > most {
                return None;
            }
            continue;
        }
        place += 1;
        let determinant = match pivot {
            Pivot::Forbidden(..) | Pivot::Dependent(..) => *determinants
                .next()
                .expect("a plan has a determinant for every forbidden motion"),
            _ => 1.0,
        };
        for pivot in elimination.sound(pivot) {
            elimination.take(arena, pivot, determinant);
        }
        if arena.len() - before > most {
            return None;
        }
    }
    for row in std::mem::take(&mut elimination.waiting) {
        elimination.step(arena, Pivot::Multiplier(row), 1.0);
    }
    assert!(
        elimination.step.iter().all(Option::is_some),
        "a plan eliminates every unknown once"
    );
    Some(elimination.factors)
}

/// The state of an elimination.
struct Elimination {
    /// As assembled with accelerations of centres of mass, which do not know of each other.
    about_centres: Symmetric,
    /// What is left.
    matrix: Symmetric,
    /// When the plan eliminates each unknown: sums are taken in this order, so that the numbers of
    /// the unknowns, and with them the order of the fields, have no say.
    turn: Vec<usize>,
    /// The step that has eliminated an unknown, and the unknown's place in it.
    step: Vec<Option<(usize, usize)>>,
    /// Rows whose pivot is zero so far.
    waiting: Vec<usize>,
    factors: Factors,
}

impl Elimination {
    /// A pivot, or its unknowns one by one where the block is not what its kind is safe for.
    fn sound(&self, pivot: Pivot) -> Vec<Pivot> {
        let entry = |k: usize, l: usize| self.matrix.get(k, l);
        let is_sound = match pivot {
            Pivot::Acceleration(_) | Pivot::Multiplier(_) => true,
            // `-a e - c^2` cannot vanish for `c = 1`, whatever was added to `a` or to `e`.
            Pivot::Saddle(k, l) => entry(k, l).abs() == Arena::ONE,
            Pivot::Dependent(_, l) => entry(l, l) == Arena::ZERO,
            Pivot::Forbidden(_, [m, n]) => {
                [(m, m), (m, n), (n, n)].map(|(k, l)| entry(k, l)) == [Arena::ZERO; 3]
            }
        };
        match pivot {
            _ if is_sound => vec![pivot],
            Pivot::Saddle(k, l) | Pivot::Dependent(k, l) => {
                vec![Pivot::Acceleration(k), Pivot::Multiplier(l)]
            }
            Pivot::Forbidden([k, l], [m, n]) => vec![
                Pivot::Acceleration(k),
                Pivot::Acceleration(l),
                Pivot::Multiplier(m),
                Pivot::Multiplier(n),
            ],
            _ => vec![pivot],
        }
    }

    /// The first pivots, if they are accelerations that know nothing of each other.
    fn mutually_uncoupled(&self, pivots: &[Pivot]) -> Vec<usize> {
        let mut together: Vec<usize> = Vec::new();
        let mut is_taken = vec![false; self.matrix.size()];
        for pivot in pivots {
            let Pivot::Acceleration(k) = *pivot else {
                break;
            };
            if self.matrix.neighbours(k).any(|l| is_taken[l]) {
                break;
            }
            together.push(k);
            is_taken[k] = true;
        }
        together
    }

    /// The first pivots, if they are accelerations with rows that carry one each and know nothing
    /// of the others.
    fn carried(&self, pivots: &[Pivot]) -> Vec<[usize; 2]> {
        let mut carried: Vec<[usize; 2]> = Vec::new();
        for pivot in pivots {
            let Pivot::Saddle(k, l) = *pivot else { break };
            let entry = |a: usize, b: usize| self.matrix.get(a, b);
            let is_zero = |a: usize, b: usize| entry(a, b) == Arena::ZERO;
            let is_alone = |&[i, j]: &[usize; 2]| is_zero(i, l) && is_zero(k, j) && is_zero(j, l);
            let is_sound = entry(k, l).abs() == Arena::ONE && is_zero(l, l);
            if !is_sound || !carried.iter().all(is_alone) {
                break;
            }
            carried.push([k, l]);
        }
        carried
    }

    /// Eliminates accelerations together with the rows that carry them, and rows that waited for
    /// it.
    fn take_carried(&mut self, arena: &mut Arena, carried: &[[usize; 2]]) {
        let signs = carried.iter().map(|&[k, l]| self.matrix.get(k, l));
        let accelerations = carried.iter().map(|[k, _]| *k);
        let mass = accelerations.clone().map(|k| {
            let row = accelerations.clone().map(|l| self.matrix.get(k, l));
            row.collect()
        });
        let inverse = Inverse::Carried {
            signs: signs.collect(),
            mass: mass.collect(),
        };
        let unknowns = accelerations.chain(carried.iter().map(|[_, l]| *l));
        let unknowns = unknowns.collect();
        self.eliminate(arena, unknowns, inverse);
        self.take_waiting(arena);
    }

    /// Eliminates accelerations that know nothing of each other, and rows that waited for it.
    fn take_uncoupled(&mut self, arena: &mut Arena, unknowns: Vec<usize>) {
        let pivots = unknowns.iter().map(|&k| self.matrix.get(k, k));
        let inverses = pivots.map(|pivot| arena.reciprocal(pivot)).collect();
        self.eliminate(arena, unknowns, Inverse::Diagonal(inverses));
        self.take_waiting(arena);
    }

    /// Eliminates what can be eliminated now, and rows that waited for it.
    fn take(&mut self, arena: &mut Arena, pivot: Pivot, determinant: f64) {
        match pivot {
            Pivot::Multiplier(row) if self.matrix.get(row, row) == Arena::ZERO => {
                self.waiting.push(row);
            }
            _ => self.step(arena, pivot, determinant),
        }
        self.take_waiting(arena);
    }

    fn take_waiting(&mut self, arena: &mut Arena) {
        while let Some(place) = self.ready() {
            let row = self.waiting.remove(place);
            self.step(arena, Pivot::Multiplier(row), 1.0);
        }
    }

    /// The first of the waiting rows that need not wait any longer.
    fn ready(&self) -> Option<usize> {
        let has_pivot = |row: &usize| self.matrix.get(*row, *row) != Arena::ZERO;
        self.waiting.iter().position(has_pivot)
    }

    /// The check of a multiplier, `None` where its pivot is a number that stands out.
    fn check(&self, arena: &mut Arena, row: usize) -> Option<Check> {
        /// A number below this, relative to what it was made of, is taken for round-off: left to
        /// the kernels to report.
        const ROUND_OFF: f64 = 1e-9;
        let pivot = self.matrix.get(row, row);
        let before = self.uncoupled(arena, row);
        let is_safe = match (arena.literal(pivot), arena.literal(before)) {
            (Some(pivot), Some(before)) => pivot.abs() > ROUND_OFF * before.abs(),
            _ => false,
        };
        (!is_safe).then_some(Check {
            unknown: row,
            pivot,
            before,
        })
    }

    /// The pivot of a multiplier if there were no other rows. The terms are summed in the order of
    /// elimination, where the elimination may have formed the same sum, in the order of the
    /// unknowns, or at once, whatever takes fewest operations.
    fn uncoupled(&self, arena: &mut Arena, row: usize) -> Expr {
        let mut sorted: Vec<usize> = self.about_centres.neighbours(row).collect();
        sorted.retain(|&k| self.step[k].is_some());
        let mut in_turn: Vec<(Option<(usize, usize)>, usize)> =
            sorted.iter().map(|&k| (self.step[k], k)).collect();
        in_turn.sort_unstable();
        let steps = in_turn.chunk_by(|(a, _), (b, _)| a.map(|a| a.0) == b.map(|b| b.0));
        let steps = steps.map(|step| step.iter().map(|&(_, k)| k).collect());
        let one_by_one: Vec<Vec<usize>> = sorted.iter().map(|&k| vec![k]).collect();
        let ways = [steps.collect(), one_by_one, vec![sorted]];
        let operations = |over: &&Vec<Vec<usize>>| {
            let mark = arena.mark();
            self.about_centres.schur_diagonal(arena, row, over);
            let operations = arena.operations_since(mark);
            arena.rollback(mark);
            operations
        };
        let over = ways.iter().min_by_key(operations);
        let over = over.expect("there are three ways");
        self.about_centres.schur_diagonal(arena, row, over)
    }

    fn step(&mut self, arena: &mut Arena, pivot: Pivot, determinant: f64) {
        let unknowns = pivot.unknowns();
        let inverse = match pivot {
            Pivot::Forbidden(accelerations, rows) => {
                let (inverse, pivot) = invert_forbidden(arena, &self.matrix, accelerations, rows);
                let before = arena.constant(determinant);
                self.factors.checks.push(Check {
                    unknown: rows[0],
                    pivot,
                    before,
                });
                inverse
            }
            Pivot::Dependent(velocity, row) => {
                let pivot = self.matrix.get(velocity, row);
                if arena.literal(pivot).is_none() {
                    let before = arena.constant(determinant);
                    self.factors.checks.push(Check {
                        unknown: row,
                        pivot,
                        before,
                    });
                }
                Inverse::Dependent {
                    reciprocal: arena.reciprocal(pivot),
                    mass: self.matrix.get(velocity, velocity),
                }
            }
            Pivot::Multiplier(row) => {
                let check = self.check(arena, row);
                self.factors.checks.extend(check);
                Inverse::Matrix(invert(arena, &self.matrix, &unknowns))
            }
            Pivot::Acceleration(_) | Pivot::Saddle(..) => {
                Inverse::Matrix(invert(arena, &self.matrix, &unknowns))
            }
        };
        self.eliminate(arena, unknowns, inverse);
    }

    fn eliminate(&mut self, arena: &mut Arena, unknowns: Vec<usize>, inverse: Inverse) {
        let matrix = &mut self.matrix;
        let coupled: Vec<usize> = {
            let mut coupled: Vec<usize> = unknowns
                .iter()
                .flat_map(|&k| matrix.neighbours(k))
                .collect();
            coupled.sort_unstable_by_key(|&k| self.turn[k]);
            coupled.dedup();
            coupled.retain(|k| !unknowns.contains(k));
            coupled
        };
        let columns: Vec<Vec<Expr>> = coupled
            .iter()
            .map(|&i| unknowns.iter().map(|&k| matrix.get(i, k)).collect())
            .collect();
        let determined: Vec<[Vec<Expr>; 2]> = columns
            .iter()
            .map(|column| inverse.determined(arena, column))
            .collect();
        // Each of many accelerations that know nothing of each other is in few columns.
        let acting: Vec<Vec<usize>> = columns.iter().map(|column| acting(column)).collect();
        let mut lower: Vec<(usize, Vec<Expr>)> = Vec::new();
        for (place, &i) in coupled.iter().enumerate() {
            let [x, left] = &determined[place];
            let row = if x.is_empty() {
                inverse.apply(arena, &columns[place])
            } else {
                [&x[..], left].concat()
            };
            for (other, &j) in coupled[..=place].iter().enumerate() {
                let update = match &inverse {
                    Inverse::Matrix(_) => dot(arena, &row, &columns[other]),
                    Inverse::Diagonal(inverses) => {
                        let both = common_places(&acting[place], &acting[other]);
                        if both.is_empty() {
                            continue;
                        }
                        let of =
                            |values: &[Expr]| both.iter().map(|&k| values[k]).collect::<Vec<_>>();
                        let [a, b] = [place, other].map(|k| of(&columns[k]));
                        through(arena, &of(inverses), &a, &b)
                    }
                    // Not by way of multipliers, which may not be asked for.
                    _ => {
                        let pair = [place, other];
                        by_determined(arena, pair.map(|k| (&columns[k][..], &determined[k])))
                    }
                };
                matrix.add(arena, i, j, -update);
            }
            lower.push((i, row));
        }
        for &unknown in &unknowns {
            matrix.remove(unknown);
        }
        for (place, &unknown) in unknowns.iter().enumerate() {
            let former = self.step[unknown].replace((self.factors.steps.len(), place));
            assert!(former.is_none(), "a plan eliminates every unknown once");
        }
        self.factors.steps.push(Step {
            unknowns,
            inverse,
            lower,
        });
    }
}

/// The places of entries that are not zero.
fn acting(column: &[Expr]) -> Vec<usize> {
    let entries = column.iter().enumerate();
    let acting = entries.filter(|(_, entry)| **entry != Arena::ZERO);
    acting.map(|(place, _)| place).collect()
}

/// What two sorted lists have in common.
fn common_places(a: &[usize], b: &[usize]) -> Vec<usize> {
    let mut others = b.iter().copied().peekable();
    let mut common = Vec::new();
    for &place in a {
        while others.next_if(|&other| other < place).is_some() {}
        if others.peek() == Some(&place) {
            common.push(place);
        }
    }
    common
}

impl Factors {
    /// The entries of `L`.
    pub(super) fn entries(&self) -> Vec<Expr> {
        let rows = self.steps.iter().flat_map(|step| &step.lower);
        rows.flat_map(|(_, row)| row.iter().copied()).collect()
    }

    /// Solves the system for a right-hand side.
    pub fn solve(&self, arena: &mut Arena, mut right: Vec<Expr>) -> Vec<Expr> {
        let rows = self.shares.iter().map(|share| right[share.row]);
        let gamma: Vec<Expr> = rows.collect();
        for share in &self.shares {
            share.add_forces(arena, &mut right);
        }
        let mut reduced = Vec::new();
        for step in &self.steps {
            let own: Vec<Expr> = step.unknowns.iter().map(|&k| right[k]).collect();
            let [x, left] = step.inverse.determined(arena, &own);
            let half = x.len();
            let known = if half == 0 {
                own.clone()
            } else {
                [&own[..half], &x].concat()
            };
            for (i, row) in &step.lower {
                if let Inverse::Diagonal(_) = step.inverse {
                    let term = sum_of_products(arena, row, &known);
                    right[*i] = arena.sub(right[*i], term);
                    continue;
                }
                for (&entry, &known) in row.iter().zip(&known) {
                    let product = arena.mul(entry, known);
                    right[*i] = arena.sub(right[*i], product);
                }
            }
            reduced.push(if half == 0 {
                step.inverse.apply(arena, &own)
            } else {
                [x, left].concat()
            });
        }
        let mut solution = vec![Arena::ZERO; right.len()];
        for (step, mut values) in self.steps.iter().zip(reduced).rev() {
            for (p, value) in values.iter_mut().enumerate() {
                // What is known first comes first, so that the path is short.
                let terms = step.lower.iter().rev();
                let terms = terms.map(|(i, row)| (row[p], solution[*i]));
                let terms: Vec<(Expr, Expr)> = terms.collect();
                let terms = match step.inverse {
                    Inverse::Diagonal(_) => common(arena, terms),
                    _ => terms,
                };
                for (entry, known) in terms {
                    let product = arena.mul(entry, known);
                    *value = arena.sub(*value, product);
                }
            }
            let half = values.len() / 2;
            let y = step.inverse.multipliers(arena, &values[half..]);
            let first = values.len() - y.len();
            values[first..].copy_from_slice(&y);
            for (&unknown, value) in step.unknowns.iter().zip(values) {
                solution[unknown] = value;
            }
        }
        for (share, gamma) in self.shares.iter().zip(gamma) {
            share.add_reaction(arena, gamma, &mut solution);
        }
        solution
    }
}

#[cfg(test)]
mod tests {
    use super::{Symmetric, factorise};
    use crate::plan::Pivot;
    use crate::symbolic::arena::Arena;

    #[test]
    fn a_numeric_saddle_system_is_solved() {
        // [4 1 1; 1 3 0; 1 0 0] x = (9, 7, 1): x = (1, 2, 3).
        let mut arena = Arena::new();
        let mut matrix = Symmetric::new(3);
        for (k, l, value) in [(0, 0, 4.0), (0, 1, 1.0), (1, 1, 3.0), (0, 2, 1.0)] {
            let value = arena.constant(value);
            matrix.set(k, l, value);
        }
        for pivots in [
            vec![Pivot::Saddle(0, 2), Pivot::Acceleration(1)],
            vec![
                Pivot::Acceleration(1),
                Pivot::Acceleration(0),
                Pivot::Multiplier(2),
            ],
        ] {
            let factors = factorise(&mut arena, matrix.clone(), matrix.clone(), &pivots, &[]);
            let right = [9.0, 7.0, 1.0].map(|value| arena.constant(value)).to_vec();
            let solution = factors.solve(&mut arena, right);
            let values: Vec<f64> = solution
                .iter()
                .map(|&x| arena.literal(x).expect("folds"))
                .collect();
            for (value, expected) in values.iter().zip([1.0, 2.0, 3.0]) {
                assert!((value - expected).abs() < 1e-15, "{values:?}");
            }
        }
    }

    #[test]
    fn a_number_that_is_round_off_is_recorded() {
        // Two rows on one acceleration: the second pivot is 9e-16, not zero.
        let mut arena = Arena::new();
        let mut matrix = Symmetric::new(3);
        for (k, l, value) in [(0, 0, 0.7), (0, 1, 0.9), (0, 2, 1.7)] {
            let value = arena.constant(value);
            matrix.set(k, l, value);
        }
        let pivots = [
            Pivot::Acceleration(0),
            Pivot::Multiplier(1),
            Pivot::Multiplier(2),
        ];
        let factors = factorise(&mut arena, matrix.clone(), matrix, &pivots, &[]);
        let [check] = factors.checks[..] else {
            panic!("{:?}", factors.checks)
        };
        let pivot = arena.literal(check.pivot).expect("folds");
        let is_round_off = pivot != 0.0 && pivot.abs() < 1e-14;
        assert!(check.unknown == 2 && is_round_off, "{check:?} {pivot:e}");
    }
}
