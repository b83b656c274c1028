"""Pictures of models for the page: content, cache, and redrawing after a file changes."""

import io
import json
import os
import struct
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from trundle.base.diagnostics import UsageError
from trundle.page.simulated_world import model_pictures
from trundle.page.simulated_world.model_pictures import SIZE_PX, cached_picture, model_glb
from trundle.robots.packages import Packages

_MODEL = """<sdf version="1.6"><model name="crate"><pose>1 2 3 0 0 0</pose><link name="l"><visual name="v">
<geometry><box><size>1 1 1</size></box></geometry><material>
<ambient>{0}</ambient><diffuse>{0}</diffuse></material></visual></link>
</model></sdf>"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    folder = tmp_path / "models" / "crate"
    folder.mkdir(parents=True)
    (folder / "model.config").write_text("<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>")
    (folder / "model.sdf").write_text(_MODEL.format("1 0 0 1"))
    return folder


@pytest.fixture
def packages(folder: Path) -> Packages:
    return Packages({"GAZEBO_MODEL_PATH": str(folder.parent), "HOME": str(folder.parents[1])}, start=folder.parents[1])


def _middle(png: bytes) -> list[int]:
    image = np.asarray(Image.open(io.BytesIO(png)))
    assert image.shape == (SIZE_PX, SIZE_PX, 3)
    return [int(value) for value in image[SIZE_PX // 2, SIZE_PX // 2]]


def test_a_picture_shows_the_model_and_is_redrawn_after_a_file_changes(packages: Packages, folder: Path) -> None:
    red, green, blue = _middle(cached_picture("crate", packages))
    assert red > 60 > max(green, blue)
    (folder / "model.sdf").write_text(_MODEL.format("0 1 0 1"))
    os.utime(folder / "model.sdf", ns=(1, 1))
    red, green, blue = _middle(cached_picture("crate", packages))
    assert green > 60 > max(red, blue)


def test_a_picture_is_drawn_once(packages: Packages, monkeypatch: pytest.MonkeyPatch) -> None:
    first = cached_picture("crate", packages)
    monkeypatch.setattr(model_pictures, "draw_model", lambda *_: b"drawn again")
    assert cached_picture("crate", packages) == first


def test_the_cache_keeps_recently_used_pictures(
    packages: Packages, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(model_pictures, "_MAX_FILES", 2)
    for number in range(4):
        os.utime(folder / "model.sdf", ns=(number, number))
        cached_picture("crate", packages)
    assert len(list((folder.parent.parent / "cache").rglob("*.png"))) == 2


def test_a_shape_is_a_glb_at_the_models_pose(packages: Packages) -> None:
    glb = model_glb("crate", packages)
    magic, version, length = struct.unpack_from("<4sII", glb)
    (size,) = struct.unpack_from("<I", glb, 12)
    nodes = json.loads(glb[20 : 20 + size])["nodes"]
    assert (magic, version, length) == (b"glTF", 2, len(glb))
    assert [1, 2, 3] in [node.get("translation") for node in nodes]


def test_models_that_cannot_be_shown_are_refused_with_a_reason(
    packages: Packages, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(UsageError, match="no model 'nothing' on the model path"):
        cached_picture("nothing", packages)
    monkeypatch.setattr(model_pictures, "_MAX_GLB_BYTES", 100)
    with pytest.raises(UsageError, match="'crate' is too large for a preview"):
        model_glb("crate", packages)
    with pytest.raises(UsageError, match=r"no model '\.\./crate' on the model path"):
        model_glb("../crate", packages)
