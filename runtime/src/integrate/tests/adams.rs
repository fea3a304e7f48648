//! The methods of Adams of order 1 to 12.

use super::pairs::{Rods, Spinning, angles, compared, pairs, starts};
use super::{Equation, Moves, curve, curved, distance, equation, span};
use crate::Fault;
use crate::error::StartFault;
use crate::integrate::{
    Adams, Advance as _, Counts, DormandPrince, DormandPrince853, Integration as _,
    Integrator as _, Method, StepLimits, System, TimeSpan, Tolerance,
};

fn tolerance(relative: f64) -> Tolerance<f64> {
    Tolerance {
        relative,
        absolute: 1e-3 * relative,
    }
}

/// The state at the end of an interval, what it has cost, and the longest step.
fn run<I: Moves<N>, const N: usize>(
    method: I,
    mut rates: impl FnMut(f64, &[f64; N]) -> [f64; N],
    end: f64,
    start: [f64; N],
) -> ([f64; N], Counts, f64) {
    let (mut calls, mut longest) = (0, 0.0_f64);
    let mut system = equation(|time: f64, state: &[f64; N]| {
        assert!(time <= end, "{time}");
        calls += 1;
        rates(time, state)
    });
    let mut integration = method.start(&mut system, span(end, end), start).unwrap();
    while integration.time() < end {
        let from = integration.time();
        integration.advance(&mut system).unwrap();
        longest = longest.max(integration.time() - from);
    }
    let (state, counts) = (*integration.state(), integration.counts());
    assert_eq!(integration.time(), end);
    drop((integration, system));
    assert_eq!(counts.evaluations, calls);
    (state, counts, longest)
}

/// An ellipse of eccentricity 0.5 about the origin, ten times round: the distance from the start.
fn ellipse<I: Moves<4>>(method: I) -> (f64, Counts) {
    let rates = |_: f64, &[x, y, u, v]: &[f64; 4]| {
        let pull = (x * x + y * y).powf(-1.5);
        [u, v, -x * pull, -y * pull]
    };
    let start = [0.5, 0.0, 0.0, 3.0_f64.sqrt()];
    let ([x, y, ..], counts, _) = run(method, rates, 20.0 * core::f64::consts::PI, start);
    (distance([x, y], [0.5, 0.0]), counts)
}

/// The closed orbit of Arenstorf, once round: Hairer, Norsett and Wanner, *Solving Ordinary
/// Differential Equations I*, (II.0.1).
fn arenstorf<I: Moves<4>>(method: I) -> (f64, Counts) {
    let rates = |_: f64, &[x, y, u, v]: &[f64; 4]| {
        let moon = 0.012_277_471;
        let earth = 1.0 - moon;
        let d1 = ((x + moon).powi(2) + y * y).powf(1.5);
        let d2 = ((x - earth).powi(2) + y * y).powf(1.5);
        [
            u,
            v,
            x + 2.0 * v - earth * (x + moon) / d1 - moon * (x - earth) / d2,
            y - 2.0 * u - earth * y / d1 - moon * y / d2,
        ]
    };
    let start = [0.994, 0.0, 0.0, -2.001_585_106_379_082_5];
    let ([x, y, ..], counts, _) = run(method, rates, 17.065_216_560_157_964, start);
    (distance([x, y], [0.994, 0.0]), counts)
}

#[test]
fn errors_go_with_the_tolerance() {
    for exponent in 3..=13 {
        let relative = 10.0_f64.powi(-exponent);
        let method = Adams::new(tolerance(relative));
        let decay = |_: f64, &[y]: &[f64; 1]| [-y];
        let ([end], ..) = run(method, decay, 10.0, [1.0]);
        let error = (end - (-10.0_f64).exp()).abs();
        assert!(error < 100.0 * relative, "{error:e} at {relative:e}");
        let (end, ..) = run(method, curved, 10.0, curve(0.0));
        let error = distance(end, curve(10.0));
        assert!(error < 10.0 * relative, "{error:e} at {relative:e}");
        let spring = |_: f64, &[q, u]: &[f64; 2]| [u, -q];
        let (end, ..) = run(method, spring, 20.0, [1.0, 0.0]);
        let error = distance(end, [20.0_f64.cos(), -(20.0_f64.sin())]);
        assert!(error < 10.0 * relative, "{error:e} at {relative:e}");
        // Errors of an orbit grow with the square of the time.
        let (error, _) = ellipse(method);
        assert!(error < 1e4 * relative, "{error:e} at {relative:e}");
        let (error, _) = arenstorf(method);
        assert!(error < 300.0 * relative, "{error:e} at {relative:e}");
    }
}

