//! Tableaus as steps take them: read from the stages that a method asks for.

use std::vec;
use std::vec::Vec;

use super::*;
use crate::integrate::EmbeddedPair;

/// Stages of a tableau, at most.
const MOST: usize = 12;

/// Evaluation `k` after the start gives slope `k`, each in an element of its own: the state at a
/// stage is then its row.
struct Reader {
    times: Vec<f64>,
    rows: Vec<[f64; MOST]>,
}

fn slope(index: usize) -> [f64; MOST] {
    core::array::from_fn(|element| if element == index { 1.0 } else { 0.0 })
}

impl System<f64> for Reader {
    type State = [f64; MOST];

    fn rates(&mut self, time: f64, state: &[f64; MOST]) -> Result<[f64; MOST], Fault> {
        self.times.push(time);
        self.rows.push(*state);
        Ok(slope(self.rows.len() - 1))
    }
}

/// Times and rows of the stages, that at the start among them, and the weights of the result.
fn tableau<K: OneStep<f64, Reader>>(scheme: K) -> (Vec<f64>, Vec<[f64; MOST]>, [f64; MOST]) {
    let nothing = [0.0; MOST];
    let mut reader = Reader {
        times: vec![0.0],
        rows: vec![nothing],
    };
    let start = StepStart {
        time: 0.0,
        state: &nothing,
        slope: &slope(0),
    };
    let mut stages = scheme.stages(&nothing);
    let result = scheme
        .advanced(&mut Slopes::new(&mut reader), start, 1.0, &mut stages)
        .unwrap();
    (reader.times, reader.rows, result)
}

/// By how much the conditions of an order are missed, at most: of the trees of up to four nodes and
/// of quadrature (Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, table
/// II.2.1).
fn missed<K: OneStep<f64, Reader>>(scheme: K, order: i32) -> f64 {
    let (c, a, b) = tableau(scheme);
    let stages = c.len();
    let sum = |of: &dyn Fn(usize) -> f64| (0..stages).map(of).sum::<f64>();
    // `A v`.
    let row = |i: usize, of: &dyn Fn(usize) -> f64| (0..i).map(|j| a[i][j] * of(j)).sum::<f64>();
    let mut conditions = Vec::new();
    for k in 1..=order {
        let quadrature = sum(&|i| b[i] * c[i].powi(k - 1));
        conditions.push(quadrature - 1.0 / f64::from(k));
    }
    if order >= 3 {
        conditions.push(sum(&|i| b[i] * row(i, &|j| c[j])) - 1.0 / 6.0);
    }
    if order >= 4 {
        conditions.push(sum(&|i| b[i] * c[i] * row(i, &|j| c[j])) - 1.0 / 8.0);
        conditions.push(sum(&|i| b[i] * row(i, &|j| c[j] * c[j])) - 1.0 / 12.0);
        conditions.push(sum(&|i| b[i] * row(i, &|j| row(j, &|k| c[k]))) - 1.0 / 24.0);
    }
    // Every stage is where its time is.
    conditions.extend((0..stages).map(|i| row(i, &|_| 1.0) - c[i]));
    conditions.into_iter().map(f64::abs).fold(0.0, f64::max)
}

#[test]
fn tableaus_meet_the_conditions_of_their_order_and_not_of_the_next() {
    fn check<K: OneStep<f64, Reader>>(scheme: K, order: i32, stages: usize) {
        assert_eq!(tableau(scheme).0.len(), stages, "{scheme:?}");
        let (met, next) = (missed(scheme, order), missed(scheme, order + 1));
        assert!(met < 1e-14, "{scheme:?}: {met}");
        assert!(next > 1e-6, "{scheme:?}: {next}");
        // What it says of itself.
        let (_, a, b) = tableau(scheme);
        let said = scheme.tableau().expect("an explicit method");
        let row = |terms: &[(usize, f64)]| {
            let mut row = [0.0; MOST];
            terms
                .iter()
                .for_each(|&(slope, weight)| row[slope] += weight);
            row
        };
        let rows = said.stages.iter().map(|terms| row(terms));
        for (said, taken) in rows
            .chain([row(said.result)])
            .zip(a[1..].iter().chain([&b]))
        {
            let apart = said.iter().zip(taken).map(|(said, taken)| said - taken);
            assert!(apart.map(f64::abs).sum::<f64>() < 1e-14, "{scheme:?}");
        }
        assert_eq!(said.stages.len() + 1, stages);
    }
    check(Midpoint, 2, 2);
    check(Heun, 2, 2);
    check(Kutta3, 3, 3);
    check(BogackiShampine3, 3, 3);
    check(Rk4, 4, 4);
    check(DormandPrince5, 5, 6);
    check(DormandPrince8, 8, 12);
}

#[test]
fn nothing_is_missed_where_all_slopes_are_the_same() {
    fn check<K: EmbeddedPair<f64>>(pair: K) {
        let same = [1.0];
        let record = StepRecord {
            step: 1.0,
            from: &[0.0],
            first: &same,
            stages: &pair.stages(&same),
            to: &[0.0],
            last: &same,
        };
        let error = pair.error(&record, 1.0);
        assert!(error < 1e-14, "{pair:?}: {error}");
    }
    check(BogackiShampine3);
    check(DormandPrince5);
    check(DormandPrince8);
}
