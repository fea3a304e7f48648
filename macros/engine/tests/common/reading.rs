//! A second reader of annotated structs and of definitions: text in, numbers and expressions out.
//!
//! It knows nothing of the engine. What is wrong with a text is the engine's to say; here it
//! panics.
#![allow(dead_code, reason = "every test uses a part of it")]

use std::f64::consts::{PI, TAU};

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{BinOp, Expr, ExprLit, Ident, Lit, Meta, Token, UnOp, braced, parenthesized};

use crate::pose::{Pose, normals, normals_without_cases};

pub(crate) type Numbers = [f64; 3];

/// Run-time values by name.
pub(crate) type Values = [(String, f64)];

/// A body as it is described, in the user's axes.
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) mass: f64,
    /// The tensor about the centre of mass; `None` for a particle.
    pub(crate) inertia: Option<[Numbers; 3]>,
    pub(crate) position: Numbers,
    /// Of length 1.
    pub(crate) orientation: [f64; 4],
    pub(crate) velocity: Numbers,
    pub(crate) angular_velocity: Numbers,
    /// Whether the orientation is given by run-time values.
    is_symbolic: bool,
}

impl Body {
    /// The number of its velocities.
    pub(crate) fn velocities(&self) -> usize {
        if self.inertia.is_some() { 6 } else { 3 }
    }
}

/// A point, vector or axis on each body of a joint, in the user's axes of the body.
pub(crate) struct Carried {
    pub(crate) name: String,
    pub(crate) is_point: bool,
    pub(crate) copies: Vec<Numbers>,
    /// For an axis: its two normals.
    pub(crate) normals: Vec<[Numbers; 2]>,
    /// For an axis: where it points in the reference configuration, in global axes.
    global: Vec<Numbers>,
    /// For an axis: whether that depends on run-time values.
    is_symbolic: Vec<bool>,
}

impl Carried {
    /// Lets the normals be those of the axis on one of the bodies, and those that they become on
    /// the others by the least rotation that makes the axes parallel: no rotation where they are,
    /// so that angles start at zero.
    ///
    /// Which body that is, is nobody's business but the engine's, as are the directions: only that
    /// they belong together can be judged.
    pub(crate) fn take_normals_from(&mut self, first: usize, poses: &[Pose]) {
        let Some(&from) = self.global.get(first) else {
            return;
        };
        let pair = if self.is_symbolic[first] {
            normals_without_cases(from)
        } else {
            normals(from)
        };
        let on_bodies = self.global.iter().zip(poses).map(|(&axis, pose)| {
            let sign = if dot(from, axis) < -1e-9 { -1.0 } else { 1.0 };
            let onto = axis.map(|component| sign * component);
            // Rodrigues' formula: the sine's part, and the part along the axis of rotation.
            let (about, cosine) = (cross(from, onto), dot(from, onto));
            let [first, second] = pair.map(|normal| {
                let turned = cross(about, normal);
                let along = dot(about, normal) / (1.0 + cosine);
                [0, 1, 2].map(|k| cosine * normal[k] + turned[k] + along * about[k])
            });
            let second = second.map(|component| sign * component);
            [first, second].map(|normal| pose.local_of(normal))
        });
        self.normals = on_bodies.collect();
    }
}

fn dot(a: Numbers, b: Numbers) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn cross(a: Numbers, b: Numbers) -> Numbers {
    [(1, 2), (2, 0), (0, 1)].map(|(k, l)| a[k] * b[l] - a[l] * b[k])
}

/// A number of a joint.
pub(crate) enum Given {
    Number(f64),
    /// What the definition says.
    Default(Box<Expr>),
}

/// A law.
pub(crate) struct Law {
    pub(crate) name: String,
    pub(crate) arguments: Vec<String>,
    pub(crate) body: Expr,
}

/// A statement of a definition.
pub(crate) enum Statement {
    Let(String, Expr),
    Row(Expr),
    Drive(Expr, Expr),
    Potential(Expr),
    /// Effort and coordinate.
    Along(Expr, Expr),
    /// Force and point.
    Force(Expr, Expr),
    /// Moment and formal body.
    Moment(Expr, Ident),
    /// What is positive on the side that is meant.
    Require(Expr),
    /// What can be read, and moves nothing.
    Reading,
}

