"""Poses, paths, maps and readings, for rviz and the page to draw."""

from typing import Any

from tests.page.picture_case import HEADER, IN_PLATE, Case, Message, covariance, point, pose, ring

_TWIST = {"linear": point(1, 0, 0.3), "angular": point(0, 0.4, 0.8)}
_READING = {"header": IN_PLATE, "variance": 0.0}


def _case(name: str, kind: str, topic: str, *messages: Message, **properties: Any) -> Case:
    shown = {"Class": f"rviz/{kind}", "Name": kind, "Topic": topic, **properties}
    return Case(name=name, display=shown, messages=messages)


def _odometry(**fields: Any) -> Message:
    placed = {"pose": pose(0.5, 0.5, 0.2, 0.7), "covariance": covariance(0.4, 0.2, 0, 0, 0, 0.05)}
    return ("/odom", "nav_msgs/Odometry", {"header": HEADER, "pose": placed} | fields)


_SURE = {"pose": pose(0, 0, 1, 0.4), "covariance": covariance(0.4, 0.2, 0.3, 0.05, 0.1, 0.02)}
_PLANAR = {"pose": pose(0, 0, 0.5, 0.4), "covariance": covariance(0.4, 0.2, 0, 0, 0, 0.1)}
_ARROW = {"Head Radius": 0.3, "Shaft Radius": 0.15, "Shaft Length": 0.4, "Head Length": 0.3}
_POSES = [
    _case(
        "Odometry",
        "Odometry",
        "/odom",
        _odometry(),
        Covariance={"Position": {"Alpha": 0.8, "Value": True}, "Value": True},
    ),
    _case(
        "Odometry as axes",
        "Odometry",
        "/odom",
        Shape={"Value": "Axes", "Axes Length": 1.5},
        Covariance={"Value": False},
    ),
    _case(
        "Odometry in other colors",
        "Odometry",
        "/odom",
        Shape={"Value": "Arrow", "Color": "40; 90; 255", "Alpha": 0.6, "Shaft Radius": 0.2, "Head Radius": 0.4},
        Covariance={
            "Position": {"Color": "40; 200; 90", "Alpha": 0.6, "Scale": 2, "Value": True},
            "Orientation": {"Value": False},
            "Value": True,
        },
    ),
    _case(
        "PoseWithCovariance",
        "PoseWithCovariance",
        "/sure",
        ("/sure", "geometry_msgs/PoseWithCovarianceStamped", {"header": HEADER, "pose": _SURE}),
        Covariance={"Orientation": {"Color Style": "RGB", "Value": True}, "Value": True},
    ),
    _case(
        "PoseWithCovariance in the fixed frame",
        "PoseWithCovariance",
        "/sure",
        Covariance={
            "Position": {"Value": False},
            "Orientation": {"Frame": "Fixed", "Color": "60; 200; 255", "Alpha": 0.8, "Offset": 1.5, "Value": True},
            "Value": True,
        },
    ),
    _case(
        "PoseWithCovariance in the plane",
        "PoseWithCovariance",
        "/planar",
        ("/planar", "geometry_msgs/PoseWithCovarianceStamped", {"header": HEADER, "pose": _PLANAR}),
        Shape="Axes",
        Covariance={"Position": {"Alpha": 0.8, "Value": True}, "Value": True},
    ),
    _case(
        "Pose",
        "Pose",
        "/pose",
        ("/pose", "geometry_msgs/PoseStamped", {"header": IN_PLATE, "pose": pose(0, 0, 0.5, 1)}),
        **{"Shaft Radius": 0.2, "Head Radius": 0.4},
    ),
    _case("Pose as axes", "Pose", "/pose", Shape="Axes"),
    _case(
        "Pose half seen through",
        "Pose",
        "/pose",
        Color="40; 90; 255",
        Alpha=0.5,
        **{"Shaft Radius": 0.2, "Head Radius": 0.4},
    ),
    _case(
        "PoseArray",
        "PoseArray",
        "/poses",
        ("/poses", "geometry_msgs/PoseArray", {"header": HEADER, "poses": ring(12)}),
        Color="200; 120; 60",
        **{"Arrow Length": 0.8},
    ),
    _case("PoseArray of arrows", "PoseArray", "/poses", Shape="Arrow (3D)", **_ARROW),
    _case("PoseArray of axes", "PoseArray", "/poses", Shape="Axes", **{"Axes Length": 0.6, "Axes Radius": 0.1}),
]

