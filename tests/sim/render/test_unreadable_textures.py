"""Textures that cannot be decoded are named once, with the reason, and plain colors are drawn."""

from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from trundle.app.cli import main
from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Box
from trundle.sim.render import Scene, Shape, report_unreadable_textures

NOISE = np.random.default_rng(0).integers(0, 255, (64, 64, 3), dtype=np.uint8)


def png() -> bytes:
    file = BytesIO()
    Image.fromarray(NOISE).save(file, "PNG")
    return file.getvalue()


def warnings_of(*textures: Path | bytes) -> list[str]:
    shapes = [Shape(name=f"v{i}", body=0, geometry=Box((1.0, 1.0, 1.0)), texture=t) for i, t in enumerate(textures)]
    report = Diagnostics()
    report_unreadable_textures(Scene(bodies=("m::l",), shapes=tuple(shapes)), report)
    return report.warnings


def test_each_unreadable_texture_is_reported_once_with_the_reason(tmp_path: Path) -> None:
    fine, text, cut = tmp_path / "fine.png", tmp_path / "text.png", tmp_path / "cut.png"
    fine.write_bytes(png())
    text.write_text("version https://git-lfs.github.com/spec/v1")
    cut.write_bytes(png()[:2000])

    not_an_image, truncated, missing, within = warnings_of(fine, text, text, cut, tmp_path / "no.png", b"\x89PNG")

    drawn = "a plain color is drawn"
    assert not_an_image == f"{text}: warning: the texture cannot be read: it is not an image; {drawn}"
    assert truncated.startswith(f"{cut}: warning: the texture cannot be read: ")
    assert "truncated" in truncated
    assert missing == f"{tmp_path}/no.png: warning: the texture cannot be read: No such file or directory; {drawn}"
    assert within == f"m::l::v5: warning: the texture cannot be read: it is not an image; {drawn}"


@pytest.mark.parametrize(
    "command", [["render", "-o", "out.png"], ["run", "--headless", "--no-ros", "--speed", "max", "--duration", "0.2"]]
)
def test_commands_with_a_camera_report_unreadable_textures(
    tmp_path: Path, command: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "map.png").write_text("no image")
    boxes = "".join(
        f'<visual name="{name}"><geometry><box><size>1 1 1</size></box></geometry><material><pbr><metal>'
        "<albedo_map>map.png</albedo_map></metal></pbr></material></visual>"
        for name in ("a", "b")
    )
    camera = (
        '<sensor name="eye" type="camera"><camera><image><width>8</width><height>8</height></image></camera></sensor>'
    )
    file = tmp_path / "m.sdf"
    file.write_text(f'<sdf version="1.7"><model name="m"><link name="l">{boxes}{camera}</link></model></sdf>')

    assert main([command[0], str(file), *command[1:]]) == 0

    warning = f"{tmp_path}/map.png: warning: the texture cannot be read: it is not an image; a plain color is drawn"
    assert capsys.readouterr().err.count(warning) == 1