/// A joint or a force of a mechanism.
pub(crate) struct Element {
    pub(crate) is_force: bool,
    pub(crate) formal: Vec<String>,
    /// `None` is the ground.
    pub(crate) between: Vec<Option<usize>>,
    pub(crate) vectors: Vec<Carried>,
    pub(crate) numbers: Vec<(String, Given)>,
    pub(crate) laws: Vec<Law>,
    pub(crate) statements: Vec<Statement>,
    /// The angles whose turns the state counts, in its order: from, to, axis.
    pub(crate) turns: Vec<(usize, usize, String)>,
    /// Vector equations that are split along directions fixed on a body where they lose a
    /// component: the first equation, the body's place, the directions in the user's axes.
    pub(crate) components: Vec<(usize, usize, [Numbers; 3])>,
}

/// A mechanism as it is described.
pub(crate) struct Described {
    pub(crate) gravity: Numbers,
    pub(crate) values: Vec<(String, f64)>,
    pub(crate) bodies: Vec<Body>,
    /// Joints, then forces.
    pub(crate) elements: Vec<Element>,
}

/// `key = value` or `key`.
struct Entry {
    key: Ident,
    value: Option<Expr>,
}

impl Parse for Entry {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let key = input.parse()?;
        let value = given(input)?;
        Ok(Self { key, value })
    }
}

/// What stands behind `=`.
fn given(input: ParseStream<'_>) -> syn::Result<Option<Expr>> {
    let equals: Option<Token![=]> = input.parse()?;
    equals.map(|_| input.parse()).transpose()
}

struct Parameter {
    name: String,
    kind: String,
    arguments: Vec<String>,
    default: Option<Expr>,
}

impl Parse for Parameter {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name = input.parse::<Ident>()?.to_string();
        input.parse::<Token![:]>()?;
        let kind = input.parse::<Ident>()?.to_string();
        let mut arguments = Vec::new();
        if input.peek(syn::token::Paren) {
            let inner;
            parenthesized!(inner in input);
            let names = Punctuated::<Ident, Token![,]>::parse_terminated(&inner)?;
            arguments = names.iter().map(ToString::to_string).collect();
        }
        let default = given(input)?;
        Ok(Self {
            name,
            kind,
            arguments,
            default,
        })
    }
}

struct Definition {
    bodies: Vec<String>,
    parameters: Vec<Parameter>,
    statements: Vec<Statement>,
}

impl Parse for Definition {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        input.parse::<Ident>()?;
        let head;
        parenthesized!(head in input);
        let mut bodies = Vec::new();
        while !head.is_empty() && !head.peek(Token![;]) {
            bodies.push(head.parse::<Ident>()?.to_string());
            head.parse::<Option<Token![,]>>()?;
        }
        head.parse::<Option<Token![;]>>()?;
        let parameters = Punctuated::<Parameter, Token![,]>::parse_terminated(&head)?;
        let body;
        braced!(body in input);
        let mut statements = Vec::new();
        while !body.is_empty() {
            statements.push(body.call(statement)?);
            body.parse::<Token![;]>()?;
        }
        Ok(Self {
            bodies,
            parameters: parameters.into_iter().collect(),
            statements,
        })
    }
}

