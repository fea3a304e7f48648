//! What a page runs: a mechanism, its stepper and the state that was reached.
//!
//! It knows no clock: the page says how many steps are taken. So a session on the host and one in a
//! page take the same ones.

use holonom::dynamics::{Bodies, Solvable, State};
use holonom::error::AssemblyFault;
use holonom::run::Steps;
use holonom::{BodyHandle, Fault, Mechanism, MechanismExt as _, Stepper};
use holonom_film::Film;

use crate::error::LiveError;
use crate::refused::Refused;
use crate::settings::Live;
use crate::slider::{Moves, Slider};
use crate::watch::Watch;

/// A parameter is moved by at most this part of its range at once: the loops stay on their branch.
const PART: f64 = 0.05;
/// How far an assembled coordinate may be from what a slider says, in parts of its range.
const OFF: f64 = 1e-6;
/// Parts of a move, at most, unless something moves much.
const MOST: f64 = 100.0;
/// How far bodies follow a part of a move (rad, or extents of the mechanism).
const LITTLE: f64 = 0.1;
/// The smallest part of a move.
const LEAST: f64 = 1.0 / 1024.0;

/// A mechanism that runs under sliders.
pub struct Session<M: Mechanism, P: Solvable<Number = f64, Mechanism = M>, K> {
    live: Live<M, P, K>,
    stepper: Stepper<P, K>,
    state: State<P>,
    /// What a slider of a start was set to; `None` where it follows.
    starts: Vec<Option<f64>>,
    /// The value of each slider: of a start what it was set to, or what the joint began with.
    values: Vec<f64>,
    /// The ends of each slider.
    ends: Vec<[f64; 2]>,
    watch: Watch,
}

