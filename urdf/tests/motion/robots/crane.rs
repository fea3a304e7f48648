// The robot `crane` of `crane.urdf`, printed by holonom-urdf 0.1.0. Read it and change it: nothing
// here is bound to the file.

use holonom::forces::TorsionalActuator;
use holonom::joints::{Gear, Planar, Prismatic, Revolute};
use holonom::prelude::*;

holonom::force! {
    /// A motor of a slide: `force` (N) pushes `j` along `axis`, and `i` the opposite way. It is an
    /// expression of `travel` (m, zero in the reference configuration), `rate` (m/s) and `time`
    /// (s).
    pub force SlideActuator(i, j; point: Point, axis: Axis, force: Law(travel, rate)) {
        let d = dot(i.axis, j.point - i.point);
        force(d, rate(d)) along d;
    }
}

holonom::joint! {
    /// A joint from `j` to `k` follows one from `i` to `j`: its displacement (m) is `multiplier`
    /// times the displacement (m) of the other, plus `offset`. The joints themselves are other
    /// fields.
    pub joint SlideMimicsSlideBefore(
        i, j, k;
        point: Point,
        axis: Axis,
        leader_point: Point,
        leader_axis: Axis,
        multiplier: Number,
        offset: Number = 0.0
    ) {
        let leader = dot(i.leader_axis, j.leader_point - i.leader_point);
        dot(j.axis, k.point - j.point) - multiplier * leader - offset;
    }
}

holonom::joint! {
    /// A joint from `j` to `k` follows one from `i` to `j`: its angle (rad) is `multiplier` times
    /// the displacement (m) of the other, plus `offset`. The joints themselves are other fields.
    pub joint TurnMimicsSlideBefore(
        i, j, k;
        axis: Axis,
        leader_point: Point,
        leader_axis: Axis,
        multiplier: Number,
        offset: Number = 0.0
    ) {
        let leader = dot(i.leader_axis, j.leader_point - i.leader_point);
        angle(j, k, axis) - multiplier * leader - offset;
    }
}

