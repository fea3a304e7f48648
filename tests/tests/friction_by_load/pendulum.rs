//! A rod that swings on a hinge with a radius, until it stays.

use holonom::RadauIIA;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode as Mode;
use holonom_fixtures::Rod;

use super::reference::PENDULUM;
use super::tight;

fn swings<C: Coordinates<Rod>, F: Formulation<f64>>(formulation: F, bounds: [f64; 2]) {
    let (rod, h) = (Rod::default(), Rod::HANDLES);
    let frictions = [Interaction::friction_by_load(h.hinge, 0.6).radius(0.05)];
    let [friction] = Interaction::handles(&frictions);
    let mut stops = Vec::new();
    let mut before = None;
    let report = Simulation::new(&rod, formulation, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(frictions)
        .run(0.0..=30.0, every(30.0), |sample| -> Result<(), Fault> {
            // A change of modes is shown on both of its sides.
            let now = (sample.time(), sample.mode(friction)?);
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
                let found = sample.effort(friction)?;
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

/// The load is that of every stage, so methods keep their order, and implicit ones take it as well.
#[test]
fn methods_keep_their_order() {
    let (rod, h) = (Rod::default(), Rod::HANDLES);
    let friction = || Interaction::friction_by_load(h.hinge, 0.6).radius(0.05);
    let fixed = |steps: u32| {
        let report = rod
            .simulation(StandardLagrange, Rk4::every(0.8 / f64::from(steps)))
            .interactions([friction()])
            .run(0.0..=0.8, every(0.8), |_| ())
            .expect("it swings");
        rod.view(0.8, &report.state).expect("a view").angle(h.hinge)
    };
    let adaptive = |tolerance: Tolerance<f64>| {
        let report = rod
            .simulation(StandardLagrange, RadauIIA::new(tolerance))
            .interactions([friction()])
            .run(0.0..=0.8, every(0.8), |_| ())
            .expect("it swings");
        rod.view(0.8, &report.state).expect("a view").angle(h.hinge)
    };
    let report = rod
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions([friction()])
        .run(0.0..=0.8, every(0.8), |_| ())
        .expect("it swings");
    let exact = rod.view(0.8, &report.state).expect("a view").angle(h.hinge);
    let errors = [20, 40, 80].map(|steps| (fixed(steps) - exact).abs());
    for pair in errors.windows(2) {
        assert!(pair[0] / pair[1] > 14.0, "{errors:?}");
    }
    let implicit = adaptive(Tolerance {
        relative: 1e-10,
        absolute: 1e-10,
    });
    assert!((implicit - exact).abs() < 1e-8, "{implicit} {exact}");
}

/// With a penalty the load has the bias of its compliance.
#[test]
fn a_penalty_has_its_bias() {
    let (rod, h) = (Rod::default(), Rod::HANDLES);
    let swung = |alpha: Option<f64>| {
        let friction = Interaction::friction_by_load(h.hinge, 0.6).radius(0.05);
        let integrator = DormandPrince::new(tight());
        let report = match alpha {
            Some(alpha) => rod
                .simulation(Penalty::new(alpha, 10.0, 1.0), integrator)
                .absolute_coordinates()
                .interactions([friction])
                .run(0.0..=0.5, every(0.5), |_| ()),
            None => rod
                .simulation(StandardLagrange, integrator)
                .absolute_coordinates()
                .interactions([friction])
                .run(0.0..=0.5, every(0.5), |_| ()),
        };
        let state = report.expect("it swings").state;
        rod.view(0.5, &state).expect("a view").angle(h.hinge)
    };
    let exact = swung(None);
    let errors = [1e5, 1e6].map(|alpha| (swung(Some(alpha)) - exact).abs());
    let ratio = errors[0] / errors[1];
    assert!(errors[0] < 1e-3 && (ratio - 10.0).abs() < 1.0, "{errors:?}");
}
