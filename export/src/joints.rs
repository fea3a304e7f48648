//! Functions of mechanisms in joint coordinates: what joints have, and kernels in their rates.

use holonom::mechanism::{
    Freedom, HasInverse, HasMassMatrix, JointMotion, JointReport, Relative, TracedCoordinates,
};
use holonom::state::{Array, MovingState as _, Vector as _};
use holonom::{JointCoordinates, Mechanism, Scalar};

use crate::constants::rigid;
use crate::error::ExportError;
use crate::export::{CONSTANTS, Export, STATE, TIMES, argument, outputs, structure, written};
use crate::interface::Turned;
use crate::layout::stem;
use crate::names::{Names, identifier};
use crate::number::{Precision, Traced};
use crate::program::{Argument, Function, Member, Output, Struct};
use crate::tape::traced;

/// Where the numbers of a motion are in a state.
struct Place {
    /// Of the cosine, or of the displacement.
    coordinate: usize,
    rate: usize,
}

/// An auxiliary variable: an angle over any number of turns, which is a sum of those of joints.
struct Counted {
    /// Its place in a state.
    place: usize,
    /// How much of each motion it has, as a state counts that.
    parts: Vec<f64>,
    /// What it is in the described configuration (rad).
    start: f64,
}

/// Positions and rates of the joints, of those motions that have one number.
fn members(report: &JointReport) -> Vec<Member> {
    let mut names = Names::default();
    let motions = report.motions.iter().filter(|motion| is_single(motion));
    let members = motions.flat_map(|motion| {
        let (name, unit) = (names.unique(&stem(report, motion)), motion.unit());
        let mover = [motion.joint, motion.body];
        let mover = mover.iter().find(|name| !name.is_empty()).unwrap_or(&"");
        let what = if motion.freedom == Freedom::Slide {
            "displacement"
        } else {
            "angle"
        };
        let rate = names.unique(&format!("{name}_rate"));
        [
            Member::number(name, format!("{what} of {mover} ({unit})")),
            Member::number(rate, format!("its rate ({unit}/s)")),
        ]
    });
    members.collect()
}

/// Whether a motion is an angle or a displacement.
fn is_single(motion: &JointMotion) -> bool {
    matches!(
        motion.freedom,
        Freedom::Turn { .. } | Freedom::Slide | Freedom::Screw { .. }
    )
}

