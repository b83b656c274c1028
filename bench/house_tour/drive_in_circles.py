"""Drives in circles with the laser on: the simulation's share of a tour."""

from typing import Self

from trundle.gazebo.plugins import Plugin
from trundle.robots.model import PluginTag
from trundle.ros import Node, Publisher
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot


class DriveInCircles(Plugin):
    """Commands a velocity ten times a second, and subscribes to the scans."""

    period_ns = 100_000_000

    def __init__(self, commands: Publisher) -> None:
        self._commands = commands

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Advertise and subscribe."""
        del sim, model, tag
        assert node is not None, "the launch has a graph"
        node.subscribe("/scan", "sensor_msgs/LaserScan", lambda _: None, queue_size=1)
        return cls(node.advertise("/cmd_vel", "geometry_msgs/Twist", queue_size=1))

    def after_step(self, snapshot: Snapshot) -> None:
        """Command the velocity."""
        del snapshot
        self._commands.publish({"linear": {"x": 0.2}, "angular": {"z": 0.4}})
