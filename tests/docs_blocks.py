"""Runs the code blocks of a documentation page in order in an empty folder.

A fence of three or more backticks is

- ```bash: commands; a following ```text fence is their output, with `...` for variable parts;
- ```python: a program, likewise with its output; with `>>>` at its start, a doctest of the whole page;
- any language with title="FILE": a file that later blocks use;
- ```xml and ```yaml without a title: part of a file, which must be well-formed.

An HTML comment before a fence is a mark: `<!-- not run: REASON -->`, `<!-- fails -->` (exit code 1), and
`<!-- keeps running: TEXT -->`: the next block runs after TEXT is printed, and SIGINT is sent at the page's end or
before a block with `<!-- after Ctrl-C -->` or `<!-- after Ctrl-C, keeps running: TEXT -->`. `trundle core` gets the
port of the page's ROS_MASTER_URI.
`<!-- figures vary -->` before a ```text fence: any number may be in place of each of its numbers.
`<!-- needs the tutorials' files -->` at the start of a page: a test of its own has them.
`<!-- slow -->` at the start of a page, or after its front matter: it runs only in `make test-all`.
"""

import itertools
import os
import re
import signal
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
from tests.graphs import free_port

ROOT = Path(__file__).parents[1]
_DOCS = sorted((ROOT / "docs").rglob("*.md"))
_LESSONS = sorted((ROOT / "src/trundle/assets/lessons").glob("*.md"))
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "ARCHITECTURE.md", *_DOCS, *_LESSONS] if _DOCS else []
"""Pages of the documentation; empty in the sdist."""
COMMANDS = Path(os.environ.get("TRUNDLE_COMMANDS", Path(sys.executable).parent))
"""Folder of `trundle` and `python` for blocks."""
_TIMEOUT_S = 900.0
_MEANWHILE = re.compile(r"^(?:\d+ of \d+ .+, about .+ left|waiting for .+ since \d+ s)\n", re.MULTILINE)
"""Lines that are printed only where something takes long."""
_SLOW = re.compile(r"(---\n.*?\n---\n)?<!-- slow -->", re.DOTALL)
_FENCE = re.compile(
    r"(?:^[ ]*<!-- (?P<mark>[^\n]+?) -->\n+)?"
    r"^(?P<indent>[ ]*)(?P<ticks>```+)(?P<language>\w+)(?: title=\"(?P<title>[^\"]+)\")?[ ]*\n"
    r"(?P<text>.*?)^(?P=indent)(?P=ticks)[ ]*$",
    re.MULTILINE | re.DOTALL,
)

