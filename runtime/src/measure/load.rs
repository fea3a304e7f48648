//! Forces that a user applies at run time.

use crate::error::Fault;
use crate::formulation::{Formulation, Solution};
use crate::math::quaternion::{normalised, rotate, rotate_back};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, read};
use crate::math::without_bounds::opaque;
use crate::measure::access::MechanismExt;
use crate::measure::view::View;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::handle::{BodyHandle, HasAngle, HasDisplacement, JointHandle};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::limits::{Nothing, Several};
use crate::nonsmooth::columns::Setting;
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::loads::Reactions;
use crate::nonsmooth::quantity::{JointQuantity, Quantity};
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::{Show, Tracked};
use crate::state::sealed::Sealed;
use crate::state::vector::{Array, StateParts};

/// Forces and moments beyond those of the description, as a function of time and state.
pub trait AppliedForces<S: Scalar, M: Mechanism>: Sealed {
    /// Whether there are any: `false` keeps the fused evaluation.
    const PRESENT: bool;

    /// Whether there are efforts that the equations of motion find.
    #[doc(hidden)]
    const INTERACTS: bool = false;

    /// Whether the limits of the description are heeded.
    #[doc(hidden)]
    const HEEDS: bool = true;

    /// Whether they are lent to a run, and not owned by a stepper.
    #[doc(hidden)]
    const OF_RUN: bool = false;

    /// Whether functions scale the capacities of interactions.
    #[doc(hidden)]
    const SCALES: bool = false;

    /// The interactions of a run with these forces.
    #[doc(hidden)]
    type Tracked: Several<Tracked<S, M>>;

    /// Those without the limits of the description.
    #[doc(hidden)]
    type Own: Several<Tracked<S, M>>;

    /// The interactions that these forces hold, with their statuses.
    #[doc(hidden)]
    type List: Several<Tracked<S, M>>;

    /// The same with other forces.
    #[doc(hidden)]
    type With<B: AppliedForces<S, M>>: AppliedForces<S, M>;

    /// Adds the forces at a time and a state.
    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>);

    /// The interactions of a run that begins, with these parameters.
    #[doc(hidden)]
    fn tracked(&self, parameters: &M::Parameters<S>) -> Self::Tracked
    where
        S: Real;

    /// Those without the limits of the description.
    #[doc(hidden)]
    fn own(&self, parameters: &M::Parameters<S>) -> Self::Own
    where
        S: Real;

    /// The same with other forces.
    #[doc(hidden)]
    fn with<B: AppliedForces<S, M>>(self, forces: B) -> Self::With<B>
    where
        Self: Sized;

    /// The interactions, with their statuses.
    #[doc(hidden)]
    fn interactions(&self) -> &[Tracked<S, M>] {
        &[]
    }

    /// The same, to be changed; `None` where there are none.
    #[doc(hidden)]
    fn list_mut(&mut self) -> Option<&mut Self::List> {
        None
    }

    /// Takes the limits of the description by other parameters.
    #[doc(hidden)]
    fn renew(&mut self, _parameters: &M::Parameters<S>)
    where
        S: Real,
    {
    }

    /// Takes other parameters and inputs, for functions that scale capacities.
    #[doc(hidden)]
    #[inline(always)]
    fn take_inputs(&mut self, _parameters: &M::Parameters<S>) {}

    /// Scales capacities, by these inputs.
    ///
    /// # Errors
    /// A factor that is not acceptable, a handle of another list.
    #[doc(hidden)]
    #[inline(always)]
    fn scale(
        &self,
        _view: &View<'_, S, M>,
        _inputs: &M::Inputs<S>,
        _list: &mut [Tracked<S, M>],
    ) -> Result<(), Fault>
    where
        S: Real,
    {
        Ok(())
    }

    /// Scales capacities, by the inputs that were taken last.
    ///
    /// # Errors
    /// As [`AppliedForces::scale`].
    #[doc(hidden)]
    #[inline(always)]
    fn scale_now(&self, _view: &View<'_, S, M>, _list: &mut [Tracked<S, M>]) -> Result<(), Fault>
    where
        S: Real,
    {
        Ok(())
    }

    /// Completes a solution by the efforts of the interactions in their modes, and shows these
    /// where that is wanted.
    ///
    /// # Errors
    /// A fault of a formulation that iterates, friction without a unique effort.
    #[doc(hidden)]
    #[inline(always)]
    fn complete<F: Formulation<S>, C: Coordinates<M>>(
        &self,
        _setting: &Setting<'_, S, M, F, C>,
        _reactions: Option<Reactions<'_, S, M, F>>,
        _solution: &mut Solution<S, M, C>,
        _show: Option<&mut Show<'_, S>>,
    ) -> Result<(), Fault>
    where
        S: Real,
    {
        Ok(())
    }
}