/// Evaluations for an error, between runs at powers of ten, on logarithmic scales.
fn needed(error: f64, run: impl Fn(Tolerance<f64>) -> (f64, Counts)) -> f64 {
    let mut last = (f64::INFINITY, 0.0);
    for exponent in 3..=13 {
        let (found, counts) = run(tolerance(10.0_f64.powi(-exponent)));
        let cost = (counts.evaluations as f64).ln();
        if found <= error {
            let part = (last.0 / error).ln() / (last.0 / found).ln();
            return (last.1 + part * (cost - last.1)).exp();
        }
        last = (found, cost);
    }
    f64::INFINITY
}

/// At equal errors: half of what Dormand-Prince 5(4) takes and less, and less than 8(5,3).
#[test]
fn evaluations_are_fewer_than_those_of_runge_and_kutta() {
    for (error, more, most) in [(1e-4, 1.2, 1.0), (1e-6, 1.6, 1.3), (1e-8, 2.5, 1.3)] {
        let adams = needed(error, |tolerance| arenstorf(Adams::new(tolerance)));
        let fifth = needed(error, |tolerance| arenstorf(DormandPrince::new(tolerance)));
        let eighth = needed(error, |tolerance| {
            arenstorf(DormandPrince853::new(tolerance))
        });
        assert!(fifth > more * adams, "{error:e}: {fifth} {adams}");
        assert!(eighth > most * adams, "{error:e}: {eighth} {adams}");
    }
}

#[test]
fn a_trial_is_an_evaluation_and_an_accepted_step_one_more() {
    let pulse = |time: f64, &[y]: &[f64; 1]| [-y + 50.0 * (-200.0 * (time - 3.0).powi(2)).exp()];
    let (_, counts, _) = run(Adams::new(tolerance(1e-6)), pulse, 10.0, [1.0]);
    let Counts {
        evaluations,
        accepted,
        rejected,
    } = counts;
    assert!(rejected > 2, "{counts:?}");
    assert_eq!(evaluations, 1 + 2 * accepted + rejected);
}

/// A trial that is taken back leaves no trace: after some, an integration is as exact as without.
#[test]
fn rejections_do_not_cost_accuracy() {
    let exact = |time: f64| {
        // `y' = -y + g`, `g` a pulse of area one about 3 s: by a fine integration.
        let pulse =
            |time: f64, &[y]: &[f64; 1]| [-y + 50.0 * (-200.0 * (time - 3.0).powi(2)).exp()];
        run(DormandPrince853::new(tolerance(1e-13)), pulse, time, [1.0]).0[0]
    };
    let pulse = |time: f64, &[y]: &[f64; 1]| [-y + 50.0 * (-200.0 * (time - 3.0).powi(2)).exp()];
    for relative in [1e-5, 1e-8, 1e-11] {
        let ([end], ..) = run(Adams::new(tolerance(relative)), pulse, 4.0, [1.0]);
        let error = (end - exact(4.0)).abs();
        assert!(error < 100.0 * relative, "{error:e} at {relative:e}");
    }
    // A jump at 1 s: `y = t` before, `y = 1 - 2 (t - 1)` from there on.
    let jump = |time: f64, _: &[f64; 1]| [if time < 1.0 { 1.0 } else { -2.0 }];
    for relative in [1e-4, 1e-8, 1e-12] {
        let ([end], counts, _) = run(Adams::new(tolerance(relative)), jump, 2.0, [0.0]);
        assert!((end + 1.0).abs() < 10.0 * relative, "{end}");
        assert!(counts.evaluations < 400, "{counts:?}");
    }
}

