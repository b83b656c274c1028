"""KITTI: labels of objects in the camera's frame, calibration, depths and lidar clouds.

The object benchmark's devkit defines the frames: the camera has x to the right, y down, z ahead; a box stands on its
`location`, and turns about the camera's y alone. A box that the camera sees tilted keeps its position and size, and its
heading in the camera's x-z plane.
"""

import math
import os
import shutil
from pathlib import Path

import numpy as np

from trundle.spatial import Pose, matrix_from_quaternion, pose_from_row

from ..annotation import CameraAnnotation, ObjectAnnotation, PictureAnnotation
from ..dataset_folder import depth_pixels, picture_path, png
from ..picture import AnnotatedPicture
from ..plan import DatasetPlan
from .format import DatasetFormat

_DEPTH_SCALE = 256.0
"""Depth pictures of KITTI's depth benchmark count 1/256 m."""
_FULLY, _PARTLY = 0.05, 0.5
"""Hidden shares up to which an object counts as fully visible, and as partly occluded; beyond, largely."""
_CENTRE = 0.5
"""KITTI counts pixels from the middle of the first one."""


class KittiFormat(DatasetFormat):
    """Writes `kitti/training/` with image_2, label_2, calib, depth_2 and, with a lidar, velodyne."""

    def write(self, plan: DatasetPlan, folder: Path, picture: AnnotatedPicture) -> None:
        """Write the files of a picture; the picture itself is the one in `images/`, as a hard link where that works."""
        del plan
        number, annotation = picture.annotation.number, picture.annotation
        base = folder / "kitti" / "training"
        for name in ("image_2", "label_2", "calib", "depth_2", *(("velodyne",) if picture.cloud else ())):
            (base / name).mkdir(parents=True, exist_ok=True)
        _link(folder / picture_path("images", number), base / picture_path("image_2", number))
        depth = base / picture_path("depth_2", number)
        depth.write_bytes(png(depth_pixels(picture.depth, _DEPTH_SCALE)))
        labels = "".join(label_line(each, annotation.camera) + "\n" for each in annotation.objects)
        (base / picture_path("label_2", number, "txt")).write_text(labels, encoding="utf-8")
        (base / picture_path("calib", number, "txt")).write_text(calibration(annotation))
        if picture.cloud is not None:
            (base / picture_path("velodyne", number, "bin")).write_bytes(picture.cloud.points.astype("<f4").tobytes())


def _link(picture: Path, path: Path) -> None:
    path.unlink(missing_ok=True)
    try:
        os.link(picture, path)
    except OSError:  # a file system without links
        shutil.copyfile(picture, path)


def label_line(each: ObjectAnnotation, camera: CameraAnnotation) -> str:
    """Return the 15 columns of an object."""
    optical_from_world = pose_from_row(np.array(camera.world_from_camera)).inverse()
    optical_from_box: Pose = optical_from_world @ pose_from_row(np.array(each.box_3d.world_from_box))
    length, width, height = each.box_3d.size
    x, y, z = optical_from_box.transform_point((0.0, 0.0, -height / 2))
    dx, _, dz = optical_from_box.transform_vector((1.0, 0.0, 0.0))
    rotation = math.atan2(-dz, dx)
    alpha = math.remainder(rotation - math.atan2(x, z), math.tau)
    occluded = 0 if each.occlusion <= _FULLY else 1 if each.occlusion <= _PARTLY else 2
    box = each.amodal_box
    pixels = (box.left, box.top, max(box.right - 1, box.left), max(box.bottom - 1, box.top))
    numbers = (alpha, *pixels, height, width, length, x, y, z, rotation)
    return f"{each.category} {each.truncation:.2f} {occluded} " + " ".join(f"{number:.2f}" for number in numbers)


def calibration(picture: PictureAnnotation) -> str:
    """Return a calibration file: four times the same camera, already rectified, and the lidar's pose in it."""
    camera = picture.camera
    projection = [
        [camera.fx, 0.0, camera.cx - _CENTRE, 0.0],
        [0.0, camera.fy, camera.cy - _CENTRE, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ]
    eye = np.eye(3, 4)
    lidar = eye if picture.camera_from_lidar is None else rigid(pose_from_row(np.array(picture.camera_from_lidar)))
    lines = [*((f"P{i}", np.array(projection)) for i in range(4)), ("R0_rect", np.eye(3))]
    lines += [("Tr_velo_to_cam", lidar), ("Tr_imu_to_velo", eye)]
    return "".join(f"{name}: {numbers_of(matrix)}\n" for name, matrix in lines)


def rigid(pose: Pose) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Return the (3, 4) matrix of a pose."""
    return np.column_stack([matrix_from_quaternion(pose.quaternion), pose.position])


def numbers_of(matrix: "np.ndarray[tuple[int, int], np.dtype[np.float64]]") -> str:
    """Return a matrix row by row, as KITTI writes it."""
    return " ".join(f"{number:.12e}" for number in matrix.reshape(-1).tolist())