/// No forces beyond those of the description; costs nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoForces;

impl Sealed for NoForces {}
impl<A: Sealed> Sealed for &A {}
impl<A> Sealed for Led<A> {}
impl<G> Sealed for ForceLaw<G> {}

impl<S: Scalar, M: Mechanism> AppliedForces<S, M> for NoForces {
    const PRESENT: bool = false;

    type Tracked = M::PerLimit<Tracked<S, M>>;
    type Own = Nothing;
    type List = Nothing;
    type With<B: AppliedForces<S, M>> = B;

    #[inline(always)]
    fn apply(&self, _time: S, _state: &M::State<S>, _loads: &mut Loads<'_, S, M>) {}

    fn tracked(&self, parameters: &M::Parameters<S>) -> Self::Tracked
    where
        S: Real,
    {
        described::<S, M>(parameters)
    }

    fn own(&self, _parameters: &M::Parameters<S>) -> Nothing
    where
        S: Real,
    {
        Nothing
    }

    fn with<B: AppliedForces<S, M>>(self, forces: B) -> B {
        forces
    }
}

/// Those that another one holds, as forces of a run.
macro_rules! forces_of_a_run {
    ($held:ty, $this:ident => $forces:expr) => {
        impl<S: Scalar, M: Mechanism, A: AppliedForces<S, M>> AppliedForces<S, M> for $held {
            const PRESENT: bool = A::PRESENT;
            const INTERACTS: bool = A::INTERACTS;
            const HEEDS: bool = A::HEEDS;
            const OF_RUN: bool = true;
            const SCALES: bool = A::SCALES;

            type Tracked = A::Tracked;
            type Own = A::Own;
            type List = Nothing;
            type With<B: AppliedForces<S, M>> = B;

            #[inline(always)]
            fn apply(&$this, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
                A::apply($forces, time, state, loads);
            }

            fn tracked(&$this, parameters: &M::Parameters<S>) -> A::Tracked
            where
                S: Real,
            {
                A::tracked($forces, parameters)
            }

            fn own(&$this, parameters: &M::Parameters<S>) -> A::Own
            where
                S: Real,
            {
                A::own($forces, parameters)
            }

            fn with<B: AppliedForces<S, M>>($this, forces: B) -> B {
                forces
            }

            fn scale(
                &$this,
                view: &View<'_, S, M>,
                inputs: &M::Inputs<S>,
                list: &mut [Tracked<S, M>],
            ) -> Result<(), Fault>
            where
                S: Real,
            {
                A::scale($forces, view, inputs, list)
            }
        }
    };
}

/// Forces of a run that its caller leads ([`Simulation::begin`](crate::Simulation::begin)).
#[derive(Clone, Copy, Debug)]
pub struct Led<A>(pub(crate) A);

forces_of_a_run!(&A, self => self);
forces_of_a_run!(Led<A>, self => &self.0);

/// Forces from a closure `Fn(time, &state, &mut loads)`.
#[derive(Clone, Copy, Debug)]
pub struct ForceLaw<G>(pub G);

impl<S: Scalar, M: Mechanism, G> AppliedForces<S, M> for ForceLaw<G>
where
    G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
{
    const PRESENT: bool = true;

    type Tracked = M::PerLimit<Tracked<S, M>>;
    type Own = Nothing;
    type List = Nothing;
    type With<B: AppliedForces<S, M>> = B;

    #[inline]
    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
        (self.0)(time, state, loads);
    }

