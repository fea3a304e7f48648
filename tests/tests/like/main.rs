//! Parameters that say what they are like: mechanisms with redundant equations whose lengths are
//! given when the program runs.

mod four_bar;
mod refused;
mod slider_crank;
mod squeezing;
mod twins;
