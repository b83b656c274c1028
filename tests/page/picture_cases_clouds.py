"""Scans and clouds in rviz's styles and colors, for rviz and the page to draw."""

import math
import struct
from collections.abc import Mapping, Sequence
from typing import Any

from tests.page.picture_case import HEADER, IN_PLATE, Case, Message, point

_FORMATS = {2: "B", 4: "H", 6: "I", 7: "f", 8: "d"}
"""Datatypes of sensor_msgs/PointField as formats of `struct`."""
_CLOUD, _SCAN = "sensor_msgs/PointCloud2", "sensor_msgs/LaserScan"
_STYLES = ("Points", "Squares", "Flat Squares", "Spheres", "Boxes")


def _cloud(points: Sequence[Sequence[float]], **further: int) -> dict[str, Any]:
    """Return a cloud of x, y, z and further channels, given by name and datatype."""
    types = {"x": 7, "y": 7, "z": 7} | further
    form = "<" + "".join(_FORMATS[datatype] for datatype in types.values())
    offsets = [struct.calcsize("<" + form[1 : 1 + index]) for index in range(len(types))]
    fields = [
        {"name": name, "offset": offset, "datatype": datatype, "count": 1}
        for (name, datatype), offset in zip(types.items(), offsets, strict=True)
    ]
    step = struct.calcsize(form)
    return {
        "header": HEADER,
        "height": 1,
        "width": len(points),
        "fields": fields,
        "point_step": step,
        "row_step": step * len(points),
        "data": b"".join(struct.pack(form, *point) for point in points),
        "is_dense": True,
    }


def _packed(data: dict[str, Any]) -> dict[str, Any]:
    """Declare a channel of packed colors as float32, as PCL does."""
    fields = [field | {"datatype": 7} if field["name"] in ("rgb", "rgba") else field for field in data["fields"]]
    return data | {"fields": fields}


_SPIRAL = [(0.3 * a * math.cos(a), 0.3 * a * math.sin(a), 0.25 * a, a) for a in (i / 6 for i in range(6, 48))]
_POSITIONS = [row[:3] for row in _SPIRAL]
_COLORS = [(*position, (0xFF0000, 0x00FF00, 0x2040FF, 0xFFFF00)[i % 4]) for i, position in enumerate(_POSITIONS)]
_CLEAR = [(*position, 0x60FF8020 if i % 2 else 0xFF20A0FF) for i, position in enumerate(_POSITIONS)]
_FLOATS = [(*position, i / 42, 1 - i / 42, 0.5) for i, position in enumerate(_POSITIONS)]
_MANY = [(2 * math.cos(i / 40), 2 * math.sin(i / 40), i / 1500, float(i)) for i in range(2000)]
_RINGS = [(*position, i % 16, i / 4) for i, position in enumerate(_POSITIONS)]
_RAYS = {
    "header": IN_PLATE,
    "angle_min": -1.5,
    "angle_max": 1.5,
    "angle_increment": 0.05,
    "range_min": 0.1,
    "range_max": 8.0,
    "ranges": [3.0 + 0.5 * math.sin(i / 5) for i in range(61)],
}
_INTENSE = _RAYS | {"intensities": [float(i) for i in range(61)]}
_HOLED = _RAYS | {"ranges": [math.inf if i % 5 == 0 else 9.0 if i % 7 == 0 else 3.0 for i in range(61)]}


def _shown(kind: str, topic: str, **properties: Any) -> dict[str, Any]:
    return {"Class": f"rviz/{kind}", "Name": kind, "Topic": topic, **properties}


def _scan(name: str, topic: str, message: Mapping[str, Any] | None = None, /, **properties: Any) -> Case:
    size = {"Size (m)": 0.15, "Size (Pixels)": 9}
    sent = [] if message is None else [(topic, _SCAN, message)]
    return Case(name=f"LaserScan {name}", display=_shown("LaserScan", topic, **size | properties), messages=sent)


def _points(name: str, topic: str, message: Mapping[str, Any] | None = None, /, **properties: Any) -> Case:
    sent = [] if message is None else [(topic, _CLOUD, message)]
    shown = _shown("PointCloud2", topic, **{"Size (m)": 0.2, "Size (Pixels)": 12} | properties)
    return Case(name=f"PointCloud2 {name}", display=shown, messages=sent)


