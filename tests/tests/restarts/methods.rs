//! All methods, in both descriptions, with all formulations.

use holonom::integrate::{
    Advance, Counts, FixedIntegration, FixedStep, Integration, Integrator, Method, System, TimeSpan,
};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::state::Vector;
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, BogackiShampine, DormandPrince853, GeneralizedAlpha, Heun,
    ImplicitMidpoint, Kutta3, Midpoint, RadauIIA, Runs, SemiImplicitEuler,
};
use holonom_models::FourBar;

use super::{Flap, flap, goes_on};

/// A value that outlives all runs.
fn kept<M>(mechanism: M) -> &'static M {
    Box::leak(Box::new(mechanism))
}

/// Reports within steps, which need interpolants, and corrections after steps.
fn with<M, F, I, C>(mechanism: &'static M, what: &str, formulation: F, method: I) -> usize
where
    M: Mechanism,
    F: Formulation<f64>,
    I: Runs<Problem<M, F, f64, C>>,
    C: Coordinates<M>,
{
    let build = || Simulation::new(mechanism, formulation, method).assembled();
    let bare = || build().coordinates::<C>();
    let corrected = || build().projection(Projection::default()).coordinates::<C>();
    let what = format!("{} {what}", M::REPORT.name);
    goes_on(&what, &bare, every(0.013));
    goes_on(&what, &corrected, every(0.013).or_steps(3))
}

macro_rules! in_all {
    ($mechanism:expr, $formulation:expr; $($method:expr),* $(,)?) => {$(
        let method = $method;
        let what = stringify!($method);
        let kept = with::<_, _, _, Relative>($mechanism, what, $formulation, method);
        assert!(kept > 7, "{what}: {kept}");
        with::<_, _, _, Absolute>($mechanism, what, $formulation, method);
    )*};
}

/// With room on the stack for the matrices of implicit methods.
fn with_room(moves: fn()) {
    let thread = std::thread::Builder::new().stack_size(1 << 26);
    let moving = thread.spawn(moves).expect("a thread");
    if let Err(panic) = moving.join() {
        std::panic::resume_unwind(panic);
    }
}

#[test]
fn fixed_steps() {
    with_room(|| {
        let flap = kept(flap());
        in_all!(flap, StandardLagrange;
            SemiImplicitEuler::every(0.002),
            Midpoint::every(0.011),
            Heun::every(0.011),
            ImplicitMidpoint::every(0.011),
            Kutta3::every(0.011),
            Rk4::every(0.011),
            AdamsBashforthMoulton4::every(0.011),
            BogackiShampine::every(0.011),
            DormandPrince::every(0.011),
            DormandPrince853::every(0.011),
        );
        let alpha = GeneralizedAlpha::every(0.011);
        with::<_, _, _, Absolute>(flap, "generalized-alpha", StandardLagrange, alpha);
    });
}

/// A method that does not hand over what it remembers, as one of a user's may not.
#[derive(Clone, Copy, Debug)]
struct Forgetful(FixedStep<f64, Rk4>);

struct ForgetfulIntegration<X: Vector<f64>>(FixedIntegration<f64, X, Rk4>);

impl Method<f64> for Forgetful {}

impl<Y: System<f64>> Integrator<f64, Y> for Forgetful {
    type Integration = ForgetfulIntegration<Y::State>;

    fn start(
        &self,
        system: &mut Y,
        span: TimeSpan<f64>,
        state: Y::State,
    ) -> Result<Self::Integration, Fault> {
        self.0.start(system, span, state).map(ForgetfulIntegration)
    }
}

impl<X: Vector<f64>> Integration<f64, X> for ForgetfulIntegration<X> {
    fn time(&self) -> f64 {
        self.0.time()
    }

    fn state(&self) -> &X {
        self.0.state()
    }

    fn estimate(&self) -> Option<f64> {
        None
    }

    fn replace(&mut self, state: X) {
        self.0.replace(state);
    }

    fn counts(&self) -> Counts {
        self.0.counts()
    }
}

impl<Y: System<f64>> Advance<f64, Y> for ForgetfulIntegration<Y::State> {
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault> {
        self.0.advance(system)
    }

    fn at(&mut self, system: &mut Y, time: f64) -> Result<Y::State, Fault> {
        self.0.at(system, time)
    }
}

#[test]
fn a_method_that_does_not_hand_over_its_memory_is_refused() {
    let flap = flap();
    let run = Simulation::new(&flap, StandardLagrange, Forgetful(Rk4::every(0.01)));
    assert!(run.run(0.0..=0.1, every(0.1), |_| ()).is_ok());
    let error = run
        .checkpoints(1, |_| ())
        .run(0.0..=0.1, every(0.1), |_| ())
        .expect_err("it forgets");
    assert_eq!(
        error.fault.to_string(),
        "the method does not hand over what it remembers, so no checkpoint can be made; implement `Integration::remember`"
    );
}

/// A clone of a stepper and its state are a checkpoint without a heap.
#[test]
fn a_clone_of_a_stepper_goes_on() {
    let mut stepper =
        Stepper::<Problem<_, _>, _>::new(&flap(), StandardLagrange, Rk4).expect("acceptable");
    let mut state = stepper.initial_state().expect("a start");
    for _ in 0..333 {
        stepper.step(&mut state, 1e-3).expect("it moves");
    }
    let (mut again, mut from) = (stepper.clone(), state);
    for _ in 0..333 {
        stepper.step(&mut state, 1e-3).expect("it moves");
        again.step(&mut from, 1e-3).expect("it moves");
    }
    assert_eq!((from, again.time()), (state, stepper.time()));
}

#[test]
fn controlled_steps() {
    with_room(|| {
        let flap = kept(flap());
        in_all!(flap, StandardLagrange;
            BogackiShampine::default(),
            DormandPrince::default(),
            DormandPrince853::default(),
            DormandPrince::default().first_step(1e-4).largest_step(0.02),
            Adams::default(),
            RadauIIA::default(),
            Bdf::default(),
        );
    });
}

#[test]
fn formulations_and_loops() {
    with_room(|| {
        let bars = kept(FourBar::default());
        in_all!(bars, Baumgarte::default(); Rk4::every(0.011), Adams::default());
        in_all!(bars, AugmentedLagrangian::default(); Rk4::every(0.011), DormandPrince::default());
        in_all!(bars, Penalty::default(); DormandPrince::default());
        let flap: &Flap = kept(flap());
        in_all!(flap, AugmentedLagrangian::default(); AdamsBashforthMoulton4::every(0.011));
    });
}
