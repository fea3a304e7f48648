//! Base parameters by their known numbers, and parameters from efforts.

use holonom::BodyHandle;
use holonom::error::StartFault;
use holonom::independent::{Chosen, Identification};
use holonom::mechanism::{HasInverse, HasJacobian};
use holonom::prelude::*;
use holonom_models::{CartPole, HeavyTop, Panda, Ur5};
use nalgebra::SVector;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::regressor::{Arm, DESCRIBED, TRUE, seen_from_described};

/// Random states, positions and rates up to 2, with the efforts of a mechanism.
fn observed<M: HasInverse + HasJacobian, const N: usize, const B: usize>(
    described: &M,
    real: &M,
    chosen: impl Chosen<M, N> + Copy,
    bodies: [BodyHandle<M>; B],
) -> Result<Identification<M, N, B>, Fault> {
    let mut random = ChaCha8Rng::seed_from_u64(36);
    let space = described.coordinates(chosen)?;
    let real = real.coordinates(chosen)?;
    let mut run = space.identification(bodies);
    for _ in 0..40 {
        let [q, v, a] =
            [(); 3].map(|()| SVector::<f64, N>::from_fn(|_, _| random.random_range(-2.0..2.0)));
        let efforts = real.inverse(&real.state(q, v)?, a)?;
        run.observe(&space.state(q, v)?, a, efforts)?;
    }
    Ok(run)
}

/// A rod on a hinge, whose axis the weight is across or along.
macro_rules! pendulum {
    ($name:ident, $gravity:expr) => {
        #[derive(Clone, Copy, Debug, Mechanism)]
        #[mechanism(gravity = $gravity, coordinates = "joints", kernels = [inverse, jacobian])]
        struct $name {
            #[body(mass = 2.0, inertia = [0.5, 0.1, 0.5], position = [0.0, 0.5, 0.0])]
            rod: Body,
            #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
            hinge: Revolute,
        }
    };
}
pendulum!(Upright, [0.0, 0.0, -9.81]);
pendulum!(Level, [-9.81, 0.0, 0.0]);

/// Two rods in a plane.
macro_rules! double_pendulum {
    ($name:ident, $gravity:expr) => {
        #[derive(Clone, Copy, Debug, Mechanism)]
        #[mechanism(gravity = $gravity, coordinates = "joints", kernels = [inverse, jacobian])]
        struct $name {
            #[body(mass = 3.0, inertia = [0.25, 0.25, 0.01], position = [0.0, 0.0, -0.5])]
            upper: Body,
            #[body(mass = 2.0, inertia = [0.2, 0.2, 0.01], position = [0.0, 0.0, -1.5])]
            lower: Body,
            #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
            shoulder: Revolute,
            #[joint(between = [upper, lower], point = [0.0, 0.0, -1.0], axis = [1.0, 0.0, 0.0])]
            elbow: Revolute,
        }
    };
}
double_pendulum!(Hanging, [0.0, 0.0, -9.81]);
double_pendulum!(Lying, [-9.81, 0.0, 0.0]);

/// The number of base parameters, certain by many powers of ten; the described ones fit.
fn count<M: HasInverse + HasJacobian + Default, const N: usize, const B: usize>(
    chosen: impl Chosen<M, N> + Copy,
    bodies: [BodyHandle<M>; B],
) -> Result<usize, Fault> {
    let mechanism = M::default();
    let run = observed(&mechanism, &mechanism, chosen, bodies)?;
    let base = run.base_parameters();
    let [least, left] = base.pivots();
    println!(
        "{}: {} of {least:.1e}, {left:.1e}",
        M::REPORT.name,
        base.count()
    );
    assert!(least > 1e-4 && left < 1e-13, "{least:.1e}, {left:.1e}");
    let found = run.identify([1.0; N])?;
    let wanted = base.values(run.described());
    assert!((&found.values - &wanted).amax() < 1e-11 * wanted.amax());
    let parameters = base.parameters(&found.values, &[SVector::zeros(); B]);
    assert!((base.values(&parameters) - &wanted).amax() < 1e-11 * wanted.amax());
    Ok(base.count())
}

