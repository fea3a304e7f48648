//! Derivatives of motions that are known in closed form.

use holonom::prelude::*;
use holonom::{Forward, Scalar, independent::Direction};

/// A slider behind a spring and a damper.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "both")]
struct Oscillator {
    #[param]
    stiffness: f64,
    #[param]
    damping: f64,
    #[param]
    mass: f64,
    #[param]
    free_length: f64,
    #[body(mass = mass, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, slider], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(
        between = [ground, slider],
        head = [-1.0, 0.0, 0.0],
        tail = [0.0, 0.0, 0.0],
        free_length = free_length,
        stiffness = stiffness,
        damping = damping
    )]
    spring: SpringDamper,
}

/// `y = e^(-a t) (cos(w t) + a / w sin(w t)) y0`, with `a = c / 2 m` and `w^2 = k / m - a^2`.
fn oscillation(time: f64, [k, c, m, l]: [Forward<f64, 4>; 4]) -> Forward<f64, 4> {
    let [one, time] = [1.0, time].map(Forward::constant);
    let inverse = m.reciprocal();
    let a = Forward::constant(0.5) * c * inverse;
    let w = (k * inverse - a * a).sqrt();
    let swing = (w * time).cos() + a * w.reciprocal() * (w * time).sin();
    (one - l) * (-(a * time)).exp() * swing - (one - l)
}

/// In both coordinates, by a fixed step and by a tolerance.
#[test]
fn a_damped_oscillator() -> Result<(), Box<dyn std::error::Error>> {
    let values = [40.0, 0.8, 2.0, 0.7];
    let [stiffness, damping, mass, free_length] = values;
    let (oscillator, h) = (
        Oscillator::new(stiffness, damping, mass, free_length)?,
        Oscillator::HANDLES,
    );
    let along = oscillator.sensitivities([h.stiffness, h.damping, h.mass, h.free_length])?;
    let near = |sample: &Sample<'_, Forward<f64, 4>, Oscillator>, limit: f64| {
        let [k, c, m, l] = values;
        let numbers = [(k, 0), (c, 1), (m, 2), (l, 3)];
        let wanted = oscillation(
            sample.time().value(),
            numbers.map(|(value, direction)| Forward::along(value, direction)),
        );
        let found = sample.displacement(h.rail);
        assert!((found.value() - wanted.value()).abs() < limit);
        for (found, wanted) in found.derivatives().iter().zip(wanted.derivatives()) {
            assert!((found - wanted).abs() < limit * (1.0 + wanted.abs()));
        }
    };
    along
        .simulation(StandardLagrange, Rk4::every(2e-3))
        .run(0.0..=5.0, every(0.5), |sample| near(sample, 1e-9))?;
    along
        .simulation(StandardLagrange, Rk4::every(2e-3))
        .joint_coordinates()
        .run(0.0..=5.0, every(0.5), |sample| near(sample, 1e-9))?;
    let tolerance = Tolerance {
        relative: 1e-10,
        absolute: 1e-12,
    };
    along
        .simulation(StandardLagrange, DormandPrince::new(tolerance))
        .run(0.0..=5.0, every(0.5), |sample| near(sample, 1e-8))?;
    Ok(())
}

/// A disc that a moment turns.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass])]
struct Turntable {
    #[param]
    inertia: f64,
    #[input]
    moment: f64,
    #[body(mass = 1.0, inertia = [1.0, 1.0, inertia], position = [0.0, 0.0, 0.0])]
    disc: Body,
    #[joint(between = [ground, disc], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[force(between = [ground, disc], axis = [0.0, 0.0, 1.0], moment = moment)]
    motor: TorsionalActuator,
}

/// `q = q0 + w t + T t^2 / 2 J`: by a parameter, an input, an angle and its rate, which a method of
/// order 4 has exactly.
#[test]
fn a_turntable() -> Result<(), Box<dyn std::error::Error>> {
    let h = Turntable::HANDLES;
    let mut table = Turntable::new(0.5)?;
    table.moment = 0.3;
    let mut space = table.coordinates([h.shaft])?;
    space.set_inputs(&table.inputs())?;
    let start = space.state([0.2], [1.5])?;
    let directions = [
        h.inertia.into(),
        h.moment.into(),
        Direction::position(h.shaft),
        Direction::rate(h.shaft),
    ];
    space
        .sensitivities(&start, directions)?
        .simulation(StandardLagrange, Rk4::every(0.1))
        .run(0.0..=2.0, every(0.5), |sample| {
            let (t, found) = (sample.time().value(), sample.angle(h.shaft));
            let turned = 0.2 + 1.5 * t + 0.3 * t * t / (2.0 * 0.5);
            assert!((found.value() - turned).sin().abs() < 1e-13);
            let wanted = [-0.3 * t * t / (2.0 * 0.25), t * t, 1.0, t];
            for (found, wanted) in found.derivatives().iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-13 * (1.0 + t));
            }
        })?;
    Ok(())
}
