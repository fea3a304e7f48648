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

class Rod:
    """A uniform rod on a hinge about x, which a motor turns; level at the start.

    Parameters:
        length: The length (m).
        mass: The mass (kg).

    Inputs, zero unless they are given:
        torque: The moment of the motor (N m).

    Coordinates, in their order:
        hinge (rad)

    Readings:
        height: height of the tip (m)"""

    length: float
    mass: float
    torque: float
    coordinates: ClassVar[tuple[str, ...]]
    parameters: ClassVar[tuple[str, ...]]
    inputs: ClassVar[tuple[str, ...]]
    states: ClassVar[tuple[str, ...]]
    readings: ClassVar[tuple[str, ...]]
    bodies: ClassVar[tuple[str, ...]]
    points: ClassVar[tuple[str, ...]]
    def __init__(
        self,
        *,
        length: float,
        mass: float,
        torque: float = ...,
    ) -> None: ...
    def simulate(
        self,
        t_end: float,
        *,
        every: float = 0.01,
        start: Mapping[str, float] | ArrayLike | None = None,
        rates: Mapping[str, float] | ArrayLike | None = None,
        inputs: Mapping[str, ArrayLike] | None = None,
        period: float | None = None,
        method: str = "dormand_prince",
        tolerance: float | None = None,
        step: float | None = None,
        projection: bool = True,
        reactions: bool = False,
        film: bool = True,
        t_start: float = 0.0,
    ) -> Run: ...
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

class FourBar:
    """A four-bar in the plane z = 0 with a motor and a damper at its crank, described
    with both upright. The rocker ends at stops.

    Parameters:
        crank_length: The length of the crank (m).
        base: The distance of the feet (m).

    Inputs, zero unless they are given:
        torque: The moment of the motor at the crank (N m).

    Coordinates, in their order:
        crank (rad)

    Readings:
        coupler_height: height of the coupler's centre of mass (m)"""

    crank_length: float
    base: float
    torque: float
    coordinates: ClassVar[tuple[str, ...]]
    parameters: ClassVar[tuple[str, ...]]
    inputs: ClassVar[tuple[str, ...]]
    states: ClassVar[tuple[str, ...]]
    readings: ClassVar[tuple[str, ...]]
    bodies: ClassVar[tuple[str, ...]]
    points: ClassVar[tuple[str, ...]]
    def __init__(
        self,
        *,
        crank_length: float = ...,
        base: float = ...,
        torque: float = ...,
    ) -> None: ...
    def simulate(
        self,
        t_end: float,
        *,
        every: float = 0.01,
        start: Mapping[str, float] | ArrayLike | None = None,
        rates: Mapping[str, float] | ArrayLike | None = None,
        inputs: Mapping[str, ArrayLike] | None = None,
        period: float | None = None,
        method: str = "dormand_prince",
        tolerance: float | None = None,
        step: float | None = None,
        projection: bool = True,
        reactions: bool = False,
        film: bool = True,
        t_start: float = 0.0,
    ) -> Run: ...
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

class Drive:
    """A rotor that a current drives, which a voltage drives.

    Inputs, zero unless they are given:
        voltage: The voltage (V) on 0.5 ohm and 0.1 H.

    States, by where they start:
        current: The current (A).

    Coordinates, in their order:
        shaft (rad)

    Readings:
        flow: current (A)"""

    voltage: float
    current: float
    coordinates: ClassVar[tuple[str, ...]]
    parameters: ClassVar[tuple[str, ...]]
    inputs: ClassVar[tuple[str, ...]]
    states: ClassVar[tuple[str, ...]]
    readings: ClassVar[tuple[str, ...]]
    bodies: ClassVar[tuple[str, ...]]
    points: ClassVar[tuple[str, ...]]
    def __init__(
        self,
        *,
        voltage: float = ...,
        current: float = ...,
    ) -> None: ...
    def simulate(
        self,
        t_end: float,
        *,
        every: float = 0.01,
        start: Mapping[str, float] | ArrayLike | None = None,
        rates: Mapping[str, float] | ArrayLike | None = None,
        inputs: Mapping[str, ArrayLike] | None = None,
        period: float | None = None,
        method: str = "dormand_prince",
        tolerance: float | None = None,
        step: float | None = None,
        projection: bool = True,
        reactions: bool = False,
        film: bool = True,
        t_start: float = 0.0,
    ) -> Run: ...
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