impl<M, P, K> Session<M, P, K>
where
    M: Mechanism,
    P: Solvable<Number = f64, Mechanism = M, Forces: Clone>,
    K: Steps<P> + Copy,
{
    pub(crate) fn new(mut live: Live<M, P, K>) -> Result<Self, LiveError> {
        if let Some(error) = live.fault.take() {
            return Err(error);
        }
        if !(live.step.is_finite() && live.step > 0.0) {
            return Err(LiveError::Step { step: live.step });
        }
        for (place, slider) in live.sliders.iter().enumerate() {
            let mut before = live.sliders[..place].iter();
            if before.any(|other| other.name == slider.name) {
                let name = slider.name.clone();
                return Err(LiveError::Name { name });
            }
        }
        let starts = vec![None; live.sliders.len()];
        let (stepper, state) = started(&live, &starts)?;
        let mut values = coordinates(&live, &stepper, &state);
        for (slider, value) in live.sliders.iter().zip(&mut values) {
            if let Moves::Parameter(field) | Moves::Input(field) = &slider.moves {
                *value = *field(&mut live.mechanism);
            }
        }
        let mut session = Self {
            watch: Watch::new(1.0),
            ends: Vec::new(),
            values,
            live,
            stepper,
            state,
            starts,
        };
        let size = session.drawn().extent();
        session.watch = Watch::new(size);
        let sliders = session.live.sliders.iter().zip(&session.values);
        let ends = sliders.map(|(slider, &value)| slider.ends(value, size));
        session.ends = ends.collect::<Result<_, _>>()?;
        Ok(session)
    }

    /// The time that was reached (s).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.stepper.time()
    }

    /// The bodies as they are now.
    #[must_use]
    pub fn bodies(&self) -> Bodies<P> {
        self.stepper.bodies(&self.state)
    }

    /// The mechanism with the present values.
    #[must_use]
    pub fn mechanism(&self) -> &M {
        &self.live.mechanism
    }

    /// Takes steps.
    ///
    /// # Errors
    /// Why one could not be taken. Time and state are then those before it.
    pub fn advance(&mut self, steps: usize) -> Result<(), Fault> {
        for step in 0..steps {
            let before = self.state;
            let control = (step == 0).then(|| self.stepper.clone());
            self.stepper.step(&mut self.state, self.live.step)?;
            if let Some(control) = control {
                self.control(control, before);
            }
        }
        Ok(())
    }

    /// Compares the step that was taken with two of half its length.
    fn control(&mut self, mut stepper: Stepper<P, K>, mut state: State<P>) {
        let half = 0.5 * self.live.step;
        for _ in 0..2 {
            // What one half cannot do is no error of the whole.
            if stepper.step(&mut state, half).is_err() {
                return;
            }
        }
        let (one, other) = (self.bodies(), stepper.bodies(&state));
        let largest = (0..M::REPORT.bodies.len()).map(|body| {
            let body = BodyHandle::<M>::new(body);
            let [a, b] = [&one, &other].map(|bodies| M::pose::<f64>(bodies, body));
            // Of the two quaternions of an orientation, the nearer one.
            let [p, q] = [a, b].map(|pose| pose.orientation.coords);
            let turned = (p - q).norm().min((p + q).norm());
            (a.position - b.position).norm() + 2.0 * turned * self.watch.size()
        });
        self.watch.add(largest.fold(0.0, f64::max), self.live.step);
    }

    /// Begins anew with the present values.
    ///
    /// # Errors
    /// Why there is no such start. Everything is then as before.
    pub fn restart(&mut self) -> Result<(), Refused> {
        let (stepper, state) = started(&self.live, &self.starts)?;
        let found = coordinates(&self.live, &stepper, &state);
        for (place, (&start, &found)) in self.starts.iter().zip(&found).enumerate() {
            let [low, high] = self.ends[place];
            let Some(set) = start else { continue };
            if found.is_nan() || (found - set).abs() > OFF * (high - low) {
                let joint = self.live.sliders[place].name.clone();
                return Err(Refused::NotKept { joint, set, found });
            }
        }
        for (place, slider) in self.live.sliders.iter().enumerate() {
            if matches!(slider.moves, Moves::Start { .. }) {
                self.values[place] = self.starts[place].unwrap_or(found[place]);
            }
        }
        (self.stepper, self.state) = (stepper, state);
        self.watch.forget();
        Ok(())
    }

    /// Moves a slider by its place: a parameter or an input under the motion, whose joints are then
    /// closed anew; of a start it begins anew.
    ///
    /// # Errors
    /// Why the value is refused. Everything is then as before.
    pub fn set(&mut self, place: usize, value: f64) -> Result<(), Refused> {
        let sliders = self.live.sliders.len();
        let Some(slider) = self.live.sliders.get(place) else {
            return Err(Refused::NoSlider { place, sliders });
        };
        if !value.is_finite() {
            let name = slider.name.clone();
            return Err(Refused::NotFinite { name });
        }
        match slider.moves {
            Moves::Start { .. } => {
                let before = self.starts[place].replace(value);
                self.restart().inspect_err(|_| self.starts[place] = before)
            }
            Moves::Parameter(_) | Moves::Input(_) => {
                let (stepper, state, old) = (self.stepper.clone(), self.state, self.values[place]);
                let moved = self.moved(place, old, value);
                if moved.is_err() {
                    self.put(place, old);
                    (self.stepper, self.state) = (stepper, state);
                } else {
                    self.values[place] = value;
                    self.watch.forget();
                }
                moved.map_err(|fault| Refused::Value {
                    name: self.live.sliders[place].name.clone(),
                    value,
                    fault,
                })
            }
        }
    }

    /// Moves a value in parts, each so small that what follows it moves little: so loops stay on
    /// their branch.
    fn moved(&mut self, place: usize, old: f64, value: f64) -> Result<(), Fault> {
        if matches!(self.live.sliders[place].moves, Moves::Input(_)) {
            self.put(place, value);
            return self.stepper.update(&self.live.mechanism);
        }
        let [low, high] = self.ends[place];
        let parts = ((value - old).abs() / (PART * (high - low))).ceil();
        let largest = 1.0 / parts.clamp(1.0, MOST);
        let (mut share, mut part) = (0.0, largest);
        while share < 1.0 {
            let next = if share + part > 1.0 - LEAST {
                1.0
            } else {
                share + part
            };
            let before = (self.stepper.clone(), self.state);
            self.put(
                place,
                if next < 1.0 {
                    old + next * (value - old)
                } else {
                    value
                },
            );
            self.stepper.update(&self.live.mechanism)?;
            match self.close() {
                Ok(true) => {
                    share = next;
                    part = largest.min(2.0 * part);
                }
                _ if part > LEAST => {
                    (self.stepper, self.state) = before;
                    part *= 0.5;
                }
                Ok(false) => {
                    let joint = None;
                    return Err(AssemblyFault::WayEnds { joint, share }.into());
                }
                Err(fault) => return Err(fault),
            }
        }
        Ok(())
    }

    /// Closes joints that a parameter has opened, from where the bodies are; whether these moved
    /// little.
    fn close(&mut self) -> Result<bool, Fault> {
        let open = self.bodies();
        let mut closed = open;
        let time = self.stepper.time();
        let correction = self
            .live
            .mechanism
            .assemble_from(time, &mut closed, &open)?;
        if closed != open {
            self.state = self.stepper.state_of(&closed)?;
        }
        let is_little =
            |angle: f64, length: f64| angle <= LITTLE && length <= LITTLE * self.watch.size();
        Ok(correction
            .moved
            .is_none_or(|moved| is_little(moved.angle, moved.length)))
    }

    fn put(&mut self, place: usize, value: f64) {
        if let Moves::Parameter(field) | Moves::Input(field) = &self.live.sliders[place].moves {
            *field(&mut self.live.mechanism) = value;
        }
    }

    /// The values of the sliders, in their order.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The readings, in the order in which they were named.
    #[must_use]
    pub fn readings(&self) -> Vec<f64> {
        let bodies = self.bodies();
        let view = self.stepper.view(&bodies);
        let readings = self.live.readings.iter();
        readings.map(|reading| (reading.read)(&view)).collect()
    }

    /// An estimate of the error of positions after ten seconds, in extents of the mechanism, from
    /// steps that are taken once more in two halves; 0 until some dozens were.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.watch.error()
    }

    /// The step (s).
    #[must_use]
    pub fn step(&self) -> f64 {
        self.live.step
    }

    /// How long the film of the page is (s).
    pub(crate) fn preview(&self) -> f64 {
        self.live.preview
    }

    /// The sliders and their ends.
    pub(crate) fn sliders(&self) -> impl Iterator<Item = (&Slider<M>, [f64; 2])> {
        self.live.sliders.iter().zip(self.ends.iter().copied())
    }

    /// A film of the present state alone.
    pub(crate) fn drawn(&self) -> Film<M> {
        let mut film = (self.live.film)(Film::new());
        self.record(&mut film);
        film
    }

    /// Adds a frame with all readings.
    pub(crate) fn record(&self, film: &mut Film<M>) {
        let bodies = self.bodies();
        let view = self.stepper.view(&bodies);
        film.record_view(&view);
        for reading in &self.live.readings {
            film.reading(&reading.name, &reading.unit, (reading.read)(&view));
        }
    }
}

