//! Mechanisms of which redundant equations were left out: the motion is that of the whole, by
//! closed forms and published values.

use core::f64::consts::FRAC_PI_2;

use holonom::joints::{Fixed, OrientationDriver, Revolute};
use holonom::prelude::*;
use holonom::{
    Report, Sample, Warning,
    dynamics::Dynamics,
    mechanism::{Rank, RedundantRow},
};
use holonom_models::Bricard;
use nalgebra::{UnitQuaternion, Vector3};

fn tight() -> DormandPrince<f64> {
    DormandPrince::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-13,
    })
}

/// First row and number of rows of every joint.
fn rows(report: &Report) -> Vec<(usize, usize)> {
    report
        .joints
        .iter()
        .map(|joint| (joint.row, joint.rows))
        .collect()
}

/// A door of 0.8 m x 2 m and 20 kg on two hinges, the edge leaning 10 degrees, released 90 degrees
/// from equilibrium.
#[derive(Mechanism)]
#[mechanism(
    gravity = [0.0, -9.81 * cos(deg(10.0)), -9.81 * sin(deg(10.0))],
    redundant = "drop"
)]
struct Door {
    #[body(
        mass = 20.0,
        inertia = [6.66933333333333, 1.06933333333333, 7.73333333333333],
        position = [0.4, 1.0, 0.0]
    )]
    leaf: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.25, 0.0], axis = [0.0, 1.0, 0.0])]
    lower: Revolute,
    #[joint(between = [ground, leaf], point = [0.0, 1.75, 0.0], axis = [0.0, 1.0, 0.0])]
    upper: Revolute,
}

#[test]
fn a_door_hangs_on_its_lower_hinge() {
    const { assert!(Door::REPORT.equations == 5 && Door::REPORT.degrees_of_freedom == 1) };
    let report = Door::REPORT;
    let (rank, at_start) = (5, 5);
    assert_eq!(report.rank, Rank::Decided { rank, at_start });
    let dropped = [0, 1, 2, 3, 4].map(|row| RedundantRow {
        joint: 1,
        row,
        dropped: true,
    });
    assert_eq!(report.redundant, dropped);
    assert_eq!(rows(&report), [(0, 5), (5, 0)]);
    let door = Door::default();
    let handles = Door::HANDLES;
    let mut last = (0.0, 0.0);
    Simulation::new(&door, StandardLagrange, tight())
        .run(0.0..=10.0, every(1.0), |sample| {
            last = (
                sample.angle(handles.lower),
                sample.angle_rate(handles.lower),
            );
            assert!((sample.angle(handles.upper) - last.0).abs() < 1e-9);
            let reaction = sample
                .reaction(handles.upper, handles.leaf)
                .expect("regular");
            assert_eq!((reaction.force.norm(), reaction.moment.norm()), (0.0, 0.0));
            assert!(!reaction.is_unique);
            ControlFlow::Continue(())
        })
        .expect("independent");
    // problems.md
    assert!(
        (FRAC_PI_2 - last.0 + 1.34374710121287).abs() < 1e-9,
        "{last:?}"
    );
    assert!((-last.1 + 1.19878325592002).abs() < 1e-9, "{last:?}");
}

