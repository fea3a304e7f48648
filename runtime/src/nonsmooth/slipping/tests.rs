//! Against a scan for all zeros of one effort, and against the equations themselves for several.

use super::{Refusal, Slipping};
use crate::nonsmooth::bearing::Ends;
use crate::nonsmooth::loads::{BearingLoads, add, size, zeros};
use crate::tests::numbers::Numbers;

fn ends(numbers: &mut Numbers, size: f64) -> Ends<f64> {
    core::array::from_fn(|_| core::array::from_fn(|_| size * numbers.next()))
}

fn loads<const K: usize>(numbers: &mut Numbers, growth: f64) -> BearingLoads<f64, K> {
    BearingLoads {
        offset: core::array::from_fn(|_| ends(numbers, 1.0)),
        by_effort: core::array::from_fn(|_| core::array::from_fn(|_| ends(numbers, growth))),
    }
}

fn identity<const K: usize>() -> [[f64; K]; K] {
    core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }))
}

/// `c (|a1 + d1 x| + |a2 + d2 x|) - |x|` on the side of `c`, over `y = |x|`.
fn excess(loads: &BearingLoads<f64, 1>, coefficient: f64, y: f64) -> f64 {
    let mut ends = loads.offset[0];
    add(coefficient.signum() * y, &loads.by_effort[0][0], &mut ends);
    coefficient.abs() * size(&ends) - y
}

#[test]
fn one_effort_is_found_where_it_is_the_only_one() {
    let mut numbers = Numbers(7);
    let matrix = identity();
    let mut counts = [0_usize; 3];
    for _ in 0..2000 {
        let loads = loads::<1>(&mut numbers, 1.0);
        let coefficient = numbers.next();
        let found = Slipping {
            matrix: &matrix,
            loads: &loads,
            holds: [false],
            coefficients: [Some(coefficient)],
        }
        .efforts(&[0.0], &[0.0]);
        // Zeros by a scan, closer and closer to infinity: a convex function has two at the most.
        let places = (0..4000).map(|k| (f64::from(k) / 4000.0 * 1.5).tan() * 4.0);
        let values: [f64; 2] = [
            excess(&loads, coefficient, 0.0),
            excess(&loads, coefficient, 1e9),
        ];
        let mut zeros = 0;
        let mut last = values[0] > 0.0;
        for place in places {
            let now = excess(&loads, coefficient, place) > 0.0;
            zeros += usize::from(now != last);
            last = now;
        }
        zeros += usize::from((values[1] > 0.0) != last);
        match found {
            Ok([x]) => {
                assert_eq!(zeros, 1);
                assert!(x * coefficient >= 0.0);
                let left = excess(&loads, coefficient, x.abs());
                assert!(left.abs() < 1e-14 * (1.0 + x.abs()) * 8.0, "{left:e} {x}");
            }
            Err(refusal) => {
                assert_eq!(refusal, Refusal::NotUnique(0));
                assert_ne!(zeros, 1);
            }
        }
        counts[zeros] += 1;
    }
    assert!(counts.iter().all(|count| *count > 10), "{counts:?}");
}

#[test]
fn several_efforts_and_what_is_held_satisfy_their_equations() {
    let mut numbers = Numbers(11);
    let mut solved = 0;
    for _ in 0..2000 {
        let loads = loads::<4>(&mut numbers, 0.25);
        // Of full rank, with what is held elastic on what slides.
        let root: [[f64; 4]; 4] =
            core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
        let mut matrix = [[0.0; 4]; 4];
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, element) in row.iter_mut().enumerate() {
                let own = if i == j { 0.5 } else { 0.0 };
                *element = own + (0..4).map(|k| root[i][k] * root[j][k]).sum::<f64>();
            }
        }
        let offset: [f64; 4] = core::array::from_fn(|_| numbers.next());
        let slides = [0.6 * numbers.next(), 0.6 * numbers.next()];
        let found = Slipping {
            matrix: &matrix,
            loads: &loads,
            holds: [false, true, false, false],
            coefficients: [Some(slides[0]), None, Some(slides[1]), None],
        }
        .efforts(&offset, &[0.0, 0.0, 0.0, 0.7]);
        let Ok(efforts) = found else {
            continue;
        };
        solved += 1;
        assert_eq!(efforts[3], 0.7);
        let held = offset[1] + (0..4).map(|j| matrix[1][j] * efforts[j]).sum::<f64>();
        assert!(held.abs() < 1e-13, "{held:e}");
        let sizes = loads.sizes(&efforts);
        for (index, slides) in [(0, slides[0]), (2, slides[1])] {
            let left = efforts[index] - slides * sizes[index];
            assert!(left.abs() < 1e-13 * (1.0 + sizes[index]), "{left:e}");
        }
    }
    assert!(solved > 500, "{solved}");
}

/// Two frictions that load each other: by the spectral radius, whatever their units.
#[test]
fn a_product_of_growths_decides_for_two() {
    for (product, is_unique) in [(0.25, true), (0.98, true), (1.02, false), (4.0, false)] {
        for unit in [1e-6, 1.0, 1e6] {
            let mut loads = BearingLoads::<f64, 2> {
                offset: [zeros(); 2],
                by_effort: [[zeros(); 2]; 2],
            };
            loads.offset[0][0] = [0.0, 1.0, 0.0];
            loads.offset[1][0] = [0.0, 0.0, unit];
            loads.by_effort[0][1][0] = [0.0, product / unit, 0.0];
            loads.by_effort[1][0][0] = [0.0, 0.0, unit];
            let found = Slipping {
                matrix: &identity(),
                loads: &loads,
                holds: [false; 2],
                coefficients: [Some(1.0), Some(1.0)],
            }
            .efforts(&[0.0; 2], &[0.0; 2]);
            assert_eq!(found.is_ok(), is_unique, "{product} {unit} {found:?}");
            if let Ok([x, y]) = found {
                // x = 1 + product y / unit, y = unit (1 + x)
                let wanted = (1.0 + product) / (1.0 - product);
                assert!((x - wanted).abs() < 1e-12 * wanted, "{x} {wanted}");
                assert!((y / unit - 1.0 - wanted).abs() < 1e-12 * wanted, "{y}");
            }
        }
    }
}

#[test]
fn numbers_that_are_none_are_refused() {
    let mut loads = BearingLoads::<f64, 1> {
        offset: [zeros()],
        by_effort: [[zeros()]],
    };
    loads.offset[0][0] = [f64::NAN, 0.0, 0.0];
    let found = Slipping {
        matrix: &identity(),
        loads: &loads,
        holds: [false],
        coefficients: [Some(0.5)],
    }
    .efforts(&[0.0], &[0.0]);
    assert_eq!(found, Err(Refusal::NotFinite));
}
