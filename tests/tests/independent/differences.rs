//! Linearisation of all models of the catalogue, against differences of accelerations.

use core::array::from_fn;
use std::fs;
use std::path::Path;

use holonom::independent::{Chosen, IndependentCoordinates};
use holonom::mechanism::{HasInverse, HasMassMatrix, ValueHandle};
use holonom::prelude::*;
use holonom_models::{
    Bricard, CartPole, Door, DoubleFourBar, FlyballGovernor, FourBar, HeavyTop, Panda, RodPendulum,
    SimplePendulum, SliderCrank, SqueezingMechanism, Ur5, VariableLengthPendulum,
};
use nalgebra::{Quaternion, SMatrix, SVector};

/// Of the largest entry.
const LIMIT: f64 = 1e-7;
/// Of differences (rad, m, rad/s, m/s, or the unit of an input).
const STEP: f64 = 1e-3;

/// The derivative at zero, by central differences of two steps, extrapolated (Richardson).
fn slope<const N: usize>(
    along: impl Fn(f64) -> Result<SVector<f64, N>, Fault>,
) -> Result<SVector<f64, N>, Fault> {
    let central = |step: f64| -> Result<SVector<f64, N>, Fault> {
        Ok((along(step)? - along(-step)?) / (2.0 * step))
    };
    Ok((4.0 * central(STEP)? - central(2.0 * STEP)?) / 3.0)
}

/// `columns` of differences against a matrix, whose entries compare by the largest of all.
fn near<const N: usize>(
    name: &str,
    found: &SMatrix<f64, N, N>,
    columns: impl Fn(usize, f64) -> Result<SVector<f64, N>, Fault>,
    largest: f64,
) -> Result<(), Fault> {
    let mut wanted = SMatrix::<f64, N, N>::zeros();
    for column in 0..N {
        wanted.set_column(column, &slope(|by| columns(column, by))?);
    }
    // What is small beside the whole is compared with a thousandth of it.
    let error = (found - wanted).amax() / wanted.amax().max(1e-3 * largest);
    assert!(error < LIMIT, "{name}: {error:.1e}, {found}{wanted}");
    Ok(())
}

fn moved<const N: usize>(numbers: [f64; N], place: usize, by: f64) -> [f64; N] {
    from_fn(|k| numbers[k] + if k == place { by } else { 0.0 })
}

/// Derivatives by coordinates and rates, and by all inputs and parameters, against differences.
fn agrees<M: HasInverse + HasMassMatrix + Default, const N: usize>(
    chosen: impl Chosen<M, N>,
    positions: [f64; N],
    rates: [f64; N],
) -> Result<&'static str, Fault> {
    let space: IndependentCoordinates<M, N> = M::default().coordinates(chosen)?;
    let described = space.of_bodies(&M::default().described_state()?);
    let state = space.state_near(&described, positions, rates)?;
    let linear = space.linearise(&state, [], |_| [])?;
    let at = |q: [f64; N], v: [f64; N]| {
        let there = space.state_near(&state, q, v)?;
        space.forward(&there, [0.0; N])
    };
    let name = M::REPORT.name;
    let largest = linear.by_positions.amax().max(linear.by_rates.amax());
    let by_position = |column, by| at(moved(positions, column, by), rates);
    near(name, &linear.by_positions, by_position, largest)?;
    let by_rate = |column, by| at(positions, moved(rates, column, by));
    near(name, &linear.by_rates, by_rate, largest)?;
    assert_eq!(linear.rates_by_positions.amax(), 0.0);
    let identity = linear.by_efforts * space.mass(&state)?;
    assert!((identity - SMatrix::identity()).amax() < 1e-12);
    for place in 0..M::REPORT.values.len() {
        let value = ValueHandle::new(place);
        let found = space.linearise(&state, [value], |_| [])?.by_values;
        let wanted = slope(|by| {
            let mut other = space;
            other.set_value(value, space.value(value) + by)?;
            let there = other.state_near(&state, positions, rates)?;
            other.forward(&there, [0.0; N])
        })?;
        let error = (found - wanted).amax() / wanted.amax();
        assert!(error < LIMIT, "{name}, {}: {error:.1e}", value.name());
    }
    Ok(name)
}