/// The robot `crane`, with all joints at zero in the reference configuration.
///
/// The ground is the link `yard`. Bodies have the axes of their links.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Crane {
    /// Link `cart`, with `cab` fixed to it: mass, centre of mass and inertia are those of all.
    #[body(
        mass = 15.0,
        inertia = [
            [1.7967578742892112, 0.09405780565677224, 0.19154043361315415],
            [0.09405780565677224, 1.640031090914722, -0.37625883931996534],
            [0.19154043361315415, -0.37625883931996534, 1.5375310347960676],
        ],
        position = [0.2440890855047734, 0.001154102928911313, 0.5],
        orientation = [0.9800665778412416, 0.0, 0.0, 0.19866933079506124]
    )]
    cart: Body,
    /// Origin of link `cab`.
    #[point(on = cart, at = [0.08317449730740487, 0.1763182982008655, 0.7])]
    cab: Point,
    /// Joint `drive`, planar.
    #[joint(between = [ground, cart], point = [0.2, -0.1, 0.3], normal = [0.0, 0.0, 1.0])]
    drive: Planar,
    /// Link `mast`.
    #[body(
        mass = 5.0,
        inertia = [
            [0.5241766773367914, 0.02231540330314421, -0.17933902272488067],
            [0.02231540330314421, 0.65, 0.0014222430938558408],
            [-0.17933902272488067, 0.0014222430938558408, 0.17582332266320866],
        ],
        position = [0.25773073284855486, -0.10814940088130114, 1.3992501562369797],
        orientation = [0.9797603229869384, 0.024499112269074745, 0.004966215917995095, 0.1986072498626707]
    )]
    mast: Body,
    /// Joint `type`, continuous.
    // Dry friction of 0.2 N m is left out: a run takes it as an `Interaction::friction`.
    #[joint(
        between = [cart, mast],
        point = [0.2, -0.1, 0.8],
        axis = [0.038925610494702, -0.09206772665577886, 1.9975005207899326]
    )]
    type_joint: Revolute,
    /// Effort of `type` (N m), on `mast`.
    #[input]
    pub type_torque: f64,
    #[force(
        between = [cart, mast],
        axis = [0.038925610494702, -0.09206772665577886, 1.9975005207899326],
        moment = type_torque - 0.7 * rate
    )]
    type_motor: TorsionalActuator,
    /// Link `boom`.
    #[body(
        mass = 2.0,
        inertia = [0.01, 0.2, 0.21],
        position = [0.7582988799521916, 0.06291200580648867, 2.146075754151453],
        orientation = [0.9695008127110059, 0.05390351016196416, -0.14150310227239932, 0.19271600294787425]
    )]
    boom: Body,
    /// Joint `boom`, prismatic: from 0 to 1.5 m, at most 0.5 m/s, at most 400 N.
    #[joint(
        between = [mast, boom],
        point = [0.31546146569710976, -0.11629880176260227, 1.9985003124739595],
        axis = [0.8856748285101637, 0.3584216151381819, 0.2951508833549871],
        limits = [0.0, 1.5]
    )]
    boom_joint: Prismatic,
    /// Effort of `boom` (N), on `boom`.
    #[input]
    pub boom_force: f64,
    #[force(
        between = [mast, boom],
        point = [0.31546146569710976, -0.11629880176260227, 1.9985003124739595],
        axis = [0.8856748285101637, 0.3584216151381819, 0.2951508833549871],
        force = boom_force - 20.0 * rate
    )]
    boom_motor: SlideActuator,
    /// Link `tip`.
    #[body(
        mass = 1.0,
        inertia = [
            [0.004, 0.0, 0.001],
            [0.0, 0.05, 0.0],
            [0.001, 0.0, 0.051],
        ],
        position = [1.3612757175742716, 0.31455392394536313, 2.4027739186510435],
        orientation = [0.959275975299156, 0.15042279570907707, -0.12155667914399328, 0.20587996381484636]
    )]
    tip: Body,
    /// Joint `tip`, prismatic: from 0 to 1 m, at most 0.5 m/s, at most 100 N.
    #[joint(
        between = [boom, tip],
        point = [1.0998888809931624, 0.19832771094329532, 2.3118432358573986],
        axis = [0.8856748285101637, 0.3584216151381819, 0.2951508833549871],
        limits = [0.0, 1.0]
    )]
    tip_joint: Prismatic,
    /// `tip` mimics `boom`: its position is 0.8 times that of the other.
    #[joint(
        between = [mast, boom, tip],
        point = [1.0998888809931624, 0.19832771094329532, 2.3118432358573986],
        axis = [0.8856748285101637, 0.3584216151381819, 0.2951508833549871],
        leader_point = [0.31546146569710976, -0.11629880176260227, 1.9985003124739595],
        leader_axis = [0.8856748285101637, 0.3584216151381819, 0.2951508833549871],
        multiplier = 0.8
    )]
    tip_mimic: SlideMimicsSlideBefore,
    /// Link `load`.
    #[body(
        mass = 8.0,
        inertia = [0.3, 0.4, 0.5],
        position = [1.7169311403017284, 0.5827037387908733, 2.0263368095838414],
        orientation = [0.959275975299156, 0.15042279570907707, -0.12155667914399328, 0.20587996381484636]
    )]
    load: Body,
    // Joint `hook`, floating: no joint is needed, the body is free.
    /// Link `flag`.
    #[body(
        mass = 0.2,
        inertia = [0.002, 0.0005, 0.0021],
        position = [1.622392603260849, 0.5681071881382046, 2.3277491612272576],
        orientation = [0.959275975299156, 0.15042279570907707, -0.12155667914399328, 0.20587996381484636]
    )]
    flag: Body,
    /// Joint `flag`, revolute: from -1 to 1 rad, at most 1 rad/s, at most 1 N m.
    #[joint(
        between = [load, flag],
        point = [1.6655487229802477, 0.48110990353207206, 2.303894983355771],
        axis = [0.7144001041052278, 0.019775497608844173, 1.2203447959280862],
        limits = [-1.0, 1.0]
    )]
    flag_joint: Revolute,
    /// Effort of `flag` (N m), on `flag`.
    #[input]
    pub flag_torque: f64,
    #[force(
        between = [load, flag],
        axis = [0.7144001041052278, 0.019775497608844173, 1.2203447959280862],
        moment = flag_torque
    )]
    flag_motor: TorsionalActuator,
    /// Link `drum`.
    #[body(
        mass = 0.4,
        inertia = [0.0008, 0.0012, 0.0008],
        position = [0.3735117780777941, -0.08795871710156267, 2.1287001620664614],
        orientation = [0.9695008127110059, 0.05390351016196416, -0.14150310227239932, 0.19271600294787425]
    )]
    drum: Body,
    /// Joint `drum`, revolute: from -9 to 9 rad, at most 2 rad/s, at most 10 N m.
    #[joint(
        between = [boom, drum],
        point = [0.378669087821937, -0.09636252208571633, 2.1234296575373595],
        axis = [-0.38893167078334084, 0.919909907600028, 0.04997916927067833],
        limits = [-9.0, 9.0]
    )]
    drum_joint: Revolute,
    /// `drum` mimics `boom`: its position is 4.0 times that of the other.
    #[joint(
        between = [mast, boom, drum],
        axis = [-0.38893167078334084, 0.919909907600028, 0.04997916927067833],
        leader_point = [0.31546146569710976, -0.11629880176260227, 1.9985003124739595],
        leader_axis = [0.8856748285101637, 0.3584216151381819, 0.2951508833549871],
        multiplier = 4.0
    )]
    drum_mimic: TurnMimicsSlideBefore,
    /// Link `pulley`.
    #[body(
        mass = 0.5,
        inertia = [0.001, 0.0018, 0.001],
        position = [0.38139002367915725, -0.015441259667811121, 0.9186407817193445],
        orientation = [0.8088838516750253, 0.5533872166040865, 0.11217714232785982, 0.16396887429543613]
    )]
    pulley: Body,
    /// Joint `pulley`, continuous.
    #[joint(
        between = [cart, pulley],
        point = [0.38421219880057705, -0.02211633153826989, 0.8999999999999999],
        axis = [-0.14110875607099124, 0.3337535935229384, 0.9320390859672263]
    )]
    pulley_joint: Revolute,
    /// `pulley` mimics `type`: its position is -2.5 times that of the other.
    #[joint(
        between = [mast, pulley, cart],
        axis_i = [0.038925610494702, -0.09206772665577886, 1.9975005207899326],
        axis_j = [-0.14110875607099124, 0.3337535935229384, 0.9320390859672263],
        ratio = -2.5
    )]
    pulley_mimic: Gear,
}

