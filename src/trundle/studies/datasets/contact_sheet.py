"""Contact sheet: some annotated pictures of a dataset, as PNG and as one HTML file."""

import base64
import math
from collections import Counter
from collections.abc import Iterator, Sequence
from html import escape
from io import BytesIO
from pathlib import Path

from PIL import Image

from trundle.base.atomic_write import write_atomically
from trundle.base.http.html_policy import policy_of_document

from .annotation import PictureAnnotation
from .dataset_folder import picture_path
from .label_layout import layout_labels, touches_box
from .overlay import box_edges, box_rect, category_color, center, draw_overlay
from .plan import DatasetPlan

_SHOWN = 24
_COLUMNS = 4
_CELL_PX = 400
_GAP_PX = 6
_PAPER = (24, 28, 34)
_LETTER_ASPECT = 0.6
"""Mean width of a letter in the page's font, relative to the font size."""
_STYLE = """
:root{color-scheme:light dark;--ink:#1d232b;--paper:#f6f7f9;--card:#fff;--line:#d8dde4}
@media(prefers-color-scheme:dark){:root{--ink:#e6eaf0;--paper:#14181d;--card:#1d232b;--line:#333c47}}
body{margin:0;padding:24px;font:14px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper)}
h1{font-size:20px;margin:0 0 4px}p{margin:0 0 16px}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(320px,1fr));gap:12px}
figure{margin:0;background:var(--card);border:1px solid var(--line);border-radius:6px;overflow:hidden}
figure>div{position:relative}img,svg{display:block;width:100%}svg{position:absolute;inset:0;height:100%}
figcaption{padding:4px 8px;font-size:12px}
text{font-family:system-ui,sans-serif;font-weight:600;fill:#0a0e14}
table{border-collapse:collapse;margin:0 0 16px}td,th{padding:2px 12px 2px 0;text-align:left}
td+td,th+th{text-align:right}i{display:inline-block;width:10px;height:10px;border-radius:2px;margin-right:6px}
label{margin-right:16px;cursor:pointer}fieldset{border:0;padding:0;margin:0 0 12px}
body:not(:has(#boxes:checked)) .box,body:not(:has(#solids:checked)) .solid,
body:not(:has(#points:checked)) .point{display:none}
"""


def write_contact_sheet(plan: DatasetPlan, folder: Path, annotations: Sequence[PictureAnnotation]) -> None:
    """Write `contact_sheet.png` and the self-contained `contact_sheet.html`.

    Args:
        plan: plan of the dataset.
        folder: dataset's folder.
        annotations: annotations of `shown_pictures`.
    """
    rows = math.ceil(len(annotations) / _COLUMNS)
    height_px = round(_CELL_PX * plan.height_px / plan.width_px)
    columns = min(_COLUMNS, len(annotations))
    size = (columns * (_CELL_PX + _GAP_PX) + _GAP_PX, rows * (height_px + _GAP_PX) + _GAP_PX)
    sheet = Image.new("RGB", size, _PAPER)
    figures: list[str] = []
    for i, annotation in enumerate(annotations):
        with Image.open(folder / picture_path("images", annotation.number)) as picture:
            small = picture.convert("RGB").resize((_CELL_PX, height_px), Image.Resampling.LANCZOS)
        cell = draw_overlay(small, annotation, plan.categories, solid=False)
        row, column = divmod(i, _COLUMNS)
        sheet.paste(cell, (_GAP_PX + column * (_CELL_PX + _GAP_PX), _GAP_PX + row * (height_px + _GAP_PX)))
        figures.append(_figure(plan, annotation, small))
    file = BytesIO()
    sheet.save(file, "PNG", optimize=True)
    write_atomically(folder / "contact_sheet.png", file.getvalue())
    write_atomically(folder / "contact_sheet.html", _page(plan, annotations, figures))