/// A ball turns along the axes of its body.
fn top() -> Result<&'static str, Fault> {
    let (top, h) = (HeavyTop::default(), HeavyTop::HANDLES);
    let space = top.coordinates([0, 1, 2].map(|k| Motion::of(h.tip, k)))?;
    let rates = [1.5, 20.0, -0.7];
    let at = |turn: Quaternion<f64>, rates: [f64; 3]| {
        let mut bodies = top.described_state::<f64>()?;
        let aslant = Quaternion::new(0.8, 0.36, -0.48, 0.0) * turn;
        top.set_relative_orientation(&mut bodies, h.tip, aslant)?;
        space.with_rates(&space.of_bodies(&bodies), rates)
    };
    let state = at(Quaternion::identity(), rates)?;
    let linear = space.linearise(&state, [], |_| [])?;
    let largest = linear.by_positions.amax().max(linear.by_rates.amax());
    let by_turn = |column: usize, by: f64| {
        let (sine, cosine) = (0.5 * by).sin_cos();
        let axis: [f64; 3] = moved([0.0; 3], column, sine);
        let turn = Quaternion::new(cosine, axis[0], axis[1], axis[2]);
        space.forward(&at(turn, rates)?, [0.0; 3])
    };
    near("HeavyTop", &linear.by_positions, by_turn, largest)?;
    let by_rate = |column, by| {
        let there = at(Quaternion::identity(), moved(rates, column, by))?;
        space.forward(&there, [0.0; 3])
    };
    near("HeavyTop", &linear.by_rates, by_rate, largest)?;
    // `t' = r - w x t`.
    let [x, y, z] = rates;
    let wanted = SMatrix::<f64, 3, 3>::new(0.0, z, -y, -z, 0.0, x, y, -x, 0.0);
    assert!((linear.rates_by_positions - wanted).amax() < 1e-14);
    Ok("HeavyTop")
}

/// The structs of the catalogue that ask for kernels, and can move.
fn catalogue() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/src");
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "rs") {
            continue;
        }
        let text = fs::read_to_string(path).expect("it is text");
        for part in text.split("#[mechanism(").skip(1) {
            let Some((attributes, rest)) = part.split_once("pub struct ") else {
                continue;
            };
            if attributes.contains("kernels = [") {
                let name = rest.split(|c: char| !c.is_alphanumeric()).next();
                names.extend(name.map(str::to_owned));
            }
        }
    }
    names.sort_unstable();
    names
}

#[test]
fn derivatives_are_those_of_differences() -> Result<(), Fault> {
    let mut seen = vec![top()?];
    let h = Ur5::HANDLES;
    seen.push(agrees::<Ur5, 6>(
        [h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3],
        [0.3, -0.8, 1.1, 0.4, -0.7, 2.0],
        [0.5, -1.0, 0.7, 1.5, -0.2, 0.9],
    )?);
    let h = Panda::HANDLES;
    seen.push(agrees::<Panda, 7>(
        [
            h.joint_1, h.joint_2, h.joint_3, h.joint_4, h.joint_5, h.joint_6, h.joint_7,
        ],
        [0.3, -0.8, 1.1, 0.4, -0.7, 2.0, 0.5],
        [0.5, -1.0, 0.7, 1.5, -0.2, 0.9, -0.6],
    )?);
    seen.push(agrees::<FourBar, 1>(
        [FourBar::HANDLES.left_foot],
        [0.4],
        [2.0],
    )?);
    seen.push(agrees::<DoubleFourBar, 1>(
        [DoubleFourBar::HANDLES.middle_foot],
        [-0.6],
        [2.0],
    )?);
    seen.push(agrees::<SliderCrank, 1>(
        [SliderCrank::HANDLES.bearing],
        [0.7],
        [20.0],
    )?);
    seen.push(agrees::<Bricard, 1>([Bricard::HANDLES.p1], [0.2], [1.5])?);
    seen.push(agrees::<SqueezingMechanism, 1>(
        [SqueezingMechanism::HANDLES.o],
        [0.3],
        [40.0],
    )?);
    let h = CartPole::HANDLES;
    seen.push(agrees::<CartPole, 2>(
        (h.rail, h.hinge),
        [0.2, 0.9],
        [1.0, -2.0],
    )?);
    seen.push(agrees::<RodPendulum, 1>(
        [RodPendulum::HANDLES.pivot],
        [0.6],
        [1.0],
    )?);
    seen.push(agrees::<Door, 1>(
        [Door::HANDLES.lower_hinge],
        [0.6],
        [1.0],
    )?);
    let h = VariableLengthPendulum::HANDLES;
    seen.push(agrees::<VariableLengthPendulum, 2>(
        (h.pin, h.guide),
        [0.4, 0.05],
        [1.0, -0.3],
    )?);
    let h = FlyballGovernor::HANDLES;
    seen.push(agrees::<FlyballGovernor, 4>(
        (h.bearing, h.guide, h.right_hinge, h.left_hinge),
        [0.4, 0.01, 0.02, 0.03],
        [6.0, -0.1, 0.2, 0.3],
    )?);
    let along = Motion::of(SimplePendulum::HANDLES.plane, 0);
    seen.push(agrees::<SimplePendulum, 1>([along], [-0.5], [1.0])?);
    // It has more coordinates than speeds: `rolling` has its linear models.
    seen.push("Bicycle");
    seen.sort_unstable();
    assert_eq!(seen, catalogue());
    Ok(())
}

/// Where entries of the closing rows vanish, and their derivatives do not.
#[test]
fn of_entries_that_vanish() -> Result<(), Fault> {
    agrees::<FourBar, 1>([FourBar::HANDLES.left_foot], [0.0], [2.0])?;
    agrees::<SliderCrank, 1>([SliderCrank::HANDLES.bearing], [0.0], [20.0])?;
    Ok(())
}
