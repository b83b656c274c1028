"""Markers, arrays of them and interactive ones, for rviz and the page to draw."""

from typing import Any

from tests.page.picture_case import HEADER, IN_PLATE, Case, color, point, pose

_LETTERS = 6
"""rviz draws letters with a resolution of about 4 px here, blurred by as much."""
_MARKER = "visualization_msgs/Marker"
_CORNERS = [point(-1, -1), point(1, -1), point(1, 1), point(-1, 1, 1)]
_RAINBOW = [color(1, 0, 0), color(0, 1, 0), color(0, 0, 1), color(1, 1, 0)]
_GLASS = [color(1, 0, 0, 0.5), color(0, 1, 0, 0.5), color(0, 0, 1, 0.5), color(1, 1, 0, 0.5)]
_TRIANGLES = [*_CORNERS[:3], *_CORNERS[1:]]
_PLATE: dict[str, Any] = {"mesh_resource": "package://pictures/plate.dae", "mesh_use_embedded_materials": True}
_SIGN: dict[str, Any] = {"mesh_resource": "package://pictures/sign.dae", "mesh_use_embedded_materials": True}


def _fields(kind: int, **fields: Any) -> dict[str, Any]:
    placed = {"header": HEADER, "ns": "n", "type": kind, "pose": pose(0.5, 0.3, 0.5), "color": color(0.9, 0.6, 0.1)}
    return placed | fields


def _marker(name: str, kind: int, *, grain: int = 1, **fields: Any) -> Case:
    topic = "/marker/" + name.replace(" ", "_")
    return Case(
        name=f"Marker {name}",
        grain=grain,
        display={"Class": "rviz/Marker", "Name": name, "Marker Topic": topic, "Queue Size": 10},
        messages=[(topic, _MARKER, _fields(kind, **fields))],
    )


def _array(name: str, *markers: dict[str, Any], **properties: Any) -> Case:
    topic = "/array/" + name.replace(" ", "_")
    return Case(
        name=f"MarkerArray {name}",
        display={"Class": "rviz/MarkerArray", "Name": name, "Marker Topic": topic, **properties},
        messages=[(topic, "visualization_msgs/MarkerArray", {"markers": list(markers)})],
    )


_SINGLE = [
    _marker("arrow", 0, scale=point(2, 0.3, 0.3)),
    _marker("arrow of points", 0, scale=point(0.2, 0.5, 0.6), points=[point(-1, 0), point(1, 1, 1)]),
    _marker("arrow of points without a head", 0, scale=point(0.3, 0.5, 0), points=[point(-1, 0), point(1, 1, 1)]),
    _marker("cube", 1, scale=point(1, 2, 0.5)),
    _marker("sphere", 2, scale=point(2, 2, 2)),
    _marker("ellipsoid", 2, scale=point(3, 1, 0.5), pose=pose(0, 0, 1, 0.6)),
    _marker("cylinder", 3, scale=point(1, 1, 2)),
    _marker("flat cylinder", 3, scale=point(3, 1.5, 0.1), color=color(0.2, 0.4, 0.9)),
    _marker("strip", 4, scale=point(0.15, 0, 0), points=_CORNERS, colors=_RAINBOW),
    _marker("lines", 5, scale=point(0.15, 0, 0), points=_CORNERS),
    _marker("colored lines", 5, scale=point(0.2, 0, 0), points=_CORNERS, colors=_RAINBOW),
    _marker("cubes", 6, scale=point(0.4, 0.4, 0.4), points=_CORNERS, colors=_RAINBOW),
    _marker("cubes of glass", 6, scale=point(0.8, 0.8, 0.8), points=_CORNERS, colors=_GLASS),
    _marker("spheres", 7, scale=point(0.6, 0.6, 0.6), points=_CORNERS, colors=_RAINBOW),
    _marker("spheres in one color", 7, scale=point(0.6, 0.6, 0.6), points=_CORNERS),
    _marker("points", 8, scale=point(0.3, 0.3, 0), points=_CORNERS, colors=_RAINBOW),
    _marker("wide points", 8, scale=point(0.8, 0.2, 0), points=_CORNERS),
    _marker("text", 9, grain=_LETTERS, scale=point(0, 0, 1.2), text="Trundle"),
    _marker(
        "text of two lines",
        9,
        grain=_LETTERS,
        scale=point(0, 0, 0.9),
        text="Stop here\n42 %",
        color=color(0.2, 0.9, 0.9),
    ),
    _marker("mesh", 10, scale=point(2, 2, 2), mesh_resource="package://pictures/pyramid.stl"),
    _marker(
        "mesh in its frame", 10, header=IN_PLATE, scale=point(1, 2, 3), mesh_resource="package://pictures/pyramid.stl"
    ),
    _marker("painted mesh", 10, scale=point(1, 1, 1), color=color(0, 0, 0, 0), **_PLATE),
    _marker("tinted mesh", 10, scale=point(1, 1, 1), color=color(1, 0.4, 0.4), **_PLATE),
    _marker("half tinted mesh", 10, scale=point(1, 1, 1), color=color(1, 0.4, 0.4, 0.3), **_SIGN),
    _marker("mesh without its paint", 10, scale=point(1, 1, 1), mesh_resource="package://pictures/plate.dae"),
    _marker("textured mesh", 10, scale=point(2, 2, 2), color=color(0, 0, 0, 0), **_SIGN),
    _marker("triangles", 11, scale=point(1, 1, 1), points=_TRIANGLES),
    _marker("colored triangles", 11, scale=point(1, 1, 1), points=_CORNERS[:3], colors=_RAINBOW[:3]),
    _marker("a color per triangle", 11, scale=point(1.5, 1.5, 1), points=_TRIANGLES, colors=_RAINBOW[:2]),
    _marker("glass", 2, scale=point(2, 2, 2), color=color(0.1, 0.9, 0.3, 0.4)),
    _marker("that follows its frame", 1, header=IN_PLATE, scale=point(1, 1, 1), frame_locked=True),
]
_ARRAYS = [
    _array(
        "of many",
        *(_fields(1 + i % 3, id=i, pose=pose(i - 2, 0, 0.3 * i), scale=point(0.8, 0.8, 0.8)) for i in range(5)),
    ),
    _array(
        "of two namespaces with one off",
        _fields(1, ns="shown", scale=point(1, 1, 1)),
        _fields(2, ns="hidden", pose=pose(-1, -1), scale=point(1, 1, 1)),
        Namespaces={"shown": True, "hidden": False},
    ),
    _array(
        "that deletes and changes",
        _fields(1, id=1, scale=point(1, 1, 1)),
        _fields(2, id=2, pose=pose(-1, -1), scale=point(1, 1, 1)),
        _fields(1, id=1, action=2),
        _fields(3, id=2, pose=pose(-1, -1), scale=point(0.5, 0.5, 3), color=color(0.3, 0.3, 1)),
    ),
    _array(
        "that begins anew",
        _fields(1, id=1, scale=point(2, 2, 2)),
        _fields(0, action=3),
        _fields(2, id=2, scale=point(1, 1, 1)),
    ),
]

