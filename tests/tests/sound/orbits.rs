//! Orbits whose period a small change of energy has shifted.

use core::f64::consts::{PI, TAU};

use holonom::joints::PointOnPlane;
use holonom::prelude::*;
use holonom::{Adams, Bdf, BogackiShampine, Heun, ImplicitMidpoint, Midpoint, RadauIIA, Runs};
use holonom::{DormandPrince853, SemiImplicitEuler, mechanism::Relative};

holonom::force! {
    pub force Sun(i; strength: Number) { potential -strength / length(i.origin); }
}

/// A planet of a sun, one unit away where it is nearest or farthest.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Orbit {
    #[body(mass = 1.0, position = [distance, 0.0, 0.0], velocity = [0.0, speed, 0.0])]
    planet: Particle,
    #[joint(between = [ground, planet], point = [distance, 0.0, 0.0], normal = [0.0, 0.0, 1.0])]
    plane: PointOnPlane,
    #[force(between = [planet], strength = 1.0)]
    sun: Sun,
    #[param]
    distance: f64,
    #[param]
    speed: f64,
}

/// An orbit of a large half-axis of 1, from the place next to the sun or the farthest one on.
struct Case {
    eccentricity: f64,
    turns: f64,
    is_near: bool,
}

impl Case {
    /// The largest distance from where the planet should be, and whether there are warnings.
    fn run<I>(&self, integrator: impl Fn(&Orbit) -> I) -> (f64, bool)
    where
        I: Runs<Problem<Orbit, StandardLagrange, f64, Relative>>,
    {
        let (e, sign) = (self.eccentricity, if self.is_near { 1.0 } else { -1.0 });
        let distance = 1.0 - sign * e;
        let speed = ((1.0 + sign * e) / distance).sqrt();
        let orbit = Orbit::new(distance, speed).expect("acceptable");
        let end = TAU * self.turns;
        let mut off = 0.0_f64;
        let report = Simulation::new(&orbit, StandardLagrange, integrator(&orbit))
            .run(0.0..=end, every(end / 200.0), |sample| {
                let from = if self.is_near { 0.0 } else { PI };
                let mean = (sample.time() + from).rem_euclid(TAU);
                let mut anomaly = if e > 0.8 { PI } else { mean };
                for _ in 0..60 {
                    let excess = anomaly - e * anomaly.sin() - mean;
                    anomaly -= excess / (1.0 - e * anomaly.cos());
                }
                let x = sign * (anomaly.cos() - e);
                let y = sign * (1.0 - e * e).sqrt() * anomaly.sin();
                let place = sample.position(Orbit::HANDLES.planet);
                off = off.max((place.x - x).hypot(place.y - y));
            })
            .expect("it runs");
        (off, !report.warnings().is_empty())
    }
}

/// What came of all runs.
#[derive(Debug, Default)]
struct Counts {
    right: usize,
    alarms: usize,
    wrong: usize,
    silent: usize,
    /// The largest error without a word.
    unseen: f64,
}

impl Counts {
    fn take(&mut self, (off, is_warned): (f64, bool)) {
        let (is_wrong, is_silent) = (off > 1e-2, !is_warned);
        self.right += usize::from(!is_wrong);
        self.alarms += usize::from(!is_wrong && is_warned);
        self.wrong += usize::from(is_wrong);
        self.silent += usize::from(is_wrong && is_silent);
        if is_silent {
            self.unseen = self.unseen.max(off);
        }
    }
}

#[test]
fn coarse_orbits_are_told_and_fine_ones_are_quiet() {
    let (mut coarse, mut fine) = (Counts::default(), Counts::default());
    for eccentricity in [0.0, 0.3, 0.6, 0.9, 0.98] {
        // Fixed steps for the flattest orbit are so short that ten turns would take as long as all
        // else here.
        let many = if eccentricity > 0.9 { 2.0 } else { 10.0 };
        for (turns, is_near) in [(1.0, true), (3.0, true), (many, true), (3.0, false)] {
            let case = Case {
                eccentricity,
                turns,
                is_near,
            };
            // A two-hundredth of a turn with the radius of the nearest passage.
            let h = TAU * (1.0 - eccentricity).powf(1.5) / 200.0;
            let of = |orbit: &Orbit, relative| Tolerance::of(orbit, relative).expect("bodies");
            coarse.take(case.run(|_| Heun::every(h)));
            coarse.take(case.run(|_| Midpoint::every(h)));
            coarse.take(case.run(|_| ImplicitMidpoint::every(h)));
            coarse.take(case.run(|_| SemiImplicitEuler::every(h)));
            coarse.take(case.run(|_| Rk4::every(8.0 * h)));
            coarse.take(case.run(|orbit| BogackiShampine::new(of(orbit, 1e-4))));
            coarse.take(case.run(|orbit| Adams::new(of(orbit, 1e-4))));
            coarse.take(case.run(|orbit| Bdf::new(of(orbit, 1e-4))));
            coarse.take(case.run(|orbit| DormandPrince::new(of(orbit, 1e-4))));
            coarse.take(case.run(|_| DormandPrince::default()));
            fine.take(case.run(|_| Rk4::every(h)));
            fine.take(case.run(|orbit| Adams::new(of(orbit, 1e-8))));
            fine.take(case.run(|orbit| DormandPrince::new(of(orbit, 1e-9))));
            fine.take(case.run(|orbit| DormandPrince853::new(of(orbit, 1e-8))));
            fine.take(case.run(|orbit| RadauIIA::new(of(orbit, 1e-7))));
        }
    }
    println!("coarse {coarse:?}, fine {fine:?}");
    assert_eq!(coarse.right + coarse.wrong, 200);
    assert!(coarse.wrong > 100 && coarse.silent <= 10, "{coarse:?}");
    assert!(coarse.unseen < 3e-2, "{coarse:?}");
    assert!(10 * coarse.alarms <= coarse.right, "{coarse:?}");
    assert!(
        fine.right >= 95 && fine.alarms == 0 && fine.silent == 0,
        "{fine:?}"
    );
}
