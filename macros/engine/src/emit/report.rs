//! The report on a mechanism: names, sizes, counts.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;
use quote::quote;

use super::joint::kind;
use crate::coordinates::spanning::Spanning;
use crate::model::mechanism::Layout;
use crate::model::{Element, Model, ParameterKind, Rank, RunTimeValue, Shape, ShapeKind};
use crate::plan::Plan;
use crate::plan::kernels::Kernels;
use crate::plan::readouts::Marker;
use crate::plan::system::Terms;
use crate::plan::time::ExplicitTime;
use crate::symbolic::arena::{Input, Node, Stage};
use crate::symbolic::count::Count;
use crate::symbolic::equations::Kernel;
use crate::symbolic::time::Cost;
use crate::symbolic::vector::Frame;

/// Name and cost of every kernel that is called at run time, in the order of the report.
#[must_use]
pub fn costs(kernels: &Kernels) -> Vec<(String, Cost)> {
    let of = |kernel: &Kernel| Cost::of(&kernel.arena, &kernel.outputs, Stage::State);
    let mut costs = vec![];
    for evaluation in &kernels.evaluations {
        costs.push((evaluation_name(evaluation.terms), of(&evaluation.kernel)));
    }
    for (name, kernel) in [
        ("constraints", &kernels.constraints),
        ("constraint rates", &kernels.constraint_rates),
        ("jacobian", &kernels.jacobian),
        ("gamma", &kernels.gamma),
        ("forces", &kernels.forces),
        ("kinetic energy", &kernels.kinetic_energy),
        ("potential energy", &kernels.potential_energy),
        ("coordinate rates", &kernels.coordinate_rates),
    ] {
        costs.push((name.into(), of(kernel)));
    }
    if !kernels.state_rates.outputs.is_empty() {
        costs.push(("state rates".into(), of(&kernels.state_rates)));
    }
    if !kernels.readouts.energies.is_empty() {
        costs.push(("power".into(), of(&kernels.power)));
    }
    for columns in &kernels.rate_columns {
        let name = format!("derivatives {}", terms_name(columns.terms));
        costs.push((name, of(&columns.kernel)));
    }
    for solver in &kernels.solvers {
        let solve = Cost::of(&solver.arena, &solver.solution, Stage::RightHandSide);
        let suffix = if solver.terms == Terms::Compliant {
            ", compliant"
        } else {
            ""
        };
        costs.push((format!("solve{suffix}"), solve));
    }
    costs
}

/// The name of an evaluation in the report.
#[must_use]
pub fn evaluation_name(terms: Terms) -> String {
    format!("evaluate {}", terms_name(terms))
}

/// The first formulation that has these terms.
pub(super) const fn terms_name(terms: Terms) -> &'static str {
    match terms {
        Terms::Plain => "standard",
        Terms::Stabilised => "baumgarte",
        Terms::Compliant => "penalty",
    }
}

/// The plan in words.
#[must_use]
pub fn describe(model: &Model, plan: &Plan, layout: &Layout) -> String {
    let frame = |frame: &Frame| match frame {
        Frame::Global => "global".to_string(),
        Frame::Body(body) => model.bodies[*body].name.to_string(),
    };
    let unknown = |k: usize| {
        if k >= layout.velocities {
            let (joint, row) = layout.place_of(k - layout.velocities);
            return format!("{}[{row}]", model.joints[joint].name);
        }
        let body = layout
            .velocity
            .iter()
            .rposition(|&first| first <= k)
            .expect("a velocity belongs to a body");
        let place = k - layout.velocity[body];
        let letter = if place < 3 { "v'" } else { "w'" };
        format!("{}.{letter}{}", model.bodies[body].name, place % 3 + 1)
    };
    let pivots: Vec<String> = plan
        .pivots
        .iter()
        .map(|pivot| {
            let unknowns: Vec<String> = pivot.unknowns().into_iter().map(unknown).collect();
            match unknowns.as_slice() {
                [only] => only.clone(),
                several => format!("({})", several.join(", ")),
            }
        })
        .collect();
    let translation: Vec<String> = plan.translation.iter().map(frame).collect();
    let rows: Vec<String> = plan.rows.iter().map(frame).collect();
    format!(
        "accelerations in axes of: {}; rows in axes of: {}; pivots: {}",
        translation.join(", "),
        rows.join(", "),
        pivots.join(" ")
    )
}

