//! What the numbers of a state are, by name.

use holonom::mechanism::{BodyKind, Freedom, JointMotion, JointReport, TracedCoordinates};
use holonom::{Mechanism, Report};

use crate::names::{Names, identifier};
use crate::program::Member;

/// A number of a state, and the same of its slope.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) of_state: Member,
    /// `None` where the slope has no number of its own.
    pub(crate) of_slope: Option<Member>,
}

/// Names as they are found, before two of them are told apart.
struct Found {
    state: (String, String),
    slope: Option<(String, String)>,
}

impl Found {
    fn new(
        name: impl Into<String>,
        about: impl Into<String>,
        slope: impl Into<String>,
        about_slope: impl Into<String>,
    ) -> Self {
        Self {
            state: (name.into(), about.into()),
            slope: Some((slope.into(), about_slope.into())),
        }
    }
}

/// The numbers of a state in the order in which they are moved.
pub(crate) fn of_state<M: Mechanism, C: TracedCoordinates<M>>(
    pairs: usize,
    rest: usize,
    rates: usize,
) -> Vec<Element> {
    let found = match C::JOINTS {
        Some(report) => of_joints(report, [pairs, rest, rates]),
        None => of_bodies(&M::REPORT),
    };
    let (mut of_state, mut of_slope) = (Names::default(), Names::default());
    for own in ["time", "time_rest"] {
        of_state.unique(own);
    }
    let element = |found: Found| {
        let (name, about) = found.state;
        Element {
            of_state: Member::number(of_state.unique(&name), about),
            of_slope: found
                .slope
                .map(|(name, about)| Member::number(of_slope.unique(&name), about)),
        }
    };
    found.into_iter().map(element).collect()
}

/// The field whose motion it is, with a number where a field has several of a kind.
pub(crate) fn stem(report: &JointReport, motion: &JointMotion) -> String {
    let mover = |motion: &JointMotion| {
        if motion.joint.is_empty() {
            motion.body
        } else {
            motion.joint
        }
    };
    let kind = |motion: &JointMotion| {
        (
            mover(motion),
            matches!(motion.freedom, Freedom::Slide),
            matches!(motion.freedom, Freedom::Ball),
        )
    };
    let alike = report
        .motions
        .iter()
        .filter(|other| kind(other) == kind(motion));
    let name = identifier(mover(motion));
    if alike.count() < 2 {
        return name;
    }
    let before = report.motions.iter().take_while(|other| *other != motion);
    let number = before.filter(|other| kind(other) == kind(motion)).count() + 1;
    format!("{name}_{number}")
}

/// What an angle is measured against, in words.
fn against(report: &JointReport, motion: &JointMotion) -> String {
    let carrier = motion
        .against
        .and_then(|against| report.motions.get(against));
    let sum = carrier.map_or_else(String::new, |carrier| {
        format!(
            ", added to that of {} (parallel axes)",
            stem(report, carrier)
        )
    });
    let reversed = if motion.is_reversed() {
        ", counted against the joint's"
    } else {
        ""
    };
    format!("{sum}{reversed}")
}