/// `x` with the sign of the joint.
fn signed<S: Scalar>(motion: &JointMotion, x: S) -> S {
    if motion.is_reversed() { -x } else { x }
}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// The functions that read what joints have, and put it into a state. They are given the
    /// parameters of the mechanism.
    pub(crate) fn of_joints(&mut self, parameters: &M::Parameters<f64>) {
        let Some(report) = C::JOINTS else { return };
        let members = members(report);
        if members.is_empty() {
            return;
        }
        let joints = self.program.structs.len();
        self.program.structs.push(Struct {
            name: "joints",
            about: "Angles and displacements of the joints, with their signs, zero in the described configuration."
                .to_owned(),
            members,
        });
        self.reading_joints(report, joints);
        if let Some(counted) = self.counted(report, parameters) {
            self.setting_joints(report, joints, &counted);
            self.turned = self.turned_by_joints(report, &counted);
        }
    }

    /// The auxiliary variables that count angles as sums of those of joints; `None` where one is no
    /// such sum.
    fn counted(
        &self,
        report: &JointReport,
        parameters: &M::Parameters<f64>,
    ) -> Option<Vec<Counted>> {
        let screws = report
            .motions
            .iter()
            .filter_map(|motion| match motion.freedom {
                Freedom::Screw { counter, .. } => Some(counter),
                _ => None,
            });
        let screws: Vec<usize> = screws.collect();
        let counters = report.counters.iter();
        let others = counters.filter(|counter| !screws.contains(&counter.coordinate));
        let others: Vec<usize> = others.map(|counter| counter.coordinate).collect();
        if others.is_empty() {
            return Some(Vec::new());
        }
        if report.rewraps {
            return None;
        }
        let (own, _) = C::prepare(parameters, &rigid(), &Array::zeros());
        let mut state = C::State::<f64>::zeros();
        for (place, &number) in self.start.iter().enumerate() {
            state.set_element(place, number);
        }
        let all = others.into_iter().map(|counter| {
            let place = 2 * self.pairs() + counter;
            let parts = report.motions.iter().map(|motion| {
                let mut velocities = C::Velocities::<f64>::zeros();
                if let Some(velocity) = velocities.as_mut_slice().get_mut(motion.velocity) {
                    *velocity = 1.0;
                }
                C::way(&own, 0.0, &state, &velocities).element(place)
            });
            Counted {
                place,
                parts: parts.collect(),
                start: self.start[place],
            }
        });
        let all: Vec<Counted> = all.collect();
        // The angle of a ball is no sum.
        let is_sum = |of: &Counted| {
            let parts = of.parts.iter().zip(report.motions);
            parts
                .clone()
                .all(|(part, motion)| *part == 0.0 || is_single(motion))
        };
        all.iter().all(is_sum).then_some(all)
    }

    /// What counts turns, by the joints: as [`Self::setting_joints`] sets it.
    fn turned_by_joints(&self, report: &JointReport, counted: &[Counted]) -> Vec<Turned> {
        let pairs = self.pairs();
        let state = |motion: &JointMotion| match motion.freedom {
            Freedom::Slide => pairs + motion.coordinate,
            _ => motion.coordinate,
        };
        let sums = counted.iter().map(|of| {
            let mut parts = vec![0.0; report.motions.len()];
            for (motion, &part) in of.parts.iter().enumerate() {
                // With what carries its run, and what carries that.
                let against = |&place: &usize| report.motions.get(place)?.against;
                let run = std::iter::successors(Some(motion), against);
                for place in run.take(report.motions.len()) {
                    parts[place] += signed(&report.motions[place], part);
                }
            }
            let parts = report.motions.iter().zip(parts);
            let parts = parts.filter(|(_, part)| *part != 0.0);
            Turned {
                state: of.place - pairs,
                described: of.start,
                parts: parts.map(|(motion, part)| (state(motion), part)).collect(),
            }
        });
        // The counter of a screw is the joint's own angle.
        let screws = report.motions.iter().filter_map(|motion| {
            let Freedom::Screw { counter, .. } = motion.freedom else {
                return None;
            };
            Some(Turned {
                state: pairs + counter,
                described: 0.0,
                parts: vec![(motion.coordinate, 1.0)],
            })
        });
        screws.chain(sums).collect()
    }

    fn place(&self, report: &JointReport, motion: &JointMotion) -> Place {
        let pairs = self.pairs();
        let coordinate = match motion.freedom {
            Freedom::Slide | Freedom::Ball => 2 * pairs + motion.coordinate,
            Freedom::Screw { counter, .. } => 2 * pairs + counter,
            _ => 2 * motion.coordinate,
        };
        Place {
            coordinate,
            rate: self.first_rate(report) + motion.velocity,
        }
    }

    /// The place of the first velocity in a state.
    pub(crate) fn first_rate(&self, report: &JointReport) -> usize {
        self.elements.len() - rates(report)
    }

    fn reading_joints(&mut self, report: &JointReport, joints: usize) {
        let motions = report.motions.iter().filter(|motion| is_single(motion));
        let (tape, places) = traced(P::IS_SINGLE, || {
            let state = |place: usize| argument::<P>(TIMES + place);
            let since = |motion: &JointMotion| {
                let place = self.place(report, motion).coordinate;
                let (c, s) = (state(place), state(place + 1));
                let zero = Traced::<P>::constant(motion.zero);
                let (a, b) = (zero.cos(), zero.sin());
                [c * a + s * b, s * a - c * b]
            };
            let mut numbers = Vec::new();
            for motion in motions {
                let place = self.place(report, motion);
                let carrier = motion
                    .against
                    .and_then(|against| report.motions.get(against));
                let own = state(place.rate);
                let rate = match carrier {
                    Some(carrier) => own - state(self.place(report, carrier).rate),
                    None => own,
                };
                let position = if let Freedom::Turn { .. } = motion.freedom {
                    let [mut c, mut s] = since(motion);
                    if let Some(carrier) = carrier {
                        let [a, b] = since(carrier);
                        (c, s) = (c * a + s * b, s * a - c * b);
                    }
                    signed(motion, s.atan2(c))
                } else {
                    state(place.coordinate)
                };
                numbers.extend([position.place(), signed(motion, rate).place()]);
            }
            numbers
        });
        self.add(Function {
            name: "get_joints".to_owned(),
            about: "What the joints have in a state; angles from -pi to pi.".to_owned(),
            arguments: vec![structure("state", STATE), written("joints", joints)],
            outputs: outputs(1, places.into_iter()).collect(),
            tape,
            returned: None,
            is_public: true,
            is_checked: false,
            guard: None,
        });
    }

    fn setting_joints(&mut self, report: &JointReport, joints: usize, counted: &[Counted]) {
        let (tape, written_numbers) = traced(P::IS_SINGLE, || {
            // Of each motion: the angle since the reference configuration, and the rate, both
            // against what carries its run.
            let mut known: Vec<Option<[Traced<P>; 2]>> = vec![None; report.motions.len()];
            let mut numbers = Vec::new();
            let singles = report.motions.iter().enumerate();
            for (k, (number, motion)) in singles.filter(|(_, motion)| is_single(motion)).enumerate()
            {
                let [mut position, mut rate] =
                    [0, 1].map(|part| signed(motion, argument::<P>(2 * k + part)));
                if let Some([before, rate_before]) =
                    motion.against.and_then(|against| known[against])
                {
                    (position, rate) = (position + before, rate + rate_before);
                }
                known[number] = Some([position, rate]);
                let place = self.place(report, motion);
                if motion.freedom != Freedom::Slide {
                    let angle = position + Traced::constant(motion.zero);
                    let pair = 2 * motion.coordinate;
                    numbers.push((pair, angle.cos().place()));
                    numbers.push((pair + 1, angle.sin().place()));
                }
                match motion.freedom {
                    Freedom::Turn { .. } => {}
                    // The counter of a screw is the joint's own angle.
                    Freedom::Screw { .. } => {
                        let own = argument::<P>(2 * k);
                        numbers.push((place.coordinate, own.place()));
                    }
                    _ => numbers.push((place.coordinate, position.place())),
                }
                numbers.push((place.rate, rate.place()));
            }
            for counted in counted {
                let mut angle = Traced::<P>::constant(counted.start);
                for (known, &part) in known.iter().zip(&counted.parts) {
                    if let (Some([position, _]), true) = (known, part != 0.0) {
                        angle = Traced::constant(part) * *position + angle;
                    }
                }
                numbers.push((counted.place, angle.place()));
            }
            numbers
        });
        let output = |(number, place)| Output {
            argument: 1,
            number: TIMES + number,
            place,
        };
        self.add(Function {
            name: "set_joints".to_owned(),
            about: "Puts what the joints have into a state, angles over any number of turns; what it has of no joint stays."
                .to_owned(),
            arguments: vec![structure("joints", joints), written("state", STATE)],
            outputs: written_numbers.into_iter().map(output).collect(),
            tape,
            returned: None,
            is_public: true,
            is_checked: false,
            guard: None,
        });
    }

    /// Whether a step turns so few pairs that it goes on from pairs that are known.
    pub(crate) fn has_few_turns(&self) -> bool {
        self.pairs() <= if P::IS_SINGLE { 12 } else { 5 }
    }

    /// How many pairs a state has.
    pub(crate) fn pairs(&self) -> usize {
        let elements = self.elements.iter();
        elements
            .filter(|element| element.of_slope.is_none())
            .count()
    }
}

