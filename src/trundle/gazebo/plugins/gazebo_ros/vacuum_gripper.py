"""libgazebo_ros_vacuum_gripper.so: a link that attracts near links while switched on."""

import math

import numpy as np

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, Wrench

from .ros_plugin import RosPlugin, plugin_names

_REACH = 0.05
"""Range between link origins [m]."""
_GRIP = 0.01
"""Distance [m] below which a link is moved to the gripper's origin."""
_STRONGEST = 20.0
"""Largest force [N]."""


class VacuumGripper(RosPlugin):
    """Services `on` and `off` (std_srvs/Empty); <topicName> (std_msgs/Bool) is true while a link is held.

    Parameters, of gazebo_ros: <bodyName> and <topicName> (required), <robotNamespace>. Links of other models whose
    origins are within 5 cm get the gripper's twist and a force of 1 N·m / distance, at most 20 N; within 1 cm they are
    moved to its origin. A link with a parent joint gets only the force. The force points to the gripper; the original's
    is rotated with the object.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        names = plugin_names(sim, model, node, parameters)
        self._node, self._model = node, model
        self._link = model.link(parameters.text("bodyName"))
        topic = parameters.text("topicName")
        self._is_on = self._holds = False
        self._topic = names.advertise("std_msgs/Bool", topic)
        node.advertise_service(names.topic("on"), "std_srvs/Empty", lambda _: self._switch(on=True))
        node.advertise_service(names.topic("off"), "std_srvs/Empty", lambda _: self._switch(on=False))

    def before_step(self, sim: Simulation) -> None:
        """Attract the near links."""
        near = self._find_nearby_links(sim) if self._is_on else []
        for link in near:
            self._apply_suction(link, free=sim.engine.writer.is_free(link.index))
        self._holds = bool(near)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish whether a link is held."""
        del snapshot
        if self._topic.has_subscribers:
            self._topic.publish({"data": self._holds})

    def _find_nearby_links(self, sim: Simulation) -> list[LinkHandle]:
        positions = sim.engine.reader.link_poses()[:, :3]
        distances = np.linalg.norm(positions - positions[self._link.index], axis=1)
        near = set(np.flatnonzero(distances < _REACH).tolist())
        others = (each for each in sim.models if each.name not in (self._model.name, self._link.name))
        return [link for each in others for link in each.links if link.index in near]

    def _apply_suction(self, link: LinkHandle, *, free: bool) -> None:
        here, there = self._link.pose, link.pose
        way = np.subtract(here.position, there.position)
        distance = math.hypot(*way.tolist())
        if free:
            link.set_twist(self._link.twist)
            if distance < _GRIP:
                link.set_pose(Pose(here.position, there.quaternion))
        if distance > 0.0:
            x, y, z = (way * min(1.0 / distance, _STRONGEST) / distance).tolist()
            link.add_wrench(Wrench((x, y, z)))

    def _switch(self, *, on: bool) -> dict[str, object]:
        word = "on" if on else "off"
        if self._is_on is on:
            self._node.log.warn(f"vacuum gripper is {word} already")
        else:
            self._node.log.info(f"vacuum gripper is {word}")
        self._is_on = on
        return {}
