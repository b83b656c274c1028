"""turtlesim/turtle_teleop_key: drives turtle1 with the arrow keys."""

from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from ..host import NodeHost
from ..keyboard import Keyboard

_HELP = """Reading from keyboard
---------------------------
Use arrow keys to move the turtle. 'q' to quit."""
_MOVES = {"up": (1.0, 0.0), "down": (-1.0, 0.0), "left": (0.0, 1.0), "right": (0.0, -1.0)}


class TurtleTeleopKey:
    """Publishes one command per key press."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments
        self._node = node
        self._display = host.display
        self._terminal = host.terminal

    async def run(self) -> int:
        """Read keys until q, or until cancelled."""
        node = self._node
        # Not private names: launch files set these parameters outside <node>.
        scales = {name: await node.params.get(name, 2.0) for name in ("scale_linear", "scale_angular")}
        settings = RosParameters(scales, node.resolve("scale_linear").rpartition("/")[0])
        linear, angular = settings.number("scale_linear"), settings.number("scale_angular")
        commands = node.advertise("turtle1/cmd_vel", "geometry_msgs/Twist", queue_size=1)
        if self._display is not None:
            self._display.drive_on(commands.topic)
        keyboard = Keyboard(self._terminal)
        if not keyboard.is_available:
            node.log.warn(keyboard.advice(commands.topic))
            await node.closed.wait()
            return 0
        keyboard.print(_HELP)
        with keyboard.cbreak():
            while (key := await keyboard.read_key()) != "q":
                if key in _MOVES:
                    speed, yaw_rate = _MOVES[key]
                    commands.publish({"linear": {"x": speed * linear}, "angular": {"z": yaw_rate * angular}})
        return 0
