//! Typed names of bodies and joints.

use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;

use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::{
    BodyInfo, BodyKind, ForceInfo, JointInfo, PointInfo, RedundantRow, StateInfo, ValueInfo,
};

/// A joint as a type: its equations and the bodies that it connects.
///
/// `joint!` implements it; a field of this type in a mechanism stands for one such joint.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a joint",
    label = "not defined with `joint!`",
    note = "a joint is defined with `holonom::joint!`; ready-made ones are in `holonom::joints`"
)]
pub trait Joint {
    /// The name of the joint's type.
    const NAME: &'static str;
    /// The number of constraint equations.
    const EQUATIONS: usize;
    /// The number of bodies that it connects, the ground among them.
    const BODIES: usize;
    /// A number made of the definition, so that two versions of it cannot be mixed.
    const FINGERPRINT: u64;
}

/// A force as a type.
///
/// `force!` implements it; a field of this type in a mechanism stands for one such force.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a force",
    label = "not defined with `force!`",
    note = "a force is defined with `holonom::force!`; ready-made ones are in `holonom::forces`"
)]
pub trait Force {
    /// The name of the force's type.
    const NAME: &'static str;
    /// The number of bodies that it speaks of, the ground among them.
    const BODIES: usize;
    /// A number made of the definition, so that two versions of it cannot be mixed.
    const FINGERPRINT: u64;
}

/// A joint whose definition has an angle.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no angle",
    label = "the definition of this joint names no angle",
    note = "an angle can be read from joints with one rotation, such as `Revolute`"
)]
pub trait HasAngle: Joint {}

/// A joint whose definition has two angles, such as [`Universal`](crate::joints::Universal).
#[diagnostic::on_unimplemented(
    message = "`{Self}` has not two angles",
    label = "the definition of this joint names no two angles",
    note = "two angles can be read from joints with two rotations, such as `Universal`; one from joints with one, by `angle`"
)]
pub trait HasTwoAngles: Joint {}

/// A joint whose definition has a displacement.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no displacement",
    label = "the definition of this joint names no displacement",
    note = "a displacement can be read from joints with a translation, such as a prismatic or a cylindrical joint"
)]
pub trait HasDisplacement: Joint {}

/// A joint whose definition has a contact, such as [`RollingWheel`](crate::joints::RollingWheel).
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no contact",
    label = "the definition of this joint names no contact",
    note = "a contact can be read from joints that roll, such as `RollingWheel` or `RollingBall`"
)]
pub trait HasContact: Joint {}

/// A joint whose definition drives a quantity: one of its rows is `quantity - law(time)`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` drives nothing",
    label = "the definition of this joint has no driver",
    note = "a driving effort can be read from joints that prescribe a motion, such as a driver of an angle"
)]
pub trait Driven: Joint {
    /// The place of the driver's equation among those of the joint's definition.
    const ROW: usize;
}

/// A typed place in a list of the report.
macro_rules! handle {
    ($(#[$about:meta])* $name:ident<$mechanism:ident $(, $type:ident)?>, $list:ident: $info:ident) => {
        $(#[$about])*
        pub struct $name<$mechanism $(, $type)?> {
            index: usize,
            types: PhantomData<fn() -> ($mechanism, $($type)?)>,
        }

        impl<$mechanism $(, $type)?> $name<$mechanism $(, $type)?> {
            #[doc(hidden)]
            #[must_use]
            pub const fn new(index: usize) -> Self {
                Self { index, types: PhantomData }
            }

            #[doc = concat!("The place in [`Report::", stringify!($list), "`](crate::Report::", stringify!($list), ").")]
            #[must_use]
            pub const fn index(self) -> usize {
                self.index
            }
        }

        impl<$mechanism: Mechanism $(, $type)?> $name<$mechanism $(, $type)?> {
            /// The name of the field.
            #[must_use]
            pub fn name(self) -> &'static str {
                self.info().map_or("", |info| info.name)
            }

            /// What the report says of it.
            pub(crate) fn info(self) -> Option<&'static $info> {
                $mechanism::REPORT.$list.get(self.index)
            }
        }

        impl<$mechanism $(, $type)?> Clone for $name<$mechanism $(, $type)?> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<$mechanism $(, $type)?> Copy for $name<$mechanism $(, $type)?> {}

        impl<$mechanism $(, $type)?> PartialEq for $name<$mechanism $(, $type)?> {
            fn eq(&self, other: &Self) -> bool {
                self.index == other.index
            }
        }

        impl<$mechanism $(, $type)?> Eq for $name<$mechanism $(, $type)?> {}

        impl<$mechanism $(, $type)?> fmt::Debug for $name<$mechanism $(, $type)?> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_tuple(stringify!($name)).field(&self.index).finish()
            }
        }
    };
}

