//! Functions beside steps: what joints have, inverse dynamics, mass matrices, readings and
//! derivatives, by C and by Rust.

use crate::compiled::{Program, random_state};
use holonom::mechanism::{Absolute, HasInverse as _, HasMassMatrix as _, Relative};
use holonom::prelude::*;
use holonom::state::Vector;
use holonom_export::{Double, Export, ExportExt as _, Interface, Single, Source};
use holonom_models::{FourBar, Ur5};
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;

/// A program that reads a state and another variable, calls, and writes a variable.
fn program(source: &Source, declared: &str, read: &str, called: &str, written: &str) -> Program {
    let n = &source.name;
    let read = if read.is_empty() {
        String::new()
    } else {
        format!(" && fread(&{read}, sizeof {read}, 1, stdin) == 1")
    };
    let main = format!(
        "\
#include \"{n}.h\"
#include <stdio.h>

int main(void)
{{
    {n}_state state;
    {declared}
    while (fread(&state, sizeof state, 1, stdin) == 1{read}) {{
        {called}
        fwrite(&{written}, sizeof {written}, 1, stdout);
    }}
    return 0;
}}
"
    );
    Program::compiled(source, &main)
}

/// The numbers of a state behind the time 0.
fn given<X: Vector<f64>>(state: &X) -> Vec<f64> {
    let mut given = vec![0.0, 0.0];
    state.for_each(|number| given.push(number));
    given
}

fn near(a: f64, b: f64, tolerance: f64, what: &str) {
    let size = 1.0 + a.abs().max(b.abs());
    let is_near = (a - b).abs() < tolerance * size;
    assert!(is_near, "{what}: {a} for {b}");
}

type Ur5State = <Ur5 as JointCoordinates>::JointState<f64>;

/// The described state of a UR5, and a hundred at random.
fn states() -> Vec<Ur5State> {
    let stepper = Ur5::default().stepper(StandardLagrange, Rk4);
    let stepper = stepper.expect("described").joint_coordinates();
    let start = stepper.initial_state().expect("described");
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let random = (0..100).map(|_| random_state(&start, &mut random));
    random.chain([start]).collect()
}

fn ur5(name: &str) -> Export<Ur5, Double, Relative> {
    Export::new(&Ur5::default(), StandardLagrange).named(name)
}

#[test]
fn joints_are_what_the_report_says_and_can_be_put_back() {
    let source = ur5("joints").c().expect("exported");
    let program = program(
        &source,
        "joints_joints both[2];",
        "",
        "joints_get_joints(&state, &both[0]); joints_set_joints(&both[0], &state); joints_get_joints(&state, &both[1]);",
        "both",
    );
    for state in states() {
        let results = program.run(&given(&state));
        let (joints, again) = results.split_at(results.len() / 2);
        for motion in 0..6 {
            let report = &Ur5::JOINT_REPORT;
            let position = report.coordinate(motion, &state).expect("a turn");
            let rate = report.rate(motion, &state).expect("a turn");
            assert_eq!(
                joints[2 * motion..][..2],
                [position, rate],
                "motion {motion}"
            );
            near(again[2 * motion], position, 1e-14, "angle put back");
            near(again[2 * motion + 1], rate, 1e-14, "rate put back");
        }
    }
}

/// Two links on parallel axes, with springs that count the turns of one joint and of both, and a
/// nut on a screw, which is described to move against its thread.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Wound {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5, 0.0])]
    first: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 1.0, 0.5])]
    second: Body,
    #[body(
        mass = 2.0, inertia = [0.01, 0.01, 0.02],
        position = [1.0, 0.0, 0.0], velocity = [0.0, 0.0, 0.3]
    )]
    nut: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [first, second], point = [0.0, 1.0, 0.0], axis = [-1.0, 0.0, 0.0])]
    elbow: Revolute,
    #[joint(
        between = [ground, nut], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.1
    )]
    thread: Screw,
    #[force(between = [first, second], axis = [1.0, 0.0, 0.0], stiffness = 2.0)]
    spring: TorsionalSpringDamper,
    #[force(between = [ground, second], axis = [-1.0, 0.0, 0.0], stiffness = 3.0)]
    outer: TorsionalSpringDamper,
}

