"""arbotix_python/arbotix_driver in its simulation mode: kinematic, without serial port or physics."""

from typing import TYPE_CHECKING

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import MessageError, Node

from ..host import NodeHost
from ..private_parameters import private_parameters
from ..rate import Rate, RateDivider
from .controller import ArbotixController, ArbotixJoint, JointReading
from .diff_controller import DiffController
from .follow_controller import FollowController
from .linear_controller import LinearController, LinearJoint
from .servo_controller import DynamixelServo, HobbyServo, ServoController

if TYPE_CHECKING:
    from trundle.ros.message_types import arbotix_msgs


class ArbotixDriver:
    """Runs the controllers and joints in the node's parameters in one loop, like the original."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._joints: dict[str, ArbotixJoint] = {}
        self._controllers: list[ArbotixController] = []

    async def run(self) -> int:
        """Read the parameters, then loop at `~rate`."""
        node = self._node
        try:
            settings = await private_parameters(node)
            if not settings.flag("sim", default=False):
                port = settings.text("port", "/dev/ttyUSB0")
                node.log.error(f"no ArbotiX board can be driven through {port}: set {node.name}/sim to true")
                return 1
            return await self._loop(settings)
        except ParamError as error:
            node.log.error(str(error))
            return 1

    async def _loop(self, settings: RosParameters) -> int:
        node = self._node
        rate_hz = settings.number("rate", 100.0, above=0.0)
        diagnostics = RateDivider(node.clock.now_ns, settings.number("diagnostic_rate", 1.0, above=0.0))
        self._diagnostics = node.advertise("diagnostics", "diagnostic_msgs/DiagnosticArray", queue_size=5)
        joint_states = RateDivider(node.clock.now_ns, settings.number("read_rate", 10.0, above=0.0))
        self._joint_states = node.advertise("joint_states", "sensor_msgs/JointState", queue_size=5)
        node.log.info("ArbotiX being simulated.")
        self._add_joints(settings.section("joints"))
        self._controllers.append(ServoController(node, self._joints, settings))
        self._add_controllers(settings.section("controllers"))
        for name in ("SetupAnalogIn", "SetupDigitalIn", "SetupDigitalOut"):
            node.advertise_service(f"~{name}", "arbotix_msgs/SetupChannel", _no_channel)
        rate = Rate(node, rate_hz)
        while True:
            for controller in self._controllers:
                controller.update()
            if joint_states.due():
                self._publish_joint_states()
            if diagnostics.due():
                self._publish_diagnostics()
            await rate.sleep()

    def _add_joints(self, settings: RosParameters) -> None:
        for name in settings.names():
            section = settings.section(name)
            match kind := section.text("type", "dynamixel"):
                case "dynamixel":
                    self._joints[name] = DynamixelServo(self._node, name, section)
                case "hobby_servo":
                    self._joints[name] = HobbyServo(self._node, name, section)
                case "calibrated_linear":
                    self._joints[name] = LinearJoint(self._node, name, section)
                case _:
                    self._node.log.warn(f"joint {name}: no type {kind!r}; it is left out")

    def _add_controllers(self, settings: RosParameters) -> None:
        """Add the valid controllers; like the original, continue without invalid ones."""
        for name in settings.names():
            section = settings.section(name)
            try:
                match kind := section.text("type"):
                    case "diff_controller":
                        self._controllers.append(DiffController(self._node, name, section))
                    case "linear_controller":
                        self._controllers.append(LinearController(self._node, name, section))
                    case "linear_controller_i":
                        self._controllers.append(LinearController(self._node, name, section, incremental=True))
                    case "follow_controller":
                        self._controllers.append(FollowController(self._node, name, section, self._joints))
                    case _:
                        self._node.log.error(f"Unrecognized controller: {kind}")
            except (ParamError, MessageError) as error:
                self._node.log.error(f"controller {name}: {error}; it is left out")

    def _readings(self) -> list[JointReading]:
        joints = [joint.reading for joint in self._joints.values()]
        return joints + [reading for controller in self._controllers for reading in controller.readings]

    def _publish_joint_states(self) -> None:
        """Publish servos, then the controllers' joints; even without joints."""
        readings = self._readings()
        self._joint_states.publish(
            {
                "header": {"stamp": self._node.clock.now_ns()},
                "name": [reading.name for reading in readings],
                "position": [reading.position for reading in readings],
                "velocity": [reading.velocity for reading in readings],
            }
        )

    def _publish_diagnostics(self) -> None:
        components = [*self._controllers, *self._joints.values()]
        entries = [status for component in components if (status := component.status()) is not None]
        self._diagnostics.publish(
            {
                "header": {"stamp": self._node.clock.now_ns()},
                "status": [
                    {
                        "name": entry.name,
                        "message": entry.message,
                        "values": [{"key": key, "value": value} for key, value in entry.values],
                    }
                    for entry in entries
                ],
            }
        )


def _no_channel(_request: "arbotix_msgs.SetupChannelRequest") -> dict[str, object]:
    """Empty response for channels that a simulated board lacks, as in the original."""
    return {}
