//! Mechanisms that were found at random and failed once, made smaller.

use holonom_engine::model::ElementKind;

use crate::comparison::Extent;
use crate::reference::{Equations, State};
use crate::text::{Outcome, Text};

/// A given moment and a spring on one body: their sum was turned out of the body and back, which
/// multiplied the moment of the spring by `|p|^4`.
const MOMENT_AND_SPRING: &str = "
    pub struct Random {
        #[body(mass = 0.7, inertia = [1.9, 1.3, 1.1], free)]
        a: Body,
        #[body(mass = 0.9, inertia = [1.6, 1.3, 1.0], position = [0.5, 0.0, 0.0], free)]
        b: Body,
        #[force(between = [a, b], moment = [1.5, -2.6, -0.5])]
        moment: ConstantMoment,
        #[force(between = [a, b], head = [-1.2, 0.9, 0.1], tail = [0.4, -0.3, -0.5], free_length = 0.9, stiffness = 1.7)]
        spring: SpringDamper,
    }";

/// An axis by `local(..)` on a body with a full tensor: round-off of the principal axes decided
/// which of the equal components of the axis was the smallest, and so where its normals were.
const NORMALS: &str = "
    #[mechanism(redundant = \"keep\")]
    pub struct Random {
        #[body(mass = 1.9, inertia = [
            [1.3265772141905323, 0.25913251382795965, -0.03663110619993026],
            [0.25913251382795965, 1.2159225524554471, -0.05610750013414348],
            [-0.03663110619993026, -0.05610750013414348, 1.0535364933927585],
        ])]
        a: Body,
        #[body(mass = 2.2, inertia = [0.9, 0.6, 0.65])]
        b: Body,
        #[joint(between = [a, b], axis = local([0.0, 0.0, -2.0], [0.0, 0.0, -2.0]))]
        joint: Own,
    }";

/// Axes by `local(..)` that are not parallel, the first with components that are equal but for
/// round-off: these decided on the normals.
const EQUAL_COMPONENTS: &str = "
    pub struct Random {
        #[joint(between = [a, b], head = [1.0, 0.0, 1.0], tail = [0.25, -0.5, 0.5], axis = local([0.49999999999999983, -0.5, -0.7500000000000001], [-0.75, -0.5, -0.5]))]
        joint: Parallel2,
        #[body(mass = 2.0, inertia = [1.2, 1.6, 1.1], position = [0.0, 0.0, -0.5])]
        b: Body,
        #[body(mass = 2.0, inertia = [
            [0.6346305756783008, -0.019614678854979004, -0.015759039991681507],
            [-0.019614678854979004, 0.4689774298255125, -0.041997102251084946],
            [-0.015759039991681507, -0.041997102251084946, 0.6989357774426339],
        ], orientation = rotation([0.0, 1.0, 0.0], deg(90.0)), position = [0.14692760343179057, 0.0, -0.5])]
        a: Body,
    }";

/// Rows that depend on each other on one body, off the constraints only: the pivot that vanishes
/// there is told.
const OFF_THE_CONSTRAINTS: &str = "
    #[mechanism(redundant = \"keep\")]
    pub struct Random {
        #[body(mass = 0.5, inertia = [0.85, 0.9, 0.99], position = [-0.1, 0.3, -0.7])]
        a: Body,
        #[body(mass = 0.5, inertia = [0.98, 1.3, 1.36], position = [-0.5, 0.6, -0.6])]
        b: Body,
        #[joint(between = [a, b], axis = [0.0, 0.0, -2.0], p = [1.0, 0.28, 0.99], q = [0.32, -0.02, -0.5])]
        joint: Twice,
    }";

