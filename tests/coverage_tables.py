"""Markdown tables of the results of `make coverage`: Python by package, C++ by folder.

C++ lines count only if tests in tests/cpp run them, not if Python's tests do.
"""

import json
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
OUT = ROOT / "out/coverage"


def main() -> None:
    """Print both tables."""
    print(*table("Python", python_lines()), "", *table("C++", cpp_lines()), sep="\n")


def python_lines() -> Iterator[tuple[str, int, int]]:
    """Yield package, number of statements, and number of statements that ran, for each file."""
    coverage = [sys.executable, "-m", "coverage"]
    subprocess.run([*coverage, "json", "--quiet", "-o", str(OUT / "python.json")], cwd=ROOT, check=True)
    for name, file in json.loads((OUT / "python.json").read_text())["files"].items():
        parts = Path(name).parts[2:-1]
        yield "/".join(parts[:2]) or ".", file["summary"]["num_statements"], file["summary"]["covered_lines"]


def cpp_lines() -> Iterator[tuple[str, int, int]]:
    """Yield folder, number of lines, and number of lines that ran, for each file."""
    report = OUT / "cpp.json"
    gcovr = ["gcovr", "--root", str(ROOT), "--filter", "cpp/", "--json-summary", str(report), "build/kernel_tests"]
    subprocess.run([sys.executable, "-m", *gcovr], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    for file in json.loads(report.read_text())["files"]:
        yield str(Path(file["filename"]).parent), file["line_total"], file["line_covered"]


def table(title: str, files: Iterable[tuple[str, int, int]]) -> list[str]:
    """Return the rows of a table with its total."""
    counts: defaultdict[str, list[int]] = defaultdict(lambda: [0, 0])
    for package, lines, covered in files:
        for key in (package, "total"):
            counts[key][0] += lines
            counts[key][1] += covered
    total = counts.pop("total")
    rows = [
        f"| {package} | {lines} | {_percent(lines, covered)} |" for package, (lines, covered) in sorted(counts.items())
    ]
    return [f"| {title} | lines | run |", "|---|---|---|", *rows, f"| **total** | {total[0]} | {_percent(*total)} |"]


def _percent(lines: int, covered: int) -> str:
    return f"{100 * covered / lines:.1f} %" if lines else "–"


if __name__ == "__main__":
    main()
