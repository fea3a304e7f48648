//! Euler angles, Bryant angles, roll, pitch and yaw: against nalgebra, the words of the macro,
//! motions of a top that are known, and where they are singular.

#![forbid(unsafe_code)]

use core::f64::consts::{FRAC_PI_2, PI};

use holonom::error::{AngleSet, ReadingFault, StepFault};
use holonom::measure::{BryantAngles, EulerAngles, RollPitchYaw};
use holonom::prelude::*;
use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// Turns about axes of the body, the first written first.
fn turns(turns: [(Unit<Vector3<f64>>, f64); 3]) -> UnitQuaternion<f64> {
    let one = |(axis, angle)| UnitQuaternion::from_axis_angle(&axis, angle);
    let [first, second, third] = turns.map(one);
    first * second * third
}

fn euler([a, b, c]: [f64; 3]) -> UnitQuaternion<f64> {
    let (x, z) = (Vector3::x_axis(), Vector3::z_axis());
    turns([(z, a), (x, b), (z, c)])
}

fn bryant([a, b, c]: [f64; 3]) -> UnitQuaternion<f64> {
    let (x, y, z) = (Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis());
    turns([(x, a), (y, b), (z, c)])
}

fn rpy([roll, pitch, yaw]: [f64; 3]) -> UnitQuaternion<f64> {
    let (x, y, z) = (Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis());
    turns([(z, yaw), (y, pitch), (x, roll)])
}

/// The angles of an orientation by their functions, and its orientation by theirs.
fn read(set: AngleSet, q: &Quaternion<f64>) -> Option<([f64; 3], Quaternion<f64>)> {
    match set {
        AngleSet::EulerZxz => EulerAngles::of(q).map(|a| (a.into(), a.orientation())),
        AngleSet::BryantXyz => BryantAngles::of(q).map(|a| (a.into(), a.orientation())),
        AngleSet::RollPitchYaw => RollPitchYaw::of(q).map(|a| (a.into(), a.orientation())),
        _ => unreachable!("there are three"),
    }
}

/// What makes rotations of angles, by nalgebra.
type Made = fn([f64; 3]) -> UnitQuaternion<f64>;

/// Each of the three, how nalgebra makes it, and the range of its second angle (rad).
const SETS: [(AngleSet, Made, [f64; 2]); 3] = [
    (AngleSet::EulerZxz, euler, [0.0, PI]),
    (AngleSet::BryantXyz, bryant, [-FRAC_PI_2, FRAC_PI_2]),
    (AngleSet::RollPitchYaw, rpy, [-FRAC_PI_2, FRAC_PI_2]),
];

/// The sine of the angle between the first and the third axis.
fn gap(set: AngleSet, second: f64) -> f64 {
    match set {
        AngleSet::EulerZxz => second.sin(),
        _ => second.cos(),
    }
}

fn is_near(p: &Quaternion<f64>, q: &Quaternion<f64>, tolerance: f64) -> bool {
    (p - q).norm().min((p + q).norm()) < tolerance
}

#[test]
fn random_rotations_come_back() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for (set, made, [least, most]) in SETS {
        for _ in 0..2000 {
            let angles = [-PI..PI, least..most, -PI..PI].map(|range| rng.random_range(range));
            let q = made(angles).into_inner();
            // Neither the length nor the sign of a quaternion says anything.
            let scaled = q * rng.random_range(-3.0..3.0);
            let (found, back) = read(set, &scaled).expect("regular");
            for (found, angle) in found.iter().zip(angles) {
                let tolerance = 4e-15 / gap(set, angles[1]);
                assert!((found - angle).abs() < tolerance, "{set:?} {found} {angle}");
            }
            assert!(is_near(&back, &q, 4e-15), "{set:?} {angles:?}");
        }
    }
}

#[test]
fn roll_pitch_and_yaw_are_those_of_nalgebra() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..2000 {
        let q = rpy([-3.0..3.0, -1.5..1.5, -3.0..3.0].map(|range| rng.random_range(range)));
        let (roll, pitch, yaw) = q.euler_angles();
        let found = RollPitchYaw::of(&q.into_inner()).expect("regular");
        assert!((found.roll - roll).abs() < 1e-13);
        assert!((found.pitch - pitch).abs() < 1e-13);
        assert!((found.yaw - yaw).abs() < 1e-13);
    }
}

