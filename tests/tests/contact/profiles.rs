//! Cams whose profiles are splines, with flat followers and with rollers.

use holonom::error::StartFault;
use holonom::prelude::*;
use holonom::run::{Cam as Profiled, InteractionMode};
use holonom::spline::{Spline, uniform_knots};

use super::cams::{Cam, Contact, FRICTION, MASS, Wanted, flat, lifts, profiled, spring, turning};
use super::tight;

/// From 42 mm by 8 mm up within 1.2 rad, by a polynomial whose slope and second derivative are zero
/// at both ends; it dwells there for 0.4 rad, goes down likewise, and dwells.
static DWELLS: Spline<121> = Spline::periodic(
    uniform_knots(0.0, core::f64::consts::TAU),
    dwelling(uniform_knots(0.0, core::f64::consts::TAU)),
);

const fn dwelling(angles: [f64; 121]) -> [f64; 121] {
    let mut heights = [0.042; 121];
    let mut k = 0;
    while k < 121 {
        let rises = (angles[k] - 1.0) / 1.2;
        let falls = (3.8 - angles[k]) / 1.2;
        let u = if rises < falls { rises } else { falls };
        if u >= 1.0 {
            heights[k] = 0.05;
        } else if u > 0.0 {
            heights[k] = 0.042 + 0.008 * u * u * u * (10.0 + u * (6.0 * u - 15.0));
        }
        k += 1;
    }
    heights
}

/// A flat follower on the spline: its lift is the support function where the normal is upwards.
fn on_flat(speed: f64, angle: f64) -> Wanted {
    let up = core::f64::consts::FRAC_PI_2 - angle;
    let (height, slope) = (DWELLS.value(up), -DWELLS.slope(up));
    let displacement = height - 0.05;
    let effort = spring(displacement) + MASS * DWELLS.curvature(up) * speed * speed;
    Wanted {
        displacement,
        slope,
        effort,
        // The material turns about the shaft. That the point of contact wanders by h'' w does not
        // count.
        slip: -height * speed,
        torque: effort * (slope + FRICTION * height),
    }
}

/// A roller of 10 mm on the spline. Its middle is at the height `Z`, on the curve `(h + r) u +
/// h' u'` turned by the angle, and stays at X = 12 mm: so the angle of the normal is known, and its
/// derivatives follow by those of X.
fn on_roller(speed: f64, angle: f64) -> Wanted {
    const RADIUS: f64 = 0.01;
    const ASIDE: f64 = 0.012;
    let parts = |up: f64| {
        let phi = up - angle;
        let (h, slope, bent) = (DWELLS.value(phi), DWELLS.slope(phi), DWELLS.curvature(phi));
        let (sine, cosine) = up.sin_cos();
        let x = (h + RADIUS) * cosine - slope * sine - ASIDE;
        (x, [h, slope, h + bent + RADIUS], [sine, cosine])
    };
    // X falls with the angle of the normal.
    let mut between = [0.3, core::f64::consts::PI - 0.3];
    for _ in 0..50 {
        let middle = 0.5 * (between[0] + between[1]);
        between[usize::from(parts(middle).0 < 0.0)] = middle;
    }
    let (_, [h, dh, radius], [sine, cosine]) = parts(0.5 * (between[0] + between[1]));
    let height = (h + RADIUS) * sine + dh * cosine;
    let slope = ASIDE - height * cosine / sine;
    // d(up)/d(angle) = 1 - Z / ((rho + r) sin(up))
    let turns = 1.0 - height / (radius * sine);
    let bent = -slope * cosine / sine + height * turns / (sine * sine);
    let displacement = height - 0.06;
    // The material of the cam there goes along with h w, that of the roller with the follower.
    let slip = slope * speed * cosine - h * speed;
    let push = spring(displacement) + MASS * bent * speed * speed;
    // Along the guide are N sin + T cos, and T = mu N against the slip.
    let along = -slip.signum() * FRICTION;
    let effort = push / (sine + along * cosine);
    // On the cam they have the arms h' and h about the shaft.
    let torque = -effort * (dh - along * h);
    Wanted {
        displacement,
        slope,
        effort,
        slip,
        torque,
    }
}

