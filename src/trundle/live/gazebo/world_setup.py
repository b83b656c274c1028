"""Changes to the world of a launch by the program that runs it."""

from typing import Protocol

from trundle.robots.model import Model, World
from trundle.ros import Node
from trundle.sim.simulation import Simulation


class WorldSetup(Protocol):
    """Changes to a world and to the models spawned into it; called on the simulation's thread."""

    @property
    def seed(self) -> int:
        """Seed of all random numbers of the simulation."""
        ...

    def settle(self) -> bool:
        """Handle a time at which all nodes have settled; return True to end the run."""
        ...

    def world(self, world: World) -> World:
        """Return the world to simulate."""
        ...

    def model(self, model: Model) -> Model:
        """Return the model to spawn."""
        ...

    def start(self, simulation: Simulation, node: Node) -> None:
        """Called at time zero, with gzserver's node."""
        ...