def shown_pictures(count: int) -> list[int]:
    """Return the numbers of the pictures on a contact sheet, evenly spaced."""
    shown = min(count, _SHOWN)
    return [i * count // shown for i in range(shown)]


def _page(plan: DatasetPlan, annotations: Sequence[PictureAnnotation], figures: Sequence[str]) -> str:
    name = escape(Path(plan.file).name)
    counts = Counter(annotated.category for picture in annotations for annotated in picture.objects)
    rows = "".join(
        f"<tr><td><i style='background:{_css(i)}'></i>{escape(category)}</td><td>{counts[category]}</td></tr>"
        for i, category in enumerate(plan.categories)
    )
    table = f"<table><tr><th>category</th><th>seen here</th></tr>{rows}</table>"
    switches = "".join(
        f'<label><input type="checkbox" id="{id_}"{checked}> {text}</label>'
        for id_, text, checked in (
            ("boxes", "2D boxes", " checked"),
            ("solids", "3D boxes", ""),
            ("points", "key points", " checked"),
        )
    )
    summary = f"{len(annotations)} of {plan.count} pictures, {plan.width_px} × {plan.height_px} px, seed {plan.seed}"
    head = (
        f'<meta charset="utf-8">{policy_of_document()}<meta name="viewport" content="width=device-width">'
        f"<title>{name}</title>"
    )
    intro = f"<h1>{name}</h1><p>{summary}</p>{table}<fieldset>{switches}</fieldset>"
    body = f"{intro}<div class='grid'>{''.join(figures)}</div>"
    return f'<!doctype html><html lang="en"><head>{head}<style>{_STYLE}</style></head><body>{body}</body></html>'


def _figure(plan: DatasetPlan, picture: PictureAnnotation, small: Image.Image) -> str:
    file = BytesIO()
    small.save(file, "WEBP", quality=82)
    data = base64.b64encode(file.getvalue()).decode()
    shapes = "".join([*_shapes(plan, picture), *_labels(plan, picture)])
    overlay = f'<svg viewBox="0 0 {picture.width} {picture.height}">{shapes}</svg>'
    image = f'<img alt="" src="data:image/webp;base64,{data}">'
    caption = f"{picture.number:06}, {len(picture.objects)} objects"
    return f"<figure><div>{image}{overlay}</div><figcaption>{caption}</figcaption></figure>"


def _shapes(plan: DatasetPlan, picture: PictureAnnotation) -> Iterator[str]:
    for annotated in picture.objects:
        color, box = _css(plan.categories.index(annotated.category)), annotated.box
        style = f'fill="none" stroke="{color}" stroke-width="2" vector-effect="non-scaling-stroke"'
        size = f'width="{box.width:g}" height="{box.height:g}"'
        yield f'<rect class="box" x="{box.left:g}" y="{box.top:g}" {size} {style}/>'
        path = "".join(
            f"M{x:.1f} {y:.1f}L{u:.1f} {v:.1f}" for (x, y), (u, v) in box_edges(annotated.box_3d, picture.camera)
        )
        yield f'<path class="solid" d="{path}" {style}/>'
        for point in annotated.key_points:
            if point.pixel is not None:
                x, y = point.pixel
                fill = "#fff" if point.is_visible else "none"
                title = f"<title>{escape(point.name)}</title>"
                ring = f'stroke="{color}" stroke-width="2"'
                yield f'<circle class="point" cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{fill}" {ring}>{title}</circle>'


def _labels(plan: DatasetPlan, picture: PictureAnnotation) -> Iterator[str]:
    """Yield labels that do not cover one another; a thin line connects a detached label to its box."""
    font_px = picture.width / 30
    boxes = [box_rect(annotated) for annotated in picture.objects]
    sizes = [
        (font_px * (_LETTER_ASPECT * len(annotated.category) + 0.4), font_px * 1.25) for annotated in picture.objects
    ]
    labels = layout_labels(boxes, sizes, (picture.width, picture.height))
    for annotated, box, label in zip(picture.objects, boxes, labels, strict=True):
        color, (left, top, right, bottom) = _css(plan.categories.index(annotated.category)), label
        line = ""
        if not touches_box(label, box):
            (x, y), (u, v) = center(label), center(box)
            line = f'<path d="M{x:.1f} {y:.1f}L{u:.1f} {v:.1f}" stroke="{color}"/>'
        card = f'<rect x="{left:.1f}" y="{top:.1f}" width="{right - left:.1f}" height="{bottom - top:.1f}"'
        text = f'<text x="{left + 0.2 * font_px:.1f}" y="{top + 0.95 * font_px:.1f}" font-size="{font_px:.1f}">'
        yield f'<g class="box">{line}{card} fill="{color}"/>{text}{escape(annotated.category)}</text></g>'


def _css(number: int) -> str:
    return "#" + "".join(f"{part:02x}" for part in category_color(number))
