"""What a description may say and hardly ever means."""

from pathlib import Path

import pytest

from trundle.bringup.check import check

BOX = '<collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>'


def findings(folder: Path, link: str, more: str = "") -> str:
    file = folder / "m.sdf"
    file.write_text(f'<sdf version="1.6"><model name="m"><link name="a">{link}</link>{more}</model></sdf>')
    return check(str(file), {}, start=folder).text()


@pytest.mark.parametrize(
    ("moment", "sentence"),
    [
        ("1", "belongs to no body of 2 kg within 0.173 m, whose largest is 0.06; it will turn far too slowly"),
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
    assert "'2nd wheel' is no name ROS can have; on the graph and in tf it is 'n_2nd_wheel'" in text
