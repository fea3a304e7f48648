//! What joints cost by themselves, against the counts of the field's tools.

use holonom_engine::check::definition::Definition;
use holonom_engine::diag::Faults;
use holonom_engine::model::{BodyKind, ElementDef, ElementKind, Model};
use holonom_engine::plan::alone::{Alone, alone};
use holonom_engine::symbolic::arena::Input;
use holonom_engine::symbolic::evaluate::evaluate;
use holonom_engine::symbolic::scene::Scene;
use holonom_engine::{check, passes, syntax};
use quote::quote;

/// The definitions of the library, by name.
fn library() -> Vec<ElementDef> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../runtime/src/joints");
    let mut joints = Vec::new();
    for entry in std::fs::read_dir(folder).expect("the library of joints") {
        let text = std::fs::read_to_string(entry.expect("a file").path()).expect("text");
        for item in syn::parse_file(&text).expect("Rust").items {
            let syn::Item::Macro(item) = item else {
                continue;
            };
            let mut faults = Faults::new();
            let written = syntax::joint::parse(item.mac.tokens, ElementKind::Joint, &mut faults);
            let joint = written.and_then(|joint| check::joint::check(&joint, &mut faults));
            assert!(!faults.any());
            assert!(faults.into_tokens().is_empty());
            joints.push(joint.expect("sound"));
        }
    }
    joints
}

