//! Which rows are worth their time.

use super::record::Row;

/// The Pareto front: the rows that no other row beats in time and in error, cheapest first.
#[must_use]
pub fn front<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Vec<&'a Row> {
    front_by(rows, |row| row.seconds)
}

/// The same for another price than time.
#[must_use]
pub fn front_by<'a>(
    rows: impl IntoIterator<Item = &'a Row>,
    price: impl Fn(&Row) -> f64,
) -> Vec<&'a Row> {
    let mut rows: Vec<_> = rows.into_iter().collect();
    rows.sort_by(|a, b| {
        price(a)
            .total_cmp(&price(b))
            .then(a.error.total_cmp(&b.error))
    });
    let mut least = f64::INFINITY;
    rows.retain(|row| {
        let is_better = row.error < least;
        if is_better {
            least = row.error;
        }
        is_better
    });
    rows
}

#[cfg(test)]
mod tests {
    use super::front;
    use crate::trade::{Key, Row};

    fn row(seconds: f64, error: f64) -> Row {
        Row {
            setting: Key {
                coordinates: "bodies".into(),
                formulation: "standard".into(),
                coefficients: Vec::new(),
                stabilisation: "none".into(),
                integrator: "rk4".into(),
                scalar: "f64".into(),
                step_or_tolerance: 0.1,
            },
            error,
            seconds,
            reference_kernels: None,
            evaluations: 1,
            steps: [1, 1],
            max_violation: 0.0,
            energy_drift_joule: 0.0,
            warnings: Vec::new(),
        }
    }

    #[test]
    fn what_is_dearer_and_no_better_is_left_out() {
        let rows = [
            (3.0, 1e-3),
            (1.0, 1e-1),
            (2.0, 1e-1),
            (2.5, 1e-2),
            (2.5, 1e-4),
        ];
        let rows = rows.map(|(seconds, error)| row(seconds, error));
        let found: Vec<_> = front(&rows)
            .iter()
            .map(|row| (row.seconds, row.error))
            .collect();
        assert_eq!(found, [(1.0, 1e-1), (2.5, 1e-4)]);
    }
}
