//! Blocks that tip, slide, rock and stand on each other.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{InteractionMode, Plane};

use super::tight;

const GRAVITY: f64 = 9.81;

/// Two blocks in a plane on a table that a driver shakes. The lower one is 1 m wide and 2 m high.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub(crate) struct Stack {
    /// How far the table is moved (m), and how fast (rad/s).
    #[param]
    amplitude: f64,
    #[param]
    frequency: f64,
    #[body(mass = 5.0, inertia = [1.0, 1.0, 1.0])]
    table: Body,
    #[body(mass = 3.0, inertia = [1.25, 1.25, 0.5], position = [0.0, 0.0, 1.0])]
    lower: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 2.25])]
    upper: Body,
    #[joint(between = [ground, table], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    slide: Prismatic,
    #[joint(between = [ground, table], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], motion = amplitude * (1.0 - cos(frequency * time)))]
    shaker: DisplacementDriver,
    #[joint(between = [ground, lower], point = [0.0, 0.0, 1.0], normal = [0.0, 1.0, 0.0])]
    lower_plane: Planar,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 2.25], normal = [0.0, 1.0, 0.0])]
    upper_plane: Planar,
    #[point(on = lower, at = [-0.5, 0.0, 0.0])]
    left: Point,
    #[point(on = lower, at = [0.5, 0.0, 0.0])]
    right: Point,
    #[point(on = upper, at = [-0.25, 0.0, 2.0])]
    upper_left: Point,
    #[point(on = upper, at = [0.25, 0.0, 2.0])]
    upper_right: Point,
}

type Contacts<const N: usize> = [Interaction<f64, Stack>; N];

/// The contacts of two corners side by side.
fn both([first, second]: [Contacts<2>; 2]) -> Contacts<4> {
    let ([a, b], [c, d]) = (first, second);
    [a, b, c, d]
}

/// The lower block on a plane that is inclined by an angle about the global y axis.
fn on_incline(stack: &Stack, angle: f64) -> (StateOf<Stack>, Plane<f64, Stack>) {
    let h = Stack::HANDLES;
    let (sine, cosine) = angle.sin_cos();
    let mut start = stack.described_state().expect("it is described");
    let mut pose = stack.view(0.0, &start).expect("a view").pose(h.lower);
    pose.position = [sine, 0.0, cosine].into();
    let half = 0.5 * angle;
    pose.orientation = holonom::nalgebra::Quaternion::new(half.cos(), 0.0, half.sin(), 0.0);
    Stack::set_pose(&mut start, h.lower, pose);
    let plane = Plane::on_ground([0.0; 3], [sine, 0.0, cosine]).along([cosine, 0.0, -sine]);
    (start, plane)
}

