"""Findings: recognition, grouping by kind, and their files."""

import hashlib
import re
from pathlib import Path

_FRAME = re.compile(r'File "[^"]*?/(src/trundle/[^"]+|fuzz/[^"]+|[^/"]+/[^/"]+)", line (\d+), in (\S+)')
_ERROR = re.compile(r"^([A-Za-z_][\w.]*(?:Error|Exception|Warning|Exit|Iteration|Group|Interrupt))\b", re.MULTILINE)
_SANITIZER = re.compile(r"(\S+:\d+:\d+: runtime error|ERROR: \w+Sanitizer: [\w-]+|ERROR: libFuzzer: [\w ]+)")
_WARNING = re.compile(r"(\S+:\d+: \w*Warning): ")
_NATIVE_FRAME = re.compile(r"#\d+ 0x\w+ in (\S+).*?/cpp/(\S+)")
_PRINTED = re.compile(r"Traceback \(most recent call last\)|^\S+:\d+: \w*Warning: |: runtime error: ", re.MULTILINE)
"""Signs of a fault in printed text: a traceback, a warning of Python or NumPy, a report of UBSan."""


def fault_in(printed: str) -> tuple[str, str] | None:
    """Return the summary and details of a fault in printed text, or None."""
    match = _PRINTED.search(printed)
    if match is None:
        return None
    details = printed[match.start() :].strip()
    lines = details.splitlines()
    return f"printed: {lines[-1 if lines[0].startswith('Traceback') else 0][:300]}", details


class Findings:
    """Folder of findings, one for each kind with its shortest input."""

    def __init__(self, folder: Path, target: str) -> None:
        """Add findings of `target` to `folder`."""
        self._folder = folder
        self._target = target
        self.names: dict[str, int] = {}
        """Name → number of inputs, in this process."""

    def add(self, summary: str, details: str, data: bytes) -> None:
        """Add a finding.

        Args:
            summary: one sentence.
            details: traceback or report, which determines the kind.
            data: input.
        """
        kind = summary.partition(":")[0] + _location(details)
        name = f"{self._target}-{hashlib.sha256(kind.encode()).hexdigest()[:8]}"
        self.names[name] = self.names.get(name, 0) + 1
        folder = self._folder / name
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / "input"
        if file.exists() and file.stat().st_size <= len(data):
            return
        file.write_bytes(data)
        repeat = f".venv/bin/python -m fuzz {self._target} --input {file}"
        (folder / "report.txt").write_text(
            f"{self._target}: {summary}\nrepeat: {repeat}\n\n{details}\n", errors="replace"
        )


def _location(details: str) -> str:
    """Return the error and the innermost line in Trundle, which identify a kind."""
    if match := _SANITIZER.search(details):
        native = _NATIVE_FRAME.search(details)
        return match[1] + (f" {native[2]}" if native else "")
    if match := _WARNING.search(details):
        return match[1]
    frames = _FRAME.findall(details)
    innermost = next(
        (frame for frame in reversed(frames) if frame[0].startswith("src/")), frames[-1] if frames else ("", "", "")
    )
    errors = _ERROR.findall(details)
    return f"{errors[-1] if errors else ''} {innermost[0]}:{innermost[1]} {innermost[2]}"
