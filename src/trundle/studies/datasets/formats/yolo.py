"""YOLO: a text file for each picture, and `data.yaml`.

https://docs.ultralytics.com/datasets/detect/: class and box (centre, size) as shares of the picture, of visible pixels;
with key points where every class has as many: https://docs.ultralytics.com/datasets/pose/.
"""

from pathlib import Path

import yaml

from trundle.base.atomic_write import write_atomically

from ..annotation import ObjectAnnotation, PictureAnnotation
from ..dataset_folder import picture_path
from ..picture import AnnotatedPicture
from ..plan import DatasetPlan
from .coco import key_point_names
from .format import DatasetFormat, ReadAll

_HIDDEN, _VISIBLE = 1, 2


class YoloFormat(DatasetFormat):
    """Writes `labels/`, which YOLO's tools find beside `images/`, and `data.yaml`."""

    def write(self, plan: DatasetPlan, folder: Path, picture: AnnotatedPicture) -> None:
        """Write a picture's labels."""
        annotation = picture.annotation
        path = folder / picture_path("labels", annotation.number, "txt")
        path.parent.mkdir(exist_ok=True)
        text = "".join(_line(plan, annotation, each) + "\n" for each in annotation.objects)
        path.write_text(text, encoding="utf-8")

    def finish(self, plan: DatasetPlan, folder: Path, read: ReadAll) -> None:
        """Write the list of classes."""
        del read  # they are the plan's
        names = dict(enumerate(plan.categories))
        data: dict[str, object] = {"train": "images", "val": "images", "names": names}
        count = _key_point_count(plan)
        if count:
            data["kpt_shape"] = [count, 3]
        comment = (
            "# `val` is what training watches: make another dataset with another seed, and name its images here.\n"
        )
        write_atomically(folder / "data.yaml", comment + yaml.safe_dump(data, sort_keys=False))


def _key_point_count(plan: DatasetPlan) -> int:
    """Return the number of key points of every class; 0: none, or not the same."""
    counts = {len(key_point_names(plan, name)) for name in plan.categories}
    return counts.pop() if len(counts) == 1 else 0


def _line(plan: DatasetPlan, picture: PictureAnnotation, each: ObjectAnnotation) -> str:
    box, width, height = each.box, picture.width, picture.height
    numbers = [(box.left + box.right) / 2 / width, (box.top + box.bottom) / 2 / height]
    numbers += [box.width / width, box.height / height]
    parts = [str(plan.categories.index(each.category)), *(f"{number:.6f}" for number in numbers)]
    if _key_point_count(plan):
        found = {point.name: point for point in each.key_points}
        for name in key_point_names(plan, each.category):
            point = found.get(name)
            if point is None or point.pixel is None:
                parts += ["0", "0", "0"]
            else:
                x, y = point.pixel
                mark = _VISIBLE if point.is_visible else _HIDDEN
                parts += [f"{x / width:.6f}", f"{y / height:.6f}", str(mark)]
    return " ".join(parts)
