//! The map of `study extremes`: motions with closed forms, and the axes along which they are swept.

pub mod case;
#[cfg(feature = "large")]
pub mod others;
pub mod rod;

use holonom::{AugmentedLagrangian, Baumgarte, Penalty};
use holonom_study::chapter15::Method;
use holonom_study::compare::{Coordinates, Precision};
use holonom_study::extremes::{Axis, Cell, Motion};
use holonom_study::trade::{
    Choice, Family, Formulated, IntegratorSetting, Posed, PostStabilisation, Setting, Subject,
};

use case::{Case, ClosedForm};
use rod::Rod;

/// The step of Runge-Kutta for a motion, where the axis is not the step: a two-hundredth of its
/// period.
const STEPS: f64 = 200.0;
/// The tolerance of Dormand-Prince, where the axis is not the tolerance: the default.
const TOLERANCE: f64 = 1e-6;

/// All parameters of the map are positive and finite.
const ACCEPTABLE: &str = "positive and finite";

const BOTH: [Precision; 2] = [Precision::Double, Precision::Single];

/// A description with a formulation and a stabilisation.
type Way = (Coordinates, Choice, PostStabilisation);

/// Where the coefficients of formulations come from, on all axes but those of coefficients.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coefficients {
    /// From each mechanism, and the step where it is fixed.
    #[default]
    Derived,
    /// From chapter 15, for all mechanisms the same.
    OfTheBook,
}

impl Coefficients {
    fn of(self, method: Method) -> Choice {
        match self {
            Self::Derived => Choice::Derived(method),
            Self::OfTheBook => Choice::Given(Formulated::default_of(method)),
        }
    }

    /// By bodies in all formulations, by joints in one, as they are for a tree.
    fn ways_of_tree(self) -> Vec<Way> {
        let by_bodies = Method::ALL.map(|method| {
            let formulation = self.of(method);
            (Coordinates::Bodies, formulation, PostStabilisation::None)
        });
        let mut ways = Vec::from(by_bodies);
        let formulation = Choice::Given(Formulated::Standard);
        ways.push((Coordinates::Joints, formulation, PostStabilisation::None));
        ways
    }

    /// By bodies and by joints in all formulations, as they are where equations remain.
    fn ways_of_loop(self, stabilisations: &[PostStabilisation]) -> Vec<Way> {
        let mut ways = Vec::new();
        for by in [Coordinates::Bodies, Coordinates::Joints] {
            for method in Method::ALL {
                for &stabilisation in stabilisations {
                    ways.push((by, self.of(method), stabilisation));
                }
            }
        }
        ways
    }
}

/// The axes and cells under construction.
#[derive(Default)]
struct Map {
    coefficients: Coefficients,
    axes: Vec<Axis>,
    cells: Vec<Cell>,
}

/// Where on an axis, and what is known of the motion there.
#[derive(Clone, Copy)]
struct Place {
    value: f64,
    motion: Motion,
    scale: f64,
}

impl Map {
    fn axis(&mut self, name: &'static str, unit: &'static str, title: &str) {
        self.axes.push(Axis {
            name,
            title: title.into(),
            unit,
        });
    }

    /// Every way with these integrators and both number types.
    fn add<M>(
        &mut self,
        place: Place,
        case: Case<M>,
        ways: &[Way],
        integrations: &[IntegratorSetting],
    ) where
        M: ClosedForm + Copy + Send + Sync + 'static,
    {
        for scalar in BOTH {
            self.add_one(place, case, ways, integrations, scalar);
        }
    }

    /// The same with one number type.
    fn add_one<M>(
        &mut self,
        place: Place,
        case: Case<M>,
        ways: &[Way],
        integrations: &[IntegratorSetting],
        scalar: Precision,
    ) where
        M: ClosedForm + Copy + Send + Sync + 'static,
    {
        let model = std::any::type_name::<M>()
            .rsplit("::")
            .next()
            .unwrap_or_default();
        let made = settings(&Posed::in_both(case), ways, integrations, scalar);
        self.add_subject(place, model, made, move || Box::new(Posed::in_both(case)));
    }

    fn add_subject<B>(
        &mut self,
        Place {
            value,
            motion,
            scale,
        }: Place,
        model: &'static str,
        settings: impl IntoIterator<Item = Setting>,
        subject: B,
    ) where
        B: Fn() -> Box<dyn Subject> + Send + Sync + Clone + 'static,
    {
        for setting in settings {
            self.cells.push(Cell {
                axis: self.axes.len() - 1,
                model,
                value,
                setting,
                motion,
                scale,
                subject: Box::new(subject.clone()),
            });
        }
    }
}

