//! The projection onto the constraints, as a function of the program.

use holonom::mechanism::TracedCoordinates;
use holonom::traced::projected;
use holonom::{Mechanism, Scalar as _};

use crate::error::ExportError;
use crate::export::{Export, TIMES, argument};
use crate::number::Precision;
use crate::program::Guard;

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// A function `project` that corrects a state onto the equations of joints: positions by so
    /// many steps of Newton's method, by the least movement in the metric of the mass, then
    /// velocities. In joint coordinates the equations are those that close loops; without loops
    /// there are none, and the state stays.
    ///
    /// The function is given the largest `|Phi|` and `|Phi'|` that are accepted, in metres and
    /// radians, and per second. It leaves the state as it was and returns `NOT_CONVERGED` where
    /// one is larger. Three steps correct what a stabilised run leaves open.
    ///
    /// [`Projection`](holonom::Projection) iterates as long as it helps and halves steps that do
    /// not. This one does neither, and takes the same time whatever it is given. Start it near a
    /// state that satisfies the equations: what `assemble` finds from afar is out of its reach.
    #[must_use]
    pub fn project(mut self, iterations: usize) -> Self {
        if self.program.function("evaluate").is_none() {
            return self;
        }
        let given = self.before_state() + TIMES + self.elements.len();
        let mut is_known = true;
        self.changing(
            "project",
            "Corrects the state onto the equations of joints, positions and velocities, if no equation is then violated by more than `tolerance` (m, rad; per second).",
            &["tolerance"],
            |_, at, state| {
                let Some(projected) = projected(at, state, iterations) else {
                    is_known = false;
                    return (None, None);
                };
                let [a, b] = [projected.violation, projected.velocity_violation];
                let worst = a.select(b, b, a);
                let guard = argument(given) - worst;
                (Some(projected.pivot), Some((guard, Guard::Converged)))
            },
        );
        if !is_known {
            return self.refused(ExportError::Projection);
        }
        self
    }
}
