//! What a class is made of, as the macro writes it.

use holonom::error::{Fault, ParameterError};
use holonom::independent::{IndependentCoordinates, Linearised};
use holonom::mechanism::{Coordinates, HasInverse, HasJacobian, HasMassMatrix, Relative};
use holonom::nalgebra::SMatrix;
use holonom::state::Array;
use holonom::{Mechanism, View};

use crate::described::{Kind, values};
use crate::start::Start;

/// A reading of the user's own.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    /// Its name.
    pub name: &'static str,
    /// What it is, with its unit in parentheses.
    pub about: &'static str,
}

/// A mechanism as a class. The macro implements it for a type of its own.
pub trait Exposed: Sized + 'static {
    /// The mechanism.
    type Mechanism: Mechanism + Send + Sync;
    /// The coordinates that runs are solved in.
    type Coordinates: Coordinates<Self::Mechanism>;

    /// The joints that were named as coordinates.
    const CHOSEN: &'static [&'static str];
    /// The readings of the user's own.
    const READINGS: &'static [Reading];

    /// The mechanism with these parameters.
    ///
    /// # Errors
    /// A parameter that is not acceptable.
    fn make(numbers: &mut Numbers) -> Result<Self::Mechanism, ParameterError>;

    /// The mechanism with its typical values, if it has these.
    fn typical() -> Option<Self::Mechanism>;

    /// The readings of the user's own, in their order.
    fn read(view: &View<'_, f64, Self::Mechanism>) -> Vec<f64>;

    /// The bodies at a start.
    ///
    /// # Errors
    /// A start that the mechanism cannot have.
    fn begin(
        valued: &Valued<Self::Mechanism>,
        time: f64,
        start: &Start,
    ) -> Result<<Self::Mechanism as Mechanism>::State<f64>, Fault>;

    /// The names of the coordinates and their units.
    fn coordinates() -> Vec<(String, &'static str)>;
}

/// The equations of motion of a class.
pub(crate) type SpaceOf<E, const N: usize> = IndependentCoordinates<<E as Exposed>::Mechanism, N>;

/// A mechanism with equations of motion in coordinates.
pub trait Analysed<const N: usize>:
    Exposed<Coordinates = Relative, Mechanism: HasInverse + HasMassMatrix + HasJacobian>
{
    /// The equations of motion, linear about a state, by all inputs.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::linearise`].
    fn linearise(
        space: &IndependentCoordinates<Self::Mechanism, N>,
        state: &<Self::Mechanism as holonom::JointCoordinates>::JointState<f64>,
    ) -> Result<Matrices, Fault>;
}

/// `A`, `B`, `C` and `D`, row by row.
#[derive(Clone, Debug)]
pub struct Matrices(pub(crate) [Vec<f64>; 4]);

impl Matrices {
    /// Those of a linear model.
    #[must_use]
    pub fn of<const N: usize, const K: usize, const P: usize>(of: &Linearised<N, K, P>) -> Self {
        let (mut a, mut b, mut c) = (Vec::new(), vec![0.0; N * K], Vec::new());
        for row in 0..N {
            put(&mut a, &of.rates_by_positions, row);
            a.extend((0..N).map(|column| f64::from(u8::from(row == column))));
        }
        for row in 0..N {
            put(&mut a, &of.by_positions, row);
            put(&mut a, &of.by_rates, row);
            put(&mut b, &of.by_values, row);
        }
        let mut d = Vec::new();
        for row in 0..P {
            put(&mut c, &of.readings_by_positions, row);
            put(&mut c, &of.readings_by_rates, row);
            put(&mut d, &of.readings_by_values, row);
        }
        Self([a, b, c, d])
    }
}

fn put<const R: usize, const C: usize>(to: &mut Vec<f64>, of: &SMatrix<f64, R, C>, row: usize) {
    to.extend(of.row(row).iter());
}

/// A mechanism with the numbers that it has.
#[derive(Debug)]
pub struct Valued<M> {
    /// The mechanism, whose inputs are those of its default.
    pub(crate) mechanism: M,
    /// Its parameters, inputs and starts, in the places of the mechanism's parameters.
    pub(crate) numbers: Vec<f64>,
}

impl<M: Mechanism> Valued<M> {
    /// The mechanism with these numbers; where one is NaN, with what it has by itself.
    pub(crate) fn of<E: Exposed<Mechanism = M>>(mut numbers: Vec<f64>) -> Result<Self, Fault> {
        let given = values::<M>().into_iter();
        let given = given.filter(|value| value.kind == Kind::Parameter);
        let places: Vec<usize> = given.flat_map(|value| value.places).collect();
        let mut arguments = Numbers {
            numbers: places.iter().map(|&place| numbers[place]).collect(),
            next: 0,
        };
        let mechanism = E::make(&mut arguments)?;
        // The arguments of `new` are the parameters in the order of the fields.
        let parameters = mechanism.parameters::<f64>()?;
        let parameters = parameters.as_slice();
        let agrees = |&place: &usize| parameters[place].to_bits() == numbers[place].to_bits();
        assert!(
            places.iter().all(agrees),
            "`new` does not take the parameters in the order of the fields"
        );
        for (number, own) in numbers.iter_mut().zip(parameters) {
            if number.is_nan() {
                *number = *own;
            }
        }
        Ok(Self { mechanism, numbers })
    }

    /// The inputs, all of them finite.
    pub(crate) fn inputs(&self) -> Result<M::Inputs<f64>, Fault> {
        let mut parameters = self.mechanism.parameters::<f64>()?;
        self.put(&mut parameters);
        Ok(M::inputs_of(&parameters))
    }

    /// Puts the inputs among the parameters.
    pub(crate) fn put(&self, parameters: &mut M::Parameters<f64>) {
        let inputs = values::<M>().into_iter();
        let inputs = inputs.filter(|value| value.kind == Kind::Input);
        for place in inputs.flat_map(|value| value.places) {
            parameters.as_mut_slice()[place] = self.numbers[place];
        }
    }
}

/// The arguments of `new`, one number after the other.
#[derive(Debug)]
pub struct Numbers {
    numbers: Vec<f64>,
    next: usize,
}

impl Numbers {
    fn next(&mut self) -> f64 {
        let number = self.numbers.get(self.next).copied();
        self.next += 1;
        number.unwrap_or(f64::NAN)
    }
}

/// What can be a parameter of a class: a number, or an array of numbers.
#[diagnostic::on_unimplemented(
    message = "a parameter of type `{Self}` cannot be given from Python",
    label = "neither `f64` nor an array of it",
    note = "write a struct of your own around the table or the part, with `#[param]` fields of type `f64`"
)]
pub trait Argument {
    /// Reads it.
    fn read(numbers: &mut Numbers) -> Self;
}

