//! What `study ensemble` draws and reads.

use std::path::Path;

use holonom::prelude::*;
use holonom_study::StudyError;
use holonom_study::ensemble::rand_chacha::ChaCha8Rng;
use holonom_study::ensemble::{Draw, Rows, Steps, Table, resume};
use rand::RngExt as _;

/// A model of which rows are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// [`Pendulum`].
    Pendulum,
    /// [`CrankRocker`].
    FourBar,
}

/// Ten seconds, read ten times a second.
const STEPS: Steps = Steps {
    step: 0.01,
    count: 1000,
    every: 10,
};

/// A uniform rod on a hinge with damping, from an angle at rest.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Pendulum {
    /// The length of the rod (m).
    #[param]
    pub length: f64,
    /// Its mass (kg).
    #[param]
    pub mass: f64,
    /// The damping of the hinge (N m s/rad).
    #[param]
    pub damping: f64,
    #[body(
        mass = mass,
        inertia = [mass * length * length / 12.0, 1e-3, mass * length * length / 12.0],
        position = [0.0, 0.0, -0.5 * length]
    )]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = -damping * rate)]
    friction: TorsionalActuator,
}

/// A four-bar whose crank goes round: links of 0.3, 0.9 and 0.7 m on feet that are 1 m apart, in
/// the plane of x and y, gravity along -y. The crank is upright at the start.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "joints")]
pub struct CrankRocker {
    /// The mass of the coupler (kg).
    #[param]
    pub mass: f64,
    /// The damping of the crank's hinge (N m s/rad).
    #[param]
    pub damping: f64,
    /// The moment on the crank (N m).
    #[input]
    pub torque: f64,
    #[body(mass = 2.0, inertia = [0.02, 0.02, 0.02], position = [0.0, 0.15, 0.0])]
    crank: Body,
    #[body(
        mass = mass,
        inertia = [0.07 * mass, 0.07 * mass, 0.07 * mass],
        position = [0.5 * 0.817_758_268_961_135_7, 0.15 + 0.5 * 0.675_860_896_537_119, 0.0]
    )]
    coupler: Body,
    #[body(
        mass = 1.0,
        inertia = [0.04, 0.04, 0.04],
        position = [0.5 + 0.5 * 0.817_758_268_961_135_7, 0.5 * 0.675_860_896_537_119, 0.0]
    )]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    foot: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.3, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [coupler, rocker], point = [0.817_758_268_961_135_7, 0.675_860_896_537_119, 0.0], axis = [0.0, 0.0, 1.0])]
    knee: Revolute,
    #[joint(between = [ground, rocker], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hip: Revolute,
    #[force(between = [ground, crank], axis = [0.0, 0.0, 1.0], moment = torque - damping * rate)]
    motor: TorsionalActuator,
}

/// The rows of a shard, each in a journal as soon as it is done; `done` is told how many further
/// ones are done.
///
/// # Errors
/// What [`resume`] refuses.
pub fn table(
    model: Model,
    rows: &Rows,
    journal: &Path,
    done: impl Fn(u64) + Sync,
) -> Result<Table, StudyError> {
    match model {
        Model::Pendulum => {
            let method = (StandardLagrange, Rk4, STEPS);
            let drawn = ["length", "mass", "damping", "angle"];
            let names = (drawn, ["angle_at_end", "highest_angle"]);
            resume(rows, journal, names, method, pendulum, swing, done)
        }
        Model::FourBar => {
            let method = (Baumgarte::default(), Rk4, STEPS);
            let drawn = ["mass", "damping", "torque"];
            let read = ["crank_rate_at_end", "highest_crank_rate", "violation"];
            resume(
                rows,
                journal,
                (drawn, read),
                method,
                crank_rocker,
                turn,
                done,
            )
        }
    }
}

fn pendulum(generator: &mut ChaCha8Rng) -> Result<Draw<Pendulum, 4>, ParameterError> {
    let length = generator.random_range(0.5..2.0);
    let mass = generator.random_range(0.5..3.0);
    let damping = generator.random_range(0.0..0.2);
    let angle: f64 = generator.random_range(-3.0..3.0);
    let mechanism = Pendulum::new(length, mass, damping)?;
    let mut start = mechanism.described_state()?;
    let pose = holonom::Pose {
        position: [0.0, 0.5 * length * angle.sin(), -0.5 * length * angle.cos()].into(),
        orientation: [(0.5 * angle).sin(), 0.0, 0.0, (0.5 * angle).cos()].into(),
    };
    Pendulum::set_pose(&mut start, Pendulum::HANDLES.rod, pose);
    Ok(Draw {
        mechanism,
        start: Some(start),
        columns: [length, mass, damping, angle],
    })
}

fn swing(readings: &mut [f64; 2], view: &View<'_, f64, Pendulum>) {
    let angle = view.angle(Pendulum::HANDLES.hinge);
    *readings = [angle, readings[1].max(angle.abs())];
}

fn crank_rocker(generator: &mut ChaCha8Rng) -> Result<Draw<CrankRocker, 3>, ParameterError> {
    let mass = generator.random_range(0.5..2.0);
    let damping = generator.random_range(0.5..2.0);
    let torque = generator.random_range(5.0..20.0);
    let mut mechanism = CrankRocker::new(mass, damping)?;
    mechanism.torque = torque;
    Ok(Draw {
        mechanism,
        start: None,
        columns: [mass, damping, torque],
    })
}

fn turn(readings: &mut [f64; 3], view: &View<'_, f64, CrankRocker>) {
    let rate = view.angle_rate(CrankRocker::HANDLES.foot);
    *readings = [
        rate,
        readings[1].max(rate.abs()),
        readings[2].max(view.violation()),
    ];
}
