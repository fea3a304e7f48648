//! Andrews' squeezing mechanism with ten hinges, as it is drawn: seven bodies, three loops, nine
//! redundant equations.

use holonom::forces::{ConstantMoment, SpringDamper};
use holonom::joints::Revolute;
use holonom::prelude::*;

use super::twins::{difference, move_alike, runs};

/// The angles of the links at the start are those of the Test Set for IVP Solvers, see
/// [`holonom_models::SqueezingMechanism`]; its lengths `rr`, `d`, `ss`, `e`, `zt`, `u` and `zf` (m)
/// are given. The three hinges in E are given by their arms, which the other ends of the links
/// follow.
macro_rules! squeezing_mechanism {
    (
        $name:ident { $($fields:tt)* }
        $rr:expr, $d:expr, $ss:expr, $e:expr, $zt:expr, $u:expr, $zf:expr
    ) => {
        #[derive(Mechanism)]
        #[mechanism(redundant = "drop", coordinates = "joints")]
        struct $name {
            $($fields)*
            #[body(
                mass = 0.04325,
                inertia = [2.194e-6, 2.194e-6, 2.194e-6],
                position = [0.00092 * cos(-0.0617138900142764), 0.00092 * sin(-0.0617138900142764), 0.0]
            )]
            crank: Body,
            #[body(
                mass = 0.00365,
                inertia = [4.410e-7, 4.410e-7, 4.410e-7],
                position = [
                    ($rr - 0.0115) * cos(-0.0617138900142764),
                    ($rr - 0.0115) * sin(-0.0617138900142764),
                    0.0
                ]
            )]
            coupler: Body,
            #[body(
                mass = 0.02373,
                inertia = [5.255e-6, 5.255e-6, 5.255e-6],
                position = [
                    -0.03635 + 0.01874 * sin(0.455279819163070) + 0.01043 * cos(0.455279819163070),
                    0.03273 - 0.01874 * cos(0.455279819163070) + 0.01043 * sin(0.455279819163070),
                    0.0
                ]
            )]
            triangle: Body,
            #[body(
                mass = 0.00706,
                inertia = [5.667e-7, 5.667e-7, 5.667e-7],
                position = [
                    -0.06934 + $zt * cos(0.487364979543843) + ($e - 0.01421) * sin(0.710033369709729),
                    -0.00227 + $zt * sin(0.487364979543843) - ($e - 0.01421) * cos(0.710033369709729),
                    0.0
                ]
            )]
            upper_link: Body,
            #[body(
                mass = 0.07050,
                inertia = [1.169e-5, 1.169e-5, 1.169e-5],
                position = [
                    -0.06934 + 0.02308 * cos(0.487364979543843) - 0.00916 * sin(0.487364979543843),
                    -0.00227 + 0.02308 * sin(0.487364979543843) + 0.00916 * cos(0.487364979543843),
                    0.0
                ]
            )]
            upper_rocker: Body,
            #[body(
                mass = 0.00706,
                inertia = [5.667e-7, 5.667e-7, 5.667e-7],
                position = [
                    -0.06934 + $u * sin(1.23054744454982) + ($zf - 0.01421) * cos(1.00787905438393),
                    -0.00227 - $u * cos(1.23054744454982) + ($zf - 0.01421) * sin(1.00787905438393),
                    0.0
                ]
            )]
            lower_link: Body,
            #[body(
                mass = 0.05498,
                inertia = [1.912e-5, 1.912e-5, 1.912e-5],
                position = [
                    -0.06934 + 0.01228 * sin(1.23054744454982) - 0.00449 * cos(1.23054744454982),
                    -0.00227 - 0.01228 * cos(1.23054744454982) - 0.00449 * sin(1.23054744454982),
                    0.0
                ]
            )]
            lower_rocker: Body,
            #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            o: Revolute,
            #[joint(
                between = [crank, coupler],
                point = [$rr * cos(-0.0617138900142764), $rr * sin(-0.0617138900142764), 0.0],
                axis = [0.0, 0.0, 1.0]
            )]
            f: Revolute,
            #[joint(between = [ground, triangle], point = [-0.03635, 0.03273, 0.0], axis = [0.0, 0.0, 1.0])]
            b: Revolute,
            #[joint(between = [ground, upper_rocker], point = [-0.06934, -0.00227, 0.0], axis = [0.0, 0.0, 1.0])]
            a_upper: Revolute,
            #[joint(
                between = [upper_rocker, upper_link],
                point = [-0.06934 + $zt * cos(0.487364979543843), -0.00227 + $zt * sin(0.487364979543843), 0.0],
                axis = [0.0, 0.0, 1.0]
            )]
            g: Revolute,
            #[joint(between = [ground, lower_rocker], point = [-0.06934, -0.00227, 0.0], axis = [0.0, 0.0, 1.0])]
            a_lower: Revolute,
            #[joint(
                between = [lower_rocker, lower_link],
                point = [-0.06934 + $u * sin(1.23054744454982), -0.00227 - $u * cos(1.23054744454982), 0.0],
                axis = [0.0, 0.0, 1.0]
            )]
            h: Revolute,
            #[joint(
                between = [triangle, coupler],
                point = local(
                    [
                        ($ss - 0.01874) * sin(0.455279819163070) - 0.01043 * cos(0.455279819163070),
                        (0.01874 - $ss) * cos(0.455279819163070) - 0.01043 * sin(0.455279819163070),
                        0.0
                    ],
                    [(0.0115 - $d) * cos(-0.0617138900142764), (0.0115 - $d) * sin(-0.0617138900142764), 0.0]
                ),
                axis = [0.0, 0.0, 1.0]
            )]
            e_coupler: Revolute,
            #[joint(
                between = [triangle, upper_link],
                point = local(
                    [
                        ($ss - 0.01874) * sin(0.455279819163070) - 0.01043 * cos(0.455279819163070),
                        (0.01874 - $ss) * cos(0.455279819163070) - 0.01043 * sin(0.455279819163070),
                        0.0
                    ],
                    [0.01421 * sin(0.710033369709729), -0.01421 * cos(0.710033369709729), 0.0]
                ),
                axis = [0.0, 0.0, 1.0]
            )]
            e_upper: Revolute,
            #[joint(
                between = [triangle, lower_link],
                point = local(
                    [
                        ($ss - 0.01874) * sin(0.455279819163070) - 0.01043 * cos(0.455279819163070),
                        (0.01874 - $ss) * cos(0.455279819163070) - 0.01043 * sin(0.455279819163070),
                        0.0
                    ],
                    [0.01421 * cos(1.00787905438393), 0.01421 * sin(1.00787905438393), 0.0]
                ),
                axis = [0.0, 0.0, 1.0]
            )]
            e_lower: Revolute,
            #[force(between = [ground, crank], moment = [0.0, 0.0, 0.033])]
            motor: ConstantMoment,
            #[force(
                between = [ground, triangle],
                head = local(
                    [0.014, 0.072, 0.0],
                    [
                        (0.018 - 0.01874) * sin(0.455279819163070) + (0.02 - 0.01043) * cos(0.455279819163070),
                        (0.01874 - 0.018) * cos(0.455279819163070) + (0.02 - 0.01043) * sin(0.455279819163070),
                        0.0
                    ]
                ),
                tail = local(
                    [0.014, 0.072, 0.0],
                    [
                        (0.018 - 0.01874) * sin(0.455279819163070) + (0.02 - 0.01043) * cos(0.455279819163070),
                        (0.01874 - 0.018) * cos(0.455279819163070) + (0.02 - 0.01043) * sin(0.455279819163070),
                        0.0
                    ]
                ),
                stiffness = 4530.0,
                free_length = 0.07785
            )]
            spring: SpringDamper,
        }
    };
}