fn statement(input: ParseStream<'_>) -> syn::Result<Statement> {
    if input.peek(Token![let]) {
        input.parse::<Token![let]>()?;
        let name = input.parse::<Ident>()?.to_string();
        input.parse::<Token![=]>()?;
        return Ok(Statement::Let(name, input.parse()?));
    }
    // An expression, unless a word leads one.
    let fork = input.fork();
    if fork.parse::<Expr>().is_ok() {
        let ends = fork.peek(Token![;]);
        if ends || fork.parse::<Ident>().is_ok_and(|word| word == "along") {
            let first: Expr = input.parse()?;
            if ends {
                return Ok(Statement::Row(first));
            }
            input.parse::<Ident>()?;
            return Ok(Statement::Along(first, input.parse()?));
        }
    }
    let word = input.parse::<Ident>()?.to_string();
    if ["motion", "angle", "contact"].contains(&word.as_str()) {
        while !input.peek(Token![;]) {
            input.parse::<TokenTree>()?;
        }
        return Ok(Statement::Reading);
    }
    let first: Expr = input.parse()?;
    Ok(match word.as_str() {
        "displacement" => Statement::Reading,
        "require" => match first {
            Expr::Binary(binary) if matches!(binary.op, BinOp::Gt(_)) => {
                Statement::Require(*binary.left)
            }
            _ => panic!("`> 0` is wanted"),
        },
        "potential" => Statement::Potential(first),
        "drive" => {
            input.parse::<Ident>()?;
            Statement::Drive(first, input.parse()?)
        }
        "force" => {
            input.parse::<Ident>()?;
            Statement::Force(first, input.parse()?)
        }
        "moment" => {
            input.parse::<Ident>()?;
            Statement::Moment(first, input.parse()?)
        }
        other => panic!("no statement begins with `{other}`"),
    })
}

/// What a number of a description is.
pub(crate) fn number(expr: &Expr, values: &Values) -> f64 {
    let of = |expr: &Expr| number(expr, values);
    match expr {
        Expr::Paren(inner) => of(&inner.expr),
        Expr::Group(inner) => of(&inner.expr),
        Expr::Lit(ExprLit { lit, .. }) => match lit {
            Lit::Float(float) => float.base10_parse().expect("a number"),
            Lit::Int(int) => int.base10_parse().expect("a number"),
            _ => panic!("a number is wanted"),
        },
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => -of(&unary.expr),
        Expr::Binary(binary) => {
            let (a, b) = (of(&binary.left), of(&binary.right));
            match binary.op {
                BinOp::Add(_) => a + b,
                BinOp::Sub(_) => a - b,
                BinOp::Mul(_) => a * b,
                BinOp::Div(_) => a / b,
                _ => panic!("no such operation"),
            }
        }
        Expr::Path(path) => {
            let name = path.path.segments.last().expect("a name").ident.to_string();
            // The engine speaks of `__value_of_p0`.
            let name = name.strip_prefix("__value_of_").unwrap_or(&name);
            let known = values.iter().find(|(known, _)| known == name);
            match (known, name) {
                (Some((_, value)), _) => *value,
                (None, "PI") => PI,
                (None, "TAU") => TAU,
                _ => panic!("no number `{name}`"),
            }
        }
        Expr::Call(call) => {
            let Expr::Path(path) = &*call.func else {
                panic!("a function is wanted");
            };
            let name = &path.path.segments.last().expect("a name").ident;
            match (name.to_string().as_str(), &call.args[0]) {
                ("deg", angle) => of(angle).to_radians(),
                ("sqrt", number) => of(number).sqrt(),
                ("sin", angle) => of(angle).sin(),
                ("cos", angle) => of(angle).cos(),
                ("exp", number) => of(number).exp(),
                // What the engine makes of a number that it cannot see:
                // `identity({ let value: f64 = number; value })`.
                ("identity", Expr::Block(block)) => match block.block.stmts.first() {
                    Some(syn::Stmt::Local(local)) => {
                        of(&local.init.as_ref().expect("a value").expr)
                    }
                    _ => panic!("a value is wanted"),
                },
                _ => panic!("no function `{name}`"),
            }
        }
        other => panic!("no number: {}", other.to_token_stream()),
    }
}

fn elements(expr: &Expr) -> Option<Vec<&Expr>> {
    match expr {
        Expr::Array(array) => Some(array.elems.iter().collect()),
        _ => None,
    }
}

fn vector<const N: usize>(expr: &Expr, values: &Values) -> [f64; N] {
    let found = elements(expr).expect("brackets").into_iter();
    let found: Vec<f64> = found.map(|expr| number(expr, values)).collect();
    found.try_into().expect("as many numbers")
}

fn call_of<'a>(expr: &'a Expr, wanted: &str) -> Option<Vec<&'a Expr>> {
    match expr {
        Expr::Call(call) if matches!(&*call.func, Expr::Path(path) if path.path.is_ident(wanted)) => {
            Some(call.args.iter().collect())
        }
        _ => None,
    }
}

