"""`trundle param`, with rosparam's output."""

import math
from pathlib import Path
from typing import Any

import pytest

from trundle.app.cli import main


def test_values_are_set_and_printed_as_yaml(graph: Any) -> None:
    assert graph.trundle("param", "set", "/a", "{b: 1, c: [x, 2.5, true]}") == (0, "", "")
    assert graph.trundle("param", "get", "/a") == (0, "b: 1\nc:\n- x\n- 2.5\n- true\n\n", "")
    assert graph.trundle("param", "get", "/a/b") == (0, "1\n", "")
    assert graph.trundle("param", "get", "-p", "/a") == (0, "b: 1\nc: - x\n- 2.5\n- true\n", "")


def test_setting_a_dictionary_keeps_its_other_keys(graph: Any) -> None:
    graph.trundle("param", "set", "/a/x", "1")
    graph.trundle("param", "set", "/a", "{y: 2}")
    assert graph.trundle("param", "get", "/a")[1] == "x: 1\ny: 2\n\n"


@pytest.mark.parametrize(("text", "value"), [("", ""), ("'5'", "5"), ("5", 5), ("deg(180)", math.pi)])
def test_values_are_yaml_with_angles(graph: Any, text: str, value: object) -> None:
    graph.trundle("param", "set", "/v", text)
    assert graph.core.parameters.get("/v") == value


def test_names_are_listed_in_order_and_by_namespace(graph: Any) -> None:
    for name in ("/r/b", "/r/a", "/rx"):
        graph.trundle("param", "set", name, "1")
    assert graph.trundle("param", "list", "/r")[1] == "/r/a\n/r/b\n"
    assert graph.trundle("param", "list")[1].split() == ["/r/a", "/r/b", "/rosdistro", "/rosversion", "/run_id", "/rx"]


def test_a_file_is_loaded_and_dumped(graph: Any, tmp_path: Path) -> None:
    source, target = tmp_path / "in.yaml", tmp_path / "out.yaml"
    source.write_text("_ns: arm\ngain: 3\nlimit: rad(pi/2)\nname: two words\n")
    assert graph.trundle("param", "load", str(source), "/robot") == (0, "", "")
    assert graph.trundle("param", "dump", str(target), "/robot")[0] == 0
    assert target.read_text() == "arm:\n  gain: 3\n  limit: 1.5707963267948966\n  name: two words\n"


def test_a_text_file_becomes_a_string_and_a_binary_one_bytes(graph: Any, tmp_path: Path) -> None:
    path = tmp_path / "x.urdf"
    path.write_text("<robot>1</robot>")
    graph.trundle("param", "set", "/robot_description", "-t", str(path))
    graph.trundle("param", "set", "/data", "-b", str(path))
    assert graph.core.parameters.get("/robot_description") == "<robot>1</robot>"
    assert graph.core.parameters.get("/data") == b"<robot>1</robot>"


def test_parameters_are_deleted(graph: Any) -> None:
    graph.trundle("param", "set", "/a/b", "1")
    assert graph.trundle("param", "delete", "-v", "/a") == (0, "deleted parameter [/a]\n", "")
    assert graph.trundle("param", "delete", "/a") == (1, "", "ERROR: parameter [/a] is not set\n")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("get", "/nope"), "ERROR: Parameter [/nope] is not set\n"),
        (("set", "/a", "{1: 2}"), "ERROR: YAML dictionaries must have string keys."),
        (("set", "/a", "99999999999"), "does not fit the 32 bits"),
        (("set", "/a", "[1"), "ERROR: the value is not YAML"),
        (("set", "/a", "rad(9**9**9)"), "ERROR: not an angle: 'rad(9**9**9)'"),
        (("load", "/no/such.yaml"), "ERROR: file [/no/such.yaml] does not exist\n"),
    ],
)
def test_errors_are_one_sentence(graph: Any, arguments: tuple[str, ...], message: str) -> None:
    code, out, error = graph.trundle("param", *arguments)
    assert (code, out) == (1, "")
    assert message in error


@pytest.mark.parametrize("command", [["param", "list"], ["topic", "list"], ["node", "list"]])
def test_without_a_master_the_error_names_trundle_core(
    no_master: None, capsys: pytest.CaptureFixture[str], command: list[str]
) -> None:
    assert main(command) == 1
    error = capsys.readouterr().err
    assert error.startswith("ERROR: Unable to communicate with master!\n")
    assert "trundle core" in error