class Ur5:
    """Universal Robots' UR5 with motors on its axes, stretched out along x at the start, at rest,
    gravity along -z.

    
    ```text
        z
        |         upper arm         forearm
        o----------------------------------------o wrist    all angles zero, y towards the reader
        |  lift                elbow             |
        |  pan                                   o-- third wrist
        ground                                          x
    ```

    Masses, inertias about the centres of mass and axes: `ur_description` (`ur5`), as in
    `example-robot-data`, given here along global axes with all angles zero. `pan`, `lift`, `elbow`,
    `wrist_1`, `wrist_2`, `wrist_3` turn about z, y, y, y, -z and y; what the numbers have left of
    the last digits of a URDF file is kept.

    Good for: a robot of six hinges in a row; forward dynamics against
    [Pinocchio](https://github.com/stack-of-tasks/pinocchio), which the tests hold to 1e-12.

    Inputs, zero unless they are given:
        pan_torque: The moment of the motor of `pan` (N m), on the outer link.
        lift_torque: The moment of the motor of `lift` (N m), on the outer link.
        elbow_torque: The moment of the motor of `elbow` (N m), on the outer link.
        wrist_1_torque: The moment of the motor of `wrist_1` (N m), on the outer link.
        wrist_2_torque: The moment of the motor of `wrist_2` (N m), on the outer link.
        wrist_3_torque: The moment of the motor of `wrist_3` (N m), on the outer link.

    Coordinates, in their order:
        pan (rad)
        lift (rad)
        elbow (rad)
        wrist_1 (rad)
        wrist_2 (rad)
        wrist_3 (rad)"""

    pan_torque: float
    lift_torque: float
    elbow_torque: float
    wrist_1_torque: float
    wrist_2_torque: float
    wrist_3_torque: float
    coordinates: ClassVar[tuple[str, ...]]
    parameters: ClassVar[tuple[str, ...]]
    inputs: ClassVar[tuple[str, ...]]
    states: ClassVar[tuple[str, ...]]
    readings: ClassVar[tuple[str, ...]]
    bodies: ClassVar[tuple[str, ...]]
    points: ClassVar[tuple[str, ...]]
    def __init__(
        self,
        *,
        pan_torque: float = ...,
        lift_torque: float = ...,
        elbow_torque: float = ...,
        wrist_1_torque: float = ...,
        wrist_2_torque: float = ...,
        wrist_3_torque: float = ...,
    ) -> None: ...
    def simulate(
        self,
        t_end: float,
        *,
        every: float = 0.01,
        start: Mapping[str, float] | ArrayLike | None = None,
        rates: Mapping[str, float] | ArrayLike | None = None,
        inputs: Mapping[str, ArrayLike] | None = None,
        period: float | None = None,
        method: str = "dormand_prince",
        tolerance: float | None = None,
        step: float | None = None,
        projection: bool = True,
        reactions: bool = False,
        film: bool = True,
        t_start: float = 0.0,
    ) -> Run: ...
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

class HeavyTop:
    """A fast top on a ball joint at the origin, its axis in the horizontal at the start, gravity along
    -z.

    
    ```text
           z
           |
           o--------(top)  y     tip in the origin, axis along y; x towards the reader
           |  g = 9.81 m/s^2
           v
    ```

    Brüls, Cardona and Arnold, *Lie group generalized-alpha time integration of constrained flexible
    multibody systems*, Mechanism and Machine Theory 48 (2012): `m = 15` kg,
    `J = (0.234375, 0.46875, 0.234375)` kg m^2 about the centre of mass, which is 1 m from the fixed
    point; the top spins at 150 rad/s about its axis, which starts at -4.61538 rad/s about z.

    It is drawn as the thin disc of 0.25 m that has these moments, on a rod.

    Good for: large rotations and Euler parameters, 24 turns a second; the order of convergence of
    an integrator. The energy, 5435.696790865547 J, the angular momentum about z, -70.3124296875 kg
    m^2/s, and the spin of 150 rad/s about the axis stay."""

    coordinates: ClassVar[tuple[str, ...]]
    parameters: ClassVar[tuple[str, ...]]
    inputs: ClassVar[tuple[str, ...]]
    states: ClassVar[tuple[str, ...]]
    readings: ClassVar[tuple[str, ...]]
    bodies: ClassVar[tuple[str, ...]]
    points: ClassVar[tuple[str, ...]]
    def __init__(
        self,
    ) -> None: ...
    def simulate(
        self,
        t_end: float,
        *,
        every: float = 0.01,
        start: Mapping[str, float] | ArrayLike | None = None,
        rates: Mapping[str, float] | ArrayLike | None = None,
        inputs: Mapping[str, ArrayLike] | None = None,
        period: float | None = None,
        method: str = "dormand_prince",
        tolerance: float | None = None,
        step: float | None = None,
        projection: bool = True,
        reactions: bool = False,
        film: bool = True,
        t_start: float = 0.0,
    ) -> Run: ...
