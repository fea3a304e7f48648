//! From the tree of links to bodies and joints in global axes.

use std::collections::HashMap;

use nalgebra::{Matrix3, Vector3};

use crate::inertias::is_odd;
use crate::mechanism::{Body, Joint, LinkFrame, Mechanism, Mesh, Mimic, Motor, Options};
use crate::names::{Names, snake_case, type_name};
use crate::robot::Robot;
use crate::spatial::{clean, euler_parameters, number};
use crate::tree::Group;
use crate::visuals::Visual;

pub(crate) fn mechanism(robot: &Robot, options: &Options) -> Mechanism {
    let (document, tree) = (&robot.document, &robot.tree);
    let (ground, moving) = tree.groups.split_at(usize::from(!options.floating));
    let first = ground.len();
    let link_names = |group: &Group| {
        let names = group
            .links
            .iter()
            .map(|link| document.links[*link].name.clone());
        names.collect::<Vec<_>>()
    };
    let mut names = Names::new();
    let bodies: Vec<Body> = moving
        .iter()
        .map(|group| body(robot, group, &mut names))
        .collect();
    let joints = joints(robot, first, options, &mut names);
    let mut mechanism = Mechanism {
        name: type_name(options.name.as_ref().unwrap_or(&document.name)),
        robot: document.name.clone(),
        source: options.source.clone(),
        ground: ground.first().map(link_names).unwrap_or_default(),
        ground_mass: ground
            .first()
            .and_then(|g| g.inertia)
            .map_or(0.0, |inertia| inertia.mass),
        bodies,
        joints,
        frames: Vec::new(),
        meshes: meshes(robot, first),
        notes: robot.notes.clone(),
    };
    for (place, body) in mechanism.bodies.iter_mut().enumerate() {
        let is_named =
            |joint: &Joint| joint.kind.has_field() && joint.between.contains(&Some(place));
        body.is_free = !mechanism.joints.iter().any(is_named);
    }
    mechanism.frames = frames(robot, first, &mut names);
    mechanism
}

fn body(robot: &Robot, group: &Group, names: &mut Names) -> Body {
    let links = group.links.iter().map(|link| &robot.document.links[*link]);
    let frame = robot.tree.places[group.links[0]].global;
    let inertia = group.inertia.expect("a body that moves was checked");
    let (mut shapes, mut visuals) = (Vec::new(), Vec::new());
    for &link in &group.links {
        let place = &robot.tree.places[link];
        for visual in &robot.document.links[link].visuals {
            match visual {
                Visual::Solid(frame, solid) => {
                    let within = place.within.compose(frame);
                    shapes.push(solid.on_body(&within, &place.global.compose(frame)));
                }
                Visual::Mesh(_, mesh) => visuals.push(mesh.name()),
                Visual::Named(name) => visuals.push(name.clone()),
            }
        }
    }
    Body {
        field: names.field(&robot.document.links[group.links[0]].name, "link"),
        links: links.map(|link| link.name.clone()).collect(),
        mass: inertia.mass,
        position: clean(frame.origin + frame.rotation * inertia.centre),
        orientation: orientation(&frame.rotation),
        inertia: rows(&inertia.tensor),
        shapes,
        visuals,
        is_free: false,
        is_as_given: is_odd(group),
    }
}

