//! Figure 15.2, and the pictures that the chapter could not have.

use super::outcome::{Instant, Outcome};
use crate::chart::{Axis, Chart, Mark, Series};
use crate::document::Figure;
use crate::pendulum::RigidPendulum;

/// The end of the pictures that show single swings (s): two periods.
const CLOSE_UP: f64 = 4.0;
/// The colours of curves that belong to no formulation.
const NEUTRAL: [usize; 2] = [4, 5];

/// Figure 15.2: the violation of the constraints over time.
#[must_use]
pub fn violation(outcomes: &[Outcome]) -> Figure {
    figure(
        "violation",
        "Figure 15.2. Violation of the constraints",
        Axis::logarithmic("ΦᵀΦ", "m² and 1"),
        curves(outcomes, |instant| instant.violation),
        "The sum of the squares of the five constraint equations, with the Euler parameters as integrated. Nothing holds \
         back the standard formulation; the other three pull the violation back to a level that the tolerance of the \
         integrator and their parameters set.",
    )
}

/// The error of the angle over time.
#[must_use]
pub fn angle(outcomes: &[Outcome]) -> Figure {
    figure(
        "angle",
        "Error of the angle",
        Axis::logarithmic("|φ − φ exact|", "rad"),
        curves(outcomes, |instant| instant.angle_error().abs()),
        "Angle from the Euler parameters against the closed form. A small violation does not mean a small error: the \
         constraints say nothing about where along its circle the rod is. The dips are the turning points, where an error of \
         phase does not show.",
    )
}

/// The drift of the energy over time.
#[must_use]
pub fn energy(outcomes: &[Outcome]) -> Figure {
    let series = outcomes.iter().map(|outcome| {
        let start = outcome.start_energy();
        curve(outcome, |instant| (instant.energy - start).abs())
    });
    figure(
        "energy",
        "Drift of the energy",
        Axis::logarithmic("|E − E at the start|", "J"),
        series.collect(),
        "Kinetic and potential energy, which the pendulum keeps.",
    )
}

/// The reaction of the pivot over the first swings, against the closed form.
#[must_use]
pub fn reaction(outcome: &Outcome) -> Figure {
    let exact = |part: fn(&Instant) -> f64| {
        let mut points = outcome.over_time(part);
        points.retain(|&(time, _)| time <= CLOSE_UP);
        points
    };
    // Every fifth report, so that the dots stand apart.
    let computed = |part: fn(&Instant) -> f64| exact(part).into_iter().step_by(5).collect();
    let series = |name: String, slot, mark, points| Series {
        name,
        slot,
        mark,
        points,
    };
    let method = outcome.method.name();
    figure(
        "reaction",
        "Reaction of the pivot",
        Axis::linear("force on the rod", "N"),
        vec![
            series(
                "radial, closed form".into(),
                NEUTRAL[0],
                Mark::Line,
                exact(|i| i.exact().radial),
            ),
            series(
                "transverse, closed form".into(),
                NEUTRAL[1],
                Mark::Line,
                exact(|i| i.exact().transverse),
            ),
            series(
                format!("radial, {method}"),
                0,
                Mark::Dots,
                computed(|i| i.reaction().0),
            ),
            series(
                format!("transverse, {method}"),
                2,
                Mark::Dots,
                computed(|i| i.reaction().1),
            ),
        ],
        "Radial from the centre of mass towards the pivot, transverse in the direction of growing φ.",
    )
}

/// The error of the radial reaction over time.
#[must_use]
pub fn radial(outcomes: &[Outcome]) -> Figure {
    figure(
        "radial",
        "Error of the radial reaction",
        Axis::logarithmic("|N − N exact|", "N"),
        curves(outcomes, |instant| instant.reaction_errors().0.abs()),
        &format!("The radial reaction reaches {:.1} N.", largest_radial()),
    )
}

/// The error of the transverse reaction over time.
#[must_use]
pub fn transverse(outcomes: &[Outcome]) -> Figure {
    let start = RigidPendulum::CHAPTER_15.at(0.0).transverse;
    figure(
        "transverse",
        "Error of the transverse reaction",
        Axis::logarithmic("|S − S exact|", "N"),
        curves(outcomes, |instant| instant.reaction_errors().1.abs()),
        &format!("The transverse reaction reaches {start:.1} N."),
    )
}

/// The radial reaction at the lowest point (N).
fn largest_radial() -> f64 {
    let pendulum = RigidPendulum::CHAPTER_15;
    pendulum.at(0.25 * pendulum.period()).radial
}

fn figure(name: &str, title: &str, y: Axis, series: Vec<Series>, caption: &str) -> Figure {
    let chart = Chart {
        title: title.into(),
        x: Axis::linear("time", "s"),
        y,
        series,
    };
    Figure {
        name: name.into(),
        chart,
        caption: caption.into(),
        headline: name == "violation",
    }
}

/// One curve per formulation, in a colour that stays the formulation's on the whole page.
fn curves(outcomes: &[Outcome], quantity: impl Fn(&Instant) -> f64) -> Vec<Series> {
    outcomes
        .iter()
        .map(|outcome| curve(outcome, &quantity))
        .collect()
}

fn curve(outcome: &Outcome, quantity: impl Fn(&Instant) -> f64) -> Series {
    Series {
        name: outcome.method.name().into(),
        slot: outcome.method as usize,
        mark: Mark::Line,
        points: outcome.over_time(quantity),
    }
}
