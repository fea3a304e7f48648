//! The planar slider-crank: three hinges and a slide.

use holonom::joints::{Prismatic, Revolute};
use holonom::prelude::*;

use super::twins::move_alike;

/// A slider-crank in the plane z = 0 with the crank at 60 degrees: crank, rod and offset of the
/// slide (m).
macro_rules! slider_crank {
    ($name:ident { $($fields:tt)* } $crank:expr, $rod:expr, $offset:expr) => {
        #[derive(Mechanism)]
        #[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "joints")]
        struct $name {
            $($fields)*
            #[body(
                mass = 0.8,
                inertia = [1e-3, 2e-3, 2e-3],
                position = [0.5 * $crank * cos(1.0), 0.5 * $crank * sin(1.0), 0.0]
            )]
            crank_body: Body,
            #[body(
                mass = 0.6,
                inertia = [1e-4, 8e-3, 8e-3],
                position = [$crank * cos(1.0) + 0.5 * $rod, $crank * sin(1.0), 0.0],
                angular_velocity = [0.0, 0.0, 0.0]
            )]
            rod_body: Body,
            #[body(mass = 1.1, inertia = [1e-3, 1e-3, 1e-3], position = [$crank * cos(1.0) + $rod, $offset, 0.0])]
            slider: Body,
            #[joint(between = [ground, crank_body], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
            o: Revolute,
            #[joint(
                between = [crank_body, rod_body],
                point = [$crank * cos(1.0), $crank * sin(1.0), 0.0],
                axis = [0.0, 0.0, 1.0]
            )]
            a: Revolute,
            #[joint(between = [rod_body, slider], point = local([0.5 * $rod, 0.0, 0.0], [0.0, 0.0, 0.0]), axis = [0.0, 0.0, 1.0])]
            b: Revolute,
            #[joint(between = [ground, slider], point = [0.0, $offset, 0.0], axis = [1.0, 0.0, 0.0])]
            slide: Prismatic,
        }
    };
}

slider_crank! {
    SliderCrank {
        #[param(like = [0.2, 0.5])]
        links: [f64; 2],
        #[param(like = 0.02)]
        offset: f64,
    } links[0], links[1], offset
}
slider_crank! { Likes {} 0.2, 0.5, 0.02 }
slider_crank! { Long {} 0.25, 1.3, -0.1 }
slider_crank! { Central {} 0.1, 0.3, 0.0 }

#[test]
fn it_moves_as_one_of_literals_does() {
    let run = (1e-3, 100);
    let new = |links, offset| SliderCrank::new(links, offset).expect("sound");
    assert_eq!(SliderCrank::REPORT.degrees_of_freedom, 1);
    assert_eq!(SliderCrank::default().links, [0.2, 0.5]);
    move_alike(&SliderCrank::default(), &Likes::default(), run);
    move_alike(&new([0.25, 1.3], -0.1), &Long::default(), run);
    move_alike(&new([0.1, 0.3], 0.0), &Central::default(), run);
}

#[test]
fn a_sweep_keeps_the_length_of_the_rod() {
    for crank in 1..=20 {
        for rod in 1..=10 {
            let (crank, rod) = (0.02 * f64::from(crank), 0.45 + 0.1 * f64::from(rod));
            let mechanism = SliderCrank::new([crank, rod], 0.02).expect("sound");
            let mut state = mechanism.described_state::<f64>().expect("sound");
            mechanism.assemble(0.0, &mut state).expect("near");
            let handles = SliderCrank::HANDLES;
            let pin = SliderCrank::pose(&state, handles.slider).position;
            let at = |body, x: f64| SliderCrank::point(&state, body, [x, 0.0, 0.0].into());
            let ends = [-0.5, 0.5].map(|part| at(handles.rod_body, part * rod));
            assert!((ends[1] - pin).norm() < 1e-12);
            assert!((ends[0].norm() - crank).abs() < 1e-12 && (pin.y - 0.02).abs() < 1e-12);
        }
    }
}

#[test]
fn what_cannot_reach_is_refused() {
    let error = SliderCrank::new([0.2, 0.5], 0.9)
        .err()
        .expect("the slide is out of reach");
    assert_eq!(error.field, "offset");
    assert!(
        matches!(
            error.fault,
            holonom::error::ParameterFault::NotAssembled { joint } if !joint.is_empty()
        ),
        "{error}"
    );
}
