"""The two published robots, read as their tutorials' tools read them."""

import json
from pathlib import Path

import pytest
from tests.robots.description.compare import shape_of

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import parse_xml
from trundle.robots.description import LoadedDescription, expand_xacro, load
from trundle.robots.model import Box, model_from_joint
from trundle.robots.packages import Packages


@pytest.fixture
def rp2w(shared: Path) -> LoadedDescription:
    folder = shared / "seeds/rp2w"
    return load(str(folder), Diagnostics(), packages=Packages({}, start=folder))


@pytest.fixture
def smartcar_file(shared: Path) -> Path:
    return shared / "seeds/smartcar_description/urdf/smartcar.urdf.xacro"


def test_the_rp2w_has_its_links_joints_and_cameras(rp2w: LoadedDescription) -> None:
    (model,) = rp2w.world.models

    assert (len(model.links), len(model.joints)) == (7, 6)
    cameras = [s for link in model.links for s in link.sensors if s.cameras]
    assert [(c.name, c.cameras[0].width_px, c.update_rate_hz) for c in cameras] == [
        ("netbook_webcam", 320, 30.0),
        ("my_sensor", 320, 30.0),
    ]
    assert model.plugins[0].filename == "/home/larry/gazebo_plugin/librp2w.so"


def test_its_joints_are_where_gazebo_has_them(rp2w: LoadedDescription, shared: Path) -> None:
    """SDF 1.4 writes axes in the model frame: read by 1.5's rules the wheels would turn about the wrong axis."""
    gazebo = json.loads((shared / "peers/gazebo_rp2w_info.json").read_text())
    (model,) = rp2w.world.models

    for joint in model.joints:
        expected = gazebo[f"JOINT my_robot::{joint.name}"]
        assert joint.axis is not None
        assert joint.axis.direction == pytest.approx([float(v) for v in expected["axis_global"].split()])
        anchor = model_from_joint(model, joint).position
        assert anchor == pytest.approx([float(v) for v in expected["anchor"].split()], abs=1e-9)
        assert joint.axis.friction == expected["friction"]


def test_values_are_kept_as_written(rp2w: LoadedDescription) -> None:
    (model,) = rp2w.world.models

    assert model.link("chassis").inertial.moments == (1.0, 1.0, 1.0)
    board = model.link("body").collisions[1].geometry
    assert isinstance(board, Box)
    assert board.size[2] == 0.0
    rigid = model.joint("chassis_body").axis
    assert rigid is not None
    assert rigid.is_rigid


def test_the_smartcar_expands_as_it_did_with_its_own_xacro(smartcar_file: Path, shared: Path) -> None:
    """Its macros are called without the prefix xacro:, which today's xacro copies to the output without a warning."""
    packages = Packages({"ROS_PACKAGE_PATH": str(shared / "seeds")}, start=smartcar_file)
    report = Diagnostics()

    actual = parse_xml(expand_xacro(smartcar_file, {}, packages=packages, report=report), name="ours")
    expected = parse_xml((shared / "peers/ros_reference/smartcar_melodic.urdf").read_bytes(), name="theirs")

    assert list(map(shape_of, actual.children)) == list(map(shape_of, expected.children))
    assert sum("without the prefix xacro:" in warning for warning in report.warnings) == 2


def test_the_smartcar_becomes_a_model_with_its_head_lumped(smartcar_file: Path) -> None:
    loaded = load(str(smartcar_file), Diagnostics(), packages=Packages({}, start=smartcar_file))

    (model,) = loaded.world.models
    assert model.links[0].name == "base_link"
    assert (len(model.links), len(model.joints)) == (5, 4)
    assert loaded.robot is not None
    assert (len(loaded.robot.links), len(loaded.robot.joints)) == (6, 5)
    base = model.link("base_link")
    assert base.inertial.mass == pytest.approx(1.1)
    assert base.visuals[-1].name == "base_link_fixed_joint_lump__head_visual_1"
    assert base.visuals[0].material.diffuse == (0.0, 0.0, 1.0, 1.0)  # <gazebo><material>Gazebo/Blue
