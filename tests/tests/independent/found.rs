//! What was once wrong.

use core::f64::consts::FRAC_PI_2;

use holonom::error::{AnalysisFault, StartFault, StepFault};
use holonom::independent::{Chosen, to_discrete};
use holonom::mechanism::{HasInverse, HasJacobian, HasMassMatrix, Located};
use holonom::prelude::*;
use holonom_models::{Panda, SimplePendulum, Ur5};
use nalgebra::{Matrix2, SVector, Vector2, Vector3};

/// A hinge, a ball, a hinge behind it, a bob on a ball, and a body that moves freely.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(
    gravity = [0.0, 0.0, -9.81],
    coordinates = "joints",
    kernels = [mass, inverse, gravity, coriolis, jacobian]
)]
pub(super) struct Balls {
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.25], position = [0.0, 0.5, 0.0])]
    a: Body,
    #[body(mass = 2.0, inertia = [0.3, 0.2, 0.25], position = [0.2, 1.0, -0.5])]
    b: Body,
    #[body(mass = 1.5, inertia = [0.1, 0.2, 0.15], position = [0.0, 1.3, -1.0])]
    c: Body,
    #[body(mass = 0.5, position = [0.4, 1.5, -1.2])]
    bob: Particle,
    #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    foot: Revolute,
    #[joint(between = [a, b], point = [0.0, 1.0, 0.0])]
    ball: Spherical,
    #[joint(between = [c, b], point = [0.1, 1.0, -1.0], axis = [0.0, 0.6, 0.8])]
    hinge: Revolute,
    #[joint(between = [c, bob], point = [0.4, 1.5, -1.2])]
    hook: Spherical,
}

/// Velocities by the Jacobian against those of the bodies; accelerations of efforts, and back.
fn moves<M, const N: usize>(
    mechanism: &M,
    chosen: impl Chosen<M, N>,
    rates: [f64; N],
    points: &[impl Located<M>],
    bodies: &[holonom::BodyHandle<M>],
) -> Result<(), Fault>
where
    M: HasMassMatrix + HasInverse + HasJacobian,
{
    let space = mechanism.coordinates(chosen)?;
    let described = space.of_bodies(&mechanism.described_state()?);
    let state = space.with_rates(&described, rates)?;
    let standing = space.bodies(&state);
    let view = mechanism.view(0.0, &standing)?;
    let v = SVector::from(rates);
    for &point in points {
        let found = space.jacobian(&state, point)? * v;
        assert!((found.fixed_rows::<3>(0) - view.velocity(point)).norm() < 1e-13);
    }
    for &body in bodies {
        let found = space.jacobian(&state, body)? * v;
        let wanted = view.angular_velocity_global(body);
        assert!(
            (found.fixed_rows::<3>(3) - wanted).norm() < 1e-13,
            "{body:?}: {found}{wanted}"
        );
    }
    let found = space.centre_of_mass_jacobian(&state, ..)? * v;
    assert!((found - view.centre_of_mass_velocity(..)?).norm() < 1e-13);
    for of in [bodies, &bodies[1..]] {
        let found = space.momentum_matrix(&state, of)? * v;
        assert!((found.fixed_rows::<3>(0) - view.linear_momentum(of)).norm() < 1e-13);
        let wanted = view.angular_momentum_about_centre(of)?;
        assert!((found.fixed_rows::<3>(3) - wanted).norm() < 1e-13);
    }
    let kinetic = 0.5 * (space.mass(&state)? * v).dot(&v);
    assert!((kinetic - view.kinetic_energy()).abs() < 1e-12 * kinetic);
    let efforts = space.inverse(&state, rates)?;
    assert!((space.forward(&state, efforts)? - v).norm() < 1e-11);
    Ok(())
}

/// Rates of a ball are those of its body against the ground: what carries it does not turn it. A
/// particle has no rotation.
#[test]
fn bodies_behind_balls() -> Result<(), Fault> {
    let (balls, h) = (Balls::default(), Balls::HANDLES);
    let [x, y, z] = [0, 1, 2].map(|k| Motion::of(h.ball, k));
    moves(
        &balls,
        [Motion::of(h.foot, 0), x, y, z, Motion::of(h.hinge, 0)],
        [1.0, 0.4, -0.7, 0.3, 2.0],
        &[h.a, h.b, h.c, h.bob],
        &[h.a, h.b, h.c, h.bob],
    )
}

