//! Loops with one degree of freedom, against minimal coordinates: `reference.py`.

use holonom::independent::Chosen;
use holonom::mechanism::{HasInverse, HasJacobian, HasMassMatrix};
use holonom::prelude::*;
use holonom_models::{Bricard, FourBar, SliderCrank};

use super::reference;

const RATE: f64 = 1.5;

/// Mass and bias of a mechanism, of the largest there; efforts and accelerations, there and back.
fn agrees<M: HasInverse + HasMassMatrix + HasJacobian + Default>(
    chosen: impl Chosen<M, 1>,
    wanted: &[[f64; 3]],
) -> Result<(), Fault> {
    let mechanism = M::default();
    let space = mechanism.coordinates(chosen)?;
    let largest = |column: usize| {
        wanted
            .iter()
            .map(|row| row[column].abs())
            .fold(0.0, f64::max)
    };
    let (most, most_bias) = (largest(1), largest(2));
    let mut near = None;
    for &[angle, mass, bias] in wanted {
        let state = match near {
            None => space.state([angle], [RATE])?,
            Some(near) => space.state_near(&near, [angle], [RATE])?,
        };
        near = Some(state);
        // By the nearest turns: from -2.9 rad to 0.7 it is shorter to go backwards.
        let turns = (space.positions(&state)?[0] - angle) / core::f64::consts::TAU;
        assert!((turns - turns.round()).abs() < 1e-15, "{turns}");
        assert!((space.rates(&state)[0] - RATE).abs() < 1e-14);
        let found = (space.mass(&state)?[0], space.bias(&state)?[0]);
        let errors = [
            (found.0 - mass).abs() / most,
            (found.1 - bias).abs() / most_bias,
        ];
        assert!(
            errors.iter().all(|error| *error < 1e-13),
            "{angle}: {found:?}, {errors:?}"
        );
        let efforts = space.inverse(&state, [0.7])?;
        assert!((efforts[0] - (mass * 0.7 + bias)).abs() < 1e-13 * (most + most_bias));
        assert!(
            (space.forward(&state, efforts)?[0] - 0.7).abs() < 1e-13 * (1.0 + most_bias / mass)
        );
        let kinetic = 0.5 * mass * RATE * RATE;
        assert!((space.kinetic_energy(&state) - kinetic).abs() < 1e-13 * most);
    }
    Ok(())
}

#[test]
fn a_parallelogram() -> Result<(), Fault> {
    agrees::<FourBar>([FourBar::HANDLES.left_foot], &reference::FOUR_BAR)
}

#[test]
fn a_slider_crank() -> Result<(), Fault> {
    agrees::<SliderCrank>([SliderCrank::HANDLES.bearing], &reference::SLIDER_CRANK)
}

#[test]
fn bricard() -> Result<(), Fault> {
    agrees::<Bricard>([Bricard::HANDLES.p1], &reference::BRICARD)
}

/// Velocities and accelerations of points, against what is read from the bodies.
#[test]
fn jacobians_of_loops() -> Result<(), Fault> {
    let (crank, h) = (SliderCrank::default(), SliderCrank::HANDLES);
    let space = crank.coordinates([h.bearing])?;
    for angle in [-2.0, 0.4, 1.9] {
        let state = space.state([angle], [RATE])?;
        let bodies = space.bodies(&state);
        let view = crank.view(0.0, &bodies)?;
        for body in [h.crank, h.rod, h.slider] {
            let velocity = space.jacobian(&state, body)? * RATE;
            let read = (view.velocity(body), view.angular_velocity_global(body));
            assert!((velocity.fixed_rows::<3>(0) - read.0).norm() < 1e-14);
            assert!((velocity.fixed_rows::<3>(3) - read.1).norm() < 1e-13);
            let step = 1e-5;
            let [before, after] = [-step, step].map(|step| {
                let there = space.state_near(&state, [angle + RATE * step], [RATE])?;
                space.jacobian(&there, body)
            });
            let difference = (after? - before?) / (2.0 * step);
            let rate = space.jacobian_rate(&state, body)?;
            assert!((difference - rate).norm() < 1e-8 * (1.0 + rate.norm()));
        }
        // The centre of mass of all and of two, by differences of its places.
        let velocity = space.centre_of_mass_jacobian(&state, ..)? * RATE;
        let two = [h.crank, h.rod];
        let of_two = space.centre_of_mass_jacobian(&state, two)? * RATE;
        let centres = [-1e-5, 1e-5].map(|step| -> Result<_, Fault> {
            let there = space.state_near(&state, [angle + RATE * step], [RATE])?;
            let bodies = space.bodies(&there);
            let view = crank.view(0.0, &bodies)?;
            Ok((view.centre_of_mass(..)?, view.centre_of_mass(two)?))
        });
        let [before, after] = centres;
        let (before, after) = (before?, after?);
        assert!(((after.0 - before.0) / 2e-5 - velocity).norm() < 1e-8);
        assert!(((after.1 - before.1) / 2e-5 - of_two).norm() < 1e-8);
        assert!((view.centre_of_mass_velocity(two)? - of_two).norm() < 1e-14);
        // One degree of freedom: a mass that a force would feel.
        let along = space.jacobian(&state, h.slider)?[(0, 0)];
        let x = nalgebra::Vector3::new(2.0, 0.0, 0.0);
        let felt = space.effective_mass(&state, h.slider, x)?;
        assert!((felt * along * along / space.mass(&state)?[(0, 0)] - 1.0).abs() < 1e-12);
    }
    Ok(())
}
