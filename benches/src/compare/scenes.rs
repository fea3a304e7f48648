//! Mechanisms that come in lengths: chains of rods, and rows of four-bar windows.

#![allow(
    missing_docs,
    reason = "what the derive adds to these is described once, in the macros that write them"
)]

use holonom::joints::Revolute;
#[cfg(feature = "large")]
use holonom::joints::Spherical;
use holonom::prelude::*;

/// Rods of 1 m and 1 kg one behind the other along +y, at rest, gravity along -z, with one joint in front of each.
///
/// `chain! { pub Name: Joint [{ keys } { keys }] (rod joint head centre).. }`: what stands beside `point` in the attributes of the joints, of the first and the second in
/// turn, and of every link the names of its fields and the places along y (m) of its joint and of its centre of mass.
macro_rules! chain {
    ($(#[$doc:meta])* pub $name:ident: $joint:ident [$first:tt $second:tt] $($link:tt)*) => {
        chain! { @links [] [$(#[$doc])* $name $joint] ground [$first $second] $($link)* }
    };
    (@links [$($done:tt)*] [$(#[$doc:meta])* $name:ident $joint:ident] $before:ident $keys:tt) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Mechanism)]
        #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
        pub struct $name { $($done)* }
    };
    (
        @links [$($done:tt)*] [$(#[$doc:meta])* $name:ident $joint:ident] $before:ident [{ $($key:tt)* } $next:tt]
        ($rod:ident $pin:ident $head:tt $centre:tt) $($link:tt)*
    ) => {
        chain! {
            @links
            [
                $($done)*
                #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, $centre, 0.0])]
                $rod: Body,
                #[joint(between = [$before, $rod], point = [0.0, $head, 0.0], $($key)*)]
                $pin: $joint,
            ]
            [$(#[$doc])* $name $joint] $rod [$next { $($key)* }] $($link)*
        }
    };
}

/// A [`chain`] of 2, 4, 8, 16 or 32 links: `links! { 8 { pub Name: Joint [{ keys } { keys }] } }`.
macro_rules! links {
    (2 { $($then:tt)* } $($more:tt)*) => {
        chain! { $($then)* (rod_1 joint_1 0.0 0.5) (rod_2 joint_2 1.0 1.5) $($more)* }
    };
    (4 { $($then:tt)* } $($more:tt)*) => {
        links! { 2 { $($then)* } (rod_3 joint_3 2.0 2.5) (rod_4 joint_4 3.0 3.5) $($more)* }
    };
    (8 { $($then:tt)* } $($more:tt)*) => {
        links! { 4 { $($then)* }
            (rod_5 joint_5 4.0 4.5) (rod_6 joint_6 5.0 5.5) (rod_7 joint_7 6.0 6.5) (rod_8 joint_8 7.0 7.5) $($more)* }
    };
    (16 { $($then:tt)* } $($more:tt)*) => {
        links! { 8 { $($then)* }
            (rod_9 joint_9 8.0 8.5) (rod_10 joint_10 9.0 9.5) (rod_11 joint_11 10.0 10.5) (rod_12 joint_12 11.0 11.5)
            (rod_13 joint_13 12.0 12.5) (rod_14 joint_14 13.0 13.5) (rod_15 joint_15 14.0 14.5) (rod_16 joint_16 15.0 15.5)
            $($more)* }
    };
    (32 { $($then:tt)* }) => {
        links! { 16 { $($then)* }
            (rod_17 joint_17 16.0 16.5) (rod_18 joint_18 17.0 17.5) (rod_19 joint_19 18.0 18.5) (rod_20 joint_20 19.0 19.5)
            (rod_21 joint_21 20.0 20.5) (rod_22 joint_22 21.0 21.5) (rod_23 joint_23 22.0 22.5) (rod_24 joint_24 23.0 23.5)
            (rod_25 joint_25 24.0 24.5) (rod_26 joint_26 25.0 25.5) (rod_27 joint_27 26.0 26.5) (rod_28 joint_28 27.0 27.5)
            (rod_29 joint_29 28.0 28.5) (rod_30 joint_30 29.0 29.5) (rod_31 joint_31 30.0 30.5) (rod_32 joint_32 31.0 31.5) }
    };
}

/// Four-bar windows side by side: upright rods of 1 m and 1 kg on the ground, each joined to the next by one of the same kind at the top, moving at 1 m/s along +x,
/// gravity along -y. Problem A02 of the IFToMM library, as [`holonom_models::FourBar`].
///
/// `windows! { pub Name (rod foot x) (top left right rod foot x_left x_middle x_right).. }`: the first rod, and of every window the names of its fields and the places along x (m) of its
/// corners and of the middle of its top.
#[cfg(feature = "large")]
macro_rules! windows {
    ($(#[$doc:meta])* pub $name:ident ($rod:ident $foot:ident $x:tt) $($window:tt)*) => {
        windows! { @windows [
            #[body(
                mass = 1.0, inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0], position = [$x, 0.5, 0.0],
                velocity = [0.5, 0.0, 0.0], angular_velocity = [0.0, 0.0, -1.0]
            )]
            $rod: Body,
            #[joint(between = [ground, $rod], point = [$x, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            $foot: Revolute,
        ] [$(#[$doc])* $name] $rod $($window)* }
    };
    (@windows [$($done:tt)*] [$(#[$doc:meta])* $name:ident] $before:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Mechanism)]
        #[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "joints")]
        pub struct $name { $($done)* }
    };
    (
        @windows [$($done:tt)*] $head:tt $before:ident
        ($top:ident $left:ident $right:ident $rod:ident $foot:ident $x:tt $middle:tt $next:tt) $($window:tt)*
    ) => {
        windows! { @windows [
            $($done)*
            #[body(
                mass = 1.0, inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0], position = [$next, 0.5, 0.0],
                velocity = [0.5, 0.0, 0.0], angular_velocity = [0.0, 0.0, -1.0]
            )]
            $rod: Body,
            #[joint(between = [ground, $rod], point = [$next, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            $foot: Revolute,
            #[body(
                mass = 1.0, inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0], position = [$middle, 1.0, 0.0],
                velocity = [1.0, 0.0, 0.0]
            )]
            $top: Body,
            #[joint(between = [$before, $top], point = [$x, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
            $left: Revolute,
            #[joint(between = [$top, $rod], point = [$next, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
            $right: Revolute,
        ] $head $rod $($window)* }
    };
}

links! { 2 {
    /// Two rods on parallel hinges.
    pub RevoluteChain2: Revolute [{ axis = [1.0, 0.0, 0.0] } { axis = [1.0, 0.0, 0.0] }]
} }

#[cfg(feature = "large")]
links! { 4 {
    /// Four rods on parallel hinges.
    pub RevoluteChain4: Revolute [{ axis = [1.0, 0.0, 0.0] } { axis = [1.0, 0.0, 0.0] }]
} }

#[cfg(feature = "large")]
links! { 8 {
    /// Eight rods on parallel hinges.
    pub RevoluteChain8: Revolute [{ axis = [1.0, 0.0, 0.0] } { axis = [1.0, 0.0, 0.0] }]
} }

#[cfg(feature = "large")]
links! { 16 {
    /// Sixteen rods on parallel hinges.
    pub RevoluteChain16: Revolute [{ axis = [1.0, 0.0, 0.0] } { axis = [1.0, 0.0, 0.0] }]
} }

#[cfg(feature = "large")]
links! { 32 {
    /// Thirty-two rods on parallel hinges.
    pub RevoluteChain32: Revolute [{ axis = [1.0, 0.0, 0.0] } { axis = [1.0, 0.0, 0.0] }]
} }

#[cfg(feature = "large")]
links! { 4 {
    /// Four rods on hinges whose axes are at right angles in turn.
    pub AlternatingChain4: Revolute [{ axis = [1.0, 0.0, 0.0] } { axis = [0.0, 0.0, 1.0] }]
} }

#[cfg(feature = "large")]
links! { 8 {
    /// Eight rods on hinges whose axes are at right angles in turn.
    pub AlternatingChain8: Revolute [{ axis = [1.0, 0.0, 0.0] } { axis = [0.0, 0.0, 1.0] }]
} }

#[cfg(feature = "large")]
links! { 2 {
    /// Two rods on balls.
    pub SphericalChain2: Spherical [{} {}]
} }

#[cfg(feature = "large")]
links! { 8 {
    /// Eight rods on balls.
    pub SphericalChain8: Spherical [{} {}]
} }

#[cfg(feature = "huge")]
links! { 32 {
    /// Thirty-two rods on balls.
    pub SphericalChain32: Spherical [{} {}]
} }

#[cfg(feature = "large")]
windows! {
    /// Five windows.
    pub Windows5 (rod_0 foot_0 0.0)
    (top_1 left_1 right_1 rod_1 foot_1 0.0 0.5 1.0) (top_2 left_2 right_2 rod_2 foot_2 1.0 1.5 2.0) (top_3 left_3 right_3 rod_3 foot_3 2.0 2.5 3.0)
    (top_4 left_4 right_4 rod_4 foot_4 3.0 3.5 4.0) (top_5 left_5 right_5 rod_5 foot_5 4.0 4.5 5.0)
}

#[cfg(feature = "large")]
windows! {
    /// Ten windows.
    pub Windows10 (rod_0 foot_0 0.0)
    (top_1 left_1 right_1 rod_1 foot_1 0.0 0.5 1.0) (top_2 left_2 right_2 rod_2 foot_2 1.0 1.5 2.0) (top_3 left_3 right_3 rod_3 foot_3 2.0 2.5 3.0)
    (top_4 left_4 right_4 rod_4 foot_4 3.0 3.5 4.0) (top_5 left_5 right_5 rod_5 foot_5 4.0 4.5 5.0) (top_6 left_6 right_6 rod_6 foot_6 5.0 5.5 6.0)
    (top_7 left_7 right_7 rod_7 foot_7 6.0 6.5 7.0) (top_8 left_8 right_8 rod_8 foot_8 7.0 7.5 8.0) (top_9 left_9 right_9 rod_9 foot_9 8.0 8.5 9.0)
    (top_10 left_10 right_10 rod_10 foot_10 9.0 9.5 10.0)
}

#[cfg(feature = "huge")]
windows! {
    /// Forty windows.
    pub Windows40 (rod_0 foot_0 0.0)
    (top_1 left_1 right_1 rod_1 foot_1 0.0 0.5 1.0) (top_2 left_2 right_2 rod_2 foot_2 1.0 1.5 2.0) (top_3 left_3 right_3 rod_3 foot_3 2.0 2.5 3.0)
    (top_4 left_4 right_4 rod_4 foot_4 3.0 3.5 4.0) (top_5 left_5 right_5 rod_5 foot_5 4.0 4.5 5.0) (top_6 left_6 right_6 rod_6 foot_6 5.0 5.5 6.0)
    (top_7 left_7 right_7 rod_7 foot_7 6.0 6.5 7.0) (top_8 left_8 right_8 rod_8 foot_8 7.0 7.5 8.0) (top_9 left_9 right_9 rod_9 foot_9 8.0 8.5 9.0)
    (top_10 left_10 right_10 rod_10 foot_10 9.0 9.5 10.0) (top_11 left_11 right_11 rod_11 foot_11 10.0 10.5 11.0)
    (top_12 left_12 right_12 rod_12 foot_12 11.0 11.5 12.0) (top_13 left_13 right_13 rod_13 foot_13 12.0 12.5 13.0)
    (top_14 left_14 right_14 rod_14 foot_14 13.0 13.5 14.0) (top_15 left_15 right_15 rod_15 foot_15 14.0 14.5 15.0)
    (top_16 left_16 right_16 rod_16 foot_16 15.0 15.5 16.0) (top_17 left_17 right_17 rod_17 foot_17 16.0 16.5 17.0)
    (top_18 left_18 right_18 rod_18 foot_18 17.0 17.5 18.0) (top_19 left_19 right_19 rod_19 foot_19 18.0 18.5 19.0)
    (top_20 left_20 right_20 rod_20 foot_20 19.0 19.5 20.0) (top_21 left_21 right_21 rod_21 foot_21 20.0 20.5 21.0)
    (top_22 left_22 right_22 rod_22 foot_22 21.0 21.5 22.0) (top_23 left_23 right_23 rod_23 foot_23 22.0 22.5 23.0)
    (top_24 left_24 right_24 rod_24 foot_24 23.0 23.5 24.0) (top_25 left_25 right_25 rod_25 foot_25 24.0 24.5 25.0)
    (top_26 left_26 right_26 rod_26 foot_26 25.0 25.5 26.0) (top_27 left_27 right_27 rod_27 foot_27 26.0 26.5 27.0)
    (top_28 left_28 right_28 rod_28 foot_28 27.0 27.5 28.0) (top_29 left_29 right_29 rod_29 foot_29 28.0 28.5 29.0)
    (top_30 left_30 right_30 rod_30 foot_30 29.0 29.5 30.0) (top_31 left_31 right_31 rod_31 foot_31 30.0 30.5 31.0)
    (top_32 left_32 right_32 rod_32 foot_32 31.0 31.5 32.0) (top_33 left_33 right_33 rod_33 foot_33 32.0 32.5 33.0)
    (top_34 left_34 right_34 rod_34 foot_34 33.0 33.5 34.0) (top_35 left_35 right_35 rod_35 foot_35 34.0 34.5 35.0)
    (top_36 left_36 right_36 rod_36 foot_36 35.0 35.5 36.0) (top_37 left_37 right_37 rod_37 foot_37 36.0 36.5 37.0)
    (top_38 left_38 right_38 rod_38 foot_38 37.0 37.5 38.0) (top_39 left_39 right_39 rod_39 foot_39 38.0 38.5 39.0)
    (top_40 left_40 right_40 rod_40 foot_40 39.0 39.5 40.0)
}
