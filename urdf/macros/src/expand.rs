//! From the call to items: the file is read, watched, and printed in place or refused.

use std::fs;
use std::path::Path;

use holonom_urdf::{Faults, Mechanism, Robot};
use proc_macro2::{Span, TokenStream};
use quote::{quote, quote_spanned};

use crate::input::Input;
use crate::source;

/// The struct of the file, which is looked for from the folder of the crate's manifest.
pub(crate) fn expand(tokens: TokenStream, folder: &Path) -> TokenStream {
    let input: Input = match syn::parse2(tokens) {
        Ok(input) => input,
        Err(error) => return error.into_compile_error(),
    };
    let (file, span) = (input.file.value(), input.file.span());
    let path = folder.join(&file);
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) => {
            let message =
                format!("{file}: {error}; a path from the folder of `Cargo.toml` is accepted");
            return refuse(span, &message);
        }
    };
    let watch = watch(&path);
    match mechanism(&text, &input) {
        Ok(mechanism) => {
            let items = source::items(&mechanism, &input);
            quote!(#watch #items)
        }
        Err(faults) => {
            let messages = faults
                .iter()
                .map(|fault| format!("{file}:{}: {}", fault.line, fault.message));
            let refusals = messages.map(|message| refuse(span, &message));
            quote!(#watch #(#refusals)*)
        }
    }
}

fn mechanism(text: &str, input: &Input) -> Result<Mechanism, Faults> {
    let robot = if input.round_angles {
        Robot::parse_rounded(text)
    } else {
        Robot::parse(text)
    };
    robot?.mechanism(&input.options)
}

/// What makes the compiler look whether the file has changed. Nothing of it is in the program.
fn watch(path: &Path) -> Option<TokenStream> {
    // A path that is no text cannot be named in a source.
    let path = path.to_str()?;
    Some(quote!(
        const _: &[::core::primitive::u8] = ::core::include_bytes!(#path);
    ))
}

fn refuse(span: Span, message: &str) -> TokenStream {
    quote_spanned!(span=> ::core::compile_error! { #message })
}
