//! What an interaction can do along its quantity: efforts, impulses, and the ends of its modes.
//!
//! Efforts and impulses are positive upwards. Those of friction by load are over that load. What
//! solves for efforts and modes asks a law nothing else: another law is another answer.

use crate::math::scalar::Real;
use crate::nonsmooth::bearing::Bearing;
use crate::nonsmooth::mode::InteractionMode;

/// An approach below this part of the fastest one has no restitution.
const REST: f64 = 1e-4;

/// Nor has one that leads to less of a height than so many `EPSILON`, which go with its square.
const HEIGHT: f64 = 1e3;

/// The efforts that are possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Law<S> {
    Limits(Limits<S>),
    Friction(Friction<S>),
}

/// Two ends that a quantity does not pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limits<S> {
    pub(crate) bounds: [S; 2],
    pub(crate) restitution: S,
    /// Restitution is of impulses (Poisson), and not of rates (Newton).
    pub(crate) is_of_impulses: bool,
    /// An approach below this rate, or below a part of the fastest one, has no restitution.
    pub(crate) rest: Rest<S>,
}

/// From which approach on there is no restitution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rest<S> {
    /// Below a rate.
    Below(S),
    /// Below a part of the fastest approach so far.
    Part(S),
}

/// Dry friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Friction<S> {
    /// The largest effort while it slides; over the load of its bearing, where it has one.
    pub(crate) capacity: S,
    /// The largest effort while it sticks, where it is another.
    pub(crate) stiction: Option<S>,
    /// The rate at which the one has fallen towards the other.
    pub(crate) stribeck: Option<S>,
    pub(crate) is_engaged: bool,
    /// A freewheel: its efforts and impulses are never negative.
    pub(crate) is_one_way: bool,
    /// What bears the load that it goes with.
    pub(crate) bearing: Option<Bearing<S>>,
    /// The contact whose effort it goes with.
    pub(crate) tangent: Option<Tangent>,
}

/// Where friction of a contact stands in a list: behind its contact, in one direction of its plane
/// or in both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tangent {
    /// So many places behind.
    pub(crate) behind: usize,
    pub(crate) has_both: bool,
}

