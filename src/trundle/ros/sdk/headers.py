"""Folders of generated headers: for a package's own types, and for other types that its sources include."""

import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.files import read_text

from ..errors import MessageError
from ..messages.definition_files import definition_files
from ..messages.definition_search import split_action
from ..messages.message_library import Messages
from .message_header import message_header, nested_types, service_header

_SOURCES = (".cpp", ".cc", ".cxx", ".c++", ".h", ".hh", ".hpp", ".hxx", ".inl", ".ipp")
_INCLUDE = re.compile(r"""^[ \t]*#[ \t]*include[ \t]*[<"](\w+)/(\w+)\.h[>"]""", re.MULTILINE)
_NOT_SEARCHED = frozenset({"build", "devel", "install"})


class Headers:
    """Writer of headers; it writes each header once, with the headers that this includes."""

    def __init__(self, packages: Mapping[str, Path], own: Path, shared: Path, *, provided: Path) -> None:
        """Create a writer.

        Args:
            packages: name → folder of the workspace's packages.
            own: folder for the headers of these packages' types.
            shared: folder for the headers of other packages' types.
            provided: folder of the development kit's headers, which are not generated again.
        """
        self._packages = packages
        self._own, self._shared = own, shared
        self._messages = Messages()
        self._done: set[str] = set()
        self._provided = {(path.parent.name, path.stem) for path in provided.glob("*/include/*/*.h")}
        for name, folder in packages.items():
            self._messages.add_package(name, folder)

    def write_package(self, name: str) -> list[Path]:
        """Write the headers of a package's types; return its definition files."""
        folder = self._packages[name]
        files = {kind: definition_files(folder, kind) for kind in ("msg", "srv", "action")}
        for path in files["msg"]:
            self.write_message(f"{name}/{path.stem}")
        for path in files["srv"]:
            self.write_service(f"{name}/{path.stem}")
        for path in files["action"]:
            for part in split_action(f"{name}/{path.stem}", ""):
                self.write_message(part)
        return [path for paths in files.values() for path in paths]

    def write_included(self, folders: Iterable[Path]) -> None:
        """Write the headers of other packages' types that the sources below folders include."""
        for package, name in sorted({pair for folder in folders for pair in included(folder)} - self._provided):
            if package not in self._packages:
                self._write_known(f"{package}/{name}")

    def write_message(self, type_name: str) -> None:
        """Write a message's header, and those of the types of its fields.

        Raises:
            MessageError: the type, or one that it contains, is unknown or invalid.
        """
        if type_name not in self._done:
            self._done.add(type_name)
            self._write(type_name, message_header(self._messages, type_name))
            for nested in nested_types(self._messages, type_name):
                self.write_message(nested)

    def write_service(self, type_name: str) -> None:
        """Write the headers of a service.

        Raises:
            MessageError: the service, or a type that it uses, is unknown or invalid.
        """
        service = self._messages.service(type_name)
        self._write(type_name, service_header(service))
        for part in (service.request, service.response):
            self._write(part, message_header(self._messages, part, of_service=service))
            for nested in nested_types(self._messages, part):
                self.write_message(nested)

    def _write_known(self, type_name: str) -> None:
        """Write the header of a name if it is that of a message or a service."""
        base = type_name.removesuffix("Request").removesuffix("Response")
        for candidate in dict.fromkeys((type_name, base)):
            try:
                self._messages.service(candidate)
            except MessageError:
                continue
            self.write_service(candidate)
            return
        if self._messages.has(type_name):
            self.write_message(type_name)

    def _write(self, type_name: str, text: str) -> None:
        package, _, name = type_name.partition("/")
        path = (self._own if package in self._packages else self._shared) / package / f"{name}.h"
        if not path.is_file() or path.read_text(encoding="utf-8") != text:  # a new time recompiles all
            path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(path, text)


def included(folder: Path) -> set[tuple[str, str]]:
    """Return folder and name of the headers `folder/name.h` that the C++ files below a folder include."""
    pairs: set[tuple[str, str]] = set()
    for root, folders, files in os.walk(folder):
        folders[:] = [child for child in folders if not child.startswith(".") and child not in _NOT_SEARCHED]
        for file in files:
            if file.endswith(_SOURCES):
                pairs.update(_INCLUDE.findall(_text(Path(root, file))))
    return pairs


def _text(path: Path) -> str:
    try:
        return read_text(path)
    except (OSError, UnicodeError):
        return ""
