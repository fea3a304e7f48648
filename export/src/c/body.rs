//! The body of a function in C.

use std::collections::{BTreeSet, HashMap};
use std::fmt::Write as _;

use super::Text;
use super::branches::{Branch, branches};
use super::source::balanced;
use super::support::Support;
use crate::export::STATE;
use crate::program::{Function, Kind, Output, Program};
use crate::tape::{Binary, Call, Operation, Place, Unary};

/// A body that is being written.
pub(super) struct Body<'a> {
    text: &'a Text,
    program: &'a Program,
    function: &'a Function,
    /// How the numbers of each argument are written behind it.
    paths: Vec<Vec<Option<String>>>,
    /// How the numbers are written that the function is given.
    given: Vec<String>,
    /// How each place is written, once it is known.
    names: Vec<String>,
    needed: Vec<bool>,
    called: Vec<bool>,
    branches: HashMap<Place, Branch>,
    /// What is written behind a branch.
    within: Vec<bool>,
    indent: &'static str,
    lines: String,
    next: usize,
    support: &'a mut BTreeSet<Support>,
}

/// A number of the type of the program.
pub(super) fn number(value: f64) -> String {
    if value.is_infinite() {
        let sign = if value > 0.0 { "" } else { "-" };
        return format!("REAL({sign}HUGE_VAL)");
    }
    if value.is_nan() {
        return "(REAL(0.0) / REAL(0.0))".to_owned();
    }
    format!("REAL({value:?})")
}

/// The statements of a function, and what it calls of [`Support`].
pub(super) fn body(
    text: &Text,
    program: &Program,
    function: &Function,
    support: &mut BTreeSet<Support>,
) -> String {
    let paths: Vec<_> = function
        .arguments
        .iter()
        .map(|argument| match argument.kind {
            Kind::Struct(place) => text.paths(program, place),
            Kind::Number => Vec::new(),
        })
        .collect();
    let is_written = |output: &&Output| {
        let path = paths[output.argument].get(output.number);
        path.is_some_and(Option::is_some)
    };
    let outputs = function.outputs.iter().filter(is_written);
    let conditions = function.guard.map(|(place, _)| place);
    let conditions = conditions.into_iter().chain(function.returned);
    let outputs = outputs.map(|output| output.place).chain(conditions);
    let outputs: Vec<Place> = outputs.collect();
    let (needed, called) = function.tape.needed(outputs.iter().copied());
    let (branches, within) = if text.has_branches {
        branches(&function.tape, &needed, outputs)
    } else {
        (HashMap::new(), vec![false; needed.len()])
    };
    let mut given = Vec::new();
    for argument in function
        .arguments
        .iter()
        .filter(|argument| !argument.is_output)
    {
        match argument.kind {
            Kind::Number => given.push(argument.name.to_owned()),
            Kind::Struct(place) => {
                given.extend(text.paths(program, place).into_iter().map(|path| {
                    path.map_or_else(String::new, |path| format!("{}->{path}", argument.name))
                }))
            }
        }
    }
    let mut body = Body {
        text,
        program,
        function,
        paths,
        given,
        names: vec![String::new(); needed.len()],
        needed,
        called,
        branches,
        within,
        indent: "    ",
        lines: String::new(),
        next: 1,
        support,
    };
    body.write();
    body.lines
}

