"""Base of all sensors: mounting link, update rate and listeners."""

from collections.abc import Callable
from fractions import Fraction
from functools import cached_property
from typing import ClassVar, Generic, TypeVar

import numpy as np
from msgspec import Struct

from trundle.base.diagnostics import UsageError
from trundle.robots.model import Link, Model, Sensor
from trundle.sim.simulation import LinkHandle, Simulation, Snapshot, StridePart
from trundle.spatial import NS_PER_S, Pose, Vector3, cross, pose_from_row

Reading = TypeVar("Reading")


class _Listener(Struct, Generic[Reading]):
    call: Callable[[Reading], None]
    enabled: Callable[[], bool]


def _period_ns(rate_hz: float) -> Fraction:
    """Return the exact period, so that no error accumulates; 0.1 Hz counts as 1/10 Hz."""
    return NS_PER_S / (Fraction(rate_hz).limit_denominator(1_000_000) or Fraction(rate_hz))


class SensorMount(Struct, frozen=True, eq=False, dict=True):
    """Mounting of a sensor on a link."""

    model: Model
    link: Link
    """Link that carries the sensor."""
    sensor: Sensor
    link_index: int
    """Index of the link in `Snapshot.poses`."""
    seed: tuple[int, ...]
    """Seed of the noise."""

    @cached_property
    def random(self) -> "np.random.Generator":
        """Random generator of the sensor; NumPy's is imported on first use."""
        return np.random.default_rng(self.seed)

    def initial_pose(self) -> Pose:
        """Return the sensor's pose in the world when its model was spawned."""
        return self.model.world_from_model @ self.link.model_from_link @ self.sensor.link_from_sensor


class LiveSensor(Generic[Reading]):
    """Hook that measures when it is due and a listener is active; otherwise it costs nothing.

    An always-on sensor keeps its schedule without listeners: it counts readings that it does not measure.
    """

    has_history: ClassVar[bool] = False
    """True if a reading depends on earlier states, so that the sensor measures continuously."""

    def __init__(self, mount: SensorMount, *, default_rate_hz: float | None = None) -> None:
        """Mount a sensor.

        Args:
            mount: model, link and sensor.
            default_rate_hz: rate if update_rate is 0; None: every step.
        """
        self.model = mount.model
        self.link = mount.link
        self.sensor = mount.sensor
        self._index = mount.link_index
        self._handle: LinkHandle | None = None
        self.parent_name = mount.link.name
        """Name in the sensor's topics: its link, or the measured joint."""
        self.topics: dict[str, str] = {}
        """Topics of the sensor's readings, the main one first, each with its message type."""
        rate = mount.sensor.update_rate_hz or default_rate_hz
        self.period_ns = 0 if rate is None else _period_ns(rate)
        self._simulation: Simulation | None = None
        self.reading_count = 0
        """Readings that were due, measured or not."""
        self._listeners: list[_Listener[Reading]] = []

    @property
    def rate_hz(self) -> float:
        """Update rate; 0: every step."""
        return float(NS_PER_S / self.period_ns) if self.period_ns else 0.0

    def start(self, simulation: Simulation) -> None:
        """Register the sensor's hook at its rate."""
        self._simulation = simulation
        simulation.add_hook(self, period_ns=self.period_ns, enabled=self.enabled, name=self.scoped_name)

    def stop(self, simulation: Simulation) -> None:
        """Remove the sensor's hook."""
        simulation.remove_hook(self)

    def set_rate(self, rate_hz: float) -> None:
        """Set the update rate [Hz]."""
        self.period_ns = _period_ns(rate_hz)
        if self._simulation is not None:
            self._simulation.retime_hook(self, self.period_ns)

    @property
    def name(self) -> str:
        """Name as in the file."""
        return self.sensor.name

    @property
    def scoped_name(self) -> str:
        """Name as `model::link::sensor`."""
        return f"{self.model.name}::{self.parent_name}::{self.name}"

    def attach_to(self, handle: LinkHandle) -> None:
        """Follow a link whose index changes as models are spawned and deleted; a deleted link ends measuring."""
        self._handle = handle

    @property
    def link_index(self) -> int:
        """Index of the carrying link in `Snapshot.poses`."""
        return self._index if self._handle is None else self._handle.index

    @property
    def _link_exists(self) -> bool:
        try:
            return self.link_index >= 0
        except UsageError:
            return False

    def listen(self, call: Callable[[Reading], None], *, enabled: Callable[[], bool] = lambda: True) -> None:
        """Call a function with each reading while `enabled` returns True; nothing is measured without listeners.

        A function that is already a listener is not added again.
        """
        if all(listener.call != call for listener in self._listeners):
            self._listeners.append(_Listener(call, enabled))

    @property
    def has_listeners(self) -> bool:
        """True if a listener is active."""
        return any(listener.enabled() for listener in self._listeners)

    def enabled(self) -> bool:
        """True if the sensor is always on or a listener is active."""
        return (self.sensor.always_on or self.has_listeners) and self._link_exists

    def after_step(self, snapshot: Snapshot) -> None:
        """Measure and pass the reading to the listeners."""
        self.reading_count += 1
        if not (self.has_history or self.has_listeners):
            self.skip()
            return
        reading = self.measure(snapshot)
        profiler = None if self._simulation is None else self._simulation.profiler
        if profiler is not None:
            profiler.lap(self)
        for listener in self._listeners:
            if listener.enabled():
                listener.call(reading)
        if profiler is not None:
            profiler.lap(StridePart.LISTENERS)

    def skip(self) -> None:
        """Skip a due reading without listeners."""

    def measure(self, snapshot: Snapshot) -> Reading:
        """Return a reading of the snapshot."""
        raise NotImplementedError

    def world_from_link(self, snapshot: Snapshot) -> Pose:
        """Return the pose of the carrying link."""
        return pose_from_row(snapshot.poses[self.link_index])

    def world_from_sensor(self, snapshot: Snapshot) -> Pose:
        """Return the pose of the sensor."""
        return self.world_from_link(snapshot) @ self.sensor.link_from_sensor

    def velocity(self, snapshot: Snapshot) -> Vector3:
        """Return the linear velocity of the sensor's point of the link, world axes [m/s]."""
        vx, vy, vz, wx, wy, wz = snapshot.twists[self.link_index].tolist()
        arm = self.world_from_link(snapshot).transform_vector(self.sensor.link_from_sensor.position)
        sx, sy, sz = cross((wx, wy, wz), arm)
        return (vx + sx, vy + sy, vz + sz)
