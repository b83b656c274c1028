"""`trundle dataset PLAN --show N`: one picture with its annotations."""

from io import BytesIO
from pathlib import Path

from PIL import Image

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.studies.datasets import AnnotatedPicture, DatasetPlan, depth_image, draw_overlay, instance_image

from .dataset_world import picture_maker


def show_picture(plan: DatasetPlan, number: int, path: Path) -> str:
    """Write a picture with 2D boxes, with 3D boxes and key points, its depths and its segmentation.

    Returns:
        One line for each object.

    Raises:
        TrundleError: the picture cannot be made, or the plan has no such picture.
    """
    if not 0 <= number < plan.count:
        raise UsageError(f"there is no picture {number}; the plan has pictures 0 to {plan.count - 1}")
    annotated = picture_maker(plan).make(number)
    picture = Image.fromarray(annotated.rgb)
    parts = [
        draw_overlay(picture, annotated.annotation, plan.categories, solid=False),
        draw_overlay(picture, annotated.annotation, plan.categories, solid=True),
        Image.fromarray(depth_image(annotated.depth)),
        Image.fromarray(instance_image(annotated.instances)),
    ]
    sheet = Image.new("RGB", (2 * picture.width, 2 * picture.height))
    for i, part in enumerate(parts):
        sheet.paste(part, (i % 2 * picture.width, i // 2 * picture.height))
    file = BytesIO()
    sheet.save(file, "PNG")
    write_atomically(path, file.getvalue())
    return _table(annotated)


def _table(annotated: AnnotatedPicture) -> str:
    lines = [f"{len(annotated.annotation.objects)} objects"]
    for item in annotated.annotation.objects:
        width, height = item.box.width, item.box.height
        hidden = f"{100 * item.occlusion:.0f} % hidden, {100 * item.truncation:.0f} % beyond the edge"
        lines.append(f"  {item.instance} {item.model} ({item.category}): {width:g} x {height:g} px, {hidden}")
    return "\n".join(lines)
