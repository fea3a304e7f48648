//! Limits of joints, and laws that switch: how near a state is to them, and impacts.

use std::f64::consts::TAU;

use holonom::mechanism::{AtTime, JointLimits, TracedCoordinates};
use holonom::state::Array as _;
use holonom::traced::{self as of_rust, LimitedJoint};
use holonom::{Mechanism, Scalar as _};

use crate::export::{CONSTANTS, Export, STATE, TIMES, argument, outputs, structure, written};
use crate::names::{Names, identifier};
use crate::number::{Precision, Traced};
use crate::program::{Argument, Function, Guard, Kind, Member, Output, Struct};
use crate::system::{StateOf, numbers};
use crate::tape::{Operation, Place, traced};

/// A joint with limits.
#[derive(Clone, Debug)]
pub(crate) struct Limited {
    limits: JointLimits<f64>,
    name: &'static str,
    /// Whether it is an angle of which a state counts no turns.
    is_up_to_turns: bool,
}

impl Limited {
    /// Whether it is not known how far it is from its limits: an angle that is told up to turns,
    /// whose limits are a turn or more apart by the numbers of the mechanism.
    pub(crate) fn is_unknown(&self) -> bool {
        let [lower, upper] = self.limits.bounds;
        // Also where one of them is no number.
        let is_narrow = upper - lower < TAU;
        self.is_up_to_turns && !is_narrow
    }

    pub(crate) fn name(&self) -> &'static str {
        self.name
    }
}

/// The numbers of a limit among the constants: both bounds and the restitution.
pub(crate) fn constants_of<P: Precision, M: Mechanism>(
    parameters: &M::Parameters<Traced<P>>,
) -> Vec<Traced<P>> {
    let all = M::limits_of(parameters, |limits| {
        let [lower, upper] = limits.bounds;
        [lower, upper, limits.restitution]
    });
    let all: &[[Traced<P>; 3]] = all.as_ref();
    all.iter().flatten().copied().collect()
}

/// The limits of a mechanism with parameters that were accepted.
pub(crate) fn limits_of<M: Mechanism>(parameters: &M::Parameters<f64>) -> Vec<Limited> {
    let all = M::limits_of(parameters, |limits| limits);
    let all: &[JointLimits<f64>] = all.as_ref();
    let constants = M::prepare(parameters);
    let bodies = M::initial_state(&constants);
    let named = |limits: &JointLimits<f64>| Limited {
        is_up_to_turns: of_rust::limited_joint::<_, M>(&constants, 0.0, &bodies, limits)
            .is_up_to_turns,
        limits: *limits,
        name: M::REPORT
            .joints
            .get(limits.joint)
            .map_or("", |joint| joint.name),
    };
    all.iter().map(named).collect()
}

