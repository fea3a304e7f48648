//! Text as the content of `joint!` and of `force!`: tokens come out, and none of them reports a
//! panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use proc_macro2::TokenStream;
use quote::quote;

fuzz_target!(|text: &str| {
    let Ok(tokens) = text.parse::<TokenStream>() else {
        return;
    };
    let input = quote!([::holonom] #tokens);
    for output in [
        holonom_engine::joint(input.clone()),
        holonom_engine::force(input),
    ] {
        assert!(!output.to_string().contains("generator failed"), "{text}");
    }
});
