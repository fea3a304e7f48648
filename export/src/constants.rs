//! What follows from parameters and inputs alone, computed once.

use holonom::mechanism::{Coordinates, Stabilisation, Terms, TracedCoordinates};
use holonom::state::Array as _;
use holonom::traced as of_rust;
use holonom::{Mechanism, Scalar};

use crate::error::ExportError;
use crate::export::{CONSTANTS, Export, INPUTS, PARAMETERS, argument, outputs, structure, written};
use crate::limits::constants_of;
use crate::number::{Precision, Traced};
use crate::program::{Function, Member, Output};
use crate::system::ConstantsOf;
use crate::tape::{Operation, Place, traced};

/// Constants, coefficients and the constants in absolute coordinates.
pub(crate) type AllConstants<P, M, C> = (
    ConstantsOf<P, M, C>,
    <C as Coordinates<M>>::Coefficients<Traced<P>>,
    <M as Mechanism>::Constants<Traced<P>>,
);

/// Constraints without a term of `Phi` and without compliance.
pub(crate) fn rigid<S: Scalar>() -> Stabilisation<S> {
    Stabilisation {
        rate: S::zero(),
        position: S::zero(),
        compliance: S::zero(),
    }
}

/// A number that depends on parameters and inputs.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Constant {
    /// On none of them.
    Known(f64),
    Given,
}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// Parameters and inputs as arguments; what is neither stays the number that it is.
    fn parameters(&self) -> M::Parameters<Traced<P>> {
        let mut parameters = M::Parameters::<Traced<P>>::zeros();
        let places = parameters.as_mut_slice().iter_mut();
        for (place, &number) in places.zip(&self.defaults) {
            *place = Traced::constant(number);
        }
        let given = self.values.iter().flatten().flat_map(|value| &value.places);
        for (number, &place) in given.enumerate() {
            if let Some(place) = parameters.as_mut_slice().get_mut(place) {
                *place = argument(number);
            }
        }
        parameters
    }

    /// The compliances of all equations, as a [`Stepper`](holonom::Stepper) of the mechanism has
    /// them. They are chosen by comparisons, so none may depend on a parameter or an input.
    pub(crate) fn compliances<T: Terms>(
        &self,
        parameters: &M::Parameters<f64>,
        stabilisation: &Stabilisation<f64>,
        radian: f64,
    ) -> Result<Vec<f64>, ExportError> {
        let has_equations = !C::Multipliers::<f64>::zeros().as_slice().is_empty();
        if T::COMPLIANT && has_equations && !self.has_known_units() {
            return Err(ExportError::Compliance);
        }
        if !P::IS_SINGLE {
            let constants = M::prepare(parameters);
            let all = of_rust::compliances::<_, M, T>(&constants, stabilisation, radian)?;
            return Ok(all.as_slice().to_vec());
        }
        let single = <f32 as Scalar>::constant;
        let mut rounded = M::Parameters::<f32>::zeros();
        let places = rounded.as_mut_slice().iter_mut();
        let numbers = parameters.as_slice();
        places
            .zip(numbers)
            .for_each(|(place, &number)| *place = single(number));
        let stabilisation = Stabilisation {
            rate: single(stabilisation.rate),
            position: single(stabilisation.position),
            compliance: single(stabilisation.compliance),
        };
        let constants = M::prepare(&rounded);
        let all = of_rust::compliances::<_, M, T>(&constants, &stabilisation, single(radian))?;
        Ok(all
            .as_slice()
            .iter()
            .map(|&number| f64::from(number))
            .collect())
    }

    /// Whether units of equations are the same whatever parameters and inputs are.
    fn has_known_units(&self) -> bool {
        let (tape, places) = traced(P::IS_SINGLE, || {
            let constants = M::prepare(&self.parameters());
            let mut places = Vec::new();
            let each = |number: Traced<P>| places.push(number.place());
            of_rust::numbers_of_units::<_, M>(&constants, each);
            places
        });
        let (needed, _) = tape.needed(places);
        let mut needed = tape.operations().iter().zip(needed);
        !needed.any(|(operation, is)| is && matches!(operation, Operation::Argument(_)))
    }

    /// The functions that compute constants, of parameters and inputs and of inputs alone.
    pub(crate) fn preparation(&mut self, stabilisation: &Stabilisation<f64>, compliances: &[f64]) {
        let number = Traced::<P>::constant;
        let prepared = traced(P::IS_SINGLE, || {
            let stabilisation = Stabilisation {
                rate: number(stabilisation.rate),
                position: number(stabilisation.position),
                compliance: number(stabilisation.compliance),
            };
            let parameters = self.parameters();
            let mut by_row = M::Multipliers::<Traced<P>>::zeros();
            let rows = by_row.as_mut_slice().iter_mut();
            rows.zip(compliances)
                .for_each(|(row, &known)| *row = number(known));
            let (own, coefficients) = C::prepare(&parameters, &stabilisation, &by_row);
            let absolute = M::prepare(&parameters);
            let limits = constants_of::<P, M>(&parameters);
            let slices = [own.as_slice(), coefficients.as_slice(), absolute.as_slice()];
            [&slices[..], &[&limits[..]]]
                .concat()
                .concat()
                .into_iter()
                .map(Traced::place)
                .collect::<Vec<_>>()
        });
        let (tape, places) = prepared;
        self.constants = places
            .iter()
            .map(|&place| {
                tape.constant(place)
                    .map_or(Constant::Given, Constant::Known)
            })
            .collect();
        self.program.structs[CONSTANTS].members =
            vec![Member::array("value", "", places.len().max(1))];
        let outputs = outputs(2, places.into_iter());
        let given = self.constants.clone();
        let is_given = |output: &Output| matches!(given[output.number], Constant::Given);
        self.add(Function {
            name: "prepare".to_owned(),
            about: "Computes what follows from parameters and inputs.".to_owned(),
            arguments: vec![
                structure("parameters", PARAMETERS),
                structure("inputs", INPUTS),
                written("constants", CONSTANTS),
            ],
            outputs: outputs.filter(is_given).collect(),
            tape,
            returned: None,
            is_public: true,
            is_checked: false,
            guard: None,
        });
        if !self.values[1].is_empty() {
            self.taking_inputs();
        }
    }

    fn taking_inputs(&mut self) {
        let values = self.values.iter().flatten();
        let count: usize = values.map(|value| value.places.len()).sum();
        let (tape, places) = traced(P::IS_SINGLE, || {
            let parameters = self.parameters();
            let (own, coefficients, absolute) = self.constants_from(count);
            let own = C::with_inputs(&parameters, own);
            let mut taken = absolute;
            M::take_inputs(&parameters, &mut taken);
            [own.as_slice(), coefficients.as_slice(), taken.as_slice()].concat()
        });
        let is_written = |(number, place): (usize, Place)| {
            let before = Operation::Argument(u32::try_from(count + number).unwrap_or(u32::MAX));
            let is_given = matches!(self.constants.get(number), Some(Constant::Given));
            (is_given && tape.at(place) != before).then_some(Output {
                argument: 3,
                number,
                place,
            })
        };
        let places = places.into_iter().map(Traced::place).enumerate();
        let outputs: Vec<_> = places.filter_map(is_written).collect();
        self.add(Function {
            name: "set_inputs".to_owned(),
            about: "Computes again what follows from inputs.".to_owned(),
            arguments: vec![
                structure("parameters", PARAMETERS),
                structure("inputs", INPUTS),
                // Read and written.
                structure("constants", CONSTANTS),
                written("constants", CONSTANTS),
            ],
            outputs,
            tape,
            returned: None,
            is_public: true,
            is_checked: false,
            guard: None,
        });
    }

    /// Constants, coefficients and the constants in absolute coordinates: known, or arguments from
    /// a place on.
    pub(crate) fn constants_from(&self, first: usize) -> AllConstants<P, M, C> {
        let mut numbers = (0..self.constants.len()).map(|k| self.constant(first, k));
        let mut own = ConstantsOf::<P, M, C>::zeros();
        let mut coefficients = <C as Coordinates<M>>::Coefficients::<Traced<P>>::zeros();
        let mut absolute = M::Constants::<Traced<P>>::zeros();
        let slices = [
            own.as_mut_slice(),
            coefficients.as_mut_slice(),
            absolute.as_mut_slice(),
        ];
        for place in slices.into_iter().flatten() {
            if let Some(number) = numbers.next() {
                *place = number;
            }
        }
        (own, coefficients, absolute)
    }

    /// The constant of a place: known, or an argument behind so many others.
    pub(crate) fn constant(&self, first: usize, place: usize) -> Traced<P> {
        match self.constants.get(place) {
            Some(Constant::Known(number)) => Traced::constant(*number),
            _ => argument(first + place),
        }
    }
}
