//! Linearisation, against closed forms.

use core::f64::consts::PI;

use holonom::independent::to_discrete;
use holonom::mechanism::ValueHandle;
use holonom::prelude::*;
use holonom_models::{CartPole, FlyballGovernor, HeavyTop};
use nalgebra::{Matrix2, Matrix4, SMatrix};

/// Florian's equations, about upright: `theta'' (l (4/3 - m / M)) = g theta - F / M`, with `l` half
/// of the pole, `m` its mass and `M` all.
#[test]
fn a_cart_pole() -> Result<(), Fault> {
    let (cart, h) = (CartPole::default(), CartPole::HANDLES);
    let space = cart.coordinates((h.rail, h.hinge))?;
    // Angles count from the described one, 0.1 rad from upright.
    let upright = space.state([0.0, -0.1], [0.0, 0.0])?;
    let linear = space.linearise(&upright, [h.push], |view| {
        [
            view.displacement(h.rail),
            view.angle(h.hinge),
            view.velocity(h.pole).x,
        ]
    })?;
    let (pole, all, half, g) = (0.1, 1.1, 0.5, 9.81);
    let length = half * (4.0 / 3.0 - pole / all);
    let (fall, push) = (g / length, -1.0 / (all * length));
    let share = pole * half / all;
    let wanted = Matrix4::new(
        0.0,
        0.0,
        1.0,
        0.0, //
        0.0,
        0.0,
        0.0,
        1.0, //
        0.0,
        -share * fall,
        0.0,
        0.0, //
        0.0,
        fall,
        0.0,
        0.0,
    );
    let a: Matrix4<f64> = linear.a();
    assert!((a - wanted).amax() < 1e-12, "{a}{wanted}");
    let b = linear.b::<4>();
    let wanted = nalgebra::Vector4::new(0.0, 0.0, 1.0 / all - share * push, push);
    assert!((b - wanted).amax() < 1e-13, "{b}{wanted}");
    let wanted = SMatrix::<f64, 3, 4>::from_row_slice(&[
        1.0, 0.0, 0.0, 0.0, //
        0.0, 1.0, 0.0, 0.0, //
        0.0, 0.0, 1.0, half,
    ]);
    assert!((linear.c::<4>() - wanted).amax() < 1e-14);
    assert_eq!(linear.d().amax(), 0.0);
    Ok(())
}

/// A sleeping top: with `A` across and `C` along the spin `w`, turns across it obey
/// `A t'' = (A - C) w^2 t + m g l t` in its own axes, coupled by `(C - 2 A) w`.
#[test]
fn a_top() -> Result<(), Fault> {
    let (top, h) = (HeavyTop::default(), HeavyTop::HANDLES);
    let space = top.coordinates([0, 1, 2].map(|k| Motion::of(h.tip, k)))?;
    // Upright: what lies along y in the reference configuration stands along z.
    let mut bodies = top.described_state::<f64>()?;
    let upright = nalgebra::Quaternion::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0, 0.0);
    top.set_relative_orientation(&mut bodies, h.tip, upright)?;
    let w = 7.0;
    let state = space.with_rates(&space.of_bodies(&bodies), [0.0, w, 0.0])?;
    let linear = space.linearise(&state, [], |_| [])?;
    let a: SMatrix<f64, 6, 6> = linear.a();
    let (across, along, weight) = (15.234375, 0.46875, 15.0 * 9.81);
    // Axes x, y (the spin) and z; turns t and rates r.
    let gyroscopic = (along - across) * w / across;
    let mut wanted = SMatrix::<f64, 6, 6>::zeros();
    for k in 0..3 {
        wanted[(k, k + 3)] = 1.0;
    }
    // `t' = r - w x t`.
    (wanted[(0, 2)], wanted[(2, 0)]) = (-w, w);
    (wanted[(3, 0)], wanted[(5, 2)]) = (weight / across, weight / across);
    (wanted[(3, 5)], wanted[(5, 3)]) = (gyroscopic, -gyroscopic);
    assert!((a - wanted).amax() < 1e-11, "{a}{wanted}");
    Ok(())
}

