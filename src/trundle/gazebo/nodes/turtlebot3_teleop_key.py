"""turtlebot3_teleop_key: keys step the velocities up and down."""

import os

from trundle.ros import Node
from trundle.sim.control import step_towards

from .host import NodeHost
from .keyboard import Keyboard
from .private_parameters import private_parameters

_HELP = """
Control Your TurtleBot3!
---------------------------
Moving around:
        w
   a    s    d
        x

w/x : increase/decrease linear velocity (Burger : ~ 0.22, Waffle and Waffle Pi : ~ 0.26)
a/d : increase/decrease angular velocity (Burger : ~ 2.84, Waffle and Waffle Pi : ~ 1.82)

space key, s : force stop

CTRL-C to quit
"""
_STEPS = {"w": (0.01, 0.0), "x": (-0.01, 0.0), "a": (0.0, 0.1), "d": (0.0, -0.1)}
_MAX_SPEEDS = {"burger": (0.22, 2.84)}
_DEFAULT_MAX_SPEEDS = (0.26, 1.82)
"""Maximum speeds [m/s], [rad/s]."""
_PERIOD_S = 0.1


class Turtlebot3TeleopKey:
    """Publishes cmd_vel at 10 Hz, approaching a new velocity by half a key's step each time."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments
        self._node = node
        self._terminal = host.terminal
        self._env = {**os.environ, **host.env}

    async def run(self) -> int:
        """Read keys until cancelled, then publish a stop."""
        node = self._node
        settings = await private_parameters(node)
        model = settings.text("model", self._env.get("TURTLEBOT3_MODEL", "burger"))
        max_speeds = _MAX_SPEEDS.get(model, _DEFAULT_MAX_SPEEDS)
        commands = node.advertise("cmd_vel", "geometry_msgs/Twist", queue_size=10)
        keyboard = Keyboard(self._terminal)
        if not keyboard.is_available:
            node.log.warn(keyboard.advice(commands.topic))
            await node.closed.wait()
            return 0
        keyboard.print(_HELP)
        target, control = (0.0, 0.0), (0.0, 0.0)
        with keyboard.cbreak():
            try:
                while True:
                    key = await keyboard.read_key(_PERIOD_S)
                    if key in _STEPS:
                        pairs = zip(target, _STEPS[key], max_speeds, strict=True)
                        linear, angular = (min(max(value + step, -limit), limit) for value, step, limit in pairs)
                        target = (linear, angular)
                        keyboard.print(f"currently:\tlinear velocity {linear:.2f}\t angular velocity {angular:.2f} ")
                    elif key in (" ", "s"):
                        target = control = (0.0, 0.0)
                    control = (step_towards(control[0], target[0], 0.005), step_towards(control[1], target[1], 0.05))
                    commands.publish({"linear": {"x": control[0]}, "angular": {"z": control[1]}})
            finally:
                commands.publish({})
