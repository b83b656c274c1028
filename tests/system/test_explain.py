"""`trundle explain`: each example of the registry causes the finding that it explains."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from trundle.app.cli.main import main
from trundle.base.explanations import Explanation, explanations

_STARTS = ("trundle launch", "trundle run", "trundle render", "trundle convert")
"""Commands that start more than a reader."""


def _entries() -> list[object]:
    return [
        pytest.param(entry, id=entry.id, marks=[pytest.mark.slow] if _is_slow(entry) else [])
        for entry in explanations().values()
        if entry.files
    ]


def _is_slow(entry: Explanation) -> bool:
    return entry.id == "too-large" or any(line.startswith(_STARTS) for line in entry.commands.splitlines())


@pytest.mark.parametrize("entry", _entries())
def test_an_example_causes_its_finding(
    entry: Explanation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))
    for variable in ("GAZEBO_MODEL_PATH", "ROS_PACKAGE_PATH", "GAZEBO_RESOURCE_PATH"):
        monkeypatch.delenv(variable, raising=False)
    for name, text in entry.files:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)

    for line in entry.commands.splitlines():
        _run(line, monkeypatch)

    output = "".join(capfd.readouterr())
    assert f"[{entry.id}]" in output or f'"id": "{entry.id}"' in output


def _run(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run a command: `trundle` in this process, but for launches, which end by a signal; others by the shell."""
    words = shlex.split(line)
    while "=" in words[0]:
        monkeypatch.setenv(*words.pop(0).split("=", 1))
    if words[0] != "trundle":
        subprocess.run(line, shell=True, check=True)
    elif words[1] == "launch":
        subprocess.run([sys.executable, "-m", *words], check=False, timeout=300)
    else:
        main(words[1:])


def test_the_list_has_a_line_for_each_id(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain"]) == 0

    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines if line.startswith("  ")] == list(explanations())


def test_an_id_is_explained_with_example_and_remedy(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "impossible-inertia"]) == 0

    output = capsys.readouterr().out
    assert output.startswith("impossible-inertia\n\nA link has a mass")
    assert "cart.sdf:\n\n    <sdf version" in output
    assert "$ trundle check cart.sdf" in output
    assert "To do: compute the inertia" in output


def test_an_unknown_id_is_refused_with_similar_ones(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "imposible-inertia"]) == 1
    assert "did you mean 'impossible-inertia'?" in capsys.readouterr().err


def test_ids_are_completed(tmp_path: Path) -> None:
    result = tmp_path / "completions"
    environment = {
        **os.environ,
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(result),
        "COMP_LINE": "trundle explain impos",
        "COMP_POINT": "21",
        "_ARGCOMPLETE_IFS": "\n",
    }
    subprocess.run([sys.executable, "-m", "trundle"], env=environment, check=False, timeout=60)

    assert [word.strip() for word in result.read_text().split()] == ["impossible-inertia"]
