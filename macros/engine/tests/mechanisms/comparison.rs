//! A mechanism through the engine's passes, evaluated by numbers, against a dense solution of the
//! same equations.

use holonom_engine::coordinates::candidates::Strategy;
use holonom_engine::coordinates::system::Reduced;
use holonom_engine::model::Model;
use holonom_engine::plan::candidates::Plans;
use holonom_engine::plan::candidates::all;
use holonom_engine::plan::kernels::{Evaluation, Kernels, evaluation};
use holonom_engine::plan::system::Terms;

use crate::dense::Factors;
use crate::inputs::{Coefficients, Inputs, in_axes, transposed, turned, user_axes};
use crate::reading::Described;
use crate::reference::{Equations, State, euler_rates};
use crate::text::Statistics;
use crate::writing::Dice;

/// Of what is evaluated without a solution, over the largest number on the way.
const DIRECT: f64 = 1e-12;
/// Of mechanisms with more unknowns, one plan is compared besides the chosen one.
const LARGE: usize = 30;
/// States besides the described one.
const STATES: usize = 2;

/// How much of a mechanism is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    /// All kernels.
    Full,
    /// One kernel of motion by one plan, and one strategy at each state; many mechanisms make up
    /// for that.
    Quick,
}

/// Mechanism and kernels.
pub(crate) struct Comparison<'a> {
    pub(crate) model: &'a Model,
    pub(crate) described: &'a Described,
    pub(crate) kernels: Option<Kernels>,
    /// Besides those of the kernels.
    pub(crate) others: Vec<Evaluation>,
    /// Of all rows of the definitions.
    pub(crate) dropped: Vec<bool>,
    pub(crate) statistics: Statistics,
    /// In joint coordinates, as far as they were asked for.
    pub(crate) in_joints: Vec<(Strategy, Reduced)>,
}

/// The largest difference; not a number is a difference.
pub(crate) fn difference(found: &[f64], wanted: &[f64]) -> f64 {
    if found.len() != wanted.len() {
        return f64::INFINITY;
    }
    found.iter().zip(wanted).fold(0.0, |worst, (a, b)| {
        let difference = (a - b).abs();
        if difference <= worst {
            worst
        } else {
            difference
        }
    })
}

/// Evaluations by other plans than the chosen ones.
fn others(model: &Model, chosen: &Plans, seed: usize) -> Vec<Evaluation> {
    let both = [Terms::Plain, Terms::Compliant];
    let plans = both.map(|terms| {
        let mut plans = all(model, terms);
        plans.retain(|plan| plan != chosen.of(terms));
        plans.into_iter().map(move |plan| (terms, plan))
    });
    let mut plans: Vec<_> = plans.into_iter().flatten().collect();
    if model.layout().velocities + model.layout().rows > LARGE && !plans.is_empty() {
        // One of them: they cost most of the time.
        plans = vec![plans.swap_remove(seed % plans.len())];
    }
    let plans = plans.iter();
    plans
        .map(|(terms, plan)| evaluation(model, plan, *terms))
        .collect()
}

/// One of all evaluations.
fn any(model: &Model, seed: usize) -> Evaluation {
    let terms = Terms::ALL[seed % 3];
    let plans = all(model, terms);
    evaluation(model, &plans[(seed / 3) % plans.len()], terms)
}

impl<'a> Comparison<'a> {
    pub(crate) fn new(
        model: &'a Model,
        described: &'a Described,
        seed: u64,
        extent: Extent,
    ) -> Self {
        let (kernels, others) = match extent {
            Extent::Full => {
                let kernels = Kernels::new(model);
                // One that runs by its joints has none for its bodies.
                let chosen = kernels.plans.as_ref();
                let others = chosen.map(|chosen| others(model, chosen, seed as usize));
                let others = others.unwrap_or_default();
                (Some(kernels), others)
            }
            Extent::Quick => (None, vec![any(model, seed as usize)]),
        };
        let mut dropped = Vec::new();
        for joint in &model.joints {
            let rows = model.definition(joint).equations();
            dropped.extend((0..rows).map(|row| joint.dropped.contains(&row)));
        }
        let statistics = Statistics {
            mechanisms: 1,
            equations: model.layout().rows,
            loops: usize::from(model.joints.len() > model.bodies.len()),
            rolling: usize::from(!model.velocity_rows().is_empty()),
            dropped: dropped.iter().filter(|dropped| **dropped).count(),
            ..Statistics::default()
        };
        Self {
            model,
            described,
            kernels,
            others,
            dropped,
            statistics,
            in_joints: Vec::new(),
        }
    }

