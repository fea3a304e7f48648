//! The scenes for the run-time assembler.

#![cfg_attr(
    not(feature = "large"),
    allow(dead_code, reason = "most scenes stand behind the feature")
)]

#[cfg(any(feature = "large", test))]
mod catalogue;

use std::hint::black_box;

use holonom::error::StepFault;
use holonom::{
    Fault, Mechanism, MechanismExt as _, StateParts as _, error::NotFinite, state::Array as _,
};
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{Body, BodyId, GROUND};
use holonom_assembler::formulation::{Evaluator, SolveError};
use holonom_assembler::joints::Joint;
use holonom_assembler::schur::SchurEvaluator;
use holonom_models::RodPendulum;
use holonom_study::chapter15::{Method, Settings};
use holonom_study::compare::measure::candidate;
use holonom_study::compare::run::Baseline;
use holonom_study::timing::Candidate;

#[cfg(feature = "large")]
pub(super) use catalogue::{cart_pole, heavy_top, panda, slider_crank, squeezer, ur5};

use crate::baselines::formulation;

/// What joins two bodies of a scene: a point and an axis where it has one, global at the reference
/// configuration.
#[derive(Clone, Copy, Debug)]
enum Join {
    Hinge([f64; 3], [f64; 3]),
    Ball([f64; 3]),
    Slider([f64; 3], [f64; 3]),
    OnLine([f64; 3], [f64; 3]),
}

/// The bodies of a mechanism as it describes them, with joints: what they are between, places among
/// the fields for bodies, `None` for the ground.
fn scene<M: Mechanism + Default>(
    gravity: [f64; 3],
    joints: impl IntoIterator<Item = ([Option<usize>; 2], Join)>,
) -> Assembler {
    let mut scene = Assembler::new(gravity);
    let bodies = add_bodies::<M>(&mut scene);
    join(&mut scene, &bodies, joints);
    scene
}

/// Adds joints between bodies by their places.
fn join(
    scene: &mut Assembler,
    bodies: &[BodyId],
    joints: impl IntoIterator<Item = ([Option<usize>; 2], Join)>,
) {
    for (between, join) in joints {
        let between = between.map(|body| body.map_or(GROUND, |body| bodies[body]));
        let joint = match join {
            Join::Hinge(point, axis) => Joint::revolute(scene, between, point, axis),
            Join::Ball(point) => Joint::spherical(scene, between, point),
            Join::Slider(point, axis) => Joint::prismatic(scene, between, point, axis),
            Join::OnLine(point, axis) => Joint::point_on_line(scene, between, point, axis),
        };
        scene.add_joint(joint);
    }
}

