//! What laws read besides numbers: splines, and inputs with their derivatives.

use proc_macro2::TokenStream;
use quote::{format_ident, quote, quote_spanned};
use syn::Expr;
use syn::spanned::Spanned;

use super::elements::Found;
use super::later::{Later, Value};
use super::number::{Numbers, value_name};
use crate::diag::Faults;
use crate::model::{Number, Spline, Table, ValueKind, first_further};
use crate::syntax::ungroup;
use crate::syntax::words::local;

/// What is called in a law.
pub(super) enum Called {
    /// A spline by its place.
    Spline(u32),
    /// Nothing that is known.
    Nothing,
    /// Something that was reported.
    Refused,
}

impl Numbers<'_> {
    /// The spline that a law calls: a field, or a constant by its path.
    pub(super) fn spline(&mut self, called: &Expr, faults: &mut Faults) -> Called {
        let table = match self.place(called, faults) {
            Found::At(place) => {
                let value = &self.values[place];
                let ValueKind::Spline(points) = value.kind else {
                    let name = &value.name;
                    faults.at(
                        called,
                        format!("`{name}` is a number; what a law calls is a function or a spline"),
                    );
                    return Called::Refused;
                };
                Table::Value(place, points)
            }
            Found::Refused => return Called::Refused,
            Found::Nothing if !is_constant(called) => return Called::Nothing,
            Found::Nothing => {
                let Some(path) = self.constant(called, faults) else {
                    return Called::Refused;
                };
                let table = self.table(&path);
                Table::Constant(path, table)
            }
        };
        let known = self.splines.iter().position(|known| known.table.is(&table));
        let place = known.unwrap_or_else(|| {
            self.splines.push(Spline {
                table,
                span: called.span(),
            });
            self.splines.len() - 1
        });
        u32::try_from(place).map_or(Called::Refused, Called::Spline)
    }

    /// The names of splines for run time, for messages.
    pub(super) fn spline_names(&self) -> Vec<String> {
        let is_spline = |kind| matches!(kind, ValueKind::Spline(_));
        let values = self.values.iter();
        let splines = values.filter(|value| is_spline(value.kind));
        splines.map(|value| value.name.text().to_owned()).collect()
    }

    /// The table of a constant, as it is read from the mechanism.
    fn table(&self, path: &TokenStream) -> TokenStream {
        let (scope, facade) = (self.field.parts(), self.facade);
        match self.scopes.iter().find(|(known, _)| known == scope) {
            Some((_, owner)) => {
                let number = crate::wire::fingerprint([path]);
                quote!(<#owner as #facade::__private::TableOf<#number>>::TABLE)
            }
            // One of another type is refused where it is named.
            None => quote_spanned!(path.span()=> #facade::spline::Spline::table(&#path)),
        }
    }

    /// The place of an input with its derivatives that an expression names.
    pub(super) fn setpoint(&self, expr: &Expr) -> Option<usize> {
        let is_setpoint = |place: usize| self.values[place].kind == ValueKind::Setpoint;
        if !(0..self.values.len()).any(is_setpoint) {
            return None;
        }
        // Whoever reads the expression reports what is wrong with it.
        let mut faults = Faults::new();
        let found = self.place(expr, &mut faults);
        let _ = faults.into_tokens();
        match found {
            Found::At(place) if is_setpoint(place) => Some(place),
            _ => None,
        }
    }

    /// The value of such an input, its rate and its acceleration.
    pub(super) fn derivatives(&mut self, place: usize, at: &Expr) -> [Number; 3] {
        let further = first_further(&self.values, place);
        let name = value_name(&self.values[place].name);
        let parameters = local("parameters");
        let numbers = [
            (name.clone(), place),
            (format_ident!("{name}_rate"), further),
            (format_ident!("{name}_acceleration"), further + 1),
        ];
        numbers.map(|(name, number)| {
            let later = Later {
                expression: quote!(#name),
                scalar: Some(quote!(#parameters[#number])),
                is_const: false,
                is_varying: true,
                values: vec![place],
                like: None,
            };
            self.number(Value::Later(later), at.span())
        })
    }
}

/// Whether an expression may be a constant of the user: a path that is no single name in small
/// letters, or an element of such a constant.
fn is_constant(expr: &Expr) -> bool {
    match ungroup(expr) {
        Expr::Path(path) => path.path.get_ident().is_none_or(|name| {
            let name = name.to_string();
            name.starts_with("r#") || !name.starts_with(char::is_lowercase)
        }),
        Expr::Index(entry) => is_constant(&entry.expr),
        _ => false,
    }
}
