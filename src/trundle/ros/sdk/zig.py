"""The C++ compiler of the Python package ziglang, for machines without one."""

import importlib.util
import os
import shlex
import sys
from collections.abc import Mapping
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.ownership import home_folder

_FOR_BOOST = "-D_LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION"
"""What Boost before 1.81 uses of a standard library that no longer has it."""
_FIRST = 'for word do shift; [ "$word" != -isystem ] || word=-I; set -- "$@" "$word"; done'
"""Zig searches folders of -isystem after /usr/include, whose Boost may be too old for it."""
_TOOLS = {"c++": f"c++ {_FOR_BOOST}", "cc": "cc", "ar": "ar", "ranlib": "ranlib"}
"""Name of a program → Zig's subcommand."""


def zig_tools(environment: Mapping[str, str]) -> Path | None:
    """Return a folder with the programs c++, cc, ar and ranlib of Zig; None if ziglang is not installed.

    Args:
        environment: environment variables; XDG_CACHE_HOME names the folder of caches.

    Raises:
        OSError: the folder cannot be written.
    """
    if os.name == "nt" or importlib.util.find_spec("ziglang") is None:
        return None
    cache = Path(environment.get("XDG_CACHE_HOME") or home_folder(environment) / ".cache")
    folder = cache / "trundle" / "zig"
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    for name, command in _TOOLS.items():
        program = folder / name
        text = f'#!/bin/sh\n{_FIRST}\nexec {shlex.quote(sys.executable)} -m ziglang {command} "$@"\n'
        if not program.is_file() or program.read_text(encoding="utf-8") != text:
            write_atomically(program, text)
            program.chmod(0o700)
    return folder


def zig_definitions(compiler: str) -> list[str]:
    """Return what CMake has to know beside the compiler if this is Zig's: the tools that the machine may lack."""
    folder = Path(compiler).parent
    if folder.parts[-2:] != ("trundle", "zig"):
        return []
    tools = {"CMAKE_C_COMPILER": "cc", "CMAKE_AR": "ar", "CMAKE_RANLIB": "ranlib"}
    definitions = [f"-D{variable}={folder / name}" for variable, name in tools.items()]
    spec = importlib.util.find_spec("ziglang")
    return definitions if spec is None else [*definitions, f"-DTRUNDLE_ZIG={Path(str(spec.origin)).parent / 'lib'}"]
