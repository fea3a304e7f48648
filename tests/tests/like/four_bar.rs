//! The planar four-bar: four hinges, four lengths.

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{JointCoordinates, dynamics::Dynamics, mechanism::Rank};
use holonom_tests::is_exhaustive;

use super::twins::{difference, move_alike, runs};

/// A four-bar in the plane z = 0 whose crank and rocker are described upright: crank, coupler,
/// rocker and base (m), and what stands above them.
macro_rules! four_bar {
    ($(#[$meta:meta])* $name:ident { $($fields:tt)* } $crank:expr, $coupler:expr, $rocker:expr, $base:expr) => {
        $(#[$meta])*
        #[derive(Mechanism)]
        #[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "joints")]
        pub(crate) struct $name {
            $($fields)*
            #[body(mass = 0.5, inertia = [0.0026, 1e-5, 0.0026], position = [0.0, 0.5 * $crank, 0.0])]
            crank_body: Body,
            #[body(mass = 1.6, inertia = [1e-5, 0.0853, 0.0853], position = [0.5 * $coupler, $crank, 0.0])]
            coupler_body: Body,
            #[body(mass = 1.2, inertia = [0.036, 1e-5, 0.036], position = [$base, 0.5 * $rocker, 0.0])]
            rocker_body: Body,
            #[joint(between = [ground, crank_body], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            o: Revolute,
            #[joint(between = [crank_body, coupler_body], point = [0.0, $crank, 0.0], axis = [0.0, 0.0, 1.0])]
            a: Revolute,
            #[joint(
                between = [coupler_body, rocker_body],
                point = local([0.5 * $coupler, 0.0, 0.0], [0.0, 0.5 * $rocker, 0.0]),
                axis = [0.0, 0.0, 1.0]
            )]
            b: Revolute,
            #[joint(between = [ground, rocker_body], point = [$base, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            c: Revolute,
        }
    };
}

four_bar! {
    /// All four are parameters.
    FourBar {
        #[param(like = 0.25)]
        crank: f64,
        #[param(like = 0.9)]
        coupler: f64,
        #[param(like = 0.6)]
        rocker: f64,
        #[param(like = 0.9)]
        base: f64,
    } crank, coupler, rocker, base
}
four_bar! {
    /// As the parameters are like.
    Likes {} 0.25, 0.9, 0.6, 0.9
}
four_bar! {
    /// Other lengths.
    Others {} 0.3, 1.1, 0.85, 1.2
}

four_bar! {
    /// Only the base is a parameter: no gradient of a closing equation depends on it.
    Based {
        #[param(like = 0.9)]
        base: f64,
    } 0.6, 0.9, 0.25, base
}

/// Which velocities follow from which, and never fail to, depends on where a linkage gets to: with
/// the base that is said the rocker turns round, with another one all links do.
#[test]
fn where_it_gets_to_is_not_decided_by_likes() -> Result<(), Fault> {
    const { assert!(!Based::JOINT_REPORT.determines) };
    for base in [0.9, 0.2, 0.5] {
        let [bodies, joints] = runs(&Based::new(base)?, (1e-3, 2000))?;
        let far = difference(&bodies, &joints);
        assert!(far < 1e-6, "{base}: {far:e}");
    }
    Ok(())
}

#[test]
fn what_is_decided_is_what_is_decided_of_literals() {
    assert_eq!(
        FourBar::REPORT.rank,
        Rank::Decided {
            rank: 17,
            at_start: 17
        }
    );
    assert_eq!(FourBar::REPORT.degrees_of_freedom, 1);
    let FourBar {
        crank,
        coupler,
        rocker,
        base,
        ..
    } = FourBar::default();
    assert_eq!([crank, coupler, rocker, base], [0.25, 0.9, 0.6, 0.9]);
}

#[test]
fn it_moves_as_one_of_literals_does() {
    let run = (1e-3, 100);
    move_alike(&FourBar::default(), &Likes::default(), run);
    let given = FourBar::new(0.3, 1.1, 0.85, 1.2).expect("sound");
    move_alike(&given, &Others::default(), run);
    // Parameters are fields, too.
    let given = FourBar {
        crank: 0.3,
        coupler: 1.1,
        rocker: 0.85,
        base: 1.2,
        ..FourBar::default()
    };
    move_alike(&given, &Others::default(), run);
}

