"""One target in a process: `python -m fuzz.worker TARGET FOLDER --seconds N` or `… --input FILE`.

Started only by `fuzz.campaign`, in an environment with the sanitizers' settings. Printed text is read from standard
error, which is a file; an input that ends the process is left in `current`.
"""

import argparse
import faulthandler
import json
import os
import random
import resource
import sys
import time
import traceback
from collections.abc import Sequence
from pathlib import Path

from . import atheris_engine
from .findings import Findings, fault_in
from .guard import forbid
from .mutate import Pool, mutate
from .sanitized import use_sanitized

MAX_CPU_S = 10.0
"""Maximum CPU time of one input; more is a finding."""
MAX_MEMORY = 1_000_000_000
"""Maximum growth of memory by one input [bytes]; more is a finding."""
_MAX_ADDRESSES = 16_000_000_000
"""Address space of the process without sanitizers [bytes]."""
_STATISTICS_S = 0.5


class Worker:
    """Feeds inputs to a target and records findings."""

    def __init__(self, name: str, folder: Path, findings: Path) -> None:
        from .catalog import load_target

        self.folder = folder
        self.target = load_target(name)
        self.findings = Findings(findings, name)
        self._executions = 0
        self._start = self._written = time.monotonic()
        self._current = (folder / "current").open("wb", buffering=0)
        self._peak = _peak_bytes()
        self._printed = 0
        (folder / "open").mkdir()
        self._opened = self.target.open(folder / "open")
        self._execute = self._opened.__enter__()  # until the process ends

    def execute(self, data: bytes) -> None:
        """Feed one input."""
        data = bytes(data)
        self._current.seek(0)
        self._current.truncate()
        self._current.write(data)
        cpu_s = self._feed(data)
        if cpu_s > MAX_CPU_S and (cpu_s := self._feed(data)) > MAX_CPU_S:  # the first run may import modules
            self.findings.add(f"slow: {cpu_s:.1f} s of CPU time", "", data)
        self._check_memory(data)
        self._check_printed(data)
        self._executions += 1
        if time.monotonic() - self._written > _STATISTICS_S:
            self.write_statistics()

    def _feed(self, data: bytes) -> float:
        """Feed an input; return the CPU time [s]."""
        from trundle.base.diagnostics import TrundleError

        start = time.process_time()
        try:
            self._execute(data)
        except TrundleError:
            pass
        except BaseException as error:
            self.findings.add(f"{type(error).__name__}: {error}"[:500], traceback.format_exc(), data)
        return time.process_time() - start

    def _check_memory(self, data: bytes) -> None:
        peak = _peak_bytes()
        growth, self._peak = peak - self._peak, max(self._peak, peak)
        if growth > MAX_MEMORY:
            self.findings.add(f"memory: {growth / 1e6:.0f} MB more", "", data)

    def _check_printed(self, data: bytes) -> None:
        """Look for signs of a fault in the text printed by this input."""
        size = os.fstat(2).st_size
        if size == self._printed:
            return
        with (self.folder / "printed").open("rb") as file:
            file.seek(self._printed)
            text = file.read().decode(errors="replace")
        self._printed = size
        if fault := fault_in(text):
            self.findings.add(*fault, data)

    def write_statistics(self) -> None:
        """Write the counts for the campaign."""
        self._written = time.monotonic()
        counts = {
            "executions": self._executions,
            "seconds": self._written - self._start,
            "findings": self.findings.names,
        }
        temporary = self.folder / "statistics.tmp"
        temporary.write_text(json.dumps(counts))
        temporary.replace(self.folder / "statistics.json")


def _peak_bytes() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def _write_seeds(seeds: Sequence[bytes], folder: Path) -> Path:
    folder.mkdir()
    for number, seed in enumerate(seeds):
        (folder / f"seed-{number:04}").write_bytes(seed)
    return folder


def _run_without_coverage(worker: Worker, pool: Pool, seconds: float) -> None:
    source = random.Random()
    for seed in pool.inputs:
        worker.execute(seed)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        worker.execute(mutate(source.choice(pool.inputs), pool, source))


def main() -> None:
    """Fuzz one target, or repeat one input."""
    parser = argparse.ArgumentParser()
    parser.add_argument("target")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--findings", type=Path, required=True)
    parser.add_argument("--corpus", type=Path, required=True)
    parser.add_argument("--seconds", type=float, default=0.0)
    parser.add_argument("--input", type=Path)
    parser.add_argument("--sanitized", type=Path)
    args = parser.parse_args()
    faulthandler.enable()
    os.umask(0o077)
    if args.sanitized is None:
        resource.setrlimit(resource.RLIMIT_AS, (_MAX_ADDRESSES, resource.RLIM_INFINITY))
    else:
        use_sanitized(args.sanitized)
    is_guided = args.input is None and atheris_engine.instrument()
    args.corpus.mkdir(parents=True, exist_ok=True)
    worker = Worker(args.target, args.folder, args.findings)
    seed_inputs = worker.target.seeds()
    worker.execute(seed_inputs[0])  # loads modules and writes their bytecode
    forbid([args.folder, args.findings, args.corpus])
    if args.input is not None:
        worker.execute(args.input.read_bytes())
    else:
        pool = Pool(worker.target.words, seed_inputs + worker.target.corpus_seeds())
        if is_guided:
            seeds = _write_seeds(pool.inputs, args.folder / "seeds")
            atheris_engine.run(worker.execute, pool, corpus=args.corpus, seeds=seeds, seconds=args.seconds)
        _run_without_coverage(worker, pool, args.seconds)
    worker.write_statistics()
    sys.stderr.flush()
    os._exit(0)  # servers need no orderly shutdown


if __name__ == "__main__":
    main()
