"""A user edits a running world and its time; the simulation's state is read over the page's protocol."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from tests.page.built_client import needs_client
from tests.page.scene_user import VIEW_CANVAS
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

pytestmark = [needs_client, pytest.mark.slow]
BOX = "<geometry><box><size>0.4 0.4 0.4</size></box></geometry>"
SHAPE = f"""<collision name="c">{BOX}</collision><visual name="v">{BOX}
<material><diffuse>0.2 0.6 0.2 1</diffuse></material></visual>"""
ARM = f"""<link name="arm"><pose>0.8 0 0 0 0 0</pose>{SHAPE}</link><joint name="slide" type="prismatic">
<parent>base</parent><child>arm</child><axis><xyz>1 0 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>
</joint>"""
WORLD = f"""<sdf version="1.6"><world name="yard"><gravity>0 0 0</gravity>
<physics type="ode"><max_step_size>0.01</max_step_size></physics>
<model name="raft"><pose>-1 0.8 0.2 0 0 0</pose><link name="base">{SHAPE}</link></model>
<model name="crane"><pose>-1 -0.8 0.2 0 0 0</pose><link name="base"><inertial><mass>1000</mass></inertial>{SHAPE}</link>
{ARM}</model></world></sdf>"""


@pytest.fixture(scope="module")
def user(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[WorldUser]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0")
    with running_page(*words, environment={"HOME": str(folder)}, folder=folder) as url:
        user = WorldUser(chromium, url)
        user.look_down()
        yield user
        user.close()


def _now(user: WorldUser) -> float:
    return user.state["time_ns"] / 1e9


def _choose(user: WorldUser, command: str) -> None:
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("Control+k")
    user.page.get_by_role("combobox", name="Search commands").fill(command)
    user.page.keyboard.press("Enter")


def _in_dialog(user: WorldUser, field: str, value: str, button: str) -> None:
    """Type into the dialog of steps and times, and press a button in it."""
    _choose(user, "Go to a time, or take several steps")
    dialog = user.page.get_by_role("dialog", name="Steps and times")
    dialog.get_by_role("textbox", name=field, exact=True).fill(value)
    user.page.keyboard.press("Tab")
    dialog.get_by_role("button", name=button, exact=True).click()


def test_several_steps_run_to_a_time_and_seek_back(user: WorldUser) -> None:
    before = _now(user)
    _in_dialog(user, "Steps", "25", "Step")
    user.until(lambda: _now(user) == pytest.approx(before + 0.25))
    _in_dialog(user, "Time [s]", "3.5", "Go")
    user.until(lambda: _now(user) == pytest.approx(3.5))
    assert user.is_paused
    _in_dialog(user, "Time [s]", "1.2", "Go")
    user.until(lambda: _now(user) == pytest.approx(1.2))
    _in_dialog(user, "Time [s]", "90000", "Go")
    user.page.get_by_role("alert").get_by_text("90000.000 s is not ahead").wait_for()
    user.page.keyboard.press("Escape")


def test_a_velocity_is_typed_and_one_model_reset(user: WorldUser) -> None:
    """The raft floats a metre along x and is reset; the crane, which was moved, too, keeps its pose."""
    user.pick("crane")
    user.type("x [m]", "-0.5")
    user.until(lambda: user.position("crane")[0] == pytest.approx(-0.5))
    user.pick("raft")
    user.type("linear x [m/s]", "1")
    _in_dialog(user, "Steps", "100", "Step")
    user.until(lambda: user.position("raft")[0] == pytest.approx(0.0, abs=0.02), what="for a metre")
    _choose(user, "Reset the selected model only")
    user.until(lambda: user.position("raft") == pytest.approx((-1, 0.8, 0.2), abs=1e-4))
    _in_dialog(user, "Steps", "50", "Step")
    user.until_still(lambda: _now(user))
    assert user.position("raft") == pytest.approx((-1, 0.8, 0.2), abs=1e-4), "it is at rest"
    assert user.position("crane")[0] == pytest.approx(-0.5)


def test_a_reset_of_a_model_is_undone_and_redone(user: WorldUser) -> None:
    """Undo restores pose, joint, velocity and motor command: it drifts and slides on as before."""
    user.pick("crane")
    user.type("linear y [m/s]", "0.5")
    user.page.get_by_role("searchbox", name="Search the world").fill("slide")
    user.pick("slide")
    user.type("target velocity [m/s]", "0.4")
    _in_dialog(user, "Steps", "50", "Step")
    user.until_still(lambda: _now(user))
    base, arm = user.position("crane"), user.position("crane", 1)
    user.page.get_by_role("searchbox", name="Search the world").fill("")
    user.page.get_by_role("treeitem").filter(has_text="crane").first.click(button="right")
    user.page.locator('.menu [data-title="Reset this model"]').click()
    user.until(lambda: user.position("crane") == pytest.approx((-1, -0.8, 0.2), abs=1e-6))
    user.button("Undo: Reset of crane").click()
    user.until(lambda: user.position("crane") == pytest.approx(base, abs=1e-6))
    assert user.position("crane", 1) == pytest.approx(arm, abs=1e-6)
    _in_dialog(user, "Steps", "10", "Step")
    user.until(lambda: user.position("crane")[1] == pytest.approx(base[1] + 0.05, abs=1e-3))
    assert user.position("crane", 1)[0] - arm[0] == pytest.approx(0.04, abs=2e-3)
    user.page.keyboard.press("Control+Shift+Z")
    user.until(lambda: user.position("crane") == pytest.approx((-1, -0.8, 0.2), abs=1e-6))
    user.button("Undo: Reset of crane").click()
    user.until(lambda: user.position("crane")[1] > base[1])


def _reset(user: WorldUser, model: str) -> None:
    user.page.get_by_role("treeitem").filter(has_text=model).first.click(button="right")
    user.page.locator('.menu [data-title="Reset this model"]').click()
    user.button(f"Undo: Reset of {model}").wait_for()


def test_a_typed_torque_turns_a_body_for_its_duration(user: WorldUser) -> None:
    """2 N·m on 1 kg·m² for half a second: 0.25 rad, then 1 rad/s for another half second."""
    _reset(user, "raft")
    user.page.get_by_role("treeitem").filter(has_text="raft").first.click(button="right")
    user.page.locator('.menu [data-title="Apply force or torque…"]').click()
    user.field("duration [s]").fill("0.5")
    user.type("torque z", "2")
    _in_dialog(user, "Steps", "100", "Step")

    def turned() -> float:
        pose = user.pose("raft")
        assert pose is not None
        return 2.0 * math.atan2(pose[5], pose[6])

    user.until(lambda: turned() == pytest.approx(0.75, abs=0.03), what=f"for a turn, not {turned()}")


def test_the_timeline_shows_contacts_of_models(user: WorldUser) -> None:
    """The raft drifts 1.2 m into the crane, at 1 m/s."""
    user.open("Timeline")
    user.page.get_by_role("group", name="Contacts", exact=True).wait_for()
    for model in ("crane", "raft"):
        _reset(user, model)
    user.pick("raft")
    user.type("linear y [m/s]", "-1")
    began = _now(user)
    bar = user.page.get_by_role("banner")
    bar.get_by_role("button", name="Play", exact=True).click()
    lane = user.page.get_by_role("group", name="crane · raft")
    lane.locator(".band").first.wait_for(state="attached")
    bar.get_by_role("button", name="Pause", exact=True).click()
    user.until(lambda: user.is_paused)
    head = user.page.get_by_role("slider", name="Time")
    start, end = (float(head.get_attribute(f"aria-value{edge}")) for edge in ("min", "max"))
    share = float(lane.locator(".band").first.evaluate("band => parseFloat(band.style.left)")) / 100
    touched = start + share * (end - start)
    assert began + 1.1 < touched < began + 2.0
    user.page.get_by_role("group", name="Contacts", exact=True).wait_for(state="detached")
    user.open("Plots")


@pytest.mark.parametrize(("target", "value"), [("position [m]", "0.5"), ("velocity [m/s]", "0.4"), ("effort [N]", "2")])
def test_a_joints_target_is_typed(user: WorldUser, target: str, value: str) -> None:
    user.pick("crane")
    _choose(user, "Reset the selected model only")
    user.until(lambda: user.position("crane", 1)[0] == pytest.approx(-0.2, abs=1e-3))
    user.page.get_by_role("searchbox", name="Search the world").fill("slide")
    user.pick("slide")
    user.type(f"target {target}", value)
    _in_dialog(user, "Steps", "50", "Step")
    user.until(lambda: user.position("crane", 1)[0] > -0.1, what=f"{user.position('crane', 1)}")
    user.page.get_by_role("searchbox", name="Search the world").fill("")


_FITS = """rows => rows.map((row) => {
    const [name, fields] = [...row.children].map((each) => {
        const range = document.createRange();
        range.selectNodeContents(each);
        return range.getBoundingClientRect();
    });
    return name.right <= fields.left && fields.right <= row.getBoundingClientRect().right + 0.5;
})"""


@pytest.mark.parametrize("size", [(1440, 900), (1280, 760)])
def test_rows_of_three_numbers_fit_next_to_their_name(user: WorldUser, size: tuple[int, int]) -> None:
    user.page.set_viewport_size({"width": size[0], "height": size[1]})
    user.pick("yard")
    user.field("gravity x").wait_for()
    rows = user.page.locator("aside .kv.numbers")
    user.until(lambda: rows.evaluate_all(_FITS) == [True] * 3, what="for gravity, wind and time step to fit")


def test_wind_and_time_step_are_typed_and_undone(user: WorldUser) -> None:
    user.pick("yard")
    user.type("wind y", "4.5")
    user.until(lambda: user.manifest()["physics"]["wind"] == [0.0, 4.5, 0.0])
    user.type("time step [ms]", "5")
    user.until(lambda: user.manifest()["physics"]["step"] == 0.005)
    before = _now(user)
    user.button("Step 1").click()
    user.until(lambda: _now(user) == pytest.approx(before + 0.005))
    for _ in range(2):
        user.button("Undo: Time step").or_(user.button("Undo: Wind")).click()
    user.until(lambda: user.manifest()["physics"]["wind"] == [0.0, 0.0, 0.0])
    user.until(lambda: user.manifest()["physics"]["step"] == 0.01)


def test_slow_motion_slows_the_simulation_down(user: WorldUser) -> None:
    """In four seconds of wall time, a few tenths of a second are simulated."""
    _choose(user, "Speed 0.1×")
    user.until(lambda: user.state["speed"] == 0.1)
    before = _now(user)
    user.button("Play").click()
    user.page.wait_for_timeout(4000)
    user.page.get_by_role("banner").get_by_role("button", name="Pause", exact=True).click()
    user.until(lambda: user.is_paused)
    user.until_still(lambda: _now(user))
    assert 0.0 < _now(user) - before < 4.0
    _choose(user, "Speed 1×")


def test_a_bookmark_keeps_its_note_and_seeks_back(user: WorldUser) -> None:
    user.open("Timeline")
    marked = _now(user)
    user.button("Mark").click()
    note = user.page.locator(".mark-flag").get_by_role("textbox")
    note.fill("it turns here")
    note.press("Enter")
    _in_dialog(user, "Steps", "30", "Step")
    user.until(lambda: _now(user) == pytest.approx(marked + 0.3))
    user.page.locator(".mark-flag").click()
    user.until(lambda: _now(user) == pytest.approx(marked, abs=0.011))
    assert note.input_value() == "it turns here"


def test_the_object_under_the_pointer_is_outlined(user: WorldUser) -> None:
    """The raft has an outline while the pointer is over it."""
    _reset(user, "raft")
    _choose(user, "Clear the selection")
    user.page.mouse.move(*user.at((1.5, -1.2)))
    user.until_still(lambda: user.picture().tobytes())
    before = user.picture()
    user.page.mouse.move(*user.at((-1.0, 0.8)))
    around = np.s_[40:100, 120:180]  # a pixel is a centimetre, from x = −2.5 and y = 1.5
    user.until(lambda: bool((user.picture() != before)[around].any(axis=-1).sum() > 50), what="for an outline")
    user.page.mouse.move(*user.at((1.5, -1.2)))
    user.until(lambda: bool((user.picture() == before).all()), what="for it to go")
