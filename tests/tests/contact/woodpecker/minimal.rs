//! The toy in its three coordinates, `M u' = h(q) + W^T l`; one contact is closed at most.

use super::{
    BEAK, BEAK_GAP, BEAK_HEIGHT, BIRD, BIRD_INERTIA, BIRD_MASS, FRICTION, GRAVITY, HALF_HEIGHT,
    HOLE, Motion, PLAY, RESTITUTION, SLEEVE_INERTIA, SLEEVE_MASS, SPRING, STIFFNESS,
};
use holonom::nalgebra::{Matrix3, Vector3};

const NORMALS: [[f64; 3]; 3] = [
    [0.0, 0.0, -BEAK_HEIGHT],
    [0.0, HALF_HEIGHT, 0.0],
    [0.0, -HALF_HEIGHT, 0.0],
];
const TANGENTS: [[f64; 3]; 3] = [
    [1.0, SPRING, BIRD + BEAK],
    [1.0, HOLE, 0.0],
    [1.0, HOLE, 0.0],
];
const GAPS: [f64; 3] = [BEAK_GAP, PLAY, PLAY];
const RESTITUTIONS: [f64; 3] = [RESTITUTION, 0.0, 0.0];

/// Where slip ends (m/s): what is held drifts by round-off.
const NO_SLIP: f64 = 1e-12;

/// Sticks, or slips with a sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    Sticks,
    Slips(f64),
}

pub(super) type Closed = Option<(usize, Way)>;

fn inverse_mass() -> Matrix3<f64> {
    let arm = Vector3::new(1.0, SPRING, BIRD);
    let own = Vector3::new(SLEEVE_MASS, SLEEVE_INERTIA, BIRD_INERTIA);
    let mass = Matrix3::from_diagonal(&own) + arm * arm.transpose() * BIRD_MASS;
    mass.try_inverse().expect("it is positive definite")
}

fn rows(contact: usize) -> [Vector3<f64>; 2] {
    [NORMALS[contact], TANGENTS[contact]].map(Vector3::from)
}

/// What the velocities change by with a normal impulse of 1 and a tangential one, along both.
fn delassus(contact: usize) -> [[f64; 2]; 2] {
    let (inverse, rows) = (inverse_mass(), rows(contact));
    rows.map(|a| rows.map(|b| a.dot(&(inverse * b))))
}

/// Both efforts (N) for a way, such that what is closed does not accelerate.
fn efforts(contact: usize, way: Way, free: [f64; 2]) -> [f64; 2] {
    let [[nn, nt], [tn, tt]] = delassus(contact);
    match way {
        Way::Sticks => {
            let determinant = nn * tt - nt * tn;
            [
                (nt * free[1] - tt * free[0]) / determinant,
                (tn * free[0] - nn * free[1]) / determinant,
            ]
        }
        Way::Slips(sign) => {
            let normal = -free[0] / (nn - nt * sign * FRICTION);
            [normal, -sign * FRICTION * normal]
        }
    }
}

fn coordinates(motion: &Motion) -> [Vector3<f64>; 2] {
    let [a, b, c, d, e, f] = *motion;
    [Vector3::new(a, b, c), Vector3::new(d, e, f)]
}

fn accelerated(motion: &Motion, closed: Closed) -> (Vector3<f64>, [f64; 2]) {
    let ([q, _], inverse) = (coordinates(motion), inverse_mass());
    let twist = STIFFNESS * (q[1] - q[2]);
    let weight = Vector3::new(
        SLEEVE_MASS + BIRD_MASS,
        BIRD_MASS * SPRING,
        BIRD_MASS * BIRD,
    );
    let free = inverse * (Vector3::new(0.0, -twist, twist) - weight * GRAVITY);
    let Some((contact, way)) = closed else {
        return (free, [0.0; 2]);
    };
    let rows = rows(contact);
    let [n, t] = efforts(contact, way, rows.map(|row| row.dot(&free)));
    (free + inverse * (rows[0] * n + rows[1] * t), [n, t])
}

/// By the series of the solution, which is linear: `u'' = J u` from the second derivative on.
fn moved(motion: &Motion, closed: Closed, step: f64) -> Motion {
    let slope = |motion: &Motion| {
        let [_, u] = coordinates(motion);
        let (a, _) = accelerated(motion, closed);
        [u[0], u[1], u[2], a[0], a[1], a[2]]
    };
    let still = slope(&[0.0; 6]);
    let (mut sum, mut term, mut factor) = (*motion, slope(motion), step);
    for order in 2..=14 {
        for (sum, term) in sum.iter_mut().zip(term) {
            *sum += factor * term;
        }
        let next = slope(&term);
        term = core::array::from_fn(|k| next[k] - still[k]);
        factor *= step / f64::from(order);
    }
    sum
}

