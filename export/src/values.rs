//! Parameters and inputs of a mechanism by name.

use holonom::Report;

use crate::names::{Names, identifier};
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
