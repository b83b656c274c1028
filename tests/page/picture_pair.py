"""rviz and the page on one graph: pictures of the same file, compared."""

import json
import math
import threading
import time
import urllib.request
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.graphs import PATIENCE_S, Graph, until
from tests.page.picture_case import FRAMES, Case, Display, Message
from tests.page.picture_cases import CASES, REMAPPINGS, VIEW
from tests.page.picture_cases_scene import TEXTURED_URDF, URDF
from tests.page.real_rviz import BACKGROUND, Picture, RealRviz, rviz_file
from tests.page_client import page_url

from trundle.page import PageServer, Session
from trundle.page.session import RvizFile
from trundle.ros import StaticTransformBroadcaster, Transform

OUT = Path(__file__).parents[2] / "out" / "rviz_pictures"
MESHES = Path(__file__).parents[1] / "data"
"""Folder of the package `pictures`."""
_VIEW_CANVAS = "canvas[aria-label='3D view']"
_ONLY_THE_VIEW = f"body * {{ visibility: hidden !important }} {_VIEW_CANVAS} {{ visibility: visible !important }}"
_RAILS = "for (const part of ['left.open', 'dock.open', 'right.open.graph']) localStorage[`trundle.${part}`] = false"
"""With all panels closed, the page's view is centred in the area above the dock's row of tabs."""
_ABOVE = 8
"""Gap above the free part of the 3D view [px]."""
MIN_DIFFERENCE = 25
"""Difference of a color from which a pixel counts as drawn [0…255]."""
_FIELD_OF_VIEW = math.pi / 4
"""rviz's vertical field of view [rad]."""
_PERIOD_S = 0.5


@dataclass(frozen=True)
class Agreement:
    """Agreement of two pictures, each compared with its empty view."""

    overlap: float
    """Ratio of pixels that both drew to pixels that either drew."""
    color: float
    """Mean difference of a color component where both drew [0…255]; the largest of the three."""

    def __bool__(self) -> bool:
        return self.overlap >= 0.8 and self.color <= 25.5


def drawn(picture: Picture, empty: Picture) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Return the mask of pixels that differ from the empty picture."""
    return np.abs(picture - empty).max(axis=-1) > MIN_DIFFERENCE


def _is_something(picture: Picture, empty: Picture) -> bool:
    """Tell if something is drawn, and the view has started."""
    share = drawn(picture, empty).mean()
    return 5e-5 < share < 0.9


def coarse(picture: Picture, grain: int) -> Picture:
    """Average squares of a picture."""
    height, width = (size // grain * grain for size in picture.shape[:2])
    squares = picture[:height, :width].reshape(height // grain, grain, width // grain, grain, 3)
    return squares.mean(axis=(1, 3)).astype(np.int16)


def agreement(actual: Picture, actual_empty: Picture, real: Picture, real_empty: Picture) -> Agreement:
    actual_mask, real_mask = drawn(actual, actual_empty), drawn(real, real_empty)
    both, either = actual_mask & real_mask, actual_mask | real_mask
    if not both.any():
        return Agreement(0.0, 255.0)
    return Agreement(float(both.sum() / either.sum()), float(np.abs(actual - real)[both].mean(axis=0).max()))


class ClientPage:
    """The page in a browser, loaded once per file; its 3D view is taller than rviz's, with the same centre."""

    def __init__(self, browser_page: Any, server: PageServer, *, width: int, height: int) -> None:
        self.page, self._server = browser_page, server
        self._height = height
        browser_page.add_init_script(_RAILS)
        self._open()
        below = browser_page.evaluate("parseFloat(document.documentElement.style.getPropertyValue('--in-b'))")
        view, viewport = self._view_rectangle(), browser_page.viewport_size
        tall = height + below - _ABOVE  # the free area has the middle of rviz's height from the top
        size = {
            "width": viewport["width"] + width - view["width"],
            "height": viewport["height"] + tall - view["height"],
        }
        browser_page.set_viewport_size({key: round(value) for key, value in size.items()})
        half = math.tan(_FIELD_OF_VIEW / 2) * tall / height
        self._view = VIEW | {"Field of View": 2 * math.atan(half)}

    def show(self, displays: Sequence[Display]) -> None:
        rviz = RvizFile(name="case.rviz", text=rviz_file(displays, self._view), writable=True)
        self._server.set_session(Session(title="pictures", kind="graph", rviz=rviz, remappings=REMAPPINGS))
        until(lambda: self._served_file() == rviz.text)
        self._open()
        self.page.add_style_tag(content=_ONLY_THE_VIEW)

    def shot(self) -> Picture:
        """Take a picture of the 3D view, at rviz's height."""
        clip = self._view_rectangle() | {"height": self._height}
        return picture_of(self.page.screenshot(clip=clip))

    def picture(self, displays: Sequence[Display], is_drawn: Callable[[Picture], bool]) -> Picture:
        """Show a file; return the 3D view's picture once two in a row are equal and `is_drawn` is true."""
        self.show(displays)
        end = time.monotonic() + PATIENCE_S
        last = None
        while time.monotonic() < end:
            now = self.shot()
            if last is not None and is_drawn(now) and np.abs(now - last).max() < 3:
                return now
            last = now
            time.sleep(0.7)  # a scene at rest is drawn once more after 0.3 s
        pytest.fail(f"the page drew nothing that stood still within {PATIENCE_S:g} s")

    def _served_file(self) -> str | None:
        with urllib.request.urlopen(page_url(self._server.url, "/session.json"), timeout=PATIENCE_S) as answer:
            file = json.load(answer)["rviz"]
        return None if file is None else file["text"]

    def _open(self) -> None:
        self.page.goto(self._server.url)
        self.page.wait_for_selector(_VIEW_CANVAS, timeout=1000 * PATIENCE_S)

    def _view_rectangle(self) -> dict[str, float]:
        return self.page.locator(_VIEW_CANVAS).bounding_box()


