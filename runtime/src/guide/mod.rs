//! The guide: how to describe a mechanism, run it and read it, chapter by chapter.
//!
//! | chapter | what it answers |
//! |---|---|
//! | [`mechanism`] | how bodies, joints and the start are described; how joints are chosen so that the count of equations comes out |
//! | [`mod@reference`] | the whole language on one page: every attribute, every joint with axes, zeros and signs |
//! | [`joint`] | how a joint of one's own is defined |
//! | [`forces`] | gravity, springs, actuators, closures; drivers, kinematics and inverse dynamics; power and energy |
//! | [`parameters`] | numbers that are known at run time only, and inputs that change at every step |
//! | [`results`] | what can be read, in which units, frames and signs; state and restart |
//! | [`reactions`] | what a joint exerts on which body, reduced to which point; body axes and principal axes |
//! | [`redundant`] | equations that follow from others, singular configurations, and joints that avoid both |
//! | [`embedded`] | fixed steps without a heap and without the standard library, single precision |
//! | [`choosing`] | formulations and integrators |
//!
//! Every example is compiled and run with the tests of the crate, and what the text says of its numbers is asserted in it.
//! Equations stand twice: typeset, where the page could load KaTeX, and as plain text.

#[doc = include_str!("mechanism.md")]
pub mod mechanism {}

#[doc = include_str!("reference.md")]
pub mod reference {}

#[doc = include_str!("joint.md")]
pub mod joint {}

#[doc = include_str!("forces.md")]
pub mod forces {}

#[doc = include_str!("parameters.md")]
pub mod parameters {}

#[doc = include_str!("results.md")]
pub mod results {}

#[doc = include_str!("reactions.md")]
pub mod reactions {}

#[doc = include_str!("redundant.md")]
pub mod redundant {}

#[doc = include_str!("embedded.md")]
pub mod embedded {}

#[doc = include_str!("choosing.md")]
pub mod choosing {}
