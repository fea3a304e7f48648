//! What is swept of other mechanisms than a rod and a four-bar.

pub mod models;
mod motions;

use holonom_study::extremes::Motion;
use holonom_study::trade::PostStabilisation;

use super::case::Case;
use super::rod::Rod;
use super::{ACCEPTABLE, BOTH, Map, Place, TOLERANCE, decades, dormand_prince, rk4, usual};
use models::{Block, Bob, Top, Turned, TwoPoints};
use motions::period;

pub(super) fn sweep(map: &mut Map) {
    let tree = map.coefficients.ways_of_tree();
    let split = map.coefficients.ways_of_loop(&[PostStabilisation::None]);
    map.axis(
        "ratio of masses",
        "1",
        "The mass of a bob over that of the rod whose end it is fixed to; it swings twice",
    );
    for ratio in decades(-9, 9) {
        let mechanism = Bob::new(ratio).expect(ACCEPTABLE);
        let case = Case {
            mechanism,
            end: 2.0 * mechanism.period(),
            period: mechanism.period(),
            displaced: 0.0,
        };
        let motion = Motion {
            frequency: std::f64::consts::TAU / case.period,
            duration: case.end,
            reach: 1.0,
            size: 1.0,
            mass: 1.0 + ratio,
            violation: 0.0,
        };
        map.add(
            Place {
                value: ratio,
                motion,
                scale: 1.0,
            },
            case,
            &tree,
            &usual(case.period),
        );
    }
    map.axis(
        "spin",
        "rad/s",
        "The spin of a top on a ball, up to a second or 2000 rad",
    );
    for spin in decades(0, 5) {
        let mechanism = Top::new(spin).expect(ACCEPTABLE);
        let rate = mechanism.rate();
        let end = (2000.0 / rate).min(1.0);
        let case = Case {
            mechanism,
            end,
            period: period(rate),
            displaced: 0.0,
        };
        let motion = Motion {
            frequency: rate,
            duration: end,
            reach: 1.0,
            size: 1.0,
            mass: 1.0,
            violation: 0.0,
        };
        map.add(
            Place {
                value: spin,
                motion,
                scale: 1.0,
            },
            case,
            &tree,
            &usual(case.period),
        );
    }
    map.axis("stiffness", "N/m", "A spring that pulls a block of 1 kg for a second, with steps of 1 ms whatever the spring is");
    for stiffness in decades(0, 10) {
        let mechanism = Block::new(stiffness).expect(ACCEPTABLE);
        let rate = stiffness.sqrt();
        let case = Case {
            mechanism,
            end: 1.0,
            period: period(rate),
            displaced: 0.0,
        };
        let motion = Motion {
            frequency: rate,
            duration: 1.0,
            reach: 10.0,
            size: 0.1,
            mass: 1.0,
            violation: 0.0,
        };
        map.add(
            Place {
                value: stiffness,
                motion,
                scale: 0.1,
            },
            case,
            &tree,
            &[rk4(1e-3), dormand_prince(TOLERANCE)],
        );
    }
    map.axis(
        "nearly dependent",
        "m",
        "The distance of two points that make a hinge of a rod of 1 m, which swings twice",
    );
    for apart in decades(-12, 0) {
        let rod = Rod::new(1.0, 1.0, 0.0).expect(ACCEPTABLE);
        let case = Case {
            mechanism: TwoPoints::new(apart).expect(ACCEPTABLE),
            end: 2.0 * rod.period(),
            period: rod.period(),
            displaced: 0.0,
        };
        let motion = Motion {
            frequency: std::f64::consts::TAU / case.period,
            duration: case.end,
            // The axis is known by the digits of the distance.
            reach: 1.0 / apart,
            size: 1.0,
            mass: 1.0,
            violation: 0.0,
        };
        map.add(
            Place {
                value: apart,
                motion,
                scale: 1.0,
            },
            case,
            &split,
            &usual(case.period),
        );
    }
    map.axis("input", "N m", "A moment that turns a rod of 1 m and 1 kg from rest for a second: what is read is its rate");
    for moment in [
        5e-324,
        1e-310,
        1e-300,
        1e-200,
        1e-100,
        1e-30,
        1.0,
        1e3,
        1e6,
        1e10,
        1e30,
        1e100,
        1e300,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ] {
        let mut mechanism = Turned::default();
        mechanism.moment = moment;
        let rate = 3.0 * moment;
        let case = Case {
            mechanism,
            end: 1.0,
            period: period(rate.max(1e-3)),
            displaced: 0.0,
        };
        let motion = Motion {
            frequency: rate.abs(),
            duration: 1.0,
            reach: 1.0,
            // What the tolerance is compared with is the rate.
            size: rate.abs().clamp(f64::MIN_POSITIVE, 1.0),
            mass: 1.0,
            violation: 0.0,
        };
        for (scalar, least) in BOTH.into_iter().zip([1e-290, 1e-35]) {
            // Below the normal numbers there are no digits to keep.
            let scale = rate.abs().max(least);
            let place = Place {
                value: moment,
                motion,
                scale,
            };
            let integrations = [rk4(1e-3), dormand_prince(TOLERANCE)];
            map.add_one(place, case, &tree, &integrations, scalar);
        }
    }
}
