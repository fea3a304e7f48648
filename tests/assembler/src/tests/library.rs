//! Every joint and driver against its definition, automatic derivatives and finite differences.

use nalgebra::{DVector, Vector3};
use rand_chacha::ChaCha8Rng;

use super::ORIENTATIONS;
use super::catalogue::{Data, Entry, Moved, catalogue, holds_as_described};
use crate::accuracy::assert_close;
use crate::assembler::Assembler;
use crate::bodies::{BodyId, GROUND, Orientation, rotation};
use crate::dual;
use crate::jacobi::SingularValues;
use crate::laws::Motion;
use crate::scenes::connected;
use crate::states::{
    Spread, add_turns, displace, generator, random_consistent_state, random_state,
};

/// Off the constraints, with Euler parameters up to 5 percent too long or too short.
const LOOSE: Spread = Spread {
    position: 0.1,
    angle: 0.3,
    velocity: 1.0,
    rate: 2.0,
    norm: 0.05,
};

/// Instants at which drivers are looked at (s).
const TIMES: [f64; 3] = [0.0, 0.3, -1.7];

/// Which of the three bodies can move; the third is in the scene only for joints that name it.
const MOVES: [[bool; 3]; 4] = [
    [true, true, true],
    [false, true, true],
    [true, false, true],
    [true, true, false],
];

/// The scene of a joint, its data and its bodies.
fn scene(entry: &Entry, moves: [bool; 3], rng: &mut ChaCha8Rng) -> (Assembler, Data, [BodyId; 3]) {
    let data = Data::random(rng);
    let mut bodies = [GROUND; 3];
    let moves = [moves[0], moves[1], moves[2] && entry.bodies == 3];
    let scene = connected(moves, rng, |scene, among, _| {
        bodies = among;
        (entry.place)(scene, among, &data)
    });
    (scene, data, bodies)
}

/// Calls a test with every joint among every choice of bodies.
fn for_every_joint(
    seed: u64,
    mut test: impl FnMut(&Entry, Assembler, Data, [BodyId; 3], &mut ChaCha8Rng),
) {
    let mut rng = generator(seed);
    for entry in catalogue() {
        for moves in &MOVES[..=entry.bodies] {
            let (scene, data, bodies) = scene(&entry, *moves, &mut rng);
            test(&entry, scene, data, bodies, &mut rng);
        }
    }
}

/// The displacement of a body since the reference configuration.
fn moved(scene: &Assembler, body: BodyId, x: &[f64]) -> Moved {
    let described = scene.body(body);
    let frame = scene.kinematics(x).frames[body.0];
    let turn = frame.rotation * rotation(&described.euler).transpose();
    Moved {
        turn,
        shift: frame.position - turn * described.position,
    }
}

#[test]
fn rows_are_those_of_the_definitions() {
    for_every_joint(20, |entry, scene, data, bodies, rng| {
        for time in TIMES {
            let x = random_state(&scene, Spread::default(), rng);
            let x = x.as_slice();
            let at = bodies.map(|body| moved(&scene, body, x));
            let expected = (entry.define)(&at, &data, time);
            let phi = scene.constraints_at(time, x);
            assert_close(entry.name, phi.as_slice(), &expected, 1e-13);
        }
    });
}

#[test]
fn joints_hold_as_described_and_their_rows_are_independent() {
    for_every_joint(21, |entry, scene, _, bodies, rng| {
        let x = scene.initial_state();
        if holds_as_described(entry.name) {
            let phi = scene.constraints(x.as_slice());
            // A difference of squares of some metres: 20 m^2 have a round-off of 4e-15 m^2, several
            // times.
            assert_close(entry.name, phi.as_slice(), &vec![0.0; phi.len()], 1e-13);
        }
        let (joint, _) = scene.joint(scene.joint_ids().next().expect("a joint"));
        assert_eq!(joint.bodies(), &bodies[..entry.bodies], "{}", entry.name);
        assert_eq!(joint.equations(), scene.equations());
        let x = random_state(&scene, Spread::default(), rng);
        let values = SingularValues::new(&scene.jacobian(x.as_slice()));
        assert_eq!(values.rank(1e-9), scene.equations(), "{}", entry.name);
    });
}

/// `Phi`, `D`, `Phi'`, `gamma` and `Phi_t` by hand and by duals.
fn compare(name: &str, scene: &Assembler, time: f64, x: &[f64]) {
    let check = |what: &str, a: &[f64], b: &[f64]| {
        assert_close(&format!("{what} of {name}"), a, b, 1e-12);
    };
    let phi = dual::constraints_at(scene, time, &x[..scene.coordinates()]);
    check("Phi", scene.constraints_at(time, x).as_slice(), &phi);
    let d = scene.jacobian(x);
    check("D", d.as_slice(), dual::jacobian(scene, x).as_slice());
    let (rate, gamma) = dual::constraint_rates_and_gamma_at(scene, time, x);
    let our_rate = scene.constraint_rates_at(time, x);
    check("Phi'", our_rate.as_slice(), rate.as_slice());
    check(
        "gamma",
        scene.gamma_at(time, x).as_slice(),
        gamma.as_slice(),
    );
    let explicit = scene.time_derivatives(time, 1);
    let by_duals = dual::time_rates(scene, time, x);
    check("Phi_t", explicit.as_slice(), by_duals.as_slice());
    let du = d * DVector::from_column_slice(&x[scene.coordinates()..]);
    check(
        "D u + Phi_t",
        our_rate.as_slice(),
        (du + explicit).as_slice(),
    );
}

