//! Files that a description names, from the folder of the crate in which it is written.

use std::path::PathBuf;

use proc_macro2::{Delimiter, Group, Literal, TokenStream, TokenTree};
use syn::LitStr;

/// The shape whose `file` is a file.
pub const MESH: &str = "mesh";

/// The place of a file that is written in the crate that is compiled.
#[must_use]
pub fn place(file: &str) -> PathBuf {
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    PathBuf::from(folder).join(file)
}

/// The same tokens with files by whole paths: what travels to another crate is looked for here.
#[must_use]
pub fn placed(tokens: TokenStream) -> TokenStream {
    let mut is_mesh = false;
    let all = tokens.into_iter().map(|token| match token {
        TokenTree::Group(group) => {
            let is_call = is_mesh && group.delimiter() == Delimiter::Parenthesis;
            is_mesh = false;
            let stream = placed(group.stream());
            let stream = if is_call { arguments(stream) } else { stream };
            let mut moved = Group::new(group.delimiter(), stream);
            moved.set_span(group.span());
            moved.into()
        }
        other => {
            is_mesh = matches!(&other, TokenTree::Ident(word) if word == MESH);
            other
        }
    });
    all.collect()
}

/// Of `file = "..", ..` the file by its whole path.
fn arguments(tokens: TokenStream) -> TokenStream {
    let mut before = [String::new(), String::new()];
    let all = tokens.into_iter().map(|token| {
        let word = token.to_string();
        let is_file = before == ["file", "="];
        before = [std::mem::take(&mut before[1]), word];
        let written = is_file.then(|| syn::parse2::<LitStr>(token.clone().into()));
        let Some(Ok(written)) = written else {
            return token;
        };
        let whole = place(&written.value());
        let Some(whole) = whole.to_str() else {
            return token;
        };
        let mut literal = Literal::string(whole);
        literal.set_span(token.span());
        literal.into()
    });
    all.collect()
}

#[cfg(test)]
mod tests {
    use quote::quote;

    use super::{place, placed};

    #[test]
    fn files_of_meshes_travel_by_whole_paths() {
        let whole = place("a.stl");
        let whole = whole.to_str().expect("text");
        assert!(whole.len() > "/a.stl".len());
        let found = placed(quote!(#[body(shape = mesh(scale = 1.0, file = "a.stl"))] b: Body));
        let wanted = quote!(#[body(shape = mesh(scale = 1.0, file = #whole))] b: Body);
        assert_eq!(found.to_string(), wanted.to_string());
        let other = quote!(#[body(shape = ball(file = "a.stl"), file = "a.stl")] mesh: Body);
        assert_eq!(placed(other.clone()).to_string(), other.to_string());
    }
}
