//! Equilibria along a parameter, folds and branchings, against closed forms.

use core::f64::consts::PI;
use core::ops::ControlFlow;

use holonom::Real;
use holonom::error::{AnalysisFault, StartFault, StepFault};
use holonom::independent::{
    BranchEnd, BranchPoint, Continuation, IndependentCoordinates, PointKind, Varied,
};
use holonom::mechanism::{HasInverse, HasMassMatrix};
use holonom::prelude::*;

/// A branch as a list.
fn branch<M: HasInverse + HasMassMatrix, const N: usize, S: Real>(
    space: &IndependentCoordinates<M, N, S>,
    start: &M::JointState<S>,
    continuation: Continuation<M, S>,
) -> Result<(BranchEnd, Vec<BranchPoint<M, N, S>>), Fault> {
    let mut points = Vec::new();
    let end = space.follow(start, continuation, |point| {
        points.push(*point);
        ControlFlow::Continue(())
    })?;
    Ok((end, points))
}

fn of_kind<M: HasInverse + HasMassMatrix, const N: usize, S: Real>(
    points: &[BranchPoint<M, N, S>],
    kind: PointKind,
) -> Vec<&BranchPoint<M, N, S>> {
    points.iter().filter(|point| point.kind == kind).collect()
}

/// Von Mises's truss: a block between two springs, which moves up and down.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse])]
struct Truss {
    #[param]
    stiffness: f64,
    #[input]
    load: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.3, 0.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.3, 0.0], axis = [0.0, 1.0, 0.0])]
    rail: Prismatic,
    #[force(between = [ground, block], point = [0.0, 0.3, 0.0], force = [0.0, -load, 0.0])]
    weight: PointForce,
    #[force(
        between = [ground, block],
        head = [-0.4, 0.0, 0.0],
        tail = [0.0, 0.3, 0.0],
        stiffness = stiffness,
        free_length = 0.5
    )]
    left: SpringDamper,
    #[force(
        between = [ground, block],
        head = [0.4, 0.0, 0.0],
        tail = [0.0, 0.3, 0.0],
        stiffness = stiffness,
        free_length = 0.5
    )]
    right: SpringDamper,
}

/// The load of the truss at a height, and the height of its fold.
fn truss(stiffness: f64) -> (impl Fn(f64) -> f64, f64) {
    let load = move |y: f64| 2.0 * stiffness * (0.5 / y.hypot(0.4) - 1.0) * y;
    let length = (0.5_f64 * 0.16).cbrt();
    (load, (length * length - 0.16).sqrt())
}

#[test]
fn a_truss_snaps_through() -> Result<(), Fault> {
    let h = Truss::HANDLES;
    for stiffness in [1e-3, 500.0, 1e9] {
        let (load, height) = truss(stiffness);
        let most = load(height);
        let truss = Truss::new(stiffness)?;
        let space = truss.coordinates([h.rail])?;
        for step in [0.01, 0.1, 0.3] {
            let start = space.state([0.0], [0.0])?;
            let way = Continuation::new(h.load, 4.0 * most).step(step);
            let (end, points) = branch(&space, &start, way)?;
            assert_eq!(end, BranchEnd::Reached);
            let last = points.last().map(|point| point.value);
            assert_eq!(last, Some(4.0 * most));
            let folds = of_kind(&points, PointKind::Fold);
            assert_eq!(folds.len(), 2, "{stiffness}, {step}");
            for (fold, sign) in folds.into_iter().zip([1.0, -1.0]) {
                let y = 0.3 + space.positions(&fold.state)?[0];
                assert!((fold.value / most - sign).abs() < 1e-12, "{}", fold.value);
                assert!((y - sign * height).abs() < 1e-10, "{y} for {height}");
            }
            for point in &points {
                let y = 0.3 + space.positions(&point.state)?[0];
                assert!((point.value - load(y)).abs() < 1e-11 * most, "{y}");
                if point.kind == PointKind::Regular {
                    let is_between = y.abs() < height;
                    assert_eq!(point.unstable, Some(usize::from(is_between)), "{y}");
                    let grows = point.linear.modes().iter().any(|mode| mode.rate.re > 0.0);
                    assert_eq!(grows, is_between);
                }
            }
        }
    }
    Ok(())
}

