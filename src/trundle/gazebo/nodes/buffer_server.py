"""tf2_ros/buffer_server: transform lookup as an action, for clients without a buffer."""

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import yaml

from trundle.robots.parameters import RosParameters
from trundle.ros import (
    ActionResult,
    ActionServer,
    ConnectivityError,
    ExtrapolationError,
    FrameNameError,
    Node,
    Transform,
    TransformBuffer,
    TransformError,
    TransformListener,
    check_frame_name,
    to_nsec,
)
from trundle.spatial import Pose

from .host import NodeHost

if TYPE_CHECKING:
    from trundle.ros.message_types import tf2_msgs

_ACTION = "tf2_buffer_server"
_NO_ERROR, _LOOKUP_ERROR, _CONNECTIVITY_ERROR, _EXTRAPOLATION_ERROR, _INVALID_ARGUMENT_ERROR = 0, 1, 2, 3, 4
_ERRORS: dict[type[TransformError], int] = {
    ConnectivityError: _CONNECTIVITY_ERROR,
    ExtrapolationError: _EXTRAPOLATION_ERROR,
    FrameNameError: _INVALID_ARGUMENT_ERROR,
}
_POLL_S = 0.02


class BufferServer:
    """The action `tf2_buffer_server`, with concurrent goals.

    Parameters, in the node's namespace: buffer_size (120 [s]), publish_frame_service, use_node_namespace (the action is
    `~`).
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        namespace = node.resolve("")
        settings = RosParameters(await node.params.get(namespace, {}), namespace)
        buffer = TransformBuffer(settings.number("buffer_size", 120.0))
        self._buffer = TransformListener(node, buffer).buffer
        action = node.name if settings.flag("use_node_namespace", default=False) else _ACTION
        ActionServer(node, action, "tf2_msgs/LookupTransform", self._on_goal, concurrent=True)
        if settings.flag("publish_frame_service", default=False):
            node.advertise_service("~tf2_frames", "tf2_msgs/FrameGraph", self._frames)
        await node.closed.wait()
        return 0

    async def _on_goal(self, goal: "tf2_msgs.LookupTransformGoal", accept: Callable[[], None]) -> ActionResult:
        """Retry until the lookup succeeds or times out; the goal always succeeds, and the result holds the error."""
        accept()
        clock = self._node.clock
        end_ns = clock.now_ns() + to_nsec(goal.timeout)
        while True:
            try:
                transform = self._lookup(goal)
            except TransformError as error:
                if clock.now_ns() >= end_ns:
                    return ActionResult(result={"error": _error(error)})
            else:
                return ActionResult(result={"transform": _stamped(transform), "error": {"error": _NO_ERROR}})
            await asyncio.sleep(_POLL_S)

    def _lookup(self, goal: "tf2_msgs.LookupTransformGoal") -> Transform:
        buffer, source_ns = self._buffer, to_nsec(goal.source_time)
        for field in ("target_frame", "source_frame", "fixed_frame")[: 3 if goal.advanced else 2]:
            check_frame_name(getattr(goal, field), "lookupTransform", field)
        if not goal.advanced and goal.target_frame == goal.source_frame:
            return self._identity(goal.source_frame, source_ns)
        if not goal.advanced:
            return buffer.lookup_transform(goal.target_frame, goal.source_frame, source_ns)
        source_transform = buffer.lookup_transform(goal.fixed_frame, goal.source_frame, source_ns)
        target_transform = buffer.lookup_transform(goal.target_frame, goal.fixed_frame, to_nsec(goal.target_time))
        pose = target_transform.pose @ source_transform.pose
        return Transform(
            parent=target_transform.parent,
            child=source_transform.child,
            stamp_ns=target_transform.stamp_ns,
            translation=pose.position,
            rotation=pose.quaternion,
        )

    def _identity(self, frame: str, stamp_ns: int) -> Transform:
        """Return the identity transform of a frame, also of an unknown one."""
        latest = None if self._buffer.is_static(frame) else self._buffer.latest(frame)
        stamp_ns = stamp_ns or (latest.stamp_ns if latest is not None else 0)
        return Transform(
            parent=frame, child=frame, stamp_ns=stamp_ns, translation=Pose().position, rotation=Pose().quaternion
        )

    def _frames(self, _request: "tf2_msgs.FrameGraphRequest") -> dict[str, Any]:
        frames = {name: {"parent": parent} for name, parent in self._buffer.frames().items() if parent is not None}
        return {"frame_yaml": yaml.safe_dump(frames)}


def _error(error: TransformError) -> dict[str, Any]:
    return {"error": _ERRORS.get(type(error), _LOOKUP_ERROR), "error_string": str(error)}


def _stamped(transform: Transform) -> dict[str, Any]:
    (x, y, z), (qw, qx, qy, qz) = transform.translation, transform.rotation
    return {
        "header": {"stamp": transform.stamp_ns, "frame_id": transform.parent},
        "child_frame_id": transform.child,
        "transform": {"translation": {"x": x, "y": y, "z": z}, "rotation": {"x": qx, "y": qy, "z": qz, "w": qw}},
    }
