"""Links of running pages, in files that only their user may read."""

import contextlib
import os
import urllib.error
import urllib.request
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import urlsplit, urlunsplit

import msgspec

from trundle.base.ownership import runtime_folders, write_private_file

from .wire import Served

_PREFIX, _SUFFIX = "page-", ".json"
_TIMEOUT_S = 2.0


def write_link_file(links: Served, environment: Mapping[str, str]) -> Path | None:
    """Write the file of a running page, whose owner removes it; None: the user has no private folder."""
    name = f"{_PREFIX}{links.port}-{os.getpid()}{_SUFFIX}"
    return write_private_file(name, msgspec.json.encode(links), environment)


def read_link_files(environment: Mapping[str, str]) -> list[Served]:
    """Return the links of this user's running pages, newest first; files of ended pages are removed."""
    files: list[tuple[float, Path, Served]] = []
    for folder in runtime_folders(environment):
        for file in folder.glob(f"{_PREFIX}*{_SUFFIX}"):
            with contextlib.suppress(OSError, msgspec.MsgspecError):
                files.append((file.stat().st_mtime, file, msgspec.json.decode(file.read_bytes(), type=Served)))
    running: list[Served] = []
    for _, file, links in sorted(files, key=lambda entry: entry[0], reverse=True):
        if _has_ended(links):
            file.unlink(missing_ok=True)
        else:
            running.append(links)
    return running


def _has_ended(links: Served) -> bool:
    """True if no server listens at the page's port, or if it is another server, which refuses the token."""
    session = urlunsplit(urlsplit(links.url)._replace(path="/session.json"))
    try:
        with urllib.request.build_opener(urllib.request.ProxyHandler({})).open(session, timeout=_TIMEOUT_S):
            return False
    except urllib.error.HTTPError as error:
        error.close()
        return True
    except urllib.error.URLError as error:
        return isinstance(error.reason, ConnectionRefusedError)
    except OSError:  # the server is busy
        return False
