"""Detections of bounding box cameras as vision_msgs, without headers."""

from trundle.sim.sensors import CameraReading, DetectedBox
from trundle.spatial import Pose, quaternion_from_rpy

_HALF_TURN = 1.5707963267948966
_OPTICAL_FROM_CAMERA = Pose(quaternion=quaternion_from_rpy(-_HALF_TURN, 0.0, -_HALF_TURN)).inverse()


def boxes_2d(reading: CameraReading) -> dict[str, object]:
    """vision_msgs/Detection2DArray, in the image [px]."""
    return {"detections": [_detection_2d(box, reading.time_ns) for box in reading.boxes or ()]}


def boxes_3d(reading: CameraReading) -> dict[str, object]:
    """vision_msgs/Detection3DArray, in the optical frame [m]."""
    return {"detections": [_detection_3d(box, reading.time_ns) for box in reading.boxes or ()]}


def _detection_2d(box: DetectedBox, time_ns: int) -> dict[str, object]:
    return {
        "header": {"stamp": time_ns},
        "results": [{"id": box.label, "score": 1.0}],
        "bbox": {
            "center": {"x": box.center[0], "y": box.center[1]},
            "size_x": box.size[0],
            "size_y": box.size[1],
        },
    }


def _detection_3d(box: DetectedBox, time_ns: int) -> dict[str, object]:
    pose = _OPTICAL_FROM_CAMERA @ box.camera_from_box
    qw, qx, qy, qz = pose.quaternion
    pose_fields = {
        "position": dict(zip("xyz", pose.position, strict=True)),
        "orientation": {"x": qx, "y": qy, "z": qz, "w": qw},
    }
    return {
        "header": {"stamp": time_ns},
        "results": [{"id": box.label, "score": 1.0, "pose": {"pose": pose_fields}}],
        "bbox": {"center": pose_fields, "size": dict(zip("xyz", box.size, strict=True))},
    }
