//! Symbolic elimination of a symmetric system with pivots of one, two or four unknowns, in a given order: `L D L^T`.

use std::collections::BTreeMap;

use super::Pivot;
use crate::symbolic::arena::{Arena, Expr};

/// A sparse symmetric matrix.
#[derive(Clone, Debug, Default)]
pub struct Symmetric {
    rows: Vec<BTreeMap<usize, Expr>>,
}

impl Symmetric {
    /// The zero matrix.
    #[must_use]
    pub fn new(size: usize) -> Self {
        Self {
            rows: vec![BTreeMap::new(); size],
        }
    }

    /// An entry.
    #[must_use]
    pub fn get(&self, k: usize, l: usize) -> Expr {
        self.rows[k].get(&l).copied().unwrap_or(Arena::ZERO)
    }

    /// Sets an entry and its mirror image.
    pub fn set(&mut self, k: usize, l: usize, value: Expr) {
        for (k, l) in [(k, l), (l, k)] {
            if value == Arena::ZERO {
                self.rows[k].remove(&l);
            } else {
                self.rows[k].insert(l, value);
            }
        }
    }

    /// Adds to an entry and its mirror image.
    pub fn add(&mut self, arena: &mut Arena, k: usize, l: usize, value: Expr) {
        let sum = arena.add(self.get(k, l), value);
        self.set(k, l, sum);
    }

    /// `-sum_l a_kl^2 / a_ll` over some unknowns: in the system as assembled, what the diagonal element of a multiplier becomes
    /// by accelerations that do not know of each other.
    fn schur_diagonal(&self, arena: &mut Arena, k: usize, over: &[usize]) -> Expr {
        let mut sum = self.get(k, k);
        for &l in over.iter().filter(|l| **l != k) {
            let entry = self.get(k, l);
            if entry != Arena::ZERO {
                let scaled = arena.div(entry, self.get(l, l));
                let term = arena.mul(entry, scaled);
                sum = arena.sub(sum, term);
            }
        }
        sum
    }

    pub(super) fn neighbours(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        self.rows[k].keys().copied()
    }

    fn remove(&mut self, k: usize) {
        for (l, _) in std::mem::take(&mut self.rows[k]) {
            if l != k {
                self.rows[l].remove(&k);
            }
        }
    }
}

/// One step of the elimination: `x_P = P^-1 (rhs_P - sum A_iP^T x_i)`.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) unknowns: Vec<usize>,
    pub(super) inverse: Inverse,
    /// What an unknown that is coupled to the pivot by a column `(u; l)` needs of it: `P^-1 (u; l)`, or where rows determine their accelerations, `x = C^-1 l`
    /// and `z = u - A x`.
    lower: Vec<(usize, Vec<Expr>)>,
}

/// The inverse of a pivot.
#[derive(Clone, Debug)]
pub(super) enum Inverse {
    /// Entry by entry.
    Matrix(Vec<Vec<Expr>>),
    /// Of `[A C^T; C 0]`: `C`, `C^-1` and `A`.
    Forbidden {
        coupling: [[Expr; 2]; 2],
        inverse: [[Expr; 2]; 2],
        mass: [[Expr; 2]; 2],
    },
    /// Of `[a c; c 0]`: `1 / c` and `a`.
    Dependent { reciprocal: Expr, mass: Expr },
}

impl Inverse {
    /// What a column, or a right-hand side, `(u; l)` becomes: `P^-1 (u; l)`, or where rows determine their accelerations, `x = C^-1 l` and `z = u - A x`. That `y =
    /// C^-T z` are multipliers matters at the very end: until then `y . l = z . x`.
    fn reduce(&self, arena: &mut Arena, b: &[Expr]) -> Vec<Expr> {
        match self {
            Self::Matrix(rows) => rows.iter().map(|row| dot(arena, row, b)).collect(),
            Self::Dependent { reciprocal, mass } => {
                let x = arena.mul(*reciprocal, b[1]);
                let inertia = arena.mul(*mass, x);
                vec![x, arena.sub(b[0], inertia)]
            }
            Self::Forbidden { inverse, mass, .. } => {
                let (upper, lower) = b.split_at(2);
                let x = inverse.map(|row| dot(arena, &row, lower));
                let inertia = mass.map(|row| dot(arena, &row, &x));
                let [first, second] = [0, 1].map(|k| arena.sub(upper[k], inertia[k]));
                vec![x[0], x[1], first, second]
            }
        }
    }

    /// What a column that was reduced takes from a right-hand side `(u; l)`, or the other way round.
    fn product(&self, arena: &mut Arena, column: &[Expr], b: &[Expr], reduced: &[Expr]) -> Expr {
        if let Self::Matrix(_) = self {
            return dot(arena, column, b);
        }
        let half = column.len() / 2;
        let ((x, z), upper) = (column.split_at(half), &b[..half]);
        let (first, second) = (dot(arena, x, upper), dot(arena, z, &reduced[..half]));
        arena.add(first, second)
    }