/// A number that a function is given beside structs.
fn number(name: &'static str) -> Argument {
    Argument {
        name,
        kind: Kind::Number,
        is_output: false,
    }
}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// The limits with their numbers from the constants.
    fn limits(&self) -> Vec<JointLimits<Traced<P>>> {
        let first = self.constants.len() - 3 * self.limited.len();
        let limits = self.limited.iter().enumerate().map(|(k, of)| {
            let [lower, upper, restitution] =
                [0, 1, 2].map(|part| self.constant(0, first + 3 * k + part));
            JointLimits {
                joint: of.limits.joint,
                is_angle: of.limits.is_angle,
                bounds: [lower, upper],
                restitution,
            }
        });
        limits.collect()
    }

    /// The functions that say how near a state is to limits and to the switches of laws, and that
    /// of impacts.
    pub(crate) fn of_limits(&mut self) {
        if !self.limited.is_empty() {
            self.reading_gaps();
            self.impacts();
        }
        if !M::SWITCHES.is_empty() {
            self.reading_switches();
        }
    }

    /// Adds a function that writes a struct of a state.
    pub(crate) fn reading_struct(
        &mut self,
        [name, about]: [&'static str; 2],
        (function, about_function): (&str, &str),
        members: Vec<Member>,
        read: impl FnOnce(
            &Self,
            &M::Constants<Traced<P>>,
            Traced<P>,
            &M::State<Traced<P>>,
        ) -> Vec<Traced<P>>,
    ) {
        let place = self.program.structs.len();
        self.program.structs.push(Struct {
            name,
            about: about.to_owned(),
            members,
        });
        let (tape, places) = traced(P::IS_SINGLE, || {
            let (own, _, absolute) = self.constants_from(0);
            let (time, state) = self.state();
            let bodies = C::bodies_by_selection(&own, &state);
            let numbers = read(self, &absolute, time, &bodies);
            numbers.into_iter().map(Traced::place).collect::<Vec<_>>()
        });
        self.add(Function {
            name: function.to_owned(),
            about: about_function.to_owned(),
            arguments: vec![
                structure("constants", CONSTANTS),
                structure("state", STATE),
                written(name, place),
            ],
            outputs: outputs(2, places.into_iter()).collect(),
            tape,
            returned: None,
            is_public: true,
            is_checked: false,
            guard: None,
        });
    }

    fn reading_gaps(&mut self) {
        let mut names = Names::default();
        let mut members = Vec::new();
        for of in &self.limited {
            let (what, unit) = if of.limits.is_angle {
                ("angle", "rad")
            } else {
                ("displacement", "m")
            };
            let name = identifier(of.name);
            for (side, word) in [("lower", "above"), ("upper", "below")] {
                let about = format!(
                    "how far the {what} of {} is {word} its {side} limit ({unit})",
                    of.name
                );
                members.push(Member::number(
                    names.unique(&format!("{name}_{side}")),
                    about,
                ));
            }
            let about = format!("rate of the {what} of {} ({unit}/s)", of.name);
            members.push(Member::number(names.unique(&format!("{name}_rate")), about));
        }
        self.reading_struct(
            [
                "gaps",
                "Distances of joints to their limits, negative beyond them, and their rates.",
            ],
            (
                "get_gaps",
                "How far joints are from their limits in a state.",
            ),
            members,
            |export, constants, time, bodies| {
                let limits = export.limits();
                let gaps = limits.iter().flat_map(|limits| {
                    let joint = of_rust::limited_joint::<_, M>(constants, time, bodies, limits);
                    let [lower, upper] = joint.gaps(limits);
                    [lower, upper, joint.rate]
                });
                gaps.collect()
            },
        );
    }

    fn reading_switches(&mut self) {
        let mut names = Names::default();
        let members = M::SWITCHES.iter().map(|switch| {
            let name = names.unique(&identifier(switch.law));
            Member::number(
                name,
                format!("{} in the law of {}", switch.expression, switch.law),
            )
        });
        let members = members.collect();
        self.reading_struct(
            [
                "switches",
                "Expressions in laws whose signs decide: a law is smooth where none of them passes zero.",
            ],
            ("get_switches", "The expressions of laws that switch, in a state."),
            members,
            |_, constants, time, bodies| {
                let mut readings = M::Parameters::<Traced<P>>::zeros();
                M::switches_into(constants, time, bodies, &mut readings);
                let places = M::SWITCHES.iter().map(|switch| switch.place);
                let readings = readings.as_slice();
                let zero = Traced::zero();
                places.map(|place| readings.get(place).copied().unwrap_or(zero)).collect()
            },
        );
    }

    fn impacts(&mut self) {
        let given = self.before_state() + TIMES + self.elements.len();
        self.changing(
            "impact",
            "Turns back the rates of joints that are not farther inside a limit than `within` (rad, m) and approach it, by the restitution of the limit. Approaches slower than `rest` (rad/s, m/s) have none.",
            &["within", "rest"],
            |export, at, state| {
                let [within, rest] = [0, 1].map(|k| argument(given + k));
                let pivot = of_rust::impact(at, state, &export.limits(), [within, rest]);
                (Some(pivot), None)
            },
        );
    }

    /// Adds a function that changes a state, and is given further numbers. What changes it returns
    /// a pivot and a guard.
    pub(crate) fn changing(
        &mut self,
        name: &str,
        about: &str,
        further: &[&'static str],
        change: impl FnOnce(
            &Self,
            &AtTime<'_, Traced<P>, M, C>,
            &mut StateOf<P, M, C>,
        ) -> (Option<Traced<P>>, Option<(Traced<P>, Guard)>),
    ) {
        let first = self.before_state() + TIMES;
        let (tape, (conditions, places)) = traced(P::IS_SINGLE, || {
            let (own, coefficients, absolute) = self.constants_from(0);
            let (time, mut state) = self.state();
            let at = AtTime {
                own: &own,
                absolute: &absolute,
                coefficients: &coefficients,
                time,
            };
            let (pivot, guard) = change(self, &at, &mut state);
            let conditions = (
                pivot.map(Traced::place),
                guard.map(|(number, of)| (number.place(), of)),
            );
            let numbers = numbers(&state).into_iter();
            (
                conditions,
                numbers.map(Traced::place).collect::<Vec<Place>>(),
            )
        });
        let (returned, guard) = conditions;
        let mut arguments = vec![structure("constants", CONSTANTS), structure("state", STATE)];
        arguments.extend(further.iter().map(|name| number(name)));
        let last = arguments.len();
        arguments.push(written("state", STATE));
        let is_changed = |(k, place): (usize, Place)| {
            let before = Operation::Argument(u32::try_from(first + k).unwrap_or(u32::MAX));
            (tape.at(place) != before).then_some(Output {
                argument: last,
                number: TIMES + k,
                place,
            })
        };
        let outputs = places.into_iter().enumerate().filter_map(is_changed);
        let outputs = outputs.collect();
        self.add(Function {
            name: name.to_owned(),
            about: about.to_owned(),
            arguments,
            outputs,
            tape,
            returned,
            is_public: true,
            is_checked: true,
            guard,
        });
    }

    /// A number that is negative where a step passes a limit; `None` without limits.
    pub(crate) fn step_guard(
        &self,
        absolute: &M::Constants<Traced<P>>,
        times: [Traced<P>; 2],
        bodies: [&M::State<Traced<P>>; 2],
        step: Traced<P>,
    ) -> Option<Traced<P>> {
        let all = self.limits();
        let guards = all.iter().map(|limits| {
            let at = |end: usize| -> LimitedJoint<Traced<P>> {
                of_rust::limited_joint::<_, M>(absolute, times[end], bodies[end], limits)
            };
            let [before, after] = [at(0), at(1)];
            after.heeds(&before, step, limits)
        });
        guards.reduce(|one, other| one.min(other))
    }
}
