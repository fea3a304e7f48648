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
                .parse_args_with(Punctuated::<Ident, Token![,]>::parse_terminated)
                .map_err(|error| Error::new(error.span(), format!("{error}; {ACCEPTED}")))?;
            for word in words {
                match &*word.to_string() {
                    "floating" => self.options.floating = true,
                    "passive" => self.options.passive = true,
                    "round_angles" => self.round_angles = true,
                    other => {
                        let message = format!("`{other}` is no option; {ACCEPTED}");
                        let fault = Error::new(word.span(), message);
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

const ACCEPTED: &str = "`floating`, `passive` and `round_angles` are accepted";