/// Two free bodies with one joint; axes along x, points on x.
fn between_free_bodies(joint: &ElementDef) -> Model {
    let attributes = joint
        .parameters
        .iter()
        .filter(|p| p.default.is_none())
        .map(|p| {
            let name = &p.name;
            let value = match (joint.name.to_string().as_str(), name.to_string().as_str()) {
                (_, "axis_j") if joint.name != "ConstantVelocity" => quote!([0.0, 1.0, 0.0]),
                (_, "slide" | "normal") => quote!([1.0, 0.0, 0.0]),
                (_, "head" | "hinge" | "first") => quote!([0.4, 0.0, 0.0]),
                (_, "tail" | "ball" | "second") => quote!([0.8, 0.0, 0.0]),
                (_, "point") => quote!([0.5, 0.0, 0.0]),
                (_, "pitch" | "ratio" | "radius") => quote!(0.1),
                (_, "motion") => quote!(0.5 * time),
                _ => quote!([1.0, 0.0, 0.0]),
            };
            quote!(#name = #value)
        });
    let kind = &joint.name;
    let names = ["one", "two", "three"].map(|name| quote::format_ident!("{name}"));
    let between = &names[..joint.bodies.len()];
    let item = quote! {
        struct Pair {
            #[body(free, mass = 1.0, inertia = [0.1, 0.2, 0.15])]
            one: Body,
            #[body(free, mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [1.0, 0.0, 0.0])]
            two: Body,
            #[body(free, mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [2.0, 0.0, 0.0])]
            three: Body,
            #[joint(between = [#(#between),*], #(#attributes),*)]
            joint: #kind,
        }
    };
    let input = syn::parse2(item).expect("a struct");
    let mut faults = Faults::new();
    let written = syntax::mechanism::parse(&input, &mut faults);
    let types = vec![
        ("Body".into(), Definition::Body(BodyKind::Rigid)),
        (kind.to_string(), Definition::Element(0)),
    ];
    let facade = quote!(::holonom);
    let definitions = vec![joint.clone()];
    let model = passes::mechanism(&written, &types, definitions, &facade, &mut faults);
    let errors = faults.into_tokens();
    model.unwrap_or_else(|| panic!("{kind}: {errors}"))
}

/// What a derivation by hand on vectors costs after hash-consing, which is less than SymPy,
/// SymForce, CasADi and wrenfold make of the same functions: axis along x, points on x, constants
/// folded, `A w` given.
const KNOWN: [(&str, usize); 7] = [
    ("Spherical", 96),
    ("Revolute", 160),
    ("Universal", 135),
    ("Cylindrical", 282),
    ("Prismatic", 307),
    ("Fixed", 185),
    ("Distance", 162),
];

#[test]
fn joints_cost_no_more_than_in_other_tools() {
    let mut library = library();
    library.sort_by_key(|joint| joint.name.to_string());
    let mut worse = Vec::new();
    for joint in &library {
        let model = between_free_bodies(joint);
        let operations = alone(&model, 0).count().total();
        let known = KNOWN.iter().find(|(name, _)| joint.name == name);
        if let Some((name, most)) = known.filter(|(_, most)| operations > *most) {
            worse.push(format!("{name}: {operations} > {most}"));
        }
    }
    assert!(worse.is_empty(), "{worse:?}");
}

/// Numbers between -1 and 1 (Knuth's linear congruential generator).
fn number(seed: &mut u64) -> f64 {
    *seed = seed
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// `A(p) w` by the sandwich product, for `p` of length 1.
fn turned(p: &[f64], w: &[f64]) -> [f64; 3] {
    let cross =
        |a: [f64; 3], b: [f64; 3]| [(1, 2), (2, 0), (0, 1)].map(|(k, l)| a[k] * b[l] - a[l] * b[k]);
    let (e, w) = ([p[1], p[2], p[3]], [w[0], w[1], w[2]]);
    let first = cross(e, w);
    let second = cross(e, first);
    [0, 1, 2].map(|k| w[k] + 2.0 * (p[0] * first[k] + second[k]))
}

/// Positions, Euler parameters of length 1 and two auxiliary variables; velocities, and the same
/// with `w` in global axes.
struct State {
    coordinates: Vec<f64>,
    velocities: Vec<f64>,
    global: Vec<f64>,
}

impl State {
    fn of(bodies: usize, seed: &mut u64) -> Self {
        let (mut coordinates, mut velocities, mut global) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..bodies {
            coordinates.extend([0; 3].map(|_| number(seed)));
            let p = [0; 4].map(|_| number(seed));
            let length = p.map(|e| e * e).iter().sum::<f64>().sqrt();
            let p = p.map(|e| e / length);
            coordinates.extend(p);
            let (v, w) = ([0; 3].map(|_| number(seed)), [0; 3].map(|_| number(seed)));
            velocities.extend(v.into_iter().chain(w));
            global.extend(v.into_iter().chain(turned(&p, &w)));
        }
        coordinates.extend([0; 2].map(|_| number(seed)));
        Self {
            coordinates,
            velocities,
            global,
        }
    }

    /// `Phi`, `D` and `gamma`, one behind the other.
    fn values(&self, functions: &Alone) -> Vec<f64> {
        let outputs = [
            &functions.constraints[..],
            &functions.jacobian,
            &functions.gamma,
        ]
        .concat();
        let values = evaluate(&functions.arena, &outputs, |input| match input {
            Input::Coordinate(place) => self.coordinates.get(place as usize).copied(),
            Input::Velocity(place) => self.velocities.get(place as usize).copied(),
            Input::Upper(place) => self.global.get(place as usize).copied(),
            Input::Time => Some(0.3),
            other => unreachable!("{other:?}"),
        });
        values.into_iter().map(|v| v.expect("known")).collect()
    }
}

#[test]
fn functions_of_one_joint_are_those_of_the_kernels() {
    let mut seed = 15;
    for joint in library() {
        let model = between_free_bodies(&joint);
        let found = alone(&model, 0);
        let wanted = Alone::of(Scene::new(&model.only(0)));
        for _ in 0..5 {
            let state = State::of(joint.bodies.len(), &mut seed);
            let (found, wanted) = (state.values(&found), state.values(&wanted));
            assert_eq!(found.len(), wanted.len());
            for (a, b) in found.iter().zip(&wanted) {
                let error = (a - b).abs();
                assert!(error < 1e-13 * (1.0 + b.abs()), "{}: {a} {b}", joint.name);
            }
        }
    }
}
