//! Names of fields as identifiers of C.

use std::collections::HashSet;

/// Words of C, C++, CUDA and HIP that no identifier may be, and macros of compilers and of
/// `math.h`, `stdio.h` and `stdlib.h`.
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
    "typeof",
    "typeof_unqual",
    "EOF",
    "BUFSIZ",
    "L_ctermid",
    "L_tmpnam",
    "P_tmpdir",
    "RAND_MAX",
    "MB_CUR_MAX",
    "FOPEN_MAX",
    "FILENAME_MAX",
    "TMP_MAX",
    "EXIT_FAILURE",
    "EXIT_SUCCESS",
    "HUGE",
    "HUGE_VALL",
    "SNAN",
    "SNANF",
    "SNANL",
    "MAXFLOAT",
    "MATH_ERRNO",
    "MATH_ERREXCEPT",
    "math_errhandling",
    "DOMAIN",
    "SING",
    "OVERFLOW",
    "UNDERFLOW",
    "TLOSS",
    "PLOSS",
    "X_TLOSS",
    "stdin",
    "stdout",
    "stderr",
    "i386",
    "BYTE_ORDER",
    "BIG_ENDIAN",
    "LITTLE_ENDIAN",
    "PDP_ENDIAN",
    "FD_SETSIZE",
    "NFDBITS",
    "WCONTINUED",
    "WEXITED",
    "WNOHANG",
    "WNOWAIT",
    "WSTOPPED",
    "WUNTRACED",
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

/// What macros of these headers begin with, and those of `stdint.h` end with, in upper case.
const FAMILIES: &[&str] = &["M_", "FP_", "SEEK_"];
const WIDTHS: &[&str] = &["_MIN", "_MAX", "_WIDTH"];
const INTEGERS: &[&str] = &[
    "INT",
    "UINT",
    "PTRDIFF",
    "SIG_ATOMIC",
    "SIZE",
    "WCHAR",
    "WINT",
];

/// Whether it is a word or a macro.
fn is_reserved(name: &str) -> bool {
    let begins = |word: &&str| {
        let rest = name.strip_prefix(*word);
        rest.is_some_and(|rest| rest.contains(|letter: char| letter.is_ascii_uppercase()))
    };
    let of_integer = || {
        INTEGERS.iter().any(|word| name.starts_with(word))
            && WIDTHS.iter().any(|word| name.ends_with(word))
    };
    WORDS.contains(&name) || FAMILIES.iter().any(begins) || of_integer()
}

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
    if is_reserved(&written) {
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
