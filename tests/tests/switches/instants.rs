//! Switches by the time alone, which no step passes over, however long it is.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::spline::Spline;
use holonom::{Adams, Bdf, DormandPrince853, ImplicitMidpoint, RadauIIA, Runs};

use super::{run, tight, unwatched};

/// A mass of 1 kg at rest, pushed by a square wave of 10 N and 5 Hz.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Wave {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, slider], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-9.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0],
        force = 10.0 * sign(sin(10.0 * PI * time))
    )]
    motor: Actuator,
}

fn square_wave<I, C>(integrator: I) -> f64
where
    C: Coordinates<Wave>,
    I: Runs<Problem<Wave, StandardLagrange, f64, C>>,
{
    let (mechanism, h) = (Wave::default(), Wave::HANDLES);
    let report = unwatched::<_, _, C>(&mechanism, integrator, 5.0);
    // In each of 25 periods 10 m/s^2 over 0.1 s forth and back.
    let wanted = 1.0 + 25.0 * 10.0 * 0.1 * 0.1;
    (Wave::pose(&report.state, h.slider).position.x - wanted).abs()
}

#[test]
fn a_square_wave_loses_no_half_of_a_period() {
    assert!(Wave::SWITCHES[0].is_of_time);
    let errors = [
        square_wave::<_, Relative>(DormandPrince::default()),
        square_wave::<_, Absolute>(DormandPrince::default()),
        square_wave::<_, Relative>(DormandPrince853::default()),
        // Steps of two and a half periods, of one, and such as no period is a multiple of.
        square_wave::<_, Relative>(Rk4::every(0.5)),
        square_wave::<_, Absolute>(Rk4::every(0.2)),
        square_wave::<_, Relative>(Rk4::every(0.03)),
        square_wave::<_, Relative>(ImplicitMidpoint::every(0.5)),
    ];
    for (index, error) in errors.iter().enumerate() {
        assert!(*error < 1e-11, "{index}: {errors:?}");
    }
    let errors = [
        square_wave::<_, Relative>(RadauIIA::default()),
        square_wave::<_, Absolute>(Adams::new(tight())),
        square_wave::<_, Relative>(Bdf::new(tight())),
    ];
    for (index, error) in errors.iter().enumerate() {
        assert!(*error < 1e-8, "{index}: {errors:?}");
    }
}

/// A particle at rest, and one pulse of a newton second in 10 s.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Pulse {
    #[param]
    start: f64,
    #[param]
    width: f64,
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0])]
    bead: Particle,
    #[joint(between = [ground, bead], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    wire: PointOnLine,
    #[force(
        between = [ground, bead], head = [-9.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0],
        force = if time > start && time < start + width { 1.0 / width } else { 0.0 }
    )]
    pulse: Actuator,
}

fn pulse<I, C>((start, width): (f64, f64), integrator: I)
where
    C: Coordinates<Pulse>,
    I: Runs<Problem<Pulse, StandardLagrange, f64, C>>,
{
    let mechanism = Pulse::new(start, width).expect("acceptable");
    let report = unwatched::<_, _, C>(&mechanism, integrator, 10.0);
    let speed = Pulse::velocity(&report.state, Pulse::HANDLES.bead).x;
    // Times of this size have so many digits.
    let digits = 8.0 * f64::EPSILON * start / width;
    assert!(
        (speed - 1.0).abs() < digits + 1e-12,
        "{speed} at {start} for {width}"
    );
}

#[test]
fn no_pulse_is_missed_and_none_is_cut() {
    for k in 0..12 {
        for width in [0.1, 0.01, 1e-3, 1e-6] {
            let at = (0.37 + 0.77 * f64::from(k), width);
            pulse::<_, Relative>(at, DormandPrince::default());
            if k % 4 == 0 {
                pulse::<_, Absolute>(at, DormandPrince::default());
                pulse::<_, Relative>(at, DormandPrince::new(tight()));
                pulse::<_, Absolute>(at, DormandPrince853::new(tight()));
                pulse::<_, Relative>(at, Rk4::every(0.5));
                pulse::<_, Relative>(at, Adams::default());
                pulse::<_, Relative>(at, RadauIIA::default());
            }
        }
    }
}

const BLINKS: Spline<4> = Spline::natural([0.0, 1.0, 2.0, 3.0], [1.0, -1.0, 1.0, -1.0]);
const RATE: f64 = 4.0;

