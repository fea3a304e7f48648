//! A scalar that counts confirms the report, operation by operation.

use holonom::{
    Mechanism, Scalar,
    mechanism::{Compliant, Operations, Plain, Stabilisation, Stabilised, Terms},
};
use holonom_models::RodPendulum;

use crate::scalars::{self, Counted};
use crate::scene::{Scene, constants, state};

/// The operations of a computation.
fn counted<T>(computation: impl FnOnce() -> T) -> Operations {
    scalars::counted(computation).0
}

/// What the kernels of a mechanism are called with.
struct Call<M: Scene> {
    constants: M::Constants<Counted>,
    coefficients: M::Coefficients<Counted>,
    state: M::State<Counted>,
}

impl<M: Scene> Call<M> {
    fn new() -> Self {
        let constants = constants::<Counted, M>();
        let stabilisation = Stabilisation {
            rate: Counted::constant(10.0),
            position: Counted::constant(25.0),
            compliance: Counted::constant(1e-7),
        };
        Self {
            coefficients: M::coefficients(&constants, &stabilisation),
            constants,
            state: state::<Counted, M>(M::assembler().initial_state().as_slice()),
        }
    }

    fn evaluation<T: Terms>(&self) -> Operations {
        counted(|| {
            M::evaluate::<Counted, T>(
                &self.constants,
                &self.coefficients,
                Counted::zero(),
                &self.state,
            )
        })
    }

    fn back_substitution<T: Terms>(&self) -> Operations {
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        let (time, state) = (Counted::zero(), &self.state);
        let (factors, _) = M::factor::<Counted, T>(constants, coefficients, time, state);
        let upper = M::forces(constants, time, state);
        let lower = M::gamma(constants, time, state);
        counted(|| M::solve::<Counted, T>(constants, coefficients, &factors, &upper, &lower))
    }

    /// What a kernel of the report does when it is called.
    fn operations(&self, kernel: &str) -> Operations {
        let (constants, time, state) = (&self.constants, Counted::zero(), &self.state);
        match kernel {
            "evaluate standard" => self.evaluation::<Plain>(),
            "evaluate baumgarte" => self.evaluation::<Stabilised>(),
            "evaluate penalty" => self.evaluation::<Compliant>(),
            "constraints" => counted(|| M::constraints(constants, time, state)),
            "constraint rates" => counted(|| M::constraint_rates(constants, time, state)),
            "jacobian" => counted(|| M::jacobian(constants, time, state)),
            "gamma" => counted(|| M::gamma(constants, time, state)),
            "forces" => counted(|| M::forces(constants, time, state)),
            "kinetic energy" => counted(|| M::kinetic_energy(constants, state)),
            "potential energy" => counted(|| M::potential_energy(constants, time, state)),
            "coordinate rates" => counted(|| M::coordinate_rates(constants, state)),
            "power" => counted(|| M::power(constants, time, state)),
            "solve" => self.back_substitution::<Plain>(),
            "solve, compliant" => self.back_substitution::<Compliant>(),
            other => panic!("the report names a kernel that is not known here: {other}"),
        }
    }
}

/// The kernels that a report has at least; where there are forces, their power besides.
const KERNELS: [&str; 13] = [
    "evaluate standard",
    "evaluate baumgarte",
    "evaluate penalty",
    "constraints",
    "constraint rates",
    "jacobian",
    "gamma",
    "forces",
    "kinetic energy",
    "potential energy",
    "coordinate rates",
    "solve",
    "solve, compliant",
];

fn reported<M: Mechanism>(kernel: &str) -> Operations {
    let found = M::REPORT.operations(kernel);
    found.unwrap_or_else(|| panic!("no {kernel} in the report of {}", M::REPORT.name))
}

fn the_report_is_what_is_done<M: Scene>() {
    let call = Call::<M>::new();
    let power = (!M::REPORT.forces.is_empty()).then_some("power");
    let kernels = KERNELS.into_iter().chain(power);
    assert_eq!(M::REPORT.kernels.len(), kernels.clone().count());
    for kernel in kernels {
        let (done, reported) = (call.operations(kernel), reported::<M>(kernel));
        println!("{kernel}: {}, depth {}", done.total(), done.depth);
        assert_eq!(done, reported, "{kernel} of {}", M::REPORT.name);
    }
}

#[test]
fn the_pendulum_is_as_cheap_as_asked_for() {
    /// With multipliers.
    const STANDARD: usize = 170;
    const BAUMGARTE: usize = 230;
    assert!(reported::<RodPendulum>("evaluate standard").total() <= STANDARD);
    assert!(reported::<RodPendulum>("evaluate baumgarte").total() <= BAUMGARTE);
}

mod the_report_is_what_is_done {
    every_independent_mechanism! { the_report_is_what_is_done }
    every_redundant_mechanism! { the_report_is_what_is_done }
}
