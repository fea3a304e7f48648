//! Mechanisms with published data: to use, and to copy from.
//!
//! | model | what it is | good for | source |
//! |---|---|---|---|
//! | [`SimplePendulum`] | a point mass on a link | long runs against a closed form | IFToMM A01 |
//! | [`RodPendulum`] | a rod on a hinge | the example of the book, reactions | Flores 2015, chapter 15 |
//! | [`VariableLengthPendulum`] | an arm and a slider on springs and a damper | comparing formulations where energy is lost | Nikravesh, examples 13.6 and 13.7 |
//! | [`HeavyTop`] | a spinning top on a ball joint, 150 rad/s | large rotations | Brüls, Cardona and Arnold 2012 |
//! | [`SliderCrank`] | crank, rod and slider, 150 rad/s | a loop at high speed | Flores, Leine and Glocker 2010 |
//! | [`DrivenSliderCrank`] | the same with a motor | inverse dynamics | own motion |
//! | [`FourBar`], [`DoubleFourBar`], [`QuintupleFourBar`] | parallelograms | singular configurations | IFToMM A02 |
//! | [`SqueezingMechanism`] | Andrews' seven bodies and three loops | small times and masses, accuracy | IFToMM A03, Test Set for IVP Solvers |
//! | [`Bricard`] | a ring of six hinges that moves | dependent equations | IFToMM A04 |
//! | [`FlyballGovernor`] | balls, arms and a slider on stiff springs | stiffness | IFToMM A05 |
//! | [`Door`] | a leaf on two hinges | redundant equations | own data |
//! | [`CartPole`] | a pole on a cart | control, a closed form | Barto, Sutton and Anderson 1983 |
//! | [`Ur5`], [`Panda`] | arms of six and seven hinges | robots, forward dynamics against Pinocchio | `example-robot-data` |
//! | [`HeavyChain`] | 1000 kg on a chain of grams | a ratio of masses of 1e6 | own data |
//!
//! IFToMM: the library of benchmark problems of its Technical Committee for Multibody Dynamics. Models that move in a
//! plane are made of spatial bodies and joints. With the feature `problems`, `problems` has their motions with known answers. What follows from the initial configuration (a distance of points, an
//! axis on a body) is not written twice.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "problems")]
extern crate std;

mod bricard;
mod cart_pole;
mod door;
mod flyball_governor;
mod four_bar;
mod heavy_chain;
mod heavy_top;
mod panda;
#[cfg(feature = "problems")]
pub mod problems;
mod rod_pendulum;
mod simple_pendulum;
mod slider_crank;
mod squeezing_mechanism;
mod ur5;
mod variable_length_pendulum;

pub use bricard::Bricard;
pub use cart_pole::CartPole;
pub use door::Door;
pub use flyball_governor::FlyballGovernor;
pub use four_bar::{DoubleFourBar, FourBar, QuintupleFourBar};
pub use heavy_chain::HeavyChain;
pub use heavy_top::HeavyTop;
pub use panda::Panda;
pub use rod_pendulum::RodPendulum;
pub use simple_pendulum::SimplePendulum;
pub use slider_crank::{DrivenSliderCrank, SliderCrank};
pub use squeezing_mechanism::SqueezingMechanism;
pub use ur5::Ur5;
pub use variable_length_pendulum::VariableLengthPendulum;
