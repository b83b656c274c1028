"""Reader of datasets' plans."""

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Literal, get_args

from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.studies.plan_files.plan_source import description_path, read_source
from trundle.studies.plan_files.yaml_node import YamlNode, read_yaml

from .object_reader import read_distractors, read_objects, read_paint
from .plan import CameraPlan, DatasetPlan, Format, LidarPlan, LightPlan, Numbers, Orbit
from .quantity import constant
from .value_reader import TURN, read_colour, read_numbers, read_pair, read_quantity, read_vector

_KEYS = (
    "world", "count", "seed", "size", "samples", "formats", "camera", "objects", "distractors", "materials", "lights",
    "ambient", "background", "lidar", "apart", "settle",
)  # fmt: skip
_CAMERA = ("orbit", "position", "look_at", "roll", "fov", "near", "far", "noise")
_LIGHT = ("type", "intensity", "colour", "azimuth", "elevation", "position", "shadows")
_LIDAR = ("beams", "columns", "vertical", "horizontal", "range", "pose")
FORMATS: tuple[Format, ...] = get_args(Format)
_MAX_COUNT, _MAX_SIDE_PX, _MAX_SAMPLES, _MAX_PX = 100_000_000, 8192, 4, 1 << 25
_MAX_RAYS = 1 << 20
_MAX_FAR_M = 1e6
_CLOUD_FORMATS: tuple[Format, ...] = ("kitti", "semantic_kitti")


def load_dataset_plan(
    plan: "str | os.PathLike[str] | Mapping[str, object]", *, count: int | None = None
) -> DatasetPlan:
    """Read a plan's file, or a dictionary.

    Args:
        plan: path of YAML, or the dictionary.
        count: number of pictures; None: the plan's.

    Raises:
        UsageError: the file cannot be read.
        DescriptionError: it is not a plan; with its line.
    """
    source = read_source(plan)
    read = read_dataset_plan(source.text, file=source.file, folder=source.folder)
    if count is None:
        return read
    if not 1 <= count <= _MAX_COUNT:
        raise UsageError(f"{count} pictures; give 1 to {_MAX_COUNT}")
    return replace(read, count=count)


def read_dataset_plan(text: str, *, file: str, folder: Path) -> DatasetPlan:
    """Read a plan.

    Args:
        text: YAML.
        file: its name in messages.
        folder: base of relative paths.

    Raises:
        DescriptionError: it is not a plan; with its line.
    """
    root = read_yaml(text, file)
    found = root.check_keys("a plan", *_KEYS)
    for needed in ("world", "count", "camera", "objects"):
        if needed not in found:
            root.fail(f"a plan needs `{needed}: …`")
    width, height = _size(found["size"]) if "size" in found else (640, 480)
    samples = found["samples"].whole("samples", at_least=1) if "samples" in found else 2
    if samples > _MAX_SAMPLES or samples * samples * width * height > _MAX_PX:
        found.get("samples", root).fail(f"samples may be {_MAX_SAMPLES} at most, and all samples {_MAX_PX}")
    count = found["count"].whole("count", at_least=1)
    if count > _MAX_COUNT:
        found["count"].fail(f"a dataset has at most {_MAX_COUNT} pictures")
    if "size" in found and isinstance(found["camera"].value, str):
        found["size"].fail("the size of the pictures is that of the camera's sensor; leave `size` out")
    objects = read_objects(found["objects"], folder)
    formats = _formats(found["formats"]) if "formats" in found else ("coco",)
    lidar = _lidar(found["lidar"]) if "lidar" in found else None
    if "semantic_kitti" in formats and lidar is None:
        found["formats"].fail("semantic_kitti needs a lidar; add `lidar: …`")
    if lidar is not None and not {*formats} & {*_CLOUD_FORMATS}:
        found["lidar"].fail(f"clouds of a lidar are written by {' and '.join(_CLOUD_FORMATS)}; add one to `formats`")
    return DatasetPlan(
        file=file,
        folder=folder,
        text=text,
        world=description_path(found["world"], folder, "a world or model"),
        world_at=found["world"].at,
        count=count,
        seed=found["seed"].whole("seed", at_least=0) if "seed" in found else 0,
        width_px=width,
        height_px=height,
        samples=samples,
        formats=formats,
        camera=_camera(found["camera"], tuple(each.name for each in objects)),
        objects=objects,
        distractors=read_distractors(found["distractors"], folder) if "distractors" in found else None,
        materials={
            name: read_paint(node, folder, f"materials of {name}")
            for name, node in (found["materials"].mapping("materials") if "materials" in found else {}).items()
        },
        lights=_lights(found["lights"]) if "lights" in found else (),
        ambient=read_quantity(found["ambient"], "ambient", at_least=0, at_most=1) if "ambient" in found else None,
        background=read_colour(found["background"], "background") if "background" in found else None,
        lidar=lidar,
        apart="apart" not in found or found["apart"].flag("apart"),
        settle_s=_seconds(found["settle"]) if "settle" in found else 0.0,
    )


