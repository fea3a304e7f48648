//! A ball in a corner, and a block on four corners of its own: more is in contact than has to be.

use holonom::nalgebra::{Rotation3, Vector3};
use holonom::prelude::*;
use holonom::run::{InteractionMode, Plane};

use super::balls::{Bowling, start};
use super::blocks::Block;
use super::tight;

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.1;

/// The normals of three planes at right angles, by how far each points up.
fn normals(up: [f64; 3]) -> [Vector3<f64>; 3] {
    let turned =
        Rotation3::rotation_between(&up.into(), &Vector3::z()).expect("they are no opposites");
    [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| turned * axis)
}

/// The contacts of a ball with planes through the origin.
fn contacts(
    [first, second, third]: [Vector3<f64>; 3],
    [restitution, friction]: [f64; 2],
) -> [Interaction<f64, Bowling>; 9] {
    let ball = Bowling::HANDLES.ball;
    let pairs = [(first, second), (second, third), (third, first)];
    let [[a, b, c], [d, e, f], [g, h, i]] = pairs.map(|(normal, along)| {
        let plane = Plane::on_ground([0.0; 3], normal.into()).along(along.into());
        Interaction::contact(ball, plane)
            .radius(RADIUS)
            .restitution(restitution)
            .with_friction(friction)
    });
    [a, b, c, d, e, f, g, h, i]
}

#[test]
fn a_ball_rests_in_a_corner_whatever_its_friction_is() {
    for up in [[0.3, 0.3, 0.9], [1.0, 1.0, 1.0], [0.01, 0.4, 0.9]] {
        let normals = normals(up);
        let place: Vector3<f64> = normals.iter().sum::<Vector3<f64>>() * RADIUS;
        for friction in [1e-3, 0.01, 0.1, 0.5, 1.0, 10.0] {
            let contacts = contacts(normals, [0.0, friction]);
            let handles = Interaction::handles(&contacts);
            Bowling::default()
                .simulation(StandardLagrange, DormandPrince::default())
                .initial_state(start(place.into(), [0.0; 3], [0.0; 3]))
                .interactions(contacts)
                .run(0.0..=1.0, every(0.1), |sample| -> Result<(), Fault> {
                    let moved = sample.position(Bowling::HANDLES.ball) - place;
                    assert!(moved.norm() < 1e-14, "{friction}: {moved}");
                    let mut force = Vector3::new(0.0, 0.0, -7.0 * GRAVITY);
                    let mut moment = Vector3::zeros();
                    for (contact, normal) in normals.into_iter().enumerate() {
                        let along = normals[(contact + 1) % 3];
                        let [n, x, y] = [0, 1, 2].map(|k| sample.effort(handles[3 * contact + k]));
                        let rubs = along * x? + normal.cross(&along) * y?;
                        let n = n?;
                        assert!(rubs.norm() <= friction * n + 1e-12, "{friction}: {rubs}");
                        force += normal * n + rubs;
                        moment -= normal.cross(&rubs) * RADIUS;
                    }
                    assert!(
                        force.norm() < 1e-9 && moment.norm() < 1e-10,
                        "{force} {moment}"
                    );
                    Ok(())
                })
                .unwrap_or_else(|fault| panic!("{up:?} {friction}: {fault}"));
        }
    }
}

/// Where it hits one plane it slips on another, and the third one opens.
#[test]
fn thrown_into_a_corner_it_comes_to_rest() {
    let (h, normals) = (Bowling::HANDLES, normals([0.3, 0.3, 0.9]));
    let place: Vector3<f64> = normals.iter().sum::<Vector3<f64>>() * RADIUS;
    let [x, y, z] = normals;
    let velocity = x * 0.1 + y * 0.2 + z * 0.3;
    let mut energy = f64::INFINITY;
    let report = Bowling::default()
        .simulation(StandardLagrange, DormandPrince::default())
        .initial_state(start(place.into(), velocity.into(), [1.0, 2.0, 3.0]))
        .interactions(contacts(normals, [0.5, 0.3]))
        .run(0.0..=1.5, every(0.01), |sample| {
            assert!(sample.energy() < energy + 1e-9);
            energy = sample.energy();
        })
        .expect("it comes to rest");
    let view = Bowling::default()
        .view(1.5, &report.state)
        .expect("a view")
        .position(h.ball);
    assert!((view - place).norm() < 1e-9);
    assert!(Bowling::velocity(&report.state, h.ball).norm() < 1e-12);
}

