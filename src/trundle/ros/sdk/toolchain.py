"""Compiler, CMake, Ninja, Boost and Eigen of this machine, or of Python's packages."""

import importlib.util
import os
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from trundle.base.diagnostics import UsageError

from .zig import zig_definitions, zig_tools

_COMPILERS = ("c++", "g++", "clang++")
_HEADER, _EIGEN = "boost/shared_ptr.hpp", "Eigen/Core"
_CODECS = ("jpeglib.h", "png.h")
_HEADER_FOLDERS = ("/usr/include", "/usr/local/include", "/opt/homebrew/include", "/opt/local/include")


class Toolchain(NamedTuple):
    """Programs that compile C++, and the prefix of Boost."""

    compiler: str
    version: str
    """Output of the compiler's `--version`."""
    cmake: str
    ninja: str
    boost: Path | None
    """Prefix of Boost, if the compiler does not find it by itself."""
    eigen: Path | None = None
    """Prefix of Eigen, if it is a Python package's."""

    @property
    def prefixes(self) -> list[str]:
        """Folders in which CMake searches besides the machine's."""
        return list(dict.fromkeys(str(prefix) for prefix in (self.boost, self.eigen) if prefix is not None))


def find_toolchain(environment: Mapping[str, str]) -> Toolchain:
    """Find the programs of this machine that compile C++.

    Raises:
        UsageError: something is missing; the text says how to install it.
    """
    path = environment.get("PATH", os.defpath)
    chosen = environment.get("CXX")
    compiler = next(
        (found for name in ([chosen] if chosen else _COMPILERS) if (found := shutil.which(name, path=path))), None
    )
    if compiler is None:
        if chosen:
            raise UsageError(f"CXX names {chosen!r}, which is not found; unset it, or name a C++ compiler")
        compiler = _zig(environment)
    is_zig = bool(zig_definitions(compiler))
    missing = [name for name in ("cmake", "ninja") if _program(name, path) is None]
    boost = _boost(environment, prefers_python=is_zig)
    if boost is None:
        missing.append("cmeel-boost")
    if missing:
        raise UsageError(
            f"{' and '.join(missing)} {'are' if len(missing) > 1 else 'is'} missing; pip install {' '.join(missing)}"
        )
    version = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=False).stdout
    cmake, ninja = _program("cmake", path), _program("ninja", path)
    assert cmake is not None
    assert ninja is not None
    prefix = None if str(boost) in ("/usr", "/usr/local") else boost
    return Toolchain(compiler, version, cmake, ninja, prefix, _eigen())


def codec_headers() -> list[str]:
    """Return the headers of the machine's libraries of JPEG and PNG that the kit's compressed images need."""
    return [name for name in _CODECS if any(Path(folder, name).is_file() for folder in _HEADER_FOLDERS)]


def _zig(environment: Mapping[str, str]) -> str:
    try:
        folder = zig_tools(environment)
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None
    if folder is None:
        raise UsageError(f"there is no C++ compiler; {_compiler_advice()}, or Python's: pip install 'trundle[cpp]'")
    return str(folder / "c++")


def _compiler_advice() -> str:
    if sys.platform == "darwin":
        return "install one with xcode-select --install"
    return "install one, such as with apt install g++ or dnf install gcc-c++"


def _program(name: str, path: str) -> str | None:
    """Return a program's path: on PATH, or from a Python package."""
    return shutil.which(name, path=path) or shutil.which(name, path=sysconfig.get_path("scripts"))


def _boost(environment: Mapping[str, str], *, prefers_python: bool) -> Path | None:
    """Return the prefix of Boost's headers: the machine's, else that of the Python package cmeel-boost.

    Zig's compiler is too new for the Boost of many machines, whose turn is last then.
    """
    named = environment.get("BOOST_ROOT")
    machine, python = [Path(folder) for folder in _HEADER_FOLDERS], [_python_prefix() / "include"]
    folders = [Path(named, "include")] if named else []
    folders += [*python, *machine] if prefers_python else [*machine, *python]
    return next((folder.parent for folder in folders if (folder / _HEADER).is_file()), None)


def _eigen() -> Path | None:
    """Return the prefix of the Python package cmeel-eigen if the machine has no Eigen."""
    if any(Path(folder, "eigen3", _EIGEN).is_file() for folder in _HEADER_FOLDERS):
        return None
    prefix = _python_prefix()
    return prefix if (prefix / "include/eigen3" / _EIGEN).is_file() else None


def _python_prefix() -> Path:
    """Return the folder in which Python's packages of C++ libraries are."""
    cmeel = importlib.util.find_spec("cmeel")
    site = Path(cmeel.origin).parents[1] if cmeel and cmeel.origin else Path(sysconfig.get_path("purelib"))
    return site / "cmeel.prefix"
