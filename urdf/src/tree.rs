//! The tree of links, and what is carried together.

use std::collections::{HashMap, HashSet};

use crate::document::{Document, JointKind};
use crate::faults::{Collector, advice};
use crate::spatial::{Frame, Inertia};

/// The links from the root outwards.
#[derive(Debug)]
pub(crate) struct Tree {
    /// Joints with their parent and child links, each after the one that carries its parent.
    pub(crate) joints: Vec<Branch>,
    /// The first is that of the root, the others are in the order of `joints`.
    pub(crate) groups: Vec<Group>,
    /// Of each link, by its place in the document: its group, its frame in that of the group's
    /// first link, and its frame at the zero configuration.
    pub(crate) places: Vec<Place>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Branch {
    /// Places in the document.
    pub(crate) joint: usize,
    pub(crate) parent: usize,
    pub(crate) child: usize,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) group: usize,
    pub(crate) within: Frame,
    pub(crate) global: Frame,
}

/// Links that joints of the type `fixed` hold together: one body, with the frame of the first.
#[derive(Debug)]
pub(crate) struct Group {
    /// Places in the document, the link that a moving joint carries first.
    pub(crate) links: Vec<usize>,
    /// The place of the joint that carries it; the root has none.
    pub(crate) joint: Option<usize>,
    /// In the frame of the first link. Nothing where a part was refused.
    pub(crate) inertia: Option<Inertia>,
}

/// The tree, unless the links form none.
pub(crate) fn grow(document: &Document, faults: &mut Collector) -> Option<Tree> {
    let links = names(document, faults)?;
    let mut parents: HashMap<usize, usize> = HashMap::new();
    let mut children: Vec<Vec<Branch>> = vec![Vec::new(); document.links.len()];
    let mut is_sound = true;
    for (place, joint) in document.joints.iter().enumerate() {
        let mut end = |role: &str, name: &str| {
            let link = links.get(name).copied();
            if link.is_none() {
                let advice = advice(name, links.keys().copied());
                let message = format!(
                    "joint \"{}\": {role} \"{name}\" is no link; {advice}",
                    joint.name
                );
                faults.at(joint.line, message);
            }
            link
        };
        let ends = (end("parent", &joint.parent), end("child", &joint.child));
        let (Some(parent), Some(child)) = ends else {
            is_sound = false;
            continue;
        };
        if let Some(other) = parents.insert(child, place) {
            is_sound = false;
            let other = &document.joints[other];
            let message = format!(
                "joint \"{}\": link \"{}\" is the child of joint \"{}\" (line {}) already; a URDF is \
                 a tree; close a loop in the struct that is printed",
                joint.name, joint.child, other.name, other.line
            );
            faults.at(joint.line, message);
            continue;
        }
        children[parent].push(Branch {
            joint: place,
            parent,
            child,
        });
    }
    if !is_sound {
        return None;
    }
    let roots = (0..document.links.len()).filter(|link| !parents.contains_key(link));
    let roots: Vec<usize> = roots.collect();
    let tree = walk(document, &children, *roots.first().unwrap_or(&0));
    one_root(document, &roots, &tree, faults).then_some(tree)
}

/// The links by their names.
fn names<'a>(document: &'a Document, faults: &mut Collector) -> Option<HashMap<&'a str, usize>> {
    let mut links: HashMap<&str, usize> = HashMap::new();
    let mut is_sound = true;
    for (place, link) in document.links.iter().enumerate() {
        if let Some(other) = links.insert(&link.name, place) {
            is_sound = false;
            let line = document.links[other].line;
            let message = format!(
                "link \"{}\": line {line} has a link of that name",
                link.name
            );
            faults.at(link.line, message);
        }
    }
    let mut joints: HashMap<&str, usize> = HashMap::new();
    for joint in &document.joints {
        if let Some(line) = joints.insert(&joint.name, joint.line) {
            let message = format!(
                "joint \"{}\": line {line} has a joint of that name",
                joint.name
            );
            faults.at(joint.line, message);
        }
    }
    if document.links.is_empty() {
        faults.at(
            1,
            format!(
                "robot \"{}\": no <link>; one at least is needed",
                document.name
            ),
        );
    }
    (is_sound && !links.is_empty()).then_some(links)
}

/// Whether all links hang on one. Those that do not are named.
fn one_root(document: &Document, roots: &[usize], tree: &Tree, faults: &mut Collector) -> bool {
    let name = |link: usize| &document.links[link].name;
    if let [first, others @ ..] = roots {
        for &other in others {
            let message = format!(
                "link \"{}\": no joint has it as its child, nor link \"{}\" (line {}); one such link, \
                 the root, is accepted",
                name(other),
                name(*first),
                document.links[*first].line
            );
            faults.at(document.links[other].line, message);
        }
    }
    let reached: HashSet<usize> = tree.joints.iter().map(|branch| branch.joint).collect();
    // What a second root carries is no circle, but what it means is said by its root.
    let mut circle = (0..document.joints.len()).filter(|joint| !reached.contains(joint));
    match circle.next() {
        Some(joint) if roots.len() <= 1 => {
            let joint = &document.joints[joint];
            let message = format!(
                "joint \"{}\": its links \"{}\" and \"{}\" are in a circle of joints that no root \
                 carries; a URDF is a tree",
                joint.name, joint.parent, joint.child
            );
            faults.at(joint.line, message);
            false
        }
        _ => roots.len() == 1,
    }
}

fn walk(document: &Document, children: &[Vec<Branch>], root: usize) -> Tree {
    let at_rest = Place {
        group: 0,
        within: Frame::IDENTITY,
        global: Frame::IDENTITY,
    };
    let mut tree = Tree {
        joints: Vec::new(),
        groups: vec![Group {
            links: vec![root],
            joint: None,
            inertia: document.links[root].inertia,
        }],
        places: vec![at_rest; document.links.len()],
    };
    let mut left: Vec<Branch> = children[root].iter().rev().copied().collect();
    let mut seen = HashSet::from([root]);
    while let Some(branch) = left.pop() {
        if !seen.insert(branch.child) {
            continue;
        }
        let joint = &document.joints[branch.joint];
        let parent = tree.places[branch.parent];
        let global = parent.global.compose(&joint.origin);
        let own = document.links[branch.child].inertia;
        let mut place = Place {
            group: parent.group,
            within: Frame::IDENTITY,
            global,
        };
        if joint.kind == Some(JointKind::Fixed) {
            place.within = parent.within.compose(&joint.origin);
            let group = &mut tree.groups[place.group];
            group.links.push(branch.child);
            let both = group.inertia.zip(own);
            group.inertia = both.map(|(all, own)| all.plus(&own.carried(&place.within)));
        } else {
            place.group = tree.groups.len();
            // Of a joint that was refused it is not known what moves.
            let inertia = joint.kind.and(own);
            let (links, joint) = (vec![branch.child], Some(branch.joint));
            tree.groups.push(Group {
                links,
                joint,
                inertia,
            });
        }
        tree.places[branch.child] = place;
        tree.joints.push(branch);
        left.extend(children[branch.child].iter().rev().copied());
    }
    tree
}
