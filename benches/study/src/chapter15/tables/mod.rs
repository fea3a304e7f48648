//! Tables 15.1 to 15.3, and the tables that the chapter could not have.

mod measured;
mod printed;

pub use measured::{accuracy, baselines, prices, steps, violation};
pub use printed::{data, evaluations, parameters};

use super::outcome::Outcome;
use crate::document::Table;

/// A table with one row per formulation.
fn by_method(
    caption: &str,
    columns: &[&str],
    outcomes: &[Outcome],
    row: impl Fn(&Outcome) -> Vec<String>,
    note: &str,
) -> Table {
    let rows = outcomes.iter().map(|outcome| {
        let mut cells = vec![outcome.method.name().to_owned()];
        cells.extend(row(outcome));
        cells
    });
    Table {
        caption: caption.into(),
        columns: std::iter::once(&"formulation")
            .chain(columns)
            .map(|&c| c.to_owned())
            .collect(),
        rows: rows.collect(),
        note: note.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::{accuracy, baselines, data, evaluations, parameters, prices, steps, violation};
    use crate::chapter15::outcome::tests::made_up;
    use crate::chapter15::{Method, Settings};

    #[test]
    fn every_row_fills_its_columns() {
        let outcomes = Method::ALL.map(made_up);
        let settings = Settings::TABLE_15_2;
        let tables = [
            data(),
            parameters(&settings),
            evaluations(&outcomes),
            prices(&outcomes),
            baselines(&outcomes[0]).unwrap(),
            steps(&outcomes),
            accuracy(&outcomes),
            violation(&outcomes, &settings),
        ];
        for table in tables {
            assert!(
                table
                    .rows
                    .iter()
                    .all(|row| row.len() == table.columns.len())
            );
            assert!(
                table.rows.iter().flatten().all(|cell| !cell.is_empty()),
                "{}",
                table.caption
            );
        }
    }

    #[test]
    fn published_and_measured_values_stand_side_by_side() {
        let table = evaluations(&Method::ALL.map(made_up));
        assert_eq!(
            table.rows[0],
            ["standard", "1639", "1765", "7.7 %", "6.3", "0.088"]
        );
        assert_eq!(table.rows[2][1], "3769");
    }

    #[test]
    fn the_cheapest_form_of_the_assembler_is_the_baseline() {
        let outcomes = Method::ALL.map(made_up);
        let table = prices(&outcomes);
        assert_eq!(
            table.rows[0][1..],
            ["50.0", "45.0 … 55.0", "2000", "1800 … 2200", "40.0"]
        );
        let forms = baselines(&outcomes[0]).unwrap().rows;
        let names: Vec<_> = forms.iter().map(|row| row[0].as_str()).collect();
        assert_eq!(
            names,
            ["generated", "static", "whole matrix", "Schur complement"]
        );
    }

    #[test]
    fn a_missing_baseline_is_a_dash() {
        let mut outcome = made_up(Method::Penalty);
        outcome.prices.assembler.clear();
        assert_eq!(prices(&[outcome.clone()]).rows[0][3..], ["–", "–", "–"]);
        assert_eq!(baselines(&outcome), None);
    }

    #[test]
    fn the_rod_is_that_of_the_book() {
        let cells: Vec<_> = data().rows.into_iter().map(|row| row[1].clone()).collect();
        assert_eq!(cells[..3], ["7.02", "0.5855265", "0.0010530"]);
    }
}
