//! The numbers that the macro cannot see: checked by the compiler where it can evaluate them, else
//! in `parameters`.

use std::collections::HashSet;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::construction::{given_parts, parts};
use crate::check::number::value_name;
use crate::model::{ElementKind, Model, Name, Number, RunTimeValue, Symbol, ValueKind};

/// Numbers that the macro could not see are checked by the compiler where it can evaluate them.
pub fn assertions(model: &Model, facade: &TokenStream) -> TokenStream {
    let mut tokens = TokenStream::new();
    let mut said = HashSet::new();
    for symbol in positive_symbols(model) {
        let Some((constant, value)) = &symbol.constant else {
            continue;
        };
        tokens.extend(quote!(const #constant: f64 = #value;));
        // What the elements of an array have in common is refused once.
        let field = &symbol.field;
        let common = format!("{}.{}: {value}", field.text(), symbol.attribute);
        if field.index().is_some() && !said.insert(common) {
            continue;
        }
        let message = format!(
            "`{}` of `{}` must be positive",
            symbol.attribute, symbol.field
        );
        // At the user's place, where a path would have the meaning of the user's edition.
        tokens.extend(quote::quote_spanned! {symbol.span=>
            const _: () = __holonom_assert!(#constant > 0.0_f64, #message);
        });
    }
    tokens.extend(lengths(model));
    tokens.extend(super::splines::assertions(model, facade));
    let mut known = HashSet::new();
    for part in &model.parts {
        let (path, fingerprint) = (&part.path, Literal::u64_suffixed(part.fingerprint));
        if known.insert(path.to_string()) {
            tokens.extend(quote! {
                const _: () = ::core::assert!(
                    <#path as #facade::__private::Assembly>::FINGERPRINT == #fingerprint,
                    "the type and the definition of an assembly differ; is one of them shadowed?"
                );
            });
        }
    }
    for element in model.elements() {
        let path = &element.path;
        if !known.insert(path.to_string()) {
            continue;
        }
        let definition = model.definition(element);
        let fingerprint = Literal::u64_suffixed(definition.fingerprint);
        let kind = match definition.kind {
            ElementKind::Joint => quote!(Joint),
            ElementKind::Force => quote!(Force),
        };
        tokens.extend(quote! {
            const _: () = ::core::assert!(
                <#path as #facade::__private::#kind>::FINGERPRINT == #fingerprint,
                "the type and the definition of a joint or force differ; is one of them shadowed?"
            );
        });
    }
    tokens
}

/// Constants have the values that the attribute says.
pub(super) fn lengths(model: &Model) -> TokenStream {
    let lengths = model.lengths.iter().map(|(name, length)| {
        let message = format!("`{name}` is not {length}, as `#[mechanism({name} = {length})]` says");
        quote::quote_spanned!(name.span()=> const _: () = ::core::assert!(#name == #length, #message);)
    });
    lengths.collect()
}

fn positive_symbols(model: &Model) -> impl Iterator<Item = &Symbol> {
    model.bodies.iter().flat_map(|body| {
        [body.mass]
            .into_iter()
            .chain(body.inertia)
            .filter_map(|number| match number {
                Number::Symbol(place) | Number::Varying(place) => {
                    Some(&model.symbols[place as usize])
                }
                Number::Literal(_) => None,
            })
    })
}

/// The function `parameters`: run-time values, checked.
pub fn parameters(model: &Model, facade: &TokenStream) -> TokenStream {
    let parts = parts(model).into_iter().map(|(field, _)| field);
    let given = given_parts(model).into_iter().map(|(field, ..)| field);
    let given: Vec<_> = given.collect();
    let parts = parts.chain(&given);
    let checks = checks(model, facade);
    let values = model
        .values
        .iter()
        .map(|value| local_values(model, value, facade));
    let given = super::splines::parameters(model, facade);
    quote! {
        fn parameters<__S: #facade::Scalar>(
            &self,
        ) -> ::core::result::Result<Self::Parameters<__S>, #facade::ParameterError> {
            #( let _ = &self.#parts; )*
            #(#values)*
            #checks
            ::core::result::Result::Ok(#given)
        }
    }
}

/// The local variables of a run-time value.
fn local_values(model: &Model, value: &RunTimeValue, facade: &TokenStream) -> TokenStream {
    let (name, at) = (value_name(&value.name), value.name.place());
    match value.kind {
        ValueKind::Number => {
            let read = read(model, &value.name, facade);
            quote!(let #name: f64 = #read;)
        }
        ValueKind::Setpoint => {
            let [rate, acceleration] = super::splines::derivatives(&name);
            quote! {
                let #facade::mechanism::Setpoint {
                    value: #name, rate: #rate, acceleration: #acceleration,
                } = self.#at;
            }
        }
        ValueKind::Spline(_) => TokenStream::new(),
    }
}

/// How a run-time value of the struct is read. The fields of a part may be private.
pub(super) fn read(model: &Model, name: &Name, facade: &TokenStream) -> TokenStream {
    let Some((field, index)) = name.parts().first() else {
        let place = name.place();
        return quote!(self.#place);
    };
    let top = |other: &Name| other.parts().first() == Some(&(field.clone(), *index));
    let own = model.values.iter().filter(|value| top(&value.name));
    let number = own.take_while(|value| value.name != *name).count();
    let at = index.map(|index| {
        let index = Literal::usize_unsuffixed(index);
        quote!([#index])
    });
    quote!(#facade::__private::Assembly::value(&self.#field #at, #number))
}

/// The checks of `parameters`.
fn checks(model: &Model, facade: &TokenStream) -> TokenStream {
    let (mut tokens, mut splines) = (TokenStream::new(), TokenStream::new());
    let mut refuse = |condition: TokenStream, field: &str, attribute: &str, fault: TokenStream| {
        tokens.extend(quote! {
            if #condition {
                return ::core::result::Result::Err(#facade::ParameterError {
                    field: #field,
                    attribute: #attribute,
                    fault: #facade::__private::ParameterFault::#fault,
                });
            }
        });
    };
    for value in &model.values {
        let (name, field) = (value_name(&value.name), value.name.to_string());
        let mut finite = |name: &proc_macro2::Ident, attribute: &str| {
            let condition = quote!(!f64::is_finite(#name));
            refuse(condition, &field, attribute, quote!(NotFinite));
        };
        match value.kind {
            ValueKind::Number => finite(&name, "value"),
            ValueKind::Setpoint => {
                let [rate, acceleration] = super::splines::derivatives(&name);
                finite(&name, "value");
                finite(&rate, "rate");
                finite(&acceleration, "acceleration");
            }
            ValueKind::Spline(_) => {
                let at = value.name.place();
                splines.extend(quote! {
                    if let ::core::option::Option::Some(__fault) = #facade::spline::Spline::fault(&self.#at) {
                        return ::core::result::Result::Err(#facade::ParameterError {
                            field: #field,
                            attribute: "spline",
                            fault: #facade::__private::ParameterFault::Spline(__fault),
                        });
                    }
                });
            }
        }
    }
    for symbol in model
        .symbols
        .iter()
        .filter(|symbol| symbol.slope_of.is_none())
    {
        let expression = &symbol.expression;
        let condition = quote!(!f64::is_finite(#expression));
        refuse(
            condition,
            &symbol.field.to_string(),
            &symbol.attribute,
            quote!(NotFinite),
        );
    }
    for symbol in positive_symbols(model) {
        let expression = &symbol.expression;
        let condition = quote!((#expression) <= 0.0_f64);
        refuse(
            condition,
            &symbol.field.to_string(),
            &symbol.attribute,
            quote!(NotPositive),
        );
    }
    for (field, attribute, moments) in symbolic_inertias(model) {
        let [a, b, c] = moments;
        let condition = quote!(#facade::__private::is_no_inertia(#a, #b, #c));
        refuse(condition, &field, attribute, quote!(TriangleInequality));
    }
    for (field, attribute, vector) in symbolic_directions(model) {
        let condition = quote!(#facade::__private::is_zero([#(#vector),*]));
        refuse(condition, &field, &attribute, quote!(ZeroLength));
    }
    tokens.extend(splines);
    tokens
}

fn number(model: &Model, number: Number) -> TokenStream {
    match number {
        Number::Literal(value) => quote!(#value),
        Number::Symbol(place) | Number::Varying(place) => {
            model.symbols[place as usize].expression.clone()
        }
    }
}

fn symbolic_inertias(model: &Model) -> Vec<(String, &'static str, [TokenStream; 3])> {
    model
        .bodies
        .iter()
        .filter(|body| body.inertia.iter().any(|moment| moment.literal().is_none()))
        .map(|body| {
            (
                body.name.to_string(),
                "inertia",
                body.inertia.map(|entry| number(model, entry)),
            )
        })
        .collect()
}

/// Axes, and orientations, that hold a symbol.
fn symbolic_directions(model: &Model) -> Vec<(String, String, Vec<TokenStream>)> {
    use crate::model::{Binding, ParameterKind};
    let mut found = Vec::new();
    let symbolic = |numbers: &[Number]| numbers.iter().any(|n| n.literal().is_none());
    for body in model
        .bodies
        .iter()
        .filter(|body| symbolic(&body.orientation))
    {
        let p = body.orientation.map(|entry| number(model, entry)).into();
        found.push((body.name.to_string(), "orientation".into(), p));
    }
    for joint in model.elements() {
        let parameters = &model.definition(joint).parameters;
        for (parameter, binding) in parameters.iter().zip(&joint.bindings) {
            if parameter.kind != ParameterKind::Axis {
                continue;
            }
            let vectors = match binding {
                Binding::Global(vector) => vec![*vector],
                Binding::Local(vectors) => vectors.clone(),
                Binding::Scalar(_) | Binding::Law(_) | Binding::Default => Vec::new(),
            };
            for vector in vectors.iter().filter(|vector| symbolic(*vector)) {
                let vector = vector.map(|entry| number(model, entry)).into();
                found.push((joint.name.to_string(), parameter.name.to_string(), vector));
            }
        }
    }
    found
}
