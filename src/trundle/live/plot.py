"""Curves of a simulation over time: `LoadedSimulation.plot`."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError, no_such
from trundle.base.documented import documented
from trundle.base.drawing import Curve, curves_svg, curves_text
from trundle.page.simulated_world.series import SampledState, SensorValue, Series, SeriesFinder
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import NS_PER_S

if TYPE_CHECKING:
    from trundle.sim.sensors import InstrumentSensor

    from .live_world import LiveWorld

_SUFFIXES = (".svg", ".csv")
_COLUMNS, _ROWS = 100, 20
"""Size of the curves as text [characters]."""


@documented("names units times_s save close")
class Plot:
    """Values of a simulation over time, sampled while it runs; a notebook draws it.

    The names are those of the page's plots: `model::link.pose.z`, `model::joint.velocity`, `model::link::imu.…`.
    """

    __module__ = "trundle"

    def __init__(self, world: "LiveWorld", names: Sequence[str], period_ns: int) -> None:
        """Sample the present state; see `LoadedSimulation.plot`."""
        self._simulation: Simulation = world.simulation
        self._sensors: list[SensorValue] = []
        self._world = world
        self._names = tuple(names)
        if not self._names:
            raise UsageError("plot needs names of values, such as 'model::link.pose.z' or 'model::joint.velocity'")
        self._series = self._find()
        self._rows: list[list[float]] = []
        self.after_step(self._simulation.snapshot())
        self._simulation.on_change(self._find_again)
        self._simulation.add_hook(self, period_ns=period_ns)

    def _find(self) -> list[Series]:
        finder = SeriesFinder(self._simulation, self._world.sensors)
        return [finder.find(name, self._listen) for name in self._names]

    def _find_again(self) -> None:
        try:
            self._series = self._find()
        except UsageError:  # its model was deleted
            self.close()

    def _listen(self, sensor: "InstrumentSensor") -> SensorValue:
        value = SensorValue()
        value.is_plotted = True
        self._sensors.append(value)
        sensor.listen(value.store, enabled=value.enabled)
        return value

    def after_step(self, snapshot: Snapshot) -> None:
        """Sample the values; for the simulation only."""
        now = SampledState(self._simulation, snapshot)
        self._rows.append([snapshot.time_ns / NS_PER_S, *(float(series.read(now)) for series in self._series)])

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the values, in the order of `plot`'s arguments."""
        return self._names

    @property
    def units(self) -> tuple[str, ...]:
        """Unit of each value: m, rad, m/s, N, …"""
        return tuple(series.unit for series in self._series)

    @property
    def times_s(self) -> NDArray[np.float64]:
        """Times (N,) of the samples [s]."""
        return np.array([row[0] for row in self._rows])

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return the samples (N,) of a value, in its unit.

        Raises:
            UsageError: the plot has no such value; the message lists its values.
        """
        if name not in self._names:
            raise UsageError(no_such("the plot has no value", name, self._names))
        column = 1 + self._names.index(name)
        return np.array([row[column] for row in self._rows])

    def save(self, file: str | Path) -> None:
        """Write the curves as .svg, or the samples as .csv, whose first column is the time [s].

        Raises:
            UsageError: it cannot be written, or its name ends in neither.
        """
        path = Path(file).expanduser()
        match path.suffix.lower():
            case ".svg":
                write_atomically(path, self._repr_svg_())
            case ".csv":
                lines = [",".join(["time", *self._names]), *(",".join(map(repr, row)) for row in self._rows)]
                write_atomically(path, "\n".join([*lines, ""]))
            case _:
                raise UsageError(f"a plot's file ends in {' or '.join(_SUFFIXES)}, not in {path.suffix!r}")

    def close(self) -> None:
        """Sample no more."""
        for value in self._sensors:
            value.is_plotted = False
        self._simulation.remove_hook(self)

    def _curves(self) -> list[Curve]:
        labels = [f"{name} [{unit}]" if unit else name for name, unit in zip(self._names, self.units, strict=True)]
        return [Curve(label, [(row[0], row[1 + column]) for row in self._rows]) for column, label in enumerate(labels)]

    def _repr_svg_(self) -> str:
        """Return the curves for notebooks."""
        return curves_svg(self._curves())

    def __str__(self) -> str:
        """Return the curves as text for a terminal."""
        return curves_text(self._curves(), columns=_COLUMNS, rows=_ROWS)

    def __repr__(self) -> str:
        return f"<Plot of {', '.join(map(repr, self._names))}: {len(self._rows)} samples>"
