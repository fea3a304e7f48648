//! The direct correction against the pseudo-inverse of a dense Jacobian, and where equations depend
//! on each other.

use holonom::error::{StartFault, StepFault};
use holonom::joints::{Distance, Revolute};
use holonom::prelude::*;
use holonom::{Real, mechanism::BodyKind, state::Array};
use holonom_models::{Bricard, FlyballGovernor, FourBar, HeavyTop, SliderCrank};
use holonom_study::trade::DirectCorrection;
use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::singular::Arm;

/// `D`, dense.
fn jacobian<M: Mechanism>(constants: &M::Constants<f64>, state: &M::State<f64>) -> DMatrix<f64> {
    let blocks = M::jacobian(constants, 0.0, state);
    let mut dense = DMatrix::zeros(M::REPORT.equations, state.velocities().as_slice().len());
    for block in M::REPORT.blocks {
        for row in 0..block.rows {
            for column in 0..block.columns {
                dense[(block.row + row, block.column + column)] +=
                    blocks.as_slice()[block.offset + row * block.columns + column];
            }
        }
    }
    dense
}

/// The least `d` with `D d = -violation`, a square of a rotation counting `turn`, by singular
/// values; those below 1e-10 of the largest are none.
fn least(jacobian: &DMatrix<f64>, violation: &[f64], metric: &DVector<f64>) -> DVector<f64> {
    let roots = metric.map(f64::sqrt);
    let scaled = DMatrix::from_fn(jacobian.nrows(), jacobian.ncols(), |row, column| {
        jacobian[(row, column)] / roots[column]
    });
    let svd = scaled.svd(true, true);
    let least = 1e-10 * svd.singular_values.max();
    let inverse = svd.pseudo_inverse(least).expect("both sides");
    let step = -(inverse * DVector::from_column_slice(violation));
    step.component_div(&roots)
}

fn metric<M: Mechanism>(turn: f64, length: usize) -> DVector<f64> {
    let mut metric = DVector::from_element(length, 1.0);
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            metric.rows_mut(body.velocity + 3, 3).fill(turn);
        }
    }
    metric
}

/// `r` by addition, `p` by the rotation.
fn moved<M: Mechanism>(state: &M::State<f64>, step: &[f64]) -> M::State<f64> {
    let mut moved = *state;
    let coordinates = moved.coordinates_mut().as_mut_slice();
    for body in M::REPORT.bodies {
        for k in 0..3 {
            coordinates[body.coordinate + k] += step[body.velocity + k];
        }
        if body.kind == BodyKind::Rigid {
            let p = &mut coordinates[body.coordinate + 3..body.coordinate + 7];
            let turn = &step[body.velocity + 3..body.velocity + 6];
            let before = Quaternion::new(p[0], p[1], p[2], p[3]);
            let turn = UnitQuaternion::from_scaled_axis(Vector3::from_column_slice(turn));
            let after = UnitQuaternion::new_normalize(before * turn.into_inner());
            p.copy_from_slice(&[after.w, after.i, after.j, after.k]);
        }
    }
    moved
}

/// The described state beside the constraints by about `size` in all elements.
fn displaced<S: Real, M: Mechanism>(model: &M, size: f64, seed: u64) -> M::State<S> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut state = model.described_state::<S>().expect("sound");
    for element in state.coordinates_mut().as_mut_slice() {
        *element = *element + S::constant(size * random.random_range(-1.0..1.0));
    }
    for element in state.velocities_mut().as_mut_slice() {
        *element = *element + S::constant(size * random.random_range(-1.0..1.0));
    }
    // Euler parameters of length 1, as after a step.
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let p = &mut state.coordinates_mut().as_mut_slice()[body.coordinate + 3..][..4];
            let length = p.iter().fold(S::zero(), |sum, &e| sum + e * e).sqrt();
            p.iter_mut().for_each(|e| *e = e.quotient(length));
        }
    }
    state
}

/// `|Phi|` and `|Phi'|`.
fn violations<S: Real, M: Mechanism>(constants: &M::Constants<S>, state: &M::State<S>) -> [S; 2] {
    let norm = |rows: M::Multipliers<S>| {
        let squares = rows.as_slice().iter().map(|&x| x * x);
        squares.fold(S::zero(), |sum, square| sum + square).sqrt()
    };
    [
        norm(M::constraints(constants, S::zero(), state)),
        norm(M::constraint_rates(constants, S::zero(), state)),
    ]
}

