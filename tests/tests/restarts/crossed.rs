//! States of the user's own, tables and inputs with derivatives in runs that go on.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::Trajectory;
use holonom::{Bdf, DormandPrince853, Runs};
use holonom_fixtures::Ball;

use super::goes_on;

/// A fan on a motor whose current is a state, against a moment from a table. It counts turns.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Fan {
    #[param]
    drag: Spline<4>,
    #[input(order = 2)]
    voltage: Setpoint,
    #[state(rate = (voltage - 2.0 * current - 0.5 * shaft.rate) / 0.02, start = 0.1)]
    current: f64,
    #[body(mass = 1.0, inertia = [1e-3, 1e-3, 1e-3])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[force(
        between = [ground, rotor], axis = [0.0, 0.0, 1.0],
        moment = 0.5 * current - drag(rate) - 0.01 * sin(angle)
    )]
    motor: TorsionalActuator,
}

fn fan() -> Fan {
    let drag = Spline::natural([0.0, 3.0, 9.0, 20.0], [0.0, 0.1, 0.4, 2.0]);
    let mut fan = Fan::new(drag).expect("a sound table");
    fan.voltage = Setpoint::at_rest(6.0);
    fan
}

fn of<C: Coordinates<Fan>>(method: impl Runs<Problem<Fan, StandardLagrange, f64, C>> + Copy) {
    let fan: &'static Fan = Box::leak(Box::new(fan()));
    let build = || Simulation::new(fan, StandardLagrange, method).coordinates::<C>();
    goes_on("a fan", &build, every(0.013));
}

#[test]
fn states_go_on_to_the_last_bit() {
    of::<Relative>(Rk4::every(0.011));
    of::<Absolute>(Rk4::every(0.011));
    of::<Relative>(DormandPrince::default());
    of::<Absolute>(DormandPrince853::default());
    of::<Relative>(Bdf::default());
}

/// A current far from that of the run moves the motion, and the checkpoint has it.
#[test]
fn trajectories_have_states() {
    let (fan, h) = (fan(), Fan::HANDLES);
    let (mut motion, mut shown) = (Trajectory::new(), Vec::new());
    let tolerance = Tolerance {
        relative: 1e-10,
        absolute: 1e-12,
    };
    Simulation::new(&fan, StandardLagrange, DormandPrince::new(tolerance))
        .trajectory(&mut motion)
        .run(0.0..=0.5, every(0.0137), |sample| {
            shown.push((sample.time(), sample.state_value(h.current)));
        })
        .expect("it runs");
    let range = shown.iter().map(|(_, current)| *current);
    assert!(range.fold(0.0, f64::max) > 1.0, "it is a motion");
    for (time, current) in shown {
        let state = motion.at(time).expect("within");
        let view = fan.view(time, &state).expect("a sound table");
        let found = view.state_value(h.current);
        assert!((found - current).abs() < 1e-9, "{time}: {found} {current}");
    }
}

#[test]
fn trajectories_have_both_sides_of_an_impact() {
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let mut motion = Trajectory::new();
    Simulation::new(&ball, StandardLagrange, DormandPrince::default())
        .interactions([Interaction::limits(h.rail.displacement(), [-1.0, 9.0]).restitution(0.5)])
        .trajectory(&mut motion)
        .run(0.0..=1.0, every(0.3), |_| ())
        .expect("it runs");
    let touch = (2.0_f64 / 9.81).sqrt();
    let fast = 9.81 * touch;
    for time in [0.1, 0.3, touch - 1e-6, touch + 1e-6, 0.6, 0.8] {
        let since = time - touch;
        let (height, rate) = if since < 0.0 {
            (1.0 - 0.5 * 9.81 * time * time, -9.81 * time)
        } else {
            let rate = 0.5 * fast - 9.81 * since;
            (0.5 * fast * since - 0.5 * 9.81 * since * since, rate)
        };
        let state = motion.at(time).expect("within");
        let found = Ball::pose(&state, h.ball).position.z;
        assert!((found - height).abs() < 1e-9, "{time}: {found} {height}");
        let found = Ball::velocity(&state, h.ball).z;
        assert!((found - rate).abs() < 1e-9, "{time}: {found} {rate}");
    }
}