/// 36 of a UR5 and 43 of a Panda without fingers: one of the first body, whose axis is vertical,
/// and seven of each other one. A UR5 has three parallel axes, which take none away, as weights act
/// across them.
#[test]
fn known_numbers() -> Result<(), Fault> {
    let h = Ur5::HANDLES;
    let hinges = [h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3];
    let bodies = [
        h.shoulder,
        h.upper_arm,
        h.forearm,
        h.first_wrist,
        h.second_wrist,
        h.third_wrist,
    ];
    assert_eq!(count(hinges, bodies)?, 36);
    let h = Panda::HANDLES;
    let hinges = [
        h.joint_1, h.joint_2, h.joint_3, h.joint_4, h.joint_5, h.joint_6, h.joint_7,
    ];
    let bodies = [
        h.link_1, h.link_2, h.link_3, h.link_4, h.link_5, h.link_6, h.hand,
    ];
    assert_eq!(count(hinges, bodies)?, 43);
    assert_eq!(count([Upright::HANDLES.hinge], [Upright::HANDLES.rod])?, 3);
    assert_eq!(count([Level::HANDLES.hinge], [Level::HANDLES.rod])?, 1);
    let h = Hanging::HANDLES;
    assert_eq!(count([h.shoulder, h.elbow], [h.upper, h.lower])?, 6);
    let h = Lying::HANDLES;
    assert_eq!(count([h.shoulder, h.elbow], [h.upper, h.lower])?, 4);
    let h = CartPole::HANDLES;
    assert_eq!(count((h.rail, h.hinge), [h.cart, h.pole])?, 4);
    Ok(())
}

/// By hand: about the hinge `Ixx - m y^2` and so on; first moments across the axis with the mass.
#[test]
fn combinations_of_a_pendulum() -> Result<(), Fault> {
    let (pendulum, h) = (Upright::default(), Upright::HANDLES);
    let base = observed(&pendulum, &pendulum, [h.hinge], [h.rod])?.base_parameters();
    let names: Vec<String> = base.independent().map(|one| one.to_string()).collect();
    assert_eq!(names.len(), 3);
    let idle: Vec<&str> = base.without_effect().map(|one| one.quantity).collect();
    assert_eq!(idle, ["mx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz"]);
    // The moment of the weight along y, the moment along z, and the inertia about the hinge: in
    // whichever terms, these are known of any parameters.
    let known = |p: &SVector<f64, 10>| {
        let [m, y, z, i] = [0, 2, 3, 4].map(|place| p[place]);
        [y + 0.5 * m, z, i + y + 0.25 * m]
    };
    let parameters = SVector::from([2.5, 1.0, 0.3, -0.2, 0.7, 1.0, 2.0, 3.0, 4.0, 5.0]);
    let values = base.values(&[parameters]);
    let [back] = base.parameters(&values, &[SVector::zeros()]);
    for (found, wanted) in known(&back).into_iter().zip(known(&parameters)) {
        assert!((found - wanted).abs() < 1e-12, "{found} for {wanted}");
    }
    Ok(())
}

/// Rates of a ball, in one state after the other of a motion. A top shows its first moments and its
/// tensor about the fixed point, but not how these come of a mass.
#[test]
fn a_top() -> Result<(), Fault> {
    let (top, h) = (HeavyTop::default(), HeavyTop::HANDLES);
    let space = top.coordinates([0, 1, 2].map(|k| Motion::of(h.tip, k)))?;
    let mut run = space.identification([h.top]);
    let mut random = ChaCha8Rng::seed_from_u64(36);
    let mut state = space.of_bodies(&top.described_state()?);
    let mut stepper = Stepper::new(&top, StandardLagrange, Rk4)?;
    for _ in 0..40 {
        let [v, a] =
            [(); 2].map(|()| SVector::<f64, 3>::from_fn(|_, _| random.random_range(-5.0..5.0)));
        state = space.with_rates(&state, v)?;
        run.observe(&state, a, space.inverse(&state, a)?)?;
        let mut bodies = space.bodies(&state);
        stepper.step(&mut bodies, 0.1)?;
        state = space.of_bodies(&bodies);
    }
    let base = run.base_parameters();
    assert_eq!(base.count(), 9);
    assert!(base.pivots()[1] < 1e-13);
    Ok(())
}

