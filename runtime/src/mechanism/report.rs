//! What the generator found out about a mechanism, as constants.

/// Sizes, names and operation counts of a mechanism.
///
/// The macro writes it, and a program only reads it: it, and what it has, may gain fields.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Report {
    /// The name of the annotated struct.
    pub name: &'static str,
    /// The bodies in the order of the fields, without the ground.
    pub bodies: &'static [BodyInfo],
    /// The joints in the order of the fields.
    pub joints: &'static [JointInfo],
    /// The forces in the order of the fields.
    pub forces: &'static [ForceInfo],
    /// The points and directions that joints and forces name, fixed on their bodies: see
    /// [`crate::Mechanism::marker`].
    pub markers: &'static [Marker],
    /// The named points in the order of the fields.
    pub points: &'static [PointInfo],
    /// Parameters, inputs and the starts of states, in the order of the fields.
    pub values: &'static [ValueInfo],
    /// What bodies look like that are described by shapes, body by body: see
    /// [`crate::Mechanism::shape`].
    pub shapes: &'static [Shape],
    /// What carries each body in the spanning tree.
    pub carriers: &'static [Carrier],
    /// The blocks of the Jacobian, in the order of [`crate::Mechanism::jacobian`].
    pub blocks: &'static [Block],
    /// Coordinates `q` of the bodies: seven a body, three a particle.
    pub coordinates: usize,
    /// Auxiliary variables, which stand behind the coordinates of the bodies in a state: angles
    /// that count turns (rad).
    pub auxiliaries: usize,
    /// The user's own states in the order of the fields. In a state they stand behind the auxiliary
    /// variables.
    pub states: &'static [StateInfo],
    /// Velocities `u`: six a body, three a particle.
    pub velocities: usize,
    /// Constraint equations; those that were left out do not count.
    pub equations: usize,
    /// The rank of the constraints.
    pub rank: Rank,
    /// Equations that follow from the others, joint by joint: a choice, without which the others
    /// are independent.
    pub redundant: &'static [RedundantRow],
    /// Velocities less the rank where it was decided; else velocities less equations (Gruebler's
    /// count).
    pub degrees_of_freedom: isize,
    /// The rows that are equations of velocities, as those of rolling: they stand in `Phi'`, and
    /// their `Phi` is zero everywhere.
    pub velocity_rows: &'static [usize],
    /// Where the time itself stands in the equations.
    pub time: ExplicitTime,
    /// Whether there are velocities without rotation in `gamma`: an equation that is not linear in
    /// the positions, such as that of a distance.
    pub curved: bool,
    /// What the kernels cost, one evaluation each. A mechanism with `coordinates = "joints"` has no
    /// fused evaluations of its bodies: `"both"` counts them.
    pub kernels: &'static [Kernel],
    /// The order of elimination and the frames of the multiplier rows, in words.
    pub plan: &'static str,
}

/// Where the time itself stands in the equations of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ExplicitTime {
    /// In the constraints: the mechanism has drivers.
    pub constraints: bool,
    /// In forces, and in the rates of the user's own states.
    pub forces: bool,
    /// In potential energies, or one of the user's own states does.
    pub potential: bool,
    /// The instants (s), in order, at which a `smooth_step` of the time begins or ends: those whose
    /// numbers the macro can see. A run begins its integration anew there, so that no step passes
    /// over a pulse.
    pub breaks: &'static [f64],
}

impl ExplicitTime {
    /// The time stands nowhere.
    pub const NONE: Self = Self {
        constraints: false,
        forces: false,
        potential: false,
        breaks: &[],
    };

    /// Whether the time stands anywhere.
    #[must_use]
    pub const fn is_anywhere(&self) -> bool {
        self.constraints || self.forces || self.potential
    }
}

/// The rank of `D`, found at expansion: the number of independent equations.
///
/// It is judged at the start and at configurations that random motions of about 0.2 rad lead to,
/// each put back onto the constraints. A row counts as dependent where it stands out from the
/// others by less than `1e-7` of its length, with translations measured by the size of the
/// mechanism.
///
/// Parameters have their typical values (`#[param(like = 0.8)]`). `new` of the mechanism checks
/// that the rank is the same at the given ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Rank {
    /// Found.
    Decided {
        /// The largest among these configurations.
        rank: usize,
        /// At the start: smaller where the mechanism starts in a singular configuration.
        at_start: usize,
    },
    /// Not decided at expansion: the constraints depend on numbers that the macro cannot see.
    NotDecided,
    /// Not decided at expansion: no configuration near the reference one was found that satisfies
    /// the constraints.
    NotAssembled,
}

