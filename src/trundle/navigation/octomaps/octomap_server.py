"""octomap_server: cubes in space from clouds, projected to a map of the ground."""

import asyncio
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.pointcloud_to_laserscan import read_points
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, Publisher, TransformError, to_nsec
from trundle.spatial import Pose, transform_points

from ..scan_queue import ScanQueue
from ..settings import read_settings
from ..transform_filter import TransformFilter
from .ground import is_ground
from .octomap_file import load_octomap, read_resolution
from .octomap_messages import cloud_fields, map_fields, marker_fields, octomap_fields, read_cubes
from .octomap_settings import WITHOUT_EFFECT, Color, OctomapSettings, read_ground_filter, read_tree

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_QUEUE = 5
_USAGE = "usage: octomap_server_node [FILE.bt|FILE.ot]"
_CLOUD = "sensor_msgs/PointCloud2"
_MARKERS = "visualization_msgs/MarkerArray"
_OCTOMAP = "octomap_msgs/Octomap"


class OctomapServer:
    """Enters the points of `cloud_in` into an octomap, and publishes it after each cloud.

    Parameters, with the original's names: `OctomapSettings`; sensor_model/hit, miss, min, max, max_range;
    ground_filter/distance, angle, plane_distance; color/r, g, b, a and color_free/…. Topics: octomap_binary,
    octomap_full, projected_map, occupied_cells_vis_array, free_cells_vis_array, octomap_point_cloud_centers; each is
    made where somebody listens, and once as the node begins; a map without cells is not published. Services:
    octomap_binary, octomap_full, ~clear_bbx, ~reset. A file of octomap is loaded.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments
        self._warnings = LogThrottle(node, 5.0)
        self._busy = asyncio.Lock()

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        if len(self._arguments) > 1:
            node.log.error(f"{_USAGE}; got {' '.join(self._arguments)!r}")
            return 1
        try:
            await self._set_up(await private_parameters(node))
        except (ParamError, UsageError) as error:
            node.log.fatal(str(error))
            return 1
        self._advertise()
        await self._publish(node.clock.now_ns(), everything=self._settings.latch)
        async with asyncio.TaskGroup() as tasks:
            entering = self._receive(tasks)
            await node.closed.wait()
            if entering is not None:
                entering.cancel()
        return 0

    async def _set_up(self, parameters: RosParameters) -> None:
        self._settings = settings = read_settings(OctomapSettings, parameters)
        file = Path(self._arguments[0]) if self._arguments else None
        resolution = settings.resolution if file is None else read_resolution(file)
        self._tree, self._max_range = read_tree(parameters, resolution)
        self._ground = read_ground_filter(parameters)
        self._color = Color.read(parameters.section("color"), Color(0.0, 0.0, 1.0, 1.0))
        self._free_color = Color.read(parameters.section("color_free"), Color(0.0, 1.0, 0.0, 1.0))
        if unused := [name for name in WITHOUT_EFFECT if name in parameters]:
            self._node.log.warn(f"{parameters.namespace}: parameters without effect: {', '.join(unused)}")
        if file is not None:
            await asyncio.to_thread(load_octomap, file, self._tree)
            self._node.log.info(f"Octomap file {file} loaded ({len(self._tree.leaves(occupied=True))} occupied cubes)")

    def _advertise(self) -> None:
        node, latch = self._node, self._settings.latch

        def publisher(topic: str, kind: str) -> Publisher:
            return node.advertise(topic, kind, latch=latch, queue_size=1)

        self._binary, self._full = publisher("octomap_binary", _OCTOMAP), publisher("octomap_full", _OCTOMAP)
        self._map = publisher("projected_map", "nav_msgs/OccupancyGrid")
        self._occupied = publisher("occupied_cells_vis_array", _MARKERS)
        self._free = publisher("free_cells_vis_array", _MARKERS)
        self._centers = publisher("octomap_point_cloud_centers", _CLOUD)
        node.advertise_service("octomap_binary", "octomap_msgs/GetOctomap", self._get_binary)
        node.advertise_service("octomap_full", "octomap_msgs/GetOctomap", self._get_full)
        node.advertise_service("~clear_bbx", "octomap_msgs/BoundingBoxQuery", self._clear_box)
        node.advertise_service("~reset", "std_srvs/Empty", self._reset)

    def _receive(self, tasks: asyncio.TaskGroup) -> asyncio.Task[None] | None:
        """Enter clouds in their order."""
        queue = ScanQueue(self._node, self._enter, size=_QUEUE)
        self._held = TransformFilter(self._node, self._frame, queue.add, queue_size=_QUEUE)
        self._node.subscribe("cloud_in", _CLOUD, self._held.add, queue_size=_QUEUE)
        return tasks.create_task(queue.run())

    @property
    def _frame(self) -> str:
        return self._settings.frame_id.lstrip("/")

    # -- clouds

    async def _enter(self, cloud: Any) -> None:
        stamp_ns = to_nsec(cloud.header.stamp)
        try:
            sensor, hits, floor = self._split(cloud, stamp_ns)
        except (TransformError, ValueError) as error:
            self._warnings.warn(f"a cloud is left out: {error}")
            return
        async with self._busy:
            is_whole = await asyncio.to_thread(self._tree.insert, sensor, hits, floor, max_range=self._max_range)
        if not is_whole:
            self._warnings.warn("the octomap is full: new cubes are left out; is the resolution too fine?")
        await self._publish(stamp_ns, everything=False)

    def _split(
        self, cloud: "sensor_msgs.PointCloud2", stamp_ns: int
    ) -> tuple[tuple[float, float, float], NDArray[np.float64], NDArray[np.float64]]:
        """Return the sensor's position, and the points (n, 3) of obstacles and of the floor, in the map's frame [m]."""
        settings, frame, buffer = self._settings, cloud.header.frame_id.lstrip("/"), self._held.buffer
        map_from_sensor = buffer.lookup_transform(self._frame, frame, stamp_ns).pose
        points = read_points(cloud)
        points = points[np.isfinite(points).all(axis=1)]
        map_from_base = Pose()
        if settings.filter_ground:
            base = settings.base_frame_id.lstrip("/")
            points = transform_points(buffer.lookup_transform(base, frame, stamp_ns).pose, points)
            map_from_base = buffer.lookup_transform(self._frame, base, stamp_ns).pose
        else:
            points = transform_points(map_from_sensor, points)
        low = (settings.pointcloud_min_x, settings.pointcloud_min_y, settings.pointcloud_min_z)
        high = (settings.pointcloud_max_x, settings.pointcloud_max_y, settings.pointcloud_max_z)
        points = points[((points >= low) & (points <= high)).all(axis=1)]
        floor = is_ground(points, self._ground) if settings.filter_ground else np.zeros(len(points), dtype=bool)
        if settings.filter_ground:
            points = transform_points(map_from_base, points)
        return map_from_sensor.position, np.ascontiguousarray(points[~floor]), np.ascontiguousarray(points[floor])

    # -- results

    async def _publish(self, stamp_ns: int, *, everything: bool) -> None:
        """Publish what somebody listens to, or everything; made beside the graph's thread."""
        async with self._busy:
            messages, fault = await asyncio.to_thread(self._messages, stamp_ns, everything)
        if fault:
            self._warnings.warn(fault)
        for publisher, fields in messages:
            publisher.publish(fields)

    def _messages(self, stamp_ns: int, everything: bool) -> tuple[list[tuple[Publisher, dict[str, Any]]], str]:
        """Return what is published, and why the map is not."""
        tree, settings = self._tree, self._settings
        header = {"stamp": stamp_ns, "frame_id": self._frame}
        heights = (settings.occupancy_min_z, settings.occupancy_max_z)
        wanted: dict[Publisher, bool] = {
            publisher: everything or publisher.has_subscribers
            for publisher in (self._binary, self._full, self._map, self._occupied, self._free, self._centers)
        }
        found: list[tuple[Publisher, dict[str, Any]]] = []
        fault = ""
        if wanted[self._binary]:
            found.append((self._binary, octomap_fields(tree, header, binary=True)))
        if wanted[self._full]:
            found.append((self._full, octomap_fields(tree, header, binary=False)))
        if wanted[self._map]:
            try:
                grid = map_fields(tree, header, heights, (settings.min_x_size, settings.min_y_size))
            except ValueError as error:
                fault = f"the octomap has no {self._map.topic}: {error}"
            else:
                if len(grid["data"]):
                    found.append((self._map, grid))
        if wanted[self._occupied] or wanted[self._centers]:
            cubes = read_cubes(tree, occupied=True, low=heights[0], high=heights[1])
            factor = settings.color_factor if settings.height_map else None
            markers = marker_fields(cubes, tree.resolution, header, self._color, height_factor=factor)
            found += [(self._occupied, markers), (self._centers, cloud_fields(cubes, header))]
        if settings.publish_free_space and wanted[self._free]:
            cubes = read_cubes(tree, occupied=False, low=heights[0], high=heights[1])
            found.append(
                (self._free, marker_fields(cubes, tree.resolution, header, self._free_color, height_factor=None))
            )
        return found, fault

    # -- services

    async def _octomap(self, *, binary: bool) -> dict[str, Any]:
        header = {"stamp": self._node.clock.now_ns(), "frame_id": self._frame}
        async with self._busy:
            return {"map": await asyncio.to_thread(octomap_fields, self._tree, header, binary=binary)}

    async def _get_binary(self, _request: object) -> dict[str, Any]:
        return await self._octomap(binary=True)

    async def _get_full(self, _request: object) -> dict[str, Any]:
        return await self._octomap(binary=False)

    async def _clear_box(self, request: Any) -> dict[str, Any]:
        low, high = ((corner.x, corner.y, corner.z) for corner in (request.min, request.max))
        async with self._busy:
            await asyncio.to_thread(self._tree.clear_box, low, high)
        await self._publish(self._node.clock.now_ns(), everything=False)
        return {}

    async def _reset(self, _request: object) -> dict[str, Any]:
        async with self._busy:
            self._tree.reset()
        self._node.log.info("Cleared octomap")
        await self._publish(self._node.clock.now_ns(), everything=False)
        return {}


class OctomapServerStatic(OctomapServer):
    """octomap_server_static: serves the octomap of a file, and receives no clouds."""

    async def run(self) -> int:
        """Serve until cancelled."""
        if not self._arguments:
            self._node.log.error("usage: octomap_server_static FILE.bt|FILE.ot")
            return 1
        return await super().run()

    def _receive(self, tasks: asyncio.TaskGroup) -> None:
        """The file is all there is."""