/// Whether a run-time value stands in an expression.
fn is_symbolic(expr: &Expr, values: &Values) -> bool {
    let text = expr.to_token_stream().to_string();
    let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    words.any(|word| values.iter().any(|(known, _)| known == word))
}

fn unit<const N: usize>(vector: [f64; N]) -> [f64; N] {
    let length = vector.iter().map(|c| c * c).sum::<f64>().sqrt();
    vector.map(|c| c / length)
}

fn orientation(expr: &Expr, values: &Values) -> [f64; 4] {
    let Some(arguments) = call_of(expr, "rotation") else {
        return unit(vector(expr, values));
    };
    let [x, y, z] = unit(vector::<3>(arguments[0], values));
    let (sine, cosine) = (0.5 * number(arguments[1], values)).sin_cos();
    [cosine, sine * x, sine * y, sine * z]
}

fn inertia(expr: &Expr, values: &Values) -> [Numbers; 3] {
    let rows = elements(expr).expect("brackets");
    if elements(rows[0]).is_some() {
        let rows: Vec<Numbers> = rows.into_iter().map(|row| vector(row, values)).collect();
        return rows.try_into().expect("three rows");
    }
    let [a, b, c] = vector(expr, values);
    [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]]
}

struct Field {
    name: String,
    ty: String,
    word: String,
    entries: Vec<Entry>,
    value: f64,
}

impl Field {
    fn find(&self, key: &str) -> Option<&Expr> {
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        entry.value.as_ref()
    }

    fn vector(&self, key: &str, values: &Values) -> Numbers {
        self.find(key).map_or([0.0; 3], |expr| vector(expr, values))
    }

    fn body(&self, values: &Values) -> Body {
        let turned = self.find("orientation");
        let identity = [1.0, 0.0, 0.0, 0.0];
        Body {
            name: self.name.clone(),
            mass: number(self.find("mass").expect("a mass"), values),
            inertia: self.find("inertia").map(|expr| inertia(expr, values)),
            position: self.vector("position", values),
            orientation: turned.map_or(identity, |expr| orientation(expr, values)),
            velocity: self.vector("velocity", values),
            angular_velocity: self.vector("angular_velocity", values),
            is_symbolic: turned.is_some_and(|expr| is_symbolic(expr, values)),
        }
    }
}

fn entries(attribute: &syn::Attribute) -> Vec<Entry> {
    let list = attribute.parse_args_with(Punctuated::<Entry, Token![,]>::parse_terminated);
    list.expect("a list").into_iter().collect()
}

fn field(field: &syn::Field) -> Field {
    let mut result = Field {
        name: field.ident.as_ref().expect("a name").to_string(),
        ty: field.ty.to_token_stream().to_string(),
        word: String::new(),
        entries: Vec::new(),
        value: 0.0,
    };
    for attribute in &field.attrs {
        match &attribute.meta {
            // What a run-time value is stands in its documentation.
            Meta::NameValue(pair) => {
                if let Expr::Lit(ExprLit {
                    lit: Lit::Str(text),
                    ..
                }) = &pair.value
                {
                    result.value = text.value().trim().parse().expect("a number");
                }
            }
            Meta::Path(path) => result.word = path.get_ident().expect("a word").to_string(),
            Meta::List(list) => {
                result.word = list.path.get_ident().expect("a word").to_string();
                result.entries = entries(attribute);
            }
        }
    }
    result
}

