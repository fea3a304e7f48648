//! Inverse trigonometric functions in laws of forces, against their integrals.

use holonom::prelude::*;

/// A wheel on springs whose moments are inverse functions of the angle. No other mechanism of the
/// tests has a law with these.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "both")]
struct Wound {
    #[param]
    steep: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], angular_velocity = [0.0, 0.0, 1.0])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    axle: Revolute,
    #[force(between = [ground, wheel], axis = [0.0, 0.0, 1.0], moment = -asin(steep * angle))]
    first: TorsionalActuator,
    #[force(
        between = [ground, wheel], axis = [0.0, 0.0, 1.0],
        moment = acos(0.3 * angle) - acos(0.0) - 0.4 * atan(2.0 * angle) - 0.5 * atan2(angle, steep + 1.0)
    )]
    second: TorsionalActuator,
}

/// The energies of the moments: `x asin(x) + sqrt(1 - x^2)`, `x atan(x) - ln(1 + x^2) / 2`.
fn potential(steep: f64, angle: f64) -> f64 {
    let sine = |x: f64| x * x.asin() + (1.0 - x * x).sqrt() - 1.0;
    let tangent = |x: f64| x * x.atan() - 0.5 * (1.0 + x * x).ln();
    let far = steep + 1.0;
    sine(steep * angle) / steep
        + sine(0.3 * angle) / 0.3
        + 0.2 * tangent(2.0 * angle)
        + 0.5 * far * tangent(angle / far)
}

#[test]
fn laws_by_inverse_functions_keep_the_energy() {
    let h = Wound::HANDLES;
    for steep in [0.4, -0.7, 1.1] {
        let wound = Wound::new(steep).expect("finite");
        let tight = DormandPrince::new(Tolerance {
            relative: 1e-11,
            absolute: 1e-12,
        });
        let mut most: f64 = 0.0;
        let mut energy = |view: &View<'_, f64, Wound>| {
            let angle = view.angle(h.axle);
            most = most.max(angle.abs());
            let energy = view.kinetic_energy() + potential(steep, angle);
            assert!((energy - 0.1).abs() < 1e-9, "{energy} at {angle}");
        };
        let simulation = wound.simulation(StandardLagrange, tight);
        simulation
            .run(0.0..=3.0, every(0.05), |sample| energy(sample))
            .expect("regular");
        let simulation = wound
            .simulation(StandardLagrange, tight)
            .joint_coordinates();
        simulation
            .run(0.0..=3.0, every(0.05), |sample| energy(sample))
            .expect("regular");
        assert!(most > 0.2, "{most}");
    }
}

/// Beyond its domain a law has no value, and the run ends there and says so.
#[test]
fn beyond_its_domain_a_law_ends_the_run() {
    let wound = Wound::new(0.4).expect("finite");
    let mut start = wound.described_state::<f64>().expect("finite");
    Wound::set_angular_velocity(&mut start, Wound::HANDLES.wheel, [0.0, 0.0, 30.0].into());
    let end = wound
        .simulation(StandardLagrange, DormandPrince::default())
        .initial_state(start)
        .run(0.0..=3.0, every(0.05), |sample| {
            assert!(sample.angle(Wound::HANDLES.axle).abs() <= 2.5);
        })
        .expect_err("the law ends at 2.5 rad");
    assert!(end.time < 2.5 / 20.0, "{end}");
    assert!(end.to_string().contains("first"), "{end}");
    // A start beyond it is refused.
    let mut start = wound.described_state::<f64>().expect("finite");
    wound
        .set_angle(&mut start, Wound::HANDLES.axle, 2.6)
        .expect("free");
    let refused = wound
        .simulation(StandardLagrange, DormandPrince::default())
        .initial_state(start)
        .run(0.0..=3.0, every(0.05), |_| ());
    assert!(refused.is_err());
}
