//! One mechanism, declared in three ways.

use super::mechanisms::{Backwards, Linkage, Renamed};
use super::*;

/// s.
const STEP: f64 = 1.0 / 512.0;

/// Position (m), two directions, velocity (m/s) and angular velocity (rad/s, global) of three
/// bodies.
type Numbers = Vec<f64>;

/// A displacement of the start (m/s) that is far above round-off.
const NEARBY: f64 = 1e-6;

fn numbers<M: JointCoordinates>(
    mechanism: &M,
    bodies: [BodyHandle<M>; 3],
    by_joints: bool,
    data: &Data,
) -> Numbers {
    let state = start(mechanism, &bodies, data);
    let mut all = Vec::new();
    run(mechanism, Rk4::every(STEP), by_joints, state, |sample| {
        for body in bodies {
            for vector in [
                sample.point(body, Vector3::zeros()),
                sample.point(body, Vector3::x()),
                sample.point(body, Vector3::y()),
                sample.velocity(body),
                sample.angular_velocity_global(body),
            ] {
                all.extend(vector.iter().copied());
            }
        }
    });
    all
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().zip(b);
    pairs.fold(0.0, |worst, (a, b)| worst.max((a - b).abs()))
}

fn linkage(data: &Data, by_joints: bool) -> Numbers {
    let linkage = Linkage::new(data.heavy, data.arm, data.lean, data.stiffness).expect("fine");
    let handles = Linkage::HANDLES;
    numbers(
        &linkage,
        [handles.upper, handles.lower, handles.tip],
        by_joints,
        data,
    )
}

/// The largest difference that round-off leaves: some ten operations deep a step and entry, carried
/// on as a displacement of the start is.
fn round_off(growth: f64) -> f64 {
    64.0 * f64::EPSILON / STEP * growth.max(1.0)
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn the_order_of_fields_and_their_names_do_not_matter(data in data()) {
        let backwards = Backwards::new(data.stiffness, data.lean, data.arm, data.heavy);
        let backwards = backwards.expect("acceptable");
        let renamed = Renamed::new(data.arm, data.stiffness, data.heavy, data.lean);
        let renamed = renamed.expect("acceptable");
        let mut nearby = data;
        nearby.motion[0][0] += NEARBY;
        for by_joints in [false, true] {
            let reference = linkage(&data, by_joints);
            let growth = apart(&reference, &linkage(&nearby, by_joints)) / NEARBY;
            let asked = round_off(growth);
            let h = Backwards::HANDLES;
            let found = numbers(&backwards, [h.upper, h.lower, h.tip], by_joints, &data);
            let first = apart(&reference, &found);
            let h = Renamed::HANDLES;
            let found = numbers(&renamed, [h.c, h.a, h.b], by_joints, &data);
            let second = apart(&reference, &found);
            println!("joints: {by_joints}, {first:e} and {second:e} of {asked:e}");
            assert!(first <= asked && second <= asked, "{first:e} {second:e}");
        }
    }
}

/// Bodies are eliminated in another order, so that the runs above are other sums.
#[test]
fn their_plans_are_not_the_same() {
    assert_ne!(Linkage::REPORT.plan, Backwards::REPORT.plan);
}
