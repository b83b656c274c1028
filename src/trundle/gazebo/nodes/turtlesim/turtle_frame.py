"""Image of the turtles' window: paths, with turtles on top."""

import math
from collections.abc import Iterable
from typing import cast

from PIL import Image, ImageDraw

from .turtle import Color, Turtle

SIZE_PX = 500
METER_PX = 45
"""Height of the original's turtle images, which it calls one metre."""
SIZE_M = (SIZE_PX - 1) / METER_PX
_SHELL: Color = (60, 140, 60)
_RADIUS_M = 0.3


class TurtleFrame:
    """Image of 500 × 500 pixels."""

    def __init__(self, background: Color) -> None:
        self._paths = Image.new("RGB", (SIZE_PX, SIZE_PX), background)

    def clear(self, background: Color) -> None:
        """Erase all paths."""
        self._paths.paste(background, (0, 0, SIZE_PX, SIZE_PX))

    def draw_line(self, a: tuple[float, float], b: tuple[float, float], color: Color, width_px: int) -> None:
        """Draw a path segment between two points [m]."""
        ImageDraw.Draw(self._paths).line([_pixel(*a), _pixel(*b)], fill=color, width=width_px)

    def color_at(self, x: float, y: float) -> Color:
        """Return the color of the path below a point [m]."""
        column, row = _pixel(x, y)
        pixel = (min(max(round(column), 0), SIZE_PX - 1), min(max(round(row), 0), SIZE_PX - 1))
        return cast("Color", self._paths.getpixel(pixel))  # RGB images have three channels

    def with_turtles(self, turtles: Iterable[Turtle]) -> bytes:
        """Return the pixels as rgb8, row by row from the top."""
        image = self._paths.copy()
        draw = ImageDraw.Draw(image)
        for turtle in turtles:
            x, y, r = turtle.x, turtle.y, _RADIUS_M
            head = (x + r * 1.3 * math.cos(turtle.theta), y + r * 1.3 * math.sin(turtle.theta))
            for (cx, cy), radius in ((head, 0.4 * r), ((x, y), r)):
                left, top = _pixel(cx - radius, cy + radius)
                right, bottom = _pixel(cx + radius, cy - radius)
                draw.ellipse((left, top, right, bottom), fill=_SHELL, outline=(20, 60, 20))
        return image.tobytes()


def _pixel(x: float, y: float) -> tuple[float, float]:
    return x * METER_PX, SIZE_PX - 1 - y * METER_PX
