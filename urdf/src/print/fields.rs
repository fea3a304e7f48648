//! The struct: bodies with their joints and motors.

use super::couplings::Coupling;
use super::page::{Page, name, names, number, tensor, vector};
use super::{points, shapes};
use crate::document::JointKind;
use crate::mechanism::{Body, Joint, Mechanism};

/// The joint of the crate `holonom` that has the motion.
pub(crate) fn kind(kind: JointKind) -> Option<&'static str> {
    match kind {
        JointKind::Revolute | JointKind::Continuous => Some("Revolute"),
        JointKind::Prismatic => Some("Prismatic"),
        JointKind::Planar => Some("Planar"),
        JointKind::Floating | JointKind::Fixed => None,
    }
}

fn word(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "revolute",
        JointKind::Continuous => "continuous",
        JointKind::Prismatic => "prismatic",
        JointKind::Planar => "planar",
        JointKind::Floating => "floating",
        JointKind::Fixed => "fixed",
    }
}

pub(crate) fn describe(page: &mut Page, mechanism: &Mechanism, couplings: &[Option<Coupling>]) {
    title(page, mechanism, couplings);
    page.line(0, "#[derive(Clone, Copy, Debug, Mechanism)]");
    page.line(
        0,
        "#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = \"joints\")]",
    );
    page.line(0, &format!("pub struct {} {{", mechanism.name));
    for (place, one) in mechanism.bodies.iter().enumerate() {
        body(page, one);
        points::on_body(page, mechanism, place);
        let carried = |(joint, _): &(&Joint, &Option<Coupling>)| joint.between[1] == Some(place);
        let mut joints = mechanism.joints.iter().zip(couplings);
        if let Some((carrier, coupling)) = joints.find(carried) {
            joint(page, mechanism, carrier);
            motor(page, mechanism, carrier);
            mimic(page, mechanism, carrier, coupling.as_ref());
        }
    }
    page.line(0, "}");
    page.blank();
}

fn title(page: &mut Page, mechanism: &Mechanism, couplings: &[Option<Coupling>]) {
    let robot = name(&mechanism.robot);
    page.comment(
        0,
        "///",
        &format!("The robot {robot}, with all joints at zero in the reference configuration."),
    );
    page.line(0, "///");
    let text = match &mechanism.ground[..] {
        [] => "The root link floats: global axes are those of its frame at the start.".into(),
        [root] => format!("The ground is the link {}.", name(root)),
        [root, others @ ..] => {
            format!(
                "The ground is the link {}, with {} fixed to it.",
                name(root),
                names(others)
            )
        }
    };
    let mass = mechanism.ground_mass;
    let mass = if mass > 0.0 {
        format!(" Its mass of {} kg has no effect.", number(mass))
    } else {
        String::new()
    };
    page.comment(
        0,
        "///",
        &format!("{text}{mass} Bodies have the axes of their links."),
    );
    if !mechanism.notes.is_empty() {
        page.line(0, "///");
        let notes = mechanism.notes.iter().map(|note| name(&note.to_string()));
        let notes = notes.collect::<Vec<_>>().join("; ");
        page.comment(0, "///", &format!("Of the file: {notes}."));
    }
    if couplings.iter().flatten().any(Coupling::is_off_at_zero) {
        page.line(0, "///");
        let text = "A joint that mimics with an offset is not satisfied with all joints at zero: start \
                    with `assembled`, or call `assemble`.";
        page.comment(0, "///", text);
    }
}

fn body(page: &mut Page, body: &Body) {
    let [first, fixed @ ..] = &body.links[..] else {
        return;
    };
    let text = match fixed {
        [] => format!("Link {}.", name(first)),
        _ => format!(
            "Link {}, with {} fixed to it: mass, centre of mass and inertia are those of all.",
            name(first),
            names(fixed)
        ),
    };
    page.comment(1, "///", &text);
    if !body.visuals.is_empty() {
        let text = format!("Visuals that are not drawn: {}.", names(&body.visuals));
        page.comment(1, "//", &text);
    }
    let mut pairs = vec![
        ("mass", number(body.mass)),
        ("inertia", tensor(&body.inertia)),
        ("position", vector(&body.position)),
    ];
    if body.orientation != [1.0, 0.0, 0.0, 0.0] {
        pairs.push(("orientation", vector(&body.orientation)));
    }
    pairs.extend(shapes::pair(&body.shapes));
    if body.is_free {
        pairs.push(("free", String::new()));
    }
    if body.is_as_given {
        pairs.push(("as_given", String::new()));
    }
    page.attribute("body", &pairs);
    page.line(1, &format!("{}: Body,", body.field));
}

/// A body in the code.
fn field(mechanism: &Mechanism, body: Option<usize>) -> String {
    body.map_or("ground".into(), |body| mechanism.bodies[body].field.clone())
}

fn between(mechanism: &Mechanism, joint: &Joint) -> (&'static str, String) {
    let [parent, child] = joint.between.map(|body| field(mechanism, body));
    ("between", format!("[{parent}, {child}]"))
}

