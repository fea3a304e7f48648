//! Joints that are open: those of closed loops, or all of them in absolute coordinates.
//!
//! A start is accepted where a run in Rust accepts it. What is small is small beside the length of
//! the mechanism and the units of its equations, as they are at the described start.

use holonom::mechanism::{BodyKind, TracedCoordinates};
use holonom::state::Array as _;
use holonom::traced::{StartRow, start_rows};
use holonom::{Mechanism, Real, Scalar as _, StateParts as _};

use crate::export::{CONSTANTS, Export, STATE, structure};
use crate::names::{Names, identifier};
use crate::number::{Precision, Traced};
use crate::program::{Function, Guard, Member};
use crate::tape::traced;

/// Equations of a joint that are all lengths, or all angles.
#[derive(Clone, Debug)]
pub(crate) struct Opening {
    /// The field of the joint.
    pub(crate) joint: &'static str,
    pub(crate) is_length: bool,
    /// The violation that a start may have (m, rad).
    pub(crate) accepted: f64,
    /// The same of its rate, for slow motions (m/s, rad/s).
    accepted_rate: f64,
    /// Places among the equations of all joints, and by what a violation becomes metres or radians.
    rows: Vec<(usize, f64)>,
}

/// What may be open, and what that is beside.
#[derive(Clone, Debug, Default)]
pub(crate) struct Openings {
    pub(crate) all: Vec<Opening>,
    /// The length of the mechanism (m).
    length: f64,
}

impl Openings {
    /// The equations that these coordinates do not satisfy by themselves. None where one of them is
    /// no equation of the bodies, so that its violation is not known.
    pub(crate) fn of<S: Real, M: Mechanism, C: TracedCoordinates<M>>(
        constants: &M::Constants<S>,
        bodies: &M::State<S>,
    ) -> Self {
        let mut rows: Vec<StartRow<S>> = Vec::new();
        let length = start_rows::<S, M>(constants, S::zero(), bodies, |row| rows.push(row));
        let count = C::Multipliers::<f64>::zeros().as_slice().len();
        let places: Option<Vec<usize>> = (0..count).map(C::row_of_all).collect();
        let mut all: Vec<Opening> = Vec::new();
        for place in places.unwrap_or_default() {
            let mut joints = M::REPORT.joints.iter();
            let joint = joints.find(|joint| (joint.row..joint.row + joint.rows).contains(&place));
            let (Some(joint), Some(row)) = (joint, rows.get(place)) else {
                continue;
            };
            let own = (place, row.factor.to_f64());
            let is_same =
                |of: &&mut Opening| of.joint == joint.name && of.is_length == row.is_length;
            match all.iter_mut().find(is_same) {
                Some(known) => known.rows.push(own),
                None => all.push(Opening {
                    joint: joint.name,
                    is_length: row.is_length,
                    accepted: row.accepted.to_f64(),
                    accepted_rate: row.accepted_rate.to_f64(),
                    rows: vec![own],
                }),
            }
        }
        Self {
            all,
            length: length.to_f64(),
        }
    }
}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// The functions that say how far joints are open, and whether a start is accepted.
    pub(crate) fn of_openings(&mut self) {
        if self.openings.all.is_empty() {
            return;
        }
        let mut names = Names::default();
        let mut members = Vec::new();
        for of in &self.openings.all {
            let (unit, suffix) = if of.is_length {
                ("m", "")
            } else {
                ("rad", "_angle")
            };
            let name = format!("{}{suffix}", identifier(of.joint));
            for (name, about) in [
                (
                    name.clone(),
                    format!("by how much {} is open ({unit})", of.joint),
                ),
                (
                    format!("{name}_rate"),
                    format!(
                        "how fast the bodies of {} move against it ({unit}/s)",
                        of.joint
                    ),
                ),
            ] {
                members.push(Member::number(names.unique(&name), about));
            }
        }
        self.reading_struct(
            [
                "openings",
                "By how much joints are open that the coordinates do not keep closed, and how fast they open.",
            ],
            ("get_openings", "How far joints are open in a state."),
            members,
            |export, constants, time, bodies| {
                let all = export.openings.violations::<P, M>(constants, time, bodies);
                all.iter().flatten().map(|sizes| largest(sizes)).collect()
            },
        );
        let (tape, guard) = traced(P::IS_SINGLE, || {
            let (own, _, absolute) = self.constants_from(0);
            let (time, state) = self.state();
            let bodies = C::bodies_by_selection(&own, &state);
            let openings = &self.openings;
            let violations = openings.violations::<P, M>(&absolute, time, &bodies);
            let one = Traced::<P>::one();
            let fastest = openings.fastest::<P, M>(&bodies);
            let fastest = fastest.select(one, one, fastest);
            let mut beyond = Traced::zero();
            for (of, sizes) in openings.all.iter().zip(violations) {
                let accepted_rate = Traced::constant(of.accepted_rate) * fastest;
                let accepted = [Traced::constant(of.accepted), accepted_rate];
                for (sizes, accepted) in sizes.iter().zip(accepted) {
                    for &size in sizes {
                        let over = size - accepted;
                        // What is no number stays none.
                        beyond = beyond + over.select(Traced::zero(), Traced::zero(), over);
                    }
                }
            }
            (-beyond).place()
        });
        self.add(Function {
            name: "check_joints".to_owned(),
            about: "Whether a run could begin in a state: a joint that is open by more than a ten-thousandth of the length of the mechanism, or of a radian, is OPEN; so is one that opens as fast, in a second and beside the velocities."
                .to_owned(),
            arguments: vec![structure("constants", CONSTANTS), structure("state", STATE)],
            outputs: Vec::new(),
            tape,
            returned: None,
            is_public: true,
            is_checked: true,
            guard: Some((guard, Guard::Closed)),
        });
    }
}

