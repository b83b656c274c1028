"""Published launch files start their robots and run in spite of missing parts.

Each line of `published_launches.txt` is a launch file with its arguments and, after `->`, topics with messages during
the run; a robot of one link has none.
"""

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import pytest
from tests.graphs import free_port

from trundle.robots.packages.stock import STOCK
from trundle.ros import GraphLoop, Message, Node, to_nsec

_RUN_S = 20
"""ROS time of each launch [s]; flat out if simulated."""
_TIMEOUT_S = 240.0
_AT_ONCE = 3
_MESSAGES = 3
"""Number of messages awaited on each topic; /tf_static has one, latched."""
_LINES = Path(__file__).with_name("published_launches.txt").read_text().splitlines()
_BATCHES = [_LINES[start : start + _AT_ONCE] for start in range(0, len(_LINES), _AT_ONCE)]
_BAD = re.compile(r"\[ERROR\]|\[FATAL\]|: error:|has died|cannot be started|Traceback")
_NO_CONTROLLER = re.compile(r"Could not load controller '(\w+)': (?:no controller of type ')?(\w+)/")
"""Error on a controller that a robot's own package compiles; ros_control's stock controllers must load."""
_NOT_MOUNTED = (
    "fath_pivot_mount_description/urdf/lockmount.urdf.xacro",
    "flir_camera_description/urdf/flir_blackflys.urdf.xacro",
    "lms1xx/urdf/sick_lms1xx.urdf.xacro",
)
"""Files of packages that husky's xacro includes for accessories that it does not carry by default."""


def test_the_list_has_40_launch_files() -> None:
    assert len(set(_LINES)) == len(_LINES) >= 40


@pytest.fixture
def loop() -> Iterator[GraphLoop]:
    with GraphLoop() as running:
        yield running


@pytest.mark.slow
@pytest.mark.parametrize("lines", _BATCHES, ids=lambda lines: lines[0].partition("/")[0])
def test_published_launches_run_without_errors(
    shared: Path, tmp_path: Path, loop: GraphLoop, lines: Sequence[str]
) -> None:
    """Missing parts, mostly compiled nodes, are reported; there are no other errors."""
    corpus = shared / "corpus"
    if not corpus.is_dir():
        pytest.skip("the published launch files (../shared/corpus) are not beside this checkout")
    for name in _NOT_MOUNTED:
        file = tmp_path / "not_mounted" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("<robot/>")
        package = file.parents[1]
        (package / "package.xml").write_text(f"<package><name>{package.name}</name></package>")
    with ThreadPoolExecutor(_AT_ONCE) as pool:
        problems = list(pool.map(partial(_run, corpus=corpus, folder=tmp_path, loop=loop), lines))
    assert [problem for problem in problems if problem] == []


def _run(line: str, corpus: Path, folder: Path, loop: GraphLoop) -> str:
    """Run a launch until all messages have arrived and its duration is over; return the faults."""
    command, _, topics = line.partition(" -> ")
    file, *arguments = command.replace("$(find urdf_tutorial)", str(corpus / "repos/ros+urdf_tutorial")).split()
    rows = json.loads((corpus / "manifest.json").read_text())["launch"]
    home = folder / f"{abs(hash(line))}"
    home.mkdir()
    env = {
        **{key: value for key, value in os.environ.items() if not key.startswith(("ROS_", "GAZEBO_"))},
        **{key: value for row in rows if row["file"] == f"repos/{file}" for key, value in row["env"].items()},
        "HOME": str(home),
        "ROS_PACKAGE_PATH": ":".join(
            map(str, (corpus / "repos" / file.partition("/")[0], corpus / "repos", folder / "not_mounted"))
        ),
        "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}",
    }
    words = ["launch", str(corpus / "repos" / file), *arguments, "--headless", "--speed", "max"]
    with (home / "log").open("w") as log:
        process = subprocess.Popen([sys.executable, "-m", "trundle", *words], env=env, stdout=log, stderr=log)
        try:
            missing = _listen(process, Node("/onlooker", loop=loop, master_uri=env["ROS_MASTER_URI"]), topics.split())
            process.send_signal(signal.SIGINT)
            code = process.wait(_TIMEOUT_S)
        finally:
            process.kill()
            process.wait()
    text = (home / "log").read_text(errors="replace")
    missing_code = {match[1] for match in _NO_CONTROLLER.finditer(text) if match[2] not in STOCK}
    expected = tuple(words for name in missing_code for words in (f"controller '{name}': ", f"Failed to load {name}"))
    errors = [row for row in text.splitlines() if _BAD.search(row) and not any(words in row for words in expected)]
    if code != 130 or errors or missing or "killing on exit" not in text:
        return f"{file}: exit code {code}; no messages: {missing}; errors: {errors[:3]}"
    return ""


def _listen(process: "subprocess.Popen[bytes]", node: Node, topics: Sequence[str]) -> list[str]:
    """Wait for the messages and the duration; return the topics without enough messages."""
    counts = dict.fromkeys(topics, 0)
    clock_ns = [0]

    def on_clock(message: Message) -> None:
        clock_ns[0] = to_nsec(message.clock)

    for topic in topics:

        def count(_message: object, topic: str = topic) -> None:
            counts[topic] += _MESSAGES if topic == "/tf_static" else 1

        node.subscribe(topic, "*", count)
    simulated = "/clock" in counts
    if simulated:
        node.subscribe("/clock", "rosgraph_msgs/Clock", on_clock)
    start = time.monotonic()
    try:
        while process.poll() is None and time.monotonic() < start + _TIMEOUT_S:
            ros_time_s = clock_ns[0] / 1e9 if simulated else time.monotonic() - start
            if ros_time_s >= _RUN_S and all(number >= _MESSAGES for number in counts.values()):
                break
            time.sleep(0.1)
    finally:
        node.loop.run(node.shutdown())
    return [topic for topic, number in counts.items() if number < _MESSAGES]
