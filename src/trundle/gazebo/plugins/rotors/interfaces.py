"""librotors_gazebo_ros_interface_plugin.so, librotors_gazebo_controller_interface.so: RotorS' topics on ROS."""

from typing import Self

from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Message, Node
from trundle.sim.simulation import ModelHandle, Simulation

from ..gazebo_ros.ros_plugin import RosPlugin
from ..plugin import WorldPlugin
from .namespaces import read_topic_name

_ACTUATORS = "mav_msgs/Actuators"


class GazeboRosInterface(WorldPlugin):
    """Does nothing: the other plugins have ROS topics themselves."""

    period_ns = 1 << 62

    @classmethod
    def load(cls, sim: Simulation, node: Node | None, tag: PluginTag) -> Self:
        """See `WorldPlugin.load`."""
        del node
        parameters = TagParameters(tag.node, sim.report)
        parameters.ignore("robotNamespace")
        parameters.report_unread()
        return cls()


class ControllerInterface(RosPlugin):
    """Forwards controllers' motor speeds to the motors' topic.

    Parameters, with RotorS' defaults: <robotNamespace>, <commandMotorSpeedSubTopic> command/motor_speed,
    <motorSpeedCommandPubTopic> gazebo/command/motor_speed.
    """

    period_ns = 1 << 62

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        command_topic = read_topic_name(parameters, "commandMotorSpeedSubTopic", "command/motor_speed")
        motor_topic = read_topic_name(parameters, "motorSpeedCommandPubTopic", "gazebo/command/motor_speed")
        self._sim, self._motors = sim, node.advertise(motor_topic, _ACTUATORS, queue_size=1)
        node.subscribe(command_topic, _ACTUATORS, self._forward, queue_size=1)
        for name in ("commandAttitudeThrustSubTopic", "commandRateThrustSubTopic", "imuSubTopic"):
            parameters.ignore(name)  # it has no effect in the original, too

    def _forward(self, message: Message) -> None:
        header = {"stamp": self._sim.time_ns}
        self._motors.publish({"header": header, "angular_velocities": list(message.angular_velocities)})
