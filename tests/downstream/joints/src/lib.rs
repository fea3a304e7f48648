//! Joints that a user defines in a crate of their own, where `holonom` bears another name.
//!
//! Each is a type like those of `holonom::joints`; two bear the name of a built-in joint and are
//! something else.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(test)]
extern crate std;

pub mod averaging;
pub mod differences;
mod slider;
mod swing;
mod telescope;

pub use slider::Slider;
pub use swing::{Bob, Swing};
pub use telescope::Telescope;

kinematics::joint! {
    /// A massless rod between a point of one body and a point of another.
    pub joint Rod(i, j; head: Point, tail: Point, length: Length) {
        squared(j.tail - i.head) - length * length;
    }
}

kinematics::joint! {
    /// A shaft that turns in a bush and slides along it: not the built-in joint of this name.
    pub joint Revolute(i, j; pin: Point, axis: Axis) {
        dot(i.axis.normals(), j.axis);
        dot(i.axis.normals(), j.pin - i.pin);
        angle about axis;
    }
}

kinematics::joint! {
    /// A ball that keeps a distance from its socket, given by a vector on the socket: not the
    /// built-in joint of this name.
    pub joint Spherical(i, j; point: Point, seat: Vector, play: Number) {
        j.point - i.point - play * i.seat;
    }
}

kinematics::joint! {
    /// A body whose centre of mass stays on a sphere about the global origin; one body is enough.
    pub joint OnSphere(i; radius: Length) {
        0.5 * (squared(i.origin) - radius * radius);
    }
}

#[cfg(test)]
mod tests;
