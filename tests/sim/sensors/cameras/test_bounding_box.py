"""Bounding boxes against the visible pixels of unoccluded shapes."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trundle
from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import mount_cameras
from trundle.spatial import Pose

LABEL = '<plugin filename="gz-sim-label-system" name="gz::sim::systems::Label"><label>3</label></plugin>'
SHAPES = {
    "box": "<box><size>1 0.6 0.8</size></box>",
    "capsule": "<capsule><radius>0.2</radius><length>0.9</length></capsule>",
    "cylinder": "<cylinder><radius>0.3</radius><length>1.2</length></cylinder>",
    "ellipsoid": "<ellipsoid><radii>0.7 0.2 0.4</radii></ellipsoid>",
    "mesh": "<mesh><uri>spike.obj</uri></mesh>",
    "sphere": "<sphere><radius>0.6</radius></sphere>",
}


def look(folder: Path, shape: str, *, pose: str, type_: str, inside: str = "") -> Any:
    """Boxes of one labelled shape from a camera at the origin."""
    (folder / "spike.obj").write_text("v 0 0 1\nv 1 0 0\nv -1 0 0\nv 0 0.2 0\nf 1 2 4\nf 1 4 3\nf 1 3 2\nf 2 3 4\n")
    optics = "<horizontal_fov>1</horizontal_fov><image><width>320</width><height>240</height></image>"
    camera = f'<sensor name="s" type="{type_}"><camera>{optics}{inside}</camera></sensor>'
    visual = f'<visual name="v"><pose>{pose}</pose><geometry>{SHAPES[shape]}</geometry>{LABEL}</visual>'
    links = f'<link name="eye">{camera}</link><link name="l"><pose>4 0.3 0.2 0 0 0</pose>{visual}</link>'
    file = folder / "w.sdf"
    file.write_text(
        f'<sdf version="1.9"><world name="w"><model name="m"><static>1</static>{links}</model></world></sdf>'
    )
    sim = trundle.load(str(file))
    (sensor,) = mount_cameras(sim, NativeRenderer)
    return sensor.measure(sim.snapshot())


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("kind", ["visible_2d", "full_2d"])
def test_a_2d_box_encloses_the_shape_tightly(tmp_path: Path, shape: str, kind: str) -> None:
    """To a pixel, in any pose; not the rectangle around the shape's bounding box."""
    pose = "0 0 0 0.7 0.5 0.3"
    labels = look(tmp_path, shape, pose=pose, type_="segmentation").labels
    (box,) = look(tmp_path, shape, pose=pose, type_="boundingbox", inside=f"<box_type>{kind}</box_type>").boxes
    rows, columns = np.nonzero(labels)

    rim = [box.center[i] + side * box.size[i] / 2 for i in (0, 1) for side in (-1, 1)]
    assert rim == pytest.approx([columns.min(), columns.max() + 1, rows.min(), rows.max() + 1], abs=1.0)


def test_a_3d_box_encloses_the_shape_tightly(tmp_path: Path) -> None:
    """A cylinder about a reaches √(1 − a²) r + |a| l / 2 along each axis of its link."""
    inside = "<box_type>3d</box_type>"
    (box,) = look(tmp_path, "cylinder", pose="0 0 0 0.7 0.5 0.3", type_="boundingbox", inside=inside).boxes
    along = Pose.from_rpy(0.0, 0.0, 0.0, 0.7, 0.5, 0.3).transform_vector((0.0, 0.0, 1.0))

    assert box.size == pytest.approx([2 * (0.3 * math.sqrt(1 - a * a) + 0.6 * abs(a)) for a in along], rel=2e-3)
    assert box.center == pytest.approx((4.0, 0.3, 0.2), abs=1e-9)
