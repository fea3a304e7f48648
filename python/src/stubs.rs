//! Documentation and type stubs of a class.

use std::fmt::Write as _;

use holonom::Mechanism;

use crate::described::{Kind, comment, first_sentence, values};
use crate::exposed::Exposed;

/// A value in the signature of a class.
struct Listed {
    name: &'static str,
    kind: Kind,
    is_array: bool,
    is_required: bool,
    about: String,
}

/// A class in words.
pub(crate) struct Described {
    name: &'static str,
    about: String,
    values: Vec<Listed>,
    coordinates: Vec<(String, &'static str)>,
    readings: Vec<(&'static str, &'static str)>,
    is_analysed: bool,
}

impl Described {
    pub(crate) fn of<E: Exposed>(is_analysed: bool) -> Self {
        let has_default = E::typical().is_some();
        let values = values::<E::Mechanism>().into_iter().map(|value| Listed {
            name: value.name,
            kind: value.kind,
            is_array: value.is_array,
            is_required: value.kind == Kind::Parameter && !has_default,
            about: comment::<E::Mechanism>(value.name)
                .map(first_sentence)
                .unwrap_or_default(),
        });
        Self {
            name: E::Mechanism::REPORT.name,
            about: comment::<E::Mechanism>("").unwrap_or_default().to_owned(),
            values: values.collect(),
            coordinates: E::coordinates(),
            readings: E::READINGS.iter().map(|of| (of.name, of.about)).collect(),
            is_analysed,
        }
    }

    /// The documentation of the class.
    pub(crate) fn documentation(&self) -> String {
        let mut text = if self.about.is_empty() {
            format!("The mechanism {}.", self.name)
        } else {
            self.about.clone()
        };
        let mut list = |title: &str, lines: Vec<String>| {
            if !lines.is_empty() {
                let _ = write!(text, "\n\n{title}\n    {}", lines.join("\n    "));
            }
        };
        for (kind, title) in [
            (Kind::Parameter, "Parameters:"),
            (Kind::Input, "Inputs, zero unless they are given:"),
            (Kind::Start, "States, by where they start:"),
        ] {
            let of_kind = self.values.iter().filter(|value| value.kind == kind);
            let lines = of_kind.map(|value| format!("{}: {}", value.name, value.about));
            list(
                title,
                lines
                    .map(|line| line.trim_end_matches([':', ' ']).to_owned())
                    .collect(),
            );
        }
        let coordinates = self.coordinates.iter();
        let coordinates = coordinates.map(|(name, unit)| format!("{name} ({unit})"));
        list("Coordinates, in their order:", coordinates.collect());
        let readings = self.readings.iter();
        list(
            "Readings:",
            readings
                .map(|(name, about)| format!("{name}: {about}"))
                .collect(),
        );
        text
    }

    /// The class in a `.pyi` file.
    pub(crate) fn stub(&self) -> String {
        let mut text = format!("class {}:\n", self.name);
        let about = self
            .documentation()
            .replace('\\', "\\\\")
            .replace('"', "\\\"");
        let about = about.replace('\n', "\n    ");
        let _ = writeln!(
            text,
            "    \"\"\"{}\"\"\"\n",
            about.replace("\n    \n", "\n\n")
        );
        for value in &self.values {
            let _ = writeln!(text, "    {}: {}", value.name, type_of(value.is_array));
        }
        for list in [
            "coordinates",
            "parameters",
            "inputs",
            "states",
            "readings",
            "bodies",
            "points",
        ] {
            let _ = writeln!(text, "    {list}: ClassVar[tuple[str, ...]]");
        }
        text.push_str("    def __init__(\n        self,\n");
        if !self.values.is_empty() {
            text.push_str("        *,\n");
        }
        // Those without a default come first, whatever the order of the fields.
        let (required, others): (Vec<_>, Vec<_>) =
            self.values.iter().partition(|value| value.is_required);
        for value in required.into_iter().chain(others) {
            let given = if value.is_array { "ArrayLike" } else { "float" };
            let default = if value.is_required { "" } else { " = ..." };
            let _ = writeln!(text, "        {}: {given}{default},", value.name);
        }
        text.push_str("    ) -> None: ...\n");
        text.push_str(SIMULATE);
        if self.is_analysed {
            text.push_str(ANALYSED);
        }
        text
    }
}

const fn type_of(is_array: bool) -> &'static str {
    if is_array {
        "NDArray[np.float64]"
    } else {
        "float"
    }
}

