"""libgazebo_ros_vacuum_gripper.so: a link that sucks on to itself what comes near, while it is on."""

import math

import numpy as np

from trundle.model import PluginTag
from trundle.ros import Node
from trundle.simulation import LinkHandle, ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, Wrench

from .namespaces import join_topic
from .ros_plugin import RosPlugin, required

_REACH = 0.05
"""[m] From origin to origin."""
_GRIP = 0.01
"""[m] What is nearer is put where the gripper is."""
_STRONGEST = 20.0
"""[N]"""


class VacuumGripper(RosPlugin):
    """`on` and `off` (std_srvs/Empty); <topicName> tells at every step whether something is held (std_msgs/Bool).

    Parameters, of gazebo_ros: <bodyName> and <topicName> (required), <robotNamespace>. Links of other models whose
    origins are within 5 cm move as the gripper does and are pulled with 1 N·m over the distance, at most 20 N; within
    1 cm they are put at the gripper. A link that hangs from others is only pulled. The pull is along the way to the
    gripper; the original's is turned with the object.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, tag: PluginTag) -> None:
        super().__init__(sim, model, node, tag)
        parameters = tag.node
        namespace = parameters.string("robotNamespace").strip("/")
        self._node, self._model = node, model
        self._link = model.link(required(parameters, "bodyName"))
        topic = required(parameters, "topicName")
        self._is_on = self._holds = False
        self._was_holding = node.advertise(join_topic(namespace, topic), "std_msgs/Bool", queue_size=1)
        node.advertise_service(join_topic(namespace, "on"), "std_srvs/Empty", lambda _: self._switch(on=True))
        node.advertise_service(join_topic(namespace, "off"), "std_srvs/Empty", lambda _: self._switch(on=False))

    def before_step(self, sim: Simulation) -> None:
        """Suck."""
        near = self._find_nearby_links(sim) if self._is_on else []
        for link in near:
            self._apply_suction(link, free=sim.engine.writer.is_free(link.index))
        self._holds = bool(near)

    def after_step(self, snapshot: Snapshot) -> None:
        """Tell."""
        del snapshot
        if self._was_holding.has_subscribers:
            self._was_holding.publish({"data": self._holds})

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
