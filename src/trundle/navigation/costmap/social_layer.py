"""social_navigation_layers' ProxemicLayer and PassingLayer: costs around people."""

import math
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.gazebo.nodes.rate import LogThrottle
from trundle.ros import Node, TransformBuffer, TransformError, to_nsec
from trundle.spatial import NS_PER_S

from .costmap import NO_INFORMATION, Bounds, Costmap

if TYPE_CHECKING:
    from trundle.ros.message_types import people_msgs

_PASSING_SIDE = 1.51
"""Angle between a person's direction of motion and the side of PassingLayer's costs [rad], as in the original."""


class SocialSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the originals' defaults."""

    enabled: bool = True
    cutoff: Annotated[float, Meta(ge=0.0, le=255.0)] = 10.0
    """Least cost that is written."""
    amplitude: Annotated[float, Meta(ge=0.0, le=255.0)] = 77.0
    """Cost at a person's position."""
    covariance: Annotated[float, Meta(ge=0.0)] = 0.25
    """Variance of the costs around a person [m²]."""
    factor: Annotated[float, Meta(ge=0.0)] = 5.0
    """Growth of the variance along a person's direction of motion per speed [s/m]."""
    keep_time: Annotated[float, Meta(ge=0.0)] = 0.75
    """Time after which a message is too old [s]."""


class _Person(NamedTuple):
    """A person in the costmap's frame."""

    x: float
    """[m]"""
    y: float
    speed: float
    """[m/s]"""
    direction: float
    """[rad]"""


class SocialLayer:
    """Raises the costs around people_msgs/People on /people: by a Gaussian, longer in the direction of motion."""

    is_current = True

    def __init__(
        self, node: Node, name: str, settings: SocialSettings, *, frame: str, buffer: TransformBuffer, passes: bool
    ) -> None:
        """Subscribe.

        Args:
            node: node of the costmap.
            name: the layer's.
            settings: parameters.
            frame: frame of the costmap.
            buffer: transforms.
            passes: True: costs at one side of a person only, so that robots pass on the other side.
        """
        self.name = name
        self.options = settings
        self._node = node
        self._frame = frame
        self._buffer = buffer
        self._passes = passes
        self._message: people_msgs.People | None = None
        self._people: list[_Person] = []
        self._last = Bounds()
        self._warnings = LogThrottle(node, 5.0)
        node.subscribe("/people", "people_msgs/People", self._on_people, queue_size=1)

    def _on_people(self, message: "people_msgs.People") -> None:
        self._message = message

    @property
    def enabled(self) -> bool:
        """True if the layer takes part in updates."""
        return self.options.enabled

    def change(self) -> None:
        """See `Layer`."""

    def match_size(self) -> None:
        """See `Layer`."""

    def reset(self) -> None:
        """Forget the people."""
        self._message = None

    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """Extend the bounds to the areas around people, now and at the last update."""
        del robot
        self._people = self._read()
        now = Bounds()
        for person in self._people:
            reach = self._reach_m(self.options.covariance * (1.0 + self.options.factor * person.speed))
            place = np.array([[person.x, person.y]])
            now.touch(np.vstack([place - reach, place + reach]))
        bounds.join(self._last)
        bounds.join(now)
        self._last = now

    def _reach_m(self, variance: float) -> float:
        """Return the distance at which the costs are cut off."""
        cutoff, amplitude = self.options.cutoff, self.options.amplitude
        return math.sqrt(2.0 * variance * math.log(amplitude / cutoff)) if 0.0 < cutoff < amplitude else 0.0

    def _read(self) -> list[_Person]:
        """Return the people of the latest message in the costmap's frame."""
        message = self._message
        if message is None:
            return []
        stamp_ns = to_nsec(message.header.stamp)
        if self._node.clock.now_ns() - stamp_ns > self.options.keep_time * NS_PER_S:
            return []
        try:
            pose = self._buffer.lookup_transform(self._frame, message.header.frame_id.lstrip("/"), stamp_ns).pose
        except TransformError as error:
            self._warnings.warn(f"{self.name}: no transform to {self._frame}: {error}")
            return []
        people: list[_Person] = []
        for person in message.people:
            x, y, _ = pose.transform_point(_triple(person.position))
            vx, vy, _ = pose.transform_vector(_triple(person.velocity))
            if math.isfinite(x + y + vx + vy):
                people.append(_Person(x, y, math.hypot(vx, vy), math.atan2(vy, vx)))
        return people

    def update_costs(self, master: Costmap, window: tuple[int, int, int, int]) -> None:
        """Raise the known costs around each person."""
        x0, y0, x1, y1 = window
        for person in self._people:
            reach = self._reach_m(self.options.covariance * (1.0 + self.options.factor * person.speed))
            around = Bounds(person.x - reach, person.y - reach, person.x + reach, person.y + reach)
            left, low, right, high = around.window(master)
            left, low, right, high = max(left, x0), max(low, y0), min(right, x1), min(high, y1)
            if left >= right or low >= high:
                continue
            x, y = np.meshgrid(
                np.arange(left, right, dtype=np.float64) + 0.5, np.arange(low, high, dtype=np.float64) + 0.5
            )
            costs = self._costs(
                x * master.resolution_m + master.origin[0] - person.x,
                y * master.resolution_m + master.origin[1] - person.y,
                person,
            )
            target = master.cells[low:high, left:right]
            is_raised = (costs >= self.options.cutoff) & (target != NO_INFORMATION) & (costs > target)
            target[is_raised] = costs[is_raised].astype(np.uint8)

    def _costs(self, dx: NDArray[np.float64], dy: NDArray[np.float64], person: _Person) -> NDArray[np.float64]:
        """Return the costs at offsets from a person [m]."""
        direction = person.direction + (_PASSING_SIDE if self._passes else 0.0)
        along = dx * math.cos(direction) + dy * math.sin(direction)
        variance = max(self.options.covariance, 1e-6)
        longer = np.where(along > 0.0, variance * (1.0 + self.options.factor * person.speed), variance)
        squares = along**2 / longer + (dx**2 + dy**2 - along**2) / variance
        costs = self.options.amplitude * np.exp(-squares / 2.0)
        return np.where(along > 0.0, costs, 0.0) if self._passes else costs


def _triple(point: Any) -> tuple[float, float, float]:
    return float(point.x), float(point.y), float(point.z)
