//! A four-bar with a spring and a motor, for an example and for tests.

use holonom::prelude::*;
use holonom_live::Live;

/// Three steel bars on four hinges, described with the crank and the rocker upright. A spring pulls
/// the rocker, a damper slows the crank, a motor turns it.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop")]
pub(crate) struct FourBar {
    #[param(like = 0.25)]
    pub(crate) crank: f64,
    #[param(like = 0.9)]
    pub(crate) coupler: f64,
    #[param(like = 0.6)]
    pub(crate) rocker: f64,
    #[param(like = 0.8)]
    pub(crate) base: f64,
    #[param(like = 60.0)]
    pub(crate) stiffness: f64,
    #[input]
    pub(crate) torque: f64,
    #[body(shape = bar(width = 0.03, height = 0.01, from = [0.0, 0.0, 0.0], to = [0.0, crank, 0.0]), density = 7800.0)]
    crank_link: Body,
    #[body(shape = bar(width = 0.03, height = 0.01, from = [0.0, crank, 0.0], to = [coupler, crank, 0.0]), density = 7800.0)]
    coupler_link: Body,
    #[body(shape = bar(width = 0.03, height = 0.01, from = [base, 0.0, 0.0], to = [base, rocker, 0.0]), density = 7800.0)]
    rocker_link: Body,
    #[joint(between = [ground, crank_link], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank_link, coupler_link], point = [0.0, crank, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    // It closes the loop: the x axis of a bar is along it.
    #[joint(
        between = [coupler_link, rocker_link],
        point = local([0.5 * coupler, 0.0, 0.0], [0.5 * rocker, 0.0, 0.0]),
        axis = [0.0, 0.0, 1.0]
    )]
    knee: Revolute,
    #[joint(between = [ground, rocker_link], point = [base, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    foot: Revolute,
    #[force(
        between = [ground, rocker_link],
        head = [1.3, 0.5, 0.0],
        tail = [base, rocker, 0.0],
        stiffness = stiffness,
        free_length = 0.4
    )]
    spring: SpringDamper,
    #[force(between = [ground, crank_link], axis = [0.0, 0.0, 1.0], moment = torque - 0.1 * rate)]
    motor: TorsionalActuator,
}

/// The page.
pub(crate) fn live(four_bar: FourBar) -> Live<FourBar> {
    let h = FourBar::HANDLES;
    Live::new(four_bar)
        .slider(|of| &mut of.crank, "m", 0.1..=0.4)
        .slider(|of| &mut of.coupler, "m", 0.7..=1.2)
        .slider(|of| &mut of.rocker, "m", 0.4..=0.9)
        .slider(|of| &mut of.base, "m", 0.6..=1.1)
        .slider(|of| &mut of.stiffness, "N/m", ..)
        .slider(|of| &mut of.torque, "N m", -5.0..=5.0)
        .start_angle(h.bearing, ..)
        .reading("rocker", "rad", move |view| view.angle(h.foot))
        .energies()
        .film(move |mut film| {
            film.trace_point(h.coupler_link, "middle of the coupler", [0.0; 3]);
            film.titled("A four-bar")
        })
}
