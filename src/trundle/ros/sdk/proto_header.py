"""C++ headers of .proto files, with the accessors that Protobuf's compiler makes.

Messages of Gazebo's transport stay inside the process here, so they need neither protoc nor its library. What a file
has beyond that is a compile error with a sentence.
"""

import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from .proto_file import ProtoError, ProtoField, ProtoFile, ProtoMessage, read_proto

_SCALARS = {
    "double": "double",
    "float": "float",
    "bool": "bool",
    "string": "std::string",
    "bytes": "std::string",
    **dict.fromkeys(("int32", "sint32", "sfixed32"), "int32_t"),
    **dict.fromkeys(("int64", "sint64", "sfixed64"), "int64_t"),
    **dict.fromkeys(("uint32", "fixed32"), "uint32_t"),
    **dict.fromkeys(("uint64", "fixed64"), "uint64_t"),
}
_NAME = re.compile(r"[A-Za-z_]\w*")
_NUMBER = re.compile(r"-?(?:0[xX][0-9a-fA-F]+|\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)")
_GAZEBO = re.compile(r"^class (\w+) \{", re.MULTILINE)
_KEYWORDS = frozenset(
    [
        "and",
        "auto",
        "bool",
        "break",
        "case",
        "char",
        "class",
        "const",
        "default",
        "delete",
        "do",
        "double",
        "else",
        "enum",
        "explicit",
        "export",
        "extern",
        "false",
        "float",
        "for",
        "friend",
        "goto",
        "if",
        "inline",
        "int",
        "long",
        "namespace",
        "new",
        "not",
        "operator",
        "or",
        "private",
        "protected",
        "public",
        "register",
        "return",
        "short",
        "signed",
        "sizeof",
        "static",
        "struct",
        "switch",
        "template",
        "this",
        "throw",
        "true",
        "try",
        "typedef",
        "union",
        "unsigned",
        "using",
        "virtual",
        "void",
        "volatile",
        "while",
        "xor",
    ]
)


def main(out: str, *arguments: str) -> int:
    """Write the headers of .proto files, and a source that includes each: `OUT [-I FOLDER]… FILE…`.

    A file that cannot be read becomes a header with an #error, so that all targets without it are built.
    """
    folders = [Path(word[2:]) for word in arguments if word.startswith("-I") and len(word) > 2]
    for name in (word for word in arguments if not word.startswith("-I")):
        path = Path(name)
        header = Path(out) / f"{path.stem}.pb.h"
        try:
            text = proto_header(path, [path.parent, *folders])
        except ProtoError as error:
            text = f'#error "{str(error).translate({34: 39, 92: 47})}"\n'
        for file, content in ((header, text), (header.with_suffix(".cc"), f'#include "{header.name}"\n')):
            if not file.exists() or file.read_text(encoding="utf-8") != content:
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(content, encoding="utf-8")
    return 0


def proto_header(path: Path, folders: Sequence[Path]) -> str:
    """Return the header of a .proto file.

    Args:
        path: the file.
        folders: folders of the files that it imports; Gazebo's own messages are the kit's.

    Raises:
        ProtoError: the file cannot be read, or names a message that there is not.
    """
    return _Writer(path, folders).text()


