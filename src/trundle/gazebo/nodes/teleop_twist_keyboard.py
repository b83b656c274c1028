"""teleop_twist_keyboard: drives a robot with the keys around i; other keys change the speeds."""

import asyncio
import math

from trundle.ros import Node

from .host import NodeHost
from .keyboard import Keyboard
from .private_parameters import private_parameters

_HELP = """
Reading from the keyboard  and Publishing to Twist!
---------------------------
Moving around:
   u    i    o
   j    k    l
   m    ,    .

For Holonomic mode (strafing), hold down the shift key:
---------------------------
   U    I    O
   J    K    L
   M    <    >

t : up (+z)
b : down (-z)

anything else : stop

q/z : increase/decrease max speeds by 10%
w/x : increase/decrease only linear speed by 10%
e/c : increase/decrease only angular speed by 10%

CTRL-C to quit
"""
_MOVES: dict[str, tuple[int, int, int, int]] = {
    "i": (1, 0, 0, 0),
    "o": (1, 0, 0, -1),
    "j": (0, 0, 0, 1),
    "l": (0, 0, 0, -1),
    "u": (1, 0, 0, 1),
    ",": (-1, 0, 0, 0),
    ".": (-1, 0, 0, 1),
    "m": (-1, 0, 0, -1),
    "O": (1, -1, 0, 0),
    "I": (1, 0, 0, 0),
    "J": (0, 1, 0, 0),
    "L": (0, -1, 0, 0),
    "U": (1, 1, 0, 0),
    "<": (-1, 0, 0, 0),
    ">": (-1, -1, 0, 0),
    "M": (-1, 1, 0, 0),
    "t": (0, 0, 1, 0),
    "b": (0, 0, -1, 0),
}
"""Key → signs of linear x, y, z and angular z."""
_SPEEDS = {"q": (1.1, 1.1), "z": (0.9, 0.9), "w": (1.1, 1.0), "x": (0.9, 1.0), "e": (1.0, 1.1), "c": (1.0, 0.9)}


class TeleopTwistKeyboard:
    """Publishes a Twist (TwistStamped with ~stamped) at each key press, and at ~repeat_rate.

    Publishes a stop ~key_timeout after the last key; with 0, never.
    """

    topic = "cmd_vel"
    speed, turn = 0.5, 1.0
    """Default speeds [m/s], [rad/s]."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments
        self._display = host.display
        self._terminal = host.terminal
        self._node = node

    async def run(self) -> int:
        """Read keys until cancelled, then publish a stop."""
        node = self._node
        settings = await private_parameters(node)
        speed, turn = settings.number("speed", self.speed), settings.number("turn", self.turn)
        repeat_hz, timeout_s = settings.number("repeat_rate", 0.0), settings.number("key_timeout", 0.5)
        stamped = settings.flag("stamped", default=False)
        frame = settings.text("frame_id", "")
        kind = "geometry_msgs/TwistStamped" if stamped else "geometry_msgs/Twist"
        commands = node.advertise(self.topic, kind, queue_size=1)

        def send(move: tuple[int, int, int, int]) -> None:
            x, y, z, th = move
            linear = {"x": x * speed, "y": y * speed, "z": z * speed}
            twist = {"linear": linear, "angular": {"z": th * turn}}
            header = {"stamp": node.clock.now_ns(), "frame_id": frame}
            commands.publish({"header": header, "twist": twist} if stamped else twist)

        if self._display is not None and not stamped:
            self._display.drive_on(commands.topic)
        keyboard = Keyboard(self._terminal)
        if not keyboard.is_available:
            node.log.warn(keyboard.advice(commands.topic))
            await node.closed.wait()
            return 0
        keyboard.print(f"{_HELP}\ncurrently:\tspeed {speed}\tturn {turn} ")
        move = (0, 0, 0, 0)
        now_s = asyncio.get_running_loop().time
        released_s = math.inf
        with keyboard.cbreak():
            try:
                while True:
                    timeouts = [released_s - now_s()] + ([1.0 / repeat_hz] if repeat_hz > 0.0 else [])
                    key = await keyboard.read_key(None if math.isinf(min(timeouts)) else max(0.0, min(timeouts)))
                    if key in _SPEEDS:
                        speed_factor, turn_factor = _SPEEDS[key]
                        speed, turn = speed * speed_factor, turn * turn_factor
                        keyboard.print(f"currently:\tspeed {speed}\tturn {turn} ")
                    elif key is not None:
                        move = _MOVES.get(key, (0, 0, 0, 0))
                    elif now_s() >= released_s:
                        move = (0, 0, 0, 0)
                        released_s = math.inf
                    if key is not None and timeout_s > 0.0:
                        released_s = math.inf if move == (0, 0, 0, 0) else now_s() + timeout_s
                    send(move)
            finally:
                send((0, 0, 0, 0))


class TurtlebotTeleopKey(TeleopTwistKeyboard):
    """turtlebot_teleop/turtlebot_teleop_key: the same keys, slower, on a private topic."""

    topic = "~cmd_vel"
    speed, turn = 0.2, 1.0
