//! A slider-crank with friction by its loads, in its slide and in the bearing of its crank.

use std::f64::consts::FRAC_PI_2;

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;

use super::reference::SLIDER_CRANK;
use super::tight;

/// Crank 0.1 m and rod 0.3 m in the plane of x and y, a slide along x; the crank stands upright at
/// 5 rad/s.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = "both")]
struct SliderCrank {
    #[input]
    torque: f64,
    #[body(mass = 1.0, inertia = [0.01 / 12.0, 0.01 / 12.0, 0.01 / 12.0], position = [0.0, 0.05, 0.0],
           velocity = [-0.25, 0.0, 0.0], angular_velocity = [0.0, 0.0, 5.0])]
    crank: Body,
    #[body(mass = 0.8, inertia = [0.006, 0.006, 0.006], position = [0.14142135623730950, 0.05, 0.0],
           velocity = [-0.5, 0.0, 0.0])]
    rod: Body,
    #[body(mass = 0.5, inertia = [0.01, 0.01, 0.01], position = [0.28284271247461900, 0.0, 0.0],
           velocity = [-0.5, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, rod], point = [0.0, 0.1, 0.0])]
    pin: Spherical,
    #[joint(between = [ground, slider], point = [0.28284271247461900, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    slide: Prismatic,
    #[joint(between = [rod, slider], point = [0.28284271247461900, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    gudgeon: Cylindrical,
    #[force(between = [ground, crank], axis = [0.0, 0.0, 1.0], moment = torque - 0.3 * rate)]
    motor: TorsionalActuator,
}

fn driven(torque: f64) -> SliderCrank {
    SliderCrank {
        torque,
        ..SliderCrank::default()
    }
}

fn turns<C: Coordinates<SliderCrank>, F: Formulation<f64>>(formulation: F, bound: f64) {
    let (crank, h) = (driven(2.0), SliderCrank::HANDLES);
    let report = Simulation::new(&crank, formulation, DormandPrince::new(tight()))
        .coordinates::<C>()
        .projection(Projection::default())
        .interactions([
            Interaction::friction_by_load(h.slide, 0.2),
            Interaction::friction_by_load(h.bearing, 0.3).radius(0.02),
        ])
        .run(0.0..=2.0, every(0.1), |sample| {
            let time = sample.time();
            let known = SLIDER_CRANK.iter().find(|row| (row[0] - time).abs() < 1e-9);
            if let Some([_, angle, rate, _]) = known {
                let found = sample.angle(h.bearing) + FRAC_PI_2;
                let error = (found - angle).sin().abs();
                assert!(error < bound, "{time}: {found} {angle} {error:e}");
                let found = sample.angle_rate(h.bearing);
                let error = (found - rate).abs();
                assert!(error < 10.0 * bound, "{time}: {found} {rate} {error:e}");
            }
        })
        .expect("it turns");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn a_slider_crank_turns_as_a_reduction_of_its_own_says() {
    turns::<Relative, _>(StandardLagrange, 1e-9);
    turns::<Absolute, _>(StandardLagrange, 1e-9);
    let baumgarte = Baumgarte {
        alpha: 5.0,
        beta: 5.0,
    };
    turns::<Relative, _>(baumgarte, 1e-9);
    turns::<Absolute, _>(baumgarte, 1e-9);
}

/// The work of both frictions, by Simpson's rule over their efforts.
fn work(end: f64, steps: usize) -> f64 {
    let (crank, h) = (driven(2.0), SliderCrank::HANDLES);
    let mut powers: Vec<f64> = Vec::new();
    let mut last = f64::NAN;
    let interval = end / steps as f64;
    let frictions = [
        Interaction::friction_by_load(h.slide, 0.2),
        Interaction::friction_by_load(h.bearing, 0.3).radius(0.02),
    ];
    let [on_slide, in_bearing] = Interaction::handles(&frictions);
    crank
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(frictions)
        .run(0.0..=end, every(interval), |sample| -> Result<(), Fault> {
            let step = (sample.time() / interval).round();
            let is_report = (sample.time() - step * interval).abs() < 1e-12;
            if is_report && step != last {
                let slide = sample.effort(on_slide)? * sample.displacement_rate(h.slide);
                let bearing = sample.effort(in_bearing)? * sample.angle_rate(h.bearing);
                powers.push(slide + bearing);
                last = step;
            }
            Ok(())
        })
        .expect("it turns");
    assert_eq!(powers.len(), steps + 1);
    let weight = |step: usize| match step {
        0 => 1.0,
        step if step == steps => 1.0,
        step => 2.0 + 2.0 * (step % 2) as f64,
    };
    let sum = powers.iter().enumerate();
    interval / 3.0 * sum.map(|(step, power)| weight(step) * power).sum::<f64>()
}

#[test]
fn the_work_of_friction_is_that_of_the_reduction() {
    // Up to 0.1 s nothing jumps. At a dead point the load of the bearing does, with the friction of
    // the slide: the rule then has an error of the order of its interval.
    for (row, steps, bound) in [(0, 800, 1e-9), (1, 4000, 2e-5)] {
        let [end, .., wanted] = SLIDER_CRANK[row];
        let found = work(end, steps);
        assert!(
            (found - wanted).abs() < bound && wanted < -0.1,
            "{found} {wanted}"
        );
    }
}

fn rests<C: Coordinates<SliderCrank>>() -> [f64; 2] {
    let (crank, h) = (driven(0.0), SliderCrank::HANDLES);
    let mut angles = Vec::new();
    let report = Simulation::new(&crank, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .projection(Projection::default())
        .interactions([
            Interaction::friction_by_load(h.slide, 0.3),
            Interaction::friction_by_load(h.bearing, 0.4).radius(0.03),
        ])
        .run(0.0..=1000.0, every(500.0), |sample| {
            if sample.time() > 400.0 {
                angles.push(sample.angle(h.bearing));
            }
        })
        .expect("it comes to rest");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    let [first, last] = angles[..] else {
        panic!("{angles:?}");
    };
    assert!((first - last).abs() < 1e-11, "{first} {last}");
    [
        first,
        crank
            .view(1000.0, &report.state)
            .expect("a view")
            .angle_rate(h.bearing),
    ]
}

/// Without a torque it comes to rest, where either friction may hold it.
#[test]
fn a_slider_crank_comes_to_rest_and_stays() {
    let [joints, bodies] = [rests::<Relative>(), rests::<Absolute>()];
    assert!(
        (joints[0] - bodies[0]).abs() < 1e-8,
        "{joints:?} {bodies:?}"
    );
    assert!(joints[1].abs() < 1e-12, "{joints:?}");
}
