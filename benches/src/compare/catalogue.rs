//! Which mechanisms are compared.

use holonom::{Fault, JointCoordinates};
use holonom_assembler::assembler::Assembler;
#[cfg(feature = "large")]
use holonom_models::{
    Bricard, CartPole, DoubleFourBar, HeavyTop, Panda, QuintupleFourBar, SliderCrank,
    SqueezingMechanism, Ur5,
};
use holonom_models::{FourBar, RodPendulum};
use holonom_study::compare::measure::Scene;

use super::assemblers as by_hand;
#[cfg(feature = "large")]
use super::scenes::{
    AlternatingChain4, AlternatingChain8, RevoluteChain2, RevoluteChain4, RevoluteChain8,
    RevoluteChain16, RevoluteChain32, SphericalChain2, SphericalChain8,
};
#[cfg(feature = "huge")]
use super::scenes::{SphericalChain32, Windows10, Windows40};

/// The step of Runge-Kutta (s).
const STEP: f64 = 1e-3;
/// That of a mechanism that is stiff and small.
#[cfg(feature = "large")]
const SHORT: f64 = 1e-5;

/// A mechanism to be compared.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name.
    pub scene: &'static str,
    /// Links of a chain or windows of a row; 1 for all others.
    pub n: usize,
    /// The step (s) of Runge-Kutta, and between the states that are evaluated.
    pub step: f64,
    /// Makes its cases.
    pub prepare: fn(&Self) -> Result<Scene, Fault>,
    /// The same by the run-time assembler.
    pub assembler: Option<fn() -> Assembler>,
}

impl Entry {
    const fn of<M: JointCoordinates + Default>(
        scene: &'static str,
        n: usize,
        assembler: Option<fn() -> Assembler>,
    ) -> Self {
        Self {
            scene,
            n,
            step: STEP,
            prepare: |entry| Scene::of::<M>(entry.scene, entry.n, entry.step),
            assembler,
        }
    }
}

/// Links on parallel hinges.
#[cfg(feature = "large")]
fn revolute<M: JointCoordinates + Default>(n: usize) -> Entry {
    Entry::of::<M>("revolute-chain", n, Some(by_hand::revolute_chain::<M>))
}

/// Links on hinges at right angles in turn.
#[cfg(feature = "large")]
fn alternating<M: JointCoordinates + Default>(n: usize) -> Entry {
    Entry::of::<M>(
        "alternating-chain",
        n,
        Some(by_hand::alternating_chain::<M>),
    )
}

/// Links on balls.
#[cfg(feature = "large")]
fn spherical<M: JointCoordinates + Default>(n: usize) -> Entry {
    Entry::of::<M>("spherical-chain", n, Some(by_hand::spherical_chain::<M>))
}

/// Four-bar windows.
fn windows<M: JointCoordinates + Default>(n: usize) -> Entry {
    Entry::of::<M>("four-bar", n, Some(by_hand::windows::<M>))
}

/// All of them in the order of the page, two without the feature `large`: every one is compiled for
/// two descriptions, four formulations and two number types. The longest are there with `huge`.
#[must_use]
pub fn entries() -> Vec<Entry> {
    [
        Entry::of::<RodPendulum>("pendulum", 1, Some(by_hand::pendulum)),
        #[cfg(feature = "large")]
        revolute::<RevoluteChain2>(2),
        #[cfg(feature = "large")]
        revolute::<RevoluteChain4>(4),
        #[cfg(feature = "large")]
        revolute::<RevoluteChain8>(8),
        #[cfg(feature = "large")]
        revolute::<RevoluteChain16>(16),
        #[cfg(feature = "large")]
        revolute::<RevoluteChain32>(32),
        #[cfg(feature = "large")]
        alternating::<AlternatingChain4>(4),
        #[cfg(feature = "large")]
        alternating::<AlternatingChain8>(8),
        #[cfg(feature = "large")]
        spherical::<SphericalChain2>(2),
        #[cfg(feature = "large")]
        spherical::<SphericalChain8>(8),
        #[cfg(feature = "huge")]
        spherical::<SphericalChain32>(32),
        windows::<FourBar>(1),
        #[cfg(feature = "large")]
        windows::<DoubleFourBar>(2),
        #[cfg(feature = "large")]
        windows::<QuintupleFourBar>(5),
        #[cfg(feature = "huge")]
        windows::<Windows10>(10),
        #[cfg(feature = "huge")]
        windows::<Windows40>(40),
        #[cfg(feature = "large")]
        Entry::of::<SliderCrank>("slider-crank", 1, Some(by_hand::slider_crank)),
        #[cfg(feature = "large")]
        Entry::of::<HeavyTop>("heavy-top", 1, Some(by_hand::heavy_top)),
        #[cfg(feature = "large")]
        Entry::of::<CartPole>("cart-pole", 1, Some(by_hand::cart_pole)),
        #[cfg(feature = "large")]
        Entry::of::<Ur5>("ur5", 1, Some(by_hand::ur5)),
        #[cfg(feature = "large")]
        Entry::of::<Panda>("panda", 1, Some(by_hand::panda)),
        #[cfg(feature = "large")]
        Entry {
            step: SHORT,
            ..Entry::of::<SqueezingMechanism>("squeezer", 1, Some(by_hand::squeezer))
        },
        // One of its equations follows from the others, which the assembler cannot leave out.
        #[cfg(feature = "large")]
        Entry::of::<Bricard>("bricard", 1, None),
    ]
    .into()
}

/// The names of the scenes, each once.
#[must_use]
pub fn names() -> Vec<&'static str> {
    let mut names: Vec<_> = entries().iter().map(|entry| entry.scene).collect();
    names.dedup();
    names
}