/// A pendulum over a step: `exp(A t)` has sines and cosines; also over many turns.
#[test]
fn discrete_steps() {
    let w = 3.0_f64;
    let a = Matrix2::new(0.0, 1.0, -w * w, 0.0);
    let b = nalgebra::Vector2::new(0.0, 1.0);
    for dt in [1e-3, 0.4, 20.0] {
        let (step, input) = to_discrete(&a, &b, dt);
        let (sine, cosine) = (w * dt).sin_cos();
        let wanted = Matrix2::new(cosine, sine / w, -w * sine, cosine);
        assert!(
            (step - wanted).amax() < 1e-14 * (1.0 + 10.0 * w * dt),
            "{dt}: {step}{wanted}"
        );
        let wanted = nalgebra::Vector2::new((1.0 - cosine) / (w * w), sine / w);
        assert!((input - wanted).amax() < 1e-14 * (1.0 + 10.0 * w * dt));
    }
}

/// Four bars of given lengths between two bearings.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(
    gravity = [0.0, -9.81, 0.0],
    redundant = "drop",
    coordinates = "joints",
    kernels = [mass, inverse, jacobian]
)]
pub(super) struct Linkage {
    #[param(like = 0.3)]
    crank_length: f64,
    #[param(like = 0.8)]
    rod_length: f64,
    #[param(like = 1.2)]
    crank_mass: f64,
    #[body(mass = crank_mass, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5 * crank_length, 0.0])]
    crank: Body,
    #[body(
        mass = 0.8,
        inertia = [0.2, 0.2, 0.2],
        position = [0.5 * rod_length, crank_length, 0.0]
    )]
    rod: Body,
    #[body(mass = 1.1, inertia = [0.3, 0.3, 0.3], position = [rod_length, 0.2 + 0.5 * crank_length, 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    foot: Revolute,
    #[joint(between = [crank, rod], point = [0.0, crank_length, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [rod, rocker], point = [rod_length, crank_length, 0.0], axis = [0.0, 0.0, 1.0])]
    knee: Revolute,
    #[joint(
        between = [rocker, ground],
        point = local([0.0, -0.1 - 0.5 * crank_length, 0.0], [0.9, -0.1, 0.0]),
        axis = [0.0, 0.0, 1.0]
    )]
    end: Revolute,
}

/// Derivatives by lengths of a closed loop, which moves what is not chosen, and by a mass.
#[test]
fn parameters_of_a_loop() -> Result<(), Fault> {
    let numbers = [0.3, 0.8, 1.2];
    let made = |[a, b, c]: [f64; 3]| Linkage::new(a, b, c);
    let linkage = made(numbers)?;
    let h = Linkage::HANDLES;
    let values: [ValueHandle<Linkage>; 3] = [h.crank_length, h.rod_length, h.crank_mass];
    let at = |linkage: &Linkage| linkage.coordinates([h.foot]);
    let space = at(&linkage)?;
    let state = space.state([-0.3], [1.7])?;
    let linear = space.linearise(&state, values, |view| [view.position(h.rocker).x])?;
    let step = 1e-6;
    for value in 0..3 {
        let found = [-step, step].map(|by| -> Result<[f64; 2], Fault> {
            let mut numbers = numbers;
            numbers[value] += by;
            let other = made(numbers)?;
            let space = at(&other)?;
            let state = space.state([-0.3], [1.7])?;
            let x = other.view(0.0, &space.bodies(&state))?.position(h.rocker).x;
            Ok([space.forward(&state, [0.0])?[0], x])
        });
        let [before, after] = [found[0]?, found[1]?];
        let wanted = [0, 1].map(|k| (after[k] - before[k]) / (2.0 * step));
        let found = [linear.by_values[(0, value)], linear.d()[(0, value)]];
        for (found, wanted) in found.into_iter().zip(wanted) {
            let error = (found - wanted).abs() / (1.0 + wanted.abs());
            assert!(error < 1e-7, "{value}: {found} for {wanted}");
        }
    }
    Ok(())
}

