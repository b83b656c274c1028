"""What all sensors share: a place on a link, a rate, and those who want its readings."""

from collections.abc import Callable
from fractions import Fraction
from functools import cached_property
from typing import Generic, TypeVar

import numpy as np
from msgspec import Struct

from trundle.diagnostics import UsageError
from trundle.model import Link, Model, Sensor
from trundle.simulation import LinkHandle, Simulation, Snapshot
from trundle.spatial import NS_PER_S, Pose, Vector3, cross, pose_from_row

Reading = TypeVar("Reading")


class _Listener(Struct, Generic[Reading]):
    call: Callable[[Reading], None]
    enabled: Callable[[], bool]


def _period_ns(rate_hz: float) -> Fraction:
    """Exact, so that a sensor keeps step with its rate for days; 0.1 Hz is taken for a tenth, as it is meant."""
    return NS_PER_S / (Fraction(rate_hz).limit_denominator(1_000_000) or Fraction(rate_hz))


class SensorMount(Struct, frozen=True, eq=False, dict=True):
    """Where a sensor is mounted."""

    model: Model
    link: Link
    """That carries it."""
    sensor: Sensor
    link_index: int
    """Of the link in `Snapshot.poses`."""
    seed: tuple[int, ...]
    """Of its noise."""

    @cached_property
    def random(self) -> "np.random.Generator":
        """Random numbers of its own; NumPy's are loaded for the first sensor that wants some."""
        return np.random.default_rng(self.seed)

    def initial_pose(self) -> Pose:
        """Where the sensor was when its model came."""
        return self.model.world_from_model @ self.link.model_from_link @ self.sensor.link_from_sensor


class LiveSensor(Generic[Reading]):
    """A hook that measures when it is due and somebody wants it; one that nobody wants costs nothing."""

    def __init__(self, mount: SensorMount, *, default_rate_hz: float | None = None) -> None:
        """Mount a sensor.

        Args:
            mount: where it is.
            default_rate_hz: where update_rate is 0; None: at every step.
        """
        self.model = mount.model
        self.link = mount.link
        self.sensor = mount.sensor
        self._index = mount.link_index
        self._handle: LinkHandle | None = None
        self.parent_name = mount.link.name
        """What its topics are called after: its link, or the joint it sits on."""
        rate = mount.sensor.update_rate_hz or default_rate_hz
        self.period_ns = 0 if rate is None else _period_ns(rate)
        self._simulation: Simulation | None = None
        self.reading_count = 0
        """Taken so far."""
        self._listeners: list[_Listener[Reading]] = []

    @property
    def rate_hz(self) -> float:
        """How often it measures; 0: at every step."""
        return float(NS_PER_S / self.period_ns) if self.period_ns else 0.0

    def start(self, simulation: Simulation) -> None:
        """Be called by a simulation, at its rate."""
        self._simulation = simulation
        simulation.add_hook(self, period_ns=self.period_ns, enabled=self.enabled)

    def stop(self, simulation: Simulation) -> None:
        """Be called no more."""
        simulation.remove_hook(self)

    def set_rate(self, rate_hz: float) -> None:
        """Measure so often from now on."""
        self.period_ns = _period_ns(rate_hz)
        if self._simulation is not None:
            self._simulation.retime_hook(self, self.period_ns)

    @property
    def name(self) -> str:
        """As in the file."""
        return self.sensor.name

    def attach_to(self, handle: LinkHandle) -> None:
        """Ride on a link wherever it is among the others, as models come and go; without it nothing is measured."""
        self._handle = handle

    @property
    def link_index(self) -> int:
        """Of the link that carries it, in `Snapshot.poses`."""
        return self._index if self._handle is None else self._handle.index

    @property
    def _link_exists(self) -> bool:
        try:
            return self.link_index >= 0
        except UsageError:
            return False

    def listen(self, call: Callable[[Reading], None], *, enabled: Callable[[], bool] = lambda: True) -> None:
        """Have a function called with each reading; while nobody wants one, none is taken."""
        self._listeners.append(_Listener(call, enabled))

    def enabled(self) -> bool:
        """Whether the sensor is always on, or anybody wants its readings."""
        asked = self.sensor.always_on or any(listener.enabled() for listener in self._listeners)
        return asked and self._link_exists

    def after_step(self, snapshot: Snapshot) -> None:
        """Measure, and tell those who want to know."""
        reading = self.measure(snapshot)
        self.reading_count += 1
        for listener in self._listeners:
            if listener.enabled():
                listener.call(reading)

    def measure(self, snapshot: Snapshot) -> Reading:
        """Measure at this instant."""
        raise NotImplementedError

    def world_from_link(self, snapshot: Snapshot) -> Pose:
        """Where the link that carries it is."""
        return pose_from_row(snapshot.poses[self.link_index])

    def world_from_sensor(self, snapshot: Snapshot) -> Pose:
        """Where the sensor itself is."""
        return self.world_from_link(snapshot) @ self.sensor.link_from_sensor

    def velocity(self, snapshot: Snapshot) -> Vector3:
        """Of the sensor's own point of the link, world axes [m/s]."""
        vx, vy, vz, wx, wy, wz = snapshot.twists[self.link_index].tolist()
        arm = self.world_from_link(snapshot).transform_vector(self.sensor.link_from_sensor.position)
        sx, sy, sz = cross((wx, wy, wz), arm)
        return (vx + sx, vy + sy, vz + sz)