fn goes<C: Coordinates<Stack>>(angle: f64, friction: f64) {
    let (stack, h) = (Stack::new(0.0, 1.0).expect("it is"), Stack::HANDLES);
    let (start, plane) = on_incline(&stack, angle);
    let contacts = both(
        [h.left, h.right]
            .map(|corner| Interaction::contact(corner, plane).with_plane_friction(friction)),
    );
    let [left, _, right, rubs] = Interaction::handles(&contacts);
    let (sine, cosine) = angle.sin_cos();
    // It stands on its corner in front where that has to bear more than the weight.
    let tips = sine.min(friction * cosine) > 0.5 * cosine;
    let slides = !tips && friction * cosine < sine;
    let mut state = None;
    let report = Simulation::new(&stack, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(contacts)
        .run(0.0..=0.1, every(0.05), |sample| -> Result<(), Fault> {
            state = Some([sample.mode(left)?, sample.mode(right)?, sample.mode(rubs)?]);
            if !tips {
                let [first, second] = [sample.effort(left)?, sample.effort(right)?];
                let normal = 3.0 * GRAVITY * cosine;
                // Moments about the middle below: what friction turns, the normal efforts hold.
                let along = 3.0 * GRAVITY * sine.min(friction * cosine);
                assert!((first + second - normal).abs() < 1e-10);
                assert!(
                    (second - first - 2.0 * along).abs() < 1e-9,
                    "{first} {second}"
                );
            }
            Ok(())
        })
        .expect("it goes");
    let wanted = match (tips, slides) {
        (true, _) => [
            InteractionMode::Free,
            InteractionMode::AtLower,
            InteractionMode::Sticking,
        ],
        (_, true) => [
            InteractionMode::AtLower,
            InteractionMode::AtLower,
            InteractionMode::Slipping,
        ],
        _ => [
            InteractionMode::AtLower,
            InteractionMode::AtLower,
            InteractionMode::Sticking,
        ],
    };
    assert_eq!(state, Some(wanted), "{angle} {friction}");
    let view = stack.view(0.1, &report.state).expect("a view");
    let (speed, turning) = (
        view.velocity(h.lower).norm(),
        view.angular_velocity(h.lower).y,
    );
    if !tips {
        let wanted = if slides {
            0.1 * GRAVITY * (sine - friction * cosine)
        } else {
            0.0
        };
        assert!((speed - wanted).abs() < 1e-11, "{speed} {wanted}");
        assert!(turning.abs() < 1e-12, "{turning:e}");
    } else {
        assert!(turning > 1e-3, "{turning}");
    }
}

#[test]
fn a_block_on_an_incline_stays_slides_or_tips() {
    for (angle, friction) in [
        (0.4, 0.5),
        (0.4, 0.43),
        (0.4, 0.42),
        (0.4, 0.0),
        (0.55, 0.49),
        (0.55, 0.8),
        (0.47, 10.0),
        (0.46, 10.0),
    ] {
        goes::<Relative>(angle, friction);
    }
    goes::<Absolute>(0.4, 0.3);
    goes::<Absolute>(0.55, 0.8);
}

/// The time (s) in which a block of 1 m by 2 m falls from an inclination onto its base, over its
/// corner: `4/3 R w' = g (cos(a - i) - cos(a - i0))`, by Simpson's rule in the root of the way.
fn falls(inclination: f64) -> f64 {
    let (height, slender) = (1.25_f64.sqrt(), 0.5_f64.atan());
    let squared = 1.5 * GRAVITY / height;
    let potential = |at: f64| (slender - at).cos();
    let rate = |s: f64| {
        if s == 0.0 {
            return 2.0 / (squared * (slender - inclination).sin()).sqrt();
        }
        2.0 * s / (squared * (potential(inclination) - potential(inclination - s * s))).sqrt()
    };
    let (count, end) = (4000, inclination.sqrt());
    let step = end / f64::from(count);
    let mut sum = rate(0.0) + rate(end);
    for k in 1..count {
        sum += if k % 2 == 1 { 4.0 } else { 2.0 } * rate(f64::from(k) * step);
    }
    sum * step / 3.0
}

/// Housner, The behavior of inverted pendulum structures during earthquakes, 1963: at every impact
/// the rate is multiplied by `1 - 3/2 sin^2 a`.
#[test]
fn a_rocking_block_loses_what_housner_says() {
    let (stack, h) = (Stack::new(0.0, 1.0).expect("it is"), Stack::HANDLES);
    let slender = 0.5_f64.atan();
    let first: f64 = 0.2;
    // It leans to the right over its right corner, which stays where it is.
    let mut start = stack.described_state().expect("it is described");
    let mut pose = stack.view(0.0, &start).expect("a view").pose(h.lower);
    let (sine, cosine) = first.sin_cos();
    pose.position = [0.5 - 0.5 * cosine + sine, 0.0, 0.5 * sine + cosine].into();
    let half = 0.5 * first;
    pose.orientation = holonom::nalgebra::Quaternion::new(half.cos(), 0.0, half.sin(), 0.0);
    Stack::set_pose(&mut start, h.lower, pose);
    let ground = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]);
    let contacts = both(
        [h.left, h.right]
            .map(|corner| Interaction::contact(corner, ground).with_plane_friction(0.8)),
    );
    let [left, _, right, _] = Interaction::handles(&contacts);
    let mut times = Vec::new();
    stack
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(start)
        .interactions(contacts)
        .run(0.0..=4.0, every(4.0), |sample| -> Result<(), Fault> {
            for corner in [left, right] {
                if let Some(impact) = sample.impact(corner)?
                    && impact.time == sample.time()
                {
                    times.push(sample.time());
                }
            }
            Ok(())
        })
        .expect("it rocks");
    times.dedup();
    assert!(times.len() > 4, "{times:?}");
    let ratio: f64 = 1.0 - 1.5 * slender.sin().powi(2);
    let (mut inclination, mut time) = (first, falls(first));
    for (number, &found) in times.iter().take(5).enumerate() {
        assert!((found - time).abs() < 1e-9, "{number}: {found} {time}");
        let height = ratio * ratio * ((slender - inclination).cos() - slender.cos());
        inclination = slender - (slender.cos() + height).acos();
        time += 2.0 * falls(inclination);
    }
}