/// Angles of a turn at which the first end of an effort is looked for.
const SAMPLES: u32 = 5000;

/// When the effort ends (s), by halving from a sampled first change of sign on.
fn end(speed: f64, samples: u32, wanted: impl Fn(f64) -> Wanted) -> Option<f64> {
    let at = |k: u32| core::f64::consts::TAU * f64::from(k) / f64::from(samples);
    let first = (0..samples).find(|&k| wanted(at(k)).effort <= 0.0)?;
    let mut between = [at(first - 1), at(first)];
    for _ in 0..60 {
        let middle = 0.5 * (between[0] + between[1]);
        between[usize::from(wanted(middle).effort <= 0.0)] = middle;
    }
    Some(between[0] / speed)
}

/// Where a spline presses, and at which speed it no longer does.
fn is_as_wanted(contact: Contact, wanted: fn(f64, f64) -> Wanted) {
    // The speed from which on the effort has an end.
    let mut between = [10.0, 200.0];
    for (rounds, samples) in [(10, 500), (8, SAMPLES)] {
        for _ in 0..rounds {
            let middle = 0.5 * (between[0] + between[1]);
            let ends = end(middle, samples, |angle| wanted(middle, angle)).is_some();
            between[usize::from(ends)] = middle;
        }
        // Few samples may miss where it ends first.
        between[0] *= 0.98;
    }
    let critical = between[1];
    let lifts = |speed: f64| {
        let first = wanted(speed, 0.0);
        let lift = [first.displacement, first.slope];
        lifts(speed, contact, lift, |angle| wanted(speed, angle), 1e-9)
    };
    assert_eq!(lifts(0.999 * critical), None);
    for speed in [1.001 * critical, 2.0 * critical] {
        let wanted = end(speed, SAMPLES, |angle| wanted(speed, angle)).expect("it ends");
        let found = lifts(speed).expect("it lifts off");
        assert!((found - wanted).abs() < 1e-9, "{speed}: {found} {wanted}");
    }
}

#[test]
fn a_flat_follower_is_pressed_by_its_spline() {
    let contact = Interaction::contact_of_cam(profiled(&DWELLS), flat());
    is_as_wanted(contact.with_plane_friction(FRICTION), on_flat);
}

#[test]
fn a_roller_is_pressed_by_its_spline() {
    let contact = Interaction::contact_with_cam(Cam::HANDLES.roller, profiled(&DWELLS));
    is_as_wanted(
        contact.radius(0.01).with_plane_friction(FRICTION),
        on_roller,
    );
}

/// The distance of a point from the spline (m), by a search of its own: the farthest tangent, among
/// many and then by golden section.
fn distance([x, y]: [f64; 2]) -> f64 {
    let beyond = |angle: f64| x * angle.cos() + y * angle.sin() - DWELLS.value(angle);
    let step = core::f64::consts::TAU / 400.0;
    let angles = (0..400).map(|k| f64::from(k) * step);
    let best = angles.fold(0.0, |best, angle| {
        if beyond(angle) > beyond(best) {
            angle
        } else {
            best
        }
    });
    let golden = 0.5 * (f64::sqrt(5.0) - 1.0);
    let [mut low, mut high] = [best - step, best + step];
    for _ in 0..60 {
        let share = golden * (high - low);
        if beyond(high - share) > beyond(low + share) {
            high = low + share;
        } else {
            low = high - share;
        }
    }
    beyond(0.5 * (low + high))
}

