"""/gazebo's services that change a running world, tested by the motion after them."""

import math
from itertools import pairwise

import pytest
from tests.gazebo_server import PATIENCE_S, Gazebo, until

from trundle.gazebo.nodes.gazebo.ode import OdeSettings
from trundle.ros import set_options

_INERTIA = "<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
_BALL = f"""<sdf version="1.6"><model name="m"><pose>0 0 100 0 0 0</pose><link name="link">
<inertial><mass>2</mass>{_INERTIA}</inertial></link></model></sdf>"""
_PENDULUM = f"""<sdf version="1.6"><model name="m"><pose>0 0 5 0 0 0</pose><link name="base">
<inertial><mass>2</mass>{_INERTIA}</inertial></link>
<link name="arm"><inertial><mass>1</mass>{_INERTIA}</inertial></link>
<joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
<joint name="turn" type="revolute"><parent>base</parent><child>arm</child><axis><xyz>0 0 1</xyz>
<limit><lower>-2</lower><upper>2</upper></limit></axis></joint></model></sdf>"""
_JOINT = {"joint_name": "turn"}


def test_gravity_can_be_switched_off(gazebo: Gazebo) -> None:
    gazebo.spawn(_BALL, "ball")
    service_type = "gazebo_msgs/SetPhysicsProperties"
    now = gazebo.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties")
    assert gazebo.call(
        "set_physics_properties",
        service_type,
        time_step=now.time_step,
        max_update_rate=0.0,
        gravity={"x": 0.5},
        ode_config=now.ode_config,
    ).success
    gazebo.call("unpause_physics")
    gazebo.until_s(1.0)
    gazebo.call("pause_physics")

    twist = gazebo.state("ball").twist.linear
    assert twist.x == pytest.approx(0.5 * gazebo.time_s, rel=1e-3)
    assert twist.z == pytest.approx(0.0, abs=1e-9)
    refused = gazebo.call("set_physics_properties", service_type)
    assert "time_step must be from 1e-06 to 1 s, got 0" in refused.status_message


def test_the_time_step_changes_and_ode_settings_are_kept_and_reported(gazebo: Gazebo) -> None:
    """/clock at every step shows it; bodies fall no faster."""
    gazebo.spawn(_BALL, "ball")
    service_type = "gazebo_msgs/GetPhysicsProperties"
    now = gazebo.call("get_physics_properties", service_type)
    assert (now.time_step, now.ode_config.sor_pgs_iters, now.ode_config.max_contacts) == (0.001, 50, 20)
    config = {name: getattr(now.ode_config, name) for name in OdeSettings().values}
    response = gazebo.call(
        "set_physics_properties",
        "gazebo_msgs/SetPhysicsProperties",
        time_step=0.004,
        max_update_rate=0.0,
        gravity=now.gravity,
        ode_config={**config, "sor_pgs_iters": 200, "erp": 0.8},
    )
    assert response.success
    assert response.status_message == (
        "physics engine updated; without effect here, where MuJoCo is the engine: sor_pgs_iters, erp"
    )
    properties = gazebo.call("get_physics_properties", service_type)
    assert (properties.time_step, properties.max_update_rate, properties.ode_config.sor_pgs_iters) == (0.004, 0.0, 200)
    gazebo.call("unpause_physics")
    gazebo.until_s(1.0)
    gazebo.call("pause_physics")

    assert gazebo.world.simulation.step_ns == 4_000_000
    assert gazebo.world.simulation.time_ns % 4_000_000 == 0
    assert gazebo.state("ball").twist.linear.z == pytest.approx(-9.8 * gazebo.time_s, rel=1e-3)


def test_dynamic_reconfigure_changes_the_time_step_too(gazebo: Gazebo) -> None:
    values = {"time_step": 0.002, "gravity_z": 0.0, "erp": 0.5}
    properties = gazebo.loop.run(
        set_options(gazebo.client, "/gazebo", values, timeout_s=PATIENCE_S), timeout_s=PATIENCE_S
    )

    assert {name: properties[name] for name in values} == values
    assert gazebo.world.simulation.step_ns == 2_000_000
    now = gazebo.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties")
    assert (now.gravity.z, now.ode_config.erp) == (0.0, 0.5)