/// The upper block slips while the table is faster than its friction allows; the lower one bears
/// both and sticks.
fn shaken<C: Coordinates<Stack>>() {
    let (amplitude, frequency, friction) = (0.03, 10.0, 0.2);
    let stack = Stack::new(amplitude, frequency).expect("it is");
    let h = Stack::HANDLES;
    let table = Plane::on(h.table, [0.0; 3], [0.0, 0.0, 1.0]);
    let top = Plane::on(h.lower, [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]);
    let below = [h.left, h.right]
        .map(|corner| Interaction::contact(corner, table).with_plane_friction(0.6));
    let above = [h.upper_left, h.upper_right]
        .map(|corner| Interaction::contact(corner, top).with_plane_friction(friction));
    let ([a, b, c, d], [e, f, g, i]) = (both(below), both(above));
    let contacts = [a, b, c, d, e, f, g, i];
    let [left, holds, right, _, upper_left, rubs, upper_right, _] = Interaction::handles(&contacts);
    // mu g t = A w sin(w t), by Newton's method.
    let (decelerated, accelerated) = (friction * GRAVITY, amplitude * frequency * frequency);
    let mut catches: f64 = 0.2;
    for _ in 0..50 {
        let slip = decelerated * catches - accelerated / frequency * (frequency * catches).sin();
        catches -= slip / (decelerated - accelerated * (frequency * catches).cos());
    }
    let begins = (-decelerated / accelerated).acos() / frequency;
    assert!(catches < begins);
    let mut last = (0.0, InteractionMode::Free);
    let mut changes = Vec::new();
    Simulation::new(&stack, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(contacts)
        .run(0.0..=0.3, every(0.01), |sample| -> Result<(), Fault> {
            let mode = sample.mode(rubs)?;
            if mode != last.1 {
                changes.push((sample.time(), mode));
            }
            last = (sample.time(), mode);
            assert_eq!(sample.mode(holds)?, InteractionMode::Sticking);
            let above = sample.effort(upper_left)? + sample.effort(upper_right)?;
            assert!((above - GRAVITY).abs() < 1e-9, "{above}");
            let below = sample.effort(left)? + sample.effort(right)?;
            assert!((below - 4.0 * GRAVITY).abs() < 1e-9, "{below}");
            Ok(())
        })
        .expect("it is shaken");
    let wanted = [
        (0.0, InteractionMode::Slipping),
        (catches, InteractionMode::Sticking),
        (begins, InteractionMode::Slipping),
    ];
    for ((time, mode), (at, wanted)) in changes.iter().zip(wanted) {
        assert_eq!(*mode, wanted);
        assert!((time - at).abs() < 1e-9, "{time} {at}");
    }
    assert_eq!(changes.len(), 3, "{changes:?}");
}

#[test]
fn a_stack_on_a_shaken_table_slips_and_sticks() {
    shaken::<Relative>();
    shaken::<Absolute>();
}

/// A block of 1 m by 1 m by 2 m, with the corners of its base.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub(crate) struct Block {
    #[body(free, mass = 3.0, inertia = [1.25, 1.25, 0.5], position = [0.0, 0.0, 1.0])]
    block: Body,
    #[point(on = block, at = [-0.5, -0.5, 0.0])]
    first: Point,
    #[point(on = block, at = [0.5, -0.5, 0.0])]
    second: Point,
    #[point(on = block, at = [-0.5, 0.5, 0.0])]
    third: Point,
    #[point(on = block, at = [0.5, 0.5, 0.0])]
    fourth: Point,
}

