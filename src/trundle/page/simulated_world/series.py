"""Values of a simulation by the names in plots: `rp2w::chassis.pose.x`, `rp2w::wheel.velocity`.

A link, or a model by its first link, has `pose`, `twist` and `contact`; a joint has `position`, `velocity` and
`effort`; a sensor has the values in its readings.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.sim.sensors import CameraSensor, InstrumentSensor
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import rpy_from_quaternion

from .sensor_series import SENSOR_VALUES, ReadingValue

_AXES = "xyz"


class SampledState:
    """State of a simulation at one time; contacts are computed on first use."""

    def __init__(self, simulation: Simulation, snapshot: Snapshot) -> None:
        self._simulation = simulation
        self.snapshot = snapshot

    @cached_property
    def contact_forces(self) -> dict[str, NDArray[np.float64]]:
        """(4,) for each link in contact: sum of the forces on it [N, world axes], and the number of its contacts."""
        contacts = self._simulation.contacts()
        sums: dict[str, NDArray[np.float64]] = {}
        for bodies, force in zip(contacts.bodies, contacts.forces, strict=True):
            for link, sign in zip(bodies, (-1.0, 1.0), strict=True):
                sums.setdefault(link, np.zeros(4))[:] += (*(sign * force), 1.0)
        return sums


_Read: TypeAlias = Callable[[SampledState], float]


class Series(Struct, frozen=True, eq=False):
    """Value over time."""

    unit: str
    read: _Read


class SeriesFinder:
    """Finds the values of one simulation; created again when its world changes."""

    def __init__(self, simulation: Simulation, sensors: Sequence[CameraSensor | InstrumentSensor]) -> None:
        compiled = simulation.engine.compiled
        self._links = {name: index for index, name in enumerate(compiled.link_names)}
        self._joints = {name: index for index, name in enumerate(compiled.joint_names)}
        self._types = {
            f"{model.name}::{joint.name}": joint.type.value
            for model in simulation.world.models
            for joint in model.joints
        }
        self._models = {
            model.name: f"{model.name}::{model.links[0].name}" for model in simulation.world.models if model.links
        }
        self._sensors = {f"{sensor.model.name}::{sensor.parent_name}::{sensor.name}": sensor for sensor in sensors}

    def find(self, name: str, listen: "Callable[[InstrumentSensor], SensorValue]") -> Series:
        """Return a value by its name; `listen` keeps a sensor measuring while its value is plotted.

        Raises:
            UsageError: there is no such value.
        """
        present: list[str] = []
        for owner, field in splits(name):
            values = self._values(owner, listen)
            if field in values:
                return values[field]
            present += values
        if present:
            raise UsageError(f"no value {name}; there are: {', '.join(present)}")
        raise UsageError(f"no model, link, joint or sensor for {name}")

    def _values(self, owner: str, listen: "Callable[[InstrumentSensor], SensorValue]") -> dict[str, Series]:
        values: dict[str, Series] = {}
        link = self._models.get(owner, owner)
        if link in self._links:
            values |= _link_values(link, self._links[link])
        if owner in self._joints:
            values |= _joint_values(self._joints[owner], self._types.get(owner, ""))
        sensor = self._sensors.get(owner)
        if sensor is not None and not isinstance(sensor, CameraSensor):
            for field, value in SENSOR_VALUES.get(sensor.sensor.type, {}).items():
                values[field] = _SensorSeries(value, sensor, listen).series
        return values


class SensorValue:
    """Latest reading of a sensor that is plotted."""

    def __init__(self) -> None:
        self.reading: object = None
        self.is_plotted = False

    def store(self, reading: object) -> None:
        """Store a reading."""
        self.reading = reading

    def enabled(self) -> bool:
        """True while it is plotted."""
        return self.is_plotted


class _SensorSeries:
    def __init__(
        self, value: ReadingValue, sensor: InstrumentSensor, listen: Callable[[InstrumentSensor], SensorValue]
    ) -> None:
        unit, self._get = value
        self._sensor, self._listen = sensor, listen
        self._latest: SensorValue | None = None
        self.series = Series(unit, self._read)

    def _read(self, _: SampledState) -> float:
        if self._latest is None:
            self._latest = self._listen(self._sensor)
        reading = self._latest.reading
        return float("nan") if reading is None else float(self._get(reading))


def splits(name: str) -> Iterator[tuple[str, str]]:
    """Yield the parts of a name before and after each dot; names of models and links may contain dots."""
    for at, letter in enumerate(name):
        if letter == ".":
            yield name[:at], name[at + 1 :]


def _link_values(link: str, index: int) -> dict[str, Series]:
    values: dict[str, Series] = {}
    for axis, letter in enumerate(_AXES):
        values[f"pose.{letter}"] = Series("m", lambda now, a=axis: now.snapshot.poses[index, a])
    for axis, angle in enumerate(("roll", "pitch", "yaw")):
        values[f"pose.{angle}"] = Series("rad", lambda now, a=axis: _rpy(now.snapshot, index)[a])
    for axis, letter in enumerate(_AXES):
        values[f"twist.linear.{letter}"] = Series("m/s", lambda now, a=axis: now.snapshot.twists[index, a])
    for axis, letter in enumerate(_AXES):
        values[f"twist.angular.{letter}"] = Series("rad/s", lambda now, a=axis: now.snapshot.twists[index, 3 + a])
    for axis, letter in enumerate(_AXES):
        values[f"contact.force.{letter}"] = Series("N", lambda now, a=axis: _contact(now, link, a))
    values["contact.count"] = Series("", lambda now: _contact(now, link, 3))
    return values


def _rpy(snapshot: Snapshot, link: int) -> tuple[float, float, float]:
    qw, qx, qy, qz = snapshot.poses[link, 3:].tolist()
    return rpy_from_quaternion((qw, qx, qy, qz))


def _contact(now: SampledState, link: str, column: int) -> float:
    sums = now.contact_forces.get(link)
    return 0.0 if sums is None else float(sums[column])


def joint_units(kind: str) -> tuple[str, str]:
    """Return the units of position and effort of a type of joint."""
    return ("m", "N") if kind == "prismatic" else ("rad", "N·m")


def _joint_values(index: int, kind: str) -> dict[str, Series]:
    length, effort = joint_units(kind)
    return {
        "position": Series(length, lambda now: now.snapshot.joint_positions[index]),
        "velocity": Series(f"{length}/s", lambda now: now.snapshot.joint_velocities[index]),
        "effort": Series(effort, lambda now: now.snapshot.joint_efforts[index]),
    }
