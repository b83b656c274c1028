"""Doubtful values of descriptions."""

from pathlib import Path

import pytest

from trundle.gazebo.check.check_file import check

BOX = '<collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>'


def findings(folder: Path, link: str, more: str = "") -> str:
    file = folder / "m.sdf"
    file.write_text(f'<sdf version="1.6"><model name="m"><link name="a">{link}</link>{more}</model></sdf>')
    return check(str(file), {}, start=folder).text()


@pytest.mark.parametrize(
    ("moment", "sentence"),
    [
        ("1", "is too large for 2 kg within 0.173 m (at most 0.06); it will turn far too slowly"),
        ("1e-7", "are tiny for 2 kg within 0.173 m"),
        ("0.0133", ""),
    ],
)
def test_an_inertia_is_held_against_mass_and_shape(tmp_path: Path, moment: str, sentence: str) -> None:
    """A 2 kg cube of 0.2 m has 0.0133 kg·m² about each axis."""
    tensor = "".join(f"<{tag}>{moment}</{tag}>" for tag in ("ixx", "iyy", "izz"))
    text = findings(tmp_path, f"<inertial><mass>2</mass><inertia>{tensor}</inertia></inertial>{BOX}")

    assert sentence in text
    assert ("moment" in text) == bool(sentence)


def test_joints_that_nothing_drives_and_names_that_ros_cannot_have_are_named(tmp_path: Path) -> None:
    joint = '<link name="2nd wheel"/><joint name="{}" type="revolute"><parent>a</parent><child>2nd wheel</child>'
    joint += "<axis><xyz>0 0 1</xyz></axis></joint>"
    plugin = '<plugin name="p" filename="libp.so"><joint>driven</joint></plugin>'

    assert "no plugin or transmission here names 'idle'" in findings(tmp_path, "", joint.format("idle") + plugin)
    text = findings(tmp_path, "", joint.format("driven") + plugin)
    assert "no plugin or transmission" not in text
    assert "'2nd wheel' is not a legal ROS name; on the graph and in tf it is 'n_2nd_wheel'" in text


@pytest.mark.parametrize(
    ("shape", "second", "overlaps"),
    [
        ("<box><size>1 1 1</size></box>", "0.4 0 0 0 0 0", True),
        ("<box><size>1 1 1</size></box>", "0.9 0 0 0 0 0", False),
        ("<box><size>4 1 1</size></box>", "0 1.5 0 0 0 1.5708", True),
        ("<cylinder><radius>1</radius><length>1</length></cylinder>", "0 0 0.4 0 0 0", True),
        ("<sphere><radius>1</radius></sphere>", "1.1 0 0 0 0 0", False),
    ],
)
def test_bodies_that_stand_in_one_another_and_cannot_move_are_named(tmp_path, shape, second, overlaps) -> None:
    """Touching shelves and walls are valid; a body whose middle is within another was added twice."""
    link = f'<link name="l"><collision name="c"><geometry>{shape}</geometry></collision></link>'
    models = [
        f'<model name="{name}"><static>true</static><pose>{pose}</pose>{link}</model>'
        for name, pose in (("a", "0 0 0 0 0 0"), ("b", second))
    ]
    file = tmp_path / "w.world"
    file.write_text(f'<sdf version="1.6"><world name="w">{"".join(models)}</world></sdf>')

    text = check(str(file), {}, start=tmp_path).text()

    assert ("model 'b' overlaps model 'a', and both are static" in text) == overlaps


def test_a_robot_with_no_mesh_found_is_reported_as_invisible_in_the_last_line(tmp_path: Path) -> None:
    lost = '<visual name="{}"><geometry><mesh><uri>lost/{}.dae</uri></mesh></geometry></visual>'
    box = '<visual name="box"><geometry><box><size>1 1 1</size></box></geometry></visual>'

    empty = findings(tmp_path, lost.format("v", "v") + lost.format("w", "w")).splitlines()[-1]

    assert "nothing is visible: none of its meshes was found (lost/v.dae and 1 more)" in empty
    assert "is visible" not in findings(tmp_path, lost.format("v", "v") + box)
