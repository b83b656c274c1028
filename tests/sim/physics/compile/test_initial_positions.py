"""A world saved while running starts from its saved link poses."""

from pathlib import Path

import pytest

import trundle
from trundle.sim.physics import compile_world
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

PARTS = """<link name="a"><pose>0 0 1 0 0 0</pose></link><link name="b"><pose>0.5 0 1 0 0.3 0</pose></link>
<link name="c"><pose>0.5 0.4 1.2 0.1 0 0</pose></link>
<joint name="outer" type="{outer}"><pose>-0.2 0 0.1 0 0 0</pose><parent>a</parent><child>b</child>{axes}</joint>
<joint name="inner" type="revolute"><parent>{c_or_b}</parent><child>{b_or_c}</child><axis><xyz>0 1 0</xyz>
<limit><lower>0</lower><upper>6</upper></limit></axis></joint>"""
AXIS = "<axis><xyz>0.6 0 0.8</xyz></axis>"
AXES = "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>"
SLOT = Pose.from_rpy(3.0, -1.0, 2.0, 0.4, -0.3, 2.0)


def world(folder: Path, parts: str, state: str = "") -> Path:
    file = folder / "w.world"
    model = f'<model name="m">{parts}</model>'
    file.write_text(f'<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity>{model}{state}</world></sdf>')
    return file


def saved(sim: Simulation) -> str:
    """World as saved by Gazebo: the pose of each link."""
    links = "".join(
        f'<link name="{name}"><pose>{" ".join(map(repr, sim["m"].link(name).pose.as_list()))}</pose></link>'
        for name in ("a", "b", "c")
    )
    model_pose = " ".join(map(repr, sim["m"].pose.as_list()))
    return f'<state world_name="w"><model name="m"><pose>{model_pose}</pose>{links}</model></state>'


@pytest.mark.parametrize(
    ("outer", "axes", "positions"),
    [
        ("revolute", AXIS, (0.7,)),
        ("revolute", AXIS, (-2.9,)),
        ("prismatic", AXIS, (0.35,)),
        ("universal", AXES, (0.8, -0.6)),
        ("revolute2", AXES, (-2.0, 0.5)),
    ],
)
@pytest.mark.parametrize("turned", [False, True])
def test_joint_positions_follow_the_saved_link_poses(tmp_path, outer, axes, positions, turned) -> None:
    ends = {"c_or_b": "c" if turned else "b", "b_or_c": "b" if turned else "c"}
    parts = PARTS.format(outer=outer, axes=axes, **ends)
    before = trundle.load(str(world(tmp_path, parts)))
    before["m"].set_pose(SLOT)
    for i, position in enumerate(positions):
        before["m"].joint("outer").set_position(position, axis=i)
    before["m"].joint("inner").set_position(4.0)

    after = trundle.load(str(world(tmp_path, parts, saved(before))))

    assert after["m"].joint("outer").positions == pytest.approx(positions, abs=1e-6)
    assert after["m"].joint("inner").position == pytest.approx(4.0, abs=1e-6)
    for name in "abc":
        assert after["m"].link(name).pose.as_list() == pytest.approx(before["m"].link(name).pose.as_list(), abs=1e-6)
    assert not [finding for finding in after.report.findings if "cannot reach the saved pose" in finding.what]
    after.run(0.01)
    after.reset()
    assert after["m"].joint("outer").positions == pytest.approx(positions, abs=1e-6)


def test_a_ball_joint_starts_at_its_saved_orientation(tmp_path: Path) -> None:
    parts = PARTS.format(outer="ball", axes="", c_or_b="b", b_or_c="c")
    before = trundle.load(str(world(tmp_path, parts)))
    before["m"].joint("outer").command_effort(2.0, axis=1)
    before.run(0.4)
    before["m"].joint("inner").set_position(1.0)

    after = trundle.load(str(world(tmp_path, parts, saved(before))))

    turned = before["m"].joint("outer").positions
    assert max(map(abs, turned)) > 0.02
    assert after["m"].joint("outer").positions == pytest.approx(turned, abs=1e-6)


def test_an_unreachable_saved_pose_is_reported(tmp_path: Path) -> None:
    parts = PARTS.format(outer="revolute", axes=AXIS, c_or_b="b", b_or_c="c")
    sim = trundle.load(str(world(tmp_path, parts)))
    state = saved(sim).replace('<link name="c"><pose>', '<link name="c"><pose>9')

    after = trundle.load(str(world(tmp_path, parts, state)))

    messages = [
        str(finding) for finding in after.report.findings if "its joints cannot reach the saved pose" in finding.what
    ]
    assert len(messages) == 1
    assert "link 'c'" in messages[0]


def test_a_world_without_a_saved_state_has_no_initial_qpos(tmp_path: Path) -> None:
    sim = trundle.load(str(world(tmp_path, PARTS.format(outer="revolute", axes=AXIS, c_or_b="b", b_or_c="c"))))

    assert compile_world(sim.world, sim.report).initial_qpos is None


@pytest.mark.parametrize("turned", [False, True])
def test_joints_start_at_and_reset_to_their_initial_positions(tmp_path: Path, turned: bool) -> None:
    ends = {"c_or_b": "c" if turned else "b", "b_or_c": "b" if turned else "c"}
    started = "<initial_position>0.4</initial_position>"
    parts = PARTS.format(outer="prismatic", axes=AXIS.replace("</axis>", f"{started}</axis>"), **ends)
    parts = parts.replace("<limit>", f"{started.replace('0.4', '2.5')}<limit>")

    sim = trundle.load(str(world(tmp_path, parts)))

    assert [sim["m"].joint(name).position for name in ("outer", "inner")] == pytest.approx([0.4, 2.5])
    sim["m"].joint("inner").set_position(1.0)
    sim.reset()
    assert sim["m"].joint("inner").position == pytest.approx(2.5)
    assert sum("starts at its <initial_position>" in finding.what for finding in sim.report.findings) == 2


def test_a_saved_state_overrides_initial_positions(tmp_path: Path) -> None:
    axis = AXIS.replace("</axis>", "<initial_position>0.4</initial_position></axis>")
    parts = PARTS.format(outer="revolute", axes=axis, c_or_b="b", b_or_c="c")
    before = trundle.load(str(world(tmp_path, parts)))
    before["m"].joint("outer").set_position(-0.3)

    after = trundle.load(str(world(tmp_path, parts, saved(before))))

    assert after["m"].joint("outer").position == pytest.approx(-0.3)