/// From either side of the folds, to either side, and back again. From between them and from a fold
/// a branch that begins towards the end turns away from it.
#[test]
fn a_truss_is_followed_from_anywhere() -> Result<(), Fault> {
    let h = Truss::HANDLES;
    let (load, height) = truss(500.0);
    let most = load(height);
    for y in [0.28, 0.2, -0.2, -0.29] {
        let truss = Truss {
            load: load(y),
            ..Truss::new(500.0)?
        };
        let space = truss.coordinates([h.rail])?;
        let mut state = space.state([y - 0.3], [0.0])?;
        let mut there = space;
        for end in [3.0 * most, -3.0 * most, 2.0 * most, load(y)] {
            let way = Continuation::new(h.load, end).step(0.05);
            let (why, points) = branch(&there, &state, way)?;
            assert_eq!(why, BranchEnd::Reached, "{y}, {end}");
            (there, state) = (
                points[points.len() - 1].space,
                points[points.len() - 1].state,
            );
            let found = 0.3 + space.positions(&state)?[0];
            assert!((load(found) - end).abs() < 1e-10 * most, "{y}: {found}");
        }
    }
    for y in [0.1, 0.0, -0.1, height, -height] {
        let truss = Truss {
            load: load(y),
            ..Truss::new(500.0)?
        };
        let space = truss.coordinates([h.rail])?;
        let start = space.state([y - 0.3], [0.0])?;
        for end in [3.0 * most, -3.0 * most] {
            let way = Continuation::new(h.load, end).step(0.05).points(200);
            let (why, points) = branch(&space, &start, way)?;
            let folds = of_kind(&points, PointKind::Fold);
            if y.abs() < height {
                assert_eq!((why, folds.len()), (BranchEnd::Points, 1), "{y}, {end}");
                assert!((folds[0].value / most - end.signum()).abs() < 1e-12);
            } else {
                assert!(folds.len() <= 2, "{y}, {end}");
            }
            for point in &points {
                let y = 0.3 + space.positions(&point.state)?[0];
                assert!((point.value - load(y)).abs() < 1e-10 * most, "{y}");
            }
        }
    }
    Ok(())
}

#[test]
fn a_truss_in_single_precision() -> Result<(), Fault> {
    let h = Truss::HANDLES;
    let (load, height) = truss(500.0);
    let space = Truss::new(500.0)?.coordinates_in::<f32, 1>([h.rail])?;
    let start = space.state([0.0], [0.0])?;
    let (end, points) = branch(&space, &start, Continuation::new(h.load, 60.0))?;
    assert_eq!(end, BranchEnd::Reached);
    let folds = of_kind(&points, PointKind::Fold);
    assert_eq!(folds.len(), 2);
    let y = 0.3 + f64::from(space.positions(&folds[0].state)?[0]);
    assert!((y - height).abs() < 1e-4, "{y}");
    assert!((f64::from(folds[0].value) / load(height) - 1.0).abs() < 1e-5);
    Ok(())
}

/// A column of three bars on torsion springs under a load at its tip.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse])]
struct Column {
    #[input]
    load: f64,
    #[input]
    side: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.25])]
    a: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.75])]
    b: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.25])]
    c: Body,
    #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    foot: Revolute,
    #[joint(between = [a, b], point = [0.0, 0.0, 0.5], axis = [1.0, 0.0, 0.0])]
    knee: Revolute,
    #[joint(between = [b, c], point = [0.0, 0.0, 1.0], axis = [1.0, 0.0, 0.0])]
    hip: Revolute,
    #[force(between = [ground, a], axis = [1.0, 0.0, 0.0], stiffness = 20.0)]
    at_foot: TorsionalSpringDamper,
    #[force(between = [a, b], axis = [1.0, 0.0, 0.0], stiffness = 20.0)]
    at_knee: TorsionalSpringDamper,
    #[force(between = [b, c], axis = [1.0, 0.0, 0.0], stiffness = 20.0)]
    at_hip: TorsionalSpringDamper,
    #[force(between = [ground, c], point = [0.0, 0.0, 1.5], force = [0.0, side, -load])]
    weight: PointForce,
}