/// The four-bar of the IFToMM library with spatial hinges: three links of 1 m and 1 kg, 20
/// equations of rank 17.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop")]
struct FourBar {
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 0.001, 1.0 / 12.0],
        position = [0.0, 0.5, 0.0],
        velocity = [0.5, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    left: Body,
    #[body(
        mass = 1.0,
        inertia = [0.001, 1.0 / 12.0, 1.0 / 12.0],
        position = [0.5, 1.0, 0.0],
        velocity = [1.0, 0.0, 0.0]
    )]
    bar: Body,
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 0.001, 1.0 / 12.0],
        position = [1.0, 0.5, 0.0],
        velocity = [0.5, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [left, bar], point = [0.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [bar, right], point = [1.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    c: Revolute,
    #[joint(between = [right, ground], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    d: Revolute,
}

#[test]
fn a_planar_loop_of_spatial_hinges() {
    let report = FourBar::REPORT;
    let (rank, at_start) = (17, 17);
    assert_eq!(report.rank, Rank::Decided { rank, at_start });
    assert_eq!((report.equations, report.degrees_of_freedom), (17, 1));
    assert_eq!(report.redundant.len(), 3);
    assert_eq!(rows(&report), [(0, 5), (5, 5), (10, 5), (15, 2)]);
    for joint in report.joints {
        assert_eq!(joint.undetermined, [2, 3, 4], "{}", joint.name);
    }
    let model = FourBar::default();
    let left = FourBar::HANDLES.left;
    let run = |end: f64, bound: f64| {
        let mut reference = Reference::default();
        Simulation::new(&model, StandardLagrange, tight())
            .run(0.0..=end, every(0.1), |sample| {
                let end = 2.0 * sample.pose(left).position;
                let angle = reference.at(sample.time());
                let error = (end - Vector3::new(angle.sin(), angle.cos(), 0.0)).norm();
                assert!(error < bound, "{error:e} m at {} s", sample.time());
            })
            .expect("independent, or straight on")
    };
    let before = run(0.7, 1e-10);
    assert!(before.worst_violation < 1e-22, "{}", before.worst_violation);
    assert!(before.warnings().is_empty(), "{}", before.warnings());
    // Where all links are in line, the rank is smaller: at 0.708450008835759 s (problems.md) the
    // motion has two ways to go on. It goes straight on, and says so.
    assert!((Reference::default().at(0.708450008835759) - FRAC_PI_2).abs() < 1e-12);
    let through = run(1.0, 1e-9);
    let told = |warning| match warning {
        Warning::NearlySingular { time, .. } => (time - 0.70845).abs() < 1e-3,
        _ => false,
    };
    let warnings = through.warnings();
    assert!(warnings.into_iter().any(told), "{}", through.warnings());
}

/// `J a'' = P g sin a` with `a(0) = 0`, `a'(0) = 1`: the angle of the links from upright.
#[derive(Default)]
struct Reference {
    time: f64,
    motion: Option<[f64; 2]>,
}

impl Reference {
    /// The classical method of order 4, in steps that leave round-off.
    fn at(&mut self, time: f64) -> f64 {
        const STEPS: u32 = 2000;
        let rates = |[angle, rate]: [f64; 2]| [rate, 2.0 * 9.81 / (5.0 / 3.0) * angle.sin()];
        let dt = (time - self.time) / f64::from(STEPS);
        let mut y = self.motion.unwrap_or([0.0, 1.0]);
        for _ in 0..STEPS {
            let moved = |k: [f64; 2], dt: f64| [y[0] + dt * k[0], y[1] + dt * k[1]];
            let k1 = rates(y);
            let k2 = rates(moved(k1, 0.5 * dt));
            let k3 = rates(moved(k2, 0.5 * dt));
            let k4 = rates(moved(k3, dt));
            for k in 0..2 {
                y[k] += dt / 6.0 * (k1[k] + 2.0 * (k2[k] + k3[k]) + k4[k]);
            }
        }
        (self.time, self.motion) = (time, Some(y));
        y[0]
    }
}

/// Bricard's mechanism: 30 equations on 30 velocities, of rank 29.
#[test]
fn a_loop_that_moves_against_the_count() {
    let report = Bricard::REPORT;
    let (rank, at_start) = (29, 29);
    assert_eq!(report.rank, Rank::Decided { rank, at_start });
    assert_eq!((report.equations, report.degrees_of_freedom), (29, 1));
    assert_eq!(report.redundant.len(), 1);
    let model = Bricard::default();
    let second = Bricard::HANDLES.second;
    // problems.md
    let published = [
        (1.0, [0.27448131926, -0.88670793873, -0.46233000269]),
        (2.0, [-0.77813537303, -0.98035268344, -0.19725267062]),
        (5.0, [0.99993274230, -0.99999999774, -6.72554e-5]),
        (10.0, [0.99973098730, -0.99999996383, -2.68976513e-4]),
    ];
    let mut seen = 0;
    Simulation::new(&model, StandardLagrange, tight())
        .run(0.0..=10.0, every(1.0), |sample| {
            let pose = sample.pose(second);
            let turned = UnitQuaternion::new_normalize(pose.orientation);
            let end = pose.position + turned * Vector3::from(Bricard::P3);
            for (time, place) in published {
                if (sample.time() - time).abs() < 1e-9 {
                    let error = (end - Vector3::from(place)).amax();
                    // The last digit that is given.
                    assert!(error < 2e-10, "{error:e} m at {time} s");
                    seen += 1;
                }
            }
            ControlFlow::Continue(())
        })
        .expect("independent all the way");
    assert_eq!(seen, published.len());
}

/// The door without gravity, swung by a motor whose equations of direction follow from those of the
/// hinge.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, 0.0], redundant = "drop")]
struct SwungDoor {
    #[body(
        mass = 20.0,
        inertia = [6.66933333333333, 1.06933333333333, 7.73333333333333],
        position = [0.4, 1.0, 0.0]
    )]
    leaf: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.25, 0.0], axis = [0.0, 1.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, leaf], axis = [0.0, 1.0, 0.0], motion = 0.5 * time * time)]
    motor: OrientationDriver,
}

