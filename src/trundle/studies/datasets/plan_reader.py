"""Reader of dataset plans."""

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
from .value_reader import TURN, read_color, read_numbers, read_pair, read_quantity, read_vector

_KEYS = (
    "world", "count", "seed", "size", "samples", "formats", "camera", "objects", "distractors", "materials", "lights",
    "ambient", "background", "lidar", "apart", "settle",
)  # fmt: skip
_CAMERA = ("orbit", "position", "look_at", "roll", "fov", "near", "far", "noise")
_LIGHT = ("type", "intensity", "color", "azimuth", "elevation", "position", "shadows")
_LIDAR = ("beams", "columns", "vertical", "horizontal", "range", "pose")
FORMATS: tuple[Format, ...] = get_args(Format)
_MAX_COUNT, _MAX_SIDE_PX, _MAX_SAMPLES, _MAX_PX = 100_000_000, 8192, 4, 1 << 25
_MAX_RAYS = 1 << 20
_MAX_FAR_M = 1e6
_CLOUD_FORMATS: tuple[Format, ...] = ("kitti", "semantic_kitti")


def load_dataset_plan(
    plan: "str | os.PathLike[str] | Mapping[str, object]", *, count: int | None = None
) -> DatasetPlan:
    """Read a plan from a file or a dictionary.

    Args:
        plan: path of a YAML file, or its content as a dictionary.
        count: number of pictures; None: the plan's.

    Raises:
        UsageError: the file cannot be read.
        DescriptionError: the plan is invalid.
    """
    source = read_source(plan)
    dataset_plan = read_dataset_plan(source.text, file=source.file, folder=source.folder)
    if count is None:
        return dataset_plan
    if not 1 <= count <= _MAX_COUNT:
        raise UsageError(f"{count} pictures; give 1 to {_MAX_COUNT}")
    return replace(dataset_plan, count=count)


def read_dataset_plan(text: str, *, file: str, folder: Path) -> DatasetPlan:
    """Read a plan.

    Args:
        text: YAML text.
        file: file name in messages.
        folder: base of relative paths.

    Raises:
        DescriptionError: the plan is invalid.
    """
    root = read_yaml(text, file)
    fields = root.check_keys("a plan", *_KEYS)
    for needed in ("world", "count", "camera", "objects"):
        if needed not in fields:
            root.fail(f"a plan needs `{needed}: …`")
    width, height = _size(fields["size"]) if "size" in fields else (640, 480)
    samples = fields["samples"].whole("samples", minimum=1) if "samples" in fields else 2
    if samples > _MAX_SAMPLES or samples * samples * width * height > _MAX_PX:
        fields.get("samples", root).fail(f"samples may be {_MAX_SAMPLES} at most, and all samples {_MAX_PX}")
    count = fields["count"].whole("count", minimum=1)
    if count > _MAX_COUNT:
        fields["count"].fail(f"a dataset has at most {_MAX_COUNT} pictures")
    if "size" in fields and isinstance(fields["camera"].value, str):
        fields["size"].fail("the size of the pictures is that of the camera's sensor; leave `size` out")
    objects = read_objects(fields["objects"], folder)
    formats = _formats(fields["formats"]) if "formats" in fields else ("coco",)
    lidar = _lidar(fields["lidar"]) if "lidar" in fields else None
    if "semantic_kitti" in formats and lidar is None:
        fields["formats"].fail("semantic_kitti needs a lidar; add `lidar: …`")
    if lidar is not None and not {*formats} & {*_CLOUD_FORMATS}:
        fields["lidar"].fail(f"clouds of a lidar are written by {' and '.join(_CLOUD_FORMATS)}; add one to `formats`")
    return DatasetPlan(
        file=file,
        folder=folder,
        text=text,
        world=description_path(fields["world"], folder, "a world or model"),
        world_at=fields["world"].at,
        count=count,
        seed=fields["seed"].whole("seed", minimum=0) if "seed" in fields else 0,
        width_px=width,
        height_px=height,
        samples=samples,
        formats=formats,
        camera=_camera(fields["camera"], tuple(object_plan.name for object_plan in objects)),
        objects=objects,
        distractors=read_distractors(fields["distractors"], folder) if "distractors" in fields else None,
        materials={
            name: read_paint(node, folder, f"materials of {name}")
            for name, node in (fields["materials"].mapping("materials") if "materials" in fields else {}).items()
        },
        lights=_lights(fields["lights"]) if "lights" in fields else (),
        ambient=read_quantity(fields["ambient"], "ambient", minimum=0, maximum=1) if "ambient" in fields else None,
        background=read_color(fields["background"], "background") if "background" in fields else None,
        lidar=lidar,
        apart="apart" not in fields or fields["apart"].flag("apart"),
        settle_s=_seconds(fields["settle"]) if "settle" in fields else 0.0,
    )


def _seconds(node: YamlNode) -> float:
    seconds = node.number("settle", minimum=0)
    return seconds if seconds <= 60 else node.fail("settle may be 60 s at most")


