"""A user uploads a model in the browser, inserts it and saves the world."""

import io
import os
import random
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
from tests.page.built_client import needs_client
from tests.page.scene_user import VIEW_CANVAS
from tests.page.world_user import WorldUser
from tests.system.browser import running_page

import trundle
from trundle.robots.model import MeshFile

pytestmark = [needs_client, pytest.mark.slow]

_CORNERS = "".join(f"v {x} {y} {z}\n" for x in (-0.3, 0.3) for y in (-0.3, 0.3) for z in (0, 0.6))
CUBE = _CORNERS + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
MESH = "<geometry><mesh><uri>model://{0}/meshes/cube.obj</uri></mesh></geometry>"
MODEL = f"""<sdf version="1.6"><model name="{{0}}"><link name="base">
<collision name="c"><pose>0 0 0.3 0 0 0</pose><geometry><box><size>0.6 0.6 0.6</size></box></geometry></collision>
<visual name="v">{MESH}<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link>
{{1}}</model></sdf>"""
CODE = """from trundle.gazebo.plugins import Plugin


class Code(Plugin):
    @classmethod
    def load(cls, *_):
        return cls()
"""
WORLD = """<sdf version="1.6"><world name="yard"><model name="floor"><static>1</static><link name="l">
<collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
<visual name="v"><pose>0 0 -0.1 0 0 0</pose>
<geometry><box><size>20 20 0.2</size></box></geometry></visual></link></model></world></sdf>"""


def _files(name: str, plugin: str = "") -> dict[str, str]:
    return {
        f"{name}/model.config": f"<model><name>My {name}</name><sdf version='1.6'>model.sdf</sdf></model>",
        f"{name}/model.sdf": MODEL.format(name, plugin),
        f"{name}/meshes/cube.obj": CUBE,
    }


def _zip(files: dict[str, str]) -> bytes:
    data = io.BytesIO()
    with ZipFile(data, "w") as packed:
        for name, text in files.items():
            packed.writestr(name, text)
    return data.getvalue()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    (folder / "temporary").mkdir()
    return folder


@pytest.fixture(scope="module")
def user(chromium: Any, folder: Path) -> Iterator[WorldUser]:
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0")
    home = {"HOME": str(folder), "XDG_CACHE_HOME": str(folder / "cache"), "TMPDIR": str(folder / "temporary")}
    with running_page(*words, environment=home, folder=folder) as url:
        user = WorldUser(chromium, url)
        user.look_down()
        user.side("Insert")
        yield user
        user.close()
    assert list((folder / "temporary").glob("trundle-*")) == []


def _open(user: WorldUser) -> Any:
    user.button("Upload a model").click()
    return user.page.get_by_role("dialog", name="Upload a model")


def _choose(user: WorldUser, button: str, files: Any) -> None:
    with user.page.expect_file_chooser() as chooser:
        _open(user).get_by_role("button", name=button).click()
    chooser.value.set_files(files)


def _archive(name: str, files: dict[str, str]) -> dict[str, Any]:
    return {"name": name, "mimeType": "application/zip", "buffer": _zip(files)}


def _entry(user: WorldUser, title: str) -> Any:
    return user.page.get_by_role("button", name=f"Insert {title}", exact=True)


def _redness(user: WorldUser) -> int:
    red, green, blue = (user.picture()[..., channel].astype(int) for channel in range(3))
    return int(((red > green + 60) & (red > blue + 60)).sum())


def test_an_archive_is_uploaded_and_dragged_into_the_scene(user: WorldUser) -> None:
    """It is the first in the list, with its picture, and its mesh is drawn at the drop point."""
    _choose(user, "Choose a file", _archive("wagon.zip", _files("wagon")))
    _entry(user, "My wagon").wait_for()
    assert user.page.get_by_role("dialog").count() == 0
    assert user.page.locator(".model").first.inner_text() == "My wagon"
    picture = user.page.locator(".model img").first
    user.until(lambda: picture.evaluate("image => image.naturalWidth") == 96, what="for its picture")
    box, before = _entry(user, "My wagon").bounding_box(), _redness(user)
    user.page.mouse.move(box["x"] + 20, box["y"] + 20)
    user.page.mouse.down()
    user.page.mouse.move(*user.at((1.0, 1.0)), steps=4)
    user.page.mouse.up()
    user.until(lambda: user.pose("wagon") is not None, what="for the wagon")
    assert user.position("wagon") == pytest.approx((1.0, 1.0, 0.0), abs=0.03)
    user.until(lambda: _redness(user) > before + 1000, what="for its mesh")


def test_errors_are_shown_in_the_dialog(user: WorldUser) -> None:
    _choose(user, "Choose a file", _archive("notes.zip", {"readme.txt": "", "../evil.sdf": ""}))
    dialog = user.page.get_by_role("dialog", name="Upload a model")
    dialog.get_by_role("alert").get_by_text("notes.zip: '../evil.sdf' is not a valid path").wait_for()
    with user.page.expect_file_chooser() as chooser:
        dialog.get_by_role("button", name="Choose a file").click()
    chooser.value.set_files(_archive("notes.zip", {"readme.txt": ""}))
    dialog.get_by_text("notes.zip: no model.config, .sdf or .urdf in it").wait_for()
    user.page.keyboard.press("Escape")


