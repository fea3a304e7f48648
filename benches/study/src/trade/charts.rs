//! The pictures of a trade.

use super::front::{front, front_by};
use super::integration::Family;
use super::measure::Trade;
use super::observation::Observation;
use super::record::Row;
use super::setting::PostStabilisation;
use crate::chapter15::Method;
use crate::chart::{Axis, Chart, Mark, SLOTS, Series};
use crate::compare::{Coordinates, Precision};
use crate::document::Figure;

/// A run that is shown over time.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Its name in the legend.
    pub name: String,
    /// What was read.
    pub run: Observation,
}

/// Error over time, one curve for each description and number type.
#[must_use]
pub fn fronts(trade: &Trade) -> Option<Figure> {
    let kinds = [
        (Coordinates::Joints, Precision::Double),
        (Coordinates::Bodies, Precision::Double),
        (Coordinates::Joints, Precision::Single),
        (Coordinates::Bodies, Precision::Single),
    ];
    let series = kinds.into_iter().enumerate().map(|(slot, (by, scalar))| {
        let rows = trade.rows.iter().filter(|row| row.is(by, scalar));
        let name = format!("{}, {}", by.key(), scalar.key());
        curve(trade, name, slot, &front(rows))
    });
    figure(
        trade,
        "front",
        "Error over time, the best of all settings",
        time_axis(),
        series.collect(),
        "Each curve is the Pareto front of a description and a number type: no other setting of these is both faster and more exact.",
        true,
    )
}

/// Whether integrators choose their steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// They do not.
    Fixed,
    /// They do, by a tolerance.
    Chosen,
}

impl Steps {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::Fixed, Self::Chosen];

    const fn key(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Chosen => "chosen",
        }
    }
}

/// Error over the price of integrators.
fn of_integrators(
    trade: &Trade,
    (by, steps): (Coordinates, Steps),
    (name, title): (&str, &str),
    x: Axis,
    price: impl Fn(&Row) -> f64 + Copy,
) -> Option<Figure> {
    let families = Family::ALL.into_iter();
    let families = families.filter(|family| family.is_adaptive() == (steps == Steps::Chosen));
    let series = families.take(SLOTS).enumerate().map(|(slot, family)| {
        let rows = trade
            .rows
            .iter()
            .filter(|row| row.is(by, Precision::Double) && row.setting.integrator == family.key());
        let rows = front_by(rows, price);
        let points = rows.iter().map(|row| (price(row), row.error));
        line(family.key().into(), slot, points.collect())
    });
    figure(
        trade,
        &format!("{name}-{}-{}", by.key(), steps.key()),
        &format!("{title}, by {}, steps {}", by.key(), steps.key()),
        x,
        series.collect(),
        "f64; of each integrator the best formulation and stabilisation.",
        false,
    )
}

/// Error over time of the integrators, one picture for each description.
#[must_use]
pub fn integrators(trade: &Trade, by: Coordinates, steps: Steps) -> Option<Figure> {
    let duration = trade.facts.span.end - trade.facts.span.start;
    let what = ("integrators", "Integrators over time");
    of_integrators(trade, (by, steps), what, time_axis(), |row| {
        row.seconds / duration
    })
}

/// Error over evaluations of the integrators, one picture for each description.
#[must_use]
pub fn evaluations(trade: &Trade, by: Coordinates, steps: Steps) -> Option<Figure> {
    let axis = Axis::logarithmic("evaluations", "1");
    let what = ("evaluations", "Integrators over evaluations");
    of_integrators(trade, (by, steps), what, axis, |row| row.evaluations as f64)
}