#[test]
fn output_within_steps_is_as_exact_as_their_ends() {
    for exponent in 3..=12 {
        let relative = 10.0_f64.powi(-exponent);
        let mut system = equation(curved);
        let mut integration = Adams::new(tolerance(relative))
            .start(&mut system, span(10.0, 10.0), curve(0.0))
            .unwrap();
        let (mut at_ends, mut within, mut seed) = (relative, 0.0_f64, 1_u32);
        while integration.time() < 10.0 {
            let start = integration.time();
            integration.advance(&mut system).unwrap();
            let evaluations = integration.counts().evaluations;
            at_ends = at_ends.max(distance(*integration.state(), curve(integration.time())));
            for _ in 0..10 {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let part = f64::from(seed) / f64::from(u32::MAX);
                let time = start + part * (integration.time() - start);
                let state = integration.at(&mut system, time).unwrap();
                within = within.max(distance(state, curve(time)));
            }
            let end = integration.at(&mut system, integration.time()).unwrap();
            assert_eq!(
                (end, evaluations),
                (*integration.state(), integration.counts().evaluations)
            );
        }
        assert!(
            within < 3.0 * at_ends,
            "{within:e} {at_ends:e} at {relative:e}"
        );
    }
}

/// Pairs turn by what the slopes add up to: errors and steps are those of the angles.
#[test]
fn pairs_turn_as_angles_do() {
    for relative in [1e-4, 1e-7, 1e-10] {
        let method = Adams::new(tolerance(relative));
        for speed in [0.0, 4.0] {
            let ([turned], [plain], length) = compared(method, Spinning, [speed], 10.0);
            assert!(turned.abs() < 300.0 * relative, "{turned:e} {plain:e}");
            assert!(length < 4.0 * f64::EPSILON, "{length:e}");
        }
        let (turned, plain, length) = compared(method, Rods, [0.0; 2], 3.0);
        for (turned, plain) in turned.into_iter().zip(plain) {
            let largest = 1e4 * relative;
            assert!(
                turned.abs() < largest && plain.abs() < largest,
                "{turned:e} {plain:e}"
            );
        }
        assert!(length < 4.0 * f64::EPSILON, "{length:e}");
        let (of_pairs, of_angles) = starts([4.0]);
        let [mut turning, mut numbers] = [Counts::default(); 2];
        let mut system = pairs(Spinning);
        let mut integration = method
            .start(&mut system, span(10.0, 10.0), of_pairs)
            .unwrap();
        while integration.time() < 10.0 {
            integration.advance(&mut system).unwrap();
            turning = integration.counts();
        }
        let mut system = angles(Spinning);
        let mut integration = method
            .start(&mut system, span(10.0, 10.0), of_angles)
            .unwrap();
        while integration.time() < 10.0 {
            integration.advance(&mut system).unwrap();
            numbers = integration.counts();
        }
        let ratio = turning.accepted as f64 / numbers.accepted as f64;
        assert!((0.7..1.4).contains(&ratio), "{turning:?} {numbers:?}");
    }
}

/// A spring whose energy is put right after every step.
fn corrected(relative: f64, is_corrected: bool) -> (f64, Counts) {
    let mut system = equation(|_: f64, &[q, u]: &[f64; 2]| [u, -q]);
    let mut integration = Adams::new(tolerance(relative))
        .start(&mut system, span(50.0, 50.0), [1.0, 0.0])
        .unwrap();
    while integration.time() < 50.0 {
        integration.advance(&mut system).unwrap();
        if is_corrected {
            let [q, u] = *integration.state();
            let length = q.hypot(u);
            integration.replace([q / length, u / length]);
        }
    }
    let exact = [50.0_f64.cos(), -(50.0_f64.sin())];
    (distance(*integration.state(), exact), integration.counts())
}

#[test]
fn a_corrected_state_goes_on_at_its_step_and_order() {
    for relative in [1e-4, 1e-7, 1e-10] {
        let (_, plain) = corrected(relative, false);
        let (error, counts) = corrected(relative, true);
        let steps = counts.accepted as f64 / plain.accepted as f64;
        assert!((0.6..1.2).contains(&steps), "{plain:?} {counts:?}");
        assert!(error < 30.0 * relative, "{error:e} at {relative:e}");
        // One evaluation more for a step, but for the last.
        let Counts {
            evaluations,
            accepted,
            rejected,
        } = counts;
        assert_eq!(evaluations, 3 * accepted + rejected);
    }
    // Before any step.
    let mut system = equation(|_: f64, &[y]: &[f64; 1]| [-y]);
    let mut integration = Adams::<f64>::default()
        .start(&mut system, span(1.0, 1.0), [1.0])
        .unwrap();
    integration.replace([2.0]);
    while integration.time() < 1.0 {
        integration.advance(&mut system).unwrap();
    }
    assert!((integration.state()[0] - 2.0 * (-1.0_f64).exp()).abs() < 1e-5);
}

