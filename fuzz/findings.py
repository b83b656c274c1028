"""Findings: what counts as one, which are the same, and their files."""

import hashlib
import re
from pathlib import Path

_FRAME = re.compile(r'File "[^"]*?/(src/trundle/[^"]+|fuzz/[^"]+|[^/"]+/[^/"]+)", line (\d+), in (\S+)')
_ERROR = re.compile(r"^([A-Za-z_][\w.]*(?:Error|Exception|Warning|Exit|Iteration|Group|Interrupt))\b", re.MULTILINE)
_SANITIZER = re.compile(r"(\S+:\d+:\d+: runtime error|ERROR: \w+Sanitizer: [\w-]+|ERROR: libFuzzer: [\w ]+)")
_WARNING = re.compile(r"(\S+:\d+: \w*Warning): ")
_NATIVE_FRAME = re.compile(r"#\d+ 0x\w+ in (\S+).*?/cpp/(\S+)")
_PRINTED = re.compile(r"Traceback \(most recent call last\)|^\S+:\d+: \w*Warning: |: runtime error: ", re.MULTILINE)
"""Signs of a fault in what was printed: a traceback, a warning of Python's or numpy's, a report of UBSan."""


def fault_in(printed: str) -> tuple[str, str] | None:
    """Return a fault's sentence and its details in what was printed; None: there is none."""
    found = _PRINTED.search(printed)
    if found is None:
        return None
    details = printed[found.start() :].strip()
    lines = details.splitlines()
    return f"printed: {lines[-1 if lines[0].startswith('Traceback') else 0][:300]}", details


class Findings:
    """Folder of findings, one for each kind; the shortest input of a kind is kept."""

    def __init__(self, folder: Path, target: str) -> None:
        """Add to `folder` what is found in `target`."""
        self._folder = folder
        self._target = target
        self.names: dict[str, int] = {}
        """Name → number of inputs, in this process."""

    def add(self, what: str, details: str, data: bytes) -> None:
        """Add a finding.

        Args:
            what: its sentence.
            details: traceback or report, which tells kinds apart.
            data: the input.
        """
        name = f"{self._target}-{hashlib.sha256((what.partition(':')[0] + _place(details)).encode()).hexdigest()[:8]}"
        self.names[name] = self.names.get(name, 0) + 1
        folder = self._folder / name
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / "input"
        if file.exists() and file.stat().st_size <= len(data):
            return
        file.write_bytes(data)
        repeat = f".venv/bin/python -m fuzz {self._target} --input {file}"
        (folder / "report.txt").write_text(f"{self._target}: {what}\nrepeat: {repeat}\n\n{details}\n", errors="replace")


def _place(details: str) -> str:
    """Return the error and the innermost place in Trundle, by which kinds are told apart."""
    if found := _SANITIZER.search(details):
        native = _NATIVE_FRAME.search(details)
        return found[1] + (f" {native[2]}" if native else "")
    if found := _WARNING.search(details):
        return found[1]
    frames = _FRAME.findall(details)
    ours = next(
        (frame for frame in reversed(frames) if frame[0].startswith("src/")), frames[-1] if frames else ("", "", "")
    )
    errors = _ERROR.findall(details)
    return f"{errors[-1] if errors else ''} {ours[0]}:{ours[1]} {ours[2]}"
