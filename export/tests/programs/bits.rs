//! What is written in C has the numbers of Rust to the last bit: steps of every mechanism of the
//! catalogue, from thousands of states, by a compiler that nobody here wrote.

use crate::compiled::{Number, Program, random_state, steps};
use holonom::integrate::SemiImplicitEuler;
use holonom::mechanism::{Absolute, Relative};
use holonom::prelude::*;
use holonom::state::Vector;
use holonom_export::{Double, Export, Single, Source};
use holonom_models::*;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// So many states of each mechanism.
const STATES: usize = 10_000;

/// Steps from random states, by Rust and by C. The step of Rust tells whether it was taken.
fn compare<S: Number, X: Vector<S> + Copy>(
    source: &Source,
    start: &X,
    step: impl Fn(S, X, S) -> (bool, X),
) {
    let name = &source.name;
    let program = Program::compiled(source, &steps(source));
    let mut random = ChaCha8Rng::seed_from_u64(15);
    let (mut given, mut expected) = (Vec::new(), Vec::new());
    for number in 0..STATES {
        let state = random_state(start, &mut random);
        let time = S::constant(random.random_range(0.0..2.0));
        // Steps that hardly turn anything, and steps by some turns.
        let size = [1e-4, 1e-3, 1e-2, 0.3, 3.0][number % 5];
        let dt = S::constant(size * random.random_range(0.5..1.0));
        given.extend([dt, time, S::zero()]);
        state.for_each(|number| given.push(number));
        expected.push(step(time, state, dt));
    }
    let mut results = program.run(&given).into_iter();
    let mut refused = 0;
    for (number, (is_ok, next)) in expected.into_iter().enumerate() {
        let status = results.next().expect("a status");
        let is_same = (status == S::zero()) == is_ok;
        assert!(is_same, "{name}, state {number}: status {status:?}");
        refused += usize::from(!is_ok);
        let _times = [results.next(), results.next()];
        next.for_each(|of_rust| {
            let of_c = results.next().expect("a number");
            let is_same = of_c.same_bits(of_rust);
            assert!(is_same, "{name}, state {number}: {of_c:?} for {of_rust:?}");
        });
    }
    assert!(
        refused < STATES / 2,
        "{name}: {refused} states were refused"
    );
}

macro_rules! compare {
    ($name:expr, $mechanism:ty, $float:ty, $precision:ty, $coordinates:ty, $scheme:expr) => {
        compare!(
            $name,
            $mechanism,
            $float,
            $precision,
            $coordinates,
            $scheme,
            StandardLagrange
        );
    };
    ($name:expr, $mechanism:ty, $float:ty, $precision:ty, $coordinates:ty, $scheme:expr, $formulation:expr) => {{
        let mechanism = <$mechanism>::default();
        let export = Export::<_, $precision, $coordinates>::new(&mechanism, $formulation);
        let source = export.named($name).step($scheme).c().expect("exported");
        let problem = Stepper::<Problem<_, _, $float>, _>::new;
        let stepper = problem(&mechanism, $formulation, $scheme).expect("described");
        let stepper = stepper.coordinates::<$coordinates>();
        let start = stepper.initial_state().expect("described");
        compare::<$float, _>(&source, &start, |time, mut state, dt| {
            let mut stepper = stepper.clone().starting_at(time);
            (stepper.step(&mut state, dt).is_ok(), state)
        });
    }};
}

macro_rules! catalogue {
    ($($test:ident: $mechanism:ty;)*) => {$(
        #[test]
        fn $test() {
            let name = |kind| format!("{}_{kind}", stringify!($test));
            compare!(&name("joints"), $mechanism, f64, Double, Relative, Rk4);
            compare!(&name("bodies"), $mechanism, f64, Double, Absolute, Rk4);
        }
    )*};
}

catalogue! {
    bicycle: Bicycle;
    bricard: Bricard;
    cart_pole: CartPole;
    clock: Clock;
    door: Door;
    driven_slider_crank: DrivenSliderCrank;
    flyball_governor: FlyballGovernor;
    four_bar: FourBar;
    double_four_bar: DoubleFourBar;
    quintuple_four_bar: QuintupleFourBar;
    heavy_chain: HeavyChain;
    heavy_top: HeavyTop;
    panda: Panda;
    rod_pendulum: RodPendulum;
    simple_pendulum: SimplePendulum;
    slider_crank: SliderCrank;
    squeezing_mechanism: SqueezingMechanism;
    ur5: Ur5;
    variable_length_pendulum: VariableLengthPendulum;
}

#[test]
fn single_precision_and_other_methods() {
    compare!("single", FourBar, f32, Single, Relative, Rk4);
    compare!("single_bodies", FourBar, f32, Single, Absolute, Rk4);
    compare!("midpoint", FourBar, f64, Double, Relative, Midpoint);
    compare!(
        "semi_implicit",
        FourBar,
        f64,
        Double,
        Relative,
        SemiImplicitEuler
    );
    compare!("kutta", FourBar, f64, Double, Relative, Kutta3);
}

/// A row of squares, whose metre is twice a length, and loops.
#[test]
fn penalties_have_their_compliances_row_by_row() {
    let penalty = || Penalty {
        radian: Some(0.3),
        ..Penalty::new(1e5, 10.0, 1.0)
    };
    macro_rules! yielding {
        ($($name:literal: $mechanism:ty, $coordinates:ty;)*) => {$(
            compare!($name, $mechanism, f64, Double, $coordinates, Rk4, penalty());
        )*};
    }
    yielding! {
        "yielding_rod": SimplePendulum, Absolute;
        "yielding_bars": FourBar, Relative;
        "yielding_bars_of_bodies": FourBar, Absolute;
        "yielding_bricard": Bricard, Relative;
    }
}

#[test]
fn both_sides_of_a_choice_are_computed_to_the_same_bits() {
    let export = |name| {
        let bars = FourBar::default();
        let export = Export::<_, Double, Relative>::new(&bars, StandardLagrange).named(name);
        export.step(Rk4)
    };
    let stepper = FourBar::default()
        .stepper(StandardLagrange, Rk4)
        .expect("described");
    let start = stepper
        .joint_coordinates()
        .initial_state()
        .expect("described");
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let mut given = Vec::new();
    for number in 0..1000 {
        given.extend([[1e-4, 1e-2, 1.0][number % 3], 0.0, 0.0]);
        random_state(&start, &mut random).for_each(|number| given.push(number));
    }
    let [one, other] = [export("branched"), export("straight").without_branches()].map(|export| {
        let source = export.c().expect("exported");
        let has_branches = source.source.contains("    } else {");
        let results = Program::compiled(&source, &steps(&source)).run(&given);
        (
            has_branches,
            results.into_iter().map(f64::to_bits).collect::<Vec<_>>(),
        )
    });
    assert!(one.0 && !other.0, "one has branches, the other has none");
    assert!(one.1 == other.1, "the same bits");
}
