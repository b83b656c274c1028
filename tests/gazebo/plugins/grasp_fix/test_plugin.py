"""Two fingers that close on a box, lift it and release it."""

from pathlib import Path

import pytest

import trundle
from trundle.gazebo.model_plugins import load_plugins
from trundle.sim.simulation import Simulation

_BODY = "<inertial><mass>{}</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>"
_SHAPE = """<collision name="c"><geometry><box><size>{}</size></box></geometry>
<surface><friction><ode><mu>0.05</mu><mu2>0.05</mu2></ode></friction></surface></collision>"""
_FINGER = """<link name="{name}"><pose>{x} 0 1 0 0 0</pose>{body}{shape}</link><joint name="{name}_joint"
type="prismatic"><parent>palm</parent><child>{name}</child><axis><xyz>{direction} 0 0</xyz></axis></joint>"""
_ARM = """<arm><arm_name>hand</arm_name><palm_link>palm</palm_link><gripper_link>left</gripper_link>
<gripper_link>right</gripper_link></arm>"""


def hand(plugin: str = _ARM) -> str:
    """Return a palm on a vertical slider, with two slippery fingers beside the box."""
    fingers = "".join(
        _FINGER.format(name=name, x=x, direction=direction, body=_BODY.format(0.2), shape=_SHAPE.format("0.02 0.1 0.1"))
        for name, x, direction in (("left", -0.1, 1), ("right", 0.1, -1))
    )
    return f"""<model name="robot"><link name="palm"><pose>0 0 1.3 0 0 0</pose>{_BODY.format(1)}</link>
<joint name="lift" type="prismatic"><parent>world</parent><child>palm</child><axis><xyz>0 0 1</xyz></axis></joint>
{fingers}<plugin name="grasp" filename="libgazebo_grasp_fix.so">{plugin}</plugin></model>"""


def table(folder: Path, robot: str) -> Simulation:
    """Return a world with the hand above a box of 0.5 kg on a table."""
    top = '<collision name="t"><geometry><box><size>1 1 0.2</size></box></geometry></collision>'
    models = f"""<model name="table"><static>1</static><pose>0 0 0.85 0 0 0</pose><link name="l">{top}</link></model>
<model name="box"><pose>0 0 1 0 0 0</pose><link name="body">{_BODY.format(0.5)}{_SHAPE.format("0.1 0.1 0.1")}</link>
</model>{robot}"""
    file = folder / "w.sdf"
    file.write_text(f'<sdf version="1.6"><world name="w">{models}</world></sdf>')
    sim = trundle.load(str(file))
    load_plugins(sim, None, {}, log=lambda _: None)
    sim["robot"].joint("lift").command_position(0.0)
    return sim


def close(sim: Simulation, force: float) -> None:
    """Close the fingers with a force [N]; a negative force opens them."""
    for name in ("left", "right"):
        sim["robot"].joint(f"{name}_joint").command_effort(force)


def height(sim: Simulation) -> float:
    return sim["box"].pose.position[2]


def test_a_held_box_is_lifted_and_falls_when_the_fingers_open(tmp_path: Path) -> None:
    """With mu = 0.05 the fingers' 5 N alone cannot lift 0.5 kg."""
    sim = table(tmp_path, hand())
    assert sim.report.warnings == []
    close(sim, 5.0)
    sim.run(1.0)
    assert not sim.joints, "at 5 Hz, more than 5 updates are needed"
    sim.run(1.0)
    assert [joint.name for joint in sim.joints] == ["robot::hand::grasp"]

    sim["robot"].joint("lift").command_position(0.3)
    sim.run(2.0)
    assert height(sim) == pytest.approx(1.3, abs=0.01)

    close(sim, -1.0)
    sim.run(2.0)
    assert not sim.joints
    assert height(sim) == pytest.approx(1.0, abs=0.01)


def test_fingers_that_move_within_the_tolerance_keep_the_box(tmp_path: Path) -> None:
    tolerance = "<release_tolerance>0.1</release_tolerance>"
    sim = table(tmp_path, hand(f"{_ARM}{tolerance}<update_rate>20</update_rate>"))
    close(sim, 5.0)
    sim.run(1.0)
    for name in ("left", "right"):
        sim["robot"].joint(f"{name}_joint").command_position(0.0)  # 4 cm away from the box
    sim.run(1.0)
    assert len(sim.joints) == 1


def test_disable_collisions_on_attach_removes_the_contacts_of_a_held_box(tmp_path: Path) -> None:
    tolerance = "<release_tolerance>0.02</release_tolerance>"
    sim = table(tmp_path, hand(f"{_ARM}{tolerance}<disable_collisions_on_attach>true</disable_collisions_on_attach>"))
    for name in ("left", "right"):
        sim["robot"].joint(f"{name}_joint").command_position(
            0.05, max_effort=5.0
        )  # 1 cm into the box, without collisions
    sim.run(2.0)
    assert not sim.contacts(frozenset({"box::body::c"}))
    sim["robot"].joint("lift").command_position(0.3)
    sim.run(2.0)
    assert height(sim) == pytest.approx(1.3, abs=0.01)
    sim.reset()
    sim.run(0.5)
    assert height(sim) == pytest.approx(1.0, abs=1e-3)
    assert sim.contacts(frozenset({"box::body::c"})), "a released box has contacts again"


def test_forces_from_one_side_hold_nothing(tmp_path: Path) -> None:
    sim = table(tmp_path, hand())
    sim["robot"].joint("left_joint").command_effort(5.0)
    sim.run(3.0)
    assert not sim.joints


def test_grasps_are_deterministic(tmp_path: Path) -> None:
    states: list[bytes] = []
    for _ in range(2):
        sim = table(tmp_path, hand())
        close(sim, 5.0)
        sim.run(2.5)
        states.append(sim.snapshot().poses.tobytes() + sim.snapshot().twists.tobytes())
    assert states[0] == states[1]


@pytest.mark.parametrize(
    ("plugin", "message"),
    [
        ("", "it needs an <arm> with fingers"),
        (_ARM.replace(">palm<", ">wrist<"), "no link 'wrist'"),
        (_ARM.replace(">left<", ">thumb<"), "no link 'thumb'; links here: 'palm', 'left', 'right'; it is left out"),
        (f"{_ARM}{_ARM}", "arm 'hand': another arm has this name"),
        (f"{_ARM}<forces_angle_tolerance>60</forces_angle_tolerance>", "nothing is ever held"),
        (f"{_ARM}<contact_topic>touch</contact_topic>", "<contact_topic> is ignored"),
        (f"{_ARM}<update_rate>0</update_rate>", "<update_rate> must be ≥ 1, got 0; 5 is used"),
        (f"{_ARM}<grip>1</grip>", "<grip>"),
    ],
)
def test_an_invalid_gripper_is_reported(tmp_path: Path, plugin: str, message: str) -> None:
    sim = table(tmp_path, hand(plugin))
    assert any(message in warning for warning in sim.report.warnings), sim.report.warnings
