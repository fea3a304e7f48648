//! Switches by the state: motions that are put together from closed forms.

use core::f64::consts::{FRAC_PI_2, TAU};

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, DormandPrince853, GeneralizedAlpha, RadauIIA, Runs,
};

use super::{run, tight};

/// `x'' = -sign x` from `x = 1`, as the length less 9 m.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct BangBang {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, slider], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-9.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0],
        force = -sign(length - 10.0 + 1.0)
    )]
    motor: Actuator,
}

/// The place `t` seconds after the start at 1 m: arcs of parabolas, with a period of `4 sqrt(2)`.
pub(super) fn arcs(t: f64) -> f64 {
    let quarter = 2.0_f64.sqrt();
    let phase = t.rem_euclid(4.0 * quarter);
    let (sign, phase) = if phase > quarter && phase < 3.0 * quarter {
        (-1.0, phase - 2.0 * quarter)
    } else if phase > 2.0 * quarter {
        (1.0, phase - 4.0 * quarter)
    } else {
        (1.0, phase)
    };
    sign * (1.0 - 0.5 * phase * phase)
}

/// By how much ten periods are off.
fn bang_bang<I, C>(integrator: I) -> f64
where
    C: Coordinates<BangBang>,
    I: Runs<Problem<BangBang, StandardLagrange, f64, C>>,
{
    let (mechanism, h) = (BangBang::default(), BangBang::HANDLES);
    let (mut worst, end) = (0.0_f64, 40.0 * 2.0_f64.sqrt());
    run::<_, _, C>(&mechanism, integrator, end, every(0.5), |sample| {
        let error = sample.pose(h.slider).position.x - arcs(sample.time());
        worst = worst.max(error.abs());
    });
    worst
}

#[test]
fn a_force_by_the_sign_of_the_place_is_right_after_ten_periods() {
    let tolerance = |relative: f64| Tolerance {
        relative,
        absolute: relative,
    };
    // Of order 2 and more, which are exact on parabolas, the time of the switch is as well.
    let exact = [
        bang_bang::<_, Relative>(Rk4::every(1e-2)),
        bang_bang::<_, Absolute>(Rk4::every(1e-2)),
        bang_bang::<_, Relative>(Rk4::every(1e-3)),
        bang_bang::<_, Relative>(DormandPrince::new(tolerance(1e-6))),
        bang_bang::<_, Absolute>(DormandPrince::new(tolerance(1e-6))),
        bang_bang::<_, Absolute>(DormandPrince::new(tolerance(1e-10))),
        bang_bang::<_, Relative>(DormandPrince853::default()),
        bang_bang::<_, Relative>(AdamsBashforthMoulton4::every(1e-2)),
        bang_bang::<_, Absolute>(GeneralizedAlpha::every(4e-3)),
    ];
    for (index, error) in exact.iter().enumerate() {
        assert!(*error < 1e-11, "{index}: {exact:?}");
    }
    let close = [
        bang_bang::<_, Relative>(Adams::new(tight())),
        bang_bang::<_, Absolute>(Adams::new(tight())),
        bang_bang::<_, Relative>(RadauIIA::default()),
        bang_bang::<_, Absolute>(RadauIIA::default()),
        bang_bang::<_, Relative>(Bdf::new(tight())),
        bang_bang::<_, Absolute>(Bdf::new(tight())),
    ];
    for (index, error) in close.iter().enumerate() {
        assert!(*error < 1e-8, "{index}: {close:?}");
    }
}

const PLAY: f64 = 0.3;
const STIFFNESS: f64 = 25.0;

/// A mass of 1 kg between two springs that it touches beyond a play: one expression by its sign and
/// its size, and one by its excess.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", kernels = [mass, inverse])]
pub(super) struct Backlash {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, slider], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-9.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0],
        force = -STIFFNESS * sign(length - 9.0) * max(0.0, abs(length - 9.0) - PLAY)
    )]
    springs: Actuator,
}

/// The place `t` seconds after the start at 1 m.
fn with_play(t: f64) -> f64 {
    let (w, size) = (STIFFNESS.sqrt(), 1.0 - PLAY);
    let (touching, coasting) = (FRAC_PI_2 / w, 2.0 * PLAY / (size * w));
    let half = 2.0 * touching + coasting;
    let sign = if (t / half).rem_euclid(2.0) < 1.0 {
        1.0
    } else {
        -1.0
    };
    let phase = t.rem_euclid(half);
    sign * if phase < touching {
        PLAY + size * (w * phase).cos()
    } else if phase < touching + coasting {
        PLAY - size * w * (phase - touching)
    } else {
        -PLAY - size * (w * (phase - touching - coasting)).sin()
    }
}

fn backlash<I, C>(integrator: I) -> f64
where
    C: Coordinates<Backlash>,
    I: Runs<Problem<Backlash, StandardLagrange, f64, C>>,
{
    let (mechanism, h) = (Backlash::default(), Backlash::HANDLES);
    let mut worst = 0.0_f64;
    run::<_, _, C>(&mechanism, integrator, 8.0, every(0.1), |sample| {
        let error = sample.pose(h.slider).position.x - with_play(sample.time());
        worst = worst.max(error.abs());
    });
    worst
}

