"""Actors with moving bones in images and lidar scans."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.skinned import bending_column

import trundle
from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import RangeSensor, mount_cameras, mount_sensors

_EYE = """<model name="eye"><static>1</static><link name="l"><pose>{}</pose>
<sensor name="s" type="depth"><camera><horizontal_fov>1.2</horizontal_fov>
<image><width>121</width><height>121</height></image><clip><near>0.1</near><far>50</far></clip></camera></sensor>
<sensor name="r" type="gpu_ray"><ray><scan><horizontal><samples>1</samples><min_angle>0</min_angle>
<max_angle>0</max_angle></horizontal></scan><range><min>0.1</min><max>50</max></range></ray></sensor>
</link></model>"""
_ACTOR = """<actor name="bender"><skin><filename>column.dae</filename></skin>
<animation name="bend"><filename>column.dae</filename><interpolate_x>{}</interpolate_x></animation>
<script><trajectory id="0" type="bend">{}</trajectory></script></actor>"""
_WALK = """<waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint>
<waypoint><time>4</time><pose>1 0 0 0 0 0</pose></waypoint>"""


def world(folder: Path, eye: str, actor: str) -> Any:
    (folder / "column.dae").write_text(bending_column())
    file = folder / "w.sdf"
    file.write_text(f'<sdf version="1.6"><world name="w">{_EYE.format(eye)}{actor}</world></sdf>')
    return trundle.load(str(file))


def height_and_distance(sim: Any, camera: Any) -> tuple[float, float]:
    """Height of the visible column at 6 m, and its distance [m]."""
    depth = camera.measure(sim.snapshot()).depth
    rows = np.flatnonzero(np.isfinite(depth).any(axis=1))
    focal = 60.5 / np.tan(0.6)
    return 1.0 + (60.5 - rows.min()) * 6.0 / focal, float(np.nanmin(depth))


def test_bones_move_in_step_with_the_path(tmp_path: Path) -> None:
    """With <interpolate_x> the column has bent over by as much as it has walked: a quarter of a turn in a metre."""
    sim = world(tmp_path, "-6 0 1 0 0 0", _ACTOR.format("true", _WALK))
    (camera,) = mount_cameras(sim, NativeRenderer)

    assert height_and_distance(sim, camera) == pytest.approx((2.0, 5.8), abs=0.06)
    sim.run(3.999)

    high, near = height_and_distance(sim, camera)
    assert near == pytest.approx(6.8, abs=0.01), "the animation's own way along x is not added to that of the script"
    assert high == pytest.approx(1.0 + 0.2 * 6.0 / 6.8, abs=0.06)


def test_without_interpolate_x_bones_move_by_time(tmp_path: Path) -> None:
    sim = world(tmp_path, "-6 0 1 0 0 0", _ACTOR.format("false", _WALK))
    (camera,) = mount_cameras(sim, NativeRenderer)

    sim.run(1.0)
    bent, _ = height_and_distance(sim, camera)
    sim.run(1.0)
    upright, _ = height_and_distance(sim, camera)

    assert bent == pytest.approx(1.2, abs=0.07)
    assert upright == pytest.approx(2.0, abs=0.15)


def test_an_actor_without_a_path_moves_by_its_animation(tmp_path: Path) -> None:
    sim = world(tmp_path, "-6 0 1 0 0 0", _ACTOR.format("true", ""))
    (camera,) = mount_cameras(sim, NativeRenderer)

    sim.run(1.0)

    assert height_and_distance(sim, camera)[1] == pytest.approx(6.8, abs=0.01)


def test_gpu_lidars_hit_the_skin_and_not_a_box(tmp_path: Path) -> None:
    """A ray at 1.8 m height hits only the upright column."""
    sim = world(tmp_path, "-6 0 1.8 0 0 0", _ACTOR.format("false", _WALK))
    (lidar,) = mount_sensors(sim)

    assert isinstance(lidar, RangeSensor)
    upright = lidar.measure(sim.snapshot()).ranges.item()
    sim.run(1.0)

    assert upright == pytest.approx(5.8, abs=1e-4)
    assert lidar.measure(sim.snapshot()).ranges.item() == np.inf


def test_two_actors_with_one_skin_move_independently(tmp_path: Path) -> None:
    second = _ACTOR.format("false", _WALK.replace("<time>4", "<time>400")).replace("bender", "other")
    second = second.replace("<loop>", "").replace("<script>", "<script><delay_start>9</delay_start>")
    second = second.replace("<pose>0 0 0 ", "<pose>0 2 0 ").replace("<pose>1 0 0 ", "<pose>1 2 0 ")
    sim = world(tmp_path, "-6 2 1 0 0 0", _ACTOR.format("false", _WALK) + second)
    camera = mount_cameras(sim, NativeRenderer)[0]

    sim.run(1.0)
    depth = camera.measure(sim.snapshot()).depth
    assert depth is not None

    heights = [
        np.flatnonzero(np.isfinite(depth[:, columns]).any(axis=1)).min() for columns in (slice(50, 71), slice(80, 121))
    ]
    assert heights[0] < heights[1] - 5, "the waiting actor stands upright"


def test_a_skin_without_bones_is_a_box_with_a_reason(tmp_path: Path) -> None:
    text = _ACTOR.format("false", _WALK).replace("<skin><filename>column.dae", "<skin><filename>lost.dae")
    sim = world(tmp_path, "-6 0 1 0 0 0", text)

    messages = [finding.what for finding in sim.report.findings]
    assert any(
        "actor 'bender' is a box of its skin's size; its bones do not move: its skin file was not found" in message
        for message in messages
    )
