//! A definition and an annotated struct that uses it, with a line of `===` between them: what is not refused where it is defined can be
//! assembled, and nothing panics.
#![no_main]

use libfuzzer_sys::fuzz_target;
use proc_macro2::TokenStream;
use quote::quote;

fuzz_target!(|text: &str| {
    let Some((definition, item)) = text.split_once("\n===\n") else {
        return;
    };
    let (Ok(definition), Ok(item)) = (
        definition.parse::<TokenStream>(),
        item.parse::<TokenStream>(),
    ) else {
        return;
    };
    // The carriers of a compiler session: a body, a particle, then whatever is defined as a joint and as a force.
    let delivery = quote! {
        [::holonom] [[body] [particle] [joint { #definition }] [force { #definition }]] { #item }
    };
    for output in [
        holonom_engine::derive(item),
        holonom_engine::assemble(delivery),
    ] {
        assert!(!output.to_string().contains("generator failed"), "{text}");
    }
});