/// A body on a hinge that is carried by one that floats.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse, jacobian])]
pub(super) struct Floating {
    #[body(free, mass = 4.0, inertia = [0.3, 0.5, 0.4], position = [1.0, 2.0, 3.0])]
    base: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [1.0, 2.6, 3.0])]
    arm: Body,
    #[joint(between = [arm, base], point = [1.0, 2.2, 3.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
}

#[test]
fn what_floats_has_coordinates() -> Result<(), Fault> {
    let (floating, h) = (Floating::default(), Floating::HANDLES);
    let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|k| Motion::free(h.base, k));
    moves(
        &floating,
        (a, b, c, d, e, f, h.hinge),
        [0.1, -0.2, 0.3, 0.5, -0.4, 0.6, 1.1],
        &[h.base, h.arm],
        &[h.base, h.arm],
    )?;
    let carried = floating.coordinates([0, 1, 2, 3, 4, 5, 6].map(|k| Motion::free(h.arm, k)));
    assert_eq!(
        carried.err(),
        Some(Fault::Analysis(AnalysisFault::Carried {
            body: "arm",
            joint: "hinge"
        }))
    );
    Ok(())
}

/// A step of a system that is damped far beyond oscillation: two rates, decades apart.
#[test]
fn discrete_steps_of_stiff_systems() {
    for (w, z, dt) in [
        (100.0, 50.0, 1.0),
        (1e3, 20.0, 0.1),
        (1e3, 5.0, 1.0),
        (1e5, 5.0, 1.0),
    ] {
        let (w, z): (f64, f64) = (w, z);
        let a = Matrix2::new(0.0, 1.0, -w * w, -2.0 * z * w);
        let (step, input) = to_discrete(&a, &Vector2::new(0.0, 1.0), dt);
        let fast = -w * (z + (z * z - 1.0).sqrt());
        let slow = w * w / fast;
        let share = |f: f64, g: f64| (fast * f - slow * g) / (fast - slow);
        let wanted = share((slow * dt).exp(), (fast * dt).exp());
        assert!(
            (step[(0, 0)] - wanted).abs() < 1e-9,
            "{w}, {z}: {} for {wanted}",
            step[(0, 0)]
        );
        let wanted = (1.0 - wanted) / (w * w);
        let off = (input[0] - wanted).abs() / wanted;
        assert!(off < 1e-9, "{w}, {z}: {off}");
    }
}

/// The same joint, described from either side.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse])]
struct Sleeves {
    #[body(mass = 2.0, inertia = [0.2, 0.2, 0.3], position = [0.0, 0.0, 0.0])]
    one: Body,
    #[body(mass = 2.0, inertia = [0.2, 0.2, 0.3], position = [3.0, 0.0, 0.0])]
    other: Body,
    #[body(mass = 2.0, inertia = [0.1, 0.2, 0.3], position = [6.0, 0.0, 0.0])]
    cross: Body,
    #[joint(between = [ground, one], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    sleeve: Cylindrical,
    #[joint(between = [other, ground], point = [3.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    turned: Cylindrical,
    #[joint(
        between = [cross, ground],
        point = [6.0, 0.0, 0.0],
        axis_i = [1.0, 0.0, 0.0],
        axis_j = [0.0, 1.0, 0.0]
    )]
    universal: Universal,
}

#[test]
fn motions_count_in_the_order_of_the_definition() -> Result<(), Fault> {
    let (sleeves, h) = (Sleeves::default(), Sleeves::HANDLES);
    let of = |number| (Motion::of(h.sleeve, number), Motion::of(h.turned, number));
    let ((a, b), (c, d)) = (of(0), of(1));
    let (e, f) = (Motion::of(h.universal, 0), Motion::of(h.universal, 1));
    let space = sleeves.coordinates([a, c, b, d, e, f])?;
    let positions = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let state = space.state(positions, [0.0; 6])?;
    assert!((space.positions(&state)? - SVector::from(positions)).norm() < 1e-14);
    let mass = space.mass(&state)?;
    let diagonal = [0, 1, 2, 3].map(|k| mass[(k, k)]);
    assert_eq!(diagonal, [0.3, 2.0, 0.3, 2.0]);
    let bodies = space.bodies(&state);
    let view = sleeves.view(0.0, &bodies)?;
    assert!((view.angle(h.sleeve) - 0.1).abs() < 1e-15);
    let [first, second] = view.angles(h.universal);
    assert!((first - 0.5).abs() < 1e-15 && (second - 0.6).abs() < 1e-15);
    assert!((view.displacement(h.turned) - 0.4).abs() < 1e-15);
    Ok(())
}

