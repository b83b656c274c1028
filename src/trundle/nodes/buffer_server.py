"""tf2_ros/buffer_server: answers where frames are, as an action, for those who keep no buffer of their own."""

import asyncio
from collections.abc import Callable
from typing import Any

import yaml

from trundle.ros import (
    ActionOutcome,
    ActionServer,
    Message,
    Node,
    Settings,
    Transform,
    TransformBuffer,
    TransformError,
    TransformListener,
    ns_of,
)

from .host import Host

_NO_ERROR, _LOOKUP_ERROR, _CONNECTIVITY_ERROR, _EXTRAPOLATION_ERROR = 0, 1, 2, 3
_LOOK_S = 0.02


class BufferServer:
    """One action, `~`, that any number of clients ask at once."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Answer until cancelled."""
        node = self._node
        settings = Settings(await node.get_param("~", {}), node.name)
        buffer = TransformBuffer(settings.number("buffer_size", 120.0))
        self._buffer = TransformListener(node, buffer).buffer
        ActionServer(node, node.name, "tf2_msgs/LookupTransform", self._look_up, side_by_side=True)
        if settings.flag("publish_frame_service", default=False):
            node.advertise_service("~tf2_frames", "tf2_msgs/FrameGraph", self._frames)
        await node.closed.wait()
        return 0

    async def _look_up(self, goal: Message, accept: Callable[[], None]) -> ActionOutcome:
        """Look until it is found or the time is over."""
        accept()
        clock = self._node.clock
        end_ns = clock.now_ns() + ns_of(goal.timeout)
        while True:
            try:
                found = self._ask(goal)
            except TransformError as error:
                if clock.now_ns() >= end_ns:
                    return ActionOutcome(status="aborted", result={"error": _error(error)})
            else:
                return ActionOutcome(result={"transform": _stamped(found), "error": {"error": _NO_ERROR}})
            await asyncio.sleep(_LOOK_S)

    def _ask(self, goal: Message) -> Transform:
        buffer, source_ns = self._buffer, ns_of(goal.source_time)
        if not goal.advanced:
            return buffer.lookup(goal.target_frame, goal.source_frame, source_ns)
        then = buffer.lookup(goal.fixed_frame, goal.source_frame, source_ns)
        now = buffer.lookup(goal.target_frame, goal.fixed_frame, ns_of(goal.target_time))
        pose = now.pose @ then.pose
        return Transform(
            parent=now.parent,
            child=then.child,
            stamp_ns=now.stamp_ns,
            translation=pose.position,
            rotation=pose.quaternion,
        )

    def _frames(self, _request: Message) -> dict[str, Any]:
        frames = {name: {"parent": parent} for name, parent in self._buffer.frames().items() if parent is not None}
        return {"frame_yaml": yaml.safe_dump(frames)}


def _error(error: TransformError) -> dict[str, Any]:
    text = str(error)
    for part, number in (("extrapolation", _EXTRAPOLATION_ERROR), ("connection", _CONNECTIVITY_ERROR)):
        if part in text:
            return {"error": number, "error_string": text}
    return {"error": _LOOKUP_ERROR, "error_string": text}


def _stamped(transform: Transform) -> dict[str, Any]:
    (x, y, z), (qw, qx, qy, qz) = transform.translation, transform.rotation
    return {
        "header": {"stamp": transform.stamp_ns, "frame_id": transform.parent},
        "child_frame_id": transform.child,
        "transform": {"translation": {"x": x, "y": y, "z": z}, "rotation": {"x": qx, "y": qy, "z": qz, "w": qw}},
    }