#[test]
fn rows_equal_automatic_derivatives_off_the_constraints() {
    for orientation in ORIENTATIONS {
        for_every_joint(22, |entry, scene, _, _, rng| {
            let scene = scene.with_orientation(orientation);
            for k in 0..15 {
                let mut x = random_state(&scene, LOOSE, rng);
                add_turns(&scene, x.as_mut_slice(), rng);
                compare(entry.name, &scene, TIMES[k % 3], x.as_slice());
            }
        });
    }
}

#[test]
fn rows_equal_automatic_derivatives_on_the_constraints() {
    for_every_joint(23, |entry, scene, _, _, rng| {
        if !holds_as_described(entry.name) {
            return;
        }
        for time in TIMES {
            let x = random_consistent_state(&scene, time, Spread::default(), rng);
            let x = x.as_slice();
            assert!(scene.constraints_at(time, x).amax() < 1e-11);
            assert!(scene.constraint_rates_at(time, x).amax() < 1e-11);
            compare(entry.name, &scene, time, x);
        }
    });
}

/// The state after a time at constant velocities: classical Runge-Kutta on the coordinates.
fn coast(scene: &Assembler, x: &DVector<f64>, time: f64) -> DVector<f64> {
    let n = scene.coordinates();
    let stage = |slope: &DVector<f64>, step: f64| {
        let mut x = x.clone();
        x.rows_mut(0, n).axpy(step, slope, 1.0);
        x
    };
    let k1 = scene.coordinate_rates(x.as_slice());
    let k2 = scene.coordinate_rates(stage(&k1, 0.5 * time).as_slice());
    let k3 = scene.coordinate_rates(stage(&k2, 0.5 * time).as_slice());
    let k4 = scene.coordinate_rates(stage(&k3, time).as_slice());
    stage(&(k1 + 2.0 * k2 + 2.0 * k3 + k4), time / 6.0)
}

#[test]
fn rows_equal_finite_differences() {
    const STEP: f64 = 1e-4;
    let compared = 2.0 * STEP;
    for_every_joint(24, |entry, scene, _, _, rng| {
        let scene = scene.with_orientation(Orientation::Raw);
        let time = 0.4;
        let x = random_state(&scene, Spread::default(), rng);
        let check = |what: &str, a: &[f64], b: &DVector<f64>| {
            assert_close(&format!("{what} of {}", entry.name), a, b.as_slice(), 1e-6);
        };
        let d = scene.jacobian(x.as_slice());
        for column in 0..scene.velocities() {
            let phi = |step: f64| {
                let mut x = x.clone();
                let mut motion = vec![0.0; scene.velocities()];
                motion[column] = step;
                displace(&scene, x.as_mut_slice(), &motion);
                scene.constraints_at(time, x.as_slice())
            };
            let slope = (phi(STEP) - phi(-STEP)) / compared;
            check("D", d.column(column).as_slice(), &slope);
        }
        let [before, after] = [-STEP, STEP].map(|h| (time + h, coast(&scene, &x, h)));
        let difference = |f: &dyn Fn(f64, &[f64]) -> DVector<f64>| {
            (f(after.0, after.1.as_slice()) - f(before.0, before.1.as_slice())) / compared
        };
        let rates = scene.constraint_rates_at(time, x.as_slice());
        let slope = difference(&|t, x| scene.constraints_at(t, x));
        check("Phi'", rates.as_slice(), &slope);
        let gamma = scene.gamma_at(time, x.as_slice());
        let slope = -difference(&|t, x| scene.constraint_rates_at(t, x));
        check("gamma", gamma.as_slice(), &slope);
        let explicit = scene.time_derivatives(time, 2);
        let slope = difference(&|t, _| scene.time_derivatives(t, 1));
        check("Phi_tt", explicit.as_slice(), &slope);
    });
}

#[test]
fn laws_have_the_derivatives_that_they_claim() {
    const STEP: f64 = 1e-4;
    let laws = [
        Motion::Constant(0.7),
        Motion::new(f64::exp, f64::exp, f64::exp),
        Motion::polynomial([0.3, -1.0, 0.5, 2.0]),
        Motion::sine(0.2, 0.4, 3.0, 0.1),
        Motion::smooth_step(0.5, -1.5, -0.2, 0.9),
    ];
    for law in laws {
        for time in [-0.5, 0.0, 0.1, 0.45, 0.6, 1.3] {
            let [_, rate, curvature] = law.at(time);
            let (before, after) = (law.at(time - STEP), law.at(time + STEP));
            let slopes = [0, 1].map(|k| (after[k] - before[k]) / (2.0 * STEP));
            assert_close("law", &[rate, curvature], &slopes, 1e-6);
        }
    }
}

#[test]
fn reactions_are_in_balance() {
    for_every_joint(25, |entry, scene, _, bodies, rng| {
        if !holds_as_described(entry.name) {
            return;
        }
        // On the constraints: the three rows of two points pull them together along no line in
        // common elsewhere.
        let x = random_consistent_state(&scene, 0.0, Spread::default(), rng);
        let x = x.as_slice();
        let joint = scene.joint_ids().next().expect("a joint");
        let lambda = DVector::from_fn(scene.equations(), |k, _| 1.0 + k as f64);
        let wrenches = scene.wrenches(joint, x, &lambda);
        let at = scene.kinematics(x);
        let points = scene.joint(joint).0.points();
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for ((wrench, body), point) in wrenches.iter().zip(bodies).zip(points) {
            force += wrench.force;
            moment += wrench.moment + at.frame(body).point(point).cross(&wrench.force);
        }
        assert_close(entry.name, force.as_slice(), &[0.0; 3], 1e-12);
        assert_close(entry.name, moment.as_slice(), &[0.0; 3], 1e-12);
    });
}