    /// What a column `(u; l)` that was reduced takes from its own diagonal element.
    fn square(&self, arena: &mut Arena, column: &[Expr], b: &[Expr]) -> Expr {
        if let Self::Matrix(_) = self {
            return dot(arena, column, b);
        }
        let (x, z) = column.split_at(column.len() / 2);
        let both: Vec<Expr> = z.iter().zip(b).map(|(&z, &u)| arena.add(z, u)).collect();
        dot(arena, x, &both)
    }

    /// The unknowns of the pivot, of what is left of a right-hand side that was reduced.
    fn finish(&self, arena: &mut Arena, left: Vec<Expr>) -> Vec<Expr> {
        match self {
            Self::Matrix(_) => left,
            Self::Dependent { reciprocal, .. } => {
                vec![left[0], arena.mul(*reciprocal, left[1])]
            }
            Self::Forbidden {
                inverse: [first, second],
                ..
            } => {
                let columns = [0, 1].map(|row| [first[row], second[row]]);
                let y = columns.map(|column| dot(arena, &column, &left[2..]));
                vec![left[0], left[1], y[0], y[1]]
            }
        }
    }
}

fn dot(arena: &mut Arena, x: &[Expr], y: &[Expr]) -> Expr {
    let mut sum = Arena::ZERO;
    for (&x, &y) in x.iter().zip(y) {
        let product = arena.mul(x, y);
        sum = arena.add(sum, product);
    }
    sum
}

/// A pivot that depends on the state, and what it is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Check {
    /// The unknown.
    pub unknown: usize,
    /// The pivot.
    pub pivot: Expr,
    /// What it is compared with: for a multiplier its diagonal element of `D M^-1 D^T` over the bodies eliminated so far, for
    /// a forbidden motion the determinant at the start.
    pub before: Expr,
}

/// A factorised symmetric matrix.
#[derive(Clone, Debug)]
pub struct Factors {
    pub(super) steps: Vec<Step>,
    /// The pivots that depend on the state and are not safe by themselves.
    pub checks: Vec<Check>,
}

/// Factorises a matrix.
///
/// `about_centres` is the same system with accelerations of centres of mass: pivots are compared with what rows would be in it. `determinants` are those of the blocks [`Pivot::Forbidden`] at the start, in order. Whatever the plan says, the result solves the
/// system: a block that an earlier step has filled, so that it is not what its kind of pivot is safe for, is eliminated
/// one unknown after the other, and a multiplier waits until its pivot is not zero by structure. What is zero to the end is
/// zero because rows depend on each other, and is recorded.
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
    let size = matrix.rows.len();
    let mut turn = vec![usize::MAX; size];
    for (place, unknown) in pivots.iter().flat_map(|p| p.unknowns()).enumerate() {
        turn[unknown] = place;
    }
    let mut elimination = Elimination {
        turn,
        about_centres,
        matrix,
        eliminated: Vec::new(),
        waiting: Vec::new(),
        factors: Factors {
            steps: Vec::new(),
            checks: Vec::new(),
        },
    };
    let mut determinants = determinants.iter();
    for &pivot in pivots {
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
    let mut eliminated = elimination.eliminated;
    eliminated.sort_unstable();
    assert!(
        eliminated.iter().copied().eq(0..size),
        "a plan eliminates every unknown once, not {eliminated:?} of {size}"
    );
    Some(elimination.factors)
}

/// The state of an elimination.
struct Elimination {
    /// As assembled with accelerations of centres of mass, which do not know of each other.
    about_centres: Symmetric,
    /// What is left.
    matrix: Symmetric,
    /// When the plan eliminates each unknown: sums are taken in this order, so that the numbers of the unknowns, and with them the order of the fields,
    /// have no say.
    turn: Vec<usize>,
    /// In order.
    eliminated: Vec<usize>,
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

