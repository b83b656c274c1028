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
        """Do what is due when the nodes have settled at a time; return True if the run is to end there."""
        ...

    def world(self, world: World) -> World:
        """Return the world to simulate."""
        ...

    def model(self, model: Model) -> Model:
        """Return the model to spawn."""
        ...

    def start(self, simulation: Simulation, node: Node) -> None:
        """Begin, at time zero; the node is gzserver's."""
        ...
