"""Pairs of links are left out for MoveIt's reasons."""

from tests.planning.arms import arm

from trundle.base.diagnostics import Diagnostics
from trundle.planning.robot_model import robot_model
from trundle.planning.setup_assistant import find_disabled_pairs

_BOX = "<geometry><box size='0.1 0.1 0.1'/></geometry>"


def _reasons(urdf: str) -> dict[tuple[str, str], str]:
    report = Diagnostics()
    pairs = find_disabled_pairs(robot_model(urdf, None, None, report), packages=None, report=report, trials=400)
    assert report.findings == []
    return {(pair.link1, pair.link2): pair.reason for pair in pairs}


def _link(name: str, x: float) -> str:
    return f"<link name='{name}'><collision><origin xyz='{x} 0 0'/>{_BOX}</collision></link>"


def _joint(name: str, type_: str, parent: str, child: str) -> str:
    limit = "<limit lower='-3' upper='3' effort='1' velocity='1'/>"
    return f"""<joint name='{name}' type='{type_}'><parent link='{parent}'/><child link='{child}'/><axis xyz='0 0 1'/>
      {limit}</joint>"""


def test_each_reason() -> None:
    """Boxes on a bar turn about z: one at the same place, one that may hit, one that never does."""
    urdf = f"""<robot name='r'>{_link("base", 0.0)}<link name='empty'/>{_link("turning", 0.3)}{_link("inside", 0.31)}
      {_link("far", 0.6)}{_link("beside", -0.3)}{_link("over", 0.3)}
      {_joint("a", "fixed", "base", "empty")}{_joint("b", "revolute", "empty", "turning")}
      {_joint("c", "fixed", "turning", "plate")}<link name='plate'/>
      {_joint("e", "fixed", "base", "far")}{_joint("f", "fixed", "base", "beside")}
      {_joint("g", "revolute", "base", "over")}{_joint("h", "fixed", "far", "inside")}</robot>"""
    reasons = _reasons(urdf)

    assert reasons["base", "turning"] == "Adjacent"  # the link between them has no shape
    assert reasons["base", "far"] == reasons["base", "beside"] == reasons["base", "over"] == "Adjacent"
    assert reasons["turning", "over"] == "Default"  # both at 0.3 m
    assert reasons["turning", "inside"] == "Default"
    assert reasons["turning", "far"] == "Never"
    assert ("turning", "beside") not in reasons  # they may meet
    assert ("over", "beside") not in reasons


def test_what_touches_in_nearly_every_state_is_always() -> None:
    """In the default state, out of the middle, the slide is clear of the stop; elsewhere it is not."""
    slide = "<joint name='s' type='prismatic'><parent link='base'/><child link='slide'/><axis xyz='1 0 0'/>"
    slide += "<limit lower='-0.01' upper='1' effort='1' velocity='1'/></joint>"
    long_box = "<collision><origin xyz='0.61 0 0'/><geometry><box size='1 0.1 0.1'/></geometry></collision>"
    urdf = f"""<robot name='r'>{_link("base", 0.0)}<link name='slide'>{long_box}</link>
      <link name='stop'><collision><origin xyz='1.17 0 0'/>{_BOX}</collision></link>
      {slide}{_joint("f", "fixed", "mount", "stop")}<link name='mount'/>
      {_joint("m", "fixed", "base", "mount")}</robot>"""
    reasons = _reasons(urdf)

    assert reasons["stop", "slide"] == "Always"
    assert reasons["base", "stop"] == "Adjacent"


def test_the_same_robot_has_the_same_pairs() -> None:
    model = arm("seven_axis")
    twice = [find_disabled_pairs(model, packages=None, report=Diagnostics(), trials=100) for _ in range(2)]

    assert twice[0] == twice[1]
    assert {pair.reason for pair in twice[0]} == {"Adjacent", "Default", "Never"}
