"""Debian's rviz and the page show the same images, with and without the scene overlaid."""

import base64
import struct
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.graphs import PATIENCE_S, running_graph
from tests.page.picture_case import Display, Message, color, point, pose
from tests.page.picture_cases import REMAPPINGS, VIEW
from tests.page.picture_pair import MESHES, Pair, agreement, picture_of, publish, save_pair
from tests.page.real_rviz import BACKGROUND, INSTALLED, NOT_INSTALLED, Picture, RealRviz, rviz_file

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

pytestmark = [pytest.mark.slow, pytest.mark.skipif(not INSTALLED, reason=NOT_INSTALLED)]

WIDTH, HEIGHT = 64, 48
MAGENTA = (255, 0, 255)
_IMAGE = "sensor_msgs/Image"
_HEADER = {"frame_id": "base", "stamp": {"secs": 1, "nsecs": 0}}
_PIXELS = [(u, v) for v in range(HEIGHT) for u in range(WIDTH)]
_NUMBERS = [u + 2 * v for u, v in _PIXELS]


def _image(encoding: str, data: bytes) -> dict[str, Any]:
    size = {"width": WIDTH, "height": HEIGHT, "step": len(data) // HEIGHT}
    return {"header": _HEADER, "encoding": encoding, "data": data, **size}


def _pixels(order: Sequence[int], alpha: int | None = None) -> bytes:
    """Return the bytes of a picture, with its components in an order."""
    colors = [(4 * u, 5 * v, 255 - 4 * u) for u, v in _PIXELS]
    end = () if alpha is None else (alpha,)
    return bytes(part for color in colors for part in (*(color[index] for index in order), *end))


def _png() -> bytes:
    file = BytesIO()
    Image.frombytes("RGB", (WIDTH, HEIGHT), _pixels((0, 1, 2))).save(file, "png")
    return file.getvalue()


IMAGES: Mapping[str, dict[str, Any]] = {
    "rgb8": _image("rgb8", _pixels((0, 1, 2))),
    "bgr8": _image("bgr8", _pixels((2, 1, 0))),
    "rgba8": _image("rgba8", _pixels((0, 1, 2), 255)),
    "bgra8": _image("bgra8", _pixels((2, 1, 0), 255)),
    "mono8": _image("mono8", bytes(min(255, 2 * number) for number in _NUMBERS)),
    "mono16": _image("mono16", b"".join(struct.pack("<H", 300 * number) for number in _NUMBERS)),
    "16UC1": _image("16UC1", b"".join(struct.pack("<H", 40 * number) for number in _NUMBERS)),
    "32FC1": _image("32FC1", b"".join(struct.pack("<f", number / 20) for number in _NUMBERS)),
}
_EMPTY = _image("rgb8", bytes(MAGENTA) * (WIDTH * HEIGHT))
_FIXED = {"Normalize Range": False, "Min Value": 2.0, "Max Value": 5.0}
CASES: Mapping[str, tuple[str, dict[str, Any]]] = {
    **{name: (f"/images/{name}", {}) for name in IMAGES},
    "32FC1 between bounds": ("/images/32FC1", _FIXED),
    "16UC1 between bounds": ("/images/16UC1", {"Normalize Range": False, "Min Value": 500, "Max Value": 4000}),
}

# A camera at base that looks along x: displays in its view are drawn over its picture.
_K = [60.0, 0.0, 32.0, 0.0, 60.0, 24.0, 0.0, 0.0, 1.0]
_P = [60.0, 0.0, 32.0, 0.0, 0.0, 60.0, 24.0, 0.0, 0.0, 0.0, 1.0, 0.0]
_INFO = {"header": _HEADER, "width": WIDTH, "height": HEIGHT, "K": _K, "P": _P}
_GREY = _image("rgb8", bytes((90, 90, 90)) * (WIDTH * HEIGHT))


def _solid(kind: int, x: float) -> dict[str, Any]:
    """Return a list of one solid about 4 m in front of the camera; lists are drawn unlit."""
    shape = {"header": {"frame_id": "map"}, "type": kind, "scale": point(1.2, 1.2, 1.2), "points": [point(0, 0)]}
    return shape | {"pose": pose(x, 0.2, 4.5, 0.4), "color": color(1.0, 0.5, 0.1)}


MESSAGES: list[Message] = [
    *((f"/images/{name}", _IMAGE, message) for name, message in IMAGES.items()),
    ("/images/empty", _IMAGE, _EMPTY),
    ("/images/png/compressed", "sensor_msgs/CompressedImage", {"header": _HEADER, "format": "png", "data": _png()}),
    *(
        (f"{folder}/{topic}", kind, message)
        for folder, image in (("/camera", _GREY), ("/unseen", _EMPTY))
        for topic, kind, message in (("image", _IMAGE, image), ("camera_info", "sensor_msgs/CameraInfo", _INFO))
    ),
    ("/seen/cube", "visualization_msgs/Marker", _solid(6, 0.2)),
    ("/seen/sphere", "visualization_msgs/Marker", _solid(7, 2.0)),
]


Area = tuple[slice, slice]


@dataclass
class Panes:
    """Panes of images in rviz and on the page."""

    pair: Pair
    image_area: Area
    camera_area: Area

    def image(self, real: Display, actual: Display) -> tuple[Picture, Picture]:
        """Show an image on both; return rviz's pane, shrunk to the image's size, and the page's tile."""
        return self._real([real], self.image_area), self._page([actual], "Image")

    def camera(self, displays: Sequence[Display]) -> tuple[Picture, Picture]:
        return self._real(displays, self.camera_area), self._page(displays, "Camera")

    def _real(self, displays: Sequence[Display], area: Area) -> Picture:
        return _shrunk(self.pair.rviz.picture(rviz_file(displays, VIEW, has_docks=True), area, _is_image))

    def _page(self, displays: Sequence[Display], name: str) -> Picture:
        """Return the page's tile, pixel by pixel."""
        self.pair.page.show(displays)
        canvas = self.pair.page.page.get_by_role("img", name=f"Camera image {name}", include_hidden=True).first
        canvas.wait_for(state="attached", timeout=1000 * PATIENCE_S)
        end = time.monotonic() + PATIENCE_S
        last: Picture | None = None
        while time.monotonic() < end:
            now = picture_of(base64.b64decode(canvas.evaluate("it => it.toDataURL()").partition(",")[2]))
            if last is not None and now.shape == (HEIGHT, WIDTH, 3) and now.max() > 0 and np.array_equal(now, last):
                return now
            last = now
            time.sleep(0.3)
        pytest.fail(f"the page's tile of {name} did not come within {PATIENCE_S:g} s")


def _is_image(picture: Picture) -> bool:
    """Tell if a pane is neither black nor rviz's background nor the magenta image."""
    unlike = [np.abs(picture - np.array(color)).max(axis=-1) > 10 for color in (MAGENTA, (0, 0, 0), BACKGROUND)]
    return bool(np.all(unlike, axis=0).mean() > 0.6)


def _is_magenta(picture: Picture) -> np.ndarray[Any, np.dtype[np.bool_]]:
    return np.abs(picture - np.array(MAGENTA)).max(axis=-1) < 10


def _shrunk(picture: Picture) -> Picture:
    image = Image.fromarray(picture.astype(np.uint8)).resize((WIDTH, HEIGHT), Image.Resampling.BOX)
    return np.asarray(image).astype(np.int16)


def _shown(kind: str, topic: str, **properties: Any) -> dict[str, Any]:
    return {"Class": f"rviz/{kind}", "Name": kind, "Image Topic": topic, **properties}


def _area_of(rviz: RealRviz, display: Display) -> Area:
    """Return the area of the screen where rviz shows a magenta image."""
    screen = rviz.picture(
        rviz_file([display], VIEW, has_docks=True), np.s_[:, :], lambda now: bool(_is_magenta(now).sum() > 3_000)
    )
    rows, columns = np.nonzero(_is_magenta(screen))
    return np.s_[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]


@pytest.fixture(scope="module")
def panes(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Panes]:
    with running_graph() as graph, pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_PACKAGE_PATH", str(MESHES))
        publish(graph, MESSAGES)
        rviz = RealRviz(tmp_path_factory.mktemp("rviz"), graph, packages=MESHES, remappings=REMAPPINGS)
        browser_page = chromium.new_page(viewport={"width": 900, "height": 700})
        address = GraphAddress(master_uri=graph.core.uri)
        session = Session(title="pictures", kind="graph")
        try:
            with PageServer.start(session, at=PageAddress(port=0), graph=address) as server:
                pair = Pair(graph, rviz, browser_page, server)
                image, camera = (
                    _area_of(rviz, display)
                    for display in (_shown("Image", "/images/empty"), _shown("Camera", "/unseen/image"))
                )
                yield Panes(pair, image, camera)
        finally:
            browser_page.close()
            rviz.close()


@pytest.mark.parametrize("name", CASES)
def test_images_have_rvizs_pixels(panes: Panes, name: str) -> None:
    topic, properties = CASES[name]
    shown = _shown("Image", topic, **properties)
    real, actual = panes.image(shown, shown)
    save_pair(f"Image {name}", real, actual)

    assert np.abs(real - actual).mean(axis=(0, 1)).max() <= 25.5
    assert np.abs(real - actual).max() <= 60, "edges of the shrunk picture differ more than its pixels may"


def test_a_compressed_image_looks_like_the_raw_one(panes: Panes) -> None:
    """Debian's rviz has no plugin for compressed images."""
    compressed = _shown("Image", "/images/png", **{"Transport Hint": "compressed"})
    real, actual = panes.image(_shown("Image", "/images/rgb8"), compressed)

    assert np.abs(real - actual).mean(axis=(0, 1)).max() <= 25.5


_MARKERS = [
    {"Class": "rviz/Marker", "Name": name, "Marker Topic": f"/seen/{name}", "Enabled": True, "Value": True}
    for name in ("cube", "sphere")
]


@pytest.mark.parametrize(
    "properties",
    [
        {},
        {"Image Rendering": "background"},
        {"Image Rendering": "overlay", "Overlay Alpha": 0.3},
        {"Zoom Factor": 2},
        {"Visibility": {"cube": False, "sphere": True, "Value": True}},
    ],
    ids=["both", "behind", "over", "zoomed", "without the cube"],
)
def test_the_scene_is_drawn_over_a_cameras_picture(panes: Panes, properties: Mapping[str, Any]) -> None:
    camera = _shown("Camera", "/camera/image", **properties)
    without = panes.camera([camera])
    end = time.monotonic() + PATIENCE_S
    while True:
        real, actual = panes.camera([*_MARKERS, camera])
        result = agreement(actual, without[1], real, without[0])
        if result or time.monotonic() > end:
            break
    save_pair("Camera " + "".join(map(str, properties.values())).replace("/", ""), real, actual)

    assert result, result


def test_a_camera_that_shows_more_than_rviz_is_detected(panes: Panes) -> None:
    """Shows that the comparison can fail."""
    all_of_it = _shown("Camera", "/camera/image")
    part = {**all_of_it, "Visibility": {"cube": False, "sphere": True, "Value": True}}
    empty = panes.camera([all_of_it])
    real, actual = panes.camera([*_MARKERS, part])[0], panes.camera([*_MARKERS, all_of_it])[1]

    assert not agreement(actual, empty[1], real, empty[0])
