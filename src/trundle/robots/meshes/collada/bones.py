"""COLLADA skeletons and animations: nodes with transforms, and channels that animate them."""

import math
from collections.abc import Callable, Iterator
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.xmlnode import XmlNode, parse_numbers
from trundle.spatial import matrix_from_quaternion, normalized, quaternion_from_axis_angle

from ..mesh import MeshError
from ..skeleton import Bone, Motion, Track, track_from_poses

_Array = NDArray[np.float64]
_MAX_BONES, _MAX_KEYS = 1000, 100_000
_COUNTS = {"matrix": 16, "translate": 3, "rotate": 4, "scale": 3}
_COMPONENTS = {"X": 0, "Y": 1, "Z": 2, "ANGLE": 3}
_Change: TypeAlias = tuple[_Array, _Array, int | None]
"""Times (T,), values (T, n), and the index of the component that is animated (None: all)."""


class _Step(Struct, frozen=True, eq=False):
    """Elementary transform of a node: a translation, rotation, scale or matrix."""

    kind: str
    sid: str
    values: _Array


def read_bones(root: XmlNode, metres: float) -> tuple[Bone, ...]:
    """Return every node of the file's first scene, parents first, in metres.

    Raises:
        MeshError: too many nodes.
    """
    return tuple(
        Bone(
            name=node.attribute("sid") or node.attribute("name") or node.attribute("id") or "",
            id=node.attribute("id") or "",
            parent=parent,
            is_joint=node.attribute("type") == "JOINT",
            rest=_metric(_product([(step.kind, step.values) for step in _steps(node)]), metres),
        )
        for node, parent in _nodes(root)
    )


def read_motion(root: XmlNode, metres: float) -> Motion:
    """Return all animation channels of the file, by node.

    Raises:
        MeshError: no channel moves a node of the file.
    """
    changes = _changes(root)
    tracks: dict[int, Track] = {}
    for number, (node, _) in enumerate(_nodes(root)):
        steps = _steps(node)
        node_changes = changes.get(node.attribute("id") or "", {})
        moved = [(step, change) for step in steps for change in node_changes.get(step.sid, [])]
        if not moved:
            continue
        times = np.unique(np.concatenate([change[0] for _, change in moved]))
        poses = np.stack([_metric(_product(_at(steps, node_changes, time)), metres) for time in times.tolist()])
        if np.isfinite(poses).all():
            tracks[number] = track_from_poses(times, poses)
    if not tracks:
        raise MeshError("no animation in it moves a bone")
    return Motion(read_bones(root, metres), tracks)


def metres_of(root: XmlNode) -> float:
    """Return the length of the file's unit [m]."""
    unit = (asset := root.find("asset")) and asset.find("unit")
    numbers = parse_numbers((unit.attribute("meter") if unit else None) or "1") or [1.0]
    return numbers[0] if math.isfinite(numbers[0]) and numbers[0] > 0.0 else 1.0


def _nodes(root: XmlNode) -> Iterator[tuple[XmlNode, int]]:
    library = root.find("library_visual_scenes")
    scene = library.find("visual_scene") if library is not None else None
    pending = [(node, -1) for node in reversed(scene.all("node") if scene is not None else [])]
    number = -1
    while pending:
        node, parent = pending.pop()
        number += 1
        if number >= _MAX_BONES:
            raise MeshError(f"more than {_MAX_BONES} nodes")
        yield node, parent
        pending += [(child, number) for child in reversed(node.all("node"))]


def _steps(node: XmlNode) -> list[_Step]:
    steps: list[_Step] = []
    for child in node.children:
        count = _COUNTS.get(child.tag)
        values = parse_numbers(child.text) if count else None
        if values is not None and len(values) == count:
            steps.append(_Step(child.tag, child.attribute("sid") or "", np.array(values)))
    return steps


def _changes(root: XmlNode) -> dict[str, dict[str, list[_Change]]]:
    """Return the animations: node id → transform sid → changes."""
    library = root.find("library_animations")
    pending = library.all("animation") if library is not None else []
    elements: dict[str, XmlNode] = {}
    channels: list[XmlNode] = []
    while pending:
        animation = pending.pop(0)
        pending += animation.all("animation")
        channels += animation.all("channel")
        elements |= {
            element.attribute("id") or "": element for tag in ("source", "sampler") for element in animation.all(tag)
        }
    changes: dict[str, dict[str, list[_Change]]] = {}
    for channel in channels:
        node, _, path = (channel.attribute("target") or "").partition("/")
        sid, component = _component(path)
        change = _change(channel, lambda name: elements.get((name or "").lstrip("#")), component)
        if change is not None:
            changes.setdefault(node, {}).setdefault(sid, []).append(change)
    return changes


def _component(path: str) -> tuple[str, int | None]:
    """Return sid and component; `rotateX.ANGLE` and `transform(0)(3)` animate one component."""
    if "." in path:
        sid, _, name = path.partition(".")
        return sid, _COMPONENTS.get(name)
    if "(" in path:
        sid, _, rest = path.partition("(")
        numbers = [int(part) for part in rest.rstrip(")").split(")(") if part.isdecimal()]
        return sid, sum(number * 4 ** (len(numbers) - 1 - i) for i, number in enumerate(numbers))
    return path, None


def _change(channel: XmlNode, find: Callable[[str | None], XmlNode | None], component: int | None) -> _Change | None:
    sampler = find(channel.attribute("source"))
    if sampler is None:
        return None
    sources = {input_.attribute("semantic"): find(input_.attribute("source")) for input_ in sampler.all("input")}
    times, values = (_floats(sources.get(semantic)) for semantic in ("INPUT", "OUTPUT"))
    if times is None or values is None or len(times) > _MAX_KEYS or len(values) % len(times):
        return None
    order = np.argsort(times, kind="stable")
    return times[order], values.reshape(len(times), -1)[order], component


def _floats(source: XmlNode | None) -> _Array | None:
    array = source.find("float_array") if source is not None else None
    numbers = parse_numbers(array.text) if array is not None else None
    values = np.array(numbers or [], dtype=np.float64)
    return values if len(values) and np.isfinite(values).all() else None


def _at(steps: list[_Step], changes: dict[str, list[_Change]], time: float) -> list[tuple[str, _Array]]:
    """Return a node's transforms at a time."""
    transforms: list[tuple[str, _Array]] = []
    for step in steps:
        values = step.values.copy()
        for times, keys, component in changes.get(step.sid, []):
            now = np.array([np.interp(time, times, column) for column in keys.T])
            if component is not None and component < len(values):
                values[component] = now[0]
            elif component is None and len(now) == len(values):
                values = now
        transforms.append((step.kind, values))
    return transforms


def _product(steps: list[tuple[str, _Array]]) -> _Array:
    whole = np.eye(4)
    for kind, values in steps:
        one = np.eye(4)
        match kind:
            case "matrix":
                one = values.reshape(4, 4)
            case "translate":
                one[:3, 3] = values
            case "scale":
                one[:3, :3] = np.diag(values)
            case _:
                one[:3, :3] = _rotation(*values.tolist())
        whole = whole @ one
    return whole


def _rotation(x: float, y: float, z: float, degrees: float) -> _Array:
    axis = normalized((x, y, z))
    return (
        np.eye(3) if axis is None else matrix_from_quaternion(quaternion_from_axis_angle(axis, math.radians(degrees)))
    )


def _metric(pose: _Array, metres: float) -> _Array:
    scaled = pose.copy()
    scaled[:3, 3] *= metres
    return scaled
