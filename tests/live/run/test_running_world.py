"""Models with plugins and sensors that are copied, deleted, restored and reset in a running world."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.graphs import PATIENCE_S, Graph, running_graph, until

from trundle.base.console import Console
from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.live.run.run_options import RunOptions
from trundle.live.run.running_world import RunningWorld
from trundle.page import CopyModel, DeleteModel, ResetModel, RestoreModel, UndoReset
from trundle.page.simulated_world.model_edits import ModelEdits
from trundle.spatial import Pose

WORLD = """<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity><model name="cart"><link name="base">
<sensor name="turn" type="imu"><update_rate>100</update_rate></sensor></link>
<link name="wheel"><pose>0 0 1 0 0 0</pose></link><joint name="axle" type="revolute"><parent>base</parent>
<child>wheel</child><axis><xyz>0 0 1</xyz></axis></joint>
<plugin name="move" filename="libgazebo_ros_planar_move.so"><commandTopic>go</commandTopic></plugin>
</model></world></sdf>"""


@pytest.fixture
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture
def world(graph: Graph, tmp_path: Path) -> Iterator[RunningWorld]:
    file, report = tmp_path / "w.sdf", Diagnostics()
    file.write_text(WORLD)
    environment = {"ROS_MASTER_URI": graph.core.uri, "HOME": str(tmp_path)}
    with RunningWorld(str(file), RunOptions(), environment, report, Console(sys.stderr, report)) as world:
        world.start()
        yield world


def test_nodes_and_topics_end_and_start_with_their_model(graph: Graph, world: RunningWorld) -> None:
    """The copy has its own nodes; all subscribe to the topic that the plugins name."""
    client = graph.node("/client")
    own_node = "/cart/move"

    def nodes() -> set[str]:
        published, subscribed, _ = graph.loop.run(client.master.call("getSystemState"), PATIENCE_S)
        names = {name for _, names in (*published, *subscribed) for name in names}
        return names & {own_node, "/cart_0/move"}

    def imu_topics() -> list[str]:
        return [name for name, _ in graph.loop.run(client.master.call("getPublishedTopics", "/")) if "turn" in name]

    edits = _model_edits(world)
    until(lambda: nodes() == {own_node})
    until(imu_topics)
    (topic,) = imu_topics()
    edits.handle(CopyModel("cart", "cart_0", (3, 0, 0)))
    until(lambda: nodes() == {own_node, "/cart_0/move"})
    until(lambda: len(imu_topics()) == 2)
    edits.handle(DeleteModel("cart"))
    until(lambda: nodes() == {"/cart_0/move"})
    until(lambda: topic not in imu_topics())
    assert [sensor.model.name for sensor in world.live.sensors] == ["cart_0"]
    edits.handle(RestoreModel("cart"))
    until(lambda: nodes() == {own_node, "/cart_0/move"})
    until(lambda: topic in imu_topics())


def test_a_restored_model_keeps_its_state_and_its_plugins_drive_it(graph: Graph, world: RunningWorld) -> None:
    client = graph.node("/client")
    velocity = client.advertise("/go", "geometry_msgs/Twist", queue_size=1)
    edits, simulation = _model_edits(world), world.simulation
    simulation["cart"].joint("axle").set_position(0.5)
    simulation["cart"].set_pose(Pose((1.0, 2.0, 3.0)))
    edits.handle(DeleteModel("cart"))
    until(lambda: not velocity.has_subscribers)
    world.live.advance(100_000_000)
    edits.handle(RestoreModel("cart"))
    cart = simulation["cart"]
    assert cart.pose.position == pytest.approx((1.0, 2.0, 3.0))
    assert cart.joint("axle").position == pytest.approx(0.5)

    until(lambda: velocity.has_subscribers)

    def moves() -> bool:
        velocity.publish({"linear": {"x": 1.0}})
        world.live.advance(simulation.time_ns + 10_000_000)
        return cart.pose.position[0] > 1.1

    until(moves)
    with pytest.raises(UsageError, match="there is a model 'cart' already"):
        edits.handle(RestoreModel("cart"))


def test_reset_of_a_model_resets_only_its_plugins(graph: Graph, world: RunningWorld) -> None:
    """As Gazebo's Model::Reset: the cart forgets its command, its copy drives on."""
    client = graph.node("/client")
    velocity = client.advertise("/go", "geometry_msgs/Twist", queue_size=1)
    edits, simulation = _model_edits(world), world.simulation
    edits.handle(CopyModel("cart", "cart_0", (3, 0, 0)))

    def both_move() -> bool:
        velocity.publish({"linear": {"x": 1.0}})
        world.live.advance(simulation.time_ns + 10_000_000)
        return simulation["cart"].pose.position[0] > 0.05 and simulation["cart_0"].pose.position[0] > 3.05

    def both_are_fast() -> bool:
        world.live.advance(simulation.time_ns + 10_000_000)
        return all(simulation[name].twist.linear[0] > 1.5 for name in ("cart", "cart_0"))

    until(both_move)
    velocity.publish({"linear": {"x": 2.0}})
    until(both_are_fast)  # all earlier messages have arrived
    before = simulation["cart_0"].pose.position[0]
    edits.handle(ResetModel("cart"))
    world.live.advance(simulation.time_ns + 500_000_000)
    assert simulation["cart"].pose.position == pytest.approx((0, 0, 0), abs=1e-6)
    assert simulation["cart_0"].pose.position[0] == pytest.approx(before + 1.0, abs=0.05)


def test_plugins_continue_after_an_undone_reset(graph: Graph, world: RunningWorld) -> None:
    """The cart is commanded once to drive at 1 m/s, and its axle to turn at 2 rad/s."""
    client = graph.node("/client")
    velocity = client.advertise("/go", "geometry_msgs/Twist", queue_size=1, latch=True)
    velocity.publish({"linear": {"x": 1.0}})
    edits, simulation = _model_edits(world), world.simulation
    cart, axle = simulation["cart"], simulation["cart"].joint("axle")
    axle.command_velocity(2.0)

    def moves() -> bool:
        world.live.advance(simulation.time_ns + 10_000_000)
        return cart.pose.position[0] > 0.05

    until(moves)
    before = cart.pose.position[0], axle.position
    edits.handle(ResetModel("cart"))
    world.live.advance(simulation.time_ns + 200_000_000)
    assert (cart.pose.position[0], axle.position) == pytest.approx((0.0, 0.0), abs=1e-6)
    edits.handle(UndoReset("cart"))
    assert (cart.pose.position[0], axle.position) == pytest.approx(before, abs=1e-9)
    world.live.advance(simulation.time_ns + 500_000_000)
    assert cart.pose.position[0] == pytest.approx(before[0] + 0.5, abs=0.01)
    assert axle.position == pytest.approx(before[1] + 1.0, abs=0.01)


def test_deleting_a_model_with_plugins_restarts_the_timeline(world: RunningWorld) -> None:
    """Replay cannot repeat the nodes of the time before."""
    world.live.advance(500_000_000)
    assert world.live.timeline is not None
    assert world.live.timeline.start_ns == 0
    world.live.delete("cart")
    assert world.live.timeline.start_ns == 500_000_000


def _model_edits(world: RunningWorld) -> ModelEdits:
    return ModelEdits(world.live)
