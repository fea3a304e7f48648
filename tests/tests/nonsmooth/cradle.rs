//! Newton's cradle: five pendulums, none of which may pass its neighbour.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use nalgebra::{Matrix4, Vector4};

use super::{GRAVITY, tight};

/// Five balls on links of 1 m about one axis x, each on a hinge on the one before it, so that the
/// angles of the hinges are the gaps.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Cradle {
    #[body(mass = 1.0, inertia = [0.001, 0.001, 0.001], position = [0.0, 0.0, -1.0])]
    balls: [Body; 5],
    #[joint(between = [ground, balls[0]], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    first: Revolute,
    #[joint(between = [balls[k], balls[k + 1]], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    gaps: [Revolute; 4],
}

const INERTIA: f64 = 1.001;
const RAISED: f64 = 0.5;

/// The first ball is let go from -0.5 rad; rates of all balls at the end, times of impacts.
fn let_go<C: Coordinates<Cradle>>(
    gap: f64,
    restitution: f64,
    end: f64,
    is_reversed: bool,
) -> ([f64; 5], Vec<f64>) {
    let (cradle, h) = (Cradle::default(), Cradle::HANDLES);
    let mut start = cradle.described_state().expect("described");
    cradle
        .set_angle(&mut start, h.first, -RAISED)
        .and_then(|()| cradle.set_angle(&mut start, h.gaps[0], RAISED))
        .expect("they carry");
    let mut limits = h
        .gaps
        .map(|joint| Interaction::limits(joint.angle(), [-gap, 3.0]).restitution(restitution));
    if is_reversed {
        limits.reverse();
    }
    let gaps = Interaction::handles(&limits);
    let mut times = Vec::new();
    let mut energy = None;
    let report = cradle
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(limits)
        .run(0.0..=end, every(1e-3), |sample| -> Result<(), Fault> {
            for gap in gaps {
                if let Some(impact) = sample.impact(gap)? {
                    times.push(impact.time);
                }
            }
            if restitution == 1.0 {
                let energy = *energy.get_or_insert(sample.energy());
                assert!((sample.energy() - energy).abs() < 1e-9, "{}", sample.time());
            }
            Ok(())
        })
        .expect("it swings");
    times.sort_by(f64::total_cmp);
    times.dedup();
    let rates = h
        .balls
        .map(|ball| Cradle::angular_velocity(&report.state, ball).x);
    (rates, times)
}

/// A quarter of the period of the first ball, up to the angle 0, by the arithmetic-geometric mean.
fn quarter() -> f64 {
    let (mut a, mut b) = (1.0_f64, (0.5 * RAISED).cos());
    while (a - b).abs() > 1e-15 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * core::f64::consts::PI / (a * (GRAVITY / INERTIA).sqrt())
}

/// The rate of the first ball at an angle.
fn arrives(angle: f64) -> f64 {
    (2.0 * GRAVITY / INERTIA * (angle.cos() - RAISED.cos())).sqrt()
}

/// Rates after an impact of balls that touch: `after + e before >= 0` of every gap that closes,
/// complementary to impulses, with every set of impulses tried.
fn struck(rate: f64, restitution: f64) -> [f64; 5] {
    let gaps = Matrix4::from_fn(|i, j| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    });
    let offset = Vector4::new(-(1.0 + restitution) * rate, 0.0, 0.0, 0.0);
    let mut found = Vec::new();
    for mask in 0..16_u32 {
        let acts = |i: usize| mask >> i & 1 == 1;
        let reduced = Matrix4::from_fn(|i, j| match (acts(i), i == j) {
            (true, _) if acts(j) => gaps[(i, j)],
            (false, true) => 1.0,
            _ => 0.0,
        });
        let right = Vector4::from_fn(|i, _| if acts(i) { -offset[i] } else { 0.0 });
        let impulses = reduced.lu().solve(&right).expect("regular");
        let left = gaps * impulses + offset;
        if impulses.min() >= 0.0 && left.min() >= -1e-12 {
            found.push(impulses);
        }
    }
    let impulse = |i: usize| found[0].as_slice().get(i).copied().unwrap_or(0.0);
    core::array::from_fn(|ball| {
        let before = if ball == 0 { rate } else { 0.0 };
        let pushed = if ball == 0 { 0.0 } else { impulse(ball - 1) };
        before + pushed - impulse(ball)
    })
}

fn near(found: [f64; 5], wanted: [f64; 5], bound: f64) {
    for (x, y) in found.iter().zip(&wanted) {
        assert!((x - y).abs() < bound, "{found:?} {wanted:?}");
    }
}

/// What Newton's restitution gives by Moreau's rule where all balls touch: the first one comes
/// back and the others leave together. Energy and momentum are kept, but it is not what a cradle
/// does (Glocker, *Set-Valued Force Laws*, 2001; Brogliato, *Nonsmooth Mechanics*, 2016).
#[test]
fn touching_balls_leave_together() {
    let rate = arrives(0.0);
    let wanted = struck(1.0, 1.0);
    near(wanted, [-0.6, 0.4, 0.4, 0.4, 0.4], 1e-14);
    for (restitution, after) in [(1.0, wanted), (0.5, struck(1.0, 0.5)), (0.0, [0.2; 5])] {
        near(struck(1.0, restitution), after, 1e-14);
        let moment = quarter();
        let (joints, times) = let_go::<Relative>(0.0, restitution, moment + 1e-9, false);
        assert_eq!(times.len(), 1);
        assert!((times[0] - moment).abs() < 1e-10, "{times:?} {moment}");
        near(joints, after.map(|part| part * rate), 1e-7);
        let (bodies, _) = let_go::<Absolute>(0.0, restitution, moment + 1e-9, false);
        near(bodies, joints, 1e-9);
        let (reversed, _) = let_go::<Relative>(0.0, restitution, moment + 1e-9, true);
        near(reversed, joints, 1e-12);
    }
}

/// With gaps there is one impact after the other, and the last ball takes all.
#[test]
fn one_ball_in_one_ball_out() {
    let gap = 1e-3_f64;
    // The first one hits at the gap; the three between it and the last rise by a gap each.
    let lost = 3.0 * 2.0 * GRAVITY / INERTIA * (1.0 - gap.cos());
    let leaves = (arrives(gap).powi(2) - lost).sqrt();
    let moment = quarter();
    let end = moment + 0.01;
    let (rates, times) = let_go::<Relative>(gap, 1.0, end, false);
    assert_eq!(times.len(), 4, "{times:?}");
    assert!(times[0] > moment && times[3] < end);
    let frequency = (GRAVITY / INERTIA).sqrt();
    // Since the last impact the last ball is a pendulum from 0.
    let since = end - times[3];
    let slowed = leaves - 0.5 * frequency * frequency * leaves * since * since;
    assert!((rates[4] - slowed).abs() < 1e-7, "{} {slowed}", rates[4]);
    for (ball, rate) in rates.iter().take(4).enumerate() {
        // At rest at the gap since it struck.
        let wanted = -frequency * gap.sin() * (frequency * (end - times[ball])).sin();
        assert!((rate - wanted).abs() < 1e-8, "{ball}: {rate} {wanted}");
    }
    let (bodies, again) = let_go::<Absolute>(gap, 1.0, end, true);
    super::assert_times("bodies", &again, &times, 1e-10);
    near(bodies, rates, 1e-9);
}
