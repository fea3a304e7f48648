//! Planar loops of hinges on carriers that turn in space, with redundant equations left out: all
//! along their motion they move like the same loops whose closing joints have no equation too many.

use holonom_engine::coordinates::candidates::Strategy;
use holonom_engine::model::Rank;
use holonom_engine::plan::system::Terms;

use crate::comparison::{Comparison, Extent, difference};
use crate::dense::Factors;
use crate::inputs::Coefficients;
use crate::reading::{Described, Numbers};
use crate::reference::{Equations, State};
use crate::solutions::System;
use crate::text::Text;
use crate::writing::Dice;

/// Of accelerations, over the largest.
const TOLERANCE: f64 = 1e-9;
/// Configurations that are led to, in steps of `STEP` rad.
const STOPS: usize = 24;
const STEP: f64 = 0.3;
/// Of a system that is far from a singular configuration.
const REGULAR: f64 = 1e4;

/// What is written of a mechanism, twice: with hinges, and with what has no redundant equation.
struct Loop {
    dice: Dice,
    bodies: String,
    joints: [String; 2],
    /// From the plane of the loop to global axes, column by column.
    axes: [Numbers; 3],
    origin: Numbers,
}

impl Loop {
    /// A point of the plane and beside it.
    fn at(&self, [x, y, z]: Numbers) -> Numbers {
        let [a, b, c] = self.axes;
        [0, 1, 2].map(|k| self.origin[k] + x * a[k] + y * b[k] + z * c[k])
    }

    fn body(&mut self, name: &str, at: Numbers) {
        self.body_at(name, self.at(at));
    }

    fn body_at(&mut self, name: &str, position: Numbers) {
        let p: [f64; 4] = self.dice.unit();
        let [a, b, c] = self.dice.vector(0.1);
        let mass = 1.0 + 0.5 * self.dice.number();
        self.bodies += &format!(
            "#[body(free, mass = {mass:?}, inertia = [{:?}, {:?}, {:?}], position = {position:?}, orientation = {p:?})] {name}: Body,\n",
            0.4 + a,
            0.5 + b,
            0.45 + c
        );
    }

    fn both(&mut self, joint: &str) {
        self.joints.iter_mut().for_each(|text| *text += joint);
    }

    fn written(
        &self,
        name: &str,
        [i, j]: [&str; 2],
        at: Numbers,
        axis: Option<Numbers>,
        kind: &str,
    ) -> String {
        let axis = axis.map_or(String::new(), |axis| format!(", axis = {axis:?}"));
        format!("#[joint(between = [{i}, {j}], point = {at:?}{axis})] {name}: {kind},\n")
    }

    /// A hinge of the loop, and what has its place in the other text.
    fn hinge(&mut self, name: &str, between: [&str; 2], [x, y]: [f64; 2], other: &str) {
        let beside = 0.1 * self.dice.number();
        let at = self.at([x, y, beside]);
        let axis = Some(self.axes[2]);
        let text = self.written(name, between, at, axis, "Revolute");
        self.joints[0] += &text;
        let axis = axis.filter(|_| other != "Spherical");
        let text = self.written(name, between, at, axis, other);
        self.joints[1] += &text;
    }

    fn slide(&mut self, name: &str, between: [&str; 2], [x, y]: [f64; 2], [a, b]: [f64; 2]) {
        let at = self.at([x, y, 0.05]);
        let axis = [0, 1, 2].map(|k| a * self.axes[0][k] + b * self.axes[1][k]);
        let text = self.written(name, between, at, Some(axis), "Prismatic");
        self.both(&text);
    }

