"""Unpacking an untrusted .zip of a model."""

import os
import stat
import struct
import zlib
from io import FileIO
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile, ZipInfo

from trundle.base.diagnostics import UsageError

from .tree import MAX_FILES, UploadTree

_CHUNK_BYTES = 1024 * 1024
_MAX_DIRECTORY_BYTES = 4 * _CHUNK_BYTES
"""Limit of the central directory, which `ZipFile` reads at once."""
_ENCRYPTED = 1
"""Flag of encrypted entries."""


class _BoundedReads(FileIO):
    """File that refuses large reads."""

    def read(self, size: int | None = -1, /) -> bytes:
        requested = os.fstat(self.fileno()).st_size - self.tell() if size is None or size < 0 else size
        if requested > _MAX_DIRECTORY_BYTES:
            raise UsageError(f"it has more than {MAX_FILES} files")
        return super().read(size) or b""


def unpack(archive: Path, tree: UploadTree) -> None:
    """Write an archive's files into a tree; their sizes are counted while unpacking, not read from the archive.

    Raises:
        UsageError: the file is not an archive, is damaged, or has entries that are refused.
    """
    try:
        with _BoundedReads(archive) as file, ZipFile(file) as packed:
            for entry in packed.infolist():
                if not entry.is_dir():
                    _unpack_entry(packed, entry, tree)
    except (BadZipFile, zlib.error, struct.error, OSError, EOFError, ValueError, NotImplementedError) as error:
        raise UsageError(f"the archive cannot be unpacked: {error}") from None


def _unpack_entry(packed: ZipFile, entry: ZipInfo, tree: UploadTree) -> None:
    if reason := _refusal(entry):
        raise UsageError(f"{entry.filename[:80]!r} in it {reason}")
    target = tree.create(entry.orig_filename)
    if target is None:
        return
    with target, packed.open(entry) as content:
        while piece := content.read(_CHUNK_BYTES):
            tree.write(target, piece)


def _refusal(entry: ZipInfo) -> str | None:
    """Return the reason to refuse an entry; None: it is accepted."""
    kind = stat.S_IFMT(entry.external_attr >> 16)
    if kind not in (0, stat.S_IFREG):
        return "is not a regular file"
    if entry.flag_bits & _ENCRYPTED:
        return "is encrypted"
    if entry.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
        return "is compressed by a method other than deflate"
    return None
