//! Screws that carry bodies: in chains, in loops, beside slides, along tilted axes, and with the
//! carrier named last.

use holonom_engine::coordinates::candidates::Strategy;
use holonom_engine::coordinates::freedom::Freedom;
use holonom_engine::coordinates::system::Reduced;
use holonom_engine::model::ElementKind;

use crate::common::{delivered, tokens};
use crate::comparison::Extent;
use crate::library;
use crate::text::{Outcome, Text};

/// A nut on the ground carries a hinge about the same axis, that a left-handed screw which names it
/// last, and that a ball.
const CHAIN: &str = "
    #[mechanism(gravity = [0.3, -9.7, 1.1])]
    pub struct Screws {
        #[body(mass = 0.7, inertia = [0.2, 0.3, 0.4], position = [0.3, 0.5, 0.1], orientation = rotation([0.1, 0.0, 1.0], 0.3))]
        nut: Body,
        #[body(mass = 1.9, inertia = [[0.5, 0.1, 0.0], [0.1, 0.7, 0.05], [0.0, 0.05, 0.4]], position = [1.2, 1.1, 0.25])]
        arm: Body,
        #[body(mass = 1.1, inertia = [0.4, 0.2, 0.5], position = [2.3, 0.8, 0.0], orientation = rotation([1.0, 0.5, 0.0], 1.1))]
        probe: Body,
        #[body(mass = 0.4, inertia = [0.1, 0.12, 0.15], position = [2.5, 1.3, 0.4])]
        load: Body,
        #[joint(between = [ground, nut], point = [0.1, 0.2, 0.0], axis = [0.3, 0.0, 1.0], pitch = 0.8)]
        thread: Screw,
        #[joint(between = [nut, arm], point = [0.6, 0.7, 0.2], axis = [0.3, 0.0, 1.0])]
        hinge: Revolute,
        #[joint(between = [probe, arm], point = [1.9, 1.4, 0.3], axis = [0.0, 1.0, 0.0], pitch = -1.7)]
        drill: Screw,
        #[joint(between = [probe, load], point = [2.4, 1.1, 0.2])]
        hook: Spherical,
    }";

/// A boom on a hinge, which a screw jack lifts.
const JACK: &str = "
    #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = \"joints\", redundant = \"drop\")]
    pub struct Screws {
        #[body(mass = 20.0, inertia = [6.0, 6.0, 0.2], position = [0.9, 0.0, 0.5])]
        boom: Body,
        #[body(mass = 3.0, inertia = [0.1, 0.1, 0.02], position = [0.65, 0.0, 0.1])]
        tube: Body,
        #[body(mass = 2.0, inertia = [0.08, 0.08, 0.01], position = [0.8, 0.0, 0.3], orientation = rotation([0.0, 1.0, 0.0], 0.6))]
        spindle: Body,
        #[joint(between = [ground, boom], point = [0.0, 0.0, 0.5], axis = [0.0, 1.0, 0.0])]
        shoulder: Revolute,
        #[joint(between = [ground, tube], point = [0.6, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
        foot: Revolute,
        #[joint(between = [tube, spindle], point = [0.6, 0.0, 0.0], axis = [0.3, 0.0, 0.4], pitch = 0.2)]
        thread: Screw,
        #[joint(between = [spindle, boom], point = [0.9, 0.0, 0.4])]
        head: Spherical,
    }";

/// A carriage with two motions.
const CARRIAGE: &str = "
    #[mechanism(gravity = [0.3, -9.7, 1.1])]
    pub struct Screws {
        #[body(mass = 1.2, inertia = [0.2, 0.3, 0.4], position = [0.3, 0.5, 0.1])]
        base: Body,
        #[body(mass = 0.7, inertia = [0.3, 0.25, 0.2], position = [0.7, 0.6, 0.4])]
        tool: Body,
        #[joint(between = [ground, base], point = [0.0, 0.0, 0.0], axis = [0.2, 1.0, 0.0])]
        bearing: Revolute,
        #[joint(between = [base, tool], point = [0.5, 0.5, 0.5], axis = [0.0, 0.6, 0.8], side = [1.0, 0.0, 0.0], pitch = 0.9)]
        carriage: Own,
    }";

