"""Edits from the page: effects, bounds, and repetition by the timeline."""

from pathlib import Path
from typing import Any

import msgspec
import pytest
from msgspec.structs import replace
from tests.page.simulated_world.worlds import loaded

from trundle.base.diagnostics import UsageError
from trundle.page import (
    ApplyWrench,
    EditAction,
    MoveJoint,
    ResetModel,
    SetFriction,
    SetLight,
    SetMass,
    SetPhysics,
    SetPose,
    SetTwist,
    UndoReset,
)
from trundle.page.shown_world import BareWorld
from trundle.page.simulated_world.edits import edit
from trundle.page.simulated_world.model_edits import ModelEdits
from trundle.sim.simulation import Simulation
from trundle.sim.timeline import Timeline
from trundle.spatial import Pose, Twist

_WORLD = """<gravity>0 0 0</gravity><light name="sun" type="directional"><diffuse>1 1 1 1</diffuse></light>
<model name="cart"><pose>1 0 0.5 0 0 0</pose><link name="base"><pose>0 0 0.1 0 0 0</pose>
<inertial><mass>2</mass><inertia><ixx>0.2</ixx><iyy>0.3</iyy><izz>0.4</izz></inertia></inertial>
<collision name="c"><geometry><box><size>1 1 0.2</size></box></geometry></collision></link>
<link name="arm"><pose>0 0 1 0 0 0</pose></link><joint name="lift" type="prismatic"><parent>base</parent>
<child>arm</child><axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis></joint></model>
<model name="outer"><model name="inner"><link name="l"><pose>0 5 0 0 0 0</pose></link></model></model>"""


def _model_edits(sim: Simulation) -> ModelEdits:
    return ModelEdits(BareWorld(sim))


@pytest.fixture
def sim(tmp_path: Path) -> Simulation:
    return loaded(tmp_path, _WORLD)[0]


def test_a_model_is_moved_by_the_pose_of_a_link(sim: Simulation) -> None:
    """Joint positions are unchanged, and the quaternion need not be normalized."""
    sim["cart"].joint("lift").set_position(0.25)
    edit(SetPose("cart", "base", (3, 4, 5), (2, 0, 0, 2)), sim)

    assert sim["cart"].link("base").pose.position == pytest.approx((3, 4, 5))
    assert sim["cart"].pose.position == pytest.approx((3, 4, 4.9))
    assert sim["cart"].link("arm").pose.position == pytest.approx((3, 4, 6.15))
    assert sim["cart"].pose.quaternion == pytest.approx((0.5**0.5, 0, 0, 0.5**0.5))


def test_moving_a_nested_model_moves_the_outermost_one(sim: Simulation) -> None:
    edit(SetPose("outer::inner", "l", (0, 0, 2), (1, 0, 0, 0)), sim)

    assert sim["outer"].pose.position == pytest.approx((0, -5, 2))


def test_velocities_wrenches_and_efforts_move_bodies(sim: Simulation) -> None:
    edit(SetTwist("cart", (1, 0, 0), (0, 0, 0)), sim)
    assert sim["cart"].twist.linear == pytest.approx((1, 0, 0))
    edit(ApplyWrench("outer::inner", "l", (0, 0, 3), (0, 0, 0), 0.1), sim)
    sim.run(0.5)
    assert sim["outer"].twist.linear[2] == pytest.approx(0.3, rel=0.01)  # 1 kg, 3 N for 0.1 s
    edit(MoveJoint("cart", "lift", effort=1.0), sim)
    sim.run(0.1)
    assert sim["cart"].joint("lift").velocity > 0.01


