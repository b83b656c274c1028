"""libgazebo_ros_link_attacher.so: its two services attach and detach links."""

import pytest
from tests.gazebo_server import PATIENCE_S, Gazebo, until

_BODY = """<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"""
_ATTACH = "gazebo_ros_link_attacher/Attach"


def _model(name: str, x: float = 0.0, z: float = 0.0, more: str = "") -> str:
    return f'<model name="{name}"><pose>{x} 0 {z} 0 0 0</pose><link name="link">{_BODY}</link>{more}</model>'


def _world(*models: str) -> str:
    plugin = '<plugin name="ros_link_attacher_plugin" filename="libgazebo_ros_link_attacher.so"/>'
    return f'<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity>{plugin}{"".join(models)}</world></sdf>'


def _call_service(gazebo: Gazebo, service: str, first: str, second: str, *, link: str = "link") -> bool:
    names = {"model_name_1": first, "link_name_1": "link", "model_name_2": second, "link_name_2": link}
    call = gazebo.client.call_service(f"/link_attacher_node/{service}", _ATTACH, names)
    return bool(gazebo.loop.run(call, timeout_s=PATIENCE_S).ok)


def _push(gazebo: Gazebo, model: str, x: float) -> None:
    """Set a model's speed along x [m/s]."""
    state = {"model_name": model, "pose": gazebo.state(model).pose, "twist": {"linear": {"x": x}}}
    assert gazebo.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state).success


def _x(gazebo: Gazebo, model: str) -> float:
    return float(gazebo.state(model).pose.position.x)


def test_attached_models_move_together_until_detached(bare_gazebo: Gazebo) -> None:
    gazebo = bare_gazebo
    gazebo.start(world=_world(_model("a"), _model("b", 1.0)))
    assert _call_service(gazebo, "attach", "a", "b")
    assert _call_service(gazebo, "attach", "a", "b", link="b::link"), "attaching twice, by the link's scoped name"
    _push(gazebo, "a", 1.0)
    gazebo.call("unpause_physics")
    until(lambda: _x(gazebo, "b") > 1.3)
    gazebo.call("pause_physics")
    assert _x(gazebo, "b") - _x(gazebo, "a") == pytest.approx(1.0, abs=1e-6)

    assert not _call_service(gazebo, "detach", "b", "a"), "the order counts"
    assert _call_service(gazebo, "detach", "a", "b")
    assert _call_service(gazebo, "detach", "a", "b"), "detaching twice is no error"
    _push(gazebo, "b", 3.0)
    gazebo.call("unpause_physics")
    until(lambda: _x(gazebo, "b") - _x(gazebo, "a") > 1.5)
    gazebo.call("pause_physics")
    distance = _x(gazebo, "b") - _x(gazebo, "a")
    assert _call_service(gazebo, "attach", "a", "b"), "attaching again keeps the current poses"
    assert _x(gazebo, "b") - _x(gazebo, "a") == pytest.approx(distance, abs=1e-9)


def test_an_invalid_attachment_is_refused_and_logged(bare_gazebo: Gazebo) -> None:
    gazebo = bare_gazebo
    gazebo.start(world=_world(_model("a"), _model("b", 1.0)))
    log = gazebo.subscribe("/rosout_agg", "rosgraph_msgs/Log")
    assert not _call_service(gazebo, "attach", "a", "c")
    assert not _call_service(gazebo, "attach", "a", "b", link="nose")
    assert not _call_service(gazebo, "attach", "a", "a")
    for message in ("no model 'c'; there are: 'a', 'b'", "no link 'nose'", "cannot be attached to itself"):
        until(lambda message=message: any(message in str(line.msg) for line in log))
