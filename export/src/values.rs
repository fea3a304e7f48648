//! Parameters and inputs of a mechanism by name.

use holonom::mechanism::TracedCoordinates;
use holonom::{Mechanism, Report};

use crate::error::ExportError;
use crate::export::{Export, INPUTS, PARAMETERS};
use crate::names::{Names, identifier};
use crate::number::Precision;
use crate::program::Member;

/// Where the numbers of a parameter or an input are.
#[derive(Clone, Debug)]
pub(crate) struct Value {
    pub(crate) member: Member,
    /// The places of its numbers among the parameters.
    pub(crate) places: Vec<usize>,
}

/// Parameters, and inputs: what a program is given. The starts of states are neither.
pub(crate) fn of(report: &Report) -> [Vec<Value>; 2] {
    let (mut parameters, mut inputs) = (Vec::new(), Vec::new());
    let [mut of_parameters, mut of_inputs] = [(); 2].map(|()| Names::default());
    let mut next = report.values.len();
    for (place, value) in report.values.iter().enumerate() {
        let further = next..next + value.further;
        next += value.further;
        if report.states.iter().any(|state| state.value == place) {
            continue;
        }
        let name = identifier(value.name);
        if !value.is_input && value.further > 0 {
            let about = format!("the table of the spline {}", value.name);
            parameters.push(Value {
                member: Member::array(of_parameters.unique(&name), about, value.further),
                places: further.collect(),
            });
            continue;
        }
        let (list, names) = if value.is_input {
            (&mut inputs, &mut of_inputs)
        } else {
            (&mut parameters, &mut of_parameters)
        };
        let mut put = |name: String, about: &str, place: usize| {
            list.push(Value {
                member: Member::number(names.unique(&name), about),
                places: vec![place],
            });
        };
        put(name.clone(), "", place);
        for (place, word) in further.zip(["rate", "acceleration"]) {
            put(format!("{name}_{word}"), "", place);
        }
    }
    [parameters, inputs]
}

impl<M: Mechanism, P: Precision, C: TracedCoordinates<M>> Export<M, P, C> {
    /// What a parameter or an input is, by its field, with its unit in parentheses, such as
    /// `torque of the motor (N m)`: the comment of its member. Members of arrays and parts are
    /// named as they are in the header.
    #[must_use]
    pub fn about(mut self, member: &str, text: &str) -> Self {
        let name = identifier(member);
        let mut is_known = false;
        for (place, values) in [PARAMETERS, INPUTS].into_iter().zip(&mut self.values) {
            let written = &mut self.program.structs[place].members;
            let members = values.iter_mut().map(|value| &mut value.member);
            for member in members.chain(written).filter(|member| member.name == name) {
                text.clone_into(&mut member.about);
                is_known = true;
            }
        }
        if is_known {
            self
        } else {
            self.refused(ExportError::Member { name })
        }
    }
}
