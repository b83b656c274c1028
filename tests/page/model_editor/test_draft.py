"""Edits of a model's SDF: written values, refusals, undo."""

import os
from pathlib import Path

import pytest

from trundle.base.diagnostics import UsageError
from trundle.page import Value
from trundle.page.model_editor.draft import Draft
from trundle.page.model_editor.new_parts import new_model
from trundle.page.model_editor.overview import draft_overview
from trundle.page.model_editor.reader import ModelReader
from trundle.robots.packages import Packages
from trundle.spatial import Pose

BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
SOURCE = f"""<sdf version="1.6"><model name="crate">
  <!-- keep me -->
  <link name="body"><collision name="c">{BOX}</collision><unknown>7</unknown></link>
</model></sdf>"""
CHASSIS, WHEEL = ("link", "chassis"), ("link", "wheel")


def _draft(text: bytes, folder: Path) -> Draft:
    reader = ModelReader(Packages({}, start=folder), os.environ, folder)
    return Draft(text, reader, original=None, world_from_model=Pose((2.0, 0.0, 0.0)))


@pytest.fixture
def cart(tmp_path: Path) -> Draft:
    """Return a cart with one wheel."""
    draft = _draft(new_model("cart"), tmp_path)
    draft.set(draft.add((), "link", "box"), "@name", "chassis")
    draft.set(draft.add((), "link", "cylinder"), "@name", "wheel")
    draft.add(WHEEL, "joint", "revolute")
    return draft


def test_comments_and_unknown_elements_are_kept(tmp_path: Path) -> None:
    draft = _draft(SOURCE.encode(), tmp_path)

    draft.set(("link", "body"), "inertial/mass", (3.0,))

    assert b"<!-- keep me -->" in draft.text
    assert b"<unknown>7</unknown>" in draft.text


def test_mass_density_and_size_determine_the_inertia(cart: Draft) -> None:
    """A cube of edge a has m a² / 6; a change of size keeps the density."""
    cart.set(CHASSIS, "inertial/mass", (6.0,))
    assert cart.checked.model.links[0].inertial.moments == pytest.approx((1.0, 1.0, 1.0))

    cart.set(CHASSIS, "collision/geometry/box/size", (2.0, 2.0, 2.0))
    inertial = cart.checked.model.links[0].inertial
    assert inertial.mass == pytest.approx(48.0)
    assert inertial.moments == pytest.approx((32.0, 32.0, 32.0))

    cart.set(CHASSIS, "density", (1.0,))
    assert cart.checked.model.links[0].inertial.mass == pytest.approx(8.0)

    cart.set(CHASSIS, "inertial/inertia/ixx", (5.0,))
    assert cart.checked.model.links[0].inertial.moments[0] == 5.0


def test_one_component_of_a_vector_is_set(cart: Draft) -> None:
    cart.set(CHASSIS, "collision/geometry/box/size", (None, 3.0, None))

    link = cart.checked.model.links[0]
    assert link.collisions[0].geometry == link.visuals[0].geometry
    assert b"<size>1 3 1</size>" in cart.text


def test_a_renamed_link_keeps_its_joint_and_plugin(cart: Draft) -> None:
    cart.set(cart.add((), "plugin", "libgazebo_ros_p3d.so"), "bodyName", "wheel")

    assert cart.set(WHEEL, "@name", "tyre") == ("link", "tyre")

    assert cart.checked.model.joints[0].child == "tyre"
    assert b"<bodyName>tyre</bodyName>" in cart.text
    with pytest.raises(UsageError, match="there is a link 'chassis' already"):
        cart.set(("link", "tyre"), "@name", "chassis")


def test_removing_a_link_removes_its_joints_and_undo_restores_both(cart: Draft) -> None:
    before = cart.text

    cart.remove(WHEEL)
    assert len(cart.checked.model.links) == 1
    assert not cart.checked.model.joints

    assert cart.undo_title == "Remove wheel"
    cart.undo()
    assert cart.text == before
    assert cart.redo_title == "Remove wheel"
    cart.redo()
    assert not cart.checked.model.joints


@pytest.mark.parametrize(
    ("part", "field", "value", "error"),
    [
        (("joint", "wheel_joint"), "@type", "wobbly", "one of"),
        (CHASSIS, "inertial/mass", (-1.0,), "from 1e-09"),
        (CHASSIS, "inertial/mass", "heavy", "1 numbers"),
        (CHASSIS, "nothing/here", (1.0,), "no field"),
        (CHASSIS, "@name", " ", "needs a name"),
        (CHASSIS, "gravity", "perhaps", "true or false"),
        (("link", "gone"), "inertial/mass", (1.0,), "no link 'gone'"),
        (("link",), "inertial/mass", (1.0,), "alternates tags and names"),
    ],
)
def test_invalid_values_are_refused_and_change_nothing(
    cart: Draft, part: tuple[str, ...], field: str, value: Value, error: str
) -> None:
    before, title = cart.text, cart.undo_title

    with pytest.raises(UsageError, match=error):
        cart.set(part, field, value)

    assert (cart.text, cart.undo_title) == (before, title)


def test_findings_belong_to_the_part_at_their_line(cart: Draft) -> None:
    """`trundle check` reports a line; the finding belongs to the part around it."""
    cart.set(WHEEL, "inertial/inertia/izz", (99.0,))

    findings = {part.part: part.findings for part in draft_overview(cart).parts if part.findings}

    assert list(findings) == [WHEEL]
    assert "inertia" in findings[WHEEL][0].text


def test_a_joints_axes_match_its_type(cart: Draft) -> None:
    joint = ("joint", "wheel_joint")

    cart.set(joint, "@type", "universal")
    assert cart.checked.model.joints[0].axis2 is not None
    cart.set(joint, "@type", "fixed")
    assert b"<axis" not in cart.text


def test_a_new_sensor_has_a_publisher(cart: Draft) -> None:
    sensor = cart.add(CHASSIS, "sensor", "gpu_ray")

    assert sensor == (*CHASSIS, "sensor", "lidar")
    assert b'filename="libgazebo_ros_gpu_laser.so"' in cart.text
    cart.set(sensor, "ray/scan/horizontal/samples", (90.0,))
    cart.set((*sensor, "plugin", "lidar_publisher"), "topicName", "front")
    assert b"<samples>90</samples>" in cart.text
    assert b"<topicName>front</topicName>" in cart.text
    with pytest.raises(UsageError, match="select the sensor first"):
        cart.add((), "plugin", "libgazebo_ros_laser.so")


def test_a_link_is_moved_to_a_pose_in_the_world(cart: Draft) -> None:
    """The model is at x = 2 m."""
    cart.move(WHEEL, Pose((2.0, 1.0, 0.5)))
    assert cart.checked.model.links[1].model_from_link.position == pytest.approx((0.0, 1.0, 0.5))

    cart.move((), Pose((4.0, 0.0, 0.0)))
    assert cart.world_from_model.position == (4.0, 0.0, 0.0)
    cart.undo()
    assert cart.world_from_model.position == (2.0, 0.0, 0.0)


def test_names_with_markup_are_escaped(cart: Draft) -> None:
    cart.set(CHASSIS, "@name", 'a"<b>&amp;')

    assert cart.checked.model.links[0].name == 'a"<b>&amp;'
    assert cart.copy(("link", 'a"<b>&amp;')) == ("link", 'a"<b>&amp;_1')