squeezing_mechanism! {
    Squeezing {
        #[param(like = 0.007)]
        rr: f64,
        #[param(like = 0.028)]
        d: f64,
        #[param(like = 0.035)]
        ss: f64,
        #[param(like = 0.02)]
        e: f64,
        #[param(like = 0.04)]
        zt: f64,
        #[param(like = 0.04)]
        u: f64,
        #[param(like = 0.02)]
        zf: f64,
    } rr, d, ss, e, zt, u, zf
}
squeezing_mechanism! { Likes {} 0.007, 0.028, 0.035, 0.02, 0.04, 0.04, 0.02 }
squeezing_mechanism! { Others {} 0.006, 0.029, 0.036, 0.021, 0.039, 0.041, 0.0205 }

#[test]
fn it_moves_as_one_of_literals_does() {
    let run = (1e-5, 100);
    assert_eq!(Squeezing::REPORT.degrees_of_freedom, 1);
    assert_eq!(Squeezing::REPORT.redundant.len(), 9);
    move_alike(&Squeezing::default(), &Likes::default(), run);
    let given = Squeezing::new(0.006, 0.029, 0.036, 0.021, 0.039, 0.041, 0.0205);
    move_alike(&given.expect("sound"), &Others::default(), run);
}

#[test]
fn a_sweep_over_all_lengths_moves_alike_by_bodies_and_by_joints() {
    let likes = [0.007, 0.028, 0.035, 0.02, 0.04, 0.04, 0.02];
    for number in 0..60_usize {
        // Up to three hundredths more or less, in an order without a pattern.
        let lengths: [f64; 7] = std::array::from_fn(|place| {
            let share = (0.618_033_988_749_895 * (1 + number * 7 + place) as f64).fract();
            likes[place] * (0.97 + 0.06 * share)
        });
        let [rr, d, ss, e, zt, u, zf] = lengths;
        let mechanism = Squeezing::new(rr, d, ss, e, zt, u, zf).expect("near what it is like");
        let [bodies, joints] = runs(&mechanism, (1e-5, 50)).expect("it runs");
        let far = difference(&bodies, &joints);
        assert!(far < 1e-8, "{lengths:?}: {far:e}");
    }
}

#[test]
fn a_link_that_does_not_reach_is_refused() {
    let error = Squeezing::new(0.007, 0.028, 0.035, 0.02, 0.04, 0.04, 0.2).err();
    assert_eq!(error.expect("it is ten times as long").field, "zf");
}
