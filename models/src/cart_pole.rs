//! A pole on a cart.

use holonom::prelude::*;

/// A pole that stands on a cart, which a force pushes; at rest, 0.1 rad from upright at the start,
/// gravity along -y.
///
#[doc = include_str!("sketches/cart_pole.svg")]
///
/// ```text
///     y        / pole, angle from upright towards x
///     |       /
///     |   ___o___
///     |  |_cart__| <-- push
///     o----------------- x
/// ```
///
/// Cart 1 kg, pole 0.1 kg and 1 m long, no friction: Barto, Sutton and Anderson, *Neuronlike
/// adaptive elements that can solve difficult learning control problems*, IEEE Transactions on
/// Systems, Man, and Cybernetics 13 (1983). Moments of inertia that do not act are ours.
///
/// Good for: control; the equations of motion in closed form (Florian, *Correct equations for the
/// dynamics of the cart-pole system*, 2007).
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct CartPole {
    /// The force on the cart along x (N).
    #[input]
    pub push: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    cart: Body,
    #[body(
        mass = 0.1,
        inertia = [0.1 / 12.0, 1.0e-5, 0.1 / 12.0],
        position = [0.5 * sin(0.1), 0.5 * cos(0.1), 0.0],
        orientation = rotation([0.0, 0.0, -1.0], 0.1)
    )]
    pole: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, pole], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, -1.0])]
    hinge: Revolute,
    #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [push, 0.0, 0.0])]
    motor: PointForce,
}
