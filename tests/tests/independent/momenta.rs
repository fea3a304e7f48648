//! Centres of mass and momenta, against momentum theorems and differences.

use holonom::error::ReadingFault;
use holonom::prelude::*;
use nalgebra::{SVector, Vector3, Vector6};

use super::found::Floating;

/// A body that floats with an arm on it, without forces: its centre of mass goes straight on, and
/// all momenta stay.
#[test]
fn momenta_of_a_free_flight_stay() -> Result<(), Box<dyn core::error::Error>> {
    let (floating, h) = (Floating::default(), Floating::HANDLES);
    let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|k| Motion::free(h.base, k));
    let space = floating.coordinates((a, b, c, d, e, f, h.hinge))?;
    let described = space.of_bodies(&floating.described_state()?);
    let start = space.with_rates(&described, [0.1, -0.2, 0.3, 0.5, -0.4, 0.6, 1.1])?;
    let about = Vector3::new(0.3, -0.7, 0.2);
    let read = |view: &View<'_, f64, Floating>| {
        Ok::<_, ReadingFault>((
            view.centre_of_mass(..)?,
            view.centre_of_mass_velocity(..)?,
            view.angular_momentum(.., about),
            view.angular_momentum_about_centre(..)?,
        ))
    };
    let bodies = space.bodies(&start);
    let (centre, velocity, angular, own) = read(&floating.view(0.0, &bodies)?.borrowed())?;
    assert!((centre - Vector3::new(1.0, 2.12, 3.0)).norm() < 1e-14);
    // The arm alone is driven about by the base.
    let mut changed: f64 = 0.0;
    let first = floating.view(0.0, &bodies)?.linear_momentum(h.arm);
    floating
        .simulation(
            StandardLagrange,
            DormandPrince::new(Tolerance {
                relative: 1e-11,
                absolute: 1e-12,
            }),
        )
        .initial_state(bodies)
        .run(0.0..=3.0, every(0.25), |sample| -> Result<(), Fault> {
            let found = read(sample)?;
            let near = |a: Vector3<f64>, b: Vector3<f64>| {
                assert!((a - b).norm() < 1e-9, "{}: {a}{b}", sample.time());
            };
            near(found.0, centre + velocity * sample.time());
            near(found.1, velocity);
            near(found.2, angular);
            near(found.3, own);
            near(sample.linear_momentum(..), velocity * sample.mass(..));
            let parts = sample.linear_momentum(h.base) + sample.linear_momentum(h.arm);
            near(parts, velocity * 5.0);
            changed = changed.max((sample.linear_momentum(h.arm) - first).norm());
            Ok(())
        })?;
    assert!(changed > 0.1, "{changed}");
    Ok(())
}

/// A run stops where the centre of mass has reached a height.
#[test]
fn an_event_reads_the_centre_of_mass() -> Result<(), Box<dyn core::error::Error>> {
    let (floating, h) = (Floating::default(), Floating::HANDLES);
    let space = floating.coordinates((
        Motion::free(h.base, 0),
        Motion::free(h.base, 1),
        Motion::free(h.base, 2),
        Motion::free(h.base, 3),
        Motion::free(h.base, 4),
        Motion::free(h.base, 5),
        h.hinge,
    ))?;
    let described = space.of_bodies(&floating.described_state()?);
    let start = space.with_rates(&described, [0.0, 0.0, 0.5, 0.2, 0.3, -0.4, 2.0])?;
    let bodies = space.bodies(&start);
    let rate = floating.view(0.0, &bodies)?.centre_of_mass_velocity(..)?.z;
    let height = |sample: &holonom::Sample<'_, f64, Floating>| {
        sample
            .centre_of_mass(..)
            .map_or(f64::NAN, |centre| centre.z)
            - 3.4
    };
    let report = floating
        .simulation(StandardLagrange, DormandPrince::default())
        .initial_state(bodies)
        .on("high", Crossing::Rising, height, |_| ControlFlow::Break(()))
        .run(0.0..=3.0, every(0.5), |_| ())?;
    assert!(report.stopped && (report.time - 0.4 / rate).abs() < 1e-6);
    Ok(())
}

/// A frame whose mass is what the arm has too much, as published inertias may be, and a lamp
/// without mass on it. No other mechanism of the tests has masses that are not positive.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [jacobian])]
struct Gimbal {
    #[body(mass = -2.0, inertia = [0.0, 0.0, 0.0], as_given)]
    frame: Body,
    #[body(mass = 0.0, inertia = [0.0, 0.0, 0.0], position = [0.0, 0.0, 0.1], as_given)]
    lamp: Body,
    #[body(mass = 2.0, inertia = [0.1, 0.2, 0.2], position = [0.3, 0.0, 0.0])]
    arm: Body,
    #[joint(between = [ground, frame], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    yaw: Revolute,
    #[joint(between = [frame, lamp], point = [0.0, 0.0, 0.1])]
    screws: Fixed,
    #[joint(between = [frame, arm], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    pitch: Revolute,
}

#[test]
fn bodies_without_mass_have_momenta_and_no_centre() -> Result<(), Fault> {
    let (gimbal, h) = (Gimbal::default(), Gimbal::HANDLES);
    let space = gimbal.coordinates([h.yaw, h.pitch])?;
    let state = space.state([0.3, -0.4], [1.5, 0.7])?;
    let bodies = space.bodies(&state);
    let view = gimbal.view(0.0, &bodies)?;
    for (fault, bodies) in [
        (view.centre_of_mass(h.lamp), 1),
        (view.centre_of_mass([h.frame, h.arm]), 2),
        (view.centre_of_mass_velocity(..), 3),
        (view.angular_momentum_about_centre(..), 3),
    ] {
        assert_eq!(fault, Err(ReadingFault::NoMass { bodies }));
    }
    let refused = Err(Fault::Reading(ReadingFault::NoMass { bodies: 3 }));
    assert_eq!(space.centre_of_mass_jacobian(&state, ..), refused);
    assert!(space.momentum_matrix(&state, ..).is_err());
    // What has a mass goes on to have a centre, and momenta are sums in any case.
    let arm = [h.lamp, h.arm];
    assert!((view.centre_of_mass(arm)? - view.position(h.arm)).norm() < 1e-15);
    assert!((view.linear_momentum(..) - view.velocity(h.arm) * 2.0).norm() < 1e-15);
    let moved = space.momentum_matrix(&state, arm)? * SVector::from([1.5, 0.7]);
    let own = view.angular_momentum_about_centre(h.arm)?;
    assert!((moved.fixed_rows::<3>(3) - own).norm() < 1e-15);
    Ok(())
}

/// In any numbers and at any size: the momenta of a scaled flight are scaled.
#[test]
fn momenta_in_single_precision() -> Result<(), Fault> {
    let (gimbal, h) = (Gimbal::default(), Gimbal::HANDLES);
    let space = gimbal.coordinates_in::<f32, 2>([h.yaw, h.pitch])?;
    let state = space.state([0.3, -0.4], [1.5e9, 0.7e9])?;
    let bodies = space.bodies(&state);
    let view = gimbal.view(0.0_f32, &bodies)?;
    let found = space.momentum_matrix(&state, h.arm)? * SVector::from([1.5e9_f32, 0.7e9]);
    let (linear, angular) = (
        view.linear_momentum(h.arm),
        view.angular_momentum_about_centre(h.arm)?,
    );
    let [[a, b, c], [d, e, f]] = [linear, angular].map(Into::<[f32; 3]>::into);
    let wanted = Vector6::new(a, b, c, d, e, f);
    assert!((found - wanted).norm() < 1e-6 * wanted.norm());
    Ok(())
}
