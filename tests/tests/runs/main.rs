//! Whole runs, judged by closed forms, by published references and by what must not happen.

#![forbid(unsafe_code)]

mod accuracy;
mod all_methods;
mod chapter15;
mod dependent;
mod derived;
mod descriptions;
mod direct;
mod faults;

mod forces;
mod generalized_alpha;
mod inputs;
mod kinematics;
mod low_order;
mod observer;
mod order;
mod pendulum;
mod placing;
mod properties;
mod rates;
mod reactions;
mod redundant;
mod references;
mod refusals;
mod scales;
mod single_precision;
mod singular;
mod steps;
mod treatments;
