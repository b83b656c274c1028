"""Drawing of annotations over pictures."""

import colorsys
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from trundle.spatial import matrix_from_quaternion, pose_from_row, transform_points

from .annotation import Box3d, CameraAnnotation, ObjectAnnotation, PictureAnnotation
from .label_layout import Rect, layout_labels, touches_box

Rgb = tuple[int, int, int]
Line = tuple[tuple[float, float], tuple[float, float]]
_GOLDEN = 0.6180339887498949
_EDGES = ((0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7), (6, 7))
"""Pairs of a box's corners that an edge connects."""
_NEAR_M = 1e-3
_DARK, _LIGHT = (10, 14, 20), (255, 255, 255)
_PAD = 2
"""Margin of a label's text [px]."""


def category_color(number: int) -> Rgb:
    """Return the color of a category's number, distinct from those of neighbouring numbers."""
    r, g, b = colorsys.hsv_to_rgb((0.33 + number * _GOLDEN) % 1.0, 0.75, 1.0)
    return round(255 * r), round(255 * g), round(255 * b)


def box_corners(box: Box3d) -> NDArray[np.float64]:
    """Return the eight corners of a box in the world, (8, 3) [m]; x varies slowest."""
    signs = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    return transform_points(pose_from_row(np.array(box.world_from_box)), signs * box.size)


def box_edges(box: Box3d, camera: CameraAnnotation) -> Iterator[Line]:
    """Yield the projected edges of a box [px], except for edges that reach behind the camera."""
    world_from_camera = pose_from_row(np.array(camera.world_from_camera))
    local = (box_corners(box) - world_from_camera.position) @ matrix_from_quaternion(world_from_camera.quaternion)
    for one, other in _EDGES:
        if min(local[one, 2], local[other, 2]) > _NEAR_M:
            yield _pixel(local[one], camera), _pixel(local[other], camera)


def _pixel(point: NDArray[np.float64], camera: CameraAnnotation) -> tuple[float, float]:
    x, y, z = point.tolist()
    return camera.fx * x / z + camera.cx, camera.fy * y / z + camera.cy


def draw_overlay(
    picture: Image.Image, annotation: PictureAnnotation, categories: Sequence[str], *, solid: bool
) -> Image.Image:
    """Return a picture with its annotations.

    Args:
        picture: picture of any size.
        annotation: its annotation.
        categories: categories of the plan.
        solid: True for 3D boxes and key points; False for 2D boxes of visible pixels with labels.
    """
    image = picture.convert("RGB")
    pen, scale = ImageDraw.Draw(image), image.width / annotation.width

    def at(x: float, y: float) -> tuple[float, float]:
        return x * scale, y * scale

    for annotated in annotation.objects:
        color = category_color(categories.index(annotated.category))
        if solid:
            for one, other in box_edges(annotated.box_3d, annotation.camera):
                pen.line([at(*one), at(*other)], fill=color, width=2)
            for point in annotated.key_points:
                if point.pixel is not None:
                    pen.circle(at(*point.pixel), 4, fill=_LIGHT if point.is_visible else None, outline=color, width=2)
            continue
        low, high = at(annotated.box.left, annotated.box.top), at(annotated.box.right, annotated.box.bottom)
        pen.rectangle([low, high], outline=color, width=2)
    if not solid:
        _draw_labels(pen, annotation, categories, scale, (image.width, image.height))
    return image


def _draw_labels(
    pen: ImageDraw.ImageDraw,
    annotation: PictureAnnotation,
    categories: Sequence[str],
    scale: float,
    bounds: tuple[float, float],
) -> None:
    texts = [label_of(annotated) for annotated in annotation.objects]
    text_boxes = [pen.textbbox((0, 0), text) for text in texts]
    boxes = [box_rect(annotated, scale) for annotated in annotation.objects]
    sizes = [(right - left + 2 * _PAD, bottom - top + 2 * _PAD) for left, top, right, bottom in text_boxes]
    labels = layout_labels(boxes, sizes, bounds)
    for annotated, box, label in zip(annotation.objects, boxes, labels, strict=True):
        if not touches_box(label, box):
            pen.line([center(label), center(box)], fill=category_color(categories.index(annotated.category)), width=1)
    for annotated, text, text_box, label in zip(annotation.objects, texts, text_boxes, labels, strict=True):
        pen.rectangle(label, fill=category_color(categories.index(annotated.category)))
        pen.text((label[0] + _PAD - text_box[0], label[1] + _PAD - text_box[1]), text, fill=_DARK)


def label_of(annotated: ObjectAnnotation) -> str:
    """Return a label with the category and the hidden percentage."""
    hidden = annotated.occlusion
    return annotated.category if hidden < 0.05 else f"{annotated.category} {100 * hidden:.0f} % hidden"


def box_rect(annotated: ObjectAnnotation, scale: float = 1.0) -> Rect:
    """Return the bounding box of the visible pixels in a scaled picture."""
    box = annotated.box
    return box.left * scale, box.top * scale, box.right * scale, box.bottom * scale


def center(rect: Rect) -> tuple[float, float]:
    """Return the middle of a rectangle."""
    return (rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2


def depth_image(depth: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Return a (height, width, 3) image of depths: near is light grey, far is dark, the background black."""
    visible = np.isfinite(depth)
    near, far = (float(depth[visible].min()), float(np.percentile(depth[visible], 98))) if visible.any() else (0.0, 1.0)
    ratio = np.clip((depth - near) / max(far - near, 1e-6), 0.0, 1.0)
    grey = np.where(visible, 255 - 215 * ratio, 0).astype(np.uint8)
    return np.repeat(grey[:, :, None], 3, axis=2)


def instance_image(instances: NDArray[np.uint16]) -> NDArray[np.uint8]:
    """Return a (height, width, 3) image with a color per instance; dark grey for the rest of the world."""
    table = np.array(
        [_DARK, *(category_color(number) for number in range(1, int(instances.max()) + 1))], dtype=np.uint8
    )
    return table[instances]
