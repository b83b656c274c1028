"""Compiles the C++ of checked-out repositories by catkin_make, starts their programs, and lists which run.

    python -m bench.cpp_nodes FOLDER[,FOLDER…]… [--targets FILE] [--list FILE] [--workspaces FOLDER]

Each argument is a repository with the repositories that it needs, which become one workspace. A program starts as the
first launch file of its repository says that names it, with its parameters, arguments and remappings, on a master of
its own. It **starts** if it registers at the master, or ends by itself without an error. Messages of the topics that
it subscribes to are published, all zero but their stamps; the list says on how many of its topics it **publishes**
within ten seconds. `--targets` is a table with the columns repository, package and target: only those.
"""

import argparse
import csv
import os
import re
import shlex
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import IO, NamedTuple

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.launch import LaunchNode, LaunchPlan, ParamCommand, read_launch
from trundle.robots.packages import Packages
from trundle.ros import Core, GraphLoop, MasterProxy, MessageError, Node, RosError
from trundle.ros.messages.message_library import Messages
from trundle.ros.node.publisher import Publisher

_REPORTED = re.compile(r"^--   (?P<kind>program|library) (?P<name>\S+) \(.*?\): (?P<state>.+)$")
_START_S, _PUBLISH_S, _POLL_S, _PERIOD_S = 20.0, 10.0, 0.1, 0.05
_TIMEOUT_S = 3600
_MAX_LENGTH = 120
_COLUMNS = ("repository", "package", "target", "built", "starts", "publishes")


class Target(NamedTuple):
    """Target of a package, and what catkin_make says of it."""

    package: str
    kind: str
    name: str
    state: str

    @property
    def file(self) -> Path | None:
        """The compiled file."""
        return Path(self.state.removeprefix("built: ")) if self.state.startswith("built: ") else None


class Workspace:
    """Workspace of linked repositories."""

    def __init__(self, base: Path, repositories: Iterable[Path]) -> None:
        self.base = base
        (base / "src").mkdir(parents=True, exist_ok=True)
        for folder in repositories:
            link = base / "src" / folder.name
            if not link.exists():
                link.symlink_to(folder.resolve(), target_is_directory=True)
        self.environment = {
            name: value for name, value in os.environ.items() if not name.startswith(("ROS", "CMAKE_P"))
        }

    def build(self) -> list[Target]:
        """Run catkin_make, and return its report."""
        command = [sys.executable, "-m", "trundle", "--as", "catkin_make"]
        environment = {**self.environment, "PWD": str(self.base)}
        done = subprocess.run(
            command, cwd=self.base, env=environment, capture_output=True, text=True, check=False, timeout=_TIMEOUT_S
        )
        (self.base / "log").write_text(done.stdout + done.stderr)
        targets: list[Target] = []
        package = ""
        for line in done.stdout.splitlines():
            if line.startswith("-- +++ processing catkin package: "):
                package = line.split("'")[1]
            elif (reported := _REPORTED.match(line)) is not None:
                targets.append(Target(package, reported["kind"], reported["name"], reported["state"]))
        return targets

    def packages(self) -> Packages:
        """Return the packages of the sources."""
        source = self.base / "src"
        return Packages({**self.environment, "ROS_PACKAGE_PATH": str(source)}, start=source)

    def launch_of(self, target: Target) -> tuple[LaunchPlan, LaunchNode] | None:
        """Return the launch that starts a program, and its node there."""
        packages = self.packages()
        folders = packages.ros_packages().values()
        for file in sorted(file for folder in folders for file in folder.rglob("*.launch")):
            if target.name not in file.read_text(errors="replace"):
                continue
            try:
                plan = read_launch(file, packages=packages, report=Diagnostics(), env=self.environment)
            except (DescriptionError, OSError):
                continue
            for node in plan.nodes:
                if (node.package, node.type) == (target.package, target.name):
                    return plan, node
        return None


