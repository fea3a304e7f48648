//! A robot with links that have no mass, against a body on a ball joint, which knows of no links.

use holonom::error::StepFault;
use holonom::prelude::*;

holonom::urdf! { struct Hip = "tests/data/hip.urdf"; }

/// The thigh alone. Its mass properties are those that the printer prints.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Thigh {
    #[body(
        mass = 9.2,
        inertia = [[0.15, 0.009, -0.001], [0.009, 0.12, -0.009], [-0.001, -0.009, 0.06]],
        position = [0.043, -0.13, -0.282],
        orientation = rpy(0.3, 0.2, 0.1)
    )]
    thigh: Body,
    #[joint(between = [ground, thigh], point = [0.023, -0.1, -0.082])]
    hip: Spherical,
}

/// The same fall, by three angles and by Euler parameters.
#[test]
fn three_hinges_are_a_ball() -> Result<(), Box<dyn std::error::Error>> {
    let method = || {
        DormandPrince::new(Tolerance {
            relative: 1e-12,
            absolute: 1e-12,
        })
    };
    let (hip, thigh) = (Hip::default(), Thigh::default());
    let h = Hip::HANDLES;
    let mut state = hip.described_state::<f64>()?;
    for (joint, rate) in [(h.hip_z, 0.7), (h.hip_x, -1.1), (h.hip_y, 1.6)] {
        hip.set_angle_rate(&mut state, joint, rate)?;
    }
    let mut places = Vec::new();
    let mut energies = Vec::new();
    let report = hip
        .simulation(StandardLagrange, method())
        .initial_state(state)
        .run(0.0..=1.0, every(0.25), |sample| {
            places.push(sample.position(h.thigh));
            energies.push(sample.kinetic_energy() + sample.potential_energy());
        })?;
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    let mut state = thigh.described_state::<f64>()?;
    let spin = nalgebra::Vector3::new(-1.1, 1.6, 0.7);
    let own = Thigh::HANDLES;
    // The joint's point is at rest.
    let arm = nalgebra::Vector3::new(0.02, -0.03, -0.2);
    Thigh::set_angular_velocity_global(&mut state, own.thigh, spin);
    Thigh::set_velocity(&mut state, own.thigh, spin.cross(&arm));
    let mut wanted = Vec::new();
    thigh
        .simulation(StandardLagrange, method())
        .initial_state(state)
        .run(0.0..=1.0, every(0.25), |sample| {
            wanted.push(sample.position(own.thigh));
        })?;
    assert_eq!(places.len(), wanted.len());
    for (found, wanted) in places.iter().zip(&wanted) {
        assert!((found - wanted).norm() < 1e-9, "{found} for {wanted}");
    }
    let lost = energies.last().zip(energies.first());
    assert!(lost.is_some_and(|(last, first)| (last - first).abs() < 1e-8));
    Ok(())
}

/// Without a mass a link has no equations of its own. What asks for them is refused by its name.
#[test]
fn accelerations_and_reactions_are_refused_by_name() -> Result<(), Box<dyn std::error::Error>> {
    let hip = Hip::default();
    let h = Hip::HANDLES;
    hip.simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=0.1, every(0.1), |sample| {
            let without = Fault::Step(StepFault::WithoutInertia { body: "yoke" });
            assert_eq!(sample.acceleration(h.thigh), Err(without));
            assert_eq!(sample.reaction(h.hip_z, h.yoke).err(), Some(without));
            assert!((sample.gravity().z + 9.81).abs() < 1e-12);
        })?;
    let by_load = hip
        .simulation(StandardLagrange, DormandPrince::default())
        .interactions([Interaction::friction_by_load(h.hip_y, 0.1).radius(0.02)])
        .run(0.0..=0.1, every(0.1), |_| ());
    let without = Fault::Step(StepFault::WithoutInertia { body: "yoke" });
    assert_eq!(by_load.err().map(|error| error.fault), Some(without));
    Ok(())
}

/// An impulse on a stop changes the momentum of its own angle alone. Momenta are differences of the
/// kinetic energy of the bodies.
#[test]
fn a_stop_between_links_without_mass_has_one_impulse() -> Result<(), Box<dyn std::error::Error>> {
    const RESTITUTION: f64 = 0.5;
    let hip = Hip::default();
    let h = Hip::HANDLES;
    let hinges = [h.hip_z, h.hip_x, h.hip_y];
    let momenta = |state: &StateOf<Hip>| -> Result<[f64; 3], Fault> {
        let mut momenta = [0.0; 3];
        for (momentum, hinge) in momenta.iter_mut().zip(hinges) {
            let rate = hip.view(0.0, state)?.angle_rate(hinge);
            let mut energies = [0.0; 2];
            for (energy, change) in energies.iter_mut().zip([0.5, -0.5]) {
                let mut other = *state;
                hip.set_angle_rate(&mut other, hinge, rate + change)?;
                *energy = hip.view(0.0, &other)?.kinetic_energy();
            }
            *momentum = energies[0] - energies[1];
        }
        Ok(momenta)
    };
    let mut start = hip.described_state::<f64>()?;
    for (hinge, rate) in hinges.into_iter().zip([0.7, -1.1, 1.6]) {
        hip.set_angle_rate(&mut start, hinge, rate)?;
    }
    let stops = [Interaction::limits(h.hip_y.angle(), [-0.3, 0.3]).restitution(RESTITUTION)];
    let [stop] = Interaction::handles(&stops);
    let mut last = start;
    let mut impacts = 0;
    hip.simulation(StandardLagrange, DormandPrince::default())
        .initial_state(start)
        .interactions(stops)
        .run(0.0..=3.0, every_step(), |sample| -> Result<(), Fault> {
            assert!(sample.angle(h.hip_y).abs() < 0.3 + 1e-9);
            let state = *sample.state();
            if let Some(impact) = sample.impact(stop)?
                && impact.time == sample.time()
                && impact.rates[1] * sample.angle_rate(h.hip_y) > 0.0
            {
                let [before, after] = impact.rates;
                assert!((after + RESTITUTION * before).abs() < 1e-12);
                let pairs = momenta(&state)?.into_iter().zip(momenta(&last)?);
                let changes = pairs.map(|(after, before)| after - before);
                for (change, wanted) in changes.zip([0.0, 0.0, impact.impulse]) {
                    assert!((change - wanted).abs() < 1e-9, "{change} for {wanted}");
                }
                impacts += 1;
            }
            last = state;
            Ok(())
        })?;
    assert!(impacts > 1, "{impacts}");
    Ok(())
}
