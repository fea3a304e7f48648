//! Linear models and equilibria by laws that switch: refused where the sides of a law differ.

use core::ops::ControlFlow;

use holonom::error::AnalysisFault;
use holonom::independent::Continuation;
use holonom::prelude::*;

use super::oscillators::Backlash;
use super::resting::{Dry, dry};

/// What sticks does not swing, and rests anywhere.
#[test]
fn friction_at_rest_is_refused_by_name() -> Result<(), Fault> {
    let h = Dry::HANDLES;
    let slider = dry(0.0, 0.0);
    let space = slider.coordinates([h.rail])?;
    let rest = space.state([0.3], [0.0])?;
    let refused = Some(Fault::Analysis(AnalysisFault::OnSwitch {
        law: "friction",
        expression: "rate",
    }));
    assert_eq!(space.linearise(&rest, [], |_| []).err(), refused);
    assert_eq!(space.equilibrium(&rest).err(), refused);
    assert_eq!(space.trim(&rest, [h.rail], [h.pull]).err(), refused);
    let from_rest = space.follow(&rest, Continuation::new(h.pull, 1.0), |_| {
        ControlFlow::Continue(())
    });
    assert_eq!(from_rest.err(), refused);
    // As it slides, friction is a constant force.
    for rate in [1e-9, -2.0] {
        let slides = space.state([0.3], [rate])?;
        let linear = space.linearise(&slides, [h.pull], |_| [])?;
        assert_eq!((linear.by_rates[0], linear.by_values[0]), (0.0, 1.0));
        let (_, [pull]) = space.trim(&slides, [h.rail], [h.pull])?;
        assert!((pull - 0.5 * rate.signum()).abs() < 1e-12, "{pull}");
    }
    Ok(())
}

/// A law that bends has equilibria where it does, and no derivative; off the bend it has that of
/// its side. Where sides are one, nothing is refused.
#[test]
fn a_bend_is_refused_where_derivatives_are_asked() -> Result<(), Fault> {
    let (slider, h) = (Backlash::default(), Backlash::HANDLES);
    let space = slider.coordinates([h.rail])?;
    for (displacement, stiffness) in [(0.0, Some(25.0)), (-1.0, Some(0.0)), (-0.7, None)] {
        let state = space.state([displacement], [0.0])?;
        let linear = space.linearise(&state, [], |_| []);
        match (linear, stiffness) {
            (Ok(linear), Some(stiffness)) => {
                assert!((linear.by_positions[0] + stiffness).abs() < 1e-12);
            }
            (Err(Fault::Analysis(AnalysisFault::OnSwitch { law, expression })), None) => {
                let wanted = ("springs", "-(abs(length - 9.0) - PLAY)");
                assert_eq!((law, expression), wanted);
            }
            (linear, _) => panic!("{displacement}: {linear:?}"),
        }
        if displacement < 0.0 {
            let rest = space.equilibrium(&state)?;
            assert!((space.positions(&rest)?[0] - displacement).abs() < 1e-12);
        }
    }
    Ok(())
}
