"""Upload of a recorded run, into a file that is removed once it is read."""

import asyncio
import os
import tempfile
from collections.abc import Awaitable, Callable
from pathlib import Path

import msgspec
from aiohttp import BodyPartReader, MultipartReader

from trundle.base.diagnostics import UsageError, printable

from ..requests.request import Compare
from .tree import MAX_BYTES

_CHUNK_BYTES = 256 * 1024
_TIMEOUT_S = 600.0
_MAX_TITLE = 100


class UploadedRecording(msgspec.Struct, frozen=True):
    """Answer to an upload of a recording: the page is compared with it."""

    title: str


async def compare_upload(parts: MultipartReader, compare: Callable[[Compare], Awaitable[str | None]]) -> str:
    """Receive a recording and compare the page with it; return its title, from the name of its field.

    Args:
        parts: form with one file.
        compare: compares the page with the file; returns the reason if it cannot compare.

    Raises:
        UsageError: the form has no file or a too large one, or it cannot be compared.
    """
    part = await parts.next()
    if not isinstance(part, BodyPartReader) or not part.name:
        raise UsageError("no file was sent")
    name = part.name.rpartition("/")[2].encode("utf-8", "replace").decode()
    title = printable(name)[:_MAX_TITLE] or "recording"
    with tempfile.TemporaryDirectory(prefix="trundle-recording-") as folder:
        file = Path(folder) / "recording"
        try:
            async with asyncio.timeout(_TIMEOUT_S):
                await _write(part, file)
        except TimeoutError:
            raise UsageError(f"the upload took more than {_TIMEOUT_S:.0f} s") from None
        except OSError as error:
            raise UsageError(f"the upload cannot be stored: {error.strerror}") from None
        refusal = await compare(Compare(file=os.fsencode(file), title=title))
    if refusal is not None:
        raise UsageError(refusal)
    return title


async def _write(part: BodyPartReader, file: Path) -> None:
    size = 0
    with file.open("xb") as stream:
        while piece := await part.read_chunk(_CHUNK_BYTES):
            size += len(piece)
            if size > MAX_BYTES:
                raise UsageError(f"it is too large: a recording has at most {MAX_BYTES // 2**20} MiB")
            stream.write(piece)
