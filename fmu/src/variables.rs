//! The variables of a unit, by their value references.

use std::collections::HashSet;

use holonom_export::{Interface, Quantity};

use crate::error::FmuError;
use crate::units::Unit;

/// What a variable is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Time,
    State,
    Derivative,
    Parameter,
    Input,
    Reading,
    Indicator,
}

impl Kind {
    /// Its name in C.
    pub(crate) const fn in_c(self) -> &'static str {
        match self {
            Self::Time => "TIME",
            Self::State => "STATE",
            Self::Derivative => "DERIVATIVE",
            Self::Parameter => "PARAMETER",
            Self::Input => "INPUT",
            Self::Reading => "READING",
            Self::Indicator => "INDICATOR",
        }
    }
}

/// A variable. Its value reference is its place.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    pub(crate) name: String,
    pub(crate) about: String,
    pub(crate) kind: Kind,
    /// The place of its first number among those of its kind.
    pub(crate) first: usize,
    /// How many numbers it has.
    pub(crate) count: usize,
    pub(crate) is_array: bool,
    /// What it has at the start; nothing where that is computed.
    pub(crate) start: Vec<f64>,
    /// The value reference of the state of which it is the derivative.
    pub(crate) derivative_of: Option<usize>,
}

impl Variable {
    pub(crate) fn unit(&self) -> Option<Unit> {
        Unit::within(&self.about)
    }
}

/// What an event indicator reads: distances to limits, then expressions of laws that switch.
pub(crate) fn indicators(interface: &Interface) -> Vec<Quantity> {
    // Each joint with limits has a rate behind its two distances.
    let gaps = interface.gaps.chunks(3).flat_map(|of| of.iter().take(2));
    let named = |of: &Quantity, word: &str| {
        let mut named = of.clone();
        named.name = format!("{}_{word}", of.name);
        named
    };
    let gaps = gaps.map(|of| named(of, "gap"));
    let switches = interface.switches.iter().map(|of| named(of, "switch"));
    gaps.chain(switches).collect()
}

/// All variables: the time, states, their derivatives, parameters, inputs, readings and event
/// indicators.
pub(crate) fn of(
    interface: &Interface,
    abouts: &[(String, String)],
) -> Result<Vec<Variable>, FmuError> {
    let mut variables = vec![Variable {
        name: "time".to_owned(),
        about: "time (s)".to_owned(),
        kind: Kind::Time,
        first: 0,
        count: 1,
        is_array: false,
        start: Vec::new(),
        derivative_of: None,
    }];
    for (first, state) in interface.states.iter().enumerate() {
        variables.push(variable(&state.quantity, Kind::State, first));
    }
    for (first, state) in interface.states.iter().enumerate() {
        variables.push(Variable {
            name: format!("der({})", state.quantity.name),
            about: state.about_rate.clone(),
            kind: Kind::Derivative,
            start: Vec::new(),
            derivative_of: Some(1 + first),
            ..variable(&state.quantity, Kind::Derivative, first)
        });
    }
    let indicators = indicators(interface);
    let lists = [
        (&interface.parameters, Kind::Parameter),
        (&interface.inputs, Kind::Input),
        (&interface.readings, Kind::Reading),
        (&indicators, Kind::Indicator),
    ];
    for (list, kind) in lists {
        let mut first = 0;
        for quantity in list {
            let variable = variable(quantity, kind, first);
            first += variable.count;
            variables.push(variable);
        }
    }
    for (name, about) in abouts {
        let found = variables.iter_mut().find(|variable| variable.name == *name);
        let missing = || FmuError::Variable { name: name.clone() };
        found.ok_or_else(missing)?.about.clone_from(about);
    }
    tell_apart(&mut variables);
    Ok(variables)
}

fn variable(quantity: &Quantity, kind: Kind, first: usize) -> Variable {
    Variable {
        name: quantity.name.clone(),
        about: quantity.about.clone(),
        kind,
        first,
        count: quantity.start.len().max(1),
        is_array: quantity.is_array,
        start: quantity.start.clone(),
        derivative_of: None,
    }
}

/// Gives a number to a name that was given before.
fn tell_apart(variables: &mut [Variable]) {
    let mut given = HashSet::new();
    for variable in variables {
        let (name, mut number) = (variable.name.clone(), 2);
        while !given.insert(variable.name.clone()) {
            variable.name = format!("{name}_{number}");
            number += 1;
        }
    }
}
