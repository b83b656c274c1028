"""Targets in turn, each in a process of its own, watched and started again; the figures of all runs."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

from .catalog import NATIVE
from .findings import Findings
from .target import ROOT

_SLICE_S = 120.0
"""Longest turn of a target: long runs go round all of them again and again."""
_HANG_S, _BUSY_S = 120.0, 60.0
"""Wall time after which an input hangs that waits, and processor time for one that computes: other programs may keep
the processors busy, and the first inputs load and instrument modules.
"""
_STARTING_S = 180.0
_POLL_S = 0.5
_EDGES = re.compile(rb"^#\d+\s.* cov: (\d+) .*?corp: (\d+)", re.MULTILINE)
_LONGEST_REPORT = 20_000


@dataclass(slots=True)
class Turn:
    """Figures of one turn of one target."""

    seconds: float = 0.0
    executions: int = 0
    edges: int = 0
    corpus: int = 0
    findings: dict[str, int] = field(default_factory=dict[str, int])

    def line(self, name: str) -> str:
        """Return the progress line."""
        edges = f"{self.edges:6} edges {self.corpus:5} inputs" if self.edges else "      not guided by coverage"
        rate = self.executions / max(self.seconds, 1e-3)
        found = f"  FOUND {' '.join(sorted(self.findings))}" if self.findings else ""
        return f"fuzz: {name:16} {self.seconds:4.0f} s {self.executions:8,} executions {rate:7.1f}/s {edges}{found}"


class Campaign:
    """A run over targets; its files are in one folder. Use it in a `with` statement."""

    def __init__(self, out: Path, sanitized: Path | None, sanitizers: dict[str, str]) -> None:
        """Create.

        Args:
            out: folder of corpora, findings and the summary, which later runs go on with.
            sanitized: folder of the C++ with sanitizers; None: there is none.
            sanitizers: variables of processes that use it.
        """
        self._out = out
        self._run = tempfile.TemporaryDirectory(prefix="trundle-fuzz-")
        """Folders of processes; outside of workspaces, which readers search for packages."""
        self._sanitized, self._sanitizers = sanitized, sanitizers
        self._lock = threading.Lock()
        self.found: dict[str, int] = {}
        """Name of each finding → number of inputs, in this run."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._run.cleanup()

    def run(self, names: Sequence[str], seconds: float, jobs: int) -> None:
        """Give every target the same time, in turns."""
        each = seconds * min(jobs, len(names)) / len(names)
        rounds = max(1, round(each / _SLICE_S))
        with ThreadPoolExecutor(jobs) as pool:
            for _ in range(rounds):
                for turn in [pool.submit(self._turn, name, each / rounds) for name in names]:
                    turn.result()

    def repeat(self, name: str, file: Path) -> int:
        """Feed one input, and print what it does; 1 if that is a finding."""
        folder = self._folder(name)
        process = self._start(name, folder, "--input", str(file))
        code = process.wait()
        text = (folder / "printed").read_text(errors="replace")
        findings = _statistics(folder)[2]
        for finding in findings:
            text += (self._out / "findings" / finding / "report.txt").read_text(errors="replace")
        print(text or f"fuzz: {name} takes or refuses it")
        return 1 if code or findings else 0

    def _turn(self, name: str, seconds: float) -> None:
        """Run a target for some time, again whenever an input has ended its process."""
        turn = Turn()
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 1.0 or not turn.seconds:
            folder = self._folder(name)
            process = self._start(name, folder, "--seconds", str(left))
            reason = _watch(process, folder, left)
            printed = (folder / "printed").read_bytes()
            took, executions, found = _statistics(folder)
            if reason is not None:
                found |= self._report(name, folder, reason, printed)
            turn.seconds += max(took, 1e-3)
            turn.executions += executions
            turn.findings |= found
            if guided := _EDGES.findall(printed):
                turn.edges, turn.corpus = int(guided[-1][0]), int(guided[-1][1])
            if reason is not None and not executions:
                break  # it does not even start
        with self._lock:
            print(turn.line(name), file=sys.stderr, flush=True)
            self.found |= turn.findings
            self._add_to_summary(name, turn)

    def _start(self, name: str, folder: Path, *more: str) -> "subprocess.Popen[bytes]":
        for each in ("home", "cache", "tmp"):
            (folder / each).mkdir()
        variables = {
            key: value for key, value in os.environ.items() if not key.startswith(("ROS", "GAZEBO", "TRUNDLE"))
        }
        variables |= {"HOME": f"{folder}/home", "XDG_CACHE_HOME": f"{folder}/cache", "TMPDIR": f"{folder}/tmp"}
        variables |= {"PYTHONPATH": str(ROOT), "MUJOCO_LOG": "0"}
        command = [sys.executable, "-m", "fuzz.worker", name, str(folder), "--findings", str(self._out / "findings")]
        command += ["--corpus", str(self._out / "corpus" / name), *more]
        if name in NATIVE and self._sanitized is not None:
            command += ["--sanitized", str(self._sanitized)]
            variables |= self._sanitizers
        with (folder / "printed").open("ab") as printed:
            return subprocess.Popen(
                command, cwd=folder / "home", env=variables, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                stderr=printed, start_new_session=True,
            )  # fmt: skip

    def _folder(self, name: str) -> Path:
        """Return an empty folder for a process."""
        folder = Path(self._run.name) / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder

    def _report(self, name: str, folder: Path, reason: str, printed: bytes) -> dict[str, int]:
        findings = Findings(self._out / "findings", name)
        current = folder / "current"
        details = printed[-_LONGEST_REPORT:].decode(errors="replace")
        findings.add(reason, details, current.read_bytes() if current.exists() else b"")
        return findings.names

    def _add_to_summary(self, name: str, turn: Turn) -> None:
        """Add to the figures of all runs."""
        file = self._out / "summary.json"
        summary = json.loads(file.read_text()) if file.exists() else {}
        row = summary.setdefault(name, {"hours": 0.0, "executions": 0, "findings": []})
        row["hours"] = round(row["hours"] + turn.seconds / 3600, 4)
        row["executions"] += turn.executions
        row["edges"], row["corpus"] = max(turn.edges, row.get("edges", 0)), max(turn.corpus, row.get("corpus", 0))
        row["findings"] = sorted({*row["findings"], *turn.findings})
        temporary = file.with_suffix(".tmp")
        temporary.write_text(json.dumps(summary, indent=1, sort_keys=True) + "\n")
        temporary.replace(file)