const EQUATIONS: &str = "
    Own(i, j; point: Point, axis: Axis, side: Axis, pitch: Length) {
        let arm = j.point - i.point;
        dot(i.axis.normals(), j.axis);
        dot(cross(i.axis, i.side), arm);
        dot(i.axis, arm) - pitch / TAU * angle(i, j, axis);";

fn own(motion: &str) -> (String, ElementKind, String) {
    let text = format!("{EQUATIONS} motion {motion}; }}");
    ("Own".into(), ElementKind::Joint, text)
}

/// Screws in the tree, equations that remain, and velocities.
fn shape(text: &Text) -> [usize; 3] {
    let model = delivered(&tokens(&text.item), |name| {
        let mut own = text.definitions.iter();
        let own = own.find(|(known, ..)| known == name);
        let own = own.map(|(_, kind, text)| (*kind, text.clone()));
        let (kind, text) = own.or_else(|| library::definition(name))?;
        Some((kind, tokens(&text)))
    });
    let reduced = Reduced::of(&model, Strategy::ALL[0]);
    let links = &reduced.links.links;
    let is_screw = |freedom: Freedom| matches!(freedom, Freedom::Screw { .. });
    let screws = links.iter().filter(|link| is_screw(link.freedom)).count();
    let rows = reduced.scene.constraints.iter();
    let rows = rows.map(|constrained| constrained.equations()).sum();
    [screws, rows, reduced.links.velocities]
}

fn assert_agrees(item: &str, definitions: &[(String, ElementKind, String)], wanted: [usize; 3]) {
    let text = Text {
        item: item.into(),
        definitions: definitions.into(),
    };
    assert_eq!(shape(&text), wanted, "{text}");
    for seed in 0..4 {
        compare(&text, seed);
    }
}

/// The same at the states of one seed.
fn assert_agrees_at(item: &str, seed: u64) {
    let text = Text {
        item: item.into(),
        definitions: Vec::new(),
    };
    compare(&text, seed);
}

fn compare(text: &Text, seed: u64) {
    match text.check(text, seed, Extent::Full) {
        Ok(Outcome::Compared(_)) => {}
        Ok(Outcome::Refused(why) | Outcome::RefusedOtherwise(why)) | Err(why) => {
            panic!("{text}\n{why}")
        }
    }
}

#[test]
fn screws_carry_bodies_in_chains() {
    assert_agrees(CHAIN, &[], [2, 0, 6]);
}

/// The five equations of the screw are no longer among those of the loop.
#[test]
fn a_jack_is_closed_at_its_head() {
    assert_agrees(JACK, &[], [1, 2, 3]);
    let cut = JACK.replace("pitch = 0.2", "pitch = 0.2, cut");
    assert_agrees(&cut, &[], [0, 4, 5]);
}

#[test]
fn a_screw_may_stand_beside_a_slide() {
    for motion in [
        "slide side, screw axis at point by pitch",
        "screw axis at point by pitch, slide side",
    ] {
        let is_carried = motion.starts_with("slide");
        let wanted = if is_carried { [1, 0, 3] } else { [0, 4, 7] };
        assert_agrees(CARRIAGE, &[own(motion)], wanted);
    }
    let reversed = CARRIAGE.replace("[base, tool]", "[tool, base]");
    assert_agrees(
        &reversed,
        &[own("slide side, screw axis at point by pitch")],
        [1, 0, 3],
    );
}

/// A screw between bodies that do not satisfy its equations: the angle about its axis nearest to
/// how they stand lies more than half a turn from the one that they count.
const ASKEW: &str = "
    pub struct Screws {
        #[body(mass = 1.1720051397698852, inertia = [[1.7594120222097382, 0.03839391506458177, 0.0816874326072334], [0.03839391506458177, 1.6853646241521596, 0.03774107725562326], [0.0816874326072334, 0.03774107725562326, 1.7051944997202835]], position = [-0.6272089214368235, 0.0, 0.20339726889185594], free)]
        stand: Body,
        #[body(mass = 1.4437851902398917, position = [0.0, 0.0, -0.5], free)]
        load: Particle,
        #[body(mass = 0.9059503948688732, inertia = [[0.5952507058912768, -0.05770593761716861, -0.03906232501007838], [-0.05770593761716861, 0.4168469551253504, -0.0860990697000303], [-0.03906232501007838, -0.0860990697000303, 0.5349840194102293]], position = [0.25, 0.0, 0.0], free)]
        nut: Body,
        #[joint(point = local([0.0, -0.5, 0.5], [0.6272089214368235, -0.5, 0.29660273110814406]), between = [ground, stand])]
        foot: Spherical,
        #[body(mass = 1.7880795709644117, inertia = [1.2239937865437078, 1.3765594281818743, 0.9696079687702954], position = [0.0, 0.14602567433409064, 0.6858349541921203], free)]
        spindle: Body,
        #[joint(between = [nut, spindle], point = [1.0, -0.5, 0.25], axis = [0.0, 1.0, 0.0], pitch = 0.46115256387759807)]
        thread: Screw,
    }";

#[test]
fn the_angle_of_a_screw_is_the_one_that_placed_its_bodies() {
    assert_agrees_at(ASKEW, 16939);
}

/// One of whose states has the axes of both bodies opposed: the equations hold, and no angle is
/// nearer than another.
const OPPOSED: &str = "
    pub struct Screws {
        #[body(mass = 0.9, inertia = [0.6, 0.4, 0.5], position = [0.25, 0.0, 0.0])]
        nut: Body,
        #[body(mass = 1.8, inertia = [1.2, 1.4, 1.0], position = [0.0, 0.15, 0.7])]
        spindle: Body,
        #[joint(between = [nut, spindle], point = [1.0, -0.5, 0.25], axis = [0.0, 1.0, 0.0], pitch = 0.46)]
        thread: Screw,
    }";

#[test]
fn no_joint_coordinates_describe_the_other_side_of_a_joint() {
    assert_agrees_at(OPPOSED, 81);
}