class _Writer:
    def __init__(self, path: Path, folders: Sequence[Path]) -> None:
        self._file = read_proto(path)
        self._folders = folders
        # Full name → C++ name, and the first value of an enumeration.
        self._types: dict[str, tuple[str, str | None]] = {}
        self._includes = ["<gazebo/msgs/msgs.hh>", "<gazebo/msgs/world_messages.h>"]
        for name in _kit_messages():
            self._types[f"gazebo.msgs.{name}"] = (f"::gazebo::msgs::{name}", None)
        self._import(self._file, set())
        self._declare(self._file)

    def text(self) -> str:
        spaces = [_name(part, self._file.path) for part in self._file.package.split(".") if self._file.package]
        body = self._file.body
        scope = self._file.package
        lines = ["#pragma once", "", *(f"#include {name}" for name in self._includes), ""]
        lines += [f"namespace {space} {{" for space in spaces]
        lines += [line for enum in body.enums for line in self._enum(enum.name, enum.values)]
        for message in self._ordered(body.messages, scope):
            lines += ["", *self._message(message, scope)]
        lines += ["", *(f"}}  // namespace {space}" for space in reversed(spaces))]
        return "\n".join(lines) + "\n"

    def _import(self, file: ProtoFile, seen: set[Path]) -> None:
        for name in file.imports:
            found = next(
                (folder / name for folder in (file.path.parent, *self._folders) if (folder / name).is_file()), None
            )
            if found is None or found.resolve() in seen:
                continue  # one of Gazebo's: each of its messages that is used is looked up
            seen.add(found.resolve())
            imported = read_proto(found)
            if file is self._file:
                self._includes.append(f'"{Path(name).stem}.pb.h"')
            self._declare(imported)
            self._import(imported, seen)

    def _declare(self, file: ProtoFile) -> None:
        def declare(message: ProtoMessage, scope: str) -> None:
            for enum in message.enums:
                first = enum.values[0][0] if enum.values else ""
                self._types[_join(scope, enum.name)] = (_cpp(_join(scope, enum.name)), first)
            for inner in message.messages:
                self._types[_join(scope, inner.name)] = (_cpp(_join(scope, inner.name)), None)
                declare(inner, _join(scope, inner.name))

        declare(file.body, file.package)

    def _message(self, message: ProtoMessage, scope: str) -> Iterator[str]:
        name = _name(message.name, self._file.path)
        own = _join(scope, name)
        yield f"class {name} {{"
        if message.enums or message.messages:
            yield " public:"
        for enum in message.enums:
            yield from (f"  {line}" for line in self._enum(enum.name, enum.values))
        for inner in self._ordered(message.messages, own):
            yield from (f"  {line}" for line in self._message(inner, own))
        for field in message.fields:
            yield f"  {self._field(field, own)}"
        yield f"  TRUNDLE_WHOLE({name})"
        yield "};"

    def _enum(self, name: str, values: Sequence[tuple[str, str]]) -> Iterator[str]:
        for value, number in values:
            _name(value, self._file.path)
            if _NUMBER.fullmatch(number) is None:
                raise ProtoError(f"{self._file.path}: {value} = {number}: this is not a number")
        _name(name, self._file.path)
        yield f"enum {name} {{ {', '.join(f'{value} = {number}' for value, number in values)} }};"

    def _field(self, field: ProtoField, scope: str) -> str:
        where = f"{self._file.path}:{field.line}"
        name = field.name.lower()
        if _NAME.fullmatch(name) is None:
            raise ProtoError(f"{where}: {field.name!r} is not a name")
        name += "_" if name in _KEYWORDS else ""
        kind, first = self._type(field, scope)
        if first is None:
            return f"TRUNDLE_MESSAGE{'S' if field.is_repeated else ''}({kind}, {name})"
        if field.is_repeated:
            return f"TRUNDLE_FIELDS({kind}, {name})"
        default = field.default or first
        if not default:
            return f"TRUNDLE_FIELD({kind}, {name})"
        known = {"std::string": r'"[^\n]*"', "bool": "true|false"}.get(kind, _NAME if first else _NUMBER)
        if re.fullmatch(known, default) is None:
            raise ProtoError(f"{where}: {default} is not a default of {field.type} that is known here")
        if first:
            default = f"{kind.rpartition('::')[0]}::{default}"
        return f"TRUNDLE_FIELD_FROM({kind}, {name}, {default})"

    def _type(self, field: ProtoField, scope: str) -> tuple[str, str | None]:
        """Return the C++ type of a field; an enumeration's first value, "" for a number or text, None for a message."""
        if field.type in _SCALARS:
            return _SCALARS[field.type], ""
        if (found := self._find(field.type, scope)) is not None:
            return self._types[found]
        raise ProtoError(
            f"{self._file.path}:{field.line}: no message {field.type}; it is neither imported nor Gazebo's here"
        )

    def _find(self, name: str, scope: str) -> str | None:
        """Return the full name of a type as written in a scope: the innermost of its name."""
        if name.startswith("."):
            return name[1:] if name[1:] in self._types else None
        while True:
            if (full := _join(scope, name)) in self._types:
                return full
            if not scope:
                return None
            scope = scope.rpartition(".")[0]

    def _ordered(self, messages: Sequence[ProtoMessage], scope: str) -> list[ProtoMessage]:
        """Return messages so that each comes after those that it has as fields."""
        by_name = {_join(scope, message.name): message for message in messages}
        ordered: list[ProtoMessage] = []
        open_: list[str] = []

        def visit(full: str) -> None:
            message = by_name[full]
            if message in ordered:
                return
            if full in open_:
                raise ProtoError(f"{self._file.path}: message {message.name} has itself as a field")
            open_.append(full)
            for used in self._used(message, full):
                outer = next((name for name in by_name if used == name or used.startswith(f"{name}.")), None)
                if outer is not None and outer != full:
                    visit(outer)
                elif used == full:
                    raise ProtoError(f"{self._file.path}: message {message.name} has itself as a field")
            open_.pop()
            ordered.append(message)

        for full in by_name:
            visit(full)
        return ordered

    def _used(self, message: ProtoMessage, scope: str) -> Iterator[str]:
        for field in message.fields:
            found = None if field.type in _SCALARS else self._find(field.type, scope)
            if found is not None:
                yield found
        for inner in message.messages:
            yield from self._used(inner, _join(scope, inner.name))


def _kit_messages() -> list[str]:
    from .kit import kit_sources

    folder = kit_sources() / "gazebo/include/gazebo/msgs"
    headers = [(folder / name).read_text(encoding="utf-8") for name in ("msgs.hh", "world_messages.h")]
    return [name for text in headers for name in _GAZEBO.findall(text)]


def _join(scope: str, name: str) -> str:
    return f"{scope}.{name}" if scope else name


def _cpp(name: str) -> str:
    return f"::{name.replace('.', '::')}"


def _name(name: str, path: Path) -> str:
    if _NAME.fullmatch(name) is None or name in _KEYWORDS:
        raise ProtoError(f"{path}: {name!r} is not a name in C++")
    return name


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
