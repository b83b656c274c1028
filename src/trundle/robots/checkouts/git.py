"""Shallow checkouts by git that run nothing of the repository: no hooks, submodules, filters or other protocols."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import mkdtemp

from trundle.base.diagnostics import UsageError

_OPTIONS = ("core.hooksPath=/dev/null", "core.fsmonitor=false", "advice.detachedHead=false", "init.defaultBranch=main")
_ENVIRONMENT = {
    "GIT_ALLOW_PROTOCOL": "https:http:git",
    "GIT_TERMINAL_PROMPT": "0",  # git fails for a private repository, instead of asking for a password
    "GIT_LFS_SKIP_SMUDGE": "1",
    "LC_ALL": "C",
}
_NO_REFERENCE = "couldn't find remote ref"
_PROGRESS = re.compile(r"(Receiving objects|Resolving deltas|Updating files): [ \d%(),/.|A-Za-z]*$")


class NoBranchError(UsageError):
    """Unknown branch, tag or commit."""


def checkout(url: str, branch: str, folder: Path, *, shows_progress: bool) -> str:
    """Fetch one commit into a new folder, and return its id.

    Args:
        url: address checked by `repositories.https_address`.
        branch: branch, tag or commit; '' is the default branch.
        folder: new folder, created when the checkout is complete.
        shows_progress: True to print git's progress to stderr.

    Raises:
        NoBranchError: unknown branch.
        UsageError: git is not installed, or could not fetch.
    """
    folder.parent.mkdir(parents=True, exist_ok=True)
    unfinished = Path(mkdtemp(prefix=f".{folder.name}-", dir=folder.parent))
    try:
        _git(["init", "--quiet", "--template=", str(unfinished)], url)
        _git(["remote", "add", "origin", url], url, unfinished)
        progress = "--progress" if shows_progress else "--quiet"
        fetch = ["fetch", progress, "--depth=1", "--no-tags", "--no-recurse-submodules", "--", url, branch or "HEAD"]
        _git(fetch, url, unfinished, shows=shows_progress)
        _git(["checkout", "--quiet", "--detach", "FETCH_HEAD"], url, unfinished)
        commit = _git(["rev-parse", "HEAD"], url, unfinished).strip()
        unfinished.rename(folder)
    except BaseException:
        shutil.rmtree(unfinished, ignore_errors=True)
        raise
    return commit


def branches(url: str) -> list[str]:
    """Return the names of a repository's branches.

    Raises:
        UsageError: git is not installed, or the repository cannot be read.
    """
    lines = _git(["ls-remote", "--heads", "--", url], url).splitlines()
    return [line.partition("refs/heads/")[2] for line in lines]


def remove_outside_links(folder: Path) -> list[Path]:
    """Remove and return symbolic links that lead out of a folder."""
    root = folder.resolve()
    removed: list[Path] = []
    for parent, folders, files in os.walk(folder):
        for path in (Path(parent, name) for name in (*folders, *files)):
            if path.is_symlink() and not path.resolve().is_relative_to(root):
                path.unlink()
                removed.append(path)
    return removed


def _git(arguments: Sequence[str], url: str, folder: Path | None = None, *, shows: bool = False) -> str:
    """Run git and return its output; `shows`: write its progress to stderr."""
    words = ["git", *(word for option in _OPTIONS for word in ("-c", option)), *arguments]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")} | _ENVIRONMENT
    try:
        process = subprocess.Popen(
            words,
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
        )
    except FileNotFoundError:
        raise UsageError("git is not installed; packages are fetched with it: apt install git") from None
    with process, ThreadPoolExecutor(1) as reading:
        messages = reading.submit(_read_messages, process, shows=shows)
        assert process.stdout is not None
        output = process.stdout.read()
        last = messages.result()
    if process.returncode == 0:
        return output
    if _NO_REFERENCE in last:
        raise NoBranchError(f"{url} has no {arguments[-1]!r}")
    reason = re.sub(r"^(fatal|error): ", "", last)
    raise UsageError(f"{url} was not fetched: git {arguments[0]} failed: {reason}")


def _read_messages(process: "subprocess.Popen[str]", *, shows: bool) -> str:
    """Read git's stderr to its end, and return the last line."""
    assert process.stderr is not None
    last = ""
    for line in process.stderr:  # progress lines end with a carriage return, which is a line end in text mode
        last = line.strip() or last
        if shows and _PROGRESS.match(line):  # other lines come from the server, and may have any characters
            sys.stderr.write(f"\r  {line.strip():<70}")
            sys.stderr.flush()
    if shows:
        sys.stderr.write(f"\r{'':<72}\r")
    return last
