"""KITTI: labels of objects in the camera's frame, calibration, depths and lidar clouds.

The object benchmark's devkit defines the frames: the camera has x to the right, y down, z ahead; `location` is the
bottom centre of a box, which rotates about the camera's y only. A tilted box keeps its position, its size, and its
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
"""Depths of KITTI's depth benchmark are in units of 1/256 m."""
_FULLY, _PARTLY = 0.05, 0.5
"""Maximum hidden fractions of fully visible and of partly occluded objects."""
_CENTRE = 0.5
"""KITTI's pixel coordinates start at the centre of the first pixel."""


class KittiFormat(DatasetFormat):
    """Writer of `kitti/training/` with image_2, label_2, calib, depth_2 and, with a lidar, velodyne."""

    def write(self, plan: DatasetPlan, folder: Path, picture: AnnotatedPicture) -> None:
        """Write the files of a picture; its image is a hard link to the one in `images/`, or a copy."""
        del plan
        number, annotation = picture.annotation.number, picture.annotation
        base = folder / "kitti" / "training"
        for name in ("image_2", "label_2", "calib", "depth_2", *(("velodyne",) if picture.cloud else ())):
            (base / name).mkdir(parents=True, exist_ok=True)
        _link(folder / picture_path("images", number), base / picture_path("image_2", number))
        depth = base / picture_path("depth_2", number)
        depth.write_bytes(png(depth_pixels(picture.depth, _DEPTH_SCALE)))
        labels = "".join(label_line(annotated, annotation.camera) + "\n" for annotated in annotation.objects)
        (base / picture_path("label_2", number, "txt")).write_text(labels, encoding="utf-8")
        (base / picture_path("calib", number, "txt")).write_text(calibration(annotation))
        if picture.cloud is not None:
            (base / picture_path("velodyne", number, "bin")).write_bytes(picture.cloud.points.astype("<f4").tobytes())


def _link(picture: Path, path: Path) -> None:
    path.unlink(missing_ok=True)
    try:
        os.link(picture, path)
    except OSError:  # the file system has no hard links
        shutil.copyfile(picture, path)


def label_line(annotated: ObjectAnnotation, camera: CameraAnnotation) -> str:
    """Return the 15 columns of an object."""
    optical_from_world = pose_from_row(np.array(camera.world_from_camera)).inverse()
    optical_from_box: Pose = optical_from_world @ pose_from_row(np.array(annotated.box_3d.world_from_box))
    length, width, height = annotated.box_3d.size
    x, y, z = optical_from_box.transform_point((0.0, 0.0, -height / 2))
    dx, _, dz = optical_from_box.transform_vector((1.0, 0.0, 0.0))
    rotation = math.atan2(-dz, dx)
    alpha = math.remainder(rotation - math.atan2(x, z), math.tau)
    occluded = 0 if annotated.occlusion <= _FULLY else 1 if annotated.occlusion <= _PARTLY else 2
    box = annotated.amodal_box
    pixels = (box.left, box.top, max(box.right - 1, box.left), max(box.bottom - 1, box.top))
    numbers = (alpha, *pixels, height, width, length, x, y, z, rotation)
    return f"{annotated.category} {annotated.truncation:.2f} {occluded} " + " ".join(
        f"{number:.2f}" for number in numbers
    )


def calibration(picture: PictureAnnotation) -> str:
    """Return a calibration file: one rectified camera for all four, and the lidar's pose in it."""
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
    """Return a matrix row by row in KITTI's number format."""
    return " ".join(f"{number:.12e}" for number in matrix.reshape(-1).tolist())
