"""Grids, axes, frames, robots and groups, for rviz and the page to draw."""

import math
from typing import Any

from tests.page.picture_case import FRAMES, HEADER, IN_PLATE, Case, point

URDF = """<robot name="cart">
  <material name="orange"><color rgba="1 0.5 0 1"/></material>
  <link name="base">
    <visual><geometry><box size="1.5 1 0.4"/></geometry><material name="orange"/></visual>
    <visual><origin xyz="0 0 0.6"/><geometry><sphere radius="0.4"/></geometry></visual>
    <collision><geometry><box size="2 1.2 0.8"/></geometry></collision>
  </link>
  <link name="arm"><visual><geometry><cylinder radius="0.3" length="1.2"/></geometry>
    <material name="blue"><color rgba="0.1 0.2 0.9 1"/></material></visual>
    <collision><geometry><sphere radius="0.6"/></geometry></collision></link>
  <link name="plate"><visual><geometry><mesh filename="package://pictures/plate.dae"/></geometry></visual>
    <collision><origin xyz="0 0 0.5" rpy="0.3 0 0.5"/>
      <geometry><mesh filename="package://pictures/pyramid.stl" scale="1 2 1"/></geometry></collision></link>
  <joint name="hinge" type="fixed"><parent link="arm"/><child link="plate"/></joint>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit effort="20" velocity="1" lower="-1" upper="1"/></joint>
</robot>"""
TEXTURED_URDF = """<robot name="sign">
  <link name="base"><visual><origin rpy="0.2 -0.3 0.4"/><geometry>
    <mesh filename="package://pictures/sign.dae" scale="2 2 2"/></geometry></visual></link>
  <link name="plate"><visual><geometry><mesh filename="package://pictures/pyramid.stl" scale="2 2 2"/></geometry>
    <material name="glass"><color rgba="0.2 0.9 0.4 0.5"/></material></visual></link>
  <joint name="weld" type="fixed"><parent link="base"/><child link="plate"/></joint>
</robot>"""


def _case(name: str, kind: str, **properties: Any) -> Case:
    return Case(name=name, display={"Class": f"rviz/{kind}", "Name": kind, **properties})


_WIDE = {"Line Style": {"Line Width": 0.08, "Value": "Billboards"}}
_GRIDS = [
    _case("Grid", "Grid", **{"Plane Cell Count": 8, "Alpha": 1}),
    _case("Grid of billboards", "Grid", Alpha=1, Color="200; 80; 40", **{"Plane Cell Count": 4}, **_WIDE),
    *(
        _case(f"Grid in {plane}", "Grid", Alpha=1, Plane=plane, **{"Plane Cell Count": 4, "Cell Size": 0.7}, **_WIDE)
        for plane in ("XZ", "YZ")
    ),
    _case(
        "Grid of layers in a frame",
        "Grid",
        Alpha=0.5,
        Offset={"X": 0.5, "Y": 1, "Z": -0.3},
        **{"Reference Frame": "plate", "Plane Cell Count": 3, "Normal Cell Count": 2, "Cell Size": 0.8},
        **_WIDE,
    ),
    _case("Axes", "Axes", Length=2, Radius=0.3),
    _case("Axes of a frame", "Axes", Length=1.5, Radius=0.2, **{"Reference Frame": "arm"}),
    _case("Axes half seen through", "Axes", Length=2, Radius=0.4, Alpha=0.4),
]

_FRAMES = {"Show Names": False, "Marker Scale": 5, "Frame Timeout": 100_000}
_STAMPED = {"frame_id": "map", "stamp": {"secs": 1, "nsecs": 0}}
_OLD = {
    "header": HEADER | {"stamp": {"secs": 1, "nsecs": 0}},
    "child_frame_id": "old",
    "transform": {"translation": point(2, -2, 1), "rotation": {"w": 1.0}},
}
_TREES = [
    _case("TF", "TF", **_FRAMES),
    _case("TF without arrows", "TF", **_FRAMES, **{"Show Arrows": False, "Marker Alpha": 0.5}),
    _case("TF without axes", "TF", **_FRAMES, **{"Show Axes": False}),
    _case(
        "TF with a frame off",
        "TF",
        **_FRAMES,
        Frames={"All Enabled": False, **{frame: {"Value": True} for frame in FRAMES}, "plate": {"Value": False}},
    ),
    Case(
        name="TF with a frame that comes late",
        display={"Class": "rviz/TF", "Name": "TF", **_FRAMES},
        messages=[("/tf", "tf2_msgs/TFMessage", {"transforms": [_OLD]})],
    ),
    _case("TF with a frame that is too old", "TF", **_FRAMES | {"Frame Timeout": 2}),
]