def test_a_large_upload_shows_its_progress_and_can_be_cancelled(user: WorldUser, folder: Path) -> None:
    """20 MB at 2 MB/s; a cancelled upload leaves no files, and can be repeated."""
    with ZipFile(folder / "big.zip", "w") as packed:
        for name, text in _files("big").items():
            packed.writestr(name, text)
        packed.writestr("big/noise.bin", random.Random(1).randbytes(20_000_000))
    network = user.page.context.new_cdp_session(user.page)
    limits = {"offline": False, "latency": 0, "downloadThroughput": -1}
    network.send("Network.emulateNetworkConditions", {**limits, "uploadThroughput": 2_000_000})
    _choose(user, "Choose a file", folder / "big.zip")
    dialog = user.page.get_by_role("dialog", name="Upload a model")
    bar = dialog.get_by_role("progressbar", name="Sent")
    dialog.get_by_text(re.compile(r"^[1-9].* MB of 20(\.0)? MB$")).wait_for()
    share = bar.evaluate("bar => bar.value")
    user.until(lambda: share < bar.evaluate("bar => bar.value") < 1)
    dialog.get_by_role("button", name="Cancel").click()
    dialog.get_by_role("button", name="Choose a file").wait_for()
    assert dialog.get_by_role("alert").count() == 0
    user.until(lambda: not list((folder / "temporary").glob("*/trundle-upload-*")), what="for the files to go")
    network.send("Network.emulateNetworkConditions", {**limits, "uploadThroughput": -1})
    with user.page.expect_file_chooser() as chooser:
        dialog.get_by_role("button", name="Choose a file").click()
    chooser.value.set_files(folder / "big.zip")
    _entry(user, "My big").wait_for()


def test_an_uploaded_folder_with_code_needs_consent(user: WorldUser, folder: Path) -> None:
    files = _files("coded", '<plugin name="p" filename="code.py"/>') | {"coded/code.py": CODE, "coded/.git/x": "x"}
    for name, text in files.items():
        (folder / "home" / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / "home" / name).write_text(text)
    _choose(user, "Choose a folder", folder / "home" / "coded")
    _entry(user, "My coded").click()
    user.click((-1.0, -1.0))
    dialog = user.page.get_by_role("dialog", name="Run the code of My coded?")
    dialog.get_by_text("code.py").wait_for()
    assert user.model("coded") is None
    dialog.get_by_role("button", name="Insert and run it").click()
    user.until(lambda: user.model("coded") is not None, what="for the model with code")


def test_a_dropped_file_is_uploaded_and_replaced_by_dropping_it_again(user: WorldUser) -> None:
    for side in ("0.5", "1.0"):
        box = f"<geometry><box><size>{side} {side} {side}</size></box></geometry>"
        link = f'<link name="l"><visual name="v">{box}</visual></link>'
        text = f'<sdf version="1.6"><model name="brick"><static>1</static>{link}</model></sdf>'
        user.drop_file("brick.sdf", text)
        user.page.get_by_role("status").get_by_text("brick can be inserted").wait_for()
    _entry(user, "brick").click()
    user.click((1.0, -1.0))
    user.until(lambda: user.model("brick") is not None, what="for the brick")
    assert _entry(user, "brick").count() == 1


def _save_dialog(user: WorldUser) -> Any:
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("Control+s")
    return user.page.get_by_role("dialog", name="Save the world as SDF")


def test_the_world_is_saved_with_uploads_and_confirms_replacements(user: WorldUser, folder: Path) -> None:
    existing = folder / "worlds" / "wagon" / "model.sdf"
    existing.parent.mkdir(parents=True)
    existing.write_text("precious")
    dialog = _save_dialog(user)
    dialog.get_by_label("File").fill("worlds/mine.sdf")
    dialog.get_by_role("button", name="Save", exact=True).click()
    dialog.get_by_text("worlds/wagon/model.sdf exists already. Replace it?").wait_for()
    assert existing.read_text() == "precious"
    assert not (folder / "worlds" / "mine.sdf").exists()
    dialog.get_by_role("button", name="Replace").click()
    user.page.get_by_role("status").get_by_text("saved as worlds/mine.sdf").wait_for()
    assert existing.read_text() == MODEL.format("wagon", "")


def test_a_saved_world_is_complete_without_the_uploads(user: WorldUser, folder: Path) -> None:
    """It is checked and loaded by a process without the uploads."""
    for uploads in (folder / "temporary").glob("trundle-models-*"):
        shutil.rmtree(uploads)
    file = folder / "worlds" / "mine.sdf"
    words = [sys.executable, "-m", "trundle", "check", str(file)]
    done = subprocess.run(words, capture_output=True, text=True, check=False, env={**os.environ, "HOME": str(folder)})
    assert done.returncode == 0, done.stdout + done.stderr
    assert "cube.obj" not in done.stdout + done.stderr
    assert "<uri>model://wagon</uri>" in file.read_text()
    wagon = trundle.load(str(file))["wagon"]
    assert wagon.pose.position == pytest.approx((1.0, 1.0, 0.0), abs=0.03)
    (visual,) = wagon.links[0].link.visuals
    assert isinstance(visual.geometry, MeshFile)
    assert visual.geometry.path == folder / "worlds" / "wagon" / "meshes" / "cube.obj"