    /// A state near another on the constraints that are kept (Newton's method).
    pub(crate) fn satisfying_position(&self, state: &State) -> Option<State> {
        const STEPS: usize = 12;
        let mut at = state.clone();
        for _ in 0..STEPS {
            let equations = self.equations(&at)?;
            if equations.hold() {
                return Some(at);
            }
            let mut right = vec![0.0; equations.forces.len()];
            right.extend(equations.phi.iter().map(|phi| -phi));
            let change = Factors::new(equations.saddle(0.0))?.solve(&right);
            at = at.moved(self.described, &change)?;
        }
        None
    }

    pub(crate) fn equations(&self, state: &State) -> Option<Equations> {
        let equations = Equations::new(self.described, state)?;
        Some(equations.without(&self.dropped))
    }

    pub(crate) fn run(mut self, seed: u64) -> Result<Statistics, String> {
        let mut dice = Dice::new(seed);
        let angles = self.model.counters().len();
        let mut states = vec![State::start(self.described, angles)];
        states.extend((0..STATES).map(|_| State::random(self.described, angles, &mut dice)));
        if let Some(last) = states.last_mut() {
            // One on the constraints, if they can be satisfied.
            *last = self
                .satisfying_position(last)
                .unwrap_or_else(|| last.clone());
        }
        for (place, state) in states.iter().enumerate() {
            let coefficients = Coefficients {
                rate_gain: 4.0 + dice.number(),
                position_gain: 9.0 + dice.number(),
                compliance: [1e-1, 1e-3, 1e-6][dice.below(3)],
            };
            let stretched = if place == 0 {
                state.clone()
            } else {
                state.stretched(&mut dice)
            };
            let both = self.equations(state).zip(self.equations(&stretched));
            let Some((unit, exact)) = both else {
                self.statistics.singular += 1;
                continue;
            };
            self.statistics.states += 1;
            self.statistics.satisfied += usize::from(unit.hold());
            let at =
                |what: String| format!("{what}\nat state {place}, {stretched:?}\n{coefficients:?}");
            self.direct(&stretched, &exact, coefficients).map_err(at)?;
            self.solutions(state, &stretched, &unit, coefficients)
                .map_err(at)?;
        }
        for (place, state) in states.iter().enumerate() {
            let coefficients = Coefficients {
                rate_gain: 4.0,
                position_gain: 9.0,
                compliance: 1e-2,
            };
            let all = Strategy::all(self.model);
            let number = seed as usize + place;
            if self.kernels.is_none() {
                // Quickly, by another one at each state.
                let terms = Terms::ALL[(number / all.len()) % 3];
                self.reduced(state, all[number % all.len()], coefficients, terms)?;
                continue;
            }
            for (place, strategy) in all.into_iter().enumerate() {
                let terms = Terms::ALL[(number + place) % 3];
                self.reduced(state, strategy, coefficients, terms)?;
            }
        }
        self.initial_state(&states[0])?;
        self.left_out(&states[0])?;
        Ok(self.statistics)
    }

    pub(crate) fn within(
        &mut self,
        what: &str,
        found: &[f64],
        wanted: &[f64],
        scale: f64,
    ) -> Result<(), String> {
        let relative = difference(found, wanted) / scale;
        // Not a number is not within.
        if relative <= DIRECT {
            self.statistics.worst_direct = self.statistics.worst_direct.max(relative);
            Ok(())
        } else {
            Err(format!(
                "{what}: {found:?}\nwanted: {wanted:?}\ndifference over scale {relative:e}"
            ))
        }
    }

    /// The state that the attributes describe, in the axes of the kernels.
    fn initial_state(&mut self, start: &State) -> Result<(), String> {
        let Some(kernels) = &self.kernels else {
            return Ok(());
        };
        let angles = vec![(-0.5, 0.0); start.turns.len()];
        let coefficients = Coefficients::default();
        let inputs = Inputs::new(self.model, self.described, start, &angles, coefficients);
        let found = inputs.of(&kernels.initial_state);
        let wanted = [&inputs.coordinates[..], &inputs.velocities].concat();
        self.within("the described state", &found, &wanted, 1.0)
    }

