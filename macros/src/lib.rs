//! The procedural macros of `holonom`: a shim over `holonom-engine`. Depend on `holonom`, which
//! hands them on.
#![forbid(unsafe_code)]

use proc_macro::TokenStream;

/// Generates the kernels of the mechanism that the struct describes. See the documentation of
/// `holonom`.
#[proc_macro_derive(
    Mechanism,
    attributes(mechanism, body, joint, force, point, part, port, param, input, state)
)]
pub fn derive_mechanism(input: TokenStream) -> TokenStream {
    holonom_engine::derive(input.into()).into()
}

/// Makes the struct a part that mechanisms may have, once or several times. See the documentation
/// of `holonom`.
#[proc_macro_derive(
    Assembly,
    attributes(mechanism, body, joint, force, point, part, port, param, input, state)
)]
pub fn derive_assembly(input: TokenStream) -> TokenStream {
    holonom_engine::derive_assembly(input.into()).into()
}

/// Defines a joint; called by `holonom::joint!`.
#[doc(hidden)]
#[proc_macro]
pub fn joint_impl(input: TokenStream) -> TokenStream {
    holonom_engine::joint(input.into()).into()
}

/// Defines a force; called by `holonom::force!`.
#[doc(hidden)]
#[proc_macro]
pub fn force_impl(input: TokenStream) -> TokenStream {
    holonom_engine::force(input.into()).into()
}

/// Puts a mechanism together; called by the carriers of its field types.
#[doc(hidden)]
#[proc_macro]
pub fn assemble(input: TokenStream) -> TokenStream {
    holonom_engine::assemble(input.into()).into()
}
