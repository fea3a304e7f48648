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
//! | [`Clock`] | a pendulum with dry friction and a wheel that a dog holds | interactions: friction, events, dogs | Andronov, Vitt and Khaikin 1966 |
//! | [`Ur5`], [`Panda`] | arms of six and seven hinges | robots, forward dynamics against Pinocchio | `example-robot-data` |
//! | [`Bicycle`] | the benchmark bicycle, two wheels that roll | equations of velocities, stability over the speed | Meijaard, Papadopoulos, Ruina and Schwab 2007 |
//! | [`HeavyChain`] | 1000 kg on a chain of grams | a ratio of masses of 1e6 | own data |
//!
//! IFToMM: the library of benchmark problems of its Technical Committee for Multibody Dynamics.
//! Models that move in a plane are made of spatial bodies and joints. With the feature `problems`,
//! `problems` has their motions with known answers. What follows from the initial configuration (a
//! distance of points, an axis on a body) is not written twice.
//!
//! Every model but [`RodPendulum`] has a feature of its name, such as `slider-crank`: with default
//! features off, only what is asked for is compiled. `catalogue`, the default, is all of them.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "problems")]
extern crate std;

#[cfg(feature = "bicycle")]
mod bicycle;
#[cfg(feature = "bricard")]
mod bricard;
#[cfg(feature = "cart-pole")]
mod cart_pole;
#[cfg(feature = "clock")]
mod clock;
#[cfg(feature = "door")]
mod door;
#[cfg(feature = "flyball-governor")]
mod flyball_governor;
#[cfg(feature = "four-bar")]
mod four_bar;
#[cfg(feature = "four-bars")]
mod four_bars;
#[cfg(feature = "heavy-chain")]
mod heavy_chain;
#[cfg(feature = "heavy-top")]
mod heavy_top;
#[cfg(feature = "panda")]
mod panda;
#[cfg(feature = "problems")]
pub mod problems;
mod rod_pendulum;
#[cfg(feature = "simple-pendulum")]
mod simple_pendulum;
#[cfg(feature = "slider-crank")]
mod slider_crank;
#[cfg(feature = "squeezing-mechanism")]
mod squeezing_mechanism;
#[cfg(feature = "ur5")]
mod ur5;
#[cfg(feature = "variable-length-pendulum")]
mod variable_length_pendulum;

#[cfg(feature = "bicycle")]
pub use bicycle::Bicycle;
#[cfg(feature = "bricard")]
pub use bricard::Bricard;
#[cfg(feature = "cart-pole")]
pub use cart_pole::CartPole;
#[cfg(feature = "clock")]
pub use clock::Clock;
#[cfg(feature = "door")]
pub use door::Door;
#[cfg(feature = "flyball-governor")]
pub use flyball_governor::FlyballGovernor;
#[cfg(feature = "four-bar")]
pub use four_bar::FourBar;
#[cfg(feature = "four-bars")]
pub use four_bars::{DoubleFourBar, QuintupleFourBar};
#[cfg(feature = "heavy-chain")]
pub use heavy_chain::HeavyChain;
#[cfg(feature = "heavy-top")]
pub use heavy_top::HeavyTop;
#[cfg(feature = "panda")]
pub use panda::Panda;
pub use rod_pendulum::RodPendulum;
#[cfg(feature = "simple-pendulum")]
pub use simple_pendulum::SimplePendulum;
#[cfg(feature = "slider-crank")]
pub use slider_crank::{DrivenSliderCrank, SliderCrank};
#[cfg(feature = "squeezing-mechanism")]
pub use squeezing_mechanism::SqueezingMechanism;
#[cfg(feature = "ur5")]
pub use ur5::Ur5;
#[cfg(feature = "variable-length-pendulum")]
pub use variable_length_pendulum::VariableLengthPendulum;

/// The example of the README is compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