#[test]
fn a_roller_stays_at_its_radius_and_comes_back_to_it() {
    let (speed, h) = (60.0, Cam::HANDLES);
    let first = on_roller(speed, 0.0);
    let (cam, start) = turning(speed, [first.displacement, first.slope]);
    let contact = Interaction::contact_with_cam(h.roller, profiled(&DWELLS)).radius(0.01);
    let [touches] = Interaction::handles(&[contact]);
    let mut counts = [0; 2];
    cam.simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(start)
        .interactions([contact])
        .run(0.0..=0.25, every(2e-3), |sample| -> Result<(), Fault> {
            // In the axes of the cam.
            let (sine, cosine) = (speed * sample.time()).sin_cos();
            let at = sample.position(h.follower);
            let (x, z) = (at.x + 0.012, at.z - 0.09);
            let gap = distance([x * cosine + z * sine, z * cosine - x * sine]) - 0.01;
            let is_free = sample.mode(touches)? == InteractionMode::Free;
            counts[usize::from(is_free)] += 1;
            assert!(gap > -1e-10, "{gap}");
            assert!(is_free || gap < 1e-10, "{gap}");
            Ok(())
        })
        .expect("it turns");
    assert!(counts[0] > 20 && counts[1] > 20, "{counts:?}");
}

#[test]
fn cams_that_are_none_are_named() {
    static CLOSED: Spline<5> = Spline::periodic(
        uniform_knots(0.0, core::f64::consts::TAU),
        [0.05, 0.05, 0.05, 0.05, 0.05],
    );
    static OPEN: Spline<3> = Spline::natural([0.0, 3.0, 6.3], [0.05, 0.05, 0.05]);
    static DEGREES: Spline<5> = Spline::periodic(uniform_knots(0.0, 360.0), [0.05; 5]);
    static TORN: Spline<3> = Spline::periodic([0.0, 3.0, 6.0], [0.05, 0.05, 0.06]);
    static HOLLOW: Spline<5> = Spline::periodic(
        uniform_knots(0.0, core::f64::consts::TAU),
        [0.05, 0.02, 0.05, 0.02, 0.05],
    );
    let h = Cam::HANDLES;
    let named = |cam: Profiled<f64, Cam>, wanted: &str| {
        let flat = Interaction::contact_of_cam(cam, flat());
        let roller = Interaction::contact_with_cam(h.roller, cam).radius(0.01);
        for contact in [flat, roller] {
            let run = Cam::new(0.0)
                .expect("it is")
                .simulation(StandardLagrange, DormandPrince::new(tight()))
                .interactions(contact.with_plane_friction(FRICTION))
                .run(0.0..=0.1, every(0.1), |_| ());
            match run.map(|_| ()).map_err(|error| error.fault) {
                Err(Fault::Start(StartFault::InteractionSetting { setting, .. })) => {
                    assert_eq!(setting, wanted);
                }
                other => panic!("{wanted}: {other:?}"),
            }
        }
    };
    let (axis, zero) = ([0.0, -1.0, 0.0], [1.0, 0.0, 0.0]);
    let about = |axis, zero| Profiled::about(h.centre, axis, zero, &CLOSED);
    named(about([0.0; 3], zero), "axis");
    named(about([f64::NAN, 1.0, 0.0], zero), "axis");
    named(about(axis, [0.0; 3]), "zero direction");
    named(about([1.0, 1.0, 1.0], [-2.0; 3]), "zero direction");
    named(Profiled::about(h.centre, axis, zero, &TORN), "profile");
    let period = "period of a profile";
    named(Profiled::about(h.centre, axis, zero, &OPEN), period);
    named(Profiled::about(h.centre, axis, zero, &DEGREES), period);
    let radius = "least radius of curvature";
    named(Profiled::about(h.centre, axis, zero, &HOLLOW), radius);
    let misplaced = Interaction::contact_of_cam(about(axis, zero), flat()).radius(0.01);
    let run = Cam::new(0.0)
        .expect("it is")
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions([misplaced])
        .run(0.0..=0.1, every(0.1), |_| ());
    assert!(matches!(
        run.map(|_| ()).map_err(|error| error.fault),
        Err(Fault::Start(StartFault::MisplacedSetting {
            setting: "radius",
            ..
        }))
    ));
}
