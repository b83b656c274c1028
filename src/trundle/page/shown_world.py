"""The world that a page shows and edits: a simulation with its sensors and plugins."""

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
    """Running world; used on the simulation's thread."""

    @property
    def simulation(self) -> "Simulation":
        """Running simulation."""
        ...

    @property
    def timeline(self) -> "Timeline | None":
        """Timeline of the last minutes; None: the simulation cannot go back in time."""
        ...

    @property
    def sensors(self) -> "Sequence[CameraSensor | InstrumentSensor]":
        """Running sensors; cameras and rays are drawn."""
        ...

    @property
    def packages(self) -> Packages:
        """Finds models."""
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
        """Execute a command, and record it for the timeline.

        Raises:
            TrundleError: raised by the command.
        """
        ...

    def spawn(self, model: Model, robot: "Robot | None" = None) -> None:
        """Add a model with its sensors and plugins; `robot` is its URDF.

        Raises:
            TrundleError: the model cannot be added; the world is unchanged.
        """
        ...

    def delete(self, name: str) -> None:
        """Remove a model with its sensors and plugins.

        Raises:
            UsageError: there is no such model.
        """
        ...


class BareWorld:
    """World that starts no sensors or plugins."""

    def __init__(
        self,
        simulation: "Simulation",
        sensors: "Sequence[CameraSensor | InstrumentSensor]" = (),
        timeline: "Timeline | None" = None,
    ) -> None:
        """Wrap a simulation and its running sensors."""
        self.simulation = simulation
        self.sensors = sensors
        self.timeline = timeline
        self.environment: Mapping[str, str] = os.environ
        self.packages = Packages(os.environ, start=Path.cwd())

    def robot(self, model: str) -> None:
        """Return None: models here have no URDF."""
        del model

    def advance(self, until_ns: int) -> None:
        """Simulate up to a time [ns]; see `Simulation.advance`."""
        (self.simulation if self.timeline is None else self.timeline).advance(until_ns)

    def do(self, command: "Callable[[Simulation], object]") -> None:
        """Execute a command, and record it for the timeline."""
        if self.timeline is None:
            command(self.simulation)
        else:
            self.timeline.do(command)

    def spawn(self, model: Model, robot: "Robot | None" = None) -> None:
        """Add a model.

        Raises:
            UsageError: the model has sensors or plugins.
        """
        del robot
        if has_sensors_or_plugins(model):
            raise UsageError(f"model {model.name!r} has sensors or plugins, which would not run here")
        self.do(lambda simulation: simulation.spawn(model))

    def delete(self, name: str) -> None:
        """Remove a model."""
        self.do(lambda simulation: simulation.delete(name))


def has_sensors_or_plugins(model: Model) -> bool:
    """Tell if a model has sensors or plugins, including plugins of visuals."""
    visuals = (visual for link in model.links for visual in link.visuals)
    parts = (*model.links, *model.joints)
    return bool(model.plugins) or any(part.sensors for part in parts) or any(visual.plugins for visual in visuals)