    /// The kernels that are evaluated without a solution.
    fn direct(
        &mut self,
        state: &State,
        equations: &Equations,
        coefficients: Coefficients,
    ) -> Result<(), String> {
        let Some(kernels) = self.kernels.take() else {
            return Ok(());
        };
        let inputs = Inputs::new(
            self.model,
            self.described,
            state,
            &equations.angles,
            coefficients,
        );
        let (model, scale) = (self.model, equations.scale);
        let found = inputs.of(&kernels.constraints);
        self.within("Phi", &found, &equations.phi, scale)?;
        let found = inputs.of(&kernels.constraint_rates);
        self.within("Phi'", &found, &equations.rate, scale)?;
        let found = inputs.of(&kernels.gamma);
        self.within("gamma", &found, &equations.gamma, scale)?;
        let found = self.jacobian(&kernels, &inputs);
        for (row, (found, wanted)) in found.iter().zip(&equations.gradients).enumerate() {
            self.within(&format!("row {row} of D"), found, wanted, scale)?;
        }
        let found = in_axes(model, &inputs.of(&kernels.forces), false);
        // A force times a derivative.
        self.within("g", &found, &equations.forces, scale * scale)?;
        for (body, described) in self.described.bodies.iter().enumerate() {
            let first = model.layout().velocity[body];
            let found = inputs.of(&kernels.mass);
            self.within(
                "a mass",
                &found[first..first + 3],
                &[described.mass; 3],
                described.mass,
            )?;
            if let Some(tensor) = described.inertia {
                let axes = user_axes(model, body);
                // C J C^T, column by column.
                let half = tensor.map(|row| turned(axes, row));
                let columns = transposed(half).map(|column| turned(axes, column));
                let moments = &found[first + 3..first + 6];
                for k in 0..3 {
                    let mut wanted = [0.0; 3];
                    wanted[k] = moments[k];
                    self.within("an inertia", &columns[k], &wanted, 1.0)?;
                }
            }
        }
        let rates = self.coordinate_rates(state, equations);
        let found = inputs.of(&kernels.coordinate_rates);
        self.within("q'", &found, &rates, scale)?;
        let energies = [
            ("kinetic energy", &kernels.kinetic_energy, equations.kinetic),
            (
                "potential energy",
                &kernels.potential_energy,
                equations.potential,
            ),
            ("power", &kernels.power, equations.power),
        ];
        let energies = energies.map(|(what, kernel, wanted)| (what, inputs.of(kernel), wanted));
        for (what, found, wanted) in energies {
            self.within(what, &found, &[wanted], scale * scale)?;
        }
        let angles: Vec<f64> = equations.angles.iter().map(|(angle, _)| *angle).collect();
        let found = inputs.of(&kernels.counters);
        self.within("unwrapped angles", &found, &angles, scale)?;
        self.kernels = Some(kernels);
        Ok(())
    }

    /// The rows of `D` in the user's axes.
    fn jacobian(&self, kernels: &Kernels, inputs: &Inputs) -> Vec<Vec<f64>> {
        let (model, layout) = (self.model, self.model.layout());
        let values = inputs.of(&kernels.jacobian);
        let mut rows = vec![vec![0.0; layout.velocities]; layout.rows];
        for block in &kernels.blocks {
            let width = model.bodies[block.body].kind.velocities();
            let first = layout.row[block.joint];
            for k in 0..model.equations(&model.joints[block.joint]) {
                let from = block.offset + k * width;
                let at = layout.velocity[block.body];
                rows[first + k][at..at + width].copy_from_slice(&values[from..from + width]);
            }
        }
        let rows = rows.iter();
        rows.map(|row| in_axes(model, row, false)).collect()
    }

    /// `r' = v`, `p' = 1/2 L(p)^T w`, rates of unwrapped angles; of the Euler parameters of
    /// principal axes.
    pub(crate) fn coordinate_rates(&self, state: &State, equations: &Equations) -> Vec<f64> {
        let mut rates = Vec::new();
        for (place, body) in self.model.bodies.iter().enumerate() {
            let (v, w) = state.rates[place];
            rates.extend(v);
            if self.described.bodies[place].inertia.is_some() {
                let [c0, c1, c2, c3] = body.user_axes;
                let own = euler_rates(state.poses[place].1, w);
                rates.extend(holonom_engine::model::inertia::compose(
                    own,
                    [c0, -c1, -c2, -c3],
                ));
            }
        }
        rates.extend(equations.angles.iter().map(|(_, rate)| *rate));
        rates
    }
}
