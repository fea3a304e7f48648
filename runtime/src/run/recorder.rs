//! Samples of a run as lines of a CSV file.

use core::any::TypeId;
use std::format;
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;
use std::string::String;
use std::vec::Vec;

use crate::error::AngleSet;
use crate::math::scalar::Real;
use crate::measure::unwrapped::UnwrappedAngle;
use crate::mechanism::handle::{BodyHandle, JointHandle, StateHandle};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::readout::AngleParts;
use crate::mechanism::report::BodyKind;
use crate::run::columns::{Extra, columns, loaded, rigid};
use crate::run::record_error::RecordError;
use crate::run::sample::Sample;

/// Writes samples as comma-separated values, for any mechanism: one line a sample, under one line
/// of names with units.
///
/// | columns | meaning |
/// |---|---|
/// | `time [s]` | the time |
/// | `rod.position.x [m]`, y, z | centre of mass of the body `rod`, global |
/// | `rod.orientation.e0`, e1, e2, e3 | Euler parameters, scalar first, of the rotation from the user's body axes to the global axes; not for a particle |
/// | `rod.velocity.x [m/s]`, y, z | velocity of the centre of mass, global |
/// | `rod.angular_velocity.x [rad/s]`, y, z | along the user's body axes; not for a particle |
/// | `pivot.angle [rad]`, `pivot.angle_rate [rad/s]` | of a joint with an angle, which goes on over turns from line to line, see [`UnwrappedAngle`] |
/// | `slide.displacement [m]`, `slide.displacement_rate [m/s]` | of a joint with a displacement |
/// | `kinetic_energy [J]`, `potential_energy [J]` | of the mechanism |
/// | `violation` | `Phi^T Phi`, in the mixed units of the equations |
/// | `rod.euler_angles.precession [rad]`, nutation, spin | with [`Recorder::with_euler_angles`], of every body but particles, see [`View::euler_angles`](crate::View::euler_angles) |
/// | `rod.bryant_angles.first [rad]`, second, third | with [`Recorder::with_bryant_angles`], likewise |
/// | `rod.roll_pitch_yaw.roll [rad]`, pitch, yaw | with [`Recorder::with_roll_pitch_yaw`], likewise |
/// | `pivot.force.x [N]`, y, z, `pivot.moment.x [N m]`, y, z | with [`Recorder::with_reactions`]: what the joint exerts on the last body of its `between`, global, reduced to the joint's point on it; `gears.wheel.force.x [N]` for each body where a joint has more than two |
///
/// Three angles of an orientation are singular somewhere (gimbal lock). There the fields of the
/// first and the third angle are empty, which programs read as a missing value. They jump from `pi`
/// to `-pi`.
///
/// A line goes to the writer in one piece and is flushed: an interruption loses the line that it
/// meets and no other. Numbers are written with the fewest digits that read back to the same `f64`.
///
/// ```
/// use holonom::prelude::*;
/// use holonom::Recorder;
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81])]
/// struct Pendulum {
///     #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     pivot: Revolute,
/// }
///
/// let mut recorder = Recorder::new(Vec::new()).with_reactions();
/// Simulation::new(&Pendulum::default(), StandardLagrange, Rk4::every(0.01))
///     .run(0.0..=1.0, every(0.1), |sample| recorder.record(sample))?;
/// let text = String::from_utf8(recorder.into_inner()).expect("text");
/// assert!(text.starts_with("time [s],rod.position.x [m],"));
/// assert_eq!(text.lines().count(), 1 + 11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Recorder<W> {
    writer: W,
    extra: Extra,
    /// The mechanism of the first sample.
    mechanism: Option<TypeId>,
    /// The angles of its joints, in their order, after the last line.
    angles: Vec<UnwrappedAngle<f64>>,
    /// Whether the names of the columns are written.
    is_titled: bool,
    /// Whether a line was not written to its end.
    torn: bool,
}

impl Recorder<File> {
    /// A recorder that writes to a file; an existing one is replaced.
    ///
    /// # Errors
    /// [`RecordError::Io`] where the file cannot be created.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, RecordError> {
        Ok(Self::new(File::create(path)?))
    }
}

impl<W: Write> Recorder<W> {
    /// A recorder that writes to any writer, without reactions. It needs no buffer of its own: a
    /// line is one call.
    #[must_use]
    pub fn new(writer: W) -> Self {
        Self {
            writer,
            extra: Extra::default(),
            mechanism: None,
            angles: Vec::new(),
            is_titled: false,
            torn: false,
        }
    }

    /// Records the reactions of all joints as well, at one evaluation a sample.
    #[must_use]
    pub fn with_reactions(mut self) -> Self {
        self.extra.reactions = true;
        self
    }

    /// Records the Euler angles of all bodies as well.
    #[must_use]
    pub fn with_euler_angles(self) -> Self {
        self.with_angles(AngleSet::EulerZxz)
    }

    /// Records the Bryant angles of all bodies as well.
    #[must_use]
    pub fn with_bryant_angles(self) -> Self {
        self.with_angles(AngleSet::BryantXyz)
    }

    /// Records roll, pitch and yaw of all bodies as well.
    #[must_use]
    pub fn with_roll_pitch_yaw(self) -> Self {
        self.with_angles(AngleSet::RollPitchYaw)
    }

    fn with_angles(mut self, angles: AngleSet) -> Self {
        if !self.extra.angles.contains(&angles) {
            self.extra.angles.push(angles);
        }
        self
    }

    /// The names of the columns with their units, as they stand in the first line.
    #[must_use]
    pub fn columns<M: Mechanism>(&self) -> Vec<String> {
        columns::<M>(&self.extra)
    }

