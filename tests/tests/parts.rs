//! Parts: what an assembly describes is the same wherever it is, and its mirror image moves as the
//! image does.

use holonom::nalgebra::{Matrix3, Rotation3, UnitVector3, Vector3};
use holonom::prelude::*;

holonom::joint! {
    /// A runner on a wave beside a shaft. A cross product says on which side the wave is: in the
    /// mirror `axis` is turned round, and `side` is not.
    joint Wave(i, j; foot: Point, point: Point, axis: Axis, side: Axis, offset: Length, rise: Length) {
        let arm = j.point - i.foot;
        dot(i.axis.normals(), j.axis);
        dot(i.side, arm) - offset;
        dot(cross(i.axis, i.side), arm) - rise * (1.0 - cos(3.0 * dot(i.axis, arm)));
    }
}

/// Nearly every kind of joint and force on one port, with all that a body may be described by.
#[derive(Assembly, Clone, Copy)]
struct Machine {
    #[port]
    frame: Body,
    #[param(like = 0.3)]
    reach: f64,
    #[input]
    torque: f64,
    #[body(
        shape = cylinder(radius = 0.05, from = [0.0, 0.0, 0.0], to = [0.1, 0.2, 0.3]), density = 700.0,
        angular_velocity = [0.0, 0.0, 0.0]
    )]
    base: Body,
    #[joint(between = [frame, base], point = [0.0, 0.0, 0.0], axis = [0.2, -0.3, 1.0])]
    hinge: Revolute,
    #[force(between = [frame, base], axis = [0.2, -0.3, 1.0], stiffness = 3.0, damping = 0.1, free_angle = 0.4)]
    torsion: TorsionalSpringDamper,
    #[body(
        mass = 0.8, inertia = [[0.02, 0.003, -0.002], [0.003, 0.03, 0.004], [-0.002, 0.004, 0.025]],
        orientation = rotation([1.0, 2.0, 3.0], 0.5), position = [reach, 0.2, 0.3]
    )]
    arm: Body,
    #[joint(between = [base, arm], point = [0.1, 0.2, 0.3], axis = [1.0, 0.1, 0.3])]
    slide: Prismatic,
    #[force(between = [frame, arm], head = [0.0, -0.5, 0.1], tail = [0.3, 0.2, 0.3], stiffness = 40.0, damping = 0.5, free_length = 0.6)]
    spring: SpringDamper,
    #[body(mass = 0.5, inertia = [0.01, 0.012, 0.009], position = [0.4, 0.25, 0.35])]
    wrist: Body,
    #[joint(between = [arm, wrist], point = [0.35, 0.2, 0.3], axis_i = [0.0, 1.0, 0.2], axis_j = [1.0, 0.0, 0.0])]
    cross: Universal,
    #[body(mass = 0.3, inertia = [0.004, 0.005, 0.006], position = [0.5, 0.3, 0.4], angular_velocity = [1.0, -2.0, 3.0])]
    end: Body,
    #[joint(between = [wrist, end], point = [0.45, 0.3, 0.35])]
    ball: Spherical,
    #[body(
        mass = 0.2, inertia = [0.001, 0.002, 0.002], inertia_axes = rotation([0.0, 1.0, 0.0], 0.3), position = [0.2, 0.0, 0.1]
    )]
    sleeve: Body,
    #[joint(between = [base, sleeve], point = [0.2, 0.0, 0.1], axis = [0.0, 0.3, 1.0])]
    rod: Cylindrical,
    #[body(mass = 0.4, inertia = [0.002, 0.002, 0.004], position = [-0.1, 0.1, 0.0])]
    wheel: Body,
    #[joint(between = [frame, wheel], point = [-0.1, 0.1, 0.0], axis = [0.1, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [base, wheel, frame], axis_i = [0.2, -0.3, 1.0], axis_j = [0.1, 0.0, 1.0], ratio = -1.5)]
    gears: Gear,
    #[force(between = [frame, wheel], axis = [0.1, 0.0, 1.0], moment = torque - 0.05 * rate)]
    motor: TorsionalActuator,
    #[force(between = [frame, end], point = [0.5, 0.3, 0.4], force = [0.3, -0.2, 0.4])]
    push: PointForce,
    #[force(between = [end], point = [0.5, 0.3, 0.45], force = [0.1, 0.2, -0.1])]
    thrust: FollowerForce,
    #[force(between = [frame, wrist], moment = [0.02, 0.01, -0.03])]
    twist: ConstantMoment,
    #[force(between = [end], moment = [0.01, -0.02, 0.015])]
    spin: FollowerMoment,
    #[body(mass = 0.3, inertia = [0.003, 0.004, 0.005], position = [-0.4, 0.1, 0.1])]
    runner: Body,
    #[joint(
        between = [frame, runner], foot = [-0.4, 0.0, 0.1], point = [-0.4, 0.1, 0.1], axis = [1.0, 0.0, 0.2],
        side = [0.0, 1.0, 0.0], offset = 0.1, rise = 0.2
    )]
    wave: Wave,
    #[body(mass = 0.1, position = [0.2, -0.3, 0.5])]
    bead: Particle,
    #[joint(between = [frame, bead], point = [0.2, -0.3, 0.5], axis = [0.3, 1.0, 0.2])]
    wire: PointOnLine,
    #[body(mass = 0.6, inertia = [0.006, 0.007, 0.008], position = [0.0, -0.2, -0.1], orientation = rpy(0.1, 0.2, 0.3))]
    table: Body,
    #[joint(between = [frame, table], point = [0.0, -0.2, -0.1], normal = [0.1, 0.2, 1.0])]
    plane: Planar,
    #[joint(between = [frame, table], axis = [0.1, 0.2, 1.0], motion = 0.3 * sin(2.0 * time))]
    driver: AngleDriver,
}

