//! Reports of runs as they are written to a file. They are not read back: a report says what a
//! program did. Its state is one that [`NamedState`] reads.

use serde::ser::{SerializeSeq as _, SerializeStruct as _};
use serde::{Serialize, Serializer};

use crate::error::sentence::Sentence;
use crate::math::scalar::Real;
use crate::measure::named_state::NamedState;
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::run::kinematics::KinematicReport;
use crate::run::report::RunReport;
use crate::run::verification::Verification;

/// The fields but `time` and `monitor`, with `warnings` behind them. `state` has the time, and is a
/// [`NamedState`].
impl<S: Real + Serialize, M: Mechanism> Serialize for RunReport<S, M> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut fields = serializer.serialize_struct("RunReport", 9)?;
        fields.serialize_field("evaluations", &self.evaluations)?;
        fields.serialize_field("accepted", &self.accepted)?;
        fields.serialize_field("rejected", &self.rejected)?;
        fields.serialize_field("worst_violation", &self.worst_violation)?;
        fields.serialize_field("iterations", &self.iterations)?;
        fields.serialize_field("stopped", &self.stopped)?;
        let state = NamedState::<M, S>::new(self.time, self.state);
        fields.serialize_field("state", &state)?;
        fields.serialize_field("verification", &self.verification)?;
        fields.serialize_field("warnings", &self.warnings())?;
        fields.end()
    }
}

/// The fields but the state, whose mechanism it does not know: write that as a [`NamedState`].
impl<S: Serialize, X> Serialize for KinematicReport<S, X> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut fields = serializer.serialize_struct("KinematicReport", 8)?;
        fields.serialize_field("poses", &self.poses)?;
        fields.serialize_field("steps", &self.steps)?;
        fields.serialize_field("shortened", &self.shortened)?;
        fields.serialize_field("iterations", &self.iterations)?;
        fields.serialize_field("worst_violation", &self.worst_violation)?;
        fields.serialize_field("time", &self.time)?;
        fields.serialize_field("stopped", &self.stopped)?;
        fields.serialize_field("warnings", &self.warnings())?;
        fields.end()
    }
}

/// `compared`, `evaluations`, `bodies` with the error of each, and `ended`: the time and the
/// sentence of the fault, or nothing.
impl<S: Real + Serialize, M: Mechanism> Serialize for Verification<S, M> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut fields = serializer.serialize_struct("Verification", 4)?;
        fields.serialize_field("compared", &self.compared)?;
        fields.serialize_field("evaluations", &self.evaluations)?;
        fields.serialize_field("bodies", &Bodies(self))?;
        let ended = self.ended.map(|(time, fault)| (time, Sentence(fault)));
        fields.serialize_field("ended", &ended)?;
        fields.end()
    }
}

struct Bodies<'a, S: Real, M: Mechanism>(&'a Verification<S, M>);

impl<S: Real + Serialize, M: Mechanism> Serialize for Bodies<'_, S, M> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut bodies = serializer.serialize_seq(Some(M::REPORT.bodies.len()))?;
        for place in 0..M::REPORT.bodies.len() {
            bodies.serialize_element(&self.0.body(BodyHandle::new(place)))?;
        }
        bodies.end()
    }
}
