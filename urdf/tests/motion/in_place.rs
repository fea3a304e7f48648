//! The same robots, each from its file in place, side by side in one module.

#![allow(
    unreachable_pub,
    reason = "joints of a module are for a crate of its own"
)]

holonom::urdf! { pub(crate) struct Crane = "tests/data/crane.urdf"; }
holonom::urdf! {
    #[mechanism(kernels = [mass, inverse, gravity, coriolis, jacobian])]
    pub(crate) struct Robot2dofPlanar = "tests/data/robots/double_pendulum.urdf";
}
holonom::urdf! {
    #[mechanism(kernels = [mass, inverse, gravity, coriolis, jacobian])]
    pub(crate) struct Panda = "tests/data/robots/panda.urdf";
}
holonom::urdf! {
    #[mechanism(kernels = [mass, inverse, gravity, coriolis, jacobian])]
    pub(crate) struct SoArm100 = "tests/data/robots/so100.urdf";
}
holonom::urdf! {
    #[mechanism(kernels = [mass, inverse, gravity, coriolis, jacobian])]
    pub(crate) struct Ur5 = "tests/data/robots/ur5.urdf";
}

/// The compiler lists what it reads in a file beside the program, by which Cargo decides what to
/// build anew.
#[test]
fn files_of_robots_are_watched() {
    let program = std::env::current_exe().expect("it runs");
    let list = std::fs::read_to_string(program.with_extension("d")).expect("it was built");
    for file in ["crane", "robots/panda", "robots/ur5"] {
        let file = format!("tests/data/{file}.urdf");
        let is_read = |line: &str| line.contains(" ") && line.contains(&file);
        assert!(list.lines().any(is_read), "{file} in {list}");
    }
}
