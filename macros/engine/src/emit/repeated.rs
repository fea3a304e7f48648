//! Kernels that do the same for many joints or bodies: a function for each thing that is done, and
//! a table of what it is done with.
//!
//! Straight-line code grows with the number of bodies, and so does the time to compile it. Called
//! once in a step it runs no faster, because it does not stay in the instruction cache.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::store::Store;
use super::straight_line::{Environment, StraightLine, Value, write};
use crate::model::mechanism::Layout;
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::equations::Kernel;
use crate::symbolic::repeated::{Leaf, Repeated, Shape};
use crate::syntax::words::local;

/// A kernel that is written so.
pub(super) struct Calls {
    /// What a function that calls them begins with, once the arrays have their names; it ends with
    /// the outputs, an array of this name.
    pub(super) statements: TokenStream,
    pub(super) gathered: Ident,
    /// The functions beside it.
    pub(super) functions: TokenStream,
}

/// The arrays that are given, as slices, and the place of an input in them.
pub(super) struct Given {
    pub(super) slices: [TokenStream; 4],
    pub(super) place: Box<dyn Fn(Input) -> Option<(usize, usize)>>,
}

/// The place among what is given of the constants.
const CONSTANTS: usize = 2;

impl Given {
    /// The arrays of a kernel that reads the state of the bodies.
    pub(super) fn of_bodies(has_time: bool) -> Self {
        let [coordinates, velocities, constants, time] =
            ["coordinates", "velocities", "constants", "time"].map(local);
        let time = if has_time {
            quote!(::core::slice::from_ref(&#time))
        } else {
            quote!(&[])
        };
        Self {
            slices: [
                quote!(&#coordinates[..]),
                quote!(&#velocities[..]),
                quote!(&#constants[..]),
                time,
            ],
            place: Box::new(move |input| match input {
                Input::Coordinate(place) => Some((0, place as usize)),
                Input::Velocity(place) => Some((1, place as usize)),
                Input::Time if has_time => Some((3, 0)),
                _ => None,
            }),
        }
    }

    /// The arrays of a kernel that reads joint coordinates.
    pub(super) fn of_joints(turns: usize) -> Self {
        let [pairs, rest, velocities, constants] =
            ["pairs", "rest", "velocities", "constants"].map(local);
        Self {
            slices: [
                quote!(#pairs.as_flattened()),
                quote!(&#velocities[..]),
                quote!(&#constants[..]),
                quote!(&#rest[..]),
            ],
            place: Box::new(move |input| match input {
                Input::Coordinate(place) => match (place as usize).checked_sub(2 * turns) {
                    Some(place) => Some((3, place)),
                    None => Some((0, place as usize)),
                },
                Input::Velocity(place) => Some((1, place as usize)),
                _ => None,
            }),
        }
    }
}

/// Tells the coordinates and velocities of one body apart.
pub(super) fn of_body(layout: &Layout) -> impl Fn(Input) -> u64 {
    let [coordinate, velocity] = [&layout.coordinate, &layout.velocity].map(Clone::clone);
    let end = layout.coordinates;
    let within = |firsts: &[usize], place: u32| {
        let place = place as usize;
        let first = firsts.iter().rev().find(|&&first| first <= place);
        place - first.copied().unwrap_or(0)
    };
    move |input| match input {
        Input::Coordinate(place) if place as usize >= end => 1,
        Input::Coordinate(place) => 2 + within(&coordinate, place) as u64,
        Input::Velocity(place) => 10 + within(&velocity, place) as u64,
        _ => 0,
    }
}

/// Tells cosine, sine, further coordinates and rates of joints apart.
pub(super) fn of_joint(turns: usize) -> impl Fn(Input) -> u64 {
    move |input| match input {
        Input::Coordinate(place) if (place as usize) < 2 * turns => 1 + u64::from(place % 2),
        Input::Coordinate(_) => 3,
        Input::Velocity(_) => 4,
        _ => 0,
    }
}

/// Writes a kernel by its calls. `None` where it reads what is not given.
pub(super) fn written(
    name: &str,
    (arena, repeated): (&Arena, &Repeated),
    given: &Given,
    store: &mut Store,
    facade: &TokenStream,
) -> Option<Calls> {
    let mut codes = Codes {
        arena,
        given,
        store,
        literals: Vec::new(),
    };
    let mut calls = Vec::new();
    for (shape, arguments) in &repeated.calls {
        let shape = *shape as u32;
        let arguments = codes.all(arguments)?;
        calls.push(quote!((#shape, &[#(#arguments),*])));
    }
    let outputs = codes.all(&repeated.outputs)?;
    let literals = codes.literals;
    let (functions, arms) = shapes(name, repeated, facade);
    let [values, next, sources, codes, gathered] =
        ["values", "next", "sources", "codes", "gathered"].map(local);
    let called = local("called");
    let slices = &given.slices;
    let (length, count) = (repeated.values, outputs.len());
    let statements = quote! {
        const __CALLS: &[(u32, &[u32])] = &[#(#calls),*];
        let #sources = #facade::__private::Sources {
            given: [#(#slices),*],
            literals: &[#(#literals),*],
        };
        let mut #values = [__S::constant(0.0); #length];
        let mut #next = 0;
        for &(#called, #codes) in __CALLS {
            #next = match #called {
                #(#arms)*
                _ => #next,
            };
        }
        let #gathered: [__S; #count] = #sources.gathered(&#values, &[#(#outputs),*]);
    };
    Some(Calls {
        statements,
        gathered,
        functions,
    })
}

/// Writes kernels of which one is called, by the place of its joint: `gathered` is then an option
/// of an array and of how many elements of it are meant.
pub(super) fn written_each(
    name: &str,
    (places, kernels): (&[usize], &[&Kernel]),
    repeated: &Repeated,
    given: &Given,
    store: &mut Store,
    facade: &TokenStream,
) -> Option<Calls> {
    let mut literals = Vec::new();
    let mut calls = Vec::new();
    let mut first = 0;
    let each = places.iter().zip(kernels).zip(&repeated.calls);
    for ((place, kernel), (shape, arguments)) in each {
        let mut codes = Codes {
            arena: &kernel.arena,
            given,
            store,
            literals,
        };
        let end = first + kernel.outputs.len();
        let shape = *shape as u32;
        let arguments = codes.all(arguments)?;
        let outputs = codes.all(&repeated.outputs[first..end])?;
        calls.push(quote!((#place, #shape, &[#(#arguments),*], &[#(#outputs),*])));
        first = end;
        literals = codes.literals;
    }
    let (functions, arms) = shapes(name, repeated, facade);
    let [values, next, sources, codes, gathered] =
        ["values", "next", "sources", "codes", "gathered"].map(local);
    let [called, joint, place, outputs] = ["called", "joint", "place", "outputs"].map(local);
    let slices = &given.slices;
    let length = repeated.values;
    let most = kernels.iter().map(|kernel| kernel.outputs.len()).max()?;
    let statements = quote! {
        const __CALLS: &[(usize, u32, &[u32], &[u32])] = &[#(#calls),*];
        let #sources = #facade::__private::Sources {
            given: [#(#slices),*],
            literals: &[#(#literals),*],
        };
        let mut #gathered = ::core::option::Option::None;
        for &(#place, #called, #codes, #outputs) in __CALLS {
            if #place == #joint {
                let mut #values = [__S::constant(0.0); #length];
                let #next = 0;
                match #called {
                    #(#arms)*
                    _ => 0,
                };
                let #values: [__S; #most] = #sources.gathered(&#values, #outputs);
                #gathered = ::core::option::Option::Some((#values, #outputs.len()));
            }
        }
    };
    Some(Calls {
        statements,
        gathered,
        functions,
    })
}

/// The functions of all shapes, and the arms that call them.
fn shapes(
    name: &str,
    repeated: &Repeated,
    facade: &TokenStream,
) -> (TokenStream, Vec<TokenStream>) {
    let [values, next, sources, codes] = ["values", "next", "sources", "codes"].map(local);
    let (mut functions, mut arms) = (TokenStream::new(), Vec::new());
    for (number, shape) in repeated.shapes.iter().enumerate() {
        let named = format_ident!("__{name}_of_{number}");
        functions.extend(function(&named, shape, facade));
        let number = number as u32;
        arms.push(quote! {
            #number => #sources.call((&mut #values, #next), #codes, #named::<__S>),
        });
    }
    (functions, arms)
}

struct Codes<'a> {
    arena: &'a Arena,
    given: &'a Given,
    store: &'a mut Store,
    literals: Vec<f64>,
}

impl Codes<'_> {
    fn all(&mut self, leaves: &[Leaf]) -> Option<Vec<u32>> {
        leaves.iter().map(|&leaf| self.code(leaf)).collect()
    }

    /// As the run-time crate reads it.
    fn code(&mut self, leaf: Leaf) -> Option<u32> {
        let (source, place, is_negative) = match leaf {
            Leaf::Value { place, is_negative } => (0, place, is_negative),
            Leaf::Input { input, is_negative } => {
                let (source, place) = (self.given.place)(input)?;
                (1 + source, place, is_negative)
            }
            Leaf::Literal(value) => {
                let known = self.literals.iter().position(|known| *known == value.abs());
                let place = known.unwrap_or_else(|| {
                    self.literals.push(value.abs());
                    self.literals.len() - 1
                });
                (5, place, value < 0.0)
            }
            Leaf::Earlier(value) => {
                let (is_coefficient, place, is_negative) = self.store.place(self.arena, value);
                if is_coefficient {
                    return None;
                }
                (1 + CONSTANTS, place, is_negative)
            }
        };
        let place = u32::try_from(place).ok().filter(|place| *place < 1 << 27)?;
        Some((source as u32) << 28 | u32::from(is_negative) << 27 | place)
    }
}

/// The function of a shape.
fn function(name: &Ident, shape: &Shape, facade: &TokenStream) -> TokenStream {
    let StraightLine {
        statements,
        outputs,
    } = write(&shape.arena, &shape.outputs, Stage::State, &mut Arguments);
    let (count, results) = (shape.arguments, outputs.len());
    let arguments = local("arguments");
    let names = (0..count).map(argument);
    quote! {
        #[inline(never)]
        fn #name<__S: #facade::Scalar>(#arguments: &[__S; #count]) -> [__S; #results] {
            let [#(#names),*] = *#arguments;
            #statements
            [#(#outputs),*]
        }
    }
}

fn argument(place: usize) -> Ident {
    local(&format!("argument_{place}"))
}

struct Arguments;

impl Environment for Arguments {
    fn input(&mut self, input: Input) -> TokenStream {
        let Input::Coordinate(place) = input else {
            unreachable!("arguments are coordinates of the arena of a function")
        };
        let argument = argument(place as usize);
        quote!(#argument)
    }

    fn earlier(&mut self, _: &Arena, _: Expr) -> Value {
        unreachable!("arguments are known with the state")
    }
}