_LINKS = {
    "All Links Enabled": True,
    "base": {"Alpha": 0.4, "Show Axes": False, "Show Trail": False, "Value": True},
    "arm": {"Alpha": 1, "Show Axes": True, "Show Trail": False, "Value": False},
}
_ROBOTS = [
    _case("RobotModel", "RobotModel"),
    _case("RobotModel half seen through", "RobotModel", Alpha=0.5),
    _case("RobotModel of collisions", "RobotModel", **{"Visual Enabled": False, "Collision Enabled": True}),
    _case("RobotModel with links of their own", "RobotModel", Links=_LINKS),
    _case("RobotModel with textures", "RobotModel", **{"Robot Description": "sign_description"}),
    Case(
        name="Effort",
        display={"Class": "rviz/Effort", "Name": "Effort", "Topic": "/joint_states", "Width": 0.05, "Scale": 2},
        messages=[
            (
                "/joint_states",
                "sensor_msgs/JointState",
                {"header": HEADER, "name": ["shoulder"], "position": [0.0], "velocity": [0.0], "effort": [15.0]},
            )
        ],
    ),
]

_GROUPED = [
    {"Class": "rviz/Axes", "Name": "Axes", "Enabled": True, "Value": True, "Length": 1.5, "Radius": 0.2},
    {"Class": "rviz/Axes", "Name": "Off", "Enabled": False, "Value": False, "Length": 3, "Radius": 0.5},
    {
        "Class": "rviz/Group",
        "Name": "Inner",
        "Enabled": True,
        "Displays": [
            {"Class": "rviz/Axes", "Name": "Arm", "Enabled": True, "Value": True, "Length": 1, "Radius": 0.3}
            | {"Reference Frame": "arm"}
        ],
    },
]
_GROUPS = [_case("Group", "Group", Displays=_GROUPED)]


# Debian's rviz has no Imu: the expected picture is drawn by its other displays (with rviz_imu_plugin's sizes).
_TILT = {"x": math.sin(0.4), "y": 0.0, "z": 0.0, "w": math.cos(0.4)}
_PUSH = (3.0, 0.0, 4.0)
_AT = dict(zip("xyz", FRAMES["plate"], strict=True))
_READING = {"header": IN_PLATE, "orientation": _TILT, "linear_acceleration": point(*_PUSH)}


def _imu(name: str, real: dict[str, Any], message: tuple[str, str, dict[str, Any]], **properties: Any) -> Case:
    return Case(
        name=f"Imu {name}",
        display={"Class": "rviz_imu_plugin/Imu", "Name": "Imu", "Topic": "/imu", **properties},
        messages=[("/imu", "sensor_msgs/Imu", _READING), message],
        real=real,
    )


def _pose(topic: str, orientation: dict[str, float]) -> tuple[str, str, dict[str, Any]]:
    return (
        topic,
        "geometry_msgs/PoseStamped",
        {"header": HEADER, "pose": {"position": _AT, "orientation": orientation}},
    )


def _along_push() -> dict[str, float]:
    """Return the rotation from x to the acceleration, after the reading's rotation about x."""
    half = -math.atan2(_PUSH[2], _PUSH[0]) / 2
    s, c, w, x = math.sin(half), math.cos(half), _TILT["w"], _TILT["x"]
    return {"x": x * c, "y": w * s, "z": x * s, "w": w * c}


_SIZE = {"x_scale": 1.5, "y_scale": 1.0, "z_scale": 0.3}
_IMU_BOX = {"header": HEADER, "type": 1, "pose": {"position": _AT, "orientation": _TILT}, "scale": point(1.5, 1.0, 0.3)}
_SCALE = 0.4
_ARROW = {"Shaft Length": 5 * _SCALE, "Shaft Radius": 0.5 * _SCALE, "Head Length": _SCALE, "Head Radius": _SCALE}
_IMUS = [
    _imu(
        "as axes",
        {
            "Class": "rviz/Pose",
            "Name": "Imu",
            "Topic": "/imu_pose",
            "Shape": "Axes",
            "Axes Length": 2,
            "Axes Radius": 0.2,
        },
        _pose("/imu_pose", _TILT),
        **{"Axes properties": {"Axes scale": 2, "Enable axes": True}},
    ),
    _imu(
        "as a box",
        {"Class": "rviz/Marker", "Name": "Imu", "Marker Topic": "/imu_box"},
        ("/imu_box", "visualization_msgs/Marker", _IMU_BOX | {"color": {"r": 1.0, "g": 0.0, "b": 0.0, "a": 1.0}}),
        **{"Axes properties": {"Enable axes": False}, "Box properties": {"Enable box": True} | _SIZE},
    ),
    _imu(
        "with its acceleration",
        {"Class": "rviz/Pose", "Name": "Imu", "Topic": "/imu_push", "Shape": "Arrow", "Color": "255; 0; 0", **_ARROW},
        _pose("/imu_push", _along_push()),
        **{
            "Axes properties": {"Enable axes": False},
            "Acceleration properties": {"Enable acceleration": True, "Acc. vector scale": _SCALE},
        },
    ),
]
SCENE = [*_GRIDS, *_TREES, *_ROBOTS, *_GROUPS, *_IMUS]
