//! What a run that goes on knows of its interactions.
//!
//! The last reading is not among it: a look into the next step takes another one first. Nor is what
//! passes between impulses and modes, which are found at one instant.

use crate::integrate::Memory;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::pace::Pace;
use crate::nonsmooth::status::{Impact, Status, Tracked};

/// In the order in which checkpoints count them.
const MODES: [InteractionMode; 8] = [
    InteractionMode::Free,
    InteractionMode::AtLower,
    InteractionMode::AtUpper,
    InteractionMode::Sticking,
    InteractionMode::SlidingUp,
    InteractionMode::SlidingDown,
    InteractionMode::Released,
    InteractionMode::Slipping,
];

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// Hands over the status, with all that was said of the interaction.
    pub(crate) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        // Without a heap there is no checkpoint, and no text in the program.
        #[cfg(feature = "std")]
        memory.label(&std::format!("{:?}", self.interaction));
        self.status.remember(memory);
    }
}

impl<S: Real> Status<S> {
    fn remember(&mut self, memory: &mut Memory<'_, S>) {
        let place = MODES.iter().position(|mode| *mode == self.mode);
        let mut place = place.unwrap_or(0);
        memory.variant(&mut place, MODES.len());
        self.mode = MODES.get(place).copied().unwrap_or(self.mode);
        memory.flag(&mut self.is_engaged);
        memory.flag(&mut self.is_asked);
        memory.flag(&mut self.is_found);
        memory.flag(&mut self.rests);
        memory.flag(&mut self.is_saturated);
        memory.flag(&mut self.begins);
        memory.flag(&mut self.ends);
        let [x, y, z] = &mut self.slip;
        let numbers = [
            x,
            y,
            z,
            &mut self.exerted.size,
            &mut self.held,
            &mut self.exerted.effort,
            &mut self.share,
            &mut self.since,
            &mut self.kept_from,
            &mut self.exerted.capacity,
            &mut self.exerted.determinant,
            &mut self.began,
            &mut self.fastest,
            &mut self.largest,
            &mut self.farthest,
        ];
        for number in numbers {
            memory.number(number);
        }
        memory.optional(&mut self.beginning);
        self.exerted.haste.remember(memory);
        memory.flag(&mut self.has_turned);
        Pace::remember(&mut self.pace, memory);
        Pace::remember(&mut self.known_pace, memory);
        self.remember_side(memory);
        let blow = Impact {
            time: S::zero(),
            impulse: S::zero(),
            rates: [S::zero(); 2],
            lost_energy: S::zero(),
        };
        several(memory, &mut self.impact, blow, |impact| {
            let [before, after] = &mut impact.rates;
            [
                &mut impact.time,
                &mut impact.impulse,
                before,
                after,
                &mut impact.lost_energy,
            ]
        });
    }
}

/// Numbers that are there together or not at all.
fn several<S: Real, T: Copy, const N: usize>(
    memory: &mut Memory<'_, S>,
    all: &mut Option<T>,
    otherwise: T,
    numbers: impl FnOnce(&mut T) -> [&mut S; N],
) {
    let mut is_there = all.is_some();
    memory.flag(&mut is_there);
    let mut read = all.unwrap_or(otherwise);
    if is_there {
        for number in numbers(&mut read) {
            memory.number(number);
        }
    }
    *all = is_there.then_some(read);
}
