//! What a user says of a page.

use std::ops::RangeBounds;

use holonom::JointHandle;
use holonom::dynamics::{Problem, Solvable};
use holonom::mechanism::{HasAngle, HasDisplacement};
use holonom::prelude::*;
use holonom::run::Steps;
use holonom_film::Film;

use crate::error::LiveError;
use crate::session::Session;
use crate::slider::{Read, Slider};

/// The step where nothing else is said (s).
const STEP: f64 = 1e-3;
/// How long the film is that the page shows until its module runs (s).
pub(crate) const PREVIEW: f64 = 4.0;

/// What makes a stepper of a mechanism.
pub(crate) type Build<M, P, K> = Box<dyn Fn(&M) -> Result<Stepper<P, K>, Fault>>;

/// What makes a film of an empty one.
type Titled<M> = Box<dyn Fn(Film<M>) -> Film<M>>;

/// A number that the page draws over time.
pub(crate) struct Reading<M: Mechanism> {
    pub(crate) name: String,
    pub(crate) unit: String,
    pub(crate) read: Read<M>,
}

/// A page in which a mechanism runs: see the crate's page.
///
/// `P` is the [`Problem`] that is solved, `K` the method: [`StandardLagrange`] and [`Rk4`] with a
/// [`Projection`] after every step, in the coordinates of the mechanism, unless
/// [`Live::stepper`] says otherwise.
pub struct Live<M: Mechanism, P: Solvable = Problem<M, StandardLagrange>, K = Rk4> {
    pub(crate) mechanism: M,
    pub(crate) step: f64,
    pub(crate) build: Build<M, P, K>,
    pub(crate) sliders: Vec<Slider<M>>,
    pub(crate) readings: Vec<Reading<M>>,
    /// What is said of each film before its first frame.
    pub(crate) film: Titled<M>,
    pub(crate) preview: f64,
    /// The first thing that was wrong: setters return no error.
    pub(crate) fault: Option<LiveError>,
}

impl<M: Mechanism> Live<M> {
    /// A page of a mechanism with these parameters and inputs, without sliders.
    #[must_use]
    pub fn new(mechanism: M) -> Self {
        Self {
            mechanism,
            step: STEP,
            build: Box::new(|of| {
                let stepper = of.stepper(StandardLagrange, Rk4)?;
                Ok(stepper.projection(Projection::default()))
            }),
            sliders: Vec::new(),
            readings: Vec::new(),
            film: Box::new(|film| film),
            preview: PREVIEW,
            fault: None,
        }
    }
}

impl<M: Mechanism, P: Solvable<Number = f64, Mechanism = M>, K> Live<M, P, K> {
    /// Runs by another stepper: another formulation or method, interactions, forces of a closure.
    /// `build` is called at every start.
    #[must_use]
    pub fn stepper<Q, L>(
        self,
        build: impl Fn(&M) -> Result<Stepper<Q, L>, Fault> + 'static,
    ) -> Live<M, Q, L>
    where
        Q: Solvable<Number = f64, Mechanism = M>,
        L: Steps<Q>,
    {
        Live {
            mechanism: self.mechanism,
            step: self.step,
            build: Box::new(build),
            sliders: self.sliders,
            readings: self.readings,
            film: self.film,
            preview: self.preview,
            fault: self.fault,
        }
    }

    /// Takes steps of this length (s), 0.001 s where nothing is said.
    #[must_use]
    pub fn step(mut self, step: f64) -> Self {
        self.step = step;
        self
    }

    /// A slider of a parameter or an input: a field of the struct, or an element of one that is an
    /// array. It has the name of the field.
    ///
    /// An end of the range that is not said, as in `..`, is 0 or twice the value that the field
    /// has; about zero -1 and 1. The range is widened to that value.
    ///
    /// ```
    /// # use holonom_live::Live;
    /// # use holonom_models::CartPole;
    /// let live = Live::new(CartPole::default()).slider(|of| &mut of.push, "N", -10.0..=10.0);
    /// ```
    #[must_use]
    pub fn slider(
        mut self,
        field: impl for<'a> Fn(&'a mut M) -> &'a mut f64 + 'static,
        unit: &str,
        range: impl RangeBounds<f64>,
    ) -> Self {
        match Slider::of_field(&mut self.mechanism, Box::new(field), unit) {
            Ok(slider) => self.sliders.push(slider.within(&range)),
            Err(error) => self.refuse(error),
        }
        self
    }

    /// A slider of the angle (rad) with which a joint starts; an end that is not said is half a
    /// turn away. The run begins anew where it is moved. Until then the joint starts as described,
    /// or as the loops that it is in let it.
    #[must_use]
    pub fn start_angle<J: HasAngle + 'static>(
        mut self,
        joint: JointHandle<M, J>,
        range: impl RangeBounds<f64>,
    ) -> Self {
        self.sliders.push(Slider::of_angle(joint).within(&range));
        self
    }

    /// The same of a displacement (m); an end that is not said is half the extent of the mechanism
    /// away.
    #[must_use]
    pub fn start_displacement<J: HasDisplacement + 'static>(
        mut self,
        joint: JointHandle<M, J>,
        range: impl RangeBounds<f64>,
    ) -> Self {
        let slider = Slider::of_displacement(joint);
        self.sliders.push(slider.within(&range));
        self
    }

    /// Another name for the last slider.
    #[must_use]
    pub fn named(self, name: &str) -> Self {
        self.last(|slider| name.clone_into(&mut slider.name))
    }

    /// Draws a number over time; those of one unit share a chart.
    #[must_use]
    pub fn reading(
        mut self,
        name: &str,
        unit: &str,
        read: impl Fn(&View<'_, f64, M>) -> f64 + 'static,
    ) -> Self {
        self.readings.push(Reading {
            name: name.to_owned(),
            unit: unit.to_owned(),
            read: Box::new(read),
        });
        self
    }

    /// Draws kinetic and potential energy, and their sum.
    #[must_use]
    pub fn energies(self) -> Self {
        self.reading("kinetic energy", "J", |view| view.kinetic_energy())
            .reading("potential energy", "J", |view| view.potential_energy())
            .reading("energy", "J", |view| view.energy())
    }

    /// Changes what is drawn, as of a film: its title, traces, meshes. It is called for every film
    /// that is made, also in the page.
    #[must_use]
    pub fn film(mut self, change: impl Fn(Film<M>) -> Film<M> + 'static) -> Self {
        self.film = Box::new(change);
        self
    }

    /// How long the film is (s) that the page shows until its module runs, and where there is no
    /// WebAssembly; 4 s where nothing is said. The first view fits what it shows.
    #[must_use]
    pub fn preview(mut self, duration: f64) -> Self {
        self.preview = duration;
        self
    }

    /// Changes the last slider.
    fn last(mut self, change: impl FnOnce(&mut Slider<M>)) -> Self {
        match self.sliders.last_mut() {
            Some(slider) => change(slider),
            None => self.refuse(LiveError::NoSlider),
        }
        self
    }

    fn refuse(&mut self, error: LiveError) {
        self.fault.get_or_insert(error);
    }

    /// What the page runs, at its start.
    ///
    /// # Errors
    /// A setting or a start that is refused.
    pub fn session(self) -> Result<Session<M, P, K>, LiveError>
    where
        P: Solvable<Forces: Clone>,
        K: Steps<P> + Copy,
    {
        Session::new(self)
    }
}
