"""turtlesim/turtlesim_node: turtles that follow velocity commands and draw; the window is an image topic."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from trundle.ros import Message, Node, Publisher, Service, ServiceError, Subscription
from trundle.spatial import NS_PER_S

from ..host import NodeHost
from ..rate import Rate
from .turtle import Color, Turtle
from .turtle_frame import SIZE_M, SIZE_PX, TurtleFrame

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs, std_srvs, turtlesim

_TICK_NS = 16_000_000
"""Timer period of the original's window."""
_MAX_BEHIND_NS = 2_000_000_000
"""Maximum time that is caught up; commands last one second, so all turtles have stopped by then."""
_UPDATES_PER_IMAGE = 6
"""Updates per image: ten images per second."""
_BACKGROUND: Color = (0x45, 0x56, 0xFF)
_MAX_TURTLES = 1000
_MIN_PEN_PX = 1
"""Width of a pen for which no width was set."""


class _SpawnedTurtle:
    """A turtle with its topics and services."""

    def __init__(self, turtle: Turtle, pose: Publisher, color: Publisher) -> None:
        self.turtle = turtle
        self.pose = pose
        self.color = color
        self.commands: Subscription | None = None
        self.services: list[Service] = []

    def unregister(self) -> None:
        """Unregister the topics and services."""
        self.pose.unregister()
        self.color.unregister()
        if self.commands is not None:
            self.commands.unregister()
        for service in self.services:
            service.unregister()


