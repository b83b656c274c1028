"""Arms in compiled programs: robot model, states, inverse kinematics, trajectories."""

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running

pytestmark = pytest.mark.slow


def _urdf() -> str:
    """A chain of six joints with two segments and a wrist whose axes meet, and a gripper of two fingers."""
    origins = ("0 0 0.3", "0 0 0", "0 0 0.4", "0 0 0", "0 0 0.3", "0 0 0.1")
    axes = ("0 0 1", "0 1 0", "0 1 0", "0 0 1", "0 1 0", "0 0 1")
    shape = '<collision><geometry><box size="0.05 0.05 0.05"/></geometry></collision>'
    links = "".join(f'<link name="l{i}">{shape}</link>' for i in range(1, 7))
    joints = "".join(
        f'<joint name="j{i + 1}" type="revolute"><parent link="{"base" if i == 0 else f"l{i}"}"/>'
        f'<child link="l{i + 1}"/>'
        f'<origin xyz="{origins[i]}"/><axis xyz="{axes[i]}"/>'
        f'<limit lower="{-2.0 if i == 1 else -2.8}" upper="{2.0 if i == 1 else 2.8}" effort="50" velocity="2"/></joint>'
        for i in range(6)
    )
    fingers = "".join(
        f'<link name="{name}_tip"/><joint name="{name}" type="prismatic"><parent link="l6"/><child link="{name}_tip"/>'
        f'<axis xyz="0 {side} 0"/><limit lower="0" upper="0.04" effort="5" velocity="0.1"/>{mimic}</joint>'
        for name, side, mimic in (("finger", 1, ""), ("thumb", -1, '<mimic joint="finger"/>'))
    )
    return f'<robot name="elbow"><link name="base">{shape}</link>{links}{joints}{fingers}</robot>'


_SRDF = """<robot name="elbow">
  <group name="whole"><group name="arm"/><group name="hand"/></group>
  <group name="arm"><chain base_link="base" tip_link="l6"/></group>
  <group name="hand"><joint name="finger"/><joint name="thumb"/></group>
  <group_state name="ready" group="arm">
    <joint name="j1" value="0"/><joint name="j2" value="0.5"/><joint name="j3" value="1.2"/><joint name="j4" value="0"/>
    <joint name="j5" value="1.0"/><joint name="j6" value="0"/>
  </group_state>
  <end_effector name="gripper" parent_link="l6" group="hand"/>
  <virtual_joint name="fixed_base" type="fixed" parent_frame="world" child_link="base"/>
  <disable_collisions link1="base" link2="l1" reason="Adjacent"/>
</robot>"""


def _describe(graph: Graph, srdf: str = _SRDF) -> None:
    node = graph.node("tester")
    limits = {
        "has_velocity_limits": True,
        "max_velocity": 1.5,
        "has_acceleration_limits": True,
        "max_acceleration": 3.0,
    }
    for name, value in {
        "/robot_description": _urdf(),
        "/robot_description_semantic": srdf,
        "/robot_description_planning/joint_limits/j1": limits,
    }.items():
        graph.loop.run(node.params.set(name, value))


def _started(running: Running, program: str) -> str:
    if not (running.folder / "cpp_arm" / program).exists():
        pytest.skip("this machine has no Eigen for C++")
    output, _ = running.start(program, package="cpp_arm").communicate(timeout=WAIT_S)
    return output


def test_models_states_and_trajectories_are_those_of_the_description(running: Running, graph: Graph) -> None:
    _describe(graph)
    output = _started(running, "arm")

    assert re.search(r"^\d{3,} checks, 0 failed$", output, re.MULTILINE), output