_PATH_POSES = [{"header": HEADER, "pose": at} for at in ring(16)]
_WIDE = {"Line Style": "Billboards", "Line Width": 0.15}
_PATHS = [
    _case("Path", "Path", "/path", ("/path", "nav_msgs/Path", {"header": HEADER, "poses": _PATH_POSES})),
    _case("Path of billboards", "Path", "/path", Color="200; 60; 200", **_WIDE),
    _case("Path raised", "Path", "/path", Offset={"X": 0.5, "Y": 0, "Z": 1}, **_WIDE),
    _case("Path with arrows", "Path", "/path", **_WIDE, **{"Pose Style": "Arrows"}),
    _case("Path with axes", "Path", "/path", **_WIDE, **{"Pose Style": "Axes", "Length": 0.5, "Radius": 0.1}),
    Case(
        name="Path with the one before",
        display={"Class": "rviz/Path", "Name": "Path", "Topic": "/ways", "Buffer Length": 2, **_WIDE},
        repeated=[("/ways", "nav_msgs/Path", {"header": frame, "poses": _PATH_POSES}) for frame in (HEADER, IN_PLATE)],
    ),
    _case(
        "PointStamped",
        "PointStamped",
        "/point",
        ("/point", "geometry_msgs/PointStamped", {"header": IN_PLATE, "point": point(0.5, 0.5, 0.5)}),
        Radius=0.5,
    ),
    Case(
        name="PointStamped with those before",
        display={
            "Class": "rviz/PointStamped",
            "Name": "Points",
            "Topic": "/clicked",
            "Radius": 0.3,
            "History Length": 2,
        },
        repeated=[
            ("/clicked", "geometry_msgs/PointStamped", {"header": HEADER, "point": point(side, 0.5, 0.5)})
            for side in (-1, 1)
        ],
    ),
    _case("PointStamped half seen through", "PointStamped", "/point", Radius=0.8, Color="90; 255; 90", Alpha=0.4),
    _case(
        "Polygon",
        "Polygon",
        "/polygon",
        (
            "/polygon",
            "geometry_msgs/PolygonStamped",
            {"header": HEADER, "polygon": {"points": [point(2, 2), point(-2, 2), point(-2, -2, 1), point(2, -2)]}},
        ),
        Color="150; 180; 40",
    ),
    _case(
        "GridCells",
        "GridCells",
        "/cells",
        (
            "/cells",
            "nav_msgs/GridCells",
            {
                "header": HEADER,
                "cell_width": 0.5,
                "cell_height": 0.3,
                "cells": [at["position"] for at in ring(12)],
            },
        ),
    ),
    _case("GridCells half seen through", "GridCells", "/cells", Color="255; 200; 40", Alpha=0.5),
]

_INFO = {"resolution": 0.2, "width": 20, "height": 20, "origin": pose(-2, -2)}
_CELLS = [-1 if x < 5 and y < 5 else (x * 5 + y) % 101 for y in range(20) for x in range(20)]
_MAP = {"header": HEADER, "info": _INFO, "data": _CELLS}
_PATCH = {"header": HEADER, "x": 8, "y": 4, "width": 6, "height": 10, "data": [100] * 60}
_ODD = _MAP | {"data": [(x * 13 + y) % 256 - 128 for y in range(20) for x in range(20)]}
_MAPS = [
    _case("Map", "Map", "/map", ("/map", "nav_msgs/OccupancyGrid", _MAP)),
    _case("Map of costs", "Map", "/map", **{"Color Scheme": "costmap"}),
    _case("Map raw", "Map", "/map", Alpha=1, **{"Color Scheme": "raw"}),
    _case("Map behind", "Map", "/map", Alpha=1, **{"Draw Behind": True}),
    *(
        _case(
            f"Map of odd values as {scheme}",
            "Map",
            "/odd",
            *([("/odd", "nav_msgs/OccupancyGrid", _ODD)] if scheme == "map" else []),
            Alpha=1,
            **{"Color Scheme": scheme},
        )
        for scheme in ("map", "costmap", "raw")
    ),
    _case(
        "Map turned",
        "Map",
        "/turned",
        (
            "/turned",
            "nav_msgs/OccupancyGrid",
            _MAP | {"header": IN_PLATE, "info": _INFO | {"origin": pose(1, -1, 0.3, 0.5)}},
        ),
    ),
    Case(
        name="Map with updates",
        display={"Class": "rviz/Map", "Name": "Map", "Topic": "/local", "Alpha": 1},
        messages=[("/local", "nav_msgs/OccupancyGrid", _MAP)],
        repeated=[("/local_updates", "map_msgs/OccupancyGridUpdate", _PATCH)],
    ),
]