fn joint(page: &mut Page, mechanism: &Mechanism, joint: &Joint) {
    let title = format!("Joint {}, {}", name(&joint.name), word(joint.kind));
    let Some(kind) = kind(joint.kind) else {
        let text = format!("{title}: no joint is needed, the body is free.");
        page.comment(1, "//", &text);
        return left_out(page, joint);
    };
    page.comment(1, "///", &format!("{title}{}.", ranges(joint)));
    left_out(page, joint);
    let axis = if joint.kind == JointKind::Planar {
        "normal"
    } else {
        "axis"
    };
    let mut pairs = vec![
        between(mechanism, joint),
        ("point", vector(&joint.point)),
        (axis, vector(&joint.axis)),
    ];
    if joint.limits.leave_a_range() {
        pairs.push(("limits", vector(&joint.limits.position)));
    }
    page.attribute("joint", &pairs);
    page.line(1, &format!("{}: {kind},", joint.field));
}

/// What acts in the joint by the file, and not here.
fn left_out(page: &mut Page, joint: &Joint) {
    let [lower, upper] = joint.limits.position;
    if lower.is_finite() && !joint.limits.leave_a_range() {
        let text = format!("Limits from {lower} to {upper} are left out: they leave no range.");
        page.comment(1, "//", &text);
    }
    let mut say = |what: &str, amount: f64, unit: &str, reason: &str| {
        if amount > 0.0 {
            let text = format!("{what} of {}{unit} is left out: {reason}.", number(amount));
            page.comment(1, "//", &text);
        }
    };
    if joint.kind.is_single() {
        let unit = if joint.kind.is_turn() { " N m" } else { " N" };
        let reason = "a run takes it as an `Interaction::friction`";
        say("Dry friction", joint.friction, unit, reason);
    } else {
        let reason = "the joint has more than one motion";
        say("Damping", joint.damping, "", reason);
        say("Dry friction", joint.friction, "", reason);
    }
}

/// What the file says of the range, for a comment.
fn ranges(joint: &Joint) -> String {
    let is_turn = joint.kind.is_turn();
    let [position, rate, effort] = if is_turn {
        ["rad", "rad/s", "N m"]
    } else {
        ["m", "m/s", "N"]
    };
    let mut parts = Vec::new();
    let [lower, upper] = joint.limits.position;
    if lower.is_finite() {
        parts.push(format!("from {lower} to {upper} {position}"));
    }
    for (limit, unit) in [(joint.limits.rate, rate), (joint.limits.effort, effort)] {
        if limit.is_finite() && joint.kind.is_single() {
            parts.push(format!("at most {limit} {unit}"));
        }
    }
    if parts.is_empty() {
        return String::new();
    }
    format!(": {}", parts.join(", "))
}

fn motor(page: &mut Page, mechanism: &Mechanism, joint: &Joint) {
    let Some(motor) = &joint.motor else { return };
    let is_turn = joint.kind.is_turn();
    let unit = if is_turn { "N m" } else { "N" };
    if let Some(input) = &motor.input {
        let child = field(mechanism, joint.between[1]);
        let text = format!("Effort of {} ({unit}), on `{child}`.", name(&joint.name));
        page.comment(1, "///", &text);
        page.line(1, "#[input]");
        page.line(1, &format!("pub {input}: f64,"));
    }
    let damping = match &motor.input {
        Some(input) if joint.damping > 0.0 => format!("{input} - {} * rate", number(joint.damping)),
        Some(input) => input.clone(),
        None => format!("-{} * rate", number(joint.damping)),
    };
    let mut pairs = vec![between(mechanism, joint)];
    if !is_turn {
        pairs.push(("point", vector(&joint.point)));
    }
    pairs.push(("axis", vector(&joint.axis)));
    pairs.push((if is_turn { "moment" } else { "force" }, damping));
    page.attribute("force", &pairs);
    let kind = if is_turn {
        "TorsionalActuator"
    } else {
        "SlideActuator"
    };
    page.line(1, &format!("{}: {kind},", motor.field));
}

fn mimic(page: &mut Page, mechanism: &Mechanism, joint: &Joint, coupling: Option<&Coupling>) {
    let (Some(mimic), Some(coupling)) = (&joint.mimic, coupling) else {
        return;
    };
    let leader = &mechanism.joints[mimic.leader];
    let offset = if mimic.offset == 0.0 {
        String::new()
    } else {
        format!(", plus {}", number(mimic.offset))
    };
    let text = format!(
        "{} mimics {}: its position is {} times that of the other{offset}.",
        name(&joint.name),
        name(&leader.name),
        number(mimic.multiplier)
    );
    page.comment(1, "///", &text);
    page.attribute(
        "joint",
        &coupling.pairs(mechanism, joint, |body| field(mechanism, body)),
    );
    page.line(1, &format!("{}: {},", mimic.field, coupling.kind()));
}