/// Digits go as the second angle comes near to where it is singular, in proportion and no faster;
/// there, and nearer than half of the digits, nothing is returned.
#[test]
fn near_a_singular_configuration_digits_go_in_proportion() {
    for (set, made, ends) in SETS {
        for (end, into) in [(ends[0], 1.0), (ends[1], -1.0)] {
            for distance in [0.1, 1e-3, 1e-5, 1e-7, 2e-8] {
                let angles = [0.7, end + into * distance, -2.1];
                let q = made(angles).into_inner();
                let (found, back) = read(set, &q).expect("regular");
                assert!((found[1] - angles[1]).abs() < 2e-15);
                for place in [0, 2] {
                    assert!((found[place] - angles[place]).abs() < 1e-15 / distance);
                }
                assert!(is_near(&back, &q, 4e-15));
            }
            for distance in [1e-8, 1e-12, 0.0] {
                let q = made([0.7, end + into * distance, -2.1]).into_inner();
                assert_eq!(read(set, &q), None, "{set:?} {distance}");
            }
        }
    }
}

#[test]
fn no_orientation_has_no_angles() {
    let zero = Quaternion::new(0.0, 0.0, 0.0, 0.0);
    for (set, made, _) in SETS {
        assert_eq!(read(set, &zero), None);
        for place in 0..4 {
            for bad in [f64::NAN, f64::INFINITY] {
                let mut q = made([0.7, 0.5, -2.1]).into_inner();
                q.coords[place] = bad;
                assert_eq!(read(set, &q), None);
            }
        }
    }
}

#[test]
fn single_precision_has_its_own_bound() {
    let of = |nutation: f32| {
        let angles = EulerAngles {
            precession: 0.7_f32,
            nutation,
            spin: -2.1,
        };
        (angles, EulerAngles::of(&angles.orientation()))
    };
    let (angles, found) = of(0.01);
    let found = found.expect("regular");
    assert!((found.precession - angles.precession).abs() < 3e-5);
    assert!((found.nutation - angles.nutation).abs() < 3e-7);
    assert_eq!(of(1e-4).1, None);
}

/// Bodies that are turned by the words of the macro; the inertia of one is along other axes.
#[derive(Mechanism)]
struct Words {
    #[body(
        mass = 1.0, inertia = [[0.08, 0.01, 0.0], [0.01, 0.09, 0.02], [0.0, 0.02, 0.12]],
        orientation = euler_zxz(0.3, 0.8, -1.9), free
    )]
    euler: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = bryant_xyz(2.3, -0.8, 1.9), free)]
    bryant: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = rpy(-0.3, 1.1, 2.9), free)]
    rpy: Body,
    #[body(
        mass = 1.0, inertia = [1.0, 1.0, 1.0],
        orientation = rpy(-0.3, 1.1, 2.9) * euler_zxz(0.4, 1.2, 0.5), free
    )]
    second: Body,
    #[body(
        mass = 1.0, inertia = [1.0, 1.0, 1.0],
        orientation = rpy(-0.3, 1.1, 2.9) * bryant_xyz(0.4, -1.2, 0.5), free
    )]
    third: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], free)]
    straight: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = rpy(0.2, deg(90.0), 0.1), free)]
    upright: Body,
    #[body(mass = 1.0, free)]
    point: Particle,
}

fn are_near(found: impl Into<[f64; 3]>, expected: [f64; 3]) {
    are_within(found.into(), expected, 4e-15);
}

#[test]
fn readings_have_the_conventions_of_the_words() -> Result<(), Box<dyn std::error::Error>> {
    let (words, h) = (Words::default(), Words::HANDLES);
    let state = words.described_state::<f64>()?;
    let view = words.view(0.0, &state)?;
    are_near(view.euler_angles(h.euler)?, [0.3, 0.8, -1.9]);
    are_near(view.bryant_angles(h.bryant)?, [2.3, -0.8, 1.9]);
    are_near(view.roll_pitch_yaw(h.rpy)?, [-0.3, 1.1, 2.9]);
    are_near(
        view.relative_euler_angles(h.second, h.rpy)?,
        [0.4, 1.2, 0.5],
    );
    are_near(
        view.relative_bryant_angles(h.third, h.rpy)?,
        [0.4, -1.2, 0.5],
    );
    are_near(
        view.relative_roll_pitch_yaw(h.rpy, h.straight)?,
        [-0.3, 1.1, 2.9],
    );
    let relative = view.relative_orientation(h.second, h.rpy);
    assert!(is_near(
        &relative,
        &euler([0.4, 1.2, 0.5]).into_inner(),
        4e-15
    ));
    are_near(view.bryant_angles(h.point)?, [0.0; 3]);
    Ok(())
}