    /// The base and what carries it; by the seed.
    fn carrier(&mut self, which: usize) {
        let base = self.at([0.3, 0.1, 0.2]);
        self.body_at("base", base);
        let axis: Numbers = self.dice.unit();
        let point = [0, 1, 2].map(|k| base[k] + 0.3 * axis[(k + 1) % 3]);
        match which % 6 {
            0 => {}
            1 => {
                let text = self.written("mount", ["ground", "base"], point, None, "Spherical");
                self.both(&text);
            }
            2 => {
                // The plane stands on the axis of the slewing gear.
                let axis = self.axes[1];
                let text = self.written("slew", ["ground", "base"], point, Some(axis), "Revolute");
                self.both(&text);
            }
            3 => {
                let text = self.written("swing", ["ground", "base"], point, Some(axis), "Revolute");
                self.both(&text);
            }
            4 => {
                let thigh = [0, 1, 2].map(|k| point[k] + 0.2);
                self.body_at("thigh", thigh);
                let other: Numbers = self.dice.unit();
                let text = self.written("hip", ["ground", "thigh"], thigh, Some(other), "Revolute")
                    + &self.written("knee", ["thigh", "base"], point, Some(axis), "Revolute");
                self.both(&text);
            }
            _ => {
                // The coupler of a four-bar of hinges in another plane.
                let [normal, along, _] = self.axes;
                let up = self.axes[2];
                let place = |x: f64, y: f64| [0, 1, 2].map(|k| base[k] + x * along[k] + y * up[k]);
                self.body_at("left", place(-0.6, -0.5));
                self.body_at("right", place(0.5, -0.55));
                let hinges = [
                    ("foot", ["ground", "left"], place(-0.7, -1.0), "Revolute"),
                    ("head", ["left", "base"], place(-0.5, 0.1), "Revolute"),
                    ("neck", ["base", "right"], place(0.4, -0.1), "Spherical"),
                    ("heel", ["right", "ground"], place(0.6, -1.1), "Cylindrical"),
                ];
                for (name, between, at, other) in hinges {
                    let text = self.written(name, between, at, Some(normal), "Revolute");
                    self.joints[0] += &text;
                    let axis = Some(normal).filter(|_| other != "Spherical");
                    let text = self.written(name, between, at, axis, other);
                    self.joints[1] += &text;
                }
            }
        }
    }

    fn four_bar(&mut self) {
        let [a, b] = [0; 2].map(|_| 0.1 * self.dice.number());
        self.body("crank", [0.02, 0.15, 0.0]);
        self.body("rod", [0.3, 0.4 + a, 0.1]);
        self.body("rocker", [0.65, 0.2, -0.1]);
        self.hinge("a", ["base", "crank"], [0.0, 0.0], "Revolute");
        self.hinge("b", ["crank", "rod"], [0.05, 0.3 + b], "Revolute");
        self.hinge("c", ["rod", "rocker"], [0.7 + a, 0.5], "Spherical");
        self.hinge("d", ["rocker", "base"], [0.6, b], "Cylindrical");
    }

    fn slider_crank(&mut self) {
        let [a, b] = [0; 2].map(|_| 0.1 * self.dice.number());
        self.body("crank", [0.1, 0.1, 0.0]);
        self.body("rod", [0.4, 0.2, 0.1]);
        self.body("slider", [0.9, 0.1, 0.0]);
        self.hinge("a", ["base", "crank"], [0.0, 0.0], "Revolute");
        self.hinge("b", ["crank", "rod"], [0.2, 0.2 + a], "Spherical");
        self.hinge("c", ["slider", "rod"], [0.9, b], "Cylindrical");
        self.slide("d", ["base", "slider"], [0.9, 0.1], [1.0, a]);
    }

    fn five_bar(&mut self) {
        let [a, b] = [0; 2].map(|_| 0.1 * self.dice.number());
        for (name, at) in [
            ("p", [0.0, 0.2]),
            ("q", [0.2, 0.5]),
            ("r", [0.5, 0.5]),
            ("s", [0.7, 0.2]),
        ] {
            self.body(name, [at[0], at[1], a]);
        }
        self.hinge("a", ["base", "p"], [0.0, 0.0], "Revolute");
        self.hinge("b", ["p", "q"], [-0.1, 0.35 + a], "Revolute");
        self.hinge("c", ["q", "r"], [0.35, 0.7 + b], "Revolute");
        self.hinge("d", ["r", "s"], [0.8, 0.4], "Spherical");
        self.hinge("e", ["s", "base"], [0.65 + b, 0.0], "Cylindrical");
    }

    fn pantograph(&mut self) {
        let a = 0.05 * self.dice.number();
        for (name, at) in [
            ("p", [0.1, 0.3]),
            ("q", [0.4, 0.5]),
            ("r", [0.3, 0.2]),
            ("s", [0.5, 0.3]),
        ] {
            self.body(name, [at[0], at[1], a]);
        }
        // The parallelogram (0.1, 0.3), (0.2, 0.6), (0.6, 0.5), (0.5, 0.2) hangs on its first bar.
        self.hinge("hang", ["base", "p"], [0.0, 0.0], "Revolute");
        self.hinge("a", ["p", "q"], [0.2, 0.6], "Revolute");
        self.hinge("b", ["q", "s"], [0.6, 0.5], "Revolute");
        self.hinge("c", ["s", "r"], [0.5, 0.2], "Spherical");
        self.hinge("d", ["r", "p"], [0.1, 0.3], "Cylindrical");
    }

