//! Mechanisms among names that generated code must not meet: constants in lower case, which a
//! pattern of the same name would mean; types and traits named like those of the language; fields
//! named like words of later editions.
#![forbid(unsafe_code)]
#![allow(
    dead_code,
    non_camel_case_types,
    non_upper_case_globals,
    missing_docs,
    unreachable_pub,
    reason = "that is what is tested"
)]

extern crate holonom;

/// Names of the older road.
pub mod constants {
    use holonom::joints::{AngleDriver, Revolute, Screw};
    use holonom::prelude::*;

    const state: u8 = 0;
    const constants: u8 = 0;
    const coefficients: u8 = 0;
    const stabilisation: u8 = 0;
    const parameters: u8 = 0;
    const coordinates: u8 = 0;
    const velocities: u8 = 0;
    const time: u8 = 0;
    const body: u8 = 0;
    const joint: u8 = 0;
    const force: u8 = 0;
    const place: u8 = 0;
    const counted: u8 = 0;
    const factors: u8 = 0;
    const upper: u8 = 0;
    const lower: u8 = 0;
    const value: u8 = 0;
    const value_of_speed: u8 = 0;
    const mechanism: u8 = 0;
    const component: u8 = 0;
    const excess: u8 = 0;
    const a: u8 = 0;
    const b: u8 = 0;
    const c: u8 = 0;
    const x: u8 = 0;
    const y: u8 = 0;
    const z: u8 = 0;
    static q: u8 = 0;
    struct n_2;
    struct n_3;
    struct n_4;
    struct n_5;
    struct rod_a11_20;

    const LENGTH: f64 = 1.0;

    /// With constants, a parameter, an input, an angle over turns, and every check of numbers that
    /// are known at run time.
    #[derive(Mechanism)]
    #[mechanism(gravity = [0.0, 0.0, -9.81])]
    pub struct Driven {
        #[param]
        speed: f64,
        #[input]
        moment: f64,
        #[body(mass = speed * 1.0, inertia = [0.1 * LENGTH, 0.1, 0.1 + 0.01 * LENGTH], position = [0.0, 0.5 * LENGTH, 0.0])]
        rod: Body,
        #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [0.1 * LENGTH, 0.0, 0.0])]
        hinge: Revolute,
        #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = speed * time)]
        motor: AngleDriver,
    }

    #[derive(Mechanism)]
    pub struct Nut {
        #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
        nut: Body,
        #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.01)]
        screw: Screw,
    }
}

/// Types and traits named like those of the language.
pub mod types {
    use holonom::joints::Revolute;
    use holonom::prelude::*;

    pub struct f64;
    pub struct f32;
    pub struct usize;
    pub struct u64;
    pub struct bool;
    pub struct str;
    pub struct Option;
    pub struct Result;
    pub struct Some;
    pub struct None;
    pub struct Ok;
    pub struct Err;
    pub trait Default {}
    pub trait Clone {}
    pub trait Copy {}
    pub trait Debug {}
    pub trait PartialEq {}
    pub trait Eq {}
    pub trait Iterator {}
    pub mod core {}
    pub mod std {}

    ::holonom::force! {
        /// A force among them.
        pub force Pull(i, j; point: Point, vector: Vector) { force i.vector at j.point; }
    }

    const LENGTH: ::std::primitive::f64 = 1.0;

    #[derive(Mechanism)]
    pub struct Pendulum {
        #[body(mass = LENGTH, inertia = [0.1 * LENGTH, 0.1, 0.1], position = [0.0, 0.5 * LENGTH, 0.0])]
        rod: Body,
        #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
        hinge: Revolute,
        #[force(between = [ground, rod], point = [0.0, 1.0, 0.0], vector = [0.0, 0.0, LENGTH])]
        pull: Pull,
    }

    ::holonom::joint! {
        /// A joint among them.
        pub joint Own(i, j; point: Point, axis: Axis, motion: Law) {
            j.point - i.point;
            drive angle(i, j, axis) to motion();
            angle about axis;
            displacement dot(i.axis, j.point - i.point);
        }
    }
}

/// Words of later editions.
pub mod words {
    use holonom::joints::Revolute;
    use holonom::prelude::*;

    #[derive(Mechanism)]
    pub struct Pendulum {
        #[param]
        await: f64,
        #[body(mass = await, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5, 0.0])]
        async: Body,
        #[joint(between = [ground, async], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
        try: Revolute,
    }
}

#[cfg(test)]
mod tests {
    use holonom::Mechanism;

    use super::{constants, types, words};

    #[test]
    fn mechanisms_among_such_names_are_as_anywhere() {
        let driven = constants::Driven::new(2.0).expect("acceptable");
        let prepared = driven.parameters::<f64>().expect("acceptable");
        assert_eq!(prepared, [2.0, 0.0]);
        assert!(constants::Driven::new(-2.0).is_err());
        assert_eq!(types::Pendulum::REPORT.forces.len(), 1);
        let swing = words::Pendulum::new(1.0).expect("acceptable");
        assert!(swing.parameters::<f64>().is_ok());
        let _ = words::Pendulum::HANDLES.r#try;
    }
}
