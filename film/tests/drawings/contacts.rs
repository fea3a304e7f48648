//! The figure of the guide's page on contacts: shapes and what they touch.

use std::f64::consts::TAU;

use crate::joints::drawn;
use crate::pen::{Of, Pen, V, v};

type Cell = (&'static str, &'static str, fn(&mut Pen));

pub(crate) fn figure() -> String {
    drawn(
        "Contacts: shapes, the surfaces that they touch, and what is given of them",
        &CELLS,
    )
}

fn floor(pen: &mut Pen) {
    pen.block(Of::I, v(0.0, 0.0, -24.0), v(34.0, 50.0, 3.0));
}

fn normal(pen: &mut Pen) {
    pen.axis(v(-20.0, -38.0, -21.0), v(-20.0, -38.0, 28.0));
    pen.dot(v(-20.0, -38.0, -21.0));
    pen.word("o", v(-20.0, -38.0, 28.0), [-20.0, -6.0], "normal");
}

/// A cam about the origin with an axis along x, by the distances `18 + 6 cos a` of its tangents.
fn cam(pen: &mut Pen, centre: V) {
    let edge: Vec<V> = (0..48)
        .map(|step| {
            let (sine, cosine) = (TAU * f64::from(step) / 48.0).sin_cos();
            let (far, slope) = (18.0 + 6.0 * cosine, -6.0 * sine);
            centre
                + v(
                    0.0,
                    far * cosine - slope * sine,
                    far * sine + slope * cosine,
                )
        })
        .collect();
    pen.plate(Of::J, v(1.0, 0.0, 0.0), &edge);
    pen.axis(centre - v(26.0, 0.0, 0.0), centre + v(40.0, 0.0, 0.0));
    pen.dot(centre + v(4.0, 0.0, 0.0));
}

const CELLS: [Cell; 7] = [
    ("contact", "a point on a plane", |pen| {
        floor(pen);
        pen.block(Of::J, v(0.0, 6.0, 2.0), v(14.0, 22.0, 23.0));
        normal(pen);
        pen.dot(v(14.0, 28.0, -21.0));
        pen.dot(v(14.0, -16.0, -21.0));
    }),
    ("contact, radius", "a ball on a plane", |pen| {
        floor(pen);
        pen.ball(Of::J, v(0.0, 0.0, 5.0), 26.0);
        normal(pen);
        pen.dot(v(0.0, 0.0, 5.0));
    }),
    ("contact_of_disc", "the edge of a disc on a plane", |pen| {
        floor(pen);
        pen.cylinder(Of::J, v(-4.0, 0.0, 9.0), v(4.0, 0.0, 13.0), 31.0);
        pen.axis(v(-30.0, 0.0, -2.0), v(46.0, 0.0, 34.0));
        normal(pen);
        pen.dot(v(4.0, 0.0, 13.0));
        pen.word("o", v(46.0, 0.0, 34.0), [-28.0, -2.0], "axis");
    }),
    ("contact_with_sphere", "two balls", |pen| {
        pen.ball(Of::I, v(0.0, -16.0, -8.0), 30.0);
        pen.ball(Of::J, v(0.0, 28.0, 16.0), 20.0);
        pen.dot(v(0.0, -16.0, -8.0));
        pen.dot(v(0.0, 28.0, 16.0));
    }),
    ("hollow", "a ball in a bowl", |pen| {
        pen.ball(Of::I, v(0.0, 0.0, 2.0), 46.0);
        pen.ball(Of::J, v(0.0, 20.0, -21.0), 15.5);
        pen.dot(v(0.0, 0.0, 2.0));
        pen.dot(v(0.0, 20.0, -21.0));
    }),
    ("contact_of_cam", "a flat follower on a cam", |pen| {
        pen.block(Of::I, v(0.0, 0.0, 18.0), v(20.0, 40.0, 3.0));
        pen.cylinder(Of::I, v(0.0, 0.0, 21.0), v(0.0, 0.0, 50.0), 6.0);
        cam(pen, v(0.0, 0.0, -4.0));
    }),
    ("contact_with_cam", "a roller on a cam", |pen| {
        pen.cylinder(Of::I, v(-4.0, 0.0, 26.0), v(4.0, 0.0, 26.0), 12.0);
        pen.dot(v(4.0, 0.0, 26.0));
        cam(pen, v(0.0, 0.0, -10.0));
    }),
];
