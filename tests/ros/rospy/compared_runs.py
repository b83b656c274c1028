"""Runs programs of other repositories with Debian's rospy and with ours, and compares what they print and publish.

    TRUNDLE_ROSPY_REPOSITORIES=FOLDER:… python -m tests.ros.rospy.compared_runs

prints how many are the same. Each folder is one checked-out repository. ORIGINAL_MODULES names folders with modules of
the original that Debian's Python lacks, SHARED_MODULES folders with other libraries, for both. Numbers are masked, for
programs run at different times, except in messages whose values repeat from run to run.
"""

import difflib
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Generator, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from bench.rospy_nodes import find_nodes
from tests.graphs import running_graph
from tests.ros.rospy.original_messages import generate
from tests.ros.rospy.programs import DEBIAN, environment

REPOSITORIES = [Path(folder) for folder in os.environ.get("TRUNDLE_ROSPY_REPOSITORIES", "").split(os.pathsep) if folder]
_PROGRAMS = Path(__file__).parents[2] / "data/compared_runs"
_OBSERVER, _TURTLES = _PROGRAMS / "observer.py", _PROGRAMS / "turtles.py"
_INSTALLED = Path("/usr/lib/python3/dist-packages")
_START_S, _STOP_S, _OBSERVE_S = 25.0, 20.0, 150.0
_NUMBER = re.compile(r" *-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
_FOLDER = re.compile(r'File "[^"]*/')
_STAMP = re.compile(r"\b(secs|nsecs|seq):.*")
_MISSING = re.compile(r"(?:ModuleNotFoundError|ImportError): (?:No module named|cannot import name) '?([\w.]+)")
_AT_ONCE = 3
Run = dict[str, Any]
"""Observations of a run: kind → lines, or a value."""


@dataclass(frozen=True)
class Repository:
    """A repository whose programs are compared, and the original's modules of its messages."""

    folder: Path
    generated: Path

    @property
    def packages(self) -> list[Path]:
        """Folders with a package.xml."""
        return sorted(path.parent for path in self.folder.rglob("package.xml"))

    def environment(self, python: str, uri: str, home: Path) -> dict[str, str]:
        """Environment of a program; the original finds messages and modules as after catkin_make."""
        env = environment(python, uri, home)
        env["ROS_PACKAGE_PATH"] = f"{self.folder}{os.pathsep}/usr/share"
        env |= {"PYTHONUNBUFFERED": "1", "MPLBACKEND": "Agg", "QT_QPA_PLATFORM": "offscreen"}
        folders = [os.environ.get("SHARED_MODULES", "")]
        if python == DEBIAN:
            packages = [package for package in self.packages if not (_INSTALLED / package.name).is_dir()]
            sources = [str(package / "src") for package in packages if (package / "src" / package.name).is_dir()]
            folders += [str(self.generated), *sources, os.environ.get("ORIGINAL_MODULES", "")]
        env["PYTHONPATH"] = os.pathsep.join(filter(None, [env.get("PYTHONPATH", ""), *folders]))
        return env


def find_programs(folder: Path) -> dict[str, Path]:
    """Nodes of a repository: path from the repository's parent → path."""
    return {str(path.relative_to(folder.resolve().parent)): path for path in find_nodes(folder.resolve())}


def run(repository: Repository, python: str, program: Path) -> Run:
    """Lines printed, messages published, service responses and exit code of a program."""
    with running_graph() as graph, tempfile.TemporaryDirectory() as home:
        env = repository.environment(python, graph.core.uri, Path(home))
        ours = repository.environment(sys.executable, graph.core.uri, Path(home))
        with _turtles(program, ours), tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            process = subprocess.Popen(
                [python, program],
                env=env,
                cwd=program.parent,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=err,
                start_new_session=True,
            )
            try:
                command = [sys.executable, _OBSERVER, str(process.pid), str(_START_S)]
                observed = subprocess.run(
                    command, env=ours, stdout=subprocess.PIPE, text=True, timeout=_OBSERVE_S, check=True
                )
                code = _interrupt(process)
            finally:
                _kill_session(process)
            streams = [(stream.seek(0), stream.read().decode(errors="replace"))[1] for stream in (out, err)]
    printed = {"stdout": mask(streams[0]), "stderr": mask(streams[1])}
    return {**masked(json.loads(observed.stdout)), "exit code": code, **printed}


def masked(observed: Run) -> Run:
    """Output of the observer; numbers are masked, except in the values of messages."""
    published = {name: "\n".join(texts) for name, texts in observed["messages"].items()}
    return {
        **{kind: _masked_value(value) for kind, value in observed.items()},
        "messages": _by_masked_name({name: mask(text) for name, text in published.items()}),
        "values": _by_masked_name({name: _STAMP.sub(r"\1 #", text).splitlines() for name, text in published.items()}),
    }


def _masked_value(value: Any) -> Any:
    match value:
        case str():
            return _NUMBER.sub(" #", value)
        case list():
            return [_masked_value(item) for item in value]
        case dict():
            return _by_masked_name({name: _masked_value(item) for name, item in value.items()})
        case _:
            return value


def _by_masked_name(lists: Mapping[str, list[Any]]) -> dict[str, list[Any]]:
    """Lists by name, merged where names differ only in numbers, in the order of the names."""
    merged = defaultdict[str, list[Any]](list)
    for name, lines in sorted(lists.items()):
        merged[_NUMBER.sub(" #", name)] += lines
    return dict(merged)


def _kill_session(process: subprocess.Popen[bytes]) -> None:
    """Kill a program and its child processes."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


@contextmanager
def _turtles(program: Path, env: Mapping[str, str]) -> Generator[None]:
    """A stand-in for turtlesim, for programs that use it."""
    if b"turtlesim" not in program.read_bytes():
        yield
        return
    with subprocess.Popen([sys.executable, _TURTLES], env=dict(env), stdout=subprocess.PIPE, text=True) as turtles:
        assert turtles.stdout is not None
        assert turtles.stdout.readline() == "ready\n"
        try:
            yield
        finally:
            turtles.kill()


def _interrupt(process: subprocess.Popen[bytes]) -> int | None:
    """Exit code after Ctrl-C; None if it keeps running."""
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
        masked = _NUMBER.sub(" #", _FOLDER.sub('File "', line)).rstrip()
        if masked and masked not in lines:
            lines.append(masked)
    return lines


def compare(repository: Repository, program: Path) -> str:
    """'same', 'not comparable: REASON', or the differences that both of two runs show."""
    differences: list[str] = []
    for attempt in range(2):
        original = run(repository, DEBIAN, program)
        if (reason := _why_not_comparable("\n".join(original["stderr"]))) is not None:
            return f"not comparable: {reason}"
        lines = list(_differences(original, run(repository, sys.executable, program)))
        differences = lines if attempt == 0 else [line for line in lines if line in differences]
        if not differences:
            return "same"
    return "\n".join(["different", *differences])


def _why_not_comparable(errors: str) -> str | None:
    if (missing := _MISSING.search(errors)) is not None:
        return f"the original has no {missing[1]}"
    return "Python 2" if "SyntaxError" in errors or "TabError" in errors else None


def _differences(original: Run, ours: Run) -> Iterator[str]:
    for kind in original:
        expected, actual = (
            json.dumps(result[kind], indent=1, sort_keys=True).splitlines() for result in (original, ours)
        )
        for line in difflib.ndiff(expected, actual):
            if line.startswith(("-", "+")):
                yield f"{kind}: {line}"


def compare_all(folders: Iterable[Path]) -> Iterator[tuple[str, str]]:
    """Pairs (program, verdict); each repository by itself."""
    for folder in folders:
        with tempfile.TemporaryDirectory() as generated, ThreadPoolExecutor(_AT_ONCE) as pool:
            repository = Repository(folder, Path(generated))
            generate(repository.packages, repository.generated)
            programs = find_programs(folder)
            verdicts = pool.map(partial(compare, repository), programs.values())
            yield from zip(programs, verdicts, strict=True)


def main() -> None:
    """Compare the programs of the repositories; print each verdict, then the counts."""
    counts = Counter[str]()
    for name, verdict in compare_all(REPOSITORIES):
        print(f"{name}: {verdict}", flush=True)
        counts[verdict.partition("\n")[0].partition(":")[0]] += 1
    print(dict(counts))


if __name__ == "__main__":
    main()