handle! {
    /// A body of the mechanism `M`.
    BodyHandle<M>, bodies: BodyInfo
}

handle! {
    /// A joint of the mechanism `M`, of the type `J`.
    JointHandle<M, J>, joints: JointInfo
}

handle! {
    /// A force of the mechanism `M`, of the type `F`.
    ForceHandle<M, F>, forces: ForceInfo
}

handle! {
    /// A named point of the mechanism `M`.
    PointHandle<M>, points: PointInfo
}

handle! {
    /// A parameter or an input of the mechanism `M`.
    ValueHandle<M>, values: ValueInfo
}

handle! {
    /// A state of the user's own in the mechanism `M`: a field with `#[state(rate = ..)]`.
    StateHandle<M>, states: StateInfo
}

impl<M: Mechanism> StateHandle<M> {
    /// Where the state starts, as a value of the mechanism: for
    /// [sensitivities](crate::sensitivity::SensitivityExt::sensitivities) by it.
    #[must_use]
    pub fn start(self) -> ValueHandle<M> {
        // One that is not there has no value.
        ValueHandle::new(self.info().map_or(usize::MAX, |info| info.value))
    }

    /// Its place among the coordinates of a state.
    pub(crate) fn coordinate(self) -> usize {
        self.info().map_or(usize::MAX, |info| info.coordinate)
    }
}

impl<M: Mechanism> BodyHandle<M> {
    /// Kind and places of the body, and the place of its Euler parameters; nothing for a particle.
    pub(crate) fn orientation(self) -> Option<(&'static BodyInfo, usize)> {
        let info = self.info()?;
        (info.kind == BodyKind::Rigid).then_some((info, info.coordinate + 3))
    }
}

impl<M: Mechanism, J> JointHandle<M, J> {
    /// The row of an equation of the joint's definition; `None` if it was left out.
    pub(crate) fn row(self, equation: usize) -> Option<usize> {
        let of_joint = |row: &&RedundantRow| row.dropped && row.joint == self.index;
        let dropped = || M::REPORT.redundant.iter().filter(of_joint);
        if dropped().any(|row| row.row == equation) {
            return None;
        }
        let before = dropped().filter(|row| row.row < equation).count();
        self.info().map(|info| info.row + equation - before)
    }
}

/// The handle of a joint or a force, which may count turns of angles.
pub trait CountsTurns<M>: Copy + sealed::Sealed {
    /// The name of the field.
    fn element(self) -> &'static str;
    /// The places of its angles among the coordinates of a state.
    fn counters(self) -> Range<usize>;
}

mod sealed {
    /// Implemented by the handles of this crate.
    pub trait Sealed {}
}

impl<M, J> sealed::Sealed for JointHandle<M, J> {}

impl<M, F> sealed::Sealed for ForceHandle<M, F> {}

impl<M: Mechanism, J> CountsTurns<M> for JointHandle<M, J> {
    fn element(self) -> &'static str {
        self.name()
    }

    fn counters(self) -> Range<usize> {
        let places = |info: &JointInfo| info.auxiliary..info.auxiliary + info.auxiliaries;
        self.info().map_or(0..0, places)
    }
}

impl<M: Mechanism, F> CountsTurns<M> for ForceHandle<M, F> {
    fn element(self) -> &'static str {
        self.name()
    }

    fn counters(self) -> Range<usize> {
        let places = |info: &ForceInfo| info.auxiliary..info.auxiliary + info.auxiliaries;
        self.info().map_or(0..0, places)
    }
}
