//! What is known about the rank of the constraints.

/// What a mechanism asks for where equations depend on each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Redundant {
    /// Nothing was said: a mechanism with redundant equations is refused.
    #[default]
    Refuse,
    /// Redundant equations are left out.
    Drop,
    /// All equations stay, for formulations with a compliance.
    Keep,
}

impl Redundant {
    /// What `redundant` takes.
    pub const ALL: [(&'static str, Self); 2] = [("drop", Self::Drop), ("keep", Self::Keep)];
}

/// The rank of `D`, if it could be found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rank {
    /// Found at the start and at configurations near it.
    Decided {
        /// The largest.
        rank: usize,
        /// At the start: smaller in a singular configuration.
        at_start: usize,
    },
    /// The constraints depend on numbers that the macro cannot see.
    #[default]
    NotDecided,
    /// No configuration near the reference one satisfies the constraints.
    NotAssembled,
}

/// An equation that follows from the others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RedundantRow {
    /// The joint.
    pub joint: usize,
    /// The place among the equations of the joint's definition.
    pub row: usize,
    /// The joints, in order, of the equations that it follows from; itself among them if so.
    pub follows_from: Vec<usize>,
}

/// An equation that cannot hold together with others.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// The joint.
    pub joint: usize,
    /// The place among the equations of the joint's definition.
    pub row: usize,
    /// The joints, in order, of the equations that it contradicts; itself among them if so.
    pub against: Vec<usize>,
    /// When it shows (s).
    pub time: f64,
    /// Whether it holds then, but asks for another speed.
    pub by_speed: bool,
    /// Coordinates of the bodies: as they are described, and where it shows.
    pub way: [Vec<f64>; 2],
}

/// What was found out about the equations of a mechanism.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Independence {
    /// The rank.
    pub rank: Rank,
    /// The equations that can go so that the others are independent and say the same.
    pub redundant: Vec<RedundantRow>,
    /// The equations, by joint and place and in order, whose multipliers are not unique, because
    /// redundant ones follow from them or are redundant themselves.
    pub undetermined: Vec<(usize, usize)>,
    /// The equations that no motion satisfies together with the others. If there are any, redundant
    /// ones are not looked for.
    pub contradictions: Vec<Contradiction>,
    /// The equations, by joint and place, that are violated in the reference configuration where
    /// their gradients vanish, if nothing near it satisfies all.
    pub stuck: Vec<(usize, usize)>,
    /// The equations among the redundant ones, by joint and place, whose gradients vanish wherever
    /// the mechanism got to, but not everywhere: they follow from nothing, and may say something
    /// yet.
    pub dormant: Vec<(usize, usize)>,
    /// The equations among the redundant ones, by joint and place, that do not hold where the
    /// others lead to: where the mechanism was looked at, they follow from these by chance.
    pub by_chance: Vec<(usize, usize)>,
    /// Whether no other configuration was found near the reference one, although the rank leaves
    /// motion free: there rows may depend on each other by chance.
    pub is_alone: bool,
    /// Whether the time stands in an equation.
    pub is_driven: bool,
    /// The places, in order, of the run-time values that the constraints depend on, where all this
    /// was found at their typical values.
    pub likes: Vec<usize>,
    /// Whether they are gone.
    pub dropped: bool,
    /// Times (s) and coordinates of the bodies along a motion that all equations leave free, from
    /// the reference configuration on, where there was a choice of equations to be made.
    pub sweep: Vec<(f64, Vec<f64>)>,
    /// The components of vector equations, by joint and first equation, to which the places of
    /// redundant equations refer where they are not along global axes.
    pub components: Vec<(usize, (usize, Components))>,
}

impl Independence {
    /// Velocities that the constraints leave free: by the rank where it is known, else by the
    /// number of equations.
    #[must_use]
    pub fn degrees_of_freedom(&self, velocities: usize, equations: usize) -> isize {
        let bound = match self.rank {
            Rank::Decided { rank, .. } => rank,
            Rank::NotDecided | Rank::NotAssembled => equations,
        };
        velocities.cast_signed() - bound.cast_signed()
    }
}

/// Three directions at right angles, fixed on a body, along which a vector equation is split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Components {
    /// The place of the body among those of the joint.
    pub place: usize,
    /// The directions in principal axes of the body.
    pub axes: [[f64; 3]; 3],
}
