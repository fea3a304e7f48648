//! The example: parameters from measurements.

use std::error::Error;

#[path = "../../../runtime/examples/estimate.rs"]
#[allow(dead_code, unreachable_pub, reason = "it is a program of its own")]
mod estimate;

/// From a quarter of the damping, and the lengths that are typical.
#[test]
fn a_damper_and_three_lengths() -> Result<(), Box<dyn Error>> {
    let found = estimate::pendulum(&estimate::measured()?, [0.05, 0.4])?;
    let ([damping, inertia], rounds) = (found.values, found.rounds);
    assert!((damping - 0.2).abs() < 1e-3, "{damping}");
    assert!((inertia - 0.34).abs() < 1e-3, "{inertia}");
    assert!(rounds < 20, "{rounds}");
    let found = estimate::four_bar([0.3, 1.0, 0.7], [0.25, 0.9, 0.6])?;
    let (lengths, rounds) = (found.values, found.rounds);
    for (found, wanted) in lengths.into_iter().zip([0.3, 1.0, 0.7]) {
        assert!((found - wanted).abs() < 1e-9, "{lengths:?}");
    }
    assert!(rounds < 10, "{rounds}");
    Ok(())
}
