"""Models that a user of the page carries, pulls and holds, and lets go."""

from pathlib import Path

import pytest
from tests.page.simulated_world.worlds import CAMERA, loaded, model

from trundle.base.diagnostics import Source, UsageError
from trundle.page import (
    Carry,
    CopyModel,
    DeleteModel,
    EditAction,
    HoldModel,
    LetGo,
    PlaceJoint,
    PlaceLight,
    Pull,
    RestoreModel,
    SetPose,
)
from trundle.page.shown_world import BareWorld
from trundle.page.simulated_world import handling
from trundle.page.simulated_world.controls import SimulationControls
from trundle.page.simulated_world.edits import edit
from trundle.page.simulated_world.handling import handled_models
from trundle.page.simulated_world.model_edits import ModelEdits
from trundle.robots.model import Joint, JointType
from trundle.sim.realtime_pacer import RealtimePacer
from trundle.sim.simulation import Simulation
from trundle.sim.timeline import Timeline

_UPRIGHT = (1, 0, 0, 0)
_WORLD = """<light name="lamp" type="point"><pose>0 0 3 0 0 0</pose></light>
<model name="cart"><pose>0 0 5 0 0 0</pose><link name="base">
<inertial><mass>2</mass><inertia><ixx>0.2</ixx><iyy>0.3</iyy><izz>0.4</izz></inertia></inertial></link>
<link name="arm"><pose>0 0 1 0 0 0</pose><inertial><mass>0.1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy>
<izz>0.01</izz>
</inertia></inertial></link><joint name="lift" type="prismatic"><parent>base</parent><child>arm</child>
<axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis></joint></model>
<model name="wall"><static>1</static><pose>9 0 0 0 0 0</pose><link name="l"/></model>"""


@pytest.fixture
def sim(tmp_path: Path) -> Simulation:
    return loaded(tmp_path, _WORLD)[0]


def test_a_carried_model_stays_at_its_pose_until_let_go(sim: Simulation) -> None:
    """Afterwards it falls from rest: g t² / 2 in a second."""
    sim.run(0.5)
    edit(Carry("cart", "base", (1, 2, 3), _UPRIGHT), sim)
    assert sim["cart"].pose.position == pytest.approx((1, 2, 3))
    sim.run(0.5)
    assert sim["cart"].pose.position == pytest.approx((1, 2, 3), abs=1e-4)
    edit(Carry("cart", "base", (1, 2, 9), _UPRIGHT), sim)
    sim.run(0.5)
    assert sim["cart"].pose.position == pytest.approx((1, 2, 9), abs=1e-4)
    assert handled_models(sim) == ["cart"]
    edit(LetGo("cart"), sim)
    assert handled_models(sim) == []
    sim.run(1.0)
    assert sim["cart"].pose.position == pytest.approx((1, 2, 9 - 4.9), abs=0.02)


def test_a_fixed_model_is_carried_without_a_hook(sim: Simulation) -> None:
    edit(Carry("wall", "l", (7, 0, 1), _UPRIGHT), sim)
    sim.run(0.1)
    assert sim["wall"].pose.position == pytest.approx((7, 0, 1))
    assert handled_models(sim) == []


def test_a_pulling_spring_stretches_by_the_models_weight(sim: Simulation) -> None:
    """At rest the spring carries the model: m g = 40 m x."""
    edit(Pull("cart", "base", (0, 0, 0), (0, 0, 6)), sim)
    sim.run(10.0)
    assert sim["cart"].link("base").pose.position[2] == pytest.approx(6 - 9.8 / 40, abs=1e-2)
    edit(LetGo("cart"), sim)
    sim.run(0.2)
    assert sim["cart"].twist.linear[2] == pytest.approx(-1.96, abs=0.1)


def test_a_light_link_is_pulled_without_oscillation(sim: Simulation) -> None:
    """This includes distant targets, as the spring's force is bounded."""
    edit(Pull("cart", "arm", (0.3, 0, 0), (0, 1000, 5)), sim)
    sim.run(2.0)
    assert 10 < sim["cart"].link("arm").pose.position[1] < 1000


def test_a_fixed_model_cannot_be_pulled(sim: Simulation) -> None:
    with pytest.raises(UsageError, match="'l' is fixed to the world"):
        edit(Pull("wall", "l", (0, 0, 0), (0, 0, 1)), sim)


def test_a_held_model_stays_in_the_air_while_its_joints_move(sim: Simulation) -> None:
    """It can be moved, and freed again."""
    edit(HoldModel("cart", on=True), sim)
    edit(SetPose("cart", "base", (0, 0, 4), _UPRIGHT), sim)
    assert handling.is_held(sim, "cart")
    sim.run(1.0)
    assert sim["cart"].pose.position == pytest.approx((0, 0, 4))
    assert sim["cart"].joint("lift").position == pytest.approx(-1.0, abs=0.01)
    edit(HoldModel("cart", on=False), sim)
    sim.run(0.5)
    assert sim["cart"].pose.position[2] < 3.0
    with pytest.raises(UsageError, match="'wall' is fixed already"):
        edit(HoldModel("wall", on=True), sim)