/// All that ends a phase where it becomes negative.
fn guards(motion: &Motion, closed: Closed) -> Vec<f64> {
    let [q, u] = coordinates(motion);
    let mut all = Vec::new();
    for (contact, gap) in GAPS.into_iter().enumerate() {
        let [normal, _] = rows(contact);
        all.push(if closed.is_some_and(|(at, _)| at == contact) {
            1.0
        } else {
            gap + normal.dot(&q)
        });
    }
    if let Some((contact, way)) = closed {
        let (_, [n, t]) = accelerated(motion, closed);
        all.push(n);
        all.push(match way {
            Way::Sticks => FRICTION * n - t.abs(),
            Way::Slips(sign) => sign * rows(contact)[1].dot(&u) + NO_SLIP,
        });
    }
    all
}

/// How what is closed goes on, after an impact or where its slip ends.
fn goes_on(motion: &Motion, contact: usize) -> Closed {
    let ([_, u], [_, tangent]) = (coordinates(motion), rows(contact));
    let slip = tangent.dot(&u);
    let ways = if slip.abs() > 2.0 * NO_SLIP {
        [Way::Slips(slip.signum()); 3]
    } else {
        [Way::Sticks, Way::Slips(1.0), Way::Slips(-1.0)]
    };
    ways.into_iter()
        .find(|&way| {
            let (a, [n, t]) = accelerated(motion, Some((contact, way)));
            let holds = match way {
                Way::Sticks => t.abs() <= FRICTION * n,
                Way::Slips(sign) => slip.abs() > 2.0 * NO_SLIP || sign * tangent.dot(&a) > 0.0,
            };
            n > 0.0 && holds
        })
        .map(|way| (contact, way))
}

/// Newton's restitution, and Coulomb's friction of the impulses.
fn hit(motion: &mut Motion, contact: usize) -> Closed {
    let ([_, u], rows) = (coordinates(motion), rows(contact));
    let before = rows.map(|row| row.dot(&u));
    let [[_, nt], [_, tt]] = delassus(contact);
    let wanted = [(1.0 + RESTITUTIONS[contact]) * before[0], before[1]];
    let [n, t] = [Way::Sticks, Way::Slips(1.0), Way::Slips(-1.0)]
        .into_iter()
        .find_map(|way| {
            let [n, t] = efforts(contact, way, wanted);
            let after = before[1] + nt * n + tt * t;
            let holds = match way {
                Way::Sticks => t.abs() <= FRICTION * n,
                Way::Slips(sign) => sign * after > 0.0,
            };
            (n > 0.0 && holds).then_some([n, t])
        })
        .expect("an impulse");
    let after = u + inverse_mass() * (rows[0] * n + rows[1] * t);
    motion[3..].copy_from_slice(after.as_slice());
    if RESTITUTIONS[contact] > 0.0 {
        return None;
    }
    goes_on(motion, contact)
}

/// Goes on to a time; calls with every motion at which the mode changes, or the beak pecks.
pub(super) fn run(
    (mut motion, mut closed): (Motion, Closed),
    end: f64,
    mut change: impl FnMut(f64, &Motion),
) -> (Motion, Closed) {
    let mut time = 0.0;
    while time < end {
        let step = f64::min(2e-4, end - time);
        let next = moved(&motion, closed, step);
        let before = guards(&motion, closed);
        let ends = |at: &Motion| {
            let now = guards(at, closed);
            let mut both = now.iter().zip(&before);
            both.position(|(&now, &before)| now < 0.0 && now < before)
        };
        if ends(&next).is_none() {
            (motion, time) = (next, time + step);
            continue;
        }
        let (mut low, mut high) = (0.0, step);
        while high - low > 1e-17 {
            let middle = 0.5 * (low + high);
            if ends(&moved(&motion, closed, middle)).is_some() {
                high = middle;
            } else {
                low = middle;
            }
        }
        (motion, time) = (moved(&motion, closed, high), time + high);
        let guard = ends(&motion).expect("it ends there");
        let was = closed;
        closed = match (guard, closed) {
            (contact @ 0..3, _) => hit(&mut motion, contact),
            (3, _) | (_, None) => None,
            (_, Some((contact, Way::Sticks))) => {
                let (_, [_, held]) = accelerated(&motion, closed);
                Some((contact, Way::Slips(-held.signum())))
            }
            (_, Some((contact, _))) => goes_on(&motion, contact),
        };
        if guard == 0 || was != closed {
            change(time, &motion);
        }
    }
    (motion, closed)
}
