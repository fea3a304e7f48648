//! Shapes and rotations that describe no body.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Words {
    #[body(shape = cylindre(radius = 0.1, from = [0.0, 0.0, 0.0], to = [1.0, 0.0, 0.0]), density = 7850.0, free)]
    unknown: Body,
    #[body(shape = 0.1, density = 7850.0, free)]
    number: Body,
    #[body(shape = cylinder(radius = 0.1, form = [0.0, 0.0, 0.0], to = [1.0, 0.0, 0.0]), density = 7850.0, free)]
    key: Body,
    #[body(shape = ball(0.1, at = [0.0, 0.0, 0.0]), density = 7850.0, free)]
    bare: Body,
    #[body(shape = bar(width = 0.1, from = [0.0, 0.0, 0.0], to = [1.0, 0.0, 0.0]), density = 7850.0, free)]
    lacking: Body,
    #[body(shape = ball(radius = 0.1, radius = 0.2, at = [0.0, 0.0, 0.0]), density = 7850.0, free)]
    twice: Body,
    #[body(shapes = ball(radius = 0.1, at = [0.0, 0.0, 0.0]), density = 7850.0, free)]
    alone: Body,
    #[body(shape = ball(radius = 0.1, at = 0.0), density = 7850.0, free)]
    place: Body,
}

#[derive(Mechanism)]
struct Sizes {
    #[body(shape = ball(radius = -0.1, at = [0.0, 0.0, 0.0]), density = 7850.0, free)]
    negative: Body,
    #[body(shape = cylinder(radius = 0.1, from = [1.0, 0.0, 0.0], to = [1.0, 0.0, 0.0]), density = 7850.0, free)]
    flat: Body,
    #[body(shape = tube(outer = 0.1, inner = 0.2, from = [0.0, 0.0, 0.0], to = [1.0, 0.0, 0.0]), density = 7850.0, free)]
    inside_out: Body,
    #[body(shape = bar(width = 0.1, height = 0.2, from = [0.0, 0.0, 0.0], to = [1.0, 0.0, 0.0], up = [2.0, 0.0, 0.0]), density = 7850.0, free)]
    lying: Body,
    #[body(shapes = [ball(radius = 0.1, at = [0.0, 0.0, 0.0]), ball(radius = 0.2, at = [0.0, 0.0, 0.0], density = -100.0)], density = 100.0, free)]
    hollow: Body,
    #[body(shapes = [ball(radius = 0.1, at = [0.0, 0.0, 0.0]), ball(radius = 0.05, at = [1.0, 0.0, 0.0], density = -100.0)], density = 100.0, free)]
    bored: Body,
}

#[derive(Mechanism)]
struct Masses {
    #[param(like = 0.5)]
    length: f64,
    #[body(shape = ball(radius = 0.1, at = [0.0, 0.0, 0.0]), free)]
    none: Body,
    #[body(shape = ball(radius = 0.1, at = [0.0, 0.0, 0.0]), density = 7850.0, mass = 1.0, free)]
    both: Body,
    #[body(shape = ball(radius = 0.1, at = [0.0, 0.0, 0.0]), density = -7850.0, free)]
    negative: Body,
    #[body(shape = ball(radius = 0.1, at = [0.0, 0.0, 0.0]), density = 7850.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.0, 0.0], free)]
    given: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], density = 7850.0, free)]
    shapeless: Body,
    #[body(mass = 1.0, shape = ball(radius = 0.1, at = [0.0, 0.0, 0.0]), free)]
    point: Particle,
    #[body(shapes = [ball(radius = 0.1, at = [0.0, 0.0, 0.0]), ball(radius = 0.1, at = [length, 0.0, 0.0])], density = 7850.0, free)]
    unseen: Body,
    #[body(shapes = [ball(radius = 0.1, at = [0.0, 0.0, 0.0], density = 1.0), ball(radius = 0.1, at = [1.0, 0.0, 0.0])], mass = 1.0, free)]
    sum: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], shape = ball(radius = 0.1, at = [length, 0.0, 0.0]), free)]
    floating: Body,
}

#[derive(Mechanism)]
struct Turns {
    #[param(like = 0.5)]
    angle: f64,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = rpy(0.1, 0.2), free)]
    short: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = rotation([0.0, 1.0, angle], 0.2), free)]
    unseen: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = axes(x = [1.0, 0.0, 0.0], y = [1.0, 1.0, 0.0]), free)]
    oblique: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = axes(x = [1.0, 0.0, 0.0], x = [0.0, 1.0, 0.0]), free)]
    one: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = along(u, [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]), free)]
    unknown: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = along(x, [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]), free)]
    nowhere: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = rotation([0.0, 0.0, 1.0], 0.1) * 2.0, free)]
    product: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], inertia_axes = 90.0, free)]
    number: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], inertia_axes = rpy(0.1, 0.2, angle), free)]
    turned: Body,
}

fn main() {}
