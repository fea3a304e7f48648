//! The runs of `study show`: one for each problem, recorded into a film.

use std::error::Error;

#[cfg(feature = "large")]
use holonom::RadauIIA;
use holonom::Runs;
use holonom::dynamics::Problem;
use holonom::measure::NoForces;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom_film::Film;
#[cfg(feature = "large")]
use holonom_models::{
    Bricard, CartPole, Door, DoubleFourBar, FlyballGovernor, HeavyChain, HeavyTop, Panda,
    QuintupleFourBar, SimplePendulum, SliderCrank, SqueezingMechanism, Ur5, VariableLengthPendulum,
};
use holonom_models::{FourBar, RodPendulum};

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

/// All runs: two without the feature `large`, whose mechanisms compile quickly.
#[must_use]
pub fn scenes() -> Vec<Scene> {
    let mut scenes = vec![
        Scene {
            name: "four-bar",
            title: "Four-bar",
            seconds: 6.0,
            run: |scene, seconds| {
                let handles = FourBar::HANDLES;
                let mut film = scene.film();
                film.trace_point(handles.coupler, "middle of the coupler", [0.0; 3]);
                through_singular(&FourBar::default(), film, seconds, |film, sample| {
                    film.reading("left foot", "rad", sample.angle(handles.left_foot));
                })
            },
        },
        Scene {
            name: "pendulum",
            title: "Rod on a hinge",
            seconds: 10.0,
            run: |scene, seconds| {
                let handles = RodPendulum::HANDLES;
                let mut film = scene.film();
                film.trace_point(handles.rod, "centre of mass", [0.0; 3]);
                accurate(&RodPendulum::default(), film, seconds, |film, sample| {
                    film.reading("pivot", "rad", sample.angle(handles.pivot));
                })
            },
        },
    ];
    scenes.extend(large());
    scenes
}

#[cfg(not(feature = "large"))]
fn large() -> [Scene; 0] {
    []
}

