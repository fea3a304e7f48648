//! A sparse symmetric matrix of expressions.

use std::collections::BTreeMap;

use super::collect::through;
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

    /// The number of rows.
    pub(super) fn size(&self) -> usize {
        self.rows.len()
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

    /// `-sum_l a_kl^2 / a_ll` over some unknowns: in the system as assembled, what the diagonal
    /// element of a multiplier becomes by accelerations that do not know of each other.
    pub(super) fn schur_diagonal(&self, arena: &mut Arena, k: usize, over: &[Vec<usize>]) -> Expr {
        let mut sum = self.get(k, k);
        for step in over {
            let acts = |l: &usize| *l != k && self.get(k, *l) != Arena::ZERO;
            let step: Vec<usize> = step.iter().copied().filter(acts).collect();
            let row: Vec<Expr> = step.iter().map(|&l| self.get(k, l)).collect();
            let inverses = step.iter().map(|&l| arena.reciprocal(self.get(l, l)));
            let inverses: Vec<Expr> = inverses.collect();
            let term = through(arena, &inverses, &row, &row);
            sum = arena.sub(sum, term);
        }
        sum
    }

    pub(super) fn neighbours(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        self.rows[k].keys().copied()
    }

    pub(super) fn remove(&mut self, k: usize) {
        for (l, _) in std::mem::take(&mut self.rows[k]) {
            if l != k {
                self.rows[l].remove(&k);
            }
        }
    }
}