_FIXED_BOUNDS = {"Autocompute Intensity Bounds": False, "Min Intensity": 2, "Max Intensity": 5}
_FIXED_VALUES = {"Autocompute Value Bounds": {"Value": False, "Min Value": 0, "Max Value": 1}}
_SCANS = [
    _scan("as Points", "/scan", _INTENSE, Style="Points"),
    *(_scan(f"as {style}", "/scan", Style=style) for style in _STYLES[1:]),
    _scan("by another name", "/renamed", Style="Spheres"),
    _scan("in one color", "/scan", Style="Boxes", **{"Color Transformer": "FlatColor", "Color": "80; 200; 40"}),
    _scan("by x", "/scan", **{"Color Transformer": "AxisColor", "Axis": "X"}),
    _scan("without intensities", "/rays", _RAYS, Style="Spheres"),
    _scan("with holes", "/holed", _HOLED, Style="Boxes", **{"Color Transformer": "FlatColor"}),
    _scan("inverted", "/scan", Style="Boxes", **{"Invert Rainbow": True}),
    _scan("half seen through", "/scan", Style="Flat Squares", Alpha=0.5),
    Case(
        name="LaserScan that stays",
        display=_shown("LaserScan", "/sweep", Style="Boxes", **{"Size (m)": 0.15, "Decay Time": 1000}),
        repeated=[("/sweep", _SCAN, _INTENSE), ("/sweep", _SCAN, _INTENSE | {"ranges": [1.5] * 61})],
    ),
]
_CLOUDS = [
    _points("by colors", "/points", _packed(_cloud(_COLORS, rgb=6)), **{"Color Transformer": "RGB8"}),
    *(_points(f"as {style}", "/points", Style=style, **{"Color Transformer": "RGB8"}) for style in _STYLES),
    _points("in grey", "/points", **{"Color Transformer": "MONO8"}),
    _points("in one color", "/points", **{"Color Transformer": "FlatColor", "Color": "255; 120; 0"}),
    _points("by height", "/points", Style="Spheres", **{"Color Transformer": "AxisColor"}),
    _points("by y", "/points", **{"Color Transformer": "AxisColor", "Axis": "Y"}),
    _points("by height between bounds", "/points", **{"Color Transformer": "AxisColor"} | _FIXED_VALUES),
    _points("with alphas", "/clear", _packed(_cloud(_CLEAR, rgba=6)), **{"Color Transformer": "RGB8"}),
    _points("by floats", "/floats", _cloud(_FLOATS, r=7, g=7, b=7), **{"Color Transformer": "RGBF32"}),
    _points("by intensity", "/values", _cloud(_SPIRAL, intensity=7)),
    _points("by intensity between bounds", "/values", **_FIXED_BOUNDS),
    _points("between two colors", "/values", **{"Use rainbow": False, "Min Color": "255; 200; 0"}),
    _points("by ring", "/rings", _cloud(_RINGS, ring=4, time=8), **{"Channel Name": "ring"}),
    _points("by time", "/rings", Style="Boxes", **{"Channel Name": "time", "Invert Rainbow": True}),
    _points("half seen through", "/values", Style="Spheres", Alpha=0.4),
    _points("of many points", "/many", _cloud(_MANY, intensity=7), **{"Size (m)": 0.08}),
    *(_points(f"of many as {style}", "/many", Style=style, **{"Size (m)": 0.15}) for style in ("Points", "Spheres")),
    Case(
        name="PointCloud",
        display=_shown("PointCloud", "/cloud1", Style="Boxes", **{"Size (m)": 0.2}),
        messages=[
            (
                "/cloud1",
                "sensor_msgs/PointCloud",
                {
                    "header": HEADER,
                    "points": [point(*xyz) for xyz in _POSITIONS],
                    "channels": [{"name": "intensity", "values": [value for *_, value in _SPIRAL]}],
                },
            )
        ],
    ),
]


def _camera(topic: str, encoding: str, depth: bytes, step: int, color: bytes | None) -> list[Message]:
    size = {"width": 64, "height": 48}
    header = {"frame_id": "map", "stamp": {"secs": 1, "nsecs": 0}}
    k = [60.0, 0.0, 32.0, 0.0, 60.0, 24.0, 0.0, 0.0, 1.0]
    p = [60.0, 0.0, 32.0, 0.0, 0.0, 60.0, 24.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    image = "sensor_msgs/Image"
    sent: list[Message] = [
        (f"{topic}/camera_info", "sensor_msgs/CameraInfo", {"header": header, "K": k, "P": p, **size}),
        (f"{topic}/image", image, {"header": header, "encoding": encoding, "step": step, "data": depth, **size}),
    ]
    colored = {"header": header, "encoding": "rgb8", "step": 192, "data": color, **size}
    return sent if color is None else [*sent, (f"{topic}/color", image, colored)]


def _depth_cloud(name: str, topic: str, sent: list[Message], color: str = "", **properties: Any) -> Case:
    shown = {"Class": "rviz/DepthCloud", "Name": "DepthCloud", "Depth Map Topic": f"{topic}/image"}
    display = shown | {"Color Image Topic": color} | properties
    return Case(
        name=f"DepthCloud {name}", display=display, repeated=sent
    )  # rviz skips an image before its camera's info


_SLOPE = [1.5 + u / 40 for _ in range(48) for u in range(64)]
_METRES = b"".join(struct.pack("<f", value) for value in _SLOPE)
_MILLIMETRES = b"".join(struct.pack("<H", round(1000 * value)) for value in _SLOPE)
_GRADIENT = bytes(part for v in range(48) for u in range(64) for part in (4 * u, 5 * v, 90))
_COLORED = _camera("/depth", "32FC1", _METRES, 256, _GRADIENT)
_DEPTHS = [
    _depth_cloud("in colors", "/depth", _COLORED, "/depth/color"),
    _depth_cloud(
        "by depth",
        "/depth16",
        _camera("/depth16", "16UC1", _MILLIMETRES, 128, None),
        **{"Color Transformer": "AxisColor", "Axis": "Z"},
    ),
    _depth_cloud(
        "in points of one size",
        "/depth",
        _COLORED,
        "/depth/color",
        **{"Auto Size": {"Value": False}, "Size (m)": 0.06},
    ),
]
CLOUDS = [*_SCANS, *_CLOUDS, *_DEPTHS]
