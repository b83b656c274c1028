"""The page as seen and operated in a real browser."""

import io
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from trundle.viewer import (
    DrawnLine,
    Drive,
    Pause,
    Play,
    Request,
    Reset,
    SetFixedFrame,
    SetJoint,
    SetSpeed,
    Step,
    Viewer,
    ViewerScene,
    ViewerState,
)

pytestmark = [pytest.mark.browser, pytest.mark.slow]

Picture = NDArray[np.int16]
_PATIENCE_S = 60.0


def _scene(page: Any) -> Picture:
    """Return the three-dimensional part of the page, between the panels, (height, width, 3)."""
    png = page.screenshot(clip={"x": 310, "y": 0, "width": 560, "height": 1300})
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=np.int16)


def _blue(picture: Picture) -> NDArray[np.bool_]:
    return (picture[..., 2] > 120) & (picture[..., 0] < 60) & (picture[..., 1] < 60)


def _red(picture: Picture) -> NDArray[np.bool_]:
    """More red than anything else, as a translucent red hull over grey and blue is."""
    return (picture[..., 0] > picture[..., 1] + 60) & (picture[..., 0] > 100)


def _eventually(page: Any, look: Callable[[Picture], bool]) -> Picture:
    """Take pictures of the page until a condition holds."""
    deadline = time.monotonic() + _PATIENCE_S
    while True:
        picture = _scene(page)
        if look(picture):
            return picture
        assert time.monotonic() < deadline, "the page never looked as it should"
        page.wait_for_timeout(100)


def _requests(page: Any, viewer: Viewer, *, count: int = 1) -> list[Request]:
    """Poll until so many requests have come."""
    deadline = time.monotonic() + _PATIENCE_S
    requests: list[Request] = []
    while len(requests) < count and time.monotonic() < deadline:
        requests += viewer.requests()
        page.wait_for_timeout(50)
    return requests


def test_the_robot_is_seen_in_its_colours_on_a_ground(page: Any) -> None:
    picture = _eventually(page, lambda picture: _blue(picture).sum() > 5000)

    rows, columns = np.nonzero(_blue(picture))
    assert 250 < rows.mean() < 1050  # the camera frames it
    assert 100 < columns.mean() < 460
    assert (picture.min(axis=2) > 180).sum() > 100_000  # a light ground


def test_a_body_that_moves_moves_on_the_screen(
    page: Any, viewer: Viewer, car_state: Callable[..., ViewerState]
) -> None:
    before = np.nonzero(_blue(_eventually(page, lambda picture: _blue(picture).sum() > 5000)))[1].mean()

    viewer.show(car_state(0.2, y=0.2, time_s=2.0))  # to the right as the camera stands

    _eventually(page, lambda picture: bool(np.nonzero(_blue(picture))[1].mean() > before + 40))
    page.wait_for_selector("text=2.00 s")


def test_a_body_without_a_pose_is_not_drawn(page: Any, viewer: Viewer, car_state: Callable[..., ViewerState]) -> None:
    _eventually(page, lambda picture: _blue(picture).sum() > 5000)
    state = car_state(time_s=2.0)
    state.body_poses[1] = np.nan

    viewer.show(state)

    _eventually(page, lambda picture: _blue(picture).sum() == 0)


def test_lines_are_drawn_and_go(page: Any, viewer: Viewer, car_state: Callable[..., ViewerState]) -> None:
    _eventually(page, lambda picture: _blue(picture).sum() > 5000)
    points = np.array([[0.0, y / 100, 0.5] for y in range(-30, 31)], dtype=np.float32)

    viewer.show(car_state(time_s=2.0, lines=(DrawnLine(points, (255, 0, 0)),)))
    _eventually(page, lambda picture: _red(picture).sum() > 100)
    viewer.show(car_state(time_s=3.0))

    _eventually(page, lambda picture: _red(picture).sum() == 0)


def test_time_controls_ask_the_owner(page: Any, viewer: Viewer) -> None:
    for label in ("Pause", "Step", "Play"):
        page.get_by_role("button", name=label, exact=True).click()
    page.get_by_role("button", name="Reset", exact=True).first.click()

    assert _requests(page, viewer, count=4) == [Pause(), Step(), Play(), Reset()]


def test_the_speed_menu_asks_for_a_pace(page: Any, viewer: Viewer) -> None:
    page.get_by_role("combobox", name="Speed").click()
    page.get_by_role("option", name="max").click()

    assert _requests(page, viewer) == [SetSpeed(float("inf"))]


def test_the_pad_drives_and_stops(page: Any, viewer: Viewer) -> None:
    for label in ("Forward", "Left", "Stop", "Back"):
        page.get_by_role("button", name=label, exact=True).click()

    assert _requests(page, viewer, count=4) == [Drive(0.5, 0.0), Drive(0.5, 0.5), Drive(0.0, 0.0), Drive(-0.5, 0.0)]