/// Bodies with axes of their own: entries of rows that are round-off are constants in joint
/// coordinates, and one that was alone in its column was taken for a pivot.
const ROUND_OFF: &str = "
    pub struct Random {
        #[body(mass = 0.6401213484139585, inertia = [
            [1.5634479915400958, -0.0023681017162023813, 0.05318422119388869],
            [-0.0023681017162023813, 1.5893419049526911, 0.028089789980247484],
            [0.05318422119388869, 0.028089789980247484, 1.7407584335004551],
        ], orientation = [0.09640384061088607, 0.9776480122107469, -0.1273628648490137, 0.13670905015139953], position = [-0.19468287961962938, -0.5511553658052033, 0.1671263925694606], free)]
        b2: Body,
        #[body(mass = 1.9247246042284278, inertia = [1.571831817217988, 1.2883264605370053, 0.7609731500507042], position = [0.0, -0.5, 0.5210126705456006], free)]
        b0: Body,
        #[joint(point = local([0.3333359834040208, 0.5, 0.5898791590506245], [0.38047336553869393, -1.0779599512911309, -0.5056617306712246]), axis = [0.0, -2.0, 0.0], between = [ground, b2])]
        j2: Prismatic,
        #[joint(between = [ground, b0], point = [-0.59237053025, 0.94561090173142, -0.9200364590048529], normal = local([0.3830227158789034, -0.5985821628489295, -0.7035573846104144], [-0.4370711265586833, -0.4421087738502577, -0.7832679378177976]))]
        j0: Planar,
    }";

#[test]
fn mechanisms_that_failed_once() {
    let own = "Own(i, j; axis: Axis) { dot(i.axis.normal(), j.origin - i.origin); }";
    let twice = "Twice(i, j; axis: Axis, p: Point, q: Point) { dot(i.axis.binormal(), j.p - i.q); j.p - i.q; }";
    for item in [
        MOMENT_AND_SPRING,
        NORMALS,
        EQUAL_COMPONENTS,
        OFF_THE_CONSTRAINTS,
        ROUND_OFF,
    ] {
        let text = Text {
            item: item.into(),
            definitions: vec![
                ("Own".into(), ElementKind::Joint, own.into()),
                ("Twice".into(), ElementKind::Joint, twice.into()),
            ],
        };
        for seed in 0..5 {
            match text.check(&text, seed, Extent::Full) {
                Ok(Outcome::Compared(_)) => {}
                Ok(Outcome::Refused(why) | Outcome::RefusedOtherwise(why)) | Err(why) => {
                    panic!("{text}\n{why}")
                }
            }
        }
    }
}

/// A bar along the axis of a link, as long as the link's offset: it touches, and there its equation
/// follows from those of the link.
const TOUCHING: &str = "
    #[mechanism(redundant = \"drop\")]
    pub struct Random {
        #[body(mass = 1.7, inertia = [1.3, 1.2, 1.7], position = [1.0, 1.0, 0.5])]
        a: Body,
        #[body(mass = 0.9, inertia = [
            [1.1, -0.2, -0.08],
            [-0.2, 1.0, 0.07],
            [-0.08, 0.07, 0.8],
        ], position = [1.0, 0.5, 0.5])]
        b: Body,
        #[joint(between = [a, b], head = [0.0, 0.0, 0.25], tail = [0.0, 0.0, 0.0], length = 0.25)]
        bar: Distance,
        #[joint(between = [a, b], first = [-0.5, -0.5, 0.0], second = [0.5, 0.25, 1.0], axis = [0.0, 0.0, -2.0])]
        link: RevoluteRevolute,
    }";

#[test]
fn a_singular_start_without_neighbours_leaves_nothing_out() {
    let text = Text {
        item: TOUCHING.into(),
        definitions: Vec::new(),
    };
    let Ok(Outcome::Refused(why)) = text.check(&text, 0, Extent::Quick) else {
        panic!("not refused");
    };
    assert!(why.contains("may depend on each other by chance"), "{why}");
}

