"""A user moves, turns, snaps, undoes, pulls and holds models in the 3D view; the simulation's state is checked."""

import math
from collections.abc import Iterator
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.scene_user import VIEW_CANVAS
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]


def _box(name: str, pose: str, size: str, inside: str = "", *, static: bool = False) -> str:
    """Return a model of a box with a collision and a visual."""
    shape = f"<geometry><box><size>{size}</size></box></geometry>"
    link = f'<link name="base"><collision name="c">{shape}</collision><visual name="v">{shape}</visual></link>'
    return f'<model name="{name}"><static>{int(static)}</static><pose>{pose}</pose>{link}{inside}</model>'


_FLAP = """<link name="flap"><pose>0 0.5 0.1 0 0 0</pose><visual name="v"><geometry><box><size>0.2 0.4 0.1</size></box>
</geometry></visual></link><joint name="hinge" type="revolute"><parent>base</parent><child>flap</child>
<axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper><effort>9</effort></limit></axis></joint>"""
WORLD = f"""<sdf version="1.6"><world name="yard"><light name="lamp" type="point"><pose>0.5 -1 3 0 0 0</pose></light>
{_box("floor", "0 0 -0.1 0 0 0", "20 20 0.2", static=True)}{_box("table", "0 1 0.25 0 0 0", "0.8 0.8 0.5", static=True)}
{_box("crate", "-1 0 0.2 0 0 0", "0.4 0.4 0.4")}{_box("gate", "1.5 0 0.2 0 0 0", "0.4 0.4 0.4", _FLAP)}</world></sdf>"""


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


def near(a: tuple[float, ...], b: tuple[float, ...], within: float = 0.03) -> bool:
    return math.dist(a, b) < within


def test_an_arrow_moves_a_model_and_undo_moves_it_back(user: WorldUser) -> None:
    """Time is paused; the arrow along x is 1.1 m long in a picture with a pixel per centimetre."""
    user.pick("crate")
    user.tool("Move")
    user.drag((-0.2, 0), (-0.2, 0.3), (0.4, 0.3))
    user.until(lambda: near(user.position("crate"), (-0.4, 0, 0.2)), what=f"at {user.position('crate')}")
    user.button("Undo: Pose of crate").click()
    user.until(lambda: near(user.position("crate"), (-1, 0, 0.2)))
    user.button("Redo: Pose of crate").click()
    user.until(lambda: near(user.position("crate"), (-0.4, 0, 0.2)))
    user.button("Undo: Pose of crate").click()
    user.until(lambda: near(user.position("crate"), (-1, 0, 0.2)))


def test_control_snaps_to_the_grid(user: WorldUser) -> None:
    user.page.keyboard.down("Control")
    user.drag((-0.2, 0), (0.43, 0))
    user.page.keyboard.up("Control")
    user.until(lambda: near(user.position("crate"), (-0.4, 0, 0.2), within=1e-4))
    user.button("Undo: Pose of crate").click()
    user.until(lambda: near(user.position("crate"), (-1, 0, 0.2)))


def test_shift_places_a_model_on_the_surface_under_the_pointer(user: WorldUser) -> None:
    """The model itself is dragged, without a handle."""
    user.page.keyboard.down("Shift")
    user.drag((-1.15, -0.15), (0.2, 1.1))
    user.page.keyboard.up("Shift")
    user.until(
        lambda: near(user.position("crate"), (0.2, 1.1, 0.7)), what=f"on the table, not {user.position('crate')}"
    )
    user.button("Undo: Pose of crate").click()
    user.until(lambda: near(user.position("crate"), (-1, 0, 0.2)))


def _yaw(pose: tuple[float, ...] | None) -> float:
    assert pose is not None
    return 2 * math.atan2(pose[5], pose[6])


def test_a_ring_turns_a_model(user: WorldUser) -> None:
    """With Control it turns in steps, by a quarter; its position is unchanged."""
    user.tool("Rotate")
    user.page.keyboard.down("Control")
    user.drag((-0.34, 0.66), (-1, 0.94), (-1.64, 0.68))
    user.page.keyboard.up("Control")
    user.until(lambda: abs(_yaw(user.pose("crate")) - math.pi / 2) < 1e-3)
    assert near(user.position("crate"), (-1, 0, 0.2))


def test_a_joint_has_a_ring_about_its_axis(user: WorldUser) -> None:
    """It sets the position while paused, up to the joint's limit of a radian."""
    user.pick("hinge")
    user.drag((1.5 + 0.935, 0.5), (1.5 + 0.66, 1.16))
    user.until(lambda: abs(_yaw(user.pose("gate", 1)) - math.pi / 4) < 0.03, what=f"{user.pose('gate', 1)}")
    user.page.get_by_text("0.79 rad").first.wait_for()  # shown at 10 Hz, and restored by undo
    user.drag((1.5 + 0.66, 1.16), (1.5 - 0.66, 1.16))
    user.until(lambda: abs(_yaw(user.pose("gate", 1)) - 1) < 1e-3)
    user.button("Undo: Joint hinge").click()
    user.until(lambda: abs(_yaw(user.pose("gate", 1)) - math.pi / 4) < 0.03)