/// The angles of the rocker, against the base, that close the loop at an angle of the crank
/// (Freudenstein 1955).
fn freudenstein([a, b, c, d]: [f64; 4], crank: f64) -> [f64; 2] {
    let (k1, k2) = (d / a, d / c);
    let k3 = (a * a - b * b + c * c + d * d) / (2.0 * a * c);
    let (sine, cosine) = crank.sin_cos();
    let p = cosine - k1 - k2 * cosine + k3;
    let q = -2.0 * sine;
    let r = k1 - (k2 + 1.0) * cosine + k3;
    let root = (q * q - 4.0 * p * r).max(0.0).sqrt();
    [-1.0, 1.0].map(|sign| 2.0 * (-q + sign * root).atan2(2.0 * p))
}

/// The branch: on which side of the line from the rocker's foot to the crank's end the rocker is.
fn is_open([a, _, _, d]: [f64; 4], crank: f64, rocker: f64) -> bool {
    let (sine, cosine) = crank.sin_cos();
    let (x, y) = (a * cosine - d, a * sine);
    x * rocker.sin() - y * rocker.cos() > 0.0
}

/// Whole turns aside.
fn apart(a: f64, b: f64) -> f64 {
    (a - b).sin().atan2((a - b).cos()).abs()
}

/// Numbers between 0 and 1 (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Lengths of a linkage of which the shortest link turns round: Grashof's, and not nearly a
    /// change point.
    fn grashof(&mut self) -> [f64; 4] {
        loop {
            let lengths = [0; 4].map(|_| 0.1 + 1.4 * self.number());
            let sum: f64 = lengths.iter().sum();
            let least = lengths.iter().copied().fold(f64::INFINITY, f64::min);
            let most = lengths.iter().copied().fold(0.0, f64::max);
            if least + most < 0.48 * sum {
                return lengths;
            }
        }
    }
}

/// A linkage, and its state at the end of a sweep from the lengths that are typical, each assembled
/// from the one before.
fn reached(lengths: [f64; 4]) -> Result<(FourBar, <FourBar as Mechanism>::State<f64>), Fault> {
    const STEPS: u32 = 10;
    const TYPICAL: [f64; 4] = [0.25, 0.9, 0.6, 0.9];
    let mut linkage = FourBar::default();
    let mut state = linkage.described_state::<f64>()?;
    for step in 0..=STEPS {
        let part = f64::from(step) / f64::from(STEPS);
        let [a, b, c, d] = std::array::from_fn(|k| TYPICAL[k] + part * (lengths[k] - TYPICAL[k]));
        linkage = FourBar::new(a, b, c, d)?;
        linkage.assemble(0.0, &mut state)?;
    }
    Ok((linkage, state))
}

#[test]
fn linkages_of_all_lengths_move_as_freudenstein_says() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let handles = FourBar::HANDLES;
    let upright = std::f64::consts::FRAC_PI_2;
    for number in 0..if is_exhaustive() { 1000 } else { 250 } {
        let lengths = random.grashof();
        let [a, b, c, d] = lengths;
        let (linkage, start) =
            reached(lengths).unwrap_or_else(|error| panic!("{number}: {lengths:?}: {error}"));
        // As described, and after a run, in which the branch stays what it is.
        let simulation = || {
            let projection = Projection {
                tolerance: 1e-12,
                ..Projection::default()
            };
            Simulation::new(&linkage, StandardLagrange, Rk4::every(0.01))
                .initial_state(start)
                .projection(projection)
        };
        let ignore = |_: &Sample<'_, f64, FourBar>| ControlFlow::Continue(());
        let by_bodies = simulation()
            .absolute_coordinates()
            .run(0.0..=0.3, every(0.3), ignore);
        let by_joints = simulation()
            .joint_coordinates()
            .run(0.0..=0.3, every(0.3), ignore);
        let ends = [by_bodies, by_joints].map(|report| {
            let report = report.unwrap_or_else(|error| panic!("{number}: {lengths:?}: {error}"));
            report.state
        });
        let dynamics = Dynamics::new(&linkage, StandardLagrange)
            .expect("sound")
            .joint_coordinates();
        let by_joints = dynamics.bodies(&dynamics.state_of(&start).expect("assembled"));
        let mut branches = Vec::new();
        for state in [start, by_joints, ends[0], ends[1]] {
            let view = dynamics.view(0.0, &state);
            let crank = upright + view.angle(handles.o);
            let rocker = upright + view.angle(handles.c);
            let errors = freudenstein(lengths, crank).map(|angle| apart(angle, rocker));
            let error = errors[0].min(errors[1]);
            assert!(error < 1e-9, "{number}: {lengths:?}: {error:e}");
            branches.push(is_open(lengths, crank, rocker));
        }
        // Where the crank turns round, no motion leads from one branch to the other.
        let turns = a.min(d) < b.min(c);
        assert!(
            !turns || branches.iter().all(|branch| *branch == branches[0]),
            "{number}: {lengths:?}: {branches:?}"
        );
    }
}