/// A bar along the axes of a hinge and a slide, which a turn shortens by the second order only: of
/// three equations for the displacement two follow from the third at the start, and nowhere else.
const SHORTENED: &str = "
    #[mechanism(redundant = \"drop\")]
    pub struct Random {
        #[body(mass = 1.6, inertia = [1.3, 1.9, 1.1], angular_velocity = [0.25, 0.5, 0.5], position = [1.0, 1.0, 0.0])]
        a: Body,
        #[body(mass = 2.2, inertia = [2.1, 1.8, 1.9], position = [0.0, -0.45, 0.5])]
        b: Body,
        #[joint(between = [ground, a], point = [0.0, 0.0, 0.5], axis = [0.0, 0.0, 1.0])]
        hinge: Revolute,
        #[joint(between = [a, b], head = [0.25, 0.0, 0.0], tail = [0.25, 0.0, 1.0], length = 1.0)]
        bar: Distance,
        #[joint(between = [ground, b], point = [-0.5, 0.5, 1.0], axis = [0.0, 0.0, 1.0])]
        slide: Prismatic,
        #[joint(between = [b, a], first = [0.0, 0.5, 0.5], second = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
        link: RevoluteRevolute,
    }";

#[test]
fn what_follows_by_chance_is_not_left_out_nor_advised_to_be() {
    let refusal = |item: &str| {
        let text = Text {
            item: item.into(),
            definitions: Vec::new(),
        };
        match text.check(&text, 0, Extent::Quick) {
            Ok(Outcome::Refused(why)) => why,
            _ => panic!("not refused: {text}"),
        }
    };
    let why = refusal(SHORTENED);
    assert!(
        why.contains("by chance, and does not hold where these lead to"),
        "{why}"
    );
    for item in [SHORTENED, TOUCHING] {
        let why = refusal(&item.replace("#[mechanism(redundant = \"drop\")]", ""));
        assert!(why.contains("and perhaps only there"), "{why}");
        assert!(why.contains("keep") && !why.contains("drop"), "{why}");
    }
}

/// A principal axis nearly across the axis of a joint: the origin that turns the offset into a zero
/// was a kilometre away along the axis, and cost the accelerations five digits.
const FAR_ORIGIN: &str = "
    pub struct Random {
        #[body(mass = 2.2, inertia = [0.6, 0.5, 0.7], position = [0.0, 0.5, -0.5], free)]
        a: Body,
        #[body(mass = 1.4, inertia = [
            [1.5007402883175056, -0.04554896473330505, 0.06115028496719204],
            [-0.04554896473330505, 1.0268866201212283, 0.3257979997884696],
            [0.06115028496719204, 0.3257979997884696, 1.0733135037578398],
        ], orientation = rotation([1.0, 0.0, 0.0], deg(-90.0)), position = [0.5, 0.25, 0.25], free)]
        b: Body,
        #[joint(between = [b, a], point = [1.0, 0.0, 0.25], axis = [0.0, 0.0, -2.0])]
        joint: Cylindrical,
    }";

/// A plane nearly along x, which determines the translation along y or z and not that along x: what
/// its row has there is small, though nothing in the column is larger.
const ALONG_X: &str = "
    pub struct Random {
        #[body(mass = 1.3, position = [-0.24, -0.84, 1.0], free)]
        a: Particle,
        #[joint(between = [ground, a], point = [-0.24, -0.84, 1.0], normal = local([1.0e-5, 0.66, -0.76], [1.0e-5, 0.66, -0.76]))]
        plane: PointOnPlane,
    }";

#[test]
fn translations_are_compared_with_each_other() {
    let text = Text {
        item: ALONG_X.into(),
        definitions: Vec::new(),
    };
    for seed in 0..4 {
        let outcome = text.check(&text, seed, Extent::Full);
        assert!(
            matches!(outcome, Ok(Outcome::Compared(_))),
            "{:?}",
            outcome.err()
        );
    }
}

