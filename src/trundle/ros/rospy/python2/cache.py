"""Detection and translation of Python 2 files, cached below the user's cache folder."""

import contextlib
import hashlib
import io
import marshal
import os
import sys
import tokenize
from importlib.util import MAGIC_NUMBER
from pathlib import Path
from types import CodeType

from trundle.base.files import read_file
from trundle.base.ownership import home_folder, is_owned_by_user

_VERSION = 3
"""Version of the translation, raised when its result changes."""
_IS_PYTHON3 = b"3"
"""Cached content for a file that needs no translation."""
_MAX_BYTES = 4_000_000
_MAX_FILES = 500
_announced: list[str] = []


def is_python2_file(path: str | os.PathLike[str], *, in_package: bool = False) -> bool:
    """True if a file is Python 2 source; False if it cannot be read. Arguments: see `translated_code`."""
    try:
        data = read_file(path, max_bytes=_MAX_BYTES)
    except OSError:
        return False
    if b"\0" in data:
        return False
    file = _file(data, path, in_package)
    cached = _read_cache(file)
    if cached is not None:
        return cached != _IS_PYTHON3
    from .detect import is_python2

    if not is_python2(_text(data)):
        _write_cache(file, _IS_PYTHON3)
        return False
    return True


def translated_code(path: str | os.PathLike[str], *, in_package: bool = False) -> CodeType:
    """Return the code of a Python 2 file's translation, which keeps file name and lines for tracebacks.

    For the first file of a process, a notice goes to standard error.

    Args:
        path: file's path.
        in_package: True for a module of a package.

    Raises:
        SyntaxError: the file is neither Python 2 nor Python 3.
    """
    data = read_file(path, max_bytes=_MAX_BYTES)
    file = _file(data, path, in_package)
    cached = _read_cache(file)
    if cached is not None:
        with contextlib.suppress(ValueError, EOFError, TypeError):
            code = marshal.loads(cached)
            if isinstance(code, CodeType):
                _announce(path)
                return code
    from .translate import compile_translated

    code = compile_translated(_text(data), os.fspath(path), in_package=in_package)
    _write_cache(file, marshal.dumps(code))
    _announce(path)
    return code


def changes(path: str | os.PathLike[str]) -> str:
    """Unified diff of a Python 2 file's translation; "" if it is Python 3."""
    from .translate import show_changes

    return show_changes(_text(read_file(path)), os.fspath(path)) if is_python2_file(path) else ""


def _announce(path: str | os.PathLike[str]) -> None:
    if not _announced:
        _announced.append(os.fspath(path))
        text = "is Python 2: translated; --show-translation prints the changes"
        print(f"{_announced[0]} {text}", file=sys.stderr, flush=True)


def _text(data: bytes) -> str:
    """Decode by the coding line, else as UTF-8, else as Latin-1."""
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
        return data.decode(encoding)
    except (SyntaxError, UnicodeDecodeError, LookupError):
        return data.decode("latin-1")


def _file(data: bytes, path: str | os.PathLike[str], in_package: bool) -> Path:
    root = os.environ.get("XDG_CACHE_HOME") or home_folder(os.environ) / ".cache"
    key = b"\0".join((str(_VERSION).encode(), b"%d" % in_package, MAGIC_NUMBER, os.fsencode(path), data))
    return Path(root) / "trundle" / "python2" / hashlib.sha256(key).hexdigest()


def _read_cache(file: Path) -> bytes | None:
    if not is_owned_by_user(file.parent):  # another user's file could be any code
        return None
    try:
        return file.read_bytes()
    except OSError:
        return None


def _write_cache(file: Path, content: bytes) -> None:
    with contextlib.suppress(OSError):
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not is_owned_by_user(file.parent):
            return
        part = file.with_name(f"{file.name}.{os.getpid()}")
        part.write_bytes(content)
        os.replace(part, file)
        files = list(file.parent.iterdir())
        if len(files) > _MAX_FILES:
            min(files, key=lambda cached_file: cached_file.stat().st_mtime).unlink()
