"""Transform of a node."""

import math

from trundle.spatial import Pose, Vector3

UNSCALED = (1.0, 1.0, 1.0)


def transform_fields(pose: Pose, scale: Vector3 = UNSCALED) -> dict[str, object]:
    """Return the transform of a node, without the parts that change nothing."""
    found: dict[str, object] = {}
    if any(pose.position):
        found["translation"] = list(pose.position)
    w, x, y, z = pose.quaternion
    if (length := math.hypot(w, x, y, z)) > 0.0 and (x, y, z) != (0.0, 0.0, 0.0):
        found["rotation"] = [x / length, y / length, z / length, w / length]
    if scale != UNSCALED:
        found["scale"] = list(scale)
    return found