#[test]
fn origins_stay_near_their_links() {
    let text = Text {
        item: FAR_ORIGIN.into(),
        definitions: Vec::new(),
    };
    for seed in 0..4 {
        let outcome = text.check(&text, seed, Extent::Full);
        assert!(
            matches!(outcome, Ok(Outcome::Compared(_))),
            "{:?}",
            outcome.err()
        );
    }
}

/// An axis across a slide, which is not led onto the constraints: the entry of the slide is a
/// number, round-off, and was taken for a pivot because no other entry of its row or its column is
/// a number.
const ALONE: &str = "
    pub struct Random {
        #[body(mass = 2.1567257958917563, inertia = [[0.998707795724942, -0.09331865161134167, 0.13652342328043932], [-0.09331865161134167, 0.7952291840315027, -0.02692479473922186], [0.13652342328043932, -0.02692479473922186, 0.6269381540383152]], orientation = [0.1076359801668129, -0.8322248380505937, -0.4086159800390929, 0.35895584068501313], position = [-0.5, 1.0, 0.0], free)]
        b2: Body,
        #[joint(between = [b1, b2], p = local([-0.25, -1.0, -0.11413580343339036], [-0.5750650818846772, 1.6527305647819472, 0.016787847763110486]), q = [0.0, 0.0, 1.0], a = [0.0, 0.0, 1.0], b = [0.0, 0.0, 1.0], v = [0.0, 1.0, 0.0], size = -0.4283222707884937, ratio = 0.7962584156967711, law = x * smooth_step(2.0 * time) + exp(0.12291668350426876 * time) / (2.0 + cos(x)))]
        j3: Own0,
        #[joint(axis = [1.0, 0.0, 0.0], point = [0.2613077461401079, 1.0, 0.5], between = [ground, b2])]
        j2: Cylindrical,
        #[body(mass = 1.8270085741411612, inertia = [1.601875611072753, 1.5340769905271925, 1.2576509687615929], position = [0.5, 0.5, -0.38586419656660964], free)]
        b1: Body,
    }";

#[test]
fn round_off_determines_no_velocity_where_it_is_the_only_number() {
    let own = "Own0(i, j; p: Point, q: Point, a: Axis, b: Axis, v: Vector, size: Length, ratio: Number, law: Law(x)) {
        let part0 = (dot(i.b.normal(), j.b.normal()) * i.v - i.a.normal());
        let part1 = i.a / (3.0 + cos(angle(i, j, a))) / (3.0 + cos(dot(i.origin, i.q)));
        dot(j.b.normal(), j.p - i.q) + dot(j.b.binormal(), i.origin);
        squared(part1 + j.p) * law(ratio / (2.0 + squared((i.q - i.q))));
    }";
    let text = Text {
        item: ALONE.into(),
        definitions: vec![("Own0".into(), ElementKind::Joint, own.into())],
    };
    for seed in 5980..5986 {
        let outcome = text.check(&text, seed, Extent::Full);
        assert!(
            matches!(outcome, Ok(Outcome::Compared(_))),
            "{:?}",
            outcome.err()
        );
    }
}

/// A force along an axis at a point on an axis of the body: the accelerations need two entries of
/// `A`. The common number was taken out of the terms of one entry, and the sum that was left read
/// Euler parameters as they are where they are to be normalised.
const ONE_ENTRY: &str = "
    pub struct Random {
        #[body(mass = 1.3, inertia = [1.8, 0.9, 1.2], position = [0.5, 0.25, 0.25])]
        body: Body,
        #[force(between = [ground, body], point = [0.5, 0.0, 0.25], force = [-1.0, 0.0, 0.0])]
        push: PointForce,
    }";

#[test]
fn all_entries_of_a_rotation_are_normalised() {
    let text = Text {
        item: ONE_ENTRY.into(),
        definitions: Vec::new(),
    };
    for seed in 0..4 {
        let outcome = text.check(&text, seed, Extent::Full);
        assert!(
            matches!(outcome, Ok(Outcome::Compared(_))),
            "{:?}",
            outcome.err()
        );
    }
}

