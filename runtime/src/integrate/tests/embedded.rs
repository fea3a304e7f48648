//! The embedded pairs besides that of `ode45`.

use super::{Moves, curve, curved, distance, equation, errors, order, span};
use crate::integrate::{
    Advance as _, BogackiShampine, DormandPrince853, Integration as _, Integrator as _, Tolerance,
};

#[test]
fn bogacki_and_shampine_have_order_three_at_and_within_steps() {
    let coarse = errors(BogackiShampine::every(0.02));
    let fine = errors(BogackiShampine::every(0.01));
    assert!(
        (order((coarse.0, fine.0)) - 3.0).abs() < 0.1,
        "{coarse:?} {fine:?}"
    );
    assert!(
        (order((coarse.1, fine.1)) - 3.0).abs() < 0.15,
        "{coarse:?} {fine:?}"
    );
}

#[test]
fn dormand_and_prince_have_order_eight_and_an_interpolant_of_order_seven() {
    let coarse = errors(DormandPrince853::every(0.2));
    let fine = errors(DormandPrince853::every(0.1));
    assert!(order((coarse.0, fine.0)) > 7.7, "{coarse:?} {fine:?}");
    // Within steps an error of order h^8, which is that of an interpolant of order 7.
    assert!(order((coarse.1, fine.1)) > 7.5, "{coarse:?} {fine:?}");
}

/// Evaluations, accepted and rejected steps, and the largest error at ends and in middles of steps.
fn run(method: impl Moves<2>, is_looked_into: bool) -> (usize, usize, usize, f64) {
    let mut system = equation(curved);
    let mut integration = method
        .start(&mut system, span(5.0, 5.0), curve(0.0))
        .unwrap();
    let mut worst = 0.0_f64;
    while integration.time() < 5.0 {
        let start = integration.time();
        integration.advance(&mut system).unwrap();
        worst = worst.max(distance(*integration.state(), curve(integration.time())));
        if is_looked_into {
            for part in [0.3, 0.5, 0.9] {
                let time = start + part * (integration.time() - start);
                let state = integration.at(&mut system, time).unwrap();
                worst = worst.max(distance(state, curve(time)));
            }
        }
    }
    let counts = integration.counts();
    (counts.evaluations, counts.accepted, counts.rejected, worst)
}

fn tolerance(relative: f64) -> Tolerance<f64> {
    Tolerance {
        relative,
        absolute: 1e-3 * relative,
    }
}

#[test]
fn both_keep_their_tolerance() {
    for relative in [1e-3, 1e-5, 1e-7] {
        let (.., worst) = run(BogackiShampine::new(tolerance(relative)), true);
        assert!(worst < 30.0 * relative, "{worst:e} at {relative:e}");
    }
    for relative in [1e-6, 1e-9, 1e-12] {
        let (.., worst) = run(DormandPrince853::new(tolerance(relative)), true);
        assert!(worst < 30.0 * relative, "{worst:e} at {relative:e}");
    }
}

#[test]
fn evaluations_are_counted_those_of_output_with_them() {
    let (evaluations, accepted, rejected, _) = run(BogackiShampine::new(tolerance(1e-6)), true);
    assert_eq!(evaluations, 3 * (accepted + rejected) + 1);
    let (bare, accepted, rejected, _) = run(DormandPrince853::new(tolerance(1e-9)), false);
    assert_eq!(bare, 12 * (accepted + rejected) + 1);
    let (looked, again, _, _) = run(DormandPrince853::new(tolerance(1e-9)), true);
    assert_eq!((looked, again), (bare + 3 * accepted, accepted));
}

#[test]
fn an_order_pays_where_it_is_asked_for() {
    let evaluations = |relative, is_high| {
        let tolerance = tolerance(relative);
        if is_high {
            run(DormandPrince853::new(tolerance), false).0
        } else {
            run(BogackiShampine::new(tolerance), false).0
        }
    };
    assert!(evaluations(1e-2, false) < evaluations(1e-2, true));
    assert!(10 * evaluations(1e-9, true) < evaluations(1e-9, false));
}

#[test]
fn a_course_that_is_copied_goes_on_alike() {
    let mut system = equation(curved);
    let method = DormandPrince853::new(tolerance(1e-9));
    let mut integration = method
        .start(&mut system, span(5.0, 5.0), curve(0.0))
        .unwrap();
    integration.advance(&mut system).unwrap();
    let mut copy = integration.clone();
    integration.advance(&mut system).unwrap();
    copy.advance(&mut system).unwrap();
    assert_eq!(
        (integration.time(), integration.state()),
        (copy.time(), copy.state())
    );
    let middle = 0.9 * integration.time();
    assert_eq!(
        integration.at(&mut system, middle),
        copy.at(&mut system, middle)
    );
}
