//! Inverse dynamics by inertial parameters: the sum over all bodies, and bodies that are others
//! than described.

use core::f64::consts::FRAC_PI_6;

use holonom::BodyHandle;
use holonom::independent::IndependentCoordinates;
use holonom::mechanism::{HasInverse, HasJacobian};
use holonom::prelude::*;
use holonom_models::{Bricard, FourBar, Panda, SliderCrank, Ur5};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::found::Balls;

/// Regressor times described parameters against inverse dynamics, of the largest effort.
fn adds_up<M: HasInverse + HasJacobian, const N: usize, const B: usize>(
    space: &IndependentCoordinates<M, N>,
    state: &M::JointState<f64>,
    accelerations: [f64; N],
    bodies: [BodyHandle<M>; B],
) -> Result<(), Fault> {
    assert_eq!(B, M::REPORT.bodies.len());
    let wanted = space.inverse(state, accelerations)?;
    let mut found = SVector::<f64, N>::zeros();
    for body in bodies {
        let block: SMatrix<f64, N, 10> = space.regressor(state, accelerations, body)?;
        found += block * space.inertial_parameters(body);
    }
    let error = (found - wanted).amax() / wanted.amax();
    println!("{}: {error:.1e}", M::REPORT.name);
    assert!(error < 1e-13, "{}: {found}{wanted}", M::REPORT.name);
    Ok(())
}

#[test]
fn arms() -> Result<(), Fault> {
    let (ur5, h) = (Ur5::default(), Ur5::HANDLES);
    let hinges = [h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3];
    let space = ur5.coordinates(hinges)?;
    let bodies = [
        h.shoulder,
        h.upper_arm,
        h.forearm,
        h.first_wrist,
        h.second_wrist,
        h.third_wrist,
    ];
    let a = [2.0, -1.0, 0.5, 3.0, -4.0, 1.5];
    for sign in [-1.0, 0.3, 1.0] {
        let q = [0.3, -0.8, 1.2, 0.4, -1.1, 2.0].map(|q| sign * q);
        let v = [1.0, -0.5, 1.5, -2.0, 0.7, 3.0].map(|v| sign * v);
        adds_up(&space, &space.state(q, v)?, a, bodies)?;
    }
    let (panda, h) = (Panda::default(), Panda::HANDLES);
    let hinges = [
        h.joint_1, h.joint_2, h.joint_3, h.joint_4, h.joint_5, h.joint_6, h.joint_7,
    ];
    let space = panda.coordinates(hinges)?;
    let bodies = [
        h.link_1, h.link_2, h.link_3, h.link_4, h.link_5, h.link_6, h.hand,
    ];
    let q = [0.3, -0.8, 1.2, -1.4, -1.1, 2.0, 0.6];
    let v = [1.0, -0.5, 1.5, -2.0, 0.7, 3.0, -1.2];
    let a = [2.0, -1.0, 0.5, 3.0, -4.0, 1.5, 2.5];
    adds_up(&space, &space.state(q, v)?, a, bodies)
}

#[test]
fn loops() -> Result<(), Fault> {
    let (crank, h) = (SliderCrank::default(), SliderCrank::HANDLES);
    let space = crank.coordinates([h.bearing])?;
    for angle in [-2.0, 0.7] {
        let state = space.state([angle], [150.0])?;
        adds_up(&space, &state, [40.0], [h.crank, h.rod, h.slider])?;
    }
    let (bricard, h) = (Bricard::default(), Bricard::HANDLES);
    let space = bricard.coordinates([h.p1])?;
    let bodies = [h.first, h.second, h.third, h.fourth, h.fifth];
    adds_up(&space, &space.state([0.2], [1.5])?, [-3.0], bodies)?;
    let (four_bar, h) = (FourBar::default(), FourBar::HANDLES);
    let space = four_bar.coordinates([h.left_foot])?;
    let bodies = [h.left, h.coupler, h.right];
    adds_up(&space, &space.state([0.4], [1.5])?, [2.0], bodies)
}