#[test]
fn the_effort_of_a_driver_is_read_behind_equations_that_were_left_out() {
    let report = SwungDoor::REPORT;
    assert_eq!(rows(&report), [(0, 5), (5, 1)]);
    let door = SwungDoor::default();
    let motor = SwungDoor::HANDLES.motor;
    KinematicAnalysis::new(&door, StandardLagrange)
        .run(0.0_f64..=1.0, every(0.25), |sample| {
            let effort = sample.driving_effort(motor).expect("independent");
            // Moment of inertia about the hinge times an acceleration of 1 rad/s^2.
            let wanted = 1.069_333_333_333_33 + 20.0 * 0.4 * 0.4;
            assert!((effort - wanted).abs() < 1e-12, "{effort}");
            assert!((sample.angle(motor) - 0.5 * sample.time().powi(2)).abs() < 1e-13);
            ControlFlow::Continue(())
        })
        .expect("driven");
}

/// Bennett's linkage: links of 1 m and sqrt(3) m in turn, axes twisted by 30 and 60 degrees, so
/// that lengths are as the sines of the twists.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "drop")]
struct Bennett {
    #[body(mass = 1.0, inertia = [0.1,0.2,0.15], position = [0.1811788772383368, 0.46601954298361314, 0.0])]
    crank: Body,
    #[body(mass = 2.0, inertia = [0.1,0.2,0.15], position = [-0.24385240516492812, 0.3482016910815706, 0.20406650553296318])]
    coupler: Body,
    #[body(mass = 3.0, inertia = [0.1,0.2,0.15], position = [-1.2910566861877038, -0.1178178519020425, 0.20406650553296327])]
    rocker: Body,
    #[joint(between = [ground,crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    j0: Revolute,
    #[joint(between = [crank,coupler], point = [0.3623577544766736, 0.9320390859672263, 0.0], axis = [0.4660195429836131, -0.18117887723833678, 0.8660254037844387])]
    j1: Revolute,
    #[joint(between = [coupler,rocker], point = [-0.8500625648065299, -0.23563570380408505, 0.40813301106592637], axis = [-0.2356357038040849, 0.5295029393094132, 0.8149248139279142])]
    j2: Revolute,
    #[joint(between = [rocker,ground], point = [-1.7320508075688776, 5.551115123125783e-17, 1.6653345369377348e-16], axis = [1.4709794989911964e-16, 0.8660254037844386, 0.5])]
    j3: Revolute,
}

#[test]
fn what_is_left_out_of_bennetts_linkage_is_never_missed() {
    let report = Bennett::REPORT;
    let (rank, at_start) = (17, 17);
    assert_eq!(report.rank, Rank::Decided { rank, at_start });
    assert_eq!((report.equations, report.degrees_of_freedom), (17, 1));
    let linkage = Bennett::default();
    let handles = Bennett::HANDLES;
    // tan(theta_1 / 2) tan(theta_2 / 2) = sin((beta + alpha) / 2) / sin((beta - alpha) / 2),
    // Denavit and Hartenberg's angles.
    let product = (45.0_f64.to_radians()).sin() / (15.0_f64.to_radians()).sin();
    let start = [1.2, 2.0 * (product / (0.6_f64).tan()).atan()];
    let (mut energy, mut turned) = (None, 0.0_f64);
    Simulation::new(
        &linkage,
        Baumgarte {
            alpha: 5.0,
            beta: 5.0,
        },
        tight(),
    )
    .run(0.0_f64..=10.0, every(0.1), |sample| {
        let [one, two] = [
            (start[0] + sample.angle(handles.j0)) / 2.0,
            (start[1] + sample.angle(handles.j1)) / 2.0,
        ];
        let error = one.sin() * two.sin() - product * one.cos() * two.cos();
        assert!(error.abs() < 1e-9, "{error}");
        let now = sample.kinetic_energy() + sample.potential_energy();
        let error = now - *energy.get_or_insert(now);
        assert!(error.abs() < 1e-9, "{error}");
        turned = turned.max(sample.angle(handles.j0).abs());
        ControlFlow::Continue(())
    })
    .expect("regular all along");
    // The crank went past the positions in which the linkage is flat.
    assert!(turned > 2.5, "{turned}");
}

