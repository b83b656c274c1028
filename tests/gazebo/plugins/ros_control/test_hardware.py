"""A PositionJointInterface moves a joint's child side and nothing else, as Gazebo's Joint::SetPosition does."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

import trundle
from trundle.gazebo.plugins.ros_control.hardware import JointHardware
from trundle.sim.simulation import Simulation

_FLOOR = """<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane>
<normal>0 0 1</normal></plane></geometry></collision></link></model>"""


def _link(name: str, pose: str, mass: float, size: tuple[float, float, float]) -> str:
    x, y, z = size
    moments = [mass * (a * a + b * b) / 12 for a, b in ((y, z), (x, z), (x, y))]
    ixx, iyy, izz = (f"<{name}>{value}</{name}>" for name, value in zip(("ixx", "iyy", "izz"), moments, strict=True))
    return f"""<link name="{name}"><pose>{pose} 0 0 0</pose><inertial><mass>{mass}</mass><inertia>{ixx}{iyy}{izz}
    </inertia></inertial><collision name="c"><geometry><box><size>{x} {y} {z}</size></box></geometry></collision>
    </link>"""


def _joint(name: str, kind: str, parent: str, child: str, axis: str, pose: str, limit: str) -> str:
    return f"""<joint name="{name}" type="{kind}"><pose>{pose} 0 0 0</pose><parent>{parent}</parent><child>{child}
    </child><axis><xyz>{axis}</xyz><limit>{limit}</limit></axis></joint>"""


def _load(folder: Path, models: str) -> Simulation:
    file = folder / "w.sdf"
    file.write_text(f'<sdf version="1.7"><world name="w">{models}{_FLOOR}</world></sdf>')
    return trundle.load(str(file))


def _arm_on_a_free_base(limit: str) -> str:
    """Return an arm of 4 kg and 0.4 m, on a pan of 2 kg, on a free base of 10 kg."""
    return f"""<model name="m">{_link("base", "0 0 0.1", 10.0, (0.4, 0.4, 0.2))}
    {_link("pan", "0 0 0.25", 2.0, (0.1, 0.1, 0.1))}{_link("arm", "0.2 0 0.35", 4.0, (0.4, 0.05, 0.05))}
    {_joint("turn", "revolute", "base", "pan", "0 0 1", "0 0 -0.05", limit)}
    {_joint("lift", "revolute", "pan", "arm", "0 1 0", "-0.2 0 0", limit)}</model>"""


def _engage(sim: Simulation, *names: str) -> list[JointHardware]:
    joints = [JointHardware(sim["m"].joint(name), "PositionJointInterface", None, lag_s=0.005) for name in names]
    for joint in joints:
        joint.read()
        joint.start()
    return joints


def _control(sim: Simulation, joints: list[JointHardware], steps: int, record: Callable[[], None]) -> None:
    for _ in range(steps):
        for joint in joints:
            joint.read()
            joint.write(0.001)
        sim.step()
        record()


@pytest.mark.parametrize(
    ("limit", "steps"),
    [
        ("", 40),
        ("<velocity>100</velocity>", 40),
        ("<velocity>10</velocity><effort>60</effort>", 150),
        ("<velocity>3</velocity><effort>1</effort>", 430),
        ("<velocity>3</velocity><effort>0</effort>", 430),
    ],
)
def test_an_arm_reaches_its_target_and_its_free_base_does_not_move(tmp_path: Path, limit: str, steps: int) -> None:
    """With reaction forces on the base, it would move by 2 mm to 13 m."""
    sim = _load(tmp_path, _arm_on_a_free_base(limit))
    joints = _engage(sim, "turn", "lift")
    base = sim["m"].link("base")
    _control(sim, joints, 300, lambda: None)
    start, offsets = base.pose, [(0.0, 0.0)]

    def record() -> None:
        moved = start.inverse() @ base.pose
        offsets.append((math.hypot(*moved.position), 2 * math.hypot(*moved.quaternion[1:])))

    joints[0].command, joints[1].command = 1.0, -1.2
    _control(sim, joints, steps, record)
    positions = [joint.handle.position for joint in joints]
    _control(sim, joints, 500, record)

    assert positions == pytest.approx([1.0, -1.2], abs=0.01)
    assert max(far for far, _ in offsets) < 1e-4
    assert max(tilt for _, tilt in offsets) < 1e-4


def test_bending_legs_lower_their_body(tmp_path: Path) -> None:
    """The feet touch the floor, so the body moves by the joints' displacement."""
    links, limit = _link("base", "0 0 0.5", 8.0, (0.5, 0.3, 0.1)), "<velocity>10</velocity><effort>100</effort>"
    for i, (x, y) in enumerate((x, y) for x in (0.2, -0.2) for y in (0.2, -0.2)):
        links += _link(f"leg{i}", f"{x} {y} 0.35", 0.5, (0.04, 0.04, 0.3))
        links += _joint(f"hip{i}", "prismatic", "base", f"leg{i}", "0 0 1", "0 0 0", limit)
    sim = _load(tmp_path, f'<model name="m"><pose>0 0 -0.2 0 0 0</pose>{links}</model>')
    joints = _engage(sim, *(f"hip{i}" for i in range(4)))
    _control(sim, joints, 300, lambda: None)
    before = sim["m"].link("base").pose.position[2]
    for step in range(1, 501):
        for joint in joints:
            joint.command = 1e-4 * step
        _control(sim, joints, 1, lambda: None)
    _control(sim, joints, 100, lambda: None)

    assert sim["m"].link("base").pose.position == pytest.approx((0.0, 0.0, before - 0.05), abs=5e-4)


