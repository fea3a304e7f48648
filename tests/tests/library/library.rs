//! The table of all joints: how each is described, assembled, and what it leaves free.

use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::BodyId;
use holonom_assembler::joints::{Joint, smooth_normals};
use rand_chacha::ChaCha8Rng;

use crate::data::{Data, LITERAL, Member};
use crate::freedom::{Freedom, Pair};
use crate::kernels::Kernels;

/// A joint among some bodies.
pub(crate) struct Placement {
    /// Which of them move, or are the ground.
    pub(crate) members: &'static [Member],
    /// Whether axes become known at run time.
    pub(crate) late: bool,
    pub(crate) describe: fn(&Data) -> Box<dyn Kernels>,
}

/// A joint of the library.
pub(crate) struct Entry {
    pub(crate) name: &'static str,
    pub(crate) equations: usize,
    /// With parameters for all data; the last one with the numbers of
    /// [`LITERAL`](crate::data::LITERAL).
    pub(crate) placements: Vec<Placement>,
    pub(crate) assemble: fn(&Assembler, &[BodyId], &Data) -> Joint,
    /// Of two bodies.
    pub(crate) free: Option<fn(&Pair<'_>, &Data) -> Freedom>,
}

impl Placement {
    /// Random data where there are parameters for them.
    pub(crate) fn data(&self, rng: &mut ChaCha8Rng) -> Data {
        if self.late {
            Data::random(rng)
        } else {
            LITERAL
        }
    }
}

impl Entry {
    /// The joint among bodies in the assembler.
    pub(crate) fn assembler(&self, placement: &Placement, data: &Data) -> (Assembler, Vec<BodyId>) {
        let (mut scene, bodies) = data.assembler(placement.members);
        if placement.late {
            scene = scene.with_normals(smooth_normals);
        }
        let joint = (self.assemble)(&scene, &bodies, data);
        scene.add_joint(joint);
        (scene, bodies)
    }
}

/// `placement! { param [i j] [ground, j] [Ground, J] Revolute {..} }`.
macro_rules! placement {
    ($mode:ident $bodies:tt $between:tt [$($member:ident),*] $joint:ident $attributes:tt) => {
        crate::library::Placement {
            members: &[$(crate::data::Member::$member),*],
            late: late!($mode),
            describe: describe! { $mode $bodies $between joint $joint $attributes },
        }
    };
}

/// A joint of two bodies, or of three: its name, the number of its equations, its attributes; how
/// it is assembled; what is free.
macro_rules! entry {
    (
        $equations:literal $joint:ident $attributes:tt,
        |$s:ident, $b:ident, $d:ident| $assemble:expr,
        |$p:ident, $f:ident| $free:expr $(,)?
    ) => {
        crate::library::Entry {
            name: stringify!($joint),
            equations: $equations,
            placements: Vec::from([
                placement! { param [i j] [i, j] [I, J] $joint $attributes },
                #[cfg(feature = "placements")]
                placement! { param [i] [i, ground] [I, Ground] $joint $attributes },
                placement! { literal [j] [ground, j] [Ground, J] $joint $attributes },
            ]),
            assemble: |$s, $b, $d| {
                let &[i, j] = $b else {
                    unreachable!("two bodies")
                };
                let $b = [i, j];
                $assemble
            },
            free: Some(|$p, $f| $free),
        }
    };
    (
        $equations:literal $joint:ident $attributes:tt,
        |$s:ident, $b:ident, $d:ident| $assemble:expr $(,)?
    ) => {
        crate::library::Entry {
            name: stringify!($joint),
            equations: $equations,
            placements: Vec::from([
                placement! { param [i j k] [i, j, k] [I, J, K] $joint $attributes },
                #[cfg(feature = "placements")]
                placement! { param [j k] [ground, j, k] [Ground, J, K] $joint $attributes },
                #[cfg(feature = "placements")]
                placement! { param [i k] [i, ground, k] [I, Ground, K] $joint $attributes },
                placement! { literal [i j] [i, j, ground] [I, J, Ground] $joint $attributes },
            ]),
            assemble: |$s, $b, $d| {
                let &[i, j, k] = $b else {
                    unreachable!("three bodies")
                };
                let $b = [i, j, k];
                $assemble
            },
            free: None,
        }
    };
}

mod lines;
mod links;
mod motors;
mod pairs;
mod particles;
mod shafts;
mod vectors;
mod wheels;

/// All of them.
pub(crate) fn library() -> Vec<Entry> {
    [
        pairs::entries(),
        shafts::entries(),
        lines::entries(),
        links::entries(),
        vectors::entries(),
        wheels::entries(),
        motors::entries(),
        particles::entries(),
    ]
    .into_iter()
    .flatten()
    .collect()
}