impl Argument for f64 {
    fn read(numbers: &mut Numbers) -> Self {
        numbers.next()
    }
}

impl<const K: usize> Argument for [f64; K] {
    fn read(numbers: &mut Numbers) -> Self {
        std::array::from_fn(|_| numbers.next())
    }
}

/// `new` of a mechanism, with any number of parameters.
pub trait Construct<A, M> {
    /// Calls it.
    ///
    /// # Errors
    /// A parameter that is not acceptable.
    fn construct(self, numbers: &mut Numbers) -> Result<M, ParameterError>;
}

macro_rules! construct {
    ($($argument:ident)*) => {
        impl<F, M, $($argument: Argument),*> Construct<($($argument,)*), M> for F
        where
            F: FnOnce($($argument),*) -> Result<M, ParameterError>,
        {
            #[allow(unused_variables, reason = "there may be no arguments")]
            fn construct(self, numbers: &mut Numbers) -> Result<M, ParameterError> {
                self($($argument::read(numbers)),*)
            }
        }
    };
}

macro_rules! constructs {
    ($first:ident $($rest:ident)*) => {
        construct!($first $($rest)*);
        constructs!($($rest)*);
    };
    () => {
        construct!();
    };
}

constructs!(A B C D E G H I J K L N O P Q R S T U V W X Y Z);

/// `new` of a mechanism without parameters, which has none: a method of the struct comes first.
pub trait Fallback: Sized {
    /// The default.
    ///
    /// # Errors
    /// None.
    fn new() -> Result<Self, ParameterError>;
}

impl<M: Mechanism + Default> Fallback for M {
    fn new() -> Result<Self, ParameterError> {
        Ok(Self::default())
    }
}

/// Asks whether a mechanism has a default.
#[derive(Debug)]
pub struct Typical<M>(std::marker::PhantomData<fn() -> M>);

impl<M: Default> Typical<M> {
    /// It has.
    #[must_use]
    pub fn of() -> Option<M> {
        Some(M::default())
    }
}

/// The answer of one without.
pub trait NotTypical<M> {
    /// It has none.
    #[must_use]
    fn of() -> Option<M> {
        None
    }
}

impl<M> NotTypical<M> for Typical<M> {}
