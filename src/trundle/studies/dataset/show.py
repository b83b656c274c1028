"""`trundle dataset PLAN --show N`: one picture with all that is written about it."""

from io import BytesIO
from pathlib import Path

from PIL import Image

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.studies.datasets import AnnotatedPicture, DatasetPlan, depth_colours, draw_overlay, instance_colours

from .dataset_world import picture_maker


def show_picture(plan: DatasetPlan, number: int, path: Path) -> str:
    """Write a picture four times: with boxes, with bodies and key points, its depths, its segmentation.

    Returns:
        One line for each object.

    Raises:
        TrundleError: the plan cannot be drawn, or has no such picture.
    """
    if not 0 <= number < plan.count:
        raise UsageError(f"there is no picture {number}; the plan has pictures 0 to {plan.count - 1}")
    made = picture_maker(plan).make(number)
    picture = Image.fromarray(made.rgb)
    parts = [
        draw_overlay(picture, made.annotation, plan.categories, solid=False),
        draw_overlay(picture, made.annotation, plan.categories, solid=True),
        Image.fromarray(depth_colours(made.depth)),
        Image.fromarray(instance_colours(made.instances)),
    ]
    sheet = Image.new("RGB", (2 * picture.width, 2 * picture.height))
    for i, part in enumerate(parts):
        sheet.paste(part, (i % 2 * picture.width, i // 2 * picture.height))
    file = BytesIO()
    sheet.save(file, "PNG")
    write_atomically(path, file.getvalue())
    return _table(made)


def _table(made: AnnotatedPicture) -> str:
    lines = [f"{len(made.annotation.objects)} objects"]
    for each in made.annotation.objects:
        width, height = each.box.width, each.box.height
        hidden = f"{100 * each.occlusion:.0f} % hidden, {100 * each.truncation:.0f} % beyond the edge"
        lines.append(f"  {each.instance} {each.model} ({each.category}): {width:g} x {height:g} px, {hidden}")
    return "\n".join(lines)