impl Described {
    /// Reads an annotated struct; `find` gives the texts of definitions.
    pub(crate) fn read(item: &TokenStream, find: impl Fn(&str) -> Option<String>) -> Self {
        let input: syn::ItemStruct = syn::parse2(item.clone()).expect("a struct");
        let fields: Vec<Field> = input.fields.iter().map(field).collect();
        let values: Vec<(String, f64)> = fields
            .iter()
            .filter(|field| matches!(field.word.as_str(), "param" | "input"))
            .map(|field| (field.name.clone(), field.value))
            .collect();
        let attributes: Vec<Entry> = input.attrs.iter().flat_map(entries).collect();
        let gravity = attributes.iter().find(|entry| entry.key == "gravity");
        let gravity = gravity.and_then(|entry| entry.value.as_ref());
        let of_word = |word: &'static str| fields.iter().filter(move |field| field.word == word);
        let mut described = Self {
            gravity: gravity.map_or([0.0; 3], |expr| vector(expr, &values)),
            bodies: of_word("body").map(|field| field.body(&values)).collect(),
            elements: Vec::new(),
            values,
        };
        for field in of_word("joint").chain(of_word("force")) {
            let definition = find(&field.ty).expect("a known definition");
            let definition = syn::parse_str(&definition).expect("a definition");
            let element = described.element(field, definition);
            described.elements.push(element);
        }
        described
    }

    fn element(&self, field: &Field, definition: Definition) -> Element {
        let between = elements(field.find("between").expect("bodies")).expect("brackets");
        let between = between.into_iter().map(|expr| {
            let name = expr.to_token_stream().to_string();
            self.bodies.iter().position(|body| body.name == name)
        });
        let mut element = Element {
            is_force: field.word == "force",
            formal: definition.bodies,
            between: between.collect(),
            vectors: Vec::new(),
            numbers: Vec::new(),
            laws: Vec::new(),
            statements: definition.statements,
            turns: Vec::new(),
            components: Vec::new(),
        };
        for parameter in definition.parameters {
            let expr = field.find(&parameter.name);
            let name = parameter.name;
            match parameter.kind.as_str() {
                "Point" | "Axis" | "Vector" => {
                    let expr = expr.expect("a vector");
                    let carried = self.carried(name, &parameter.kind, expr, &element.between);
                    element.vectors.push(carried);
                }
                "Law" => element.laws.push(Law {
                    name,
                    arguments: parameter.arguments,
                    body: expr.expect("a law").clone(),
                }),
                _ => {
                    let given = match expr {
                        Some(expr) => Given::Number(number(expr, &self.values)),
                        None => Given::Default(Box::new(parameter.default.expect("a default"))),
                    };
                    element.numbers.push((name, given));
                }
            }
        }
        element
    }

    fn carried(&self, name: String, kind: &str, expr: &Expr, between: &[Option<usize>]) -> Carried {
        let values = &self.values;
        let (is_point, is_axis) = (kind == "Point", kind == "Axis");
        let local = call_of(expr, "local");
        let poses: Vec<Pose> = between.iter().map(|&body| self.start(body)).collect();
        let copy = |place: usize| {
            let pose = &poses[place];
            let copy = match &local {
                Some(copies) => vector(copies[place], values),
                None => {
                    let given: Numbers = vector(expr, values);
                    let from = pose.position.map(|x| if is_point { x.re } else { 0.0 });
                    pose.local_of([0, 1, 2].map(|k| given[k] - from[k]))
                }
            };
            if is_axis { unit(copy) } else { copy }
        };
        let copies: Vec<Numbers> = (0..poses.len()).map(copy).collect();
        let mut carried = Carried {
            name,
            is_point,
            copies,
            normals: Vec::new(),
            global: Vec::new(),
            is_symbolic: Vec::new(),
        };
        if is_axis {
            for (place, pose) in poses.iter().enumerate() {
                let (global, is_symbolic) = match &local {
                    Some(copies) => (
                        pose.global_of(carried.copies[place]),
                        is_symbolic(copies[place], values)
                            || between[place].is_some_and(|body| self.bodies[body].is_symbolic),
                    ),
                    None => (unit(vector(expr, values)), is_symbolic(expr, values)),
                };
                carried.global.push(global);
                carried.is_symbolic.push(is_symbolic);
            }
            carried.take_normals_from(0, &poses);
        }
        carried
    }

    /// Where a body stands in the reference configuration; `None` is the ground.
    pub(crate) fn start(&self, body: Option<usize>) -> Pose {
        body.map_or_else(Pose::ground, |body| {
            let body = &self.bodies[body];
            Pose::still(body.position, body.orientation)
        })
    }
}