    /// The numbers of a sample in the order of [`Recorder::columns`], for those who put them
    /// elsewhere; `None` where a field would be empty. Nothing is written. Angles go on over turns
    /// from sample to sample.
    ///
    /// # Errors
    /// [`RecordError::OtherMechanism`], [`RecordError::NotFinite`] and the fault of an evaluation.
    pub fn values<S: Real, M: Mechanism>(
        &mut self,
        sample: &Sample<'_, S, M>,
    ) -> Result<Vec<Option<f64>>, RecordError> {
        let mechanism = TypeId::of::<M>();
        if self.mechanism.is_some_and(|known| known != mechanism) {
            return Err(RecordError::OtherMechanism);
        }
        let mut angles = self.angles.clone();
        angles.resize_with(M::REPORT.joints.len(), UnwrappedAngle::default);
        let row = Row::of(sample, &mut angles, &self.extra)?;
        let is_wrong = |value: &Option<f64>| value.is_some_and(|value| !value.is_finite());
        if let Some(place) = row.values.iter().position(is_wrong) {
            let column = columns::<M>(&self.extra).swap_remove(place);
            return Err(RecordError::NotFinite { column });
        }
        self.mechanism = Some(mechanism);
        self.angles = angles;
        Ok(row.values)
    }

    /// Writes a sample as one line, the first one under the names of the columns.
    ///
    /// # Errors
    /// See [`RecordError`].
    pub fn record<S: Real, M: Mechanism>(
        &mut self,
        sample: &Sample<'_, S, M>,
    ) -> Result<(), RecordError> {
        if self.torn {
            return Err(RecordError::Torn);
        }
        let values = self.values(sample)?;
        if !self.is_titled {
            self.line(&columns::<M>(&self.extra))?;
            self.is_titled = true;
        }
        let digits = |value: &Option<f64>| value.map_or_else(String::new, |x| format!("{x:?}"));
        self.line(&values.iter().map(digits).collect::<Vec<_>>())
    }

    /// The writer.
    #[must_use]
    pub fn writer(&self) -> &W {
        &self.writer
    }

    /// The writer, with all that was recorded.
    #[must_use]
    pub fn into_inner(self) -> W {
        self.writer
    }

    /// Writes a line in one piece.
    fn line(&mut self, fields: &[String]) -> Result<(), RecordError> {
        let mut text = Vec::new();
        {
            let mut csv = csv::Writer::from_writer(&mut text);
            csv.write_record(fields).map_err(io::Error::from)?;
            csv.flush()?;
        }
        self.torn = true;
        self.writer.write_all(&text)?;
        self.writer.flush()?;
        self.torn = false;
        Ok(())
    }
}

/// The values of a sample, in the order of the columns; `None` for an angle that is not known.
struct Row {
    values: Vec<Option<f64>>,
}

impl Row {
    fn of<S: Real, M: Mechanism>(
        sample: &Sample<'_, S, M>,
        angles: &mut [UnwrappedAngle<f64>],
        extra: &Extra,
    ) -> Result<Self, RecordError> {
        let mut row = Self { values: Vec::new() };
        row.push(&[sample.time()]);
        for (place, body) in M::REPORT.bodies.iter().enumerate() {
            let handle = BodyHandle::<M>::new(place);
            let pose = sample.pose(handle);
            row.push(pose.position.as_slice());
            if body.kind == BodyKind::Rigid {
                let [x, y, z, w] = pose.orientation.coords.into();
                row.push(&[w, x, y, z]);
            }
            row.push(sample.velocity(handle).as_slice());
            if body.kind == BodyKind::Rigid {
                row.push(sample.angular_velocity(handle).as_slice());
            }
        }
        for ((place, joint), angle) in M::REPORT.joints.iter().enumerate().zip(angles) {
            if joint.has_angle {
                let parts = in_double(&sample.angle_parts(place));
                let whole = sample.angle_of(place).to_f64();
                let time = sample.time().to_f64();
                row.push(&[angle.follow(time, whole, &parts), parts.rate]);
            }
            if joint.has_displacement {
                let parts = sample.displacement_parts(place);
                row.push(&[parts.value, parts.rate]);
            }
        }
        for place in 0..M::REPORT.states.len() {
            row.push(&[sample.state_value(StateHandle::new(place))]);
        }
        row.push(&[
            sample.kinetic_energy(),
            sample.potential_energy(),
            sample.violation(),
        ]);
        for &angles in &extra.angles {
            for (place, _) in rigid::<M>() {
                let found = sample.known_angles(BodyHandle::new(place), angles);
                row.values.extend(found.map(|angle| angle.map(S::to_f64)));
            }
        }
        if extra.reactions {
            for (place, joint) in M::REPORT.joints.iter().enumerate() {
                let handle = JointHandle::<M, ()>::new(place);
                for body in loaded(joint) {
                    let wrench = sample.reaction_on_place(handle, body)?;
                    row.push(wrench.force.as_slice());
                    row.push(wrench.moment.as_slice());
                }
            }
        }
        Ok(row)
    }

    fn push<S: Real>(&mut self, values: &[S]) {
        self.values
            .extend(values.iter().map(|value| Some(value.to_f64())));
    }
}

/// The parts of an angle as numbers of a record.
fn in_double<S: Real>(parts: &AngleParts<S>) -> AngleParts<f64> {
    AngleParts {
        cosine: parts.cosine.to_f64(),
        sine: parts.sine.to_f64(),
        rate: parts.rate.to_f64(),
        turns: parts.turns.map(S::to_f64),
    }
}
