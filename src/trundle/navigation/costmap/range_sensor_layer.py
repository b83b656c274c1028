"""range_sensor_layer::RangeSensorLayer: obstacles that sonars and infrared sensors see, by probabilities."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.gazebo.nodes.rate import LogThrottle
from trundle.ros import Node, TransformBuffer, TransformError, to_nsec
from trundle.spatial import NS_PER_S

from .costmap import FREE_SPACE, LETHAL, NO_INFORMATION, Bounds, Costmap

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_Share = Annotated[float, Meta(ge=0.0, le=1.0)]
_KEPT = 100
"""Maximum number of readings between two updates; older ones are dropped."""
_EVEN = 0.5
"""Probability of an obstacle in cells without a reading."""
_HIT = 233
"""Probability by LETHAL that the cell at a reading's range gets before the cone is computed."""
_WIDER = 1.2
"""Ratio of the length of the cone's sides to the range."""


class RangeSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    enabled: bool = True
    phi: Annotated[float, Meta(ge=0.0)] = 1.2
    """Distance from the sensor beyond which readings count little [m]."""
    inflate_cone: _Share = 1.0
    """Share of the area beside the cone's triangle that a reading changes, too."""
    no_readings_timeout: Annotated[float, Meta(ge=0.0)] = 0.0
    """Longest time without a reading [s]; 0: unlimited."""
    clear_threshold: _Share = 0.2
    mark_threshold: _Share = 0.8
    clear_on_max_reading: bool = False