/// The largest of some numbers.
fn largest<P: Precision>(sizes: &[Traced<P>]) -> Traced<P> {
    let sizes = sizes.iter();
    sizes.fold(Traced::zero(), |most, &size| size.select(most, most, size))
}

impl Openings {
    /// What the equations of each are violated by, and their rates.
    fn violations<P: Precision, M: Mechanism>(
        &self,
        constants: &M::Constants<Traced<P>>,
        time: Traced<P>,
        bodies: &M::State<Traced<P>>,
    ) -> Vec<[Vec<Traced<P>>; 2]> {
        let phi = M::constraints(constants, time, bodies);
        let rates = M::constraint_rates(constants, time, bodies);
        let sizes = |of: &Opening, numbers: &[Traced<P>]| {
            let rows = of.rows.iter();
            let sizes = rows.filter_map(|&(place, factor)| {
                Some(numbers.get(place)?.abs() * Traced::constant(factor))
            });
            sizes.collect()
        };
        let all = self.all.iter();
        let both = |of| [phi.as_slice(), rates.as_slice()].map(|numbers| sizes(of, numbers));
        all.map(both).collect()
    }

    /// The largest velocity of a body, in lengths of the mechanism and in radians a second.
    fn fastest<P: Precision, M: Mechanism>(&self, bodies: &M::State<Traced<P>>) -> Traced<P> {
        let velocities = bodies.velocities().as_slice();
        let size = |first: usize, unit: f64| {
            let parts = velocities.get(first..first + 3).unwrap_or(&[]).iter();
            let sum = parts.fold(Traced::<P>::zero(), |sum, &part| part.fused(part, sum));
            sum.sqrt() * Traced::constant(unit.recip())
        };
        let sizes = M::REPORT.bodies.iter().flat_map(|body| {
            let turning = (body.kind == BodyKind::Rigid).then(|| size(body.velocity + 3, 1.0));
            [size(body.velocity, self.length)]
                .into_iter()
                .chain(turning)
        });
        largest(&sizes.collect::<Vec<_>>())
    }
}