#[test]
fn what_is_singular_is_refused_with_a_sentence() -> Result<(), Box<dyn std::error::Error>> {
    let (words, h) = (Words::default(), Words::HANDLES);
    let mut state = words.described_state::<f64>()?;
    let view = words.view(0.0, &state)?;
    let fault = view.euler_angles(h.straight).expect_err("parallel");
    assert_eq!(
        fault.to_string(),
        "the Euler angles of body `straight` are singular here: precession and spin turn about one axis, and only their sum or difference is \
         known; Bryant angles are regular there"
    );
    are_near(view.bryant_angles(h.straight)?, [0.0; 3]);
    let fault = view.roll_pitch_yaw(h.upright).expect_err("upright");
    let (body, angles) = ("upright", AngleSet::RollPitchYaw);
    assert_eq!(
        fault,
        Fault::Reading(ReadingFault::SingularAngles { body, angles })
    );
    assert!(view.euler_angles(h.upright).is_ok());
    // A body against itself.
    assert!(view.relative_euler_angles(h.rpy, h.rpy).is_err());
    are_near(view.relative_bryant_angles(h.rpy, h.rpy)?, [0.0; 3]);

    let place = Words::REPORT.bodies[h.rpy.index()].coordinate + 3;
    for (value, fault) in [
        (0.0, Fault::Step(StepFault::ZeroOrientation { body: "rpy" })),
        (f64::NAN, Fault::Step(StepFault::StateNotFinite)),
    ] {
        state.coordinates_mut()[place..place + 4].fill(value);
        let view = words.view(0.0, &state)?;
        assert_eq!(view.roll_pitch_yaw(h.rpy), Err(fault));
        assert_eq!(view.relative_euler_angles(h.second, h.rpy), Err(fault));
    }
    Ok(())
}

/// The rates of angles by their functions, and the angular velocity by theirs.
fn rates(set: AngleSet, angles: [f64; 3], turning: Vector3<f64>) -> Option<Rates> {
    match set {
        AngleSet::EulerZxz => {
            let angles = EulerAngles::from(angles);
            let rates = angles.rates(&turning)?;
            Some((rates.into(), angles.angular_velocity(&rates)))
        }
        AngleSet::BryantXyz => {
            let angles = BryantAngles::from(angles);
            let rates = angles.rates(&turning)?;
            Some((rates.into(), angles.angular_velocity(&rates)))
        }
        AngleSet::RollPitchYaw => {
            let angles = RollPitchYaw::from(angles);
            let rates = angles.rates(&turning)?;
            Some((rates.into(), angles.angular_velocity(&rates)))
        }
        _ => unreachable!("there are three"),
    }
}

type Rates = ([f64; 3], Vector3<f64>);

/// Rates that are chosen make an angular velocity: by nalgebra, each turns about its axis as those
/// before have turned it.
#[test]
fn rates_make_up_the_angular_velocity() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for (set, made, [least, most]) in SETS {
        for _ in 0..2000 {
            let angles = [-PI..PI, least..most, -PI..PI].map(|range| rng.random_range(range));
            let chosen = [0.0; 3].map(|_| rng.random_range(-5.0..5.0));
            let axis = |place: usize| match (set, place) {
                (AngleSet::EulerZxz, 0) | (_, 2) => Vector3::z(),
                (AngleSet::EulerZxz, _) | (_, 0) => Vector3::x(),
                _ => Vector3::y(),
            };
            // The turn of an angle is left out, and those inside it: what turns its axis is left.
            let before = |place: usize| {
                let mut outer = angles;
                for (other, angle) in outer.iter_mut().enumerate() {
                    let is_inside = match set {
                        AngleSet::RollPitchYaw => other <= place,
                        _ => other >= place,
                    };
                    *angle = if is_inside { 0.0 } else { *angle };
                }
                made(outer)
            };
            let parts = [0, 1, 2].map(|place| before(place) * axis(place) * chosen[place]);
            let turning = parts[0] + parts[1] + parts[2];
            let (found, back) = rates(set, angles, turning).expect("regular");
            let gap = gap(set, angles[1]);
            are_within(found, chosen, 2e-14 / gap);
            are_within(back.into(), turning.into(), 2e-14);
        }
    }
}

/// Against central differences of order four of the angles, of bodies that turn steadily.
#[test]
fn rates_are_differences_of_the_angles() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for (set, made, [least, most]) in SETS {
        for _ in 0..200 {
            let range = least + 0.3..most - 0.3;
            let angles = [-2.5..2.5, range, -2.5..2.5].map(|range| rng.random_range(range));
            let turning = Vector3::from([0.0; 3].map(|_| rng.random_range(-2.0..2.0)));
            let at = |time: f64| {
                let q = UnitQuaternion::from_scaled_axis(turning * time) * made(angles);
                read(set, &q).expect("regular").0
            };
            let step = 3e-4;
            let [far, near, ahead, on] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(k * step));
            let (found, _) = rates(set, angles, turning).expect("regular");
            for k in 0..3 {
                let slope = 8.0 * (ahead[k] - near[k]) - (on[k] - far[k]);
                let slope = slope / (12.0 * step);
                assert!((found[k] - slope).abs() < 1e-8, "{set:?} {found:?} {slope}");
            }
        }
    }
}