def test_a_light_is_moved(user: WorldUser) -> None:
    user.tool("Move")
    user.pick("lamp")
    user.drag((1.2, -1), (0.7, -1))
    user.until(lambda: near(user.manifest()["lights"][0]["pose"][:3], (0, -1, 3)))


def test_a_model_dragged_while_time_runs_stays_at_the_pointer(user: WorldUser) -> None:
    """Beyond the table's edge it falls only after it is released."""
    user.pick("crate")
    user.page.get_by_role("banner").get_by_role("button", name="Play", exact=True).click()
    user.page.keyboard.down("Shift")
    user.page.mouse.move(*user.at((-1.15, -0.15)))
    user.page.mouse.down()
    user.page.mouse.move(*user.at((0.35, 0.7)), steps=5)
    user.until(lambda: near(user.position("crate"), (0.35, 0.7, 0.7)))
    user.page.wait_for_timeout(1500)
    assert near(user.position("crate"), (0.35, 0.7, 0.7))
    user.page.keyboard.up("Shift")
    user.page.mouse.move(*user.at((1.2, -1.0)), steps=5)
    user.until(lambda: near(user.position("crate"), (1.35, -0.85, 0.2), within=0.05), what=f"{user.position('crate')}")
    user.page.mouse.up()
    user.page.get_by_role("banner").get_by_role("button", name="Pause", exact=True).click()
    user.button("Undo: Pose of crate").click()
    user.until(lambda: near(user.position("crate"), (-1, 0, 0.2)))


def test_a_pull_drags_a_model_along_while_time_runs(user: WorldUser) -> None:
    """The tool Push pulls by a spring; a drag with Control does the same with Interact."""
    user.tool("Push")
    user.page.get_by_role("banner").get_by_role("button", name="Play", exact=True).click()
    for tool, direction in (("Push", 1.0), ("Interact", -1.0)):
        user.tool(tool)
        x, y, _ = user.position("crate")
        if tool == "Interact":
            user.page.keyboard.down("Control")
        user.page.mouse.move(*user.at((x, y)))
        user.page.mouse.down()
        user.page.mouse.move(*user.at((x, y - direction)), steps=3)
        user.until(
            lambda y=y, direction=direction: (y - user.position("crate")[1]) * direction > 0.3, what=f"pulled by {tool}"
        )
        user.until_at_rest("crate")  # at the pointer: a model released while moving would slide out of the picture
        user.page.mouse.up()
        user.page.keyboard.up("Control")


def test_a_typed_force_acts_for_a_time(user: WorldUser) -> None:
    """50 N for 0.2 s move a mass of 1 kg on the ground."""
    user.pick("crate")
    user.page.get_by_role("treeitem").filter(has_text="crate").first.press("ArrowRight")
    user.page.get_by_role("treeitem").get_by_text("base", exact=True).last.click()  # the first belongs to the gate
    before = user.position("crate")
    for name, value in (("force x", "-50"), ("duration [s]", "0.2")):
        user.field(name).fill(value)
    user.button("Apply").click()
    user.until(lambda: user.position("crate")[0] < before[0] - 0.3, what=f"{user.position('crate')}, was {before}")


def test_a_held_model_does_not_fall(user: WorldUser) -> None:
    """It is lifted by typing, held, and freed."""
    user.pick("crate")
    user.button("Hold in the air").click()
    user.until(lambda: (user.model("crate") or {}).get("held"))
    user.type("z [m]", "2")
    user.until(lambda: abs(user.position("crate")[2] - 2) < 1e-3)
    user.page.wait_for_timeout(1000)
    assert abs(user.position("crate")[2] - 2) < 1e-3
    user.button("Hold in the air").click()
    user.until(lambda: user.position("crate")[2] < 0.5)


def test_a_model_is_copied_and_deleted_by_keys_and_both_are_undone(user: WorldUser) -> None:
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("Shift+C")
    user.until(lambda: user.model("crate_0"))
    user.page.get_by_role("heading", name="crate_0", exact=True).wait_for()
    assert user.position("crate_0")[0] == pytest.approx(user.position("crate")[0] + 0.5, abs=0.2)
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("Delete")
    user.until(lambda: not user.model("crate_0"))
    user.button("Undo: Delete crate_0").click()
    user.until(lambda: user.model("crate_0"))
    user.button("Undo: Copy of crate").click()
    user.until(lambda: not user.model("crate_0"))


def test_a_changing_number_is_still_while_it_is_edited(user: WorldUser) -> None:
    """The crate falls meanwhile; a click selects the number, and typing replaces it."""
    user.pick("crate")
    user.type("z [m]", "40")
    user.until(lambda: 1 < user.position("crate")[2] < 39)
    field = user.field("z [m]")
    field.click()
    shown = field.input_value()
    high = user.position("crate")[2]
    user.until(lambda: user.position("crate")[2] < high - 1)
    assert field.input_value() == shown
    user.page.keyboard.type("1.5")
    user.page.keyboard.press("Enter")
    user.until(lambda: user.position("crate")[2] < 1.6)
