//! What is refused of an interaction, by the name of its joint or point.

use crate::error::{Fault, ModeFault, OF_ITSELF, StartFault};
use crate::math::scalar::Real;
use crate::mechanism::kernels::{Mechanism, have_equations};
use crate::nonsmooth::bearing::Bearing;
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::law::{Friction, Law, Limits, Tangent};
use crate::nonsmooth::quantity::{JointReading, Quantity};
use crate::nonsmooth::status::Tracked;

impl<S: Real, M: Mechanism> Interaction<S, M> {
    fn refused(&self, setting: &'static str, value: S) -> Result<(), Fault> {
        Err(Fault::Start(StartFault::InteractionSetting {
            joint: self.name(),
            setting,
            value: value.to_f64(),
        }))
    }

    /// Refuses settings of friction by load, and a joint whose load is not determined.
    fn check_bearing(&self, friction: &Friction<S>, bearing: &Bearing<S>) -> Result<(), Fault> {
        have_equations::<M>()?;
        let joint = self.name();
        let refuse = |setting, value| self.refused(setting, value);
        let Quantity::Joint(reading) = self.quantity else {
            return Err(Fault::Mode(ModeFault::LoadNotUnique { joint }));
        };
        let info = M::REPORT.joints.get(reading.joint());
        if info.is_none_or(|info| !info.undetermined.is_empty()) {
            return Err(Fault::Mode(ModeFault::LoadNotUnique { joint }));
        }
        if !friction.at_rest().is_finite() {
            return refuse("coefficient", friction.at_rest());
        }
        let is_length = |length: S| length > S::zero() && length.is_finite();
        let turns = matches!(reading, JointReading::Angle(_));
        let radius = bearing.radius.unwrap_or(S::zero());
        let needs_radius = bearing.radius.is_some() || bearing.collar.is_none();
        if turns && needs_radius && !is_length(radius) {
            return refuse("radius", radius);
        }
        let lengths = [("guide", bearing.half_length), ("collar", bearing.collar)];
        for (setting, length) in lengths {
            if let Some(length) = length.filter(|&length| !is_length(length)) {
                return refuse(setting, length);
            }
        }
        Ok(())
    }

    /// Refuses distances that have no direction.
    fn check_distances(&self, limits: &Limits<S>) -> Result<(), Fault> {
        let has_direction = |bound: &S| !bound.is_finite() || *bound > S::zero();
        let [lower, _] = limits.bounds;
        match limits.bounds.iter().find(|bound| !has_direction(bound)) {
            Some(bound) if *bound == lower => self.refused("least distance", lower),
            Some(bound) => self.refused("greatest distance", *bound),
            None => Ok(()),
        }
    }

    /// Refuses settings that are not acceptable.
    pub(crate) fn check(&self) -> Result<(), Fault> {
        let joint = self.name();
        let refuse = |setting, value| self.refused(setting, value);
        if let Some(setting) = self.misplaced {
            return Err(Fault::Start(StartFault::MisplacedSetting {
                joint,
                setting,
            }));
        }
        if let Quantity::Gap(_, surface, shape) = self.quantity
            && let Err((setting, length)) = surface.check(&shape)
        {
            return refuse(setting, length);
        }
        if let (Quantity::Distance(..), Some(limits)) = (self.quantity, self.law.limits()) {
            self.check_distances(limits)?;
        }
        if let Err((setting, value)) = self.law.check() {
            return refuse(setting, value);
        }
        if let Law::Friction(friction) = &self.law {
            if let Some(bearing) = &friction.bearing {
                self.check_bearing(friction, bearing)?;
            }
            if let Quantity::Difference(first, second, ratio) = self.quantity {
                if first == second {
                    return refuse(OF_ITSELF, ratio);
                }
                if !ratio.is_finite() || ratio == S::zero() {
                    return refuse("ratio", ratio);
                }
            }
        }
        Ok(())
    }
}

/// Refuses settings of a list that are not acceptable.
pub(crate) fn check_all<S: Real, M: Mechanism>(list: &[Tracked<S, M>]) -> Result<(), Fault> {
    let has_tangents = list.iter().any(|tracked| tracked.tangent().is_some());
    for (index, tracked) in list.iter().enumerate() {
        tracked.interaction.check()?;
        let misplaced = |setting| {
            Err(Fault::Start(StartFault::MisplacedSetting {
                joint: tracked.interaction.name(),
                setting,
            }))
        };
        if has_tangents && tracked.bearing().is_some() {
            return misplaced("friction_by_load beside a contact with friction");
        }
        if let Some(tangent) = tracked.tangent()
            && !stands_behind(list, index, tangent)
        {
            return misplaced("with_friction, apart from its contact");
        }
    }
    Ok(())
}

/// Whether friction of a contact stands behind it, in all of its directions.
fn stands_behind<S: Real, M: Mechanism>(
    list: &[Tracked<S, M>],
    index: usize,
    tangent: Tangent,
) -> bool {
    let contact = index.checked_sub(tangent.behind);
    let Some(contact) = contact.and_then(|index| Some((index, list.get(index)?))) else {
        return false;
    };
    let (place, contact) = contact;
    let is_of_it = |tracked: &Tracked<S, M>| match (
        tracked.interaction.quantity,
        contact.interaction.quantity,
    ) {
        (Quantity::Slip(at, surface, shape, _), Quantity::Gap(of, on, with)) => {
            (at, surface, shape) == (of, on, with)
        }
        _ => false,
    };
    let count = if tangent.has_both { 2 } else { 1 };
    (1..=count).all(|behind| {
        let direction = place.checked_add(behind).and_then(|index| list.get(index));
        direction.is_some_and(|tracked| {
            let stands = Some(Tangent { behind, ..tangent });
            tracked.tangent() == stands && is_of_it(tracked)
        })
    })
}
