//! The solution of the equations of motion in an order of velocities and multipliers.

use super::links::Links;
use crate::plan::Pivot;
use crate::plan::eliminate::{Check, Factors, factorise};
use crate::plan::symmetric::Symmetric;
use crate::symbolic::arena::{Arena, Expr, Input};

/// The solution of the equations of motion.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Rates of the velocities.
    pub accelerations: Vec<Expr>,
    /// Multipliers of the rows that remain.
    pub multipliers: Vec<Expr>,
    /// Pivots that depend on the state and are not safe by themselves, with the row in the place of
    /// the unknown.
    pub checks: Vec<Check>,
}

/// How `[M D^T; D -E]` is solved.
#[derive(Clone, Debug)]
pub(super) struct Elimination {
    pub(super) pivots: Vec<Pivot>,
    pub(super) determinants: Vec<f64>,
    /// Whether every row determines a velocity.
    pub(super) is_determined: bool,
    pub(super) is_compliant: bool,
}

impl Elimination {
    /// Solves the system for forces along the velocities and right-hand sides of the rows.
    pub(super) fn solve(
        &self,
        arena: &mut Arena,
        links: &Links,
        rows: &[Vec<Expr>],
        mut right: Vec<Expr>,
        lower: Vec<Expr>,
    ) -> Solution {
        right.extend(lower);
        let factors = self.factors(arena, links, rows);
        let mut solution = factors.solve(arena, right);
        let multipliers = solution.split_off(links.velocities);
        // Quasi-definite with a compliance: every pivot is safe.
        let checks = factors.checks.iter().filter(|_| !self.is_compliant);
        let checks = checks.map(|check| Check {
            unknown: check.unknown - links.velocities,
            ..*check
        });
        Solution {
            accelerations: solution,
            multipliers,
            checks: checks.collect(),
        }
    }

    /// The factors of the system.
    pub(super) fn factors(&self, arena: &mut Arena, links: &Links, rows: &[Vec<Expr>]) -> Factors {
        let velocities = links.velocities;
        let mass = links.mass_matrix(arena);
        let mut matrix = Symmetric::new(velocities + rows.len());
        for k in 0..velocities {
            for l in 0..=k {
                matrix.set(k, l, mass.get(k, l));
            }
        }
        for (row, entries) in rows.iter().enumerate() {
            for (k, &entry) in entries.iter().enumerate() {
                matrix.set(velocities + row, k, entry);
            }
            if self.is_compliant {
                let compliance = arena.input(Input::Compliance(row as u32));
                matrix.set(velocities + row, velocities + row, -compliance);
            }
        }
        let (pivots, determinants) = (&self.pivots, &self.determinants);
        factorise(arena, matrix.clone(), matrix, pivots, determinants)
    }
}