/// Rates of a ball are those of its body against the ground; a particle has its mass alone.
#[test]
fn balls_and_particles() -> Result<(), Fault> {
    let (balls, h) = (Balls::default(), Balls::HANDLES);
    let [x, y, z] = [0, 1, 2].map(|k| Motion::of(h.ball, k));
    let space = balls.coordinates([Motion::of(h.foot, 0), x, y, z, Motion::of(h.hinge, 0)])?;
    let described = space.of_bodies(&balls.described_state()?);
    let state = space.with_rates(&described, [1.0, -0.5, 2.0, 0.7, 1.3])?;
    let a = [0.4, 1.0, -2.0, 3.0, -0.6];
    adds_up(&space, &state, a, [h.a, h.b, h.c, h.bob])?;
    let block = space.regressor(&state, a, h.bob)?;
    assert_eq!(block.columns(1, 9).amax(), 0.0);
    assert_eq!(space.inertial_parameters(h.bob).rows(1, 9).amax(), 0.0);
    Ok(())
}

/// A body that floats, with a full tensor, and an arm on a spring whose hinge a law drives.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(
    gravity = [0.5, -1.0, -9.81],
    coordinates = "joints",
    kernels = [inverse, jacobian]
)]
struct Satellite {
    #[param]
    stiffness: f64,
    #[body(
        mass = 4.0,
        inertia = [[0.3, 0.02, -0.05], [0.02, 0.5, 0.04], [-0.05, 0.04, 0.4]],
        orientation = rotation([0.6, 0.0, 0.8], 0.7),
        position = [1.0, 2.0, 3.0],
    )]
    base: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [1.0, 2.6, 3.0])]
    arm: Body,
    #[joint(between = [base, arm], point = [1.0, 2.2, 3.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [base, arm], axis = [0.0, 0.0, 1.0], motion = 0.3 * time + sin(2.0 * time))]
    motor: AngleDriver,
    #[force(
        between = [base, arm], head = [1.3, 2.0, 3.0], tail = [1.2, 2.6, 3.0],
        stiffness = stiffness, free_length = 0.3, damping = 0.1 * stiffness
    )]
    spring: SpringDamper,
}

/// With what a law accelerates; springs have no part in it, however stiff they are.
#[test]
fn free_bodies_and_drivers() -> Result<(), Fault> {
    let h = Satellite::HANDLES;
    let free = [0, 1, 2, 3, 4, 5].map(|k| Motion::free(h.arm, k));
    let (v, a) = (
        [0.1, -0.2, 0.3, 0.5, -0.4, 0.6],
        [1.0, 2.0, -1.0, 0.5, 4.0, -3.0],
    );
    let mut soft = None;
    for stiffness in [0.0, 1e4] {
        let satellite = Satellite::new(stiffness)?;
        let mut space = satellite.coordinates(free)?;
        space.set_time(0.2);
        let mut bodies = satellite.described_state()?;
        let _ = satellite.assemble(0.2, &mut bodies)?;
        let state = space.with_rates(&space.of_bodies(&bodies), v)?;
        let blocks = space.regressors(&state, a, [h.base, h.arm])?;
        let Some(soft) = soft else {
            adds_up(&space, &state, a, [h.base, h.arm])?;
            soft = Some(blocks);
            continue;
        };
        for (block, soft) in blocks.iter().zip(&soft) {
            // Gravity is what is left of the forces without the spring.
            assert!((block - soft).amax() < 1e-11 * soft.amax());
        }
    }
    Ok(())
}

/// Two rods, of which the second is what its parameters say: its axes are turned about z.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(
    gravity = [0.0, 0.0, -9.81],
    coordinates = "joints",
    kernels = [inverse, jacobian]
)]
pub(super) struct Arm {
    #[param]
    mass: f64,
    #[param]
    moments: [f64; 3],
    #[param]
    centre: [f64; 3],
    #[body(mass = 3.0, inertia = [0.25, 0.25, 0.01], position = [0.0, 0.0, -0.5])]
    upper: Body,
    #[body(
        mass = mass,
        inertia = [moments[0], moments[1], moments[2]],
        position = [centre[0], centre[1], centre[2]],
        orientation = rotation([0.0, 0.0, 1.0], PI / 6.0),
    )]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.0, 0.0, -1.0], axis_i = [0.0, 1.0, 0.0], axis_j = [1.0, 0.0, 0.0])]
    elbow: Universal,
}

/// What stands in the description of the second rod.
pub(super) const DESCRIBED: (f64, [f64; 3], [f64; 3]) = (2.0, [0.2, 0.25, 0.1], [0.0, 0.0, -1.5]);

