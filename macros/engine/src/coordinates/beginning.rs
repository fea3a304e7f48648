//! What all ways to the equations of motion begin with, found once for a mechanism: a tree, and
//! what numbers tell of the rows that close its loops.

use std::cell::OnceCell;

use super::spanning::Spanning;
use crate::model::Model;
use crate::rank::closing::{self, Free, Place};

/// What is common to all strategies.
pub struct Beginning<'a> {
    /// The mechanism.
    pub(super) model: &'a Model,
    /// Its tree.
    pub(super) spanning: Spanning,
    following: OnceCell<Vec<(usize, usize)>>,
    stops: OnceCell<Vec<Place>>,
    free: OnceCell<Option<Free>>,
    elsewhere: OnceCell<Vec<Place>>,
}

impl<'a> Beginning<'a> {
    /// The tree of a mechanism; numbers are asked when they are needed.
    #[must_use]
    pub fn new(model: &'a Model) -> Self {
        Self {
            model,
            spanning: Spanning::new(model),
            following: OnceCell::new(),
            stops: OnceCell::new(),
            free: OnceCell::new(),
            elsewhere: OnceCell::new(),
        }
    }

    /// The equations, by joint and place, of the closing joints that follow from all others and
    /// from each other; none where nothing can be told.
    pub(super) fn following(&self) -> &[(usize, usize)] {
        self.following.get_or_init(|| {
            closing::following(&self.whole(), &self.spanning.closing).unwrap_or_default()
        })
    }

    /// Times and coordinates of the bodies along a sweep; none where nothing can move or be told.
    pub(super) fn stops(&self) -> &[Place] {
        self.stops.get_or_init(|| closing::stops(&self.whole()))
    }

    /// What the constraints leave free; none where nothing can be told.
    pub(super) fn free(&self) -> Option<&Free> {
        self.free.get_or_init(|| Free::of(&self.whole())).as_ref()
    }

    /// Times and coordinates of the bodies far from the sweep, on other branches where there are
    /// some.
    pub(super) fn elsewhere(&self) -> &[Place] {
        self.elsewhere.get_or_init(|| {
            let places = self.free().zip(self.stops().first());
            let places = places.map(|(free, about)| free.elsewhere(&self.whole(), about));
            places.unwrap_or_default()
        })
    }

    /// The mechanism with all its equations.
    fn whole(&self) -> Model {
        let mut whole = self.model.clone();
        let joints = whole.joints.iter_mut();
        joints.for_each(|joint| joint.dropped.clear());
        whole
    }
}
