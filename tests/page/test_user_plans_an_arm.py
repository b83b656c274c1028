"""A user of the panel MotionPlanning drags an arm's tip, plans, executes, and puts an object into the scene."""

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage
from tests.page.axe import assert_accessible, load_axe, needs_axe
from tests.page.built_client import needs_client
from tests.page.panel_user import PATIENCE_MS, PanelUser
from tests.system.browser import running_page

pytestmark = [needs_client, pytest.mark.slow]

JOINTS = ("base", "shoulder", "elbow", "roll", "wrist", "hand")
_PHONE = (390, 844)


class ArmUser(PanelUser):
    """Reads the panel MotionPlanning, and drags the handles at the arm's tip."""

    @property
    def status(self) -> str:
        return self.page.locator(".armstatus").get_by_role("status").inner_text()

    @property
    def alert(self) -> str:
        alerts = self.page.locator(".armstatus").get_by_role("alert")
        return alerts.inner_text() if alerts.count() else ""

    def section(self, name: str) -> None:
        self.page.locator(".motionplanning").get_by_role("tab", name=name, exact=True).click()

    def choose(self, label: str, option: str) -> None:
        self.page.get_by_label(label, exact=True).select_option(option)

    def chosen(self, label: str) -> str:
        return str(self.page.get_by_label(label, exact=True).input_value())

    def number(self, label: str) -> Any:
        """Return a field for a number, whose name begins with a label."""
        return self.page.locator(f'.motionplanning input[aria-label^="{label} ["]')

    def joints(self, state: str) -> list[float]:
        """Return the joints of a state in the section Joints [rad]."""
        self.section("Joints")
        self.button(state).click()
        fields = [self.number(joint).input_value() for joint in JOINTS]
        return [float(text.replace("−", "-")) for text in fields]

    def arrow(self) -> tuple[float, float]:
        """Return the middle of the largest green part of the view, which is an arrow along y or its ring [px]."""
        red, green, blue = self._view().transpose(2, 0, 1)
        green_parts = ndimage.label((green > 90) & (red < 60) & (blue < 60))
        labels, count = cast("tuple[NDArray[np.int32], int]", green_parts)
        assert count > 0, "no green handle in the view"
        sizes = ndimage.sum_labels(np.ones_like(labels), labels, range(1, count + 1))
        rows, columns = np.nonzero(labels == 1 + int(np.argmax(sizes)))
        middle = len(rows) // 2
        return float(columns[middle]), float(rows[middle])

    def still_arrow(self) -> tuple[float, float]:
        """Return `arrow` once the view has come to rest: it moves while a panel opens."""
        self.until(self.has_handles, what="for the handles at the tip")
        self.until_still(self.arrow)
        return self.arrow()

    def has_handles(self) -> bool:
        red, green, blue = self._view().transpose(2, 0, 1)
        return int(((green > 90) & (red < 60) & (blue < 60)).sum()) > 200

    def _view(self) -> Any:
        """Return the picture of the page above dock or sheet, in pixels of the page."""
        shown = Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")
        size = self.page.viewport_size
        picture = np.asarray(shown.resize((size["width"], size["height"]))).astype(int)
        picture[:60] = 0
        edge = self.page.locator(".armstatus").locator("xpath=ancestor::section[1]").bounding_box()
        picture[int(edge["y"]) :] = 0
        picture[:, size["width"] - 90 :] = 0  # the view's axes
        return picture


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("arm")
    environment = {"ROS_MASTER_URI": "", "HOME": str(folder)}
    words = ("launch", "arm_moveit_config", "demo.launch", "--view-port", "0", "--port", "0")
    with running_page(*words, environment=environment, folder=folder) as url:
        yield url


@pytest.fixture(scope="module")
def user(chromium: Any, address: str) -> Iterator[ArmUser]:
    user = ArmUser(chromium, address)
    user.sees("Drag the arm")  # the panel opens by itself, since move_group runs
    yield user
    assert user.faults == []
    user.close()


def test_the_configurations_file_is_shown_whole(user: ArmUser) -> None:
    user.page.get_by_role("treeitem").filter(has_text="MotionPlanning").first.wait_for()
    assert user.page.get_by_text("not supported").count() == 0
    user.until(lambda: user.chosen("Planning Group") == "arm", what="for the group")


