"""librotors_gazebo_multirotor_base_plugin.so: speeds of a body's rotors."""

import re

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import JointHandle, ModelHandle, Simulation, Snapshot

from ..gazebo_ros.ros_plugin import RosPlugin
from .namespaces import join_topic, read_topic_name

_ROTOR = re.compile(r"rotor_(\d+)")


class MultirotorBase(RosPlugin):
    """Publishes mav_msgs/Actuators on <motorPubTopic> motor_speed, and joint_states of the rotors.

    Parameters, with RotorS' defaults: <robotNamespace>, <linkName> base_link, <rotorVelocitySlowdownSim> 10. Rotors
    are its child links with `rotor_<number>` in their names and a joint `<link>_joint`.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        base = model.link(parameters.text("linkName", "base_link"))
        self._frame = base.name
        self._slowdown = parameters.number("rotorVelocitySlowdownSim", 10.0)
        self._rotors = _rotors_of(model, base.name)
        self._speeds = node.advertise(
            read_topic_name(parameters, "motorPubTopic", "motor_speed"), "mav_msgs/Actuators", queue_size=1
        )
        self._states = node.advertise(join_topic(parameters, "joint_states"), "sensor_msgs/JointState", queue_size=1)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish rotor speeds and joint states."""
        header = {"stamp": snapshot.time_ns, "frame_id": self._frame}
        if self._speeds.has_subscribers:
            speeds = [joint.velocity * self._slowdown for joint in self._rotors]
            self._speeds.publish({"header": header, "angular_velocities": speeds})
        if self._states.has_subscribers:
            names, positions = [joint.name for joint in self._rotors], [joint.position for joint in self._rotors]
            self._states.publish({"header": header, "name": names, "position": positions})


def _rotors_of(model: ModelHandle, base: str) -> list[JointHandle]:
    """Return the joints of a body's rotors, by number."""
    rotors: dict[int, JointHandle] = {}
    for joint in model.joints:
        number = _ROTOR.search(joint.joint.child)
        if joint.joint.parent == base and number is not None and joint.name == f"{joint.joint.child}_joint":
            rotors[int(number[1])] = joint
    return [rotors[number] for number in sorted(rotors)]
