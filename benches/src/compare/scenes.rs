//! Mechanisms that come in lengths: chains of rods, and rows of four-bar windows.

use holonom::joints::Revolute;
use holonom::joints::Spherical;
use holonom::prelude::*;

/// Rods of 1 m and 1 kg one behind the other along +y, at rest, gravity along -z, with one joint in
/// front of each.
macro_rules! chain {
    ($(#[$attribute:meta])* $name:ident: [$joint:ident; $links:tt] $($keys:tt)*) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, Mechanism)]
        #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
        pub struct $name {
            #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, k + 0.5, 0.0])]
            rods: [Body; $links],
            #[joint(between = [if k == 0 { ground } else { rods[k - 1] }, rods[k]], point = [0.0, k, 0.0] $($keys)*)]
            joints: [$joint; $links],
        }
    };
}

/// Four-bar windows side by side: upright rods of 1 m and 1 kg on the ground, each joined to the
/// next by one of the same kind at the top, moving at 1 m/s along +x, gravity along -y. Problem A02
/// of the IFToMM library, as [`holonom_models::QuintupleFourBar`].
#[cfg(feature = "huge")]
macro_rules! windows {
    ($(#[$attribute:meta])* $name:ident: [$rods:tt] [$windows:tt]) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, Mechanism)]
        #[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "both")]
        pub struct $name {
            #[body(
                mass = 1.0, inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0], position = [k, 0.5, 0.0],
                velocity = [0.5, 0.0, 0.0], angular_velocity = [0.0, 0.0, -1.0]
            )]
            rods: [Body; $rods],
            #[joint(between = [ground, rods[k]], point = [k, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            feet: [Revolute; $rods],
            #[body(
                mass = 1.0, inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0], position = [k + 0.5, 1.0, 0.0],
                velocity = [1.0, 0.0, 0.0]
            )]
            tops: [Body; $windows],
            #[joint(between = [rods[k], tops[k]], point = [k, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
            left: [Revolute; $windows],
            #[joint(between = [tops[k], rods[k + 1]], point = [k + 1, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
            right: [Revolute; $windows],
        }
    };
}

chain! {
    /// Two rods on parallel hinges.
    RevoluteChain2: [Revolute; 2], axis = [1.0, 0.0, 0.0]
}

chain! {
    /// Four rods on parallel hinges.
    RevoluteChain4: [Revolute; 4], axis = [1.0, 0.0, 0.0]
}

chain! {
    /// Eight rods on parallel hinges.
    RevoluteChain8: [Revolute; 8], axis = [1.0, 0.0, 0.0]
}

chain! {
    /// Sixteen rods on parallel hinges.
    RevoluteChain16: [Revolute; 16], axis = [1.0, 0.0, 0.0]
}

chain! {
    /// Thirty-two rods on parallel hinges.
    RevoluteChain32: [Revolute; 32], axis = [1.0, 0.0, 0.0]
}

chain! {
    /// Four rods on hinges whose axes are at right angles in turn.
    AlternatingChain4: [Revolute; 4], axis = if k % 2 == 0 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] }
}

chain! {
    /// Eight rods on hinges whose axes are at right angles in turn.
    AlternatingChain8: [Revolute; 8], axis = if k % 2 == 0 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] }
}

chain! {
    /// Two rods on balls.
    SphericalChain2: [Spherical; 2]
}

chain! {
    /// Eight rods on balls.
    SphericalChain8: [Spherical; 8]
}

chain! {
    /// Thirty-two rods on balls.
    #[cfg(feature = "huge")]
    SphericalChain32: [Spherical; 32]
}

#[cfg(feature = "huge")]
windows! {
    /// Ten windows.
    Windows10: [11] [10]
}

#[cfg(feature = "huge")]
windows! {
    /// Forty windows.
    Windows40: [41] [40]
}