    fn tracked(&self, parameters: &M::Parameters<S>) -> Self::Tracked
    where
        S: Real,
    {
        described::<S, M>(parameters)
    }

    fn own(&self, _parameters: &M::Parameters<S>) -> Nothing
    where
        S: Real,
    {
        Nothing
    }

    fn with<B: AppliedForces<S, M>>(self, forces: B) -> B {
        forces
    }
}

/// The limits of the description.
fn described<S: Real, M: Mechanism>(parameters: &M::Parameters<S>) -> M::PerLimit<Tracked<S, M>> {
    M::limits_of(parameters, |limits| {
        Tracked::new(Interaction::of_description(limits))
    })
}

/// Where a user adds forces (N) and moments (N m) on bodies. Contributions add up.
pub struct Loads<'a, S: Scalar, M: Mechanism> {
    view: View<'a, S, M>,
    pub(super) forces: &'a mut M::Velocities<S>,
}

opaque!([S: Scalar, M: Mechanism] Loads<'_, S, M>, "Loads");

impl<'a, S: Scalar, M: Mechanism> Loads<'a, S, M> {
    /// Loads to be added to `g`, in a state whose Euler parameters are as the kernels read them.
    pub(crate) fn new(view: View<'a, S, M>, forces: &'a mut M::Velocities<S>) -> Self {
        Self { view, forces }
    }

    /// The state at hand, to be read by handle: `loads.view().angle_rate(hinge)`. It costs what is
    /// read.
    #[must_use]
    pub fn view(&self) -> View<'a, S, M> {
        self.view
    }

    /// A force (N, global) at the centre of mass.
    pub fn force(&mut self, body: BodyHandle<M>, force: [S; 3]) {
        if let Some(info) = body.info() {
            self.add(info.velocity, force);
        }
    }

    /// A force (N, global) at a point of the body, given from the centre of mass in the user's body
    /// axes (m).
    pub fn force_at(&mut self, body: BodyHandle<M>, point: [S; 3], force: [S; 3]) {
        self.force(body, force);
        let arm = rotate(&M::orientation(self.view.state(), body), &point);
        self.moment(body, cross(&arm, &force));
    }

    /// A moment (N m, global). Without effect on a particle.
    pub fn moment(&mut self, body: BodyHandle<M>, moment: [S; 3]) {
        if let Some((info, place)) = body.orientation() {
            let p = normalised(&read(self.view.state().coordinates().as_slice(), place));
            self.add(info.velocity + 3, rotate_back(&p, &moment));
        }
    }

    /// A moment (N m) in the user's body axes. Without effect on a particle.
    pub fn moment_in_body_axes(&mut self, body: BodyHandle<M>, moment: [S; 3]) {
        if let Some((info, _)) = body.orientation() {
            let axes = M::user_axes(body.index()).map(S::constant);
            self.add(info.velocity + 3, rotate(&axes, &moment));
        }
    }

    /// A moment (N m) about the axis of a joint, on its second body, and its opposite on the first.
    /// A positive moment drives the angle upwards: its power is the moment times
    /// [`View::angle_rate`].
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(coordinates = "joints")]
    /// # struct Arm {
    /// #     #[body(mass = 2.0, inertia = [0.1, 0.02, 0.1], position = [0.0, 0.5, 0.0])]
    /// #     upper: Body,
    /// #     #[body(mass = 1.0, inertia = [0.1, 0.02, 0.1], position = [0.0, 1.5, 0.0])]
    /// #     lower: Body,
    /// #     #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     shoulder: Revolute,
    /// #     #[joint(between = [upper, lower], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     elbow: Revolute,
    /// # }
    /// let (arm, handles) = (Arm::default(), Arm::HANDLES);
    /// Simulation::new(&arm, StandardLagrange, Rk4::every(0.001))
    ///     .forces(|_, _, loads| {
    ///         // A motor in the elbow: a spring to 1 rad, with damping.
    ///         let view = loads.view();
    ///         let (angle, rate) = (view.angle(handles.elbow), view.angle_rate(handles.elbow));
    ///         loads.moment_between(handles.elbow, 8.0 * (1.0 - angle) - 2.0 * rate);
    ///     })
    ///     .run(0.0_f64..=1.0, every(0.1), |sample| {
    ///         // It acts within the arm, whose spin about the shoulder stays what it was: none.
    ///         let [upper, lower] = [handles.upper, handles.lower].map(|body| {
    ///             let (arm, v) = (sample.pose(body).position, sample.velocity(body));
    ///             let mass = if body == handles.upper { 2.0 } else { 1.0 };
    ///             mass * arm.cross(&v).x + 0.1 * sample.angular_velocity(body).x
    ///         });
    ///         assert!((upper + lower).abs() < 1e-9);
    ///     })?;
    /// # Ok::<(), SimulationError<_>>(())
    /// ```
    pub fn moment_between<J: HasAngle>(&mut self, joint: JointHandle<M, J>, moment: S) {
        self.drive(joint.angle(), moment);
    }

    /// A force (N) along the displacement of a joint, on its second body, and its opposite on the
    /// first. A positive force drives the displacement upwards: its power is the force times
    /// [`View::displacement_rate`], as far as the displacement is not a function of time.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// /// A slide of 1 kg on a cart of 2 kg.
    /// #[derive(Mechanism)]
    /// struct Train {
    ///     #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
    ///     cart: Body,
    ///     #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.3, 0.0, 0.2])]
    ///     slide: Body,
    ///     #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     rail: Prismatic,
    ///     #[joint(between = [cart, slide], point = [0.0, 0.0, 0.2], axis = [1.0, 0.0, 0.0])]
    ///     guide: Prismatic,
    /// }
    ///
    /// let (train, handles) = (Train::default(), Train::HANDLES);
    /// Simulation::new(&train, StandardLagrange, Rk4::every(0.01))
    ///     .forces(|_, _, loads| loads.force_between(handles.guide, 6.0))
    ///     .run(0.0_f64..=0.1, every(0.1), |sample| -> Result<(), Fault> {
    ///         // 6 N on 1 kg, and as much backwards on 2 kg.
    ///         let acceleration = sample.displacement_acceleration(handles.guide)?;
    ///         assert!((acceleration - 9.0).abs() < 1e-12);
    ///         let backwards = sample.displacement_acceleration(handles.rail)?;
    ///         assert!((backwards + 3.0).abs() < 1e-12);
    ///         Ok(())
    ///     })?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn force_between<J: HasDisplacement>(&mut self, joint: JointHandle<M, J>, force: S) {
        self.drive(joint.displacement(), force);
    }

    /// An effort on a quantity of a joint, by its power.
    #[inline(never)]
    fn drive(&mut self, quantity: JointQuantity<M>, effort: S) {
        let scene = Scene::<S, M> {
            constants: self.view.constants(),
            time: self.view.time(),
            bodies: self.view.state(),
        };
        Quantity::Joint(quantity.reading).add_effort(&scene, effort, self.forces);
    }

    fn add<const N: usize>(&mut self, place: usize, value: [S; N]) {
        for (element, value) in self.forces.as_mut_slice().iter_mut().skip(place).zip(value) {
            *element = *element + value;
        }
    }
}
