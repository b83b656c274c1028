"""costmap_2d::Costmap2DROS: a costmap that follows the robot, with its topics and parameters."""

import math
from collections.abc import Sequence
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.gazebo.nodes.rate import LogThrottle, Rate
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, TransformBuffer, TransformError
from trundle.spatial import NS_PER_S

from ..settings import read_settings, reconfigure
from .costmap import MAX_CELLS, Costmap
from .footprint import placed, radii, read_footprint
from .layer_plugins import LayerMaker, plugin_list
from .layered_costmap import Layer, LayeredCostmap
from .publisher import CostmapPublisher
from .static_layer import StaticLayer

_POLL_S = 0.1
_WARNING_S = 5.0


class CostmapSettings(msgspec.Struct, kw_only=True):
    """Parameters that dynamic_reconfigure changes, with the original's defaults."""

    transform_tolerance: Annotated[float, Meta(ge=0.0, le=10.0)] = 0.3
    """Greatest age of the robot's pose [s]."""
    update_frequency: Annotated[float, Meta(ge=0.0, le=100.0)] = 5.0
    publish_frequency: Annotated[float, Meta(ge=0.0, le=100.0)] = 0.0
    width: Annotated[float, Meta(ge=0.0)] = 10.0
    height: Annotated[float, Meta(ge=0.0)] = 10.0
    resolution: Annotated[float, Meta(ge=0.0, le=50.0)] = 0.05
    origin_x: float = 0.0
    origin_y: float = 0.0
    footprint: str = "[]"
    robot_radius: Annotated[float, Meta(ge=0.0, le=10.0)] = 0.46
    footprint_padding: float = 0.01


