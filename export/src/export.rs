//! A mechanism as a program: what is traced, function by function.

use std::marker::PhantomData;

use holonom::dynamics::Problem;
use holonom::formulation::Formulation;
use holonom::mechanism::{Terms, TracedCoordinates};
use holonom::state::{Array, MovingState, Vector as _};
use holonom::traced::check_start;
use holonom::{Fault, Mechanism, MechanismExt as _, Real, Rk4, StandardLagrange, Stepper, View};

use crate::constants::{Constant, rigid};
use crate::error::ExportError;
use crate::interface::Turned;
use crate::layout::{self, Element};
use crate::limits::{Limited, limits_of};
use crate::names::identifier;
use crate::number::{Double, Precision, Traced};
use crate::openings::Openings;
use crate::program::{Argument, Function, Kind, Member, Output, Program, Struct};
use crate::system::{StateOf, numbers, state_of};
use crate::tape::{Obstacle, Operation, Place, Tape, traced, with};
use crate::values::{self, Value};

/// The places of the structs of every program.
pub(crate) const PARAMETERS: usize = 0;
pub(crate) const INPUTS: usize = 1;
pub(crate) const CONSTANTS: usize = 2;
pub(crate) const STATE: usize = 3;
pub(crate) const SLOPE: usize = 4;

/// The numbers of a state in front of those that are moved: the time, and what its last digits
/// leave over.
pub(crate) const TIMES: usize = 2;

/// The relative pivot, in units of the last digit, below which a system has no solution: as a
/// [`Stepper`] has it.
const VANISHED: f64 = 64.0;

/// Names that every program has beside those of its functions and structs.
const OWN: &[&str] = &[
    "real",
    "status",
    "init",
    "rates",
    "default_parameters",
    "default_inputs",
    "fused",
    "sqrt",
    "fabs",
    "least",
    "sin",
    "cos",
    "exp",
    "atan2",
    "round",
    "turn",
    "small_turn",
    "large_turn",
    "turns",
    "small_turn",
    "ulp",
    "slope_is_finite",
    // What is written in upper case, where the name of the program is.
    "OK",
    "BAD_STEP",
    "SINGULAR",
    "NOT_FINITE",
    "LIMIT",
    "NOT_CONVERGED",
    "OPEN",
    "H",
    "FUNCTION",
    "RESTRICT",
];

/// A mechanism that is written as a program: its functions, one after the other, and then in C.
///
/// ```
/// use holonom::prelude::*;
/// use holonom_export::ExportExt;
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// struct Arm {
///     #[input]
///     torque: f64,
///     #[body(mass = 1.0, inertia = [0.083, 0.001, 0.083], position = [0.0, 0.5, 0.0])]
///     link: Body,
///     #[joint(between = [ground, link], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
///     #[force(between = [ground, link], axis = [1.0, 0.0, 0.0], moment = torque)]
///     motor: TorsionalActuator,
/// }
///
/// let arm = Arm::default();
/// let source = arm.export(StandardLagrange)
///     .step(Rk4)
///     .reading("height", "height of the link (m)", |view| view.position(Arm::HANDLES.link).z)
///     .c()?;
/// assert!(source.header.contains("arm_status arm_step("));
/// # Ok::<(), holonom_export::ExportError>(())
/// ```
///
/// `P` is the type of its numbers, `C` are the coordinates in which the equations of motion are
/// solved.
#[derive(Debug)]
pub struct Export<M: Mechanism, P = Double, C = <M as Mechanism>::Coordinates> {
    pub(crate) name: String,
    pub(crate) program: Program,
    pub(crate) elements: Vec<Element>,
    pub(crate) values: [Vec<Value>; 2],
    /// The parameters and inputs of the mechanism that was given.
    pub(crate) defaults: Vec<f64>,
    /// The numbers of the start.
    pub(crate) start: Vec<f64>,
    /// What is wrong with the start.
    start_fault: Option<ExportError>,
    /// Joints that may be open.
    pub(crate) openings: Openings,
    /// The least pivot that is accepted.
    pub(crate) least_pivot: f64,
    pub(crate) has_pivot: bool,
    pub(crate) constants: Vec<Constant>,
    /// The joints with limits.
    pub(crate) limited: Vec<Limited>,
    /// What counts turns, by the joints.
    pub(crate) turned: Vec<Turned>,
    pub(crate) is_passing_limits: bool,
    /// Whether what one side of a choice alone needs stands behind a branch.
    pub(crate) has_branches: bool,
    pub(crate) fault: Option<ExportError>,
    types: PhantomData<(M, P, C)>,
}

