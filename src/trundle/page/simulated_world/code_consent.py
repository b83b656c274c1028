"""Agreement of a person to run the code of a model: once, and for what the page has shown."""

import hashlib
import secrets
from collections.abc import Mapping
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.files import read_file
from trundle.gazebo.plugins import find_held_file, find_user_file
from trundle.robots.model import Model, PluginTag
from trundle.robots.packages import HELD

from ..requests.answers import CodeQuestion

_MAX_ASKED = 100
"""Questions that may be open; the oldest ones end."""
_MAX_BYTES = 16 * 1024 * 1024


class CodeConsent:
    """Questions that the page was asked, each with a word that agrees to it once."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        """Prepare; `environment` has the variables that locate plugins."""
        self._environment = environment
        self._asked: dict[str, bytes] = {}
        """Word → digest of plugins and code."""

    def question(self, model: Model, consent: str | None) -> CodeQuestion | None:
        """Return what to ask a person before a model is added; None: it has no code, or a person has agreed.

        Uploaded files of code, which nothing else runs, become plugins once a person has agreed.

        Args:
            model: the model.
            consent: word of an earlier answer of this function.

        Raises:
            UsageError: a file of code cannot be read.
        """
        tags = _plugins(model)
        code = {file: _read(file) for tag in tags if (file := self._find(tag)) is not None}
        if not code:
            return None
        digest = hashlib.sha256()
        for part in (*(tag.node.xml().encode("utf-8", "surrogateescape") for tag in tags), *_parts(code)):
            digest.update(hashlib.sha256(part).digest())
        if consent is not None and self._asked.pop(consent, None) == digest.digest():
            _release(code)
            return None
        word = secrets.token_urlsafe(16)
        self._asked[word] = digest.digest()
        while len(self._asked) > _MAX_ASKED:
            self._asked.pop(next(iter(self._asked)), None)
        return CodeQuestion(code=tuple(str(file).removesuffix(HELD) for file in code), consent=word)

    def _find(self, tag: PluginTag) -> Path | None:
        return find_user_file(tag, self._environment) or find_held_file(tag, self._environment)


def _plugins(model: Model) -> list[PluginTag]:
    """Return the plugins of a model and its visuals; those of sensors are Trundle's own."""
    visuals = (visual for link in model.links for visual in link.visuals)
    return [*model.plugins, *(tag for visual in visuals for tag in visual.plugins)]


def _parts(code: Mapping[Path, bytes]) -> list[bytes]:
    return [part for file, content in code.items() for part in (bytes(file), content)]


def _read(file: Path) -> bytes:
    try:
        return read_file(file, max_bytes=_MAX_BYTES)
    except OSError as error:
        raise UsageError(f"{file} cannot be read: {error.strerror}") from None


def _release(code: Mapping[Path, bytes]) -> None:
    """Write what was agreed to in place of the held files; these may be other ones by now."""
    for file, content in code.items():
        if file.name.endswith(HELD):
            write_atomically(file.with_name(file.name.removesuffix(HELD)), content)