_NUMBER = re.compile(r"-?\d+(\.\d+)?")
_OTHERS_FILES = "<!-- needs the tutorials' files -->"
_NOTHING = re.compile(r"(?!)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """A fence of a page."""

    line: int
    language: str
    text: str
    title: str | None
    mark: str
    """Mark in the HTML comment above the block, or empty."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Folder:
    """Folder and environment of a page's blocks."""

    path: Path
    commands: Path
    """Folder of `trundle` and `python`."""
    environment: dict[str, str]


def read_blocks(page: Path) -> list[Block]:
    """Return all fences of a page in order."""
    text = page.read_text()
    return [
        Block(
            line=text.count("\n", 0, match.start("language")) + 1,
            language=match["language"],
            text=textwrap.dedent(match["text"]),
            title=match["title"],
            mark=match["mark"] or "",
        )
        for match in _FENCE.finditer(text)
    ]


def has_blocks(page: Path) -> bool:
    """Return whether a page has blocks to run, without files of others."""
    return not page.read_text().startswith(_OTHERS_FILES) and (bool(read_blocks(page)) or _has_doctest(page))


def _has_doctest(page: Path) -> bool:
    return any(line.lstrip().startswith(">>> ") for line in page.read_text().splitlines())


def is_slow(page: Path) -> bool:
    """Return whether a page runs only in `make test-all`."""
    return _SLOW.match(page.read_text()) is not None


def run_page(page: Path, folder: Path, *, commands: Path = COMMANDS) -> None:
    """Run every block; assertions name the page and the line of the failing block."""
    page_folder = Folder(path=folder, commands=commands, environment=_environment(folder, commands))
    blocks = read_blocks(page)
    if _has_doctest(page):
        doctest = [str(page_folder.commands / "python"), "-m", "doctest", "-o", "ELLIPSIS", str(page)]
        _run(doctest, page_folder, f"{page.name}: the doctest")
    with ExitStack() as running:
        for block, after in itertools.zip_longest(blocks, blocks[1:]):
            name = f"{page.relative_to(ROOT)}:{block.line}"
            expected = after if after and (after.language, after.title) == ("text", None) else None
            _run_block(block, expected, page_folder, name, running)


def _run_block(block: Block, expected: Block | None, page_folder: Folder, name: str, running: ExitStack) -> None:
    if block.mark.startswith("not run:"):
        return
    if block.mark.startswith("after Ctrl-C"):
        running.close()
    if block.title:
        file = page_folder.path / block.title.replace("~", str(page_folder.path))
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(block.text)
    elif block.language == "xml":
        ElementTree.fromstring(f"<part xmlns:xacro='xacro'>{block.text}</part>")
    elif block.language == "yaml":
        yaml.safe_load(block.text)
    elif "keeps running:" in block.mark:
        running.enter_context(_run_in_background(block, page_folder, name))
    elif block.language == "bash":
        script = ["bash", "-e", "-c", block.text]
        _compare(_run(script, page_folder, name, code=1 if block.mark == "fails" else 0), expected, name)
    elif block.language == "python" and not block.text.startswith(">>>"):
        _compare(_run([str(page_folder.commands / "python"), "-c", block.text], page_folder, name), expected, name)


def _run(command: list[str], page_folder: Folder, name: str, *, code: int = 0) -> str:
    cwd = ROOT if "doctest" in command else page_folder.path
    process = subprocess.run(
        command,
        cwd=cwd,
        env=page_folder.environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=_TIMEOUT_S,
    )
    assert process.returncode == code, f"{name} ends with {process.returncode}:\n{process.stdout}"
    return process.stdout


def _compare(output: str, expected: Block | None, name: str) -> None:
    if expected is not None:
        same = _NUMBER if expected.mark == "figures vary" else _NOTHING
        wanted, printed = (same.sub("0", text) for text in (expected.text, _MEANWHILE.sub("", output)))
        matches = OutputChecker().check_output(f"\n{wanted}", f"\n{printed}", ELLIPSIS)
        assert matches, f"{name} prints\n{output}\nand not\n{expected.text}"


@contextmanager
def _run_in_background(block: Block, page_folder: Folder, name: str) -> Iterator[None]:
    port = page_folder.environment["ROS_MASTER_URI"].rstrip("/").rpartition(":")[2]
    command = block.text.replace("trundle core", f"trundle core -p {port}")
    expected = block.mark.partition(":")[2].strip()
    output = page_folder.path / f".output_{block.line}"
    with output.open("w") as file:
        process = subprocess.Popen(
            ["bash", "-c", f"exec {command}"],
            cwd=page_folder.path,
            env=page_folder.environment,
            stdout=file,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
    try:
        deadline = time.monotonic() + _TIMEOUT_S
        while expected not in output.read_text():
            message = f"{name} does not print {expected!r}:\n{output.read_text()}"
            assert process.poll() is None, message
            assert time.monotonic() < deadline, message
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
    """Return the environment of a user without ROS, with a home and a master's URI for the page."""
    foreign = ("ROS_", "GAZEBO_", "TRUNDLE_", "PYTEST_ADDOPTS")
    variables = {key: value for key, value in os.environ.items() if not key.startswith(foreign)}
    return variables | {
        "HOME": str(folder),
        "PATH": f"{commands}{os.pathsep}{os.environ['PATH']}",
        "PYTHONUNBUFFERED": "1",
        "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}/",
    }
