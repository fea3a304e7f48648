//! Numbers that the macro cannot see: constants of the crate, and functions of them.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;
use holonom::{StateParts, dynamics::Dynamics, error::ParameterFault};
use nalgebra::DVector;

use crate::comparison::distance;
use crate::scene::{flat, state, values};

/// Numbers as a crate would keep them.
pub(crate) mod data {
    pub(crate) const MASS: f64 = 2.0;
    pub(crate) const LENGTH: f64 = 0.64;
    pub(crate) const GRAVITY: f64 = 9.81;
    pub(crate) const INERTIA: [f64; 3] = [0.3, 0.4, 0.5];
    pub(crate) const FIRST: f64 = INERTIA[0];
    pub(crate) const SECOND: f64 = INERTIA[1];
    pub(crate) const THIRD: f64 = INERTIA[2];
    pub(crate) const SLOPE: f64 = 0.5;
    pub(crate) const TILT: f64 = 0.3;
    pub(crate) const ANGLE: f64 = 40.0;
}

/// With symbols wherever they are allowed.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.1 * crate::symbols::data::SLOPE, 0.0, -crate::symbols::data::GRAVITY])]
struct Symbolic {
    #[body(
        mass = crate::symbols::data::MASS,
        inertia = [
            crate::symbols::data::FIRST,
            crate::symbols::data::SECOND,
            crate::symbols::data::THIRD,
        ],
        position = [0.0, sqrt(crate::symbols::data::LENGTH), 0.1],
        velocity = [0.0, crate::symbols::data::SLOPE, 0.0],
        angular_velocity = [exp(crate::symbols::data::SLOPE), 0.0, 1.0]
    )]
    upper: Body,
    #[body(
        mass = crate::symbols::data::MASS / 4.0,
        inertia = [0.02, 0.05, 0.04],
        position = [0.2, 1.2, 0.3],
        orientation = [
            cos(deg(crate::symbols::data::ANGLE) / 2),
            0.0,
            sin(deg(crate::symbols::data::ANGLE) / 2),
            0.0,
        ]
    )]
    lower: Body,
    #[joint(
        between = [ground, upper],
        point = [0.0, crate::symbols::data::SLOPE - 0.5, 0.0],
        axis = [1.0, crate::symbols::data::SLOPE, tan(crate::symbols::data::TILT)]
    )]
    hinge: Revolute,
    #[joint(
        between = [upper, lower],
        point = local([0.0, sqrt(crate::symbols::data::LENGTH) / 2.0, 0.0], [0.0, -0.1, -0.2])
    )]
    ball: Spherical,
}

/// The same with every number written out.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.1 * 0.5, 0.0, -9.81])]
struct Literal {
    #[body(
        mass = 2.0,
        inertia = [0.3, 0.4, 0.5],
        position = [0.0, 0.8, 0.1],
        velocity = [0.0, 0.5, 0.0],
        angular_velocity = [exp(0.5), 0.0, 1.0]
    )]
    upper: Body,
    #[body(
        mass = 0.5,
        inertia = [0.02, 0.05, 0.04],
        position = [0.2, 1.2, 0.3],
        orientation = rotation([0.0, 1.0, 0.0], deg(40.0))
    )]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.5, tan(0.3)])]
    hinge: Revolute,
    #[joint(between = [upper, lower], point = local([0.0, 0.4, 0.0], [0.0, -0.1, -0.2]))]
    ball: Spherical,
}

/// Constants are rounded twice, at expansion and at run time, and enter some hundred operations.
const ROUND_OFF: f64 = 1e-13;

fn described<M: Mechanism + Default>() -> Vec<f64> {
    flat::<f64, M>(&M::default().described_state().expect("described"))
}

#[test]
fn the_described_state_is_the_same() {
    let (symbolic, literal) = (described::<Symbolic>(), described::<Literal>());
    assert!(distance(&symbolic, &literal, 0.0) <= ROUND_OFF);
}

/// Rates, and the energies, at a state.
fn motion<M: Mechanism + Default, F: Formulation<f64>>(method: F, x: &[f64]) -> Vec<f64> {
    let dynamics = Dynamics::<Problem<M, F>>::new(&M::default(), method)
        .expect("acceptable")
        .absolute_coordinates();
    let state = state::<f64, M>(x);
    let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("solvable");
    let view = dynamics.view(0.0, &state);
    let mut motion = flat::<f64, M>(&evaluation.rates);
    motion.extend([view.kinetic_energy(), view.potential_energy()]);
    // The normals of an axis that the macro cannot see are other ones: the size of the violation is
    // the same.
    motion.extend([view.violation(), view.velocity_violation()]);
    motion
}

fn states() -> Vec<Vec<f64>> {
    use rand::RngExt;
    let mut rng = holonom_assembler::states::generator(21);
    let described = described::<Literal>();
    let disturbed = |_| {
        let noise = DVector::from_fn(described.len(), |_, _| rng.random_range(-0.1..=0.1));
        let x = DVector::from_column_slice(&described) + noise;
        x.as_slice().to_vec()
    };
    (0..100).map(disturbed).collect()
}