/// Two bodies on two parallel hinges, which are one: it swings about a third one, parallel and
/// askew to all axes. Of the last hinge one equation counts, along a global axis that it passes on
/// the way; its equations of axes hold by themselves, but for round-off.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 1.0], redundant = "drop", coordinates = "both")]
struct Locked {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    a: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [1.0, 0.0, 0.3])]
    b: Body,
    #[joint(between = [ground, a], point = [0.0, 0.2, 0.0], axis = [-0.322, -0.928, 0.186])]
    first: Revolute,
    #[joint(between = [a, b], point = [0.5, 0.3, 0.0], axis = [-0.322, -0.928, 0.186])]
    second: Revolute,
    #[joint(between = [a, b], point = [0.7, -0.4, 0.0], axis = [-0.322, -0.928, 0.186])]
    third: Revolute,
}

/// The same, welded.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 1.0])]
struct Welded {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    a: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [1.0, 0.0, 0.3])]
    b: Body,
    #[joint(between = [ground, a], point = [0.0, 0.2, 0.0], axis = [-0.322, -0.928, 0.186])]
    first: Revolute,
    #[joint(between = [a, b], point = [0.5, 0.3, 0.0])]
    second: Fixed,
}

#[test]
fn equations_that_hold_but_for_round_off_are_not_the_ones_that_are_kept() {
    let mut welded = 0.0;
    Simulation::new(&Welded::default(), StandardLagrange, tight())
        .run(0.0..=2.0, every(1.0), |sample| {
            welded = sample.angle(Welded::HANDLES.first);
            ControlFlow::Continue(())
        })
        .expect("nothing stops it");
    let locked = Locked::default();
    for by_joints in [false, true] {
        let mut angle = 0.0;
        let observe = |sample: &Sample<'_, f64, Locked>| {
            angle = sample.angle(Locked::HANDLES.first);
            assert!(sample.angle(Locked::HANDLES.second).abs() < 1e-9);
            ControlFlow::Continue(())
        };
        let run = Simulation::new(&locked, StandardLagrange, Rk4::every(1e-3));
        let report = if by_joints {
            run.joint_coordinates().run(0.0..=2.0, every(0.1), observe)
        } else {
            run.run(0.0..=2.0, every(0.1), observe)
        };
        report.expect("nothing stops it");
        assert!((angle - welded).abs() < 1e-8, "{angle} for {welded}");
    }

    let joints = Dynamics::<Problem<_, _>>::new(&locked, StandardLagrange)
        .expect("it is sound")
        .joint_coordinates();
    let start = joints.initial_state().expect("it is sound");
    let (evaluation, _) = joints.evaluate(0.0, &start).expect("it is regular");
    let [first, second] = *evaluation.rates.rates();
    // Rates of both bodies, against the ground: that of the weld.
    assert!((first - second).abs() < 1e-9 && (first.abs() - 1.211_045).abs() < 1e-5);
    assert!(evaluation.multipliers.as_slice()[0].abs() < 100.0);
}

/// A locked loop as above, and a pendulum that has nothing to do with it.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Apart {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    a: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    b: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [2.0, 0.0, 0.0])]
    alone: Body,
    #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    first: Revolute,
    #[joint(between = [a, b], point = [0.5, 0.3, 0.0], axis = [0.0, 0.0, 1.0])]
    second: Revolute,
    #[joint(between = [a, b], point = [0.7, -0.4, 0.0], axis = [0.0, 0.0, 1.0])]
    third: Revolute,
    #[joint(between = [ground, alone], point = [1.5, 0.0, 0.0], axis = [1.0, 0.2, 0.3])]
    pendulum: Revolute,
}

#[test]
fn of_a_locked_loop_nothing_else_is_left_out() {
    let left_out = Apart::REPORT.redundant.iter().filter(|row| row.dropped);
    let joints: Vec<&str> = left_out
        .map(|row| Apart::REPORT.joints[row.joint].name)
        .collect();
    assert_eq!(joints.len(), 4);
    assert!(
        joints
            .iter()
            .all(|joint| ["second", "third"].contains(joint)),
        "{joints:?}"
    );
    let mut worst = 0.0_f64;
    Simulation::new(&Apart::default(), StandardLagrange, Rk4::every(1e-3))
        .run(0.0..=1.0, every(0.1), |sample| {
            let angle: f64 = sample.angle(Apart::HANDLES.second);
            worst = worst.max(angle.abs());
            ControlFlow::Continue(())
        })
        .expect("nothing stops it");
    assert!(worst < 1e-9, "{worst:e}");
}

