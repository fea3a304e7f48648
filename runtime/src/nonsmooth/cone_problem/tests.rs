//! Against closed forms, and against the conditions themselves.

use super::{ConeProblem, NoSolution, Outcome, Role, Rough, length};
use crate::tests::numbers::Numbers;

fn rough(coefficient: f64, tangents: [Option<usize>; 2], slip: Option<[f64; 2]>) -> Role<f64> {
    Role::Pushes {
        sign: 1.0,
        least: 0.0,
        rough: Some(Rough {
            coefficient,
            at_rest: coefficient,
            tangents,
            slip,
        }),
    }
}

fn diagonal<const K: usize>(inverse_mass: f64) -> [[f64; K]; K] {
    core::array::from_fn(|i| core::array::from_fn(|j| if i == j { inverse_mass } else { 0.0 }))
}

/// A point of 2 kg that is pressed by 20 N and drawn along its plane.
#[test]
fn a_point_sticks_up_to_its_cone_and_then_slides_along_the_force() {
    for angle in [0.0_f64, 0.7, 2.0, 4.0] {
        for (force, slides) in [(5.9, false), (6.1, true), (60.0, true)] {
            let direction = [angle.cos(), angle.sin()];
            let problem = ConeProblem {
                matrix: diagonal::<3>(0.5),
                offset: [
                    -10.0,
                    0.5 * force * direction[0],
                    0.5 * force * direction[1],
                ],
                roles: [
                    rough(0.3, [Some(1), Some(2)], None),
                    Role::Tangent,
                    Role::Tangent,
                ],
            };
            let found = problem.solved().expect("it is unique");
            let [normal, x, y] = found.efforts;
            assert!((normal - 20.0).abs() < 1e-12);
            let size = if slides { 6.0 } else { force };
            assert!((x + size * direction[0]).abs() < 1e-12, "{x}");
            assert!((y + size * direction[1]).abs() < 1e-12, "{y}");
            assert_eq!(matches!(found.outcomes[1], Outcome::Slips(_)), slides);
        }
    }
}

/// The conditions hold for what is found, whatever the matrix is.
#[test]
fn two_contacts_satisfy_their_conditions() {
    let mut numbers = Numbers(5);
    let mut counts = [0_usize; 4];
    for _ in 0..2000 {
        let root: [[f64; 6]; 6] =
            core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
        let mut matrix = diagonal::<6>(0.3);
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, element) in row.iter_mut().enumerate() {
                *element += (0..6).map(|k| root[i][k] * root[j][k]).sum::<f64>();
            }
        }
        let coefficient = 0.3 + 0.3 * numbers.next();
        let problem = ConeProblem {
            matrix,
            offset: core::array::from_fn(|_| numbers.next()),
            roles: [
                rough(coefficient, [Some(1), Some(2)], None),
                Role::Tangent,
                Role::Tangent,
                rough(coefficient, [Some(4), Some(5)], None),
                Role::Tangent,
                Role::Tangent,
            ],
        };
        let found = match problem.solved() {
            Ok(found) => found,
            Err(why) => {
                counts[if why == NoSolution::Several { 0 } else { 1 }] += 1;
                continue;
            }
        };
        for contact in [0, 3] {
            let (normal, rate) = (found.efforts[contact], found.residuals[contact]);
            assert!(normal > -1e-12 && rate > -1e-10 && (normal * rate).abs() < 1e-10);
            let friction = [found.efforts[contact + 1], found.efforts[contact + 2]];
            let slip = [found.residuals[contact + 1], found.residuals[contact + 2]];
            assert!(length(friction) <= coefficient * normal + 1e-10);
            if length(slip) > 1e-9 {
                let power = friction[0] * slip[0] + friction[1] * slip[1];
                assert!((power + coefficient * normal * length(slip)).abs() < 1e-9);
                counts[3] += 1;
            } else {
                counts[2] += 1;
            }
        }
    }
    // Moderate friction: nearly always there is one motion.
    assert!(counts[0] < 40 && counts[1] < 40, "{counts:?}");
    assert!(counts[2] > 50 && counts[3] > 1000, "{counts:?}");
}

/// Painleve's rod: the friction of sliding lifts by `mu s c` what it is pressed by.
#[test]
fn painleves_rod_has_no_motion_or_two() {
    // Of a rod of length 2 and mass 1 at an angle: Leine, Brogliato, Nijmeijer, Periodic motion and
    // bifurcations induced by the Painleve paradox, 2002, equations 7 and 8.
    let (sine, cosine) = 1.0_f64.sin_cos();
    let matrix = [
        [1.0 + 3.0 * cosine * cosine, -3.0 * sine * cosine],
        [-3.0 * sine * cosine, 1.0 + 3.0 * sine * sine],
    ];
    let critical = matrix[0][0] / matrix[0][1].abs();
    for (coefficient, pressed, wanted) in [
        (0.9 * critical, true, None),
        (0.9 * critical, false, None),
        (1.1 * critical, true, Some(NoSolution::None)),
        (1.1 * critical, false, Some(NoSolution::Several)),
    ] {
        // It slides so that friction presses it down.
        let problem = ConeProblem {
            matrix,
            offset: [if pressed { -9.81 } else { 9.81 }, 0.0],
            roles: [
                rough(coefficient, [Some(1), None], Some([-1.0, 0.0])),
                Role::Tangent,
            ],
        };
        let found = problem.solved();
        assert_eq!(found.err(), wanted, "{coefficient} {pressed}");
    }
}

