//! What the printer prints: the tests `robots` write it.

#![allow(unreachable_pub, reason = "what is printed is for a crate of its own")]

pub(crate) mod crane;
pub(crate) mod double_pendulum;
pub(crate) mod gripper;
pub(crate) mod panda;
pub(crate) mod so100;
pub(crate) mod ur5;
