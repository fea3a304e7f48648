//! The Jacobian that implicit methods take, of every model, in both descriptions: against the dual
//! numbers of num-dual, one column at a time from parameters on, and against central differences of
//! the rates.

#![forbid(unsafe_code)]

#[path = "../../tests/kernels/scalars/dual.rs"]
mod dual;
mod laws;

use holonom::{
    Baumgarte, Formulation, JointCoordinates, Mechanism, Penalty, StandardLagrange, StateParts,
    dynamics::{Dynamics, Problem},
    integrate::System,
    mechanism::JointParts,
    state::{Array, MovingState, Vector},
};
use holonom_models as models;
use nalgebra::DMatrix;

use self::dual::Dual;

const TIME: f64 = 0.13;

/// What dual numbers may differ by, relative to the largest number of a row: round-off, and what is
/// made of it by equations that nearly depend on each other.
const ROUND_OFF: f64 = 1e-9;

/// What central differences may differ by, relative to the largest number of the matrix: the square
/// of their step, and round-off over it.
const FINITE: f64 = 1e-5;
const STEP: f64 = 1e-5;

/// Numbers between -1 and 1 without a pattern.
pub(crate) fn scattered(seed: u64) -> impl FnMut() -> f64 {
    let mut bits = seed;
    move || {
        bits = bits
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A state beside this one: increments of up to `size` in every element.
fn beside<X: Vector<f64>>(state: &X, size: f64, seed: u64) -> X {
    let mut number = scattered(seed);
    let direction = state.zip(state, |_, _| number());
    state.plus([(size, &direction)])
}

/// The matrix that a system offers: rows are rates, columns elements of the state. With the number
/// of evaluations that it counts.
pub(crate) fn offered<Y: System<f64>>(system: &mut Y, state: &Y::State) -> (DMatrix<f64>, usize) {
    let rates = system.rates(TIME, state).expect("rates");
    let mut columns = state.each(rates.clone());
    let count = system
        .jacobian(TIME, state, &rates, &mut columns)
        .expect("a Jacobian");
    let length = state.length();
    let matrix = DMatrix::from_fn(length, length, |row, column| columns[column].element(row));
    (matrix, count)
}

/// Central differences along increments of the state.
pub(crate) fn differences<Y: System<f64>>(system: &mut Y, state: &Y::State) -> DMatrix<f64> {
    let length = state.length();
    let mut matrix = DMatrix::zeros(length, length);
    for column in 0..length {
        let mut unit = state.zip(state, |_, _| 0.0);
        unit.set_element(column, 1.0);
        let step = STEP * state.element(column).abs().max(1.0);
        let mut at = |step| {
            system
                .rates(TIME, &state.plus([(step, &unit)]))
                .expect("rates")
        };
        let (ahead, behind) = (at(step), at(-step));
        for row in 0..length {
            matrix[(row, column)] = (ahead.element(row) - behind.element(row)) / (2.0 * step);
        }
    }
    matrix
}

/// The largest difference, relative to the largest number of each row, and of the whole matrix.
fn apart(a: &DMatrix<f64>, b: &DMatrix<f64>) -> [f64; 2] {
    let difference = a - b;
    let whole = difference.amax() / b.amax();
    let rows = difference.row_iter().zip(b.row_iter());
    let by_rows = rows.map(|(difference, row)| {
        // What cancels in a row leaves round-off of what was there.
        difference.amax() / row.amax().max(1e-3 * b.amax()).max(f64::MIN_POSITIVE)
    });
    // `max` would lose what is not a number.
    let by_rows = by_rows.fold(0.0, |most: f64, x| if x <= most { most } else { x });
    [by_rows, whole]
}

/// Numbers lifted along one direction.
fn along(values: &[f64], derivatives: &[f64], to: &mut [Dual]) {
    for ((to, &value), &derivative) in to.iter_mut().zip(values).zip(derivatives) {
        *to = Dual::new(value, derivative);
    }
}

fn derivatives(numbers: &[Dual]) -> impl Iterator<Item = f64> {
    numbers.iter().map(|number| number.derivative())
}

/// The coefficients of a formulation over dual numbers.
fn stabilisation<F: Formulation<f64>>(formulation: &F) -> holonom::mechanism::Stabilisation<Dual> {
    let holonom::mechanism::Stabilisation {
        rate,
        position,
        compliance,
    } = formulation.stabilisation().expect("sound");
    holonom::mechanism::Stabilisation {
        rate: Dual::new(rate, 0.0),
        position: Dual::new(position, 0.0),
        compliance: Dual::new(compliance, 0.0),
    }
}

/// The compliance of every row: in metres, so that a difference of squares of a length `l` has
/// `(2 l)^2` times as much.
fn compliances<M: Mechanism>(mechanism: &M, compliance: Dual) -> M::Multipliers<Dual> {
    let mut compliances = M::Multipliers::<Dual>::zeros();
    compliances.as_mut_slice().fill(compliance);
    let constants = M::prepare(&mechanism.parameters::<f64>().expect("parameters"));
    let jacobian = M::jacobian(&constants, 0.0, &M::initial_state(&constants));
    for block in M::REPORT.blocks {
        if M::REPORT.joints[block.joint].kind == "Distance" {
            let gradient = &jacobian.as_slice()[block.offset..][..3];
            let square = gradient.iter().map(|part| part * part).sum();
            compliances.as_mut_slice()[block.row] = compliance * Dual::new(square, 0.0);
        }
    }
    compliances
}

/// The matrix by dual numbers, from the parameters on; coordinates of bodies are numbers.
fn by_dual_numbers<M: Mechanism, F: Formulation<f64>>(
    mechanism: &M,
    formulation: &F,
    state: &M::State<f64>,
) -> DMatrix<f64> {
    let constants = M::prepare(&mechanism.parameters::<Dual>().expect("parameters"));
    let stabilisation = stabilisation(formulation);
    let compliances = compliances::<M>(mechanism, stabilisation.compliance);
    let coefficients = M::coefficients_by_row(&constants, &stabilisation, &compliances);
    let length = state.length();
    let mut matrix = DMatrix::zeros(length, length);
    for column in 0..length {
        let mut unit = state.zip(state, |_, _| 0.0);
        unit.set_element(column, 1.0);
        let zeros = || M::State::<Dual>::from_parts(Array::zeros(), Array::zeros());
        let (mut at, mut rates) = (zeros(), zeros());
        let (q, u) = (state.coordinates(), state.velocities());
        let (dq, du) = (unit.coordinates(), unit.velocities());
        along(
            q.as_slice(),
            dq.as_slice(),
            at.coordinates_mut().as_mut_slice(),
        );
        along(
            u.as_slice(),
            du.as_slice(),
            at.velocities_mut().as_mut_slice(),
        );
        M::evaluate_into::<Dual, F::Terms>(
            &constants,
            &coefficients,
            Dual::new(TIME, 0.0),
            &at,
            &mut rates,
            &mut Array::zeros(),
        );
        let coordinates = derivatives(rates.coordinates().as_slice());
        let all = coordinates.chain(derivatives(rates.velocities().as_slice()));
        for (row, value) in all.enumerate() {
            matrix[(row, column)] = value;
        }
    }
    matrix
}

/// The matrix by dual numbers in joint coordinates: a pair moves by `(-sine, cosine)`.
fn by_dual_numbers_of_joints<M: JointCoordinates, F: Formulation<f64>>(
    mechanism: &M,
    formulation: &F,
    state: &M::JointState<f64>,
) -> DMatrix<f64> {
    let constants = M::prepare_joints(&mechanism.parameters::<Dual>().expect("parameters"));
    let stabilisation = stabilisation(formulation);
    let of_all = compliances::<M>(mechanism, stabilisation.compliance);
    let mut compliances = M::ClosingMultipliers::<Dual>::zeros();
    let closing = compliances.as_mut_slice().iter_mut();
    for (compliance, &row) in closing.zip(M::JOINT_REPORT.rows) {
        *compliance = row.map_or(stabilisation.compliance, |row| of_all.as_slice()[row]);
    }
    let coefficients = M::joint_coefficients(&constants, &stabilisation, &compliances);
    let length = state.length();
    let pairs = length - state.rest_slice().len() - state.rates_slice().len();
    let mut matrix = DMatrix::zeros(length, length);
    for column in (0..length).filter(|&column| column >= pairs || column % 2 == 0) {
        let mut at = M::JointState::<Dual>::zeros();
        for element in 0..length {
            let slope = match element {
                _ if element == column && column < pairs => -state.element(column + 1),
                _ if column < pairs && element == column + 1 => state.element(column),
                _ => f64::from(u8::from(element == column)),
            };
            at.set_element(element, Dual::new(state.element(element), slope));
        }
        let mut rates = M::JointState::<Dual>::zeros();
        let time = Dual::new(TIME, 0.0);
        M::joint_rates_into::<Dual, F::Terms>(&constants, &coefficients, time, &at, &mut rates);
        let mut row = 0;
        rates.for_each(|rate: Dual| {
            matrix[(row, column)] = rate.derivative();
            row += 1;
        });
    }
    matrix
}

/// How many roundings on the way may count as much as one of the state does.
const ROUNDINGS: f64 = 16.0;

/// Judges a matrix by two others. The exact one is given at the state and at the next numbers above
/// its elements: what that changes is what a rounding does.
#[track_caller]
fn judge(what: &str, offered: &DMatrix<f64>, exact: [&DMatrix<f64>; 2], finite: &DMatrix<f64>) {
    let [exact, beside] = exact;
    let [by_rows, _] = apart(offered, exact);
    let [resolved, _] = apart(beside, exact);
    let [_, whole] = apart(offered, finite);
    println!("{what}: {by_rows:.1e} of dual numbers, {whole:.1e} of differences");
    assert!(
        by_rows < ROUND_OFF.max(ROUNDINGS * resolved),
        "{what}: {by_rows:e} of dual numbers, {resolved:e} by a digit of the state"
    );
    assert!(whole < FINITE, "{what}: {whole:e} of differences");
}

/// The next numbers above the elements of a state.
fn next<X: Vector<f64>>(state: &X) -> X {
    state.zip(state, |x, _| x.next_up())
}

fn formulated<M: JointCoordinates, F: Formulation<f64>>(mechanism: &M, formulation: F) {
    let name = format!("{} {formulation:?}", M::REPORT.name);
    let mut bodies = Dynamics::<Problem<M, F>>::new(mechanism, formulation)
        .expect("sound")
        .absolute_coordinates();
    let start = M::initial_state(bodies.constants());
    for (size, seed) in [(0.01, 1), (0.1, 2)] {
        // Off the constraints, and `p` off length 1.
        let state = beside(&start, size, seed);
        let (matrix, count) = offered(&mut bodies, &state);
        assert_eq!(count, state.length());
        let exact =
            [state, next(&state)].map(|state| by_dual_numbers(mechanism, &formulation, &state));
        let finite = differences(&mut bodies, &state);
        judge(
            &format!("{name} by bodies"),
            &matrix,
            exact.each_ref(),
            &finite,
        );
    }
    let mut joints = Dynamics::<Problem<M, F>>::new(mechanism, formulation)
        .expect("sound")
        .joint_coordinates();
    let start = joints.initial_state().expect("assembled");
    for (size, seed) in [(0.01, 3), (0.3, 4)] {
        let state = beside(&start, size, seed);
        let (matrix, count) = offered(&mut joints, &state);
        let moving = (0..state.length())
            .filter(|&k| state.is_independent(k))
            .count();
        assert_eq!(count, moving);
        let exact = [state, next(&state)]
            .map(|state| by_dual_numbers_of_joints::<M, F>(mechanism, &formulation, &state));
        let finite = differences(&mut joints, &state);
        judge(
            &format!("{name} by joints"),
            &matrix,
            exact.each_ref(),
            &finite,
        );
    }
}

fn exact<M: JointCoordinates + Default>() {
    let mechanism = M::default();
    formulated(&mechanism, StandardLagrange);
    formulated(&mechanism, Baumgarte::default());
    formulated(&mechanism, Penalty::default());
}

macro_rules! every_model {
    ($($test:ident $model:ident,)*) => {$(
        #[test]
        fn $test() {
            exact::<models::$model>();
        }
    )*};
}

every_model! {
    bicycle Bicycle,
    bricard Bricard,
    cart_pole CartPole,
    door Door,
    double_four_bar DoubleFourBar,
    driven_slider_crank DrivenSliderCrank,
    flyball_governor FlyballGovernor,
    four_bar FourBar,
    heavy_chain HeavyChain,
    heavy_top HeavyTop,
    panda Panda,
    quintuple_four_bar QuintupleFourBar,
    rod_pendulum RodPendulum,
    simple_pendulum SimplePendulum,
    slider_crank SliderCrank,
    squeezing_mechanism SqueezingMechanism,
    ur5 Ur5,
    variable_length_pendulum VariableLengthPendulum,
}