/// A slide that a force pushes, and one on a spring.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse, jacobian])]
struct Slides {
    #[param]
    push: f64,
    #[param]
    stiffness: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    free: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 1.0, 0.0])]
    sprung: Body,
    #[joint(between = [ground, free], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [ground, sprung], point = [0.5, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    sled: Prismatic,
    #[force(between = [ground, free], point = [0.0, 0.0, 0.0], force = [push, 0.0, 0.0])]
    motor: PointForce,
    #[force(
        between = [ground, sprung],
        head = [0.0, 1.0, 0.0],
        tail = [0.5, 1.0, 0.0],
        stiffness = stiffness,
        free_length = 0.5
    )]
    spring: SpringDamper,
}

#[test]
fn where_nothing_balances_there_is_no_equilibrium() -> Result<(), Fault> {
    let h = Slides::HANDLES;
    for (push, stiffness) in [(1e-4, 1e9), (0.1, 1e6), (1e-3, 1e4)] {
        let slides = Slides::new(push, stiffness)?;
        let space = slides.coordinates([h.rail, h.sled])?;
        let found = space.equilibrium(&space.state([0.0, 0.0], [0.0, 0.0])?);
        assert!(
            matches!(found, Err(Fault::Step(StepFault::NotConverged { .. }))),
            "{found:?}"
        );
        let space = slides.coordinates_in::<f32, 2>([h.rail, h.sled])?;
        let found = space.equilibrium(&space.state([0.0, 0.0], [0.0, 0.0])?);
        assert!(
            matches!(found, Err(Fault::Step(StepFault::NotConverged { .. }))),
            "{found:?}"
        );
    }
    let slides = Slides::new(0.0, 100.0)?;
    let space = slides.coordinates([h.rail, h.sled])?;
    let rest = space.equilibrium(&space.state([0.3, 0.2], [5.0, 0.0])?)?;
    assert!((space.positions(&rest)? - Vector2::new(0.3, 0.0)).norm() < 1e-15);
    let moving = space.equilibrium(&space.state([0.0, 0.2], [5.0, 5.0])?);
    assert_eq!(
        moving,
        Err(Fault::Analysis(AnalysisFault::NotSteady { joint: "sled" }))
    );
    Ok(())
}

/// Two rods, described on the horizontal, with a spring in the elbow.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
struct Rods {
    #[param]
    stiffness: f64,
    #[body(mass = 3.0, inertia = [0.25, 0.25, 0.25], position = [0.0, 0.5, 0.0])]
    upper: Body,
    #[body(mass = 3.0, inertia = [0.25, 0.25, 0.25], position = [0.0, 1.5, 0.0])]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
    #[force(between = [upper, lower], axis = [1.0, 0.0, 0.0], stiffness = stiffness)]
    spring: TorsionalSpringDamper,
}

#[test]
fn rods_fall_until_they_hang() -> Result<(), Fault> {
    let h = Rods::HANDLES;
    for stiffness in [0.0, 20.0, 1e4, 1e8, 1e10] {
        for start in [0.0, -0.4, 1e-12, -1.2] {
            let rods = Rods::new(stiffness)?;
            let space = rods.coordinates([h.shoulder, h.elbow])?;
            let rest = space.equilibrium(&space.state([start, 0.0], [0.0, 0.0])?)?;
            let [shoulder, elbow]: [f64; 2] = space.positions(&rest)?.into();
            let off = [(shoulder + FRAC_PI_2).abs(), elbow.abs()];
            assert!(
                off[0] < 1e-10 && off[1] < 1e-10,
                "{stiffness}, {start}: {off:?}"
            );
        }
    }
    Ok(())
}