/// The text of a module's file.
pub(crate) fn module(classes: &[String]) -> String {
    format!("{HEAD}\n{}", classes.join("\n"))
}

const HEAD: &str = "\
# Written by stubs() of the module.
from collections.abc import Iterator, Mapping
from os import PathLike
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

def stubs() -> str: ...

class Fault(RuntimeError):
    time: float | None
    joint: str | None
    index: int | None
    run: Run | None

class RunWarning(UserWarning): ...

class Run:
    warnings: list[str]
    @property
    def columns(self) -> list[str]: ...
    @property
    def units(self) -> dict[str, str]: ...
    @property
    def time(self) -> NDArray[np.float64]: ...
    @property
    def evaluations(self) -> int: ...
    @property
    def accepted(self) -> int: ...
    @property
    def rejected(self) -> int: ...
    def __getitem__(self, name: str) -> NDArray[np.float64]: ...
    def __contains__(self, name: str) -> bool: ...
    def __len__(self) -> int: ...
    def to_dict(self) -> dict[str, NDArray[np.float64]]: ...
    def to_pandas(self) -> Any: ...
    def film(self) -> str: ...
    def save_film(self, path: str | PathLike[str]) -> None: ...

class Rollouts:
    time: NDArray[np.float64]
    q: NDArray[np.float64]
    v: NDArray[np.float64]
    readings: NDArray[np.float64]
    energy: NDArray[np.float64]
    violation: NDArray[np.float64]
    stopped: list[tuple[int, float, str | None, str]]
    def __getitem__(self, name: str) -> NDArray[np.float64]: ...
    def to_dict(self) -> dict[str, Any]: ...

class Linearised:
    states: list[str]
    inputs: list[str]
    outputs: list[str]
    @property
    def A(self) -> NDArray[np.float64]: ...
    @property
    def B(self) -> NDArray[np.float64]: ...
    @property
    def C(self) -> NDArray[np.float64]: ...
    @property
    def D(self) -> NDArray[np.float64]: ...
    def __iter__(self) -> Iterator[NDArray[np.float64]]: ...
";

const SIMULATE: &str = "    \
def simulate(
        self,
        t_end: float,
        *,
        every: float = 0.01,
        start: Mapping[str, float] | ArrayLike | None = None,
        rates: Mapping[str, float] | ArrayLike | None = None,
        inputs: Mapping[str, ArrayLike] | None = None,
        period: float | None = None,
        method: str = \"dormand_prince\",
        tolerance: float | None = None,
        step: float | None = None,
        projection: bool = True,
        reactions: bool = False,
        film: bool = True,
        t_start: float = 0.0,
    ) -> Run: ...
";

const ANALYSED: &str = "    \
def forward_dynamics(
        self,
        q: ArrayLike,
        v: ArrayLike | None = None,
        tau: ArrayLike | None = None,
        *,
        inputs: Mapping[str, ArrayLike] | None = None,
        time: float = 0.0,
    ) -> NDArray[np.float64]: ...
    def inverse_dynamics(
        self,
        q: ArrayLike,
        v: ArrayLike | None = None,
        a: ArrayLike | None = None,
        *,
        inputs: Mapping[str, ArrayLike] | None = None,
        time: float = 0.0,
    ) -> NDArray[np.float64]: ...
    def mass_matrix(self, q: ArrayLike, *, time: float = 0.0) -> NDArray[np.float64]: ...
    def jacobian(self, at: str, q: ArrayLike, *, time: float = 0.0) -> NDArray[np.float64]: ...
    def linearised(
        self,
        q: ArrayLike,
        v: ArrayLike | None = None,
        *,
        inputs: Mapping[str, ArrayLike] | None = None,
        time: float = 0.0,
    ) -> Linearised: ...
    def rollouts(
        self,
        t_end: float,
        dt: float,
        *,
        every: int = 1,
        start: ArrayLike | None = None,
        rates: ArrayLike | None = None,
        inputs: Mapping[str, ArrayLike] | None = None,
        parameters: Mapping[str, ArrayLike] | None = None,
        t_start: float = 0.0,
        limits: bool = True,
        threads: int | None = None,
    ) -> Rollouts: ...
";
