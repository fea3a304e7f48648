//! The runs of `study show`: one for each problem, recorded into a film.

pub mod mechanisms;

use std::error::Error;

#[cfg(feature = "large")]
use holonom::RadauIIA;
use holonom::Runs;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom_film::Film;
#[cfg(feature = "large")]
use holonom_models::{
    Bricard, CartPole, Door, DoubleFourBar, FlyballGovernor, HeavyChain, HeavyTop, Panda,
    QuintupleFourBar, SimplePendulum, SqueezingMechanism, Ur5, VariableLengthPendulum,
};
use holonom_models::{FourBar, RodPendulum, SliderCrank};

use self::mechanisms::{Arm, Axle, CrankRocker, Digger, GearTrain};

/// The tolerance of all runs, relative to the scales of the mechanism.
const TOLERANCE: f64 = 1e-8;
/// Frames of a film, at least: a second of the screen has sixty, and nothing is over sooner than
/// six seconds.
const FRAMES: f64 = 360.0;

/// A run that can be shown.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Its name, that of the problem and of the file.
    pub name: &'static str,
    /// The title of the film.
    pub title: &'static str,
    /// How long it lasts (s) unless another time is asked for.
    pub seconds: f64,
    run: fn(&Self, f64) -> Outcome,
}

/// A film and what is said about it.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// The page.
    pub html: String,
    /// The formulation and the integrator, and why they are taken.
    pub method: &'static str,
    /// The number of frames.
    pub frames: usize,
    /// "no warnings", or those of the run, a line each.
    pub warnings: String,
}

/// A film, or what stopped the run.
type Outcome = Result<Recorded, Box<dyn Error>>;

impl Scene {
    /// Runs the problem for so many seconds.
    ///
    /// # Errors
    /// What stops the run.
    pub fn record(&self, seconds: f64) -> Result<Recorded, Box<dyn Error>> {
        (self.run)(self, seconds)
    }
}

/// A run: the problem, how it is run, what of it is traced and what is read of every sample.
macro_rules! scene {
    (
        $name:literal, $title:literal, $seconds:literal s, $model:ident $how:ident
        $(, trace $body:ident $($label:literal $point:expr)?)?
        $(, $reading:literal ($unit:literal) of |$sample:ident, $handles:ident| $value:expr)?
    ) => {
        Scene {
            name: $name,
            title: $title,
            seconds: $seconds,
            run: |scene, seconds| {
                let film = Film::new().titled(scene.title).with_reactions();
                $(let film = traced(film, scene!(@trace $model $body $($label $point)?));)?
                $how(&$model::default(), film, seconds, |_film, _sample| {
                    $(
                        let ($sample, $handles) = (_sample, $model::HANDLES);
                        _film.reading($reading, $unit, $value);
                    )?
                })
            },
        }
    };
    (@trace $model:ident $body:ident) => {
        |film| {
            film.trace($model::HANDLES.$body);
        }
    };
    (@trace $model:ident $body:ident $label:literal $point:expr) => {
        |film| {
            film.trace_point($model::HANDLES.$body, $label, $point);
        }
    };
}

/// The film with a trace.
fn traced<M: Mechanism>(mut film: Film<M>, trace: impl FnOnce(&mut Film<M>)) -> Film<M> {
    trace(&mut film);
    film
}

