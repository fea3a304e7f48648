//! C01: the heavy top of 150 rad/s.

use holonom::prelude::*;
use holonom_models::HeavyTop;
use nalgebra::{Vector3, Vector4};

use super::{at_times, change_of_energy};

/// Position (m), Euler parameters, angular velocity (rad/s, body axes) and the force of the tip on
/// the top (N): by independent integrations in minimal coordinates that agree to 6e-12, and to the
/// digits given in Brüls, Cardona and Arnold 2012.
struct Top {
    position: [f64; 3],
    euler: [f64; 4],
    spin: [f64; 3],
    reaction: [f64; 3],
}

/// At 1 s and at 2 s.
const TOPS: [Top; 2] = [
    Top {
        position: [
            0.173_343_964_098_322,
            0.640_088_592_070_459,
            -0.748_490_791_133_685,
        ],
        euler: [
            0.732_943_980_679_714,
            -0.278_285_719_337_735,
            0.531_824_611_334_04,
            -0.320_176_142_736_226,
        ],
        spin: [-0.822_078_101_685_771, 150.0, -5.923_291_348_116_9],
        reaction: [
            -517.600_739_476_873,
            -396.843_101_489_451,
            404.574_925_163_038,
        ],
    },
    Top {
        position: [
            -0.150_416_822_745_869,
            -0.724_165_591_636_978,
            -0.673_022_269_560_291,
        ],
        euler: [
            0.122_947_135_041_549,
            -0.491_079_892_550_41,
            0.350_430_030_343_55,
            -0.787_986_887_550_27,
        ],
        spin: [0.122_233_219_491_359, 150.0, -5.855_624_589_204_97],
        reaction: [
            -260.735_211_310_882,
            613.612_698_982_613,
            309.716_631_390_754,
        ],
    },
];

fn spins<F: Formulation<f64>>(method: F) {
    /// m, parts of p, and relative to 150 rad/s and to the force.
    const ASKED: f64 = 1e-9;
    let handles = HeavyTop::HANDLES;
    at_times(
        &HeavyTop::default(),
        method,
        1.0,
        &[1.0, 2.0],
        |place, sample| {
            let top = &TOPS[place];
            let wrench = sample.reaction(handles.tip, handles.top).expect("solvable");
            let pose = sample.pose(handles.top);
            let p = pose.orientation;
            let (p, reference) = (Vector4::new(p.w, p.i, p.j, p.k), Vector4::from(top.euler));
            let attitude = (p - reference).norm().min((p + reference).norm());
            let position = (pose.position - Vector3::from(top.position)).norm();
            let spin = (sample.angular_velocity(handles.top) - Vector3::from(top.spin)).norm();
            let force = (wrench.force - Vector3::from(top.reaction)).norm();
            println!("{position:e} m, p {attitude:e}, {spin:e} rad/s, {force:e} N");
            assert!(position <= ASKED && attitude <= ASKED && spin <= 150.0 * ASKED);
            assert!(force <= ASKED * wrench.force.norm());
            // A ball transmits no moment.
            assert!(wrench.moment.amax() <= ASKED * wrench.force.norm());
        },
    );
}

#[test]
fn it_is_where_it_should_be_after_two_seconds() {
    spins(StandardLagrange);
    spins(Baumgarte::default());
    spins(AugmentedLagrangian::default());
}

#[test]
fn the_first_reaction_is_that_of_a_rigid_body() {
    /// N, at the start.
    const FIRST: [f64; 3] = [0.0, -319.525_988_166, -317.262_461_538_462];
    let handles = HeavyTop::HANDLES;
    Simulation::new(&HeavyTop::default(), StandardLagrange, Rk4::every(1e-3))
        .run(0.0..=0.0, every(1.0), |sample| {
            let wrench = sample.reaction(handles.tip, handles.top).expect("solvable");
            // To the digits given.
            assert!((wrench.force - Vector3::from(FIRST)).amax() <= 1e-9);
            ControlFlow::Continue(())
        })
        .expect("solvable");
}

#[test]
fn energy_and_spin_stay() {
    /// Of 5435.7 J and 150 rad/s, over 1 s.
    const RELATIVE: f64 = 1e-9;
    const ENERGY: f64 = 5_435.696_790_865_547;
    let model = HeavyTop::default();
    assert!(change_of_energy(&model, Baumgarte::default(), 1.0, ENERGY) <= RELATIVE * ENERGY);
    at_times(
        &model,
        Baumgarte::default(),
        0.1,
        &[0.1, 0.5, 1.0],
        |_, sample| {
            let spin = sample.angular_velocity(HeavyTop::HANDLES.top).y;
            assert!((spin - 150.0).abs() <= RELATIVE * 150.0);
        },
    );
}
