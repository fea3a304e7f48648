//! Generated code, plans and counts, as they are; a change of these files is a change to be looked at.

mod common;

use common::{FAULTY, PENDULUM, SCENES, generated, model, tokens};
use holonom_engine::emit::report::{counts, describe};
use holonom_engine::plan::kernels::Kernels;
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
        let plan = describe(&model, &kernels.plans.rigid, &model.layout());
        text += &format!("{name}\n  {plan}\n");
        for (kernel, count) in counts(&kernels) {
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
