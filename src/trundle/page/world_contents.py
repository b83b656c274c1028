"""Models of a running world with their sensors and plugins, as they are added and removed while it runs."""

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TypeAlias

from trundle.base.diagnostics import UsageError
from trundle.robots.model import Model
from trundle.robots.packages import Packages

if TYPE_CHECKING:
    from trundle.robots.robot import Robot
    from trundle.sim.simulation import Simulation

Do: TypeAlias = "Callable[[Callable[[Simulation], None]], None]"
"""Gives the simulation a command that a timeline can repeat."""


class WorldContents(Protocol):
    """Models of a world with their sensors and plugins; used on the simulation's thread."""

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

    def spawn(self, model: Model, robot: "Robot | None") -> None:
        """Add a model with its sensors and plugins; `robot` is the URDF that it came from."""
        ...

    def delete(self, name: str) -> None:
        """Remove a model with its sensors and plugins."""
        ...


class BareContents:
    """Models of a simulation in which no sensor or plugin can be started; used on its thread."""

    def __init__(self, do: Do) -> None:
        """Prepare; `do` gives the simulation its commands."""
        self._do = do
        self.environment: Mapping[str, str] = os.environ
        self.packages = Packages(os.environ, start=Path.cwd())

    def robot(self, model: str) -> None:
        """Return the URDF that a model was spawned from; there is none."""
        del model

    def spawn(self, model: Model, robot: "Robot | None") -> None:
        """Add a model.

        Raises:
            UsageError: it has sensors or plugins.
        """
        del robot
        if has_sensors_or_plugins(model):
            raise UsageError(f"model {model.name!r} has sensors or plugins, which would not run here")
        self._do(lambda simulation: simulation.spawn(model) and None)

    def delete(self, name: str) -> None:
        """Remove a model."""
        self._do(lambda simulation: simulation.delete(name))


def has_sensors_or_plugins(model: Model) -> bool:
    """Tell if a model has sensors or plugins, its visuals' included."""
    visuals = (visual for link in model.links for visual in link.visuals)
    parts = (*model.links, *model.joints)
    return bool(model.plugins) or any(part.sensors for part in parts) or any(visual.plugins for visual in visuals)
