//! What symbols change by with the run-time values that are in them, as symbols of their own.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::model::{Asked, Model, Symbol};
use crate::syntax::words::local;

/// Adds them for all values by which there are derivatives. Nothing is refused.
pub fn add(model: &mut Model, facade: &TokenStream) {
    if !model.asked.contains(&Asked::Derivatives) {
        return;
    }
    let (known, values) = (model.symbols.len(), model.derived_values());
    for value in values {
        for place in 0..known {
            let symbol = &model.symbols[place];
            let Some(scalar) = &symbol.scalar else {
                continue;
            };
            if symbol.itself == Some(value) || !symbol.values.contains(&value) {
                continue;
            }
            let scalar = slope(scalar, value, model.parameters(), facade);
            let symbol = Symbol {
                scalar: Some(scalar),
                itself: None,
                slope_of: Some((place, value)),
                like: None,
                constant: None,
                ..symbol.clone()
            };
            model.symbols.push(symbol);
        }
    }
}

/// The slope of an expression over the scalar `__S`: it is evaluated over numbers that carry a
/// derivative.
fn slope(scalar: &TokenStream, value: usize, count: usize, facade: &TokenStream) -> TokenStream {
    let (of, given) = (local("of"), local("parameters"));
    let count = Literal::usize_unsuffixed(count);
    quote! {{
        fn #of<__S: #facade::Scalar>(#given: &[__S; #count]) -> __S {
            #scalar
        }
        #facade::__private::slope(#of, #given, #value)
    }}
}
