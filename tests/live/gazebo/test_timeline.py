"""Timeline of the world behind /gazebo: seeking back, and replay that repeats the first run."""

import queue
import time
from collections.abc import Callable
from typing import Any

import pytest
from tests.gazebo.plugins.ros_control.test_steering import ACKERMANN, BIKE, driving
from tests.gazebo_server import PATIENCE_S, Gazebo, until

_CART = """<sdf version="1.6"><model name="as_written"><pose>0 0 0.2 0 0 0</pose><link name="link">
<collision name="c"><geometry><box><size>1 1 0.4</size></box></geometry></collision></link>
<plugin name="move" filename="libgazebo_ros_planar_move.so"><commandTopic>go</commandTopic></plugin></model></sdf>"""
_BALL = """<sdf version="1.6"><model name="as_written"><pose>0 3 5 0 0 0</pose><link name="link">
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model></sdf>"""


def _on_simulation_thread(gazebo: Gazebo, call: Callable[[], Any]) -> Any:
    results: queue.SimpleQueue[Any] = queue.SimpleQueue()
    gazebo.world.post(lambda: results.put(call()))
    return results.get(timeout=PATIENCE_S)


def _poses(gazebo: Gazebo) -> bytes:
    return _on_simulation_thread(gazebo, lambda: gazebo.world.simulation.snapshot().poses.tobytes())


def _seek(gazebo: Gazebo, time_ns: int) -> None:
    def seek() -> None:
        assert gazebo.world.live.timeline is not None
        gazebo.world.live.timeline.seek(time_ns)

    _on_simulation_thread(gazebo, seek)


def test_replay_repeats_services_and_messages(gazebo: Gazebo) -> None:
    """A node of this process drives the cart; services move and push the ball, and reduce gravity."""
    gazebo.spawn(_CART, "cart")
    gazebo.spawn(_BALL, "ball")
    _on_simulation_thread(gazebo, lambda: gazebo.world.live.keep_timeline(100_000_000))
    drive = gazebo.advertise("/go", "geometry_msgs/Twist")
    gazebo.call("unpause_physics")
    gazebo.until_s(0.5)
    drive({"linear": {"x": 1.0}})
    until(lambda: gazebo.state("cart").pose.position.x > 0.1)
    begin_ns = _on_simulation_thread(gazebo, lambda: gazebo.world.simulation.time_ns)
    state = {"model_name": "ball", "pose": {"position": {"x": 4.0, "z": 6.0}}, "reference_frame": "world"}
    assert gazebo.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state).success
    push = {"body_name": "ball::link", "wrench": {"force": {"y": 3.0}}, "duration": {"nanosec": 300_000_000}}
    assert gazebo.call("apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", **push).success
    physics = {"time_step": 0.001, "gravity": {"z": -1.6}, "max_update_rate": 1000.0}
    assert gazebo.call("set_physics_properties", "gazebo_msgs/SetPhysicsProperties", **physics).success
    gazebo.until_s(begin_ns / 1e9 + 0.6)
    drive({"linear": {"y": -1.0}})
    until(lambda: gazebo.state("cart").pose.position.y < -0.1)
    gazebo.call("pause_physics")
    end_ns = _on_simulation_thread(gazebo, lambda: gazebo.world.simulation.time_ns)
    end_poses, ball = _poses(gazebo), gazebo.state("ball").pose.position
    assert (ball.x, ball.y > 0.2) == (4.0, True)

    _seek(gazebo, begin_ns)
    assert gazebo.time_s * 1e9 == begin_ns
    assert gazebo.state("ball").pose.position.x == 0.0
    assert gazebo.state("cart").pose.position.y == pytest.approx(0.0, abs=1e-9)
    _seek(gazebo, end_ns)
    assert _poses(gazebo) == end_poses


def test_spawning_a_model_with_plugins_restarts_the_timeline(gazebo: Gazebo) -> None:
    """Replay spawns a ball again; it cannot repeat the node of a cart's plugin."""
    gazebo.spawn(_BALL, "ball")
    _on_simulation_thread(gazebo, lambda: gazebo.world.live.keep_timeline(100_000_000))
    timeline = gazebo.world.live.timeline
    assert timeline is not None
    gazebo.call("unpause_physics")
    gazebo.until_s(0.2)
    gazebo.spawn(_BALL, "other", x=2.0)
    gazebo.until_s(0.5)
    assert timeline.start_ns == 0
    gazebo.call("pause_physics")
    _seek(gazebo, 0)
    assert [model.name for model in gazebo.world.simulation.models] == ["ground_plane", "ball"]
    _seek(gazebo, timeline.end_ns)
    assert [model.name for model in gazebo.world.simulation.models] == ["ground_plane", "ball", "other"]
    gazebo.spawn(_CART, "cart")
    assert timeline.start_ns == timeline.end_ns >= 500_000_000


def test_loading_a_controller_restarts_the_timeline_and_replay_repeats_its_drive(gazebo: Gazebo) -> None:
    """Replay cannot repeat the creation of its topic and object."""
    _on_simulation_thread(gazebo, lambda: gazebo.world.live.keep_timeline(100_000_000))
    gazebo.call("unpause_physics")
    gazebo.until_s(0.2)
    with driving(gazebo, BIKE, ACKERMANN):
        drive = gazebo.advertise("/base/cmd_vel", "geometry_msgs/Twist")

        def has_driven(metres: float) -> bool:
            drive({"linear": {"x": 0.5}})
            time.sleep(0.05)
            return gazebo.state("car").pose.position.x > metres

        until(lambda: has_driven(0.7))
        gazebo.call("pause_physics")
        timeline = gazebo.world.live.timeline
        assert timeline is not None
        assert timeline.start_ns >= 200_000_000
        end_poses, end_ns = _poses(gazebo), timeline.end_ns
        _seek(gazebo, timeline.start_ns)
        assert gazebo.state("car").pose.position.x == pytest.approx(0.0, abs=1e-3)
        _seek(gazebo, end_ns)
        assert _poses(gazebo) == end_poses
        gazebo.call("unpause_physics")
        until(lambda: has_driven(0.9))