def _watch(process: "subprocess.Popen[bytes]", folder: Path, seconds: float) -> str | None:
    """Wait for a process; return why it ended as it should not have."""
    current = folder / "current"
    end = time.monotonic() + seconds + 10 * _STARTING_S
    fed, since, since_cpu = 0.0, time.monotonic() + _STARTING_S - _HANG_S, 0.0
    while process.poll() is None:
        time.sleep(_POLL_S)
        now, cpu = time.monotonic(), _processor_s(process.pid)
        if current.exists() and current.stat().st_mtime != fed:
            fed, since, since_cpu = current.stat().st_mtime, now, cpu
        waits, computes = now - since > _HANG_S and cpu - since_cpu < 1.0, cpu - since_cpu > _BUSY_S
        if waits or (computes and fed):
            process.send_signal(signal.SIGABRT)  # faulthandler prints where it is
            time.sleep(_POLL_S)
            _end(process)
            return f"hang: no end after {now - since:.0f} s, {cpu - since_cpu:.0f} of them of the processor"
        if now > end:
            _end(process)
            return "hang: it did not end in time"
    _end(process)
    code = process.returncode
    return None if code == 0 else f"crash: the process ended with {code}"


def _processor_s(process: int) -> float:
    """Return the processor time of a process [s]; 0 where it has ended."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _end(process: "subprocess.Popen[bytes]") -> None:
    """End a process and all that it has started."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def _statistics(folder: Path) -> tuple[float, int, dict[str, int]]:
    """Return seconds, executions and findings of a process."""
    file = folder / "statistics.json"
    if not file.exists():
        return 0.0, 0, {}
    counts = json.loads(file.read_text())
    return counts["seconds"], counts["executions"], counts["findings"]
