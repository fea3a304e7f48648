//! What is done to states after steps: what it keeps, and what it must not cost.

use core::f64::consts::FRAC_PI_2;

use holonom::prelude::*;
use holonom::{
    JointCoordinates,
    run::{PostStabilisation, TreeRecovery, VelocityProjection},
};
use holonom_models::{FourBar, RodPendulum, SliderCrank, VariableLengthPendulum};
use holonom_study::pendulum::{RigidPendulum, from_vertical, wrapped};
use holonom_study::trade::DirectCorrection;

/// The largest errors (rad) of the angle of the rod of chapter 15 over ten seconds, read from its
/// Euler parameters and from its position, and the largest `Phi^T Phi`.
fn errors(stabilisation: Option<&dyn PostStabilisation<f64, RodPendulum>>) -> [f64; 3] {
    let rod = RodPendulum::default();
    let mut run = Simulation::new(&rod, StandardLagrange, Rk4::every(0.01));
    if let Some(stabilisation) = stabilisation {
        run = run.post_stabilisation(stabilisation);
    }
    let mut largest = [0.0_f64; 3];
    let handles = RodPendulum::HANDLES;
    run.run(0.0..=10.0, every(0.5), |sample| {
        let exact = RigidPendulum::CHAPTER_15.at(sample.time()).angle;
        let position = sample.pose(handles.rod).position;
        let found = [
            from_vertical(sample.angle(handles.pivot), FRAC_PI_2),
            position.y.atan2(-position.z),
        ];
        for (largest, found) in largest.iter_mut().zip(found) {
            *largest = largest.max(wrapped(found - exact).abs());
        }
        largest[2] = largest[2].max(sample.violation());
        ControlFlow::Continue(())
    })
    .expect("solvable");
    largest
}

#[test]
fn positions_are_as_good_as_orientations_along_the_tree() {
    let tree = TreeRecovery::new(&RodPendulum::default()).expect("sound");
    let [none, recovered] = [errors(None), errors(Some(&tree))];
    println!("{none:?} {recovered:?}");
    assert!(
        recovered[0] <= 4e-7 && recovered[1] <= 4e-7,
        "{recovered:?}"
    );
    assert!(recovered[2] < 1e-28, "{recovered:?}");
    // Without it, positions drift: what is gained is no accident.
    assert!(none[1] > 10.0 * recovered[1], "{none:?}");
}

#[test]
fn velocities_alone_keep_the_joint_from_drifting_fast() {
    let [none, velocities] = [errors(None), errors(Some(&VelocityProjection::default()))];
    println!("{none:?} {velocities:?}");
    assert!(velocities[2] < 0.1 * none[2], "{velocities:?} {none:?}");
}

/// Masses do not weigh, but one body on its hinge has one motion: what a correction chooses is by
/// how much it moves along it.
#[test]
fn the_direct_correction_is_as_exact_as_that_by_the_mass() {
    let [none, projected, direct] = [
        errors(None),
        errors(Some(&Projection::default())),
        errors(Some(&DirectCorrection::default())),
    ];
    println!("{none:?} {projected:?} {direct:?}");
    assert!(direct[0] < 1e-6 && direct[1] < 1e-6, "{direct:?}");
    assert!(direct[2] < 1e-16, "{direct:?}");
    assert!(none[1] > 10.0 * direct[1], "{none:?}");
}

/// A run of a slider-crank by a stabilisation; its largest violations of positions and velocities,
/// and by how much its bearing, a joint of the tree, was open (m).
fn cranked<I: holonom::Runs<Problem<SliderCrank, StandardLagrange>>>(
    stabilisation: &dyn PostStabilisation<f64, SliderCrank>,
    integrator: I,
) -> [f64; 3] {
    assert!(!SliderCrank::JOINT_REPORT.closing.contains(&"bearing"));
    let crank = SliderCrank::default();
    let mut largest = [0.0_f64; 2];
    let report = Simulation::new(&crank, StandardLagrange, integrator)
        .post_stabilisation(stabilisation)
        .run(0.0..=0.1, every(0.005), |sample| {
            largest[0] = largest[0].max(sample.violation());
            largest[1] = largest[1].max(sample.velocity_violation());
            ControlFlow::Continue(())
        })
        .expect("solvable");
    assert!(
        report.warnings().is_empty(),
        "{integrator:?}: {}",
        report.warnings()
    );
    let monitor = report.monitor.as_ref().expect("monitored");
    let bearing = monitor.violation(SliderCrank::HANDLES.bearing);
    [largest[0], largest[1], bearing.length]
}