def test_a_reset_affects_one_model(sim: Simulation) -> None:
    cart, outer = sim["cart"], sim["outer"]
    edit(SetPose("cart", "base", (3, 4, 5), (2, 0, 0, 2)), sim)
    edit(SetPose("outer", "inner::l", (0, 0, 2), (1, 0, 0, 0)), sim)
    edit(SetTwist("cart", (1, 0, 0), (0, 0, 1)), sim)
    edit(MoveJoint("cart", "lift", velocity=0.5), sim)
    edit(ApplyWrench("cart", "base", (5, 0, 0), (0, 0, 0), 10.0), sim)
    sim.run(0.5)
    _model_edits(sim).handle(ResetModel("cart"))

    assert cart.pose.position == pytest.approx((1, 0, 0.5))
    assert cart.pose.quaternion == pytest.approx((1, 0, 0, 0))
    assert cart.joint("lift").position == 0.0
    sim.run(0.5)
    assert cart.pose.position == pytest.approx((1, 0, 0.5), abs=1e-6)
    assert cart.joint("lift").position == pytest.approx(0.0, abs=1e-6)
    assert outer.pose.position == pytest.approx((0, -5, 2))


def test_resets_are_undone_one_at_a_time(sim: Simulation) -> None:
    cart, edits = sim["cart"], _model_edits(sim)
    first = Pose((3.0, 4.0, 5.0), (0.6, 0.0, 0.0, 0.8))
    cart.set_pose(first)
    cart.set_twist(Twist((1.0, 0.0, 2.0), (0.0, 0.0, 0.5)))
    cart.joint_positions, cart.joint_velocities = [0.25], [0.125]
    edits.handle(ResetModel("cart"))
    edit(SetTwist("cart", (0, 7, 0), (0, 0, 0)), sim)
    edits.handle(ResetModel("cart"))
    assert cart.twist == Twist()

    edits.handle(UndoReset("cart"))
    assert cart.pose.position == pytest.approx((1, 0, 0.5), abs=1e-12)
    assert cart.twist.linear == pytest.approx((0, 7, 0), abs=1e-12)
    edits.handle(UndoReset("cart"))
    assert cart.pose.position == pytest.approx(first.position, abs=1e-12)
    assert cart.pose.quaternion == pytest.approx(first.quaternion, abs=1e-12)
    assert cart.twist.linear == pytest.approx((1, 0, 2), abs=1e-12)
    assert cart.twist.angular == pytest.approx((0, 0, 0.5), abs=1e-12)
    assert (cart.joint_positions, cart.joint_velocities) == (pytest.approx([0.25]), pytest.approx([0.125]))
    with pytest.raises(UsageError, match="the page has not reset model 'cart'"):
        edits.handle(UndoReset("cart"))


def test_undoing_a_reset_restores_motor_commands_and_wrenches(sim: Simulation, tmp_path: Path) -> None:
    """The model behaves like one that was not reset: pushed for 0.4 s, its joint driven at 0.5 m/s."""
    other = loaded(tmp_path, _WORLD)[0]
    for simulation in (sim, other):
        edit(MoveJoint("cart", "lift", velocity=0.5), simulation)
        edit(ApplyWrench("cart", "base", (5, 0, 0), (0, 0, 1), 0.4), simulation)
        simulation.run(0.3)
    edits = _model_edits(sim)
    edits.handle(ResetModel("cart"))
    sim.run(0.2)
    assert sim["cart"].joint("lift").position == pytest.approx(0.0)
    edits.handle(UndoReset("cart"))
    for simulation in (sim, other):
        simulation.run(0.5)

    for link, same in zip(sim["cart"].links, other["cart"].links, strict=True):
        assert link.pose.position == pytest.approx(same.pose.position, abs=1e-6)
        assert link.twist.linear == pytest.approx(same.twist.linear, abs=1e-6)
        assert link.twist.angular == pytest.approx(same.twist.angular, abs=1e-6)
    assert sim["cart"].joint("lift").velocity == pytest.approx(0.5, abs=1e-3)


def test_a_state_is_not_restored_to_a_model_with_other_joints(sim: Simulation) -> None:
    edits = _model_edits(sim)
    edits.handle(ResetModel("cart"))
    sim.delete("cart")
    sim.spawn(replace(sim["outer"].model, name="cart"))
    with pytest.raises(UsageError, match="other links or joints now"):
        edits.handle(UndoReset("cart"))


def test_inertia_scales_with_the_mass(sim: Simulation) -> None:
    edit(SetMass("cart", "base", 4.0), sim)

    inertial = sim["cart"].link("base").link.inertial
    assert inertial.mass == 4.0
    assert inertial.moments == pytest.approx((0.4, 0.6, 0.8))