def test_a_joint_blocked_by_a_wall_pushes_with_its_effort_limit(tmp_path: Path) -> None:
    limit = "<velocity>3</velocity><effort>5</effort>"
    wall = f"""<model name="wall"><static>true</static><pose>0.3 0.35 0.35 0 0 0</pose>
    {_link("l", "0 0 0", 1.0, (0.2, 0.2, 0.3))}</model>"""
    sim = _load(tmp_path, _arm_on_a_free_base(limit) + wall)
    joints = _engage(sim, "turn", "lift")
    joints[0].command = 1.5
    _control(sim, joints, 1500, lambda: None)

    assert joints[0].handle.position < 1.1
    assert joints[0].handle.effort == pytest.approx(5.0, rel=0.01)
    assert math.hypot(*sim["m"].link("base").twist.linear) < 1e-3
    joints[0].command = 0.0
    _control(sim, joints, 1000, lambda: None)
    assert joints[0].handle.position == pytest.approx(0.0, abs=1e-3)


@pytest.mark.parametrize("command", ["interface", "set_position"])
def test_closing_fingers_do_not_move_a_box(tmp_path: Path, command: str) -> None:
    """The fingers are commanded 2 cm into the box from either side; one arrives first."""
    limit = "<lower>-0.1</lower><upper>0.1</upper>"
    hand = f"""{_link("palm", "0 0 0.3", 5.0, (0.2, 0.1, 0.05))}{_link("left", "-0.08 0 0.23", 0.1, (0.02, 0.04, 0.1))}
    {_link("right", "0.08 0 0.23", 0.1, (0.02, 0.04, 0.1))}
    {_joint("a", "prismatic", "palm", "left", "1 0 0", "0 0 0", limit)}
    {_joint("b", "prismatic", "palm", "right", "-1 0 0", "0 0 0", limit)}
    <joint name="fix" type="fixed"><parent>world</parent><child>palm</child></joint>"""
    box = f"""<model name="box"><pose>0.005 0 0.2 0 0 0</pose>{_link("l", "0 0 0", 0.5, (0.06, 0.06, 0.06))}</model>
    <model name="stand"><static>true</static><pose>0 0 0.085 0 0 0</pose>{_link("l", "0 0 0", 1.0, (0.1, 0.1, 0.17))}
    </model>"""
    sim = _load(tmp_path, f'<model name="m">{hand}</model>{box}')
    joints = _engage(sim, "a", "b")
    _control(sim, joints, 100, lambda: None)
    for joint in joints:
        joint.command = 0.06
    max_speed = 0.0
    for _ in range(1000):
        for joint in joints:
            if command == "interface":
                joint.read()
                joint.write(0.001)
            else:
                joint.handle.set_position(0.06)
        sim.step()
        max_speed = max(max_speed, math.hypot(*sim["box"].base.twist.linear))

    assert sim["box"].pose.position == pytest.approx((0.0, 0.0, 0.2), abs=0.006)
    assert max_speed < 3.0
    assert math.hypot(*sim["box"].base.twist.linear) < 0.01
