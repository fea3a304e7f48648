//! Moments of inertia, and the axes in which they are given.

use syn::Expr;

use super::reader::{MOMENTS_MOVE, Reader, place_of};
use crate::check::number::elements;
use crate::model::Number;
use crate::model::inertia::{IDENTITY, principal};
use crate::model::number::literals;

impl Reader<'_, '_> {
    /// Three principal moments, or three rows of a full tensor; and the rotation from the axes in
    /// which they are given to principal axes.
    pub(super) fn inertia(&mut self, expr: &Expr) -> Option<([Number; 3], [f64; 4])> {
        self.at("inertia");
        let Some(rows) = elements(expr) else {
            self.faults.at(
                expr,
                "expected three principal moments as in `[0.1, 0.1, 0.01]`, or the full tensor as three such rows",
            );
            return None;
        };
        let is_tensor = rows.iter().any(|row| elements(row).is_some());
        let (moments, axes) = if is_tensor {
            let tensor = self.tensor(expr, &rows)?;
            let (moments, axes) = principal(tensor);
            (moments.map(Number::Literal), axes)
        } else {
            (self.numbers.array(expr, self.faults)?, IDENTITY)
        };
        self.moments(expr, moments)?;
        Some((moments, axes))
    }

    /// Moments that a body can have, as far as the macro sees them.
    pub(super) fn moments(&mut self, expr: &Expr, moments: [Number; 3]) -> Option<()> {
        if self.as_given {
            return self.written_out(expr, &moments);
        }
        let (name, place) = (self.name, place_of(&moments));
        let seen = moments.map(|moment| self.numbers.seen(moment));
        if seen.iter().any(|m| m.is_some_and(|moment| moment <= 0.0)) {
            let is_measured = |m: &Option<f64>| m.is_none_or(|moment| moment >= 0.0);
            let instead = if seen.iter().all(is_measured) {
                MOMENTS_MOVE
            } else {
                ""
            };
            let found = seen.map(|m| m.map_or("..".into(), |m| brief(m).to_string()));
            self.faults.advised(
                expr,
                format!(
                    "the moments of inertia of `{name}` must be positive, in kg m^2; these are {}{place}; a point mass is a \
                     `Particle`",
                    found.join(", ")
                ),
                instead,
            );
            return None;
        }
        if let [Some(a), Some(b), Some(c)] = seen {
            let excess = |x: f64, y: f64, z: f64| x > (y + z) * (1.0 + 1e-9);
            if excess(a, b, c) || excess(b, c, a) || excess(c, a, b) {
                let largest = a.max(b).max(c);
                let excess = brief(largest - (a + b + c - largest));
                let [a, b, c] = [a, b, c].map(brief);
                self.faults.advised(
                    expr,
                    format!(
                        "no body has the moments of inertia of `{name}`: of {a}, {b} and {c}{place}, one exceeds the sum of \
                         the others by {excess}; a point mass is a `Particle`"
                    ),
                    MOMENTS_MOVE,
                );
                return None;
            }
        }
        Some(())
    }

    fn tensor(&mut self, expr: &Expr, rows: &[&Expr]) -> Option<[[f64; 3]; 3]> {
        if rows.len() != 3 {
            self.faults
                .at(expr, format!("found {} rows; a tensor has 3", rows.len()));
            return None;
        }
        let rows: Vec<Option<[Number; 3]>> = rows
            .iter()
            .map(|row| self.numbers.vector(row, self.faults))
            .collect();
        let rows: Vec<[Number; 3]> = rows.into_iter().collect::<Option<_>>()?;
        let values: Option<Vec<[f64; 3]>> = rows.iter().map(literals).collect();
        let Some(values) = values else {
            self.faults.at(
                expr,
                "a full tensor needs numbers that the macro can see, to find its principal axes; \
                 give principal moments instead",
            );
            return None;
        };
        let tensor: [[f64; 3]; 3] = values.try_into().ok()?;
        for (k, l) in [(0, 1), (0, 2), (1, 2)] {
            let (a, b) = (tensor[k][l], tensor[l][k]);
            if (a - b).abs() > 1e-12 * a.abs().max(b.abs()) {
                self.faults.at(
                    expr,
                    format!("the tensor is not symmetric: {a} stands against {b}"),
                );
                return None;
            }
        }
        Some(tensor)
    }
}

/// A number to seven digits, for messages: principal moments of a tensor come with round-off.
fn brief(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}