#[test]
fn a_backlash_keeps_the_order_of_the_method() {
    let expressions = Backlash::SWITCHES.iter().map(|switch| switch.expression);
    let expressions: Vec<_> = expressions.collect();
    assert_eq!(expressions, ["length - 9.0", "-(abs(length - 9.0) - PLAY)"]);
    // The fourth order, by halving the step.
    let steps = [2e-2, 1e-2, 5e-3];
    let errors = steps.map(|step| backlash::<_, Relative>(Rk4::every(step)));
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!(ratio > 11.0 && ratio < 24.0, "{errors:?}");
    }
    assert!(errors[2] < 1e-5, "{errors:?}");
    let absolute = backlash::<_, Absolute>(Rk4::every(5e-3));
    assert!((absolute / errors[2] - 1.0).abs() < 1e-3, "{absolute:e}");
    for error in [
        backlash::<_, Relative>(DormandPrince::new(tight())),
        backlash::<_, Absolute>(DormandPrince::new(tight())),
        backlash::<_, Relative>(DormandPrince853::new(tight())),
        backlash::<_, Relative>(Adams::new(tight())),
        backlash::<_, Relative>(RadauIIA::new(tight())),
    ] {
        assert!(error < 1e-8, "{error:e}");
    }
}

const MOST: f64 = 3.0;
const GAIN: f64 = 8.0;
const TARGET: f64 = 2.0;

/// A wheel under a controller of limited moment.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Limited {
    #[body(mass = 1.0, inertia = [0.5, 0.5, 0.5])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    axle: Revolute,
    #[force(
        between = [ground, wheel], axis = [0.0, 0.0, 1.0],
        moment = max(-MOST, min(MOST, GAIN * (TARGET - angle)))
    )]
    motor: TorsionalActuator,
}

#[test]
fn a_controller_of_limited_moment_swings_in_time() {
    // At the limit up to the angle where the gain asks for less, then a harmonic arc, then at the
    // other limit up to twice the target, where it rests and turns back.
    let (acceleration, band) = (MOST / 0.5, MOST / GAIN);
    let limited = (2.0 * (TARGET - band) / acceleration).sqrt();
    let w = (GAIN / 0.5).sqrt();
    let arc = 2.0 * (band * w / (acceleration * limited)).atan() / w;
    let half = 2.0 * limited + arc;
    let (mechanism, h) = (Limited::default(), Limited::HANDLES);
    let ends = |periods: f64, reports: f64| {
        let mut ends = Vec::new();
        let end = periods * half;
        let mut see = |sample: &Sample<'_, f64, Limited>| {
            ends.push([sample.angle(h.axle), sample.angle_rate(h.axle)]);
        };
        run::<_, _, Relative>(
            &mechanism,
            DormandPrince::new(tight()),
            end,
            every(reports),
            &mut see,
        );
        run::<_, _, Absolute>(
            &mechanism,
            DormandPrince::new(tight()),
            end,
            every(reports),
            &mut see,
        );
        ends
    };
    let wrapped = |angle: f64| (angle + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
    for (periods, wanted) in [(1.0, 2.0 * TARGET), (2.0, 0.0), (5.0, 2.0 * TARGET)] {
        for [angle, rate] in ends(periods, 100.0).chunks(2).map(|ends| ends[1]) {
            assert!(wrapped(angle - wanted).abs() < 1e-9, "{angle}");
            assert!(rate.abs() < 1e-9, "{rate}");
        }
    }
}

/// Two of them side by side: two switches pass their zeros at one instant, over and over.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Pair {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, k, 0.0])]
    sliders: [Body; 2],
    #[joint(between = [ground, sliders[k]], point = [1.0, k, 0.0], axis = [1.0, 0.0, 0.0])]
    rails: [Prismatic; 2],
    #[force(
        between = [ground, sliders[k]], head = [-9.0, k, 0.0], tail = [1.0, k, 0.0],
        force = if length > 9.0 { if k == 0 { -1.0 } else { -4.0 } } else { 1.0 + 3.0 * k }
    )]
    motors: [Actuator; 2],
    #[force(
        between = [ground, sliders[0]], head = [-9.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0],
        force = if 18.0 < 2.0 * length || !(length <= 9.0) { 0.5 } else { -0.5 }
    )]
    against: Actuator,
}

#[test]
fn several_switches_at_one_instant() {
    // With half the force, and with four times as much: periods that meet.
    let (mechanism, h) = (Pair::default(), Pair::HANDLES);
    let names: Vec<_> = Pair::SWITCHES.iter().map(|switch| switch.law).collect();
    assert_eq!(names, ["motors[0]", "motors[1]", "against", "against"]);
    for by_joints in [false, true] {
        let mut see = |sample: &Sample<'_, f64, Pair>| {
            for (slider, force) in h.sliders.into_iter().zip([0.5_f64, 4.0]) {
                let wanted = arcs(force.sqrt() * sample.time());
                let error = sample.pose(slider).position.x - wanted;
                assert!(error.abs() < 1e-10, "{error:e} at {}", sample.time());
            }
        };
        let method = DormandPrince::default();
        if by_joints {
            run::<_, _, Relative>(&mechanism, method, 30.0, every(0.5), &mut see);
        } else {
            run::<_, _, Absolute>(&mechanism, method, 30.0, every(0.5), &mut see);
        }
    }
}
