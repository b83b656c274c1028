"""Three robots, each with a lidar: two driven wheels, a steered wheel, and wheels that roll sideways.

The lidar is planar, or has 16 rings and publishes clouds.
"""

import math
from typing import Any, NamedTuple


class Lidar(NamedTuple):
    """A planar lidar."""

    beams: int
    span_rad: float
    """Angle between the first and the last beam."""
    range_m: float


LIDAR = Lidar(541, math.radians(270.0), 10.0)
RINGS = 16
"""Rays above one another of the other lidar, from −15° to 15°."""
_PLANAR = """<plugin name="lidar" filename="libgazebo_ros_laser.so"><topicName>scan</topicName>
<frameName>base_scan</frameName></plugin>"""
_CLOUDS = """<plugin name="lidar" filename="libgazebo_ros_velodyne_laser.so"><topicName>/velodyne_points</topicName>
<frameName>base_scan</frameName></plugin>"""
_VERTICAL = f"""<vertical><samples>{RINGS}</samples><min_angle>-0.2618</min_angle><max_angle>0.2618</max_angle>
</vertical>"""


class Robot(NamedTuple):
    """A robot's links and drive, and the parameters of its planner."""

    body: str
    drive: str
    footprint: tuple[tuple[float, float], ...]
    """Corners of the body in base_footprint, counterclockwise [m]."""
    odometry: str
    """`odom_model_type` of amcl."""
    turning_m: float
    """Least turning radius; 0: it turns on the spot [m]."""
    planner: dict[str, Any]

    def sdf(self, pose: tuple[float, float, float], plugins: str, *, has_rings: bool = False) -> str:
        """Return the model `robot` at a pose x, y [m], yaw [rad]."""
        x, y, yaw = pose
        half = LIDAR.span_rad / 2
        return f"""<model name="robot"><pose>{x} {y} 0 0 0 {yaw}</pose>{self.body}
<link name="base_scan"><pose>0 0 0.22 0 0 0</pose><inertial><mass>0.05</mass>
<inertia><ixx>1e-4</ixx><iyy>1e-4</iyy><izz>1e-4</izz></inertia></inertial>
<sensor name="lidar" type="ray"><update_rate>10</update_rate>
<ray><scan><horizontal><samples>{LIDAR.beams}</samples><min_angle>{-half}</min_angle><max_angle>{half}</max_angle>
</horizontal>{_VERTICAL if has_rings else ""}</scan><range><min>0.1</min><max>{LIDAR.range_m}</max></range>
<noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise></ray>
{_CLOUDS if has_rings else _PLANAR}</sensor></link>
<joint name="scan" type="fixed"><parent>base_footprint</parent><child>base_scan</child></joint>
{self.drive}{plugins}</model>"""


def _body(geometry: str, at: str, mass_kg: float, more: str = "") -> str:
    inertia = mass_kg * 0.012
    return f"""<link name="base_footprint"><inertial><pose>{at}</pose><mass>{mass_kg}</mass>
<inertia><ixx>{inertia}</ixx><iyy>{inertia}</iyy><izz>{2 * inertia}</izz></inertia></inertial>
<collision name="body"><pose>{at}</pose><geometry>{geometry}</geometry></collision>{more}</link>"""


def _wheel(name: str, x: float, y: float, axis: str, parent: str = "base_footprint") -> str:
    """Return a wheel of 0.06 m radius and its joint of the same name."""
    return f"""<link name="{name}_link"><pose>{x} {y} 0.06 1.5707963 0 0</pose><inertial><mass>0.3</mass>
<inertia><ixx>3e-4</ixx><iyy>3e-4</iyy><izz>5.4e-4</izz></inertia></inertial>
<collision name="wheel"><geometry><cylinder><radius>0.06</radius><length>0.03</length></cylinder></geometry></collision>
</link><joint name="{name}" type="continuous"><parent>{parent}</parent><child>{name}_link</child>
<axis><xyz>{axis}</xyz><use_parent_model_frame>1</use_parent_model_frame></axis></joint>"""


def _ball(x: float) -> str:
    return f"""<collision name="ball_{x}"><pose>{x} 0 0.02 0 0 0</pose><geometry><sphere><radius>0.02</radius></sphere>
</geometry><surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>"""


def _rectangle(back: float, front: float, half: float) -> tuple[tuple[float, float], ...]:
    return (back, -half), (front, -half), (front, half), (back, half)


