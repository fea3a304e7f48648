//! What falls on a stop and bounces, against integrals of the energy: `reference.py`.

use core::f64::consts::PI;

use holonom::measure::{Interacting, NoForces};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{Beside, InteractionMode as Mode, JointQuantity};
use holonom::{Adams, DormandPrince853, Formulation, RadauIIA, Runs};

use super::{GRAVITY, Moves, assert_times, reference, tight};

/// A rod of 1 m on a hinge, 60 degrees from the vertical.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Rod {
    #[body(
        mass = 1.0, inertia = [1.0 / 12.0, 0.1, 0.1],
        position = [0.0, 0.43301270189221932338, -0.25]
    )]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

/// Crank 1 m, coupler 2 m, rocker 1.5 m, 2 m between the feet; 1 kg a metre.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = "joints")]
struct FourBar {
    #[body(
        mass = 1.0, inertia = [0.1, 0.1, 1.0 / 12.0],
        position = [0.17101007166283436652, 0.46984631039295419203, 0.0]
    )]
    crank: Body,
    #[body(
        mass = 2.0, inertia = [0.6, 0.6, 8.0 / 12.0],
        position = [1.305436737881535669, 1.2077009515041461396, 0.0]
    )]
    coupler: Body,
    #[body(
        mass = 1.5, inertia = [0.2, 0.2, 3.375 / 12.0],
        position = [2.1344266662187013025, 0.73785464111119194752, 0.0]
    )]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    crank_foot: Revolute,
    #[joint(
        between = [crank, coupler], axis = [0.0, 0.0, 1.0],
        point = [0.34202014332566873304, 0.93969262078590838405, 0.0]
    )]
    crank_pin: Revolute,
    #[joint(between = [ground, rocker], point = [2.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rocker_foot: Revolute,
    #[joint(
        between = [rocker, coupler], axis = [0.0, 0.0, 1.0],
        point = [2.268853332437402605, 1.475709282222383895, 0.0]
    )]
    rocker_pin: PointOnLine,
}

/// The times of impacts on the lower stop of a quantity up to a time, and what it ends with.
/// Energy is kept in between, and what is lost is told.
fn bounces<M, I, C>(
    integrator: I,
    quantity: JointQuantity<M>,
    stop: f64,
    end: f64,
) -> (Vec<f64>, Mode, f64)
where
    M: Beside<1, 1> + Default,
    C: Coordinates<M>,
    I: Moves<M, C, 1>,
{
    let mechanism = M::default();
    let mut times = Vec::new();
    let mut last = (Mode::Free, 0.0);
    let mut energy = None;
    let stops = [Interaction::limits(quantity, [stop, 3.0]).restitution(0.5)];
    let [stop] = Interaction::handles(&stops);
    let report = Simulation::new(&mechanism, StandardLagrange, integrator)
        .coordinates::<C>()
        .projection(Projection::default())
        .interactions(stops)
        .run(0.0..=end, every(2e-3), |sample| -> Result<(), Fault> {
            let kept = *energy.get_or_insert(sample.energy());
            if let Some(impact) = sample.impact(stop)?
                && times.last() != Some(&impact.time)
            {
                times.push(impact.time);
                let [before, after] = impact.rates;
                assert!(before < 0.0 && impact.impulse > 0.0);
                let is_slow = after.abs() < 1e-15 || (after / before + 0.5).abs() < 1e-10;
                assert!(is_slow, "{before} {after}");
                let lost = kept - sample.energy();
                let error = (impact.lost_energy - lost).abs();
                assert!(error < 1e-9, "{} {lost}", impact.lost_energy);
                energy = Some(sample.energy());
            } else {
                let error = (sample.energy() - kept).abs();
                assert!(error < 1e-9, "{error:e} at {}", sample.time());
            }
            last = (sample.mode(stop)?, sample.effort(stop)?);
            Ok(())
        })
        .expect("it falls");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    (times, last.0, last.1)
}

const ROD_STOP: f64 = -50.0 * PI / 180.0;

fn rod<I, C>(what: &str, integrator: I, bound: f64)
where
    C: Coordinates<Rod>,
    I: Moves<Rod, C, 1>,
{
    let hinge = Rod::HANDLES.hinge.angle();
    let (times, mode, effort) = bounces::<_, _, C>(integrator, hinge, ROD_STOP, 2.15);
    assert_times(what, &times, &reference::PENDULUM, bound);
    assert_eq!((mode, effort), (Mode::Free, 0.0), "{what}");
}