/// A bar that stands across all velocities of its loop at the start. There its row, without what
/// other rows determine, is nothing but round-off, and a share of that was taken for an entry.
const ACROSS: &str = "
    pub struct Random {
        #[joint(between = [ground, b2], head = local([0.5, 0.0, 0.0], [0.5, -1.0, -1.0]), tail = local([-0.5, 0.0, 0.0], [-0.5, -1.0, -1.0]))]
        j2: Distance,
        #[joint(between = [b1, b3], point = [0.0, 1.0, 0.5], axis = [0.0, 0.0, 1.0])]
        j4: Prismatic,
        #[body(mass = 0.6423425581730913, inertia = [[1.0117593362054236, -0.06800300511797813, 0.13378314674831818], [-0.06800300511797813, 0.9735486634222985, 0.13502118970828625], [0.13378314674831818, 0.13502118970828625, 0.8667259569620992]], position = [0.0, 1.0, 1.0], free)]
        b2: Body,
        #[body(mass = 1.9371441321471574, inertia = [1.4389574922430075, 1.0620427543471673, 1.3532974100172852], position = [0.9951014306392421, 0.25, 1.0], free)]
        b1: Body,
        #[joint(point = [0.25, 0.0, 0.0], between = [ground, b1], axis = [0.0, 0.0, 1.0])]
        j1: Revolute,
        #[joint(between = [b3, b2], point = [-0.7039204144119593, 0.0, -0.9455507222560633], axis = local([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]))]
        j3: Prismatic,
        #[body(mass = 2.067027708928494, inertia = [[1.5766873241362056, -0.021075861038551996, 0.036731979499650444], [-0.021075861038551996, 1.570708009705256, 0.12330143454456435], [0.036731979499650444, 0.12330143454456435, 1.6755116130749081]], position = [0.0, 0.0, 1.0], free)]
        b3: Body,
    }";

#[test]
fn round_off_determines_no_velocity_where_it_is_all_of_a_row() {
    let text = Text {
        item: ACROSS.into(),
        definitions: Vec::new(),
    };
    for seed in 24554..24558 {
        let outcome = text.check(&text, seed, Extent::Full);
        assert!(
            matches!(outcome, Ok(Outcome::Compared(_))),
            "{:?}",
            outcome.err()
        );
    }
}

/// A driver of the angle about axes that nothing keeps parallel. The angle is not defined where
/// these are opposed. Near there its row is a thousand times as large as at the start, which was
/// taken for a singular position.
const BESIDE_OPPOSED_AXES: &str = "
    pub struct Random {
        #[joint(between = [b0, b1], first = [0.5, 0.7806456769667696, 0.6469445240569884], second = [0.25, 0.25, 0.0], axis = [0.0, 0.0, 1.0])]
        j1: RevoluteRevolute,
        #[body(mass = 1.1125489896155274, inertia = [1.205918812761236, 1.2565738180799606, 2.0158282199809654], position = [0.0, 0.25, -0.5], free)]
        b0: Body,
        #[body(mass = 0.751312857681943, inertia = [0.6465810955788915, 1.0669135332507795, 0.7422635701665206], orientation = rotation([0.0, 0.0, 1.0], deg(90.0)), position = [1.0, -0.5, 0.5], free)]
        b3: Body,
        #[body(mass = 2.144812252141867, inertia = [1.183305944732659, 1.128372634752853, 1.5527227713250207], position = [0.0, -0.5, -0.08062635263639506], free)]
        b4: Body,
        #[body(mass = 0.6806741064048432, inertia = [1.3277868493202134, 1.4880168294435774, 0.786145686091752], orientation = [-0.2347277328789689, 0.6640078826782877, 0.5046248343476623, -0.4993497769281481], position = [0.25, 0.25, 0.5], free)]
        b2: Body,
        #[joint(between = [ground, b0], point = local([0.25, 0.25, -0.5], [0.25, 0.0, 0.0]), axis = [0.0, 0.0, 1.0])]
        j0: Revolute,
        #[body(mass = 2.2193414909667544, inertia = [1.861966391291062, 1.1627243707233825, 1.2306787187095367], orientation = rotation([0.0, 1.0, 0.0], deg(90.0)), position = [-0.9146274777878938, 0.5, 0.5], free)]
        b1: Body,
        #[joint(axis = [0.0, 0.0, 1.0], second = [0.0, 0.25, 0.0], between = [b2, b1], first = [1.0, -0.5, 0.41629340980781415])]
        j2: RevoluteRevolute,
        #[joint(between = [b4, b0], axis = local([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]), motion = 0.39866373754563633 * smooth_step(time / 2.0))]
        j3: AngleDriver,
    }";

