"""Message, service and action definitions of a package: shipped ones first, then the package's own, then published."""

from collections.abc import Iterator
from functools import cache, cached_property
from pathlib import Path

from trundle.assets import ASSETS
from trundle.base.files import read_text
from trundle.ros.errors import MessageError
from trundle.ros.messages.definition_files import definition_files
from trundle.ros.messages.definition_search import (
    MAX_CHARACTERS,
    published_definitions,
    split_action,
    split_service,
)

from .message_spec import SEPARATOR
from .package_folders import find_package

_BUNDLES = ASSETS / "messages/standard"
_FOLDERS = ASSETS / "messages/definitions"
_KINDS = ("msg", "srv", "action")
_PARTS = ("Action", "ActionGoal", "ActionResult", "ActionFeedback", "Goal", "Result", "Feedback")


class DefinitionFolder:
    """Definitions in one folder with `msg/`, `srv/` and `action/`; read on first use."""

    def __init__(self, package: str, folder: Path) -> None:
        self._package = package
        self._folder = folder

    @cached_property
    def messages(self) -> dict[str, Path]:
        """Message name → its file, parts of actions included."""
        actions = self._files("action")
        parts = {f"{name}{part}": path for name, path in actions for part in _PARTS}
        return parts | dict(self._files("msg"))

    @cached_property
    def services(self) -> dict[str, Path]:
        """Service name → its file."""
        return dict(self._files("srv"))

    def message(self, name: str) -> str | None:
        """Text of a message; None if there is none of this name."""
        path = self.messages.get(name)
        if path is None:
            return None
        text = _read(path)
        if path.suffix != ".action":
            return text
        return split_action(f"{self._package}/{path.stem}", text)[f"{self._package}/{name}"][1]

    def service(self, name: str) -> str | None:
        """Text of a service; None if there is none of this name."""
        path = self.services.get(name)
        return None if path is None else _read(path)

    def _files(self, kind: str) -> list[tuple[str, Path]]:
        return [(path.stem, path) for path in definition_files(self._folder, kind)]


class PublishedDefinitions:
    """Definitions of a published package that is not on this machine."""

    def __init__(self, package: str) -> None:
        self.messages: dict[str, str] = {}
        self.services: dict[str, str] = {}
        for kind, name, text in published_definitions(package):
            if kind == "action":
                parts = split_action(name, text).items()
                self.messages |= {part.partition("/")[2]: text_of_part for part, (_, text_of_part) in parts}
            else:
                (self.messages if kind == "msg" else self.services)[name.partition("/")[2]] = text

    def message(self, name: str) -> str | None:
        """Text of a message; None if there is none of this name."""
        return self.messages.get(name)

    def service(self, name: str) -> str | None:
        """Text of a service; None if there is none of this name."""
        return self.services.get(name)


class PackageDefinitions:
    """Definitions of one package: shipped, and in the package's folder."""

    def __init__(self, package: str) -> None:
        self._package = package
        self._bundle = dict(_bundle(package))
        self._shipped = DefinitionFolder(package, _FOLDERS / package)

    @cached_property
    def _unshipped(self) -> DefinitionFolder | PublishedDefinitions:
        folder = find_package(self._package)
        return PublishedDefinitions(self._package) if folder is None else DefinitionFolder(self._package, folder)

    @property
    def _is_shipped(self) -> bool:
        return bool(self._bundle or self._shipped.messages or self._shipped.services)

    @property
    def is_empty(self) -> bool:
        """True if the package defines nothing."""
        return not (self.names("msg") or self.names("srv"))

    def names(self, kind: str) -> list[str]:
        """Names of the messages (`msg`) or services (`srv`): the shipped ones if any, else those in its folder."""
        folder = self._shipped if self._is_shipped else self._unshipped
        names = folder.messages if kind == "msg" else folder.services
        return sorted({*names, *(self._bundle if kind == "msg" else ())})

    def message(self, name: str) -> str | None:
        """Text of a message; None if the package has none of this name.

        Raises:
            MessageError: its file cannot be read.
        """
        text = self._bundle.get(name)
        text = self._shipped.message(name) if text is None else text
        return self._unshipped.message(name) if text is None else text

    def service(self, name: str) -> str | None:
        """Text of a service; None if the package has none of this name.

        Raises:
            MessageError: its file cannot be read.
        """
        text = self._shipped.service(name)
        return self._unshipped.service(name) if text is None else text


@cache
def find_definitions(package: str) -> PackageDefinitions:
    """Definitions of a package; empty if it has none."""
    return PackageDefinitions(package)


def service_halves(text: str) -> tuple[str, str]:
    """Split the text of a service into request and response."""
    (_, request), (_, response) = split_service(text)
    return request, response


def _bundle(package: str) -> Iterator[tuple[str, str]]:
    """Pairs (name, text) of the types in a package's shipped bundle."""
    path = _BUNDLES / f"{package}.txt"
    if not path.is_file():
        return
    for part in path.read_text(encoding="utf-8").split(f"{SEPARATOR}\n"):
        head, _, text = part.partition("\n")
        yield head.rpartition("/")[2], text


def _read(path: Path) -> str:
    try:
        return read_text(path, max_bytes=MAX_CHARACTERS)
    except OSError as error:
        raise MessageError(f"{path}: cannot be read: {error.strerror}") from None
