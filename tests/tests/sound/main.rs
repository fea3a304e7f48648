//! Results that were once wrong without a word: each is right now, or refused, or doubted by the
//! report.

#![forbid(unsafe_code)]

mod between;
mod clock;
mod digits;
mod lag;
mod limits;
mod orientation;
mod origins;
mod outside;
mod readings;
mod start;
mod turns;
