//! Random definitions of joints and forces, written in the language.
#![allow(dead_code, reason = "every test uses a part of it")]

use holonom_engine::model::ElementKind;

/// Numbers without a pattern, the same in every run (Marsaglia's xorshift).
pub(crate) struct Dice {
    state: u64,
    /// Choices that are made already.
    made: Vec<u8>,
}

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self {
            state: seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1,
            made: Vec::new(),
        }
    }

    /// With the first choices made by others; numbers are still without a pattern.
    pub(crate) fn with_choices(seed: u64, choices: &[u8]) -> Self {
        let made = choices.iter().rev().copied().collect();
        Self {
            made,
            ..Self::new(seed)
        }
    }

    fn roll(&mut self) -> u64 {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        self.state >> 11
    }

    /// Between -1 and 1.
    pub(crate) fn number(&mut self) -> f64 {
        self.roll() as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        let choice = self.made.pop().map_or_else(|| self.roll(), u64::from);
        usize::try_from(choice % bound as u64).unwrap_or(0)
    }

    pub(crate) fn one<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.below(of.len())]
    }

    pub(crate) fn vector(&mut self, size: f64) -> [f64; 3] {
        [0; 3].map(|_| size * self.number())
    }

    pub(crate) fn unit<const N: usize>(&mut self) -> [f64; N] {
        loop {
            let vector = [0; N].map(|_| self.number());
            let length = vector.iter().map(|c| c * c).sum::<f64>().sqrt();
            if length > 0.3 {
                return vector.map(|c| c / length);
            }
        }
    }

    pub(crate) fn unit_quaternion(&mut self) -> [f64; 4] {
        self.unit()
    }
}

/// A statement of a joint.
#[derive(Clone, Debug)]
pub(crate) enum Statement {
    Let(String, String),
    Row(String),
    Drive(String, String),
    Motion(String),
    Potential(String),
    /// Effort and coordinate.
    Along(String, String),
    /// Force and point.
    Force(String, String),
    /// Moment and body.
    Moment(String, &'static str),
}

/// The formal bodies.
pub(crate) const BODIES: [&str; 3] = ["i", "j", "k"];

/// What stands in a random definition.
pub(crate) struct Written {
    pub(crate) statements: Vec<Statement>,
    /// The angles that the statements speak of, in order.
    pub(crate) angles: Vec<(usize, usize, String)>,
}

impl Written {
    /// Statements about so many bodies.
    pub(crate) fn random(kind: ElementKind, bodies: usize, dice: &mut Dice) -> Self {
        let mut statements = Vec::new();
        let mut writer = Writer {
            dice,
            bodies,
            names: [Vec::new(), Vec::new()],
            angles: Vec::new(),
        };
        for place in 0..2 {
            let is_vector = writer.dice.below(2) == 1;
            let text = if is_vector {
                writer.vector(2, false)
            } else {
                writer.scalar(2, false)
            };
            let name = format!("part{place}");
            statements.push(Statement::Let(name.clone(), text));
            writer.names[usize::from(is_vector)].push(name);
        }
        for _ in 0..=writer.dice.below(3) {
            statements.push(match kind {
                ElementKind::Joint => writer.row(),
                ElementKind::Force => writer.action(),
            });
        }
        if kind == ElementKind::Joint && writer.dice.below(3) == 0 {
            let driven = format!("{} + {}", writer.moving(), writer.scalar(2, false));
            let law = format!("law({})", writer.scalar(1, false));
            statements.push(Statement::Drive(driven, law));
        }
        if kind == ElementKind::Joint && bodies == 2 {
            // Of dice of its own: the equations are what they would be without.
            let size = statements
                .iter()
                .map(|s| format!("{s:?}").len())
                .sum::<usize>();
            let mut dice = Dice::new(size as u64);
            if dice.below(2) == 0 {
                statements.push(Statement::Motion(motions(&mut dice)));
            }
        }
        let angles = writer.angles;
        Self { statements, angles }
    }
}

/// What stands behind the word `joint` or `force`.
pub(crate) fn definition(name: &str, bodies: usize, statements: &[Statement]) -> String {
    let bodies = BODIES[..bodies].join(", ");
    let statements = statements.iter().map(|statement| match statement {
        Statement::Let(name, text) => format!("let {name} = {text};\n"),
        Statement::Row(text) => format!("{text};\n"),
        Statement::Drive(driven, law) => format!("drive {driven} to {law};\n"),
        Statement::Motion(text) => format!("motion {text};\n"),
        Statement::Potential(energy) => format!("potential {energy};\n"),
        Statement::Along(effort, coordinate) => format!("{effort} along {coordinate};\n"),
        Statement::Force(force, point) => format!("force {force} at {point};\n"),
        Statement::Moment(moment, body) => format!("moment {moment} on {body};\n"),
    });
    let statements: String = statements.collect();
    format!(
        "{name}({bodies}; p: Point, q: Point, a: Axis, b: Axis, v: Vector, size: Length, ratio: Number, law: Law(x)) {{\n{statements}}}"
    )
}

/// A law of the time and of one argument.
pub(crate) fn law(dice: &mut Dice) -> String {
    let (a, b, c) = (dice.number(), dice.number(), dice.number());
    match dice.below(6) {
        0 => format!("{a:?} + {b:?} * time"),
        4 => format!("{a:?} * atan2(x, {b:?}) - asin(0.5 * sin({c:?} * time)) * atan(x)"),
        1 => format!("{a:?} * sin({b:?} * time + x) - {c:?} * x"),
        2 => format!("x * smooth_step(2.0 * time) + exp({a:?} * time) / (2.0 + cos(x))"),
        3 => format!("sqrt(1.0 + x * x) * (time - {a:?}) / 2.0"),
        _ => format!("{a:?} * time * time * x + {b:?} * cos(time) * x * x"),
    }
}

/// Motions that need not be those that the equations leave: a mechanism is the same with them and
/// without.
fn motions(dice: &mut Dice) -> String {
    let count = dice.below(4);
    let motions = (0..count).map(|_| {
        let direction = dice.one(&["a", "b", "a.normal()", "b.binormal()"]);
        let point = dice.one(&["p", "q"]);
        match dice.below(3) {
            0 => format!("turn {direction} at {point}"),
            1 => format!("slide {direction}"),
            _ => format!("ball at {point}"),
        }
    });
    let motions: Vec<String> = motions.collect();
    if motions.is_empty() {
        return "none".into();
    }
    motions.join(", ")
}

/// Writes expressions.
struct Writer<'a> {
    dice: &'a mut Dice,
    bodies: usize,
    /// Names of scalars and of vectors.
    names: [Vec<String>; 2],
    angles: Vec<(usize, usize, String)>,
}

