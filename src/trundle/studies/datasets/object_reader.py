"""Reader of a plan's objects and distractors: models, placements and looks."""

import os
from pathlib import Path
from typing import Literal

from trundle.base.diagnostics import DescriptionError
from trundle.robots.meshes import Texture
from trundle.sim.render import NAMED_TEXTURES, named_texture
from trundle.studies.plan_files.yaml_node import YamlNode

from .plan import DistractorPlan, KeyPoint, Numbers, ObjectPlan, Paint, Placement
from .quantity import Quantity, constant
from .value_reader import read_color, read_count, read_numbers, read_pair, read_quantity, read_vector

_PLACEMENT = ("surface", "within", "position", "rotation")
_PAINT = ("color", "textures", "repeat")
_OBJECT = ("model", "category", "count", *_PLACEMENT, *_PAINT, "joints", "key_points")
_IMAGES = (".bmp", ".jpeg", ".jpg", ".png", ".webp")
_ANY = "any"
_MAX_TEXTURES, _MAX_INSTANCES = 256, 200


def read_objects(node: YamlNode, folder: Path) -> tuple[ObjectPlan, ...]:
    """Read the objects to annotate.

    Raises:
        DescriptionError: an object is invalid.
    """
    objects = tuple(
        _object(name, item, node.keys[name].line or 1, folder) for name, item in node.mapping("objects").items()
    )
    return objects or node.fail("objects: name one model or more")


def _object(name: str, node: YamlNode, line: int, folder: Path) -> ObjectPlan:
    if node.value is None:
        node.value = {}
    fields = node.check_keys(f"object {name}", *_OBJECT)
    at = node.at._replace(line=line)
    if not name or any(sign in name for sign in ":/\\ \n"):
        raise DescriptionError(at, f"{name!r} is no name; give letters, digits, _ and -")
    model = None
    if "model" in fields:
        text = fields["model"].text("model")
        path = folder / text
        model = str(path) if "://" not in text and os.path.exists(path) else text
    elif "count" in fields:
        fields["count"].fail(f"object {name}: `count` is of what `model: FILE` adds; a model of the world is one")
    category = fields["category"].text("category") if "category" in fields else name
    if not category or any(sign.isspace() for sign in category):
        fields["category"].fail(f"{category!r} is no category: give a word without spaces, as KITTI's labels need it")
    return ObjectPlan(
        name=name,
        at=at,
        model=model,
        category=category,
        count=read_count(fields["count"], "count", maximum=_MAX_INSTANCES) if "count" in fields else constant(1.0),
        placement=_placement(node, fields),
        paint=_paint(node, fields, folder),
        joints=_joints(fields["joints"]) if "joints" in fields else {},
        key_points=_key_points(fields["key_points"]) if "key_points" in fields else (),
    )


def read_distractors(node: YamlNode, folder: Path) -> DistractorPlan:
    """Read the distractors.

    Raises:
        DescriptionError: a distractor is invalid.
    """
    fields = node.check_keys("distractors", "count", "size", *_PLACEMENT, *_PAINT)
    for needed in ("count", "size"):
        if needed not in fields:
            node.fail(f"distractors need `{needed}: …`")
    if "surface" not in fields and "position" not in fields:
        node.fail("distractors need `surface: MODEL` or `position: [x, y, z]`")
    return DistractorPlan(
        at=node.at,
        count=read_count(fields["count"], "count", maximum=_MAX_INSTANCES),
        size=read_quantity(fields["size"], "size", minimum=1e-3, maximum=1e3),
        placement=_placement(node, fields),
        paint=_paint(node, fields, folder),
    )


def read_paint(node: YamlNode, folder: Path, label: str) -> Paint:
    """Read a look: color and textures.

    Raises:
        DescriptionError: the look is invalid.
    """
    fields = node.check_keys(label, *_PAINT)
    if not {"color", "textures"} & fields.keys():
        node.fail(f"{label} need `color: …` or `textures: …`")
    return _paint(node, fields, folder)