/// Mechanisms that are exported.
pub trait ExportExt: Mechanism {
    /// The mechanism as a program over `double`, in the coordinates that its attribute names. What
    /// is wrong is said where the program is written.
    fn export<F: Formulation<f64>>(&self, formulation: F) -> Export<Self>
    where
        Self::Coordinates: TracedCoordinates<Self>,
    {
        Export::new(self, formulation)
    }
}

impl<M: Mechanism> ExportExt for M {}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// The mechanism as a program, with the function that gives its rates.
    #[must_use]
    pub fn new<F: Formulation<f64>>(mechanism: &M, formulation: F) -> Self {
        let mut export = Self {
            name: program_name(&snake(M::REPORT.name)),
            program: Program::default(),
            elements: Vec::new(),
            values: values::of(&M::REPORT),
            defaults: Vec::new(),
            start: Vec::new(),
            start_fault: None,
            openings: Openings::default(),
            least_pivot: VANISHED
                * if P::IS_SINGLE {
                    f64::from(f32::EPSILON)
                } else {
                    f64::EPSILON
                },
            has_pivot: C::HAS_PIVOTS && !F::Terms::COMPLIANT,
            constants: Vec::new(),
            limited: Vec::new(),
            turned: Vec::new(),
            is_passing_limits: false,
            has_branches: true,
            fault: None,
            types: PhantomData,
        };
        if F::ITERATED {
            export.fault = Some(ExportError::Formulation);
        }
        if let Err(fault) = export.begin(mechanism, formulation) {
            export.fault.get_or_insert(fault);
        }
        export
    }

    fn begin<F: Formulation<f64>>(
        &mut self,
        mechanism: &M,
        formulation: F,
    ) -> Result<(), ExportError> {
        let stabilisation = formulation.stabilisation()?;
        let parameters = mechanism.parameters::<f64>()?;
        self.defaults = parameters.as_slice().to_vec();
        self.limited = limits_of::<M>(&parameters);
        if P::IS_SINGLE {
            self.described::<f32>(mechanism)?;
        } else {
            self.described::<f64>(mechanism)?;
        }
        self.layout();
        let radian = formulation.radian();
        let compliances = self.compliances::<F::Terms>(&parameters, &stabilisation, radian)?;
        self.preparation(&stabilisation, &compliances);
        self.kernel::<F::Terms>();
        self.of_joints(&parameters);
        self.of_limits();
        self.of_openings();
        Ok(())
    }

    /// Begins as the attributes of the bodies say, or nearly so where a joint is open: then another
    /// start has to be given.
    fn described<S: Real>(&mut self, mechanism: &M) -> Result<(), ExportError> {
        let parameters = mechanism.parameters::<S>()?;
        let constants = M::prepare(&parameters);
        let bodies = M::initial_state(&constants);
        self.openings = Openings::of::<S, M, C>(&constants, &bodies);
        if let Err(fault) = self.begin_with::<S>(mechanism, &bodies) {
            self.start_fault = Some(ExportError::of_start(fault));
            let (own, _) = C::prepare(&parameters, &rigid(), &Array::zeros());
            self.start_from(&C::of_bodies(&own, &bodies));
        }
        Ok(())
    }

    /// Begins with a state of the bodies, if a run could.
    fn begin_with<S: Real>(&mut self, mechanism: &M, bodies: &M::State<S>) -> Result<(), Fault> {
        let stepper = Stepper::<Problem<_, _, S>, _>::new(mechanism, StandardLagrange, Rk4)?;
        if !C::IS_RELATIVE {
            let constants = stepper.dynamics().constants();
            check_start::<S, M>(constants, (S::zero(), S::one()), bodies, false)?;
        }
        self.start_from(&stepper.coordinates::<C>().state_of(bodies)?);
        Ok(())
    }

    fn start_from<S: Real>(&mut self, state: &C::State<S>) {
        self.start.clear();
        state.for_each(|number| self.start.push(number.to_f64()));
    }

    /// The structs of the program.
    fn layout(&mut self) {
        let [pairs, rest, rates] = sizes::<M, C>();
        self.elements = layout::of_state::<M, C>(pairs, rest, rates);
        let members = |values: &[Value]| values.iter().map(|value| value.member.clone()).collect();
        let mut of_state = vec![
            Member::number("time", "time (s)"),
            Member::number(
                "time_rest",
                "what the last digits of the time leave over (s)",
            ),
        ];
        of_state.extend(self.elements.iter().map(|element| element.of_state.clone()));
        let of_slope = self
            .elements
            .iter()
            .filter_map(|element| element.of_slope.clone());
        let made = |name, about: &str, members| Struct {
            name,
            about: about.to_owned(),
            members,
        };
        self.program.structs = vec![
            made(
                "parameters",
                "Parameters, in the units of the description.",
                members(&self.values[0]),
            ),
            made(
                "inputs",
                "Inputs, in the units of the description.",
                members(&self.values[1]),
            ),
            made(
                "constants",
                "What follows from parameters and inputs.",
                Vec::new(),
            ),
            made("state", "The time, coordinates and velocities.", of_state),
            made("slope", "The rates of a state.", of_slope.collect()),
        ];
    }

    /// How many numbers a function is given before the state.
    pub(crate) fn before_state(&self) -> usize {
        // There is none where the mechanism was refused.
        let constants = self.program.structs.get(CONSTANTS);
        constants.map_or(0, Struct::numbers)
    }

    /// The time, and the state as arguments behind the constants.
    pub(crate) fn state(&self) -> (Traced<P>, StateOf<P, M, C>) {
        let first = self.before_state();
        let state = state_of::<P, M, C>(|place| Some(argument(first + TIMES + place)));
        (argument(first), state)
    }

    /// The function that gives the rates, and the least relative pivot.
    fn kernel<T: Terms>(&mut self) {
        let (tape, (pivot, rates)) = traced(P::IS_SINGLE, || {
            let (own, coefficients, _) = self.constants_from(0);
            let (time, state) = self.state();
            let mut rates = StateOf::<P, M, C>::zeros();
            let mut multipliers = Array::zeros();
            let pivot = C::rates_into::<_, T>(
                &own,
                &coefficients,
                time,
                &state,
                &mut rates,
                &mut multipliers,
            );
            (pivot.relative.place(), numbers(&rates))
        });
        let gives = self.gives();
        let given = rates.into_iter().zip(&gives).filter(|(_, gives)| **gives);
        let outputs = outputs(2, given.map(|(rate, _)| rate.place())).collect();
        self.add(Function {
            name: "evaluate".to_owned(),
            about: "The rates of a state; returns the least relative pivot.".to_owned(),
            arguments: vec![
                structure("constants", CONSTANTS),
                structure("state", STATE),
                written("slope", SLOPE),
            ],
            outputs,
            tape,
            returned: self.has_pivot.then_some(pivot),
            is_public: false,
            is_checked: false,
            guard: None,
        });
    }

    /// Which numbers of a slope are given.
    pub(crate) fn gives(&self) -> Vec<bool> {
        let elements = self.elements.iter();
        elements.map(|element| element.of_slope.is_some()).collect()
    }

    /// Gives the program, and with it every name in it, another name than that of the mechanism in
    /// lower case.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.name = program_name(name);
        self
    }

    /// Begins with this state of the bodies, in the place of the described one.
    #[must_use]
    pub fn starting_from(mut self, mechanism: &M, bodies: &M::State<f64>) -> Self {
        let begun = self.begin_with(mechanism, bodies);
        self.start_fault = begun.err().map(ExportError::of_start);
        self
    }

    /// Corrects the described start onto the constraints, as
    /// [`Simulation::assembled`](holonom::Simulation::assembled) does: loops whose description is
    /// open are closed on its branch.
    #[must_use]
    pub fn assembled(mut self, mechanism: &M) -> Self {
        let begun = if P::IS_SINGLE {
            self.assemble::<f32>(mechanism)
        } else {
            self.assemble::<f64>(mechanism)
        };
        self.start_fault = begun.err().map(ExportError::of_start);
        self
    }

    fn assemble<S: Real>(&mut self, mechanism: &M) -> Result<(), Fault> {
        let mut bodies = mechanism.described_state::<S>()?;
        mechanism.assemble(S::zero(), &mut bodies)?;
        self.begin_with(mechanism, &bodies)
    }

    /// A step passes the limits of joints as if there were none. Else it returns `LIMIT`, and
    /// leaves the state as it was.
    #[must_use]
    pub fn without_limits(mut self) -> Self {
        self.is_passing_limits = true;
        self
    }

    /// Computes both sides of every choice, and takes one: a step takes the same time whatever the
    /// numbers are. Else what only one side needs is computed where it is taken. The numbers are
    /// the same.
    #[must_use]
    pub fn without_branches(mut self) -> Self {
        self.has_branches = false;
        self
    }

    /// A function of the state that returns a number, with what it is, and its unit.
    ///
    /// The closure is called once with numbers that write down what is computed with them. It may
    /// read what a [`View`] gives of such numbers, and combine it by the operations of a
    /// [`Scalar`](holonom::Scalar).
    #[must_use]
    pub fn reading(
        mut self,
        name: &str,
        about: &str,
        read: impl FnOnce(&View<'_, Traced<P>, M>) -> Traced<P>,
    ) -> Self {
        let (tape, place) = traced(P::IS_SINGLE, || {
            let (own, _, absolute) = self.constants_from(0);
            let (time, state) = self.state();
            let bodies = C::bodies_by_selection(&own, &state);
            read(&View::new(&absolute, time, &bodies)).place()
        });
        self.add(Function {
            name: identifier(name),
            about: about.to_owned(),
            arguments: vec![structure("constants", CONSTANTS), structure("state", STATE)],
            outputs: Vec::new(),
            tape,
            returned: Some(place),
            is_public: true,
            is_checked: false,
            guard: None,
        });
        self
    }

    /// How many additions, multiplications and functions of numbers a function takes, by its name
    /// such as `evaluate`. Those of the functions that it calls are left out. `None` where there is
    /// none of that name.
    #[must_use]
    pub fn operations(&self, function: &str) -> Option<usize> {
        let place = self.program.function(function)?;
        Some(self.program.functions[place].operations())
    }

    pub(crate) fn add(&mut self, function: Function) {
        if function.tape.obstacle() == Some(Obstacle::Comparison) {
            self.fault.get_or_insert(ExportError::Comparison {
                function: function.name.clone(),
            });
        }
        self.program.functions.push(function);
    }

    /// The program, with what is wrong with it.
    pub(crate) fn refused(mut self, fault: ExportError) -> Self {
        self.fault.get_or_insert(fault);
        self
    }

    /// A name that is given twice.
    fn taken(&self) -> Option<String> {
        let structs = self.program.structs.iter().map(|of| of.name);
        let known: Vec<&str> = structs.chain(OWN.iter().copied()).collect();
        let mut before = Vec::new();
        for function in &self.program.functions {
            let name = function.name.as_str();
            let is_own = ["evaluate", "step"].contains(&name) && !before.contains(&name);
            if before.contains(&name) || (known.contains(&name) && !is_own) {
                return Some(name.to_owned());
            }
            before.push(name);
        }
        None
    }

    /// The program, if nothing is wrong with it.
    ///
    /// # Errors
    /// What was wrong with the mechanism or with one of its functions.
    pub fn checked(mut self) -> Result<Self, ExportError> {
        let fault = self.fault.take().or(self.start_fault.take());
        if let Some(fault) = fault {
            return Err(fault);
        }
        if self.program.structs[SLOPE].members.is_empty() {
            return Err(ExportError::Still);
        }
        if let Some(name) = self.taken() {
            return Err(ExportError::Name { name });
        }
        let step = self.program.function("step");
        let step = step.and_then(|place| self.program.functions.get_mut(place));
        let Some(step) = step else { return Ok(self) };
        if self.is_passing_limits {
            step.guard = None;
        } else if let Some(wide) = self.limited.iter().find(|of| of.is_unknown()) {
            let joint = wide.name();
            return Err(ExportError::Limits { joint });
        }
        Ok(self)
    }
}

