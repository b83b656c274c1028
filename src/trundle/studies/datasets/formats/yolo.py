"""YOLO: a text file for each picture, and `data.yaml`.

https://docs.ultralytics.com/datasets/detect/: class and box of visible pixels (centre, size), relative to the picture;
with key points if every class has equally many: https://docs.ultralytics.com/datasets/pose/.
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
    """Writer of `labels/`, which YOLO's tools find next to `images/`, and `data.yaml`."""

    def write(self, plan: DatasetPlan, folder: Path, picture: AnnotatedPicture) -> None:
        """Write a picture's labels."""
        annotation = picture.annotation
        path = folder / picture_path("labels", annotation.number, "txt")
        path.parent.mkdir(exist_ok=True)
        text = "".join(_line(plan, annotation, annotated) + "\n" for annotated in annotation.objects)
        path.write_text(text, encoding="utf-8")

    def finish(self, plan: DatasetPlan, folder: Path, read: ReadAll) -> None:
        """Write the list of classes."""
        del read  # the plan has the classes
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
    """Return the number of key points of every class; 0 if none, or if classes differ."""
    counts = {len(key_point_names(plan, name)) for name in plan.categories}
    return counts.pop() if len(counts) == 1 else 0


def _line(plan: DatasetPlan, picture: PictureAnnotation, annotated: ObjectAnnotation) -> str:
    box, width, height = annotated.box, picture.width, picture.height
    numbers = [(box.left + box.right) / 2 / width, (box.top + box.bottom) / 2 / height]
    numbers += [box.width / width, box.height / height]
    parts = [str(plan.categories.index(annotated.category)), *(f"{number:.6f}" for number in numbers)]
    if _key_point_count(plan):
        points = {point.name: point for point in annotated.key_points}
        for name in key_point_names(plan, annotated.category):
            point = points.get(name)
            if point is None or point.pixel is None:
                parts += ["0", "0", "0"]
            else:
                x, y = point.pixel
                mark = _VISIBLE if point.is_visible else _HIDDEN
                parts += [f"{x / width:.6f}", f"{y / height:.6f}", str(mark)]
    return " ".join(parts)
