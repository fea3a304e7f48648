//! Names of fields as identifiers of C.

use std::collections::HashSet;

/// Words of C, C++, CUDA and HIP that no identifier may be, and macros of compilers and of
/// `math.h`.
const WORDS: &[&str] = &[
    "and_eq",
    "or_eq",
    "xor_eq",
    "not_eq",
    "wchar_t",
    "char8_t",
    "char16_t",
    "char32_t",
    "static_assert",
    "static_cast",
    "dynamic_cast",
    "const_cast",
    "reinterpret_cast",
    "co_await",
    "co_yield",
    "co_return",
    "consteval",
    "constinit",
    "linux",
    "unix",
    "HUGE_VAL",
    "HUGE_VALF",
    "INFINITY",
    "NAN",
    "errno",
    "NULL",
    "REAL",
    "signbit",
    "isnan",
    "isinf",
    "isfinite",
    "alignas",
    "alignof",
    "and",
    "asm",
    "auto",
    "bitand",
    "bitor",
    "bool",
    "break",
    "case",
    "catch",
    "char",
    "class",
    "compl",
    "concept",
    "const",
    "constexpr",
    "continue",
    "decltype",
    "default",
    "delete",
    "do",
    "double",
    "else",
    "enum",
    "explicit",
    "export",
    "extern",
    "false",
    "float",
    "for",
    "friend",
    "goto",
    "if",
    "inline",
    "int",
    "long",
    "mutable",
    "namespace",
    "new",
    "noexcept",
    "not",
    "nullptr",
    "operator",
    "or",
    "private",
    "protected",
    "public",
    "register",
    "requires",
    "restrict",
    "return",
    "short",
    "signed",
    "sizeof",
    "static",
    "struct",
    "switch",
    "template",
    "this",
    "thread_local",
    "throw",
    "true",
    "try",
    "typedef",
    "typeid",
    "typename",
    "union",
    "unsigned",
    "using",
    "virtual",
    "void",
    "volatile",
    "while",
    "xor",
];

/// A name such as `legs[1].knee` as an identifier: `legs_1_knee`.
pub(crate) fn identifier(name: &str) -> String {
    let mut written = String::new();
    for character in name.chars() {
        if character.is_ascii_alphanumeric() {
            written.push(character);
        } else if !written.is_empty() && !written.ends_with('_') {
            written.push('_');
        }
    }
    let mut written = written.trim_end_matches('_').to_owned();
    if written.is_empty() || written.starts_with(|first: char| first.is_ascii_digit()) {
        written.insert(0, '_');
    }
    if WORDS.contains(&written.as_str()) {
        written.push('_');
    }
    written
}

/// Names that were given, so that none is given twice.
#[derive(Debug, Default)]
pub(crate) struct Names {
    given: HashSet<String>,
}

impl Names {
    /// A name that was not given yet: this one, if it was not, else with a number behind it.
    pub(crate) fn unique(&mut self, name: &str) -> String {
        let mut unique = name.to_owned();
        let mut number = 2;
        while !self.given.insert(unique.clone()) {
            unique = format!("{name}_{number}");
            number += 1;
        }
        unique
    }
}