def _seconds(node: YamlNode) -> float:
    seconds = node.number("settle", at_least=0)
    return seconds if seconds <= 60 else node.fail("settle may be 60 s at most")


def _size(node: YamlNode) -> tuple[int, int]:
    items = node.items()
    if len(items) != 2:
        node.fail("size must be [width, height] in pixels")
    width, height = (item.whole("size", at_least=16) for item in items)
    if max(width, height) > _MAX_SIDE_PX:
        node.fail(f"size may be {_MAX_SIDE_PX} pixels at most")
    return width, height


def _formats(node: YamlNode) -> tuple[Format, ...]:
    names: list[Format] = []
    for name, at in node.texts("formats"):
        if name not in FORMATS:
            raise DescriptionError(at, f"there is no format {name!r}; formats: {', '.join(FORMATS)}")
        names.append(name)
    return tuple(dict.fromkeys(names)) or node.fail(f"formats must be some of {', '.join(FORMATS)}")


def _camera(node: YamlNode, objects: tuple[str, ...]) -> CameraPlan:
    if isinstance(node.value, str):
        one = constant(1.0)  # its sensor says it
        return CameraPlan(
            at=node.at, place=node.value, look_at=None, roll=one, horizontal_fov=one, near_m=1.0, far_m=1.0, noise=0.0
        )
    found = node.check_keys("camera", *_CAMERA)
    if ("orbit" in found) == ("position" in found):
        node.fail(
            "camera needs orbit: {center, distance, elevation, azimuth}, or position: [x, y, z]; or is MODEL/SENSOR"
        )
    place = _orbit(found["orbit"]) if "orbit" in found else read_numbers(found["position"], "position")
    look_at: Numbers | str | None = None
    if "look_at" in found:
        target = found["look_at"]
        look_at = read_numbers(target, "look_at") if isinstance(target.value, list) else target.text("look_at")
        if isinstance(look_at, str) and look_at not in objects:
            target.fail(f"look_at: there is no object {look_at!r}; objects: {', '.join(objects)}, or a point [x, y, z]")
    near = found["near"].number("near", above=0) if "near" in found else 0.05
    far = found["far"].number("far", above=near) if "far" in found else 100.0
    if far > _MAX_FAR_M:
        found["far"].fail(f"far may be {_MAX_FAR_M:g} m at most")
    return CameraPlan(
        at=node.at,
        place=place,
        look_at=look_at,
        roll=read_quantity(found["roll"], "roll") if "roll" in found else constant(0.0),
        horizontal_fov=read_quantity(found["fov"], "fov", at_least=0.01, at_most=3.0)
        if "fov" in found
        else constant(1.047),
        near_m=near,
        far_m=far,
        noise=found["noise"].number("noise", at_least=0) if "noise" in found else 0.0,
    )


