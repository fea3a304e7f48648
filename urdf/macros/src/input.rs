//! What stands in `urdf!`: a struct, its file, options, and fields beside those of the file.

use holonom_urdf::Options;
use proc_macro2::{Ident, TokenStream, TokenTree};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Error, Field, FieldsNamed, LitStr, Token, Visibility, token};

#[derive(Debug)]
pub(crate) struct Input {
    /// The path of the crate `holonom`.
    pub(crate) facade: TokenStream,
    /// What the user's struct has, but `#[urdf(..)]`.
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) visibility: Visibility,
    pub(crate) name: Ident,
    pub(crate) file: LitStr,
    pub(crate) fields: Punctuated<Field, Token![,]>,
    pub(crate) options: Options,
    pub(crate) round_angles: bool,
}

impl Parse for Input {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let Ok(TokenTree::Group(facade)) = input.parse() else {
            return Err(Error::new(
                input.span(),
                "this macro is called by `holonom::urdf!` only",
            ));
        };
        let all = Attribute::parse_outer(input)?;
        let visibility = input.parse()?;
        input.parse::<Token![struct]>()?;
        let name: Ident = input.parse()?;
        if !input.peek(Token![=]) {
            let message = format!("`struct {name}` has no file; `= \"robot.urdf\"` is accepted");
            return Err(input.error(message));
        }
        input.parse::<Token![=]>()?;
        let file = input.parse()?;
        let fields = if input.peek(token::Brace) {
            input.parse::<FieldsNamed>()?.named
        } else {
            input.parse::<Token![;]>()?;
            Punctuated::new()
        };
        if !input.is_empty() {
            return Err(input.error("one struct is accepted; call `urdf!` again for another file"));
        }
        let (own, attributes) = all.into_iter().partition(|one| one.path().is_ident("urdf"));
        let mut read = Self {
            facade: facade.stream(),
            attributes,
            visibility,
            name,
            file,
            fields,
            options: Options::default(),
            round_angles: false,
        };
        read.take_options(&own)?;
        Ok(read)
    }
}

impl Input {
    /// The words of `#[urdf(..)]`. All that are unknown are reported.
    fn take_options(&mut self, attributes: &[Attribute]) -> syn::Result<()> {
        let mut faults: Option<Error> = None;
        for attribute in attributes {
            let words = attribute
                .parse_args_with(Punctuated::<Word, Token![,]>::parse_terminated)
                .map_err(|error| Error::new(error.span(), format!("{error}; {ACCEPTED}")))?;
            for Word { name, value } in words {
                let value = value.as_ref().map(LitStr::value);
                match (&*name.to_string(), value.as_deref()) {
                    ("floating", None) => self.options.floating = true,
                    ("passive", None) => self.options.passive = true,
                    ("round_angles", None) => self.round_angles = true,
                    ("inertia", Some("as given")) => self.options.accept_inertia = true,
                    (other, value) => {
                        let value = value.map_or(String::new(), |value| format!(" = {value:?}"));
                        let message = format!("`{other}{value}` is no option; {ACCEPTED}");
                        let fault = Error::new(name.span(), message);
                        match &mut faults {
                            Some(all) => all.combine(fault),
                            None => faults = Some(fault),
                        }
                    }
                }
            }
        }
        faults.map_or(Ok(()), Err)
    }
}

const ACCEPTED: &str =
    "`floating`, `passive`, `round_angles` and `inertia = \"as given\"` are accepted";

/// An option, which may have a value.
struct Word {
    name: Ident,
    value: Option<LitStr>,
}

impl Parse for Word {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name = input.parse()?;
        let equals: Option<Token![=]> = input.parse()?;
        let value = equals.map(|_| input.parse()).transpose()?;
        Ok(Self { name, value })
    }
}
