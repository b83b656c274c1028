"""COCO: detection, instance masks and key points in one JSON file.

https://cocodataset.org/#format-data; masks are run lengths, boxes enclose visible pixels. `amodal_bbox`, `occlusion`
and `truncation` are additional fields, which COCO's tools ignore.
"""

import os
from collections.abc import Iterator
from pathlib import Path

from msgspec import json

from ..annotation import Box2d, ObjectAnnotation, PictureAnnotation
from ..dataset_folder import picture_path
from ..plan import DatasetPlan
from .format import DatasetFormat, ReadAll

_HIDDEN, _VISIBLE = 1, 2
"""COCO's visibility flags of key points; 0: outside the picture."""


class CocoFormat(DatasetFormat):
    """Writer of `coco.json`; `file_name` is relative to the dataset's folder."""

    def finish(self, plan: DatasetPlan, folder: Path, read: ReadAll) -> None:
        """Write the file picture by picture, as it may be larger than memory."""
        path = folder / "coco.json"
        unfinished = path.with_name(f".{path.name}.part")
        names = {name: key_point_names(plan, name) for name in plan.categories}
        numbers = {name: number for number, name in enumerate(plan.categories, 1)}
        categories = [
            {"id": number, "name": name, "supercategory": name}
            | ({"keypoints": list(names[name]), "skeleton": []} if names[name] else {})
            for name, number in numbers.items()
        ]
        with unfinished.open("wb") as file:
            file.write(b'{"info":' + json.encode({"description": Path(plan.file).stem, "version": "1.0"}))
            file.write(b',"licenses":[],"categories":' + json.encode(categories))
            file.write(b',"images":[')
            for i, picture in enumerate(read()):
                file.write((b",\n" if i else b"\n") + json.encode(_image(picture)))
            file.write(b'],"annotations":[')
            for i, annotation in enumerate(_annotations(read, numbers, names)):
                file.write((b",\n" if i else b"\n") + json.encode(annotation))
            file.write(b"]}\n")
        os.replace(unfinished, path)


def key_point_names(plan: DatasetPlan, category: str) -> tuple[str, ...]:
    """Return the names of a category's key points, in the order of the plan."""
    names = [
        point.name
        for object_plan in plan.objects
        if object_plan.category == category
        for point in object_plan.key_points
    ]
    return tuple(dict.fromkeys(names))


def _image(picture: PictureAnnotation) -> dict[str, object]:
    return {
        "id": picture.number,
        "file_name": picture_path("images", picture.number).as_posix(),
        "width": picture.width,
        "height": picture.height,
    }


def _annotations(
    read: ReadAll, numbers: dict[str, int], names: dict[str, tuple[str, ...]]
) -> Iterator[dict[str, object]]:
    id_ = 0
    for picture in read():
        for annotated in picture.objects:
            id_ += 1
            annotation: dict[str, object] = {
                "id": id_,
                "image_id": picture.number,
                "category_id": numbers[annotated.category],
                "bbox": _xywh(annotated.box),
                "area": annotated.pixels,
                "iscrowd": 0,
                "segmentation": {"size": annotated.mask.size, "counts": annotated.mask.counts},
                "amodal_bbox": _xywh(annotated.amodal_box),
                "occlusion": round(annotated.occlusion, 4),
                "truncation": round(annotated.truncation, 4),
            }
            if names[annotated.category]:
                annotation |= _key_points(annotated, names[annotated.category])
            yield annotation


def _xywh(box: Box2d) -> list[float]:
    return [round(number, 2) for number in (box.left, box.top, box.width, box.height)]


def _key_points(annotated: ObjectAnnotation, names: tuple[str, ...]) -> dict[str, object]:
    points = {point.name: point for point in annotated.key_points}
    numbers: list[float] = []
    count = 0
    for name in names:
        point = points.get(name)
        if point is None or point.pixel is None:
            numbers += [0, 0, 0]
            continue
        x, y = point.pixel
        numbers += [round(x, 2), round(y, 2), _VISIBLE if point.is_visible else _HIDDEN]
        count += 1
    return {"keypoints": numbers, "num_keypoints": count}
