"""Sends one goal within the simulation's process, so that runs repeat."""

from typing import Self

from trundle.gazebo.plugins import Plugin
from trundle.robots.model import PluginTag
from trundle.ros import Node, Publisher
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot


class SendGoal(Plugin):
    """Publishes on move_base_simple/goal after a second."""

    period_ns = 1_000_000_000

    def __init__(self, goals: Publisher) -> None:
        self._goals = goals

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Advertise the goal's topic."""
        del sim, model, tag
        assert node is not None, "the launch has a graph"
        return cls(node.advertise("/move_base_simple/goal", "geometry_msgs/PoseStamped", queue_size=1))

    def after_step(self, snapshot: Snapshot) -> None:
        """Send it in the third second."""
        if snapshot.time_ns // self.period_ns == 2:
            pose = {"position": {"x": 2.4, "y": 0.8}, "orientation": {"w": 1.0}}
            self._goals.publish({"header": {"frame_id": "map"}, "pose": pose})
