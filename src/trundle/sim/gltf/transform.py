"""Transform of a node."""

import math

from trundle.spatial import Pose, Vector3

UNSCALED = (1.0, 1.0, 1.0)


def transform_fields(pose: Pose, scale: Vector3 = UNSCALED) -> dict[str, object]:
    """Return the transform of a node, without identity parts."""
    fields: dict[str, object] = {}
    if any(pose.position):
        fields["translation"] = list(pose.position)
    w, x, y, z = pose.quaternion
    if (length := math.hypot(w, x, y, z)) > 0.0 and (x, y, z) != (0.0, 0.0, 0.0):
        fields["rotation"] = [x / length, y / length, z / length, w / length]
    if scale != UNSCALED:
        fields["scale"] = list(scale)
    return fields
