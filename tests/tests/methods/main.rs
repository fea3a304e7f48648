//! Methods of integration: their orders, what they hold to, what they cannot do.

#![forbid(unsafe_code)]

mod accuracy;
mod all_methods;
mod chapter15;
mod direct;
mod generalized_alpha;
mod low_order;
mod order;
mod pendulum;
mod single_precision;
mod singular;

use holonom_fixtures as _;
