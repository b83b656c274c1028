"""Reading .proto files of plugins: messages and enumerations, with their fields."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

_MAX_BYTES = 1_000_000
_MAX_DEPTH = 32
_TOKEN = re.compile(
    r"""(?P<space>\s+|//[^\n]*|/\*.*?\*/)|(?P<word>\.?[A-Za-z_][\w.]*|-?\d[\w.+-]*|-)|"""
    r"""(?P<text>"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')|(?P<mark>[{}\[\]();=,<>:])""",
    re.DOTALL,
)
_MISSING = {
    "extend": "extensions of messages",
    "group": "groups",
    "map": "map fields",
    "oneof": "oneof",
    "service": "services",
}


class ProtoError(Exception):
    """A file that cannot be read; the text is a sentence with its place."""


@dataclass(slots=True)
class ProtoField:
    """A field of a message."""

    line: int
    name: str
    type: str
    """As written: `double`, `Header` or `gazebo.msgs.Vector3d`."""
    is_repeated: bool
    default: str | None
    """As written; a text with its quotes."""


@dataclass(slots=True)
class ProtoEnum:
    """An enumeration."""

    name: str
    values: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])


@dataclass(slots=True)
class ProtoMessage:
    """A message, with those declared in it."""

    name: str
    fields: list[ProtoField] = field(default_factory=list[ProtoField])
    messages: "list[ProtoMessage]" = field(default_factory=list["ProtoMessage"])
    enums: list[ProtoEnum] = field(default_factory=list[ProtoEnum])


@dataclass(slots=True)
class ProtoFile:
    """Package, imports, messages and enumerations of a .proto file."""

    path: Path
    package: str = ""
    imports: list[str] = field(default_factory=list[str])
    body: ProtoMessage = field(default_factory=lambda: ProtoMessage(""))
    """Messages and enumerations outside of messages."""


def read_proto(path: Path) -> ProtoFile:
    """Read a .proto file of syntax 2 or 3.

    Raises:
        ProtoError: it is no such file, or has what messages of one process do not: maps, groups, services, oneof.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise ProtoError(f"{path}: {error.strerror}") from None
    if len(data) > _MAX_BYTES:
        raise ProtoError(f"{path}: {len(data)} bytes are too many for a .proto file")
    return _Reader(path, data.decode("utf-8", errors="replace")).read()


class _Reader:
    def __init__(self, path: Path, text: str) -> None:
        self._path = path
        self._tokens = list(self._split(text))
        self._at = 0

    def read(self) -> ProtoFile:
        file = ProtoFile(self._path)
        while self._peek():
            word = self._next()
            if word == "package":
                file.package = self._next()
            elif word == "import":
                name = self._next()
                file.imports.append((self._next() if name in ("public", "weak") else name).strip("\"'"))
            elif word in ("syntax", "option"):
                self._skip_statement()
                continue
            elif word != ";":
                self._declaration(word, file.body, 0)
                continue
            self._skip_statement()
        return file

    def _declaration(self, word: str, into: ProtoMessage, depth: int) -> None:
        """Read a message or an enumeration after its first word."""
        if word in _MISSING:
            raise self._error(f"{_MISSING[word]} are not in messages of plugins here")
        if word not in ("message", "enum"):
            raise self._error(f"{word!r} is neither a message nor an enum")
        if depth > _MAX_DEPTH:
            raise self._error("messages are nested too deeply")
        name = self._next()
        self._expect("{")
        if word == "enum":
            into.enums.append(ProtoEnum(name, list(self._values())))
        else:
            message = ProtoMessage(name)
            into.messages.append(message)
            self._members(message, depth)

    def _members(self, message: ProtoMessage, depth: int) -> None:
        while (word := self._next()) != "}":
            if word in ("option", "reserved", "extensions"):
                self._skip_statement()
            elif word in ("message", "enum") or word in _MISSING:
                self._declaration(word, message, depth + 1)
            elif word != ";":
                message.fields.append(self._field(word))

    def _field(self, word: str) -> ProtoField:
        is_labelled = word in ("optional", "required", "repeated")
        kind = self._next() if is_labelled else word
        if kind in _MISSING:
            raise self._error(f"{_MISSING[kind]} are not in messages of plugins here")
        line, name = self._line(), self._next()
        self._expect("=")
        self._next()
        default = None
        options = list(self._until(";"))
        for before, after, value in zip(options, options[1:], options[2:], strict=False):
            if (before, after) == ("default", "="):
                default = value
        return ProtoField(line, name, kind, word == "repeated", default)

    def _values(self) -> Iterator[tuple[str, str]]:
        while (word := self._next()) != "}":
            if word in ("option", "reserved"):
                self._skip_statement()
            elif word != ";":
                self._expect("=")
                yield word, self._next()
                self._skip_statement()

    def _skip_statement(self) -> None:
        for _ in self._until(";"):
            pass

    def _until(self, end: str) -> Iterator[str]:
        while (word := self._next()) != end:
            yield word

    def _expect(self, mark: str) -> None:
        if (word := self._next()) != mark:
            raise self._error(f"{word!r} is where {mark!r} belongs")

    def _peek(self) -> bool:
        return self._at < len(self._tokens)

    def _next(self) -> str:
        if not self._peek():
            raise self._error("the file ends in the middle of a declaration")
        self._at += 1
        return self._tokens[self._at - 1][0]

    def _line(self) -> int:
        return self._tokens[min(max(self._at - 1, 0), len(self._tokens) - 1)][1] if self._tokens else 1

    def _error(self, what: str) -> ProtoError:
        return ProtoError(f"{self._path}:{self._line()}: {what}")

    def _split(self, text: str) -> Iterator[tuple[str, int]]:
        at, line = 0, 1
        while at < len(text):
            match = _TOKEN.match(text, at)
            if match is None:
                raise ProtoError(f"{self._path}:{line}: {text[at]!r} is not part of a .proto file")
            if match["space"] is None:
                yield match[0], line
            line += match[0].count("\n")
            at = match.end()
