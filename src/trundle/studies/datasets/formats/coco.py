"""COCO: detection, instance masks and key points in one JSON file.

https://cocodataset.org/#format-data; masks are run lengths, boxes are around visible pixels. `amodal_bbox`, `occlusion`
and `truncation` are further fields, which COCO's tools leave alone.
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
"""COCO's marks of key points; 0: not in the picture."""


class CocoFormat(DatasetFormat):
    """Writes `coco.json`; `file_name` is relative to the dataset's folder."""

    def finish(self, plan: DatasetPlan, folder: Path, read: ReadAll) -> None:
        """Write the file, a picture at a time: it may be larger than memory."""
        path = folder / "coco.json"
        half = path.with_name(f".{path.name}.part")
        names = {name: key_point_names(plan, name) for name in plan.categories}
        numbers = {name: number for number, name in enumerate(plan.categories, 1)}
        categories = [
            {"id": number, "name": name, "supercategory": name}
            | ({"keypoints": list(names[name]), "skeleton": []} if names[name] else {})
            for name, number in numbers.items()
        ]
        with half.open("wb") as file:
            file.write(b'{"info":' + json.encode({"description": Path(plan.file).stem, "version": "1.0"}))
            file.write(b',"licenses":[],"categories":' + json.encode(categories))
            file.write(b',"images":[')
            for i, picture in enumerate(read()):
                file.write((b",\n" if i else b"\n") + json.encode(_image(picture)))
            file.write(b'],"annotations":[')
            for i, found in enumerate(_annotations(read, numbers, names)):
                file.write((b",\n" if i else b"\n") + json.encode(found))
            file.write(b"]}\n")
        os.replace(half, path)


def key_point_names(plan: DatasetPlan, category: str) -> tuple[str, ...]:
    """Return the names of a category's key points, in the order of the plan."""
    found = [point.name for each in plan.objects if each.category == category for point in each.key_points]
    return tuple(dict.fromkeys(found))


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
        for each in picture.objects:
            id_ += 1
            found: dict[str, object] = {
                "id": id_,
                "image_id": picture.number,
                "category_id": numbers[each.category],
                "bbox": _xywh(each.box),
                "area": each.pixels,
                "iscrowd": 0,
                "segmentation": {"size": each.mask.size, "counts": each.mask.counts},
                "amodal_bbox": _xywh(each.amodal_box),
                "occlusion": round(each.occlusion, 4),
                "truncation": round(each.truncation, 4),
            }
            if names[each.category]:
                found |= _key_points(each, names[each.category])
            yield found


def _xywh(box: Box2d) -> list[float]:
    return [round(number, 2) for number in (box.left, box.top, box.width, box.height)]


def _key_points(each: ObjectAnnotation, names: tuple[str, ...]) -> dict[str, object]:
    found = {point.name: point for point in each.key_points}
    numbers: list[float] = []
    count = 0
    for name in names:
        point = found.get(name)
        if point is None or point.pixel is None:
            numbers += [0, 0, 0]
            continue
        x, y = point.pixel
        numbers += [round(x, 2), round(y, 2), _VISIBLE if point.is_visible else _HIDDEN]
        count += 1
    return {"keypoints": numbers, "num_keypoints": count}
