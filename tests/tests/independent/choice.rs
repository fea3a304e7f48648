//! What can be chosen, and what cannot.

use holonom::error::{AnalysisFault, AssemblyFault};
use holonom::mechanism::HasInverse;
use holonom::prelude::*;
use holonom_models::{CartPole, FourBar, HeavyTop, SliderCrank};

fn refused<M: HasInverse + Default, const N: usize>(
    chosen: impl holonom::independent::Chosen<M, N>,
) -> Fault {
    match M::default().coordinates(chosen) {
        Ok(_) => panic!("it was to be refused"),
        Err(fault) => fault,
    }
}

#[test]
fn choices_are_refused_by_name() {
    let h = CartPole::HANDLES;
    let one = refused::<CartPole, 1>([h.hinge]);
    assert_eq!(
        one.to_string(),
        "the mechanism has 2 degrees of freedom: choose as many coordinates, not 1"
    );
    let twice = refused::<CartPole, 2>([h.hinge, h.hinge]);
    assert_eq!(
        twice.to_string(),
        "the motion of joint `hinge` was chosen twice"
    );
    let ball = refused::<HeavyTop, 3>([HeavyTop::HANDLES.tip; 3]);
    assert_eq!(
        ball.to_string(),
        "`tip` has 3 motions: choose one of them by `Motion::of(tip, 0)` to `Motion::of(tip, 2)`"
    );
    let h = SliderCrank::HANDLES;
    let closing = refused::<SliderCrank, 1>([h.slider_pin]);
    assert_eq!(
        closing,
        Fault::Assembly(AssemblyFault::CarriesNothing {
            joint: "slider_pin",
            instead: Some("crank_pin")
        })
    );
}

/// At a dead point the slider does not determine the crank.
#[test]
fn a_choice_that_fails_names_what_can_move() -> Result<(), Fault> {
    let (crank, h) = (SliderCrank::default(), SliderCrank::HANDLES);
    let by_slider = crank.coordinates([h.guide])?;
    let by_crank = crank.coordinates([h.bearing])?;
    let regular = by_crank.state([0.8], [3.0])?;
    let (mass, ratio) = (
        by_crank.mass(&regular)?[0],
        by_slider.rates(&regular)[0] / 3.0,
    );
    assert!((by_slider.mass(&regular)?[0] * ratio * ratio / mass - 1.0).abs() < 1e-12);
    for angle in [0.0, 1e-9] {
        let dead = by_crank.state([angle], [3.0])?;
        assert!(by_crank.mass(&dead).is_ok());
        let wanted = Fault::Analysis(AnalysisFault::NotDetermined { joint: "crank_pin" });
        assert_eq!(by_slider.mass(&dead).err(), Some(wanted));
    }
    Ok(())
}

/// On the line of all links a parallelogram has two motions.
#[test]
fn a_branch_point_is_refused() -> Result<(), Fault> {
    let (bar, h) = (FourBar::default(), FourBar::HANDLES);
    let space = bar.coordinates([h.left_foot])?;
    let near = space.state([1.5], [1.0])?;
    assert!(space.mass(&near).is_ok());
    assert!(matches!(
        space.state_near(&near, [core::f64::consts::FRAC_PI_2], [1.0]),
        Err(Fault::Analysis(AnalysisFault::NotDetermined { .. }))
    ));
    Ok(())
}

/// Angular velocities of a ball are rates of no coordinates; everything else is there.
#[test]
fn a_ball_has_rates_and_no_positions() -> Result<(), Fault> {
    let (top, h) = (HeavyTop::default(), HeavyTop::HANDLES);
    let space = top.coordinates([0, 1, 2].map(|k| Motion::of(h.tip, k)))?;
    let state = space.of_bodies(&top.described_state()?);
    assert_eq!(
        space.positions(&state),
        Err(Fault::Analysis(AnalysisFault::NoPosition { joint: "tip" }))
    );
    assert!((space.rates(&state) - nalgebra::Vector3::new(0.0, 150.0, -4.61538)).norm() < 1e-12);
    let mass = space.mass(&state)?;
    let wanted = nalgebra::Matrix3::from_diagonal(&[15.234375, 0.46875, 15.234375].into());
    assert!((mass - wanted).norm() < 1e-13);
    Ok(())
}

/// In single precision, and in motion by a driver's time.
#[test]
fn single_precision() -> Result<(), Fault> {
    let (cart, h) = (CartPole::default(), CartPole::HANDLES);
    let (single, double) = (
        cart.coordinates_in::<f32, 2>((h.rail, h.hinge))?,
        cart.coordinates((h.rail, h.hinge))?,
    );
    let a = single.state([0.5, 0.3], [1.0, -2.0])?;
    let b = double.state([0.5, 0.3], [1.0, -2.0])?;
    let (a, b) = (single.mass(&a)?, double.mass(&b)?);
    assert!((a.cast::<f64>() - b).norm() < 1e-6 * b.norm());
    Ok(())
}

holonom::joint! {
    /// Two turns about axes that cross, and the angle of one: no joint of the library has both.
    pub joint Cross(i, j; point: Point, axis_i: Axis, axis_j: Axis) {
        j.point - i.point;
        dot(i.axis_i, j.axis_j);
        angle about axis_i;
        motion turn axis_i at point, turn axis_j at point;
    }
}

#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass])]
struct Gimbal {
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.3], position = [0.0, 0.0, 0.5])]
    upper: Body,
    #[joint(
        between = [ground, upper],
        point = [0.0, 0.0, 0.0],
        axis_i = [1.0, 0.0, 0.0],
        axis_j = [0.0, 1.0, 0.0]
    )]
    cross: Cross,
}

/// The account of turns is that of the joint's angle: the other turn is told from `-pi` to `pi`.
#[test]
fn of_several_turns_none_is_counted_for_another() -> Result<(), Fault> {
    let (gimbal, h) = (Gimbal::default(), Gimbal::HANDLES);
    for order in [[0, 1], [1, 0]] {
        let chosen = order.map(|number| Motion::of(h.cross, number));
        let space = gimbal.coordinates(chosen)?;
        for set in [[-0.5, 4.0], [0.2, 7.0], [3.0, -3.0]] {
            let state = space.state(set, [0.0, 0.0])?;
            for (found, wanted) in space.positions(&state)?.iter().zip(set) {
                let turns = (found - wanted) / core::f64::consts::TAU;
                assert!(
                    (turns - turns.round()).abs() < 1e-14 && found.abs() <= core::f64::consts::PI
                );
            }
        }
    }
    Ok(())
}
