//! Equilibria and natural motions, against closed forms.

use holonom::error::AnalysisFault;
use holonom::prelude::*;
use holonom_models::{CartPole, RodPendulum, SliderCrank};
use nalgebra::{SMatrix, SVector};

/// Watt's governor: two balls on arms that hinge on the axis of the shaft.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
struct Watt {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    shaft: Body,
    #[body(mass = 2.0, inertia = [1e-3, 1e-3, 1e-3], position = [0.4, 0.0, -0.3])]
    right: Body,
    #[body(mass = 2.0, inertia = [1e-3, 1e-3, 1e-3], position = [-0.4, 0.0, -0.3])]
    left: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [shaft, right], point = [0.0, 0.0, 0.0], axis = [0.0, -1.0, 0.0])]
    right_hinge: Revolute,
    #[joint(between = [shaft, left], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    left_hinge: Revolute,
}

/// The height of the cone is `g / w^2`, whatever the arms are; modes are those of arms that swing
/// about it.
#[test]
fn a_governor_stands_as_high_as_its_speed_says() -> Result<(), Fault> {
    let (watt, h) = (Watt::default(), Watt::HANDLES);
    let space = watt.coordinates((h.bearing, h.right_hinge, h.left_hinge))?;
    for speed in [4.6, 5.0, 7.0, 20.0] {
        let guess = space.state([0.3, 0.1, 0.1], [speed, 0.0, 0.0])?;
        let steady = space.equilibrium(&guess)?;
        let bodies = space.bodies(&steady);
        let view = watt.view(0.0, &bodies)?;
        for ball in [h.right, h.left] {
            let height = -view.position(ball).z;
            let wanted = 9.81 / (speed * speed);
            assert!(
                (height / wanted - 1.0).abs() < 1e-12 * (1.0 + speed),
                "{speed}: {height}"
            );
        }
        assert!((space.rates(&steady)[0] - speed).abs() < 1e-13);
        // Against each other, at the speed of the shaft, arms swing with `w sin(angle)`, but for
        // their own inertia.
        let cosine = 9.81 / (speed * speed * 0.5);
        let wanted = speed * ((1.0 - cosine * cosine) * 0.5 / 0.501).sqrt();
        let modes = space.linearise(&steady, [], |_| [])?.modes();
        let near = modes
            .iter()
            .map(|mode| (mode.angular_frequency() / wanted - 1.0).abs());
        assert!(
            near.fold(1.0, f64::min) < 1e-7,
            "{speed}: {modes:?} for {wanted}"
        );
    }
    Ok(())
}

/// About steady turning at `w`. An arm of length `r` is at an angle from the vertical, with
/// `c = cos` and `s = sin`; `J` is of all about the axis. Arms obey
/// `(m r^2 + I) q'' = 2 m r^2 s c w p' - m r^2 w^2 s^2 q`, and the turn
/// `J p'' = -2 m r^2 s c w (q_1' + q_2')`.
#[test]
fn a_governor_is_linear_about_its_turning() -> Result<(), Fault> {
    let (watt, h) = (Watt::default(), Watt::HANDLES);
    let space = watt.coordinates((h.bearing, h.right_hinge, h.left_hinge))?;
    for speed in [4.6, 7.0, 20.0] {
        let guess = space.state([0.3, 0.1, 0.1], [speed, 0.0, 0.0])?;
        let steady = space.equilibrium(&guess)?;
        let a: SMatrix<f64, 6, 6> = space.linearise(&steady, [], |_| [])?.a();
        let cosine = 9.81 / (speed * speed * 0.5);
        let square = 1.0 - cosine * cosine;
        let arm = 2.0 * 0.25 + 1e-3;
        let turning = 0.1 + 2.0 * (1e-3 + 0.5 * square);
        let coupling = square.sqrt() * cosine * speed;
        let mut wanted = SMatrix::<f64, 6, 6>::zeros();
        for k in 0..3 {
            wanted[(k, k + 3)] = 1.0;
        }
        for arm_row in [4, 5] {
            wanted[(arm_row, arm_row - 3)] = -0.5 * speed * speed * square / arm;
            wanted[(arm_row, 3)] = coupling / arm;
            wanted[(3, arm_row)] = -coupling / turning;
        }
        let off = (a - wanted).amax() / wanted.amax();
        assert!(off < 1e-10, "{speed}: {off:.1e} {a}{wanted}");
    }
    Ok(())
}

/// A swing at a rate is no steady motion, and says so.
#[test]
fn what_is_not_steady_is_refused() -> Result<(), Fault> {
    let (watt, h) = (Watt::default(), Watt::HANDLES);
    let space = watt.coordinates((h.bearing, h.right_hinge, h.left_hinge))?;
    let guess = space.state([0.3, 0.1, 0.1], [6.0, 0.5, 0.0])?;
    assert_eq!(
        space.equilibrium(&guess),
        Err(Fault::Analysis(AnalysisFault::NotSteady {
            joint: "right_hinge"
        }))
    );
    Ok(())
}

/// A crank with a weight in its rod hangs below its bearing; nothing else is an equilibrium near.
#[test]
fn a_loop_hangs() -> Result<(), Fault> {
    let (crank, h) = (SliderCrank::default(), SliderCrank::HANDLES);
    let space = crank.coordinates([h.bearing])?;
    let rest = space.equilibrium(&space.state([-1.0], [0.0])?)?;
    let angle = space.positions(&rest)?[0];
    assert!(
        (angle + core::f64::consts::FRAC_PI_2).abs() < 1e-12,
        "{angle}"
    );
    let modes = space.linearise(&rest, [], |_| [])?.modes();
    assert_eq!(modes.len(), 1);
    assert!(modes[0].rate.re.abs() < 1e-12 && modes[0].rate.im > 1.0);
    Ok(())
}

#[test]
fn a_pole_falls_and_a_rod_swings() -> Result<(), Fault> {
    let (cart, h) = (CartPole::default(), CartPole::HANDLES);
    let space = cart.coordinates((h.rail, h.hinge))?;
    let upright = space.equilibrium(&space.state([0.4, 0.1], [0.0, 0.0])?)?;
    let positions = space.positions(&upright)?;
    assert!((positions[1] + 0.1).abs() < 1e-13 && (positions[0] - 0.4).abs() < 1e-6);
    let modes = space.linearise(&upright, [], |_| [])?.modes();
    let fall = (9.81_f64 / (0.5 * (4.0 / 3.0 - 0.1 / 1.1))).sqrt();
    let grows = modes
        .iter()
        .filter(|mode| (mode.rate.re - fall).abs() < 1e-10);
    assert_eq!(grows.count(), 1, "{modes:?}");
    let (rod, h) = (RodPendulum::default(), RodPendulum::HANDLES);
    let space = rod.coordinates([h.pivot])?;
    let rest = space.equilibrium(&space.state([-0.9], [0.0])?)?;
    let modes = space.linearise(&rest, [], |_| [])?.modes();
    let shape = SVector::from(modes[0].shape.map(|entry| entry.re));
    assert_eq!((modes.len(), shape[0]), (1, 1.0));
    assert!(modes[0].damping_ratio().abs() < 1e-12);
    Ok(())
}