/// The machine by itself.
#[derive(Mechanism)]
#[mechanism(gravity = [1.0, -2.0, -9.0], coordinates = "both")]
struct Alone {
    #[part(frame = ground)]
    machine: Machine,
}

/// Seen in a mirror across y, turned by a right angle and moved, beside itself.
#[derive(Mechanism)]
#[mechanism(gravity = [-2.0, 1.0, -9.0], coordinates = "both")]
struct Seen {
    #[part(frame = ground, mirror = y, rotation = rotation([0.0, 0.0, 1.0], deg(90.0)), at = [0.7, -0.3, 0.2])]
    machine: Machine,
}

/// Within parts of parts: a mirror in a mirror, turned anyhow, without gravity.
#[derive(Assembly, Clone, Copy)]
struct Boxed {
    #[port]
    wall: Body,
    #[param(like = 0.1)]
    height: f64,
    #[part(frame = wall, mirror = x, rotation = rotation([1.0, 2.0, 3.0], 0.7), at = [0.1, 0.2, height])]
    machine: Machine,
}

#[derive(Mechanism)]
struct Nested {
    #[part(wall = ground, mirror = z, rotation = rpy(0.3, -0.4, 1.2), at = [1.0, 0.5, 0.0])]
    case: Boxed,
}

/// The machine without gravity.
#[derive(Mechanism)]
struct Weightless {
    #[part(frame = ground)]
    machine: Machine,
}

/// Where a part is, by matrices.
struct Image {
    matrix: Matrix3<f64>,
    at: Vector3<f64>,
}

impl Image {
    fn new(mirror: Option<usize>, rotation: Rotation3<f64>, at: Vector3<f64>) -> Self {
        let mut matrix = rotation.into_inner();
        if let Some(axis) = mirror {
            matrix.column_mut(axis).neg_mut();
        }
        Self { matrix, at }
    }

    fn of(&self, inner: &Self) -> Self {
        Self {
            matrix: self.matrix * inner.matrix,
            at: self.at + self.matrix * inner.at,
        }
    }
}

/// What is read of a machine: angles and displacements, centres of mass, an energy.
type Course = Vec<(Vec<f64>, Vec<Vector3<f64>>)>;

