//! Derivatives along directions in which nothing moves: no error of a value tells of them.

use holonom::error::StepFault;
use holonom::independent::Direction;
use holonom::integrate::Method;
use holonom::measure::{NoForces, Unlimited};
use holonom::prelude::*;
use holonom::sensitivity::Differentiable;
use holonom::{Adams, BogackiShampine, DormandPrince853, Forward, Runs, Warning, Warnings};

use super::refused::Rod;

/// Methods that move a mechanism with derivatives.
trait Moves<M: Mechanism>:
    Runs<Problem<M, StandardLagrange, Forward<f64, 3>, M::Coordinates, Unlimited<NoForces>>>
{
}

impl<I, M: Mechanism> Moves<M> for I where
    I: Runs<Problem<M, StandardLagrange, Forward<f64, 3>, M::Coordinates, Unlimited<NoForces>>>
{
}

type Found = Result<f64, Box<dyn std::error::Error>>;

/// The largest error of the derivatives of both angles by the length, by the angle of the first
/// pendulum and by the rate of the second, which hangs. The first hangs, too, or swings.
fn worst<I>(method: I, swings: bool) -> Found
where
    I: Differentiable<f64, 3>,
    I::Carrying: Method<Forward<f64, 3>> + Moves<Rod>,
{
    const END: f64 = 10.0;
    let (rod, h) = (Rod::new(1.0)?, Rod::HANDLES);
    let space = rod.coordinates([h.hinge, h.spindle])?;
    let down = -core::f64::consts::FRAC_PI_2;
    let first = if swings { 0.6 } else { 0.0 };
    let start = space.state([down + first, down], [0.0, 0.0])?;
    let directions = [
        h.length.into(),
        Direction::position(h.hinge),
        Direction::rate(h.spindle),
    ];
    // Of a mass at the end of an arm: `w^2 = m g l / (J + m l^2)`.
    let [slow, quick] = [1.0, 0.3].map(|arm: f64| (9.81 * arm / (0.1 + arm * arm)).sqrt());
    let mut worst = 0.0_f64;
    let report = space
        .sensitivities(&start, directions)?
        .simulation(StandardLagrange, method)
        .run(0.0..=END, every(0.5), |sample| {
            let time = sample.time().value();
            let [first, second] = [h.hinge, h.spindle].map(|joint| sample.angle(joint));
            let [by_length, by_angle, _] = first.derivatives();
            if !swings {
                let wanted = [0.0, (slow * time).cos()];
                for (found, wanted) in [by_length, by_angle].into_iter().zip(wanted) {
                    worst = worst.max((found - wanted).abs());
                }
            }
            let [by_length, by_angle, by_rate] = second.derivatives();
            let off = by_rate - (quick * time).sin() / quick;
            worst = worst
                .max(off.abs())
                .max(by_length.abs())
                .max(by_angle.abs());
        })?;
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    Ok(worst)
}

/// Ten seconds are some six oscillations, over which the errors of steps add up.
#[test]
fn a_tolerance_holds_for_derivatives() -> Result<(), Box<dyn std::error::Error>> {
    let tolerance = |relative| Tolerance {
        relative,
        absolute: 1e-3 * relative,
    };
    for swings in [false, true] {
        for (relative, limit) in [(1e-6, 2e-5), (1e-9, 2e-8)] {
            let found = [
                worst(DormandPrince::new(tolerance(relative)), swings)?,
                worst(DormandPrince853::new(tolerance(relative)), swings)?,
                worst(Adams::new(tolerance(relative)), swings)?,
            ];
            for off in found {
                assert!(off < limit, "{relative} {swings}: {found:?}");
            }
        }
        let off = worst(BogackiShampine::new(tolerance(1e-5)), swings)?;
        assert!(off < 2e-4, "{swings}: {off}");
    }
    Ok(())
}

/// What stands upright exactly falls along its derivatives, which are right; and steps that are too
/// long for what hangs at rest make something of nothing. Values tell of neither, derivatives do.
#[test]
fn growth_without_bound_is_told() -> Result<(), Box<dyn std::error::Error>> {
    let (rod, h) = (Rod::new(1.0)?, Rod::HANDLES);
    let space = rod.coordinates([h.hinge, h.spindle])?;
    let up = core::f64::consts::FRAC_PI_2;
    let directions = [Direction::position(h.hinge), Direction::rate(h.spindle)];
    let along = |first| {
        let start = space.state([first, -up], [0.0, 0.0])?;
        space.sensitivities(&start, directions)
    };
    let grows = |warnings: Warnings, along: usize| {
        let mut warnings = warnings.into_iter();
        warnings.any(|warning| {
            matches!(warning, Warning::GrowingDerivatives { direction, .. } if direction == along)
        })
    };
    let mut last = 0.0;
    let upright = along(up)?
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=8.0, every(8.0), |sample| {
            last = sample.angle(h.hinge).derivatives()[0];
        })?;
    assert!(grows(upright.warnings(), 0), "{}", upright.warnings());
    let wanted = (8.0 * (9.81_f64 / 1.1).sqrt()).cosh();
    assert!((last / wanted - 1.0).abs() < 1e-6, "{last} {wanted}");
    // 0.75 s are three radians of the second pendulum, with the first one just stable.
    let steps = |step| along(-up).map(|along| along.simulation(StandardLagrange, Rk4::every(step)));
    let long = steps(0.75)?.run(0.0..=40.0, every(40.0), |_| ())?;
    assert!(grows(long.warnings(), 1), "{}", long.warnings());
    let short = steps(0.05)?.run(0.0..=40.0, every(40.0), |_| ())?;
    assert!(short.warnings().is_empty(), "{}", short.warnings());
    let fault = steps(4.0)?
        .joint_coordinates()
        .run(0.0..=1000.0, every(1000.0), |_| ());
    let fault = fault.expect_err("beyond all numbers").fault;
    assert!(
        matches!(fault, Fault::Step(StepFault::Unstable { .. })),
        "{fault}"
    );
    Ok(())
}

#[test]
fn scales_of_directions_are_positive() -> Result<(), Fault> {
    let (rod, h) = (Rod::new(1.0)?, Rod::HANDLES);
    let along = rod.sensitivities([h.length])?;
    assert!(along.scales([1e-3]).is_ok());
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let fault = along.scales([scale]).expect_err("it is refused");
        assert!(
            fault.to_string().contains("scale of a direction"),
            "{fault}"
        );
    }
    Ok(())
}
