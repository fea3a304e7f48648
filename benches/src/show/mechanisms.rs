//! Mechanisms that are there to be looked at. Their data are ours.

use holonom::forces::{SpringDamper, TorsionalActuator};
use holonom::joints::{AngleDriver, Distance, Gear, Revolute};
use holonom::prelude::*;

/// An arm of three axes whose motors hold it on a smooth way: torques that are proportional to the
/// error of an angle, and dampers.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Arm {
    #[body(shapes = [
        cylinder(radius = 0.12, from = [0.0, 0.0, 0.0], to = [0.0, 0.0, 0.35]),
        cylinder(radius = 0.09, from = [0.0, -0.14, 0.42], to = [0.0, 0.14, 0.42]),
    ], density = 2700.0)]
    column: Body,
    #[body(shape = bar(width = 0.1, height = 0.1, from = [0.0, 0.0, 0.42], to = [0.0, 0.0, 0.97]), density = 1200.0)]
    upper_arm: Body,
    #[body(shapes = [
        bar(width = 0.07, height = 0.07, from = [0.0, 0.0, 0.97], to = [0.45, 0.0, 0.97]),
        cone(radius = 0.05, from = [0.45, 0.0, 0.97], to = [0.6, 0.0, 0.97]),
    ], density = 1200.0)]
    forearm: Body,
    #[point(on = forearm, at = [0.6, 0.0, 0.97])]
    tip: Point,
    #[joint(between = [ground, column], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    waist: Revolute,
    #[joint(between = [column, upper_arm], point = [0.0, 0.0, 0.42], axis = [0.0, 1.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper_arm, forearm], point = [0.0, 0.0, 0.97], axis = [0.0, 1.0, 0.0])]
    elbow: Revolute,
    #[force(between = [ground, column], axis = [0.0, 0.0, 1.0], moment = 400.0 * (1.2 * sin(1.6 * time) - angle) - 60.0 * rate)]
    waist_motor: TorsionalActuator,
    #[force(between = [column, upper_arm], axis = [0.0, 1.0, 0.0], moment = 900.0 * (0.5 * sin(2.1 * time) - angle) - 120.0 * rate)]
    shoulder_motor: TorsionalActuator,
    #[force(between = [upper_arm, forearm], axis = [0.0, 1.0, 0.0], moment = 400.0 * (0.7 * sin(2.9 * time) - angle) - 40.0 * rate)]
    elbow_motor: TorsionalActuator,
}

/// A train of three wheels on a wall: a motor turns the first, a brake the last.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints")]
pub struct GearTrain {
    #[body(shape = disc(radius = 0.05, thickness = 0.02, at = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0]), density = 7800.0)]
    pinion: Body,
    #[body(shape = disc(radius = 0.1, thickness = 0.02, at = [0.15, 0.0, 0.0], axis = [0.0, 0.0, 1.0]), density = 7800.0)]
    idler: Body,
    #[body(shape = disc(radius = 0.15, thickness = 0.02, at = [0.3, 0.2, 0.0], axis = [0.0, 0.0, 1.0]), density = 7800.0)]
    wheel: Body,
    #[joint(between = [ground, pinion], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    input: Revolute,
    #[joint(between = [ground, idler], point = [0.15, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    middle: Revolute,
    #[joint(between = [ground, wheel], point = [0.3, 0.2, 0.0], axis = [0.0, 0.0, 1.0])]
    output: Revolute,
    #[joint(between = [pinion, idler, ground], axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 0.0, 1.0], ratio = -0.5)]
    first: Gear,
    #[joint(between = [idler, wheel, ground], axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 0.0, 1.0], ratio = -2.0 / 3.0)]
    second: Gear,
    #[force(between = [ground, pinion], axis = [0.0, 0.0, 1.0], moment = 0.6 - 0.08 * rate)]
    motor: TorsionalActuator,
    #[force(between = [ground, wheel], axis = [0.0, 0.0, 1.0], moment = -0.2 * rate)]
    brake: TorsionalActuator,
}

/// A rigid axle with two wheels on springs, guided by three links along and one across. One wheel
/// has just left a bump. x is ahead, z is up.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Axle {
    #[body(
        shape = tube(outer = 0.05, inner = 0.04, from = [0.0, -0.7, 0.3], to = [0.0, 0.7, 0.3]),
        density = 7800.0,
        orientation = rpy(0.0, 0.0, 0.0),
        velocity = [0.0, 0.0, -0.9],
        angular_velocity = [1.4, 0.0, 0.0]
    )]
    beam: Body,
    #[body(
        shape = disc(radius = 0.3, thickness = 0.16, at = [0.0, 0.7, 0.3], axis = [0.0, 1.0, 0.0]),
        mass = 18.0,
        orientation = rpy(0.0, 0.0, 0.0),
        velocity = [0.0, 0.0, 1.4 * 0.7 - 0.9],
        angular_velocity = [1.4, 12.0, 0.0]
    )]
    left: Body,
    #[body(
        shape = disc(radius = 0.3, thickness = 0.16, at = [0.0, -0.7, 0.3], axis = [0.0, 1.0, 0.0]),
        mass = 18.0,
        orientation = rpy(0.0, 0.0, 0.0),
        velocity = [0.0, 0.0, -1.4 * 0.7 - 0.9],
        angular_velocity = [1.4, 12.0, 0.0]
    )]
    right: Body,
    #[joint(between = [beam, left], point = [0.0, 0.7, 0.3], axis = [0.0, 1.0, 0.0])]
    left_hub: Revolute,
    #[joint(between = [beam, right], point = [0.0, -0.7, 0.3], axis = [0.0, 1.0, 0.0])]
    right_hub: Revolute,
    #[joint(between = [ground, beam], head = [0.6, 0.4, 0.3], tail = [0.0, 0.4, 0.3])]
    left_link: Distance,
    #[joint(between = [ground, beam], head = [0.6, -0.4, 0.3], tail = [0.0, -0.4, 0.3])]
    right_link: Distance,
    #[joint(between = [ground, beam], head = [0.45, 0.0, 0.45], tail = [0.0, 0.0, 0.45])]
    upper_link: Distance,
    #[joint(between = [ground, beam], head = [-0.1, 0.5, 0.3], tail = [-0.1, -0.5, 0.3])]
    panhard_rod: Distance,
    #[force(between = [ground, beam], head = [0.0, 0.5, 0.7], tail = [0.0, 0.5, 0.3], stiffness = 2.0e4, damping = 350.0, free_length = 0.38)]
    left_spring: SpringDamper,
    #[force(between = [ground, beam], head = [0.0, -0.5, 0.7], tail = [0.0, -0.5, 0.3], stiffness = 2.0e4, damping = 350.0, free_length = 0.38)]
    right_spring: SpringDamper,
}

