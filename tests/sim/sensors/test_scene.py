"""A camera in a published scene against Gazebo's image."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.pictures import drawn

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load
from trundle.robots.model import World
from trundle.robots.packages import Packages
from trundle.sim.render import Intrinsics, NativeRenderer, scene_from_world
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

WORLD_FROM_CAMERA = Pose.from_rpy(0.0, 0.05715, 1.5113, 0.0, 0.0, math.pi / 2)
"""Pose of the RP2W's upper camera at rest."""


@pytest.fixture(scope="module")
def scene_world(shared: Path, tmp_path_factory: pytest.TempPathFactory) -> World:
    """A box, a ball and a cylinder on the ground; the robot that carried Gazebo's camera is left out."""
    text = (shared / "peers" / "worlds" / "cam_scene.world").read_text()
    path = tmp_path_factory.mktemp("scene") / "cam_scene.world"
    path.write_text(re.sub(r"<include>\s*<uri>model://rp2w_camsave</uri>\s*</include>", "", text))
    return load(str(path), Diagnostics(), packages=Packages({}, start=path)).world


@pytest.fixture(scope="module")
def picture(scene_world: World) -> NDArray[np.int_]:
    """(240, 320, 3)"""
    renderer = NativeRenderer(scene_from_world(scene_world, Diagnostics()))
    renderer.update(Simulation(scene_world, Diagnostics()).snapshot().poses)
    picture = drawn(renderer, WORLD_FROM_CAMERA, Intrinsics(width_px=320, height_px=240, horizontal_fov_rad=1.047))
    return picture.rgb.astype(int)


# Centroid and area in Gazebo's picture [px], measured on the right half of gazebo_cameras.png.
@pytest.mark.parametrize(
    ("channel", "column", "row", "area"),
    [(0, 83.6, 195.7, 7514), (1, 187.7, 177.1, 2436), (2, 265.7, 176.3, 4909)],
    ids=["red box", "green ball", "blue cylinder"],
)
def test_objects_have_gazebos_positions_and_sizes_in_the_image(
    picture: NDArray[np.int_], channel: int, column: float, row: float, area: int
) -> None:
    others = [i for i in range(3) if i != channel]
    mask = (picture[..., channel] > 60) & (picture[..., others] < 40).all(axis=-1)
    rows, columns = np.nonzero(mask)
    # Gazebo smooths edges, rays do not: half a pixel at every rim.
    assert (columns.mean(), rows.mean()) == pytest.approx((column, row), abs=1.5)
    # Its ball is a polyhedron inside ours, and its dark rims are not counted.
    assert mask.sum() == pytest.approx(area, rel=0.06)


def test_sky_and_ground_have_gazebos_greys(picture: NDArray[np.int_]) -> None:
    assert (picture[:100, :200] == picture[0, 0]).all()
    assert picture[0, 0] == pytest.approx([178, 178, 178], abs=2)
    r, g, b = picture[235, 235]
    assert r == g == b != picture[0, 0, 0]


def test_the_horizon_is_level_in_the_middle(picture: NDArray[np.int_]) -> None:
    ground = (picture != picture[0, 0]).any(axis=-1)[:, 5]
    # The plane ends 50 m away, seen from 1.5 m: 8 px below the middle of the picture.
    first = int(np.flatnonzero(ground)[0])
    assert 120 <= first <= 130