/// Adds the bodies of a mechanism, all rigid, in the order of the fields. Mass and moments of
/// inertia are twice the kinetic energies at unit velocities.
fn add_bodies<M: Mechanism + Default>(scene: &mut Assembler) -> Vec<BodyId> {
    let mechanism = M::default();
    let constants = mechanism.constants::<f64>().expect("the data are sound");
    let described = M::initial_state(&constants);
    let body = |body: &holonom::mechanism::BodyInfo| {
        let moment = |place: usize| {
            let mut state = described;
            let velocities = state.velocities_mut().as_mut_slice();
            velocities.fill(0.0);
            velocities[body.velocity + place] = 1.0;
            2.0 * M::kinetic_energy(&constants, &state)
        };
        let q = &described.coordinates().as_slice()[body.coordinate..];
        let u = &described.velocities().as_slice()[body.velocity..];
        let body = Body::rigid(moment(0), [3, 4, 5].map(moment), [q[0], q[1], q[2]]);
        body.with_euler([q[3], q[4], q[5], q[6]])
            .with_velocity([u[0], u[1], u[2]], [u[3], u[4], u[5]])
    };
    let bodies = M::REPORT.bodies.iter();
    bodies.map(|info| scene.add_body(body(info))).collect()
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// `links` bodies one behind the other, the joint in front of each from its place.
fn in_a_row(
    links: usize,
    join: impl Fn(usize) -> Join,
) -> impl Iterator<Item = ([Option<usize>; 2], Join)> {
    (0..links).map(move |link| ([link.checked_sub(1), Some(link)], join(link)))
}

fn head(link: usize) -> [f64; 3] {
    [0.0, link as f64, 0.0]
}

pub(super) fn revolute_chain<M: Mechanism + Default>() -> Assembler {
    let joint = |link| Join::Hinge(head(link), X);
    scene::<M>([0.0, 0.0, -9.81], in_a_row(M::REPORT.bodies.len(), joint))
}

pub(super) fn alternating_chain<M: Mechanism + Default>() -> Assembler {
    let joint = |link| Join::Hinge(head(link), if link % 2 == 0 { X } else { Z });
    scene::<M>([0.0, 0.0, -9.81], in_a_row(M::REPORT.bodies.len(), joint))
}

pub(super) fn spherical_chain<M: Mechanism + Default>() -> Assembler {
    let joint = |link| Join::Ball(head(link));
    scene::<M>([0.0, 0.0, -9.81], in_a_row(M::REPORT.bodies.len(), joint))
}

/// Rows of windows: the joints of `M` between its bodies, with what follows from others left out:
/// one hinge of every loop keeps its two equations in the plane.
pub(super) fn windows<M: Mechanism + Default>() -> Assembler {
    let constants = M::default().constants::<f64>().expect("the data are sound");
    let described = M::initial_state(&constants);
    let centre = |body: usize| {
        let at = M::REPORT.bodies[body].coordinate;
        let q = described.coordinates().as_slice();
        [q[at], q[at + 1]]
    };
    let joints = M::REPORT.joints.iter().map(|joint| {
        let between = [joint.bodies[0], joint.bodies[1]];
        // A foot is half a metre below its rod; a pin is where an upright rod ends, beside the
        // middle of the top.
        let point = match between {
            [None, Some(rod)] | [Some(rod), None] => [centre(rod)[0], 0.0, 0.0],
            [Some(a), Some(b)] => {
                let is_rod = |body: &usize| centre(*body)[1] < 0.75;
                let rod = [a, b].into_iter().find(is_rod).unwrap_or(a);
                [centre(rod)[0], 1.0, 0.0]
            }
            [None, None] => [0.0; 3],
        };
        (between, point)
    });
    // The pin at the right end of a top closes a loop.
    let closes = |[a, b]: [Option<usize>; 2], point: [f64; 3]| {
        let beside =
            |body: Option<usize>| body.is_some_and(|body| centre(body)[0] < point[0] - 0.25);
        beside(a) || beside(b)
    };
    let joints: Vec<_> = joints
        .map(|(between, point)| {
            let join = if closes(between, point) {
                Join::OnLine(point, Z)
            } else {
                Join::Hinge(point, Z)
            };
            (between, join)
        })
        .collect();
    scene::<M>([0.0, -9.81, 0.0], joints)
}

pub(super) fn pendulum() -> Assembler {
    scene::<RodPendulum>([0.0, 0.0, -9.81], in_a_row(1, |_| Join::Hinge([0.0; 3], X)))
}

/// The forms of an assembler in a formulation, timed at some states; a form that cannot be solved
/// there is left out.
pub(super) fn baselines(
    (scene, n): (&'static str, usize),
    assembler: &Assembler,
    states: &[Vec<f64>],
) -> Vec<Baseline> {
    let settings = Settings::TABLE_15_2;
    let states = &read_by(assembler, states);
    let mut baselines = Vec::new();
    let mut enter = |method, solve: Option<_>| {
        if let Some(candidate) = solve {
            baselines.push(Baseline {
                scene,
                n,
                method,
                candidate,
            });
        }
    };
    for method in Method::ALL {
        // A whole matrix of a thousand rows takes a second.
        if assembler.coordinates() <= LARGEST {
            let mut evaluator = Evaluator::new(assembler.clone(), formulation(method, &settings));
            let solve = timed(states, move |x, out| evaluator.rates(0.0, x, out));
            enter(method, solve);
        }
        let (alpha, beta) = settings.baumgarte;
        let (a, b) = match method {
            Method::Standard => (0.0, 0.0),
            Method::Baumgarte => (alpha, beta),
            Method::Penalty | Method::AugmentedLagrangian => continue,
        };
        let mut schur = SchurEvaluator::new(assembler.clone(), a, b);
        let solve = timed(states, move |x, out| schur.rates(0.0, x, out));
        enter(method, solve);
    }
    baselines
}

/// States of a mechanism as an assembler takes them: angles that the mechanism counts behind its
/// coordinates are none of it where it has no forces along them.
fn read_by(assembler: &Assembler, states: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let (coordinates, velocities) = (assembler.coordinates(), assembler.velocities());
    let read = |x: &Vec<f64>| [&x[..coordinates], &x[x.len() - velocities..]].concat();
    states.iter().map(read).collect()
}

/// The most coordinates of a mechanism that the assembler solves as a whole.
const LARGEST: usize = 300;
/// The states of large mechanisms, whose evaluation takes milliseconds.
const FEW: usize = 2;

fn timed(
    states: &[Vec<f64>],
    mut rates: impl FnMut(&[f64], &mut [f64]) -> Result<(), SolveError> + 'static,
) -> Option<Candidate<'static>> {
    let size = states.first()?.len();
    let count = if size > 100 { FEW } else { states.len() };
    let states = states[..count.min(states.len())].to_vec();
    let mut out = vec![0.0; size];
    let unsolved = |_| {
        Fault::Step(StepFault::RatesNotFinite {
            origin: NotFinite::Unknown,
        })
    };
    let work = move || {
        for state in &states {
            rates(black_box(state), &mut out).map_err(unsolved)?;
            black_box(&out);
        }
        Ok(())
    };
    candidate(count as u64, work).ok()
}

#[cfg(test)]
mod tests {
    use holonom::{
        StandardLagrange,
        dynamics::{Dynamics, Problem},
        integrate::System as _,
    };
    use holonom_models::Ur5;

    use super::catalogue::ur5;
    use super::*;

    /// An arm at rest whose motors are off, which count no angles: nobody reads them.
    #[test]
    fn an_arm_falls_as_its_assembler_says() {
        let arm = Ur5::default();
        let state = arm.described_state::<f64>().expect("described");
        let (q, u) = (state.coordinates(), state.velocities());
        let x = [q.as_slice(), u.as_slice()].concat();
        let assembler = ur5();
        let states = read_by(&assembler, std::slice::from_ref(&x));
        assert_eq!(x.len(), states[0].len());
        let mut found = vec![0.0; states[0].len()];
        let mut schur = SchurEvaluator::new(assembler.clone(), 0.0, 0.0);
        schur.rates(0.0, &states[0], &mut found).expect("a tree");
        let dynamics = Dynamics::<Problem<Ur5, _>>::new(&arm, StandardLagrange);
        let rates = dynamics.expect("sound").rates(0.0, &state).expect("a tree");
        let found = &found[assembler.coordinates()..];
        for (found, wanted) in found.iter().zip(rates.velocities().as_slice()) {
            assert!(
                (found - wanted).abs() <= 1e-9 * (1.0 + wanted.abs()),
                "{found} {wanted}"
            );
        }
        assert_eq!(baselines(("ur5", 1), &assembler, &[x]).len(), 6);
    }
}
