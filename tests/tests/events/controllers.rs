//! Controllers at their period, against exact discrete solutions of a linear plant.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, DormandPrince853, GeneralizedAlpha, Heun, RadauIIA, Runs,
};

use super::{Slider, tight};

const DAMPING: f64 = 0.8;
const TARGET: f64 = 2.0;
const KHZ: f64 = 1e-3;

/// A controller with an integral part, and the filtered derivative of the place.
#[derive(Clone, Copy)]
struct Pid {
    period: f64,
    integral: f64,
    before: f64,
    slope: f64,
}

impl Pid {
    fn new(period: f64) -> Self {
        Self {
            period,
            integral: 0.0,
            before: 1.0,
            slope: 0.0,
        }
    }

    fn push(&mut self, place: f64) -> f64 {
        let error = TARGET - place;
        self.integral += error * self.period;
        let slope = (place - self.before) / self.period;
        self.before = place;
        self.slope += (slope - self.slope) * (self.period / (self.period + 0.02));
        20.0 * error + 5.0 * self.integral - 6.0 * self.slope
    }
}

/// The place after so many periods: `v' = push - c v` with the push held.
fn exact(period: f64, periods: usize) -> f64 {
    let (mut x, mut v) = (1.0, 0.0);
    let mut pid = Pid::new(period);
    let decay = (-DAMPING * period).exp();
    let reach = (1.0 - decay) / DAMPING;
    for _ in 0..periods {
        let push = pid.push(x);
        let drift = push / DAMPING;
        x += drift * period + (v - drift) * reach;
        v = drift + (v - drift) * decay;
    }
    x
}

fn error<I, C>(integrator: I, period: f64, end: f64) -> f64
where
    C: Coordinates<Slider>,
    I: Runs<Problem<Slider, StandardLagrange, f64, C>>,
{
    let (slider, h) = (Slider::new(DAMPING).expect("acceptable"), Slider::HANDLES);
    let mut pid = Pid::new(period);
    let mut times = Vec::new();
    let report = Simulation::new(&slider, StandardLagrange, integrator)
        .coordinates::<C>()
        .every_period(period, |sample, inputs| {
            times.push(sample.time());
            inputs.push = pid.push(sample.pose(h.slider).position.x);
        })
        .run(0.0..=end, every(0.33), |_| ())
        .expect("it is controlled");
    assert!(
        period > KHZ || report.warnings().is_empty(),
        "{}",
        report.warnings()
    );
    let periods = (end / period).round() as usize;
    assert_eq!(times.len(), periods);
    for (k, time) in times.iter().enumerate() {
        assert!((time - period * k as f64).abs() < 1e-12);
    }
    let place = Slider::pose(&report.state, h.slider).position.x;
    (place - exact(period, periods)).abs()
}

#[test]
fn a_controller_at_1_khz_is_exact_between_adaptive_steps() {
    let errors = [
        error::<_, Relative>(DormandPrince::default(), KHZ, 2.0),
        error::<_, Absolute>(DormandPrince::default(), KHZ, 2.0),
        error::<_, Relative>(DormandPrince853::default(), KHZ, 2.0),
        error::<_, Relative>(RadauIIA::default(), KHZ, 2.0),
        error::<_, Relative>(Rk4::every(1e-2), KHZ, 2.0),
        error::<_, Absolute>(Rk4::every(3e-4), KHZ, 2.0),
        error::<_, Relative>(AdamsBashforthMoulton4::every(1e-4), KHZ, 2.0),
        error::<_, Relative>(Adams::new(tight()), KHZ, 2.0),
    ];
    for (index, error) in errors.iter().enumerate() {
        assert!(*error < 1e-9, "{index}: {errors:?}");
    }
    let low = [
        error::<_, Relative>(Bdf::new(tight()), KHZ, 1.0),
        error::<_, Absolute>(GeneralizedAlpha::every(KHZ), KHZ, 1.0),
    ];
    assert!(low.iter().all(|error| *error < 1e-6), "{low:?}");
}

#[test]
fn a_controlled_motion_converges_with_the_order_of_the_method() {
    let rk4 = |step| error::<_, Relative>(Rk4::every(step), 0.2, 2.0);
    let heun = |step| error::<_, Relative>(Heun::every(step), 0.2, 2.0);
    let [coarse, fine] = [0.1, 0.05].map(rk4);
    assert!(coarse / fine > 13.0, "{coarse:e} {fine:e}");
    let [coarse, fine] = [0.1, 0.05].map(heun);
    assert!(coarse / fine > 3.5, "{coarse:e} {fine:e}");
    let multistep = |step| error::<_, Relative>(AdamsBashforthMoulton4::every(step), 0.2, 2.0);
    let [coarse, fine] = [0.025, 0.0125].map(multistep);
    assert!(coarse / fine > 11.0, "{coarse:e} {fine:e}");
}

#[test]
fn two_controllers_and_an_event_go_together() {
    let (slider, h) = (Slider::new(0.0).expect("acceptable"), Slider::HANDLES);
    let (mut fast, mut slow) = (0, 0);
    let mut passed = 0.0;
    let report = slider
        .simulation(StandardLagrange, DormandPrince::default())
        .every_period(0.01, |_, _| fast += 1)
        .every_period(0.25, |_, inputs| {
            slow += 1;
            inputs.push = 1.0;
        })
        .on(
            "half a metre",
            Crossing::Rising,
            |sample| sample.displacement(h.rail) - 0.5,
            |event| passed = event.time(),
        )
        .run(0.0..=1.5, every(0.1), |_| ())
        .expect("it moves");
    assert_eq!((fast, slow), (150, 6));
    assert!((passed - 1.0).abs() < 1e-12, "{passed}");
    assert!((report.state.velocities()[0] - 1.5).abs() < 1e-12);
}

#[test]
fn inputs_begin_as_those_of_the_mechanism_and_controllers_may_stop() {
    let (mut slider, h) = (Slider::new(0.0).expect("acceptable"), Slider::HANDLES);
    slider.push = 3.0;
    let mut seen = Vec::new();
    let report = slider
        .simulation(StandardLagrange, Rk4::every(0.01))
        .every_period(0.1, |sample, inputs| {
            seen.push(inputs.push);
            inputs.push += 1.0;
            if sample.time() > 0.25 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .run(0.0..=1.0, every(1.0), |_| ())
        .expect("it moves");
    assert_eq!(seen, [3.0, 4.0, 5.0, 6.0]);
    assert!(report.stopped && (report.time - 0.3).abs() < 1e-15);
    let speed = Slider::velocity(&report.state, h.slider).x;
    assert!((speed - 1.5).abs() < 1e-12, "{speed}");
}

#[test]
fn a_fault_of_a_controller_ends_the_run() {
    let (slider, h) = (Slider::new(0.0).expect("acceptable"), Slider::HANDLES);
    let error = slider
        .simulation(StandardLagrange, Rk4::every(0.01))
        .every_period(0.1, |sample, inputs| -> Result<(), Fault> {
            let reaction = sample.reaction(h.rail, h.slider)?;
            inputs.push = reaction.force.norm();
            if sample.time() > 0.15 {
                inputs.push = f64::NAN;
            }
            Ok(())
        })
        .run(0.0..=1.0, every(1.0), |_| ())
        .expect_err("an input is not finite");
    assert!(matches!(error.fault, Fault::Parameter(_)), "{error}");
    assert!((error.time - 0.2).abs() < 1e-15);
}
