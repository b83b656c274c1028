"""Registry of the IDs of findings: what each means, an example that causes it, and what to do.

The registry is the Markdown in `assets/diagnostics`, which the reference on the site shows as it is. An entry is

    ## ID

    meaning

    fences with title="FILE": the files of the example, if one is known
    a fence ```bash: the commands that show the finding; without one, `trundle check` of the first file does

    To do: remedy
"""

import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

from trundle.assets import ASSETS

from .diagnostics import UsageError, no_such

FOLDER = ASSETS / "diagnostics"
_FENCE = re.compile(r'^```(\w+)(?: title="([^"]+)")?\n(.*?)^```$', re.MULTILINE | re.DOTALL)
_SENTENCE = re.compile(r".*?[.](?=\s|$)", re.DOTALL)
_LINK = re.compile(r"\[([^\]]+)\]\([^)]+\)")


class Explanation(NamedTuple):
    """Entry of the registry."""

    id: str
    section: str
    """Heading of its page."""
    meaning: str
    files: tuple[tuple[str, str], ...]
    """Name and text of each file of the example."""
    commands: str
    """Commands that show the finding, one a line."""
    remedy: str

    def summary(self) -> str:
        """Return the first sentence of the meaning, on one line."""
        sentence = _SENTENCE.match(self.meaning)
        return " ".join((sentence[0] if sentence else self.meaning).split())

    def text(self) -> str:
        """Return the entry for a terminal."""
        files = [f"{name}:\n\n{_indented(text)}" for name, text in self.files]
        commands = "\n".join(f"    $ {line}" for line in self.commands.splitlines())
        return "\n\n".join(filter(None, [self.id, self.meaning, *files, commands, f"To do: {self.remedy}"]))


@cache
def explanations() -> dict[str, Explanation]:
    """Return all entries by ID, in the order of their pages."""
    return {entry.id: entry for page in pages() for entry in _entries(page)}


def pages() -> list[Path]:
    """Return the pages of the registry, sorted by name."""
    return sorted(FOLDER.glob("*.md"))


def explain(id: str) -> Explanation:
    """Return the entry of an ID.

    Raises:
        UsageError: no such ID; the message names similar ones.
    """
    entries = explanations()
    if id not in entries:
        from difflib import get_close_matches  # lazy: slow to import, rarely needed

        near = get_close_matches(id, entries, n=3, cutoff=0.4)
        raise UsageError(
            no_such("no diagnostic", id, near) if near else f"no diagnostic {id!r}; `trundle explain` lists all"
        )
    return entries[id]


def _entries(page: Path) -> list[Explanation]:
    head, *parts = re.split(r"^## ", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return [_entry(head.removeprefix("# ").strip(), part) for part in parts]


def _entry(section: str, text: str) -> Explanation:
    id, _, body = text.partition("\n")
    fences: list[tuple[str, str, str]] = _FENCE.findall(body)
    files = tuple((title, content) for _, title, content in fences if title)
    commands = next((content for language, title, content in fences if language == "bash" and not title), "")
    prose = _LINK.sub(r"\1", _FENCE.sub("", body))
    meaning, _, remedy = prose.partition("\nTo do: ")
    return Explanation(
        id=id.strip(),
        section=section,
        meaning=meaning.strip(),
        files=files,
        commands=commands.strip() or (f"trundle check {files[0][0]}" if files else ""),
        remedy=remedy.strip(),
    )


def _indented(text: str) -> str:
    return "\n".join(f"    {line}".rstrip() for line in text.splitlines()) or "    (empty)"
