"""Runs programs of other repositories with Debian's rospy and with ours, and compares what they print and publish.

    TRUNDLE_ROSPY_REPOSITORIES=FOLDER:… python -m tests.rospy.compared_runs

prints how many are the same. ORIGINAL_MODULES names folders with modules of the original that Debian's Python lacks.
Each folder is one repository, as checked out. Numbers are masked: the programs run at other times.
"""

import difflib
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from bench.rospy_nodes import find_nodes
from tests.graphs import running_graph
from tests.rospy.original_messages import generate
from tests.rospy.programs import DEBIAN, environment

REPOSITORIES = [Path(each) for each in os.environ.get("TRUNDLE_ROSPY_REPOSITORIES", "").split(os.pathsep) if each]
_OBSERVER = Path(__file__).parent / "observer.py"
_START_S, _STOP_S, _OBSERVE_S = 25.0, 20.0, 150.0
_NUMBER = re.compile(r" *-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
_MISSING = re.compile(r"(?:ModuleNotFoundError|ImportError): (?:No module named|cannot import name) '?([\w.]+)")
_AT_ONCE = 3
Run = dict[str, Any]
"""What a run did: kind → lines, or a value."""


@dataclass(frozen=True)
class Repositories:
    """Repositories whose programs are compared, and the original's modules of their packages."""

    folders: list[Path]
    generated: Path

    @property
    def packages(self) -> list[Path]:
        """Folders with a package.xml."""
        return sorted({path.parent for folder in self.folders for path in folder.rglob("package.xml")})

    def environment(self, python: str, uri: str, home: Path) -> dict[str, str]:
        """Environment of a program; the original finds messages and modules as after catkin_make."""
        env = environment(python, uri, home)
        env["ROS_PACKAGE_PATH"] = os.pathsep.join([*map(str, self.folders), "/usr/share"])
        env |= {"PYTHONUNBUFFERED": "1", "MPLBACKEND": "Agg", "QT_QPA_PLATFORM": "offscreen"}
        if python == DEBIAN:
            sources = [str(each / "src") for each in self.packages if (each / "src" / each.name).is_dir()]
            more = os.environ.get("ORIGINAL_MODULES", "")
            env["PYTHONPATH"] = os.pathsep.join(filter(None, [str(self.generated), *sources, more]))
        return env


def find_programs(folders: Iterable[Path]) -> Iterator[tuple[str, Path]]:
    """Nodes of repositories: pairs (path from the repository's parent, path)."""
    for folder in map(Path.resolve, folders):
        yield from ((str(path.relative_to(folder.parent)), path) for path in find_nodes(folder))


def run(repositories: Repositories, python: str, program: Path) -> Run:
    """What a program printed, published, answered and ended with."""
    with running_graph() as graph, tempfile.TemporaryDirectory() as home:
        env = repositories.environment(python, graph.core.uri, Path(home))
        ours = repositories.environment(sys.executable, graph.core.uri, Path(home))
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            process = subprocess.Popen(
                [python, program], env=env, cwd=program.parent, stdin=subprocess.DEVNULL, stdout=out, stderr=err
            )
            try:
                command = [sys.executable, _OBSERVER, str(_START_S)]
                seen = subprocess.run(
                    command, env=ours, stdout=subprocess.PIPE, text=True, timeout=_OBSERVE_S, check=True
                )
                code = _interrupt(process)
            finally:
                process.kill()
                process.wait()
            streams = [(stream.seek(0), stream.read().decode(errors="replace"))[1] for stream in (out, err)]
    observed = json.loads(_NUMBER.sub(" #", seen.stdout))
    observed["messages"] = {name: mask("\n".join(kept)) for name, kept in observed["messages"].items()}
    return {**observed, "exit code": code, "stdout": mask(streams[0]), "stderr": mask(streams[1])}


def _interrupt(process: subprocess.Popen[bytes]) -> int | None:
    """Exit code after Ctrl-C; None if it goes on."""
    process.send_signal(signal.SIGINT)
    try:
        return process.wait(_STOP_S)
    except subprocess.TimeoutExpired:
        return None


def mask(text: str) -> list[str]:
    """Distinct lines in order, with numbers masked, and tracebacks without the interpreter's files."""
    lines: list[str] = []
    is_traceback = False
    for line in text.splitlines():
        if is_traceback and line.startswith(" "):
            continue
        is_traceback = line.startswith("Traceback")
        masked = _NUMBER.sub(" #", line).rstrip()
        if masked and masked not in lines:
            lines.append(masked)
    return lines


def compare(repositories: Repositories, program: Path) -> str:
    """'same', 'not comparable: WHY', or the differences that two runs of each show."""
    kept: list[str] = []
    for attempt in range(2):
        original = run(repositories, DEBIAN, program)
        if (reason := _why_not_comparable("\n".join(original["stderr"]))) is not None:
            return f"not comparable: {reason}"
        found = list(_differences(original, run(repositories, sys.executable, program)))
        kept = found if attempt == 0 else [line for line in found if line in kept]
        if not kept:
            return "same"
    return "\n".join(["different", *kept])


def _why_not_comparable(errors: str) -> str | None:
    if (missing := _MISSING.search(errors)) is not None:
        return f"the original has no {missing[1]}"
    return "Python 2" if "SyntaxError" in errors or "TabError" in errors else None


def _differences(original: Run, ours: Run) -> Iterator[str]:
    for what in original:
        expected, found = (json.dumps(each[what], indent=1, sort_keys=True).splitlines() for each in (original, ours))
        for line in difflib.ndiff(expected, found):
            if line.startswith(("-", "+")):
                yield f"{what}: {line}"


def compare_all(folders: Iterable[Path]) -> Iterator[tuple[str, str]]:
    """Pairs (program, outcome)."""
    with tempfile.TemporaryDirectory() as generated:
        repositories = Repositories(list(folders), Path(generated))
        generate(repositories.packages, Path(generated))
        programs = [path for _, path in find_programs(repositories.folders)]
        names = [name for name, _ in find_programs(repositories.folders)]
        with ThreadPoolExecutor(_AT_ONCE) as pool:
            yield from zip(names, pool.map(partial(compare, repositories), programs), strict=True)


def main() -> None:
    """Compare the programs of the repositories; print each outcome, then the counts."""
    outcomes = Counter[str]()
    for name, outcome in compare_all(REPOSITORIES):
        print(f"{name}: {outcome}", flush=True)
        outcomes[outcome.partition("\n")[0].partition(":")[0]] += 1
    print(dict(outcomes))


if __name__ == "__main__":
    main()
