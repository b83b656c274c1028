"""Where the text of message and service definitions comes from: this package, or folders a user adds."""

import re
from dataclasses import dataclass
from pathlib import Path

_SHIPPED = Path(__file__).parent / "definitions"
_CONSTANT = re.compile(r"^\s*(?P<type>[A-Za-z0-9_]+)\s+(?P<name>[A-Za-z][A-Za-z0-9_]*)\s*=(?P<value>.*)$", re.MULTILINE)


@dataclass(slots=True)
class Definitions:
    """Texts by type name ('geometry_msgs/Twist'), read from a package's folder when one of its types is asked for."""

    messages: dict[str, str]
    services: dict[str, str]
    folders: dict[str, Path]
    """Package → the folder that holds its `msg/` and `srv/`."""

    @classmethod
    def shipped(cls) -> "Definitions":
        """What comes with Trundle because the message library lacks it."""
        folders = {path.name: path for path in sorted(_SHIPPED.iterdir()) if path.is_dir()}
        return cls({}, {}, folders)

    def load_package(self, package: str) -> list[str]:
        """Read a package's texts, once; return the names of its messages."""
        folder = self.folders.pop(package, None)
        if folder is None:
            return []
        self.services.update({f"{package}/{p.stem}": _read(p) for p in sorted(folder.glob("srv/*.srv"))})
        found = {f"{package}/{p.stem}": _read(p) for p in sorted(folder.glob("msg/*.msg"))}
        self.messages.update(found)
        return list(found)


def split_service(text: str) -> tuple[str, str]:
    """Split a .srv text into request and response."""
    request, separator, response = re.sub(r"^\s*---[^\n]*$", "\0", text, count=1, flags=re.MULTILINE).partition("\0")
    return (request, response.lstrip("\n")) if separator else (text, "")


def constant_texts(text: str) -> dict[str, str]:
    """Values of constants exactly as written: the md5 sum is over the text, and `1.50` is not `1.5`."""
    found: dict[str, str] = {}
    for match in _CONSTANT.finditer(text):
        value = match["value"]
        # Only string constants may hold a '#'; everything up to the end of the line is theirs (msg specification).
        found[match["name"]] = value.strip() if match["type"] == "string" else value.partition("#")[0].strip()
    return found


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace").replace("\r\n", "\n")