#[test]
fn a_row_that_grows_without_bound_makes_no_other_stop_singular() {
    let text = Text {
        item: BESIDE_OPPOSED_AXES.into(),
        definitions: Vec::new(),
    };
    for seed in 50022..50026 {
        let outcome = text.check(&text, seed, Extent::Full);
        assert!(
            matches!(outcome, Ok(Outcome::Compared(_))),
            "{:?}",
            outcome.err()
        );
    }
}

/// An equation that is a product of a squared distance and a sine. Along a sweep its gradient
/// varies by many decades, and the greatest of them is no measure of the others.
const PRODUCT: &str = "
    #[mechanism(redundant = \"drop\")]
    pub struct Random {
        #[joint(p = local([-0.2681126091442869, -0.5, 0.9948610274696705], [-0.38548409796678473, 0.7308542007065477, 0.22301615366028676]), q = [0.8310122553815966, 0.28006818341488326, -0.4271350643139935], a = [0.0, 1.0, 0.0], b = [-0.5756884835383183, 0.5733474336301442, -0.5829712602445156], v = [0.5945458188657597, 0.4628756278932607, 0.6574659096650283], between = [ground, b2])]
        j1: Product,
        #[body(mass = 1.497509619492636, position = [0.9735572067270459, 0.1438288174202813, -0.5932124819733458], free)]
        b0: Particle,
        #[joint(between = [ground, b0], point = [0.9735572067270459, 0.1438288174202813, -0.5932124819733458], axis = local([-0.5076085711542299, 0.1361137183269146, 0.8507682376381847], [-0.7989783540051042, 0.5918637341205972, 0.10644674755067678]), motion = 0.02720577634248933 + -0.42009493852632884 * time * time)]
        j2: DisplacementDriver,
        #[body(mass = 0.8004102634740009, inertia = [[0.9830448742674485, -0.005009725040959298, -0.00331117724260266], [-0.005009725040959298, 0.6457497914393464, -0.07342242516908226], [-0.00331117724260266, -0.07342242516908226, 0.8690074362286867]], orientation = [-0.6765098340307094, 0.00025789842089644536, -0.43814335495520096, -0.5919161920886667], position = [0.1525968253960599, -0.5258394797677737, 0.25], free)]
        b2: Body,
        #[body(mass = 1.2023751993902938, inertia = [[1.1325949890278002, -0.0025234772893462758, -0.0006538746243062651], [-0.0025234772893462758, 0.9733554549893707, 0.12084995187624382], [-0.0006538746243062651, 0.12084995187624382, 1.0404163464049343]], position = [0.04867994759547534, -0.6433872619768322, 0.0], free)]
        b1: Body,
        #[joint(between = [ground, b0], point = [0.9735572067270459, 0.1438288174202813, -0.5932124819733458], axis = local([-0.5076085711542299, 0.1361137183269146, 0.8507682376381847], [-0.7989783540051042, 0.5918637341205972, 0.10644674755067678]), motion = 0.02720577634248933 + -0.42009493852632884 * time * time)]
        j0: DisplacementDriver,
    }";

