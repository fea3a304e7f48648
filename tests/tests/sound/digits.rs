//! Steps that the digits of a number type, or a limit of the user's, keep from becoming small
//! enough.

use holonom::error::StepFault;
use holonom::joints::{Distance, Revolute};
use holonom::prelude::*;

/// A rod on a hinge, a kilometre from the origin.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Far {
    #[body(mass = 2.0, inertia = [0.2, 0.01, 0.2], position = [1000.0, 1000.5, 1000.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [1000.0, 1000.0, 1000.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

/// A violation is seen to 6e-5 m, and hard coefficients make accelerations of that, which no step
/// is short enough for.
#[test]
fn a_tolerance_below_the_digits_of_a_position_is_named() {
    let far = Far::default();
    let method = Baumgarte::new(100.0_f32, 100.0);
    let run = |absolute| {
        let ode45 = DormandPrince::new(Tolerance {
            relative: 1e-6,
            absolute,
        });
        Simulation::new(&far, method, ode45)
            .run(0.0..=10.0, every(0.1), |_| ControlFlow::Continue(()))
            .map_err(Box::new)
    };
    let error = run(1e-9).expect_err("below what the digits tell");
    println!("{error}");
    let Fault::Step(StepFault::SizeUnderflow {
        is_least: false,
        joint: None,
        resolution: Some(resolution),
        ..
    }) = error.fault
    else {
        panic!("{error}");
    };
    assert_eq!(resolution, f64::from(1000.5_f32.next_up() - 1000.5));
    assert!(
        error
            .fault
            .to_string()
            .contains("positions of this size are known to 6.1e-5 m"),
        "{error}"
    );
    // What it says helps.
    run(1e-2).expect("as coarse as the digits are");
}

#[test]
fn a_least_step_is_said_to_be_one() {
    let far = Far::default();
    let ode45 = DormandPrince::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-12,
    })
    .least_step(0.1);
    let error = Simulation::new(&far, StandardLagrange, ode45)
        .run(0.0..=10.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("a tenth of a second is too long");
    assert!(
        error.fault.to_string().starts_with(
            "the error of a step of 0.1 s, the least that may be taken, is beyond the tolerance; "
        ),
        "{error}"
    );
}

/// A bead that flies away from the wire that holds it.
#[derive(Mechanism)]
struct Bead {
    #[body(mass = 1.0, position = [0.0, size, 0.0], velocity = [0.4 * size, 0.9 * size, 0.3 * size])]
    bead: Particle,
    #[joint(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, size, 0.0])]
    wire: Distance,
    #[param]
    size: f64,
}

/// The equation of a distance is one of square metres: of a small mechanism it is a small number,
/// and no round-off.
#[test]
fn velocities_of_small_mechanisms_are_corrected() {
    for exponent in 0..=10 {
        let size = 10.0_f64.powi(-exponent);
        let bead = Bead::new(size).expect("acceptable");
        let mut state = bead.described_state::<f32>().expect("acceptable");
        bead.assemble(0.0, &mut state).expect("it converges");
        let [along, away, across] = *state.velocities();
        println!("{size:e} m: {along:e} {away:e} {across:e} m/s");
        assert!(f64::from(away).abs() < 1e-3 * size, "{size}");
        assert!(
            (f64::from(along) - 0.4 * size).abs() < 1e-3 * size,
            "{size}"
        );
    }
}