/// A digger that digs: motions of boom, stick and bucket are prescribed.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Digger {
    #[body(shapes = [
        block(size = [1.6, 1.2, 0.6], at = [-0.5, 0.0, 1.0]),
        cylinder(radius = 0.5, from = [0.0, 0.0, 0.4], to = [0.0, 0.0, 0.7]),
    ], density = 400.0)]
    cab: Body,
    #[body(shapes = [
        bar(width = 0.25, height = 0.3, from = [0.3, 0.0, 1.0], to = [1.4, 0.0, 2.3]),
        bar(width = 0.25, height = 0.3, from = [1.4, 0.0, 2.3], to = [2.6, 0.0, 2.2]),
    ], density = 500.0)]
    boom: Body,
    #[body(shape = bar(width = 0.18, height = 0.22, from = [2.6, 0.0, 2.2], to = [2.9, 0.0, 0.9]), density = 500.0)]
    stick: Body,
    #[body(shapes = [
        bar(width = 0.6, height = 0.05, from = [2.9, 0.0, 0.9], to = [2.6, 0.0, 0.45]),
        bar(width = 0.6, height = 0.05, from = [2.6, 0.0, 0.45], to = [2.2, 0.0, 0.5]),
    ], density = 3000.0)]
    bucket: Body,
    #[point(on = bucket, at = [2.2, 0.0, 0.5])]
    teeth: Point,
    #[joint(between = [ground, cab], point = [0.0, 0.0, 0.4], axis = [0.0, 0.0, 1.0])]
    turntable: Revolute,
    #[joint(between = [cab, boom], point = [0.3, 0.0, 1.0], axis = [0.0, 1.0, 0.0])]
    foot: Revolute,
    #[joint(between = [boom, stick], point = [2.6, 0.0, 2.2], axis = [0.0, 1.0, 0.0])]
    elbow: Revolute,
    #[joint(between = [stick, bucket], point = [2.9, 0.0, 0.9], axis = [0.0, 1.0, 0.0])]
    wrist: Revolute,
    #[joint(between = [ground, cab], axis = [0.0, 0.0, 1.0], motion = 0.9 * smooth_step((time - 4.0) / 2.0))]
    swing: AngleDriver,
    #[joint(between = [cab, boom], axis = [0.0, 1.0, 0.0], motion = 0.25 * smooth_step(time / 2.0) - 0.5 * smooth_step((time - 3.0) / 2.0))]
    lift: AngleDriver,
    #[joint(between = [boom, stick], axis = [0.0, 1.0, 0.0], motion = 0.6 * smooth_step((time - 1.0) / 2.5))]
    pull: AngleDriver,
    #[joint(between = [stick, bucket], axis = [0.0, 1.0, 0.0], motion = 0.9 * smooth_step((time - 1.5) / 2.5) - 1.2 * smooth_step((time - 6.0) / 1.5))]
    curl: AngleDriver,
}

/// A four-bar whose crank can turn wholly: it passes no singular configuration.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "joints")]
pub struct CrankRocker {
    #[body(shape = bar(width = 0.03, height = 0.02, from = [0.0, 0.0, 0.0], to = [0.2, 0.0, 0.0]), density = 7800.0)]
    crank: Body,
    #[body(shape = bar(width = 0.03, height = 0.02, from = [0.2, 0.0, 0.0], to = [0.75, 0.45, 0.0]), density = 7800.0)]
    coupler: Body,
    #[body(shape = bar(width = 0.03, height = 0.02, from = [0.6, 0.0, 0.0], to = [0.75, 0.45, 0.0]), density = 7800.0)]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, coupler], point = [0.2, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    crank_pin: Revolute,
    #[joint(between = [coupler, rocker], point = [0.75, 0.45, 0.0], axis = [0.0, 0.0, 1.0])]
    knee: Revolute,
    #[joint(between = [ground, rocker], point = [0.6, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rocker_foot: Revolute,
    #[force(between = [ground, crank], axis = [0.0, 0.0, 1.0], moment = 60.0 - 12.0 * rate)]
    motor: TorsionalActuator,
}
