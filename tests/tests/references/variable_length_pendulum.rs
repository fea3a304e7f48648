//! D02: the variable-length pendulum of Nikravesh's examples 13.6 and 13.7, and what the
//! formulations make of a start that is rounded.

use core::f64::consts::FRAC_PI_3;

use holonom::forces::{SpringDamper, TorsionalSpringDamper};
use holonom::joints::{Prismatic, Revolute};
use holonom::prelude::*;
use holonom_models::VariableLengthPendulum;

use super::{angle_about_z, at_times, difference, simpson, tight};

/// `phi` (rad), distance of the slider from the pin (m), and their rates at 1, 2 and 5 s: by two
/// integrations of the planar model in these two coordinates, which agree to 4e-14.
const TIMES: [f64; 3] = [1.0, 2.0, 5.0];
const MOTION: [[f64; 4]; 3] = [
    [
        -0.620_930_373_712_414,
        1.386_132_682_098_74,
        0.661_859_136_169_384,
        -1.097_593_709_622_24,
    ],
    [
        0.473_624_078_239_525,
        1.235_812_833_845_29,
        -1.452_985_659_145_66,
        -0.455_259_281_952_63,
    ],
    [
        0.176_570_726_587_059,
        1.260_603_355_127_01,
        1.654_218_131_907_42,
        0.406_238_457_930_619,
    ],
];

/// `phi`, `r` and their rates as [`MOTION`].
fn coordinates(sample: &Sample<'_, f64, VariableLengthPendulum>) -> [f64; 4] {
    let h = VariableLengthPendulum::HANDLES;
    let r = sample.pose(h.slider).position;
    [
        angle_about_z(sample, h.arm),
        r.norm(),
        sample.angle_rate(h.pin),
        r.dot(&sample.velocity(h.slider)) / r.norm(),
    ]
}

fn swings<F: Formulation<f64>>(method: F) {
    /// rad, m, rad/s, m/s.
    const ASKED: f64 = 1e-9;
    let pin = VariableLengthPendulum::HANDLES.pin;
    at_times(
        &VariableLengthPendulum::default(),
        method,
        1.0,
        &TIMES,
        |place, sample| {
            let reached = coordinates(sample);
            let errors = reached
                .iter()
                .zip(MOTION[place])
                .map(|(a, b)| (a - b).abs());
            let error = errors.fold(0.0, f64::max);
            println!("{error:e} at {} s", sample.time());
            assert!(error <= ASKED);
            // The angle of the hinge is zero at the start.
            let angle = difference(sample.angle(pin) + FRAC_PI_3, reached[0]);
            assert!(angle.abs() <= ASKED);
        },
    );
}

#[test]
fn it_swings_as_its_reference() {
    swings(StandardLagrange);
    swings(Baumgarte::default());
    swings(AugmentedLagrangian::default());
}

#[test]
fn the_work_of_the_damper_is_what_the_energy_loses() {
    const DAMPING: f64 = 5.0;
    const STEP: f64 = 5e-3;
    /// J, of 10 J that are lost in 5 s.
    const ASKED: f64 = 1e-8;
    let (mut power, mut energy) = (Vec::new(), Vec::new());
    Simulation::new(
        &VariableLengthPendulum::default(),
        StandardLagrange,
        tight(),
    )
    .run(0.0..=5.0, every(STEP), |sample| {
        let [_, _, _, rate] = coordinates(sample);
        power.push(DAMPING * rate * rate);
        energy.push(sample.energy());
        ControlFlow::Continue(())
    })
    .expect("solvable");
    let lost = energy[0] - energy[energy.len() - 1];
    let work = simpson(STEP, &power);
    println!(
        "lost {lost} J, work {work} J, difference {:e} J",
        lost - work
    );
    assert!((lost - work).abs() <= ASKED);
    assert!(lost > 1.0, "nothing is lost");
}

/// The same in body axes, as the examples define it, with the positions of four digits that they
/// print: the joints are violated by 1e-5 at the start.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0])]
struct Rounded {
    #[body(
        mass = 2.0,
        inertia = [0.04, 0.04, 0.04],
        position = [0.4330, -0.2500, 0.0],
        orientation = rotation([0.0, 0.0, 1.0], deg(60.0))
    )]
    arm: Body,
    #[body(
        mass = 1.0,
        inertia = [0.1, 0.1, 0.1],
        position = [0.6928, -0.4000, 0.0],
        orientation = rotation([0.0, 0.0, 1.0], deg(60.0))
    )]
    slider: Body,
    #[joint(
        between = [ground, arm],
        point = local([0.0, 0.0, 0.0], [0.0, 0.5, 0.0]),
        axis = local([0.0, 0.0, 1.0], [0.0, 0.0, 1.0])
    )]
    pin: Revolute,
    #[joint(
        between = [arm, slider],
        point = local([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        axis = local([0.0, 1.0, 0.0], [0.0, 1.0, 0.0])
    )]
    guide: Prismatic,
    #[force(between = [ground, arm], axis = [0.0, 0.0, 1.0], stiffness = 6.0, free_angle = deg(-60.0))]
    torsion: TorsionalSpringDamper,
    #[force(
        between = [ground, slider],
        head = local([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        tail = local([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        stiffness = 20.0,
        damping = 5.0,
        free_length = 0.7
    )]
    spring: SpringDamper,
}

/// The norm of `Phi` at the start and at 2 s, and the error of the slider's distance (m) at 2 s.
fn rounded<F: Formulation<f64>>(method: F) -> [f64; 3] {
    let slider = Rounded::HANDLES.slider;
    let (mut violations, mut error) = (Vec::new(), 0.0);
    Simulation::new(&Rounded::default(), method, tight())
        .run(0.0..=2.0, every(2.0), |sample| {
            violations.push(sample.violation().sqrt());
            error = (sample.pose(slider).position.norm() - MOTION[1][1]).abs();
            ControlFlow::Continue(())
        })
        .expect("solvable");
    println!("{method:?}: Phi {violations:?}, r {error:e} m");
    [violations[0], violations[1], error]
}

#[test]
fn formulations_treat_a_rounded_start_each_in_its_own_way() {
    use core::f64::consts::PI;
    // Lagrange multipliers keep Phi'' = 0: the violation of a start at rest stays as it is.
    let [first, last, _] = rounded(StandardLagrange);
    assert!((1e-5..2e-5).contains(&first), "published: 1e-5; {first:e}");
    assert!((last / first - 1.0).abs() <= 1e-6);
    // Baumgarte with the coefficients of the examples: (1 + 5 t) exp(-5 t) of it is left.
    let [first, last, _] = rounded(Baumgarte::new(5.0, 5.0));
    let left = 11.0 * f64::exp(-10.0);
    assert!((last / first / left - 1.0).abs() <= 1e-5);
    // The penalty with theirs has a floor that the mass of 1000 kg sets, and a motion that is off
    // by as much. In the planar coordinates of the examples the floor is 8e-6 and the error 1.2e-5
    // m; the equations of the joints are scaled otherwise here.
    let [_, last, error] = rounded(Penalty::new(1000.0, 20.0 * PI, 1.0));
    assert!((1e-6..1e-4).contains(&last) && (1e-6..1e-4).contains(&error));
}