def test_a_new_mass_changes_the_acceleration(gazebo: Gazebo) -> None:
    """4 N for half a second on 8 kg without gravity: a quarter of a metre a second."""
    gazebo.spawn(_BALL, "ball")
    service_type = "gazebo_msgs/SetLinkProperties"
    inertia = {"ixx": 1.0, "iyy": 1.0, "izz": 1.0}
    assert gazebo.call(
        "set_link_properties", service_type, link_name="ball::link", mass=8.0, gravity_mode=False, **inertia
    ).success
    properties = gazebo.call("get_link_properties", "gazebo_msgs/GetLinkProperties", link_name="ball::link")
    assert (properties.mass, properties.gravity_mode, properties.ixx) == (8.0, False, 1.0)
    push = {"body_name": "ball::link", "wrench": {"force": {"x": 4.0}}, "duration": {"nanosec": 500_000_000}}
    gazebo.call("apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", **push)
    gazebo.call("unpause_physics")
    gazebo.until_s(1.0)

    twist = gazebo.state("ball").twist.linear
    assert (twist.x, twist.z) == (pytest.approx(0.25, rel=1e-3), pytest.approx(0.0, abs=1e-9))
    nothing = gazebo.call("set_link_properties", service_type, link_name="ball::link", mass=0.0, **inertia)
    assert "must be greater than 0" in nothing.status_message


def test_joint_limits_damping_and_motor_are_set(gazebo: Gazebo) -> None:
    gazebo.spawn(_PENDULUM, "arm")
    service_type = "gazebo_msgs/SetJointProperties"
    config = {"hiStop": [0.5], "loStop": [-0.5], "damping": [0.25], "fmax": [10.0], "vel": [2.0], "cfm": [0.1]}
    response = gazebo.call("set_joint_properties", service_type, **_JOINT, ode_joint_config=config)
    assert response.success
    assert response.status_message.endswith("without effect here: cfm")
    gazebo.call("unpause_physics")
    gazebo.until_s(1.0)

    properties = gazebo.call("get_joint_properties", "gazebo_msgs/GetJointProperties", **_JOINT)
    assert list(properties.damping) == [0.25]
    assert properties.position[0] == pytest.approx(0.5, abs=0.01)  # driven against its new stop
    for wrong in ({"hiStop": [-1.0]}, {"damping": [-1.0]}, {"fmax": [1.0, 2.0]}):
        assert not gazebo.call("set_joint_properties", service_type, **_JOINT, ode_joint_config=wrong).success


def test_lights_are_changed_and_deleted(gazebo: Gazebo) -> None:
    name = {"light_name": "sun"}
    before = gazebo.call("get_light_properties", "gazebo_msgs/GetLightProperties", **name)
    assert before.success
    color = {"r": 1.0, "g": 0.5, "b": 0.25, "a": 1.0}
    assert gazebo.call(
        "set_light_properties",
        "gazebo_msgs/SetLightProperties",
        **name,
        diffuse=color,
        attenuation_linear=0.5,
        direction={"z": -2.0},
    ).success
    after = gazebo.call("get_light_properties", "gazebo_msgs/GetLightProperties", **name)
    assert (after.diffuse.g, after.attenuation_linear) == (0.5, 0.5)
    assert gazebo.world.simulation.world.lights[0].direction == (0.0, 0.0, -1.0)

    assert gazebo.call("delete_light", "gazebo_msgs/DeleteLight", **name).success
    deleted = gazebo.call("get_light_properties", "gazebo_msgs/GetLightProperties", **name)
    assert deleted.status_message == "GetLightProperties: no light 'sun'; lights: none"


@pytest.mark.parametrize(
    ("rate", "distro", "period"),
    [
        (50.0, "noetic", 0.02),
        (50, "kinetic", 0.02),
        (50.0, "indigo", 0.001),
        (0, "noetic", 0.001),
        (None, "melodic", 0.001),
        ("fast", "noetic", 0.001),
    ],
)
def test_the_clock_is_published_at_its_frequency_parameter(
    bare_gazebo: Gazebo, rate: object, distro: str, period: float
) -> None:
    gazebo = bare_gazebo
    if rate is not None:
        gazebo.loop.run(gazebo.client.params.set("/gazebo/pub_clock_frequency", rate))
    gazebo.start(distro)
    messages = gazebo.subscribe("/clock", "rosgraph_msgs/Clock")
    gazebo.call("unpause_physics")

    def closest() -> float:
        """Least time between two messages received [s]; on a busy machine some are lost."""
        stamps = [message.clock.sec + message.clock.nanosec * 1e-9 for message in messages]
        return min((b - a for a, b in pairwise(stamps)), default=math.inf)

    until(lambda: closest() == pytest.approx(period, abs=1e-9))
    count = len(messages)
    until(lambda: len(messages) > count + 20)
    assert closest() == pytest.approx(period, abs=1e-9)