    /// Eliminates what can be eliminated now, and rows that waited for it.
    fn take(&mut self, arena: &mut Arena, pivot: Pivot, determinant: f64) {
        match pivot {
            Pivot::Multiplier(row) if self.matrix.get(row, row) == Arena::ZERO => {
                self.waiting.push(row);
            }
            _ => self.step(arena, pivot, determinant),
        }
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
        /// A number below this, relative to what it was made of, is taken for round-off: left to the kernels to report.
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

    /// The pivot of a multiplier if there were no other rows. The terms are summed in the order of elimination, where the elimination may have
    /// formed the same sum, or in the order of the unknowns, whatever takes fewer operations.
    fn uncoupled(&self, arena: &mut Arena, row: usize) -> Expr {
        let mut sorted = self.eliminated.clone();
        sorted.sort_unstable();
        let [as_eliminated, as_numbered] = [&self.eliminated, &sorted].map(|over| {
            let mark = arena.mark();
            self.about_centres.schur_diagonal(arena, row, over);
            let operations = arena.operations_since(mark);
            arena.rollback(mark);
            operations
        });
        let over = if as_eliminated < as_numbered {
            &self.eliminated
        } else {
            &sorted
        };
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
        let column = |matrix: &Symmetric, i: usize| -> Vec<Expr> {
            unknowns.iter().map(|&k| matrix.get(i, k)).collect()
        };
        let lower: Vec<(usize, Vec<Expr>)> = coupled
            .iter()
            .map(|&i| (i, inverse.reduce(arena, &column(matrix, i))))
            .collect();
        for (place, (i, row)) in lower.iter().enumerate() {
            for (j, reduced) in &lower[..place] {
                let update = inverse.product(arena, row, &column(matrix, *j), reduced);
                matrix.add(arena, *i, *j, -update);
            }
            let update = inverse.square(arena, row, &column(matrix, *i));
            matrix.add(arena, *i, *i, -update);
        }
        for &unknown in &unknowns {
            matrix.remove(unknown);
        }
        self.eliminated.extend(&unknowns);
        self.factors.steps.push(Step {
            unknowns,
            inverse,
            lower,
        });
    }
}

fn invert(arena: &mut Arena, matrix: &Symmetric, unknowns: &[usize]) -> Vec<Vec<Expr>> {
    match *unknowns {
        [k] => vec![vec![arena.reciprocal(matrix.get(k, k))]],
        [k, l] => {
            let (a, b, c) = (matrix.get(k, k), matrix.get(k, l), matrix.get(l, l));
            let (ac, bb) = (arena.mul(a, c), arena.square(b));
            let determinant = arena.sub(ac, bb);
            let inverse = arena.reciprocal(determinant);
            let (a, b, c) = (
                arena.mul(a, inverse),
                arena.mul(b, inverse),
                arena.mul(c, inverse),
            );
            vec![vec![c, -b], vec![-b, a]]
        }
        _ => unreachable!("a pivot that is inverted entry by entry has one or two unknowns"),
    }
}

/// The inverse of `[A C^T; C 0]`, and the determinant of `C`.
fn invert_forbidden(
    arena: &mut Arena,
    matrix: &Symmetric,
    accelerations: [usize; 2],
    rows: [usize; 2],
) -> (Inverse, Expr) {
    let coupling = rows.map(|row| accelerations.map(|k| matrix.get(row, k)));
    let [[a, b], [c, d]] = coupling;
    let (ad, bc) = (arena.mul(a, d), arena.mul(b, c));
    let determinant = arena.sub(ad, bc);
    let reciprocal = arena.reciprocal(determinant);
    // Rows are accelerations, columns are rows of C.
    let inverse = [[d, -b], [-c, a]].map(|row| row.map(|entry| arena.mul(entry, reciprocal)));
    let mass = accelerations.map(|k| accelerations.map(|l| matrix.get(k, l)));
    let inverse = Inverse::Forbidden {
        coupling,
        inverse,
        mass,
    };
    (inverse, determinant)
}

impl Factors {
    /// The entries of `L`.
    pub(super) fn entries(&self) -> Vec<Expr> {
        let rows = self.steps.iter().flat_map(|step| &step.lower);
        rows.flat_map(|(_, row)| row.iter().copied()).collect()
    }

    /// Solves the system for a right-hand side.
    pub fn solve(&self, arena: &mut Arena, mut right: Vec<Expr>) -> Vec<Expr> {
        let mut reduced = Vec::new();
        for step in &self.steps {
            let own: Vec<Expr> = step.unknowns.iter().map(|&k| right[k]).collect();
            let of_own = step.inverse.reduce(arena, &own);
            for (i, row) in &step.lower {
                let product = step.inverse.product(arena, row, &own, &of_own);
                right[*i] = arena.sub(right[*i], product);
            }
            reduced.push(of_own);
        }
        let mut solution = vec![Arena::ZERO; right.len()];
        for (step, mut left) in self.steps.iter().zip(reduced).rev() {
            for (p, value) in left.iter_mut().enumerate() {
                // What is known first comes first, so that the path is short.
                for (i, row) in step.lower.iter().rev() {
                    let product = arena.mul(row[p], solution[*i]);
                    *value = arena.sub(*value, product);
                }
            }
            let values = step.inverse.finish(arena, left);
            for (&unknown, value) in step.unknowns.iter().zip(values) {
                solution[unknown] = value;
            }
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
