//! What single steps cannot tell, a companion beside the run does: how errors grow in orbits and in
//! falls from the upright, closures that jump, pulses that steps pass over.

#![forbid(unsafe_code)]

use core::f64::consts::{FRAC_PI_2, TAU};

use holonom::prelude::*;
use holonom::{
    Adams, DormandPrince853, Heun, Loads, RadauIIA, Runs,
    measure::ForceLaw,
    mechanism::{Absolute, Relative},
    run::{BodyError, Verification},
};
use holonom_fixtures as _;
use holonom_models::RodPendulum;
use nalgebra::Vector3;

/// A mass point without weight.
#[derive(Mechanism)]
struct Point {
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0], free)]
    mass: Particle,
}

fn point(place: [f64; 3], velocity: [f64; 3]) -> <Point as Mechanism>::State<f64> {
    let (mass, mut state) = (
        Point::HANDLES.mass,
        Point::default().described_state().expect("described"),
    );
    let mut pose = Point::pose(&state, mass);
    pose.position = Vector3::from(place);
    Point::set_pose(&mut state, mass, pose);
    Point::set_velocity(&mut state, mass, Vector3::from(velocity));
    state
}

/// An estimate is about the error: by a factor of three either way.
fn tells<M: Mechanism>(
    found: Option<Verification<f64, M>>,
    wrong: f64,
    estimate: impl Fn(&BodyError<f64>) -> f64,
) -> f64 {
    let found = found.expect("it is verified");
    assert!(found.ended.is_none() && found.compared > 1, "{found:?}");
    let worst = found.worst().expect("there are bodies");
    let estimate = estimate(&worst);
    assert!(
        estimate > wrong / 3.0 && estimate < 3.0 * wrong,
        "{estimate:e} for {wrong:e}: {found:?}"
    );
    worst.grew
}

