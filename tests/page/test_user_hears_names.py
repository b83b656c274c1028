"""A user with a screen reader finds the scene's tools by role and name, and uses them by keys."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]

TOOLS = ("Interact", "Move", "Rotate", "Push", "Measure", "Insert", "More tools")
VIEW = ("Show in the view", "Split the view", "Record a video of the view")
SIDES = ("the front", "the back", "the left", "the right", "top", "bottom")
NAMELESS = """() => [...document.querySelectorAll(
    ".scene-overlay :is(button, [tabindex], input), .edge, svg[role=group] [tabindex]")]
    .filter((one) => one.checkVisibility() && !one.labels?.length)
    .filter((one) => !(one.getAttribute("aria-label") || one.textContent).trim())
    .map((one) => one.outerHTML)"""


@pytest.fixture(scope="module")
def user(chromium: Any) -> Iterator[WorldUser]:
    with running_page("run", "rp2w_at_home.world", "--pause", "--port", "0", environment={}) as url:
        user = WorldUser(chromium, url)
        user.page.set_viewport_size({"width": 1440, "height": 900})  # wide enough for other widths of the panels
        user.page.locator(".disc").wait_for()
        yield user
        user.close()


def _number(user: WorldUser, name: str) -> float:
    return float(user.property(name).input_value().replace("−", "-"))


def test_the_tools_are_a_tool_bar_and_tell_which_is_on(user: WorldUser) -> None:
    tools = user.page.get_by_role("toolbar", name="Tools")
    assert [one.get_attribute("aria-label") for one in tools.get_by_role("button").all()] == list(TOOLS)
    tools.get_by_role("button", name="Measure", exact=True).press("Enter")
    tools.get_by_role("button", name="Measure", exact=True, pressed=True).wait_for()
    user.page.get_by_role("status").filter(has_text="Click").first.wait_for()
    tools.get_by_role("button", name="Interact", exact=True).press("Enter")
    tools.get_by_role("button", name="Measure", exact=True, pressed=False).wait_for()
    view = user.page.get_by_role("group", name="View", exact=True)
    assert [one.get_attribute("aria-label") for one in view.get_by_role("button").all()] == list(VIEW)


def test_the_view_axes_and_the_keys_of_the_view_turn_the_camera(user: WorldUser) -> None:
    axes = user.page.get_by_role("group", name="View axes")
    for side in SIDES:
        assert axes.get_by_role("button", name=f"Look from {side}", exact=True).count() == 1
    user.side("Views")
    axes.get_by_role("button", name="Look from top", exact=True).press("Enter")
    user.until(lambda: _number(user, "Pitch [rad]") > 1.56, what="for the view from the top")
    axes.get_by_role("button", name="Look from the front", exact=True).press("Enter")
    user.until(lambda: abs(_number(user, "Pitch [rad]")) < 0.01, what="for the view from the front")
    user.page.get_by_role("application", name="3D view", exact=True).press("ArrowUp")
    user.until(lambda: abs(_number(user, "Pitch [rad]")) > 0.01, what="for a turn by the keyboard")


def test_the_disc_tells_its_velocities(user: WorldUser) -> None:
    disc = user.page.get_by_role("application", name=re.compile("^Drive: drag, or hold W A S D; "))
    assert disc.get_attribute("aria-label").endswith("stopped")
    disc.focus()
    user.page.keyboard.down("ArrowUp")
    user.page.get_by_role("application", name="0.50 m/s, 0.00 rad/s").wait_for()
    user.page.keyboard.up("ArrowUp")
    user.page.get_by_role("application", name=re.compile("stopped$")).wait_for()


def test_the_handles_of_panels_are_separators_with_a_width(user: WorldUser) -> None:
    for name, key, change in (
        ("Width of the left panel", "ArrowLeft", -8),
        ("Width of the right panel", "ArrowRight", -8),
        ("Height of the dock", "ArrowUp", 16),
    ):
        handle = user.page.get_by_role("separator", name=name, exact=True)
        before = float(handle.get_attribute("aria-valuenow"))
        handle.press(key)
        user.until(
            lambda handle=handle, before=before, change=change: (
                float(handle.get_attribute("aria-valuenow")) == pytest.approx(before + change, abs=1)
            ),
            what=f"for another {name}",
        )


def test_the_pose_is_moved_by_named_fields_instead_of_the_handles_in_the_scene(user: WorldUser) -> None:
    user.side("Inspector")
    user.pick("rp2w")
    pose = user.page.get_by_role("group", name="Pose in world", exact=True)
    pose.get_by_role("textbox").first.wait_for()
    names = ("x [m]", "roll [°]", "y [m]", "pitch [°]", "z [m]", "yaw [°]")
    assert [one.get_attribute("aria-label") for one in pose.get_by_role("textbox").all()] == list(names)
    field = pose.get_by_role("textbox", name="x [m]", exact=True)
    field.fill("0.5")
    field.press("Enter")
    user.until(lambda: abs(user.position("rp2w")[0] - 0.5) < 0.01, what="for the robot at 0.5 m")


def test_nothing_over_the_scene_is_without_a_name(user: WorldUser) -> None:
    assert user.page.evaluate(NAMELESS) == []