#[test]
fn every_stabilisation_works_with_every_integrator() {
    let tree = TreeRecovery::new(&SliderCrank::default()).expect("sound");
    let tolerance = Tolerance {
        relative: 1e-8,
        absolute: 1e-10,
    };
    macro_rules! with_all {
        ($stabilisation:expr) => {
            [
                cranked($stabilisation, Rk4::every(1e-4)),
                cranked($stabilisation, holonom::Heun::every(1e-5)),
                cranked($stabilisation, holonom::DormandPrince853::every(5e-4)),
                cranked($stabilisation, holonom::BogackiShampine::new(tolerance)),
                cranked($stabilisation, DormandPrince::new(tolerance)),
                cranked($stabilisation, holonom::DormandPrince853::new(tolerance)),
                cranked($stabilisation, holonom::ImplicitMidpoint::every(2e-5)),
                cranked($stabilisation, holonom::AdamsBashforthMoulton4::every(5e-5)),
                cranked($stabilisation, holonom::Adams::new(tolerance)),
                cranked($stabilisation, holonom::Bdf::new(tolerance)),
                cranked($stabilisation, holonom::RadauIIA::new(tolerance)),
            ]
        };
    }
    for [position, velocity, _] in with_all!(&Projection::default()) {
        assert!(
            position < 1e-20 && velocity < 1e-16,
            "{position:e} {velocity:e}"
        );
    }
    // Of one's own, or of the study's: it is called as the others are.
    for [position, velocity, _] in [
        cranked(&DirectCorrection::default(), Rk4::every(1e-4)),
        cranked(&DirectCorrection::default(), DormandPrince::new(tolerance)),
    ] {
        assert!(
            position < 1e-20 && velocity < 1e-16,
            "{position:e} {velocity:e}"
        );
    }
    for [_, velocity, _] in with_all!(&VelocityProjection::default()) {
        assert!(velocity < 1e-16, "{velocity:e}");
    }
    // The loop stays open by what the integrator leaves, the bearing does not.
    for [position, _, bearing] in with_all!(&tree) {
        assert!(
            position < 1e-8 && bearing < 1e-15,
            "{position:e} {bearing:e}"
        );
    }
    let [_, _, bearing] = cranked(&VelocityProjection::default(), Rk4::every(1e-4));
    assert!(
        bearing > 1e-13,
        "a bearing that does not open tells nothing: {bearing:e}"
    );
}

#[test]
fn recovery_leaves_what_stands_as_it_stands() {
    fn stays<M: JointCoordinates>(model: &M) {
        let mut state = model.described_state::<f64>().expect("sound");
        let before = state;
        let constants = model.constants().expect("sound");
        let tree = TreeRecovery::new(model).expect("sound");
        assert_eq!(tree.stabilise(&constants, 0.0, &mut state), Ok(0.0));
        let pairs = holonom::StateParts::coordinates(&before);
        let after = holonom::StateParts::coordinates(&state);
        let slices = [pairs, after].map(holonom::state::Array::as_slice);
        for (a, b) in slices[0].iter().zip(slices[1]) {
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
    }
    stays(&RodPendulum::default());
    stays(&FourBar::default());
    stays(&SliderCrank::default());
}

#[test]
fn recovery_keeps_the_turns_that_are_counted() {
    let model = VariableLengthPendulum::default();
    let torsion = VariableLengthPendulum::HANDLES.torsion;
    let mut state = model.described_state::<f64>().expect("sound");
    let first = VariableLengthPendulum::unwrapped_angles(&state, torsion)[0];
    let turned = first + 3.0 * core::f64::consts::TAU;
    VariableLengthPendulum::set_unwrapped_angles(&mut state, torsion, &[turned])
        .expect("one angle");
    let constants = model.constants().expect("sound");
    let tree = TreeRecovery::new(&model).expect("sound");
    assert_eq!(tree.stabilise(&constants, 0.0, &mut state), Ok(0.0));
    let after = VariableLengthPendulum::unwrapped_angles(&state, torsion)[0];
    assert!((after - turned).abs() < 1e-12, "{after} {turned}");
}

#[test]
fn the_last_of_two_stabilisations_counts() {
    let rod = RodPendulum::default();
    let tree = TreeRecovery::new(&rod).expect("sound");
    let end = |run: Simulation<'_, Problem<_, _>, _>| {
        let report = run.run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()));
        report.expect("solvable").state
    };
    let new = || Simulation::new(&rod, StandardLagrange, Rk4::every(0.02));
    let alone = end(new().post_stabilisation(&tree));
    assert_eq!(
        end(new()
            .projection(Projection::default())
            .post_stabilisation(&tree)),
        alone
    );
    let projected = end(new().projection(Projection::default()));
    assert_eq!(
        end(new()
            .post_stabilisation(&tree)
            .projection(Projection::default())),
        projected
    );
    assert_ne!(alone, projected);
}
