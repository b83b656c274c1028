"""Messages between the page's server and its owner: msgpack after its length as u32.

They go through the server's standard input and output. Poses, pictures and the clock's state are many, and only the
newest counts: they go through mailboxes.
"""

import os
import struct
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Self, TypeAlias
from urllib.parse import urlsplit

import msgspec

from .requests.request import Request
from .session import Session
from .shared_memory import MemoryAddress

if TYPE_CHECKING:
    from .world.manifest import Manifest

_LENGTH = struct.Struct("<I")


class GraphAddress(msgspec.Struct, frozen=True, kw_only=True):
    """Graph that the server joins as a node."""

    master_uri: str
    host: str | None = None
    """Address that the node binds; None: loopback."""
    name: str = "trundle_page"
    """Base name; the server appends a number, so that names of several pages differ."""
    number: int | None = None
    """None: the server's process id."""


class BagFile(msgspec.Struct, frozen=True, kw_only=True):
    """Bag that the server plays."""

    path: bytes
    """Path in the system's encoding, which need not be UTF-8."""
    speed: float
    """Recorded seconds per second of wall time."""
    paused: bool

    @property
    def file(self) -> Path:
        """Bag's path."""
        return Path(os.fsdecode(self.path))


class BagReferenceFile(msgspec.Struct, frozen=True, kw_only=True):
    """Bag that the server compares its topics with."""

    path: bytes
    """Path in the system's encoding."""
    title: str
    """Name for users."""

    @property
    def file(self) -> Path:
        """Bag's path."""
        return Path(os.fsdecode(self.path))

    @classmethod
    def of(cls, file: Path) -> Self:
        """Return a user's file."""
        return cls(path=os.fsencode(file.absolute()), title=os.fsencode(file).decode("utf-8", "replace"))


class Start(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """First message to the server."""

    host: str
    port: int | None
    """None: 8080 or the next free one."""
    reserved_ports: tuple[int, ...] = ()
    hosts: tuple[str, ...]
    origins: tuple[str, ...]
    token: str
    view_token: str
    session: Session
    graph: GraphAddress | None
    """None: no graph."""
    bag: BagFile | None = None
    """None: the page shows the owner's data or the graph."""
    reference: BagReferenceFile | None = None
    """Bag that the page's topics are compared with."""
    source: bytes
    """File or folder, in the system's encoding; clients may fetch files around it."""
    last_request: int = 0
    """Id of the last request of an earlier server."""
    uploads: str | None = None
    """Folder of an earlier server's uploaded models; None: there is none."""


class SetSession(msgspec.Struct, frozen=True, tag=True):
    """Replaces the session."""

    session: Session


class SetNotice(msgspec.Struct, frozen=True, tag=True):
    """Shows or removes a warning."""

    id: str
    text: str | None
    """None: the warning ends."""


class AddFile(msgspec.Struct, frozen=True, tag=True):
    """Adds a file that the next manifest names."""

    url: str
    content: bytes


class SetWorld(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """Replaces the manifest of the simulated world; files that it does not name are removed."""

    manifest: bytes
    """JSON for clients."""
    generation: int
    urls: frozenset[str]
    """URLs of all files that the manifest names."""
    camera_topics: tuple[str, ...]

    @classmethod
    def of(cls, manifest: "Manifest") -> Self:
        """Encode a manifest, with the fields that the server uses."""
        urls = {file.url for file in manifest.files} | set(manifest.resources)
        if manifest.collisions is not None:
            urls.add(manifest.collisions)
        return cls(
            manifest=encode_json(manifest),
            generation=manifest.generation,
            urls=frozenset(urls),
            camera_topics=tuple(camera.topic for camera in manifest.cameras),
        )


class OpenMailbox(msgspec.Struct, frozen=True, tag=True):
    """Replaces the mailbox of a stream."""

    stream: str
    """Topic: `trundle/poses`, or a camera's topic."""
    address: MemoryAddress


class Respond(msgspec.Struct, frozen=True, tag=True):
    """Answer to a request."""

    id: int
    error: str | None = None
    picture: bytes | None = None
    """PNG that answers `RenderView`."""
    answer: bytes = b"{}"
    """JSON."""


class Served(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """Links of the running server, each with a token."""

    url: str
    foxglove_url: str
    view_url: str
    """View-only link."""
    network_urls: tuple[str, ...] = ()
    """See `PageSession.network_urls`."""

    @property
    def port(self) -> int | None:
        """Port of the server."""
        return urlsplit(self.url).port


class Refused(msgspec.Struct, frozen=True, tag=True):
    """The requested address cannot be bound."""

    reason: str


class Watched(msgspec.Struct, frozen=True, tag=True):
    """Streams that any client watches."""

    streams: frozenset[str]


class Plotted(msgspec.Struct, frozen=True, tag=True):
    """Values of the simulation that any client plots."""

    series: tuple[str, ...]


class Uploaded(msgspec.Struct, frozen=True, tag=True):
    """Folder of uploaded models, each a folder."""

    folder: str


class TerminalInput(msgspec.Struct, frozen=True, tag=True):
    """Input for a node's terminal, and its size."""

    number: int
    text: str
    size: tuple[int, int] | None
    """Columns and rows; None: unchanged."""


class Driven(msgspec.Struct, frozen=True, tag=True):
    """Topics of velocity commands that any client drives with, and their types."""

    topics: dict[str, str]


ToServer: TypeAlias = SetSession | SetNotice | AddFile | SetWorld | OpenMailbox | Respond
FromServer: TypeAlias = Served | Refused | Request | Watched | Plotted | Uploaded | Driven | TerminalInput
encoder = msgspec.msgpack.Encoder()
start_decoder = msgspec.msgpack.Decoder(Start)
to_server_decoder = msgspec.msgpack.Decoder(ToServer)
from_server_decoder = msgspec.msgpack.Decoder(FromServer)


def frame(message: Start | ToServer | FromServer) -> bytes:
    """Encode a message with its length; bytes of file names that are not UTF-8 become question marks."""
    try:
        body = encoder.encode(message)
    except UnicodeEncodeError:
        body = encoder.encode(_readable(message))
    return _LENGTH.pack(len(body)) + body


def encode_json(value: object) -> bytes:
    """Encode as JSON; bytes of file names that are not UTF-8 become question marks."""
    try:
        return msgspec.json.encode(value)
    except UnicodeEncodeError:
        return msgspec.json.encode(_readable(value))


def _readable(value: object) -> object:
    """Return a value as builtins whose texts can be encoded as UTF-8."""
    return _with_texts(msgspec.to_builtins(value, builtin_types=(bytes,)))


def _with_texts(value: Any) -> Any:
    match value:
        case str():
            return value.encode("utf-8", "replace").decode()
        case dict():
            return {_with_texts(name): _with_texts(item) for name, item in value.items()}
        case list() | tuple():
            return [_with_texts(item) for item in value]
        case _:
            return value


def read_frame(stream: IO[bytes]) -> bytes:
    """Read one message.

    Raises:
        EOFError: the stream has ended.
    """
    (length,) = _LENGTH.unpack(_read_exactly(stream, _LENGTH.size))
    return _read_exactly(stream, length)


def _read_exactly(stream: IO[bytes], size: int) -> bytes:
    data = stream.read(size)
    if len(data) < size:
        raise EOFError
    return data