@pytest.mark.parametrize(
    ("srdf", "fault"),
    [
        ("<robot", "SRDF, line 1:"),
        ("<a>" * 100_000, "there are too many elements in elements"),
        ("<group/>", "Could not find the 'robot' element in the SRDF"),
        (_SRDF.replace('tip_link="l6"', 'tip_link="l9"'), "Link 'l9' declared as part of group 'arm'"),
        (_SRDF.replace('<group name="arm"/>', '<group name="whole"/>'), "Could not process group 'whole'"),
        (_SRDF.replace('value="0.5"', 'value="half"'), "Unable to parse joint value 'half' for joint 'j2'"),
    ],
)
def test_a_fault_of_the_semantic_description_is_named(running: Running, graph: Graph, srdf: str, fault: str) -> None:
    _describe(graph, srdf)

    assert fault in _started(running, "arm")


def test_a_program_moves_an_arm_by_move_group(running: Running, graph: Graph, tmp_path: Path) -> None:
    node = graph.node("tester")
    words = ["launch", "arm_moveit_config", "demo.launch", "use_rviz:=false", "--headless"]
    environment = {**running.environment, "ROS_HOME": str(tmp_path)}
    command = [sys.executable, "-m", "trundle", *words]
    with subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as launch:
        try:
            until(lambda: graph.loop.run(node.params.search("/robot_description_semantic")))
            output = _started(running, "mover")
        finally:
            launch.terminate()
        assert launch.stdout is not None
        log = launch.stdout.read()
    lines = [line for line in output.splitlines() if not re.match(r"\S*\[", line)]

    assert lines == [
        "arm world hand_link",
        "named 1",
        "table 1 1",
        "plan 1 1",
        "execute 1",
        "reached 1",
        "cartesian 1",
        "far 0",
        "cleared 0",
    ], output + log


def test_a_program_shows_the_way_of_an_arm_step_by_step(running: Running, graph: Graph) -> None:
    """The tip goes from 1.1 m above the base to 0.8 m before it; buttons of the topic lead on."""
    _describe(graph)
    node = graph.node("tester")
    shown: list[Any] = []
    states: list[Any] = []
    scenes: list[Any] = []
    node.subscribe("/rviz_visual_tools", "visualization_msgs/MarkerArray", shown.append)
    node.subscribe("/display_robot_state", "moveit_msgs/DisplayRobotState", states.append)
    node.subscribe("/planning_scene", "moveit_msgs/PlanningScene", scenes.append)
    buttons = node.advertise("/rviz_visual_tools_gui", "sensor_msgs/Joy", queue_size=5)
    if not (running.folder / "cpp_arm/shower").exists():
        pytest.skip("this machine has no Eigen for C++")
    program = running.start("shower", package="cpp_arm")

    until(lambda: shown and buttons.has_subscribers)
    until(lambda: buttons.publish({"buttons": [0, 1]}) or (states and scenes))
    until(lambda: buttons.publish({"buttons": [0, 0, 0, 1]}) or program.poll() is not None)
    output, _ = program.communicate(timeout=WAIT_S)

    markers = {(marker.ns, marker.type): marker for marker in shown[0].markers}
    assert shown[0].markers[0].action == 3  # DELETEALL
    assert [marker.text for marker in shown[0].markers if marker.type == 9] == ["Way of the tip", "tip"]
    way = [(point.x, point.z) for point in markers["Path", 4].points]
    assert way == [pytest.approx((0.0, 1.1)), pytest.approx((0.8, 0.3))]
    assert len([marker for marker in shown[0].markers if marker.ns == "tip"]) == 3
    state = dict(zip(states[-1].state.joint_state.name, states[-1].state.joint_state.position, strict=True))
    assert state["j2"] == pytest.approx(1.5708, abs=1e-4)
    assert {color.id for color in states[-1].highlight_links} == {"base", *(f"l{i}" for i in range(1, 7))}
    block = scenes[-1].world.collision_objects[0]
    assert (block.id, list(block.primitives[0].dimensions)) == ("block", pytest.approx([0.2, 0.2, 0.4]))
    assert "Waiting to continue: see the line... continuing\n" in output
    assert re.findall(r"^(line|short|empty) (\d)$", output, re.MULTILINE) == [
        ("line", "1"),
        ("short", "0"),
        ("empty", "0"),
    ], output
