//! Named points: read by their handles, in the place of points of joints and forces, in parts.

use holonom::nalgebra::{UnitQuaternion, Vector3};
use holonom::prelude::*;

/// A hand with a tool, for a right and a left arm.
#[derive(Assembly)]
struct Hand {
    #[port]
    arm: Body,
    #[param(like = 0.2)]
    reach: f64,
    #[body(mass = 0.4, inertia = [0.002, 0.003, 0.004], position = [1.0, 0.1, 0.0], orientation = rpy(0.1, 0.2, 0.3))]
    palm: Body,
    #[joint(between = [arm, palm], point = wrist, axis = [0.2, 1.0, 0.1])]
    joint: Revolute,
    #[point(on = palm, at = [1.0 + reach, 0.2, 0.1])]
    tool: Point,
    #[point(on = arm, at = [0.95, 0.05, 0.0])]
    wrist: Point,
}

/// Two arms about z, each with a hand. A spring pulls the right tool, and a rod holds a bead at the
/// left arm.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Arms {
    #[body(mass = 1.0, inertia = [[0.1, 0.01, 0.0], [0.01, 0.1, 0.02], [0.0, 0.02, 0.1]], position = [0.5, 0.0, 0.0], angular_velocity = [0.0, 0.0, 2.0], velocity = [0.0, 1.0, 0.0])]
    upper: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shoulder: Revolute,
    #[part(arm = upper)]
    right: Hand,
    #[part(arm = upper, mirror = z, at = [0.0, 0.0, -0.1])]
    left: Hand,
    #[point(on = ground, at = [0.3, -0.4, 0.5])]
    hook: Point,
    #[point(on = upper, at = [0.1 * (k + 1), 0.0, 0.2])]
    marks: [Point; 3],
    #[force(between = [ground, right.palm], head = hook, tail = right.tool, stiffness = 20.0, free_length = 0.5)]
    spring: SpringDamper,
    #[body(mass = 0.1, position = [0.3, 0.0, 0.2])]
    bead: Particle,
    #[point(on = bead, at = [0.3, 0.0, 0.2])]
    pearl: Point,
    #[joint(between = [upper, bead], head = marks[0], tail = pearl)]
    rod: Distance,
}

fn arms() -> Arms {
    Arms::new(Hand::new(0.25), Hand::new(0.15)).unwrap()
}

#[test]
fn a_point_is_where_it_was_described() {
    let (arms, h) = (arms(), Arms::HANDLES);
    let state = arms.described_state::<f64>().unwrap();
    let view = arms.view(0.0, &state).unwrap();
    let near = |a: Vector3<f64>, b: [f64; 3]| assert!((a - Vector3::from(b)).norm() < 1e-14, "{a}");
    near(view.position(h.hook), [0.3, -0.4, 0.5]);
    near(view.position(h.right.tool), [1.25, 0.2, 0.1]);
    near(view.position(h.left.tool), [1.15, 0.2, -0.2]);
    near(view.position(h.marks[2]), [0.3, 0.0, 0.2]);
    near(view.position(h.pearl), [0.3, 0.0, 0.2]);
    near(view.position(h.upper), [0.5, 0.0, 0.0]);
    assert_eq!(h.left.tool.name(), "left.tool");
    assert_eq!(Arms::REPORT.points[3].name, "left.wrist");
    assert_eq!(Arms::REPORT.points[h.hook.index()].body, None);
    // In its place in a joint: the wrist is the point of the reaction.
    let wrist = view.position(h.right.wrist);
    near(wrist, [0.95, 0.05, 0.0]);
}

/// Positions, velocities and accelerations against differences of a run, in both coordinates.
macro_rules! moves {
    ($($joints:ident)?) => {{
        let (arms, h) = (arms(), Arms::HANDLES);
        let step = 2e-4;
        let points = [h.right.tool, h.left.tool, h.left.wrist, h.marks[1], h.pearl, h.hook];
        let mut seen = Vec::new();
        let simulation = Simulation::new(&arms, StandardLagrange, Rk4::every(step)).assembled();
        $(let simulation = simulation.$joints();)?
        simulation
            .run(0.0_f64..=0.4, every(step), |sample| -> Result<(), Fault> {
                let mut row = Vec::new();
                for point in points {
                    row.push([
                        sample.position(point),
                        sample.velocity(point),
                        sample.acceleration(point)?,
                    ]);
                }
                // A point of the body by numbers is the same.
                let pose = sample.pose(h.upper);
                let turn = UnitQuaternion::from_quaternion(pose.orientation);
                let local = turn.inverse() * (sample.position(h.marks[1]) - pose.position);
                let [_, velocity, acceleration] = row[3];
                assert!((sample.point_velocity(h.upper, local) - velocity).norm() < 1e-12);
                let other = sample.point_acceleration(h.upper, local)?;
                assert!((other - acceleration).norm() < 1e-11);
                seen.push(row);
                Ok(())
            })
            .unwrap();
        for rows in seen.windows(3) {
            for k in 0..points.len() {
                let difference = |part: usize| (rows[2][k][part] - rows[0][k][part]) / (2.0 * step);
                let [_, velocity, acceleration] = rows[1][k];
                assert!((difference(0) - velocity).norm() < 1e-3 * (1.0 + velocity.norm()));
                let (a, b) = (difference(1), acceleration); assert!((a - b).norm() < 1e-3 * (1.0 + b.norm()), "{k}: {a} {b}");
            }
        }
        let moved = (seen[0][0][0] - seen[2000][0][0]).norm();
        assert!(moved > 0.1, "{moved}");
    }};
}

#[test]
fn points_move_as_their_differences_say() {
    moves!();
    moves!(joint_coordinates);
}

/// The spring and the rod hold what they would with the same numbers written out.
#[test]
fn a_name_stands_for_the_numbers() {
    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81])]
    struct Named {
        #[body(mass = 1.0, inertia = [0.1, 0.2, 0.3])]
        rod: Body,
        #[point(on = ground, at = [0.0, 0.3, 0.4])]
        pivot: Point,
        #[joint(between = [ground, rod], point = pivot, axis = [1.0, 0.0, 0.0])]
        hinge: Revolute,
    }
    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81])]
    struct Written {
        #[body(mass = 1.0, inertia = [0.1, 0.2, 0.3])]
        rod: Body,
        #[joint(between = [ground, rod], point = [0.0, 0.3, 0.4], axis = [1.0, 0.0, 0.0])]
        hinge: Revolute,
    }
    assert_eq!(Named::REPORT.kernels, Written::REPORT.kernels);
    let (named, written) = (Named::default(), Written::default());
    let state = written.described_state::<f64>().unwrap();
    let mut rates = Vec::new();
    Simulation::new(&named, StandardLagrange, Rk4::every(0.01))
        .run(0.0_f64..=0.1, every(0.1), |sample| {
            rates.push(sample.angle_rate(Named::HANDLES.hinge))
        })
        .unwrap();
    Simulation::new(&written, StandardLagrange, Rk4::every(0.01))
        .initial_state(state)
        .run(0.0_f64..=0.1, every(0.1), |sample| {
            assert_eq!(sample.angle_rate(Written::HANDLES.hinge), rates.remove(0));
        })
        .unwrap();
}
