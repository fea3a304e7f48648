//! The tables that the chapter prints.

use super::by_method;
use crate::chapter15::Settings;
use crate::chapter15::outcome::Outcome;
use crate::document::Table;
use crate::format::{fixed, scientific};
use crate::pendulum::RigidPendulum;

/// Table 15.1: the data of the pendulum.
#[must_use]
pub fn data() -> Table {
    let pendulum = RigidPendulum::CHAPTER_15;
    let about_axis = pendulum.inertia - pendulum.mass * pendulum.distance.powi(2);
    let rows = [
        ("mass", fixed(pendulum.mass, 2), "kg"),
        (
            "moments of inertia about the centre of mass, across the rod",
            fixed(about_axis, 7),
            "kg m²",
        ),
        (
            "moment of inertia along the rod",
            fixed(0.001_053, 7),
            "kg m²",
        ),
        (
            "from the pivot to the centre of mass",
            fixed(pendulum.distance, 1),
            "m",
        ),
        ("gravity, along −z", fixed(pendulum.gravity, 2), "m/s²"),
        (
            "angle from the downward vertical at the start, at rest",
            fixed(90.0, 0),
            "°",
        ),
        (
            "period of the swing, closed form",
            fixed(pendulum.period(), 9),
            "s",
        ),
    ];
    Table {
        caption: "Table 15.1. The rod pendulum.".into(),
        columns: ["quantity", "value", "unit"].map(Into::into).into(),
        rows: rows.map(|(what, value, unit)| vec![what.into(), value, unit.into()]).into(),
        note: "One body of seven coordinates, position and Euler parameters; one revolute joint about x of five \
               equations; one degree of freedom. The rod starts along +y."
            .into(),
    }
}

/// Table 15.2: the parameters of the simulation.
#[must_use]
pub fn parameters(settings: &Settings) -> Table {
    let (alpha, beta) = settings.baumgarte;
    let (penalty, omega, mu) = settings.penalty;
    let rows = [
        ("simulated time", fixed(settings.end, 0), "s"),
        ("time between reports", fixed(settings.reporting, 2), "s"),
        ("relative tolerance", scientific(settings.relative, 0), "1"),
        (
            "absolute tolerance",
            scientific(settings.absolute, 0),
            "m, m/s, rad/s, 1",
        ),
        ("Baumgarte α", fixed(alpha, 0), "1/s"),
        ("Baumgarte β", fixed(beta, 0), "1/s"),
        (
            "penalty and augmented Lagrangian α",
            scientific(penalty, 0),
            "kg, kg m²",
        ),
        ("penalty and augmented Lagrangian ω", fixed(omega, 0), "1/s"),
        ("penalty and augmented Lagrangian μ", fixed(mu, 0), "1"),
        (
            "augmented Lagrangian: change of the accelerations at which it stops",
            scientific(settings.iteration_tolerance, 0),
            "of 1 + |u′|",
        ),
    ];
    Table {
        caption: "Table 15.2. The parameters of the simulation.".into(),
        columns: ["parameter", "value", "unit"].map(Into::into).into(),
        rows: rows.map(|(what, value, unit)| vec![what.into(), value, unit.into()]).into(),
        note: "The integrator is Dormand-Prince 5(4) with the step control and the dense output of MATLAB’s ode45. \
               The chapter does not print when its augmented Lagrangian iteration stops; that value is ours."
            .into(),
    }
}

/// Table 15.3: function evaluations and time, as published and here.
#[must_use]
pub fn evaluations(outcomes: &[Outcome]) -> Table {
    by_method(
        "Table 15.3. Function evaluations and computation time.",
        &[
            "evaluations, published",
            "evaluations, here",
            "difference",
            "time, published (s)",
            "time, here (ms)",
        ],
        outcomes,
        |outcome| {
            let published = outcome.method.published();
            let difference = outcome.evaluations as f64 / published.evaluations as f64 - 1.0;
            vec![
                published.evaluations.to_string(),
                outcome.evaluations.to_string(),
                format!("{} %", fixed(100.0 * difference, 1)),
                fixed(published.seconds, 1),
                fixed(1e3 * outcome.run_time(), 3),
            ]
        },
        "An evaluation is one solution of the equations of motion. ode45 counts one at the start and six for every step \
         it tries. The published times were measured on a computer of that time: compare them down the column, not \
         across.",
    )
}
