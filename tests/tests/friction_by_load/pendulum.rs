//! A rod that swings on a hinge with a radius, until it stays.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;

use super::reference::PENDULUM;
use super::tight;

/// A rod of 1 m on a hinge about x, released from the horizontal.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Rod {
    #[body(mass = 2.0, inertia = [1.0 / 6.0, 0.001, 1.0 / 6.0], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn swings<C: Coordinates<Rod>, F: Formulation<f64>>(formulation: F, bounds: [f64; 2]) {
    let (rod, h) = (Rod::default(), Rod::HANDLES);
    let friction = Interaction::friction_by_load(h.hinge, 0.6).radius(0.05);
    let mut stops = Vec::new();
    let mut before = None;
    let report = Simulation::new(&rod, formulation, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions([friction])
        .run(0.0..=30.0, every(30.0), |sample| -> Result<(), Fault> {
            // A change of modes is shown on both of its sides.
            let now = (sample.time(), sample.mode(0)?);
            if let Some((time, mode)) = before
                && time == now.0
                && mode != now.1
            {
                stops.push([time, sample.angle(h.hinge)]);
            }
            before = Some(now);
            if sample.time() == 30.0 {
                assert_eq!(now.1, Mode::Sticking);
                // What holds it: the moment of its weight.
                let effort = 9.81 * sample.angle(h.hinge).cos();
                let found = sample.effort(0)?;
                assert!((found - effort).abs() < bounds[1], "{found} {effort}");
            }
            Ok(())
        })
        .expect("it swings");
    assert_eq!(stops.len(), PENDULUM.len(), "{stops:?}");
    for (found, wanted) in stops.iter().zip(&PENDULUM) {
        for (found, wanted) in found.iter().zip(wanted) {
            let error = (found - wanted).abs();
            assert!(error < bounds[0], "{found} {wanted} {error:e}");
        }
    }
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn a_rod_stops_where_a_reduction_of_its_own_says() {
    swings::<Relative, _>(StandardLagrange, [1e-9, 1e-9]);
    swings::<Absolute, _>(StandardLagrange, [1e-9, 1e-9]);
    let baumgarte = Baumgarte {
        alpha: 5.0,
        beta: 5.0,
    };
    swings::<Absolute, _>(baumgarte, [1e-9, 1e-9]);
}

/// The radius is a factor of the coefficient.
#[test]
fn coefficient_and_radius_are_a_product() {
    let (rod, h) = (Rod::default(), Rod::HANDLES);
    let ends = [(0.6, 0.05), (0.3, 0.1)].map(|(mu, radius)| {
        let friction = Interaction::friction_by_load(h.hinge, mu).radius(radius);
        let report = rod
            .simulation(StandardLagrange, DormandPrince::new(tight()))
            .interactions([friction])
            .run(0.0..=1.0, every(1.0), |_| ())
            .expect("it swings");
        rod.view(1.0, &report.state).expect("a view").angle(h.hinge)
    });
    assert!((ends[0] - ends[1]).abs() < 1e-12, "{ends:?}");
}
