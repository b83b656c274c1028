"""Time to read a large launch file: `trundle launch --nodes` against `roslaunch --nodes`."""

import gzip
import json
import os
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bench.table import Row

CORPUS = Path(__file__).parents[2] / "shared/corpus"
_RUNS = 5
_CANDIDATES = 12
_ROSLAUNCH = "/usr/bin/roslaunch"


def run() -> list[Row]:
    """Alternate processes on the published launch file with the most nodes that both can read."""
    if not (CORPUS / "manifest.json").is_file():
        return []
    for row in _largest():
        file, repository = CORPUS / row["file"], CORPUS / "repos" / row["repo"]
        env = {**os.environ, **row["env"], "ROS_PACKAGE_PATH": f"{repository}:{CORPUS / 'repos'}"}
        words = [word for word in row["argv"] if ":=" in word]
        trundle = [sys.executable, "-m", "trundle", "launch", "--nodes", str(file), *words]
        roslaunch = [_ROSLAUNCH, "--nodes", str(file), *words]
        names = _timed(trundle, env)[1]
        if names is None:
            continue
        name = f"{file.name} ({len(names.split())} nodes), launch --nodes"
        if not shutil.which(_ROSLAUNCH):
            return [Row(name, statistics.median(_timed(trundle, env)[0] for _ in range(_RUNS)), "s", "", None)]
        if _timed(roslaunch, env)[1] is None:
            continue
        pairs = [(_timed(trundle, env)[0], _timed(roslaunch, env)[0]) for _ in range(_RUNS)]
        ratio = statistics.median(trundle_s / roslaunch_s for trundle_s, roslaunch_s in pairs)
        return [Row(name, statistics.median(trundle_s for trundle_s, _ in pairs), "s", "roslaunch --nodes", ratio)]
    return []


def _largest() -> list[dict[str, Any]]:
    """Return the launch files with the most nodes, as counted by roslaunch."""
    rows = [row for row in json.loads((CORPUS / "manifest.json").read_text())["launch"] if row.get("ref")]

    def nodes(row: dict[str, Any]) -> int:
        return len(json.loads(gzip.decompress((CORPUS / row["ref"]).read_bytes())).get("nodes", ()))

    return sorted(rows, key=nodes, reverse=True)[:_CANDIDATES]


def _timed(command: Sequence[str], env: dict[str, str]) -> tuple[float, str | None]:
    """Return the wall time from start to exit [s], and the output; None: it failed."""
    start = time.perf_counter()
    process = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    return time.perf_counter() - start, process.stdout if process.returncode == 0 else None