/// It buckles at the eigenvalues of the chain of springs, `k / l (2 - 2 cos (2 n - 1) pi / 7)`, one
/// more direction at each.
#[test]
fn a_column_buckles() -> Result<(), Fault> {
    let (column, h) = (Column::default(), Column::HANDLES);
    let space = column.coordinates([h.foot, h.knee, h.hip])?;
    let start = space.state([0.0; 3], [0.0; 3])?;
    let wanted = [1.0, 3.0, 5.0].map(|n: f64| 40.0 * (2.0 - 2.0 * (n * PI / 7.0).cos()));
    for (step, end) in [(0.02, 200.0), (0.1, 151.7), (0.003, 140.0)] {
        let way = Continuation::new(h.load, end).step(step);
        let (why, points) = branch(&space, &start, way)?;
        assert_eq!(why, BranchEnd::Reached);
        let found = of_kind(&points, PointKind::Branching);
        assert_eq!(found.len(), 3);
        for (point, wanted) in found.iter().zip(wanted) {
            assert!(
                (point.value / wanted - 1.0).abs() < 1e-10,
                "{}",
                point.value
            );
        }
        assert!(of_kind(&points, PointKind::Fold).is_empty());
        for point in of_kind(&points, PointKind::Regular) {
            let below = wanted.iter().filter(|load| **load < point.value).count();
            assert_eq!(point.unstable, Some(below), "{}", point.value);
        }
    }
    // With a push to the side it bends instead, and goes on bending.
    let pushed = Column {
        side: 0.05,
        ..column
    };
    let space = pushed.coordinates([h.foot, h.knee, h.hip])?;
    let rest = space.equilibrium(&start)?;
    let (why, points) = branch(&space, &rest, Continuation::new(h.load, 30.0))?;
    assert_eq!(why, BranchEnd::Reached);
    assert!(points.iter().all(|point| point.kind == PointKind::Regular));
    assert!(points.iter().all(|point| point.unstable == Some(0)));
    let last = points[points.len() - 1];
    assert!(space.positions(&last.state)?.amax() > 0.5);
    assert!(last.space.forward(&last.state, [0.0; 3])?.amax() < 1e-9);
    Ok(())
}