/// Its slip on one plane ends while it sticks on the other: from then on nothing moves, and
/// friction bears what it has to.
#[test]
fn a_ball_that_stops_in_a_groove_sticks_on_both_planes() {
    let friction = 0.3233;
    let planes: [Vector3<f64>; 2] = [[0.637, -0.159, 0.755], [-0.785, 0.055, 0.617]]
        .map(|normal| Vector3::from(normal).normalize());
    let [first, second] = planes;
    let place = (first + second) * RADIUS / (1.0 + first.dot(&second));
    let [[a, b, c], [d, e, f]] = planes.map(|normal| {
        Interaction::contact(
            Bowling::HANDLES.ball,
            Plane::on_ground([0.0; 3], normal.into()),
        )
        .radius(RADIUS)
        .with_friction(friction)
    });
    let contacts = [a, b, c, d, e, f];
    let handles = Interaction::handles(&contacts);
    for relative in [1e-5, 2e-7, 1e-9] {
        let tolerance = Tolerance {
            relative,
            absolute: 0.1 * relative,
        };
        let mut at_rest: Option<[f64; 6]> = None;
        Bowling::default()
            .simulation(StandardLagrange, DormandPrince::new(tolerance))
            .initial_state(start(
                place.into(),
                [0.121, 0.172, -0.044],
                [-0.983, -0.234, -1.038],
            ))
            .interactions(contacts)
            .run(0.0..=0.1, every_step(), |sample| -> Result<(), Fault> {
                let mut efforts = [0.0; 6];
                for (effort, handle) in efforts.iter_mut().zip(handles) {
                    *effort = sample.effort(handle)?;
                }
                for [normal, along, across] in [0, 3].map(|k| [0, 1, 2].map(|i| efforts[k + i])) {
                    let bears = friction * normal * (1.0 + 1e-9);
                    assert!(along.hypot(across) < bears, "{relative}: {efforts:?}");
                }
                if sample.time() > 0.03 {
                    for friction in [handles[1], handles[4]] {
                        assert_eq!(sample.mode(friction)?, InteractionMode::Sticking);
                    }
                    let kept = *at_rest.get_or_insert(efforts);
                    for (effort, kept) in efforts.into_iter().zip(kept) {
                        assert!((effort - kept).abs() < 1e-7, "{effort} {kept}");
                    }
                }
                Ok(())
            })
            .expect("it stops");
        let [_, along, across, ..] = at_rest.expect("it rests");
        assert!(along.hypot(across) < 2.0, "{at_rest:?}");
    }
}

/// All four corners hit at once, evenly: it bounces as a ball does.
#[test]
fn a_block_that_falls_flat_bounces_on_four_corners() {
    const RESTITUTION: f64 = 0.5;
    let (block, h, height) = (Block::default(), Block::HANDLES, 0.2);
    let floor = Plane::on_ground([0.0, 0.0, -height], [0.0, 0.0, 1.0]);
    let [[a, b, c], [d, e, f], [g, i, j], [k, l, m]] =
        [h.first, h.second, h.third, h.fourth].map(|corner| {
            let contact = Interaction::contact(corner, floor).restitution(RESTITUTION);
            contact.with_friction(0.3)
        });
    let contacts = [a, b, c, d, e, f, g, i, j, k, l, m];
    let handles = Interaction::handles(&contacts);
    let [normal, rubs, ..] = handles;
    let hits = f64::sqrt(2.0 * height / GRAVITY);
    block
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .interactions(contacts)
        .run(0.0..=2.0, every(0.05), |sample| -> Result<(), Fault> {
            let (mut after, mut speed) = (sample.time() - hits, GRAVITY * hits);
            let mut fell = 0.5 * GRAVITY * sample.time().powi(2) - height;
            while after > 0.0 && speed > 1e-3 {
                speed *= RESTITUTION;
                fell = after * (0.5 * GRAVITY * after - speed);
                after -= 2.0 * speed / GRAVITY;
            }
            let above = sample.position(h.block).z - 1.0 + height;
            if speed > 1e-3 {
                assert!(
                    (above + fell).abs() < 1e-9,
                    "{}: {above} {fell}",
                    sample.time()
                );
            } else {
                assert!(above.abs() < 1e-6);
            }
            let leans = sample.pose(h.block).orientation.coords.xy().norm();
            assert!(leans < 1e-12, "{leans}");
            for (index, handle) in handles.into_iter().enumerate() {
                let is_struck = sample.impact(handle)?.is_some();
                assert!(!is_struck || index % 3 == 0, "friction has no part in that");
            }
            if sample.time() > 1.0 {
                assert_eq!(sample.mode(rubs)?, InteractionMode::Sticking);
                let weight = 0.25 * 3.0 * GRAVITY;
                let bears = sample.effort(normal)?;
                assert!((bears - weight).abs() < 1e-6, "{bears} {weight}");
            }
            Ok(())
        })
        .expect("it comes to rest");
}
