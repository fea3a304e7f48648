//! Robots from files, where `holonom` bears a third name: two beside each other with couplings of
//! one kind, and one in a module of its own.

mech::urdf! {
    /// Two fingers that move together.
    pub struct Gripper = "../../../urdf/tests/data/gripper.urdf";
}

mech::urdf! {
    #[urdf(passive)]
    #[mechanism(gravity = [0.0, 0.0, 0.0])]
    #[derive(PartialEq, Eq)]
    pub struct Weightless = "../../../urdf/tests/data/gripper.urdf";
}

pub mod inner {
    //! No name of the library is imported here.

    mech::urdf! {
        pub struct Arm = "../../../urdf/arm.urdf" {
            /// In N m/rad.
            #[param]
            stiffness: f64,
            #[force(between = [upper_arm, forearm], axis = [0.0, 1.0, 0.0], stiffness = stiffness)]
            spring: mech::forces::TorsionalSpringDamper,
        }
    }
}