#[test]
fn a_rod_bounces_at_the_times_of_its_energy() {
    rod::<_, Relative>("ode45", DormandPrince::new(tight()), 1e-10);
    rod::<_, Absolute>("ode45", DormandPrince::new(tight()), 1e-10);
    rod::<_, Relative>("dop853", DormandPrince853::new(tight()), 1e-10);
    rod::<_, Relative>("ode113", Adams::new(tight()), 1e-10);
    rod::<_, Relative>("rk4", Rk4::every(1e-3), 1e-10);
    rod::<_, Absolute>("rk4", Rk4::every(1e-3), 1e-10);
    rod::<_, Relative>("radau", RadauIIA::new(tight()), 1e-10);
}

/// After infinitely many bounces it lies on the stop, which carries it.
#[test]
fn a_rod_comes_to_rest_on_its_stop() {
    let hinge = Rod::HANDLES.hinge.angle();
    let wanted = 0.5 * GRAVITY * (PI / 18.0).sin();
    let tight = DormandPrince::new(tight());
    for (times, mode, effort) in [
        bounces::<Rod, _, Relative>(tight, hinge, ROD_STOP, 5.0),
        bounces::<Rod, _, Absolute>(tight, hinge, ROD_STOP, 5.0),
    ] {
        assert!(times.len() > 10 && times.len() < 40, "{times:?}");
        assert_eq!(mode, Mode::AtLower);
        assert!((effort / wanted - 1.0).abs() < 1e-9, "{effort} {wanted}");
    }
}

fn four_bar<I, C>(what: &str, integrator: I, bound: f64)
where
    C: Coordinates<FourBar>,
    I: Moves<FourBar, C, 1>,
{
    let [_, _, stop] = reference::FOUR_BAR_ANGLES;
    let foot = FourBar::HANDLES.rocker_foot.angle();
    let (times, ..) = bounces::<_, _, C>(integrator, foot, stop, 1.03);
    assert_times(what, &times, &reference::FOUR_BAR, bound);
}

#[test]
fn the_rocker_of_a_four_bar_bounces_at_the_times_of_its_energy() {
    four_bar::<_, Relative>("ode45", DormandPrince::new(tight()), 1e-10);
    four_bar::<_, Absolute>("ode45", DormandPrince::new(tight()), 1e-10);
    four_bar::<_, Relative>("dop853", DormandPrince853::new(tight()), 1e-10);
    four_bar::<_, Absolute>("rk4", Rk4::every(1e-3), 1e-9);
}

/// The times of the four-bar's impacts by another formulation, and how far the loop opens.
fn formulated<F, C>(formulation: F) -> (Vec<f64>, f64)
where
    F: Formulation<f64>,
    C: Coordinates<FourBar>,
    DormandPrince<f64>: Runs<Problem<FourBar, F, f64, C, Interacting<f64, FourBar, NoForces, 1>>>,
{
    let [_, _, stop] = reference::FOUR_BAR_ANGLES;
    let (four_bar, h) = (FourBar::default(), FourBar::HANDLES);
    let limits = h.rocker_foot.angle().limits();
    let (mut times, mut opening) = (Vec::new(), 0.0_f64);
    Simulation::new(&four_bar, formulation, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions([Interaction::limits(h.rocker_foot.angle(), [stop, 3.0]).restitution(0.5)])
        .run(0.0..=1.03, every(2e-3), |sample| -> Result<(), Fault> {
            opening = opening.max(sample.violation());
            if let Some(impact) = sample.impact(limits)?
                && times.last() != Some(&impact.time)
            {
                times.push(impact.time);
            }
            Ok(())
        })
        .expect("it falls");
    (times, opening)
}

#[test]
fn other_formulations_bounce_at_the_same_times() -> Result<(), Fault> {
    let four_bar = FourBar::default();
    let baumgarte = Baumgarte::of(&four_bar)?;
    for (times, opening) in [
        formulated::<_, Absolute>(baumgarte),
        formulated::<_, Relative>(baumgarte),
    ] {
        assert_times("Baumgarte", &times, &reference::FOUR_BAR, 1e-9);
        assert!(opening < 1e-9, "{opening:e}");
    }
    let penalty = Penalty::of(&four_bar)?;
    let (times, opening) = formulated::<_, Absolute>(penalty);
    println!("{times:?} {opening:e}");
    assert_times("penalty", &times, &reference::FOUR_BAR, 1e-3);
    Ok(())
}
