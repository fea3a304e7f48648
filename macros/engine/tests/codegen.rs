//! Generated code, plans and counts, as they are; a change of these files is a change to be looked
//! at.

mod common;

use common::{FAULTY, PENDULUM, SCENES, chain, generated, model, tokens};
use holonom_engine::emit::report::{costs, describe};
use holonom_engine::plan::candidates::choose;
use holonom_engine::plan::kernels::{Kernels, evaluation};
use holonom_engine::plan::system::Terms;
use holonom_engine::symbolic::arena::Stage;
use holonom_engine::symbolic::count::count;
use syn::{Block, Expr, File, Item, Stmt};

/// The function of a name in the block that holds everything generated for a mechanism.
fn function(file: File, name: &str) -> File {
    let functions = file.items.into_iter().filter_map(|item| match item {
        Item::Const(item) => match *item.expr {
            Expr::Block(block) => Some(block.block),
            _ => None,
        },
        _ => None,
    });
    let items = functions
        .flat_map(|Block { stmts, .. }| stmts)
        .filter_map(|statement| match statement {
            Stmt::Item(Item::Fn(item)) if item.sig.ident == name => Some(Item::Fn(item)),
            _ => None,
        })
        .collect();
    File {
        items,
        ..syn::parse_quote!()
    }
}

#[test]
fn the_pendulum_in_one_straight_line() {
    let file = generated(&tokens(PENDULUM));
    let code = prettyplease::unparse(&function(file, "__evaluate_plain"));
    insta::assert_snapshot!("pendulum", code);
}

#[test]
fn plans_and_counts() {
    let mut text = String::new();
    for (name, item) in SCENES {
        let model = model(&tokens(item));
        let kernels = Kernels::new(&model);
        let plan = describe(
            &model,
            &kernels.plans.as_ref().expect("bodies are fused").rigid,
            &model.layout(),
        );
        text += &format!("{name}\n  {plan}\n");
        for (kernel, cost) in costs(&kernels) {
            let count = cost.count;
            text += &format!(
                "  {kernel}: {} = {} + {} * {} / {} sqrt, depth {}\n",
                count.total(),
                count.additions,
                count.multiplications,
                count.divisions,
                count.square_roots,
                count.depth
            );
        }
    }
    insta::assert_snapshot!("counts", text);
}

/// Three rods on four hinges; one of the equations' sets that follow from the others is left out.
const FOUR_BAR: &str = "#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = \"drop\")] struct FourBar {
    #[body(mass = 1.0, inertia = [0.0833, 0.0833, 0.001], position = [0.0, 0.0, 0.5])] left: Body,
    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 1.0])] top: Body,
    #[body(mass = 1.0, inertia = [0.0833, 0.0833, 0.001], position = [0.0, 1.0, 0.5])] right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])] first: Revolute,
    #[joint(between = [left, top], point = [0.0, 0.0, 1.0], axis = [1.0, 0.0, 0.0])] second: Revolute,
    #[joint(between = [ground, right], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])] third: Revolute,
    #[joint(between = [right, top], point = [0.0, 1.0, 1.0], axis = [1.0, 0.0, 0.0])] fourth: Revolute,
}";

#[test]
fn chains_and_a_loop() {
    let scenes = [
        ("2 rods on ball joints", chain("Spherical", 2, false)),
        ("8 rods on ball joints", chain("Spherical", 8, false)),
        ("2 rods on hinges", chain("Revolute", 2, false)),
        ("8 rods on hinges", chain("Revolute", 8, false)),
        ("four-bar", FOUR_BAR.into()),
    ];
    let mut text = String::new();
    for (name, item) in scenes {
        let model = model(&tokens(&item));
        let plans = choose(&model);
        text += &format!("{name}\n");
        for terms in Terms::ALL {
            let kernel = evaluation(&model, plans.of(terms), terms).kernel;
            let count = count(&kernel.arena, &kernel.outputs, Stage::State);
            text += &format!(
                "  {terms:?}: {} operations, {} of them reciprocals, depth {}\n",
                count.total(),
                count.divisions,
                count.depth
            );
        }
    }
    insta::assert_snapshot!("chains", text);
}

#[test]
fn faults_and_a_stub() {
    let code = prettyplease::unparse(&generated(&tokens(FAULTY)));
    insta::assert_snapshot!("faulty", code);
}

#[test]
fn the_same_input_gives_the_same_code() {
    let once = || prettyplease::unparse(&generated(&tokens(PENDULUM)));
    assert_eq!(once(), once());
}
