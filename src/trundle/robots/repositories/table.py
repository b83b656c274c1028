"""Table of repositories, made from the published rosdistro index.

A line is a repository: its URL, `distro:branch …`, and its packages, separated by tabs.
"""

from collections.abc import Iterable, Iterator

from .entry import Entry


def read_table(text: str) -> Iterator[Entry]:
    """Yield the entries of a table."""
    for line in text.splitlines():
        if line and not line.startswith("#"):
            url, branches, packages = line.split("\t")
            yield Entry(url, dict(_named_branch(word) for word in branches.split()), tuple(packages.split()))


def write_table(entries: Iterable[Entry]) -> str:
    """Return the text of a table; distributions with the same packages share a line."""
    merged: dict[tuple[str, tuple[str, ...]], dict[str, str]] = {}
    for url, branches, packages in entries:
        merged.setdefault((url, packages), {}).update(branches)
    lines = [
        "\t".join((url, " ".join(f"{distro}:{branch}" for distro, branch in branches.items()), " ".join(packages)))
        for (url, packages), branches in sorted(merged.items())
    ]
    return "\n".join(lines) + "\n"


def _named_branch(word: str) -> tuple[str, str]:
    distro, _, branch = word.partition(":")
    return distro, branch