/// The runs that are shown where none is named: a mechanism of each kind.
#[must_use]
pub fn first() -> [Scene; 6] {
    [
        scene!("arm", "An arm of three axes", 8.0 s, Arm accurate,
            trace tip,
            "elbow" ("rad") of |sample, h| sample.angle(h.elbow)),
        scene!("slider-crank", "Slider-crank", 0.2 s, SliderCrank accurate,
            trace rod "middle of the rod" [0.0; 3],
            "slider" ("m") of |sample, h| sample.displacement(h.guide)),
        scene!("gear-train", "A train of three wheels", 6.0 s, GearTrain accurate,
            "output" ("rad") of |sample, h| sample.angle(h.output)),
        scene!("axle", "A rigid axle after a bump", 3.0 s, Axle accurate,
            trace left "left hub" [0.0; 3],
            "height of the left hub" ("m") of |sample, h| sample.pose(h.left).position.z),
        scene!("digger", "Digger", 8.0 s, Digger accurate,
            trace teeth,
            "height of the teeth" ("m") of |sample, h| sample.position(h.teeth).z),
        scene!("crank-rocker", "Crank and rocker", 6.0 s, CrankRocker accurate,
            trace coupler "middle of the coupler" [0.0; 3],
            "rocker" ("rad") of |sample, h| sample.angle(h.rocker_foot)),
    ]
}

/// All runs: without the feature `large` those whose mechanisms compile quickly.
#[must_use]
pub fn scenes() -> Vec<Scene> {
    let mut scenes = first().to_vec();
    scenes.extend([
        scene!("four-bar", "Four-bar", 6.0 s, FourBar through_singular,
            trace coupler "middle of the coupler" [0.0; 3],
            "left foot" ("rad") of |sample, h| sample.angle(h.left_foot)),
        scene!("pendulum", "Rod on a hinge", 10.0 s, RodPendulum accurate,
            trace rod "centre of mass" [0.0; 3],
            "pivot" ("rad") of |sample, h| sample.angle(h.pivot)),
    ]);
    scenes.extend(large());
    scenes
}

#[cfg(not(feature = "large"))]
fn large() -> [Scene; 0] {
    []
}

#[cfg(feature = "large")]
fn large() -> [Scene; 13] {
    [
        scene!("double-four-bar", "Two four-bars in a row", 6.0 s, DoubleFourBar through_singular),
        scene!("quintuple-four-bar", "Five four-bars in a row", 6.0 s,
            QuintupleFourBar through_singular),
        scene!("long-pendulum", "Simple pendulum", 10.0 s, SimplePendulum accurate),
        scene!("squeezer", "Andrews' squeezing mechanism", 0.03 s, SqueezingMechanism accurate,
            "hinge b" ("rad") of |sample, h| sample.angle(h.b)),
        scene!("bricard", "Bricard's mechanism", 10.0 s, Bricard accurate,
            trace second "a corner" Bricard::P3),
        scene!("governor", "Flyball governor", 10.0 s, FlyballGovernor stiff,
            "height of the slider" ("m") of |sample, h| sample.pose(h.slider).position.z),
        scene!("heavy-top", "Heavy top", 2.0 s, HeavyTop accurate,
            trace top "centre of mass" [0.0; 3]),
        scene!("variable-length", "Pendulum of variable length", 5.0 s,
            VariableLengthPendulum accurate,
            trace slider,
            "pin" ("rad") of |sample, h| sample.angle(h.pin)),
        scene!("heavy-chain", "A bob of 1000 kg on a chain of grams", 1.0 s, HeavyChain accurate),
        scene!("door", "Door on two hinges", 10.0 s, Door accurate,
            "lower hinge" ("rad") of |sample, h| sample.angle(h.lower_hinge)),
        scene!("cart-pole", "Cart and pole", 5.0 s, CartPole accurate,
            "hinge" ("rad") of |sample, h| sample.angle(h.hinge)),
        scene!("ur5", "UR5 without motors", 2.0 s, Ur5 accurate,
            trace third_wrist "third wrist" [0.0; 3],
            "height of the wrist" ("m") of |sample, h| sample.pose(h.third_wrist).position.z),
        scene!("panda", "Panda without motors", 1.5 s, Panda accurate,
            trace hand,
            "height of the hand" ("m") of |sample, h| sample.pose(h.hand).position.z),
    ]
}

