"""libgazebo_ros_vacuum_gripper.so: a link that attracts nearby links while switched on."""

import math

import numpy as np

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, Wrench

from .ros_plugin import RosPlugin, plugin_names

_MAX_DISTANCE = 0.05
"""Range between link origins [m]."""
_GRIP_DISTANCE = 0.01
"""Distance [m] below which a link is moved to the gripper's origin."""
_MAX_FORCE = 20.0
"""Largest force [N]."""


class VacuumGripper(RosPlugin):
    """Services `on` and `off` (std_srvs/Empty); <topicName> (std_msgs/Bool) is true while a link is held.

    Parameters, of gazebo_ros: <bodyName> and <topicName> (required), <robotNamespace>. Links of other models with
    origins within 5 cm get the gripper's twist and a force of 1 N·m / distance, at most 20 N; within 1 cm they are
    moved to its origin. A link with a parent joint gets only the force. The force points to the gripper; in the
    original it is rotated with the object.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        names = plugin_names(sim, model, node, parameters)
        self._node, self._model = node, model
        self._link = model.link(parameters.text("bodyName"))
        topic = parameters.text("topicName")
        self._is_on = self._is_holding = False
        self._topic = names.advertise("std_msgs/Bool", topic)
        node.advertise_service(names.topic("on"), "std_srvs/Empty", lambda _: self._switch(on=True))
        node.advertise_service(names.topic("off"), "std_srvs/Empty", lambda _: self._switch(on=False))

    def before_step(self, sim: Simulation) -> None:
        """Attract nearby links."""
        nearby = self._find_nearby_links(sim) if self._is_on else []
        for link in nearby:
            self._apply_suction(link, free=sim.engine.writer.is_free(link.index))
        self._is_holding = bool(nearby)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish whether a link is held."""
        del snapshot
        if self._topic.has_subscribers:
            self._topic.publish({"data": self._is_holding})

    def _find_nearby_links(self, sim: Simulation) -> list[LinkHandle]:
        positions = sim.engine.reader.link_poses()[:, :3]
        distances = np.linalg.norm(positions - positions[self._link.index], axis=1)
        nearby = set(np.flatnonzero(distances < _MAX_DISTANCE).tolist())
        models = (model for model in sim.models if model.name not in (self._model.name, self._link.name))
        return [link for model in models for link in model.links if link.index in nearby]

    def _apply_suction(self, link: LinkHandle, *, free: bool) -> None:
        gripper_pose, link_pose = self._link.pose, link.pose
        offset = np.subtract(gripper_pose.position, link_pose.position)
        distance = math.hypot(*offset.tolist())
        if free:
            link.set_twist(self._link.twist)
            if distance < _GRIP_DISTANCE:
                link.set_pose(Pose(gripper_pose.position, link_pose.quaternion))
        if distance > 0.0:
            x, y, z = (offset * min(1.0 / distance, _MAX_FORCE) / distance).tolist()
            link.add_wrench(Wrench((x, y, z)))

    def _switch(self, *, on: bool) -> dict[str, object]:
        state = "on" if on else "off"
        if self._is_on is on:
            self._node.log.warn(f"vacuum gripper is {state} already")
        else:
            self._node.log.info(f"vacuum gripper is {state}")
        self._is_on = on
        return {}