/// A rod that is another than described, by its own efforts: all that these depend on is found.
#[test]
fn a_rod_that_is_another() -> Result<(), Fault> {
    let [described, real] =
        [DESCRIBED, TRUE].map(|(mass, moments, centre)| Arm::new(mass, moments, centre));
    let (described, real, h) = (described?, real?, Arm::HANDLES);
    let chosen = [
        Motion::of(h.shoulder, 0),
        Motion::of(h.elbow, 0),
        Motion::of(h.elbow, 1),
    ];
    let run = observed(&described, &real, chosen, [h.lower])?;
    let found = run.identify([1.0; 3])?;
    assert_eq!(found.base.count(), 10);
    let [parameters] = found.base.parameters(&found.values, run.described());
    let error = parameters - seen_from_described(TRUE);
    assert!(error.amax() < 1e-12, "{error}");
    assert!(found.residual < 1e-12);
    Ok(())
}

/// A normal deviate (Box and Muller).
fn normal(random: &mut ChaCha8Rng) -> f64 {
    let [radius, angle] = [(); 2].map(|()| random.random_range(f64::MIN_POSITIVE..1.0));
    (-2.0 * radius.ln()).sqrt() * (core::f64::consts::TAU * angle).cos()
}

/// Noise of another size on each hinge: what is left is that noise, and parameters are as wrong as
/// they are said to be.
#[test]
fn a_noisy_arm() -> Result<(), Fault> {
    let (ur5, h) = (Ur5::default(), Ur5::HANDLES);
    let space = ur5.coordinates([h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3])?;
    let bodies = [
        h.shoulder,
        h.upper_arm,
        h.forearm,
        h.first_wrist,
        h.second_wrist,
        h.third_wrist,
    ];
    let noise = SVector::from([0.5, 0.5, 0.3, 0.1, 0.1, 0.05]);
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut run = space.identification(bodies);
    for _ in 0..400 {
        let [q, v, a] =
            [(); 3].map(|()| SVector::<f64, 6>::from_fn(|_, _| random.random_range(-2.0..2.0)));
        let state = space.state(q, v)?;
        let noisy = space.inverse(&state, a)? + noise.map(|size| size * normal(&mut random));
        run.observe(&state, a, noisy)?;
    }
    let found = run.identify(noise)?;
    assert_eq!((found.base.count(), found.values.len()), (36, 36));
    // 2400 rows less 36: its own deviation is 1.5 %.
    assert!((found.residual - 1.0).abs() < 0.05, "{}", found.residual);
    let wanted = found.base.values(run.described());
    let errors = (&found.values - wanted).component_div(&found.deviations);
    assert!(errors.amax() < 4.0, "{errors}");
    let spread = (errors.norm_squared() / 36.0).sqrt();
    assert!((spread - 1.0).abs() < 0.35, "{spread}");
    Ok(())
}

#[test]
fn what_cannot_be_identified_is_refused() -> Result<(), Fault> {
    let (pendulum, h) = (Upright::default(), Upright::HANDLES);
    let space = pendulum.coordinates([h.hinge])?;
    let mut run = space.identification([h.rod]);
    let surplus = Fault::Start(StartFault::Setting {
        name: "surplus of rows",
        value: 0.0,
    });
    assert_eq!(run.identify([1.0]), Err(surplus));
    let state = space.state([0.3], [1.0])?;
    assert!(run.observe(&state, [1.0], [f64::NAN]).is_err());
    assert!(run.observe(&state, [f64::INFINITY], [1.0]).is_err());
    // One state shows one combination, whatever is in it.
    run.observe(&state, [1.0], [1.0])?;
    assert_eq!(run.base_parameters().count(), 1);
    assert_eq!(run.identify([1.0]), Err(surplus));
    run.observe(&state, [1.0], [1.0])?;
    assert!(run.identify([0.0]).is_err() && run.identify([f64::NAN]).is_err());
    assert!(run.identify([1.0]).is_ok());
    assert!(run.with_threshold(-1.0).is_err());
    Ok(())
}
