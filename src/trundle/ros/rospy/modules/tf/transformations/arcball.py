"""Arcball: rotation with the mouse (Ken Shoemake, Arcball Rotation Control, Graphics Gems IV, 1994)."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .quaternions import quaternion_from_matrix, quaternion_matrix, quaternion_multiply, quaternion_slerp
from .vectors import _EPS, unit_vector, vector_norm

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .vectors import Array, Vector


class Arcball:
    """Virtual trackball: the mouse drags points of a sphere."""

    def __init__(self, initial: "ArrayLike | None" = None) -> None:
        """Start with no rotation, a quaternion, or a 4×4 matrix.

        Raises:
            ValueError: `initial` is neither.
        """
        self._center = [0.0, 0.0]
        self._radius = 1.0
        self._axes: list[Array] | None = None
        self._axis: Array | None = None
        self._constrain = False
        self._down_vector = np.array((0.0, 0.0, 1.0))
        if initial is None:
            start = np.array((0.0, 0.0, 0.0, 1.0))
        else:
            rotation = np.array(initial, dtype=np.float64)
            if rotation.shape == (4, 4):
                start = quaternion_from_matrix(rotation)
            elif rotation.shape == (4,):
                start = unit_vector(rotation)
            else:
                raise ValueError("initial rotation is neither a quaternion nor a 4x4 matrix")
        self._down = self._before = self._now = start

    def place(self, center: "Vector", radius: float) -> None:
        """Place the ball in the window.

        Args:
            center: [px].
            radius: [px].
        """
        self._center[0] = center[0]
        self._center[1] = center[1]
        self._radius = float(radius)

    def setaxes(self, *axes: "Vector | None") -> None:
        """Set the axes that may constrain dragging; None removes the constraint."""
        self._axes = None if axes[0] is None else [unit_vector(axis) for axis in axes if axis is not None]

    def setconstrain(self, constrain: bool) -> None:
        """Switch the constraint on or off."""
        self._constrain = constrain is True

    def getconstrain(self) -> bool:
        """True if the constraint is on."""
        return self._constrain

    def down(self, point: "Vector") -> None:
        """Press the button at a point [px]."""
        self._down_vector = arcball_map_to_sphere(point, self._center, self._radius)
        self._down = self._before = self._now
        self._axis = None
        if self._constrain and self._axes is not None:
            self._axis = arcball_nearest_axis(self._down_vector, self._axes)
            self._down_vector = arcball_constrain_to_axis(self._down_vector, self._axis)

    def drag(self, point: "Vector") -> None:
        """Drag to a point [px]."""
        vector = arcball_map_to_sphere(point, self._center, self._radius)
        if self._axis is not None:
            vector = arcball_constrain_to_axis(vector, self._axis)
        self._before = self._now
        axis = np.cross(self._down_vector, vector)
        if np.dot(axis, axis) < _EPS:
            self._now = self._down
        else:
            self._now = quaternion_multiply([*axis, np.dot(self._down_vector, vector)], self._down)

    def next(self, acceleration: float = 0.0) -> None:
        """Continue the rotation of the last drag."""
        following = quaternion_slerp(self._before, self._now, 2.0 + acceleration, False)
        self._before, self._now = self._now, following

    def matrix(self) -> "Array":
        """4×4 rotation."""
        return quaternion_matrix(self._now)


def arcball_map_to_sphere(point: "Vector", center: "Vector", radius: float) -> "Array":
    """Unit vector of a point in the window, whose y axis points down."""
    x, y = (point[0] - center[0]) / radius, (center[1] - point[1]) / radius
    square = x * x + y * y
    if square > 1.0:
        return np.array((x, y, 0.0)) / math.sqrt(square)
    return np.array((x, y, math.sqrt(1.0 - square)))


def arcball_constrain_to_axis(point: "Vector", axis: "Vector") -> "Array":
    """Nearest point of the great circle perpendicular to an axis."""
    on_plane = np.array(point, dtype=np.float64)
    normal = np.array(axis, dtype=np.float64)
    on_plane -= normal * np.dot(normal, on_plane)
    length = vector_norm(on_plane)
    if length > _EPS:
        return (-on_plane if on_plane[2] < 0.0 else on_plane) / length
    if normal[2] == 1.0:
        return np.array([1.0, 0.0, 0.0])
    return unit_vector([-normal[1], normal[0], 0.0])


def arcball_nearest_axis(point: "Vector", axes: "Sequence[Array]") -> "Array":
    """Axis whose great circle is nearest to a point of the sphere."""
    point = np.asarray(point, dtype=np.float64)
    return max(axes, key=lambda axis: np.dot(arcball_constrain_to_axis(point, axis), point))