    fn scissors(&mut self) {
        let a = 0.05 * self.dice.number();
        for (name, at) in [
            ("p", [0.2, 0.2]),
            ("q", [0.3, 0.2]),
            ("r", [0.2, 0.6]),
            ("s", [0.3, 0.5]),
        ] {
            self.body(name, [at[0], at[1], a]);
        }
        self.body("shoe", [0.5, 0.0, 0.1]);
        self.hinge("a", ["base", "p"], [0.0, 0.0], "Revolute");
        self.slide("guide", ["base", "shoe"], [0.5, 0.0], [1.0, 0.0]);
        self.hinge("b", ["shoe", "q"], [0.5, 0.0], "PointOnLine");
        self.hinge("mid", ["p", "q"], [0.25, 0.2], "Revolute");
        self.hinge("c", ["p", "s"], [0.5, 0.4], "Revolute");
        self.hinge("d", ["q", "r"], [0.0, 0.4], "Revolute");
        self.hinge("top", ["r", "s"], [0.25, 0.6], "PointOnLine");
    }
}

/// A mechanism with redundant equations, and the same without.
fn pair(seed: u64) -> [Text; 2] {
    let mut dice = Dice::new(seed + 1);
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // Some planes are coordinate planes.
    if dice.below(3) == 0 {
        axes.rotate_left(dice.below(3));
    } else {
        let pose = crate::pose::Pose::still([0.0; 3], dice.unit());
        axes = axes.map(|axis| pose.global_of(axis));
    }
    let mut written = Loop {
        origin: dice.vector(1.0),
        dice,
        bodies: String::new(),
        joints: [String::new(), String::new()],
        axes,
    };
    written.carrier((seed / 5) as usize);
    match seed % 5 {
        0 => written.four_bar(),
        1 => written.slider_crank(),
        2 => written.five_bar(),
        3 => written.pantograph(),
        _ => written.scissors(),
    }
    let Loop { bodies, joints, .. } = written;
    let redundant = [", redundant = \"drop\"", ""];
    let texts = joints.into_iter().zip(redundant).map(|(joints, redundant)| Text {
        item: format!(
            "#[mechanism(gravity = [0.3, -9.7, 1.1]{redundant})] pub struct Carried {{\n{bodies}{joints}}}"
        ),
        definitions: Vec::new(),
    });
    let texts: Vec<Text> = texts.collect();
    texts
        .try_into()
        .unwrap_or_else(|_| unreachable!("two texts"))
}

/// A saddle system without forces.
fn projected(equations: &Equations, motion: &[f64]) -> Option<Vec<f64>> {
    let mut right: Vec<f64> = equations
        .mass
        .iter()
        .map(|row| row.iter().zip(motion).map(|(m, u)| m * u).sum())
        .collect();
    right.extend(equations.phi.iter().map(|_| 0.0));
    let mut solved = Factors::new(equations.saddle(0.0))?.solve(&right);
    solved.truncate(motion.len());
    Some(solved)
}

/// States along a motion straight on, at random velocities, of a mechanism without redundant
/// equations.
fn states(described: &Described, comparison: &Comparison<'_>, dice: &mut Dice) -> Vec<State> {
    let mut at = State::start(described, 0);
    let mut found = Vec::new();
    let velocities: usize = described.bodies.iter().map(|body| body.velocities()).sum();
    let mut heading: Vec<f64> = (0..velocities).map(|_| dice.number()).collect();
    for _ in 0..STOPS {
        let Some(equations) = Equations::new(described, &at) else {
            break;
        };
        let Some(free) = projected(&equations, &heading) else {
            break;
        };
        let most = free.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        if most < 1e-6 {
            break;
        }
        heading = free.iter().map(|x| x * STEP / most).collect();
        let next = at.moved(described, &heading);
        let Some(next) = next.and_then(|next| comparison.satisfying_position(&next)) else {
            break;
        };
        at = next;
        let Some(equations) = Equations::new(described, &at) else {
            break;
        };
        let random: Vec<f64> = (0..velocities).map(|_| 2.0 * dice.number()).collect();
        let Some(free) = projected(&equations, &random) else {
            break;
        };
        let mut state = at.clone();
        let mut place = 0;
        for (v, w) in &mut state.rates {
            *v = [0, 1, 2].map(|k| free[place + k]);
            *w = [3, 4, 5].map(|k| free[place + k]);
            place += 6;
        }
        found.push(state);
    }
    found
}

/// The accelerations of the bodies, and the condition of the system.
fn accelerations(equations: &Equations) -> Option<(Vec<f64>, f64)> {
    let system = System::new(equations, 0.0)?;
    let mut right = equations.forces.clone();
    right.extend(&equations.gamma);
    let (mut solved, _) = system.solve(&right);
    solved.truncate(equations.forces.len());
    Some((solved, system.condition()))
}

