//! Problems that nothing can be made of, that begin in the origin, or whose equations depend on
//! each other.

use super::*;

/// A block that hangs on a spring, with all that a problem can have wrong.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Block {
    #[param]
    stiffness: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    guide: holonom::joints::Prismatic,
    #[force(between = [ground, block], head = [0.0, 0.0, 2.0], tail = [0.0, 0.0, 0.0], stiffness = stiffness, free_length = 1.9)]
    spring: holonom::forces::SpringDamper,
}

/// What is known at a time (s).
type Known = fn(f64) -> Option<Vec<f64>>;

struct Hanging {
    block: Block,
    name: &'static str,
    span: [f64; 3],
    time_scale: f64,
    read: usize,
    known: Option<Known>,
}

impl Hanging {
    fn new(stiffness: f64) -> Self {
        Self {
            block: Block::new(stiffness).unwrap(),
            name: "block",
            span: [0.0, 2.0, 0.25],
            time_scale: 1.0,
            read: 1,
            known: None,
        }
    }
}

impl Problem for Hanging {
    type Mechanism = Block;

    fn name(&self) -> &str {
        self.name
    }

    fn mechanism(&self) -> &Block {
        &self.block
    }

    fn span(&self) -> TimeSpan<f64> {
        let [start, end, first_output] = self.span;
        TimeSpan {
            start,
            end,
            first_output,
        }
    }

    fn time_scale(&self) -> f64 {
        self.time_scale
    }

    fn quantity(&self) -> Quantity {
        Quantity {
            name: "height",
            unit: "m",
        }
    }

    fn read<S: Real>(&self, view: &View<'_, S, Block>) -> Vec<f64> {
        vec![view.pose(Block::HANDLES.block).position.z.to_f64(); self.read]
    }

    fn reference(&self, time: f64) -> Option<Vec<f64>> {
        self.known.and_then(|known| known(time))
    }
}

#[test]
fn another_mechanism_or_another_reference_is_measured_anew() {
    let directory = scratch("stale");
    let path = directory.join("journal");
    let errors = |hanging: Hanging| -> Vec<f64> {
        let trade = measure(
            &Posed::in_both(hanging),
            &grid(),
            timing(),
            &path,
            |_, _| (),
        )
        .unwrap();
        trade.rows.iter().map(|row| row.error).collect()
    };
    let soft = errors(Hanging::new(40.0));
    assert_eq!(errors(Hanging::new(40.0)), soft);
    assert_ne!(errors(Hanging::new(400.0)), soft);
    let known = Hanging {
        known: Some(|_| Some(vec![1.0])),
        ..Hanging::new(40.0)
    };
    assert!(errors(known).iter().all(|error| *error > 0.9));
    fs::remove_dir_all(&directory).unwrap();
}

#[test]
fn problems_that_nothing_can_be_made_of_are_refused() {
    let directory = scratch("refused");
    let reason = |hanging: Hanging| {
        let path = directory.join("journal");
        let outcome = measure(
            &Posed::in_both(hanging),
            &grid(),
            timing(),
            &path,
            |_, _| (),
        );
        outcome.unwrap_err().to_string()
    };
    let new = || Hanging::new(40.0);
    for (hanging, part) in [
        (
            Hanging {
                name: "../escaped",
                ..new()
            },
            "no name of a file",
        ),
        (Hanging { name: "", ..new() }, "no name of a file"),
        (
            Hanging {
                span: [0.0, 0.0, 1.0],
                ..new()
            },
            "no interval",
        ),
        (
            Hanging {
                span: [1.0, 0.0, 1.0],
                ..new()
            },
            "no interval",
        ),
        (
            Hanging {
                span: [0.0, f64::INFINITY, 1.0],
                ..new()
            },
            "no interval",
        ),
        (
            Hanging {
                span: [0.0, 1.0, 0.0],
                ..new()
            },
            "reports every 0 s",
        ),
        (
            Hanging {
                span: [0.0, 1.0, 1e-12],
                ..new()
            },
            "are kept",
        ),
        (
            Hanging {
                time_scale: f64::NAN,
                ..new()
            },
            "time scale",
        ),
        (
            Hanging {
                time_scale: 0.0,
                ..new()
            },
            "time scale",
        ),
        (Hanging { read: 0, ..new() }, "nothing is read"),
        (
            Hanging {
                known: Some(|_| Some(vec![0.0; 2])),
                ..new()
            },
            "the reference 2",
        ),
        (
            Hanging {
                known: Some(|_| Some(vec![f64::NAN])),
                ..new()
            },
            "not finite",
        ),
        (
            Hanging {
                known: Some(|time| (time == 0.0).then(|| vec![0.0])),
                ..new()
            },
            "at the start alone",
        ),
    ] {
        let reason = reason(hanging);
        assert!(reason.contains(part), "{reason}");
    }
    for endless in [
        Grid {
            most_steps: f64::INFINITY,
            ..grid()
        },
        Grid {
            least_tolerance: 0.0,
            ..grid()
        },
    ] {
        let path = directory.join("journal");
        assert!(measure(&Posed::in_both(new()), &endless, timing(), &path, |_, _| ()).is_err());
    }
}

