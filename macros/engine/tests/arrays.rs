//! Arrays of bodies, joints, forces and values: what they stand for, written out, gives the same
//! kernels.

mod common;

use common::{checked, definition, generated, model, tokens};
use holonom_engine::emit::report::{costs, describe};
use holonom_engine::model::Model;
use holonom_engine::plan::kernels::Kernels;
use quote::ToTokens;
use syn::{Block, Expr, File, ImplItem, Item, Stmt};

/// A chain with axes in turn, springs between neighbours, loads and numbers known at run time.
const CHAIN: &str = "#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = \"both\")] struct Chain {
    #[param] lengths: [f64; 5],
    #[input] thrusts: [f64; 2],
    #[body(mass = 1.0 + 0.25 * k, inertia = [0.1, 0.05, 0.1 + 0.001 * k * k], position = [0.0, 0.5 + 1.0 * k, 0.0],
        velocity = [if k == 4 { 0.5 } else { 0.0 }, 0.0, 0.0])]
    links: [Body; 5],
    #[joint(between = [if k == 0 { ground } else { links[k - 1] }, links[k]], point = [0.0, k, 0.0],
        axis = if k % 2 == 0 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] })]
    pins: [Revolute; 5],
    #[force(between = [links[k], links[(k + 2) % 5]], head = [0.0, k, 1.0], tail = [0.5, lengths[k], -(k % 3)],
        stiffness = 10.0 * (k + 1), force = -(k + 1) * rate + 0.5 * sin(time - k) * thrusts[k % 2])]
    springs: [Damper; 5],
}";

/// The same with a field for each element.
fn written_out() -> String {
    let mut text = String::from(
        "#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = \"both\")] struct Chain {",
    );
    for k in 0..5 {
        text += &format!("#[param] lengths_{k}: f64,");
    }
    text += "#[input] thrusts_0: f64, #[input] thrusts_1: f64,";
    for k in 0..5 {
        let (mass, height) = (1.0 + 0.25 * f64::from(k), 0.5 + f64::from(k));
        let moment = 0.1 + 0.001 * f64::from(k) * f64::from(k);
        let speed = if k == 4 { 0.5 } else { 0.0 };
        text += &format!(
            "#[body(mass = {mass:?}, inertia = [0.1, 0.05, {moment:?}], position = [0.0, {height:?}, 0.0], velocity = [{speed:?}, 0.0, 0.0])]
             links_{k}: Body,"
        );
    }
    for (k, axis) in ["1.0, 0.0, 0.0", "0.0, 0.0, 1.0"]
        .into_iter()
        .cycle()
        .take(5)
        .enumerate()
    {
        let before = match k {
            0 => "ground".into(),
            _ => format!("links_{}", k - 1),
        };
        text += &format!(
            "#[joint(between = [{before}, links_{k}], point = [0.0, {k}.0, 0.0], axis = [{axis}])] pins_{k}: Revolute,"
        );
    }
    for k in 0..5 {
        let (other, thrust, place) = ((k + 2) % 5, k % 2, k % 3);
        let stiffness = 10.0 * f64::from(k + 1);
        text += &format!(
            "#[force(between = [links_{k}, links_{other}], head = [0.0, {k}.0, 1.0], tail = [0.5, lengths_{k}, -{place}.0],
                stiffness = {stiffness:?}, force = -({k}.0 + 1.0) * rate + 0.5 * sin(time - {k}.0) * thrusts_{thrust})] springs_{k}: Damper,"
        );
    }
    text + "}"
}

/// The names as they would be with a field for each element.
fn plain(text: &str) -> String {
    let mut plain = text.to_string();
    for field in ["lengths", "thrusts", "links", "pins", "springs"] {
        for k in 0..5 {
            plain = plain.replace(&format!("{field}[{k}]"), &format!("{field}_{k}"));
        }
    }
    plain
}

#[test]
fn elements_are_what_single_fields_are() {
    let [array, single] = [CHAIN.to_string(), written_out()].map(|text| model(&tokens(&text)));
    let names = |model: &Model| {
        let bodies = model.bodies.iter().map(|body| body.name.to_string());
        let elements = model.elements().map(|element| element.name.to_string());
        let values = model.values.iter().map(|value| value.name.to_string());
        let names: Vec<String> = bodies.chain(elements).chain(values).collect();
        names
    };
    assert_eq!(names(&array)[3], "links[3]");
    assert_eq!(
        names(&single),
        names(&array)
            .iter()
            .map(|name| plain(name))
            .collect::<Vec<_>>()
    );

    let [array_kernels, kernels] = [&array, &single].map(Kernels::new);
    assert_eq!(costs(&array_kernels), costs(&kernels));
    let plan = describe(
        &array,
        &array_kernels
            .plans
            .as_ref()
            .expect("bodies are fused")
            .rigid,
        &array.layout(),
    );
    let single_plan = describe(
        &single,
        &kernels.plans.as_ref().expect("bodies are fused").rigid,
        &single.layout(),
    );
    assert_eq!(plain(&plan), single_plan);

    let [array, single] =
        [CHAIN.to_string(), written_out()].map(|text| functions(generated(&tokens(&text))));
    let names = single.iter().map(|(name, _)| name.as_str());
    for wanted in [
        "prepare",
        "__evaluate_plain",
        "__evaluate_joints_plain",
        "force_parts",
    ] {
        assert!(
            names.clone().any(|name| name == wanted),
            "{wanted} is compared"
        );
    }
    assert_eq!(array.len(), single.len());
    for ((name, code), (other, wanted)) in array.iter().zip(&single) {
        assert_eq!(name, other);
        assert!(code == wanted, "`{name}` differs:\n{code}\n{wanted}");
    }
}