/// What joints have is put into a state over any number of turns, and what counts them goes along.
#[test]
fn joints_whose_turns_are_counted_are_set_over_all_turns() {
    let wound = Wound::default();
    let export = || wound.export(StandardLagrange).named("wound");
    let refused = export().c().expect_err("it moves against its thread");
    assert!(refused.to_string().contains("joint `thread`"), "{refused}");
    let mut bodies = wound.described_state().expect("described");
    let assembled = wound.assemble(0.0, &mut bodies);
    assembled.expect("the screw turns");
    let export = export().starting_from(&wound, &bodies);
    let interface = export.interface();
    let source = export.c().expect("exported");
    let program = program(
        &source,
        "wound_joints joints;",
        "joints",
        "wound_set_joints(&joints, &state);",
        "state",
    );
    let stepper = wound.stepper(StandardLagrange, Rk4).expect("described");
    let start = stepper.state_of(&bodies).expect("assembled");
    let h = Wound::HANDLES;
    for angles in [[0.3, -0.7, 1.0], [7.0, -9.0, 20.0], [-30.0, 31.0, -4.0]] {
        let rates = [0.5, -2.0, 3.0];
        let [a, b, c] = angles;
        let [u, v, w] = rates;
        // In the order of the header.
        let joints = [a, u, c, w, b, v];
        let found = program.run(&[given(&start), joints.to_vec()].concat());
        let mut bodies = stepper.bodies(&start);
        let set = wound.set_angle(&mut bodies, h.shoulder, a);
        set.expect("it is free");
        wound
            .set_angle(&mut bodies, h.elbow, b)
            .expect("it is free");
        wound
            .set_angle(&mut bodies, h.thread, c)
            .expect("it is free");
        let handles = [h.shoulder, h.elbow];
        for (handle, rate) in handles.into_iter().zip(rates) {
            let set = wound.set_angle_rate(&mut bodies, handle, rate);
            set.expect("it is free");
        }
        let set = wound.set_angle_rate(&mut bodies, h.thread, w);
        set.expect("it is free");
        let expected = stepper.state_of(&bodies).expect("a state");
        for (number, expected) in given(&expected).into_iter().enumerate() {
            near(
                found[number],
                expected,
                1e-13,
                &format!("{angles:?}, {number}"),
            );
        }
        counted_along(&interface, angles, &given(&expected));
    }
}

/// What counts turns is the sum of what the joints of its list have.
fn counted_along(interface: &Interface, [a, b, c]: [f64; 3], state: &[f64]) {
    let known = [
        ("shoulder_angle", a),
        ("elbow_angle", b),
        ("thread_angle", c),
    ];
    let pairs = interface.states.iter().filter(|of| of.is_angle).count();
    assert_eq!(interface.turned.len(), 3);
    for of in &interface.turned {
        let parts = of.parts.iter().map(|&(place, part)| {
            let name = &interface.states[place].quantity.name;
            let found = known.iter().find(|(known, _)| known == name);
            part * found.expect("an angle").1
        });
        let sum: f64 = of.described + parts.sum::<f64>();
        let name = &interface.states[of.state].quantity.name;
        // Behind the time, and two numbers of each angle.
        near(sum, state[2 + pairs + of.state], 1e-13, name);
    }
}

#[test]
fn kernels_in_the_rates_of_joints_are_those_of_rust() {
    let source = ur5("kernels").inverse_dynamics().mass_matrix().c();
    let source = source.expect("exported");
    let program = program(
        &source,
        "kernels_constants constants; kernels_inputs inputs; kernels_accelerations a; struct { kernels_efforts e; kernels_mass m; } all;",
        "a",
        "kernels_default_inputs(&inputs); kernels_prepare(&inputs, &constants); kernels_inverse_dynamics(&constants, &state, &a, &all.e); kernels_mass_matrix(&constants, &state, &all.m);",
        "all",
    );
    let parameters = Ur5::default().parameters::<f64>().expect("described");
    let constants = Ur5::prepare_joints(&parameters);
    for state in states() {
        let accelerations = [0.3, -1.0, 2.0, 0.5, -0.7, 3.0];
        let results = program.run(&[given(&state), accelerations.to_vec()].concat());
        let efforts = Ur5::inverse_dynamics(&constants, 0.0, &state, &accelerations);
        assert_eq!(results[..6], efforts, "efforts");
        let matrix = Ur5::mass_matrix(&constants, 0.0, &state);
        assert_eq!(results[6..], matrix, "mass matrix");
    }
}

