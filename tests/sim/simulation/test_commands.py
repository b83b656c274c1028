"""Commands to a world, as `gz` has them, from Python."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from msgspec.structs import replace

import trundle
from trundle.base.diagnostics import UsageError
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, Twist, Wrench

INERTIA = "<inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"
CART = f"""<model name="cart"><pose>0 0 1 0 0 0</pose><link name="base">{INERTIA}</link><link name="arm">{INERTIA}
</link><joint name="hinge" type="revolute"><parent>base</parent><child>arm</child><axis><xyz>0 0 1</xyz></axis></joint>
</model><model name="post"><link name="l">{INERTIA}
</link><joint name="weld" type="fixed"><parent>world</parent><child>l</child>
</joint></model><joint name="tie" type="revolute"><parent>post::l</parent><child>cart::base</child><axis><xyz>0 0 1
</xyz></axis></joint>"""


def load(folder: Path, *, tied: bool = False) -> Simulation:
    file = folder / "w.sdf"
    models = CART if tied else CART[: CART.index('<joint name="tie"')]
    file.write_text(f'<sdf version="1.10"><world name="w"><gravity>0 0 0</gravity>{models}</world></sdf>')
    return trundle.load(str(file))


@pytest.fixture
def sim(tmp_path: Path) -> Simulation:
    """A cart that flies and turns its arm."""
    sim = load(tmp_path)
    sim["cart"].set_twist(Twist((1.0, 0.0, 0.0)))
    sim["cart"].joint("hinge").set_velocity(2.0)
    sim.run(0.5)
    return sim


class Clock:
    """Hook that records its times."""

    def __init__(self) -> None:
        self.times: list[int] = []

    def before_step(self, sim: Simulation) -> None:
        self.times.append(sim.time_ns // 1_000_000)


def _slower(sim: Simulation) -> None:
    sim.edit(replace(sim.world, physics=replace(sim.world.physics, max_step_size_s=0.01)))


@pytest.mark.parametrize(
    ("command", "time_ms"),
    [
        (lambda sim: sim.reset(), 100),
        (lambda sim: sim.reset(poses=False), 100),
        (_slower, 600),
    ],
)
def test_a_time_reset_by_a_command_keeps_the_remaining_advance(
    sim: Simulation, command: Callable[[Simulation], None], time_ms: int
) -> None:
    """Half a second has gone by, of which a burst would make up for."""
    before_ns = sim.simulated_ns
    sim.post(command)
    sim.run(0.1)

    assert sim.time_ns == time_ms * 1_000_000
    assert sim.simulated_ns - before_ns == 100_000_000


def test_a_restore_does_not_reduce_the_total_simulated_time(sim: Simulation) -> None:
    saved = sim.save()
    sim.run(0.3)
    sim.post(lambda sim: sim.restore(saved))
    sim.run(0.1)

    assert (sim.time_ns, sim.simulated_ns) == (600_000_000, 900_000_000)
    assert sim.simulated_steps == 900


def test_a_stride_is_not_longer_after_a_command_resets_the_time(sim: Simulation) -> None:
    sim.post(Simulation.reset)
    sim.stride(sim.time_ns + 20_000_000)

    assert sim.time_ns == 20_000_000


def test_a_hook_may_reset_the_time_during_an_advance(sim: Simulation) -> None:
    class Back:
        def before_step(self, sim: Simulation) -> None:
            if sim.time_ns == 600_000_000:
                sim.reset(poses=False)

    sim.add_hook(Back(), period_ns=100_000_000)
    sim.run(0.2)

    assert sim.time_ns == 100_000_000


def test_a_reset_of_time_keeps_the_poses(sim: Simulation) -> None:
    clock, called = Clock(), []
    sim.on_reset(lambda: called.append(1))
    sim.add_hook(clock, period_ns=100_000_000)
    sim["cart"].base.apply_wrench(Wrench(force=(0.0, 2.0, 0.0)), duration_s=0.3)
    sim.run(0.15)
    before = sim["cart"].base.pose

    sim.reset(poses=False)
    assert sim.time_ns == 0
    assert sim["cart"].base.pose == before
    sim.run(0.25)
    assert clock.times == [500, 600, 0, 100, 200]
    assert sim["cart"].base.twist.linear[1] == pytest.approx(2.0 / 4.0 * 0.3, rel=0.2), "the push lasted 0.3 s in all"
    assert called == []


def test_a_reset_of_poses_keeps_the_time(sim: Simulation) -> None:
    clock, called = Clock(), []
    sim.on_reset(lambda: called.append(1))
    sim.add_hook(clock, period_ns=100_000_000)
    sim.run(0.15)

    sim.reset(time=False)
    assert sim.time_ns == 650_000_000
    assert sim["cart"].pose == Pose((0.0, 0.0, 1.0))
    assert sim["cart"].joint("hinge").velocity == 0.0
    sim.run(0.1)
    assert clock.times == [500, 600, 700]
    assert called == [1]


def test_reset_callbacks_of_a_model_are_removed_with_it(sim: Simulation) -> None:
    called: list[str] = []
    sim.on_reset(lambda: called.append("cart"), model=sim["cart"])
    sim["cart"].reset()
    sim.reset()
    assert called == ["cart", "cart"]

    sim.delete("cart")
    sim.reset()

    assert called == ["cart", "cart"]


def test_an_effort_lasts_for_its_duration(tmp_path: Path) -> None:
    sim = load(tmp_path)
    hinge = sim["cart"].joint("hinge")
    hinge.command_effort(0.1, duration_s=0.2)
    sim.run(1.0)
    # Against each other two bodies of 0.1 kg·m² are 0.05.
    assert hinge.velocity == pytest.approx(0.1 * 0.2 / 0.05, rel=1e-6)
    assert hinge.effort == 0.0

    hinge.command_effort(0.1, duration_s=0.2)
    saved = sim.save()
    sim.run(0.1)
    hinge.command_effort(-0.1)
    sim.run(0.5)
    assert hinge.effort == pytest.approx(-0.1), "the later command holds"
    sim.restore(saved)
    sim.run(0.5)
    assert hinge.velocity == pytest.approx(2 * 0.1 * 0.2 / 0.05, rel=1e-6)


def test_an_effort_of_a_deleted_model_ends_with_it(tmp_path: Path) -> None:
    sim = load(tmp_path)
    sim["cart"].joint("hinge").command_effort(0.1, duration_s=0.2)
    sim.delete("cart")
    sim.run(0.5)

    assert [model.name for model in sim.models] == ["post"]


def test_joint_positions_and_velocities_can_be_set(sim: Simulation) -> None:
    hinge = sim["cart"].joint("hinge")
    hinge.set_position(0.7)
    hinge.set_velocity(-1.0)

    assert (hinge.position, hinge.velocity) == (0.7, -1.0)


def test_a_model_reports_the_twist_of_its_frame(tmp_path: Path) -> None:
    """A link that spins 2 m from the model's frame moves the frame in a circle."""
    file = tmp_path / "w.sdf"
    link = f'<link name="l"><pose>2 0 0 0 0 0</pose>{INERTIA}</link>'
    model = f'<model name="m">{link}</model>'
    file.write_text(f'<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity>{model}</world></sdf>')
    sim = trundle.load(str(file))
    sim["m"].link("l").set_twist(Twist((0.0, 1.0, 0.0), (0.0, 0.0, 3.0)))

    assert sim["m"].twist.linear == pytest.approx((0.0, 1.0 - 3.0 * 2.0, 0.0))
    assert sim["m"].twist.angular == pytest.approx((0.0, 0.0, 3.0))
    sim["m"].set_twist(Twist((0.5, 0.0, 0.0), (0.0, 0.0, 1.0)))
    assert sim["m"].twist.linear == pytest.approx((0.5, 0.0, 0.0))


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_poses_that_are_not_finite_are_refused(sim: Simulation, number: float) -> None:
    cart, nowhere, no_speed = sim["cart"], Pose((number, 0.0, 0.0)), Twist((0.0, number, 0.0))
    for call in (cart.set_pose, cart.link("base").set_pose):
        with pytest.raises(UsageError, match=rf"pose must have finite numbers, got \({number}, 0.0, 0.0, 1"):
            call(nowhere)
    for call in (cart.set_twist, cart.link("base").set_twist):
        with pytest.raises(UsageError, match="twist must have finite numbers, got"):
            call(no_speed)

    sim.run(0.1)