impl Writer<'_> {
    fn body(&mut self) -> &'static str {
        BODIES[self.dice.below(self.bodies)]
    }

    /// A vector fixed on a body.
    fn fixed(&mut self) -> String {
        let body = self.body();
        let vector = self
            .dice
            .one(&["a", "b", "v", "a.normal()", "b.binormal()", "b.normal()"]);
        format!("{body}.{vector}")
    }

    fn point(&mut self) -> String {
        let body = self.body();
        let point = self.dice.one(&["p", "q", "origin"]);
        format!("{body}.{point}")
    }

    /// A vector; where the reference configuration is meant, without time.
    fn vector(&mut self, depth: usize, described: bool) -> String {
        let named = self.names[1].len();
        if depth == 0 || self.dice.below(4) == 0 {
            return match self.dice.below(5) {
                0 => self.point(),
                1 => format!("({} - {})", self.point(), self.point()),
                2 if named > 0 && !described => self.names[1][self.dice.below(named)].clone(),
                _ => self.fixed(),
            };
        }
        let depth = depth - 1;
        match self.dice.below(8) {
            0 => format!(
                "({} + {})",
                self.vector(depth, described),
                self.vector(depth, described)
            ),
            1 => format!(
                "({} - {})",
                self.vector(depth, described),
                self.vector(depth, described)
            ),
            2 => format!(
                "cross({}, {})",
                self.vector(depth, described),
                self.vector(depth, described)
            ),
            3 => format!(
                "{} * {}",
                self.scalar(depth, described),
                self.vector(depth, described)
            ),
            4 => format!(
                "{} / (3.0 + cos({}))",
                self.vector(depth, described),
                self.scalar(depth, described)
            ),
            5 => format!(
                "[{}, {}, 0.3]",
                self.scalar(depth, described),
                self.scalar(depth, described)
            ),
            6 => format!("fixed({}, {})", self.body(), self.vector(depth, true)),
            _ => format!("-{}", self.vector(depth, described)),
        }
    }

    /// A scalar; where the reference configuration is meant, without time.
    fn scalar(&mut self, depth: usize, described: bool) -> String {
        let named = self.names[0].len();
        if depth == 0 || self.dice.below(6) == 0 {
            return match self.dice.below(8) {
                0 => format!("{:.3}", 0.1 + self.dice.number().abs()),
                1 => "size".into(),
                2 => "ratio".into(),
                3 if !described => "time".into(),
                4 if named > 0 && !described => self.names[0][self.dice.below(named)].clone(),
                5 => self.angle(),
                _ => format!("dot({}, {})", self.fixed(), self.fixed()),
            };
        }
        let depth = depth - 1;
        match self.dice.below(14) {
            0 => format!(
                "({} + {})",
                self.scalar(depth, described),
                self.scalar(depth, described)
            ),
            1 => format!(
                "({} - {})",
                self.scalar(depth, described),
                self.scalar(depth, described)
            ),
            2 => format!(
                "{} * {}",
                self.scalar(depth, described),
                self.scalar(depth, described)
            ),
            3 => format!(
                "{} / (2.0 + squared({}))",
                self.scalar(depth, described),
                self.vector(depth, described)
            ),
            4 | 5 => format!(
                "dot({}, {})",
                self.vector(depth, described),
                self.vector(depth, described)
            ),
            6 => format!("squared({})", self.vector(depth, described)),
            7 => format!("length({})", self.vector(depth, described)),
            8 => format!("sqrt(1.0 + squared({}))", self.vector(depth, described)),
            9 => {
                let inner = self.scalar(depth, described);
                match self.dice.below(6) {
                    0 => format!("atan({inner})"),
                    1 => format!("asin(0.9 * sin({inner}))"),
                    2 => format!("acos(0.8 * cos({inner}))"),
                    3 => format!("atan2({inner}, {})", self.scalar(depth, described)),
                    _ => format!("sin({inner})"),
                }
            }
            10 => format!("exp(0.2 * {})", self.scalar(depth, described)),
            11 => format!("smooth_step({})", self.scalar(depth, described)),
            12 if !described => format!("law({})", self.scalar(depth, described)),
            _ => format!("initial({})", self.scalar(depth, true)),
        }
    }

    /// An angle about one of the axes.
    fn angle(&mut self) -> String {
        let from = self.dice.below(self.bodies);
        let to = (from + 1 + self.dice.below(self.bodies - 1)) % self.bodies;
        let axis = self.dice.one(&["a", "b"]);
        let angle = (from, to, axis.to_string());
        if !self.angles.contains(&angle) {
            self.angles.push(angle);
        }
        format!("angle({}, {}, {axis})", BODIES[from], BODIES[to])
    }

    fn moving(&mut self) -> String {
        format!("dot({}, j.p - i.q)", self.fixed())
    }

    /// A force of any kind.
    fn action(&mut self) -> Statement {
        match self.dice.below(4) {
            0 => Statement::Potential(format!("{} + {}", self.moving(), self.scalar(3, false))),
            1 => {
                let coordinate = format!("{} + {}", self.moving(), self.scalar(2, false));
                let (rate, other) = (self.scalar(2, false), self.scalar(2, false));
                Statement::Along(
                    format!("-0.3 * rate({rate}) + law(rate(time * {rate})) - {other}"),
                    coordinate,
                )
            }
            2 => Statement::Force(self.vector(3, false), self.point()),
            _ => {
                let (moment, body) = (self.vector(3, false), self.body());
                if self.bodies < 2 || self.dice.below(2) == 0 {
                    return Statement::Moment(moment, body);
                }
                let from = self.dice.below(self.bodies);
                let to = (from + 1) % self.bodies;
                let (from, to) = (BODIES[from], BODIES[to]);
                let damped = format!("{moment} - 0.3 * angular_velocity({from}, {to})");
                Statement::Moment(damped, body)
            }
        }
    }

    /// An equation or more, in which something moves.
    fn row(&mut self) -> Statement {
        let moving = self.moving();
        match self.dice.below(6) {
            0 | 1 => Statement::Row(format!("{moving} + {}", self.scalar(3, false))),
            2 => Statement::Row(format!("j.p - i.q + {}", self.vector(3, false))),
            3 => Statement::Row(format!("dot(i.a.normals(), {})", self.vector(3, false))),
            4 => Statement::Row(format!(
                "cross(j.b.normals(), {}) * {}",
                self.vector(2, false),
                self.scalar(2, false)
            )),
            _ => Statement::Row(format!(
                "squared({} + j.p) * {}",
                self.vector(3, false),
                self.scalar(2, false)
            )),
        }
    }
}
