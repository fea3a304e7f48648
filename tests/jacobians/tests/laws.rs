//! Laws, inputs, closures, readings of Euler parameters and number types: what else a Jacobian is
//! made of.

use holonom::forces::{Actuator, SpringDamper, TorsionalActuator};
use holonom::joints::{Distance, Revolute, Spherical};
use holonom::prelude::*;
use holonom::{
    AugmentedLagrangian,
    dynamics::Dynamics,
    integrate::System,
    mechanism::{Normalised, Orientation},
    state::Vector,
};
use nalgebra::DMatrix;

use super::{apart, beside, by_dual_numbers, differences, offered};

/// Euler parameters read as they are, at any length.
#[derive(Clone, Copy, Debug, Default)]
struct Chapter15;

impl Orientation for Chapter15 {
    const NORMALISED_RATES: bool = true;
}

/// An arm with a motor, and a bob on a rope at its end, with numbers that are known at run time.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Swing {
    #[param]
    reach: f64,
    #[input]
    gain: f64,
    #[body(mass = 2.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5 * reach, 0.0])]
    arm: Body,
    #[body(
        mass = 1.0,
        inertia = [[0.02, 0.001, 0.0], [0.001, 0.03, 0.0], [0.0, 0.0, 0.02]],
        position = [0.1, reach, -0.3]
    )]
    bob: Body,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [arm, bob], point = [0.0, reach, 0.0])]
    ball: Spherical,
    #[force(between = [ground, arm], axis = [1.0, 0.0, 0.0], moment = gain * sin(3.0 * angle + time) - 0.2 * gain * rate)]
    motor: TorsionalActuator,
    #[force(between = [ground, bob], head = [0.5, 0.0, 0.2], tail = [0.1, reach, -0.3], force = gain * exp(-length) - 0.1 * rate)]
    rope: Actuator,
}

fn swing() -> Swing {
    Swing::new(0.8).expect("sound")
}

/// What central differences leave, relative to the largest number; and what those of a closure's
/// forces do, to one side.
const EXACT: f64 = 1e-8;
const CLOSURE: f64 = 1e-6;

/// A Jacobian, judged by central differences.
#[track_caller]
fn agrees<Y: System<f64>>(
    what: &str,
    system: &mut Y,
    state: &Y::State,
    (count, asked): (usize, f64),
) -> DMatrix<f64> {
    let (matrix, counted) = offered(system, state);
    assert_eq!(counted, count, "{what}");
    let [_, whole] = apart(&matrix, &differences(system, state));
    println!("{what}: {whole:.1e}");
    assert!(whole < asked, "{what}: {whole:e}");
    matrix
}

/// Inputs are those of the present, and those of the mechanism do not count.
#[test]
fn parameters_and_inputs_enter() {
    let mut bodies = Dynamics::<Problem<_, _>>::new(&swing(), StandardLagrange).expect("sound");
    let mut joints = Dynamics::<Problem<_, _>>::new(&swing(), StandardLagrange)
        .expect("sound")
        .joint_coordinates();
    let of_bodies = beside(&Swing::initial_state(bodies.constants()), 0.1, 5);
    let of_joints = beside(&joints.initial_state().expect("assembled"), 0.3, 6);
    let mut before = None;
    for gain in [0.0, 4.0, -30.0] {
        type Inputs = <Swing as Mechanism>::Inputs<f64>;
        let inputs = Inputs { gain };
        bodies.set_inputs(&inputs).expect("finite");
        joints.set_inputs(&inputs).expect("finite");
        let matrix = agrees("bodies", &mut bodies, &of_bodies, (27, EXACT));
        let exact = by_dual_numbers(&Swing { gain, ..swing() }, &StandardLagrange, &of_bodies);
        assert!(apart(&matrix, &exact)[0] < 1e-11);
        let changed = before.replace(matrix.clone());
        assert!(changed.is_none_or(|before| (matrix - before).amax() > 1.0));
        // Euler parameters of the ball, the pair of the hinge and its count of turns.
        agrees("joints", &mut joints, &of_joints, (1 + 5 + 4, EXACT));
    }
}

/// A fan on a motor whose current is a state, against a moment from a table.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", kernels = [derivatives])]
struct Fan {
    #[param]
    drag: Spline<4>,
    #[state(rate = (6.0 - 2.0 * current * current - 0.5 * shaft.rate * cos(time)) / 0.2)]
    current: f64,
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.02])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[force(between = [ground, rotor], axis = [0.0, 0.0, 1.0], moment = 0.5 * current - drag(rate))]
    motor: TorsionalActuator,
}