def test_joint_positions_and_light_poses_are_set(sim: Simulation) -> None:
    edit(PlaceJoint("cart", "lift", 0.5), sim)
    assert sim["cart"].joint("lift").position == 0.5
    edit(PlaceLight("lamp", (1, 1, 1), (2, 0, 0, 0)), sim)
    assert sim.world.lights[0].world_from_light.position == (1, 1, 1)
    with pytest.raises(UsageError, match="no light 'sun'; it has: 'lamp'"):
        edit(PlaceLight("sun", (1, 1, 1), _UPRIGHT), sim)


def test_a_carried_model_is_let_go_after_a_timeout(sim: Simulation) -> None:
    """The timeout is a second of wall time after the last request."""
    wall_s = [0.0]
    timeline = Timeline(sim)
    controls = SimulationControls(BareWorld(sim, timeline=timeline), None, wall_ns=lambda: round(wall_s[0] * 1e9))
    pacer = RealtimePacer(1.0)

    def ask(action: EditAction) -> None:
        controls.handle(action, pacer, paused=False)

    for second in (0.0, 0.9, 1.8):
        wall_s[0] = second
        controls.let_go_after_timeout()
        ask(Pull("cart", "base", (0, 0, 0), (second, 0, 6)))
        timeline.advance(sim.time_ns + 100_000_000)
    wall_s[0] = 2.7
    controls.let_go_after_timeout()
    assert handled_models(sim) == ["cart"]
    wall_s[0] = 2.9
    controls.let_go_after_timeout()
    assert handled_models(sim) == []


def test_a_timeline_repeats_a_pull(sim: Simulation) -> None:
    """The timeline repeats the pull and its end without requests, bitwise the same."""
    timeline = Timeline(sim)
    wall_s = [0.0]
    controls = SimulationControls(BareWorld(sim, timeline=timeline), None, wall_ns=lambda: round(wall_s[0] * 1e9))
    pacer = RealtimePacer(1.0)
    for _ in range(15):
        controls.handle(Pull("cart", "base", (0.1, 0, 0), (2, 0, 6)), pacer, paused=False)
        timeline.advance(sim.time_ns + 100_000_000)
    controls.handle(LetGo("cart"), pacer, paused=False)
    timeline.advance(sim.time_ns + 500_000_000)
    end_ns, first = sim.time_ns, sim.snapshot().poses.tobytes()

    wall_s[0] = 100.0
    timeline.seek(700_000_000)
    assert handled_models(sim) == ["cart"]
    controls.let_go_after_timeout()
    timeline.advance(end_ns)
    assert sim.snapshot().poses.tobytes() == first
    assert handled_models(sim) == []


def test_a_copy_has_the_state_of_its_model(sim: Simulation) -> None:
    sim["cart"].joint("lift").set_position(0.25)
    sim.run(0.3)
    model_edits(sim).handle(CopyModel("cart", "cart_0", (2, 0, 0)))

    copy, cart = sim["cart_0"], sim["cart"]
    assert copy.pose.position == pytest.approx((2, 0, cart.pose.position[2]))
    assert copy.twist.linear == pytest.approx(cart.twist.linear)
    assert copy.joint_positions == pytest.approx(cart.joint_positions)
    sim.run(0.3)
    assert copy.link("arm").pose.position[2] == pytest.approx(cart.link("arm").pose.position[2], abs=1e-6)


@pytest.mark.parametrize("is_held", [False, True])
def test_a_restored_model_has_its_former_state(sim: Simulation, is_held: bool) -> None:
    edits = model_edits(sim)
    sim.run(0.3)
    edit(HoldModel("cart", on=is_held), sim)
    sim.run(0.3)
    before = sim.snapshot().poses.copy()
    for action in (DeleteModel("cart"), RestoreModel("cart")):
        edits.handle(action)
    assert sorted(sim.snapshot().poses.tolist()) == sorted(before.tolist())
    assert handling.is_held(sim, "cart") == is_held
    with pytest.raises(UsageError, match="has deleted no model 'wall'"):
        edits.handle(RestoreModel("wall"))


def test_models_with_sensors_are_not_copied_where_sensors_cannot_start(tmp_path: Path) -> None:
    sim = loaded(tmp_path, model("eye", CAMERA, static=False))[0]
    with pytest.raises(UsageError, match="'eye_0' has sensors or plugins, which would not run here"):
        model_edits(sim).handle(CopyModel("eye", "eye_0", (2, 0, 0)))


def test_a_model_fixed_to_another_is_not_moved_alone(sim: Simulation) -> None:
    """The joint would hold it in place, as in Gazebo."""
    tie = Joint(name="tie", type=JointType.FIXED, parent="wall::l", child="cart::base", at=Source("test"))
    sim.attach(tie)
    with pytest.raises(UsageError, match="'cart' is fixed to 'wall::l' by joint 'tie'"):
        edit(SetPose("cart", "base", (0, 0, 4), _UPRIGHT), sim)
    edit(SetPose("wall", "l", (7, 0, 0), _UPRIGHT), sim)
    assert sim["cart"].pose.position == pytest.approx((-2, 0, 5))


def model_edits(sim: Simulation) -> ModelEdits:
    return ModelEdits(BareWorld(sim))
