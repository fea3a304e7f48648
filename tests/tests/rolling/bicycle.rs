//! The benchmark bicycle against the published values.

use holonom::Pose;
use holonom::independent::{LinearMotion, NonholonomicExt};
use holonom::nalgebra::{Complex, Matrix3, Rotation3, Unit, UnitQuaternion, Vector3};
use holonom::prelude::*;
use holonom_models::Bicycle;

type State = StateOf<Bicycle>;

fn axis(k: usize) -> Unit<Vector3<f64>> {
    Unit::new_unchecked(Vector3::ith(k, 1.0))
}

fn rotation(k: usize, angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&axis(k), angle)
}

/// Upright and straight on, at a speed (m/s).
fn straight(speed: f64) -> State {
    let h = Bicycle::HANDLES;
    let mut state: State = Bicycle::default().described_state().expect("as described");
    for body in [h.rear_wheel, h.frame, h.fork, h.front_wheel] {
        Bicycle::set_velocity(&mut state, body, Vector3::new(speed, 0.0, 0.0));
    }
    for (wheel, radius) in [(h.rear_wheel, 0.3), (h.front_wheel, 0.35)] {
        let spin = Vector3::new(0.0, -speed / radius, 0.0);
        Bicycle::set_angular_velocity_global(&mut state, wheel, spin);
    }
    state
}

/// The rates of lean and steer, and the rate of a wheel; lean and steer, what the equations do not
/// depend on, and the wheels.
fn linear(speed: f64) -> LinearMotion<7, 3, 0, 0> {
    let (bicycle, h) = (Bicycle::default(), Bicycle::HANDLES);
    // The fork is what moves freely; its turns about the second axis follow from the others.
    let free = |number| Motion::free(h.fork, number);
    let coordinates = (
        free(0),
        free(1),
        free(3),
        free(5),
        h.rear_hub,
        h.steering,
        h.front_hub,
    );
    let speeds = (free(3), h.steering, h.rear_hub);
    let space = bicycle.nonholonomic(coordinates, speeds).expect("a choice");
    let state = space.of_bodies(&straight(speed));
    space.linearise(&state, [], |_| []).expect("a linear model")
}

/// The four eigenvalues that are not zero, by their real parts. Those that are zero are multiple
/// ones, of which round-off leaves its roots.
fn eigenvalues(speed: f64) -> Vec<Complex<f64>> {
    let all = linear(speed).a::<10>().complex_eigenvalues();
    let mut found: Vec<_> = all.iter().copied().collect();
    found.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    assert!(
        found[..6].iter().all(|value| value.norm() < 1e-4),
        "{found:?}"
    );
    let mut found = found.split_off(6);
    found.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
    found
}

/// Table 2 of Meijaard et al. (2007).
#[test]
fn eigenvalues_are_those_of_the_benchmark() {
    let pair = |re: f64, im: f64| [Complex::new(re, -im), Complex::new(re, im)];
    let one = |re: f64| Complex::new(re, 0.0);
    let [weave, other] = pair(1.706_756_056_639_75, 2.315_824_473_843_25);
    let [fast, faster] = pair(-0.775_341_882_195_845, 4.464_867_713_788_23);
    let [seven, of_seven] = pair(-2.138_756_442_583_62, 7.195_259_133_298_05);
    let [ten, of_ten] = pair(-3.720_168_404_372_87, 10.906_811_394_762_87);
    let [first, second] = pair(3.526_961_709_900_70, 0.807_740_275_199_300);
    for (speed, expected) in [
        (
            0.0,
            [
                one(-5.530_943_717_653_93),
                one(-3.131_643_247_906_56),
                one(3.131_643_247_906_56),
                one(5.530_943_717_653_93),
            ],
        ),
        (
            1.0,
            [
                one(-7.110_080_146_374_42),
                one(-3.134_231_250_665_78),
                first,
                second,
            ],
        ),
        (
            3.0,
            [
                one(-10.351_014_672_459_2),
                one(-2.633_661_372_536_67),
                weave,
                other,
            ],
        ),
        (
            5.0,
            [
                one(-14.078_389_692_798_22),
                fast,
                faster,
                one(-0.322_866_429_004_087),
            ],
        ),
        (
            7.0,
            [
                one(-18.157_884_661_252_62),
                seven,
                of_seven,
                one(0.102_681_705_747_66),
            ],
        ),
        (
            10.0,
            [
                one(-24.624_596_350_174_04),
                ten,
                of_ten,
                one(0.161_053_386_531_72),
            ],
        ),
    ] {
        for (found, expected) in eigenvalues(speed).iter().zip(expected) {
            let off = (found - expected).norm() / expected.norm();
            assert!(off < 1e-9, "{speed} m/s: {found} for {expected}");
        }
    }
}