impl Rank {
    /// Whether the mechanism is known to start in a singular configuration: equations depend on
    /// each other there, and nowhere near it.
    #[must_use]
    pub const fn starts_singular(&self) -> bool {
        matches!(self, Self::Decided { rank, at_start } if *at_start < *rank)
    }
}

/// An equation that follows from others, wherever the mechanism moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RedundantRow {
    /// The joint.
    pub joint: usize,
    /// The place among the equations of the joint's definition.
    pub row: usize,
    /// Whether it was left out (`redundant = "drop"`): then it is no row of `Phi`, and those behind
    /// it move up.
    pub dropped: bool,
}

impl Report {
    /// Whether equations stand in `Phi` that follow from others.
    pub(crate) const fn keeps_redundant(&self) -> bool {
        // One choice for all.
        match self.redundant {
            [row, ..] => !row.dropped,
            [] => false,
        }
    }

    /// The operations of a kernel by its name, such as `"evaluate standard"`.
    #[must_use]
    pub fn operations(&self, kernel: &str) -> Option<Operations> {
        self.kernels
            .iter()
            .find(|k| k.name == kernel)
            .map(|k| k.operations)
    }

    /// The field of the joint that a row of `Phi` belongs to.
    pub(crate) fn joint_of(&self, row: usize) -> Option<&'static str> {
        let owner = |joint: &&JointInfo| (joint.row..joint.row + joint.rows).contains(&row);
        self.joints.iter().find(owner).map(|joint| joint.name)
    }
}

/// A body and where its coordinates stand in the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BodyInfo {
    /// The name of the field.
    pub name: &'static str,
    /// Body or particle.
    pub kind: BodyKind,
    /// The place of `r` in the coordinates; `p` stands three places further.
    pub coordinate: usize,
    /// The place of `v` in the velocities; `w` stands three places further.
    pub velocity: usize,
}

/// What carries a body in the spanning tree of a mechanism, which is grown from the ground along
/// joints that say how they move (`motion ..`): the joint with the fewest motions first.
///
/// It is the tree of [`JointCoordinates`](crate::JointCoordinates), where a mechanism has these; a
/// joint's angle or displacement is set by moving what it carries
/// ([`MechanismExt::set_angle`](crate::MechanismExt::set_angle)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Carrier {
    /// The body that carries it; `None` for the ground.
    pub body: Option<usize>,
    /// The joint; `None` for a body that no joint carries, which moves freely.
    pub joint: Option<usize>,
}

/// Whether a body has an orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum BodyKind {
    /// Position and orientation: 7 coordinates, 6 velocities.
    Rigid,
    /// Position only: 3 coordinates, 3 velocities.
    Particle,
}

/// A joint, its rows and its bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct JointInfo {
    /// The name of the field.
    pub name: &'static str,
    /// The name of the joint's type.
    pub kind: &'static str,
    /// Its first row in `Phi` and in the multipliers.
    pub row: usize,
    /// The number of its rows, without those that were left out.
    pub rows: usize,
    /// The bodies in the order of `between`; `None` is the ground.
    pub bodies: &'static [Option<usize>],
    /// Whether the joint's definition has an angle.
    pub has_angle: bool,
    /// Whether the joint's definition has a displacement.
    pub has_displacement: bool,
    /// Whether the joint's definition has a point, to which reactions are reduced; else they are
    /// reduced to the centre of mass.
    pub has_point: bool,
    /// The place of its first auxiliary variable in the coordinates of a state, where it has any.
    pub auxiliary: usize,
    /// How many it has: the angles that its definition counts turns of, in the order in which they
    /// stand there.
    pub auxiliaries: usize,
    /// The places, among the equations of its definition, of those whose multipliers are not
    /// unique: they take part in a dependence of equations, so that [`Report::redundant`] could
    /// have been chosen otherwise. Empty where [`Report::rank`] is not decided, too.
    pub undetermined: &'static [usize],
}

/// A force and its bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ForceInfo {
    /// The name of the field.
    pub name: &'static str,
    /// The name of the force's type.
    pub kind: &'static str,
    /// The bodies in the order of `between`; `None` is the ground.
    pub bodies: &'static [Option<usize>],
    /// The place of its first auxiliary variable in the coordinates of a state, where it has any.
    pub auxiliary: usize,
    /// How many it has: the angles that its definition counts turns of, in the order in which they
    /// stand there.
    pub auxiliaries: usize,
}

/// A point or direction that a joint or force names, on one of its bodies; Adams has the word. Two
/// bodies on a hinge have a marker each for its point and for its axis. Of a spring each body has
/// one end: a point is a marker of those bodies on which the definition uses it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Marker {
    /// The joint or force.
    pub of: ElementPlace,
    /// The place of the body in `between`.
    pub place: usize,
    /// The body; `None` for the ground.
    pub body: Option<usize>,
    /// The name in the definition, such as `"point"`.
    pub name: &'static str,
    /// Point or direction.
    pub kind: MarkerKind,
}

