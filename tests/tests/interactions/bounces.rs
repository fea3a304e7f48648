//! Impacts on limits, and rest on them.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode;

use super::{Ball, GRAVITY, tight};

fn comes_to_rest<C: Coordinates<Ball>>() {
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let restitution = 0.5;
    let mut rests = None;
    let report = Simulation::new(&ball, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions([
            // The rail's displacement is zero at the height 1 m.
            Interaction::limits(h.rail.displacement(), [-1.0, f64::INFINITY])
                .restitution(restitution),
        ])
        .run(0.0..=3.0, every(0.01), |sample| {
            let x = sample.displacement(h.rail);
            assert!(x > -1.0 - 1e-12, "{x}");
            if sample.mode(0) == Ok(InteractionMode::AtLower) {
                rests.get_or_insert(sample.time());
                let effort = sample.effort(0).expect("one interaction");
                assert!((effort - GRAVITY).abs() < 1e-10, "{effort}");
                assert!((x + 1.0).abs() < 1e-14, "{x}");
            }
        })
        .expect("it bounces and rests");
    let fall = (2.0 / GRAVITY).sqrt();
    let wanted = fall * (1.0 + restitution) / (1.0 - restitution);
    let rests = rests.expect("it comes to rest");
    assert!(
        rests < wanted + 0.01 && rests > wanted - 1e-3,
        "{rests} {wanted}"
    );
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn a_ball_comes_to_rest_after_infinitely_many_bounces() {
    comes_to_rest::<Relative>();
    comes_to_rest::<Absolute>();
}