/// Rates that are integrals of laws of the time.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Windows {
    #[state(rate = if time < 1.0 { 2.0 } else if time < 2.5 { -1.0 } else { 0.5 })]
    nested: f64,
    // Met at its start, and touched without being passed.
    #[state(rate = sign((time - 1.0) * (time - 1.0) * time))]
    touched: f64,
    // Rests at zero, then leaves it.
    #[state(rate = sign(smooth_step(time - 1.25)))]
    late: f64,
    // Comes to rest at zero.
    #[state(rate = sign(smooth_step(1.25 - time)))]
    early: f64,
    #[state(rate = sign(max(0.0, 2.0 - time)) - sign(max(0.0, time - 2.5)))]
    two: f64,
    // Passes zero faster and faster.
    #[state(rate = sign(sin(RATE * PI * time * time)))]
    chirp: f64,
    // One side decides about another, which jumps with it.
    #[state(rate = sign(sin(2.0 * PI * time) + 2.0 * sign(time - 1.5)))]
    jumping: f64,
    #[state(rate = abs(exp(-time) - 0.25))]
    distance: f64,
    #[state(rate = if BLINKS(time) > 0.0 { 1.0 } else { 0.0 })]
    blinks: f64,
    #[state(rate = min(time, max(1.0, 3.0 - time)))]
    tent: f64,
    #[body(free, mass = 1.0)]
    stone: Particle,
}

#[test]
fn windows_of_time_are_integrals() {
    const END: f64 = 3.0;
    let (mechanism, h) = (Windows::default(), Windows::HANDLES);
    // 4 pi t^2 is a multiple of pi where 4 t^2 is an integer.
    let mut chirp = 0.0;
    let turns = 36;
    for k in 0..turns {
        let [from, to] = [k, k + 1].map(|k| (f64::from(k) / RATE).sqrt());
        chirp += if k % 2 == 0 { to - from } else { from - to };
    }
    // The natural spline through these points passes zero at 0.5, 1.5 and 2.5 s: it is odd there.
    let dark = 4.0_f64.ln();
    let distance = (1.0 - 0.25) - 0.25 * dark + 0.25 * (END - dark) - (0.25 - (-END).exp());
    let wanted = [
        (h.nested, 2.0 - 1.5 + 0.25),
        (h.touched, 3.0),
        (h.late, 1.75),
        (h.early, 1.25),
        (h.two, 1.5),
        (h.chirp, chirp),
        (h.jumping, 0.0),
        (h.distance, distance),
        (h.blinks, 1.5),
        // t up to 1.5, 3 - t up to 2, then 1.
        (h.tent, 1.125 + 0.5 * (1.5 + 1.0) * 0.5 + 1.0),
    ];
    let see = |state: &StateOf<Windows>| {
        for (number, (of, wanted)) in wanted.into_iter().enumerate() {
            let found = Windows::state_value(state, of);
            assert!(
                (found - wanted).abs() < 1e-9,
                "{number}: {found} and {wanted}"
            );
        }
    };
    let tight = DormandPrince::new(tight());
    see(&run::<_, _, Relative>(&mechanism, tight, END, every(END), |_| ()).state);
    see(&run::<_, _, Absolute>(&mechanism, tight, END, every(END), |_| ()).state);
    see(&run::<_, _, Relative>(&mechanism, Rk4::every(0.01), END, every(END), |_| ()).state);
}

/// An input decides, and is no event.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Asked {
    #[input]
    wish: f64,
    #[param]
    bound: f64,
    #[state(rate = max(-bound, min(bound, wish)) + if bound > 2.0 { 1.0 } else { 0.0 })]
    way: f64,
    #[body(free, mass = 1.0)]
    stone: Particle,
}

#[test]
fn what_no_run_changes_by_itself_is_no_switch() {
    assert!(Asked::SWITCHES.is_empty());
    for (bound, more) in [(1.5, 0.0), (2.5, 1.0)] {
        let mechanism = Asked::new(bound).expect("acceptable");
        let report = mechanism
            .simulation(StandardLagrange, Rk4::every(0.01))
            .every_period(0.25, |sample, inputs| {
                inputs.wish = 10.0 * (sample.time() - 0.4);
            })
            .run(0.0..=1.0, every(1.0), |_| ())
            .expect("it runs");
        // Wishes of -4, -1.5, 1 and 3.5.
        let wanted = 0.25 * (-bound - 1.5 + 1.0 + bound) + more;
        let way = Asked::state_value(&report.state, Asked::HANDLES.way);
        assert!((way - wanted).abs() < 1e-12, "{way} and {wanted}");
    }
}
