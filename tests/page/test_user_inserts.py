"""A user inserts shapes, lights and models into a running world, deletes and saves them."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.scene_user import VIEW_CANVAS, Point
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

import trundle

pytestmark = [pytest.mark.slow, needs_client]

_GEOMETRY = "<geometry><box><size>{}</size></box></geometry>"
_RED = "<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material>"
CRATE = f"""<sdf version="1.6"><model name="crate"><pose>0 0 0.2 0 0 0</pose><link name="base">
<collision name="c">{_GEOMETRY.format("0.4 0.4 0.4")}</collision>
<visual name="v">{_GEOMETRY.format("0.4 0.4 0.4")}{_RED}</visual></link></model></sdf>"""
CODED = CRATE.replace("crate", "coded").replace("</model>", '<plugin name="p" filename="code.py"/></model>')
CONFIG = "<model><name>{}</name><sdf version='1.6'>model.sdf</sdf></model>"
CODE = """from pathlib import Path
from trundle.gazebo.plugins import Plugin


class Code(Plugin):
    @classmethod
    def load(cls, sim, model, node, tag):
        Path(__file__).with_name("has_run").touch()
        return cls()
"""
WORLD = f"""<sdf version="1.6"><world name="yard"><model name="floor"><static>1</static><pose>0 0 -0.1 0 0 0</pose>
<link name="l"><collision name="c">{_GEOMETRY.format("20 20 0.2")}</collision>
<visual name="v">{_GEOMETRY.format("20 20 0.2")}</visual></link></model>
<model name="table"><static>1</static><pose>0 1 0.25 0 0 0</pose><link name="l">
<collision name="c">{_GEOMETRY.format("0.8 0.8 0.5")}</collision>
<visual name="v">{_GEOMETRY.format("0.8 0.8 0.5")}</visual></link></model></world></sdf>"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    for name, text in (("crate", CRATE), ("coded", CODED)):
        model = folder / ".gazebo" / "models" / name
        model.mkdir(parents=True)
        (model / "model.config").write_text(CONFIG.format(f"{name.title()} of wood"))
        (model / "model.sdf").write_text(text)
    (folder / ".gazebo" / "models" / "coded" / "code.py").write_text(CODE)
    return folder


@pytest.fixture(scope="module")
def address(folder: Path) -> Iterator[str]:
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0")
    home = {"HOME": str(folder), "XDG_CACHE_HOME": str(folder / "cache")}
    with running_page(*words, environment=home, folder=folder) as url:
        yield url


@pytest.fixture(scope="module")
def user(chromium: Any, address: str) -> Iterator[WorldUser]:
    user = WorldUser(chromium, address)
    user.look_down()
    user.side("Insert")
    yield user
    user.close()


def _entry(user: WorldUser, name: str) -> Any:
    return user.page.get_by_role("button", name=f"Insert {name}", exact=True)


def _center(user: WorldUser, name: str) -> Point:
    box = _entry(user, name).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def _is_at(user: WorldUser, name: str, position: tuple[float, float, float], within: float = 0.03) -> bool:
    return user.pose(name) is not None and math.dist(user.position(name), position) < within


def _lights(user: WorldUser) -> dict[str, list[float]]:
    return {light["name"]: light["pose"][:3] for light in user.manifest()["lights"]}


def test_a_box_is_chosen_and_placed_by_a_click(user: WorldUser) -> None:
    """Done twice: the second box has a different name, and both insertions can be undone."""
    for point in ((-1.5, 0.0), (1.5, 0.0)):
        _entry(user, "box").click()
        user.click(point)
        name = "box" if point[0] < 0 else "box_0"
        user.until(lambda name=name, point=point: _is_at(user, name, (*point, 0.5)), what=f"for {name}")
    user.button("Undo: Insert box_0").click()
    user.until(lambda: user.model("box_0") is None)
    user.button("Redo: Insert box_0").click()
    user.until(lambda: _is_at(user, "box_0", (1.5, 0.0, 0.5)))
    user.side("World")
    user.pick("box_0")
    user.page.get_by_role("heading", name="box_0", exact=True).wait_for()
    user.page.get_by_text("free", exact=True).wait_for()
    assert user.page.locator(".ti .src").count() == 0  # it comes from no file
    for name in ("box_0", "box"):
        user.button(f"Undo: Insert {name}").click()
        user.until(lambda name=name: user.model(name) is None)


