use core::f64::consts::{PI, TAU};
use std::boxed::Box;

use super::Profile;
use crate::forward::Forward;
use crate::math::scalar::Scalar;
use crate::math::spline::{Spline, uniform_knots};

type Moving = Forward<f64, 2>;

fn sampled(height: impl Fn(f64) -> f64) -> &'static Spline<721> {
    let knots = uniform_knots(0.0, TAU);
    let mut values = knots.map(height);
    values[720] = values[0];
    Box::leak(Box::new(Spline::periodic(knots, values)))
}

/// Outlines with flanks that are nearly flat, about points in their middle and near an end. Their
/// radii of curvature differ up to four thousandfold.
fn outlines() -> [&'static Spline<721>; 4] {
    let long = |share: f64, at: f64| {
        sampled(move |angle: f64| {
            let (sine, cosine) = angle.sin_cos();
            0.01 + f64::hypot(cosine, share * sine) + at * cosine + 0.03 * sine
        })
    };
    [
        sampled(|angle| 1.0 + 0.3 * angle.cos() + 0.05 * (2.0 * angle).cos()),
        long(0.2, 0.0),
        long(0.06, 0.9),
        // The centre is outside.
        long(0.3, -1.5),
    ]
}

/// Calls with an outline, an angle, and the point at a distance from the tangent there.
fn each(distances: &[f64], mut call: impl FnMut(&'static Spline<721>, f64, f64, [f64; 2])) {
    for outline in outlines() {
        assert_eq!(Profile::of(outline).check(), Ok(()));
        for k in 0..500 {
            let angle = TAU * (f64::from(k) / 500.0 + 1e-4);
            let (sine, cosine) = angle.sin_cos();
            let slope = outline.slope(angle);
            for &distance in distances {
                let beyond = outline.value(angle) + distance;
                let point = [
                    beyond * cosine - slope * sine,
                    beyond * sine + slope * cosine,
                ];
                call(outline, angle, distance, point);
            }
        }
    }
}

/// How far a point is from the tangent that faces it.
fn distance<S: Scalar>(outline: &'static Spline<721>, point: [S; 2]) -> S {
    let [angle, height] = Profile::of(outline).facing(point);
    point[0] * angle.cos() + point[1] * angle.sin() - height
}

/// A point on the normal of a convex curve has its foot as the nearest point.
#[test]
fn a_point_outside_is_faced_by_the_tangent_whose_normal_it_is_on() {
    let distances = [0.0, 1e-9, 1e-4, 1e-2, 0.3, 2.0, 100.0];
    each(&distances, |outline, angle, distance, point| {
        let [found, height] = Profile::of(outline).facing(point);
        // That of slopes is that of heights over the distance of knots.
        let round_off = 1e-15 * (1.0 + distance);
        let turn = (found - angle + PI).rem_euclid(TAU) - PI;
        let radius = outline.value(angle) + outline.curvature(angle);
        assert!(
            (turn * (radius + distance)).abs() < 2e3 * round_off,
            "{angle} {distance}: {turn}"
        );
        assert_eq!(height, outline.value(found));
        let gap = self::distance(outline, point);
        assert!((gap - distance).abs() < 4.0 * round_off, "{gap} {distance}");
    });
}

/// The slope of a distance is the normal, and the normal turns by one over the radius.
#[test]
fn the_distance_has_its_derivatives() {
    each(&[0.0, 1e-3, 0.5], |outline, angle, away, point| {
        let (sine, cosine) = angle.sin_cos();
        let [x, y] = [0, 1].map(|along| Moving::along(point[along], along));
        let [by_x, by_y] = distance(outline, [x, y]).derivatives();
        assert!((by_x - cosine).abs() < 1e-12 && (by_y - sine).abs() < 1e-12);
        let [turn, _] = Profile::of(outline).facing([x, y]);
        let [by_x, by_y] = turn.derivatives();
        let radius = outline.value(angle) + outline.curvature(angle) + away;
        let share = 1e-9 / radius.min(1.0);
        assert!((by_x * radius + sine).abs() < share, "{by_x} {radius}");
        assert!((by_y * radius - cosine).abs() < share, "{by_y} {radius}");
    });
}

#[test]
fn a_point_within_is_behind_all_tangents() {
    each(&[-1e-6, -1e-3, -1e-2], |outline, _, _, point| {
        assert!(distance(outline, point) < 0.0);
    });
}

#[test]
fn numbers_of_seven_digits_find_it() {
    each(&[1e-3, 0.5], |outline, _, away, point| {
        let found = f64::from(distance(outline, point.map(|x| x as f32)));
        assert!((found - away).abs() < 3e-6, "{found} {away}");
    });
}

#[test]
fn what_is_no_profile_is_named() {
    let named =
        |spline: &'static Spline<721>| Profile::of(spline).check().map_err(|(name, _)| name);
    assert_eq!(named(sampled(|_| f64::NAN)), Err("profile"));
    let natural = Spline::natural(uniform_knots(0.0, TAU), [1.0; 721]);
    assert_eq!(
        Profile::of(Box::leak(Box::new(natural))).check(),
        Err(("period of a profile", 0.0))
    );
    let short = Spline::periodic(uniform_knots(0.0, 6.25), [1.0; 721]);
    assert_eq!(
        named(Box::leak(Box::new(short))),
        Err("period of a profile")
    );
    // The radius of curvature is 1 - 3 e cos(2 x), and the spline is within 1e-5 of it.
    let flank = |depth: f64| named(sampled(move |angle| 1.0 + depth * (2.0 * angle).cos()));
    assert_eq!(flank(0.33332), Ok(()));
    assert_eq!(flank(0.33335), Err("least radius of curvature"));
}

/// The least radius of pieces, against many points.
#[test]
fn the_least_radius_is_that_of_all_points() {
    let rough = Spline::periodic(
        [0.0, 0.9, 1.7, 2.0, 3.3, 4.1, 5.5, TAU],
        [1.0, 1.2, 1.1, 0.7, 0.9, 1.4, 0.8, 1.0],
    );
    let points = (0..400_000).map(|k| TAU * f64::from(k) / 400_000.0);
    let least = points.fold(f64::INFINITY, |least, angle| {
        least.min(rough.value(angle) + rough.curvature(angle))
    });
    let found = rough.table().least_radius();
    assert!((found - least).abs() < 1e-4, "{found} {least}");
    assert!(found <= least);
}
