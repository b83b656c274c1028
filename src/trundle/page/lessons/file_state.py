"""State of a file that a lesson names: whether it exists and loads."""

import ast
import asyncio
import os
import sys
from pathlib import Path

from trundle.base.diagnostics import DescriptionError
from trundle.base.files import read_text

_DESCRIPTIONS = {".sdf", ".world", ".urdf", ".xacro", ".launch"}
_MAX_BYTES = 1_000_000
_TIMEOUT_S = 60.0
_Stamp = tuple[int, int]


class FileStates:
    """States of files; a file is read again once it has changed. Used on one loop."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[_Stamp, str | None]] = {}
        self._one_at_a_time = asyncio.Lock()

    async def fault(self, path: str) -> str | None:
        """Return why a file does not load; None: it loads."""
        file = Path(path).expanduser().absolute()
        async with self._one_at_a_time:
            try:
                status = os.stat(file)
            except (OSError, ValueError):
                return "it does not exist"
            stamp = (status.st_mtime_ns, status.st_size)
            known = self._known.get(path)
            if known is None or known[0] != stamp:
                known = self._known[path] = (stamp, await _find_fault(file))
            return known[1]


async def _find_fault(file: Path) -> str | None:
    if file.suffix in _DESCRIPTIONS:
        return await _check(file)
    return await asyncio.to_thread(_parse, file)


async def _check(file: Path) -> str | None:
    """Run `trundle check`, in a process that is killed if the file takes too long."""
    process = await asyncio.create_subprocess_exec(
        *(sys.executable, "-P", "-m", "trundle", "check", str(file)),
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.STDOUT,
    )
    try:
        output, _ = await asyncio.wait_for(process.communicate(), _TIMEOUT_S)
    except (TimeoutError, asyncio.CancelledError) as error:
        process.kill()
        await process.wait()
        if isinstance(error, asyncio.CancelledError):
            raise
        return f"it was not read within {_TIMEOUT_S:.0f} s"
    if process.returncode == 0:
        return None
    lines = output.decode(errors="replace").splitlines()
    return next((line for line in lines if ": error: " in line), "it does not load")


def _parse(file: Path) -> str | None:
    """Parse a program or configuration; other files need only be readable."""
    import yaml  # lazy, as each kind of file needs another parser

    from trundle.base.yaml_loader import load_yaml, one_line

    try:
        text = read_text(file, max_bytes=_MAX_BYTES)
        if file.suffix == ".py":
            ast.parse(text)
        elif file.suffix in (".yaml", ".yml"):
            load_yaml(text)
        elif file.suffix in (".xml", ".config"):
            from trundle.base.xmlnode import parse_xml

            parse_xml(text, name=file.name)
    except OSError as error:
        return error.strerror
    except (SyntaxError, RecursionError, MemoryError) as error:
        return f"it is no Python: {error}"
    except yaml.YAMLError as error:
        return one_line(error)
    except DescriptionError as error:
        return str(error)
    return None
