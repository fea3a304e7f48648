//! The bodies of a state by name.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{Error as _, MapAccess, Visitor};
use serde::ser::SerializeMap as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::names::Among;
use crate::math::scalar::Real;
use crate::math::vec3::{read, write};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::{BodyInfo, BodyKind};
use crate::state::vector::{Array, MovingState as _, StateParts};

/// A body with an orientation, as it is written.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Body", deny_unknown_fields)]
struct Rigid<S> {
    position: [S; 3],
    orientation: [S; 4],
    velocity: [S; 3],
    angular_velocity: [S; 3],
    principal_axes: [f64; 4],
}

/// A particle, as it is written.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Particle", deny_unknown_fields)]
struct Point<S> {
    position: [S; 3],
    velocity: [S; 3],
}

/// By how much components of the principal axes may differ: what a format may round off.
const SAME_AXES: f64 = 1e-9;

/// The bodies of a state by name; its auxiliary variables are zero once read.
pub(super) struct Bodies<M: Mechanism, S: Real>(pub(super) M::State<S>);

impl<M: Mechanism, S: Real + Serialize> Serialize for Bodies<M, S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let (q, u) = (
            self.0.coordinates().as_slice(),
            self.0.velocities().as_slice(),
        );
        let mut bodies = serializer.serialize_map(Some(M::REPORT.bodies.len()))?;
        for (place, body) in M::REPORT.bodies.iter().enumerate() {
            let position = read(q, body.coordinate);
            let velocity = read(u, body.velocity);
            match body.kind {
                BodyKind::Rigid => {
                    let rigid = Rigid {
                        position,
                        orientation: read(q, body.coordinate + 3),
                        velocity,
                        angular_velocity: read(u, body.velocity + 3),
                        principal_axes: M::user_axes(place),
                    };
                    bodies.serialize_entry(body.name, &rigid)?;
                }
                BodyKind::Particle => {
                    bodies.serialize_entry(body.name, &Point { position, velocity })?;
                }
            }
        }
        bodies.end()
    }
}

impl<'de, M: Mechanism, S: Real + Deserialize<'de>> Deserialize<'de> for Bodies<M, S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(BodiesByName(PhantomData))
    }
}

struct BodiesByName<M, S>(PhantomData<fn() -> (M, S)>);

impl<'de, M: Mechanism, S: Real + Deserialize<'de>> Visitor<'de> for BodiesByName<M, S> {
    type Value = Bodies<M, S>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the bodies of `{}` by name", M::REPORT.name)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut state = M::State::<S>::zeros();
        // One in the place of the velocity of a body that was read.
        let mut seen = M::Velocities::<S>::zeros();
        let place_of = |name: &str| M::REPORT.bodies.iter().position(|body| body.name == name);
        let is_seen = |seen: &M::Velocities<S>, body: &BodyInfo| {
            seen.as_slice().get(body.velocity) == Some(&S::one())
        };
        loop {
            let mechanism = M::REPORT.name;
            let names = Among {
                find: place_of,
                what: "body",
                mechanism,
            };
            let Some(place) = map.next_key_seed(names)? else {
                break;
            };
            let Some(body) = M::REPORT.bodies.get(place) else {
                continue;
            };
            if is_seen(&seen, body) {
                let twice = format_args!("body `{}` is there twice", body.name);
                return Err(A::Error::custom(twice));
            }
            write(seen.as_mut_slice(), body.velocity, [S::one()]);
            let (position, velocity) = match body.kind {
                BodyKind::Rigid => {
                    let rigid: Rigid<S> = map.next_value()?;
                    check_axes(body.name, &rigid.principal_axes, &M::user_axes(place))?;
                    let (q, u) = (body.coordinate + 3, body.velocity + 3);
                    write(state.coordinates_mut().as_mut_slice(), q, rigid.orientation);
                    write(
                        state.velocities_mut().as_mut_slice(),
                        u,
                        rigid.angular_velocity,
                    );
                    (rigid.position, rigid.velocity)
                }
                BodyKind::Particle => {
                    let point: Point<S> = map.next_value()?;
                    (point.position, point.velocity)
                }
            };
            write(
                state.coordinates_mut().as_mut_slice(),
                body.coordinate,
                position,
            );
            write(
                state.velocities_mut().as_mut_slice(),
                body.velocity,
                velocity,
            );
        }
        match M::REPORT.bodies.iter().find(|body| !is_seen(&seen, body)) {
            Some(body) => Err(A::Error::custom(format_args!(
                "body `{}` of `{}` is missing",
                body.name,
                M::REPORT.name
            ))),
            None => Ok(Bodies(state)),
        }
    }
}

fn check_axes<E: serde::de::Error>(
    body: &str,
    found: &[f64; 4],
    expected: &[f64; 4],
) -> Result<(), E> {
    // A number that is none is not near.
    let is_near = |(x, y): (&f64, &f64)| (x - y).abs() < SAME_AXES;
    if found.iter().zip(expected).all(is_near) {
        return Ok(());
    }
    Err(E::custom(format_args!(
        "the principal axes of body `{body}` are not those of the file: its inertia is another one"
    )))
}
