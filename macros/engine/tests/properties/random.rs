//! Random joints between random bodies.

use std::fmt::{Display, Formatter, Result};

use holonom_engine::model::{ElementKind, Model};

use crate::State;
use crate::common::tokens;
use crate::language::Interpreter;
use crate::pose::{Pose, constant};
use crate::reading::{Described, Element};
pub(crate) use crate::writing::Dice;
use crate::writing::{Statement, Written, definition, law};

/// A joint or a force between random bodies, with random parameters.
pub(crate) struct Joint {
    pub(crate) kind: ElementKind,
    /// Where the bodies of the mechanism stand at the start.
    pub(crate) starts: Vec<([f64; 3], [f64; 4])>,
    /// The bodies of the joint; `None` is the ground.
    pub(crate) between: Vec<Option<usize>>,
    pub(crate) points: Vec<(&'static str, [f64; 3])>,
    pub(crate) axes: Vec<(&'static str, [f64; 3])>,
    pub(crate) vectors: Vec<(&'static str, [f64; 3])>,
    pub(crate) scalars: Vec<(&'static str, f64)>,
    pub(crate) law: String,
    pub(crate) statements: Vec<Statement>,
    /// The angles that the statements speak of, in order.
    angles: Vec<(usize, usize, String)>,
}

impl Joint {
    pub(crate) fn random(kind: ElementKind, dice: &mut Dice) -> Self {
        let count = 2 + dice.below(2);
        let ground = dice.below(2 * count);
        let mut starts = Vec::new();
        let mut between = Vec::new();
        for body in 0..count {
            between.push((body != ground).then_some(starts.len()));
            if body != ground {
                starts.push((dice.vector(1.0), dice.unit_quaternion()));
            }
        }
        let mut joint = Self {
            kind,
            starts,
            between,
            points: ["p", "q"].map(|name| (name, dice.vector(1.0))).into(),
            axes: ["a", "b"].map(|name| (name, dice.unit())).into(),
            vectors: vec![("v", dice.vector(1.0))],
            scalars: ["size", "ratio"].map(|name| (name, dice.number())).into(),
            law: law(dice),
            statements: Vec::new(),
            angles: Vec::new(),
        };
        let written = Written::random(kind, count, dice);
        joint.statements = written.statements;
        joint.angles = written.angles;
        joint
    }

    /// What stands behind the word `joint`.
    pub(crate) fn definition(&self) -> String {
        definition("Any", self.between.len(), &self.statements)
    }

    /// The annotated struct.
    pub(crate) fn mechanism(&self) -> String {
        let names = ["first", "second", "third"];
        let free = match self.kind {
            ElementKind::Joint => "",
            ElementKind::Force => "free, ",
        };
        let bodies = self.starts.iter().zip(names).map(|((position, euler), name)| {
            format!(
                "#[body({free}mass = 1.0, inertia = [2.0, 3.0, 4.0], position = {position:?}, orientation = {euler:?})] {name}: Body,\n"
            )
        });
        let bodies: String = bodies.collect();
        let between = self
            .between
            .iter()
            .map(|body| body.map_or("ground", |body| names[body]));
        let between: Vec<&str> = between.collect();
        let vectors = self.points.iter().chain(&self.axes).chain(&self.vectors);
        let vectors: String = vectors
            .map(|(name, value)| format!("{name} = {value:?}, "))
            .collect();
        let scalars = self.scalars.iter();
        let scalars: String = scalars
            .map(|(name, value)| format!("{name} = {value:?}, "))
            .collect();
        let word = self.kind.word();
        format!(
            "#[mechanism(redundant = \"keep\")] struct Random {{\n{bodies}#[{word}(between = [{}], {vectors}{scalars}law = {})] any: Any }}",
            between.join(", "),
            self.law
        )
    }

    /// What the second reader makes of it: the joint, with all its angles counted, and where the
    /// bodies stand at the start.
    pub(crate) fn read(&self) -> (Element, Vec<Pose>) {
        let mut described =
            Described::read(&tokens(&self.mechanism()), |_| Some(self.definition()));
        let mut element = described.elements.remove(0);
        element.turns.clone_from(&self.angles);
        let bodies = 0..described.bodies.len();
        (
            element,
            bodies.map(|body| described.start(Some(body))).collect(),
        )
    }

    /// The angles that the engine counts, in its order, by their places among those of the joint.
    pub(crate) fn turns(&self, model: &Model) -> Vec<usize> {
        let definition = &model.definitions[0];
        let places = definition.turns.iter().map(|turn| {
            let axis = definition.parameters[turn.axis].name.to_string();
            let known =
                |known: &(usize, usize, String)| *known == (turn.from, turn.to, axis.clone());
            self.angles
                .iter()
                .position(known)
                .expect("the engine counts angles that the joint speaks of")
        });
        places.collect()
    }

    /// The values of the angles that the engine counts.
    pub(crate) fn angles(&self, counted: &[usize], state: &State) -> Vec<f64> {
        let (element, starts) = self.read();
        let poses = state.poses.iter().map(|(r, p)| Pose::still(*r, *p));
        let poses: Vec<Pose> = poses.collect();
        let time = constant(state.time);
        let interpreter = Interpreter::new(&element, [&poses, &starts], &[], time, &state.turns);
        let angles = counted.iter().map(|&place| {
            let (from, to, axis) = &self.angles[place];
            interpreter.angle_now(*from, *to, axis)
        });
        angles.collect()
    }
}

impl Display for Joint {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{}\n{}", self.definition(), self.mechanism())
    }
}