/// The joints that move. `first` is the group that is the first body.
fn joints(robot: &Robot, first: usize, options: &Options, names: &mut Names) -> Vec<Joint> {
    let (document, tree) = (&robot.document, &robot.tree);
    let moving = || {
        tree.joints.iter().filter(|branch| {
            document.joints[branch.joint]
                .kind
                .is_some_and(|kind| !kind.is_fixed())
        })
    };
    let place = |(place, branch): (usize, &crate::tree::Branch)| {
        (&*document.joints[branch.joint].name, place)
    };
    let places: HashMap<&str, usize> = moving().enumerate().map(place).collect();
    let fields: Vec<String> = moving()
        .map(|branch| names.field(&document.joints[branch.joint].name, "joint"))
        .collect();
    let joints = moving().zip(fields).map(|(branch, field)| {
        let joint = &document.joints[branch.joint];
        let kind = joint.kind.expect("a joint without a type was refused");
        let body = |link: usize| tree.places[link].group.checked_sub(first);
        let frame = tree.places[branch.child].global;
        let stem = field.strip_suffix("_joint").unwrap_or(&field);
        let mimic = joint.mimic.as_ref().map(|mimic| Mimic {
            field: names.unique(format!("{stem}_mimic")),
            leader: places[&*mimic.joint],
            multiplier: mimic.multiplier,
            offset: mimic.offset,
        });
        let has_input = kind.is_single() && mimic.is_none() && !options.passive;
        let has_motor = has_input || kind.is_single() && joint.damping > 0.0;
        let effort = if kind.is_turn() { "torque" } else { "force" };
        let motor = has_motor.then(|| Motor {
            input: has_input.then(|| names.unique(format!("{stem}_{effort}"))),
            field: names.unique(format!(
                "{stem}_{}",
                if has_input { "motor" } else { "damper" }
            )),
        });
        Joint {
            name: joint.name.clone(),
            kind,
            between: [body(branch.parent), body(branch.child)],
            point: clean(frame.origin),
            axis: clean(frame.rotation * joint.axis),
            limits: joint.limits,
            damping: joint.damping,
            friction: joint.friction,
            mimic,
            motor,
            field,
        }
    });
    joints.collect()
}

/// The frames of all links. Names of fields are given out last, so that others do not hang on them.
fn frames(robot: &Robot, first: usize, fields: &mut Names) -> Vec<LinkFrame> {
    let (document, tree) = (&robot.document, &robot.tree);
    let mut names = Names::new();
    let frames =
        document
            .links
            .iter()
            .enumerate()
            .zip(&tree.places)
            .map(|((number, link), place)| {
                let body = place.group.checked_sub(first);
                let centre = centre(robot, place.group, body);
                let is_fixed = body.is_some() && tree.groups[place.group].links[0] != number;
                LinkFrame {
                    link: link.name.clone(),
                    point: is_fixed.then(|| fields.field(&link.name, "point")),
                    constant: names.field(&snake_case(&link.name), "link").to_uppercase(),
                    body,
                    origin: clean(place.within.origin - centre),
                    orientation: orientation(&place.within.rotation),
                    global_origin: clean(place.global.origin),
                    global_orientation: orientation(&place.global.rotation),
                }
            });
    frames.collect()
}

/// The meshes of all links. `first` is the group that is the first body.
fn meshes(robot: &Robot, first: usize) -> Vec<Mesh> {
    let (document, tree) = (&robot.document, &robot.tree);
    let of_link = document.links.iter().zip(&tree.places);
    let meshes = of_link.flat_map(|(link, place)| {
        let body = place.group.checked_sub(first);
        let centre = centre(robot, place.group, body);
        link.visuals.iter().filter_map(move |visual| match visual {
            Visual::Mesh(frame, mesh) => {
                let mut within = place.within.compose(frame);
                within.origin -= centre;
                Some(mesh.on(body, &within))
            }
            _ => None,
        })
    });
    meshes.collect()
}

/// What frames of a group are given from, in the frame of its first link: the centre of mass, on
/// the ground the frame itself, which is global.
fn centre(robot: &Robot, group: usize, body: Option<usize>) -> Vector3<f64> {
    let inertia = robot.tree.groups[group].inertia;
    let inertia = inertia.filter(|_| body.is_some());
    inertia.map_or(Vector3::zeros(), |inertia| inertia.centre)
}

fn rows(tensor: &Matrix3<f64>) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| number(tensor[(row, column)])))
}

fn orientation(rotation: &Matrix3<f64>) -> [f64; 4] {
    euler_parameters(rotation).map(number)
}