/// Error over time of the formulations with one integrator.
#[must_use]
pub fn formulations(trade: &Trade, by: Coordinates) -> Option<Figure> {
    let kinds = Method::ALL
        .map(|method| (method, PostStabilisation::None))
        .into_iter();
    let corrected =
        [Method::Standard, Method::Penalty].map(|method| (method, PostStabilisation::Projection));
    let series = kinds
        .chain(corrected)
        .enumerate()
        .map(|(slot, (method, stabilisation))| {
            let rows = trade.rows.iter().filter(|row| {
                row.is(by, Precision::Double)
                    && row.setting.formulation == method.key()
                    && row.setting.stabilisation == stabilisation.key()
            });
            let name = match stabilisation {
                PostStabilisation::None => method.name().to_owned(),
                _ => format!("{}, {}", method.name(), stabilisation.key()),
            };
            curve(trade, name, slot, &front(rows))
        });
    let series: Vec<_> = series.collect();
    // Where no equations remain there is one formulation, and nothing to compare.
    if series
        .iter()
        .filter(|series| !series.points.is_empty())
        .count()
        < 2
    {
        return None;
    }
    figure(
        trade,
        &format!("formulations-{}", by.key()),
        &format!("Formulations, by {}", by.key()),
        time_axis(),
        series,
        "f64; of each formulation the best integrator. A penalty has an error of its own that no step takes away.",
        false,
    )
}

/// Violation and energy over time of some runs.
#[must_use]
pub fn histories(histories: &[History]) -> Vec<Figure> {
    let series = |read: fn(&Observation) -> Vec<f64>| {
        let one = |(slot, history): (usize, &History)| {
            let values = read(&history.run);
            let points = history.run.times.iter().copied().zip(values);
            line(history.name.clone(), slot, points.collect())
        };
        let shown = histories.iter().take(SLOTS).enumerate();
        shown.map(one).collect::<Vec<_>>()
    };
    let change = |run: &Observation| {
        let first = run.energies.first().copied().unwrap_or(f64::NAN);
        run.energies
            .iter()
            .map(|energy| (energy - first).abs())
            .collect()
    };
    let figures = [
        (
            "violation",
            "Violation of the constraints",
            Axis::logarithmic("|Φ|", "m, rad"),
            series(|run| run.violations.clone()),
            "All equations together.",
        ),
        (
            "energy",
            "Change of energy",
            Axis::logarithmic("|E − E₀|", "J"),
            series(change),
            "Kinetic and potential energy less those of the start; what dampers, drivers and other forces put in or take is a part of it.",
        ),
    ];
    let drawable = |series: &Series| series.points.iter().any(|&(_, y)| y > 0.0 && y.is_finite());
    let figures = figures
        .into_iter()
        .filter(|(_, _, _, series, _)| series.iter().any(drawable));
    let figures = figures.map(|(name, title, y, series, caption)| Figure {
        name: name.into(),
        chart: Chart {
            title: title.into(),
            x: Axis::linear("time", "s"),
            y,
            series,
        },
        caption: caption.into(),
        headline: false,
    });
    figures.collect()
}

fn time_axis() -> Axis {
    Axis::logarithmic("time per simulated second", "s")
}

fn figure(
    trade: &Trade,
    name: &str,
    title: &str,
    x: Axis,
    series: Vec<Series>,
    caption: &str,
    headline: bool,
) -> Option<Figure> {
    let series: Vec<_> = series
        .into_iter()
        .filter(|series| !series.points.is_empty())
        .collect();
    let quantity = trade.facts.quantity;
    (!series.is_empty()).then(|| Figure {
        name: name.into(),
        chart: Chart {
            title: title.into(),
            x,
            y: Axis::logarithmic(format!("error of {}", quantity.name), quantity.unit),
            series,
        },
        caption: caption.into(),
        headline,
    })
}

fn curve(trade: &Trade, name: String, slot: usize, rows: &[&Row]) -> Series {
    let duration = trade.facts.span.end - trade.facts.span.start;
    let points = rows.iter().map(|row| (row.seconds / duration, row.error));
    line(name, slot, points.collect())
}

fn line(name: String, slot: usize, points: Vec<(f64, f64)>) -> Series {
    Series {
        name,
        slot,
        mark: Mark::Line,
        points,
    }
}