/// A slope and a state that are brought into a normal form together.
#[test]
fn states_are_renormalised_with_their_slopes() {
    struct Scaled(usize);
    impl System<f64> for Scaled {
        type State = [f64; 2];
        fn rates(&mut self, _: f64, &[a, b]: &[f64; 2]) -> Result<[f64; 2], Fault> {
            Ok([-b, a])
        }
        fn renormalise(&mut self, state: &mut [f64; 2], rates: Option<&mut [f64; 2]>) {
            let length = state[0].hypot(state[1]);
            *state = state.map(|x| x / length);
            let rates = rates.expect("they are known");
            *rates = rates.map(|x| x / length);
            self.0 += 1;
        }
    }
    let mut system = Scaled(0);
    let mut integration = Adams::new(tolerance(1e-7))
        .start(&mut system, span(20.0, 20.0), [1.0, 0.0])
        .unwrap();
    while integration.time() < 20.0 {
        integration.advance(&mut system).unwrap();
        let [a, b] = *integration.state();
        assert!((a.hypot(b) - 1.0).abs() < 1e-15);
    }
    assert_eq!(system.0, integration.counts().accepted);
    let exact = [20.0_f64.cos(), 20.0_f64.sin()];
    assert!(distance(*integration.state(), exact) < 1e-5);
}

#[test]
fn limits_are_kept() {
    let method = Adams::new(tolerance(1e-6));
    let wanted = StepLimits {
        first: Some(1e-3),
        least: Some(1e-9),
        largest: Some(0.05),
        evaluations: 5000,
    };
    let held = method
        .first_step(1e-3)
        .least_step(1e-9)
        .largest_step(0.05)
        .budget(5000);
    assert_eq!((held.limits, held.tolerance), (wanted, method.tolerance));
    assert_eq!(Method::<f64>::budget(&held), Some(5000));
    assert_eq!(Method::<f64>::tolerance(&held), Some(held.tolerance));
    let (_, _, free) = run(method, curved, 10.0, curve(0.0));
    let (end, _, longest) = run(held, curved, 10.0, curve(0.0));
    assert!(
        free > 0.1 && longest <= 0.05 * (1.0 + 1e-12),
        "{free} {longest}"
    );
    assert!(distance(end, curve(10.0)) < 1e-6);
    let mut system = equation(curved);
    let mut integration = held
        .start(&mut system, span(10.0, 10.0), curve(0.0))
        .unwrap();
    integration.advance(&mut system).unwrap();
    assert_eq!(integration.time(), 1e-3);
    for value in [0.0, -1.0, f64::NAN] {
        let start = held
            .least_step(value)
            .start(&mut system, span(1.0, 1.0), curve(0.0));
        assert!(matches!(
            start,
            Err(Fault::Start(StartFault::Setting { .. }))
        ));
    }
}

#[test]
fn single_precision_works_with_a_tolerance_beyond_its_digits() {
    let mut system: Equation<'_, _, 2> = equation(|_: f32, &[q, u]: &[f32; 2]| [u, -q]);
    let span = TimeSpan {
        start: 0.0,
        end: 5.0,
        first_output: 5.0,
    };
    let mut integration = Adams::new(Tolerance {
        relative: 1e-9_f32,
        absolute: 1e-9,
    })
    .start(&mut system, span, [1.0, 0.0])
    .unwrap();
    while integration.time() < 5.0 {
        integration.advance(&mut system).unwrap();
    }
    let [q, u] = integration.state().map(f64::from);
    let error = distance([q, u], [5.0_f64.cos(), -(5.0_f64.sin())]);
    assert!(
        error < 1e-5 && integration.counts().accepted < 500,
        "{error:e} {:?}",
        integration.counts()
    );
}

#[test]
fn a_course_that_is_copied_goes_on_alike() {
    let mut system = equation(curved);
    let mut integration = Adams::new(tolerance(1e-9))
        .start(&mut system, span(5.0, 5.0), curve(0.0))
        .unwrap();
    for _ in 0..20 {
        integration.advance(&mut system).unwrap();
    }
    let mut copy = integration.clone();
    integration.advance(&mut system).unwrap();
    copy.advance(&mut system).unwrap();
    assert_eq!(
        (integration.time(), integration.state()),
        (copy.time(), copy.state())
    );
}