/// Rows and columns of the current, and the slope of the table where the shaft turns. By joints,
/// the kernel that is asked for has them.
#[test]
fn states_and_tables_enter() {
    assert!(Fan::DERIVED_BY.is_some() && !Fan::HAS_RATE_COLUMNS);
    let drag = Spline::natural([-2.0, 0.5, 1.0, 2.0], [-0.9, 0.1, 0.4, 2.0]);
    let fan = Fan::new(drag).expect("sound");
    let mut bodies = Dynamics::<Problem<_, _>>::new(&fan, StandardLagrange).expect("sound");
    let mut joints = bodies.clone().joint_coordinates();
    let mut of_bodies = Fan::initial_state(bodies.constants());
    fan.set_angle_rate(&mut of_bodies, Fan::HANDLES.shaft, 0.8)
        .expect("a free rate");
    Fan::set_state_value(&mut of_bodies, Fan::HANDLES.current, 1.7);
    let of_joints = joints.state_of(&of_bodies).expect("consistent");
    // Seven coordinates of the rotor, six velocities; a pair, a rate; the current.
    let matrix = agrees("bodies", &mut bodies, &of_bodies, (7 + 6 + 1, EXACT));
    assert!(matrix.amax() > 10.0);
    agrees("joints", &mut joints, &of_joints, (1 + 1 + 1, EXACT));
}

/// A swing of bodies alone, with the kernel of derivatives: bodies, Euler parameters, a loop, an
/// angle that is counted, a state and an input.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], kernels = [derivatives])]
struct Tied {
    #[input]
    gain: f64,
    #[state(rate = gain - 3.0 * current * current - 0.2 * hinge.rate)]
    current: f64,
    #[body(mass = 2.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.4, 0.0])]
    arm: Body,
    #[body(
        mass = 1.0,
        inertia = [[0.02, 0.001, 0.0], [0.001, 0.03, 0.0], [0.0, 0.0, 0.02]],
        position = [0.1, 0.8, -0.3]
    )]
    bob: Body,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [arm, bob], point = [0.0, 0.8, 0.0])]
    ball: Spherical,
    #[joint(between = [ground, bob], head = [0.5, 0.9, 0.4], tail = [0.1, 0.8, -0.4])]
    tie: Distance,
    #[force(between = [ground, arm], axis = [1.0, 0.0, 0.0],
        moment = current * sin(3.0 * angle + time) - 0.2 * gain * rate)]
    motor: TorsionalActuator,
    #[force(between = [ground, bob], head = [0.5, 0.0, 0.2], tail = [0.1, 0.8, -0.3], stiffness = 40.0, free_length = 0.6)]
    spring: SpringDamper,
}

/// Bodies and all formulations, off the constraints, by the kernel that is asked for.
#[test]
fn bodies_have_a_kernel_of_derivatives() {
    fn in_a_formulation<F: Formulation<f64>>(formulation: F) {
        let tied = Tied {
            gain: 0.7,
            current: 1.3,
            ..Tied::default()
        };
        let mut dynamics = Dynamics::<Problem<_, _>>::new(&tied, formulation).expect("sound");
        for (size, seed) in [(0.01, 11), (0.2, 12)] {
            let state = beside(&Tied::initial_state(dynamics.constants()), size, seed);
            // Fourteen coordinates, a count of turns, the current, twelve velocities.
            let matrix = agrees("tied", &mut dynamics, &state, (28, EXACT));
            let exact = by_dual_numbers(&tied, &formulation, &state);
            let [by_rows, _] = apart(&matrix, &exact);
            assert!(by_rows < 1e-11, "{formulation:?}: {by_rows:e}");
        }
    }
    const { assert!(Tied::HAS_RATE_COLUMNS && !Swing::HAS_RATE_COLUMNS) };
    in_a_formulation(StandardLagrange);
    in_a_formulation(Baumgarte::default());
    in_a_formulation(Penalty::default());
}

