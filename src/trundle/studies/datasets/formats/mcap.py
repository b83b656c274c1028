"""MCAP shards with ROS 1 messages of a camera and a detector.

`trundle play`, Foxglove and rosbag tools read them; `/record` has each picture's whole record as JSON.
"""

from io import BytesIO
from pathlib import Path

import numpy as np
from msgspec import json
from PIL import Image

from trundle.ros import BagConnection, BagMessage, Messages, replaced_bag
from trundle.spatial import pose_from_row

from ..annotation import Numbers, ObjectAnnotation, PictureAnnotation
from ..dataset_folder import picture_path
from ..plan import DatasetPlan
from .format import DatasetFormat, ReadAll
from .shards import missing_shards

_PERIOD_NS = 100_000_000
_FRAME, _WORLD = "camera_optical", "world"
_CENTRE = 0.5
"""ROS' pixel coordinates start at the centre of the first pixel."""


class McapFormat(DatasetFormat):
    """Writer of `mcap/`."""

    def finish(self, plan: DatasetPlan, folder: Path, read: ReadAll) -> None:
        """Write the missing shards."""
        messages = _Encoder(plan.categories)
        for path, pictures in missing_shards(plan, folder / "mcap", "mcap", read):
            with replaced_bag(path, compression="lz4") as bag:
                for picture in pictures:
                    for message in messages.encode(folder, picture):
                        bag.write(message)


class _Encoder:
    def __init__(self, categories: tuple[str, ...]) -> None:
        self._messages = Messages()
        self._connections: dict[str, BagConnection] = {}
        self._categories = categories

    def encode(self, folder: Path, picture: PictureAnnotation) -> list[BagMessage]:
        """Return the messages of a picture."""
        stamp = (picture.number + 1) * _PERIOD_NS
        header: dict[str, object] = {"stamp": stamp, "frame_id": _FRAME, "seq": picture.number}

        def message(topic: str, kind: str, fields: dict[str, object]) -> BagMessage:
            if topic not in self._connections:
                self._connections[topic] = BagConnection(
                    topic=topic,
                    type=kind,
                    md5sum=self._messages.md5(kind),
                    definition=self._messages.definition(kind),
                )
            data = self._messages.serialize(self._messages.new(kind, fields))
            return BagMessage(self._connections[topic], stamp, data)

        image = (folder / picture_path("images", picture.number)).read_bytes()
        return [
            message("/tf", "tf2_msgs/TFMessage", {"transforms": [_transform(picture, stamp)]}),
            message("/camera/camera_info", "sensor_msgs/CameraInfo", {"header": header} | _camera_info(picture)),
            message(
                "/camera/image/compressed",
                "sensor_msgs/CompressedImage",
                {"header": header, "format": "rgb8; png compressed bgr8", "data": np.frombuffer(image, np.uint8)},
            ),
            *(
                message(f"/camera/{kind}", "sensor_msgs/Image", {"header": header} | _image(folder, kind, picture))
                for kind in ("depth", "segmentation")
            ),
            message(
                "/camera/detections",
                "vision_msgs/Detection2DArray",
                {
                    "header": header,
                    "detections": [self._detection_2d(annotated, header) for annotated in picture.objects],
                },
            ),
            message(
                "/camera/boxes",
                "vision_msgs/Detection3DArray",
                {
                    "header": header | {"frame_id": _WORLD},
                    "detections": [self._detection_3d(annotated, header) for annotated in picture.objects],
                },
            ),
            message("/record", "std_msgs/String", {"data": json.encode(picture).decode()}),
        ]

    def _detection_2d(self, annotated: ObjectAnnotation, header: dict[str, object]) -> dict[str, object]:
        box = annotated.box
        centre = {"x": (box.left + box.right) / 2 - _CENTRE, "y": (box.top + box.bottom) / 2 - _CENTRE}
        return {
            "header": header,
            "results": [{"id": self._categories.index(annotated.category) + 1, "score": 1.0}],
            "bbox": {"center": centre, "size_x": box.width, "size_y": box.height},
        }

    def _detection_3d(self, annotated: ObjectAnnotation, header: dict[str, object]) -> dict[str, object]:
        number = self._categories.index(annotated.category) + 1
        return {
            "header": header | {"frame_id": _WORLD},
            "results": [{"id": number, "score": 1.0, "pose": {"pose": _pose(annotated.world_from_model)}}],
            "bbox": {
                "center": _pose(annotated.box_3d.world_from_box),
                "size": dict(zip("xyz", annotated.box_3d.size, strict=True)),
            },
        }


def _pose(row: Numbers) -> dict[str, object]:
    x, y, z, qw, qx, qy, qz = row
    return {"position": {"x": x, "y": y, "z": z}, "orientation": {"x": qx, "y": qy, "z": qz, "w": qw}}


def _transform(picture: PictureAnnotation, stamp: int) -> dict[str, object]:
    (x, y, z), (qw, qx, qy, qz) = (
        (pose := pose_from_row(np.array(picture.camera.world_from_camera))).position,
        pose.quaternion,
    )
    return {
        "header": {"stamp": stamp, "frame_id": _WORLD},
        "child_frame_id": _FRAME,
        "transform": {
            "translation": {"x": x, "y": y, "z": z},
            "rotation": {"x": qx, "y": qy, "z": qz, "w": qw},
        },
    }


def _camera_info(picture: PictureAnnotation) -> dict[str, object]:
    camera = picture.camera
    cx, cy = camera.cx - _CENTRE, camera.cy - _CENTRE
    return {
        "height": picture.height,
        "width": picture.width,
        "distortion_model": "plumb_bob",
        "D": [0.0] * 5,
        "K": [camera.fx, 0.0, cx, 0.0, camera.fy, cy, 0.0, 0.0, 1.0],
        "R": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        "P": [camera.fx, 0.0, cx, 0.0, 0.0, camera.fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    }


def _image(folder: Path, kind: str, picture: PictureAnnotation) -> dict[str, object]:
    """Return the fields of a 16-bit image: depths in millimetres, as in REP 118, or instance numbers."""
    with Image.open(BytesIO((folder / picture_path(kind, picture.number)).read_bytes())) as image:
        pixels = np.asarray(image).astype("<u2")
    return {
        "height": picture.height,
        "width": picture.width,
        "encoding": "16UC1",
        "step": 2 * picture.width,
        "data": pixels.reshape(-1).view(np.uint8),
    }
