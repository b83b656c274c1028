"""Titles of a page: the world's name, its file or its robot."""

from pathlib import Path

import pytest

import trundle
from trundle.page.simulated_world.page import page_names

_CAR = '<model name="car"><link name="base"/><link name="wheel"/><joint name="axle" type="revolute">\
<parent>base</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis></joint></model>'


@pytest.mark.parametrize(
    ("file", "content", "names"),
    [
        ("room.world", f'<world name="lab">{_CAR}</world>', ("lab", "car")),
        ("room.world", f'<world name="default">{_CAR}</world>', ("room", "car")),
        ("empty.world", '<world name="default"/>', ("empty", None)),
        ("model.sdf", _CAR, ("car", "car")),
    ],
)
def test_the_title_is_the_most_specific_name(
    file: str, content: str, names: tuple[str, str | None], tmp_path: Path
) -> None:
    (tmp_path / file).write_text(f'<sdf version="1.6">{content}</sdf>')
    assert page_names(trundle.load(tmp_path / file, plugins=False).world) == names