_TURNED = [(1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1)]


def _control(name: str, mode: int, axis: int, **fields: Any) -> dict[str, Any]:
    x, y, z, w = _TURNED[axis]
    turned = {"x": x, "y": y, "z": z, "w": w}
    return {"name": name, "orientation": turned, "interaction_mode": mode, "always_visible": True} | fields


def _interactive(name: str, *controls: dict[str, Any], **properties: Any) -> Case:
    topic = "/handles/" + name.replace(" ", "_")
    marker = {"header": {"frame_id": "map", "stamp": 0}, "name": "handles", "pose": pose(0.0, 0.0, 0.5), "scale": 2.0}
    server = {"server_id": "/pictures", "seq_num": 1}
    markers = [marker | {"description": "Handles", "controls": list(controls)}]
    shown = {"Class": "rviz/InteractiveMarkers", "Name": "Handles", "Update Topic": f"{topic}/update"}
    return Case(
        name=f"InteractiveMarkers {name}",
        display=shown | {"Show Descriptions": False} | properties,
        messages=[
            (f"{topic}/update_full", "visualization_msgs/InteractiveMarkerInit", server | {"markers": markers}),
            (f"{topic}/update", "visualization_msgs/InteractiveMarkerUpdate", server | {"type": 0}),
        ],
    )


_BUTTON = _fields(1, pose=pose(), scale=point(1, 1, 1), color=color(0.5, 0.5, 0.5))
_FLAT = _fields(1, pose=pose(), scale=point(0.1, 2, 2), color=color(0.2, 0.6, 0.9))
_INTERACTIVE = [
    _interactive("of axes and a turn", _control("x", 3, 0), _control("z", 3, 2), _control("turn", 5, 1)),
    _interactive("of planes", _control("plane", 4, 1), _control("both", 6, 0)),
    _interactive("with a button and a menu", _control("button", 2, 0, markers=[_BUTTON])),
    _interactive("with axes", _control("button", 2, 0, markers=[_BUTTON]), **{"Show Axes": True}),
    _interactive("opaque", _control("x", 3, 0), _control("turn", 5, 1), **{"Enable Transparency": False}),
    _interactive("that faces the viewer", _control("face", 2, 0, orientation_mode=2, markers=[_FLAT | {"header": {}}])),
    _interactive("that keeps its directions", _control("face", 2, 2, orientation_mode=1, markers=[_FLAT])),
]
MARKERS = [*_SINGLE, *_ARRAYS, *_INTERACTIVE]
