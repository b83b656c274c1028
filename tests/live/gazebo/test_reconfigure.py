"""dynamic_reconfigure of physics, camera rates and PID gains."""

from itertools import pairwise
from typing import Any

import pytest
from tests.gazebo.plugins.ros_control.controlled import Robot, driven, fixed_robot
from tests.gazebo_server import PATIENCE_S, Gazebo, until

from trundle.ros import Option, find_reconfigurable, read_options, set_options, to_nsec

CAMERA = """<sdf version="1.6"><model name="mast"><static>1</static><link name="l">
<sensor name="eye" type="camera"><update_rate>50</update_rate><camera><horizontal_fov>1</horizontal_fov>
<image><width>16</width><height>12</height></image><clip><near>0.1</near><far>20</far></clip></camera>
<plugin name="p" filename="libgazebo_ros_camera.so"><robotNamespace>r</robotNamespace><cameraName>front</cameraName>
</plugin></sensor></link></model></sdf>"""
BALL = """<sdf version="1.6"><model name="ball"><link name="l"><pose>0 0 1 0 0 0</pose>
<inertial><mass>1</mass></inertial></link></model></sdf>"""
LIFT = driven(
    "lift",
    "prismatic",
    "EffortJointInterface",
    axis="0 0 1",
    limit='<limit lower="-1" upper="1" effort="500" velocity="9"/>',
)
CAR = """<sdf version="1.6"><model name="car"><link name="base"><pose>0 0 0.1 0 0 0</pose><inertial><mass>6</mass>
<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>{}<plugin name="tyres"
filename="libgazebo_ros_wheel_slip.so">{}</plugin></model></sdf>"""
WHEEL = """<link name="{name}"><pose>{x} {y} 0.1 -1.5707963 0 0</pose><inertial><mass>1</mass><inertia><ixx>0.005</ixx>
<iyy>0.005</iyy><izz>0.008</izz></inertia></inertial><collision name="c"><geometry><cylinder><radius>0.1</radius>
<length>0.02</length></cylinder></geometry></collision></link><joint name="{name}" type="revolute"><parent>base</parent>
<child>{name}</child><axis><xyz>0 0 1</xyz></axis></joint>"""
TYRE = """<wheel link_name="{name}"><wheel_normal_force>24.5</wheel_normal_force></wheel>"""


def options(gazebo: Gazebo, name: str) -> dict[str, Option]:
    read = gazebo.loop.run(read_options(gazebo.client, name, timeout_s=PATIENCE_S), PATIENCE_S)
    return {option.name: option for option in read}


def change(gazebo: Gazebo, name: str, **values: Any) -> None:
    gazebo.loop.run(set_options(gazebo.client, name, values, timeout_s=PATIENCE_S), PATIENCE_S)


def test_gravity_is_turned_off_and_steps_are_longer(gazebo: Gazebo) -> None:
    assert gazebo.spawn(BALL, "ball").success
    assert options(gazebo, "/gazebo")["gravity_z"].value == pytest.approx(-9.8)
    change(gazebo, "/gazebo", gravity_z=0.0, time_step=0.1)
    gazebo.call("unpause_physics")
    gazebo.until_s(0.2)

    assert gazebo.state("ball").pose.position.z == pytest.approx(0.0, abs=1e-6)
    now = options(gazebo, "/gazebo")
    assert (now["gravity_z"].value, now["time_step"].value) == (0.0, 0.1)
    assert gazebo.world.simulation.step_ns == 100_000_000
    assert gazebo.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties").gravity.z == 0.0


def test_a_camera_takes_pictures_at_the_rate_it_is_set_to(gazebo: Gazebo) -> None:
    assert gazebo.spawn(CAMERA, "mast").success
    assert options(gazebo, "/r/front")["imager_rate"].value == pytest.approx(50.0)
    change(gazebo, "/r/front", imager_rate=200)
    images = gazebo.subscribe("/r/front/image_raw", "sensor_msgs/Image")
    gazebo.call("unpause_physics")

    def shortest() -> int:  # a busy machine drops pictures
        gaps = [to_nsec(b.header.stamp) - to_nsec(a.header.stamp) for a, b in pairwise(list(images))]
        return min(gaps, default=1_000_000_000)

    until(lambda: shortest() <= 5_000_000)
    assert shortest() == 5_000_000


