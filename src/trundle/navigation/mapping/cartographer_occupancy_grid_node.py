"""cartographer_ros/cartographer_occupancy_grid_node: publishes submaps as one map."""

import asyncio
import math
from typing import Any

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.rate import LogThrottle, Rate
from trundle.ros import Node, RosError
from trundle.spatial import Pose

from ..pose_messages import read_pose
from .cartographer_node import read_arguments
from .submap_textures import Texture, paint, unpack_texture

_SERVICE = "cartographer_ros_msgs/SubmapQuery"


class CartographerOccupancyGridNode:
    """Publishes `map` from `submap_list` and the service `submap_query`.

    Arguments, with the original's defaults: -resolution 0.05, -publish_period_sec 1, -occupancy_grid_topic map,
    -include_frozen_submaps and -include_unfrozen_submaps true.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._options = read_arguments(arguments)
        self._list: Any = None
        self._textures: dict[tuple[int, int], tuple[int, Texture]] = {}
        """Version and picture by trajectory and submap."""

    async def run(self) -> int:
        """Publish until cancelled; exit code 1 on invalid options."""
        node = self._node
        self._warnings = LogThrottle(node, 5.0)
        try:
            self._resolution_m, period_s = self._number("resolution", 0.05), self._number("publish_period_sec", 1.0)
        except ValueError as error:
            node.log.fatal(str(error))
            return 1
        topic = self._options.get("occupancy_grid_topic", "map")
        self._maps = node.advertise(topic, "nav_msgs/OccupancyGrid", latch=True, queue_size=1)
        node.subscribe("submap_list", "cartographer_ros_msgs/SubmapList", self._on_list, queue_size=1)
        rate = Rate(node, 1.0 / period_s)
        while not node.closed.is_set():
            await rate.sleep()
            if self._list is not None and self._list.submap:
                with node.loop.work.pending("the map"):
                    await self._publish(self._list)
        return 0

    def _number(self, name: str, default: float) -> float:
        text = self._options.get(name, str(default))
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not 0.001 <= value <= 1e6:
            raise ValueError(f"-{name} must be a number from 0.001 to 1000000, got {text!r}")
        return value

    def _on_list(self, message: Any) -> None:
        self._list = message

    def _includes(self, entry: Any) -> bool:
        name = "include_frozen_submaps" if entry.is_frozen else "include_unfrozen_submaps"
        return self._options.get(name, "true").lower() not in ("false", "0", "no")

    async def _publish(self, message: Any) -> None:
        placed: list[tuple[Pose, Texture]] = []
        keys: set[tuple[int, int]] = set()
        for entry in filter(self._includes, message.submap):
            key = (int(entry.trajectory_id), int(entry.submap_index))
            keys.add(key)
            try:
                placed.append((read_pose(entry.pose), await self._texture(key, int(entry.submap_version))))
            except (RosError, ValueError) as error:
                self._warnings.warn(f"submap {key[1]} of trajectory {key[0]} is left out: {error}")
        self._textures = {key: value for key, value in self._textures.items() if key in keys}
        grid = await asyncio.to_thread(paint, placed, self._resolution_m)
        if grid is not None:
            self._maps.publish({"header": {"stamp": message.header.stamp, "frame_id": message.header.frame_id}, **grid})

    async def _texture(self, key: tuple[int, int], version: int) -> Texture:
        """Return a submap's picture, asked for where it has changed.

        Raises:
            RosError: the service does not answer.
            ValueError: there is no such submap, or its picture is invalid.
        """
        known = self._textures.get(key)
        if known is not None and known[0] == version:
            return known[1]
        answer = await self._node.call_service(
            "submap_query", _SERVICE, {"trajectory_id": key[0], "submap_index": key[1]}
        )
        if not answer.textures:
            raise ValueError(answer.status.message or "it has no picture")
        texture = await asyncio.to_thread(unpack_texture, answer.textures[0])
        self._textures[key] = (int(answer.submap_version), texture)
        return texture