#[test]
fn derivatives_by_joints_are_those_of_the_kernel() {
    let source = ur5("by_joints").joint_derivatives().c().expect("exported");
    let program = program(
        &source,
        "by_joints_constants constants; by_joints_inputs inputs; by_joints_joint_jacobian j;",
        "",
        "by_joints_default_inputs(&inputs); by_joints_prepare(&inputs, &constants); by_joints_joint_derivatives(&constants, &state, &j);",
        "j",
    );
    let parameters = Ur5::default().parameters::<f64>().expect("described");
    let constants = Ur5::prepare_joints(&parameters);
    for state in states() {
        let results = program.run(&given(&state));
        let columns = results.len() / 6;
        let kernel = Ur5::derivatives(&constants, 0.0, &state);
        for (k, &entry) in results.iter().enumerate() {
            assert_eq!(
                entry,
                kernel[6 * (1 + k % columns) + k / columns],
                "entry {k}"
            );
        }
    }
}

#[test]
fn readings_are_those_of_a_view() {
    let handles = FourBar::HANDLES;
    let export = Export::<FourBar, Double, Relative>::new(&FourBar::default(), StandardLagrange);
    let source = export
        .named("readings")
        .reading("height", "m", |view| view.position(handles.coupler).y)
        .reading("energy", "J", |view| {
            view.kinetic_energy() + view.potential_energy()
        })
        .c()
        .expect("exported");
    let program = program(
        &source,
        "double all[2];",
        "",
        "all[0] = readings_height(&state); all[1] = readings_energy(&state);",
        "all",
    );
    let four_bar = FourBar::default();
    let stepper = four_bar.stepper(StandardLagrange, Rk4).expect("described");
    let stepper = stepper.joint_coordinates();
    let start = stepper.initial_state().expect("described");
    let mut random = ChaCha8Rng::seed_from_u64(5);
    for _ in 0..100 {
        let state = random_state(&start, &mut random);
        let bodies = stepper.bodies(&state);
        let view = stepper.view(&bodies);
        let results = program.run(&given(&state));
        near(
            results[0],
            view.position(handles.coupler).y,
            1e-14,
            "height",
        );
        let energy = view.kinetic_energy() + view.potential_energy();
        near(results[1], energy, 1e-13, "energy");
    }
}

