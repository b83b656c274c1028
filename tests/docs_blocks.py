"""Runs the blocks of a page of the documentation, in order, in a folder of its own.

A fence is

- ```bash: commands; a ```text fence that follows is what they print, with `...` for what differs;
- ```python: a program, with what it prints likewise; with `>>>` at its start, a doctest of the whole page;
- any language with title="FILE": a file that later blocks use;
- ```xml and ```yaml without a title: part of a file, which has to be well-formed.

An HTML comment before a fence says what is special: `<!-- not run: REASON -->`, `<!-- fails -->` (exit code 1), and
`<!-- keeps running: TEXT -->`, which has the driver go on once TEXT is printed and press Ctrl-C at the page's end, or
before a block with `<!-- after Ctrl-C -->`. `trundle core` gets the port that the page's other commands look at.
`<!-- slow -->` at the start of a page leaves it to `make test-all`.
"""

import itertools
import os
import re
import signal
import socket
import subprocess
import sys
import textwrap
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from doctest import ELLIPSIS, OutputChecker
from pathlib import Path
from xml.etree import ElementTree

import yaml

ROOT = Path(__file__).parents[1]
_DOCS = sorted((ROOT / "docs").rglob("*.md"))
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "ARCHITECTURE.md", *_DOCS] if _DOCS else []
"""The documentation; none in the sdist."""
COMMANDS = Path(os.environ.get("TRUNDLE_COMMANDS", Path(sys.executable).parent))
"""Folder of the `trundle` and the `python` that blocks call."""
_TIMEOUT_S = 60.0
_FENCE = re.compile(
    r"(?:^[ ]*<!-- (?P<mark>[^\n]+?) -->\n+)?"
    r"^(?P<indent>[ ]*)```(?P<language>\w+)(?: title=\"(?P<title>[^\"]+)\")?[ ]*\n"
    r"(?P<text>.*?)^(?P=indent)```[ ]*$",
    re.MULTILINE | re.DOTALL,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """A fence of a page."""

    line: int
    language: str
    text: str
    title: str | None
    mark: str
    """Mark in the HTML comment above the block; empty if there is none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Folder:
    """Where a page's blocks run, and what they may rely on."""

    path: Path
    commands: Path
    """Folder of the `trundle` and the `python` that they call."""
    environment: dict[str, str]


def read_blocks(page: Path) -> list[Block]:
    """Every fence of a page, in order."""
    text = page.read_text()
    return [
        Block(
            line=text.count("\n", 0, found.start("language")) + 1,
            language=found["language"],
            text=textwrap.dedent(found["text"]),
            title=found["title"],
            mark=found["mark"] or "",
        )
        for found in _FENCE.finditer(text)
    ]


def has_blocks(page: Path) -> bool:
    """Whether there is something to run."""
    return bool(read_blocks(page)) or _has_doctest(page)


def _has_doctest(page: Path) -> bool:
    return any(line.lstrip().startswith(">>> ") for line in page.read_text().splitlines())


def is_slow(page: Path) -> bool:
    """Whether the page is left to `make test-all`."""
    return page.read_text().startswith("<!-- slow -->")


def run_page(page: Path, folder: Path, *, commands: Path = COMMANDS) -> None:
    """Run every block; an assertion names the page and the line of the one that does not do what it says."""
    where = Folder(path=folder, commands=commands, environment=_environment(folder, commands))
    blocks = read_blocks(page)
    if _has_doctest(page):
        doctest = [str(where.commands / "python"), "-m", "doctest", "-o", "ELLIPSIS", str(page)]
        _run(doctest, where, f"{page.name}: the doctest")
    with ExitStack() as running:
        for block, after in itertools.zip_longest(blocks, blocks[1:]):
            name = f"{page.relative_to(ROOT)}:{block.line}"
            expected = after.text if after and (after.language, after.title) == ("text", None) else None
            _run_block(block, expected, where, name, running)


def _run_block(block: Block, expected: str | None, where: Folder, name: str, running: ExitStack) -> None:
    if block.mark.startswith("not run:"):
        return
    if block.mark == "after Ctrl-C":
        running.close()
    if block.title:
        file = where.path / block.title.replace("~", str(where.path))
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(block.text)
    elif block.language == "xml":
        ElementTree.fromstring(f"<part xmlns:xacro='xacro'>{block.text}</part>")
    elif block.language == "yaml":
        yaml.safe_load(block.text)
    elif block.mark.startswith("keeps running:"):
        running.enter_context(_kept_running(block, where, name))
    elif block.language == "bash":
        script = ["bash", "-e", "-c", block.text]
        _compare(_run(script, where, name, code=1 if block.mark == "fails" else 0), expected, name)
    elif block.language == "python" and not block.text.startswith(">>>"):
        _compare(_run([str(where.commands / "python"), "-c", block.text], where, name), expected, name)


def _run(command: list[str], where: Folder, name: str, *, code: int = 0) -> str:
    cwd = ROOT if "doctest" in command else where.path
    done = subprocess.run(
        command,
        cwd=cwd,
        env=where.environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=_TIMEOUT_S,
    )
    assert done.returncode == code, f"{name} ends with {done.returncode}:\n{done.stdout}"
    return done.stdout


def _compare(got: str, expected: str | None, name: str) -> None:
    if expected is not None:
        matches = OutputChecker().check_output(f"\n{expected}", f"\n{got}", ELLIPSIS)
        assert matches, f"{name} prints\n{got}\nand not\n{expected}"


@contextmanager
def _kept_running(block: Block, where: Folder, name: str) -> Iterator[None]:
    port = where.environment["ROS_MASTER_URI"].rstrip("/").rpartition(":")[2]
    command = block.text.replace("trundle core", f"trundle core -p {port}")
    awaited = block.mark.partition(":")[2].strip()
    output = where.path / f".output_{block.line}"
    with output.open("w") as file:
        process = subprocess.Popen(
            ["bash", "-c", f"exec {command}"],
            cwd=where.path,
            env=where.environment,
            stdout=file,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
    try:
        deadline = time.monotonic() + _TIMEOUT_S
        while awaited not in output.read_text():
            said = f"{name} does not say {awaited!r}:\n{output.read_text()}"
            assert process.poll() is None, said
            assert time.monotonic() < deadline, said
            time.sleep(0.05)
        yield
        assert process.poll() is None, f"{name} ended before the page did:\n{output.read_text()}"
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        try:
            process.wait(timeout=20.0)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def _environment(folder: Path, commands: Path) -> dict[str, str]:
    """Those of a user who has nothing of ROS: a home and a master of the page's own."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("ROS_", "GAZEBO_", "TRUNDLE_"))}
    return kept | {
        "HOME": str(folder),
        "PATH": f"{commands}{os.pathsep}{os.environ['PATH']}",
        "PYTHONUNBUFFERED": "1",
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}/",
    }
