//! Rigid displacements, and how fast they go on.

use super::geometry::turned;
use crate::model::inertia::{IDENTITY, compose, rotation};

/// A rotation about the origin, and then a translation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Displacement {
    /// Euler parameters.
    rotation: [f64; 4],
    translation: [f64; 3],
}

impl Displacement {
    /// Everything stays where it is.
    pub(super) const NONE: Self = Self {
        rotation: IDENTITY,
        translation: [0.0; 3],
    };

    /// A translation.
    pub(super) const fn along(translation: [f64; 3]) -> Self {
        Self {
            rotation: IDENTITY,
            translation,
        }
    }

    /// A rotation by a vector about a point.
    pub(super) fn about(point: [f64; 3], by: [f64; 3]) -> Self {
        let rotation = turned(IDENTITY, by);
        let turned = apply(rotation, point);
        Self {
            rotation,
            translation: [0, 1, 2].map(|k| point[k] - turned[k]),
        }
    }

    /// This one after another.
    pub(super) fn after(&self, other: &Self) -> Self {
        Self {
            rotation: compose(self.rotation, other.rotation),
            translation: self.of_point(other.translation),
        }
    }

    /// The way back.
    pub(super) fn inverse(&self) -> Self {
        let [e0, e1, e2, e3] = self.rotation;
        let rotation = [e0, -e1, -e2, -e3];
        Self {
            rotation,
            translation: apply(rotation, self.translation).map(|x| -x),
        }
    }

    /// Where a point gets.
    pub(super) fn of_point(&self, point: [f64; 3]) -> [f64; 3] {
        let turned = apply(self.rotation, point);
        [0, 1, 2].map(|k| turned[k] + self.translation[k])
    }

    /// What Euler parameters become.
    pub(super) fn of_orientation(&self, p: [f64; 4]) -> [f64; 4] {
        compose(self.rotation, p)
    }
}

/// A vector after a rotation.
pub(super) fn apply(p: [f64; 4], vector: [f64; 3]) -> [f64; 3] {
    let rows = rotation(p);
    rows.map(|row| row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2])
}

/// A velocity and an angular velocity of what is rigid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Twist {
    /// The angular velocity.
    pub(super) spin: [f64; 3],
    /// The velocity of what passes the origin.
    velocity: [f64; 3],
}

impl Twist {
    /// A translation.
    pub(super) const fn along(velocity: [f64; 3]) -> Self {
        Self {
            spin: [0.0; 3],
            velocity,
        }
    }

    /// A rotation about a point.
    pub(super) fn about(point: [f64; 3], spin: [f64; 3]) -> Self {
        Self {
            spin,
            velocity: cross(point, spin),
        }
    }

    /// A rotation about an axis through a point, and a translation along it in proportion.
    pub(super) fn screw(point: [f64; 3], axis: [f64; 3], advance: f64) -> Self {
        let around = cross(point, axis);
        Self {
            spin: axis,
            velocity: [0, 1, 2].map(|k| around[k] + advance * axis[k]),
        }
    }

    /// The velocity of a point.
    pub(super) fn at(&self, point: [f64; 3]) -> [f64; 3] {
        let around = cross(self.spin, point);
        [0, 1, 2].map(|k| self.velocity[k] + around[k])
    }

    /// The same, displaced with what it moves.
    pub(super) fn carried(&self, by: &Displacement) -> Self {
        let spin = apply(by.rotation, self.spin);
        let velocity = apply(by.rotation, self.velocity);
        let around = cross(by.translation, spin);
        Self {
            spin,
            velocity: [0, 1, 2].map(|k| velocity[k] + around[k]),
        }
    }
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(k, l)| a[k] * b[l] - a[l] * b[k])
}

#[cfg(test)]
mod tests {
    use super::{Displacement, Twist};

    const POINT: [f64; 3] = [0.3, -0.7, 0.2];

    fn assert_near(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
        for (x, y) in found.into_iter().zip(expected) {
            assert!((x - y).abs() < tolerance, "{found:?} is not {expected:?}");
        }
    }

    #[test]
    fn the_way_back_leads_back() {
        let there = Displacement::about([1.0, 2.0, 3.0], [0.4, -0.5, 0.6]);
        let there = Displacement::along([0.1, 0.2, -0.3]).after(&there);
        assert_near(
            there.inverse().of_point(there.of_point(POINT)),
            POINT,
            1e-15,
        );
        let nowhere = there.after(&there.inverse());
        assert_near(nowhere.of_point(POINT), POINT, 1e-15);
    }

    /// A twist is the rate of a displacement, where it acts first and where it is carried.
    #[test]
    fn twists_are_rates_of_displacements() {
        const STEP: f64 = 1e-5;
        let (centre, spin) = ([0.5, 0.1, -0.4], [0.2, 0.9, -0.3]);
        let before = Displacement::about([1.0, -1.0, 0.5], [0.7, 0.1, 0.3]);
        let before = Displacement::along([0.3, 0.0, 0.9]).after(&before);
        let place = |amount: f64| {
            let small = Displacement::about(centre, spin.map(|x| amount * x));
            before.after(&small).of_point(POINT)
        };
        let (back, on) = (place(-STEP), place(STEP));
        let rate = [0, 1, 2].map(|k| (on[k] - back[k]) / (2.0 * STEP));
        let twist = Twist::about(centre, spin).carried(&before);
        assert_near(twist.at(before.of_point(POINT)), rate, 1e-9);
        assert_near(Twist::about(centre, spin).at(centre), [0.0; 3], 1e-15);
    }
}
