"""Runs what a compiled library is made for: a world, or a launch file, in which a plugin or controller is loaded."""

import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from threading import Timer

from .workspace import Target, Workspace

_SUFFIXES = (".so", ".dylib")
_GAZEBO, _CLASSES = b"trundle gazebo plugin", b"_ZN12class_loader4impl13registerClass"
_LOADED = re.compile(r"(?P<what>plugin .*?|controller \S+|hardware \S+.*): (?P<library>\S+), in C\+\+")
_RUN_S, _RUNS, _SIMULATED_S = 90.0, 4, "3"
_NO_LAUNCH = "no launch file, world or robot of its repositories names it"


class LibraryRun:
    """Runs of the launch files and descriptions that name a library, until one loads it."""

    def __init__(self, workspace: Workspace, target: Target) -> None:
        """Prepare the runs of a workspace's target."""
        self._workspace, self._target = workspace, target
        assert target.file is not None
        self._file = target.file

    def result(self) -> tuple[str, str]:
        """Return whether the library is loaded, and by what; "-" for a library that programs are linked with."""
        if self._file.suffix not in _SUFFIXES:
            return "-", ""
        contents = self._file.read_bytes()
        exported = self._exported_names() if _CLASSES in contents else []
        if _GAZEBO not in contents and not exported:
            return "-", ""
        ends: list[str] = []
        for words in islice(self._commands([self._file.name, *exported]), _RUNS):
            loaded, end = self._run(words)
            if loaded:
                return "is loaded", f"{loaded}; {words[1]}{end}"
            ends.append(f"{Path(words[1]).name}{end or ': not loaded'}")
        return ("not loaded", "; ".join(ends)) if ends else ("not loaded", _NO_LAUNCH)

    def _exported_names(self) -> list[str]:
        """Return the names of the classes that the package's plugin descriptions have for this library."""
        folder = self._workspace.folders[self._target.package]
        names: list[str] = []
        for file in folder.rglob("*.xml"):
            text = file.read_text(errors="replace")
            if re.search(rf"<library\s+path=\"[^\"]*{re.escape(self._target.name)}", text):
                names += re.findall(r"<class[^>]*\sname=\"([^\"]+)\"", text)
        return names

    def _commands(self, words: list[str]) -> Iterator[list[str]]:
        for file in self._workspace.launches_that_name(words):
            yield ["launch", str(file), "--headless", "--port", "0", "--duration", _SIMULATED_S, "--speed", "max"]
        for file in self._workspace.descriptions_that_name(self._file.name):
            yield ["run", str(file), "--headless", "--duration", _SIMULATED_S, "--speed", "max"]

    def _run(self, words: list[str]) -> tuple[str, str]:
        """Run a command; return what it loaded, and how it ended: "" if without an error."""
        with tempfile.TemporaryDirectory() as home, tempfile.TemporaryFile() as output:
            process = subprocess.Popen(
                [sys.executable, "-m", "trundle", *words],
                env=self._workspace.running_environment(ROS_HOME=home),
                cwd=home,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
            )
            limit = Timer(_RUN_S, process.terminate)
            limit.start()
            try:
                code = process.wait()
            finally:
                limit.cancel()
            output.seek(0)
            text = output.read().decode(errors="replace")
        loaded = [found["what"] for found in _LOADED.finditer(text) if Path(found["library"]).name == self._file.name]
        errors = [line for line in text.splitlines() if "error" in line.lower()]
        end = "" if code in (0, -15, 143) else f": exit code {code}: {(errors or [''])[-1][:160]}"
        return (loaded[0] if loaded else ""), end