/// A hinge that is driven.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse, jacobian])]
struct Driven {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = 2.0 * time)]
    driver: AngleDriver,
}

#[test]
fn without_degrees_of_freedom() -> Result<(), Fault> {
    let none: [holonom::JointHandle<Driven, holonom::joints::Revolute>; 0] = [];
    let space = Driven::default().coordinates(none)?;
    let state = space.state([], [])?;
    assert!((state.rates()[0] - 2.0).abs() < 1e-14);
    let linear = space.linearise(&state, [], |_| [])?;
    assert!(linear.modes().is_empty());
    Ok(())
}

#[test]
fn a_direction_has_any_length_but_zero() -> Result<(), Fault> {
    let slides = Slides::new(0.0, 100.0)?;
    let h = Slides::HANDLES;
    let space = slides.coordinates([h.rail, h.sled])?;
    let state = space.state([0.0, 0.0], [0.0, 0.0])?;
    for length in [1e-200, 1.0, 1e200] {
        let mass = space.effective_mass(&state, h.free, Vector3::new(length, 0.0, 0.0))?;
        assert!((mass - 1.0).abs() < 1e-15);
        let fixed = space.effective_mass(&state, h.free, Vector3::new(0.0, length, 0.0))?;
        assert_eq!(fixed, f64::INFINITY);
    }
    let none = space.effective_mass(&state, h.free, Vector3::zeros());
    assert!(matches!(
        none,
        Err(Fault::Start(StartFault::Setting {
            name: "direction",
            ..
        }))
    ));
    Ok(())
}

/// A wheel that turns another one five times slower.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse])]
struct Train {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    small: Body,
    #[body(mass = 1.0, inertia = [0.3, 0.3, 0.4], position = [0.6, 0.0, 0.0])]
    large: Body,
    #[joint(between = [ground, small], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    first: Revolute,
    #[joint(between = [ground, large], point = [0.6, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    second: Revolute,
    #[joint(
        between = [ground, small, large],
        axis_i = [0.0, 0.0, 1.0],
        axis_j = [0.0, 0.0, 1.0],
        ratio = -0.2
    )]
    gear: Gear,
}

/// Over more than a turn, what is geared goes along.
#[test]
fn gears_go_along() -> Result<(), Fault> {
    let (train, h) = (Train::default(), Train::HANDLES);
    let by_small = train.coordinates([h.first])?;
    let by_large = train.coordinates([h.second])?;
    for angle in [7.0, -12.5, 2.0] {
        let state = by_small.state([angle], [1.0])?;
        let (found, rate) = (by_large.positions(&state)?[0], by_large.rates(&state)[0]);
        let wanted = angle * rate;
        let turns = ((found - wanted) / core::f64::consts::TAU).round();
        let off = found - wanted - turns * core::f64::consts::TAU;
        assert!(
            off.abs() < 1e-12 && rate.abs() > 0.1,
            "{angle}: {found} for {wanted}"
        );
    }
    Ok(())
}

/// A slider-crank of any size.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse])]
struct Sized {
    #[param(like = 1.0)]
    l: f64,
    #[body(mass = 1.0, inertia = [l * l, l * l, l * l], position = [0.15 * l, 0.0, 0.0])]
    crank: Body,
    #[body(mass = 1.0, inertia = [l * l, l * l, l * l], position = [0.8 * l, 0.0, 0.0])]
    rod: Body,
    #[body(mass = 1.0, inertia = [l * l, l * l, l * l], position = [1.3 * l, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, rod], point = [0.3 * l, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [ground, slider], point = [1.3 * l, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[joint(between = [slider, rod], point = [1.3 * l, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    end: PointOnLine,
}