class TurtleSim:
    """Starts with turtle1 in the centre; `spawn` adds more."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments
        self._node = node
        self._display = host.display
        self._turtles: dict[str, _SpawnedTurtle] = {}
        self._name_count = 0
        """Number of generated names since the start; numbers are not reused."""
        self._background = _BACKGROUND
        self._picture = TurtleFrame(_BACKGROUND)

    async def run(self) -> int:
        """Move turtles until cancelled."""
        node = self._node
        for name, value in zip("rgb", _BACKGROUND, strict=True):
            if not await node.params.has(f"~background_{name}"):
                await node.params.set(f"~background_{name}", value)
        await self._wipe()
        image = node.advertise("~image", "sensor_msgs/Image", queue_size=1)
        node.advertise_service("clear", "std_srvs/Empty", self._clear)
        node.advertise_service("reset", "std_srvs/Empty", self._reset)
        node.advertise_service("spawn", "turtlesim/Spawn", self._on_spawn)
        node.advertise_service("kill", "turtlesim/Kill", self._kill)
        node.log.info(f"Starting turtlesim with node name {node.name}; its window is {image.topic}")
        self._start()
        window = None
        if self._display is not None:
            self._display.show_image(image.topic)
            self._display.drive_on(node.resolve("turtle1/cmd_vel"))
            window = node.loop.spawn(self._display.show(node, config=None, fixed_frame=None))
        try:
            return await self._move_all(image)
        finally:
            if window is not None:
                window.cancel()

    async def _move_all(self, image: Publisher) -> int:
        clock = self._node.clock
        rate, count = Rate(self._node, NS_PER_S / _TICK_NS), 0
        moved_ns = clock.now_ns()
        while True:
            await rate.sleep()
            now_ns = clock.now_ns()
            if moved_ns > now_ns:  # time jumped back
                moved_ns = now_ns - _TICK_NS
            # Catch up after delays, so that motion depends on time, not on the number of updates.
            moved_ns = max(moved_ns, now_ns - _MAX_BEHIND_NS)
            while moved_ns + _TICK_NS <= now_ns:
                moved_ns += _TICK_NS
                for name, registered in self._turtles.items():
                    self._move(name, registered.turtle, moved_ns)
            for registered in list(self._turtles.values()):
                self._publish(registered)
            count += 1
            if count % _UPDATES_PER_IMAGE == 0 and image.has_subscribers:
                image.publish(self._image())

    def _start(self) -> None:
        self._name_count = 0
        self._spawn(self._new_name(), Turtle(SIZE_M / 2.0, SIZE_M / 2.0, 0.0, size=SIZE_M))

    def _spawn(self, name: str, turtle: Turtle) -> None:
        node = self._node
        registered = _SpawnedTurtle(
            turtle,
            node.advertise(f"{name}/pose", "turtlesim/Pose", queue_size=1),
            node.advertise(f"{name}/color_sensor", "turtlesim/Color", queue_size=1),
        )

        def command(twist: "geometry_msgs.Twist") -> None:
            turtle.command(twist.linear.x, twist.linear.y, twist.angular.z, now_ns=node.clock.now_ns())

        registered.commands = node.subscribe(f"{name}/cmd_vel", "geometry_msgs/Twist", command, queue_size=1)
        handlers: tuple[tuple[str, str, Callable[[Turtle, Message], None]], ...] = (
            ("set_pen", "SetPen", _set_pen),
            ("teleport_absolute", "TeleportAbsolute", self._teleport),
            ("teleport_relative", "TeleportRelative", self._teleport_ahead),
        )
        for service, kind, handler in handlers:

            def handle(request: Message, handler: Callable[[Turtle, Message], None] = handler) -> dict[str, Any]:
                handler(turtle, request)
                return {}

            registered.services.append(node.advertise_service(f"{name}/{service}", f"turtlesim/{kind}", handle))
        self._turtles[name] = registered
        node.log.info(f"Spawning turtle [{name}] at x=[{turtle.x:f}], y=[{turtle.y:f}], theta=[{turtle.theta:f}]")

    def _move(self, name: str, turtle: Turtle, now_ns: int) -> None:
        before = (turtle.x, turtle.y)
        turtle.update(_TICK_NS / NS_PER_S, now_ns=now_ns)
        if turtle.hit_wall:
            self._node.log.warn(f"Oh no! I hit the wall! ({name} is held at x=[{turtle.x:f}], y=[{turtle.y:f}])")
        self._draw(turtle, before)

    def _publish(self, registered: _SpawnedTurtle) -> None:
        turtle = registered.turtle
        red, green, blue = self._picture.color_at(turtle.x, turtle.y)
        registered.color.publish({"r": red, "g": green, "b": blue})
        registered.pose.publish(
            {
                "x": turtle.x,
                "y": turtle.y,
                "theta": turtle.theta,
                "linear_velocity": turtle.linear_velocity,
                "angular_velocity": turtle.angular_velocity,
            }
        )

    def _draw(self, turtle: Turtle, before: tuple[float, float]) -> None:
        if turtle.pen.on and before != (turtle.x, turtle.y):
            self._picture.draw_line(before, (turtle.x, turtle.y), turtle.pen.color, turtle.pen.width_px)

    def _teleport(self, turtle: Turtle, request: "turtlesim.TeleportAbsoluteRequest") -> None:
        before = (turtle.x, turtle.y)
        turtle.teleport(request.x, request.y, request.theta)
        self._draw(turtle, before)

    def _teleport_ahead(self, turtle: Turtle, request: "turtlesim.TeleportRelativeRequest") -> None:
        before = (turtle.x, turtle.y)
        turtle.teleport_relative(request.linear, request.angular)
        self._draw(turtle, before)

    def _image(self) -> dict[str, Any]:
        pixels = self._picture.with_turtles(registered.turtle for registered in self._turtles.values())
        return {
            "header": {"stamp": self._node.clock.now_ns()},
            "height": SIZE_PX,
            "width": SIZE_PX,
            "encoding": "rgb8",
            "step": 3 * SIZE_PX,
            "data": list(pixels),
        }

    async def _wipe(self) -> None:
        values = [await self._node.params.get(f"~background_{name}", 0) for name in "rgb"]
        red, green, blue = (min(max(int(value), 0), 255) for value in values)
        self._background = (red, green, blue)
        self._picture.clear(self._background)

    async def _clear(self, _request: "std_srvs.EmptyRequest") -> dict[str, Any]:
        self._node.log.info("Clearing turtlesim.")
        await self._wipe()
        return {}

    async def _reset(self, _request: "std_srvs.EmptyRequest") -> dict[str, Any]:
        self._node.log.info("Resetting turtlesim.")
        for registered in self._turtles.values():
            registered.unregister()
        self._turtles.clear()
        await self._wipe()
        self._start()
        return {}

    def _on_spawn(self, request: "turtlesim.SpawnRequest") -> dict[str, Any]:
        name = request.name or self._new_name()
        if name in self._turtles:
            raise ServiceError(f"A turtle named [{name}] already exists")
        if len(self._turtles) >= _MAX_TURTLES:
            raise ServiceError(f"{_MAX_TURTLES} turtles is the limit")
        self._spawn(name, Turtle(request.x, request.y, request.theta, size=SIZE_M))
        return {"name": name}

    def _new_name(self) -> str:
        while True:
            self._name_count += 1
            if (name := f"turtle{self._name_count}") not in self._turtles:
                return name

    def _kill(self, request: "turtlesim.KillRequest") -> dict[str, Any]:
        registered = self._turtles.pop(request.name, None)
        if registered is None:
            raise ServiceError(f"Tried to kill turtle [{request.name}], which does not exist")
        registered.unregister()
        return {}


def _set_pen(turtle: Turtle, request: "turtlesim.SetPenRequest") -> None:
    pen = turtle.pen
    pen.on = not request.off
    if pen.on:
        pen.color = (request.r, request.g, request.b)
        pen.width_px = request.width or _MIN_PEN_PX