@pytest.mark.parametrize("name", ["", "\0", "cart\0", "a\nb"])
def test_a_name_with_control_characters_is_refused(sim: Simulation, name: str) -> None:
    cart = sim.models[0].model
    with pytest.raises(UsageError, match="name"):
        sim.spawn(replace(cart, name=name))


def test_spawned_models_are_numbered_if_renaming_is_allowed(sim: Simulation) -> None:
    cart = sim["cart"].model
    with pytest.raises(UsageError, match="there is a model 'cart' already"):
        sim.spawn(cart)

    names = [sim.spawn(replace(cart, name="cart"), allow_renaming=True).name for _ in range(3)]
    assert names == ["cart_0", "cart_1", "cart_2"]
    assert sim.spawn(replace(cart, name="other"), allow_renaming=True).name == "other"


@pytest.mark.parametrize("tied", [False, True])
def test_a_renamed_model_continues_to_the_bit(tmp_path: Path, tied: bool) -> None:
    ends: list[tuple[object, ...]] = []
    for rename in (False, True):
        sim = load(tmp_path, tied=tied)
        cart = sim["cart"]
        hinge, arm = cart.joint("hinge"), cart.link("arm")
        hinge.command_velocity(1.0, max_effort=0.2)
        arm.apply_wrench(Wrench(force=(0.3, 0.1, 0.0)), duration_s=0.6)
        hinge_end = sim.time_ns
        sim.run(0.4)
        if rename:
            sim.rename("cart", "wagon")
            assert cart.name == "wagon"
            assert sim["wagon"] is cart
            with pytest.raises(UsageError, match="no model 'cart'; there are: 'wagon', 'post'"):
                sim["cart"]
        sim.run(0.8)
        ends.append((arm.pose, arm.twist, hinge.position, hinge.velocity, hinge_end))
    assert ends[0] == ends[1]


def test_a_name_that_is_taken_is_refused(sim: Simulation) -> None:
    for new, words in (("post", "there is a model 'post' already"), ("", "a model needs a name")):
        with pytest.raises(UsageError, match=words):
            sim.rename("cart", new)
    sim.rename("cart", "cart")
    assert sim["cart"].name == "cart"


def test_joints_with_a_deleted_model_are_deleted(tmp_path: Path) -> None:
    sim = load(tmp_path, tied=True)
    (tie,) = sim.joints
    sim.delete("post")
    sim.run(0.1)

    assert sim.joints == []
    assert not tie.is_valid
    assert sim.report.warnings == []