/// A drag of the air, which only plain numbers know, enters by differences, and everything else
/// does not.
#[test]
fn closures_enter_by_differences_of_their_forces() {
    let swing = Swing {
        gain: 3.0,
        ..swing()
    };
    let drag =
        |_: f64, state: &<Swing as Mechanism>::State<f64>, loads: &mut Loads<'_, f64, Swing>| {
            let velocity = Swing::velocity(state, Swing::HANDLES.bob);
            let force = -0.3 * velocity.norm() * velocity;
            loads.force_at(Swing::HANDLES.bob, [0.0, 0.1, 0.05], force.into());
        };
    fn in_both<F: Formulation<f64>>(
        swing: &Swing,
        formulation: F,
        drag: impl Fn(f64, &<Swing as Mechanism>::State<f64>, &mut Loads<'_, f64, Swing>) + Copy,
    ) {
        let bodies = Dynamics::<Problem<_, _>>::new(swing, formulation).expect("sound");
        let state = beside(&Swing::initial_state(bodies.constants()), 0.1, 7);
        let without = offered(&mut bodies.clone(), &state).0;
        let with = agrees("bodies", &mut bodies.forces(drag), &state, (27, CLOSURE));
        assert!((with - without).amax() > 0.1);
        let joints = Dynamics::<Problem<_, _>>::new(swing, formulation)
            .expect("sound")
            .joint_coordinates();
        let state = beside(&joints.initial_state().expect("assembled"), 0.3, 8);
        let without = offered(&mut joints.clone(), &state).0;
        let with = agrees("joints", &mut joints.forces(drag), &state, (10, CLOSURE));
        assert!((with - without).amax() > 0.1);
    }
    in_both(&swing, StandardLagrange, drag);
    in_both(&swing, Baumgarte::default(), drag);
    in_both(&swing, Penalty::default(), drag);
    in_both(&swing, AugmentedLagrangian::default(), drag);
}

#[test]
fn euler_parameters_are_read_as_by_the_evaluation() {
    fn read_as<P: Orientation>() {
        let swing = Swing {
            gain: 2.0,
            ..swing()
        };
        let dynamics = Dynamics::<Problem<_, _>>::new(&swing, Baumgarte::default()).expect("sound");
        let mut dynamics = dynamics.orientation::<P>();
        let state = beside(&Swing::initial_state(dynamics.constants()), 0.1, 9);
        let matrix = agrees("as read", &mut dynamics, &state, (27, EXACT));
        if !P::NORMALISED_RATES {
            let exact = by_dual_numbers(&swing, &Baumgarte::default(), &state);
            assert!(apart(&matrix, &exact)[0] < 1e-11);
        }
    }
    read_as::<Normalised>();
    read_as::<Chapter15>();
}

/// Differences have three digits there.
#[test]
fn single_precision_has_its_digits() {
    let swing = Swing {
        gain: 2.0,
        ..swing()
    };
    let mut double = Dynamics::<Problem<_, _>>::new(&swing, StandardLagrange)
        .expect("sound")
        .joint_coordinates();
    let mut single = Dynamics::<Problem<_, _, f32>>::new(&swing, StandardLagrange)
        .expect("sound")
        .joint_coordinates();
    let state = beside(&double.initial_state().expect("assembled"), 0.3, 10);
    let mut rounded = single.initial_state().expect("assembled");
    for index in 0..state.length() {
        rounded.set_element(index, state.element(index) as f32);
    }
    let (exact, _) = offered(&mut double, &state);
    let rates = single.rates(0.13, &rounded).expect("rates");
    let mut columns = rounded.each(rates);
    single
        .jacobian(0.13, &rounded, &rates, &mut columns)
        .expect("a Jacobian");
    let found = DMatrix::from_fn(exact.nrows(), exact.ncols(), |row, column| {
        f64::from(columns[column].element(row))
    });
    let [_, whole] = apart(&found, &exact);
    println!("single precision: {whole:.1e}");
    assert!(whole < 2e-6, "{whole:e}");
}

/// The root of a distance has no derivative where the distance is zero, and an implicit method no
/// worse a Jacobian than by differences.
#[test]
fn where_there_is_no_derivative_differences_stand_in() {
    /// A cart on a spring that is the softer the farther it is pulled.
    #[derive(Mechanism)]
    #[mechanism(coordinates = "both")]
    struct Cart {
        #[body(mass = 1.0, position = [0.5, 0.0, 0.0])]
        cart: Particle,
        #[force(between = [ground, cart], head = [0.0, 0.0, 0.0], tail = [0.5, 0.0, 0.0], force = -sqrt(length - 0.5))]
        spring: Actuator,
    }
    let mut bodies =
        Dynamics::<Problem<_, _>>::new(&Cart::default(), StandardLagrange).expect("sound");
    let state = Cart::initial_state(bodies.constants());
    let (matrix, count) = offered(&mut bodies, &state);
    assert_eq!(count, 6);
    assert!(matrix.iter().all(|number| number.is_finite()), "{matrix}");
    assert!(matrix[(3, 0)] < -1e3, "{matrix}");
}