/// A four-bar in the plane y = 0 of a base that turns about z, with hinges only.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", redundant = "drop")]
struct Slewing {
    #[body(mass = 3.0, inertia = [0.2, 0.3, 0.25], orientation = rotation([0.0, 0.0, 1.0], 0.4))]
    base: Body,
    #[body(mass = 0.5, inertia = [0.003, 0.003, 0.001], position = [0.0, 0.0, 0.15])]
    crank: Body,
    #[body(mass = 0.8, inertia = [0.002, 0.02, 0.02], position = [0.25, 0.0, 0.35])]
    rod: Body,
    #[body(mass = 0.6, inertia = [0.005, 0.005, 0.001], position = [0.5, 0.0, 0.2])]
    rocker: Body,
    #[joint(between = [ground, base], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    slew: Revolute,
    #[joint(between = [base, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    a: Revolute,
    #[joint(between = [crank, rod], point = [0.0, 0.0, 0.3], axis = [0.0, 1.0, 0.0])]
    b: Revolute,
    #[joint(between = [rod, rocker], point = [0.5, 0.0, 0.4], axis = [0.0, 1.0, 0.0])]
    c: Revolute,
    #[joint(between = [base, rocker], point = [0.5, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    d: Revolute,
}

/// Energy and momentum about the axis of the base, by hand, and how far the loop is open.
fn kept_of_slewing(sample: &Sample<'_, f64, Slewing>) -> ([f64; 2], f64) {
    let h = Slewing::HANDLES;
    let bodies = [
        (h.base, 3.0, [0.2, 0.3, 0.25]),
        (h.crank, 0.5, [0.003, 0.003, 0.001]),
        (h.rod, 0.8, [0.002, 0.02, 0.02]),
        (h.rocker, 0.6, [0.005, 0.005, 0.001]),
    ];
    let (mut energy, mut momentum) = (0.0, 0.0);
    for (body, mass, inertia) in bodies {
        let pose = sample.pose(body);
        let velocity = sample.velocity(body);
        let spin = sample.angular_velocity(body);
        let own = Vector3::from(inertia).component_mul(&spin);
        energy += 0.5 * (mass * velocity.norm_squared() + spin.dot(&own));
        energy += mass * 9.81 * pose.position.z;
        let turned = UnitQuaternion::new_unchecked(pose.orientation) * own;
        momentum += mass * pose.position.cross(&velocity).z + turned.z;
    }
    let ends = [
        sample.point(h.rod, Vector3::new(0.25, 0.0, 0.05)),
        sample.point(h.rocker, Vector3::new(0.0, 0.0, 0.2)),
    ];
    ([energy, momentum], (ends[0] - ends[1]).norm())
}

/// Two freedoms, and two numbers that are kept: they determine the motion.
#[test]
fn a_loop_whose_plane_turns_stays_closed() {
    let (slewing, handles) = (Slewing::default(), Slewing::HANDLES);
    let mut start = slewing.described_state::<f64>().expect("described");
    slewing
        .set_angle_rate(&mut start, handles.slew, 2.0)
        .expect("free");
    let mut ends = Vec::new();
    let mut first = None;
    let mut see = |sample: &Sample<'_, f64, Slewing>| {
        let ([energy, momentum], open) = kept_of_slewing(sample);
        let [e, m] = *first.get_or_insert([energy, momentum]);
        assert!((energy - e).abs() < 1e-8, "{energy} for {e}");
        assert!((momentum - m).abs() < 1e-8, "{momentum} for {m}");
        assert!(open < 1e-9, "{open}");
        if sample.time() == 4.0 {
            ends.push([sample.angle_rate(handles.slew), sample.angle(handles.a)]);
        }
    };
    let simulation = || {
        Simulation::new(&slewing, StandardLagrange, tight())
            .initial_state(start)
            .projection(Projection::default())
    };
    let joints = simulation().joint_coordinates();
    let joints = joints
        .run(0.0..=4.0, every(0.25), &mut see)
        .expect("regular");
    let bodies = simulation().absolute_coordinates();
    let bodies = bodies
        .run(0.0..=4.0, every(0.25), &mut see)
        .expect("regular");
    assert_eq!(joints.warnings().to_string(), "no warnings");
    assert_eq!(bodies.warnings().to_string(), "no warnings");
    let [[rate, angle], [same_rate, same_angle]] = ends[..] else {
        panic!("{ends:?}")
    };
    assert!((rate - same_rate).abs() < 1e-8 && (angle - same_angle).abs() < 1e-8);
}
