//! How a joint mimics another one: by a gear, or by a joint that is defined beside the struct.

use super::page::{Page, number, vector};
use crate::mechanism::{Joint, Mechanism};

/// Letters of bodies in a definition.
const LETTERS: [&str; 4] = ["i", "j", "k", "l"];

/// An equation between two joints.
#[derive(Debug)]
pub(crate) struct Coupling {
    follower_turns: bool,
    leader_turns: bool,
    /// Different bodies, in the order of `between`.
    bodies: Vec<Option<usize>>,
    /// Places in `bodies` of the leader's parent and child and the follower's parent and child.
    places: [usize; 4],
    has_offset: bool,
}

/// The couplings of a mechanism, one or none for each joint.
pub(crate) fn of(mechanism: &Mechanism) -> Vec<Option<Coupling>> {
    let couplings = mechanism.joints.iter().map(|follower| {
        let mimic = follower.mimic.as_ref()?;
        let leader = &mechanism.joints[mimic.leader];
        let ([a, b], [c, d]) = (leader.between, follower.between);
        let mut bodies: Vec<Option<usize>> = Vec::new();
        let places = [a, b, c, d].map(|body| {
            let known = bodies.iter().position(|other| *other == body);
            known.unwrap_or_else(|| {
                bodies.push(body);
                bodies.len() - 1
            })
        });
        Some(Coupling {
            follower_turns: follower.kind.is_turn(),
            leader_turns: leader.kind.is_turn(),
            bodies,
            places,
            has_offset: mimic.offset != 0.0,
        })
    });
    couplings.collect()
}

impl Coupling {
    /// Hinges beside each other on one body.
    pub(crate) fn is_gear(&self) -> bool {
        let [parent, _, carrier, _] = self.places;
        self.follower_turns && self.leader_turns && !self.has_offset && parent == carrier
    }

    /// Whether the reference configuration, with all joints at zero, violates it.
    pub(crate) fn is_off_at_zero(&self) -> bool {
        self.has_offset
    }

    /// The type of the field.
    pub(crate) fn kind(&self) -> String {
        if self.is_gear() {
            return "Gear".into();
        }
        let word = |turns: bool| if turns { "Turn" } else { "Slide" };
        let [a, b, c, d] = self.places;
        let how = match () {
            () if a == c => "Beside",
            () if b == c => "Before",
            () if a == d => "Behind",
            () => "",
        };
        let (follower, leader) = (word(self.follower_turns), word(self.leader_turns));
        format!("{follower}Mimics{leader}{how}")
    }

    /// The parameters, as keys and kinds: those of the follower, then those of the leader.
    fn parameters(&self) -> Vec<(&'static str, &'static str)> {
        let mut all = Vec::new();
        if !self.follower_turns {
            all.push(("point", "Point"));
        }
        all.push(("axis", "Axis"));
        if !self.leader_turns {
            all.push(("leader_point", "Point"));
        }
        all.push(("leader_axis", "Axis"));
        all.extend([("multiplier", "Number"), ("offset", "Number = 0.0")]);
        all
    }

    /// The definition of the joint.
    pub(crate) fn define(&self, page: &mut Page) {
        let [a, b, c, d] = self.places.map(|place| LETTERS[place]);
        let what = |turns: bool| {
            if turns {
                "angle (rad)"
            } else {
                "displacement (m)"
            }
        };
        let text = format!(
            "A joint from `{c}` to `{d}` follows one from `{a}` to `{b}`: its {} is `multiplier` times \
             the {} of the other, plus `offset`. The joints themselves are other fields.",
            what(self.follower_turns),
            what(self.leader_turns)
        );
        page.line(0, "holonom::joint! {");
        page.comment(1, "///", &text);
        page.line(1, &format!("pub joint {}(", self.kind()));
        let letters = LETTERS[..self.bodies.len()].join(", ");
        page.line(2, &format!("{letters};"));
        let parameters = self.parameters();
        for (place, (name, kind)) in parameters.iter().enumerate() {
            let end = if place + 1 == parameters.len() {
                ""
            } else {
                ","
            };
            page.line(2, &format!("{name}: {kind}{end}"));
        }
        page.line(1, ") {");
        let coordinate = |turns: bool, i: &str, j: &str, prefix: &str| {
            if turns {
                format!("angle({i}, {j}, {prefix}axis)")
            } else {
                format!("dot({i}.{prefix}axis, {j}.{prefix}point - {i}.{prefix}point)")
            }
        };
        let follower = coordinate(self.follower_turns, c, d, "");
        let leader = coordinate(self.leader_turns, a, b, "leader_");
        page.line(2, &format!("let leader = {leader};"));
        page.line(2, &format!("{follower} - multiplier * leader - offset;"));
        page.line(1, "}");
        page.line(0, "}");
        page.blank();
    }

    /// The attribute of the field.
    pub(crate) fn pairs(
        &self,
        mechanism: &Mechanism,
        follower: &Joint,
        body: impl Fn(Option<usize>) -> String,
    ) -> Vec<(&'static str, String)> {
        let mimic = follower
            .mimic
            .as_ref()
            .expect("a coupling is that of a joint that mimics");
        let leader = &mechanism.joints[mimic.leader];
        let between = |bodies: &[Option<usize>]| {
            let bodies: Vec<String> = bodies.iter().map(|one| body(*one)).collect();
            format!("[{}]", bodies.join(", "))
        };
        if self.is_gear() {
            let bodies = [leader.between[1], follower.between[1], leader.between[0]];
            return vec![
                ("between", between(&bodies)),
                ("axis_i", vector(&leader.axis)),
                ("axis_j", vector(&follower.axis)),
                ("ratio", number(mimic.multiplier)),
            ];
        }
        let mut pairs = vec![("between", between(&self.bodies))];
        for (name, _) in self.parameters() {
            let value = match name {
                "point" => vector(&follower.point),
                "axis" => vector(&follower.axis),
                "leader_point" => vector(&leader.point),
                "leader_axis" => vector(&leader.axis),
                "multiplier" => number(mimic.multiplier),
                _ if self.has_offset => number(mimic.offset),
                _ => continue,
            };
            pairs.push((name, value));
        }
        pairs
    }
}
