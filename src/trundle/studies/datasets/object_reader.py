"""Reader of a plan's objects and distractors: what they are, where they stand, how they look."""

import os
from pathlib import Path
from typing import Literal

from trundle.base.diagnostics import DescriptionError
from trundle.robots.meshes import Texture
from trundle.sim.render import NAMED_TEXTURES, named_texture
from trundle.studies.plan_files.yaml_node import YamlNode

from .plan import DistractorPlan, KeyPoint, Numbers, ObjectPlan, Paint, Placement
from .quantity import Quantity, constant
from .value_reader import read_colour, read_count, read_numbers, read_pair, read_quantity, read_vector

_PLACEMENT = ("surface", "within", "position", "rotation")
_PAINT = ("colour", "textures", "repeat")
_OBJECT = ("model", "category", "count", *_PLACEMENT, *_PAINT, "joints", "key_points")
_IMAGES = (".bmp", ".jpeg", ".jpg", ".png", ".webp")
_ANY = "any"
_MAX_TEXTURES, _MAX_INSTANCES = 256, 200


def read_objects(node: YamlNode, folder: Path) -> tuple[ObjectPlan, ...]:
    """Read the objects, which are annotated.

    Raises:
        DescriptionError: with its line.
    """
    objects = tuple(
        _object(name, each, node.keys[name].line or 1, folder) for name, each in node.mapping("objects").items()
    )
    return objects or node.fail("objects: name one model or more")


def _object(name: str, node: YamlNode, line: int, folder: Path) -> ObjectPlan:
    if node.value is None:
        node.value = {}
    found = node.check_keys(f"object {name}", *_OBJECT)
    at = node.at._replace(line=line)
    if not name or any(sign in name for sign in ":/\\ \n"):
        raise DescriptionError(at, f"{name!r} is no name; give letters, digits, _ and -")
    model = None
    if "model" in found:
        text = found["model"].text("model")
        beside = folder / text
        model = str(beside) if "://" not in text and os.path.exists(beside) else text
    elif "count" in found:
        found["count"].fail(f"object {name}: `count` is of what `model: FILE` adds; a model of the world is one")
    category = found["category"].text("category") if "category" in found else name
    if not category or any(sign.isspace() for sign in category):
        found["category"].fail(f"{category!r} is no category: give a word without spaces, as KITTI's labels need it")
    return ObjectPlan(
        name=name,
        at=at,
        model=model,
        category=category,
        count=read_count(found["count"], "count", most=_MAX_INSTANCES) if "count" in found else constant(1.0),
        placement=_placement(node, found),
        paint=_paint(node, found, folder),
        joints=_joints(found["joints"]) if "joints" in found else {},
        key_points=_key_points(found["key_points"]) if "key_points" in found else (),
    )


def read_distractors(node: YamlNode, folder: Path) -> DistractorPlan:
    """Read the distractors.

    Raises:
        DescriptionError: with its line.
    """
    found = node.check_keys("distractors", "count", "size", *_PLACEMENT, *_PAINT)
    for needed in ("count", "size"):
        if needed not in found:
            node.fail(f"distractors need `{needed}: …`")
    if "surface" not in found and "position" not in found:
        node.fail("distractors need `surface: MODEL` or `position: [x, y, z]`")
    return DistractorPlan(
        at=node.at,
        count=read_count(found["count"], "count", most=_MAX_INSTANCES),
        size=read_quantity(found["size"], "size", at_least=1e-3, at_most=1e3),
        placement=_placement(node, found),
        paint=_paint(node, found, folder),
    )


def read_paint(node: YamlNode, folder: Path, what: str) -> Paint:
    """Read colour and textures alone.

    Raises:
        DescriptionError: with its line.
    """
    found = node.check_keys(what, *_PAINT)
    if not {"colour", "textures"} & found.keys():
        node.fail(f"{what} need `colour: …` or `textures: …`")
    return _paint(node, found, folder)


def _placement(node: YamlNode, found: dict[str, YamlNode]) -> Placement:
    rotation: Literal["upright", "any"] | Numbers = "upright"
    if "rotation" in found:
        value = found["rotation"].value
        if value == "any" or value == "upright":
            rotation = value
        elif isinstance(value, list):
            rotation = read_numbers(found["rotation"], "rotation")
        else:
            found["rotation"].fail("rotation must be upright, any, or [roll, pitch, yaw] in radians")
    if "surface" in found and "position" in found:
        found["position"].fail("`surface` draws the position; give one of them")
    if "within" in found and "surface" not in found:
        found["within"].fail("`within` is a part of the surface that `surface: MODEL` names")
    if "rotation" in found and not {"surface", "position"} & found.keys():
        found["rotation"].fail("`rotation` turns what is placed; add `surface: MODEL` or `position: [x, y, z]`")
    return Placement(
        at=node.at,
        surface=found["surface"].text("surface") if "surface" in found else None,
        within=_within(found["within"]) if "within" in found else None,
        position=read_numbers(found["position"], "position") if "position" in found else None,
        rotation=rotation,
    )


def _within(node: YamlNode) -> tuple[tuple[float, float], tuple[float, float]]:
    found = node.check_keys("within", "x", "y")
    if len(found) != 2:
        node.fail("within must be {x: [low, high], y: [low, high]}")
    (x0, x1), (y0, y1) = read_pair(found["x"], "x"), read_pair(found["y"], "y")
    return (x0, y0), (x1, y1)


def _paint(node: YamlNode, found: dict[str, YamlNode], folder: Path) -> Paint:
    if "repeat" in found and "textures" not in found:
        found["repeat"].fail("`repeat` is that of an image; add `textures: …`")
    textures = (
        tuple(file for item in found["textures"].items() for file in _textures(item, folder))
        if "textures" in found
        else ()
    )
    return Paint(
        at=node.at,
        colour=read_colour(found["colour"], "colour") if "colour" in found else None,
        textures=textures,
        repeat=read_quantity(found["repeat"], "repeat", at_least=0.01, at_most=1000)
        if "repeat" in found
        else constant(1.0),
    )


def _textures(node: YamlNode, folder: Path) -> list[Texture]:
    """Return an image, the images of a folder in order of their names, a named texture of Gazebo's, or all of those."""
    name = node.text("textures")
    if name in (_ANY, *NAMED_TEXTURES):
        return [named_texture(each) for each in (NAMED_TEXTURES if name == _ANY else (name,))]
    path = folder / name
    if os.path.isfile(path):
        return [path]
    files = sorted(each for each in path.iterdir() if each.suffix.lower() in _IMAGES) if os.path.isdir(path) else []
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
    return {name: read_quantity(each, f"joint {name}") for name, each in node.mapping("joints").items()}


def _key_points(node: YamlNode) -> tuple[KeyPoint, ...]:
    found = node.mapping("key_points")
    return tuple(_key_point(name, each) for name, each in found.items())


def _key_point(name: str, node: YamlNode) -> KeyPoint:
    if isinstance(node.value, dict):
        parts = node.check_keys(f"key point {name}", "link", "at")
        if "at" not in parts:
            node.fail(f"key point {name} needs `at: [x, y, z]`")
        link = parts["link"].text("link") if "link" in parts else None
        return KeyPoint(name=name, at=node.at, link=link, point=read_vector(parts["at"], "at"))
    return KeyPoint(name=name, at=node.at, link=None, point=read_vector(node, f"key point {name}"))