#[test]
fn rates_are_singular_where_the_angles_are() {
    let turning = Vector3::new(0.3, -0.7, 0.2);
    for (set, _, ends) in SETS {
        for (end, into) in [(ends[0], 1.0), (ends[1], -1.0)] {
            let at = |distance: f64, turning: Vector3<f64>| {
                rates(set, [0.7, end + into * distance, -2.1], turning)
            };
            let ([first, second, third], back) = at(1e-6, turning).expect("regular");
            // Both rates are large, and nearly take each other back.
            assert!(second.abs() < 1.0 && first.abs().min(third.abs()) > 1e5);
            are_within(back.into(), turning.into(), 1e-9);
            for distance in [1e-8, 0.0] {
                assert_eq!(at(distance, turning), None);
            }
            for bad in [f64::NAN, f64::INFINITY, f64::MAX] {
                assert_eq!(at(1e-6, Vector3::new(bad, bad, bad)), None, "{set:?}");
            }
        }
    }
}

#[test]
fn rates_of_bodies_are_read_and_refused() -> Result<(), Box<dyn std::error::Error>> {
    let (words, h) = (Words::default(), Words::HANDLES);
    let mut state = words.described_state::<f64>()?;
    let chosen = [0.4, -0.9, 1.3];
    // Of the body whose inertia has axes of its own, then of one against another that turns too.
    let turning = EulerAngles::from([0.3, 0.8, -1.9]).angular_velocity(&chosen.into());
    Words::set_angular_velocity_global(&mut state, h.euler, turning);
    let own = Vector3::new(0.5, -0.2, 0.8);
    Words::set_angular_velocity(&mut state, h.rpy, own);
    let against = EulerAngles::from([0.4, 1.2, 0.5]).angular_velocity(&chosen.into());
    let base = rpy([-0.3, 1.1, 2.9]);
    Words::set_angular_velocity_global(&mut state, h.second, base * (own + against));
    let against = BryantAngles::from([0.4, -1.2, 0.5]).angular_velocity(&chosen.into());
    Words::set_angular_velocity_global(&mut state, h.third, base * (own + against));
    let view = words.view(0.0, &state)?;
    let tolerance = 2e-14;
    are_within(view.euler_angle_rates(h.euler)?.into(), chosen, tolerance);
    let found = view.relative_euler_angle_rates(h.second, h.rpy)?;
    are_within(found.into(), chosen, tolerance);
    let found = view.relative_bryant_angle_rates(h.third, h.rpy)?;
    are_within(found.into(), chosen, tolerance);
    let found = view.relative_roll_pitch_yaw_rates(h.rpy, h.straight)?;
    assert_eq!(found, view.roll_pitch_yaw_rates(h.rpy)?);
    are_within(view.bryant_angle_rates(h.point)?.into(), [0.0; 3], 1e-300);

    let (body, angles) = ("straight", AngleSet::EulerZxz);
    let fault = view.euler_angle_rates(h.straight).expect_err("parallel");
    assert_eq!(
        fault,
        Fault::Reading(ReadingFault::SingularAngles { body, angles })
    );
    assert!(view.bryant_angle_rates(h.straight).is_ok());
    assert!(view.roll_pitch_yaw_rates(h.upright).is_err());
    Words::set_angular_velocity(&mut state, h.rpy, Vector3::new(f64::NAN, 0.0, 0.0));
    let view = words.view(0.0, &state)?;
    let fault = view.roll_pitch_yaw_rates(h.rpy).expect_err("not finite");
    assert_eq!(fault, Fault::Step(StepFault::StateNotFinite));
    Ok(())
}

/// The mass of the top (kg) and the distance of its centre of mass from its tip (m).
const MASS: f64 = 0.5;
const ARM: f64 = 0.04;
/// Its moments of inertia (kg m^2) across and along its axis, about the centre of mass.
const ACROSS: f64 = 2e-4;
const ALONG: f64 = 3e-4;
/// Its nutation (rad) and its precession (rad/s).
const NUTATION: f64 = 0.6;
const PRECESSION: f64 = 2.0;

