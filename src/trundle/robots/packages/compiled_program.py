"""Detection of ELF programs and libraries that cannot run here, such as in a devel folder copied from another machine.

The file layout is in the System V ABI, "Object Files" and "Dynamic Linking"; the search order in ld.so(8).
"""

import mmap
import os
import platform
import struct
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from trundle.base.files import open_file, read_file

_MACHINES = {3: "x86", 40: "ARM", 62: "x86-64", 183: "ARM64", 243: "RISC-V"}
_RUN_BY = {"x86_64": {3, 62}, "aarch64": {40, 183}, "i686": {3}, "armv7l": {40}, "riscv64": {243}}
_LOAD, _DYNAMIC, _INTERPRETER = 1, 2, 3
_NEEDED, _STRINGS, _RPATH, _RUNPATH = 1, 5, 15, 29
_MAX_SEGMENTS, _MAX_ENTRIES, _MAX_LENGTH = 200, 2000, 4096
_CACHE = Path("/etc/ld.so.cache")
_FOLDERS = ("/lib", "/usr/lib", "/lib64", "/usr/lib64", "/usr/local/lib")


class _Segment(NamedTuple):
    kind: int
    offset: int
    address: int
    size: int


def compiled_fault(path: Path, env: Mapping[str, str]) -> str | None:
    """Return the reason why this machine cannot load an ELF file; None if it can, or if the file is not ELF."""
    try:
        with open_file(path) as file:
            if file.read(4) != b"\x7fELF":
                return None
            if sys.platform != "linux":
                return "it is compiled for Linux"
            with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
                return _fault(path, data, env)
    except (OSError, ValueError, struct.error):  # the file is damaged: starting it gives the system's message
        return None


def _fault(path: Path, data: mmap.mmap, env: Mapping[str, str]) -> str | None:
    (machine,) = struct.unpack_from("<H", data, 18)
    if machine not in _RUN_BY.get(platform.machine(), {machine}):
        return f"it is compiled for {_MACHINES.get(machine, 'another processor')}, not {platform.machine()}"
    if data[4:6] != b"\x02\x01" or not _CACHE.exists():  # checked only for 64 bits, little-endian, and glibc's loader
        return None
    segments = list(_segments(data))
    for segment in segments:
        loader = os.fsdecode(data[segment.offset : segment.offset + min(segment.size, _MAX_LENGTH)].rstrip(b"\0"))
        if segment.kind == _INTERPRETER and not os.path.exists(loader):
            return f"its loader {loader} is not here"
    entries = list(_dynamic(data, segments))
    run_path = [folder for tag, text in entries if tag != _NEEDED for folder in text.split(":")]
    origin = os.path.dirname(os.path.realpath(path))
    run_path = [folder.replace("${ORIGIN}", "$ORIGIN").replace("$ORIGIN", origin) for folder in run_path]
    folders = [*run_path, *env.get("LD_LIBRARY_PATH", "").split(":"), *_FOLDERS]
    cache = read_file(_CACHE)
    missing = [name for tag, name in entries if tag == _NEEDED and not _is_library_found(name, folders, cache)]
    return f"{', '.join(missing)} {'is' if len(missing) == 1 else 'are'} not here" if missing else None


def _segments(data: mmap.mmap) -> Iterator[_Segment]:
    (table,) = struct.unpack_from("<Q", data, 32)
    size, count = struct.unpack_from("<HH", data, 54)
    for index in range(min(count, _MAX_SEGMENTS)):
        kind, _, offset, address, _, length = struct.unpack_from("<IIQQQQ", data, table + index * size)
        yield _Segment(kind, offset, address, length)


def _dynamic(data: mmap.mmap, segments: list[_Segment]) -> Iterator[tuple[int, str]]:
    """Yield the tags and texts of the dynamic entries that name libraries and folders."""
    entries: list[tuple[int, int]] = []
    for segment in segments:
        if segment.kind == _DYNAMIC:
            count = min(segment.size // 16, _MAX_ENTRIES)
            entries += [struct.unpack_from("<qQ", data, segment.offset + 16 * index) for index in range(count)]
    address = dict(entries).get(_STRINGS, 0)
    offsets = (s.offset - s.address for s in segments if s.kind == _LOAD and s.address <= address < s.address + s.size)
    strings = address + next(offsets, 0)
    for tag, value in entries:
        if tag in (_NEEDED, _RPATH, _RUNPATH):
            start = strings + value
            yield tag, os.fsdecode(data[start : min(max(data.find(b"\0", start), start), start + _MAX_LENGTH)])


def _is_library_found(library: str, folders: list[str], cache: bytes) -> bool:
    in_cache = any(
        os.fsencode(f"{separator}{library}\0") in cache for separator in ("/", "\0")
    )  # the cache holds names, some as the ends of paths
    return in_cache or any(os.path.exists(os.path.join(folder, library)) for folder in folders if folder)
