//! Joints whose position follows that of another one.

use crate::document::{Document, Joint};
use crate::faults::{Collector, advice, is_like};

/// Refuses what mimics a joint that has no position, or itself. What mimics a joint that is not
/// there moves by itself, unless its name may be misspelt.
pub(crate) fn judge(document: &mut Document, faults: &mut Collector) {
    let names: Vec<String> = document.joints.iter().map(|one| one.name.clone()).collect();
    for joint in &mut document.joints {
        let leader = joint.mimic.as_ref().map(|mimic| &*mimic.joint);
        let Some(leader) = leader else { continue };
        let is_single = joint.kind.is_some_and(|kind| kind.is_single());
        if is_single
            && !names
                .iter()
                .any(|name| name == leader || is_like(leader, name))
        {
            let message = format!(
                "joint \"{}\": it mimics \"{leader}\", which is no joint, and moves by itself",
                joint.name
            );
            faults.note(joint.line, message);
            joint.mimic = None;
        }
    }
    refuse(document, faults);
}

fn refuse(document: &Document, faults: &mut Collector) {
    let find = |name: &str| document.joints.iter().find(|joint| joint.name == name);
    let is_single = |joint: &Joint| joint.kind.is_none_or(|kind| kind.is_single());
    for joint in &document.joints {
        let Some(mimic) = &joint.mimic else { continue };
        let mut refuse = |message: String| {
            faults.at(mimic.line, format!("joint \"{}\": {message}", joint.name));
        };
        if !is_single(joint) {
            refuse(
                "it mimics another one; only a revolute, continuous or prismatic joint can".into(),
            );
        }
        let Some(leader) = find(&mimic.joint) else {
            let names = document.joints.iter().map(|joint| &*joint.name);
            let advice = advice(&mimic.joint, names);
            refuse(format!(
                "it mimics \"{}\", which is no joint; {advice}",
                mimic.joint
            ));
            continue;
        };
        if !is_single(leader) {
            refuse(format!(
                "it mimics \"{}\", which has no position; a revolute, continuous or prismatic joint has",
                mimic.joint
            ));
        }
        let next = |joint: &&Joint| find(&joint.mimic.as_ref()?.joint);
        let chain = std::iter::successors(Some(leader), next).take(document.joints.len());
        if chain.into_iter().any(|other| other.name == joint.name) {
            refuse(format!(
                "it mimics \"{}\", which follows it in turn",
                mimic.joint
            ));
        }
    }
}