#[test]
fn the_motion_is_the_same_under_every_formulation() {
    for x in states() {
        let x = &x[..];
        let pairs = [
            (
                motion::<Symbolic, _>(StandardLagrange, x),
                motion::<Literal, _>(StandardLagrange, x),
            ),
            (
                motion::<Symbolic, _>(Baumgarte::default(), x),
                motion::<Literal, _>(Baumgarte::default(), x),
            ),
            (
                motion::<Symbolic, _>(Penalty::default(), x),
                motion::<Literal, _>(Penalty::default(), x),
            ),
            (
                motion::<Symbolic, _>(AugmentedLagrangian::default(), x),
                motion::<Literal, _>(AugmentedLagrangian::default(), x),
            ),
        ];
        for (symbolic, literal) in pairs {
            assert!(distance(&symbolic, &literal, 0.0) <= ROUND_OFF);
        }
    }
}

#[test]
fn angle_and_reaction_are_the_same() {
    fn read<M: Mechanism + Default>(
        x: &[f64],
        read: impl Fn(&holonom::View<'_, f64, M>, &M::Multipliers<f64>) -> Vec<f64>,
    ) -> Vec<f64> {
        let method = Baumgarte::default();
        let dynamics = Dynamics::<Problem<M, _>>::new(&M::default(), method)
            .expect("acceptable")
            .absolute_coordinates();
        let state = state::<f64, M>(x);
        let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("solvable");
        read(&dynamics.view(0.0, &state), &evaluation.multipliers)
    }
    macro_rules! read {
        ($mechanism:ident, $x:expr) => {
            read::<$mechanism>($x, |view, multipliers| {
                let handles = $mechanism::HANDLES;
                let wrench = view
                    .reaction(multipliers, handles.hinge, handles.upper)
                    .expect("of the hinge");
                let mut read = vec![view.angle(handles.hinge), view.angle_rate(handles.hinge)];
                read.extend(
                    wrench
                        .force
                        .iter()
                        .chain(&wrench.moment)
                        .chain(&wrench.point),
                );
                read
            })
        };
    }
    for x in states() {
        // Off the constraints the two pairs of normals see another violation: take a state on them.
        let mut state = state::<f64, Literal>(&x);
        Literal::default()
            .assemble(0.0, &mut state)
            .expect("assembles");
        let x = flat::<f64, Literal>(&state);
        assert!(distance(&read!(Symbolic, &x), &read!(Literal, &x), 0.0) <= ROUND_OFF);
    }
}

/// Not a constant that the compiler checks: `sqrt` is a function of the run time.
#[derive(Debug, Mechanism)]
struct Broken {
    #[body(free, mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [sqrt(-crate::symbols::data::MASS), 0.0, 0.0])]
    lost: Body,
}

#[derive(Debug, Mechanism)]
struct Weightless {
    #[body(free, mass = exp(-1e6 * crate::symbols::data::MASS))]
    feather: Particle,
}

#[derive(Debug, Mechanism)]
struct Impossible {
    #[body(free, mass = 1.0, inertia = [0.1, 0.1, sqrt(crate::symbols::data::MASS)])]
    brick: Body,
}

#[derive(Debug, Mechanism)]
struct Pointless {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, crate::symbols::data::SLOPE - 0.5])]
    hinge: Revolute,
}

fn refused<M: Mechanism + Default>() -> ParameterError {
    let mechanism = M::default();
    mechanism.parameters::<f64>().expect_err("a bad number")
}

#[test]
fn a_bad_number_is_refused_at_run_time_by_name() {
    for (error, field, attribute, fault, text) in [
        (
            refused::<Broken>(),
            "lost",
            "position",
            ParameterFault::NotFinite,
            "`position` of `lost` must be finite",
        ),
        (
            refused::<Weightless>(),
            "feather",
            "mass",
            ParameterFault::NotPositive,
            "`mass` of `feather` must be positive",
        ),
        (
            refused::<Impossible>(),
            "brick",
            "inertia",
            ParameterFault::TriangleInequality,
            "`inertia` of `brick` must satisfy the triangle inequality: no principal moment exceeds the sum of the others",
        ),
        (
            refused::<Pointless>(),
            "hinge",
            "axis",
            ParameterFault::ZeroLength,
            "`axis` of `hinge` must not be the zero vector",
        ),
    ] {
        assert_eq!(
            (error.field, error.attribute, error.fault),
            (field, attribute, fault)
        );
        assert_eq!(error.to_string(), text);
    }
}

#[test]
fn a_run_with_a_bad_number_does_not_begin() {
    let mut seen = 0;
    let error = Simulation::new(&Pointless::default(), StandardLagrange, Rk4::every(0.1))
        .run(0.0..=1.0, every_step(), |_| {
            seen += 1;
            ControlFlow::Continue(())
        })
        .expect_err("refused");
    assert_eq!(error.fault, Fault::Parameter(refused::<Pointless>()));
    assert_eq!((seen, error.time), (0, 0.0));
    assert!(
        values(error.state.coordinates())
            .iter()
            .all(|value| value.is_finite())
    );
}
