"""JSON objects of a stream."""

import codecs
import re

from .errors import RosbridgeError

_MAX_CHARACTERS = 16 * 1024 * 1024
"""Limit for an incomplete object."""
_SPECIAL = re.compile(r'["{}]|\\.', re.DOTALL)


class ObjectSplitter:
    """Splits a stream into objects, in time linear in its length."""

    def __init__(self) -> None:
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self._text = ""
        self._scanned = 0
        self._depth = 0
        self._in_string = False

    def feed(self, data: bytes) -> list[str]:
        """Add bytes; return the complete objects.

        Raises:
            RosbridgeError: the stream does not consist of objects, or one is too long.
        """
        self._text += self._decoder.decode(data)
        objects: list[str] = []
        while (end := self._find_end()) is not None:
            objects.append(self._text[:end])
            self._text, self._scanned = self._text[end:], 0
        if len(self._text) > _MAX_CHARACTERS:
            raise RosbridgeError(f"an object has more than {_MAX_CHARACTERS} characters")
        return objects

    def _find_end(self) -> int | None:
        """Return the position after the first object; None: it is incomplete."""
        if self._depth == 0:
            self._text = self._text.lstrip()
            if self._text and not self._text.startswith("{"):
                raise RosbridgeError("it does not send JSON objects")
        for match in _SPECIAL.finditer(self._text, self._scanned):
            self._scanned = match.end()
            character = match[0]
            if character == '"':
                self._in_string = not self._in_string
            elif not self._in_string and character in "{}":
                self._depth += 1 if character == "{" else -1
                if self._depth == 0:
                    return match.end()
        # A backslash at the end waits for the character that it escapes.
        self._scanned = max(self._scanned, len(self._text) - self._text.endswith("\\"))
        return None
