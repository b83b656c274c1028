"""map_server/map_server: publishes the map of a YAML file on /map."""

import asyncio
import math
import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node

from ..host import NodeHost
from ..private_parameters import private_parameters
from .occupancy_grid import OccupancyGrid, positive, read_cells, read_map

if TYPE_CHECKING:
    from trundle.ros.message_types import nav_msgs

_USAGE = "usage: map_server MAP.yaml"
_SUCCESS, _DOES_NOT_EXIST, _INVALID = 0, 1, 2


class MapServer:
    """Publishes its map, latched, and serves it."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        self._frame = settings.text("frame_id", "map")
        if len(self._arguments) not in (1, 2):
            node.log.error(f"{_USAGE}; got {' '.join(self._arguments)!r}")
            return 255
        file = Path(self._arguments[0])
        self._map = node.advertise("map", "nav_msgs/OccupancyGrid", latch=True, queue_size=1)
        self._metadata = node.advertise("map_metadata", "nav_msgs/MapMetaData", latch=True, queue_size=1)
        try:
            if len(self._arguments) == 2:
                node.log.warn(f"an image with a resolution is deprecated; {_USAGE}")
                await self._load(partial(_read_picture, file, self._arguments[1], settings))
            else:
                await self._load(partial(read_map, file))
        except (ParamError, UsageError) as error:
            node.log.error(str(error))
            return 255
        node.advertise_service("static_map", "nav_msgs/GetMap", self._get_map)
        node.advertise_service("change_map", "nav_msgs/LoadMap", self._change_map)
        await node.closed.wait()
        return 0

    async def _load(self, read: Callable[[], OccupancyGrid]) -> None:
        with self._node.loop.work.pending("the map"):
            grid = await asyncio.to_thread(read)
        stamp_ns = self._node.clock.now_ns()
        info = metadata_fields(grid, stamp_ns=stamp_ns)
        header = {"stamp": stamp_ns, "frame_id": self._frame}
        self._fields = {"header": header, "info": info, "data": grid.cells.reshape(-1)}
        height, width = grid.cells.shape
        self._node.log.info(f"Read a {width} X {height} map @ {grid.resolution_m:.3f} m/cell")
        self._metadata.publish(info)
        self._map.publish(self._fields)

    def _get_map(self, _request: "nav_msgs.GetMapRequest") -> dict[str, Any]:
        return {"map": self._fields}

    async def _change_map(self, request: "nav_msgs.LoadMapRequest") -> dict[str, Any]:
        file = Path(request.map_url.removeprefix("file://"))
        try:
            await self._load(partial(read_map, file))
        except UsageError as error:
            self._node.log.error(str(error))
            return {"result": _INVALID if os.path.exists(file) else _DOES_NOT_EXIST}
        return {"map": self._fields, "result": _SUCCESS}


def _read_picture(picture: Path, resolution: str, settings: RosParameters) -> OccupancyGrid:
    """Read an image of the deprecated command line, with thresholds from parameters; origin: lower left corner."""
    try:
        resolution_m = positive(float(resolution), picture)
    except ValueError:
        raise UsageError(f"map {picture}: resolution must be a number [m], got {resolution!r}") from None
    cells = read_cells(
        picture,
        negate=bool(settings.number("negate", 0.0)),
        occupied=settings.number("occupied_thresh", 0.65),
        free=settings.number("free_thresh", 0.196),
    )
    return OccupancyGrid(cells=cells, resolution_m=resolution_m, origin=(0.0, 0.0, 0.0))


def metadata_fields(grid: OccupancyGrid, *, stamp_ns: int) -> dict[str, object]:
    """Return the fields of a nav_msgs/MapMetaData."""
    x, y, yaw = grid.origin
    height, width = grid.cells.shape
    return {
        "map_load_time": stamp_ns,
        "resolution": grid.resolution_m,
        "width": width,
        "height": height,
        "origin": {
            "position": {"x": x, "y": y},
            "orientation": {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)},
        },
    }