def _size(node: YamlNode) -> tuple[int, int]:
    items = node.items()
    if len(items) != 2:
        node.fail("size must be [width, height] in pixels")
    width, height = (item.whole("size", minimum=16) for item in items)
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
        unused = constant(1.0)  # the camera's sensor has these values
        return CameraPlan(
            at=node.at,
            viewpoint=node.value,
            look_at=None,
            roll=unused,
            horizontal_fov=unused,
            near_m=1.0,
            far_m=1.0,
            noise=0.0,
        )
    fields = node.check_keys("camera", *_CAMERA)
    if ("orbit" in fields) == ("position" in fields):
        node.fail(
            "camera needs orbit: {center, distance, elevation, azimuth}, or position: [x, y, z]; or is MODEL/SENSOR"
        )
    viewpoint = _orbit(fields["orbit"]) if "orbit" in fields else read_numbers(fields["position"], "position")
    look_at: Numbers | str | None = None
    if "look_at" in fields:
        target = fields["look_at"]
        look_at = read_numbers(target, "look_at") if isinstance(target.value, list) else target.text("look_at")
        if isinstance(look_at, str) and look_at not in objects:
            target.fail(f"look_at: there is no object {look_at!r}; objects: {', '.join(objects)}, or a point [x, y, z]")
    near = fields["near"].number("near", above=0) if "near" in fields else 0.05
    far = fields["far"].number("far", above=near) if "far" in fields else 100.0
    if far > _MAX_FAR_M:
        fields["far"].fail(f"far may be {_MAX_FAR_M:g} m at most")
    return CameraPlan(
        at=node.at,
        viewpoint=viewpoint,
        look_at=look_at,
        roll=read_quantity(fields["roll"], "roll") if "roll" in fields else constant(0.0),
        horizontal_fov=read_quantity(fields["fov"], "fov", minimum=0.01, maximum=3.0)
        if "fov" in fields
        else constant(1.047),
        near_m=near,
        far_m=far,
        noise=fields["noise"].number("noise", minimum=0) if "noise" in fields else 0.0,
    )


def _orbit(node: YamlNode) -> Orbit:
    fields = node.check_keys("orbit", "center", "distance", "azimuth", "elevation")
    if "distance" not in fields:
        node.fail("orbit needs `distance: …`")
    return Orbit(
        center=read_vector(fields["center"], "center") if "center" in fields else (0.0, 0.0, 0.0),
        distance=read_quantity(fields["distance"], "distance", minimum=1e-3, maximum=1e6),
        azimuth=read_quantity(fields["azimuth"], "azimuth") if "azimuth" in fields else TURN,
        elevation=read_quantity(fields["elevation"], "elevation", minimum=-1.58, maximum=1.58)
        if "elevation" in fields
        else constant(0.5),
    )


def _lights(node: YamlNode) -> tuple[LightPlan, ...]:
    return tuple(_light(name, item) for name, item in node.mapping("lights").items())


def _light(name: str, node: YamlNode) -> LightPlan:
    fields = node.check_keys(f"light {name}", *_LIGHT)
    kind: Literal["directional", "point"] | None = None
    if "type" in fields:
        text = fields["type"].text("type")
        if text not in ("directional", "point"):
            fields["type"].fail(f"type must be directional or point, not {text!r}; a light of the world needs none")
        kind = "point" if text == "point" else "directional"
        if kind == "point" and "position" not in fields:
            node.fail(f"light {name}: a point light needs `position: [x, y, z]`")
    _check_light(name, fields, kind)
    return LightPlan(
        name=name,
        at=node.at,
        kind=kind,
        intensity=read_quantity(fields["intensity"], "intensity", minimum=0, maximum=100)
        if "intensity" in fields
        else constant(1.0),
        color=read_color(fields["color"], "color") if "color" in fields else None,
        azimuth=read_quantity(fields["azimuth"], "azimuth") if "azimuth" in fields else TURN,
        elevation=read_quantity(fields["elevation"], "elevation", minimum=-1.58, maximum=1.58)
        if "elevation" in fields
        else (constant(1.0) if kind == "directional" else None),
        position=read_numbers(fields["position"], "position") if "position" in fields else None,
        shadows=fields["shadows"].flag("shadows") if "shadows" in fields else None,
    )


def _check_light(name: str, fields: dict[str, YamlNode], kind: Literal["directional", "point"] | None) -> None:
    """Refuse parameters that a light of this kind does not have."""
    for angle in ("azimuth", "elevation"):
        if kind == "point" and angle in fields:
            fields[angle].fail(f"light {name}: a point light has no `{angle}`; leave it out")
    if kind == "directional" and "position" in fields:
        message = "a directional light has no `position`; give `azimuth` and `elevation`"
        fields["position"].fail(f"light {name}: {message}")
    if kind is None and "azimuth" in fields and "elevation" not in fields:
        fields["azimuth"].fail(f"light {name}: `azimuth` alone changes nothing; add `elevation: …`")


def _lidar(node: YamlNode) -> LidarPlan:
    fields = node.check_keys("lidar", *_LIDAR)
    beams = fields["beams"].whole("beams", minimum=1) if "beams" in fields else 64
    columns = fields["columns"].whole("columns", minimum=1) if "columns" in fields else 1024
    if beams * columns > _MAX_RAYS:
        node.fail(f"a lidar has at most {_MAX_RAYS} rays")
    pose = (0.0, 0.0, 0.1, 0.0, 0.0, 0.0)
    if "pose" in fields:
        items = fields["pose"].items()
        if len(items) != 6:
            fields["pose"].fail("pose must be [x, y, z, roll, pitch, yaw] in the camera's frame")
        pose = tuple(item.number("pose") for item in items)
    return LidarPlan(
        at=node.at,
        beams=beams,
        columns=columns,
        vertical=read_pair(fields["vertical"], "vertical") if "vertical" in fields else (-0.43, 0.035),
        horizontal=read_pair(fields["horizontal"], "horizontal") if "horizontal" in fields else (-3.14159, 3.14159),
        range_m=fields["range"].number("range", above=0) if "range" in fields else 100.0,
        camera_from_lidar=pose,
    )
