"""The world that a page shows and changes: a simulation, and what comes and goes with its models."""

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from trundle.base.diagnostics import UsageError
from trundle.robots.model import Model
from trundle.robots.packages import Packages

if TYPE_CHECKING:
    from trundle.robots.robot import Robot
    from trundle.sim.sensors import CameraSensor, InstrumentSensor
    from trundle.sim.simulation import Simulation
    from trundle.sim.timeline import Timeline


class ShownWorld(Protocol):
    """World in motion; used on the simulation's thread."""

    @property
    def simulation(self) -> "Simulation":
        """The running simulation."""
        ...

    @property
    def timeline(self) -> "Timeline | None":
        """Last minutes of the simulation; None: it cannot go back."""
        ...

    @property
    def sensors(self) -> "Sequence[CameraSensor | InstrumentSensor]":
        """Sensors that measure; cameras and rays are drawn."""
        ...

    @property
    def packages(self) -> Packages:
        """Finder of models."""
        ...

    @property
    def environment(self) -> Mapping[str, str]:
        """Variables that locate plugins."""
        ...

    def robot(self, model: str) -> "Robot | None":
        """Return the URDF that a model was spawned from."""
        ...

    def advance(self, until_ns: int) -> None:
        """Simulate up to a time [ns]; see `Simulation.advance`."""
        ...

    def do(self, command: "Callable[[Simulation], object]") -> None:
        """Give the simulation a command, which the timeline repeats.

        Raises:
            TrundleError: of the command.
        """
        ...

    def spawn(self, model: Model, robot: "Robot | None" = None) -> None:
        """Add a model with its sensors and plugins; `robot` is the URDF that it came from.

        Raises:
            TrundleError: it cannot be added; nothing has changed.
        """
        ...

    def delete(self, name: str) -> None:
        """Remove a model with its sensors and plugins.

        Raises:
            UsageError: there is no such model.
        """
        ...


class BareWorld:
    """Simulation in which no sensor or plugin can be started."""

    def __init__(
        self,
        simulation: "Simulation",
        sensors: "Sequence[CameraSensor | InstrumentSensor]" = (),
        timeline: "Timeline | None" = None,
    ) -> None:
        """Take a simulation, with sensors that are started already."""
        self.simulation = simulation
        self.sensors = sensors
        self.timeline = timeline
        self.environment: Mapping[str, str] = os.environ
        self.packages = Packages(os.environ, start=Path.cwd())

    def robot(self, model: str) -> None:
        """Return the URDF that a model was spawned from; there is none."""
        del model

    def advance(self, until_ns: int) -> None:
        """Simulate up to a time [ns]; see `Simulation.advance`."""
        (self.simulation if self.timeline is None else self.timeline).advance(until_ns)

    def do(self, command: "Callable[[Simulation], object]") -> None:
        """Give the simulation a command, which the timeline repeats."""
        if self.timeline is None:
            command(self.simulation)
        else:
            self.timeline.do(command)

    def spawn(self, model: Model, robot: "Robot | None" = None) -> None:
        """Add a model.

        Raises:
            UsageError: it has sensors or plugins.
        """
        del robot
        if has_sensors_or_plugins(model):
            raise UsageError(f"model {model.name!r} has sensors or plugins, which would not run here")
        self.do(lambda simulation: simulation.spawn(model))

    def delete(self, name: str) -> None:
        """Remove a model."""
        self.do(lambda simulation: simulation.delete(name))


def has_sensors_or_plugins(model: Model) -> bool:
    """Tell if a model has sensors or plugins, its visuals' included."""
    visuals = (visual for link in model.links for visual in link.visuals)
    parts = (*model.links, *model.joints)
    return bool(model.plugins) or any(part.sensors for part in parts) or any(visual.plugins for visual in visuals)
