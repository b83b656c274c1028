"""A recorded run as an HTML file and as an animated GLB."""

import base64
import gzip
import json
import re
from pathlib import Path

import pytest
from tests.sim.gltf.glb import Glb

from trundle.app.cli import main
from trundle.page import REPLAY_FILES

BOUNCE = """<sdf version="1.6"><world name="w"><model name="ball"><pose>0 0 1 0 0 0</pose><link name="l">
<visual name="v"><geometry><sphere><radius>0.1</radius></sphere></geometry></visual>
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link></model></world></sdf>"""
needs_viewer = pytest.mark.skipif(not REPLAY_FILES[0].exists(), reason="the page's client is not built: make")


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Half a second of a falling ball, in a file whose name contains markup."""
    folder = tmp_path_factory.mktemp("log")
    (folder / "w.sdf").write_text(BOUNCE)
    path = folder / "a<b>&.log"
    options = ("--headless", "--no-ros", "--duration", "0.5", "--speed", "max", "--record", str(path))
    assert main(("run", str(folder / "w.sdf"), *options)) == 0
    return path


def converted(log: Path, to: str, output: Path) -> bytes:
    assert main(("convert", str(log), "--to", to, "-o", str(output))) == 0
    return output.read_bytes()


def part(page: str, name: str) -> str:
    """Return the content of a script element."""
    match = re.search(rf'<script [^>]*id="{name}">(.*?)</script>', page, re.DOTALL)
    assert match is not None, name
    return match[1]


def test_the_animation_of_a_glb_follows_the_recording(log: Path, tmp_path: Path) -> None:
    glb = Glb(converted(log, "glb", tmp_path / "ball.glb"))

    (animation,) = glb.tree["animations"]
    (channel,) = animation["channels"]
    sampler = animation["samplers"][channel["sampler"]]
    times, positions = glb.array(sampler["input"])[:, 0], glb.array(sampler["output"])
    assert glb.tree["nodes"][channel["target"]["node"]]["name"] == "ball::l"
    assert times[[0, -1]] == pytest.approx([0.0, 0.5])
    assert positions[:21, 2] == pytest.approx(1.0 - 9.8 / 2 * times[:21] ** 2, abs=0.005)  # until it bounces


@needs_viewer
def test_a_replay_page_is_self_contained(log: Path, tmp_path: Path) -> None:
    """It loads nothing, and the recording's name is escaped."""
    page = converted(log, "html", tmp_path / "ball.html").decode()

    about = json.loads(part(page, "about"))
    glb = Glb(gzip.decompress(base64.b64decode(part(page, "world"))))
    assert (about["title"], about["start"], about["end"]) == (log.name, 0.0, 0.5)
    assert "<title>a&lt;b&gt;&amp;.log</title>" in page
    assert len(glb.tree["animations"]) == 1
    assert re.findall(r"<(?:link|img|script|iframe)\b[^>]*(?:src|href)=", page) == []
    assert "three" in part(page, "licenses")


@needs_viewer
def test_replay_pages_are_reproducible(log: Path, tmp_path: Path) -> None:
    assert converted(log, "html", tmp_path / "a.html") == converted(log, "html", tmp_path / "b.html")


def test_only_recordings_are_converted_to_replays(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(("convert", str(log), "--to", "sdf")) == 1
    assert "is a recording; it is converted to glb or html" in capsys.readouterr().err
    assert main(("convert", str(log.parent / "w.sdf"), "--to", "html")) == 1
    assert "for an HTML replay, record one with trundle run --record" in capsys.readouterr().err