/// How many rates there are.
fn rates(report: &JointReport) -> usize {
    let count = |motion: &JointMotion| {
        if motion.freedom == Freedom::Ball {
            3
        } else {
            1
        }
    };
    report.motions.iter().map(count).sum()
}

/// A member for each rate of the joints.
fn by_rates(report: &JointReport, [of_turn, of_slide]: [&str; 2]) -> Vec<Member> {
    let mut names = Names::default();
    let members = report.motions.iter().flat_map(|motion| {
        let name = stem(report, motion);
        let unit = if motion.freedom == Freedom::Slide {
            of_slide
        } else {
            of_turn
        };
        let parts = if motion.freedom == Freedom::Ball {
            ["x", "y", "z"]
                .map(|axis| format!("{name}_{axis}"))
                .to_vec()
        } else {
            vec![name]
        };
        parts.into_iter().map(move |name| (name, unit))
    });
    let members =
        members.map(|(name, unit)| Member::number(names.unique(&identifier(&name)), unit));
    members.collect()
}

impl<M: JointCoordinates, P: Precision> Export<M, P, Relative> {
    /// The place of a struct with a number for each rate, which is made where it is not there.
    fn structure_by_rates(&mut self, name: &'static str, about: &str, of_each: [&str; 2]) -> usize {
        let known = self
            .program
            .structs
            .iter()
            .position(|known| known.name == name);
        known.unwrap_or_else(|| {
            self.program.structs.push(Struct {
                name,
                about: about.to_owned(),
                members: by_rates(&M::JOINT_REPORT, of_each),
            });
            self.program.structs.len() - 1
        })
    }

    /// Adds a function of the constants and a state, and of what else it is given, that writes a
    /// struct. The kernel takes the place of the first number of what else is given, and gives the
    /// numbers of the struct in their order.
    fn with_kernel(
        mut self,
        [name, about]: [&str; 2],
        given: Option<Argument>,
        gives: Argument,
        kernel: impl FnOnce(
            (
                &M::JointConstants<Traced<P>>,
                Traced<P>,
                &M::JointState<Traced<P>>,
            ),
            usize,
        ) -> Vec<Traced<P>>,
    ) -> Self {
        let (tape, numbers) = traced(P::IS_SINGLE, || {
            let (own, ..) = self.constants_from(0);
            let (time, state) = self.state();
            let first = self.before_state() + TIMES + self.elements.len();
            kernel((&own, time, &state), first)
        });
        let mut arguments = vec![structure("constants", CONSTANTS), structure("state", STATE)];
        arguments.extend(given);
        let places = numbers.into_iter().map(Traced::place);
        self.add(Function {
            name: name.to_owned(),
            about: about.to_owned(),
            outputs: outputs(arguments.len(), places).collect(),
            arguments: arguments.into_iter().chain([gives]).collect(),
            tape,
            returned: None,
            is_public: true,
            is_checked: false,
            guard: None,
        });
        self
    }