/// Where the real part of the weave mode, and the capsize mode, pass zero.
#[test]
fn weave_and_capsize_speeds_are_those_of_the_benchmark() {
    let weave = |speed: f64| {
        let values = eigenvalues(speed);
        let swinging = values.iter().find(|value| value.im.abs() > 1.0);
        swinging.expect("a pair").re
    };
    // The product of the four, which vanishes with one of them: by Newton's identities.
    let capsize = |speed: f64| {
        let a = linear(speed).a::<10>();
        let [second, third] = [a * a, a * a * a];
        let [p, q, r, s] = [a, second, third, second * second].map(|power| power.trace());
        (p.powi(4) - 6.0 * p * p * q + 3.0 * q * q + 8.0 * p * r - 6.0 * s) / 24.0
    };
    let zero = |of: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64| {
        let sign = of(low).signum();
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if of(middle).signum() == sign {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    assert!((zero(&weave, 4.0, 4.6) - 4.292_382_536_341_106).abs() < 1e-9);
    assert!((zero(&capsize, 5.5, 6.5) - 6.024_262_015_388_376).abs() < 1e-9);
}

/// Basu-Mandal, Chatterjee and Papadopoulos, *Hands-free circular motions of a benchmark bicycle*,
/// Proceedings of the Royal Society A 463 (2007), table 1. Its axes are those of the model turned
/// by half a turn about y, and its angles (yaw, lean, pitch, steer, wheels) count the other way.
struct Table {
    lean: f64,
    pitch: f64,
    steer: f64,
    /// Of yaw, lean, pitch, steer, rear and front wheel.
    rates: [f64; 6],
    second_rates: [f64; 6],
    centre: Vector3<f64>,
    velocity: Vector3<f64>,
    acceleration: Vector3<f64>,
}

const TABLE: Table = Table {
    lean: core::f64::consts::FRAC_PI_2 - 0.950_129_285_147_2,
    pitch: core::f64::consts::PI - 3.125_707_301_489_4,
    steer: -0.231_138_513_574_3,
    rates: [
        -0.783_003_352_706_5,
        -0.606_842_583_541_8,
        0.011_918_552_806_9,
        -0.485_982_468_709_3,
        -8.912_989_661_489_0,
        -8.013_362_058_415_5,
    ],
    second_rates: [
        -0.835_328_170_637_9,
        7.855_528_112_824_4,
        -0.120_554_389_788_4,
        4.619_890_403_940_3,
        -1.847_255_414_421_7,
        -2.454_807_290_455_0,
    ],
    centre: Vector3::new(0.0, 0.0, -0.244_047_210_292_5),
    velocity: Vector3::new(
        2.806_934_571_454_5,
        -0.148_098_239_600_1,
        -0.105_877_874_626_1,
    ),
    acceleration: Vector3::new(
        0.504_162_631_504_7,
        -0.344_970_661_945_4,
        1.460_452_833_298_0,
    ),
};

/// The directions of yaw, lean and pitch, of the steering axis and of the front axle; the state.
fn leaning() -> ([Vector3<f64>; 3], [Vector3<f64>; 2], State) {
    let h = Bicycle::HANDLES;
    let [yaw, lean, pitch, steer, rear, front] = TABLE.rates;
    let turned = rotation(0, TABLE.lean);
    let frame = turned * rotation(1, TABLE.pitch);
    let tilt = core::f64::consts::PI / 10.0;
    let column = Unit::new_normalize(Vector3::new(tilt.sin(), 0.0, tilt.cos()));
    let fork = frame * Rotation3::from_axis_angle(&column, TABLE.steer);
    let axes = [*axis(2), *axis(0), turned * *axis(1)];
    let joints = [frame * *column, fork * *axis(1)];
    let of_frame = axes[0] * yaw + axes[1] * lean + axes[2] * pitch;
    let of_fork = of_frame + joints[0] * steer;
    let hub = Vector3::new(0.0, 0.0, -0.3);
    let foot = Vector3::new(1.1, 0.0, 0.0);
    let on_frame = |point: Vector3<f64>| frame * (point - hub);
    let head = on_frame(foot);
    let on_fork = |point: Vector3<f64>| fork * (point - foot);
    let mut state: State = Bicycle::default().described_state().expect("as described");
    let mut put = |body, orientation: Rotation3<f64>, arm: Vector3<f64>, carried, spin| {
        let turn = UnitQuaternion::from_rotation_matrix(&orientation);
        let position = TABLE.centre + arm;
        let orientation = turn.into_inner();
        Bicycle::set_pose(
            &mut state,
            body,
            Pose {
                position,
                orientation,
            },
        );
        Bicycle::set_velocity(&mut state, body, TABLE.velocity + carried);
        Bicycle::set_angular_velocity_global(&mut state, body, spin);
    };
    let none = Vector3::zeros();
    put(
        h.rear_wheel,
        frame,
        none,
        none,
        of_frame + frame * *axis(1) * rear,
    );
    let arm = on_frame(Vector3::new(0.3, 0.0, -0.9));
    put(h.frame, frame, arm, of_frame.cross(&arm), of_frame);
    for (body, centre, spin) in [
        (h.fork, Vector3::new(0.9, 0.0, -0.7), of_fork),
        (
            h.front_wheel,
            Vector3::new(1.02, 0.0, -0.35),
            of_fork + joints[1] * front,
        ),
    ] {
        let arm = on_fork(centre);
        let carried = of_frame.cross(&head) + of_fork.cross(&arm);
        put(body, fork, head + arm, carried, spin);
    }
    (axes, joints, state)
}

#[test]
fn accelerations_of_a_leaning_bicycle_are_published_ones() {
    let (axes, [column, axle], state) = leaning();
    let h = Bicycle::HANDLES;
    let bicycle = Bicycle::default();
    let mut seen = 0;
    let mut observe = |sample: &Sample<'_, f64, Bicycle>| -> Result<(), Fault> {
        if sample.time() > 0.0 {
            return Ok(());
        }
        seen += 1;
        assert!(sample.violation() < 1e-24 && sample.velocity_violation() < 1e-24);
        let turning = |body| sample.angular_acceleration_global(body);
        let [yaw, lean, pitch, ..] = TABLE.rates;
        // The directions of the rates turn.
        let known = yaw * lean * axes[0].cross(&axes[1])
            + pitch * (yaw * axes[0] + lean * axes[1]).cross(&axes[2]);
        let of_angles = Matrix3::from_columns(&axes)
            .try_inverse()
            .expect("no gimbal lock");
        let of_angles = of_angles * (turning(h.frame)? - known);
        let hub = Bicycle::pose(sample.state(), h.frame).orientation;
        let hub = UnitQuaternion::new_unchecked(hub) * *axis(1);
        let found = [
            of_angles.x,
            of_angles.y,
            of_angles.z,
            column.dot(&(turning(h.fork)? - turning(h.frame)?)),
            hub.dot(&(turning(h.rear_wheel)? - turning(h.frame)?)),
            axle.dot(&(turning(h.front_wheel)? - turning(h.fork)?)),
        ];
        for (found, expected) in found.iter().zip(TABLE.second_rates) {
            assert!((found - expected).abs() < 1e-10, "{found} for {expected}");
        }
        let off = sample.acceleration(h.rear_wheel)? - TABLE.acceleration;
        assert!(off.norm() < 1e-10, "{off}");
        Ok(())
    };
    let simulation =
        || Simulation::new(&bicycle, StandardLagrange, Rk4::every(1e-3)).initial_state(state);
    simulation()
        .absolute_coordinates()
        .run(0.0..=1e-3, every(1e-3), &mut observe)
        .expect("a run");
    simulation()
        .joint_coordinates()
        .run(0.0..=1e-3, every(1e-3), &mut observe)
        .expect("a run");
    assert_eq!(seen, 2);
}

/// Pushed sideways at 4.6 m/s, it rides, leans and recovers; no energy is lost.
#[test]
fn it_recovers_between_the_two_speeds() {
    let (bicycle, h) = (Bicycle::default(), Bicycle::HANDLES);
    let mut state = straight(4.6);
    let spin = Vector3::new(0.5, 0.0, 0.0);
    for body in [h.rear_wheel, h.frame, h.fork, h.front_wheel] {
        let more = Bicycle::angular_velocity_global(&state, body) + spin;
        let arm = Bicycle::pose(&state, body).position;
        let faster = Bicycle::velocity(&state, body) + spin.cross(&arm);
        Bicycle::set_angular_velocity_global(&mut state, body, more);
        Bicycle::set_velocity(&mut state, body, faster);
    }
    let (mut energy, mut leans, mut last) = (None, 0.0_f64, f64::NAN);
    let report = Simulation::new(&bicycle, StandardLagrange, DormandPrince::default())
        .initial_state(state)
        .joint_coordinates()
        .run(0.0..=20.0, every(0.05), |sample| {
            let orientation = sample.pose(h.frame).orientation;
            let side = UnitQuaternion::new_unchecked(orientation) * *axis(1);
            last = side.z.asin();
            leans = leans.max(last.abs());
            let first = *energy.get_or_insert(sample.energy());
            assert!((sample.energy() - first).abs() < 1e-5 * first);
        })
        .expect("a run");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    assert!(leans > 0.05 && last.abs() < 0.01 * leans, "{leans} {last}");
}
