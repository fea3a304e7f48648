//! UR5 and Panda against Pinocchio: accelerations, reactions and energies at given states, and a
//! free motion.

mod data;

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{
    BodyHandle, JointCoordinates, JointHandle, Pose, StateParts, dynamics::Dynamics,
    state::MovingState,
};
use holonom_models::{Panda, Ur5};
use nalgebra::{Unit, UnitQuaternion, Vector3};

use super::{difference, tight};

/// What is known of an arm of `N` joints: the configuration of zero angles, global axes, from the
/// ground outwards; and how it moves.
struct Reference<const N: usize> {
    /// Points on the axes (m).
    points: [[f64; 3]; N],
    axes: [[f64; 3]; N],
    /// Centres of mass (m).
    centres: [[f64; 3]; N],
    states: [State<N>; 5],
    /// Angles (rad) and rates (rad/s) half a second after a start at rest with 0.3 rad in every
    /// joint, without torques.
    later: [[f64; N]; 2],
}

/// A state, and what follows from it.
struct State<const N: usize> {
    /// In rad.
    angles: [f64; N],
    /// In rad/s.
    rates: [f64; N],
    /// In N m.
    torques: [f64; N],
    /// In rad/s^2.
    accelerations: [f64; N],
    /// On the first link by the base (N).
    force: [f64; 3],
    /// On the first link by the base, about the global origin (N m).
    moment: [f64; 3],
    /// Of the last link (m).
    last_centre: [f64; 3],
    /// Kinetic and potential (J).
    energies: [f64; 2],
}

/// An arm with names for what the reference counts.
trait Arm<const N: usize>: JointCoordinates + Default {
    const LINKS: [BodyHandle<Self>; N];
    const JOINTS: [JointHandle<Self, Revolute>; N];
    const REFERENCE: Reference<N>;

    fn with_torques(torques: [f64; N]) -> Self;
}

impl Arm<6> for Ur5 {
    const LINKS: [BodyHandle<Self>; 6] = {
        let h = Self::HANDLES;
        [
            h.shoulder,
            h.upper_arm,
            h.forearm,
            h.first_wrist,
            h.second_wrist,
            h.third_wrist,
        ]
    };
    const JOINTS: [JointHandle<Self, Revolute>; 6] = {
        let h = Self::HANDLES;
        [h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3]
    };
    const REFERENCE: Reference<6> = data::UR5;

    fn with_torques(torques: [f64; 6]) -> Self {
        let mut arm = Self::default();
        [
            arm.pan_torque,
            arm.lift_torque,
            arm.elbow_torque,
            arm.wrist_1_torque,
            arm.wrist_2_torque,
            arm.wrist_3_torque,
        ] = torques;
        arm
    }
}

impl Arm<7> for Panda {
    const LINKS: [BodyHandle<Self>; 7] = {
        let h = Self::HANDLES;
        [
            h.link_1, h.link_2, h.link_3, h.link_4, h.link_5, h.link_6, h.hand,
        ]
    };
    const JOINTS: [JointHandle<Self, Revolute>; 7] = {
        let h = Self::HANDLES;
        [
            h.joint_1, h.joint_2, h.joint_3, h.joint_4, h.joint_5, h.joint_6, h.joint_7,
        ]
    };
    const REFERENCE: Reference<7> = data::PANDA;

    fn with_torques(torques: [f64; 7]) -> Self {
        let mut arm = Self::default();
        [
            arm.joint_1_torque,
            arm.joint_2_torque,
            arm.joint_3_torque,
            arm.joint_4_torque,
            arm.joint_5_torque,
            arm.joint_6_torque,
            arm.joint_7_torque,
        ] = torques;
        arm
    }
}

/// The state of an arm by its angles and rates.
fn state<M: Arm<N>, const N: usize>(arm: &M, angles: [f64; N], rates: [f64; N]) -> M::State<f64> {
    let Reference {
        points,
        axes,
        centres,
        ..
    } = M::REFERENCE;
    let mut state = arm.described_state().expect("sound");
    // Of the link before: how it is turned, where the origin of the zero configuration is on it,
    // and how these move.
    let mut turned = UnitQuaternion::identity();
    let mut origin = Vector3::zeros();
    let (mut spin, mut velocity) = (Vector3::zeros(), Vector3::zeros());
    for k in 0..N {
        let (point, axis) = (
            Vector3::from(points[k]),
            Unit::new_normalize(Vector3::from(axes[k])),
        );
        let hinge = origin + turned * point;
        let of_hinge = velocity + spin.cross(&(turned * point));
        spin += turned * axis.scale(rates[k]);
        turned *= UnitQuaternion::from_axis_angle(&axis, angles[k]);
        origin = hinge - turned * point;
        velocity = of_hinge - spin.cross(&(turned * point));
        let arm = turned * Vector3::from(centres[k]);
        let pose = Pose {
            position: origin + arm,
            orientation: turned.into_inner(),
        };
        M::set_pose(&mut state, M::LINKS[k], pose);
        M::set_velocity(&mut state, M::LINKS[k], velocity + spin.cross(&arm));
        M::set_angular_velocity_global(&mut state, M::LINKS[k], spin);
    }
    state
}

/// The largest difference over the largest number wanted.
fn relative(found: &[f64], wanted: &[f64]) -> f64 {
    let largest = wanted.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let pairs = found.iter().zip(wanted);
    pairs.fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs())) / largest
}