/// What the file says of its joints, in the order of the fields; of a slide m and N in the place of
/// rad and N m. A run holds joints within their positions, unless it says `.without_limits()`;
/// nothing holds rates and efforts.
#[allow(dead_code, clippy::approx_constant)]
impl Crane {
    /// Names in the file.
    #[rustfmt::skip]
    pub const JOINT_NAMES: [&str; 6] = [
        "type",
        "boom",
        "tip",
        "flag",
        "drum",
        "pulley",
    ];

    /// Lowest and highest positions (rad).
    #[rustfmt::skip]
    pub const POSITION_LIMITS: [[f64; 2]; 6] = [
        [f64::NEG_INFINITY, f64::INFINITY],
        [0.0, 1.5],
        [0.0, 1.0],
        [-1.0, 1.0],
        [-9.0, 9.0],
        [f64::NEG_INFINITY, f64::INFINITY],
    ];

    /// Largest rates (rad/s).
    #[rustfmt::skip]
    pub const RATE_LIMITS: [f64; 6] = [
        f64::INFINITY,
        0.5,
        0.5,
        1.0,
        2.0,
        f64::INFINITY,
    ];

    /// Largest efforts (N m).
    #[rustfmt::skip]
    pub const EFFORT_LIMITS: [f64; 6] = [
        f64::INFINITY,
        400.0,
        100.0,
        1.0,
        10.0,
        f64::INFINITY,
    ];

    /// Dry friction (N m), which the mechanism does not have.
    #[rustfmt::skip]
    pub const FRICTION: [f64; 6] = [
        0.2,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    ];
}

/// Frames of the links on their bodies: origins (m) from the centre of mass in axes of the body, as
/// `View::point` takes them; on the ground global. Where a frame has other axes than its body,
/// Euler parameters, scalar first, turn them to those of the body.
#[allow(dead_code, clippy::approx_constant)]
#[rustfmt::skip]
impl Crane {
    /// Link `yard`, on the ground.
    pub const YARD_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `cart`, on `cart`.
    pub const CART_ORIGIN: [f64; 3] = [-0.08000000000000002, -0.076, -0.20000000000000004];
    /// Link `cab`, on `cart`.
    pub const CAB_ORIGIN: [f64; 3] = [-0.08000000000000002, 0.22399999999999998, 0.19999999999999998];
    /// Axes of `cab`.
    pub const CAB_AXES: [f64; 4] = [0.7071067811865475, 0.0, 0.0, 0.7071067811865475];
    /// Link `mast`, on `mast`.
    pub const MAST_ORIGIN: [f64; 3] = [-0.05, 0.0, -0.6];
    /// Link `boom`, on `boom`.
    pub const BOOM_ORIGIN: [f64; 3] = [-0.5, 0.0, 0.0];
    /// Link `tip`, on `tip`.
    pub const TIP_ORIGIN: [f64; 3] = [-0.3, -0.01, 0.0];
    /// Link `pulley`, on `pulley`.
    pub const PULLEY_ORIGIN: [f64; 3] = [0.0, -0.02, 0.0];
    /// Link `drum`, on `drum`.
    pub const DRUM_ORIGIN: [f64; 3] = [0.0, -0.01, -0.005];
    /// Link `load`, on `load`.
    pub const LOAD_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `flag`, on `flag`.
    pub const FLAG_ORIGIN: [f64; 3] = [0.0, -0.1, 0.0];
}