def picture_of(png: bytes) -> Picture:
    return np.asarray(Image.open(BytesIO(png)).convert("RGB")).astype(np.int16)


class Pair:
    """rviz and the page on one graph, and their pictures without displays."""

    def __init__(self, graph: Graph, rviz: RealRviz, browser_page: Any, server: PageServer) -> None:
        self.graph, self.rviz, self.server = graph, rviz, server
        screen = rviz.picture(rviz_file([], VIEW), np.s_[:, :], _has_empty_view)
        self.view = _bounds(_background(screen))
        self.real_empty = screen[self.view]
        height, width = self.real_empty.shape[:2]
        self.page = ClientPage(browser_page, server, width=width, height=height)
        self.empty = self.page.picture([], lambda now: _background(now).mean() > 0.99)
        assert self.empty.shape == self.real_empty.shape

    def agreement(self, case: Case, *, patience_s: float = PATIENCE_S) -> Agreement:
        """Draw a case on both and compare, repeatedly while something may still be loading."""
        real = rviz_file([case.real or case.display], VIEW)
        with repeating(self.graph, case.repeated):
            expected = self.rviz.picture(real, self.view, lambda now: _is_something(now, self.real_empty))
            actual = self.page.picture([case.display], lambda now: _is_something(now, self.empty))
            end = time.monotonic() + patience_s
            while not (result := self._compare(actual, expected, case.grain)) and time.monotonic() < end:
                time.sleep(_PERIOD_S)
                expected, actual = self.rviz.shot()[self.view], self.page.shot()
        save_pair(case.name, expected, actual)
        return result

    def _compare(self, actual: Picture, expected: Picture, grain: int) -> Agreement:
        return agreement(*(coarse(picture, grain) for picture in (actual, self.empty, expected, self.real_empty)))


def save_pair(name: str, real: Picture, actual: Picture) -> None:
    """Write rviz's picture and the page's side by side."""
    OUT.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.concatenate([real, actual], axis=1).astype(np.uint8)).save(OUT / f"{name}.png")


def _bounds(mask: np.ndarray[Any, np.dtype[np.bool_]]) -> tuple[slice, slice]:
    rows, columns = np.nonzero(mask)
    return np.s_[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]


def _has_empty_view(screen: Picture) -> bool:
    """Tell if rviz shows an empty 3D view."""
    mask = _background(screen)
    return bool(mask.sum() > 100_000 and mask[_bounds(mask)].all())


def _background(picture: Picture) -> np.ndarray[Any, np.dtype[np.bool_]]:
    return (picture == BACKGROUND).all(axis=-1)


def publish(graph: Graph, messages: Sequence[Message]) -> None:
    """Publish latched messages, the frames and the robots."""
    node = graph.node("pictures")
    for name, urdf in (("/robot_description", URDF), ("/sign_description", TEXTURED_URDF)):
        graph.loop.run(node.params.set(name, urdf), PATIENCE_S)
    still = (1.0, 0.0, 0.0, 0.0)
    frames = [
        Transform(parent="map", child=name, stamp_ns=0, translation=at, rotation=still) for name, at in FRAMES.items()
    ]
    StaticTransformBroadcaster(node).send_transform(*frames)
    for topic, type_name, fields in messages:
        node.advertise(topic, type_name, latch=True).publish(dict(fields))
    graph.ready(node)


def publish_cases(graph: Graph) -> None:
    publish(graph, [message for case in CASES for message in case.messages])


@contextmanager
def repeating(graph: Graph, messages: Sequence[Message]) -> Generator[None]:
    """Publish messages one after another, at 2 Hz."""
    if not messages:
        yield
        return
    node = graph.node("repeating")
    publishers = [(node.advertise(topic, kind), dict(fields)) for topic, kind, fields in messages]
    over = threading.Event()

    def run() -> None:
        while not over.wait(_PERIOD_S / len(publishers)):
            publisher, fields = publishers[0]
            publisher.publish(fields)
            publishers.append(publishers.pop(0))

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
        graph.loop.run(node.shutdown(), PATIENCE_S)
