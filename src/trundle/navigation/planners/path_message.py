"""Plans as nav_msgs/Path."""

import math
from typing import Any

from .interfaces import Plan


def path_message(plan: Plan, stamp_ns: int) -> dict[str, Any]:
    """Return the fields of a nav_msgs/Path."""
    header = {"stamp": stamp_ns, "frame_id": plan.frame}
    poses = [
        {
            "header": header,
            "pose": {
                "position": {"x": x, "y": y},
                "orientation": {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)},
            },
        }
        for x, y, yaw in plan.poses.tolist()
    ]
    return {"header": header, "poses": poses}
