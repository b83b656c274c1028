"""<experimental:params>: changes of an <include> to the included model."""

from pathlib import Path

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load
from trundle.robots.model import Model, Sphere
from trundle.robots.packages import Packages

ARM = """<sdf version="1.9"><model name="arm">
  <link name="upper"><inertial><mass>2</mass></inertial>
    <visual name="skin"><geometry><sphere><radius>1</radius></sphere></geometry><transparency>0.5</transparency>
    </visual><visual name="stripe"><geometry><sphere><radius>2</radius></sphere></geometry></visual></link>
  <link name="lower"/>
</model></sdf>"""


def changed(folder: Path, params: str) -> tuple[Model, Diagnostics]:
    (folder / "arm.sdf").write_text(ARM)
    (folder / "x.sdf").write_text(
        '<sdf version="1.9" xmlns:experimental="http://sdformat.org/schemas/experimental"><world name="w"><include>\n'
        f"<uri>arm.sdf</uri><experimental:params>\n{params}</experimental:params></include></world></sdf>"
    )
    report = Diagnostics()
    loaded = load(str(folder / "x.sdf"), report, packages=Packages({}, start=folder))
    return loaded.world.models[0], report


def test_elements_are_added_modified_replaced_and_removed(tmp_path: Path) -> None:
    arm, report = changed(
        tmp_path,
        '<visual element_id="upper::skin" action="modify"><transparency>0.25</transparency></visual>'
        '<visual element_id="upper::stripe" action="remove"/>'
        '<link element_id="lower"><inertial action="add"><mass>3</mass></inertial></link>'
        '<link element_id="upper"><inertial action="replace"><mass>4</mass></inertial></link>'
        '<frame element_id="" name="tip" action="add"><pose>1 0 0 0 0 0</pose></frame>'
        '<visual element_id="lower" name="ball" action="add"><geometry><sphere><radius>3</radius></sphere></geometry>'
        "</visual>",
    )

    assert [visual.name for visual in arm.link("upper").visuals] == ["skin"]
    assert arm.link("upper").visuals[0].transparency == 0.25
    assert arm.link("upper").inertial.mass == 4
    assert arm.link("lower").inertial.mass == 3
    assert arm.link("lower").visuals[0].geometry == Sphere(3)
    assert [frame.name for frame in arm.frames] == ["tip"]
    assert report.warnings == []


def test_a_nested_element_can_be_removed(tmp_path: Path) -> None:
    arm, report = changed(
        tmp_path,
        '<link element_id="upper"><inertial action="remove"><mass/></inertial>'
        '<visual name="stripe" action="remove"/></link>',
    )

    assert arm.link("upper").inertial.mass == 1
    assert [visual.name for visual in arm.link("upper").visuals] == ["skin"]
    assert report.warnings == []


def test_an_impossible_change_is_reported_with_its_line(tmp_path: Path) -> None:
    _, report = changed(
        tmp_path,
        '<visual element_id="upper::lost" action="remove"/>\n'
        "<visual action='remove'/>\n"
        '<link element_id="upper" action="paint"/>\n'
        '<visual element_id="upper::skin" action="modify"><pose>1 0 0 0 0 0</pose></visual>\n'
        '<link element_id="upper"><sensor name="s" action="remove"/></link>',
    )

    warnings = [line.removeprefix(f"{tmp_path}/x.sdf:") for line in report.warnings]
    assert warnings == [
        "3: warning: <experimental:params>: no <visual> 'upper::lost' in the included model; it is left out",
        "4: warning: <visual> without element_id in <experimental:params>; it is left out",
        "5: warning: <link>: action 'paint' is unknown; actions: add, modify, remove, replace; it is left out",
        "6: warning: <experimental:params>: no <pose> to modify in <visual>; it is left out",
        "7: warning: <experimental:params>: no <sensor> in <link>; it is left out",
    ]


def test_a_fault_in_an_added_element_is_reported_with_its_own_line(tmp_path: Path) -> None:
    _, report = changed(tmp_path, '<link element_id="lower"><gravity action="add">maybe</gravity></link>')

    assert report.warnings[0].startswith(f"{tmp_path}/x.sdf:3: warning: <gravity>: 'maybe' is neither true nor false")


def test_an_attribute_with_an_undeclared_prefix_is_left_out(tmp_path: Path) -> None:
    arm, report = changed(
        tmp_path,
        '<visual element_id="upper::skin" action="modify" my::a="1">\n<transparency my:a="1">0.25</transparency>'
        '</visual><my::b element_id="lower" action="add" my::c="1"/>',
    )

    assert arm.link("upper").visuals[0].transparency == 0.25
    assert [warning.partition("warning: ")[2] for warning in report.warnings[1:]] == [
        "attribute 'my::a' has an undeclared prefix; it is left out",
        "attribute 'my:a' has an undeclared prefix; it is left out",
        "<my::b> in <link> is not supported; it is ignored",
    ]