/// Reads a machine of a mechanism by the handles at a place.
macro_rules! course {
    ($mechanism:expr, $handles:expr $(, $joints:ident)?) => {{
        let mechanism = $mechanism;
        let mut course: Course = Vec::new();
        let simulation = Simulation::new(&mechanism, StandardLagrange, Rk4::every(0.005));
        let simulation = simulation.assembled().projection(Projection::default());
        $(let simulation = simulation.$joints();)?
        simulation
            .run(0.0_f64..=0.5, every(0.05), |sample| -> Result<(), Fault> {
                let h = $handles;
                let mut scalars = vec![
                    sample.angle(h.hinge),
                    sample.displacement(h.slide),
                    sample.displacement(h.rod),
                    sample.angle(h.bearing),
                    sample.displacement(h.wire),
                    sample.driving_effort(h.driver)?,
                ];
                scalars.push(sample.reaction(h.ball, h.end)?.force.norm());
                scalars.push(sample.reaction(h.hinge, h.base)?.moment.norm());
                let centres = [h.base, h.arm, h.wrist, h.end, h.sleeve, h.wheel, h.bead, h.table, h.runner,];
                course.push((scalars, centres.map(|body| sample.pose(body).position).to_vec()));
                Ok(())
            })
            .unwrap();
        course
    }};
}

fn agree(course: &Course, original: &Course, image: &Image, tolerance: f64) {
    assert_eq!(course.len(), original.len());
    let moved = |course: &Course| (course[0].1[3] - course[course.len() - 1].1[3]).norm();
    assert!(moved(original) > 0.01, "nothing moves");
    for (own, other) in course.iter().zip(original) {
        for (place, (a, b)) in own.0.iter().zip(&other.0).enumerate() {
            assert!(
                (a - b).abs() < tolerance * (1.0 + b.abs()),
                "{place}: {a} {b}"
            );
        }
        for (place, (a, b)) in own.1.iter().zip(&other.1).enumerate() {
            let b = image.matrix * b + image.at;
            assert!((a - b).norm() < tolerance, "{place}: {a} {b}");
        }
    }
}

fn machine() -> Machine {
    let mut machine = Machine::new(0.32);
    machine.torque = 0.2;
    machine
}

#[test]
fn a_mirrored_part_moves_as_its_mirror_image() {
    let z = UnitVector3::new_normalize(Vector3::z());
    let turn = Rotation3::from_axis_angle(&z, std::f64::consts::FRAC_PI_2);
    let image = Image::new(Some(1), turn, Vector3::new(0.7, -0.3, 0.2));
    let alone = Alone::new(machine()).unwrap();
    let original = course!(alone, Alone::HANDLES.machine);
    let seen = Seen::new(machine()).unwrap();
    agree(
        &course!(seen, Seen::HANDLES.machine),
        &original,
        &image,
        1e-11,
    );
    let alone = Alone::new(machine()).unwrap();
    let original = course!(alone, Alone::HANDLES.machine, joint_coordinates);
    let seen = Seen::new(machine()).unwrap();
    let joints = course!(seen, Seen::HANDLES.machine, joint_coordinates);
    agree(&joints, &original, &image, 1e-11);
}

#[test]
fn parts_of_parts_are_where_both_say() {
    let original = course!(
        Weightless::new(machine()).unwrap(),
        Weightless::HANDLES.machine
    );
    let case = Boxed::new(0.15, machine());
    let nested = Nested::new(case).unwrap();
    let course = course!(nested, Nested::HANDLES.case.machine);
    let axis = UnitVector3::new_normalize(Vector3::new(1.0, 2.0, 3.0));
    let turn = Rotation3::from_axis_angle(&axis, 0.7);
    let inner = Image::new(Some(0), turn, Vector3::new(0.1, 0.2, 0.15));
    let outer = Rotation3::from_euler_angles(0.3, -0.4, 1.2);
    let image = Image::new(Some(2), outer, Vector3::new(1.0, 0.5, 0.0)).of(&inner);
    agree(&course, &original, &image, 1e-10);
}

#[test]
fn fields_of_parts_have_the_name_of_the_part_before_their_own() {
    assert_eq!(Alone::REPORT.bodies[0].name, "machine.base");
    assert_eq!(Nested::REPORT.bodies[0].name, "case.machine.base");
    assert_eq!(axle::Axle::REPORT.bodies[4].name, "sides[1].lower");
    let default = Nested::default().case;
    assert_eq!([default.height, default.machine.reach], [0.1, 0.3]);
}

