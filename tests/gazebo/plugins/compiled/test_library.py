"""Finding of compiled plugins: where Gazebo looks, and only those of the development kit."""

from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import parse_xml
from trundle.gazebo.plugins import find_plugin, find_user_file, require_plugin
from trundle.gazebo.plugins.compiled.elements import elements_of
from trundle.robots.model import PluginTag

_OURS = b"\x7fELF and much else: trundle gazebo plugin, interface 1\0"


def tag_of(folder: Path, filename: str) -> PluginTag:
    inside = '<speed unit="a&amp;b">2</speed><list><v/></list>'
    text = f'<model><plugin name="p" filename="{filename}">{inside}</plugin></model>'
    node = parse_xml(text, name=str(folder / "model.sdf"), report=Diagnostics()).find("plugin")
    assert node is not None
    return PluginTag(name="p", filename=filename, at=node.at, node=node)


@pytest.mark.parametrize("place", ["model", "model/build", "path", "devel/lib"])
def test_a_library_is_found_by_its_file_name(tmp_path: Path, place: str) -> None:
    (tmp_path / "model").mkdir()
    library = tmp_path / place / "libp.so"
    library.parent.mkdir(parents=True, exist_ok=True)
    library.write_bytes(_OURS)

    tag = tag_of(tmp_path / "model", "/home/author/plugins/libp.so")
    environment = {"GAZEBO_PLUGIN_PATH": str(tmp_path / "path")}

    assert find_plugin(tag, environment)[1] == f"{library}, in C++"
    assert find_user_file(tag, environment) == library
    require_plugin(tag, environment)


def test_the_path_as_written_comes_first(tmp_path: Path) -> None:
    for folder in ("written", "model"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "libp.so").write_bytes(_OURS)

    _, origin = find_plugin(tag_of(tmp_path / "model", f"{tmp_path}/written/libp.so"), {})

    assert origin == f"{tmp_path}/written/libp.so, in C++"


def test_a_compiled_plugin_wins_over_stand_ins_of_its_name(tmp_path: Path) -> None:
    (tmp_path / "p.py").write_text("raise SystemExit('not loaded')")
    for name in ("libp.so", "libgazebo_ros_p3d.so"):
        (tmp_path / name).write_bytes(_OURS)
        assert find_plugin(tag_of(tmp_path, name), {})[1] == f"{tmp_path}/{name}, in C++"


def test_a_library_for_gazebo_itself_is_named_and_not_opened(tmp_path: Path) -> None:
    (tmp_path / "libp.so").write_bytes(b"\x7fELF of libgazebo.so.11")

    with pytest.raises(DescriptionError) as raised:
        find_plugin(tag_of(tmp_path, "libp.so"), {})

    hint = f"({tmp_path}/libp.so is for Gazebo itself: compile it again in `trundle shell`)"
    assert f"no libp.so {hint}; " in str(raised.value)


def test_the_python_file_runs_where_no_library_is_found(tmp_path: Path) -> None:
    (tmp_path / "libp.so").write_bytes(b"\x7fELF of libgazebo.so.11")
    (tmp_path / "p.py").write_text("from trundle import Plugin\n\nclass P(Plugin):\n    pass\n")

    assert find_plugin(tag_of(tmp_path, "libp.so"), {})[1] == str(tmp_path / "p.py")


def test_elements_are_words_with_zeros_after_them(tmp_path: Path) -> None:
    words = elements_of(tag_of(tmp_path, "libp.so").node).decode().split("\0")

    assert words[:8] == ["0", "plugin", "", "2", "name", "p", "filename", "libp.so"]
    assert words[8:14] == ["1", "speed", "2", "1", "unit", "a&b"]
    assert words[14:] == ["1", "list", "", "0", "2", "v", "", "0", ""]