/// The run of a name.
///
/// # Errors
/// The names that there are.
pub fn scene(name: &str) -> Result<Scene, String> {
    let scenes = scenes();
    let found = scenes.iter().find(|scene| scene.name == name);
    found.copied().ok_or_else(|| {
        let names: Vec<_> = scenes.iter().map(|scene| scene.name).collect();
        let more = if cfg!(feature = "large") {
            ""
        } else {
            "; more with --large"
        };
        format!(
            "there is no problem `{name}` here; there are {}{more}",
            names.join(", ")
        )
    })
}

/// For mechanisms whose equations are independent.
fn accurate<M>(
    mechanism: &M,
    film: Film<M>,
    seconds: f64,
    read: impl Fn(&mut Film<M>, &Sample<'_, f64, M>),
) -> Outcome
where
    M: JointCoordinates,
    DormandPrince<f64>: Runs<Problem<M, StandardLagrange, f64, Relative>>,
{
    let method = "standard Lagrange multipliers in joint coordinates, projected; \
         Dormand-Prince 5(4), tolerance 1e-8";
    let integrator = DormandPrince::new(Tolerance::of(mechanism, TOLERANCE)?);
    let simulation = Simulation::new(mechanism, StandardLagrange, integrator).joint_coordinates();
    let simulation = simulation.projection(Projection::default());
    recorded(method, &simulation, film, seconds, read)
}

/// For stiff mechanisms.
#[cfg(feature = "large")]
fn stiff<M>(
    mechanism: &M,
    film: Film<M>,
    seconds: f64,
    read: impl Fn(&mut Film<M>, &Sample<'_, f64, M>),
) -> Outcome
where
    M: JointCoordinates,
    RadauIIA<f64>: Runs<Problem<M, StandardLagrange, f64, Relative>>,
{
    let method = "standard Lagrange multipliers in joint coordinates; \
         Radau IIA of order 5, because the springs are stiff, tolerance 1e-8";
    let integrator = RadauIIA::new(Tolerance::of(mechanism, TOLERANCE)?);
    let simulation = Simulation::new(mechanism, StandardLagrange, integrator).joint_coordinates();
    recorded(method, &simulation, film, seconds, read)
}

/// For mechanisms that pass singular configurations.
fn through_singular<M>(
    mechanism: &M,
    film: Film<M>,
    seconds: f64,
    read: impl Fn(&mut Film<M>, &Sample<'_, f64, M>),
) -> Outcome
where
    M: Mechanism,
    DormandPrince<f64>: Runs<Problem<M, Penalty<f64>, f64, Absolute>>,
{
    let method = "penalty in absolute coordinates, projected, because the mechanism passes \
         singular configurations; Dormand-Prince 5(4), tolerance 1e-8";
    let integrator = DormandPrince::new(Tolerance::of(mechanism, TOLERANCE)?);
    let formulation = Penalty::of(mechanism)?;
    let simulation = Simulation::new(mechanism, formulation, integrator).absolute_coordinates();
    let simulation = simulation.projection(Projection::default());
    recorded(method, &simulation, film, seconds, read)
}

fn recorded<M, F, I, C>(
    method: &'static str,
    simulation: &Simulation<'_, Problem<M, F, f64, C>, I>,
    mut film: Film<M>,
    seconds: f64,
    read: impl Fn(&mut Film<M>, &Sample<'_, f64, M>),
) -> Outcome
where
    M: Mechanism,
    F: Formulation<f64>,
    C: Coordinates<M>,
    I: Runs<Problem<M, F, f64, C>>,
{
    let frames = FRAMES.max((60.0 * seconds).min(5.0 * FRAMES));
    let report = simulation.run(0.0..=seconds, every(seconds / frames), |sample| {
        film.record(sample);
        read(&mut film, sample);
        film.reading("kinetic energy", "J", sample.kinetic_energy());
        film.reading("potential energy", "J", sample.potential_energy());
    });
    // A stopped run says at which state, of a type of the mechanism's own.
    let report = report.map_err(|error| error.to_string())?;
    let warnings = report.warnings();
    film.warnings(&warnings);
    Ok(Recorded {
        html: film.html()?,
        method,
        frames: film.frames(),
        warnings: warnings.to_string(),
    })
}
