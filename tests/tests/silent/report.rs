//! What the report says of the elements of a joint state is what access by handle reads, in any
//! state.

use holonom::forces::{TorsionalActuator, TorsionalSpringDamper};
use holonom::joints::{Cylindrical, Prismatic, Revolute, Screw, Spherical, Universal};
use holonom::prelude::*;
use holonom::{
    JointCoordinates, JointHandle,
    mechanism::{Freedom, HasAngle, HasDisplacement, JointParts},
    state::MovingState,
};
use holonom::{View, mechanism::JointReport};

#[test]
fn comments_are_those_above_the_struct_and_its_fields() {
    let texts: Vec<_> = Pushed::COMMENTS
        .iter()
        .map(|of| (of.field, of.text))
        .collect();
    assert_eq!(
        texts,
        [("", "A cart.\n\nIt is pushed."), ("push", "The force (N).")]
    );
}

/// A cart.
///
/// It is pushed.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Pushed {
    /// The force (N).
    #[input]
    push: f64,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    cart: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [push, 0.0, 0.0])]
    motor: PointForce,
}

/// Four links about parallel axes: angles and rates are sums along the run.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Run {
    #[body(mass = 1.0, inertia = [0.03, 0.03, 0.03], position = [0.0, 0.3 + 0.6 * k, 0.4 + 0.8 * k])]
    links: [Body; 4],
    #[joint(
        between = [if k == 0 { ground } else { links[k - 1] }, links[k]],
        point = [0.0, 0.6 * k, 0.8 * k], axis = [1.0, 0.0, 0.0]
    )]
    pins: [Revolute; 4],
}

/// Joints that are described from the body that they carry, axes that point the other way, and a
/// run on a slide.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Askew {
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [0.1, 0.2, 0.3])]
    cart: Body,
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [0.4, 0.6, 0.3])]
    upper: Body,
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [0.7, 0.5, 0.4])]
    fore: Body,
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [0.9, 0.6, 0.2])]
    hand: Body,
    #[joint(between = [cart, ground], point = [0.1, 0.2, 0.3], axis = [0.6, 0.8, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, upper], point = [0.2, 0.3, 0.3], axis = [0.0, 0.0, 1.0])]
    shoulder: Revolute,
    #[joint(between = [fore, upper], point = [0.5, 0.5, 0.3], axis = [0.0, 0.0, 1.0])]
    elbow: Revolute,
    #[joint(between = [fore, hand], point = [0.8, 0.5, 0.4], axis = [0.0, 0.0, -1.0])]
    wrist: Cylindrical,
}

/// A cart with a pole, whose pin has viscous friction: no auxiliary variable. The spring of the
/// wheel counts turns, the actuator that reads its angle too.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct CartPole {
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.01])]
    cart: Body,
    #[body(mass = 0.2, inertia = [0.006, 0.006, 0.0001], position = [0.0, 0.0, 0.3])]
    pole: Body,
    #[body(mass = 0.2, inertia = [0.006, 0.006, 0.01], position = [0.0, 0.0, 0.7])]
    wheel: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, pole], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pin: Revolute,
    #[joint(between = [pole, wheel], point = [0.0, 0.0, 0.7], axis = [1.0, 0.0, 0.0])]
    bearing: Revolute,
    #[force(between = [cart, pole], axis = [1.0, 0.0, 0.0], moment = -0.002 * rate)]
    friction: TorsionalActuator,
    #[force(between = [pole, wheel], axis = [1.0, 0.0, 0.0], stiffness = 0.1, damping = 0.01)]
    spring: TorsionalSpringDamper,
    #[force(between = [cart, pole], axis = [1.0, 0.0, 0.0], moment = -0.01 * angle - 0.1 * rate)]
    motor: TorsionalActuator,
}

/// A ball, a universal joint and a body that moves freely.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Balls {
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [0.0, 0.0, 0.3])]
    arm: Body,
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [0.0, 0.0, 0.9])]
    hand: Body,
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [1.0, 0.0, 0.0], free)]
    stone: Body,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0])]
    shoulder: Spherical,
    #[joint(between = [arm, hand], point = [0.0, 0.0, 0.6], axis_i = [1.0, 0.0, 0.0], axis_j = [0.0, 1.0, 0.0])]
    wrist: Universal,
}

