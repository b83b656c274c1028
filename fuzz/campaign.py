"""Targets in turn, in monitored processes that are restarted; statistics of all runs."""

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
"""Maximum duration of a target's turn: long runs repeat all targets."""
_HANG_S, _BUSY_S = 120.0, 60.0
"""Wall time after which a waiting input hangs, and CPU time for a computing input: other programs may use the CPU,
and the first inputs load and instrument modules.
"""
_STARTING_S = 180.0
_POLL_S = 0.5
_EDGES = re.compile(rb"^#\d+\s.* cov: (\d+) .*?corp: (\d+)", re.MULTILINE)
_MAX_REPORT_BYTES = 20_000


@dataclass(slots=True)
class Turn:
    """Statistics of one turn of one target."""

    seconds: float = 0.0
    executions: int = 0
    edges: int = 0
    corpus: int = 0
    findings: dict[str, int] = field(default_factory=dict[str, int])

    def line(self, name: str) -> str:
        """Return the progress line."""
        edges = f"{self.edges:6} edges {self.corpus:5} inputs" if self.edges else "      not guided by coverage"
        rate = self.executions / max(self.seconds, 1e-3)
        findings = f"  FOUND {' '.join(sorted(self.findings))}" if self.findings else ""
        return f"fuzz: {name:16} {self.seconds:4.0f} s {self.executions:8,} executions {rate:7.1f}/s {edges}{findings}"


class Campaign:
    """A run over targets; its files are in one folder. Use it in a `with` statement."""

    def __init__(self, out: Path, sanitized: Path | None, sanitizers: dict[str, str]) -> None:
        """Create.

        Args:
            out: folder of corpora, findings and the summary, which later runs continue.
            sanitized: folder of the C++ libraries with sanitizers; None: not built.
            sanitizers: environment variables of processes that use them.
        """
        self._out = out
        self._run = tempfile.TemporaryDirectory(prefix="trundle-fuzz-")
        """Folder of the processes' folders, outside of workspaces, in which readers search for packages."""
        self._sanitized, self._sanitizers = sanitized, sanitizers
        self._lock = threading.Lock()
        self.found: dict[str, int] = {}
        """Name of each finding → number of inputs, in this run."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._run.cleanup()

    def run(self, names: Sequence[str], seconds: float, jobs: int) -> None:
        """Run all targets in turns for the same time."""
        target_s = seconds * min(jobs, len(names)) / len(names)
        rounds = max(1, round(target_s / _SLICE_S))
        with ThreadPoolExecutor(jobs) as pool:
            for _ in range(rounds):
                for turn in [pool.submit(self._turn, name, target_s / rounds) for name in names]:
                    turn.result()

    def repeat(self, name: str, file: Path) -> int:
        """Feed one input, and print the result; return 1 if it is a finding."""
        folder = self._folder(name)
        process = self._start(name, folder, "--input", str(file))
        code = process.wait()
        text = (folder / "printed").read_text(errors="replace")
        findings = _statistics(folder)[2]
        for finding in findings:
            text += (self._out / "findings" / finding / "report.txt").read_text(errors="replace")
        print(text or f"fuzz: {name} accepts or refuses it without a finding")
        return 1 if code or findings else 0

    def _turn(self, name: str, seconds: float) -> None:
        """Run a target for some time, and restart it when an input has ended its process."""
        turn = Turn()
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 1.0 or not turn.seconds:
            folder = self._folder(name)
            process = self._start(name, folder, "--seconds", str(left))
            reason = _watch(process, folder, left)
            printed = (folder / "printed").read_bytes()
            elapsed_s, executions, findings = _statistics(folder)
            if reason is not None:
                findings |= self._report(name, folder, reason, printed)
            turn.seconds += max(elapsed_s, 1e-3)
            turn.executions += executions
            turn.findings |= findings
            if coverage := _EDGES.findall(printed):
                turn.edges, turn.corpus = int(coverage[-1][0]), int(coverage[-1][1])
            if reason is not None and not executions:
                break  # the target cannot start
        with self._lock:
            print(turn.line(name), file=sys.stderr, flush=True)
            self.found |= turn.findings
            self._add_to_summary(name, turn)

    def _start(self, name: str, folder: Path, *arguments: str) -> "subprocess.Popen[bytes]":
        for subfolder in ("home", "cache", "tmp"):
            (folder / subfolder).mkdir()
        variables = {
            key: value for key, value in os.environ.items() if not key.startswith(("ROS", "GAZEBO", "TRUNDLE"))
        }
        variables |= {"HOME": f"{folder}/home", "XDG_CACHE_HOME": f"{folder}/cache", "TMPDIR": f"{folder}/tmp"}
        variables |= {"PYTHONPATH": str(ROOT), "MUJOCO_LOG": "0"}
        command = [sys.executable, "-m", "fuzz.worker", name, str(folder), "--findings", str(self._out / "findings")]
        command += ["--corpus", str(self._out / "corpus" / name), *arguments]
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
        details = printed[-_MAX_REPORT_BYTES:].decode(errors="replace")
        findings.add(reason, details, current.read_bytes() if current.exists() else b"")
        return findings.names

    def _add_to_summary(self, name: str, turn: Turn) -> None:
        """Add a turn to the statistics of all runs."""
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
    """Wait for a process; return the reason of an abnormal end."""
    current = folder / "current"
    end = time.monotonic() + seconds + 10 * _STARTING_S
    fed, since, since_cpu = 0.0, time.monotonic() + _STARTING_S - _HANG_S, 0.0
    while process.poll() is None:
        time.sleep(_POLL_S)
        now, cpu = time.monotonic(), _cpu_s(process.pid)
        if current.exists() and current.stat().st_mtime != fed:
            fed, since, since_cpu = current.stat().st_mtime, now, cpu
        waits, computes = now - since > _HANG_S and cpu - since_cpu < 1.0, cpu - since_cpu > _BUSY_S
        if waits or (computes and fed):
            process.send_signal(signal.SIGABRT)  # faulthandler prints the stack
            time.sleep(_POLL_S)
            _end(process)
            return f"hang: no end after {now - since:.0f} s, with {cpu - since_cpu:.0f} s of CPU time"
        if now > end:
            _end(process)
            return "hang: it did not end in time"
    _end(process)
    code = process.returncode
    return None if code == 0 else f"crash: the process ended with {code}"


def _cpu_s(process: int) -> float:
    """Return the CPU time of a process [s]; 0 if it has ended."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _end(process: "subprocess.Popen[bytes]") -> None:
    """End a process and its child processes."""
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