/// Columns of derivatives against central differences of the rates, both in C.
fn differences<X: Vector<f64> + Copy>(source: &Source, start: &X, given_before: &str) {
    let n = &source.name;
    let constants = if source.header.contains(&format!("}} {n}_constants;")) {
        format!("{n}_constants constants; {n}_inputs inputs;")
    } else {
        String::new()
    };
    let (prepare, handed) = if constants.is_empty() {
        (String::new(), "")
    } else {
        (
            format!("{n}_default_inputs(&inputs); {n}_prepare(&inputs, &constants);"),
            "&constants, ",
        )
    };
    let program = program(
        source,
        &format!("{constants} struct {{ {n}_slope k; {n}_jacobian j; }} all;"),
        "",
        &format!(
            "{prepare} {n}_rates({handed}&state, &all.k); {n}_derivatives({given_before}&state, &all.j);"
        ),
        "all",
    );
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for _ in 0..20 {
        let state = random_state(start, &mut random);
        let independent: Vec<usize> = (0..start.length())
            .filter(|&k| start.is_independent(k))
            .collect();
        let rows = independent.len();
        let results = program.run(&given(&state));
        let columns = (results.len() - rows) / rows;
        for (column, &element) in independent.iter().enumerate() {
            let beside = |h: f64| {
                let mut moved = state;
                if element + 1 < state.length() && !state.is_independent(element + 1) {
                    let (c, s) = (state.element(element), state.element(element + 1));
                    moved.set_element(element, c * h.cos() - s * h.sin());
                    moved.set_element(element + 1, s * h.cos() + c * h.sin());
                } else {
                    moved.set_element(element, state.element(element) + h);
                }
                program.run(&given(&moved))
            };
            let (h, ahead, behind) = (1e-5, beside(1e-5), beside(-1e-5));
            let largest = ahead[..rows]
                .iter()
                .fold(1.0_f64, |most, x| most.max(x.abs()));
            for row in 0..rows {
                let difference = (ahead[row] - behind[row]) / (2.0 * h);
                let derivative = results[rows + row * columns + column];
                let error = (difference - derivative).abs();
                let scale = largest.max(derivative.abs());
                assert!(
                    error < 1e-6 * scale,
                    "{n}, row {row}, column {column}: {derivative} for {difference}"
                );
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    let export = ur5("derived").derivatives();
    let operations = export.operations("derivatives").expect("it is there");
    // As many as the prototype took for the accelerations alone, and few for what is linear.
    assert!(operations < 2200, "{operations} operations");
    let source = export.c().expect("exported");
    let [start, ..] = states()[..] else {
        panic!("no states")
    };
    differences(&source, &start, "&inputs, ");
    let export = Export::<FourBar, Double, Relative>::new(&FourBar::default(), StandardLagrange);
    let source = export
        .named("derived_bars")
        .derivatives()
        .c()
        .expect("exported");
    let stepper = FourBar::default()
        .stepper(StandardLagrange, Rk4)
        .expect("described");
    let start = stepper
        .joint_coordinates()
        .initial_state()
        .expect("described");
    differences(&source, &start, "");
    let export = Export::<FourBar, Double, Absolute>::new(&FourBar::default(), StandardLagrange);
    let source = export
        .named("derived_bodies")
        .derivatives()
        .c()
        .expect("exported");
    let stepper = FourBar::default()
        .stepper(StandardLagrange, Rk4)
        .expect("described");
    let stepper = stepper.absolute_coordinates();
    differences(&source, &stepper.initial_state().expect("described"), "");
}

#[test]
fn what_users_write_stays_within_comments() {
    let export = FourBar::default()
        .export(StandardLagrange)
        .named("commented");
    let about = "a ratio a*/b, and /* more\nof it \\";
    let source = export.reading("ratio", about, |view| view.time()).c();
    let source = source.expect("exported");
    assert!(
        source
            .header
            .contains("/* a ratio a* /b, and / * more of it   */")
    );
    let _ = Program::compiled(&source, "int main(void) { return 0; }\n");
}

#[test]
fn a_start_in_single_precision_is_that_of_rust() {
    let export = Export::<FourBar, Single, Relative>::new(&FourBar::default(), StandardLagrange);
    let source = export.named("begun").c().expect("exported");
    let program = program(&source, "", "", "begun_init(&state);", "state");
    let stepper = Stepper::<Problem<_, _, f32>, _>::new(&FourBar::default(), StandardLagrange, Rk4);
    let stepper = stepper.expect("described").joint_coordinates();
    let start = stepper.initial_state().expect("described");
    let mut numbers = vec![0.0_f32; 2];
    start.for_each(|number| numbers.push(number));
    assert_eq!(program.run(&numbers), numbers);
}

/// The mechanism of the README.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Arm {
    #[param]
    mass: f64,
    #[input]
    torque: f64,
    #[body(mass = mass, inertia = [0.083, 0.001, 0.083], position = [0.0, 0.5, 0.0])]
    link: Body,
    #[joint(between = [ground, link], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, link], axis = [1.0, 0.0, 0.0], moment = torque)]
    motor: TorsionalActuator,
}

#[test]
fn the_program_of_the_readme_prints_what_a_stepper_reads() {
    let readme = include_str!("../../README.md");
    let main = readme
        .split("```c\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next());
    let arm = Arm::new(2.0).expect("a mass");
    let export = arm.export(StandardLagrange).step(Rk4);
    let height = |view: &View<'_, _, _>| view.position(Arm::HANDLES.link).z;
    let source = export
        .reading("height", "m", height)
        .derivatives()
        .c()
        .expect("exported");
    let program = Program::compiled(&source, main.expect("a program in C"));
    let mut stepper = arm.stepper(StandardLagrange, Rk4).expect("described");
    let mut state = arm.described_state().expect("described");
    arm.set_angle(&mut state, Arm::HANDLES.hinge, 0.5)
        .expect("it turns");
    let mut state = stepper.state_of(&state).expect("near");
    for k in 0..1000 {
        let torque = 0.1 * f64::from(k);
        stepper
            .step_with(&mut state, &InputsOf::<Arm> { torque }, 1e-3)
            .expect("a step");
    }
    let angle: f64 = Arm::JOINT_REPORT.coordinate(0, &state).expect("a turn");
    let printed = program.printed();
    let read: f64 = printed
        .strip_prefix("1 s: ")
        .and_then(|rest| rest.trim().strip_suffix(" rad"))
        .and_then(|number| number.parse().ok())
        .unwrap_or_else(|| panic!("{printed}"));
    near(read, angle, 1e-13, "angle");
}
