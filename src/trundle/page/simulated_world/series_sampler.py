"""Samples of plotted values, a row for each stride."""

from collections.abc import Sequence

import numpy as np

from trundle.base.diagnostics import UsageError
from trundle.page import PageServer
from trundle.sim.sensors import CameraSensor, InstrumentSensor
from trundle.sim.simulation import Simulation
from trundle.spatial import NS_PER_S

from ..world.streams import SeriesHead
from .series import SampledState, SensorValue, Series, SeriesFinder

_ROWS = 64
"""Rows of a message: about a second of strides, so that a slow page misses none."""


class SeriesSampler:
    """Samples the plotted values; belongs to the simulation's thread."""

    def __init__(self, server: PageServer) -> None:
        self._server = server
        self._names: tuple[str, ...] = ()
        self._series: list[Series] = []
        self._faults: dict[str, str] = {}
        self._rows: list[list[float]] = []
        self._count = 0
        """Rows sampled so far."""
        self._time_ns = -1
        self._values: dict[InstrumentSensor, SensorValue] = {}

    def show(self, simulation: Simulation, sensors: Sequence[CameraSensor | InstrumentSensor]) -> None:
        """Sample another simulation, or the same one after its world has changed."""
        self._simulation = simulation
        self._finder = SeriesFinder(simulation, sensors)
        self._find(self._names)

    def sample(self, *, paused: bool) -> None:
        """Sample the plotted values; while paused, only if time has advanced."""
        names = self._server.plotted
        if names != self._names:
            self._find(names)
        time_ns = self._simulation.time_ns
        if not names or time_ns == self._time_ns or (paused and time_ns < self._time_ns):
            return
        if time_ns < self._time_ns:
            self._find(names)  # going back in time restores the sensors' earlier listeners
        self._time_ns = time_ns
        now = SampledState(self._simulation, self._simulation.snapshot())
        row = [time_ns / NS_PER_S, *(series.read(now) for series in self._series)]
        self._rows = [*self._rows[1 - _ROWS :], row]
        self._count += 1

    def put(self) -> None:
        """Send the newest rows to the page."""
        if not self._names:
            return
        names = tuple(name for name in self._names if name not in self._faults)
        head = SeriesHead(names=names, units=tuple(series.unit for series in self._series), faults=self._faults)
        rows = np.array(self._rows).reshape(len(self._rows), 1 + len(names))
        self._server.put_series(self._count - len(rows), head, rows)

    def _find(self, names: tuple[str, ...]) -> None:
        self._names, self._series, self._faults, self._rows = names, [], {}, []
        for value in self._values.values():
            value.is_plotted = False
        for name in names:
            try:
                self._series.append(self._finder.find(name, self._listen))
            except UsageError as error:
                self._faults[name] = str(error)

    def _listen(self, sensor: InstrumentSensor) -> SensorValue:
        value = self._values.setdefault(sensor, SensorValue())
        value.is_plotted = True
        sensor.listen(value.store, enabled=value.enabled)
        return value
