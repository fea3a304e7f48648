//! Texts of mechanisms, and what becomes of them.

use std::collections::BTreeMap;
use std::fmt::{Display, Formatter};

use holonom_engine::model::{ElementKind, Model, Rank};
use holonom_engine::plan::candidates::choose;
use holonom_engine::plan::kernels::evaluation;
use holonom_engine::plan::system::Terms;

use crate::common::{checked, tokens};
use crate::comparison::{Comparison, Extent, difference};
use crate::inputs::{Coefficients, Inputs, transposed, turned, user_axes};
use crate::library;
use crate::pose::Pose;
use crate::reading::Described;
use crate::reference::{Equations, State};
use crate::solutions::{SMALL, System, TOLERANCE, smallest};

/// Texts of a mechanism.
#[derive(Clone)]
pub(crate) struct Text {
    /// The annotated struct.
    pub(crate) item: String,
    /// Definitions that are not of the library: name, kind, text.
    pub(crate) definitions: Vec<(String, ElementKind, String)>,
}

/// What became of a mechanism.
pub(crate) enum Outcome {
    /// The engine refuses it.
    Refused(String),
    /// The engine refuses it as contradictory if its fields stand in another order.
    RefusedOtherwise(String),
    Compared(Statistics),
}

/// What was compared.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Statistics {
    pub(crate) mechanisms: usize,
    pub(crate) states: usize,
    pub(crate) solutions: usize,
    pub(crate) equations: usize,
    pub(crate) loops: usize,
    /// Mechanisms with equations of velocities.
    pub(crate) rolling: usize,
    pub(crate) dropped: usize,
    /// States on the constraints.
    pub(crate) satisfied: usize,
    /// States off the constraints where a pivot vanishes, and the kernel says so, although the
    /// system is regular.
    pub(crate) told: usize,
    /// States near a point where something has no derivative, and systems that are nearly singular.
    pub(crate) singular: usize,
    pub(crate) worst: f64,
    pub(crate) worst_direct: f64,
}

impl Statistics {
    pub(crate) fn add(&mut self, other: &Self) {
        self.mechanisms += other.mechanisms;
        self.states += other.states;
        self.solutions += other.solutions;
        self.equations += other.equations;
        self.loops += other.loops;
        self.rolling += other.rolling;
        self.dropped += other.dropped;
        self.satisfied += other.satisfied;
        self.told += other.told;
        self.singular += other.singular;
        self.worst = self.worst.max(other.worst);
        self.worst_direct = self.worst_direct.max(other.worst_direct);
    }
}

impl Display for Statistics {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self {
            mechanisms,
            states,
            solutions,
            equations,
            loops,
            rolling,
            dropped,
            satisfied,
            told,
            singular,
            worst,
            worst_direct,
        } = self;
        write!(
            f,
            "{mechanisms} mechanisms, {states} states, {satisfied} on the constraints, {solutions} solutions, {equations} equations, {loops} with loops, {rolling} with equations of velocities, {dropped} equations \
             left out, {singular} singular, {told} with a small pivot off the constraints; largest deviation {worst:.1e} of the condition, {worst_direct:.1e} without a solution"
        )
    }
}

impl Display for Text {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        for (_, kind, text) in &self.definitions {
            writeln!(f, "{} {text}", kind.word())?;
        }
        write!(f, "{}", self.item)
    }
}

impl Text {
    pub(crate) fn find(&self, name: &str) -> Option<(ElementKind, String)> {
        let own = self.definitions.iter().find(|(known, ..)| known == name);
        own.map(|(_, kind, text)| (*kind, text.clone()))
            .or_else(|| library::definition(name))
    }