/// The front axle of `newcomer` tasks: by parts, and by arrays of two.
mod axle {
    use super::*;

    #[derive(Assembly)]
    struct Suspension {
        #[port]
        chassis: Body,
        #[body(mass = 3.0, inertia = [0.05, 0.05, 0.05], position = [0.0, 0.5, 0.2])]
        lower: Body,
        #[body(mass = 2.0, inertia = [0.03, 0.03, 0.03], position = [0.0, 0.52, 0.45])]
        upper: Body,
        #[body(mass = 25.0, inertia = [0.5, 0.8, 0.5], position = [0.0, 0.75, 0.3])]
        knuckle: Body,
        #[joint(between = [chassis, lower], point = [0.0, 0.3, 0.2], axis = [1.0, 0.0, 0.0])]
        lower_hinge: Revolute,
        #[joint(between = [chassis, upper], point = [0.0, 0.35, 0.45], axis = [1.0, 0.05, -0.02])]
        upper_hinge: Revolute,
        #[joint(between = [lower, knuckle], point = [0.0, 0.7, 0.18])]
        lower_ball: Spherical,
        #[joint(between = [upper, knuckle], point = [-0.02, 0.68, 0.44])]
        upper_ball: Spherical,
        #[joint(between = [chassis, knuckle], head = [-0.12, 0.32, 0.25], tail = [-0.12, 0.69, 0.25])]
        tie_rod: Distance,
        #[force(between = [lower, chassis], head = [0.0, 0.55, 0.2], tail = [0.0, 0.4, 0.65], stiffness = 30e3, damping = 2e3, free_length = 0.55)]
        strut: SpringDamper,
        #[force(between = [ground, knuckle], head = [0.0, 0.75, -10.0], tail = [0.0, 0.75, 0.3], stiffness = 200e3, damping = 300.0, free_length = 10.32)]
        tyre: SpringDamper,
    }

    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    pub(super) struct Axle {
        #[body(mass = 400.0, inertia = [80.0, 200.0, 220.0], position = [0.0, 0.0, 0.5])]
        chassis: Body,
        #[joint(between = [ground, chassis], point = [0.0, 0.0, 0.5], axis = [0.0, 0.0, 1.0])]
        heave: Prismatic,
        #[part(chassis = chassis, mirror = if k == 0 { none } else { y })]
        sides: [Suspension; 2],
    }

    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    struct ByArrays {
        #[body(mass = 400.0, inertia = [80.0, 200.0, 220.0], position = [0.0, 0.0, 0.5])]
        chassis: Body,
        #[joint(between = [ground, chassis], point = [0.0, 0.0, 0.5], axis = [0.0, 0.0, 1.0])]
        heave: Prismatic,
        #[body(mass = 3.0, inertia = [0.05, 0.05, 0.05], position = [0.0, (1.0 - 2.0 * k) * 0.5, 0.2])]
        lower: [Body; 2],
        #[body(mass = 2.0, inertia = [0.03, 0.03, 0.03], position = [0.0, (1.0 - 2.0 * k) * 0.52, 0.45])]
        upper: [Body; 2],
        #[body(mass = 25.0, inertia = [0.5, 0.8, 0.5], position = [0.0, (1.0 - 2.0 * k) * 0.75, 0.3])]
        knuckle: [Body; 2],
        #[joint(between = [chassis, lower[k]], point = [0.0, (1.0 - 2.0 * k) * 0.3, 0.2], axis = [1.0, 0.0, 0.0])]
        lower_hinge: [Revolute; 2],
        #[joint(between = [chassis, upper[k]], point = [0.0, (1.0 - 2.0 * k) * 0.35, 0.45], axis = [1.0, (1.0 - 2.0 * k) * 0.05, -0.02])]
        upper_hinge: [Revolute; 2],
        #[joint(between = [lower[k], knuckle[k]], point = [0.0, (1.0 - 2.0 * k) * 0.7, 0.18])]
        lower_ball: [Spherical; 2],
        #[joint(between = [upper[k], knuckle[k]], point = [-0.02, (1.0 - 2.0 * k) * 0.68, 0.44])]
        upper_ball: [Spherical; 2],
        #[joint(between = [chassis, knuckle[k]], head = [-0.12, (1.0 - 2.0 * k) * 0.32, 0.25], tail = [-0.12, (1.0 - 2.0 * k) * 0.69, 0.25])]
        tie_rod: [Distance; 2],
        #[force(between = [lower[k], chassis], head = [0.0, (1.0 - 2.0 * k) * 0.55, 0.2], tail = [0.0, (1.0 - 2.0 * k) * 0.4, 0.65], stiffness = 30e3, damping = 2e3, free_length = 0.55)]
        strut: [SpringDamper; 2],
        #[force(between = [ground, knuckle[k]], head = [0.0, (1.0 - 2.0 * k) * 0.75, -10.0], tail = [0.0, (1.0 - 2.0 * k) * 0.75, 0.3], stiffness = 200e3, damping = 300.0, free_length = 10.32)]
        tyre: [SpringDamper; 2],
    }