/// Screws that are described from the body that they carry and from the other one, along axes that
/// point either way.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Screws {
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [0.1, 0.2, 0.3])]
    nut: Body,
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [0.4, 0.6, 0.3])]
    drill: Body,
    #[body(mass = 1.0, inertia = [0.03, 0.04, 0.05], position = [0.4, 0.7, 0.5])]
    bit: Body,
    #[joint(between = [nut, ground], point = [0.0, 0.1, 0.0], axis = [0.0, 0.0, -1.0], pitch = 0.4)]
    thread: Screw,
    #[joint(between = [nut, drill], point = [0.3, 0.3, 0.3], axis = [0.0, 0.0, -1.0], pitch = -0.7)]
    other: Screw,
    #[joint(between = [bit, drill], point = [0.4, 0.5, 0.3], axis = [0.0, 0.6, 0.8], pitch = 0.5)]
    last: Screw,
}

/// Random numbers between -1 and 1 (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A state of the joints by random numbers, with angles all around.
fn any<M: JointCoordinates>(state: &M::JointState<f64>, random: &mut Random) -> M::JointState<f64> {
    let report: JointReport = M::JOINT_REPORT;
    let mut moved = *state;
    for element in moved.rest_slice_mut() {
        *element = random.next();
    }
    for element in moved.rates_slice_mut() {
        *element = random.next();
    }
    let mut angles = M::JointState::<f64>::zeros();
    for k in 0..report.motions.len() {
        let motion = report.motions[k];
        let mut angle = 3.0 * random.next();
        match motion.freedom {
            Freedom::Turn { .. } => {}
            // The joint counts the same angle, which may be beyond half a turn.
            Freedom::Screw { counter, .. } => {
                angle *= 4.0;
                let sign = if motion.is_reversed() { -1.0 } else { 1.0 };
                moved.rest_slice_mut()[counter] = sign * angle;
            }
            _ => continue,
        }
        // A slope has the rate of an angle in the place of the cosine.
        holonom::state::Vector::set_element(&mut angles, 2 * motion.coordinate, angle);
    }
    holonom::state::Vector::plus(&moved, [(1.0, &angles)])
}