fn moves_as_given<M: Arm<N>, const N: usize>() {
    for given in M::REFERENCE.states {
        let arm = M::with_torques(given.torques);
        let state = state(&arm, given.angles, given.rates);
        let dynamics = Dynamics::new(&arm, StandardLagrange)
            .expect("sound")
            .absolute_coordinates();
        let view = dynamics.view(0.0, &state);
        for (k, joint) in M::JOINTS.into_iter().enumerate() {
            assert!(
                (view.angle(joint) - given.angles[k]).abs() < 1e-14,
                "angle {k}"
            );
            assert!(
                (view.angle_rate(joint) - given.rates[k]).abs() < 1e-14,
                "rate {k}"
            );
        }
        let last = view.pose(M::LINKS[N - 1]).position;
        assert!(relative(last.as_slice(), &given.last_centre) < 1e-14);
        let energies = [view.kinetic_energy(), view.potential_energy()];
        assert!(relative(&energies, &given.energies) < 1e-14, "{energies:?}");

        let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("regular");
        // The axis is fixed on both links, so that the velocity of the one does not show along it.
        let mut rates = state;
        *rates.velocities_mut() = *evaluation.rates.velocities();
        let rates = dynamics.view(0.0, &rates);
        let spins = M::LINKS.map(|link| rates.angular_velocity_global(link));
        let mut before = Vector3::zeros();
        let mut accelerations = [0.0; N];
        for k in 0..N {
            let turned = UnitQuaternion::new_unchecked(view.pose(M::LINKS[k]).orientation);
            let axis = turned * Vector3::from(M::REFERENCE.axes[k]).normalize();
            accelerations[k] = axis.dot(&(spins[k] - before));
            before = spins[k];
        }
        let error = relative(&accelerations, &given.accelerations);
        println!("accelerations: {error:e}");
        assert!(error < 1e-12, "{accelerations:?}");
        let accelerations = by_joints::<M, N>(&arm, &state);
        let error = relative(&accelerations, &given.accelerations);
        println!("accelerations by joints: {error:e}");
        assert!(error < 1e-12, "{accelerations:?}");

        let reaction = view
            .reaction(&evaluation.multipliers, M::JOINTS[0], M::LINKS[0])
            .expect("it is there");
        let error = relative(reaction.force.as_slice(), &given.force);
        assert!(error < 1e-10, "{error:e}: {:?}", reaction.force);
        let motor = Vector3::from(M::REFERENCE.axes[0]) * given.torques[0];
        let moment = reaction.moment + reaction.point.cross(&reaction.force) + motor;
        let error = relative(moment.as_slice(), &given.moment);
        assert!(error < 1e-10, "{error:e}: {moment:?}");
    }
}

/// The accelerations of the angles in joint coordinates.
fn by_joints<M: Arm<N>, const N: usize>(arm: &M, state: &M::State<f64>) -> [f64; N] {
    let dynamics = Dynamics::new(arm, StandardLagrange)
        .expect("sound")
        .joint_coordinates();
    let state = dynamics.state_of(state).expect("closed");
    let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("regular");
    // The rates of angles are linear in the velocities of the joints, whatever these are counted
    // against.
    let mut rates = state;
    let accelerations = evaluation.rates.rates_slice();
    rates.rates_slice_mut().copy_from_slice(accelerations);
    let bodies = dynamics.bodies(&rates);
    let view = dynamics.view(0.0, &bodies);
    M::JOINTS.map(|joint| view.angle_rate(joint))
}

fn falls_as_given<M: Arm<N>, F: Formulation<f64>, const N: usize>(method: F) {
    let arm = M::default();
    let start = state(&arm, [0.3; N], [0.0; N]);
    let simulation = || {
        Simulation::new(&arm, method, tight())
            .initial_state(start)
            .projection(Projection::default())
    };
    let mut reached = [[0.0; N]; 2];
    let look = |reached: &mut [[f64; N]; 2], sample: &Sample<'_, f64, M>| {
        *reached = [
            M::JOINTS.map(|joint| sample.angle(joint)),
            M::JOINTS.map(|joint| sample.angle_rate(joint)),
        ];
        ControlFlow::Continue(())
    };
    let report = simulation().run(0.0..=0.5, every(0.5), |sample| look(&mut reached, sample));
    let evaluations = report.expect("regular").evaluations;
    println!("{method:?}: {evaluations} evaluations");
    is_as_given::<M, N>(reached);
    if !F::ITERATED {
        reached = [[0.0; N]; 2];
        let by_joints = simulation().joint_coordinates();
        let report = by_joints.run(0.0..=0.5, every(0.5), |sample| look(&mut reached, sample));
        report.expect("regular");
        is_as_given::<M, N>(reached);
    }
}

fn is_as_given<M: Arm<N>, const N: usize>(reached: [[f64; N]; 2]) {
    let [angles, rates] = M::REFERENCE.later;
    // The angle of a hinge is that of its two bodies, without turns.
    let worst = |pairs: &mut dyn Iterator<Item = f64>| pairs.fold(0.0_f64, |w, x| w.max(x.abs()));
    let errors = [
        worst(&mut (0..N).map(|k| difference(reached[0][k], angles[k]))),
        worst(&mut (0..N).map(|k| reached[1][k] - rates[k])),
    ];
    println!("{errors:?}");
    assert!(errors[0] < 1e-8, "{errors:?}");
    assert!(errors[1] < 1e-6, "{errors:?}");
}

#[test]
fn ur5() {
    moves_as_given::<Ur5, 6>();
    falls_as_given::<Ur5, _, 6>(StandardLagrange);
    falls_as_given::<Ur5, _, 6>(Baumgarte::default());
    falls_as_given::<Ur5, _, 6>(AugmentedLagrangian::default());
}

#[test]
fn panda() {
    moves_as_given::<Panda, 7>();
    falls_as_given::<Panda, _, 7>(StandardLagrange);
    falls_as_given::<Panda, _, 7>(Baumgarte::default());
    falls_as_given::<Panda, _, 7>(AugmentedLagrangian::default());
}
