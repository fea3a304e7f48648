//! The generated kernels, judged by the run-time assembler, by automatic differentiation and by
//! counting.
//!
//! The mechanisms are declared twice, once with the derive and once for the assembler: see
//! [`mechanisms`].

#![forbid(unsafe_code)]

/// One test per mechanism, named after it.
macro_rules! each {
    ($check:ident: $($name:ident $mechanism:ty),* $(,)?) => {
        $(
            #[test]
            fn $name() {
                super::$check::<$mechanism>();
            }
        )*
    };
}

/// One test for every mechanism whose equations are independent.
macro_rules! every_independent_mechanism {
    ($check:ident) => {
        each! { $check:
            rod_pendulum holonom_models::RodPendulum,
            heavy_top holonom_models::HeavyTop,
            double_pendulum crate::mechanisms::DoublePendulum,
            oblique_chain crate::mechanisms::ObliqueChain,
            alternating_chain crate::mechanisms::AlternatingChain,
            four_bar crate::mechanisms::FourBar,
            full_tensors crate::mechanisms::FullTensors,
            tethered crate::mechanisms::Tethered,
        }
    };
}

/// One test for every mechanism with redundant equations.
macro_rules! every_redundant_mechanism {
    ($check:ident) => {
        each! { $check:
            door crate::mechanisms::Door,
            planar_four_bar crate::mechanisms::PlanarFourBar,
        }
    };
}

mod agreement;
mod arrays;
mod comparison;
mod counting;
mod derivatives;
mod drift;
mod free_bodies;
mod letters;
mod mechanisms;
mod parts;
mod projection;
mod scalars;
mod scene;
mod solutions;
mod symbols;
mod textbook;
mod user_axes;

use holonom_fixtures as _;