/// Whether a choice fails does not depend on the unit of length.
#[test]
fn small_and_large_mechanisms() -> Result<(), Fault> {
    let h = Sized::HANDLES;
    let at = |l: f64| -> Result<f64, Fault> {
        let sized = Sized::new(l)?;
        let (by_crank, by_slide) = (
            sized.coordinates([h.bearing])?,
            sized.coordinates([h.guide])?,
        );
        let state = by_crank.state([0.7], [1.0])?;
        by_slide.mass(&state).map(|mass| mass[0])
    };
    let wanted = at(1.0)?;
    for l in [1e-6, 1e-3, 1e3, 1e6] {
        assert!((at(l)? / wanted - 1.0).abs() < 1e-9, "{l}");
    }
    for l in [1e-3, 1e-2, 1e3] {
        let sized = Sized::new(l)?;
        let by_crank = sized.coordinates_in::<f32, 1>([h.bearing])?;
        let by_slide = sized.coordinates_in::<f32, 1>([h.guide])?;
        let state = by_crank.state([0.7], [1.0])?;
        let found = f64::from(by_slide.mass(&state)?[0]);
        assert!((found / wanted - 1.0).abs() < 1e-3, "{l}: {found}");
    }
    Ok(())
}

/// A state far from the described one was open by some thousandths: it went back to its coordinates
/// along the constraints, which bend. With `y` the height of a pendulum of 1 m, `y'' = -g (1 - y^2)
/// - y y'^2 / (1 - y^2)`.
#[test]
fn states_satisfy_the_constraints() -> Result<(), Fault> {
    let (pendulum, h) = (SimplePendulum::default(), SimplePendulum::HANDLES);
    let space = pendulum.coordinates([Motion::of(h.plane, 0)])?;
    for position in [-0.5, 0.2, 0.7, -0.9] {
        let state = space.state([position], [1.0])?;
        let bodies = space.bodies(&state);
        let bob = pendulum.view(0.0, &bodies)?.position(h.bob);
        assert!((bob.norm() - 1.0).abs() < 1e-15, "{position}: {bob}");
        assert!((bob.y.abs() - position.abs()).abs() < 1e-15);
        let (y, sign) = (bob.y, bob.y / position);
        let rest = 1.0 - y * y;
        let wanted = sign * (-9.81 * rest - y / rest);
        let found = space.forward(&state, [0.0])?[0];
        assert!((found / wanted - 1.0).abs() < 1e-13, "{found}, {wanted}");
        let wanted = 2.0 * 9.81 * y - (1.0 + y * y) / (rest * rest);
        let found = space.linearise(&state, [], |_| [])?.by_positions[0];
        assert!((found / wanted - 1.0).abs() < 1e-12, "{found}, {wanted}");
    }
    Ok(())
}

/// A state that holds no number is no state, and gives none.
#[test]
fn what_is_not_finite_does_not_travel() -> Result<(), Fault> {
    let slides = Slides::new(0.0, 100.0)?;
    let h = Slides::HANDLES;
    let space = slides.coordinates([h.rail, h.sled])?;
    let none = [f64::NAN, 0.0];
    assert_eq!(
        space.state(none, [0.0; 2]),
        Err(Fault::Step(StepFault::StateNotFinite))
    );
    assert_eq!(
        space.state([0.0; 2], none),
        Err(Fault::Step(StepFault::StateNotFinite))
    );
    let (balls, h) = (Balls::default(), Balls::HANDLES);
    let [x, y, z] = [0, 1, 2].map(|k| Motion::of(h.ball, k));
    let space = balls.coordinates([Motion::of(h.foot, 0), x, y, z, Motion::of(h.hinge, 0)])?;
    let mut state = space.of_bodies(&balls.described_state()?);
    for pair in state.pairs_mut() {
        *pair = [f64::NAN; 2];
    }
    let x = Vector3::x();
    assert!(space.mass(&state).is_err() && space.gravity(&state).is_err());
    assert!(space.jacobian(&state, h.c).is_err() && space.jacobian_rate(&state, h.c).is_err());
    assert!(space.effective_mass(&state, h.c, x).is_err());
    assert!(space.linearise(&state, [], |_| []).is_err() && space.equilibrium(&state).is_err());
    Ok(())
}

