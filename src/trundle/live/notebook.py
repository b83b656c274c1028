"""Notebooks: whether this process runs one, and which Jupyter servers of this user may frame the page."""

import json
import os
import sys
from pathlib import Path
from urllib.parse import urlsplit

from trundle.base.diagnostics import UsageError
from trundle.base.http.page_address import AllowedNames

_HOSTS = ("localhost", "127.0.0.1")


def is_notebook() -> bool:
    """True in a kernel of Jupyter."""
    return "ipykernel" in sys.modules


def notebook_origins() -> tuple[str, ...]:
    """Return the origins of this user's Jupyter servers, `http://localhost:8888`, which may frame a notebook's page."""
    if not is_notebook():
        return ()
    origins: dict[str, None] = {}
    for file in sorted(_runtime_folder().glob("*server-*.json")):
        try:
            address = urlsplit(str(json.loads(file.read_text())["url"]))
            port, host = address.port, address.hostname
        except (OSError, ValueError, KeyError, TypeError):
            continue
        if address.scheme in ("http", "https") and host is not None and port is not None and ":" not in host:
            names = _HOSTS if host in _HOSTS else (host,)
            origins |= {f"{address.scheme}://{name}:{port}": None for name in names}
    return tuple(filter(_is_origin, origins))


def _is_origin(text: str) -> bool:
    try:
        AllowedNames(origins=(text,))
    except UsageError:
        return False
    return True


def _runtime_folder() -> Path:
    """Return the folder in which Jupyter's servers write their addresses (`jupyter --runtime-dir`)."""
    if named := os.environ.get("JUPYTER_RUNTIME_DIR"):
        return Path(named)
    if data := os.environ.get("JUPYTER_DATA_DIR"):
        return Path(data, "runtime")
    home = Path.home()
    if sys.platform == "darwin":
        return home / "Library/Jupyter/runtime"
    if sys.platform == "win32":
        return Path(os.environ.get("APPDATA", home), "jupyter/runtime")
    return Path(os.environ.get("XDG_DATA_HOME") or home / ".local/share", "jupyter/runtime")
