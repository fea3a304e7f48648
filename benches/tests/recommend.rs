//! What `study recommend` recommends meets the error from starts that it was not tried with:
//! `cargo test --release -p holonom-benches --features large --test recommend`.

#![cfg(feature = "large")]

use std::time::Duration;

use holonom_benches::trade::problem;
use holonom_study::compare::Precision;
use holonom_study::timing::Schedule;
use holonom_study::trade::{
    Choice, Family, Formulated, Grid, PostStabilisation, Processor, Reference, Timing, Wish,
    measure, recommend,
};

/// Problems, and the error that is asked for in the unit of each.
const ASKED: [(&str, f64); 8] = [
    ("pendulum", 1e-4),
    ("slider-crank", 1e-5),
    ("heavy-top", 1e-4),
    ("bricard", 1e-6),
    ("door", 1e-7),
    ("variable-length", 1e-6),
    ("squeezer", 1e-4),
    ("heavy-chain", 1e-4),
];

/// The first number of the starts that nobody has tried.
const UNSEEN: u64 = 1000;

#[test]
fn recommendations_are_right() {
    let grid = Grid {
        formulations: vec![Choice::Given(Formulated::Standard)],
        stabilisations: vec![PostStabilisation::None, PostStabilisation::Projection],
        families: vec![Family::Rk4, Family::DormandPrince, Family::DormandPrince853],
        scalars: vec![Precision::Double],
        most_steps: 20_000.0,
        least_tolerance: 1e-11,
        ..Grid::default()
    };
    let timing = Timing {
        schedule: Schedule {
            rounds: 3,
            turn: Duration::from_millis(1),
        },
        reference_kernel: None,
    };
    let directory = std::env::temp_dir().join(format!("holonom-recommend-{}", std::process::id()));
    let mut wrong = Vec::new();
    for (name, asked) in ASKED {
        let subject = problem(name).expect("a problem");
        let journal = directory.join(name);
        let trade = measure(&*subject, &grid, timing, &journal, |_, _| ()).expect("a trade");
        let on = (Processor::Here, timing);
        let found = recommend(&*subject, &trade, Wish::Error(asked), on, || ());
        let Some(found) = found.expect("references") else {
            panic!("nothing does {asked:e} for {name}");
        };
        let mut worst = 0.0_f64;
        for number in UNSEEN..UNSEEN + 10 {
            let start = subject.start_near(0.01, number).expect("a start nearby");
            let reference = Reference::of(&*subject, Some(&start)).expect("a reference");
            let run = subject.observe(&found.setting, &start).expect("a run");
            worst = worst.max(reference.error_of(&*subject, &run));
        }
        println!(
            "{name}: {}, tried {:.1e}, unseen {worst:.1e}, asked {asked:.0e}; passed over {}",
            found.setting.name(),
            found.worst(),
            found.passed_over.len()
        );
        if worst > asked {
            wrong.push(name);
        }
    }
    std::fs::remove_dir_all(directory).expect("the journals");
    assert!(wrong.is_empty(), "{wrong:?}");
}