/// The coordinates of sliders of starts in a state, zeros in the places of others.
fn coordinates<M, P, K>(live: &Live<M, P, K>, stepper: &Stepper<P, K>, state: &State<P>) -> Vec<f64>
where
    M: Mechanism,
    P: Solvable<Number = f64, Mechanism = M>,
    K: Steps<P>,
{
    let bodies = stepper.bodies(state);
    let view = stepper.view(&bodies);
    let read = |slider: &Slider<M>| match &slider.moves {
        Moves::Start { read, .. } => read(&view),
        Moves::Parameter(_) | Moves::Input(_) => 0.0,
    };
    live.sliders.iter().map(read).collect()
}

/// The stepper and the state of a start: as described, with the coordinates that were set, and
/// closed.
fn started<M, P, K>(
    live: &Live<M, P, K>,
    starts: &[Option<f64>],
) -> Result<(Stepper<P, K>, State<P>), Fault>
where
    M: Mechanism,
    P: Solvable<Number = f64, Mechanism = M>,
    K: Steps<P>,
{
    let of = &live.mechanism;
    let stepper = (live.build)(of)?;
    let mut bodies = of.described_state()?;
    for (slider, start) in live.sliders.iter().zip(starts) {
        if let (Moves::Start { set, .. }, Some(value)) = (&slider.moves, *start) {
            set(of, &mut bodies, value)?;
        }
    }
    of.assemble(stepper.time(), &mut bodies)?;
    let state = stepper.state_of(&bodies)?;
    Ok((stepper, state))
}
