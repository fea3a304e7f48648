//! Constants beside the struct: limits of joints and frames of links.

use super::page::{Page, name, number, vector};
use crate::mechanism::{Joint, Mechanism};

/// A program need not use all constants, and files give pi by some figures.
const ALLOW: &str = "#[allow(dead_code, clippy::approx_constant)]";

/// What the file says of the joints with one coordinate, as arrays.
pub(crate) fn limits(page: &mut Page, mechanism: &Mechanism) {
    let joints: Vec<&Joint> = mechanism
        .joints
        .iter()
        .filter(|j| j.kind.is_single())
        .collect();
    if joints.is_empty() {
        return;
    }
    let text = "What the file says of its joints, in the order of the fields; of a slide m and N in the \
                place of rad and N m. A run holds joints within their positions, unless it says \
                `.without_limits()`; nothing holds rates and efforts.";
    page.comment(0, "///", text);
    page.line(0, ALLOW);
    page.line(0, &format!("impl {} {{", mechanism.name));
    table(
        page,
        &joints,
        "Names in the file.",
        "JOINT_NAMES: [&str",
        |joint| format!("{:?}", joint.name),
    );
    page.blank();
    let text = "Lowest and highest positions (rad).";
    table(page, &joints, text, "POSITION_LIMITS: [[f64; 2]", |joint| {
        vector(&joint.limits.position)
    });
    page.blank();
    table(
        page,
        &joints,
        "Largest rates (rad/s).",
        "RATE_LIMITS: [f64",
        |joint| number(joint.limits.rate),
    );
    page.blank();
    table(
        page,
        &joints,
        "Largest efforts (N m).",
        "EFFORT_LIMITS: [f64",
        |joint| number(joint.limits.effort),
    );
    if joints.iter().any(|joint| joint.friction > 0.0) {
        page.blank();
        let text = "Dry friction (N m), which the mechanism does not have.";
        table(page, &joints, text, "FRICTION: [f64", |joint| {
            number(joint.friction)
        });
    }
    page.line(0, "}");
    page.blank();
}

/// One array, a row for each joint.
fn table(
    page: &mut Page,
    joints: &[&Joint],
    text: &str,
    head: &str,
    entry: impl Fn(&Joint) -> String,
) {
    page.comment(1, "///", text);
    page.line(1, "#[rustfmt::skip]");
    page.line(1, &format!("pub const {head}; {}] = [", joints.len()));
    for joint in joints {
        page.line(2, &format!("{},", entry(joint)));
    }
    page.line(1, "];");
}

/// The origin of each link's frame on its body, and its axes where they are others.
pub(crate) fn frames(page: &mut Page, mechanism: &Mechanism) {
    if mechanism.frames.is_empty() {
        return;
    }
    let text = "Frames of the links on their bodies: origins (m) from the centre of mass in axes of the \
                body, as `View::point` takes them; on the ground global. Where a frame has other axes \
                than its body, Euler parameters, scalar first, turn them to those of the body.";
    page.comment(0, "///", text);
    page.line(0, ALLOW);
    page.line(0, "#[rustfmt::skip]");
    page.line(0, &format!("impl {} {{", mechanism.name));
    for frame in &mechanism.frames {
        let body = match frame.body {
            Some(body) => format!("`{}`", mechanism.bodies[body].field),
            None => "the ground".into(),
        };
        page.comment(1, "///", &format!("Link {}, on {body}.", name(&frame.link)));
        let constant = &frame.constant;
        let origin = vector(&frame.origin);
        page.line(
            1,
            &format!("pub const {constant}_ORIGIN: [f64; 3] = {origin};"),
        );
        if frame.orientation != [1.0, 0.0, 0.0, 0.0] {
            page.comment(1, "///", &format!("Axes of {}.", name(&frame.link)));
            let axes = vector(&frame.orientation);
            page.line(1, &format!("pub const {constant}_AXES: [f64; 4] = {axes};"));
        }
    }
    page.line(0, "}");
    page.blank();
}