impl Body<'_> {
    fn write(&mut self) {
        let function = self.function;
        let takes_a_step = function
            .arguments
            .iter()
            .any(|argument| argument.name == "dt");
        if function.is_checked && takes_a_step {
            let (upper, zero) = (&self.text.upper, number(0.0));
            let mut condition = format!("!(dt > {zero})");
            if self.text.has_time {
                self.support.insert(Support::Resolution);
                condition += &format!(" || dt < {}(state->time)", self.text.named("ulp"));
            }
            let _ = writeln!(
                self.lines,
                "    if ({condition}) {{\n        return {upper}_BAD_STEP;\n    }}"
            );
        }
        if function.is_checked {
            self.refuse_no_numbers();
        }
        let mut calls = function.tape.calls().iter().enumerate().peekable();
        for (place, operation) in function.tape.operations().iter().enumerate() {
            while let Some((number, (call, _))) = calls.next_if(|(_, (_, at))| *at == place) {
                if self.called[number] {
                    self.call(number, call);
                }
            }
            let at = Place::try_from(place).unwrap_or(Place::MAX);
            if let Some(branch) = self.branches.remove(&at) {
                self.branch(&branch);
            } else if self.needed[place] && !self.within[place] && self.names[place].is_empty() {
                self.statement(place, *operation);
            }
        }
        if function.is_checked {
            self.check();
        }
        for line in self.writes() {
            let _ = writeln!(self.lines, "    {line}");
        }
        if function.is_checked {
            let _ = writeln!(self.lines, "    return {}_OK;", self.text.upper);
        } else if let Some(place) = function.returned {
            let value = self.name(place);
            let _ = writeln!(self.lines, "    return {value};");
        }
    }

    /// Returns another status where a number that is compared with others, such as a distance, is
    /// none: every comparison with it would be false. A step is compared on its own.
    fn refuse_no_numbers(&mut self) {
        let numbers = self
            .function
            .arguments
            .iter()
            .filter(|argument| matches!(argument.kind, Kind::Number) && argument.name != "dt");
        let conditions = numbers.map(|argument| format!("{0} != {0}", argument.name));
        let condition = conditions.collect::<Vec<_>>().join(" || ");
        if !condition.is_empty() {
            let upper = &self.text.upper;
            let _ = writeln!(
                self.lines,
                "    if ({condition}) {{\n        return {upper}_NOT_FINITE;\n    }}"
            );
        }
    }

    /// The outputs as they are written. What is read of a struct that is written, too, is read
    /// before.
    fn writes(&mut self) -> Vec<String> {
        let function = self.function;
        let mut writes = Vec::new();
        for output in &function.outputs {
            let argument = &function.arguments[output.argument];
            let path = self.paths[output.argument].get(output.number);
            let Some(path) = path.and_then(Option::as_ref) else {
                continue;
            };
            let target = format!("{}->{path}", argument.name);
            let mut value = self.name(output.place);
            if value == target {
                continue;
            }
            if value.contains(&format!("{}->", argument.name)) {
                let (name, real) = (self.fresh('t'), self.text.real());
                let _ = writeln!(self.lines, "    const {real} {name} = {value};");
                value = name;
            }
            writes.push(format!("{target} = {value};"));
        }
        writes
    }

    /// Returns another status where nothing is to be written.
    fn check(&mut self) {
        let (function, upper) = (self.function, &self.text.upper);
        if let Some(pivot) = function.returned {
            let (pivot, least) = (self.operand(pivot), number(self.text.least_pivot));
            let _ = writeln!(
                self.lines,
                "    if ({pivot} < {least}) {{\n        return {upper}_SINGULAR;\n    }}"
            );
        }
        // The difference of a number that is not finite is no number.
        let written = function.outputs.iter().map(|output| output.place);
        let guard = function.guard.map(|(place, _)| place);
        // What writes nothing is known by its guard.
        let guard = guard.filter(|_| function.outputs.is_empty());
        let differences = written.chain(guard).map(|place| {
            let name = self.operand(place);
            format!("({name} - {name})")
        });
        let sum = balanced(&differences.collect::<Vec<_>>());
        let (real, zero) = (self.text.real(), number(0.0));
        if !sum.is_empty() {
            let _ = writeln!(
                self.lines,
                "    const {real} zero =\n        {sum};\n    if (!(zero <= {zero})) {{\n        return {upper}_NOT_FINITE;\n    }}"
            );
        }
        if let Some((guard, of)) = function.guard {
            let (guard, status) = (self.operand(guard), of.status());
            let _ = writeln!(
                self.lines,
                "    if (!({guard} >= {zero})) {{\n        return {upper}_{status};\n    }}"
            );
        }
    }

    fn name(&self, place: Place) -> String {
        self.names[place as usize].clone()
    }

    /// A name as an operand: a sign in front of it needs brackets behind an operator.
    fn operand(&self, place: Place) -> String {
        let name = self.name(place);
        if name.starts_with('-') {
            format!("({name})")
        } else {
            name
        }
    }

    fn call_of(&mut self, support: Support, operands: &[Place]) -> String {
        self.support.insert(support);
        let operands: Vec<String> = operands.iter().map(|&place| self.name(place)).collect();
        let name = self.text.named(support.name());
        format!("{name}({})", operands.join(", "))
    }

    fn statement(&mut self, place: usize, operation: Operation) {
        let expression = match operation {
            Operation::Constant(bits) => {
                self.names[place] = number(f64::from_bits(bits));
                return;
            }
            Operation::Argument(number) => {
                self.names[place] = self.given[number as usize].clone();
                return;
            }
            // Written with its call.
            Operation::Result { .. } => return,
            Operation::Unary(Unary::Negation, of) => {
                self.names[place] = format!("-{}", self.operand(of));
                return;
            }
            Operation::Unary(Unary::TurnSine | Unary::TurnVersine, of) => {
                self.turn(of);
                return;
            }
            Operation::Unary(function, of) => self.unary(function, of),
            Operation::Binary(function, of) => self.binary(function, of),
            Operation::Fused(of) => self.call_of(Support::Fused, &of),
            Operation::Select([a, b, less, otherwise]) => {
                let [a, b, less, otherwise] = [a, b, less, otherwise].map(|of| self.operand(of));
                format!("{a} < {b} ? {less} : {otherwise}")
            }
        };
        let name = self.fresh('t');
        let (indent, real) = (self.indent, self.text.real());
        let _ = writeln!(self.lines, "{indent}const {real} {name} = {expression};");
        self.names[place] = name;
    }

    /// Choices by one comparison, with what either side needs behind it.
    fn branch(&mut self, branch: &Branch) {
        let function = self.function;
        let selects = branch.choices.iter();
        let operands = selects.filter_map(|&choice| match function.tape.at(choice) {
            Operation::Select(operands) => Some(operands),
            _ => None,
        });
        let operands: Vec<[Place; 4]> = operands.collect();
        let Some([a, b, ..]) = operands.first().map(|of| of.map(|of| self.operand(of))) else {
            return;
        };
        let names: Vec<String> = operands.iter().map(|_| self.fresh('t')).collect();
        let _ = writeln!(self.lines, "    {} {};", self.text.real(), names.join(", "));
        let heads = [format!("    if ({a} < {b}) {{"), "    } else {".to_owned()];
        for (side, head) in heads.into_iter().enumerate() {
            let _ = writeln!(self.lines, "{head}");
            self.indent = "        ";
            for &place in &branch.sides[side] {
                if self.names[place as usize].is_empty() {
                    self.statement(place as usize, function.tape.at(place));
                }
            }
            for (name, operands) in names.iter().zip(&operands) {
                let value = self.name(operands[2 + side]);
                let _ = writeln!(self.lines, "        {name} = {value};");
            }
            self.indent = "    ";
        }
        self.lines.push_str("    }\n");
        for (&choice, name) in branch.choices.iter().zip(names) {
            self.names[choice as usize] = name;
        }
    }

    fn fresh(&mut self, letter: char) -> String {
        let name = format!("{letter}{}", self.next);
        self.next += 1;
        name
    }

    fn unary(&mut self, function: Unary, of: Place) -> String {
        let support = match function {
            Unary::Reciprocal => return format!("REAL(1.0) / {}", self.operand(of)),
            Unary::SquareRoot => Support::SquareRoot,
            Unary::Magnitude => Support::Magnitude,
            Unary::Sine | Unary::TurnSine => Support::Sine,
            Unary::Cosine | Unary::TurnVersine => Support::Cosine,
            Unary::Exponential => Support::Exponential,
            Unary::Rounding => Support::Rounding,
            Unary::Negation => return format!("-{}", self.operand(of)),
        };
        self.call_of(support, &[of])
    }

    fn binary(&mut self, function: Binary, of: [Place; 2]) -> String {
        let sign = match function {
            Binary::Sum => '+',
            Binary::Difference => '-',
            Binary::Product => '*',
            Binary::Angle => return self.call_of(Support::Angle, &of),
            Binary::Least => return self.call_of(Support::Least, &of),
        };
        let [a, b] = of.map(|of| self.operand(of));
        format!("{a} {sign} {b}")
    }

    /// Sines and versines of this angle, and of all others that are known here.
    fn turn(&mut self, of: Place) {
        self.support.insert(Support::Turns);
        let function = self.function;
        let angle = |operation: &Operation| match operation {
            Operation::Unary(Unary::TurnSine | Unary::TurnVersine, angle) => Some(*angle),
            _ => None,
        };
        let mut angles: Vec<Place> = vec![of];
        let operations = function.tape.operations().iter().enumerate();
        for (place, operation) in operations {
            let is_open = self.needed[place] && !self.within[place] && self.indent.len() == 4;
            if is_open
                && self.names[place].is_empty()
                && let Some(angle) = angle(operation)
                && !self.names[angle as usize].is_empty()
                && !angles.contains(&angle)
            {
                angles.push(angle);
            }
        }
        let (sine, versine) = (self.fresh('s'), self.fresh('v'));
        let names: Vec<String> = angles.iter().map(|&angle| self.name(angle)).collect();
        let (indent, real, count) = (self.indent, self.text.real(), angles.len());
        let list = self.fresh('a');
        let _ = writeln!(
            self.lines,
            "{indent}{real} {list}[{count}], {sine}[{count}], {versine}[{count}];"
        );
        for (k, name) in names.iter().enumerate() {
            let _ = writeln!(self.lines, "{indent}{list}[{k}] = {name};");
        }
        let turns = self.text.named("turns");
        let _ = writeln!(
            self.lines,
            "{indent}{turns}({count}, {list}, {sine}, {versine});"
        );
        for (place, operation) in function.tape.operations().iter().enumerate() {
            let found = angle(operation).and_then(|of| angles.iter().position(|&a| a == of));
            let Some(k) = found else { continue };
            let list = match operation {
                Operation::Unary(Unary::TurnSine, _) => &sine,
                _ => &versine,
            };
            self.names[place] = format!("{list}[{k}]");
        }
    }

    /// A call, with room for what it is given and for what it gives.
    fn call(&mut self, number: usize, call: &Call) {
        let called = &self.program.functions[call.function];
        let mut given = call.given.iter();
        let (mut arguments, mut results) = (Vec::new(), Vec::new());
        if called.returned.is_some() {
            results.push(self.fresh('p'));
        }
        for argument in &called.arguments {
            let Kind::Struct(place) = argument.kind else {
                if let Some(&place) = given.next() {
                    arguments.push(self.name(place));
                }
                continue;
            };
            let of = &self.program.structs[place];
            if argument.is_output {
                let room = self.fresh('k');
                let kind = self.text.named(of.name);
                let _ = writeln!(self.lines, "    {kind} {room};");
                let paths = of.paths();
                results.extend(paths.into_iter().map(|path| format!("{room}.{path}")));
                arguments.push(format!("&{room}"));
            } else if place == STATE {
                let numbers: Vec<Place> = given.by_ref().take(of.numbers()).copied().collect();
                arguments.push(self.state(&numbers));
            } else if !of.members.is_empty() {
                arguments.push(argument.name.to_owned());
            }
        }
        let (name, arguments) = (self.text.named(&called.name), arguments.join(", "));
        let line = if called.returned.is_some() {
            format!(
                "const {} {} = {name}({arguments});",
                self.text.real(),
                results[0]
            )
        } else {
            format!("{name}({arguments});")
        };
        let _ = writeln!(self.lines, "    {line}");
        self.name_results(number, results);
    }

    fn name_results(&mut self, number: usize, results: Vec<String>) {
        for (place, operation) in self.function.tape.operations().iter().enumerate() {
            if let Operation::Result { call, result } = operation
                && *call as usize == number
                && let Some(name) = results.get(*result as usize)
            {
                self.names[place].clone_from(name);
            }
        }
    }

    /// A state of these numbers as an argument: the function's own, where they are its numbers.
    fn state(&mut self, numbers: &[Place]) -> String {
        let paths = self.program.structs[STATE].paths();
        let is_own = |(place, path): (&Place, &String)| {
            path == "time_rest" || self.name(*place) == format!("state->{path}")
        };
        if numbers.iter().zip(&paths).all(is_own) {
            return "state".to_owned();
        }
        let room = self.fresh('x');
        let kind = self.text.named(self.program.structs[STATE].name);
        let _ = writeln!(self.lines, "    {kind} {room};");
        for (&place, path) in numbers.iter().zip(&paths) {
            let value = self.name(place);
            let _ = writeln!(self.lines, "    {room}.{path} = {value};");
        }
        format!("&{room}")
    }
}
