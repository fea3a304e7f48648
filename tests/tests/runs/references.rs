//! Motion and reactions against closed forms and published references.

use holonom::prelude::*;
use holonom_models::{HeavyTop, RodPendulum};
use nalgebra::{Vector3, Vector4};

use crate::pendulum::{SWINGS, angle, final_swing};

/// What is asked for: rad, m, rad/s.
const ASKED: f64 = 1e-8;

/// Steps so small that the integration does not count.
fn tight() -> DormandPrince<f64> {
    DormandPrince::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-14,
    })
}

/// The heavy top at 1 s, `m = 15` kg, `J = (0.234375, 0.46875, 0.234375)` kg m^2, 1 m from its tip, at 150 rad/s: by independent
/// integrations in minimal coordinates that agree to 6e-12, and to the digits given in Brüls, Cardona and Arnold 2012.
mod top {
    pub(super) const POSITION: [f64; 3] = [
        0.173_343_964_098_322,
        0.640_088_592_070_459,
        -0.748_490_791_133_685,
    ];
    pub(super) const EULER: [f64; 4] = [
        0.732_943_980_679_714,
        -0.278_285_719_337_735,
        0.531_824_611_334_04,
        -0.320_176_142_736_226,
    ];
    pub(super) const SPIN: [f64; 3] = [-0.822_078_101_685_771, 150.0, -5.923_291_348_116_9];
    /// Of the tip on the top (N).
    pub(super) const REACTION: [f64; 3] = [
        -517.600_739_476_873,
        -396.843_101_489_451,
        404.574_925_163_038,
    ];
    /// At the start.
    pub(super) const FIRST_REACTION: [f64; 3] = [0.0, -319.525_988_166, -317.262_461_538_462];
}

#[test]
fn the_heavy_top_is_where_it_should_be_after_a_second() {
    let model = HeavyTop::default();
    let handles = HeavyTop::HANDLES;
    let mut seen = 0;
    Simulation::new(&model, StandardLagrange, tight())
        .run(0.0..=1.0, every(1.0), |sample| {
            seen += 1;
            let wrench = sample.reaction(handles.tip, handles.top).expect("solvable");
            // A ball transmits no moment.
            assert!(wrench.moment.amax() <= ASKED * wrench.force.norm());
            if sample.time() == 0.0 {
                let error = wrench.force - Vector3::from(top::FIRST_REACTION);
                assert!(error.amax() <= ASKED, "{error}");
                return ControlFlow::Continue(());
            }
            let pose = sample.pose(handles.top);
            let p = pose.orientation;
            let (p, reference) = (Vector4::new(p.w, p.i, p.j, p.k), Vector4::from(top::EULER));
            let attitude = (p - reference).norm().min((p + reference).norm());
            let position = (pose.position - Vector3::from(top::POSITION)).norm();
            let spin = (sample.angular_velocity(handles.top) - Vector3::from(top::SPIN)).norm();
            let force = (wrench.force - Vector3::from(top::REACTION)).norm();
            println!("errors: {position:e} m, p {attitude:e}, {spin:e} rad/s, {force:e} N");
            assert!(position <= ASKED && attitude <= ASKED && spin <= ASKED);
            // Of 770 N.
            assert!(force <= ASKED * wrench.force.norm());
            ControlFlow::Continue(())
        })
        .expect("solvable");
    assert_eq!(seen, 2);
}

/// Angle, rate and reaction of the pendulum at 1, 5 and 10 s.
fn pendulum<F: Formulation<f64>>(method: F) {
    let rod = RodPendulum::default();
    let handles = RodPendulum::HANDLES;
    let mut seen = 0;
    Simulation::new(&rod, method, tight())
        .run(0.0..=10.0, every(1.0), |sample| {
            let Some(swing) = SWINGS
                .iter()
                .find(|s| (s.time - sample.time()).abs() < 1e-9)
            else {
                return ControlFlow::Continue(());
            };
            seen += 1;
            let error = (angle(sample, handles.pivot) - swing.angle).abs();
            let rate = (sample.angle_rate(handles.pivot) - swing.rate).abs();
            let (sine, cosine) = swing.angle.sin_cos();
            let towards_the_hinge = Vector3::new(0.0, -sine, cosine);
            let across = Vector3::new(0.0, cosine, sine);
            let wrench = sample
                .reaction(handles.pivot, handles.rod)
                .expect("solvable");
            let radial = (wrench.force.dot(&towards_the_hinge) - swing.radial).abs();
            let transverse = (wrench.force.dot(&across) - swing.transverse).abs();
            println!(
                "{method:?} at {} s: {error:e} rad, {rate:e} rad/s, {radial:e} N, {transverse:e} N",
                swing.time
            );
            // A rate of 5 rad/s, forces of 170 N: all to 8 digits.
            assert!(error <= ASKED && rate <= 5.0 * ASKED);
            assert!(radial <= 170.0 * ASKED && transverse <= 170.0 * ASKED);
            // The plane of the motion has no force across it, the hinge turns freely.
            assert!(wrench.force.x.abs() <= ASKED && wrench.moment.amax() <= ASKED);
            ControlFlow::Continue(())
        })
        .expect("solvable");
    assert_eq!(seen, SWINGS.len());
}

#[test]
fn the_pendulum_swings_as_its_closed_form() {
    pendulum(StandardLagrange);
    pendulum(Baumgarte::default());
    pendulum(AugmentedLagrangian::default());
}

#[test]
fn the_penalty_has_its_own_bias() {
    /// Of the angle at 10 s with the coefficients of chapter 15, and to how much of it.
    const BIAS: f64 = -3.4e-5;
    const PART: f64 = 0.02;
    let swing = SWINGS[2];
    let bias_of = |method| {
        let [reached, _] = final_swing::<_, _, Normalised>(method, tight(), swing.time);
        reached - swing.angle
    };
    let bias = bias_of(Penalty::default());
    println!("bias {bias:e} rad");
    assert!((bias - BIAS).abs() <= PART * BIAS.abs());
    // It is of the penalty, not of the integration: it shrinks with alpha.
    let less = bias_of(Penalty::new(1e8, 10.0, 1.0));
    println!("bias {less:e} rad at ten times alpha");
    assert!((less / bias - 0.1).abs() <= PART);
}

#[test]
fn the_heavy_top_keeps_its_energy_and_its_spin() {
    /// Of 5435.7 J and 150 rad/s, over 1 s.
    const RELATIVE: f64 = 1e-9;
    const ENERGY: f64 = 5_435.696_790_865_547;
    let model = HeavyTop::default();
    Simulation::new(&model, Baumgarte::default(), tight())
        .run(0.0..=1.0, every(0.1), |sample| {
            assert!((sample.energy() - ENERGY).abs() <= RELATIVE * ENERGY);
            let spin = sample.angular_velocity(HeavyTop::HANDLES.top).y;
            assert!((spin - 150.0).abs() <= RELATIVE * 150.0);
            ControlFlow::Continue(())
        })
        .expect("solvable");
}