/// A named point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PointInfo {
    /// The name of the field.
    pub name: &'static str,
    /// The body that it is fixed on; `None` for the ground.
    pub body: Option<usize>,
}

/// A state of the user's own: a number that integrates a rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StateInfo {
    /// The name of the field.
    pub name: &'static str,
    /// Its place: among the coordinates of a state, or among
    /// [`rest`](crate::state::JointState::rest) in joint coordinates.
    pub coordinate: usize,
    /// The place of its start in [`Report::values`].
    pub value: usize,
}

/// A parameter, an input, or the start of a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ValueInfo {
    /// The name of the field.
    pub name: &'static str,
    /// Whether it may change at every step.
    pub is_input: bool,
    /// How many further numbers it has among the parameters, behind the first ones of all values:
    /// the rate and the acceleration of a [`Setpoint`](crate::mechanism::Setpoint), the table of a
    /// [`Spline`](crate::spline::Spline).
    pub further: usize,
}

/// A doc comment in the description of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Comment {
    /// The field that it stands above, without the numbers of elements; empty for the struct.
    pub field: &'static str,
    /// Its lines.
    pub text: &'static str,
}

/// A joint or a force by its place in a [`Report`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum ElementPlace {
    /// A place in [`Report::joints`].
    Joint(usize),
    /// A place in [`Report::forces`].
    Force(usize),
}

/// What a [`Marker`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum MarkerKind {
    /// A point (m).
    Point,
    /// A direction of length 1.
    Axis,
    /// A vector of any length.
    Vector,
}

/// A shape of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Shape {
    /// The body.
    pub body: usize,
    /// What it is.
    pub kind: ShapeKind,
    /// Its centre of mass, or the origin of a mesh's file, from the centre of mass of the body (m),
    /// in the user's body axes.
    pub centre: [f64; 3],
    /// Euler parameters of the rotation from its axes to the user's body axes. Its length is along
    /// its x axis.
    pub axes: [f64; 4],
    /// Whether it is taken away: its density is negative.
    pub is_hole: bool,
    /// The file of a mesh, by its whole path on the machine that compiled it.
    pub file: Option<&'static str>,
}

/// What a [`Shape`] is. Its sizes (m) are those of [`crate::Mechanism::shape`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum ShapeKind {
    /// Length, radius.
    Cylinder,
    /// Length, outer radius, inner radius.
    Tube,
    /// Length, radius of the base. The base is at the negative end of x.
    Cone,
    /// Lengths along x, y and z.
    Block,
    /// Radius.
    Ball,
    /// What a unit of its file is (m), along the axes x, y and z of the file; negative along an
    /// axis across which a part mirrors it.
    Mesh,
}

/// A block of the Jacobian `D`: the rows of one joint against the velocities of one body.
///
/// Its values stand row by row from `offset` on in the array that [`crate::Mechanism::jacobian`]
/// returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Block {
    /// The joint.
    pub joint: usize,
    /// The body.
    pub body: usize,
    /// The first row of the block in `D`.
    pub row: usize,
    /// The number of rows.
    pub rows: usize,
    /// The first column of the block in `D`, a place in the velocities.
    pub column: usize,
    /// The number of columns: 6, or 3 for a particle.
    pub columns: usize,
    /// Where the values of the block start.
    pub offset: usize,
}

/// The cost of one kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Kernel {
    /// What it computes, for instance `"evaluate standard"`.
    pub name: &'static str,
    /// What one call costs.
    pub operations: Operations,
    /// About how many cycles a call takes that waits for the one before, in double precision on an
    /// x86-64 with AVX2. It is an estimate, which `study estimate` holds against measured times. Of
    /// short kernels it is too large.
    pub cycles: usize,
}

/// A count of operations. One of `+ - * / sqrt` is one operation, and so is the call of a function,
/// whatever it takes; a fused multiply-add is two; signs, comparisons and rounding to an integer
/// are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Operations {
    /// Additions and subtractions.
    pub additions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Divisions and reciprocals.
    pub divisions: usize,
    /// Square roots.
    pub square_roots: usize,
    /// Calls of `sin`, `cos`, `exp` and `atan2`.
    pub functions: usize,
    /// The longest chain of dependent operations.
    pub depth: usize,
}

impl Operations {
    /// Nothing counted, for kernels written by hand.
    pub const NONE: Self = Self {
        additions: 0,
        multiplications: 0,
        divisions: 0,
        square_roots: 0,
        functions: 0,
        depth: 0,
    };

    /// All operations together.
    #[must_use]
    pub const fn total(&self) -> usize {
        self.additions + self.multiplications + self.divisions + self.square_roots + self.functions
    }
}
