//! Hands the joints of another crate on: under other names, as a module, and by a glob. Knows
//! nothing of `holonom`.
#![no_std]
#![forbid(unsafe_code)]

pub use downstream_joints::Rod as Link;
pub use downstream_joints::averaging as means;

/// Two globs, one in the other.
pub mod all {
    pub use inner::*;

    mod inner {
        pub use downstream_joints::*;
    }
}

/// One joint under the name of another.
pub mod swapped {
    pub use downstream_joints::OnSphere as Rod;
}

#[cfg(test)]
mod tests {
    /// Whatever the path, it is one type.
    #[test]
    fn names_lead_to_one_joint() {
        let rods: [super::Link; 3] = [super::Link, super::all::Rod, downstream_joints::Rod];
        assert_eq!(rods[0], rods[2]);
        let spheres = [super::swapped::Rod, super::all::OnSphere];
        assert_eq!(spheres[0], spheres[1]);
        let midpoints = [super::means::Midpoint, super::all::averaging::Midpoint];
        assert_eq!(midpoints[0], midpoints[1]);
    }
}
