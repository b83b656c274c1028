"""A hand-made car to look at: blue body, white mast, black wheels, a camera."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from trundle.model import Box, Cylinder, Plane
from trundle.render import Scene, Shape
from trundle.spatial import Pose
from trundle.viewer import CameraView, FrameInfo, JointSlider, Viewer, ViewerScene, ViewerState

_BODIES = ("ground::link", "car::base_link", "car::left_wheel", "car::right_wheel")


def make_scene(**changes: object) -> ViewerScene:
    """Return a page with everything on it; `changes` replace fields."""
    wheel, on_side, black = Cylinder(0.1, 0.05), Pose.from_rpy(0, 0, 0, math.pi / 2), (0.0, 0.0, 0.0, 1.0)
    shapes = (
        Shape(name="ground", body=0, geometry=Plane((0, 0, 1), (100, 100)), rgba=(0.8, 0.8, 0.8, 1)),
        Shape(name="chassis", body=1, geometry=Box((0.5, 0.3, 0.15)), rgba=(0.0, 0.0, 0.9, 1)),
        Shape(name="mast", body=1, geometry=Cylinder(0.02, 0.4), body_from_shape=Pose((-0.1, 0, 0.27))),
        Shape(name="camera", body=1, geometry=Box((0.05, 0.05, 0.03)), body_from_shape=Pose((0.2, 0, 0.1))),
        Shape(name="left", body=2, geometry=wheel, body_from_shape=on_side, rgba=black),
        Shape(name="right", body=3, geometry=wheel, body_from_shape=on_side, rgba=black),
    )
    hull = Shape(name="hull", body=1, geometry=Box((0.6, 0.4, 0.25)), rgba=(1.0, 0.0, 0.0, 1.0))
    fields: dict[str, Any] = {
        "title": "car",
        "scene": Scene(bodies=_BODIES, shapes=shapes),
        "collisions": Scene(bodies=_BODIES, shapes=(hull,)),
        "frames": (FrameInfo("base_link", "world"), FrameInfo("left_wheel", "base_link"), FrameInfo("world")),
        "cameras": (CameraView(name="front", body=1, body_from_camera=Pose((0.22, 0, 0.1))),),
        "joints": (JointSlider(name="left_wheel_joint", lower=-3.0, upper=3.0),),
        "playback": True,
        "drive": True,
        "follow_body": 1,
    }
    return ViewerScene(**(fields | changes))


def make_state(
    x: float = 0.0, *, y: float = 0.0, yaw: float = 0.0, time_s: float = 1.0, **changes: object
) -> ViewerState:
    """Return the car standing at a place."""
    base = Pose.from_rpy(x, y, 0.12, 0, 0, yaw)
    left, right = base @ Pose((0, 0.18, -0.02)), base @ Pose((0, -0.18, -0.02))
    fields: dict[str, Any] = {
        "time_ns": int(time_s * 1e9),
        "body_poses": _rows(Pose(), base, left, right),
        "frame_poses": _rows(base, left, Pose()),
        "joint_positions": np.array([0.5]),
        "real_time_factor": 1.0,
    }
    return ViewerState(**(fields | changes))


def _rows(*poses: Pose) -> NDArray[np.float64]:
    return np.array([(*p.position, *p.quaternion) for p in poses])


@pytest.fixture
def car_scene() -> Callable[..., ViewerScene]:
    """Make the car's page."""
    return make_scene


@pytest.fixture
def car_state() -> Callable[..., ViewerState]:
    """Make a moment of the car's."""
    return make_state


@pytest.fixture
def viewer() -> Iterator[Viewer]:
    """Serve the car's page on a free port."""
    with Viewer.start(make_scene(), port=0, state=make_state()) as viewer:
        yield viewer


@pytest.fixture
def page(chromium: Any, viewer: Viewer) -> Iterator[Any]:
    """Open the car's page and wait until it is drawn."""
    page = chromium.new_page(viewport={"width": 1200, "height": 1300})
    page.set_default_timeout(60_000)
    page.goto(viewer.url)
    page.add_style_tag(content=".mantine-Notification-root { display: none }")  # "WebGL is in software mode"
    page.wait_for_selector("text=real-time factor")
    yield page
    page.close()
