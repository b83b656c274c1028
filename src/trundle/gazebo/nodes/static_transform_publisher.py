"""static_transform_publisher of tf (periodic, on /tf) and of tf2_ros (latched, on /tf_static)."""

import math
from typing import Any

from trundle.ros import Node, ParameterError, StaticTransformBroadcaster, Transform, TransformBroadcaster
from trundle.spatial import Quaternion, Vector3, quaternion_from_rpy

from .host import NodeHost

_TF_USAGE = (
    "usage: static_transform_publisher x y z yaw pitch roll frame_id child_frame_id period_ms, "
    "or x y z qx qy qz qw frame_id child_frame_id period_ms"
)
_TF2_USAGE = (
    "usage: static_transform_publisher x y z yaw pitch roll frame_id child_frame_id, "
    "or x y z qx qy qz qw frame_id child_frame_id, or the name of a parameter that holds the transform"
)
_WRONG_ARGUMENTS = 255
"""The originals return -1."""


class TfStaticTransformPublisher:
    """tf/static_transform_publisher: publishes periodically, stamped one period ahead."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Publish until cancelled."""
        node, arguments = self._node, self._arguments
        numbers = _numbers([*arguments[:-3], arguments[-1]]) if len(arguments) in (9, 10) else None
        if numbers is None:
            node.log.error(f"{_TF_USAGE}; got {' '.join(arguments)!r}")
            return _WRONG_ARGUMENTS
        # Leading slashes are published as given, as by the original; listeners strip them.
        parent, child = arguments[-3:-1]
        if parent == child:
            # The original continues after this message.
            node.log.fatal(f"target_frame and source frame are the same ({parent}, {child}) this cannot work")
        *values, period_ms = numbers
        translation, rotation = _pose(values)
        period_s = max(period_ms, 1.0) / 1000.0
        broadcaster = TransformBroadcaster(node)
        while True:
            broadcaster.send_transform(
                Transform(
                    parent=parent,
                    child=child,
                    stamp_ns=node.clock.now_ns() + round(period_s * 1e9),
                    translation=translation,
                    rotation=rotation,
                )
            )
            await node.clock.sleep(period_s)


class Tf2StaticTransformPublisher:
    """tf2_ros/static_transform_publisher: publishes once, latched."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Publish once, then idle until cancelled."""
        node, arguments = self._node, self._arguments
        if len(arguments) == 1:
            transform = await self._from_param(arguments[0])
        elif len(arguments) in (8, 9) and (values := _numbers(arguments[:-2])) is not None:
            translation, rotation = _pose(values)
            transform = self._transform(arguments[-2], arguments[-1], translation, rotation)
        else:
            node.log.error(f"{_TF2_USAGE}; got {' '.join(arguments)!r}")
            return _WRONG_ARGUMENTS
        if transform is None:
            return _WRONG_ARGUMENTS
        if transform.parent == transform.child:
            frames = f"{transform.parent}, {transform.child}"
            node.log.fatal(f"target_frame and source frame are the same ({frames}) this cannot work")
            return 1
        StaticTransformBroadcaster(node).send_transform(transform)
        node.log.info(f"Spinning until killed publishing {transform.parent} to {transform.child}")
        await node.closed.wait()
        return 0

    def _transform(self, parent: str, child: str, translation: Vector3, rotation: Quaternion) -> Transform:
        now = self._node.clock.now_ns()
        return Transform(parent=parent, child=child, stamp_ns=now, translation=translation, rotation=rotation)

    async def _from_param(self, name: str) -> Transform | None:
        """Read a geometry_msgs/TransformStamped from a parameter."""
        try:
            tree = await self._node.params.get(name)
            position, orientation = tree["transform"]["translation"], tree["transform"]["rotation"]
            translation = (float(position["x"]), float(position["y"]), float(position["z"]))
            rotation = (
                float(orientation["w"]),
                float(orientation["x"]),
                float(orientation["y"]),
                float(orientation["z"]),
            )
            parent, child = str(tree["header"]["frame_id"]), str(tree["child_frame_id"])
        except ParameterError as error:
            self._node.log.fatal(f"Could not read TF: {error}")
            return None
        except (KeyError, TypeError, ValueError) as error:
            self._node.log.fatal(f"Could not read TF: parameter {name} is not a transform: {_describe(error)}")
            return None
        return self._transform(parent, child, translation, rotation)


def _describe(error: Exception) -> Any:
    return f"{error} is missing" if isinstance(error, KeyError) else error


def _numbers(arguments: list[str]) -> list[float] | None:
    try:
        numbers = [float(argument) for argument in arguments]
    except ValueError:
        return None
    return numbers if all(map(math.isfinite, numbers)) else None


def _pose(values: list[float]) -> tuple[Vector3, Quaternion]:
    """Parse x y z yaw pitch roll, or x y z qx qy qz qw; the result's quaternion is wxyz."""
    x, y, z, *rotation = values
    if len(rotation) == 3:
        yaw, pitch, roll = rotation
        return (x, y, z), quaternion_from_rpy(roll, pitch, yaw)
    qx, qy, qz, qw = rotation
    return (x, y, z), (qw, qx, qy, qz)
