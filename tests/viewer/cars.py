"""A hand-made car for the viewer's tests: blue body, black wheels, a pole that turns, a camera."""

import math

import numpy as np
from numpy.typing import NDArray

from trundle.model import Box, Cylinder, Plane
from trundle.render import Scene, Shape
from trundle.spatial import Pose, quaternion_from_rpy
from trundle.viewer import CameraView, FrameInfo, JointSlider, ViewerScene, ViewerState

BODIES = ("ground::link", "car::base_link", "car::left_wheel", "car::right_wheel")


def car_scene(**changes: object) -> ViewerScene:
    """Return a page with everything on it; `changes` replace fields."""
    upright = quaternion_from_rpy(math.pi / 2, 0, 0)
    shapes = (
        Shape(name="ground", body=0, geometry=Plane((0, 0, 1), (100, 100)), rgba=(0.8, 0.8, 0.8, 1)),
        Shape(name="chassis", body=1, geometry=Box((0.5, 0.3, 0.15)), rgba=(0.0, 0.0, 0.9, 1)),
        Shape(
            name="mast", body=1, geometry=Cylinder(0.02, 0.4), body_from_shape=Pose((-0.1, 0, 0.27)), rgba=(1, 1, 1, 1)
        ),
        Shape(name="camera", body=1, geometry=Box((0.05, 0.05, 0.03)), body_from_shape=Pose((0.2, 0, 0.1))),
        Shape(
            name="left", body=2, geometry=Cylinder(0.1, 0.05), body_from_shape=Pose((0, 0, 0), upright), rgba=(0, 0, 0, 1)
        ),
        Shape(
            name="right", body=3, geometry=Cylinder(0.1, 0.05), body_from_shape=Pose((0, 0, 0), upright), rgba=(0, 0, 0, 1)
        ),
    )
    fields: dict[str, object] = {
        "title": "car",
        "scene": Scene(bodies=BODIES, shapes=shapes),
        "collisions": Scene(bodies=BODIES, shapes=(Shape(name="hull", body=1, geometry=Box((0.6, 0.4, 0.25))),)),
        "frames": (FrameInfo("base_link", "world"), FrameInfo("left_wheel", "base_link"), FrameInfo("world")),
        "cameras": (CameraView(name="front", body=1, body_from_camera=Pose((0.22, 0, 0.1))),),
        "joints": (JointSlider(name="left_wheel_joint", lower=-3.0, upper=3.0),),
        "playback": True,
        "drive": True,
        "follow_body": 1,
    }
    return ViewerScene(**(fields | changes))  # type: ignore[arg-type]


def car_state(x: float = 0.0, *, y: float = 0.0, yaw: float = 0.0, time_s: float = 1.0, **changes: object) -> ViewerState:
    """Return the car standing at a place."""
    world_from_base = Pose.from_rpy(x, y, 0.12, 0, 0, yaw)
    poses = [Pose(), world_from_base, world_from_base @ Pose((0, 0.18, -0.02)), world_from_base @ Pose((0, -0.18, -0.02))]
    frames = [poses[1], poses[2], Pose()]
    fields: dict[str, object] = {
        "time_ns": int(time_s * 1e9),
        "body_poses": _rows(poses),
        "frame_poses": _rows(frames),
        "joint_positions": np.array([0.5]),
        "real_time_factor": 1.0,
    }
    return ViewerState(**(fields | changes))  # type: ignore[arg-type]


def _rows(poses: list[Pose]) -> NDArray[np.float64]:
    return np.array([(*p.position, *p.quaternion) for p in poses])