def test_multicamera_images_stay_synchronized_at_a_new_rate(gazebo: Gazebo) -> None:
    """The rate of one camera sets both; the plugin states the baseline."""
    one = CAMERA.partition("<camera>")[2].partition("</camera>")[0]
    eyes = "".join(f'<camera name="my_{side}_eye">{one}</camera>' for side in ("left", "right"))
    both = CAMERA.replace(f"<camera>{one}</camera>", eyes).replace('type="camera"', 'type="multicamera"')
    both = both.replace("ros_camera.so", "ros_multicamera.so").replace(
        "</plugin>", "<hackBaseline>0.1</hackBaseline></plugin>"
    )
    assert gazebo.spawn(both, "mast").success
    service_ready = gazebo.client.wait_for_service("/r/front/left/set_parameters", PATIENCE_S)
    gazebo.loop.run(service_ready, timeout_s=PATIENCE_S)
    change(gazebo, "/r/front/left", imager_rate=200)
    images = {side: gazebo.subscribe(f"/r/front/{side}/image_raw", "sensor_msgs/Image") for side in ("left", "right")}
    infos = {
        side: gazebo.subscribe(f"/r/front/{side}/camera_info", "sensor_msgs/CameraInfo") for side in ("left", "right")
    }
    gazebo.call("unpause_physics")

    def gaps(side: str) -> set[int]:  # a busy machine drops pictures
        return {to_nsec(b.header.stamp) - to_nsec(a.header.stamp) for a, b in pairwise(list(images[side]))}

    until(lambda: all(5_000_000 in gaps(side) for side in images))
    assert all(gap % 5_000_000 == 0 for side in images for gap in gaps(side))
    until(lambda: all(infos.values()))
    assert infos["left"][-1].P[3] == 0.0
    assert infos["right"][-1].P[3] == pytest.approx(-0.1 * infos["right"][-1].P[0])


def test_wheel_slip_follows_the_reconfigured_compliance(gazebo: Gazebo) -> None:
    """A rolling car of 10 kg under a side force drifts by compliance · force / load per distance rolled."""
    wheel_positions = {"w0": (0.2, 0.2), "w1": (0.2, -0.2), "w2": (-0.2, 0.2), "w3": (-0.2, -0.2)}
    wheels = "".join(WHEEL.format(name=name, x=x, y=y) for name, (x, y) in wheel_positions.items())
    tyres = "".join(TYRE.format(name=name) for name in wheel_positions)
    assert gazebo.spawn(CAR.format(wheels, tyres), "car").success
    name = "/car/wheel_slip"
    parameters = [f"slip_compliance_unitless_{direction}" for direction in ("lateral", "longitudinal")]
    assert {key: option.value for key, option in options(gazebo, name).items()} == dict.fromkeys(parameters, -1.0)
    change(gazebo, name, **{parameters[0]: 0.5})
    gazebo.call("unpause_physics")
    gazebo.call(
        "set_model_state",
        "gazebo_msgs/SetModelState",
        model_state={"model_name": "car", "twist": {"linear": {"x": 5.0}}},
    )
    gazebo.call(
        "apply_body_wrench",
        "gazebo_msgs/ApplyBodyWrench",
        body_name="car::base",
        wrench={"force": {"y": 20.0}},
        duration={"secs": -1},
    )

    gazebo.until_s(gazebo.time_s + 1.0)
    speed = gazebo.state("car").twist.linear
    assert speed.x == pytest.approx(5.0 * 10.0 / 13.2, rel=0.01)  # its wheels began to turn
    assert speed.y == pytest.approx(0.5 * 20.0 / 98.0 * speed.x, rel=0.05)


def test_pid_gains_change_while_the_controller_runs(gazebo: Gazebo) -> None:
    pid = {"p": 300.0, "i": 0.0, "d": 60.0}
    controller = {"type": "effort_controllers/JointPositionController", "joint": "lift", "pid": pid}
    robot = Robot(gazebo, fixed_robot(LIFT), {"lift": controller})
    try:
        robot.spawn("lift")
        robot.command("lift", 0.5)
        until(lambda: robot.joint("lift").position[0] == pytest.approx(0.5 - 9.8 / 300.0, abs=1e-3))
        assert "/r/lift/pid" in gazebo.loop.run(find_reconfigurable(gazebo.client), PATIENCE_S)
        change(gazebo, "/r/lift/pid", p=3000.0, d=200.0)
        until(lambda: robot.joint("lift").position[0] == pytest.approx(0.5 - 9.8 / 3000.0, abs=5e-4))
        assert gazebo.loop.run(gazebo.client.params.get("/r/lift/pid/p")) == 3000.0
    finally:
        robot.close()
