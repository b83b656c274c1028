"""A mimic joint, driven in C++ within the step."""

from pathlib import Path
from typing import Any

import pytest
from tests.gazebo.plugins.plugin_world import load

import trundle
from trundle.gazebo.plugins.mimic_joint import MimicJoint
from trundle.sim.simulation import Simulation

_LINK = """<link name="{0}"><inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>
</inertial></link><joint name="{1}" type="revolute"><parent>{2}</parent><child>{0}</child><axis><xyz>0 0 1</xyz></axis>
</joint>"""
_PLUGIN = """<plugin name="p" filename="libroboticsgroup_gazebo_mimic_joint_plugin.so"><joint>lead</joint>
<mimicJoint>tip</mimicJoint><multiplier>-2</multiplier><offset>0.1</offset>{}</plugin>"""


def _no_action(_: MimicJoint) -> None:
    return None


def _pair(folder: Path, extra: str, monkeypatch: pytest.MonkeyPatch | None = None) -> Simulation:
    """Return a world with a leader and a mimic joint; with `monkeypatch`, Python drives it at every step."""
    if monkeypatch is not None:
        monkeypatch.setattr(MimicJoint, "step_action", _no_action)
    body = _LINK.format("a", "lead", "world") + _LINK.format("b", "tip", "world")
    return load(folder, body + _PLUGIN.format(extra))


def _state_bytes(sim: Simulation) -> bytes:
    saved = sim.save().engine
    return saved.data.qpos.tobytes() + saved.data.qvel.tobytes() + saved.motors.states.tobytes()


@pytest.mark.parametrize(
    "extra",
    ["", "<hasPID/><maxEffort>0.5</maxEffort>", "<sensitiveness>0.05</sensitiveness>"],
    ids=["unlimited", "pid", "tolerance"],
)
def test_the_step_action_writes_the_same_bytes_as_python(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, extra: str
) -> None:
    sim = _pair(tmp_path, extra)
    states: list[bytes] = []

    def run(sim: Simulation) -> None:
        lead, tip = sim["m"].joint("lead"), sim["m"].joint("tip")
        for number, steps in enumerate((1, 90, 30, 200)):
            lead.command_effort((0.3, -0.8, 0.5, 0.0)[number])
            if number == 2:
                tip.command_effort(0.4, duration_s=0.01)
            if number == 3:
                sim.spawn(sim["m"].model, allow_renaming=True)
            sim.step(steps)
            states.append(_state_bytes(sim))

    run(sim)
    strides = _count_strides(sim, monkeypatch)
    sim.step(200)
    assert strides == [200]
    in_step_states, states = states, []
    run(_pair(tmp_path, extra, monkeypatch))

    assert in_step_states == states
    assert len(set(states)) == len(states)
    tip, lead = (sim["m"].joint(name).position for name in ("tip", "lead"))
    assert tip == pytest.approx(0.1 - 2 * lead, abs=0.1)


def _count_strides(sim: Simulation, monkeypatch: pytest.MonkeyPatch) -> list[int]:
    strides, step = list[int](), sim.engine.step

    def counted_step(count: int, recorders: Any) -> int:
        strides.append(count)
        return step(count, recorders)

    monkeypatch.setattr(sim.engine, "step", counted_step)
    return strides


_LIGHT = """<link name="{0}"><inertial><origin xyz="0.03 0 0"/><mass value="0.03"/>
<inertia ixx="4e-5" ixy="0" ixz="0" iyy="5e-6" iyz="0" izz="3.5e-5"/></inertial></link>
<joint name="{1}" type="continuous"><parent link="{2}"/><child link="{0}"/><axis xyz="0 0 1"/><origin xyz="{3} 0 0"/>
<limit effort="{4}" velocity="100"/></joint>"""
_COUPLED = """<gazebo><plugin name="{0}" filename="libroboticsgroup_gazebo_mimic_joint_plugin.so"><joint>lead</joint>
<mimicJoint>{0}</mimicJoint><multiplier>{1}</multiplier></plugin></gazebo>"""


def test_light_mimic_joints_of_a_gripper_follow_its_finger(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A four-bar finger: the tip turns back on a mimic joint; each has its motor's effort limit."""
    file = tmp_path / "gripper.urdf"
    file.write_text(
        '<robot name="gripper"><link name="world"/>'
        + _LIGHT.format("finger", "lead", "world", 0, 1000)
        + _LIGHT.format("knuckle", "inner", "world", 0.06, 0.1)
        + _LIGHT.format("end", "tip", "knuckle", 0.05, 0.1)
        + _COUPLED.format("inner", 1)
        + _COUPLED.format("tip", -1)
        + "</robot>"
    )
    sim = trundle.load(str(file), plugins=True)
    lead, inner, tip = (sim["gripper"].joint(name) for name in ("lead", "inner", "tip"))
    lead.command_position(0.8)

    for _ in range(30):
        sim.run(0.1)
        assert inner.position == pytest.approx(lead.position, abs=2e-3)
        assert tip.position == pytest.approx(-lead.position, abs=2e-3)

    assert lead.position == pytest.approx(0.8, abs=0.01)
    assert abs(tip.velocity) < 0.05
    assert _count_strides_of(sim, 100, monkeypatch) == [100], "no plugin acts between the steps"


def _count_strides_of(sim: Simulation, steps: int, monkeypatch: pytest.MonkeyPatch) -> list[int]:
    strides = _count_strides(sim, monkeypatch)
    sim.step(steps)
    return strides
