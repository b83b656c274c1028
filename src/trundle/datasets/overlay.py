"""Annotations drawn over pictures, for people to look at."""

import colorsys
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from trundle.spatial import matrix_from_quaternion, pose_from_row, transform_points

from .annotation import Box3d, CameraAnnotation, PictureAnnotation

Rgb = tuple[int, int, int]
Line = tuple[tuple[float, float], tuple[float, float]]
_GOLDEN = 0.6180339887498949
_EDGES = ((0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7), (6, 7))
"""Corners of a box that an edge joins."""
_NEAR_M = 1e-3
_DARK, _LIGHT = (10, 14, 20), (255, 255, 255)


def category_colour(number: int) -> Rgb:
    """Return a colour of a category's number, far from those of its neighbours."""
    r, g, b = colorsys.hsv_to_rgb((0.33 + number * _GOLDEN) % 1.0, 0.75, 1.0)
    return round(255 * r), round(255 * g), round(255 * b)


def box_corners(box: Box3d) -> NDArray[np.float64]:
    """Return the eight corners of a box in the world, (8, 3) [m]; x varies slowest."""
    signs = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    return transform_points(pose_from_row(np.array(box.world_from_box)), signs * box.size)


def box_edges(box: Box3d, camera: CameraAnnotation) -> Iterator[Line]:
    """Yield the edges of a box in the picture [px], without those that reach behind the camera."""
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
        picture: of any size.
        annotation: of it.
        categories: of the plan.
        solid: draw boxes around the bodies and key points; else around the visible pixels, with their categories.
    """
    image = picture.convert("RGB")
    pen, scale = ImageDraw.Draw(image), image.width / annotation.width

    def at(x: float, y: float) -> tuple[float, float]:
        return x * scale, y * scale

    for each in annotation.objects:
        colour = category_colour(categories.index(each.category))
        if solid:
            for one, other in box_edges(each.box_3d, annotation.camera):
                pen.line([at(*one), at(*other)], fill=colour, width=2)
            for point in each.key_points:
                if point.pixel is not None:
                    pen.circle(at(*point.pixel), 4, fill=_LIGHT if point.is_visible else None, outline=colour, width=2)
            continue
        low, high = at(each.box.left, each.box.top), at(each.box.right, each.box.bottom)
        pen.rectangle([low, high], outline=colour, width=2)
        label = each.category if each.occlusion < 0.05 else f"{each.category} {100 * each.occlusion:.0f} % hidden"
        left, top, right, bottom = pen.textbbox((0, 0), label)
        x, y = low[0], max(low[1] - (bottom - top) - 5, 0.0)
        pen.rectangle([x, y, x + right - left + 5, y + bottom - top + 5], fill=colour)
        pen.text((x + 2 - left, y + 2 - top), label, fill=_DARK)
    return image


def depth_colours(depth: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Return depths as greys, the nearest the lightest; (height, width, 3), black where there is nothing."""
    seen = np.isfinite(depth)
    near, far = (float(depth[seen].min()), float(np.percentile(depth[seen], 98))) if seen.any() else (0.0, 1.0)
    share = np.clip((depth - near) / max(far - near, 1e-6), 0.0, 1.0)
    grey = np.where(seen, 255 - 215 * share, 0).astype(np.uint8)
    return np.repeat(grey[:, :, None], 3, axis=2)


def instance_colours(instances: NDArray[np.uint16]) -> NDArray[np.uint8]:
    """Return a colour for each instance, (height, width, 3); dark grey for the rest of the world."""
    table = np.array(
        [_DARK, *(category_colour(number) for number in range(1, int(instances.max()) + 1))], dtype=np.uint8
    )
    return table[instances]