class RangeSensorLayer:
    """Keeps the probability of an obstacle in each cell, and changes it along the cone of each sensor_msgs/Range."""

    def __init__(
        self,
        node: Node,
        name: str,
        master: Costmap,
        settings: RangeSettings,
        topics: Sequence[str],
        *,
        kind: str,
        frame: str,
        buffer: TransformBuffer,
        is_rolling: bool,
    ) -> None:
        """Subscribe.

        Args:
            node: node of the costmap.
            name: the layer's.
            master: the costmap.
            settings: parameters.
            topics: topics of the readings.
            kind: VARIABLE for sensors that measure a range, FIXED for those that only detect, ALL for both.
            frame: frame of the costmap.
            buffer: transforms.
            is_rolling: True for a rolling window.
        """
        self.name = name
        self.options = settings
        self._node = node
        self._master = master
        self._kind = kind
        self._frame = frame
        self._buffer = buffer
        self._is_rolling = is_rolling
        self._odds = Costmap(*master.geometry, int(LETHAL * _EVEN))
        """Probabilities of obstacles, multiplied by LETHAL."""
        self._waiting: list[sensor_msgs.Range] = []
        self._read_ns = node.clock.now_ns()
        self._seen = Bounds()
        self._warnings = LogThrottle(node, 2.0)
        for topic in topics:
            node.subscribe(topic, "sensor_msgs/Range", self._on_range, queue_size=_KEPT)

    def _on_range(self, message: "sensor_msgs.Range") -> None:
        self._waiting = [*self._waiting[1 - _KEPT :], message]
        self._read_ns = self._node.clock.now_ns()

    @property
    def enabled(self) -> bool:
        """True if the layer takes part in updates."""
        return self.options.enabled

    @property
    def is_current(self) -> bool:
        """True if a reading came within the timeout."""
        timeout_s = self.options.no_readings_timeout
        return timeout_s <= 0.0 or self._node.clock.now_ns() - self._read_ns <= timeout_s * NS_PER_S

    def change(self) -> None:
        """See `Layer`."""

    def match_size(self) -> None:
        """Take the costmap's size; forgets obstacles."""
        odds = self._odds
        odds.width, odds.height, odds.resolution_m, odds.origin = self._master.geometry
        odds.clear()

    def reset(self) -> None:
        """Forget obstacles."""
        self._waiting.clear()
        self._odds.clear()
        self._seen.touch_all(self._odds)

    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """Count the readings since the last update."""
        del robot
        if self._is_rolling:
            self._odds.shift_to(*self._master.origin)
        waiting, self._waiting = self._waiting, []
        for reading in waiting:
            range_m = self._range_m(reading)
            if range_m is not None:
                self._count(reading, range_m)
        bounds.join(self._seen)
        self._seen = Bounds()

    def _range_m(self, reading: "sensor_msgs.Range") -> float | None:
        """Return the range to use [m]; infinite: nothing up to the maximum range; None: the reading is left out."""
        low, high, range_m = float(reading.min_range), float(reading.max_range), float(reading.range)
        clears = self.options.clear_on_max_reading
        if self._kind == "FIXED" or (self._kind == "ALL" and low == high):
            if math.isfinite(range_m):
                frame = reading.header.frame_id
                self._warnings.warn(f"{frame}: {range_m:g} m is left out; its range is fixed: -Inf or Inf is expected")
                return None
            return low if range_m < 0.0 else math.inf if clears else None
        if not low <= range_m <= high:
            return None
        return math.inf if range_m >= high and clears else range_m

    def _count(self, reading: "sensor_msgs.Range", range_m: float) -> None:
        try:
            transform = self._buffer.lookup_transform(
                self._frame, reading.header.frame_id.lstrip("/"), to_nsec(reading.header.stamp)
            )
        except TransformError as error:
            self._warnings.warn(f"{self.name}: no transform to {self._frame}: {error}")
            return
        length_m = range_m if math.isfinite(range_m) else float(reading.max_range)
        origin = np.array(transform.pose.position[:2])
        end = np.array(transform.pose.transform_point((length_m, 0.0, 0.0))[:2])
        half_angle = float(reading.field_of_view) / 2.0
        if not (np.isfinite(end).all() and 0.0 < half_angle < math.pi):
            return
        offset = end - origin
        direction, reach = math.atan2(offset[1], offset[0]), _WIDER * float(np.hypot(*offset))
        angles = direction + np.array([-half_angle, half_angle])
        corners = origin + reach * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        cell = self._odds.cell(*end.tolist()) if math.isfinite(range_m) else None
        if cell is not None:
            self._odds.cells[cell[1], cell[0]] = _HIT
        cone = Bounds()
        cone.touch(np.vstack([origin[None], end[None], corners]))
        self._seen.join(cone)
        x0, y0, x1, y1 = cone.window(self._odds)
        if x0 >= x1 or y0 >= y1:
            return
        x, y = np.meshgrid(*(np.arange(low, high, dtype=np.float64) + 0.5 for low, high in ((x0, x1), (y0, y1))))
        points = np.stack([x, y], axis=-1) * self._odds.resolution_m + np.array(self._odds.origin)
        seen = self._sensor_model(points - origin, direction, half_angle, range_m)
        prior = self._odds.cells[y0:y1, x0:x1] / LETHAL
        occupied, free = seen * prior, (1.0 - seen) * (1.0 - prior)
        odds = np.divide(occupied, occupied + free, out=prior, where=occupied + free > 0.0)
        is_changed = self._is_in_cone(points, np.vstack([corners, origin[None]]))
        self._odds.cells[y0:y1, x0:x1][is_changed] = (LETHAL * odds[is_changed]).astype(np.uint8)

    def _sensor_model(
        self, offsets: NDArray[np.float64], direction: float, half_angle: float, range_m: float
    ) -> NDArray[np.float64]:
        """Return the probability of an obstacle at offsets from the sensor for a range; 0 for an infinite one.

        Cells in the cone before the range are likely free, cells at the range likely occupied; the certainty falls
        toward the cone's sides and with the distance.
        """
        distances = np.hypot(offsets[..., 0], offsets[..., 1])
        if not math.isfinite(range_m):
            return np.zeros_like(distances)
        angles = np.remainder(np.arctan2(offsets[..., 1], offsets[..., 0]) - direction + math.pi, math.tau) - math.pi
        across = np.where(np.abs(angles) > half_angle, 0.0, 1.0 - (angles / half_angle) ** 2)
        weight = across * (1.0 - (1.0 + np.tanh(2.0 * (distances - self.options.phi))) / 2.0)
        width = max(self._odds.resolution_m * range_m, 1e-9)
        place = (distances - range_m) / width
        before = (1.0 - weight) * _EVEN
        rising = weight * _EVEN * (place + 2.0) ** 2 + before
        at = weight * (_EVEN - 0.5 * place**2) + _EVEN
        return np.select([place < -2.0, place < -1.0, place < 1.0], [before, rising, at], _EVEN)

    def _is_in_cone(self, points: NDArray[np.float64], triangle: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return True for points in a triangle, or within the share `inflate_cone` beside it."""
        if self.options.inflate_cone >= 1.0:
            return np.ones(points.shape[:2], dtype=bool)
        following = np.roll(triangle, -1, axis=0)
        edges = following - triangle
        sides = [
            edge[0] * (points[..., 1] - corner[1]) - edge[1] * (points[..., 0] - corner[0])
            for corner, edge in zip(triangle, edges, strict=True)
        ]
        area = edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0]
        least = -self.options.inflate_cone * abs(area)
        return np.all([math.copysign(1.0, area) * side >= least for side in sides], axis=0)

    def update_costs(self, master: Costmap, window: tuple[int, int, int, int]) -> None:
        """Mark cells above mark_threshold, and free those below clear_threshold."""
        x0, y0, x1, y1 = window
        odds, target = self._odds.cells[y0:y1, x0:x1], master.cells[y0:y1, x0:x1]
        is_occupied = odds > int(LETHAL * self.options.mark_threshold)
        is_free = odds < int(LETHAL * self.options.clear_threshold)
        target[is_free & (target == NO_INFORMATION)] = FREE_SPACE
        target[is_occupied & ((target == NO_INFORMATION) | (target < LETHAL))] = LETHAL