    /// The place of a new struct of one array, row by row.
    fn matrix(&mut self, name: &'static str, about: String, entries: usize) -> usize {
        self.program.structs.push(Struct {
            name,
            about,
            members: vec![Member::array("value", "row by row", entries)],
        });
        self.program.structs.len() - 1
    }

    /// Inverse dynamics: the efforts along the joints (N m, N) that have to act beside the
    /// described forces for these accelerations. In a mechanism with loops, those of its tree
    /// alone.
    #[must_use]
    pub fn inverse_dynamics(mut self) -> Self
    where
        M: HasInverse,
    {
        let about = "Accelerations of the rates of the joints.";
        let given = self.structure_by_rates("accelerations", about, ["rad/s^2", "m/s^2"]);
        let about = "Efforts along the joints.";
        let gives = self.structure_by_rates("efforts", about, ["N m", "N"]);
        self.with_kernel(
            [
                "inverse_dynamics",
                "The efforts that have to act beside the described forces.",
            ],
            Some(structure("accelerations", given)),
            written("efforts", gives),
            |(constants, time, state), first| {
                let mut accelerations = M::JointVelocities::<Traced<P>>::zeros();
                let places = accelerations.as_mut_slice().iter_mut().enumerate();
                places.for_each(|(k, place)| *place = argument(first + k));
                let efforts = M::inverse_dynamics(constants, time, state, &accelerations);
                efforts.as_slice().to_vec()
            },
        )
    }

    /// The mass matrix in the rates of the joints, row by row; in a mechanism with loops, that of
    /// its tree.
    #[must_use]
    pub fn mass_matrix(mut self) -> Self
    where
        M: HasMassMatrix,
    {
        let count = rates(&M::JOINT_REPORT);
        let about = "The mass matrix in the rates of the joints.".to_owned();
        let matrix = self.matrix("mass", about, count * count);
        self.with_kernel(
            ["mass_matrix", "The mass matrix in a state."],
            None,
            written("mass", matrix),
            |(constants, time, state), _| {
                let matrix = M::mass_matrix(constants, time, state);
                matrix.as_slice().to_vec()
            },
        )
    }

    /// Derivatives of the accelerations of the joints' rates: by the positions of the joints, by
    /// their rates, by efforts along them, by inputs and by the parameters that are named, of a
    /// mechanism with `kernels = [derivatives]`. It has fewer operations than
    /// [`Export::derivatives`], whose rows and columns are the numbers of a state.
    ///
    /// In a mechanism with loops, positions and rates are taken as if they could change one by one.
    #[must_use]
    pub fn joint_derivatives(mut self) -> Self {
        let Some(values) = M::DERIVED_BY else {
            return self.refused(ExportError::Kernel {
                kernel: "derivatives",
            });
        };
        let rates = by_rates(&M::JOINT_REPORT, ["", ""]);
        let (rows, columns) = (rates.len(), 3 * rates.len() + values.len());
        let names: Vec<&str> = rates.iter().map(|rate| rate.name.as_str()).collect();
        let values = values.iter();
        let values = values.filter_map(|&value| Some(M::REPORT.values.get(value)?.name));
        let values: Vec<&str> = values.collect();
        let about = format!(
            "Derivatives of the accelerations of {}, a row each. Columns: by the positions of these, by their rates, by efforts along them, and by the values {}.",
            names.join(", "),
            values.join(", ")
        );
        let jacobian = self.matrix("joint_jacobian", about, rows * columns);
        self.with_kernel(
            [
                "joint_derivatives",
                "Derivatives of the accelerations of the joints in a state.",
            ],
            None,
            written("jacobian", jacobian),
            |(constants, time, state), _| {
                // Columns stand one after the other, behind the accelerations. Left out are those
                // by the user's own states, and the rates of these.
                let states = M::JOINT_REPORT.states.len();
                let places = (0..columns).map(|column| match column {
                    column if column < 2 * rows => column,
                    column => column + states,
                });
                let places: Vec<usize> = places.collect();
                let numbers = M::derivatives(constants, time, state);
                let numbers = numbers.as_slice();
                let entries = (0..rows).flat_map(|row| {
                    let at = move |&place: &usize| {
                        numbers.get((rows + states) * (1 + place) + row).copied()
                    };
                    places.iter().filter_map(at)
                });
                entries.collect()
            },
        )
    }
}