/// More corners than its motion determines begin to stick together.
#[test]
fn a_block_in_space_slides_to_rest_on_four_corners() {
    let (block, h) = (Block::default(), Block::HANDLES);
    for (number, slope) in [0.1_f64, 0.0].into_iter().enumerate() {
        let friction = 0.31 + 0.01 * number as f64;
        let speed = 1.1 + 0.037 * number as f64;
        let (sine, cosine) = slope.sin_cos();
        let plane = Plane::on_ground([0.0; 3], [sine, 0.0, cosine]).along([cosine, 0.0, -sine]);
        let mut start = block.described_state().expect("it is described");
        let mut pose = block.view(0.0, &start).expect("a view").pose(h.block);
        pose.position = [sine, 0.0, cosine].into();
        let half = 0.5 * slope;
        pose.orientation = holonom::nalgebra::Quaternion::new(half.cos(), 0.0, half.sin(), 0.0);
        Block::set_pose(&mut start, h.block, pose);
        let down = [speed * cosine, 0.0, -speed * sine];
        Block::set_velocity(&mut start, h.block, down.into());
        let [[a, b, c], [d, e, f], [g, i, j], [k, l, m]] = [h.first, h.second, h.third, h.fourth]
            .map(|corner| Interaction::contact(corner, plane).with_friction(friction));
        let contacts = [a, b, c, d, e, f, g, i, j, k, l, m];
        let [_, first, _, _, _, _, _, _, _, _, last, _] = Interaction::handles(&contacts);
        let braking = GRAVITY * (friction * cosine - sine);
        let rests = speed / braking;
        block
            .simulation(StandardLagrange, DormandPrince::new(tight()))
            .initial_state(start)
            .interactions(contacts)
            .run(
                0.0..=rests + 1.0,
                every(0.25),
                |sample| -> Result<(), Fault> {
                    let after = sample.time() - rests;
                    for rubs in [first, last] {
                        let sticks = sample.mode(rubs)? == InteractionMode::Sticking;
                        assert!(after.abs() < 1e-9 || sticks == (after > 0.0), "{after}");
                    }
                    if after > 1e-9 {
                        let way = (sample.position(h.block) - pose.position).norm();
                        let wanted = 0.5 * speed * rests;
                        assert!((way - wanted).abs() < 1e-9, "{way} {wanted}");
                        assert!(sample.velocity(h.block).norm() < 1e-15);
                    }
                    Ok(())
                },
            )
            .unwrap_or_else(|fault| panic!("{number}: {fault}"));
    }
}

/// Impulses at all four corners at once share the load in many ways, and friction with them. One of
/// these is taken whatever the order of the corners is, and whatever round-off is in the start.
#[test]
fn a_block_that_lands_flat_does_not_ask_for_the_order_of_its_corners() {
    let lands = |number: usize, is_other: bool| -> [f64; 5] {
        let (block, h) = (Block::default(), Block::HANDLES);
        let [friction, speed, spin] = [
            [0.1, 1.0, 2.0],
            [0.26, 0.6, -1.0],
            [0.3, 0.4, 1.5],
            [0.4, 0.9, 3.0],
        ][number];
        let mut start = block.described_state().expect("it is described");
        let off = if is_other { 1e-12 } else { 0.0 };
        Block::set_velocity(&mut start, h.block, [speed + off, 0.3, 0.0].into());
        Block::set_angular_velocity(&mut start, h.block, [0.0, 0.0, spin].into());
        let ground = Plane::on_ground([0.0, 0.0, -0.02], [0.0, 0.0, 1.0]).along([1.0, 0.0, 0.0]);
        let corners = if is_other {
            [h.third, h.first, h.fourth, h.second]
        } else {
            [h.first, h.second, h.third, h.fourth]
        };
        let [[a, b, c], [d, e, f], [g, i, j], [k, l, m]] =
            corners.map(|corner| Interaction::contact(corner, ground).with_friction(friction));
        let report = block
            .simulation(StandardLagrange, Rk4::every(4e-3))
            .initial_state(start)
            .interactions([a, b, c, d, e, f, g, i, j, k, l, m])
            .run(0.0..=0.12, every(0.12), |_| ())
            .unwrap_or_else(|fault| panic!("{number}: {fault}"));
        let view = block.view(0.12, &report.state).expect("a view");
        let (place, velocity) = (view.position(h.block), view.velocity(h.block));
        let spin = view.angular_velocity(h.block).z;
        [place.x, place.y, velocity.x, velocity.y, spin]
    };
    for number in 0..4 {
        let (one, other) = (lands(number, false), lands(number, true));
        for (a, b) in one.into_iter().zip(other) {
            assert!((a - b).abs() < 1e-9, "{number}: {one:?} {other:?}");
        }
    }
}