/// A heavy top on its tip.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Top {
    #[body(
        mass = MASS, inertia = [ACROSS, ACROSS, ALONG],
        position = [0.0, -ARM * sin(NUTATION), ARM * cos(NUTATION)],
        orientation = euler_zxz(0.0, 0.6, 0.0)
    )]
    top: Body,
    #[joint(between = [ground, top], point = [0.0, 0.0, 0.0])]
    tip: Spherical,
}

/// Steady precession (Goldstein, *Classical Mechanics*, section 5.7):
/// `m g l = C (spin + precession cos) precession - A precession^2 cos`, with `A` about the tip.
#[test]
fn a_top_precesses_steadily() -> Result<(), Box<dyn std::error::Error>> {
    let (top, h) = (Top::default(), Top::HANDLES);
    let (sine, cosine) = NUTATION.sin_cos();
    let about_tip = ACROSS + MASS * ARM * ARM;
    let moment = MASS * 9.81 * ARM + about_tip * PRECESSION * PRECESSION * cosine;
    let spin = moment / (ALONG * PRECESSION) - PRECESSION * cosine;
    let mut state = top.described_state::<f64>()?;
    // Precession about the global z, spin about that of the body.
    let turning = Vector3::new(0.0, -spin * sine, PRECESSION + spin * cosine);
    let arm = Vector3::new(0.0, -ARM * sine, ARM * cosine);
    Top::set_angular_velocity_global(&mut state, h.top, turning);
    Top::set_velocity(&mut state, h.top, turning.cross(&arm));
    let tolerance = Tolerance {
        relative: 1e-11,
        absolute: 1e-11,
    };
    let whole = |angle: f64| (angle / core::f64::consts::TAU).round() * core::f64::consts::TAU;
    top.simulation(StandardLagrange, DormandPrince::new(tolerance))
        .initial_state(state)
        .run(0.0..=3.0, every(0.05), |sample| -> Result<(), Fault> {
            let time = sample.time();
            let found = sample.euler_angles(h.top)?;
            assert!(
                (found.nutation - NUTATION).abs() < 1e-7,
                "{time}: {found:?}"
            );
            let rates = sample.euler_angle_rates(h.top)?;
            are_within(rates.into(), [PRECESSION, 0.0, spin], 1e-6);
            let ahead = found.precession - PRECESSION * time;
            assert!((ahead - whole(ahead)).abs() < 1e-6, "{time}: {found:?}");
            let ahead = found.spin - spin * time;
            assert!((ahead - whole(ahead)).abs() < 1e-6, "{time}: {found:?}");
            Ok(())
        })?;
    Ok(())
}

/// A disc that is thrown, with its angular momentum along z.
#[derive(Mechanism)]
struct Disc {
    #[body(
        mass = 1.0, inertia = [0.01, 0.01, 0.02], orientation = euler_zxz(0.2, 0.3, 0.4), free
    )]
    disc: Body,
}

/// Without a moment: precession `L / A`, spin `L cos (1 / C - 1 / A)`, which is negative for a disc
/// (Goldstein, section 5.6).
#[test]
fn a_thrown_disc_wobbles_as_euler_says() -> Result<(), Box<dyn std::error::Error>> {
    let (disc, h) = (Disc::default(), Disc::HANDLES);
    let (momentum, nutation) = (0.1, 0.3_f64);
    let mut state = disc.described_state::<f64>()?;
    let [across, along] = [momentum * nutation.sin(), momentum * nutation.cos()];
    // The angular momentum along the body's axes, at a spin of 0.4 rad.
    let turning = [
        across * 0.4_f64.sin() / 0.01,
        across * 0.4_f64.cos() / 0.01,
        along / 0.02,
    ];
    Disc::set_angular_velocity(&mut state, h.disc, turning.into());
    let tolerance = Tolerance {
        relative: 1e-11,
        absolute: 1e-11,
    };
    disc.simulation(StandardLagrange, DormandPrince::new(tolerance))
        .initial_state(state)
        .run(0.0..=0.25, every(0.01), |sample| -> Result<(), Fault> {
            let found = sample.euler_angles(h.disc)?;
            let rates = [momentum / 0.01, 0.0, along * (1.0 / 0.02 - 1.0 / 0.01)];
            let precession = 0.2 + rates[0] * sample.time();
            let spin = 0.4 + rates[2] * sample.time();
            are_within(found.into(), [precession, nutation, spin], 1e-9);
            are_within(sample.euler_angle_rates(h.disc)?.into(), rates, 1e-8);
            Ok(())
        })?;
    Ok(())
}

fn are_within(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    let off = |(found, expected): (&f64, f64)| (found - expected).abs() < tolerance;
    assert!(
        found.iter().zip(expected).all(off),
        "{found:?} {expected:?}"
    );
}