/// The largest differences, of coordinates and of velocities, from the pseudo-inverse, over the
/// size of the displacement.
fn differences<M: Mechanism>(model: &M, size: f64) -> [f64; 2] {
    let constants = model.constants::<f64>().expect("sound");
    let mut largest = [0.0_f64; 2];
    for seed in 0..5 {
        let given = displaced::<f64, M>(model, size, seed);
        let mut found = given;
        let loose = DirectCorrection { tolerance: 1e-2 };
        loose
            .correct::<M>(&constants, 0.0, &mut found)
            .expect("corrected");
        let phi = M::constraints(&constants, 0.0, &given);
        let length = given.velocities().as_slice().len();
        let jacobian_there = jacobian::<M>(&constants, &given);
        let step = least(&jacobian_there, phi.as_slice(), &metric::<M>(0.25, length));
        let expected = moved::<M>(&given, step.as_slice());
        let rates = M::constraint_rates(&constants, 0.0, &expected);
        let jacobian_there = jacobian::<M>(&constants, &expected);
        let step = least(&jacobian_there, rates.as_slice(), &metric::<M>(1.0, length));
        let pairs = found.coordinates().as_slice().iter();
        let pairs = pairs.zip(expected.coordinates().as_slice());
        // Behind the coordinates of the bodies stand angles that count turns.
        for (found, expected) in pairs.take(M::REPORT.coordinates) {
            largest[0] = largest[0].max((found - expected).abs() / size);
        }
        let velocities = expected.velocities().as_slice().iter().zip(step.iter());
        for (found, (before, step)) in found.velocities().as_slice().iter().zip(velocities) {
            largest[1] = largest[1].max((found - (before + step)).abs() / size);
        }
    }
    largest
}

#[test]
fn the_correction_is_that_of_the_pseudo_inverse() {
    let found = [
        ("four-bar", differences(&FourBar::default(), 1e-3)),
        ("slider-crank", differences(&SliderCrank::default(), 1e-3)),
        ("heavy top", differences(&HeavyTop::default(), 1e-3)),
        ("governor", differences(&FlyballGovernor::default(), 1e-3)),
        ("Bricard", differences(&Bricard::default(), 1e-3)),
        ("unlike", differences(&Unlike::default(), 1e-3)),
    ];
    println!("{found:?}");
    for (name, [positions, velocities]) in found {
        assert!(
            positions < 1e-6 && velocities < 1e-6,
            "{name} {positions:e} {velocities:e}"
        );
    }
}

/// Masses from a milligram to a tonne: the mass-weighted correction moves the light one alone.
#[derive(Mechanism)]
struct Unlike {
    #[body(mass = 1e-3, position = [0.0, 0.0, 0.0], velocity = [0.1, 0.0, 0.0])]
    light: Particle,
    #[body(mass = 1e3, position = [1.0, 0.0, 0.0])]
    heavy: Particle,
    #[body(mass = 1.0, inertia = [1e-4, 1e-4, 1e-5], position = [1.0, 1.0, 0.0])]
    bar: Body,
    #[joint(between = [light, heavy], head = [0.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0])]
    rod: Distance,
    #[joint(between = [heavy, bar], head = [1.0, 0.0, 0.0], tail = [1.0, 0.9, 0.0])]
    other: Distance,
}

#[test]
fn masses_do_not_weigh() {
    let model = Unlike::default();
    let constants = model.constants::<f64>().expect("sound");
    let mut state = model.described_state::<f64>().expect("sound");
    state.coordinates_mut().as_mut_slice()[0] = -0.01;
    DirectCorrection::default()
        .correct::<Unlike>(&constants, 0.0, &mut state)
        .expect("corrected");
    let place = |body: usize| {
        let place = Unlike::REPORT.bodies[body].coordinate;
        state.coordinates().as_slice()[place]
    };
    let (light, heavy) = (place(0), place(1));
    // Half of it each, but for the second order.
    assert!((light + 0.005).abs() < 1e-4, "{light}");
    assert!((heavy - 0.995).abs() < 1e-4, "{heavy}");
}

#[test]
fn what_one_application_leaves_is_of_second_order() {
    let model = FourBar::default();
    let constants = model.constants::<f64>().expect("sound");
    let loose = DirectCorrection { tolerance: 1e-2 };
    let left = |size| {
        let mut state = displaced::<f64, FourBar>(&model, size, 3);
        let before = violations::<f64, FourBar>(&constants, &state);
        let residual = loose.correct::<FourBar>(&constants, 0.0, &mut state);
        assert_eq!(residual.expect("corrected"), 0.0);
        let after = violations::<f64, FourBar>(&constants, &state);
        [before[0], after[0]]
    };
    let [coarse, fine] = [left(1e-2), left(1e-3)];
    println!("{coarse:?} {fine:?}");
    assert!((coarse[0] / fine[0] - 10.0).abs() < 1.0);
    let ratio = coarse[1] / fine[1];
    assert!((80.0..125.0).contains(&ratio), "{ratio}");
    // By the default tolerance it counts as left.
    let mut state = displaced::<f64, FourBar>(&model, 3e-3, 3);
    let residual = DirectCorrection::default().correct::<FourBar>(&constants, 0.0, &mut state);
    let residual = residual.expect("lessened");
    assert!((1e-6..1e-4).contains(&residual), "{residual:e}");
}

