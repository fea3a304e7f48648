//! Every method of integration on mechanisms of every kind, in both descriptions: the same motion,
//! as exactly as was asked for.

use holonom::prelude::*;
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, BogackiShampine, DormandPrince853, ImplicitMidpoint,
    JointCoordinates, RadauIIA, StateParts,
    state::{Array, Vector},
};
use holonom_models::{
    Bricard, CartPole, DrivenSliderCrank, FlyballGovernor, FourBar, HeavyTop, RodPendulum,
    SqueezingMechanism, Ur5, VariableLengthPendulum,
};
use holonom_tests::RunsBoth;
use holonom_tests::is_exhaustive;

/// The state of the bodies at the end, by them and by their joints.
fn ends<M: JointCoordinates + Default>(
    method: impl RunsBoth<M, StandardLagrange>,
    end: f64,
) -> [M::State<f64>; 2] {
    let mechanism = M::default();
    let run = || {
        Simulation::new(&mechanism, StandardLagrange, method)
            .projection(Projection::default())
            .assembled()
    };
    let look = |_: &Sample<'_, f64, M>| ControlFlow::Continue(());
    let bodies = run()
        .absolute_coordinates()
        .run(0.0..=end, every(end), look);
    let joints = run().joint_coordinates().run(0.0..=end, every(end), look);
    [bodies, joints].map(|report| report.expect("solvable").state)
}

/// The largest difference of elements, relative to those of size 1 and more.
fn apart<M: JointCoordinates>(a: &M::State<f64>, b: &M::State<f64>) -> f64 {
    a.weighted_norm(b, 1.0, [(1.0, a), (-1.0, b)])
}

fn moves_alike<M: JointCoordinates + Default>(end: f64) {
    let name = M::REPORT.name;
    let tolerance = |relative| Tolerance {
        relative,
        absolute: 1e-2 * relative,
    };
    let exact = ends::<M>(DormandPrince853::new(tolerance(1e-12)), end);
    // Euler parameters are known but for their sign.
    let velocities = exact.each_ref().map(|state| state.velocities().as_slice());
    for (a, b) in velocities[0].iter().zip(velocities[1]) {
        assert!((a - b).abs() < 1e-8 * (1.0 + a.abs()), "{name}: {a} {b}");
    }
    let close = |found: [M::State<f64>; 2], asked: f64, method: &str| {
        for ((state, exact), by) in found.iter().zip(&exact).zip(["bodies", "joints"]) {
            let error = apart::<M>(state, exact);
            println!("{name} by {by}, {method}: {error:e}");
            assert!(error < asked, "{name} by {by}, {method}: {error:e}");
        }
    };
    close(
        ends::<M>(RadauIIA::new(tolerance(1e-8)), end),
        1e-5,
        "Radau",
    );
    close(ends::<M>(Bdf::new(tolerance(1e-8)), end), 1e-4, "BDF");
    close(ends::<M>(Adams::new(tolerance(1e-8)), end), 1e-5, "Adams");
    close(
        ends::<M>(BogackiShampine::new(tolerance(1e-6)), end),
        1e-3,
        "Bogacki-Shampine",
    );
    let step = end / 4096.0;
    close(
        ends::<M>(AdamsBashforthMoulton4::every(step), end),
        1e-5,
        "Adams-Bashforth-Moulton",
    );
    close(
        ends::<M>(ImplicitMidpoint::every(step), end),
        1e-3,
        "implicit midpoint",
    );
}

/// With room on the stack for the matrices of implicit methods, which code that is not optimised
/// copies.
fn with_room(moves: fn()) {
    let thread = std::thread::Builder::new().stack_size(1 << 26);
    let moving = thread.spawn(moves).expect("a thread");
    if let Err(panic) = moving.join() {
        std::panic::resume_unwind(panic);
    }
}

#[test]
fn open_chains_move_alike() {
    with_room(|| {
        moves_alike::<RodPendulum>(1.0);
        moves_alike::<HeavyTop>(0.1);
        moves_alike::<CartPole>(1.0);
        moves_alike::<Ur5>(0.3);
        moves_alike::<VariableLengthPendulum>(1.0);
    });
}

#[test]
fn loops_move_alike() {
    with_room(|| {
        moves_alike::<FourBar>(0.5);
        if is_exhaustive() {
            moves_alike::<DrivenSliderCrank>(0.5);
        }
        moves_alike::<SqueezingMechanism>(0.01);
        moves_alike::<Bricard>(0.5);
    });
}

/// Explicit steps are short there, and implicit ones by fixed points do not converge at longer
/// ones.
#[test]
fn stiff_ones_move_alike() {
    with_room(|| moves_alike::<FlyballGovernor>(0.05));
}