/// How a joint is read by handle.
type Read<'a, M> = &'a dyn Fn(&View<'_, f64, M>) -> [f64; 2];

/// Compares what the report reads of each joint's only motion of a kind with what access by handle
/// does.
fn agrees<M: JointCoordinates>(mechanism: &M, joints: &[(&'static str, bool, Read<'_, M>)]) {
    let stepper = Stepper::<Problem<_, _>, _>::new(mechanism, StandardLagrange, Rk4);
    let stepper = stepper.expect("parameters").joint_coordinates();
    let described = mechanism.described_state().expect("parameters");
    let start = stepper.state_of(&described).expect("it is consistent");
    let mut random = Random(7);
    for _ in 0..50 {
        let state = any::<M>(&start, &mut random);
        let bodies = stepper.bodies(&state);
        let view = stepper.view(&bodies);
        for (joint, is_slide, read) in joints {
            let [coordinate, rate] = read(&view);
            let is_it = |&place: &usize| {
                let freedom = M::JOINT_REPORT.motions[place].freedom;
                (freedom == Freedom::Slide) == *is_slide
            };
            let place = M::JOINT_REPORT.motions_of(joint).find(is_it);
            let place = place.unwrap_or_else(|| panic!("{joint} moves"));
            let said = M::JOINT_REPORT
                .coordinate(place, &state)
                .expect("it has one");
            let is_turn = matches!(M::JOINT_REPORT.motions[place].freedom, Freedom::Turn { .. });
            let off = if is_turn {
                (said - coordinate).sin()
            } else {
                said - coordinate
            };
            assert!(off.abs() < 1e-12, "{joint}: {said} {coordinate}");
            let said = M::JOINT_REPORT.rate(place, &state).expect("it has one");
            assert!((said - rate).abs() < 1e-12, "{joint}: {said} {rate}");
        }
    }
}

fn angle<M: Mechanism, J: HasAngle>(
    joint: JointHandle<M, J>,
) -> impl Fn(&View<'_, f64, M>) -> [f64; 2] {
    move |view| [view.angle(joint), view.angle_rate(joint)]
}

fn slide<M: Mechanism, J: HasDisplacement>(
    joint: JointHandle<M, J>,
) -> impl Fn(&View<'_, f64, M>) -> [f64; 2] {
    move |view| [view.displacement(joint), view.displacement_rate(joint)]
}

#[test]
fn coordinates_and_rates_of_joints_are_read_from_the_report() {
    let pins = Run::HANDLES.pins.map(angle);
    let names = ["pins[0]", "pins[1]", "pins[2]", "pins[3]"];
    let joints: Vec<(&str, bool, Read<'_, Run>)> = names
        .iter()
        .zip(&pins)
        .map(|(name, pin)| (*name, false, pin as Read<'_, Run>))
        .collect();
    agrees(&Run::default(), &joints);
    // They are sums along the run, and the report says so.
    assert_eq!(
        Run::JOINT_REPORT.motions.map_against(),
        [None, Some(0), Some(1), Some(2)]
    );
    let h = Askew::HANDLES;
    agrees(
        &Askew::default(),
        &[
            ("rail", true, &slide(h.rail)),
            ("shoulder", false, &angle(h.shoulder)),
            ("elbow", false, &angle(h.elbow)),
            ("wrist", false, &angle(h.wrist)),
            ("wrist", true, &slide(h.wrist)),
        ],
    );
    let h = CartPole::HANDLES;
    agrees(
        &CartPole::default(),
        &[
            ("rail", true, &slide(h.rail)),
            ("pin", false, &angle(h.pin)),
            ("bearing", false, &angle(h.bearing)),
        ],
    );
    let h = Screws::HANDLES;
    agrees(
        &Screws::default(),
        &[
            ("thread", false, &angle(h.thread)),
            ("other", false, &angle(h.other)),
            ("last", false, &angle(h.last)),
        ],
    );
}

trait Against {
    fn map_against(&self) -> Vec<Option<usize>>;
}

impl Against for [holonom::mechanism::JointMotion] {
    fn map_against(&self) -> Vec<Option<usize>> {
        self.iter().map(|motion| motion.against).collect()
    }
}

/// What the elements of a state are is said of each of them, once.
#[test]
fn every_element_is_described() {
    fn covered<M: JointCoordinates>() {
        let report: JointReport = M::JOINT_REPORT;
        let state = M::JointState::<f64>::zeros();
        let mut pairs = vec![0; state.pairs_slice().len()];
        let mut rest = vec![0; state.rest_slice().len()];
        let mut rates = vec![0; state.rates_slice().len()];
        for motion in report.motions {
            let (coordinates, velocities) = match motion.freedom {
                Freedom::Turn { .. } | Freedom::Screw { .. } => {
                    (&mut pairs[motion.coordinate..][..1], 1)
                }
                Freedom::Slide => (&mut rest[motion.coordinate..][..1], 1),
                Freedom::Ball => (&mut rest[motion.coordinate..][..4], 3),
                other => panic!("{other:?} is of no known size"),
            };
            coordinates.iter_mut().for_each(|x| *x += 1);
            rates[motion.velocity..]
                .iter_mut()
                .take(velocities)
                .for_each(|x| *x += 1);
        }
        for counter in report.counters {
            rest[counter.coordinate] += 1;
        }
        for all in [pairs, rest, rates] {
            assert!(all.iter().all(|&times| times == 1), "{report}");
        }
        assert_eq!(report.counters.len(), report.auxiliaries);
    }
    covered::<Run>();
    covered::<Askew>();
    covered::<CartPole>();
    covered::<Balls>();
    covered::<Screws>();
}

/// An angle that nobody reads is not counted, and its damper does what it did.
#[test]
fn friction_counts_no_angle() {
    let counted: Vec<&str> = CartPole::JOINT_REPORT
        .counters
        .iter()
        .map(|c| c.element)
        .collect();
    assert_eq!(counted, ["spring", "motor"]);
    let (model, h) = (CartPole::default(), CartPole::HANDLES);
    let mut state = model.described_state().expect("parameters");
    model
        .set_angle_rate(&mut state, h.pin, 3.0)
        .expect("it carries the pole");
    let constants = model.constants().expect("parameters");
    let view = View::<f64, CartPole>::new(&constants, 0.0, &state);
    let load = view.load(h.friction, h.pole).expect("it is between");
    assert!((load.moment.x + 0.006).abs() < 1e-15, "{load:?}");
}

#[test]
fn the_report_says_it_in_words() {
    let said = CartPole::JOINT_REPORT.to_string();
    for line in [
        "rest()[0]: the displacement of `rail` (m)",
        "rates()[1]: its rate (rad/s)",
        "an auxiliary variable, the angle that `spring` counts turns of (rad)",
    ] {
        assert!(said.contains(line), "{line}\n{said}");
    }
    let said = Run::JOINT_REPORT.to_string();
    assert!(
        said.contains("rad in the reference configuration"),
        "{said}"
    );
    let said = Balls::JOINT_REPORT.to_string();
    assert!(
        said.contains("Euler parameters of `arm`, of `shoulder`"),
        "{said}"
    );
    assert!(
        said.contains("the displacement of `stone`, which moves freely (m)"),
        "{said}"
    );
}