/// All generated functions but those that take the values of parameters and inputs over from a
/// struct.
fn functions(file: File) -> Vec<(String, String)> {
    let mut functions = Vec::new();
    let mut blocks: Vec<Block> = Vec::new();
    let of_const = |item: Item| match item {
        Item::Const(item) => match *item.expr {
            Expr::Block(block) => Some(block.block),
            _ => None,
        },
        _ => None,
    };
    blocks.extend(file.items.into_iter().filter_map(of_const));
    while let Some(block) = blocks.pop() {
        for statement in block.stmts {
            match statement {
                Stmt::Item(Item::Fn(item)) => {
                    functions.push((item.sig.ident.to_string(), item.block.to_token_stream()));
                }
                Stmt::Item(Item::Impl(item)) => {
                    functions.extend(item.items.into_iter().filter_map(|item| match item {
                        ImplItem::Fn(item) => {
                            Some((item.sig.ident.to_string(), item.block.to_token_stream()))
                        }
                        _ => None,
                    }));
                }
                Stmt::Item(item) => blocks.extend(of_const(item)),
                _ => {}
            }
        }
    }
    let functions = functions.into_iter();
    functions
        .filter(|(name, _)| !OF_FIELDS.contains(&name.as_str()))
        .map(|(name, code)| (name, code.to_string()))
        .collect()
}

/// The functions that name fields of a struct.
const OF_FIELDS: [&str; 6] = [
    "parameters",
    "new",
    "inputs",
    "put_inputs",
    "inputs_of",
    "default",
];

/// The handles and what takes values over from the struct.
#[test]
fn arrays_are_arrays_in_generated_code() {
    let text = generated(&tokens(CHAIN)).to_token_stream().to_string();
    for part in [
        "pub links : [:: holonom :: BodyHandle < Chain > ; 5usize]",
        "pub pins : [:: holonom :: JointHandle < Chain , Revolute > ; 5usize]",
        "pub fn new (lengths : [:: core :: primitive :: f64 ; 5usize])",
        "thrusts : [0.0 ; 2usize]",
        "pub thrusts : [__S ; 2usize]",
        "(5 , \"thrusts[0]\" , __inputs . thrusts [0])",
        "let __element_of_lengths_3 : f64 = self . lengths [3] ;",
        "field : \"lengths[3]\"",
    ] {
        assert!(text.contains(part), "no `{part}` in\n{text}");
    }
}

/// A chain of so many links by an array.
fn chain(links: usize) -> String {
    format!(
        "#[mechanism(gravity = [0.0, 0.0, -9.81])] struct Chain {{
            #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5 + k, 0.0])] links: [Body; {links}],
            #[joint(between = [if k == 0 {{ ground }} else {{ links[k - 1] }}, links[k]], point = [0.0, k, 0.0])] pins: [Spherical; {links}],
        }}"
    )
}

/// `links[10]` comes behind `links[9]`: where names decide, a chain is eliminated from its end to
/// the ground, whatever its length.
#[test]
fn long_chains_are_in_order() {
    let text = chain(12).replace("if k == 0 { ground } else { links[k - 1] }", "ground");
    let model = model(&tokens(&text));
    let kernels = Kernels::new(&model);
    let plan = describe(
        &model,
        &kernels.plans.as_ref().expect("bodies are fused").rigid,
        &model.layout(),
    );
    let places: Vec<usize> = (0..12)
        .map(|k| {
            plan.find(&format!("links[{k}].w'"))
                .expect("a pivot of every link")
        })
        .collect();
    assert!(places.is_sorted(), "{plan}");
}

/// What is wrong with a mechanism.
fn refusal(text: &str) -> String {
    checked(&tokens(text), definition).expect_err("a fault")
}

#[test]
fn what_elements_have_in_common_is_reported_once() {
    let once = |text: &str, messages: &[&str]| {
        let found = refusal(text);
        assert_eq!(
            found.matches("compile_error").count(),
            messages.len(),
            "{found}"
        );
        for message in messages {
            assert!(found.contains(message), "no `{message}` in {found}");
        }
    };
    let sound = chain(16);
    once(
        &sound.replace("links[k - 1]", "links[k - 2]"),
        &["this is `links[-1]` where `k` is 1; what stands there instead is said by `if k == 1"],
    );
    once(
        &sound.replace("mass = 1.0", "mass = 2.5 - k"),
        &["the mass of `links[3]` must be positive, in kg; this is -0.5"],
    );
    once(
        &sound
            .replace("mass = 1.0, ", "mas = 1.0, ")
            .replace("point = ", "pint = "),
        &[
            "body `links[0]` has no attribute `mas`",
            "joint `pins[0]` has no attribute `pint`",
        ],
    );
    // Two faults of one element at one token are two.
    once(
        &sound.replace("[0.0, k, 0.0]", "[1e-60 * (k + 1), k, 1e60 * k]"),
        &["this is 1e-60", "this is 1e60"],
    );
    once(
        "struct Shelf { #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])] boards: [Body; 4],
            #[joint(between = [ground, boards[k]], point = [0.0, 0.0, k], axis = [0.0, 0.0, 1.0])] first: [Revolute; 4],
            #[joint(between = [ground, boards[k]], point = [0.0, 0.0, k + 1], axis = [0.0, 0.0, 1.0])] second: [Revolute; 4] }",
        &["all 5 equations of `second[0]` are redundant: `second[0][0]`"],
    );
}
