//! Calls of `urdf!`: without a file, with options that are none, with two structs. Faults of a file
//! are in the tests of `holonom-urdf-macros`.

holonom::urdf! { struct Nowhere = "robots/nowhere.urdf"; }

holonom::urdf! {
    #[urdf(float, passive, rounded)]
    struct Options = "arm.urdf";
}

holonom::urdf! { struct NoFile; }

holonom::urdf! {
    struct One = "one.urdf";
    struct Two = "two.urdf";
}

fn main() {}
