"""Bags of a robot that drives along x, for tests that compare them."""

import math
from pathlib import Path
from typing import Any

from trundle.ros import BagConnection, BagMessage, Messages, create_bag

MESSAGES = Messages()
TF = "tf2_msgs/TFMessage"


def write_drive(
    file: Path, *, speed: float, start_s: float = 100.0, seconds: float = 4.0, turn_s: float = math.inf, **more: str
) -> Path:
    """Write a drive at 20 Hz, with a wheel of 0.1 m radius and a scan of a wall at 3 m.

    Args:
        file: bag to write.
        speed: speed along x [m/s].
        start_s: time of the first message [s].
        seconds: duration [s].
        turn_s: time since the start from which on the wheel stands [s].
        more: names of further topics → their types; each has one empty message.
    """
    with create_bag(file) as bag:

        def write(topic: str, kind: str, time_s: float, fields: dict[str, Any]) -> None:
            stamp_ns = round(time_s * 1e9)
            connection = BagConnection(
                topic=topic,
                type=kind,
                md5sum=MESSAGES.md5(kind),
                definition=MESSAGES.definition(kind),
                latching=topic == "/tf_static",
            )
            data = MESSAGES.serialize(MESSAGES.new(kind, fields, now_ns=stamp_ns))
            bag.write(BagMessage(connection, stamp_ns, data))

        write("/tf_static", TF, start_s, {"transforms": [transform("base_link", "laser", z=0.3)]})
        for topic, kind in more.items():
            write(f"/{topic}", kind, start_s, {})
        for tick in range(round(seconds * 20) + 1):
            since = tick / 20
            time_s, x = start_s + since, speed * since
            write("/tf", TF, time_s, {"transforms": [transform("odom", "base_link", x=x)]})
            pose = {"pose": {"position": {"x": x}, "orientation": {"w": 1.0}}}
            odometry = {"header": {"stamp": "now"}, "pose": pose, "twist": {"twist": {"linear": {"x": speed}}}}
            write("/odom", "nav_msgs/Odometry", time_s, odometry)
            joints = {"name": ["left", "right"], "position": [10 * speed * min(since, turn_s), 10 * x]}
            write("/joint_states", "sensor_msgs/JointState", time_s, {"header": {"stamp": "now"}, **joints})
            if tick % 2 == 0:
                scan = {"header": {"stamp": "now", "frame_id": "laser"}, "ranges": [3.0 - x] * 30 + [math.inf]}
                write("/scan", "sensor_msgs/LaserScan", time_s, scan)
    return file


def transform(parent: str, child: str, *, x: float = 0.0, z: float = 0.0) -> dict[str, Any]:
    """Return a transform stamped now."""
    moved = {"translation": {"x": x, "z": z}, "rotation": {"w": 1.0}}
    return {"header": {"stamp": "now", "frame_id": parent}, "child_frame_id": child, "transform": moved}
