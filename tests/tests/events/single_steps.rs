//! Steps of a `Stepper` up to an event.

use holonom::Heun;
use holonom::error::StepFault;
use holonom::integrate::{DormandPrince5, DormandPrince8};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::Steps;

use super::{Ball, GRAVITY};

fn bounces<K, C>(scheme: K, dt: f64)
where
    C: Coordinates<Ball>,
    K: Steps<Problem<Ball, StandardLagrange, f64, C>>,
{
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let mut stepper = Stepper::new(&ball, StandardLagrange, scheme)
        .expect("acceptable")
        .coordinates::<C>();
    let mut state = stepper.initial_state().expect("described");
    let floor = |view: &View<'_, f64, Ball>| view.pose(h.ball).position.z;
    let mut speed = (2.0 * GRAVITY).sqrt();
    let mut wanted = speed / GRAVITY;
    let mut found = 0;
    while stepper.time() < 2.4 {
        let time = stepper
            .step_until(&mut state, dt, Crossing::Falling, floor)
            .expect("it moves");
        let mut bodies = stepper.bodies(&state);
        let view = stepper.view(&bodies);
        assert!(floor(&view) > -1e-12);
        let Some(time) = time else { continue };
        assert_eq!(time, stepper.time());
        assert!((time - wanted).abs() < 1e-10, "{time} {wanted}");
        let rate = view.displacement_rate(h.rail);
        ball.set_displacement_rate(&mut bodies, h.rail, -0.7 * rate)
            .expect("free");
        state = stepper.state_of(&bodies).expect("closed");
        speed *= 0.7;
        wanted += 2.0 * speed / GRAVITY;
        found += 1;
    }
    assert!(found > 6 && wanted > 2.4, "{found}");
}

#[test]
fn a_ball_bounces_between_single_steps() {
    bounces::<_, Relative>(Rk4, 0.013);
    bounces::<_, Absolute>(Rk4, 0.013);
    bounces::<_, Relative>(Heun, 0.013);
    bounces::<_, Relative>(DormandPrince5, 0.1);
    bounces::<_, Absolute>(DormandPrince8, 0.1);
}

#[test]
fn a_whole_step_is_that_of_step() {
    let ball = Ball::default();
    let mut stepper = ball.stepper(StandardLagrange, Rk4).expect("fine");
    let mut state = stepper.initial_state().expect("described");
    let (mut other, mut same) = (stepper.clone(), state);
    for _ in 0..10 {
        other.step(&mut same, 0.01).expect("it falls");
        let found = stepper
            .step_until(&mut state, 0.01, Crossing::Either, |_| 1.0)
            .expect("it falls");
        assert_eq!(found, None);
        assert_eq!(state, same);
    }
    assert_eq!(stepper.time(), other.time());
    let before = state;
    let error = stepper
        .step_until(&mut state, 0.01, Crossing::Either, |_| f64::NAN)
        .expect_err("not a number");
    assert!(
        matches!(error, Fault::Step(StepFault::EventNotANumber { .. })),
        "{error}"
    );
    assert_eq!((state, stepper.time()), (before, other.time()));
}