def _placement(node: YamlNode, fields: dict[str, YamlNode]) -> Placement:
    rotation: Literal["upright", "any"] | Numbers = "upright"
    if "rotation" in fields:
        value = fields["rotation"].value
        if value == "any" or value == "upright":
            rotation = value
        elif isinstance(value, list):
            rotation = read_numbers(fields["rotation"], "rotation")
        else:
            fields["rotation"].fail("rotation must be upright, any, or [roll, pitch, yaw] in radians")
    if "surface" in fields and "position" in fields:
        fields["position"].fail("`surface` draws the position; give one of them")
    if "within" in fields and "surface" not in fields:
        fields["within"].fail("`within` is a part of the surface that `surface: MODEL` names")
    if "rotation" in fields and not {"surface", "position"} & fields.keys():
        fields["rotation"].fail("`rotation` turns what is placed; add `surface: MODEL` or `position: [x, y, z]`")
    return Placement(
        at=node.at,
        surface=fields["surface"].text("surface") if "surface" in fields else None,
        within=_within(fields["within"]) if "within" in fields else None,
        position=read_numbers(fields["position"], "position") if "position" in fields else None,
        rotation=rotation,
    )


def _within(node: YamlNode) -> tuple[tuple[float, float], tuple[float, float]]:
    bounds = node.check_keys("within", "x", "y")
    if len(bounds) != 2:
        node.fail("within must be {x: [low, high], y: [low, high]}")
    (x0, x1), (y0, y1) = read_pair(bounds["x"], "x"), read_pair(bounds["y"], "y")
    return (x0, y0), (x1, y1)


def _paint(node: YamlNode, fields: dict[str, YamlNode], folder: Path) -> Paint:
    if "repeat" in fields and "textures" not in fields:
        fields["repeat"].fail("`repeat` is that of an image; add `textures: …`")
    textures = (
        tuple(file for item in fields["textures"].items() for file in _textures(item, folder))
        if "textures" in fields
        else ()
    )
    return Paint(
        at=node.at,
        color=read_color(fields["color"], "color") if "color" in fields else None,
        textures=textures,
        repeat=read_quantity(fields["repeat"], "repeat", minimum=0.01, maximum=1000)
        if "repeat" in fields
        else constant(1.0),
    )


def _textures(node: YamlNode, folder: Path) -> list[Texture]:
    """Return an image, the images of a folder sorted by name, a named texture of Gazebo, or all named textures."""
    name = node.text("textures")
    if name in (_ANY, *NAMED_TEXTURES):
        return [named_texture(entry) for entry in (NAMED_TEXTURES if name == _ANY else (name,))]
    path = folder / name
    if os.path.isfile(path):
        return [path]
    files = sorted(entry for entry in path.iterdir() if entry.suffix.lower() in _IMAGES) if os.path.isdir(path) else []
    if not files:
        node.fail(
            f"textures: {path} is no image and no folder with images; there are also: any, {', '.join(NAMED_TEXTURES)}"
        )
    if len(files) > _MAX_TEXTURES:
        node.fail(f"textures: {path} has {len(files)} images; give at most {_MAX_TEXTURES}")
    return list(files)


def _joints(node: YamlNode) -> dict[str, Quantity] | Literal["any"]:
    if node.value == "any":
        return "any"
    return {name: read_quantity(item, f"joint {name}") for name, item in node.mapping("joints").items()}


def _key_points(node: YamlNode) -> tuple[KeyPoint, ...]:
    points = node.mapping("key_points")
    return tuple(_key_point(name, item) for name, item in points.items())


def _key_point(name: str, node: YamlNode) -> KeyPoint:
    if isinstance(node.value, dict):
        parts = node.check_keys(f"key point {name}", "link", "at")
        if "at" not in parts:
            node.fail(f"key point {name} needs `at: [x, y, z]`")
        link = parts["link"].text("link") if "link" in parts else None
        return KeyPoint(name=name, at=node.at, link=link, point=read_vector(parts["at"], "at"))
    return KeyPoint(name=name, at=node.at, link=None, point=read_vector(node, f"key point {name}"))
