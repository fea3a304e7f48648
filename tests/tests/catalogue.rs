//! The problems of the catalogue at settings that the guide recommends: what is right is quiet.
//!
//! The parallelograms are not among them. They pass through singular configurations, and a run says
//! so, whether it goes on as it should or not.
//!
//! It takes many minutes to compile, so it is a test by itself, and asked for by its feature:
//!
//! ```text
//! cargo test -p holonom-tests --features catalogue --test catalogue -- --nocapture
//! ```

#![forbid(unsafe_code)]

use holonom::prelude::*;
use holonom::{DormandPrince853, Formulation, JointCoordinates, RadauIIA};
use holonom_models::problems::{
    Chain, Crank, Governor, Leaf, LongPendulum, Pendulum, Ring, Slide, Squeezer, Top,
};
use holonom_study::trade::Problem;
use holonom_tests::RunsBoth;

/// A reading is right within this part of the largest one, or of one.
const RIGHT: f64 = 1e-3;

/// The part of the time scale of a problem that a step of a fixed length is.
const STEPS: f64 = 200.0;

/// What came of all runs.
#[derive(Debug, Default)]
struct Counts {
    right: usize,
    alarms: usize,
    wrong: usize,
    silent: usize,
    failed: usize,
}

struct Runs<'a, P> {
    problem: &'a P,
    counts: &'a mut Counts,
}

impl<P: Problem<Mechanism: JointCoordinates>> Runs<'_, P> {
    /// Runs in both descriptions, and compares.
    fn both<F, I>(&mut self, name: &str, formulation: F, integrator: I, is_projected: bool)
    where
        F: Formulation<f64>,
        I: RunsBoth<P::Mechanism, F>,
    {
        let problem = self.problem;
        let start = problem.start().expect("it is described");
        let span = problem.span();
        let simulation =
            || Simulation::new(problem.mechanism(), formulation, integrator).initial_state(start);
        for description in ["bodies", "joints"] {
            let mut off = 0.0_f64;
            let observe = |sample: &Sample<'_, f64, P::Mechanism>| {
                if let Some(expected) = problem.reference(sample.time()) {
                    let size = expected.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
                    let read = problem.read(sample);
                    // NaN counts as wrong.
                    let difference = problem.difference(&read, &expected) / size;
                    off = if difference <= off { off } else { difference };
                }
            };
            let (times, reports) = (span.start..=span.end, every(span.first_output));
            let report = if description == "joints" {
                simulation()
                    .joint_coordinates()
                    .run(times, reports, observe)
            } else if is_projected {
                let simulation = simulation().absolute_coordinates();
                let simulation = simulation.projection(Projection::default());
                simulation.run(times, reports, observe)
            } else {
                simulation()
                    .absolute_coordinates()
                    .run(times, reports, observe)
            };
            let name = format!("{}, {description}, {name}", problem.name());
            let report = match report {
                Ok(report) => report,
                Err(error) => {
                    println!("{name}: {error}");
                    self.counts.failed += 1;
                    continue;
                }
            };
            let warnings = report.warnings().to_string();
            let (is_right, is_quiet) = (off < RIGHT, warnings == "no warnings");
            self.counts.right += usize::from(is_right);
            self.counts.alarms += usize::from(is_right && !is_quiet);
            self.counts.wrong += usize::from(!is_right);
            self.counts.silent += usize::from(!is_right && is_quiet);
            if is_right != is_quiet {
                println!("{name}: off by {off:.1e}; {warnings}");
            }
        }
    }

    /// The rows of `guide::choosing`.
    fn recommended(&mut self) {
        let mechanism = self.problem.mechanism();
        let of = |tolerance| Tolerance::of(mechanism, tolerance).expect("acceptable");
        let (usual, tight) = (of(1e-6), of(1e-10));
        let step = self.problem.time_scale() / STEPS;
        let standard = StandardLagrange;
        let baumgarte = Baumgarte::of(mechanism).expect("acceptable");
        let augmented = AugmentedLagrangian::of(mechanism).expect("acceptable");
        let penalty = Penalty::of(mechanism).expect("acceptable");
        let usual = DormandPrince::new(usual);
        self.both("Baumgarte, ode45", baumgarte, usual, false);
        self.both(
            "Baumgarte, RK4",
            baumgarte.at_step(step),
            Rk4::every(step),
            false,
        );
        self.both("standard, projected, ode45", standard, usual, true);
        self.both("standard, projected, RK4", standard, Rk4::every(step), true);
        self.both(
            "standard, projected, DOP853",
            standard,
            DormandPrince853::new(tight),
            true,
        );
        self.both(
            "standard, projected, Radau",
            standard,
            RadauIIA::new(of(1e-6)),
            true,
        );
        self.both("augmented, ode45", augmented, usual, false);
        self.both("penalty, ode45", penalty, usual, false);
    }
}

/// Bytes of stack: without optimisation a run of a large mechanism takes more than tests have.
const STACK: usize = 256 << 20;

#[test]
fn recommended_settings_raise_no_false_alarm() {
    let all = std::thread::Builder::new().stack_size(STACK).spawn(all);
    all.expect("a thread").join().expect("as asserted");
}

fn all() {
    let mut counts = Counts::default();
    macro_rules! problems {
        ($($problem:ident),* $(,)?) => {$(
            let problem = &$problem::default();
            Runs { problem, counts: &mut counts }.recommended();
        )*};
    }
    problems!(
        Pendulum,
        LongPendulum,
        Squeezer,
        Ring,
        Governor,
        Top,
        Slide,
        Crank,
        Chain,
        Leaf,
    );
    println!("{counts:?}");
    assert_eq!(counts.alarms, 0, "{counts:?}");
    assert!(counts.right > 100, "{counts:?}");
}
