//! Methods for controllers: their orders and costs in both descriptions, and an augmented
//! Lagrangian of a cost that is known in advance.

use holonom::error::StepFault;
use holonom::prelude::*;
use holonom::{
    Heun, JointCoordinates, Kutta3, Midpoint, SemiImplicitEuler, StateParts,
    dynamics::Dynamics,
    integrate::{SecondOrder as _, System as _},
    mechanism::Relative,
    run,
    state::{Array, MovingState, Vector},
};
use holonom_models::{
    Bricard, CartPole, DrivenSliderCrank, FlyballGovernor, FourBar, HeavyTop, RodPendulum,
    SqueezingMechanism, Ur5, VariableLengthPendulum,
};

/// Methods that take steps of the rod in both coordinates.
trait Steps:
    run::Steps<Problem<RodPendulum, StandardLagrange>>
    + run::Steps<Problem<RodPendulum, StandardLagrange, f64, Relative>>
{
}

impl<K> Steps for K where
    K: run::Steps<Problem<RodPendulum, StandardLagrange>>
        + run::Steps<Problem<RodPendulum, StandardLagrange, f64, Relative>>
{
}

/// The angle of the rod (rad) after half a second, by its bodies and by its joints.
fn angles<K: Steps>(scheme: K, steps: u32) -> [f64; 2] {
    let rod = RodPendulum::default();
    let step = 0.5 / f64::from(steps);
    let mut bodies = Stepper::new(&rod, StandardLagrange, scheme).expect("acceptable");
    let mut joints = rod
        .stepper(StandardLagrange, scheme)
        .expect("acceptable")
        .joint_coordinates();
    let mut state = rod.described_state().expect("described");
    let mut joint_state = joints.initial_state().expect("consistent");
    for _ in 0..steps {
        bodies.step(&mut state, step).expect("regular");
        joints.step(&mut joint_state, step).expect("regular");
    }
    [state, joints.bodies(&joint_state)]
        .map(|state| bodies.view(&state).angle(RodPendulum::HANDLES.pivot))
}

#[test]
fn methods_have_their_order_in_both_descriptions() {
    fn orders<K: Steps>(scheme: K, wanted: f64) {
        let exact = angles(Rk4, 4096);
        let (coarse, fine) = (angles(scheme, 256), angles(scheme, 512));
        for k in 0..2 {
            let order = ((coarse[k] - exact[k]) / (fine[k] - exact[k])).log2();
            assert!((order - wanted).abs() < 0.1, "{scheme:?}, {k}: {order}");
        }
    }
    orders(SemiImplicitEuler, 1.0);
    orders(Midpoint, 2.0);
    orders(Heun, 2.0);
    orders(Kutta3, 3.0);
}

/// Rates of coordinates at new velocities are those of an evaluation there.
fn moves_by_new_velocities<M: JointCoordinates + Default>() {
    let mechanism = M::default();
    let name = M::REPORT.name;
    let mut start = mechanism.described_state::<f64>().expect("described");
    mechanism.assemble(0.0, &mut start).expect("regular");
    let (time, step) = (0.3, 0.01);
    let mut bodies = Dynamics::<Problem<M, _>>::new(&mechanism, Penalty::default())
        .expect("fine")
        .absolute_coordinates();
    let mut rates = bodies.rates(time, &start).expect("regular");
    let mut end = start;
    for (velocity, rate) in end
        .velocities_mut()
        .as_mut_slice()
        .iter_mut()
        .zip(rates.velocities().as_slice())
    {
        *velocity += step * rate;
    }
    let wanted = bodies.rates(time, &end).expect("regular");
    bodies.with_new_velocities(time, &start, step, &mut rates);
    let pairs = rates.coordinates().as_slice().iter();
    for (found, wanted) in pairs.zip(wanted.coordinates().as_slice()) {
        assert!(
            (found - wanted).abs() <= 1e-12 * (1.0 + wanted.abs()),
            "{name}: {found} {wanted}"
        );
    }

    let mut joints = Dynamics::<Problem<M, _>>::new(&mechanism, Penalty::default())
        .expect("fine")
        .joint_coordinates();
    let start = joints.state_of(&start).expect("consistent");
    let mut rates = joints.rates(time, &start).expect("regular");
    let mut end = start;
    for (velocity, rate) in end.rates_slice_mut().iter_mut().zip(rates.rates_slice()) {
        *velocity += step * rate;
    }
    let mut wanted = joints.rates(time, &end).expect("regular");
    for (place, &rate) in wanted.rates_slice_mut().iter_mut().zip(rates.rates_slice()) {
        *place = rate;
    }
    joints.with_new_velocities(time, &start, step, &mut rates);
    let apart = rates.weighted_norm(&wanted, 1.0, [(1.0, &rates), (-1.0, &wanted)]);
    assert!(apart <= 1e-12, "{name}: {apart:e}");
}