fn of_joints(report: &JointReport, [pairs, rest, rates]: [usize; 3]) -> Vec<Found> {
    let unnamed = |kind: &str, count: usize| {
        let names = (0..count).map(|k| {
            let name = format!("{kind}_{k}");
            Found::new(
                &name,
                "a number of the state",
                format!("{name}_rate"),
                "its rate",
            )
        });
        names.collect::<Vec<_>>()
    };
    let [mut turns, mut further, mut speeds] =
        [("pair", 2 * pairs), ("rest", rest), ("rate", rates)]
            .map(|(kind, count)| unnamed(kind, count));
    let put = |list: &mut Vec<Found>, place: usize, found: Found| {
        if let Some(at) = list.get_mut(place) {
            *at = found;
        }
    };
    for motion in report.motions {
        let (stem, sum) = (stem(report, motion), against(report, motion));
        let (place, velocity) = (motion.coordinate, motion.velocity);
        match motion.freedom {
            Freedom::Slide => {
                let position = format!("displacement of {stem} (m)");
                let speed = format!("its rate (m/s){sum}");
                let found = Found::new(
                    format!("{stem}_position"),
                    position,
                    format!("{stem}_speed"),
                    speed,
                );
                put(&mut further, place, found);
                put(&mut speeds, velocity, rate(&stem, "m/s"));
            }
            Freedom::Ball => {
                for k in 0..4 {
                    let about =
                        format!("Euler parameter {k} of {stem}, from principal to global axes");
                    let name = format!("{stem}_e{k}");
                    let found = Found::new(&name, about, format!("{name}_rate"), "its rate (1/s)");
                    put(&mut further, place + k, found);
                }
                for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                    let name = format!("{stem}_w{axis}");
                    let about = format!("angular velocity along the principal axis {axis} (rad/s)");
                    let acceleration = format!("{stem}_w{axis}_rate");
                    let found = Found::new(name, about, acceleration, "its rate (rad/s^2)");
                    put(&mut speeds, velocity + k, found);
                }
            }
            Freedom::Turn { .. } | Freedom::Screw { .. } | _ => {
                let cosine = format!("cosine of the angle of {stem}{sum}");
                let turning = format!("rate of the angle of {stem} (rad/s){sum}");
                let found = Found::new(
                    format!("{stem}_cos"),
                    cosine,
                    format!("{stem}_turning"),
                    turning,
                );
                put(&mut turns, 2 * place, found);
                let sine = (format!("{stem}_sin"), "its sine".to_owned());
                put(
                    &mut turns,
                    2 * place + 1,
                    Found {
                        state: sine,
                        slope: None,
                    },
                );
                put(&mut speeds, velocity, rate(&stem, "rad/s"));
            }
        }
    }
    for counter in report.counters {
        let name = format!("{}_turned", identifier(counter.element));
        let about = format!("angle of {} over all turns (rad)", counter.element);
        let found = Found::new(&name, about, format!("{name}_rate"), "its rate (rad/s)");
        put(&mut further, counter.coordinate, found);
    }
    for own in report.states {
        put(&mut further, own.coordinate, of_own(own.name));
    }
    turns.append(&mut further);
    turns.append(&mut speeds);
    turns
}

/// The rate of a motion, and its acceleration.
fn rate(stem: &str, unit: &str) -> Found {
    Found::new(
        format!("{stem}_rate"),
        format!("rate of {stem} ({unit})"),
        format!("{stem}_acceleration"),
        format!("its rate ({unit}^2)"),
    )
}

/// A state of the user's own.
fn of_own(name: &str) -> Found {
    let rate = format!("{}_rate", identifier(name));
    Found::new(
        identifier(name),
        format!("the state {name}"),
        rate,
        "its rate",
    )
}

fn of_bodies(report: &Report) -> Vec<Found> {
    let (mut coordinates, mut velocities) = (Vec::new(), Vec::new());
    for body in report.bodies {
        let name = identifier(body.name);
        for axis in ["x", "y", "z"] {
            coordinates.push(Found::new(
                format!("{name}_{axis}"),
                format!("centre of mass of {} along {axis} (m, global)", body.name),
                format!("{name}_{axis}_rate"),
                "its rate (m/s)",
            ));
            velocities.push(Found::new(
                format!("{name}_v{axis}"),
                format!("its velocity along {axis} (m/s, global)"),
                format!("{name}_v{axis}_rate"),
                "acceleration (m/s^2)",
            ));
        }
        if body.kind != BodyKind::Rigid {
            continue;
        }
        for k in 0..4 {
            coordinates.push(Found::new(
                format!("{name}_e{k}"),
                format!(
                    "Euler parameter {k} of {}, from principal to global axes",
                    body.name
                ),
                format!("{name}_e{k}_rate"),
                "its rate (1/s)",
            ));
        }
        for axis in ["x", "y", "z"] {
            velocities.push(Found::new(
                format!("{name}_w{axis}"),
                format!("angular velocity along the principal axis {axis} (rad/s)"),
                format!("{name}_w{axis}_rate"),
                "its rate (rad/s^2)",
            ));
        }
    }
    let joints = report
        .joints
        .iter()
        .map(|joint| (joint.name, joint.auxiliary, joint.auxiliaries));
    let forces = report
        .forces
        .iter()
        .map(|force| (force.name, force.auxiliary, force.auxiliaries));
    let mut counted: Vec<_> = joints
        .chain(forces)
        .filter(|(.., count)| *count > 0)
        .collect();
    counted.sort_by_key(|(_, first, _)| *first);
    for (name, _, count) in counted {
        for _ in 0..count {
            let element = format!("{}_turned", identifier(name));
            let about = format!("angle of {name} over all turns (rad)");
            let rate = format!("{element}_rate");
            coordinates.push(Found::new(element, about, rate, "its rate (rad/s)"));
        }
    }
    coordinates.extend(report.states.iter().map(|own| of_own(own.name)));
    coordinates.append(&mut velocities);
    coordinates
}