_SONAR = {"header": IN_PLATE, "field_of_view": 0.6, "min_range": 0.1, "max_range": 4.0, "range": 2.5}
_WRENCH = {"force": _TWIST["linear"], "torque": _TWIST["angular"]}
_READINGS = [
    _case("Range", "Range", "/range", ("/range", "sensor_msgs/Range", _SONAR)),
    Case(
        name="Range with the one before",
        display={
            "Class": "rviz/Range",
            "Name": "Range",
            "Topic": "/ranges",
            "Buffer Length": 2,
            "Color": "80; 160; 255",
        },
        repeated=[("/ranges", "sensor_msgs/Range", _SONAR | {"header": frame}) for frame in (HEADER, IN_PLATE)],
    ),
    _case(
        "Range of infrared",
        "Range",
        "/ir",
        ("/ir", "sensor_msgs/Range", _SONAR | {"radiation_type": 1, "field_of_view": 0.1}),
        Color="255; 60; 60",
        Alpha=1,
    ),
    _case(
        "WrenchStamped",
        "WrenchStamped",
        "/wrench",
        ("/wrench", "geometry_msgs/WrenchStamped", {"header": HEADER, "wrench": _WRENCH}),
    ),
    _case(
        "WrenchStamped in other colors",
        "WrenchStamped",
        "/wrench",
        **{
            "Force Color": "40; 200; 90",
            "Torque Color": "40; 90; 255",
            "Force Arrow Scale": 1,
            "Torque Arrow Scale": 3,
            "Arrow Width": 1.5,
        },
    ),
    _case(
        "TwistStamped",
        "TwistStamped",
        "/twist",
        ("/twist", "geometry_msgs/TwistStamped", {"header": HEADER, "twist": _TWIST}),
    ),
    _case(
        "AccelStamped",
        "AccelStamped",
        "/accel",
        ("/accel", "geometry_msgs/AccelStamped", {"header": HEADER, "accel": _TWIST}),
        **{"Arrow Width": 1.0},
    ),
    _case(
        "Temperature",
        "Temperature",
        "/temperature",
        ("/temperature", "sensor_msgs/Temperature", {"temperature": 70.0, **_READING}),
        **{"Size (m)": 0.8},
    ),
    _case(
        "FluidPressure",
        "FluidPressure",
        "/pressure",
        ("/pressure", "sensor_msgs/FluidPressure", {"fluid_pressure": 101000.0, **_READING}),
        Style="Boxes",
        **{"Size (m)": 0.8},
    ),
    _case(
        "Illuminance",
        "Illuminance",
        "/light",
        ("/light", "sensor_msgs/Illuminance", {"illuminance": 300.0, **_READING}),
        Style="Spheres",
        **{"Size (m)": 0.8},
    ),
    _case(
        "RelativeHumidity",
        "RelativeHumidity",
        "/humidity",
        ("/humidity", "sensor_msgs/RelativeHumidity", {"relative_humidity": 0.9, **_READING}),
        Style="Squares",
        **{"Size (m)": 0.8},
    ),
]
POSES = [*_POSES, *_PATHS, *_MAPS, *_READINGS]