#[test]
fn a_row_whose_size_varies_is_compared_with_itself() {
    let own = "Product(i, j; p: Point, q: Point, a: Axis, b: Axis, v: Vector) {
        squared(j.b + j.p) * sin(sin(dot(j.p + j.b.binormal(), cross(j.v, j.b.normal()))));
        dot(i.a, j.p - i.q) + sin(initial(dot(i.a.normal(), i.b.normal())));
    }";
    let text = Text {
        item: PRODUCT.into(),
        definitions: vec![("Product".into(), ElementKind::Joint, own.into())],
    };
    for seed in 95212..95216 {
        let outcome = text.check(&text, seed, Extent::Full);
        assert!(
            matches!(outcome, Ok(Outcome::Compared(_))),
            "{:?}",
            outcome.err()
        );
    }
}

/// A moment by the angle of a point that is opposite to where angles begin, but for round-off: it
/// is half a turn, or minus that.
const JUMP: &str = "
    pub struct Random {
        #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = [0.5, 0.1, 0.7, 0.3], free)]
        a: Body,
        #[force(between = [ground, a], axis = [0.3, 0.5, 0.7])]
        turned: Half,
    }";

#[test]
fn an_angle_at_its_jump_is_not_compared() {
    for (cosine, is_compared) in [(-0.5, false), (0.5, true)] {
        let own = format!(
            "Half(i, j; axis: Axis) {{
                moment atan2(dot(i.axis, j.axis.normal()), {cosine:?}) * j.axis on j;
            }}"
        );
        let text = Text {
            item: JUMP.into(),
            definitions: vec![("Half".into(), ElementKind::Force, own)],
        };
        let (_, described) = text.read().expect("a mechanism");
        let equations = Equations::new(&described, &State::start(&described, 0));
        assert_eq!(equations.is_some(), is_compared, "{cosine}");
    }
}

/// A body on a ball, and two equations that hold on two branches. On one of them its axis `a` stays
/// where it is, and what the equations determine of the angular velocity is all but the part along
/// that axis; on the other one they determine this part. Only the branch of the start was looked
/// at, and in all states of the other one a pivot vanished.
const TWO_BRANCHES: &str = "
    pub struct Random {
        #[body(mass = 0.429371262613466, inertia = [1.517062526761617, 1.5488179325105103, 1.941099003501372], position = [0.0, 0.0, 1.0], free)]
        b1: Body,
        #[joint(between = [b0, ground], p = [0.5, -0.49549709771925166, 0.5], q = [-0.5, -0.5, 0.0], a = [0.0, 0.0, 1.0], v = [1.0, 0.0, 0.0])]
        j0: Branches,
        #[joint(between = [b1, ground], point = [1.0, 1.0, 0.25], pitch = 0.5220082419032978, axis = [1.0, 0.0, 0.0])]
        j1: Screw,
        #[body(mass = 2.1778047248039427, inertia = [0.512923365010183, 1.1983291751902094, 1.3892003538566917], position = [0.0, -0.5052827861828428, 0.0], free)]
        b0: Body,
    }";

#[test]
fn velocities_follow_on_all_branches() {
    let own = "Branches(i, j; p: Point, q: Point, a: Axis, v: Vector) {
        dot(i.a.normals(), cross(j.q - i.p, i.a.normal() - j.v - i.p + j.origin));
        j.p - i.q + j.a;
    }";
    let text = Text {
        item: TWO_BRANCHES.into(),
        definitions: vec![("Branches".into(), ElementKind::Joint, own.into())],
    };
    for seed in 500_189..500_197 {
        let outcome = text.check(&text, seed, Extent::Full);
        assert!(
            matches!(outcome, Ok(Outcome::Compared(_))),
            "{:?}",
            outcome.err()
        );
    }
}
