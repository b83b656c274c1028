"""map_server/map_saver: saves the next message on /map as an image and YAML."""

import asyncio
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from trundle.base.diagnostics import UsageError
from trundle.ros import Message, Node

from ..host import NodeHost
from .occupancy_grid import OccupancyGrid, write_map

if TYPE_CHECKING:
    from trundle.ros.message_types import nav_msgs

_USAGE = "usage: map_saver [--occ 1…100] [--free 0…100] [-f NAME]"


class MapSaver:
    """Saves one map and exits."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Save; exit code 1 on invalid options or write errors."""
        node = self._node
        if "-h" in self._arguments:
            print(_USAGE)
            return 0
        options = {"-f": "map", "--occ": "65", "--free": "25"}
        arguments = iter(self._arguments)
        for argument in arguments:
            if argument not in options:
                node.log.error(f"{_USAGE}; got {' '.join(self._arguments)!r}")
                return 1
            options[argument] = next(arguments, "")
        try:
            occupied, free = int(options["--occ"]), int(options["--free"])
        except ValueError:
            occupied = free = -1
        if not 0 <= free < occupied <= 100:
            node.log.error(f"{_USAGE}; --free must be below --occ")
            return 1
        messages: asyncio.Queue[Message] = asyncio.Queue()
        node.log.info("Waiting for the map")
        node.subscribe("map", "nav_msgs/OccupancyGrid", messages.put_nowait, queue_size=1)
        message = await messages.get()
        try:
            await asyncio.to_thread(write_map, Path(options["-f"]), _read_grid(message), occupied=occupied, free=free)
        except UsageError as error:
            node.log.error(str(error))
            return 1
        node.log.info(f"Received a {message.info.width} X {message.info.height} map; wrote {options['-f']}.pgm")
        return 0


def _read_grid(message: "nav_msgs.OccupancyGrid") -> OccupancyGrid:
    """Convert a message.

    Raises:
        UsageError: its cells do not fit its size, or a number is not finite.
    """
    info, orientation = message.info, message.info.origin.orientation
    cells = np.asarray(message.data, dtype=np.int8)
    if cells.size != info.height * info.width:
        raise UsageError(f"the map announces {info.width} × {info.height} cells, and has {cells.size}")
    yaw = math.atan2(
        2.0 * (orientation.w * orientation.z + orientation.x * orientation.y),
        1.0 - 2.0 * (orientation.y**2 + orientation.z**2),
    )
    position = info.origin.position
    if not math.isfinite(info.resolution + position.x + position.y + yaw):
        raise UsageError("the map's resolution or origin is not finite")
    origin = (position.x, position.y, yaw)
    return OccupancyGrid(
        cells=cells.reshape(info.height, info.width), resolution_m=float(info.resolution), origin=origin
    )