class CostmapRos:
    """Updates, publishes and clears one costmap of a node.

    Parameters, with the original's defaults: global_frame map, robot_base_frame base_link, rolling_window false,
    track_unknown_space false, always_send_full_costmap false, plugins, footprint, and those of `CostmapSettings`.
    """

    def __init__(self, node: Node, name: str, root: RosParameters, buffer: TransformBuffer) -> None:
        """Read the parameters of `~name`, and make the layers.

        Raises:
            ParamError: a parameter is invalid.
        """
        section = root.section(name)
        self.name = name
        self._node = node
        self._buffer = buffer
        self.frame = section.text("global_frame", "map").lstrip("/")
        self.base = section.text("robot_base_frame", "base_link").lstrip("/")
        self.settings = settings = _read(section)
        is_rolling = section.flag("rolling_window", default=False)
        tracks_unknown = section.flag("track_unknown_space", default=False)
        columns = math.ceil(settings.width / settings.resolution - 1e-6)
        rows = math.ceil(settings.height / settings.resolution - 1e-6)
        if columns * rows > MAX_CELLS:
            raise ParamError(f"{section.namespace}: {columns} x {rows} cells exceed the limit of {MAX_CELLS}")
        grid = Costmap(columns, rows, settings.resolution, (settings.origin_x, settings.origin_y))
        self._layered = LayeredCostmap(grid, is_rolling=is_rolling, tracks_unknown=tracks_unknown)
        maker = LayerMaker(node, section, root, grid, buffer, frame=self.frame, is_rolling=is_rolling)
        layers: list[Layer] = []
        for layer_name, kind, parameters in plugin_list(node, section):
            node.log.info(f'{name}: Using plugin "{layer_name}"')
            layer = maker.make(layer_name, kind, parameters)
            layers += [] if layer is None else [layer]
        self._layered.layers = layers
        self._static = next((layer for layer in self._layered.layers if isinstance(layer, StaticLayer)), None)
        self._set_footprint(read_footprint(section, settings.robot_radius, settings.footprint_padding))
        self._warnings = LogThrottle(node, _WARNING_S)
        self.is_updated = False
        """True once the costs have been computed."""
        always_full = section.flag("always_send_full_costmap", default=False)
        self._publisher = CostmapPublisher(node, f"~{name}/costmap", self.frame, always_full=always_full)
        polygon = "geometry_msgs/PolygonStamped"
        self._footprints = node.advertise(f"~{name}/footprint", polygon, latch=True, queue_size=1)
        self._serve_parameters()

    def _serve_parameters(self) -> None:
        node, space = self._node, f"{self._node.name}/{self.name}"
        reconfigure(node, space, self.settings, self._on_settings)
        for layer in self._layered.layers:
            reconfigure(node, f"{space}/{layer.name}", layer.options, layer.change)

    def _on_settings(self) -> None:
        """Take a footprint set at run time; width, height and resolution keep their first values."""
        try:
            value = RosParameters({"footprint": self.settings.footprint}, f"{self._node.name}/{self.name}")
            self._set_footprint(read_footprint(value, self.settings.robot_radius, self.settings.footprint_padding))
        except ParamError as error:
            self._node.log.error(str(error))

    def _set_footprint(self, points: NDArray[np.float64]) -> None:
        self.footprint = points
        """Padded outline (n, 2) of the robot in its frame [m]."""
        self.inscribed_m, self.circumscribed_m = radii(points)
        self._layered.set_footprint(points)

    @property
    def costmap(self) -> Costmap:
        """The grid of costs."""
        return self._layered.costmap

    @property
    def layers(self) -> Sequence[Layer]:
        """The layers, the first one at the bottom."""
        return self._layered.layers

    def match_size(self) -> None:
        """Give the layers the costmap's size."""
        self._layered.match_size()

    @property
    def is_current(self) -> bool:
        """True if the sensors' data are recent enough to drive."""
        return self._layered.is_current

    async def start(self) -> None:
        """Wait for the robot's transform and the map, then update until the node is closed."""
        await self._wait_for_transform()
        if self._static is not None:
            self._node.log.info("Requesting the map...")
            while self._static.map is None and not self._node.closed.is_set():
                await self._node.clock.sleep(_POLL_S)
        self._layered.match_size()
        self._node.loop.spawn(self._update_loop())

    async def _wait_for_transform(self) -> None:
        while not self._node.closed.is_set():
            try:
                self._buffer.lookup_transform(self.frame, self.base)
                return
            except TransformError as error:
                self._warnings.warn(
                    f"Timed out waiting for transform from {self.base} to {self.frame} to become available before "
                    f"running costmap, tf error: {error}"
                )
            await self._node.clock.sleep(_POLL_S)

    async def _update_loop(self) -> None:
        node, settings = self._node, self.settings
        published_ns = 0
        while not node.closed.is_set():
            if settings.update_frequency <= 0.0:
                await node.clock.sleep(_POLL_S)
                continue
            rate = Rate(node, settings.update_frequency)
            frequency = settings.update_frequency
            while not node.closed.is_set() and settings.update_frequency == frequency:
                self.update()
                now_ns = node.clock.now_ns()
                if settings.publish_frequency > 0.0 and self.is_updated:
                    period_ns = NS_PER_S / settings.publish_frequency
                    if now_ns < published_ns or now_ns - published_ns >= period_ns - 1e-6 * NS_PER_S:
                        self._publisher.publish(self.costmap)
                        published_ns = now_ns
                await rate.sleep()

    def update(self) -> None:
        """Update the costs now, if the robot's pose is known."""
        pose = self.robot_pose()
        if pose is None:
            return
        if self._static is not None and not self._static.fits:
            self._layered.match_size()
        self._layered.update(pose)
        self.is_updated = True
        self._publisher.change(self._layered.changed)
        if self._footprints.has_subscribers:
            points = [{"x": x, "y": y} for x, y in placed(self.footprint, *pose).tolist()]
            header = {"stamp": self._node.clock.now_ns(), "frame_id": self.frame}
            self._footprints.publish({"header": header, "polygon": {"points": points}})

    def robot_pose(self) -> tuple[float, float, float] | None:
        """Return the robot's x, y [m] and yaw [rad] in the costmap's frame; None if it is unknown or too old."""
        try:
            transform = self._buffer.lookup_transform(self.frame, self.base)
        except TransformError as error:
            self._warnings.warn(f"Could not get robot pose: {error}")
            return None
        age_s = (self._node.clock.now_ns() - transform.stamp_ns) / NS_PER_S
        if transform.stamp_ns and age_s > self.settings.transform_tolerance:
            self._warnings.warn(
                f"Costmap2DROS transform timeout. The pose is {age_s:.4f} s old, "
                f"tolerance {self.settings.transform_tolerance:.4f}"
            )
            return None
        x, y, _ = transform.pose.position
        return x, y, transform.pose.rpy[2]

    def reset(self) -> None:
        """Forget what sensors saw, and compute the costs again."""
        self._layered.reset()
        self.update()

    def clear_outside(self, size_m: float, layers: list[str], *, invert: bool) -> None:
        """Forget the layers' obstacles outside a square around the robot [m]; with `invert`, those inside it."""
        pose = self.robot_pose()
        if pose is not None:
            self._layered.clear_outside(pose[0], pose[1], size_m, layers, invert=invert)
            self.update()


def _read(section: RosParameters) -> CostmapSettings:
    """Read the settings except `footprint`, which may be a list: see `read_footprint`."""
    defaults = CostmapSettings()
    numbers = [name for name in CostmapSettings.__struct_fields__ if name != "footprint"]
    tree = {name: section.number(name, getattr(defaults, name)) for name in numbers}
    settings = read_settings(CostmapSettings, RosParameters(tree, section.namespace))
    if not settings.resolution > 0.0 or not settings.width > 0.0 or not settings.height > 0.0:
        raise ParamError(f"{section.namespace}: resolution, width and height must be > 0 m")
    return settings