/// Every way with these integrators. Where no coefficients follow from a mechanism, they are those
/// of the book, with which it is refused as well.
fn settings(
    subject: &dyn Subject,
    ways: &[Way],
    integrations: &[IntegratorSetting],
    scalar: Precision,
) -> Vec<Setting> {
    let mut settings = Vec::new();
    for &(coordinates, choice, stabilisation) in ways {
        for &integration in integrations {
            let (formulation, is_derived, _) = choice.made(subject, scalar, integration);
            if !integration.family.moves(coordinates, formulation.method()) {
                continue;
            }
            settings.push(Setting {
                coordinates,
                formulation,
                is_derived,
                stabilisation,
                integration,
                scalar,
            });
        }
    }
    settings
}

const fn with(family: Family, step_or_tolerance: f64) -> IntegratorSetting {
    IntegratorSetting {
        family,
        step_or_tolerance,
    }
}

const fn rk4(step: f64) -> IntegratorSetting {
    with(Family::Rk4, step)
}

const fn dormand_prince(tolerance: f64) -> IntegratorSetting {
    with(Family::DormandPrince, tolerance)
}

/// Both, at what they are by default for a motion of this period.
fn usual(period: f64) -> [IntegratorSetting; 2] {
    [rk4(period / STEPS), dormand_prince(TOLERANCE)]
}

/// `10^from` to `10^to`.
fn decades(from: i32, to: i32) -> impl Iterator<Item = f64> {
    (from..=to).map(|exponent| {
        if exponent < 0 {
            1.0 / 10.0_f64.powi(-exponent)
        } else {
            10.0_f64.powi(exponent)
        }
    })
}

/// The rod, and what is known of its motion.
fn swing(length: f64, mass: f64, place: f64, periods: f64) -> (Case<Rod>, Motion) {
    let rod = Rod::new(length, mass, place).expect(ACCEPTABLE);
    let period = rod.period();
    let end = periods * period;
    let case = Case {
        mechanism: rod,
        end,
        period,
        displaced: 0.0,
    };
    let motion = Motion {
        frequency: std::f64::consts::TAU / period,
        duration: end,
        reach: (1.0 + place / length).max(1.0),
        size: length.min(1.0),
        mass,
        violation: 0.0,
    };
    (case, motion)
}

/// All cells of the map, with their axes; without the feature `large` those of a rod and of a
/// four-bar.
#[must_use]
pub fn map(coefficients: Coefficients) -> (Vec<Axis>, Vec<Cell>) {
    let mut map = Map {
        coefficients,
        ..Map::default()
    };
    rods(&mut map);
    factors(&mut map);
    loops(&mut map);
    #[cfg(feature = "large")]
    others::sweep(&mut map);
    (map.axes, map.cells)
}

/// What is swept of a rod on a hinge.
fn rods(map: &mut Map) {
    let tree = map.coefficients.ways_of_tree();
    map.axis("step", "s", "The step, of a rod of 1 m that swings for two seconds, and the tolerance that stands for it");
    let thrice = [3e-6, 3e-5, 3e-4, 3e-3, 3e-2, 3e-1];
    for step in decades(-6, 0)
        .zip(thrice.into_iter().map(Some).chain([None]))
        .flat_map(|(step, more)| [Some(step), more])
        .flatten()
    {
        let (case, motion) = swing(1.0, 1.0, 0.0, 1.0);
        let place = Place {
            value: step,
            motion,
            scale: 1.0,
        };
        // What takes a million steps is done by one of them.
        let few = step < 1e-5;
        let families = Family::ALL
            .into_iter()
            .filter(|&family| !family.is_adaptive() && (!few || family == Family::Rk4));
        let integrations: Vec<_> = families.map(|family| with(family, step)).collect();
        map.add(place, case, &tree, &integrations);
    }
    map.axis(
        "tolerance",
        "1",
        "The relative tolerance, of a rod of 1 m that swings once",
    );
    for tolerance in decades(-14, -1) {
        let (case, motion) = swing(1.0, 1.0, 0.0, 1.0);
        let place = Place {
            value: tolerance,
            motion,
            scale: 1.0,
        };
        let families = Family::ALL
            .into_iter()
            .filter(|family| family.is_adaptive());
        let integrations: Vec<_> = families.map(|family| with(family, tolerance)).collect();
        map.add(place, case, &tree, &integrations);
    }
    map.axis(
        "size",
        "m",
        "The length of a rod of 1 kg, which swings twice",
    );
    for length in decades(-6, 3) {
        let (case, motion) = swing(length, 1.0, 0.0, 2.0);
        let place = Place {
            value: length,
            motion,
            scale: 1.0,
        };
        map.add(place, case, &tree, &usual(case.period));
    }
    map.axis("mass", "kg", "The mass of a rod of 1 m, which swings twice");
    for mass in decades(-6, 6) {
        let (case, motion) = swing(1.0, mass, 0.0, 2.0);
        let place = Place {
            value: mass,
            motion,
            scale: 1.0,
        };
        map.add(place, case, &tree, &usual(case.period));
    }
    map.axis("small and light", "m", "The length of a rod of its own density: a cubic metre weighs a tonne, a rod is a tenth as thick as long");
    for length in decades(-6, 3) {
        let (case, motion) = swing(length, 10.0 * length * length * length, 0.0, 2.0);
        let place = Place {
            value: length,
            motion,
            scale: 1.0,
        };
        map.add(place, case, &tree, &usual(case.period));
    }
    map.axis(
        "distance",
        "m",
        "The distance of a rod of 1 m from the origin along all axes, which swings twice",
    );
    for distance in decades(-1, 6) {
        let (case, motion) = swing(1.0, 1.0, distance, 2.0);
        let place = Place {
            value: distance,
            motion,
            scale: 1.0,
        };
        map.add(place, case, &tree, &usual(case.period));
    }
    map.axis("run", "s", "How long a rod of 1 m swings");
    for end in decades(0, 4) {
        let (case, motion) = swing(1.0, 1.0, 0.0, 1.0);
        let (case, motion) = (
            Case { end, ..case },
            Motion {
                duration: end,
                ..motion
            },
        );
        let place = Place {
            value: end,
            motion,
            scale: 1.0,
        };
        let ways: Vec<_> = tree
            .iter()
            .copied()
            .filter(|(_, choice, _)| end < 5e3 || choice.method() != Method::AugmentedLagrangian)
            .collect();
        map.add(place, case, &ways, &[rk4(0.01), dormand_prince(TOLERANCE)]);
    }
    map.axis(
        "start",
        "1",
        "How far from its hinge a rod of 1 m starts, over its length; it swings twice",
    );
    for violation in decades(-12, -1) {
        let (case, motion) = swing(1.0, 1.0, 0.0, 2.0);
        let case = Case {
            displaced: violation,
            ..case
        };
        let motion = Motion {
            violation,
            ..motion
        };
        let place = Place {
            value: violation,
            motion,
            scale: 1.0,
        };
        map.add(place, case, &tree, &usual(case.period));
    }
}

