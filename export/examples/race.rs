//! Writes three mechanisms in C into a folder, and says what a step of them takes in Rust: what
//! `benches/c/run` compares.

use std::env;
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_export::{Double, Export};
use holonom_models::{FourBar, Panda, Ur5};

const STEPS: u32 = 2000;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::args().nth(1).ok_or("say a folder")?;
    macro_rules! race {
        ($mechanism:ty) => {{
            let mechanism = <$mechanism>::default();
            let export = Export::<_, Double, Relative>::new(&mechanism, StandardLagrange);
            let source = export.step(Rk4).c()?;
            source.write(&folder)?;
            let stepper = mechanism
                .stepper(StandardLagrange, Rk4)?
                .joint_coordinates();
            let start = stepper.initial_state()?;
            let mut least = f64::INFINITY;
            for _ in 0..300 {
                let (mut stepper, mut state) = (stepper.clone(), start);
                let begun = Instant::now();
                for _ in 0..STEPS {
                    stepper.step(&mut state, 1e-4)?;
                }
                black_box(state);
                least = least.min(begun.elapsed().as_secs_f64());
            }
            println!("{} {:.1}", source.name, 1e9 * least / f64::from(STEPS));
        }};
    }
    race!(FourBar);
    race!(Ur5);
    race!(Panda);
    Ok(())
}