def test_keys_drive_and_stop(page: Any, viewer: Viewer) -> None:
    page.mouse.click(250, 900)
    for key in "ijkx":
        page.keyboard.press(key)

    assert _requests(page, viewer, count=4) == [Drive(0.5, 0.0), Drive(0.5, 0.5), Drive(-0.5, 0.0), Drive(0.0, 0.0)]


def test_a_slider_moves_its_joint(page: Any, viewer: Viewer) -> None:
    slider = page.get_by_role("slider").last
    slider.focus()
    slider.press("End")

    assert _requests(page, viewer) == [SetJoint("left_wheel_joint", 3.0)]


def test_a_slider_shows_its_joint_and_asks_nothing(
    page: Any, viewer: Viewer, car_state: Callable[..., ViewerState]
) -> None:
    viewer.show(car_state(time_s=2.0, joint_positions=np.array([1.5])))

    page.wait_for_selector("[role=slider][aria-valuenow='1.5']")
    assert viewer.requests() == []


def test_camera_images_appear_in_the_panel_and_in_the_scene(
    page: Any, viewer: Viewer, car_state: Callable[..., ViewerState]
) -> None:
    viewer.show(car_state(-0.4, y=-0.4, time_s=2.0))  # the frustum comes to the middle
    rgb = np.zeros((240, 320, 3), dtype=np.uint8)
    rgb[:] = (240, 10, 10)
    assert _red(_scene(page)).sum() == 0

    viewer.image(0, rgb)

    page.wait_for_selector("img[src^='blob:']")
    _eventually(page, lambda picture: _red(picture).sum() > 300)


def test_the_fixed_frame_stays_where_the_page_looks(
    page: Any, viewer: Viewer, car_state: Callable[..., ViewerState]
) -> None:
    viewer.show(car_state(30.0, time_s=2.0))
    _eventually(page, lambda picture: _blue(picture).sum() == 0)  # driven out of the picture

    page.get_by_role("combobox", name="Fixed frame").click()
    page.get_by_role("option", name="base_link").click()

    _eventually(page, lambda picture: _blue(picture).sum() > 5000)
    assert _requests(page, viewer) == [SetFixedFrame("base_link")]


def test_a_fixed_frame_without_a_pose_is_named(
    page: Any, viewer: Viewer, car_state: Callable[..., ViewerState]
) -> None:
    page.get_by_role("combobox", name="Fixed frame").click()
    page.get_by_role("option", name="left_wheel").click()
    state = car_state(time_s=2.0)
    assert state.frame_poses is not None
    state.frame_poses[1] = np.nan

    viewer.show(state)

    page.wait_for_selector("text=Fixed Frame [left_wheel] does not exist")


def test_collision_shapes_are_drawn_when_asked_for(page: Any) -> None:
    assert _red(_scene(page)).sum() == 0

    page.get_by_text("Collisions", exact=True).click()

    _eventually(page, lambda picture: _red(picture).sum() > 5000)


def test_following_keeps_the_robot_in_the_picture(
    page: Any, viewer: Viewer, car_state: Callable[..., ViewerState]
) -> None:
    before = np.nonzero(_blue(_eventually(page, lambda picture: _blue(picture).sum() > 5000)))[1].mean()
    page.get_by_text("Follow robot", exact=True).click()
    page.wait_for_timeout(500)

    viewer.show(car_state(30.0, time_s=2.0))
    page.wait_for_selector("text=2.00 s")

    after = np.nonzero(_blue(_eventually(page, lambda picture: _blue(picture).sum() > 5000)))[1].mean()
    assert after == pytest.approx(before, abs=5)


def test_another_scene_replaces_the_first_on_the_same_page(
    page: Any, viewer: Viewer, car_scene: Callable[..., ViewerScene], car_state: Callable[..., ViewerState]
) -> None:
    viewer.replace(car_scene(title="another", cameras=(), joints=()), state=car_state(time_s=5.0, joint_positions=None))

    page.wait_for_selector("text=another")
    page.wait_for_selector("text=5.00 s")
    assert page.get_by_text("left_wheel_joint").count() == 0
    assert page.get_by_text("Cameras", exact=True).count() == 0
    _eventually(page, lambda picture: _blue(picture).sum() > 5000)


def test_a_warning_of_the_owner_is_shown_as_text(
    page: Any, viewer: Viewer, car_state: Callable[..., ViewerState]
) -> None:
    viewer.show(car_state(time_s=2.0, status=("No transform from [<b>] to [odom]",)))

    page.wait_for_selector("text=No transform from [<b>] to [odom]")