    /// What it means, read by the engine and by the second reader, or why the engine refuses it.
    pub(crate) fn read(&self) -> Result<(Model, Described), String> {
        let item = tokens(&self.item);
        let model = checked(&item, |name| {
            self.find(name).map(|(kind, text)| (kind, tokens(&text)))
        })?;
        let mut described = Described::read(&item, |name| Some(self.find(name)?.1));
        let poses: Vec<Pose> = (0..described.bodies.len())
            .map(|body| described.start(Some(body)))
            .collect();
        let start = |body: Option<usize>| body.map_or_else(Pose::ground, |body| poses[body]);
        for (element, used) in described.elements.iter_mut().zip(model.elements()) {
            let definition = model.definition(used);
            let counted = model.counted(used);
            let turns = counted.iter().map(|turn| {
                let axis = definition.parameters[turn.axis].name.to_string();
                (turn.from, turn.to, axis)
            });
            element.turns = turns.collect();
            let components = used.components.iter().map(|(first, along)| {
                let body = used.bodies[along.place].expect("a body");
                let own = transposed(user_axes(&model, body));
                (
                    *first,
                    along.place,
                    along.axes.map(|axis| turned(own, axis)),
                )
            });
            element.components = components.collect();
            let poses: Vec<Pose> = element.between.iter().map(|&body| start(body)).collect();
            for carried in &mut element.vectors {
                let mut parameters = definition.parameters.iter();
                let parameter = parameters.position(|p| p.name == carried.name);
                let parameter = parameter.expect("a parameter");
                carried.take_normals_from(definition.first_body_of(parameter), &poses);
            }
        }
        Ok((model, described))
    }

    /// What the engine finds of the rank of its equations, or why it refuses it.
    pub(crate) fn rank(&self) -> Result<Rank, String> {
        let model = checked(&tokens(&self.item), |name| {
            self.find(name).map(|(kind, text)| (kind, tokens(&text)))
        })?;
        Ok(model.independence.rank)
    }

    /// Compares everything, also with the same fields in another order; the error says what
    /// differs.
    pub(crate) fn check(
        &self,
        shuffled: &Self,
        seed: u64,
        extent: Extent,
    ) -> Result<Outcome, String> {
        let (model, described) = match self.read() {
            Ok(read) => read,
            Err(faults) => return Ok(Outcome::Refused(faults)),
        };
        let statistics = Comparison::new(&model, &described, seed, extent).run(seed)?;
        if extent == Extent::Quick || model.independence.dropped {
            // What is left out may be another choice.
            return Ok(Outcome::Compared(statistics));
        }
        let (other_model, other) = match shuffled.read() {
            Ok(read) => read,
            // Whether equations that nothing satisfies are seen to contradict each other depends on
            // where a search for such a configuration ends.
            Err(faults) if faults.contains("contradicts") => {
                return Ok(Outcome::RefusedOtherwise(faults));
            }
            Err(faults) => {
                return Err(format!(
                    "refused in another order: {faults}\n{}",
                    shuffled.item
                ));
            }
        };
        let one = by_name(&model, &described);
        let two = by_name(&other_model, &other);
        if let (Some((one, round_off)), Some((two, _))) = (one, two)
            && one.iter().zip(&two).any(|((name, a), (same, b))| {
                name != same || difference(a, b) > 2.0 * TOLERANCE * round_off
            })
        {
            return Err(format!(
                "another order changes more than the order: {one:?}\n{two:?}\n{}",
                shuffled.item
            ));
        }
        Ok(Outcome::Compared(statistics))
    }
}

/// Accelerations by bodies and multipliers by joints in the described state, and what their
/// round-off is compared with; `None` where the system is nearly singular.
fn by_name(model: &Model, described: &Described) -> Option<(BTreeMap<String, Vec<f64>>, f64)> {
    let state = State::start(described, model.counters().len());
    let equations = Equations::new(described, &state)?;
    let mut right = equations.forces.clone();
    right.extend(&equations.gamma);
    let (_, round_off) = System::new(&equations, 0.0)?.solve(&right);
    let coefficients = Coefficients {
        rate_gain: 0.0,
        position_gain: 0.0,
        compliance: 0.0,
    };
    let inputs = Inputs::new(model, described, &state, &equations.angles, coefficients);
    let layout = model.layout();
    let evaluation = evaluation(model, &choose(model).rigid, Terms::Plain);
    let values = inputs.of(&evaluation.kernel);
    let (solution, pivots) =
        values[layout.coordinates + layout.auxiliaries..].split_at(layout.velocities + layout.rows);
    let mut named = BTreeMap::new();
    let bodies = model.bodies.iter().zip(&layout.velocity);
    for (body, &first) in bodies {
        named.insert(
            body.name.to_string(),
            solution[first..first + body.kind.velocities()].to_vec(),
        );
    }
    for (joint, &first) in model.joints.iter().zip(&layout.row) {
        let first = layout.velocities + first;
        named.insert(
            joint.name.to_string(),
            solution[first..first + model.equations(joint)].to_vec(),
        );
    }
    let pivot = smallest(pivots, &evaluation.checks);
    (pivot >= SMALL).then_some((named, round_off / pivot))
}