#[cfg(feature = "large")]
fn large() -> [Scene; 14] {
    [
        Scene {
            name: "double-four-bar",
            title: "Two four-bars in a row",
            seconds: 6.0,
            run: |scene, seconds| {
                through_singular(&DoubleFourBar::default(), scene.film(), seconds, |_, _| ())
            },
        },
        Scene {
            name: "quintuple-four-bar",
            title: "Five four-bars in a row",
            seconds: 6.0,
            run: |scene, seconds| {
                through_singular(
                    &QuintupleFourBar::default(),
                    scene.film(),
                    seconds,
                    |_, _| (),
                )
            },
        },
        Scene {
            name: "long-pendulum",
            title: "Simple pendulum",
            seconds: 10.0,
            run: |scene, seconds| {
                accurate(&SimplePendulum::default(), scene.film(), seconds, |_, _| ())
            },
        },
        Scene {
            name: "squeezer",
            title: "Andrews' squeezing mechanism",
            seconds: 0.03,
            run: |scene, seconds| {
                let handles = SqueezingMechanism::HANDLES;
                let mechanism = SqueezingMechanism::default();
                accurate(&mechanism, scene.film(), seconds, |film, sample| {
                    film.reading("hinge b", "rad", sample.angle(handles.b));
                })
            },
        },
        Scene {
            name: "bricard",
            title: "Bricard's mechanism",
            seconds: 10.0,
            run: |scene, seconds| {
                let handles = Bricard::HANDLES;
                let mut film = scene.film();
                film.trace_point(handles.second, "a corner", Bricard::P3);
                accurate(&Bricard::default(), film, seconds, |_, _| ())
            },
        },
        Scene {
            name: "governor",
            title: "Flyball governor",
            seconds: 10.0,
            run: |scene, seconds| {
                let handles = FlyballGovernor::HANDLES;
                stiff(
                    &FlyballGovernor::default(),
                    scene.film(),
                    seconds,
                    |film, sample| {
                        film.reading(
                            "height of the slider",
                            "m",
                            sample.pose(handles.slider).position.z,
                        );
                    },
                )
            },
        },
        Scene {
            name: "heavy-top",
            title: "Heavy top",
            seconds: 2.0,
            run: |scene, seconds| {
                let handles = HeavyTop::HANDLES;
                let mut film = scene.film();
                film.trace_point(handles.top, "centre of mass", [0.0; 3]);
                accurate(&HeavyTop::default(), film, seconds, |_, _| ())
            },
        },
        Scene {
            name: "variable-length",
            title: "Pendulum of variable length",
            seconds: 5.0,
            run: |scene, seconds| {
                let handles = VariableLengthPendulum::HANDLES;
                let mut film = scene.film();
                film.trace(handles.slider);
                let mechanism = VariableLengthPendulum::default();
                accurate(&mechanism, film, seconds, |film, sample| {
                    film.reading("pin", "rad", sample.angle(handles.pin));
                })
            },
        },
        Scene {
            name: "slider-crank",
            title: "Slider-crank",
            seconds: 0.2,
            run: |scene, seconds| {
                let handles = SliderCrank::HANDLES;
                let mut film = scene.film();
                film.trace_point(handles.rod, "middle of the rod", [0.0; 3]);
                accurate(&SliderCrank::default(), film, seconds, |film, sample| {
                    film.reading("slider", "m", sample.displacement(handles.guide));
                })
            },
        },
        Scene {
            name: "heavy-chain",
            title: "A bob of 1000 kg on a chain of grams",
            seconds: 1.0,
            run: |scene, seconds| {
                accurate(&HeavyChain::default(), scene.film(), seconds, |_, _| ())
            },
        },
        Scene {
            name: "door",
            title: "Door on two hinges",
            seconds: 10.0,
            run: |scene, seconds| {
                let handles = Door::HANDLES;
                accurate(&Door::default(), scene.film(), seconds, |film, sample| {
                    film.reading("lower hinge", "rad", sample.angle(handles.lower_hinge));
                })
            },
        },
        Scene {
            name: "cart-pole",
            title: "Cart and pole",
            seconds: 5.0,
            run: |scene, seconds| {
                let handles = CartPole::HANDLES;
                accurate(
                    &CartPole::default(),
                    scene.film(),
                    seconds,
                    |film, sample| {
                        film.reading("hinge", "rad", sample.angle(handles.hinge));
                    },
                )
            },
        },
        Scene {
            name: "ur5",
            title: "UR5 without motors",
            seconds: 2.0,
            run: |scene, seconds| {
                let handles = Ur5::HANDLES;
                let mut film = scene.film();
                film.trace_point(handles.third_wrist, "third wrist", [0.0; 3]);
                accurate(&Ur5::default(), film, seconds, |film, sample| {
                    let height = sample.pose(handles.third_wrist).position.z;
                    film.reading("height of the wrist", "m", height);
                })
            },
        },
        Scene {
            name: "panda",
            title: "Panda without motors",
            seconds: 1.5,
            run: |scene, seconds| {
                let handles = Panda::HANDLES;
                let mut film = scene.film();
                film.trace(handles.hand);
                accurate(&Panda::default(), film, seconds, |film, sample| {
                    let height = sample.pose(handles.hand).position.z;
                    film.reading("height of the hand", "m", height);
                })
            },
        },
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

impl Scene {
    fn film<M: Mechanism>(&self) -> Film<M> {
        Film::new().titled(self.title).with_reactions()
    }
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
    DormandPrince<f64>: Runs<f64, M, StandardLagrange, Relative>,
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
    RadauIIA<f64>: Runs<f64, M, StandardLagrange, Relative>,
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
    DormandPrince<f64>: Runs<f64, M, Penalty<f64>, Absolute>,
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
    simulation: &Simulation<'_, Problem<f64, M, F, NoForces, C>, I>,
    mut film: Film<M>,
    seconds: f64,
    read: impl Fn(&mut Film<M>, &Sample<'_, f64, M>),
) -> Outcome
where
    M: Mechanism,
    F: Formulation<f64>,
    C: Coordinates<M>,
    I: Runs<f64, M, F, C>,
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
