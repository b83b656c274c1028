"""Names, numbers and namespaces in requests to /gazebo's services."""

import math
from typing import Any

import pytest
from tests.gazebo_server import Gazebo, until

_LINK = "<link name='{}'><inertial><mass>1</mass></inertial></link>"
_ARM = f"""<sdf version="1.6"><model name="m">{_LINK.format("base")}{_LINK.format("rod")}
<joint name="turn" type="revolute"><parent>base</parent><child>rod</child><axis><xyz>0 0 1</xyz></axis></joint>
</model></sdf>"""
_NESTED = f"""<sdf version="1.6"><model name="m">{_LINK.format("a")}<model name="inner"><pose>1 0 0 0 0 0</pose>
{_LINK.format("b")}</model></model></sdf>"""
_NO_VECTOR = {"x": math.nan}
_NOWHERE = {"position": _NO_VECTOR}


def test_links_of_nested_models_are_found(gazebo: Gazebo) -> None:
    gazebo.spawn(_NESTED, "outer", x=2.0)
    for name in ("outer::inner::b", "inner::b", "b"):
        response = gazebo.call("get_link_state", "gazebo_msgs/GetLinkState", link_name=name)
        assert (response.success, response.link_state.pose.position.x) == (True, 3.0)

    model = gazebo.call("get_model_properties", "gazebo_msgs/GetModelProperties", model_name="outer")
    assert (list(model.body_names), list(model.child_model_names)) == (["a"], ["inner"])


def test_numbers_that_are_not_finite_are_refused(gazebo: Gazebo) -> None:
    gazebo.spawn(_ARM, "arm")
    requests: tuple[tuple[str, str, dict[str, Any]], ...] = (
        ("spawn_sdf_model", "SpawnModel", {"model_name": "b", "model_xml": _ARM, "initial_pose": _NOWHERE}),
        ("set_model_state", "SetModelState", {"model_state": {"model_name": "arm", "pose": _NOWHERE}}),
        ("set_model_state", "SetModelState", {"model_state": {"model_name": "arm", "twist": {"linear": _NO_VECTOR}}}),
        ("set_link_state", "SetLinkState", {"link_state": {"link_name": "base", "pose": {"orientation": _NO_VECTOR}}}),
        (
            "set_model_configuration",
            "SetModelConfiguration",
            {"model_name": "arm", "joint_names": ["turn"], "joint_positions": [math.nan]},
        ),
        ("apply_body_wrench", "ApplyBodyWrench", {"body_name": "base", "wrench": {"torque": {"x": math.inf}}}),
        ("apply_joint_effort", "ApplyJointEffort", {"joint_name": "turn", "effort": math.nan}),
    )
    for service, type_name, fields in requests:
        response = gazebo.call(service, f"gazebo_msgs/{type_name}", **fields)
        assert not response.success
        assert response.status_message.startswith(f"{type_name}: finite numbers are needed, got ")
    gazebo.call("unpause_physics")
    gazebo.until_s(0.05)
    assert math.isfinite(gazebo.state("arm").pose.position.z)


def test_a_namespace_applies_to_plugins_without_one(gazebo: Gazebo) -> None:
    plugin = "<plugin name='p' filename='libgazebo_ros_joint_state_publisher.so'><jointName>turn</jointName>"
    for number, (written, namespace, topic) in enumerate(
        (
            ("", "/one", "/one/joint_states"),
            ("", "/", "/joint_states"),
            ("<robotNamespace>own</robotNamespace>", "/one", "/own/joint_states"),
        )
    ):
        model = _ARM.replace("</model>", f"{plugin}{written}</plugin></model>")
        assert gazebo.spawn(model, f"arm{number}", x=3.0 * number, robot_namespace=namespace).success
        messages = gazebo.subscribe(topic, "sensor_msgs/JointState")
        gazebo.call("unpause_physics")
        until(lambda messages=messages: messages)
        assert list(messages[0].name) == ["turn"]


def test_the_twist_of_a_model_state_is_set_at_each_links_origin(gazebo: Gazebo) -> None:
    body = "<inertial><pose>0 0.3 0 0 0 0</pose><mass>1</mass></inertial>"
    links = "".join(
        f'<link name="{name}"><pose>{x} 0 0 0 0 0</pose>{body}</link>' for name, x in (("near", 0), ("far", 2))
    )
    gazebo.spawn(f'<sdf version="1.6"><model name="pair">{links}</model></sdf>', "pair")
    gazebo.call("pause_physics")

    twist = {"linear": {"x": 0.4, "y": 0.1, "z": 0.0}, "angular": {"x": 0.0, "y": 0.0, "z": 3.0}}
    state = {"model_name": "pair", "pose": {"position": {"z": 5.0}, "orientation": {"w": 1.0}}, "twist": twist}
    assert gazebo.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state).success

    for name in ("near", "far"):
        moves = gazebo.call("get_link_state", "gazebo_msgs/GetLinkState", link_name=name).link_state.twist
        assert (moves.linear.x, moves.linear.y, moves.angular.z) == pytest.approx((0.4, 0.1, 3.0), abs=1e-6)