/// A setting that is not acceptable, with its value.
type Refused<S> = (&'static str, S);

impl<S: Real> Law<S> {
    /// The mode before a run has found one.
    pub(crate) fn first_mode(&self) -> InteractionMode {
        self.idle_mode()
    }

    /// Whether it is engaged at the start. Limits always are.
    pub(crate) fn is_engaged(&self) -> bool {
        self.friction().is_none_or(|friction| friction.is_engaged)
    }

    pub(crate) fn limits(&self) -> Option<&Limits<S>> {
        match self {
            Self::Limits(limits) => Some(limits),
            Self::Friction(_) => None,
        }
    }

    pub(crate) fn friction(&self) -> Option<&Friction<S>> {
        match self {
            Self::Friction(friction) => Some(friction),
            Self::Limits(_) => None,
        }
    }

    /// What bears the load that it goes with.
    pub(crate) fn bearing(&self) -> Option<&Bearing<S>> {
        self.friction()?.bearing.as_ref()
    }

    /// Where it stands, as friction of a contact.
    pub(crate) fn tangent(&self) -> Option<Tangent> {
        self.friction()?.tangent
    }

    /// The mode of friction while nothing may rub.
    pub(crate) fn idle_mode(&self) -> InteractionMode {
        if self.friction().is_some() && self.tangent().is_none() {
            InteractionMode::Released
        } else {
            InteractionMode::Free
        }
    }

    /// The value at which a mode holds the quantity, where the law has it.
    pub(crate) fn held_at(&self, mode: InteractionMode) -> Option<S> {
        let [lower, upper] = self.limits()?.bounds;
        match mode {
            InteractionMode::AtLower => Some(lower),
            InteractionMode::AtUpper => Some(upper),
            _ => None,
        }
    }

    /// The limit that is nearest to a value.
    pub(crate) fn nearest(&self, value: S) -> Option<S> {
        let limits = self.limits()?;
        let (_, is_lower) = limits.gap(value);
        let [lower, upper] = limits.bounds;
        Some(if is_lower { lower } else { upper })
    }

    /// Refuses settings that are not acceptable.
    pub(crate) fn check(&self) -> Result<(), Refused<S>> {
        match self {
            Self::Limits(limits) => limits.check(),
            Self::Friction(friction) => friction.check(),
        }
    }
}

impl<S: Real> Limits<S> {
    /// Without restitution.
    pub(crate) fn between(bounds: [S; 2]) -> Self {
        Self {
            bounds,
            restitution: S::zero(),
            is_of_impulses: false,
            rest: Rest::by_default(),
        }
    }

    /// How far a value is from the nearer one, negative beyond it, and whether that is the lower
    /// one.
    pub(crate) fn gap(&self, value: S) -> (S, bool) {
        let [lower, upper] = self.bounds;
        let (above, below) = (value - lower, upper - value);
        (above.min(below), above <= below)
    }

    /// The limit that pushes with this sign.
    pub(crate) fn bound(&self, sign: S) -> S {
        let [lower, upper] = self.bounds;
        if sign > S::zero() { lower } else { upper }
    }

    /// The rate below which it rests, beside the fastest approach so far.
    pub(crate) fn least(&self, fastest: S) -> S {
        match self.rest {
            Rest::Below(rate) => rate,
            Rest::Part(part) => part * fastest,
        }
    }

    /// The restitution of an approach, beside the fastest one so far.
    pub(crate) fn restitution(&self, approach: S, fastest: S) -> S {
        if approach < self.least(fastest) {
            S::zero()
        } else {
            self.restitution
        }
    }

    fn check(&self) -> Result<(), Refused<S>> {
        let ([lower, upper], zero) = (self.bounds, S::zero());
        if lower >= upper || is_nan(lower) || is_nan(upper) {
            return Err(("lower limit", lower));
        }
        if !(self.restitution >= zero && self.restitution <= S::one()) {
            return Err(("restitution", self.restitution));
        }
        let (Rest::Below(rate) | Rest::Part(rate)) = self.rest;
        if !(rate >= zero && rate.is_finite()) {
            return Err(("rate of rest", rate));
        }
        Ok(())
    }
}

/// Efforts and impulses of a limit that pushes with a sign: it does not pull.
pub(crate) fn pushes<S: Real>(sign: S) -> [S; 2] {
    let infinite = S::constant(f64::INFINITY);
    if sign > S::zero() {
        [S::zero(), infinite]
    } else {
        [-infinite, S::zero()]
    }
}

impl<S: Real> Rest<S> {
    /// Where nothing is said.
    pub(crate) fn by_default() -> Self {
        let resolved = (S::constant(HEIGHT) * S::EPSILON).sqrt();
        Self::Part(S::constant(REST).max(resolved))
    }
}

impl<S: Real> Friction<S> {
    /// Coulomb's, engaged.
    pub(crate) fn of(capacity: S) -> Self {
        Self {
            capacity,
            stiction: None,
            stribeck: None,
            is_engaged: true,
            is_one_way: false,
            bearing: None,
            tangent: None,
        }
    }

    /// Of a contact.
    pub(crate) fn of_contact(coefficient: S, tangent: Tangent) -> Self {
        Self {
            tangent: Some(tangent),
            ..Self::of(coefficient)
        }
    }

    /// With all of its capacities times a factor.
    pub(crate) fn scaled(self, factor: S) -> Self {
        Self {
            capacity: factor * self.capacity,
            stiction: self.stiction.map(|stiction| factor * stiction),
            ..self
        }
    }

    /// The largest effort while it sticks.
    pub(crate) fn at_rest(&self) -> S {
        self.stiction.unwrap_or(self.capacity)
    }

    /// The least and the largest effort while it sticks.
    pub(crate) fn bounds(&self) -> [S; 2] {
        self.between(self.at_rest())
    }

    /// The least and the largest effort of a capacity that is known otherwise, as by a load.
    pub(crate) fn between(&self, capacity: S) -> [S; 2] {
        [self.downwards(capacity), capacity]
    }

    /// The effort of sliding at a rate of a sign, which the rate may not have yet.
    pub(crate) fn effort(&self, sign: S, rate: S) -> S {
        if sign > S::zero() {
            self.downwards(self.against(rate))
        } else {
            self.against(rate)
        }
    }

    /// An effort or an impulse of a size against a positive rate.
    fn downwards(&self, size: S) -> S {
        if self.is_one_way { S::zero() } else { -size }
    }

    /// Whether what slips at an end of its bounds, with about this effort, turns freely upwards.
    pub(crate) fn is_overrun(&self, effort: S) -> bool {
        self.is_one_way && effort < S::constant(0.5) * self.at_rest()
    }

    /// The size of the effort against sliding at a rate.
    fn against(&self, rate: S) -> S {
        let (Some(stiction), Some(stribeck)) = (self.stiction, self.stribeck) else {
            return self.capacity;
        };
        let part = rate.quotient(stribeck);
        (stiction - self.capacity).fused((-(part * part)).exp(), self.capacity)
    }

    /// The impulses by which it stops its quantity at once; `None` where it has efforts alone.
    pub(crate) fn impulses(&self) -> Option<[S; 2]> {
        let infinite = S::constant(f64::INFINITY);
        (!self.capacity.is_finite()).then_some([self.downwards(infinite), infinite])
    }

    /// Whether it stops a rate at once.
    pub(crate) fn stops(&self, rate: S) -> bool {
        self.impulses().is_some_and(|[lower, upper]| {
            if rate > S::zero() {
                lower < S::zero()
            } else {
                upper > S::zero()
            }
        })
    }

    fn check(&self) -> Result<(), Refused<S>> {
        let is_coefficient = self.capacity >= S::zero() && self.capacity.is_finite();
        if self.tangent.is_some() && !is_coefficient {
            return Err(("coefficient", self.capacity));
        }
        if self.capacity < S::zero() || is_nan(self.capacity) {
            return Err(("capacity", self.capacity));
        }
        if let Some(stiction) = self.stiction
            && (stiction < self.capacity || is_nan(stiction))
        {
            return Err(("stiction", stiction));
        }
        match self.stribeck {
            Some(rate) if !(rate > S::zero() && rate.is_finite() && self.stiction.is_some()) => {
                Err(("stribeck", rate))
            }
            _ => Ok(()),
        }
    }
}

fn is_nan<S: Real>(number: S) -> bool {
    number.to_f64().is_nan()
}