def _orbit(node: YamlNode) -> Orbit:
    found = node.check_keys("orbit", "center", "distance", "azimuth", "elevation")
    if "distance" not in found:
        node.fail("orbit needs `distance: …`")
    return Orbit(
        center=read_vector(found["center"], "center") if "center" in found else (0.0, 0.0, 0.0),
        distance=read_quantity(found["distance"], "distance", at_least=1e-3, at_most=1e6),
        azimuth=read_quantity(found["azimuth"], "azimuth") if "azimuth" in found else TURN,
        elevation=read_quantity(found["elevation"], "elevation", at_least=-1.58, at_most=1.58)
        if "elevation" in found
        else constant(0.5),
    )


def _lights(node: YamlNode) -> tuple[LightPlan, ...]:
    return tuple(_light(name, each) for name, each in node.mapping("lights").items())


def _light(name: str, node: YamlNode) -> LightPlan:
    found = node.check_keys(f"light {name}", *_LIGHT)
    kind: Literal["directional", "point"] | None = None
    if "type" in found:
        text = found["type"].text("type")
        if text not in ("directional", "point"):
            found["type"].fail(f"type must be directional or point, not {text!r}; a light of the world needs none")
        kind = "point" if text == "point" else "directional"
        if kind == "point" and "position" not in found:
            node.fail(f"light {name}: a point light needs `position: [x, y, z]`")
    _check_light(name, found, kind)
    return LightPlan(
        name=name,
        at=node.at,
        kind=kind,
        intensity=read_quantity(found["intensity"], "intensity", at_least=0, at_most=100)
        if "intensity" in found
        else constant(1.0),
        colour=read_colour(found["colour"], "colour") if "colour" in found else None,
        azimuth=read_quantity(found["azimuth"], "azimuth") if "azimuth" in found else TURN,
        elevation=read_quantity(found["elevation"], "elevation", at_least=-1.58, at_most=1.58)
        if "elevation" in found
        else (constant(1.0) if kind == "directional" else None),
        position=read_numbers(found["position"], "position") if "position" in found else None,
        shadows=found["shadows"].flag("shadows") if "shadows" in found else None,
    )


def _check_light(name: str, found: dict[str, YamlNode], kind: Literal["directional", "point"] | None) -> None:
    """Refuse numbers that a light of this kind does not have."""
    for angle in ("azimuth", "elevation"):
        if kind == "point" and angle in found:
            found[angle].fail(f"light {name}: a point light has no `{angle}`; leave it out")
    if kind == "directional" and "position" in found:
        what = "a directional light has no `position`; give `azimuth` and `elevation`"
        found["position"].fail(f"light {name}: {what}")
    if kind is None and "azimuth" in found and "elevation" not in found:
        found["azimuth"].fail(f"light {name}: `azimuth` alone changes nothing; add `elevation: …`")


def _lidar(node: YamlNode) -> LidarPlan:
    found = node.check_keys("lidar", *_LIDAR)
    beams = found["beams"].whole("beams", at_least=1) if "beams" in found else 64
    columns = found["columns"].whole("columns", at_least=1) if "columns" in found else 1024
    if beams * columns > _MAX_RAYS:
        node.fail(f"a lidar has at most {_MAX_RAYS} rays")
    pose = (0.0, 0.0, 0.1, 0.0, 0.0, 0.0)
    if "pose" in found:
        items = found["pose"].items()
        if len(items) != 6:
            found["pose"].fail("pose must be [x, y, z, roll, pitch, yaw] in the camera's frame")
        pose = tuple(item.number("pose") for item in items)
    return LidarPlan(
        at=node.at,
        beams=beams,
        columns=columns,
        vertical=read_pair(found["vertical"], "vertical") if "vertical" in found else (-0.43, 0.035),
        horizontal=read_pair(found["horizontal"], "horizontal") if "horizontal" in found else (-3.14159, 3.14159),
        range_m=found["range"].number("range", above=0) if "range" in found else 100.0,
        camera_from_lidar=pose,
    )
