"""Check that the compiled modules of a checkout match its C++ sources."""

import hashlib
from functools import cache
from pathlib import Path
from types import ModuleType

from trundle.base.diagnostics import TrundleError

_SOURCES = Path(__file__).parents[3] / "cpp"


def refuse_stale(module: ModuleType) -> None:
    """Refuse a compiled module that does not match the checkout's C++ sources; an installed wheel has no sources.

    Raises:
        TrundleError: the sources differ.
    """
    digest = _digest(_SOURCES)
    package = Path(str(module.__file__)).parents[module.__name__.count(".") - 1]
    record = package / "sources.sha256"  # CMake installs the digest with the modules
    if digest is None or (record.is_file() and record.read_text() == digest):
        return
    problem = f"the compiled part of Trundle does not match the sources in {_SOURCES}"
    raise TrundleError(f"{problem}; build it: make .venv/.ready, or pip install --editable {_SOURCES.parent}")


@cache
def _digest(sources: Path) -> str | None:
    """Return the digest, as in CMakeLists.txt; None without sources."""
    files = sorted(path for path in sources.glob("*/*") if path.suffix in (".cc", ".h"))
    digests = [hashlib.sha256(path.read_bytes()).hexdigest() for path in files]
    return hashlib.sha256("".join(digests).encode()).hexdigest() if files else None