/// Compares one mechanism along some walks; the number of states.
fn compared(seed: u64, walks: u64) -> Result<usize, String> {
    let [hinges, exact] = pair(seed);
    let (model, described) = hinges.read()?;
    let (exact_model, exact_described) = exact.read().map_err(|why| format!("exact: {why}"))?;
    assert!(matches!(
        exact_model.independence.rank,
        Rank::Decided { .. }
    ));
    let mut comparison = Comparison::new(&model, &described, seed, Extent::Quick);
    let reference = Comparison::new(&exact_model, &exact_described, seed, Extent::Quick);
    let mut dice = Dice::new(seed + 77);
    let coefficients = Coefficients {
        rate_gain: 4.0,
        position_gain: 9.0,
        compliance: 1e-2,
    };
    let strategies = Strategy::all(&model);
    let mut count = 0;
    for walk in 0..walks {
        let states = states(&exact_described, &reference, &mut dice);
        for (place, state) in states.into_iter().enumerate() {
            let at = |what: String| format!("walk {walk}, stop {place}: {what}");
            let Some(other) = Equations::new(&exact_described, &state) else {
                continue;
            };
            let Some((wanted, condition)) = accelerations(&other) else {
                continue;
            };
            if condition > REGULAR {
                continue;
            }
            let Some(equations) = comparison.equations(&state) else {
                continue;
            };
            let Some((found, own)) = accelerations(&equations) else {
                return Err(at("the equations that are kept depend on each other".into()));
            };
            if own > 30.0 * condition {
                return Err(at(format!("a condition of {own:e} for {condition:e}")));
            }
            let size = wanted.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            let far = difference(&found, &wanted) / size;
            // Not a number is off.
            if far.is_nan() || far >= TOLERANCE {
                return Err(at(format!("accelerations are off by {far:e} of {size:e}")));
            }
            comparison
                .solutions(&state, &state, &equations, coefficients)
                .map_err(at)?;
            let number = place + seed as usize;
            let strategy = strategies[number % strategies.len()];
            comparison
                .reduced(&state, strategy, coefficients, Terms::ALL[number % 3])
                .map_err(at)?;
            count += 1;
        }
    }
    match comparison.statistics.told {
        0 if count > 5 => Ok(count),
        told => Err(format!(
            "{count} states, {told} of them singular by a kernel"
        )),
    }
}

/// `HOLONOM_CARRIERS=100` compares more of them on longer ways.
#[test]
fn planar_loops_on_carriers_that_turn() {
    // A four-bar and scissors on a slewing gear, a slider-crank on the coupler of another loop.
    let chosen = [10, 14, 26];
    let wanted = crate::setting("HOLONOM_CARRIERS", 0);
    let first = crate::setting("HOLONOM_SEED", 0);
    let seeds = chosen.into_iter().filter(|_| wanted == 0);
    let (seeds, walks) = (
        seeds.chain(first..first + wanted),
        if wanted == 0 { 1 } else { 3 },
    );
    let mut wrong = Vec::new();
    for seed in seeds {
        let found = compared(seed, walks);
        println!("seed {seed}: {found:?}");
        wrong.extend(found.err().map(|why| (seed, why)));
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// A slewing four-bar whose base a parameter turns: no walk does.
#[test]
fn what_a_parameter_turns_is_split_along_directions_of_its_own() {
    let item = "#[mechanism(redundant = \"drop\")] pub struct Tilted {
        #[param(like = 0.0)] tilt: f64,
        #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])] base: Body,
        #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.2])] crank: Body,
        #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.2, 0.0, 0.4])] rod: Body,
        #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.0, 0.2])] rocker: Body,
        #[joint(between = [ground, base], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
        slew: Revolute,
        #[joint(between = [ground, base], axis = [0.0, 0.0, 1.0], motion = tilt)]
        motor: AngleDriver,
        #[joint(between = [base, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
        a: Revolute,
        #[joint(between = [crank, rod], point = [0.0, 0.0, 0.3], axis = [0.0, 1.0, 0.0])]
        b: Revolute,
        #[joint(between = [rod, rocker], point = [0.5, 0.0, 0.4], axis = [0.0, 1.0, 0.0])]
        c: Revolute,
        #[joint(between = [rocker, base], point = [0.5, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
        d: Revolute,
    }";
    let read = |item: &str| {
        crate::common::delivered(&crate::common::tokens(item), |name| {
            let (kind, text) = crate::library::definition(name)?;
            Some((kind, crate::common::tokens(&text)))
        })
    };
    let is_split = |item: &str| {
        let model = read(item);
        let last = model.joints.last().expect("joints");
        assert_eq!(last.dropped.len(), 3);
        !last.components.is_empty()
    };
    assert!(is_split(item));
    // One that is written is what it is.
    assert!(!is_split(
        &item
            .replace("#[param(like = 0.0)] tilt: f64,", "")
            .replace("motion = tilt", "motion = 0.3")
    ));
}