/// How many pairs, further coordinates and rates a state has.
fn sizes<M: Mechanism, C: TracedCoordinates<M>>() -> [usize; 3] {
    let state = C::State::<f64>::zeros();
    let rates = state.rates_slice().len();
    let coordinates = state.length() - rates;
    let pairs = (0..coordinates)
        .filter(|&k| !state.is_independent(k))
        .count();
    [pairs, coordinates - 2 * pairs, rates]
}

/// The number that a function is given at a place.
pub(crate) fn argument<P: Precision>(place: usize) -> Traced<P> {
    let place = Operation::Argument(u32::try_from(place).unwrap_or(u32::MAX));
    Traced::at(with(|tape: &mut Tape| tape.intern(place)))
}

pub(crate) fn structure(name: &'static str, place: usize) -> Argument {
    Argument {
        name,
        kind: Kind::Struct(place),
        is_output: false,
    }
}

pub(crate) fn written(name: &'static str, place: usize) -> Argument {
    Argument {
        is_output: true,
        ..structure(name, place)
    }
}

/// All numbers of a struct as outputs of an argument.
pub(crate) fn outputs(
    argument: usize,
    places: impl Iterator<Item = Place>,
) -> impl Iterator<Item = Output> {
    places.enumerate().map(move |(number, place)| Output {
        argument,
        number,
        place,
    })
}

/// The name of a program: a keyword of some compilers would begin with an underscore.
fn program_name(name: &str) -> String {
    let name = identifier(name);
    if name.starts_with('_') {
        format!("mechanism{name}").trim_end_matches('_').to_owned()
    } else {
        name
    }
}

/// A name such as `FourBar` as `four_bar`.
fn snake(name: &str) -> String {
    let mut written = String::new();
    let mut before = None::<char>;
    for character in name.chars() {
        if character.is_ascii_uppercase()
            && before.is_some_and(|before| before.is_ascii_lowercase() || before.is_ascii_digit())
        {
            written.push('_');
        }
        written.push(character.to_ascii_lowercase());
        before = Some(character);
    }
    written
}
