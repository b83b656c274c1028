"""Which files are Python 2, and their code; both are kept below the user's cache folder."""

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
"""Raised when the same file is translated otherwise."""
_IS_PYTHON3 = b"3"
"""Kept for a file that needs no translation."""
_MAX_BYTES = 4_000_000
_MAX_FILES = 500
_said: list[str] = []


def is_python2_file(path: str | os.PathLike[str], *, in_package: bool = False) -> bool:
    """True if a file is Python 2 source; False for what cannot be read. Arguments are those of `translated_code`."""
    try:
        data = read_file(path, max_bytes=_MAX_BYTES)
    except OSError:
        return False
    if b"\0" in data:
        return False
    file = _file(data, path, in_package)
    kept = _kept(file)
    if kept is not None:
        return kept != _IS_PYTHON3
    from .detect import is_python2

    if not is_python2(_text(data)):
        _keep(file, _IS_PYTHON3)
        return False
    return True


def translated_code(path: str | os.PathLike[str], *, in_package: bool = False) -> CodeType:
    """Code of a Python 2 file, with its name and lines; the first of a process is named on standard error.

    Args:
        path: of the file.
        in_package: it is imported as a module of a package.

    Raises:
        SyntaxError: it is neither Python 2 nor Python 3.
    """
    data = read_file(path, max_bytes=_MAX_BYTES)
    file = _file(data, path, in_package)
    kept = _kept(file)
    if kept is not None:
        with contextlib.suppress(ValueError, EOFError, TypeError):
            code = marshal.loads(kept)
            if isinstance(code, CodeType):
                _say(path)
                return code
    from .translate import compile_translated

    code = compile_translated(_text(data), os.fspath(path), in_package=in_package)
    _keep(file, marshal.dumps(code))
    _say(path)
    return code


def changes(path: str | os.PathLike[str]) -> str:
    """Unified diff of a Python 2 file's translation; "" if it is Python 3."""
    from .translate import show_changes

    return show_changes(_text(read_file(path)), os.fspath(path)) if is_python2_file(path) else ""


def _say(path: str | os.PathLike[str]) -> None:
    if not _said:
        _said.append(os.fspath(path))
        what = "is Python 2: translated; --show-translation prints what changed"
        print(f"{_said[0]} {what}", file=sys.stderr, flush=True)


def _text(data: bytes) -> str:
    """Decode by its coding line; without one as UTF-8, and what is not that as Latin-1."""
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
        return data.decode(encoding)
    except (SyntaxError, UnicodeDecodeError, LookupError):
        return data.decode("latin-1")


def _file(data: bytes, path: str | os.PathLike[str], in_package: bool) -> Path:
    root = os.environ.get("XDG_CACHE_HOME") or home_folder(os.environ) / ".cache"
    key = b"\0".join((str(_VERSION).encode(), b"%d" % in_package, MAGIC_NUMBER, os.fsencode(path), data))
    return Path(root) / "trundle" / "python2" / hashlib.sha256(key).hexdigest()


def _kept(file: Path) -> bytes | None:
    if not is_owned_by_user(file.parent):  # another user's file could be any code
        return None
    try:
        return file.read_bytes()
    except OSError:
        return None


def _keep(file: Path, content: bytes) -> None:
    with contextlib.suppress(OSError):
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not is_owned_by_user(file.parent):
            return
        half = file.with_name(f"{file.name}.{os.getpid()}")
        half.write_bytes(content)
        os.replace(half, file)
        kept = list(file.parent.iterdir())
        if len(kept) > _MAX_FILES:
            min(kept, key=lambda each: each.stat().st_mtime).unlink()