    #[test]
    fn an_axle_of_parts_is_the_axle_by_arrays() {
        let (parts, arrays) = (Axle::default(), ByArrays::default());
        let (a, b) = (Axle::HANDLES, ByArrays::HANDLES);
        let operations = |report: &holonom::Report| {
            let kernels = report.kernels.iter();
            kernels
                .map(|kernel| (kernel.name, kernel.operations.total()))
                .collect::<Vec<_>>()
        };
        let mut heights = Vec::new();
        let settings = |t| Rk4::every(t);
        Simulation::new(&parts, Baumgarte::of(&parts).unwrap(), settings(0.002))
            .run(0.0_f64..=1.0, every(0.1), |sample| {
                let knuckles = a.sides.map(|side| sample.pose(side.knuckle).position);
                heights.push((sample.displacement(a.heave), knuckles));
                ControlFlow::<()>::Continue(())
            })
            .unwrap();
        let mut heights = heights.into_iter();
        Simulation::new(&arrays, Baumgarte::of(&arrays).unwrap(), settings(0.002))
            .run(0.0_f64..=1.0, every(0.1), |sample| {
                let (heave, knuckles) = heights.next().unwrap();
                assert!((heave - sample.displacement(b.heave)).abs() < 1e-12);
                for (own, body) in knuckles.iter().zip(b.knuckle) {
                    assert!((own - sample.pose(body).position).norm() < 1e-12);
                }
                ControlFlow::<()>::Continue(())
            })
            .unwrap();
        // The order of the bodies is another one: no more than a few operations.
        let (own, other) = (operations(&Axle::REPORT), operations(&ByArrays::REPORT));
        for ((name, own), (_, other)) in own.iter().zip(&other) {
            assert!(own.abs_diff(*other) <= other / 50, "{name}: {own} {other}");
        }
    }
}

/// Lengths of arrays by a constant, which counts in attributes too.
mod lengths {
    use super::*;

    const LINKS: usize = 3;

    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81], LINKS = 3)]
    struct Chain {
        #[body(mass = 1.0 / LINKS, inertia = [0.01, 0.01, 0.01], position = [(k + 0.5) / LINKS, 0.0, 0.0])]
        links: [Body; LINKS],
        #[joint(
            between = [if k == 0 { ground } else { links[k - 1] }, links[k]], point = [k / LINKS, 0.0, 0.0], axis = [0.0, 1.0, 0.0]
        )]
        hinges: [Revolute; LINKS],
        #[body(mass = 0.1, position = [1.0 / LINKS, 0.0, LINKS])]
        bead: Particle,
        #[joint(between = [ground, bead], head = [0.0, 0.0, LINKS], tail = [1.0 / LINKS, 0.0, LINKS])]
        wire: Distance,
    }

    #[test]
    fn a_constant_counts_elements() {
        let (chain, h) = (Chain::default(), Chain::HANDLES);
        assert_eq!(h.links.len(), LINKS);
        let state = chain.described_state::<f64>().unwrap();
        let view = chain.view(0.0, &state).unwrap();
        assert_eq!(view.pose(h.links[2]).position.x, 2.5 / 3.0);
        assert_eq!(view.pose(h.bead).position.z, 3.0);
    }
}