type Law = fn(f64, &<Point as Mechanism>::State<f64>, &mut Loads<'_, f64, Point>);

fn attraction(
    _time: f64,
    state: &<Point as Mechanism>::State<f64>,
    loads: &mut Loads<'_, f64, Point>,
) {
    let r = Point::pose(state, Point::HANDLES.mass).position;
    let factor = -1.0 / r.norm().powi(3);
    loads.force(Point::HANDLES.mass, [0, 1, 2].map(|k| factor * r[k]));
}

/// Ten turns about a centre that attracts by one over the square of the distance; the large axis is
/// 2. It ends where it began, where it is fastest.
fn orbit<I>(eccentricity: f64, integrator: I, least: f64)
where
    I: Runs<Problem<Point, StandardLagrange, f64, Absolute, ForceLaw<Law>>>,
{
    let near = 1.0 - eccentricity;
    let speed = ((1.0 + eccentricity) / near).sqrt();
    let start = point([near, 0.0, 0.0], [0.0, speed, 0.0]);
    let end = 10.0 * TAU;
    let report = Simulation::new(&Point::default(), StandardLagrange, integrator)
        .initial_state(start)
        .forces(attraction as Law)
        .verified()
        .run(0.0..=end, every(end / 10.0), |_| ControlFlow::Continue(()))
        .expect("it runs");
    let r = Point::pose(&report.state, Point::HANDLES.mass).position;
    let wrong = (r - Vector3::new(near, 0.0, 0.0)).norm();
    assert!(wrong > least, "{wrong}");
    let grew = tells(report.verification, wrong, |worst| worst.position);
    assert!(grew > 0.0 && grew <= end);
}

#[test]
fn orbits() {
    orbit(0.9, DormandPrince::default(), 1e-3);
    orbit(
        0.9,
        RadauIIA::new(Tolerance {
            relative: 1e-4,
            absolute: 1e-7,
        }),
        1e-2,
    );
    orbit(0.5, Heun::every(0.01), 1e-2);
}

/// `x'' = -sign x`, ten periods and a quarter: at zero, at full speed.
#[test]
fn closures_that_jump() {
    fn jump(
        _time: f64,
        state: &<Point as Mechanism>::State<f64>,
        loads: &mut Loads<'_, f64, Point>,
    ) {
        let x = Point::pose(state, Point::HANDLES.mass).position[0];
        loads.force(Point::HANDLES.mass, [-x.signum(), 0.0, 0.0]);
    }
    fn with<I>(integrator: I, least: f64)
    where
        I: Runs<Problem<Point, StandardLagrange, f64, Absolute, ForceLaw<Law>>>,
    {
        let end = 41.0 * 2.0_f64.sqrt();
        let report = Simulation::new(&Point::default(), StandardLagrange, integrator)
            .forces(jump as Law)
            .verified()
            .run(0.0..=end, every(end / 41.0), |_| ControlFlow::Continue(()))
            .expect("it runs");
        let wrong = Point::pose(&report.state, Point::HANDLES.mass).position[0].abs();
        assert!(wrong > least, "{wrong}");
        let found = report.verification.expect("it is verified");
        // Errors of jumps are as if thrown by dice: no factor holds, but they do not hide.
        let estimate = found.worst().expect("a body").position;
        assert!(estimate > wrong / 10.0, "{estimate:e} for {wrong:e}");
    }
    with(Rk4::every(1e-2), 1e-3);
    with(DormandPrince::default(), 1e-3);
}

/// From a thousandth of a radian beside the upright, 6 s: the angle of the rod at the end.
fn fallen<I>(integrator: I) -> (f64, RunReport<f64, RodPendulum>)
where
    I: Runs<Problem<RodPendulum, StandardLagrange, f64, Relative>>,
{
    let (rod, pivot) = (RodPendulum::default(), RodPendulum::HANDLES.pivot);
    let mut start = rod.described_state::<f64>().expect("described");
    // It is described lying; upright is a quarter of a turn up.
    rod.set_angle(&mut start, pivot, FRAC_PI_2 - 1e-3)
        .expect("set");
    let mut angle = 0.0;
    let report = Simulation::new(&rod, StandardLagrange, integrator)
        .initial_state(start)
        .joint_coordinates()
        .verified()
        .run(0.0..=6.0, every(0.05), |sample| {
            angle = sample.angle(pivot);
            let error = sample.error_of(|view| view.angle_rate(pivot));
            assert!(error.expect("it is verified").is_finite());
            ControlFlow::Continue(())
        });
    (angle, report.expect("it runs"))
}

#[test]
fn falls_from_the_upright() {
    let tolerance = |relative| Tolerance {
        relative,
        absolute: 1e-3 * relative,
    };
    let (truth, exact) = fallen(DormandPrince853::new(tolerance(1e-12)));
    let found = exact.verification.expect("it is verified");
    assert!(found.worst().expect("a body").rotation < 1e-6, "{found:?}");
    let check = |(angle, report): (f64, RunReport<f64, RodPendulum>), least: f64| {
        let off = (angle - truth).rem_euclid(TAU);
        let wrong = off.min(TAU - off);
        assert!(wrong > least, "{wrong}");
        let worst = report.verification.and_then(|found| found.worst());
        let worst = worst.expect("a body");
        // The largest error of the whole run, which is more than that of its end.
        assert!(worst.rotation > wrong / 3.0, "{worst:?} for {wrong}");
    };
    check(fallen(DormandPrince::default()), 1e-3);
    check(fallen(RadauIIA::new(tolerance(1e-4))), 0.1);
    check(fallen(Adams::new(tolerance(1e-5))), 0.1);
    check(fallen(Heun::every(5e-3)), 0.1);
}

/// Reports within the steps of the companion, on their ends and beside them: equal times are
/// compared, and the estimate is the same.
#[test]
fn reports_on_ends_of_steps_that_were_passed() {
    let rod = RodPendulum::default();
    let worst = |is_projected, reports| {
        let simulation = Simulation::new(&rod, StandardLagrange, Rk4::every(0.05)).verified();
        let quiet = |_: &Sample<'_, f64, RodPendulum>| ControlFlow::Continue(());
        let (span, reports) = (0.0..=5.0, every(reports));
        let report = if is_projected {
            let simulation = simulation.projection(Projection::default());
            simulation.run(span, reports, quiet)
        } else {
            simulation.joint_coordinates().run(span, reports, quiet)
        };
        let found = report.expect("it runs").verification.expect("verified");
        found.worst().expect("a body").rotation
    };
    for is_projected in [false, true] {
        let right = worst(is_projected, 0.05);
        assert!(right > 1e-7 && right < 1e-3, "{right:e}");
        for reports in [0.025, 0.02, 0.01, 0.005] {
            let found = worst(is_projected, reports);
            assert!(
                found > 0.9 * right && found < 1.5 * right,
                "{found:e} {right:e}"
            );
        }
    }
}

/// The angle of the rod after two seconds, and by how much a run with a bias is off there.
fn biased<F, I>(formulation: F, integrator: I, least: f64)
where
    F: holonom::Formulation<f64>,
    I: Runs<Problem<RodPendulum, F, f64, Absolute>>,
{
    let (rod, pivot) = (RodPendulum::default(), RodPendulum::HANDLES.pivot);
    let angle = |state: &StateOf<RodPendulum>| rod.view(2.0, state).map(|view| view.angle(pivot));
    let quiet = |_: &Sample<'_, f64, RodPendulum>| ControlFlow::Continue(());
    let truth = Simulation::new(&rod, StandardLagrange, DormandPrince853::new(fine()))
        .joint_coordinates()
        .run(0.0..=2.0, every(2.0), quiet)
        .expect("it runs");
    let report = Simulation::new(&rod, formulation, integrator)
        .absolute_coordinates()
        .verified()
        .run(0.0..=2.0, every(2.0), quiet)
        .expect("it runs");
    let angles = [&report.state, &truth.state].map(|state| angle(state).expect("a view"));
    let wrong = (angles[0] - angles[1]).abs();
    assert!(wrong > least, "{wrong:e}");
    tells(report.verification, wrong, |worst| worst.rotation);
}

fn fine() -> Tolerance<f64> {
    Tolerance {
        relative: 1e-11,
        absolute: 1e-13,
    }
}

/// The bias of a penalty is no matter of steps: the companion has another one. Nor is that of a
/// number of solutions.
#[test]
fn the_bias_of_a_penalty_is_estimated() {
    for alpha in [1e3, 1e4, 1e6] {
        let penalty = Penalty::new(alpha, 10.0, 1.0);
        biased(penalty, DormandPrince::new(fine()), 1e-8);
        // Errors of steps beside the bias, in either direction.
        biased(penalty, Rk4::every(0.02), 1e-7);
        biased(penalty, Rk4::every(0.05), 1e-6);
    }
    for alpha in [1e5, 3e5] {
        let twice = AugmentedLagrangian::new(alpha, 10.0, 1.0).exactly(2);
        biased(twice, DormandPrince::new(fine()), 1e-10);
    }
}

/// Where the number type has no digits for a finer tolerance, the companion has a coarser one.
#[test]
fn tolerances_near_round_off() {
    for relative in [1e-12, 3e-13, 1e-13, 3e-14] {
        let tolerance = Tolerance {
            relative,
            absolute: relative,
        };
        orbit(0.9, DormandPrince::new(tolerance), 1e-11);
    }
}

/// A point at rest, and one pulse of 0.1 s in 10 s.
#[test]
fn a_pulse_between_steps() {
    for relative in [1e-6, 1e-12] {
        let tolerance = Tolerance {
            relative,
            absolute: 1e-3 * relative,
        };
        let report = Simulation::new(
            &Point::default(),
            StandardLagrange,
            DormandPrince::new(tolerance),
        )
        .forces(|time, _, loads| {
            if (4.93..5.03).contains(&time) {
                loads.force(Point::HANDLES.mass, [1.0, 0.0, 0.0]);
            }
        })
        .verified()
        .run(0.0..=10.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect("it runs");
        let truth = 1.0 + 0.1 * (10.0 - 4.98);
        let x = Point::pose(&report.state, Point::HANDLES.mass).position.x;
        let wrong = f64::abs(x - truth);
        assert!(wrong > 0.1, "the run misses it: {x}");
        let grew = tells(report.verification, wrong, |worst| worst.position);
        assert!((4.9..5.5).contains(&grew), "{grew}");
    }
}

/// A right run is told to be right, in both coordinates, with a projection, and with breaks.
#[test]
fn what_is_right_is_told_so() {
    let rod = RodPendulum::default();
    let run = || {
        Simulation::new(&rod, StandardLagrange, DormandPrince::default())
            .breaks(&[0.3, 0.7])
            .verified()
    };
    let quiet = |_: &Sample<'_, f64, RodPendulum>| ControlFlow::Continue(());
    let reports = [
        run().run(0.0..=2.0, every(0.1), quiet),
        run()
            .projection(Projection::default())
            .run(0.0..=2.0, every(0.1), quiet),
        run()
            .joint_coordinates()
            .run(0.0..=2.0, every_step(), quiet),
    ];
    for report in reports {
        let found = report.expect("it runs").verification.expect("verified");
        let worst = found.worst().expect("a body");
        assert!(worst.position < 1e-4 && worst.rotation < 1e-4, "{found:?}");
        assert!(
            worst.position > 0.0 && found.evaluations > 1000,
            "{found:?}"
        );
    }
    let plain = Simulation::new(&rod, StandardLagrange, Rk4::every(0.01));
    let report = plain.run(0.0..=1.0, every(0.1), |sample| {
        assert!(sample.error_of(|view| view.energy()).is_none());
        ControlFlow::Continue(())
    });
    assert!(report.expect("it runs").verification.is_none());
}