def test_a_named_goal_is_planned_and_executed(user: ArmUser) -> None:
    user.type("Velocity Scaling", "1")
    user.choose("Goal State", "home")
    user.button("Plan").click()
    user.until(lambda: user.status.startswith("Planned in"), what="for a path")
    user.sees("Waypoint")
    user.button("Execute").click()
    user.until(lambda: user.status.startswith("Executed."), what="for the motion")
    goal = user.joints("Goal State")
    assert goal == pytest.approx([0.0] * 6, abs=1e-3)
    user.until(lambda: np.allclose(user.joints("Start State"), goal, atol=0.02), what="for the robot at its goal")
    user.section("Planning")


def test_a_dragged_tip_is_reached_by_the_arm(user: ArmUser) -> None:
    user.choose("Goal State", "ready")
    user.button("Plan & Execute").click()
    user.until(lambda: "and executed" in user.status, what="for a posture that can move in all directions")
    before = user.joints("Goal State")
    assert before[2] == pytest.approx(1.8, abs=1e-3)
    user.section("Planning")
    x, y = user.still_arrow()
    user.page.mouse.move(x, y)
    user.page.mouse.down()
    for step in range(1, 11):
        user.page.mouse.move(x + 4 * step, y)
        user.page.wait_for_timeout(50)
    user.page.mouse.up()
    user.until(lambda: user.chosen("Goal State") == "by hand", what="for the pose of the drag")
    user.button("Plan").click()
    user.until(lambda: user.status.startswith("Planned in") and "points" in user.status, what="for a path")
    user.button("Execute").click()
    user.until(lambda: user.status.startswith("Executed."), what="for the motion")
    goal = user.joints("Goal State")
    assert not np.allclose(goal, before, atol=0.01)
    user.until(lambda: np.allclose(user.joints("Start State"), goal, atol=0.02), what="for the robot at the tip's pose")
    user.section("Planning")


def test_an_object_in_the_arm_is_a_collision_that_is_named(user: ArmUser, tmp_path: Path) -> None:
    user.section("Scene Objects")
    user.button("Add an object").click()
    user.page.get_by_role("menuitem", name="Box", exact=True).click()
    for part, value in (("x", "0"), ("z", "0.5")):
        user.number(part).first.fill(value)
        user.number(part).first.press("Enter")
    user.sees("1 change, not published")
    user.button("Publish").click()
    user.until(lambda: user.status.startswith("The scene is published"), what="for move_group")
    user.until(lambda: "The goal is in collision: " in user.alert and "box" in user.alert, what="for the collision")
    with user.page.expect_download() as download:
        user.button("Export").click()
    download.value.save_as(tmp_path / "planning.scene")
    assert "* box\n0 0 0.5\n" in (tmp_path / "planning.scene").read_text()
    user.button("Plan").click()
    user.until(lambda: "IN_COLLISION" in user.status or "FAILED" in user.status, what="for the reason")
    user.page.locator(".motionplanning").get_by_role("button", name="Remove", exact=True).click()
    user.button("Publish").click()
    user.until(lambda: "in collision" not in user.alert, what="for the free goal")
    user.section("Planning")


@needs_axe
def test_every_section_is_accessible(user: ArmUser) -> None:
    load_axe(user.page)
    for section in ("Joints", "Scene Objects", "Context", "Planning"):
        user.section(section)
        assert_accessible(user.page, section)
    user.section("Scene Objects")
    user.button("Add an object").click()
    user.page.get_by_role("menuitem", name="Sphere", exact=True).click()
    user.sees("1 change, not published")
    assert_accessible(user.page, "an object")
    user.button("Discard").click()


def test_the_arm_is_dragged_with_a_finger(chromium: Any, address: str) -> None:
    context = chromium.new_context(viewport={"width": _PHONE[0], "height": _PHONE[1]}, has_touch=True, is_mobile=True)
    user = ArmUser.__new__(ArmUser)
    user.page, user.faults = context.new_page(), []
    user.page.set_default_timeout(PATIENCE_MS)
    user.page.on("pageerror", lambda error: user.faults.append(str(error)))
    user.page.goto(address)
    user.page.get_by_role("navigation").get_by_role("button", name="Arm", exact=True).click()
    x, y = user.still_arrow()
    drag = user.page.get_by_role("button", name="Drag the arm")
    assert drag.get_attribute("aria-pressed") == "true"
    touch = context.new_cdp_session(user.page)
    for kind, step in (("touchStart", 0), *(("touchMove", step) for step in range(1, 11)), ("touchEnd", 10)):
        points = [] if kind == "touchEnd" else [{"x": x + 4 * step, "y": y}]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        user.page.wait_for_timeout(50)
    user.until(lambda: user.chosen("Goal State") == "by hand", what="for the pose of the finger")
    assert user.faults == []
    context.close()
