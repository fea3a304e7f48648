//! Mechanisms of many kinds: a particle, and a force of its own kind for every field.

use core::ops::ControlFlow;

use holonom::BodyHandle;
use holonom::prelude::*;

/// Forces of 0.5 N, a kind for each, and a particle of 2 kg that they all push.
macro_rules! pushed {
    ($(#[$attribute:meta])* $mechanism:ident: $($kind:ident $field:ident)*) => {
        $(holonom::force! {
            /// A constant force at the centre of mass.
            force $kind(i) {
                force [0.5, 0.0, 0.0] at i.origin;
            }
        })*

        /// A particle that is pushed.
        #[derive(Mechanism)]
        $(#[$attribute])*
        struct $mechanism {
            #[body(mass = 2.0, free)]
            bead: Particle,
            $(
                #[force(between = [bead])]
                $field: $kind,
            )*
        }
    };
}

/// The velocity of the particle after a second.
pub(crate) fn velocity_after_a_second<M: Mechanism + Default>(bead: BodyHandle<M>) -> f64 {
    let mut reached = f64::NAN;
    Simulation::new(
        &M::default(),
        StandardLagrange,
        DormandPrince::new(Tolerance::default()),
    )
    .run(0.0..=1.0, every(1.0), |sample| {
        reached = sample.velocity(bead).x;
        ControlFlow::Continue(())
    })
    .expect("a particle that moves");
    reached
}
