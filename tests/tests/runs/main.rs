//! Whole runs, judged by closed forms and by what must not happen.

#![forbid(unsafe_code)]

mod derived;
mod faults;
mod flat;
mod forces;
mod inputs;
mod inverse;
mod kinematics;
mod markers;
mod observer;
mod properties;
mod rates;
mod reactions;
mod refusals;
mod stabilisations;
mod steps;

use holonom_fixtures as _;