/// A crank on a torsion spring, a rod, and a slider that is pushed.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse])]
pub(super) struct Press {
    #[param(like = 0.3)]
    crank_length: f64,
    #[input]
    load: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5 * crank_length, 0.0, 0.0])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [crank_length + 0.25, 0.0, 0.0])]
    rod: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [crank_length + 0.5, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, rod], point = [crank_length, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [ground, slider], point = [crank_length + 0.5, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[joint(between = [slider, rod], point = [crank_length + 0.5, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    end: PointOnLine,
    #[force(between = [ground, crank], axis = [0.0, 0.0, 1.0], stiffness = 5.0, free_angle = -0.5)]
    spring: TorsionalSpringDamper,
    #[force(between = [ground, slider], point = [crank_length + 0.5, 0.0, 0.0], force = [-load, 0.0, 0.0])]
    push: PointForce,
}

/// The load that holds the press, by the work of spring and load.
pub(super) fn load(crank: f64, angle: f64) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let rod = (0.25 - (crank * sine).powi(2)).sqrt();
    5.0 * (angle + 0.5) / (crank * sine * (1.0 + crank * cosine / rod))
}

/// The least load of a loop, from either side; what is behind it is never reached.
#[test]
fn a_press_has_a_least_load() -> Result<(), Fault> {
    // By thirds: the least value to half of the digits.
    let (mut low, mut high) = (0.2, 2.8);
    for _ in 0..200 {
        let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if load(0.3, a) < load(0.3, b) {
            high = b;
        } else {
            low = a;
        }
    }
    let least = load(0.3, low);
    let h = Press::HANDLES;
    for angle in [0.3, 2.6] {
        let press = Press {
            load: load(0.3, angle),
            ..Press::new(0.3)?
        };
        let space = press.coordinates([h.bearing])?;
        let start = space.state([angle], [0.0])?;
        let mut folds = Vec::new();
        let way = Continuation::new(h.load, 0.5 * least);
        let end = space.follow(&start, way, |point| {
            let at = space.positions(&point.state).map_or(0.0, |at| at[0]);
            assert!((point.value / load(0.3, at) - 1.0).abs() < 1e-11, "{at}");
            if point.kind == PointKind::Fold {
                folds.push((point.value, at));
            }
            if (at - low) * (angle - low) < 0.0 && point.value > 1.5 * least {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })?;
        assert_eq!((end, folds.len()), (BranchEnd::Stopped, 1));
        assert!(
            (folds[0].0 / least - 1.0).abs() < 1e-12,
            "{folds:?} for {least}"
        );
        assert!((folds[0].1 - low).abs() < 1e-7, "{folds:?} for {low}");
        // Nobody stops it: the load grows beyond all bounds at a dead point.
        let end = space.follow(&start, way.points(60), |_| ControlFlow::Continue(()));
        assert_eq!(end, Ok(BranchEnd::Points));
    }
    Ok(())
}

/// Watt's governor with one arm of 0.5 m.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
pub(super) struct Governor {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    shaft: Body,
    #[body(mass = 2.0, inertia = [1e-3, 1e-3, 1e-3], position = [0.4, 0.0, -0.3])]
    ball: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [shaft, ball], point = [0.0, 0.0, 0.0], axis = [0.0, -1.0, 0.0])]
    hinge: Revolute,
}

/// Steady motions along the speed of a shaft.
#[test]
fn a_governor_rises_with_its_speed() -> Result<(), Fault> {
    let (governor, h) = (Governor::default(), Governor::HANDLES);
    let space = governor.coordinates((h.bearing, h.hinge))?;
    let steady = space.equilibrium(&space.state([0.0, 0.0], [6.0, 0.0])?)?;
    let speed = Varied::rate(h.bearing)?;
    for end in [30.0, 4.43] {
        let (why, points) = branch(&space, &steady, Continuation::new(speed, end))?;
        assert_eq!(why, BranchEnd::Reached);
        for point in &points {
            let bodies = point.space.bodies(&point.state);
            let height = -governor.view(0.0, &bodies)?.position(h.ball).z;
            let wanted = 9.81 / (point.value * point.value);
            assert!((height - wanted).abs() < 1e-12, "{}: {height}", point.value);
            assert_eq!(point.space.rates(&point.state)[0], point.value);
            assert_eq!((point.kind, point.unstable), (PointKind::Regular, None));
        }
    }
    let shaft = Continuation::new(Varied::rate(h.hinge)?, 1.0);
    let found = space.follow(&steady, shaft, |_| ControlFlow::Continue(()));
    assert!(
        matches!(
            found,
            Err(Fault::Analysis(AnalysisFault::NotSteady { joint: "hinge" }))
        ),
        "{found:?}"
    );
    Ok(())
}

/// What cannot be followed is refused by name.
#[test]
fn refusals() -> Result<(), Fault> {
    let h = Truss::HANDLES;
    let truss = Truss::new(500.0)?;
    let space = truss.coordinates([h.rail])?;
    let start = space.state([0.0], [0.0])?;
    let follow = |start, way| space.follow(start, way, |_| ControlFlow::Continue(()));
    let way = Continuation::new(h.load, 10.0);
    let setting = follow(&start, way.step(0.0));
    assert!(matches!(
        setting,
        Err(Fault::Start(StartFault::Setting { name: "step", .. }))
    ));
    let none = follow(&start, Continuation::new(h.load, f64::INFINITY));
    assert!(matches!(none, Err(Fault::Parameter(_))), "{none:?}");
    let afar = space.state([5.0], [0.0])?;
    let moving = space.state([0.0], [1.0])?;
    assert_eq!(
        follow(&moving, way),
        Err(Fault::Analysis(AnalysisFault::NotSteady { joint: "rail" }))
    );
    // Of a coordinate on whose position something depends no rate is steady.
    let faster = follow(&start, Continuation::new(Varied::rate(h.rail)?, 2.0));
    assert_eq!(
        faster,
        Err(Fault::Analysis(AnalysisFault::NotSteady { joint: "rail" }))
    );
    let found = follow(&afar, way);
    assert!(
        found == Ok(BranchEnd::Reached)
            || matches!(found, Err(Fault::Step(StepFault::NotConverged { .. })))
    );
    // Unloaded springs hold at any stiffness.
    let stiff = follow(&start, Continuation::new(h.stiffness, 600.0));
    assert_eq!(stiff, Ok(BranchEnd::Reached));
    let still = follow(&start, Continuation::new(h.load, 0.0));
    assert_eq!(still, Ok(BranchEnd::Reached));
    let few = follow(&start, way.step(1e-3).points(5));
    assert_eq!(few, Ok(BranchEnd::Points));
    Ok(())
}