/// How a block begins on a plane or above it.
struct Throw {
    friction: f64,
    /// Poisson's.
    restitution: f64,
    /// Along the plane of the description, and about its normal.
    velocity: [f64; 2],
    spin: f64,
    /// Of the plane (rad): the block stands on two corners.
    tilt: f64,
    /// That of a method that controls its error.
    tolerance: Option<f64>,
}

/// It tips, hops, slips and comes to rest on one corner and on several, whatever their order is and
/// whatever round-off is in the start.
#[test]
fn a_thrown_block_does_not_ask_for_the_order_of_its_corners() {
    let on_a_plane = |friction, velocity, spin, tolerance| Throw {
        friction,
        restitution: 0.0,
        velocity,
        spin,
        tilt: 0.0,
        tolerance,
    };
    let throws = [
        Throw {
            restitution: 0.45,
            ..on_a_plane(0.46, [-1.08, 0.31], 2.57, Some(1e-9))
        },
        Throw {
            restitution: 0.15,
            tilt: 0.03,
            ..on_a_plane(0.45, [-0.1, 0.84], -0.3, None)
        },
        on_a_plane(0.49, [-0.96, 0.84], 0.04, None),
        on_a_plane(0.57, [0.47, -1.17], -1.97, Some(1e-9)),
        on_a_plane(0.42, [0.65, -1.0], 0.35, Some(1e-6)),
    ];
    for (number, throw) in throws.iter().enumerate() {
        let (one, other) = (thrown(throw, false), thrown(throw, true));
        for (a, b) in one.into_iter().zip(other) {
            assert!((a - b).abs() < 1e-8, "{number}: {one:?} {other:?}");
        }
    }
}

/// Where it is after 0.3 s, and how fast.
fn thrown(throw: &Throw, is_other: bool) -> [f64; 6] {
    let (block, h, end) = (Block::default(), Block::HANDLES, 0.3);
    let mut start = block.described_state().expect("it is described");
    let off = if is_other { 1e-12 } else { 0.0 };
    let [x, y] = throw.velocity;
    Block::set_velocity(&mut start, h.block, [x + off, y, 0.0].into());
    Block::set_angular_velocity(&mut start, h.block, [0.0, 0.0, throw.spin].into());
    let (sine, cosine) = throw.tilt.sin_cos();
    let below = 0.5 * sine.abs();
    let ground = Plane::on_ground([-below * sine, 0.0, -below * cosine], [sine, 0.0, cosine])
        .along([cosine, 0.0, -sine]);
    let corners = if is_other {
        [h.third, h.first, h.fourth, h.second]
    } else {
        [h.first, h.second, h.third, h.fourth]
    };
    let [[a, b, c], [d, e, f], [g, i, j], [k, l, m]] = corners.map(|corner| {
        Interaction::contact(corner, ground)
            .restitution_of_impulses(throw.restitution)
            .with_friction(throw.friction)
    });
    let contacts = [a, b, c, d, e, f, g, i, j, k, l, m];
    let report = match throw.tolerance {
        Some(tolerance) => {
            let tolerance = Tolerance {
                relative: tolerance,
                absolute: tolerance,
            };
            block
                .simulation(StandardLagrange, DormandPrince::new(tolerance))
                .initial_state(start)
                .interactions(contacts)
                .run(0.0..=end, every(end), |_| ())
        }
        None => block
            .simulation(StandardLagrange, Rk4::every(3e-3))
            .initial_state(start)
            .interactions(contacts)
            .run(0.0..=end, every(end), |_| ()),
    };
    let report = report.unwrap_or_else(|fault| panic!("{}: {fault}", throw.friction));
    let view = block.view(end, &report.state).expect("a view");
    let (place, velocity) = (view.position(h.block), view.velocity(h.block));
    [
        place.x, place.y, place.z, velocity.x, velocity.y, velocity.z,
    ]
}