/// The bodies of a joint or force, `None` for the ground.
fn places(element: &Element) -> impl Iterator<Item = TokenStream> {
    element.bodies.iter().copied().map(option)
}

fn option(place: Option<usize>) -> TokenStream {
    match place {
        Some(place) => quote!(::core::option::Option::Some(#place)),
        None => quote!(::core::option::Option::None),
    }
}

/// A kernel by its name and what it costs.
pub(super) fn kernel(
    name: &str,
    Cost { count, cycles }: Cost,
    facade: &TokenStream,
) -> TokenStream {
    let operations = operations(count, facade);
    quote!(#facade::__private::Kernel { name: #name, operations: #operations, cycles: #cycles })
}

fn operations(count: Count, facade: &TokenStream) -> TokenStream {
    let Count {
        additions,
        multiplications,
        divisions,
        square_roots,
        functions,
        depth,
    } = count;
    quote! {
        #facade::__private::Operations {
            additions: #additions,
            multiplications: #multiplications,
            divisions: #divisions,
            square_roots: #square_roots,
            functions: #functions,
            depth: #depth,
        }
    }
}

fn explicit_time(time: &ExplicitTime, facade: &TokenStream) -> TokenStream {
    let ExplicitTime {
        constraints,
        forces,
        potential,
        breaks,
    } = time;
    quote! {
        #facade::__private::ExplicitTime {
            constraints: #constraints, forces: #forces, potential: #potential, breaks: &[#(#breaks),*],
        }
    }
}

/// The constant `REPORT`.
#[must_use]
pub fn report(model: &Model, kernels: &Kernels, facade: &TokenStream) -> TokenStream {
    let layout = model.layout();
    let name = model.name.to_string();
    let bodies = model.bodies.iter().enumerate().map(|(place, body)| {
        let (name, kind) = (body.name.to_string(), kind(body.kind, facade));
        let (coordinate, velocity) = (layout.coordinate[place], layout.velocity[place]);
        quote!(#facade::__private::BodyInfo { name: #name, kind: #kind, coordinate: #coordinate, velocity: #velocity })
    });
    let counters = model.counters();
    // The first auxiliary variable of a joint or force, and how many it has.
    let auxiliaries = |element: usize| {
        let before = counters.iter().filter(|c| c.element < element).count();
        let own = counters.iter().filter(|c| c.element == element).count();
        (layout.coordinates + before, own)
    };
    let joints = model.joints.iter().enumerate().map(|(place, joint)| {
        let definition = model.definition(joint);
        let (name, kind) = (joint.name.to_string(), definition.name.to_string());
        let (row, rows) = (layout.row[place], model.equations(joint));
        let bodies = places(joint);
        let has_angle = definition.angle.is_some();
        let has_point = definition.reaction_point().is_some();
        let has_displacement = definition.displacement.is_some();
        let (auxiliary, auxiliaries) = auxiliaries(place);
        let undetermined = model.independence.undetermined.iter();
        let undetermined = undetermined.filter_map(|&(of, row)| (of == place).then_some(row));
        quote! {
            #facade::__private::JointInfo {
                name: #name, kind: #kind, row: #row, rows: #rows, bodies: &[#(#bodies),*], has_angle: #has_angle,
                has_displacement: #has_displacement, has_point: #has_point,
                auxiliary: #auxiliary, auxiliaries: #auxiliaries, undetermined: &[#(#undetermined),*],
            }
        }
    });
    let forces = model.forces.iter().enumerate().map(|(place, force)| {
        let (name, kind) = (
            force.name.to_string(),
            model.definition(force).name.to_string(),
        );
        let bodies = places(force);
        let (auxiliary, auxiliaries) = auxiliaries(model.joints.len() + place);
        quote! {
            #facade::__private::ForceInfo {
                name: #name, kind: #kind, bodies: &[#(#bodies),*], auxiliary: #auxiliary, auxiliaries: #auxiliaries,
            }
        }
    });
    let markers = kernels.readouts.markers.iter();
    let markers = markers.map(|found| marker(model, found, facade));
    let points = model.points.iter().map(|point| {
        let (name, body) = (point.name.to_string(), option(point.body));
        quote!(#facade::__private::PointInfo { name: #name, body: #body })
    });
    let values = model.values.iter().map(|value| value_info(value, facade));
    let states = state_infos(model, layout.coordinates + layout.auxiliaries, facade);
    let bodies_and_shapes = model.bodies.iter().enumerate();
    let shapes = bodies_and_shapes.flat_map(|(place, body)| {
        let shapes = body.shapes.iter();
        shapes.map(move |found| shape(place, found, facade))
    });
    let mut carriers = vec![TokenStream::new(); model.bodies.len()];
    for carried in Spanning::new(model).carried {
        let [body, joint] = [carried.by, carried.joint].map(option);
        carriers[carried.body] = quote!(#facade::__private::Carrier { body: #body, joint: #joint });
    }
    let blocks = kernels.blocks.iter().map(|block| {
        let crate::symbolic::equations::Block { joint, body, offset } = *block;
        let (row, rows) = (layout.row[joint], model.equations(&model.joints[joint]));
        let (column, columns) = (layout.velocity[body], model.bodies[body].kind.velocities());
        quote! {
            #facade::__private::Block {
                joint: #joint, body: #body, row: #row, rows: #rows, column: #column, columns: #columns, offset: #offset,
            }
        }
    });
    let costs = costs(kernels).into_iter();
    let costs = costs.map(|(name, cost)| kernel(&name, cost, facade));
    let Layout {
        coordinates,
        auxiliaries,
        velocities,
        rows,
        ..
    } = layout;
    let independence = &model.independence;
    let degrees_of_freedom = independence.degrees_of_freedom(velocities, rows);
    let rank = rank(&independence.rank, facade);
    let dropped = independence.dropped;
    let redundant = independence.redundant.iter().map(|redundant| {
        let (joint, row) = (redundant.joint, redundant.row);
        quote!(#facade::__private::RedundantRow { joint: #joint, row: #row, dropped: #dropped })
    });
    let time = explicit_time(&ExplicitTime::of(kernels, model), facade);
    let velocity_rows = model.velocity_rows();
    let curved = is_curved(model, &kernels.gamma);
    let plan = described_plan(model, kernels, &layout);
    quote! {
        #facade::Report {
            name: #name,
            bodies: &[#(#bodies),*],
            joints: &[#(#joints),*],
            forces: &[#(#forces),*],
            markers: &[#(#markers),*],
            points: &[#(#points),*],
            values: &[#(#values),*],
            shapes: &[#(#shapes),*],
            carriers: &[#(#carriers),*],
            blocks: &[#(#blocks),*],
            coordinates: #coordinates,
            auxiliaries: #auxiliaries,
            states: &[#(#states),*],
            velocities: #velocities,
            equations: #rows,
            rank: #rank,
            redundant: &[#(#redundant),*],
            degrees_of_freedom: #degrees_of_freedom,
            velocity_rows: &[#(#velocity_rows),*],
            time: #time,
            curved: #curved,
            kernels: &[#(#costs),*],
            plan: #plan,
        }
    }
}

/// The plan in words.
fn described_plan(model: &Model, kernels: &Kernels, layout: &Layout) -> String {
    let plan = kernels.plans.as_ref();
    plan.map_or("rows in turn".into(), |plans| {
        describe(model, &plans.rigid, layout)
    })
}

fn rank(rank: &Rank, facade: &TokenStream) -> TokenStream {
    match rank {
        Rank::Decided { rank, at_start } => {
            quote!(#facade::__private::Rank::Decided { rank: #rank, at_start: #at_start })
        }
        Rank::NotDecided => quote!(#facade::__private::Rank::NotDecided),
        Rank::NotAssembled => quote!(#facade::__private::Rank::NotAssembled),
    }
}

/// What a report has of a parameter or an input.
fn value_info(value: &RunTimeValue, facade: &TokenStream) -> TokenStream {
    let (name, is_input) = (value.name.to_string(), value.is_input);
    let further = value.kind.further();
    quote!(#facade::__private::ValueInfo { name: #name, is_input: #is_input, further: #further })
}

/// The user's own states, of which the first has this place.
pub(super) fn state_infos(model: &Model, first: usize, facade: &TokenStream) -> Vec<TokenStream> {
    let states = model.states.iter().enumerate();
    let states = states.map(|(place, state)| {
        let (name, coordinate, value) = (state.name.to_string(), first + place, state.value);
        quote! {
            #facade::__private::StateInfo { name: #name, coordinate: #coordinate, value: #value }
        }
    });
    states.collect()
}

/// Lets the compiler watch the files of meshes.
pub(super) fn watched(model: &Model) -> TokenStream {
    let shapes = model.bodies.iter().flat_map(|body| &body.shapes);
    let files: BTreeSet<&String> = shapes.filter_map(|shape| shape.file.as_ref()).collect();
    let files = files.iter();
    quote!(#( const _: &[::core::primitive::u8] = ::core::include_bytes!(#files); )*)
}

fn shape(body: usize, shape: &Shape, facade: &TokenStream) -> TokenStream {
    let Shape {
        kind,
        centre: [x, y, z],
        axes: [e0, e1, e2, e3],
        is_hole,
        ref file,
        ..
    } = *shape;
    let file = match file {
        Some(file) => quote!(::core::option::Option::Some(#file)),
        None => quote!(::core::option::Option::None),
    };
    let kind = match kind {
        ShapeKind::Cylinder => quote!(Cylinder),
        ShapeKind::Tube => quote!(Tube),
        ShapeKind::Cone => quote!(Cone),
        ShapeKind::Block => quote!(Block),
        ShapeKind::Ball => quote!(Ball),
        ShapeKind::Mesh => quote!(Mesh),
    };
    quote! {
        #facade::__private::Shape {
            body: #body, kind: #facade::__private::ShapeKind::#kind, centre: [#x, #y, #z],
            axes: [#e0, #e1, #e2, #e3], is_hole: #is_hole, file: #file,
        }
    }
}

fn marker(model: &Model, marker: &Marker, facade: &TokenStream) -> TokenStream {
    let Marker {
        element,
        place,
        parameter,
        ..
    } = *marker;
    let count = model.joints.len();
    let (element, of) = match model.joints.get(element) {
        Some(joint) => (joint, quote!(Joint(#element))),
        None => {
            let force = element - count;
            (&model.forces[force], quote!(Force(#force)))
        }
    };
    let parameter = &model.definition(element).parameters[parameter];
    let name = parameter.name.to_string();
    let kind = match parameter.kind {
        ParameterKind::Point => quote!(Point),
        ParameterKind::Axis => quote!(Axis),
        _ => quote!(Vector),
    };
    let body = option(element.bodies[place]);
    quote! {
        #facade::__private::Marker {
            of: #facade::__private::ElementPlace::#of, place: #place, body: #body, name: #name,
            kind: #facade::__private::MarkerKind::#kind,
        }
    }
}

/// Whether `gamma` speaks of velocities of centres of mass.
fn is_curved(model: &Model, gamma: &Kernel) -> bool {
    let layout = model.layout();
    let mut is_translation = vec![false; layout.velocities];
    for &first in &layout.velocity {
        is_translation[first..first + 3].fill(true);
    }
    let live = gamma.arena.live(&gamma.outputs, Stage::Literal);
    live.into_iter().any(|place| {
        matches!(gamma.arena.node(place), Node::Input(Input::Velocity(u)) if is_translation[u as usize])
    })
}
