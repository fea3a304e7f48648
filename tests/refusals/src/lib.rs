//! Mechanisms and definitions that are refused stand under `tests/ui`, and beside each what the
//! compiler says of it.
#![forbid(unsafe_code)]