/// A row for each rate of a corner, by the velocities (v, w) of the body.
type Corners = [[f64; 6]; 12];

/// The corners of a block at (+-1, +-1, -0.5), each along z, x and y: `v + w x r`.
fn block() -> Corners {
    let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let mut rows = [[0.0_f64; 6]; 12];
    for (corner, [x, y]) in corners.into_iter().enumerate() {
        let z = -0.5;
        rows[3 * corner] = [0.0, 0.0, 1.0, y, -x, 0.0];
        rows[3 * corner + 1] = [1.0, 0.0, 0.0, 0.0, z, -y];
        rows[3 * corner + 2] = [0.0, 1.0, 0.0, -z, 0.0, x];
    }
    rows
}

/// The problem of a block of unit mass and inertias that moves, or is accelerated, by (v, w).
fn on_corners(coefficient: f64, motion: &[f64; 6]) -> ConeProblem<f64, 12> {
    let rows = block();
    let dot = |a: &[f64; 6], b: &[f64; 6]| (0..6).map(|k| a[k] * b[k]).sum::<f64>();
    ConeProblem {
        matrix: core::array::from_fn(|i| core::array::from_fn(|j| dot(&rows[i], &rows[j]))),
        offset: rows.each_ref().map(|row| dot(row, motion)),
        roles: core::array::from_fn(|row| {
            if row % 3 == 0 {
                rough(coefficient, [Some(row + 1), Some(row + 2)], None)
            } else {
                Role::Tangent
            }
        }),
    }
}

/// A block on four corners at rest on an incline: 3 equations of rotation and heave for 4 normal
/// efforts, 3 for 8 of friction.
#[test]
fn four_corners_share_what_they_bear() {
    for (slope, slides) in [(0.29_f64, false), (0.31, true)] {
        let gravity = [slope, 0.0, -1.0, 0.0, 0.0, 0.0];
        let problem = on_corners(0.3, &gravity);
        let found = problem.solved().expect("it is unique");
        let sum = |from: usize| (0..4).map(|k| found.efforts[3 * k + from]).sum::<f64>();
        assert!((sum(0) - 1.0).abs() < 1e-9, "{}", sum(0));
        let friction = if slides { 0.3 } else { slope };
        assert!((sum(1) + friction).abs() < 1e-9, "{}", sum(1));
        for corner in 0..4 {
            let [normal, x, y] = [0, 1, 2].map(|k| found.efforts[3 * corner + k]);
            // Proportional to what it bears.
            assert!((x + friction * normal).abs() < 1e-6, "{x} {normal}");
            assert!(y.abs() < 1e-6, "{y}");
            let acceleration = found.residuals[3 * corner + 1];
            let wanted = slope - friction;
            assert!((acceleration - wanted).abs() < 1e-9, "{acceleration}");
        }
    }
}

/// There is a solution of impulses at any time (Moreau 1988).
#[test]
fn impulses_that_stop_a_block_are_always_found() {
    let mut numbers = Numbers(7);
    let mut stop = 0;
    for _ in 0..80 {
        // It falls nearly flat, and as fast as about what friction can stop.
        let mut motion = [1.0, 1.0, 0.0, 0.1, 0.1, 1.0].map(|part: f64| part * numbers.next());
        motion[2] = -1.0;
        let coefficient = 0.5 + 0.5 * numbers.next().abs();
        let problem = on_corners(coefficient, &motion);
        let found = match problem.solved() {
            Ok(found) => found,
            Err(why) => {
                assert_eq!(why, NoSolution::Several, "{coefficient} {motion:?}");
                continue;
            }
        };
        for corner in 0..4 {
            let [normal, x, y] = [0, 1, 2].map(|k| found.efforts[3 * corner + k]);
            let [opens, along, across] = [0, 1, 2].map(|k| found.residuals[3 * corner + k]);
            assert!(normal > -1e-12 && opens > -1e-12 && normal * opens < 1e-11);
            assert!(length([x, y]) < coefficient * normal + 1e-11);
            // What slips has all the friction that there is, against its slip.
            let slip = length([along, across]);
            if slip > 1e-6 {
                for (friction, rate) in [(x, along), (y, across)] {
                    let wanted = -coefficient * normal * rate / slip;
                    assert!((friction - wanted).abs() < 1e-6, "{friction} {wanted}");
                }
            }
        }
        stop += i32::from(found.residuals.iter().all(|rate| rate.abs() < 1e-11));
    }
    assert!(stop > 10, "{stop}");
}
