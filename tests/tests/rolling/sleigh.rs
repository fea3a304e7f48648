//! Chaplygin's sleigh against its minimal equations (Bloch 2003, section 1.7).

use holonom::independent::NonholonomicExt;
use holonom::prelude::*;

/// A sleigh on an edge that stands behind its centre of mass.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", kernels = [mass, inverse])]
pub(crate) struct Sleigh {
    /// How far behind (m).
    #[param]
    behind: f64,
    /// A force along the sleigh (N).
    #[input]
    push: f64,
    #[body(
        mass = 2.0, inertia = [0.1, 0.2, 0.3], velocity = [0.7, 0.3, 0.0], angular_velocity = [0.0, 0.0, 1.3]
    )]
    sleigh: Body,
    #[joint(between = [ground, sleigh], point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0])]
    plane: Planar,
    #[joint(between = [ground, sleigh], point = [-behind, 0.0, 0.0], side = [0.0, 1.0, 0.0])]
    edge: KnifeEdge,
    #[force(between = [sleigh], point = [0.0, 0.0, 0.0], force = [push, 0.0, 0.0])]
    motor: FollowerForce,
}

/// Mass, moment of inertia and the distance of the edge.
const SLEIGH: [f64; 3] = [2.0, 0.3, 0.3];

pub(crate) fn sleigh(push: f64) -> Sleigh {
    let [_, _, behind] = SLEIGH;
    Sleigh {
        push,
        ..Sleigh::new(behind).expect("a sleigh")
    }
}

/// Rates of speed along the sleigh, rate of turn, angle and place of the centre of mass:
/// `u' = a w^2 + F / m`, `(J + m a^2) w' = -m a u w`.
fn rates(push: f64, [u, w, angle, ..]: [f64; 5]) -> [f64; 5] {
    let [m, j, a] = SLEIGH;
    let (sine, cosine) = angle.sin_cos();
    [
        a * w * w + push / m,
        -m * a * u * w / (j + m * a * a),
        w,
        u * cosine - a * w * sine,
        u * sine + a * w * cosine,
    ]
}

/// The same after a time, by Runge-Kutta steps of 0.1 ms.
fn after(time: f64, push: f64, mut y: [f64; 5]) -> [f64; 5] {
    let h = 1e-4;
    for _ in 0..(time / h).round() as usize {
        let at = |y: [f64; 5], k: [f64; 5], h: f64| core::array::from_fn(|i| y[i] + h * k[i]);
        let first = rates(push, y);
        let second = rates(push, at(y, first, 0.5 * h));
        let third = rates(push, at(y, second, 0.5 * h));
        let last = rates(push, at(y, third, h));
        for i in 0..5 {
            y[i] += h / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + last[i]);
        }
    }
    y
}

/// The speeds of the described state once the edge holds: the impulse along the edge's side.
fn start() -> [f64; 5] {
    let [m, j, a] = SLEIGH;
    let (across, turn) = (0.3, 1.3);
    let impulse = (across - a * turn) / (1.0 / m + a * a / j);
    [0.7, turn + impulse * a / j, 0.0, 0.0, 0.0]
}

#[test]
fn it_moves_as_its_minimal_equations_say() {
    let h = Sleigh::HANDLES;
    for push in [0.0, 0.4] {
        let expected = [1.0, 2.0].map(|time| after(time, push, start()));
        let sleigh = sleigh(push);
        let observe = |sample: &Sample<'_, f64, Sleigh>| {
            let place = sample.time().round() as usize;
            let Some(&[_, w, angle, x, y]) = place.checked_sub(1).and_then(|k| expected.get(k))
            else {
                return;
            };
            let pose = sample.pose(h.sleigh);
            let turn = 2.0 * pose.orientation.k.atan2(pose.orientation.w);
            for (found, expected) in [
                (sample.angular_velocity(h.sleigh).z, w),
                (turn, angle),
                (pose.position.x, x),
                (pose.position.y, y),
            ] {
                assert!((found - expected).abs() < 1e-10, "{found} for {expected}");
            }
        };
        let simulation =
            || Simulation::new(&sleigh, StandardLagrange, Rk4::every(1e-3)).assembled();
        simulation()
            .absolute_coordinates()
            .run(0.0..=2.0, every(1.0), observe)
            .expect("a run");
        simulation()
            .joint_coordinates()
            .run(0.0..=2.0, every(1.0), observe)
            .expect("a run");
    }
}