/// The mass matrix is refused where an entry is no number, whichever angle is none: by what its
/// kernel tells, and by all entries of rates in another order.
fn refuses_masses<M: HasMassMatrix + Default, const N: usize>(
    chosen: impl Chosen<M, N>,
    reversed: impl Chosen<M, N>,
    pairs: fn(&mut M::JointState<f64>) -> &mut [[f64; 2]],
) -> Result<(), Fault> {
    let mechanism = M::default();
    let space = mechanism.coordinates(chosen)?;
    let reversed = mechanism.coordinates(reversed)?;
    let described = space.state([0.3; N], [0.0; N])?;
    assert!(space.mass(&described).is_ok());
    let mut refused = 0;
    for angle in 0..N {
        for place in 0..2 {
            for number in [f64::NAN, f64::INFINITY] {
                let mut state = described;
                if let Some(pair) = pairs(&mut state).get_mut(angle) {
                    pair[place] = number;
                }
                let found = space.mass(&state).is_err();
                assert_eq!(found, reversed.mass(&state).is_err(), "{angle} {place}");
                refused += usize::from(found);
            }
        }
    }
    // The first angle enters no entry.
    assert!(refused >= 4 * (N - 2), "{refused}");
    Ok(())
}

#[test]
fn a_mass_matrix_with_an_entry_that_is_no_number_is_refused() -> Result<(), Fault> {
    let h = Ur5::HANDLES;
    let [a, b, c] = [h.pan, h.lift, h.elbow];
    let [d, e, f] = [h.wrist_1, h.wrist_2, h.wrist_3];
    let reversed = [f, e, d, c, b, a];
    refuses_masses::<Ur5, 6>([a, b, c, d, e, f], reversed, |state| state.pairs_mut())?;
    let h = Panda::HANDLES;
    let [a, b, c, d] = [h.joint_1, h.joint_2, h.joint_3, h.joint_4];
    let [e, f, g] = [h.joint_5, h.joint_6, h.joint_7];
    let reversed = [g, f, e, d, c, b, a];
    refuses_masses::<Panda, 7>([a, b, c, d, e, f, g], reversed, |state| state.pairs_mut())
}

/// A rod that stands on a hinge with a torsion spring, under a load.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse])]
struct Strut {
    #[input]
    load: f64,
    #[input]
    side: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.5])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    foot: Revolute,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], stiffness = 10.0)]
    spring: TorsionalSpringDamper,
    #[force(between = [ground, rod], point = [0.0, 0.0, 1.0], force = [0.0, side, -load])]
    weight: PointForce,
}

/// The branching of one coordinate was told at the end of the step that passes it; and a walk with
/// a small imperfection ended at the first step that led to another branch.
#[test]
fn a_strut_buckles() -> Result<(), Fault> {
    use core::ops::ControlFlow;
    use holonom::independent::{BranchEnd, Continuation, PointKind};
    let h = Strut::HANDLES;
    for (from, to) in [
        (0.0, 30.0),
        (0.0, 11.0),
        (0.3, 30.0),
        (9.5, 30.0),
        (30.0, 0.0),
    ] {
        let mut space = Strut::default().coordinates([h.foot])?;
        space.set_value(h.load, from)?;
        let (upright, mut found) = (space.state([0.0], [0.0])?, Vec::new());
        let end = space.follow(&upright, Continuation::new(h.load, to), |point| {
            if point.kind != PointKind::Regular {
                found.push((point.kind, point.value));
            }
            ControlFlow::Continue(())
        })?;
        assert_eq!(end, BranchEnd::Reached);
        let [(PointKind::Branching, load)] = found[..] else {
            panic!("{from} to {to}: {found:?}")
        };
        assert!((load - 10.0).abs() < 1e-9, "{from} to {to}: {load}");
    }
    for side in [1e-2, 1e-3, 1e-4, 1e-6] {
        let mut space = Strut::default().coordinates([h.foot])?;
        space.set_value(h.side, side)?;
        let start = space.equilibrium(&space.state([0.0], [0.0])?)?;
        let mut last = 0.0;
        let end = space.follow(&start, Continuation::new(h.load, 12.0), |point| {
            last = space.positions(&point.state).map_or(f64::NAN, |at| at[0]);
            ControlFlow::Continue(())
        })?;
        assert_eq!(end, BranchEnd::Reached);
        // `10 q = 12 sin(q) + side cos(q)` of the angle away from upright.
        let q = last.abs();
        let left = 10.0 * q - 12.0 * q.sin() - side * q.cos();
        assert!(left.abs() < 1e-9 && q > 0.5, "{side}: {q} leaves {left}");
    }
    Ok(())
}