def test_friction_lights_gravity_wind_and_time_step_can_be_set(sim: Simulation) -> None:
    edit(SetFriction("cart", "base", 0.25, 0.5), sim)
    edit(SetLight("sun", (1, 0.5, 0), 2.0), sim)
    edit(SetPhysics(gravity=(0, 0, -1.6)), sim)
    edit(SetPhysics(wind=(3, 0, 0), step=0.002), sim)

    (collision,) = sim["cart"].link("base").link.collisions
    assert (collision.surface.mu, collision.surface.mu2) == (0.25, 0.5)
    (sun,) = sim.world.lights
    assert (sun.diffuse, sun.intensity) == ((1, 0.5, 0, 1), 2.0)
    assert (sim.world.physics.gravity, sim.world.wind, sim.step_ns) == ((0, 0, -1.6), (3, 0, 0), 2_000_000)
    sim.run(1.0)
    assert sim["outer"].twist.linear[2] == pytest.approx(-1.6, rel=1e-3)


@pytest.mark.parametrize(
    ("action", "error"),
    [
        (SetTwist("cat", (0, 0, 0), (0, 0, 0)), "'cat'"),
        (SetMass("cart", "wheel", 1.0), "'base', 'arm'"),
        (SetFriction("cart", "arm", 1.0, 1.0), "link 'arm' has no collisions and so no friction"),
        (SetLight("moon", (1, 1, 1), 1.0), "no light 'moon'; there are: 'sun'"),
        (MoveJoint("cart", "hinge", position=1.0), "'lift'"),
    ],
)
def test_unknown_names_are_refused_with_the_known_ones(sim: Simulation, action: EditAction, error: str) -> None:
    with pytest.raises(UsageError, match=error):
        edit(action, sim)


@pytest.mark.parametrize(
    "fields",
    [
        {"request": "mass", "model": "cart", "link": "base", "mass": 0},
        {"request": "mass", "model": "cart", "link": "base", "mass": 1e9},
        {"request": "joint", "model": "cart", "joint": "lift", "position": 1e300},
        {"request": "joint", "model": "cart", "joint": "lift"},
        {"request": "pose", "model": "cart", "link": "base", "position": [0, 0, 1e9], "orientation": [1, 0, 0, 0]},
        {"request": "pose", "model": "cart", "link": "base", "position": [0, 0, 1], "orientation": [0, 0, 0, 0]},
        {"request": "friction", "model": "cart", "link": "base", "mu": -1, "mu2": 1},
        {"request": "physics", "step": 0},
        {"request": "light", "light": "sun", "diffuse": [2, 0, 0], "intensity": 1},
        {"request": "wrench", "model": "m", "link": "l", "force": [0, 0, 1e12], "torque": [0, 0, 0], "duration": 1},
    ],
)
def test_requests_with_numbers_out_of_bounds_are_invalid(fields: dict[str, Any]) -> None:
    with pytest.raises(msgspec.ValidationError):
        msgspec.json.decode(msgspec.json.encode(fields), type=EditAction)


def test_a_timeline_repeats_every_edit(sim: Simulation) -> None:
    """Seeking to before the edits restores the state; running on from there repeats it bitwise."""
    timeline = Timeline(sim)

    def do(action: EditAction, until_ns: int) -> None:
        timeline.do(lambda simulation: edit(action, simulation))
        timeline.advance(until_ns)

    do(SetMass("cart", "base", 4.0), 200_000_000)
    do(SetPhysics(gravity=(0, 0, -1.6)), 400_000_000)
    do(SetPose("cart", "base", (3, 4, 5), (1, 0, 0, 0)), 600_000_000)
    timeline.do(lambda simulation: simulation.delete("outer"))
    timeline.advance(1_500_000_000)
    ended = sim.snapshot().poses.tobytes()

    timeline.seek(100_000_000)
    assert sim.world.physics.gravity == (0, 0, 0)
    assert [model.name for model in sim.models] == ["cart", "outer"]
    timeline.seek(1_500_000_000)
    assert sim.snapshot().poses.tobytes() == ended
    assert sim["cart"].link("base").link.inertial.mass == 4.0