/// The coefficients of formulations.
fn factors(map: &mut Map) {
    let only = |formulation| {
        let given = Choice::Given(formulation);
        [(Coordinates::Bodies, given, PostStabilisation::None)]
    };
    map.axis("penalty", "kg", "The factor alpha of penalty and augmented Lagrangian, of a rod of 1 m and 1 kg that swings twice");
    for alpha in decades(0, 16) {
        let (case, motion) = swing(1.0, 1.0, 0.0, 2.0);
        let place = Place {
            value: alpha,
            motion,
            scale: 1.0,
        };
        let penalty = Penalty {
            alpha,
            ..Penalty::default()
        };
        let augmented = AugmentedLagrangian {
            alpha,
            ..AugmentedLagrangian::default()
        };
        for formulation in [
            Formulated::Penalty(penalty),
            Formulated::AugmentedLagrangian(augmented),
        ] {
            map.add(place, case, &only(formulation), &usual(case.period));
        }
    }
    map.axis("baumgarte", "1", "Baumgarte's alpha and beta, which are equal, times the step of Runge-Kutta; theory has it stable below 2.785");
    for part in [
        0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 1.5, 2.0, 2.5, 2.7, 2.8, 2.9, 3.0, 5.0, 10.0, 100.0,
    ] {
        let (case, motion) = swing(1.0, 1.0, 0.0, 2.0);
        let place = Place {
            value: part,
            motion,
            scale: 1.0,
        };
        for steps in [50.0, 500.0] {
            let step = case.period / steps;
            let terms = Baumgarte {
                alpha: part / step,
                beta: part / step,
            };
            map.add(
                place,
                case,
                &only(Formulated::Baumgarte(terms)),
                &[rk4(step)],
            );
        }
    }
}

/// A loop.
fn loops(map: &mut Map) {
    map.axis("singular", "1", "A parallelogram that passes through its singular configurations ten times in ten seconds, by the relative tolerance");
    for tolerance in decades(-12, -3) {
        let motion = Motion {
            frequency: 6.0,
            duration: 10.0,
            reach: 1.0,
            size: 1.0,
            mass: 3.0,
            violation: 0.0,
        };
        let place = Place {
            value: tolerance,
            motion,
            scale: 6.0,
        };
        let ways = map.coefficients.ways_of_loop(&PostStabilisation::ALL);
        let subject = || Posed::in_both(holonom_models::problems::Parallelogram::default());
        let made = BOTH
            .into_iter()
            .flat_map(|scalar| settings(&subject(), &ways, &[dormand_prince(tolerance)], scalar));
        map.add_subject(place, "FourBar", made, move || Box::new(subject()));
    }
}