def test_a_model_is_found_and_dragged_onto_the_table(user: WorldUser) -> None:
    """Its picture is red like the model; a preview at the pointer is visible before it is placed."""
    user.side("Insert")
    user.page.get_by_label("Search the models").fill("crate of")
    user.until(lambda: user.page.locator(".model").count() == 1)
    picture = user.page.locator(".model img")
    user.until(lambda: picture.evaluate("image => image.naturalWidth") == 96)
    before = user.picture()
    user.page.mouse.move(*_center(user, "Crate of wood"))
    user.page.mouse.down()
    user.page.mouse.move(*user.at((0.0, 1.0)), steps=4)
    user.until(lambda: _redness(user.picture()) > _redness(before) + 1000, what="for the preview at the pointer")
    assert user.model("crate") is None
    user.page.mouse.up()
    user.until(lambda: _is_at(user, "crate", (0.0, 1.0, 0.7)), what="for the crate on the table")
    user.page.get_by_label("Search the models").fill("")


def _redness(picture: Any) -> int:
    red, green, blue = (picture[..., channel].astype(int) for channel in range(3))
    return int(((red > green + 60) & (red > blue + 60)).sum())


def test_escape_cancels_an_insertion(user: WorldUser) -> None:
    names = {model["name"] for model in user.manifest()["models"]}
    _entry(user, "sphere").click()
    user.page.mouse.move(*user.at((-1.0, -0.5)))
    user.page.keyboard.press("Escape")
    user.click((-1.0, -0.5))
    user.side("Insert")  # the click has selected the floor in the tree
    user.page.mouse.move(*_center(user, "sphere"))
    user.page.mouse.down()
    user.page.mouse.move(*user.at((-1.0, -0.5)), steps=4)
    user.page.mouse.move(*_center(user, "cylinder"), steps=4)
    user.page.mouse.up()
    assert _entry(user, "sphere").get_attribute("aria-pressed") == "false"
    assert {model["name"] for model in user.manifest()["models"]} == names


def test_the_keyboard_inserts_at_the_middle_of_the_view(user: WorldUser) -> None:
    _entry(user, "cylinder").focus()
    user.page.keyboard.press("Enter")
    user.until(lambda: _is_at(user, "cylinder", (0.0, 0.0, 0.5), within=0.1), what="for the cylinder")
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("Delete")
    user.until(lambda: user.model("cylinder") is None)
    user.button("Undo: Delete cylinder").click()
    user.until(lambda: user.model("cylinder") is not None)


def test_a_light_is_inserted_and_deleted(user: WorldUser) -> None:
    _entry(user, "spot light").click()
    user.click((-1.0, 0.5))
    user.until(lambda: "spot_light" in _lights(user))
    assert math.dist(_lights(user)["spot_light"], (-1.0, 0.5, 2.0)) < 0.03
    user.page.get_by_role("button", name="Delete", exact=True).click()
    user.until(lambda: "spot_light" not in _lights(user))
    user.button("Undo: Delete spot_light").click()
    user.until(lambda: "spot_light" in _lights(user))


def test_code_is_run_only_after_consent(user: WorldUser, folder: Path) -> None:
    ran = folder / ".gazebo" / "models" / "coded" / "has_run"
    dialog = user.page.get_by_role("dialog", name="Run the code of Coded of wood?")
    for agrees in (False, True):
        _entry(user, "Coded of wood").click()
        user.click((1.0, -0.8))
        dialog.get_by_text(str(ran.with_name("code.py"))).wait_for()
        assert not ran.exists()
        assert user.model("coded") is None
        dialog.get_by_role("button", name="Insert and run it" if agrees else "Cancel").click()
    user.until(lambda: _is_at(user, "coded", (1.0, -0.8, 0.2)))
    assert ran.exists()


def test_inserted_models_are_saved_with_the_world(user: WorldUser, folder: Path) -> None:
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("Control+s")
    dialog = user.page.get_by_role("dialog", name="Save the world as SDF")
    dialog.get_by_label("File").fill("mine.sdf")
    dialog.get_by_role("button", name="Save", exact=True).click()
    user.page.get_by_role("status").get_by_text("saved as mine.sdf").wait_for()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HOME", str(folder))
        again = trundle.load(str(folder / "mine.sdf"))
    assert again["crate"].pose.position == pytest.approx((0.0, 1.0, 0.7), abs=0.03)
    assert {"cylinder", "coded"} <= {model.name for model in again.models}
    assert [light.name for light in again.world.lights] == ["spot_light"]


def test_on_a_phone_a_shape_and_then_a_point_are_tapped(chromium: Any, address: str, user: WorldUser) -> None:
    context = chromium.new_context(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    page = context.new_page()
    page.set_default_timeout(60_000)
    page.goto(address)
    page.get_by_label("Pages of the sheet").get_by_role("button", name="World").tap()
    page.get_by_role("button", name="World's menu").tap()
    page.get_by_role("menuitem", name="Open Insert").tap()
    page.get_by_role("button", name="Insert sphere", exact=True).tap()
    page.touchscreen.tap(195, 420)
    user.until(lambda: user.model("sphere") is not None, what="for the sphere")
    context.close()
