"""dynamic_reconfigure/dynparam from the command line, on a stand-in with options."""

from pathlib import Path

import pytest

NODE = "/depthimage_to_laserscan"


@pytest.fixture
def dynparam(graph):
    graph.start("depthimage_to_laserscan/depthimage_to_laserscan", scan_height=3)
    names = iter(range(100))

    def run(arguments: str, **params: object) -> int:
        return graph.start("dynamic_reconfigure/dynparam", arguments, name=f"d{next(names)}", **params).result(60.0)

    graph.loop.run(graph.client.wait_for_service(f"{NODE}/set_parameters"), 60.0)
    return run


def test_list_get_set_dump_and_load(dynparam, graph, capsys, tmp_path: Path) -> None:
    assert dynparam("list") == 0
    assert dynparam(f"set {NODE} range_max 5") == 0
    assert dynparam(f"dump {NODE} {tmp_path / 'a.yaml'}") == 0
    assert dynparam(f'set {NODE} {{"scan_height":7,"range_max":3.5}}') == 0
    assert dynparam(f"get {NODE}") == 0
    assert dynparam(f"load {NODE} {tmp_path / 'a.yaml'}") == 0
    assert dynparam("set_from_parameters " + NODE, range_min=0.25) == 0

    out = capsys.readouterr().out
    assert out.startswith(f"{NODE}\n")
    assert "'scan_height': 7" in out
    assert "'range_max': 3.5" in out
    now = graph.loop.run(graph.client.params.get(NODE))
    assert (now["scan_height"], now["range_max"], now["range_min"]) == (3, 5.0, 0.25)


def test_a_dump_of_the_original_is_loaded(dynparam, graph, tmp_path: Path) -> None:
    """The original dumps a Python object with its groups."""
    file = tmp_path / "a.yaml"
    file.write_text(
        "!!python/object/new:dynamic_reconfigure.encoding.Config\ndictitems:\n  scan_height: 9\n"
        "  groups: !!python/object/new:dynamic_reconfigure.encoding.Config\n    dictitems: {id: 0}\n    state: []\n"
        "state: []\n"
    )
    assert dynparam(f"load {NODE} {file}") == 0
    assert graph.loop.run(graph.client.params.get(f"{NODE}/scan_height")) == 9


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (f"set {NODE} speed 1", "don't know parameter: speed; there are: scan_height"),
        (f"set {NODE} scan_height x", "'x' is not of type int"),
        ("get -t 0.2 /nobody", "/nobody sent no options within 0.2 s"),
        (f"load {NODE} /no/such.yaml", "No such file"),
    ],
)
def test_invalid_commands_are_reported(dynparam, capfd, arguments: str, message: str) -> None:
    assert dynparam(arguments) == 1
    assert message in "".join(capfd.readouterr())


def test_a_usage_error_exits_with_two(dynparam) -> None:
    assert dynparam("fly") == 2