/// Around a steady turn the governor's shaft keeps its angular momentum.
#[test]
fn a_governor() -> Result<(), Fault> {
    let (governor, h) = (FlyballGovernor::default(), FlyballGovernor::HANDLES);
    let space = governor.coordinates((h.bearing, h.guide, h.right_hinge, h.left_hinge))?;
    let state = space.of_bodies(&governor.described_state()?);
    let linear = space.linearise(&state, [], |_| [])?;
    // Nothing depends on the angle of the shaft.
    assert_eq!(linear.by_positions.column(0).amax(), 0.0);
    // Arms sink and rise together or against each other.
    let a = linear.a::<8>();
    for row in 4..6 {
        assert!((a[(row, 2)] - a[(row, 3)]).abs() < 1e-9 * a.amax());
    }
    assert!((a[(6, 2)] - a[(7, 3)]).abs() < 1e-9 * a.amax());
    Ok(())
}

/// Two rods of 1 m and 3 kg.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
struct DoublePendulum {
    #[body(mass = 3.0, inertia = [0.25, 0.25, 0.001], position = [0.0, 0.0, -0.5])]
    upper: Body,
    #[body(mass = 3.0, inertia = [0.25, 0.25, 0.001], position = [0.0, 0.0, -1.5])]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.0, 0.0, -1.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}

/// In the angles of the rods from the vertical `M = [4 1.5; 1.5 1]` and `K = g diag(4.5, 1.5)`; the
/// elbow is their difference. Inverted, or folded over, `K` and couplings change their signs.
#[test]
fn a_double_pendulum() -> Result<(), Fault> {
    let (pendulum, h) = (DoublePendulum::default(), DoublePendulum::HANDLES);
    let space = pendulum.coordinates([h.shoulder, h.elbow])?;
    let g = 9.81;
    let turned = Matrix2::new(1.0, 0.0, 1.0, 1.0);
    let back = Matrix2::new(1.0, 0.0, -1.0, 1.0);
    for (positions, sides) in [
        ([0.0, 0.0], [1.0, 1.0]),
        ([PI, 0.0], [-1.0, -1.0]),
        ([0.0, PI], [1.0, -1.0]),
    ] {
        let state = space.state(positions, [0.0, 0.0])?;
        let linear = space.linearise(&state, [], |_| [])?;
        let coupling = 1.5 * sides[0] * sides[1];
        let inverse = Matrix2::new(1.0, -coupling, -coupling, 4.0) / (4.0 - 2.25);
        let stiffness = Matrix2::new(4.5 * g * sides[0], 0.0, 0.0, 1.5 * g * sides[1]);
        let wanted = -back * inverse * stiffness * turned;
        let off = (linear.by_positions - wanted).amax();
        assert!(off < 1e-10, "{positions:?}: {off:.1e}");
        let wanted = back * inverse * back.transpose();
        assert!((linear.by_efforts - wanted).amax() < 1e-12);
        assert!(linear.by_rates.amax() < 1e-12 && linear.rates_by_positions.amax() == 0.0);
    }
    // `1.75 x^2 - 10.5 g x + 6.75 g^2 = 0` for squares of frequencies, or of rates of falling.
    let squares = [-1.0, 1.0].map(|sign| g * (10.5 + sign * 63.0_f64.sqrt()) / 3.5);
    for angle in [0.0, PI] {
        let state = space.state([angle, 0.0], [0.0, 0.0])?;
        let modes = space.linearise(&state, [], |_| [])?.modes();
        for square in squares {
            let near = |mode: &f64| (mode - square.sqrt()).abs() < 1e-10;
            let rates = modes.iter().map(|mode| {
                if angle == 0.0 {
                    mode.angular_frequency()
                } else {
                    mode.rate.re
                }
            });
            assert_eq!(rates.filter(near).count(), 1, "{angle}: {modes:?}");
        }
    }
    Ok(())
}