/// Straight on, the linear model has `u' = F / m` and `w' = -m a u w / (J + m a^2)`; the sleigh
/// drifts with its angle.
#[test]
fn it_is_linear_about_a_motion() {
    let h = Sleigh::HANDLES;
    let [m, j, a] = SLEIGH;
    let sleigh = sleigh(0.0);
    let motions = [0, 1, 2].map(|number| Motion::of(h.plane, number));
    let [first, second, turn] = motions;
    let mut bodies: StateOf<Sleigh> = sleigh.described_state().expect("as described");
    Sleigh::set_angular_velocity_global(&mut bodies, h.sleigh, [0.0; 3].into());
    Sleigh::set_velocity(&mut bodies, h.sleigh, [0.7, 0.0, 0.0].into());
    // The axes of the plane are fixed but arbitrary: one of them is more nearly along x.
    let mut least = f64::INFINITY;
    for along in [first, second] {
        let Ok(space) = sleigh.nonholonomic(motions, [along, turn]) else {
            continue;
        };
        let state = space.of_bodies(&bodies);
        let Ok(linear) = space.linearise(&state, [h.push], |_| []) else {
            continue;
        };
        let speed = space.speeds(&state)[0];
        let decay = -m * a * 0.7 / (j + m * a * a);
        let off = (linear.by_speeds[(1, 1)] - decay).abs()
            + (linear.by_values[(0, 0)] - speed / 0.7 / m).abs()
            + linear.by_speeds[(0, 0)].abs();
        least = least.min(off);
        let mass = space.mass(&state).expect("a mass matrix");
        assert!((mass[(1, 1)] - (j + m * a * a)).abs() < 1e-12);
    }
    assert!(least < 1e-12, "{least}");
}

/// Pushed and turning, with the speeds along x and about the vertical. At the angle 0 the first has
/// the rate `a w^2 + F / m - w u_y`. The velocity aside is `a w / cos(angle) + u_x tan(angle)`: it
/// changes with the angle, the turn, and the place of the edge.
#[test]
fn inputs_push_and_readings_are_linear_too() {
    let h = Sleigh::HANDLES;
    let [m, j, a] = SLEIGH;
    let sleigh = sleigh(0.0);
    let motions = [0, 1, 2].map(|number| Motion::of(h.plane, number));
    let [first, second, turn] = motions;
    let (u, w) = (0.7, 1.3);
    let mut bodies: StateOf<Sleigh> = sleigh.described_state().expect("as described");
    Sleigh::set_angular_velocity_global(&mut bodies, h.sleigh, [0.0, 0.0, w].into());
    Sleigh::set_velocity(&mut bodies, h.sleigh, [u, a * w, 0.0].into());
    let mut spaces = [first, second].into_iter().filter_map(|along| {
        let space = sleigh.nonholonomic(motions, [along, turn]).ok()?;
        let speed = space.speeds(&space.of_bodies(&bodies))[0];
        ((speed.abs() - u).abs() < 1e-12).then_some((space, speed / u))
    });
    let (mut space, sign) = spaces.next().expect("an axis of the plane along x");
    let state = space.of_bodies(&bodies);
    for push in [0.0, 0.4] {
        let inputs = InputsOf::<Sleigh> { push };
        space.set_inputs(&inputs).expect("a finite input");
        let found = space.forward(&state, [0.0, 0.0]).expect("accelerations");
        // That of `x` is that along the sleigh less what turns.
        let along = a * w * w + push / m - w * a * w;
        let turning = -m * a * u * w / (j + m * a * a);
        assert!((sign * found[0] - along).abs() < 1e-12, "{push} {found}");
        assert!((found[1] - turning).abs() < 1e-12, "{push} {found}");
    }
    let linear = space
        .linearise(&state, [h.behind, h.push], |view| {
            [view.velocity(h.sleigh).y, view.angular_velocity(h.sleigh).z]
        })
        .expect("a linear model");
    let c = linear.c::<5>();
    for (column, expected) in [0.0, 0.0, u, 0.0, a].into_iter().enumerate() {
        assert!((c[(0, column)] - expected).abs() < 1e-12, "{c}");
    }
    assert!(
        (c[(1, 4)] - 1.0).abs() < 1e-12 && c[(1, 2)].abs() < 1e-12,
        "{c}"
    );
    let d = linear.d();
    assert!(
        (d[(0, 0)] - w).abs() < 1e-12 && d[(0, 1)].abs() < 1e-12,
        "{d}"
    );
}

#[test]
fn positions_follow_from_no_chosen_ones() {
    let h = Sleigh::HANDLES;
    let motions = [0, 1].map(|number| Motion::of(h.plane, number));
    let fault = sleigh(0.0)
        .coordinates(motions)
        .expect_err("there are three");
    assert_eq!(
        fault.to_string(),
        "joint `edge` has equations of velocities, which determine no positions: neither chosen coordinates nor a kinematic analysis have them; take a run"
    );
    let sleigh = sleigh(0.0);
    let analysis = KinematicAnalysis::new(&sleigh, StandardLagrange);
    let fault = analysis
        .run(0.0..=1.0, every(0.1), |_| {})
        .expect_err("it is not driven");
    assert!(
        fault
            .to_string()
            .contains("`edge` has equations of velocities"),
        "{fault}"
    );
}
