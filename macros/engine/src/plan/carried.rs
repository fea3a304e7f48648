//! Two other ways through a factorised system, for rows that are eliminated together with
//! accelerations.
//!
//! Such rows determine their accelerations, and the equations of these accelerations determine
//! their multipliers. From the ground to the leaves the first gives accelerations that satisfy the
//! rows as they are: what is left to the factors has zeros for right-hand sides there. From the
//! leaves to the ground the second gives multipliers by the balance of forces on the bodies, in the
//! place of back-substitution. Both hold with and without a compliance of other rows.

use super::collect::common;
use super::eliminate::{Factors, Step};
use super::inverse::Inverse;
use super::symmetric::Symmetric;
use crate::symbolic::arena::{Arena, Expr};

impl Step {
    /// The accelerations and the rows of a pivot that has both.
    fn parts(&self) -> Option<(&[usize], &[usize])> {
        let half = self.unknowns.len() / 2;
        match &self.inverse {
            Inverse::Diagonal(_) => None,
            Inverse::Matrix(rows) if rows.len() == 1 => None,
            _ => Some(self.unknowns.split_at(half)),
        }
    }

    /// `C^-1`, rows are accelerations, if `C` is in a matrix what it was for the pivot.
    fn inverse_coupling(&self, matrix: &Symmetric) -> Option<Vec<Vec<Expr>>> {
        let (accelerations, rows) = self.parts()?;
        let block = rows.iter().map(|&row| {
            let entries = accelerations.iter().map(|&k| matrix.get(row, k));
            entries.collect::<Vec<Expr>>()
        });
        let block: Vec<Vec<Expr>> = block.collect();
        match &self.inverse {
            // Its own inverse.
            Inverse::Matrix(_) if block[0][0].abs() == Arena::ONE => Some(block),
            Inverse::Carried { signs, .. } => {
                let is_diagonal = block.iter().enumerate().all(|(k, row)| {
                    let mut entries = row.iter().enumerate();
                    entries.all(|(l, &entry)| {
                        let wanted = if k == l { signs[k] } else { Arena::ZERO };
                        entry == wanted
                    })
                });
                is_diagonal.then_some(block)
            }
            Inverse::Forbidden {
                coupling, inverse, ..
            } if block.iter().zip(coupling).all(|(a, b)| a[..] == b[..]) => {
                Some(inverse.iter().map(|row| row.to_vec()).collect())
            }
            _ => None,
        }
    }
}

fn dot<'a>(arena: &mut Arena, terms: impl Iterator<Item = (&'a Expr, &'a Expr)>) -> Expr {
    let mut sum = Arena::ZERO;
    for (a, b) in terms {
        let product = arena.mul(*a, *b);
        sum = arena.add(sum, product);
    }
    sum
}

/// `b - sum_l a_kl x_l` over some unknowns.
fn remainder(
    arena: &mut Arena,
    matrix: &Symmetric,
    k: usize,
    right: Expr,
    x: &[Expr],
    over: impl Fn(usize) -> bool,
) -> Expr {
    let mut rest = right;
    let others = matrix.neighbours(k).filter(|&l| over(l));
    let terms = others.map(|l| (matrix.get(k, l), x[l])).collect();
    for (entry, x) in common(arena, terms) {
        let product = arena.mul(entry, x);
        rest = arena.sub(rest, product);
    }
    rest
}

impl Factors {
    /// Whether rows are eliminated together with accelerations at all.
    pub(super) fn carry(&self) -> bool {
        self.steps.iter().any(|step| step.parts().is_some())
    }

    /// Solves the system `matrix`, of which these are the factors, beginning with accelerations
    /// that satisfy the rows that are eliminated together with them.
    pub(super) fn solve_from_known(
        &self,
        arena: &mut Arena,
        matrix: &Symmetric,
        right: &[Expr],
    ) -> Vec<Expr> {
        let size = right.len();
        let mut known = vec![Arena::ZERO; size];
        // Accelerations that may still be set, and rows that are satisfied.
        let mut open = vec![false; size];
        let mut satisfied = vec![false; size];
        for (accelerations, _) in self.steps.iter().filter_map(Step::parts) {
            accelerations.iter().for_each(|&k| open[k] = true);
        }
        for step in self.steps.iter().rev() {
            let Some((accelerations, rows)) = step.parts() else {
                continue;
            };
            accelerations.iter().for_each(|&k| open[k] = false);
            let is_final = |&row: &usize| matrix.neighbours(row).all(|l| !open[l]);
            let Some(inverse) = step.inverse_coupling(matrix) else {
                continue;
            };
            if !rows.iter().all(is_final) {
                continue;
            }
            let rests: Vec<Expr> = rows
                .iter()
                .map(|&row| remainder(arena, matrix, row, right[row], &known, |_| true))
                .collect();
            for (&k, inverse) in accelerations.iter().zip(&inverse) {
                known[k] = dot(arena, inverse.iter().zip(&rests));
            }
            rows.iter().for_each(|&row| satisfied[row] = true);
        }
        let rest = (0..size)
            .map(|k| {
                if satisfied[k] {
                    return Arena::ZERO;
                }
                remainder(arena, matrix, k, right[k], &known, |_| true)
            })
            .collect();
        let rest = self.solve(arena, rest);
        let both = known.into_iter().zip(rest);
        both.map(|(known, rest)| arena.add(known, rest)).collect()
    }

    /// Puts in the place of multipliers what the equations of the accelerations say that are
    /// eliminated together with their rows. The solution `x` is that of `matrix`, which may be
    /// about other points than the factors.
    pub(super) fn balance(
        &self,
        arena: &mut Arena,
        matrix: &Symmetric,
        right: &[Expr],
        x: &mut [Expr],
    ) {
        // Multipliers that may still change.
        let mut open = vec![false; x.len()];
        for (_, rows) in self.steps.iter().filter_map(Step::parts) {
            rows.iter().for_each(|&row| open[row] = true);
        }
        let mut pending: Vec<&Step> = self.steps.iter().filter(|s| s.parts().is_some()).collect();
        while !pending.is_empty() {
            let is_final = |step: &&Step, open: &[bool]| {
                step.parts().is_some_and(|(accelerations, rows)| {
                    let mut others = accelerations.iter().flat_map(|&k| matrix.neighbours(k));
                    others.all(|l| !open[l] || rows.contains(&l))
                })
            };
            let ready = pending.iter().position(|step| is_final(step, &open));
            let step = pending.remove(ready.unwrap_or(0));
            let Some((accelerations, rows)) = step.parts() else {
                continue;
            };
            rows.iter().for_each(|&row| open[row] = false);
            let Some(inverse) = step.inverse_coupling(matrix).filter(|_| ready.is_some()) else {
                continue;
            };
            let rests: Vec<Expr> = accelerations
                .iter()
                .map(|&k| {
                    let others = |l: usize| !rows.contains(&l);
                    remainder(arena, matrix, k, right[k], x, others)
                })
                .collect();
            for (place, &row) in rows.iter().enumerate() {
                let column = inverse.iter().map(|row| &row[place]);
                x[row] = dot(arena, column.zip(&rests));
            }
        }
    }
}
