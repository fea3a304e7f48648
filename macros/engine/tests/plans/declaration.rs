//! The order of the fields decides neither results nor, within a few operations, counts.

use std::collections::BTreeMap;

use holonom_engine::emit::report::costs;
use holonom_engine::model::Model;
use holonom_engine::plan::kernels::Kernels;
use holonom_engine::plan::system::Terms;
use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::{Attribute, Fields, File, Item, ItemStruct};

use crate::common::{delivered, tokens};
use crate::dense::{Dice, State, deviation, evaluated};
use crate::library;

/// A motor on a hinge.
const MOTOR: &str = "#[mechanism(gravity = [0.0, 0.0, -9.81])] struct Motor {
    #[body(mass = 7.02, inertia = [0.5855265, 0.0010530, 0.5855265], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = 0.5 * time)]
    motor: AngleDriver,
}";

/// The operations of its standard evaluation.
const MOTORED: usize = 199;

/// What of a struct the engine reads.
fn described(item: ItemStruct) -> ItemStruct {
    let is_ours = |attribute: &Attribute| attribute.path().is_ident("mechanism");
    let attrs = item.attrs.into_iter().filter(is_ours).collect();
    ItemStruct { attrs, ..item }
}

/// A mechanism of the catalogue.
fn catalogued(file: &str, name: &str) -> ItemStruct {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/src");
    let text = std::fs::read_to_string(format!("{folder}/{file}.rs")).expect("a model");
    let File { items, .. } = syn::parse_file(&text).expect("Rust");
    let found = items.into_iter().find_map(|item| match item {
        Item::Struct(item) if item.ident == name => Some(described(item)),
        _ => None,
    });
    found.expect("a struct")
}

/// The same with its fields in another order.
fn shuffled(item: &ItemStruct, dice: &mut Dice) -> ItemStruct {
    let mut item = item.clone();
    let Fields::Named(fields) = &mut item.fields else {
        panic!("named fields")
    };
    let mut order: Vec<_> = fields.named.iter().cloned().collect();
    for k in (1..order.len()).rev() {
        order.swap(k, dice.below(k + 1));
    }
    fields.named = Punctuated::from_iter(order);
    item
}

/// Numbers by the names of what they belong to.
type Named = BTreeMap<String, Vec<f64>>;

/// Velocities and rows by the names of bodies and joints.
fn named(model: &Model, values: &[f64]) -> Named {
    let layout = model.layout();
    let bodies = model
        .bodies
        .iter()
        .zip(&layout.velocity)
        .map(|(body, &first)| {
            let own = first..first + body.kind.velocities();
            (body.name.to_string(), values[own].to_vec())
        });
    let joints = model.joints.iter().zip(&layout.row).map(|(joint, &first)| {
        let first = layout.velocities + first;
        let own = first..first + model.equations(joint);
        (joint.name.to_string(), values[own].to_vec())
    });
    bodies.chain(joints).collect()
}

/// Counts of all kernels, and accelerations and multipliers at the described state.
fn worked_out(item: &ItemStruct) -> (Vec<(String, usize)>, Named) {
    let model = delivered(&item.to_token_stream(), library::definition);
    let kernels = Kernels::new(&model);
    let state = State::described(&model, &kernels);
    let found = evaluated(&model, &kernels, Terms::Plain, &state);
    let counts = costs(&kernels).into_iter();
    let counts = counts
        .map(|(name, cost)| (name, cost.count.total()))
        .collect();
    (counts, named(&model, &found.solution))
}

/// Compares some orders of declaration: counts may differ by one part in so many.
fn judge(item: &ItemStruct, orders: usize, parts: usize) {
    let mut dice = Dice::new(11);
    let (counts, results) = worked_out(item);
    for _ in 0..orders {
        let item = shuffled(item, &mut dice);
        let (other_counts, other_results) = worked_out(&item);
        for ((name, count), (_, other)) in counts.iter().zip(&other_counts) {
            let text = item.to_token_stream();
            let difference = count.abs_diff(*other);
            assert!(
                difference <= count / parts,
                "{name}: {count} and {other} operations\n{text}"
            );
        }
        let [found, wanted]: [Vec<f64>; 2] =
            [&other_results, &results].map(|named| named.values().flatten().copied().collect());
        let difference = deviation(&found, &wanted);
        assert!(difference < 1e-12, "{difference:e}\n{found:?}\n{wanted:?}");
    }
}

#[test]
fn a_motor_before_its_hinge() {
    let item = described(syn::parse2(tokens(MOTOR)).expect("a struct"));
    judge(&item, 10, usize::MAX);
    let (counts, _) = worked_out(&item);
    assert_eq!(counts[0], ("evaluate standard".into(), MOTORED));
}

/// Sums are taken in the order of the fields, so that other terms are shared. (Where equations are
/// left out, which ones depends on the order: such mechanisms are not here.)
#[test]
fn mechanisms_of_the_catalogue() {
    for (file, name) in [
        ("rod_pendulum", "RodPendulum"),
        ("heavy_chain", "HeavyChain"),
        ("slider_crank", "DrivenSliderCrank"),
        ("variable_length_pendulum", "VariableLengthPendulum"),
        ("flyball_governor", "FlyballGovernor"),
        ("squeezing_mechanism", "SqueezingMechanism"),
    ] {
        judge(&catalogued(file, name), 4, 50);
    }
}