#[test]
fn a_block_in_the_origin_starts_nearby_too_and_is_not_warned_of() {
    let subject = Posed::in_both(Hanging::new(40.0));
    let own = subject.start().unwrap();
    let near = subject.start_near(0.01, 1).unwrap();
    let moved = own.0.iter().zip(&near.0).map(|(a, b)| (a - b).abs());
    assert!(moved.fold(0.0, f64::max) > 1e-4);
    for by in [Coordinates::Bodies, Coordinates::Joints] {
        let run = subject
            .observe(&setting(by, Family::Rk4, 0.02), &own)
            .unwrap();
        assert_eq!(run.warnings, Vec::<String>::new());
    }
}

#[test]
fn wishes_are_positive() {
    let directory = scratch("wishes");
    let subject = falling();
    let path = directory.join("journal");
    let trade = measure(&subject, &grid(), timing(), &path, |_, _| ()).unwrap();
    let on = (Processor::Here, timing());
    for wish in [
        Wish::Error(0.0),
        Wish::Error(f64::NAN),
        Wish::Budget(-1.0),
        Wish::Budget(f64::INFINITY),
    ] {
        assert!(recommend(&subject, &trade, wish, on, || ()).is_err());
    }
    fs::remove_dir_all(&directory).unwrap();
}

/// A door on two hinges of which the equations of the second are kept.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "keep", coordinates = "both")]
struct Door {
    #[body(mass = 1.0, inertia = [0.3, 0.1, 0.4], position = [0.4, 0.0, 0.0])]
    leaf: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.0, -0.5], axis = [0.0, 0.0, 1.0])]
    lower: Revolute,
    #[joint(between = [ground, leaf], point = [0.0, 0.0, 0.5], axis = [0.0, 0.0, 1.0])]
    upper: Revolute,
}

struct Shutting(Door);

impl Problem for Shutting {
    type Mechanism = Door;

    fn name(&self) -> &str {
        "door"
    }

    fn mechanism(&self) -> &Door {
        &self.0
    }

    fn span(&self) -> TimeSpan<f64> {
        TimeSpan {
            start: 0.0,
            end: 1.0,
            first_output: 0.5,
        }
    }

    fn time_scale(&self) -> f64 {
        1.0
    }

    fn quantity(&self) -> Quantity {
        Quantity {
            name: "angle",
            unit: "rad",
        }
    }

    fn read<S: Real>(&self, view: &View<'_, S, Door>) -> Vec<f64> {
        vec![view.angle(Door::HANDLES.lower).to_f64()]
    }
}

#[test]
fn equations_that_are_kept_are_studied_with_a_compliance() {
    let directory = scratch("kept");
    let subject = Posed::in_both(Shutting(Door::default()));
    let reference = Reference::of(&subject, None).unwrap();
    assert!(reference.error < 1e-9, "{:e}", reference.error);
    let grid = Grid {
        coordinates: vec![Coordinates::Bodies],
        formulations: vec![
            Choice::Derived(Method::Standard),
            Choice::Derived(Method::AugmentedLagrangian),
        ],
        stabilisations: vec![PostStabilisation::None],
        scalars: vec![Precision::Double],
        ..grid()
    };
    let path = directory.join("journal");
    let trade = measure(&subject, &grid, timing(), &path, |_, _| ()).unwrap();
    assert!(!trade.rows.is_empty() && !trade.stopped.is_empty());
    let compliant = trade
        .rows
        .iter()
        .all(|row| row.setting.formulation == "augmented-lagrangian");
    assert!(compliant, "{:?}", trade.rows);
    assert_ne!(
        subject.start_near(0.01, 1).unwrap(),
        subject.start().unwrap()
    );
    fs::remove_dir_all(&directory).unwrap();
}
