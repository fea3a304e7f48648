//! The problems of `study trade`.

#[cfg(feature = "huge")]
use holonom_models::problems::{Chain, Leaf, QuintupleParallelogram, Ring, Squeezer};
#[cfg(feature = "large")]
use holonom_models::problems::{Crank, DoubleParallelogram, Governor, LongPendulum, Slide, Top};
use holonom_models::problems::{Parallelogram, Pendulum};
use holonom_study::trade::{Posed, Subject};

/// All of them with the feature `huge`, most with `large`, two without either: every one is
/// compiled for two descriptions, four formulations and two number types.
#[must_use]
pub fn problems() -> Vec<Box<dyn Subject>> {
    vec![
        Box::new(Posed::in_both(Pendulum::default())),
        Box::new(Posed::in_both(Parallelogram::default())),
        #[cfg(feature = "large")]
        Box::new(Posed::in_both(DoubleParallelogram::default())),
        #[cfg(feature = "huge")]
        Box::new(Posed::in_both(QuintupleParallelogram::default())),
        #[cfg(feature = "large")]
        Box::new(Posed::in_both(LongPendulum::default())),
        #[cfg(feature = "huge")]
        Box::new(Posed::in_both(Squeezer::default())),
        #[cfg(feature = "huge")]
        Box::new(Posed::in_both(Ring::default())),
        #[cfg(feature = "large")]
        Box::new(Posed::in_both(Governor::default())),
        #[cfg(feature = "large")]
        Box::new(Posed::in_both(Top::default())),
        #[cfg(feature = "large")]
        Box::new(Posed::in_both(Slide::default())),
        #[cfg(feature = "large")]
        Box::new(Posed::in_both(Crank::default())),
        #[cfg(feature = "huge")]
        Box::new(Posed::in_both(Chain::default())),
        #[cfg(feature = "huge")]
        Box::new(Posed::in_both(Leaf::default())),
    ]
}

/// Their names.
#[must_use]
pub fn names() -> Vec<String> {
    let problems = problems();
    problems
        .iter()
        .map(|problem| problem.facts().name)
        .collect()
}

/// The problem of a name.
///
/// # Errors
/// The names that there are.
pub fn problem(name: &str) -> Result<Box<dyn Subject>, String> {
    let mut problems = problems();
    match problems
        .iter()
        .position(|problem| problem.facts().name == name)
    {
        Some(place) => Ok(problems.swap_remove(place)),
        None => {
            let more = if cfg!(feature = "huge") {
                ""
            } else if cfg!(feature = "large") {
                "; more with --huge"
            } else {
                "; more with --large, all with --huge"
            };
            Err(format!(
                "there is no problem `{name}` here; there are {}{more}",
                names().join(", ")
            ))
        }
    }
}
