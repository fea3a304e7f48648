//! The drawing of a mechanism as it is described.

use holonom::{Mechanism, MechanismExt, ParameterError, View};

use crate::Film;

/// A drawing of the reference configuration.
///
/// A plane mechanism is seen along its normal, others along all axes and from a corner. Joints have
/// numbers, and dashes along their axes; crosses are centres of mass. Below are the names of bodies
/// by colour, and a table of joints and forces. So a point that was written wrong is seen before
/// anything runs.
///
/// ```no_run
/// use holonom_film::Sketch;
/// use holonom_models::FourBar;
///
/// std::fs::write("four-bar.svg", FourBar::default().sketch()?)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Sketch: Mechanism {
    /// The drawing, an SVG for a page or a file.
    ///
    /// # Errors
    /// That of a parameter with which the configuration cannot be computed.
    fn sketch(&self) -> Result<String, ParameterError> {
        let constants = self.constants::<f64>()?;
        let state = self.described_state::<f64>()?;
        Ok(Film::sketch_of(&View::<f64, Self>::new(
            &constants, 0.0, &state,
        )))
    }
}

impl<M: Mechanism> Sketch for M {}
