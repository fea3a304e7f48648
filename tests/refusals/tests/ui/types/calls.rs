//! Joints and bodies are no macros to call, and neither is what stands behind them.

use holonom::joints::Revolute;
use holonom::prelude::*;

Revolute! { i, j }

Revolute!();

Body! { mass = 1.0 }

Revolute! { @holonom0 [] [] {} }

Body! { @holonom0 [] [] {} }

holonom::__private::assemble! { rod }

holonom::__private::joint_impl! { pub joint Rod(i) { i.origin; } }

fn main() {
    let _ = Particle!();
}