#[test]
fn coordinates_move_by_the_velocities_at_the_end() {
    moves_by_new_velocities::<RodPendulum>();
    moves_by_new_velocities::<HeavyTop>();
    moves_by_new_velocities::<CartPole>();
    moves_by_new_velocities::<Ur5>();
    moves_by_new_velocities::<FourBar>();
    moves_by_new_velocities::<DrivenSliderCrank>();
    moves_by_new_velocities::<VariableLengthPendulum>();
    moves_by_new_velocities::<SqueezingMechanism>();
    moves_by_new_velocities::<Bricard>();
    moves_by_new_velocities::<FlyballGovernor>();
}

/// Over 100 s the energy swings and comes back; the explicit method of the same order would gain
/// all that it has.
#[test]
fn semi_implicit_euler_does_not_drift() {
    let rod = RodPendulum::default();
    let mut joints = rod
        .stepper(StandardLagrange, SemiImplicitEuler)
        .expect("fine")
        .joint_coordinates();
    let mut state = joints.initial_state().expect("consistent");
    let mut largest = [0.0_f64; 2];
    for number in 0..100_000 {
        joints.step(&mut state, 1e-3).expect("regular");
        let energy = joints.view(&joints.bodies(&state)).energy();
        let half = usize::from(number >= 50_000);
        largest[half] = largest[half].max(energy.abs());
    }
    // Of 34 J that it swings with.
    assert!(
        largest[0] < 0.1 && largest[1] < 1.01 * largest[0],
        "{largest:?}"
    );
}

#[test]
fn an_augmented_lagrangian_of_a_known_cost() {
    let crank = DrivenSliderCrank::default();
    let state = crank.described_state::<f64>().expect("described");
    let formulation = AugmentedLagrangian::default();
    let evaluate = |formulation| {
        let dynamics = Dynamics::<Problem<DrivenSliderCrank, _>>::new(&crank, formulation)?;
        let (evaluation, solutions) = dynamics.evaluate(0.0, &state)?;
        let joints = Dynamics::<Problem<DrivenSliderCrank, _>>::new(&crank, formulation)?
            .joint_coordinates();
        let (evaluated, _) = joints.evaluate(0.0, &joints.state_of(&state)?)?;
        Ok::<_, Fault>((evaluation.rates, solutions, evaluated.rates))
    };
    let (wanted, _, wanted_joints) = evaluate(formulation).expect("regular");
    let mut last = f64::INFINITY;
    for solutions in [2, 3, 4, 8] {
        let (rates, taken, joint_rates) =
            evaluate(formulation.exactly(solutions)).expect("regular");
        assert_eq!(taken, solutions);
        let apart = rates.weighted_norm(&wanted, 1.0, [(1.0, &rates), (-1.0, &wanted)]);
        assert!(apart <= last.max(1e-9), "{solutions}: {apart:e}");
        last = apart;
        if solutions == 8 {
            assert!(apart < 1e-9, "{apart:e}");
            let terms = [(1.0, &joint_rates), (-1.0, &wanted_joints)];
            let apart = joint_rates.weighted_norm(&wanted_joints, 1.0, terms);
            assert!(apart < 1e-9, "{apart:e}");
        }
    }
    let fault = evaluate(formulation.exactly(1)).expect_err("a penalty");
    assert_eq!(
        fault.to_string(),
        "`solutions of the augmented Lagrangian beyond the first (max_iterations - 1)` must be finite and positive, not 0"
    );
    // Not converged by far, in either description.
    let weak = AugmentedLagrangian::new(1.0, 10.0, 1.0).exactly(2);
    let dynamics =
        Dynamics::<Problem<DrivenSliderCrank, _>>::new(&crank, weak).expect("acceptable");
    let fault = dynamics.evaluate(0.0, &state).err();
    assert!(
        matches!(
            fault,
            Some(Fault::Step(StepFault::NotConverged { iterations: 2, .. }))
        ),
        "{fault:?}"
    );
    let joints = Dynamics::<Problem<DrivenSliderCrank, _>>::new(&crank, weak)
        .expect("acceptable")
        .joint_coordinates();
    let start = joints.state_of(&state).expect("consistent");
    let fault = joints.evaluate(0.0, &start).err();
    assert!(
        matches!(
            fault,
            Some(Fault::Step(StepFault::NotConverged { iterations: 2, .. }))
        ),
        "{fault:?}"
    );
}
