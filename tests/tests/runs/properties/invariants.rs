//! Energy, momentum and constraints of random mechanisms.

use holonom::{View, integrate::FixedStep};

use super::mechanisms::{Floating, Linkage};
use super::*;

/// The largest changes over a run, of the energy (J), the linear (N s) and the angular momentum
/// about the origin (N m s), and the largest `|Phi|`.
type Changes = [f64; 4];

/// Energies are some ten joules, momenta some units; a thousand steps round, now up and now down.
const ROUND_OFF: f64 = 1e-12;

/// Linear momentum and angular momentum about the origin of bodies of these masses and moments of
/// inertia, summed by hand.
fn momenta<M: Mechanism>(
    view: &View<'_, f64, M>,
    bodies: &[(BodyHandle<M>, f64, [f64; 3])],
) -> [Vector3<f64>; 2] {
    let mut sums = [Vector3::zeros(); 2];
    for &(body, mass, inertia) in bodies {
        let momentum = mass * view.velocity(body);
        let own = Vector3::from(inertia).component_mul(&view.angular_velocity(body));
        // The axes of the body in global axes.
        let at = view.point(body, Vector3::zeros());
        let turned: Vector3<f64> = [Vector3::x(), Vector3::y(), Vector3::z()]
            .into_iter()
            .zip(own.iter())
            .map(|(axis, part)| *part * (view.point(body, axis) - at))
            .sum();
        sums[0] += momentum;
        sums[1] += at.cross(&momentum) + turned;
    }
    sums
}

fn changes<M: JointCoordinates, I: RunsBoth<M, StandardLagrange>>(
    mechanism: &M,
    state: M::State<f64>,
    bodies: &[(BodyHandle<M>, f64, [f64; 3])],
    (integrator, by_joints): (I, bool),
) -> Changes {
    let mut first = None;
    let mut worst = [0.0_f64; 4];
    run(mechanism, integrator, by_joints, state, |sample| {
        let (energy, [linear, angular]) = (sample.energy(), momenta(sample, bodies));
        let (e, l, a) = *first.get_or_insert((energy, linear, angular));
        let now = [
            (energy - e).abs(),
            (linear - l).norm(),
            (angular - a).norm(),
            sample.violation().sqrt(),
        ];
        for (worst, now) in worst.iter_mut().zip(now) {
            *worst = worst.max(now);
        }
    });
    worst
}

fn of_linkage<I: RunsBoth<Linkage, StandardLagrange>>(
    data: &Data,
    integrator: I,
    by_joints: bool,
) -> Changes {
    let linkage = Linkage::new(data.heavy, data.arm, data.lean, data.stiffness).expect("fine");
    let handles = Linkage::HANDLES;
    let state = start(&linkage, &[handles.upper, handles.lower, handles.tip], data);
    changes(&linkage, state, &[], (integrator, by_joints))
}

fn of_floating<I: RunsBoth<Floating, StandardLagrange>>(
    data: &Data,
    integrator: I,
    by_joints: bool,
) -> Changes {
    let heavy = data.heavy;
    let floating = Floating::new(heavy, data.arm, data.lean, data.stiffness).expect("fine");
    let handles = Floating::HANDLES;
    let bodies = [
        (handles.hub, heavy, [0.3 * heavy, 0.2 * heavy, 0.25 * heavy]),
        (handles.wheel, 0.6, [0.02, 0.02, 0.03]),
        (handles.limb, 1.2, [0.1, 0.02, 0.11]),
        (handles.tail, 0.5, [0.01, 0.04, 0.04]),
    ];
    let state = start(&floating, &bodies.map(|(body, ..)| body), data);
    changes(&floating, state, &bodies, (integrator, by_joints))
}

/// Which of the changes the method keeps to round-off; the others it keeps to its order.
type Exact = [bool; 4];

/// By bodies the sum of the momenta is linear in the state, which Runge-Kutta methods keep.
const BY_BODIES: Exact = [false, true, false, false];
/// The joints of a tree cannot open.
const TREE_BY_JOINTS: Exact = [false, false, false, true];
/// Nothing is read of momenta where there is none.
const LINKAGE: Exact = [false, true, true, false];

/// What is exact stays at round-off; all else falls by this factor at least, where it is not
/// round-off.
fn falls([coarse, fine]: [Changes; 2], exact: Exact, factor: f64) {
    println!("{coarse:?} {fine:?}");
    assert!(coarse[0] > ROUND_OFF, "nothing moves");
    for k in 0..4 {
        let asked = if exact[k] { 0.0 } else { coarse[k] / factor };
        assert!(fine[k] <= asked + ROUND_OFF, "{k}: {coarse:?} {fine:?}");
    }
}

/// Halving a step divides by 16 in the limit; here the order is nearer to 4 than to 3.
fn halved(of: impl Fn(FixedStep<f64, Rk4>) -> Changes, exact: Exact) {
    let steps = [512.0, 1024.0].map(|steps| Rk4::every(1.0 / steps));
    falls(steps.map(of), exact, 2.0_f64.powf(3.5));
}

/// Errors are proportional to the tolerance for an error of order 5 controlled step by step; within
/// a factor of ten, because steps are not all the same part of it.
fn controlled(of: impl Fn(DormandPrince<f64>) -> Changes, exact: Exact) {
    let tolerances = [1e-6, 1e-10].map(|tolerance| {
        DormandPrince::new(Tolerance {
            relative: tolerance,
            absolute: tolerance,
        })
    });
    falls(tolerances.map(of), exact, 1e3);
}

proptest! {
    #![proptest_config(cases(24))]

    /// A loop under gravity and on a spring keeps its energy and stays closed.
    #[test]
    fn a_linkage_keeps_its_energy_and_its_constraints(data in data()) {
        for by_joints in [false, true] {
            halved(|steps| of_linkage(&data, steps, by_joints), LINKAGE);
            controlled(|steps| of_linkage(&data, steps, by_joints), LINKAGE);
        }
    }

    /// What floats keeps its momentum and its angular momentum besides.
    #[test]
    fn a_floating_mechanism_keeps_its_momenta(data in data()) {
        for (by_joints, exact) in [(false, BY_BODIES), (true, TREE_BY_JOINTS)] {
            halved(|steps| of_floating(&data, steps, by_joints), exact);
            controlled(|steps| of_floating(&data, steps, by_joints), exact);
        }
    }
}
