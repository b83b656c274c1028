"""Published launch files start their robots and run, whatever of them is not there: see `published_launches.txt`."""

import json
import os
import re
import socket
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

_LIST = Path(__file__).with_name("published_launches.txt")
_RUN_S = 20
"""ROS time each of them runs."""
_TIMEOUT_S = 240.0
_AT_ONCE = 5
_LINES = _LIST.read_text().splitlines()
_BATCHES = [_LINES[start : start + _AT_ONCE] for start in range(0, len(_LINES), _AT_ONCE)]
_BAD = re.compile(r"\[ERROR\]|\[FATAL\]|: error:|has died|cannot be started|Traceback")


def test_there_are_enough_of_them() -> None:
    assert len(set(_LINES)) == len(_LINES) >= 40


@pytest.mark.slow
@pytest.mark.parametrize("lines", _BATCHES, ids=lambda lines: lines[0].partition("/")[0])
def test_they_run_without_an_error(shared: Path, tmp_path: Path, lines: Sequence[str]) -> None:
    """What they name and no machine has, compiled nodes most of all, is a warning; all else must be silent."""
    corpus = shared / "corpus"
    if not corpus.is_dir():
        pytest.skip("the published launch files (../shared/corpus) are not beside this checkout")
    rows = json.loads((corpus / "manifest.json").read_text())["launch"]
    variables = {row["file"]: row["env"] for row in rows}

    def launch(line: str) -> tuple[str, str]:
        file, *arguments = line.split()
        home = tmp_path / file.replace("/", "_")
        home.mkdir()
        repository = corpus / "repos" / file.partition("/")[0]
        env = {
            **{key: value for key, value in os.environ.items() if not key.startswith(("ROS_", "GAZEBO_"))},
            **variables[f"repos/{file}"],
            "HOME": str(home),
            "ROS_PACKAGE_PATH": f"{repository}:{corpus / 'repos'}",
            "ROS_MASTER_URI": f"http://127.0.0.1:{_free_port()}",
        }
        words = ["launch", str(corpus / "repos" / file), *arguments, "--headless", "--duration", str(_RUN_S)]
        try:
            done = subprocess.run(
                [sys.executable, "-m", "trundle", *words],
                env=env,
                capture_output=True,
                text=True,
                timeout=_TIMEOUT_S,
                check=False,
            )
        except subprocess.TimeoutExpired as error:
            return line, f"no end within {error.timeout:g} s"
        said = [text for text in (done.stdout + done.stderr).splitlines() if _BAD.search(text)]
        if done.returncode != 0 or said:
            return line, f"exit code {done.returncode}: {said[:3]}"
        return line, "" if "killing on exit" in done.stdout else "nothing was running any more at the end"

    with ThreadPoolExecutor(_AT_ONCE) as pool:
        assert {line: problem for line, problem in pool.map(launch, lines) if problem} == {}


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
