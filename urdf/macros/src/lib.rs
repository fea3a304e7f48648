//! The procedural macro of `holonom::urdf!`: a shim over `holonom-urdf`, whose printed source it
//! puts in place. Depend on `holonom` with its feature `urdf`, which hands it on.

#![forbid(unsafe_code)]

mod expand;
mod input;
mod source;

#[cfg(test)]
mod tests;

use std::env;
use std::path::PathBuf;

use proc_macro::TokenStream;

/// Makes a mechanism of a URDF file; called by `holonom::urdf!`.
#[doc(hidden)]
#[proc_macro]
pub fn urdf_impl(input: TokenStream) -> TokenStream {
    let folder = env::var_os("CARGO_MANIFEST_DIR").map_or_else(PathBuf::new, PathBuf::from);
    expand::expand(input.into(), &folder).into()
}