class Run:
    """Master, and a program that is started there."""

    def __init__(self, workspace: Workspace, target: Target, home: str) -> None:
        self._workspace, self._target, self._home = workspace, target, home
        self._messages = Messages()
        for name, folder in workspace.packages().ros_packages().items():
            self._messages.add_package(name, folder)

    def result(self) -> tuple[str, str]:
        """Start the program; return how it started, and what it publishes."""
        with GraphLoop() as loop:
            core = Core(loop, port=0)
            loop.run(core.start(), 60)
            loop.run(core.wait_ready(), 60)
            try:
                with tempfile.TemporaryFile() as output:
                    process = self._start(core.uri, output)
                    try:
                        started = self._wait(process, core.uri, output)
                        return started, self._published(core.uri, loop) if started == "starts" else ""
                    finally:
                        process.kill()
                        process.wait()
            finally:
                loop.run(core.stop(), 60)

    def _start(self, uri: str, output: IO[bytes]) -> "subprocess.Popen[bytes]":
        file = self._target.file
        assert file is not None
        found = self._workspace.launch_of(self._target)
        command = [str(file)]
        environment = {
            **self._workspace.environment,
            "ROS_MASTER_URI": uri,
            "ROS_HOME": self._home,
            "ROS_PACKAGE_PATH": str(self._workspace.base / "src"),
            "CMAKE_PREFIX_PATH": str(self._workspace.base / "devel"),
        }
        if found is not None:
            plan, node = found
            for param in plan.params:
                if not isinstance(param.value, ParamCommand):
                    MasterProxy(uri).call("setParam", param.name, param.value)
            command += (
                shlex.split(node.arguments) + [f"{a}:={b}" for a, b in node.remappings] + [f"__name:={node.name}"]
            )
            environment |= {"ROS_NAMESPACE": node.namespace, **dict(node.env)}
        return subprocess.Popen(
            command, env=environment, cwd=self._home, stdin=subprocess.DEVNULL, stdout=output, stderr=output
        )

    def _wait(self, process: "subprocess.Popen[bytes]", uri: str, output: IO[bytes]) -> str:
        end = time.monotonic() + _START_S
        while process.poll() is None and time.monotonic() < end:
            if any(_topics_of_others(uri)):
                return "starts"
            time.sleep(_POLL_S)
        if process.poll() is None:
            return "runs, but does not register"
        output.seek(0)
        lines = output.read().decode(errors="replace").strip().splitlines()
        return (
            "ends" if process.returncode == 0 else f"exit code {process.returncode}: {lines[-1][:120] if lines else ''}"
        )

    def _published(self, uri: str, loop: GraphLoop) -> str:
        """Publish what the program subscribes to; return on how many of its topics a message came."""
        node = Node("bench_cpp_nodes", loop=loop, master_uri=uri, rosout=False)
        received: set[str] = set()
        inputs: dict[str, tuple[Publisher, str]] = {}
        outputs: set[str] = set()
        end = time.monotonic() + _PUBLISH_S
        try:
            while time.monotonic() < end:
                published, subscribed, _ = _topics_of_others(uri)
                types = dict(MasterProxy(uri).call("getTopicTypes"))
                for topic in published - outputs:
                    outputs.add(topic)
                    node.subscribe(topic, types[topic], lambda _, topic=topic: received.add(topic))
                for topic in subscribed - published - inputs.keys():
                    inputs[topic] = node.advertise(topic, types[topic]), types[topic]
                for publisher, kind in inputs.values():
                    publisher.publish(self._messages.new(kind))
                if outputs and received == outputs:
                    break
                time.sleep(_PERIOD_S)
        except (MessageError, KeyError) as error:
            return str(error)
        finally:
            loop.run(node.shutdown(), 60)
        return f"publishes on {len(received)} of {len(outputs)} topics"


def _topics_of_others(uri: str) -> tuple[set[str], set[str], set[str]]:
    """Return topics published and subscribed to, and services offered, by the program."""
    try:
        state = MasterProxy(uri).call("getSystemState")
    except RosError:
        return set(), set(), set()
    own = {"/rosout", "/bench_cpp_nodes"}
    published, subscribed, services = ({name for name, nodes in kind if {*nodes} - own} for kind in state)
    return published - {"/rosout"}, subscribed - {"/clock"}, services


def main() -> int:
    """Build and start what the command line names."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="FOLDER[,FOLDER…]")
    parser.add_argument("--targets", type=Path, help="table with the columns repository, package, target")
    parser.add_argument("--list", type=Path, help="file for the table of results")
    parser.add_argument("--workspaces", type=Path, help="folder that keeps the workspaces")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        rows = [
            row for words in args.folders for row in _rows(words.split(","), args.workspaces or Path(temporary), args)
        ]
    text = "\n".join("\t".join(row) for row in [_COLUMNS, *rows])
    print(text)
    if args.list:
        args.list.write_text(text + "\n")
    programs = [row for row in rows if row[4] != "-"]
    print(f"{sum(row[3] == 'compiles' for row in rows)} of {len(rows)} targets compile")
    print(f"{sum(row[4] in ('starts', 'ends') for row in programs)} of {len(programs)} programs start")
    return 0


def _rows(folders: list[str], workspaces: Path, args: argparse.Namespace) -> Iterable[tuple[str, ...]]:
    paths = [Path(folder) for folder in folders]
    repository = paths[0].name
    workspace = Workspace(workspaces.resolve() / repository, paths)
    wanted = None if args.targets is None else _wanted(args.targets, repository)
    for target in workspace.build():
        if wanted is not None and (target.package, target.name) not in wanted:
            continue
        built = "compiles" if target.file else target.state
        started, published = "-", ""
        if target.file and target.kind == "program":
            with tempfile.TemporaryDirectory() as home:
                started, published = Run(workspace, target, home).result()
        yield repository, target.package, target.name, built, started, published


def _wanted(table: Path, repository: str) -> set[tuple[str, str]]:
    with table.open(newline="") as file:
        rows: Iterable[Mapping[str, str]] = csv.DictReader(file, delimiter="\t")
        return {(row["package"], row["target"]) for row in rows if row["repository"].replace("/", "+") == repository}


if __name__ == "__main__":
    sys.exit(main())
