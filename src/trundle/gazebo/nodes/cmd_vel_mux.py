"""yocs_cmd_vel_mux: forwards the active velocity command of the highest priority, as on a TurtleBot 2."""

import asyncio
from dataclasses import dataclass
from typing import TYPE_CHECKING

import yaml

from trundle.base.files import read_file
from trundle.base.yaml_loader import load_yaml
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node

from .host import NodeHost

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs

_KIND = "geometry_msgs/Twist"
_IDLE = "idle"
_POLL_S = 0.02


@dataclass(slots=True, eq=False)
class CmdVelSubscriber:
    """An input topic."""

    name: str
    topic: str
    timeout_s: float
    priority: float
    received_ns: int = 0

    def is_expired(self, now_ns: int) -> bool:
        """True if the last message is older than the timeout."""
        return now_ns - self.received_ns > self.timeout_s * 1e9


class CmdVelMux:
    """Forwards one input at a time; `~active` publishes its name, or "idle".

    `~yaml_cfg_file` names a file with `subscribers` (name, topic, timeout, priority) and `publisher` (output); their
    topics are private names. An input stays active until it times out or one of higher priority publishes.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._allowed: CmdVelSubscriber | None = None

    async def run(self) -> int:
        """Mux until cancelled."""
        node = self._node
        path = str(await node.params.get("~yaml_cfg_file", ""))
        try:
            with node.loop.work.pending("the multiplexer's file"):
                sources, output = await asyncio.to_thread(_read, path)
        except ParamError as error:
            node.log.error(str(error))
            return 1
        self._active = node.advertise("~active", "std_msgs/String", latch=True, queue_size=1)
        self._active.publish({"data": _IDLE})
        self._output = node.advertise(f"~{output}", _KIND, queue_size=10)
        for source in sources:
            node.subscribe(f"~{source.topic}", _KIND, lambda message, s=source: self._on_command(s, message))
        while not node.closed.is_set():
            await node.clock.sleep(_POLL_S)
            if self._allowed is not None and self._allowed.is_expired(node.clock.now_ns()):
                self._allow(None)
        return 0

    def _on_command(self, source: CmdVelSubscriber, message: "geometry_msgs.Twist") -> None:
        now = source.received_ns = self._node.clock.now_ns()
        allowed = self._allowed
        is_free = allowed is None or allowed.is_expired(now) or source.priority > allowed.priority
        if source is not allowed and is_free:
            self._allow(source)
        if self._allowed is source:
            self._output.publish(message)

    def _allow(self, source: CmdVelSubscriber | None) -> None:
        self._allowed = source
        self._active.publish({"data": _IDLE if source is None else source.name})


def _read(path: str) -> tuple[list[CmdVelSubscriber], str]:
    """Read the configuration file.

    Raises:
        ParamError: the file is missing or invalid.
    """
    try:
        tree = load_yaml(read_file(path).decode())
    except (OSError, ValueError, yaml.YAMLError) as error:
        raise ParamError(f"yaml_cfg_file {path!r} cannot be read: {error}") from None
    settings = RosParameters(tree, path)
    sources = [
        CmdVelSubscriber(
            section.text("name"), section.text("topic"), section.number("timeout"), section.number("priority")
        )
        for section in settings.sections("subscribers")
    ]
    if not sources:
        raise ParamError(f"{path}: no subscribers")
    return sources, settings.text("publisher", "output")
