"""A generated skinned COLLADA file: a moving column of two bones that bends."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

_HEIGHTS = (0.0, 0.5, 1.0, 1.5, 2.0)
_CORNERS = ((-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2))


def bending_column(*, times: Sequence[float] = (0.0, 1.0, 2.0), weights: Sequence[float] = (1.0, 0.5)) -> str:
    """Return a column, 2 m high and 0.4 m wide; its upper half belongs to the bone `tip`, 1 m above the ground.

    From the first to the second time the tip rotates by 90° about x, and until the third back;
    in both intervals the bone `root` moves along x by 1 m.
    """
    points = [(x, y, z) for z in _HEIGHTS for x, y in _CORNERS]
    faces = [(0, 2, 1), (0, 3, 2), (16, 17, 18), (16, 18, 19)]
    for level in range(4):
        for k in range(4):
            a, b = 4 * level + k, 4 * level + (k + 1) % 4
            faces += [(a, b, b + 4), (a, b + 4, a + 4)]
    influences = {0.0: (0, 0), 0.5: (0, 0), 1.0: (0, 1, 1, 1), 1.5: (1, 0), 2.0: (1, 0)}
    counts = [len(influences[z]) // 2 for _, _, z in points]
    pairs = [number for _, _, z in points for number in influences[z]]
    up = _translation(0, 0, 1)
    root = [_translation(0, 0, 0), _translation(1, 0, 0), _translation(2, 0, 0)]
    tip = [up, up @ _rotation_about_x(math.pi / 2), up]
    names = '<Name_array id="jn-a" count="2">root tip</Name_array>'
    return f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/></asset>
<library_geometries><geometry id="column"><mesh>{_source("at", points, 3, "XYZ")}
<vertices id="v"><input semantic="POSITION" source="#at"/></vertices>
<triangles count="{len(faces)}"><input semantic="VERTEX" source="#v" offset="0"/><p>{_text(faces)}</p></triangles>
</mesh></geometry></library_geometries>
<library_animations>{_animation("root", times, root)}{_animation("tip", times, tip)}</library_animations>
<library_controllers><controller id="c"><skin source="#column">
<bind_shape_matrix>{_text(np.eye(4))}</bind_shape_matrix>
<source id="jn">{names}<technique_common><accessor source="#jn-a" count="2" stride="1">
<param name="JOINT" type="name"/></accessor></technique_common></source>
{_source("jm", [np.eye(4), _translation(0, 0, -1)], 16, "M")}{_source("w", weights, 1, "W")}
<joints><input semantic="JOINT" source="#jn"/><input semantic="INV_BIND_MATRIX" source="#jm"/></joints>
<vertex_weights count="20"><input semantic="JOINT" source="#jn" offset="0"/>
<input semantic="WEIGHT" source="#w" offset="1"/><vcount>{_text(counts)}</vcount><v>{_text(pairs)}</v></vertex_weights>
</skin></controller></library_controllers>
<library_visual_scenes><visual_scene id="s"><node id="rig"><node id="root" sid="root" type="JOINT">
<matrix sid="transform">{_text(np.eye(4))}</matrix><node id="tip" sid="tip" type="JOINT">
<matrix sid="transform">{_text(up)}</matrix></node></node></node>
<node id="body"><instance_controller url="#c"><skeleton>#root</skeleton></instance_controller></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def _animation(bone: str, times: Sequence[float], poses: Sequence[Any]) -> str:
    return f"""<animation>{_source(f"{bone}-t", times, 1, "T")}{_source(f"{bone}-p", poses, 16, "M")}
<sampler id="{bone}-s"><input semantic="INPUT" source="#{bone}-t"/><input semantic="OUTPUT" source="#{bone}-p"/>
</sampler><channel source="#{bone}-s" target="{bone}/transform"/></animation>"""


def _source(name: str, values: Any, stride: int, params: str) -> str:
    count = np.size(values)
    types = "".join(f'<param name="{param}" type="{"float4x4" if stride == 16 else "float"}"/>' for param in params)
    return f"""<source id="{name}"><float_array id="{name}-a" count="{count}">{_text(values)}</float_array>
<technique_common><accessor source="#{name}-a" count="{count // stride}" stride="{stride}">{types}</accessor>
</technique_common></source>"""


def _text(values: Any) -> str:
    return " ".join(f"{value:g}" for value in np.ravel(values))


def _translation(x: float, y: float, z: float) -> Any:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def _rotation_about_x(angle: float) -> Any:
    pose = np.eye(4)
    pose[1, 1] = pose[2, 2] = math.cos(angle)
    pose[2, 1] = math.sin(angle)
    pose[1, 2] = -pose[2, 1]
    return pose
