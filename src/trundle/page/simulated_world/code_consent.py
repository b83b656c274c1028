"""A user's consent to run a model's code, valid once and only for the code that the page listed."""

import hashlib
import secrets
from collections.abc import Mapping
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.files import read_file
from trundle.gazebo.plugins import find_held_file, find_user_file
from trundle.robots.model import Model, PluginTag
from trundle.robots.packages import HELD_SUFFIX

from ..requests.answers import CodeQuestion

_MAX_QUESTIONS = 100
"""Limit of open questions; the oldest expire."""
_MAX_BYTES = 16 * 1024 * 1024


class CodeConsent:
    """Open questions, each with a token that gives consent once."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        """Create it; `environment` has the variables that locate plugins."""
        self._environment = environment
        self._digests: dict[str, bytes] = {}
        """Token → digest of plugins and code."""

    def question(self, model: Model, consent: str | None) -> CodeQuestion | None:
        """Return the question to ask before a model is added; None: it has no code, or the user has consented.

        Consent also releases the model's uploaded files of code, so that they load as plugins.

        Args:
            model: model to add.
            consent: token of an earlier question.

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
        if consent is not None and self._digests.pop(consent, None) == digest.digest():
            _release(code)
            return None
        token = secrets.token_urlsafe(16)
        self._digests[token] = digest.digest()
        while len(self._digests) > _MAX_QUESTIONS:
            self._digests.pop(next(iter(self._digests)), None)
        return CodeQuestion(code=tuple(str(file).removesuffix(HELD_SUFFIX) for file in code), consent=token)

    def _find(self, tag: PluginTag) -> Path | None:
        return find_user_file(tag, self._environment) or find_held_file(tag, self._environment)


def _plugins(model: Model) -> list[PluginTag]:
    """Return the plugins of a model, its visuals and its sensors."""
    parts = (part for link in model.links for part in (*link.visuals, *link.sensors))
    return [*model.plugins, *(tag for part in parts for tag in part.plugins)]


def _parts(code: Mapping[Path, bytes]) -> list[bytes]:
    return [part for file, content in code.items() for part in (bytes(file), content)]


def _read(file: Path) -> bytes:
    try:
        return read_file(file, max_bytes=_MAX_BYTES)
    except OSError as error:
        raise UsageError(f"{file} cannot be read: {error.strerror}") from None


def _release(code: Mapping[Path, bytes]) -> None:
    """Write the files' contents to which the user consented; the held files may have changed since."""
    for file, content in code.items():
        if file.name.endswith(HELD_SUFFIX):
            write_atomically(file.with_name(file.name.removesuffix(HELD_SUFFIX)), content)