/// What it is in fact.
pub(super) const TRUE: (f64, [f64; 3], [f64; 3]) = (2.7, [0.3, 0.2, 0.15], [0.04, -0.07, -1.4]);

/// The parameters of the rod about the described centre, in described axes.
pub(super) fn seen_from_described(
    (mass, moments, centre): (f64, [f64; 3], [f64; 3]),
) -> SVector<f64, 10> {
    let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), FRAC_PI_6);
    let c = turn.inverse() * (Vector3::from(centre) - Vector3::from(DESCRIBED.2));
    let about = Matrix3::from_diagonal(&Vector3::from(moments))
        + mass * (Matrix3::from_diagonal_element(c.norm_squared()) - c * c.transpose());
    SVector::from([
        mass,
        mass * c.x,
        mass * c.y,
        mass * c.z,
        about[(0, 0)],
        about[(1, 1)],
        about[(2, 2)],
        about[(0, 1)],
        about[(0, 2)],
        about[(1, 2)],
    ])
}

/// A body that is another than described: its own inverse dynamics, and the described regressor.
#[test]
fn bodies_that_are_others() -> Result<(), Fault> {
    let [described, other] =
        [DESCRIBED, TRUE].map(|(mass, moments, centre)| Arm::new(mass, moments, centre));
    let (described, other, h) = (described?, other?, Arm::HANDLES);
    let chosen = [
        Motion::of(h.shoulder, 0),
        Motion::of(h.elbow, 0),
        Motion::of(h.elbow, 1),
    ];
    let (space, others) = (described.coordinates(chosen)?, other.coordinates(chosen)?);
    let (q, v, a) = ([0.4, -0.9, 0.6], [1.0, 2.0, -1.5], [3.0, -2.0, 5.0]);
    let wanted = others.inverse(&others.state(q, v)?, a)?;
    let state = space.state(q, v)?;
    let [upper, lower] = space.regressors(&state, a, [h.upper, h.lower])?;
    let found = upper * space.inertial_parameters(h.upper) + lower * seen_from_described(TRUE);
    assert!(
        (found - wanted).amax() < 1e-13 * wanted.amax(),
        "{found}{wanted}"
    );
    let error = space.inertial_parameters(h.lower) - seen_from_described(DESCRIBED);
    assert!(error.amax() < 1e-16, "{error}");
    Ok(())
}

#[test]
fn single_precision() -> Result<(), Fault> {
    let (ur5, h) = (Ur5::default(), Ur5::HANDLES);
    let hinges = [h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3];
    let space = ur5.coordinates(hinges)?;
    let single = ur5.coordinates_in::<f32, 6>(hinges)?;
    let (q, v, a) = (
        [0.3, -0.8, 1.2, 0.4, -1.1, 2.0],
        [1.0, -0.5, 1.5, -2.0, 0.7, 3.0],
        [2.0, -1.0, 0.5, 3.0, -4.0, 1.5],
    );
    let wanted = space.regressor(&space.state(q, v)?, a, h.forearm)?;
    let [q, v, a] = [q, v, a].map(|numbers| numbers.map(|number| number as f32));
    let found = single.regressor(&single.state(q, v)?, a, h.forearm)?;
    let error = (found.map(f64::from) - wanted).amax() / wanted.amax();
    assert!(error < 1e-5, "{error:.1e}");
    Ok(())
}

#[test]
fn what_is_not_finite_does_not_travel() -> Result<(), Fault> {
    let (mass, moments, centre) = DESCRIBED;
    let (arm, h) = (Arm::new(mass, moments, centre)?, Arm::HANDLES);
    let chosen = [
        Motion::of(h.shoulder, 0),
        Motion::of(h.elbow, 0),
        Motion::of(h.elbow, 1),
    ];
    let space = arm.coordinates(chosen)?;
    let mut state = space.state([0.1, 0.2, 0.3], [0.0; 3])?;
    // Not even where it has no part.
    let none = [0.0, f64::NAN, 0.0];
    assert!(space.regressor(&state, none, h.upper).is_err());
    for pair in state.pairs_mut() {
        *pair = [f64::NAN; 2];
    }
    assert!(space.regressor(&state, [0.0; 3], h.lower).is_err());
    Ok(())
}
