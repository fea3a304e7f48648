//! Links that are fixed to a body, as points of it.

use super::page::{Page, name, vector};
use crate::mechanism::Mechanism;

/// The origins of links that are fixed to the first link of a body, in the order of the file.
pub(super) fn on_body(page: &mut Page, mechanism: &Mechanism, body: usize) {
    for frame in &mechanism.frames {
        let Some(field) = frame.point.as_ref().filter(|_| frame.body == Some(body)) else {
            continue;
        };
        page.comment(1, "///", &format!("Origin of link {}.", name(&frame.link)));
        let pairs = [
            ("on", mechanism.bodies[body].field.clone()),
            ("at", vector(&frame.global_origin)),
        ];
        page.attribute("point", &pairs);
        page.line(1, &format!("{field}: Point,"));
    }
}

#[cfg(test)]
mod tests {
    use super::{Page, on_body};
    use crate::{Options, Robot};

    #[test]
    fn links_that_are_fixed_are_points() {
        let robot = Robot::parse(include_str!("../../arm.urdf")).expect("sound");
        let arm = robot.mechanism(&Options::default()).expect("it moves");
        let printed = |body: usize| {
            let mut page = Page::default();
            on_body(&mut page, &arm, body);
            page.finish()
        };
        assert_eq!(printed(0).trim(), "");
        // The frames behind the elbow are turned by 0.5 rad about y.
        let (sine, cosine) = 0.5_f64.sin_cos();
        let at = format!("[{:?}, 0.0, {:?}]", 0.3 * sine, 0.7 + 0.3 * cosine);
        let wanted = [
            "    /// Origin of link `tip`.",
            &format!("    #[point(on = forearm, at = {at})]"),
            "    tip: Point,\n",
        ];
        assert_eq!(printed(1), wanted.join("\n"));
    }
}
