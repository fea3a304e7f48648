//! Splines that laws read: functions that kernels call, and the numbers of those that are given at
//! run time.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote, quote_spanned};

use super::straight_line::{StraightLine, of_spline};
use crate::check::number::value_name;
use crate::model::{Curve, Model, Table, ValueKind, first_further};
use crate::syntax::words::local;

/// The derivatives, as the run time calls them.
const ORDERS: [&str; 3] = ["Value", "Slope", "Curvature"];

/// The functions that evaluate splines, over the constants of a mechanism.
pub(super) fn functions(model: &Model, facade: &TokenStream) -> TokenStream {
    let splines = model.splines.iter().enumerate();
    let functions = splines.flat_map(|(place, spline)| {
        let [constants, x] = ["constants", "x"].map(local);
        let orders = (0_u8..).zip(ORDERS).map(move |(derivative, order)| {
            let name = of_spline(Curve {
                spline: place as u32,
                derivative,
            });
            let order = format_ident!("{order}");
            let order = quote!(#facade::__private::Order::#order);
            let value = match &spline.table {
                Table::Constant(_, table) => {
                    quote!(#facade::__private::Table::evaluate(&#table, #order, #x))
                }
                Table::Value(..) => {
                    let numbers = model.spline_numbers(place);
                    let (first, end) = (numbers.start, numbers.end);
                    quote! {
                        #facade::__private::evaluate_numbers(
                            #constants.get(#first..#end).unwrap_or(&[]), #order, #x,
                        )
                    }
                }
            };
            quote! {
                #[inline]
                fn #name<__S: #facade::Scalar>(#constants: &[__S], #x: __S) -> __S {
                    #value
                }
            }
        });
        orders.collect::<Vec<_>>()
    });
    functions.collect()
}

/// Constants that make no spline are refused by the compiler.
pub(super) fn assertions(model: &Model, facade: &TokenStream) -> TokenStream {
    let splines = model.splines.iter();
    let assertions = splines.filter_map(|spline| {
        let Table::Constant(_, table) = &spline.table else {
            return None;
        };
        Some(quote_spanned! {spline.span=>
            const _: () = match #facade::__private::Table::fault(&#table) {
                ::core::option::Option::None => {}
                ::core::option::Option::Some(fault) => {
                    __holonom_assert!(false, "{}", #facade::__private::SplineFault::sentence(fault))
                }
            };
        })
    });
    assertions.collect()
}

/// What `parameters` gives: the values, and behind them the further numbers of those that are
/// several.
pub(super) fn parameters(model: &Model, facade: &TokenStream) -> TokenStream {
    let values: Vec<TokenStream> = model
        .values
        .iter()
        .map(|value| match value.kind {
            ValueKind::Spline(_) => quote!(0.0_f64),
            ValueKind::Number | ValueKind::Setpoint => {
                let name = value_name(&value.name);
                quote!(#name)
            }
        })
        .collect();
    let count = model.parameters();
    if count == values.len() {
        return quote!([#(__S::constant(#values)),*]);
    }
    let given = local("parameters");
    let further = model.values.iter().enumerate().map(|(place, value)| {
        let first = first_further(&model.values, place);
        let at = value.name.place();
        match value.kind {
            ValueKind::Number => TokenStream::new(),
            ValueKind::Setpoint => {
                let [rate, acceleration] = derivatives(&value_name(&value.name));
                let second = first + 1;
                quote! {
                    #given[#first] = __S::constant(#rate);
                    #given[#second] = __S::constant(#acceleration);
                }
            }
            ValueKind::Spline(_) => {
                let end = first + value.kind.further();
                quote!(#facade::spline::Spline::table(&self.#at).put(&mut #given[#first..#end]);)
            }
        }
    });
    let places = 0..values.len();
    quote! {{
        let mut #given = [__S::constant(0.0); #count];
        #( #given[#places] = __S::constant(#values); )*
        #(#further)*
        #given
    }}
}

/// The local variables that hold the derivatives of an input.
pub(super) fn derivatives(value: &Ident) -> [Ident; 2] {
    ["rate", "acceleration"].map(|word| format_ident!("{value}_{word}"))
}

/// The end of `prepare`: the constants, which begin with the numbers of splines.
pub(super) fn prepared(model: &Model, line: StraightLine) -> TokenStream {
    let StraightLine {
        statements,
        outputs,
    } = line;
    let numbers = model.all_spline_numbers();
    if numbers == 0 {
        return quote!(#statements [#(#outputs),*]);
    }
    let [constants, given] = ["constants", "parameters"].map(local);
    let count = numbers + outputs.len();
    let places = numbers..count;
    let copies = model.splines.iter().enumerate().map(|(spline, described)| {
        let Table::Value(value, _) = described.table else {
            return TokenStream::new();
        };
        let numbers = model.spline_numbers(spline);
        let from = first_further(&model.values, value);
        let (first, end, last) = (numbers.start, numbers.end, from + numbers.len());
        quote!(#constants[#first..#end].copy_from_slice(&#given[#from..#last]);)
    });
    quote! {
        #statements
        let mut #constants = [__S::constant(0.0); #count];
        #(#copies)*
        #( #constants[#places] = #outputs; )*
        #constants
    }
}