_COMMON = {"acc_lim_x": 1.0, "acc_lim_theta": 3.0, "sim_time": 1.6, "vx_samples": 12, "vth_samples": 30}
_COMMON |= {"path_distance_bias": 32.0, "goal_distance_bias": 20.0, "occdist_scale": 0.02}
_STRAIGHT = {**_COMMON, "max_vel_y": 0.0, "min_vel_y": 0.0, "vy_samples": 0}
_DIFFERENTIAL = Robot(
    body=_body("<cylinder><radius>0.18</radius><length>0.12</length></cylinder>", "0 0 0.1 0 0 0", 4.0)[:-7]
    + _ball(0.14)
    + _ball(-0.14)
    + "</link>"
    + _wheel("left", 0.0, 0.14, "0 1 0")
    + _wheel("right", 0.0, -0.14, "0 1 0"),
    drive="""<plugin name="drive" filename="libgazebo_ros_diff_drive.so"><leftJoint>left</leftJoint>
<rightJoint>right</rightJoint><wheelSeparation>0.28</wheelSeparation><wheelDiameter>0.12</wheelDiameter>
<wheelAcceleration>2</wheelAcceleration><wheelTorque>5</wheelTorque><odometrySource>encoder</odometrySource>
<legacyMode>false</legacyMode><robotBaseFrame>base_footprint</robotBaseFrame><updateRate>50</updateRate>
<publishWheelTF>false</publishWheelTF><publishWheelJointState>false</publishWheelJointState></plugin>""",
    footprint=tuple((0.18 * math.cos(k * math.tau / 12), 0.18 * math.sin(k * math.tau / 12)) for k in range(12)),
    odometry="diff",
    turning_m=0.0,
    planner={**_STRAIGHT, "max_vel_x": 0.5, "max_vel_trans": 0.5, "max_vel_theta": 1.5},
)
_CAR = Robot(
    body=_body("<box><size>0.56 0.3 0.12</size></box>", "0.17 0 0.14 0 0 0", 6.0)
    + _wheel("left", 0.0, 0.12, "0 1 0")
    + _wheel("right", 0.0, -0.12, "0 1 0")
    + """<link name="fork"><pose>0.34 0 0.06 0 0 0</pose><inertial><mass>0.2</mass>
<inertia><ixx>2e-4</ixx><iyy>2e-4</iyy><izz>2e-4</izz></inertia></inertial></link>
<joint name="steering" type="revolute"><parent>base_footprint</parent><child>fork</child><axis><xyz>0 0 1</xyz>
<limit><lower>-0.62</lower><upper>0.62</upper></limit></axis></joint>"""
    + _wheel("front", 0.34, 0.0, "0 1 0", "fork"),
    drive="""<plugin name="drive" filename="libgazebo_ros_tricycle_drive.so"><steeringJoint>steering</steeringJoint>
<actuatedWheelJoint>front</actuatedWheelJoint><encoderWheelLeftJoint>left</encoderWheelLeftJoint>
<encoderWheelRightJoint>right</encoderWheelRightJoint><actuatedWheelDiameter>0.12</actuatedWheelDiameter>
<encoderWheelDiameter>0.12</encoderWheelDiameter><encoderWheelSeparation>0.24</encoderWheelSeparation>
<wheelAcceleration>20</wheelAcceleration><steeringSpeed>2.5</steeringSpeed><wheelTorque>5</wheelTorque>
<odometrySource>encoder</odometrySource><commandTopic>steering</commandTopic><odometryTopic>odom</odometryTopic>
<odometryFrame>odom</odometryFrame><robotBaseFrame>base_footprint</robotBaseFrame><updateRate>50</updateRate></plugin>
<plugin name="steer" filename="libsteer_by_twist.so"><wheelbase>0.34</wheelbase><limit>0.6</limit></plugin>""",
    footprint=_rectangle(-0.11, 0.45, 0.15),
    odometry="diff",
    turning_m=0.5,
    planner=_STRAIGHT
    | {"max_vel_x": 0.5, "min_vel_x": -0.3, "max_vel_trans": 0.5, "max_vel_theta": 1.0, "min_turning_radius": 0.5},
)
_OMNI = Robot(
    body=_body("<box><size>0.4 0.3 0.16</size></box>", "0 0 0.12 0 0 0", 6.0),
    drive="""<plugin name="drive" filename="libgazebo_ros_planar_move.so"><commandTopic>cmd_vel</commandTopic>
<odometryTopic>odom</odometryTopic><odometryFrame>odom</odometryFrame><odometryRate>30</odometryRate>
<robotBaseFrame>base_footprint</robotBaseFrame></plugin>""",
    footprint=_rectangle(-0.2, 0.2, 0.15),
    odometry="omni",
    turning_m=0.0,
    planner=_COMMON
    | {"max_vel_x": 0.4, "min_vel_x": -0.2, "max_vel_y": 0.3, "min_vel_y": -0.3, "vy_samples": 7}
    | {"max_vel_trans": 0.4, "max_vel_theta": 1.0, "acc_lim_y": 1.0, "vx_samples": 7, "vth_samples": 14},
)
ROBOTS = {"differential": _DIFFERENTIAL, "car": _CAR, "omni": _OMNI}