/// A parallelogram of spatial hinges: three rows depend on the others.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "keep")]
struct Parallelogram {
    #[body(
        mass = 1.0,
        inertia = [0.08, 0.001, 0.08],
        position = [0.0, 0.5, 0.0],
        velocity = [0.5, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    left: Body,
    #[body(
        mass = 1.0,
        inertia = [0.001, 0.08, 0.08],
        position = [0.5, 1.0, 0.0],
        velocity = [1.0, 0.0, 0.0]
    )]
    top: Body,
    #[body(
        mass = 1.0,
        inertia = [0.08, 0.001, 0.08],
        position = [1.0, 0.5, 0.0],
        velocity = [0.5, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [left, top], point = [0.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [top, right], point = [1.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    c: Revolute,
    #[joint(between = [ground, right], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    d: Revolute,
}

#[test]
fn redundant_equations_are_corrected() {
    let model = Parallelogram::default();
    let report = Simulation::new(&model, AugmentedLagrangian::default(), Rk4::every(1e-3))
        .post_stabilisation(&DirectCorrection::default())
        .run(0.0..=0.3, every(0.01), |sample| {
            assert!(
                sample.violation() < 1e-18 && sample.velocity_violation() < 1e-15,
                "{:e} {:e} at {}",
                sample.violation(),
                sample.velocity_violation(),
                sample.time()
            );
            ControlFlow::Continue(())
        })
        .expect("solvable");
    println!("{}", report.warnings());
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn an_arm_pulled_beyond_its_reach_stops() {
    let arm = Arm::default();
    for step in [1e-3, 1e-4] {
        let outcome = Simulation::new(&arm, Penalty::default(), Rk4::every(step))
            .assembled()
            .post_stabilisation(&DirectCorrection::default())
            .run(0.0..=3.0, every(0.1), |_| ControlFlow::Continue(()));
        match outcome {
            Err(error) => {
                println!("{error}");
                assert!((1.99..2.01).contains(&error.time), "{}", error.time);
                assert!(
                    matches!(
                        error.fault,
                        Fault::Step(StepFault::NotConverged { joint: Some(_), .. })
                    ),
                    "{error}"
                );
            }
            Ok(report) => panic!("beyond reach: {}", report.warnings()),
        }
    }
}

#[test]
fn a_state_that_cannot_be_corrected_stays() {
    let model = FourBar::default();
    let constants = model.constants::<f64>().expect("sound");
    let correct = |tolerance: f64, state: &mut <FourBar as Mechanism>::State<f64>| {
        DirectCorrection { tolerance }.correct::<FourBar>(&constants, 0.0, state)
    };
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mut state = displaced::<f64, FourBar>(&model, 1e-3, 1);
        let before = state;
        let fault = correct(tolerance, &mut state).expect_err("a tolerance");
        assert!(
            matches!(fault, Fault::Start(StartFault::Setting { .. })),
            "{fault}"
        );
        assert_eq!(state, before);
    }
    for value in [f64::NAN, f64::INFINITY, 1e300, -1e200] {
        for place in 0..6 {
            let mut state = model.described_state::<f64>().expect("sound");
            state.coordinates_mut().as_mut_slice()[place % 3] = value;
            state.velocities_mut().as_mut_slice()[place] = value;
            let before = state;
            let fault = correct(1e-8, &mut state).expect_err("far off");
            let expected = matches!(
                fault,
                Fault::Step(StepFault::StateNotFinite | StepFault::NotConverged { .. })
            );
            assert!(expected, "{fault}");
            assert!(format!("{state:?}") == format!("{before:?}"));
        }
    }
    let mut state = model.described_state::<f64>().expect("sound");
    state.coordinates_mut().as_mut_slice()[3..7].fill(0.0);
    let fault = correct(1e-8, &mut state).expect_err("no orientation");
    assert!(
        matches!(fault, Fault::Step(StepFault::ZeroOrientation { .. })),
        "{fault}"
    );
}

#[test]
fn single_precision_is_corrected_to_its_digits() {
    fn left<M: Mechanism>(model: &M) -> [f32; 2] {
        let constants = model.constants::<f32>().expect("sound");
        let mut largest = [0.0_f32; 2];
        for seed in 0..5 {
            let mut state = displaced::<f32, M>(model, 1e-4, seed);
            DirectCorrection::default()
                .correct::<M>(&constants, 0.0, &mut state)
                .expect("corrected");
            let after = violations::<f32, M>(&constants, &state);
            largest = [largest[0].max(after[0]), largest[1].max(after[1])];
        }
        largest
    }
    let found = [
        left(&FourBar::default()),
        left(&SliderCrank::default()),
        left(&Bricard::default()),
        left(&Unlike::default()),
        left(&Parallelogram::default()),
    ];
    println!("{found:?}");
    for [positions, velocities] in found {
        assert!(positions < 3e-6 && velocities < 3e-5);
    }
}

#[test]
fn a_state_on_the_constraints_stays() {
    let model = Bricard::default();
    let constants = model.constants::<f64>().expect("sound");
    let mut state = model.described_state::<f64>().expect("sound");
    let before = state;
    let residual = DirectCorrection::default().correct::<Bricard>(&constants, 0.0, &mut state);
    assert_eq!((residual.expect("corrected"), state), (0.0, before));
}
