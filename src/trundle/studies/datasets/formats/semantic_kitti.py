"""SemanticKITTI: lidar clouds with a class and instance per point, and the lidar's poses.

A label has the class in its lower 16 bits and the instance in its upper ones, as in semantic-kitti-api.
"""

from pathlib import Path

import numpy as np
import yaml

from trundle.base.atomic_write import write_atomically
from trundle.spatial import Pose, pose_from_row

from ..annotation import PictureAnnotation
from ..dataset_folder import picture_path
from ..picture import AnnotatedPicture
from ..plan import DatasetPlan
from .format import DatasetFormat, ReadAll
from .kitti import calibration, numbers_of, rigid

_PERIOD_S = 0.1
"""Time between scans, which the format requires."""


class SemanticKittiFormat(DatasetFormat):
    """Writer of `semantic_kitti/sequences/00/` and `labels.yaml`."""

    def write(self, plan: DatasetPlan, folder: Path, picture: AnnotatedPicture) -> None:
        """Write a cloud and its labels."""
        del plan
        assert picture.cloud is not None
        base = folder / "semantic_kitti" / "sequences" / "00"
        for name in ("velodyne", "labels"):
            (base / name).mkdir(parents=True, exist_ok=True)
        number, cloud = picture.annotation.number, picture.cloud
        (base / picture_path("velodyne", number, "bin")).write_bytes(cloud.points.astype("<f4").tobytes())
        labels = (cloud.instances.astype("<u4") << 16) | cloud.classes
        (base / picture_path("labels", number, "label")).write_bytes(labels.astype("<u4").tobytes())

    def finish(self, plan: DatasetPlan, folder: Path, read: ReadAll) -> None:
        """Write the classes, the poses in the first camera's frame, and the calibration."""
        base = folder / "semantic_kitti" / "sequences" / "00"
        labels = {0: "unlabeled"} | dict(enumerate(plan.categories, 1))
        write_atomically(folder / "semantic_kitti" / "labels.yaml", yaml.safe_dump({"labels": labels}))
        lines: list[str] = []
        first: Pose | None = None
        for picture in read():
            pose = _pose(picture)
            first = first or pose
            lines.append(numbers_of(rigid(first.inverse() @ pose)) + "\n")
            if picture.number == 0:
                text = calibration(picture).replace("Tr_velo_to_cam:", "Tr:")
                used_lines = [line for line in text.splitlines() if line.startswith(("P", "Tr:"))]
                write_atomically(base / "calib.txt", "\n".join(used_lines) + "\n")
        write_atomically(base / "poses.txt", "".join(lines))
        write_atomically(base / "times.txt", "".join(f"{_PERIOD_S * i:.6e}\n" for i in range(plan.count)))


def _pose(picture: PictureAnnotation) -> Pose:
    return pose_from_row(np.array(picture.camera.world_from_camera))
