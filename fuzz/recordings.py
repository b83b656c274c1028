"""Recordings: bags of every format, and state logs."""

import struct
import tempfile
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

import trundle
from trundle.app.convert import convert
from trundle.base.diagnostics import Diagnostics
from trundle.live.state_logs import start_state_log
from trundle.ros import BagConnection, BagMessage, BagSummary, Messages, create_bag, open_bag, recover_messages

from .seeds import seed
from .target import Execute, Open, Target, call_all, reads_file, write_file


def _bags(name: str) -> Open:
    """Return an `open` that summarizes a bag, reads its messages by their definitions, and recovers it."""

    def list_and_read(file: Path) -> None:
        with open_bag(file) as bag:
            summary = BagSummary(bag, file.name, with_rates=True)
            summary.text()
            summary.yaml()
            bag.stamps_ns()
            for message in bag.messages():
                _decode(message)

    def recover(file: Path) -> None:
        for message in recover_messages(file):
            _decode(message)

    @contextmanager
    def opened(folder: Path) -> Generator[Execute]:
        file = folder / name

        def execute(data: bytes) -> None:
            write_file(file, data)
            call_all(lambda: list_and_read(file), lambda: recover(file))

        yield execute

    return opened


def _decode(message: BagMessage) -> None:
    connection = message.connection

    def read() -> None:
        types = Messages(bare=True)
        types.add_definition(connection.type, connection.definition)
        types.deserialize(message.data, connection.type)

    call_all(read)


def _recorded() -> list[BagMessage]:
    types = Messages()
    messages: list[BagMessage] = []
    for number, (topic, kind) in enumerate(
        [("/a", "std_msgs/String"), ("/b", "geometry_msgs/Twist"), ("/a", "std_msgs/String")]
    ):
        connection = BagConnection(topic=topic, type=kind, md5sum=types.md5(kind), definition=types.definition(kind))
        data = bytes(types.serialize(types.new(kind)))
        messages.append(BagMessage(connection, 1_700_000_000_000_000_000 + number * 10**8, data))
    return messages


def _written(name: str, compression: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / name
        with create_bag(file, compression=compression) as bag:
            for message in _recorded():
                bag.write(message)
        return file.read_bytes()


def _rosrecord() -> bytes:
    """Return a bag of format 1.2 without an index, as written by rosrecord."""

    def record(fields: dict[str, bytes], data: bytes = b"") -> bytes:
        header = b"".join(struct.pack("<I", len(f)) + f for f in (k.encode() + b"=" + v for k, v in fields.items()))
        return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data

    body = b"#ROSRECORD V1.2\n"
    for message in _recorded():
        connection = message.connection
        kind = {"topic": connection.topic, "md5": connection.md5sum, "type": connection.type}
        fields = {key: value.encode() for key, value in kind.items()}
        body += record({"op": b"\x01", **fields, "def": connection.definition.encode()})
        sec, nsec = divmod(message.stamp_ns, 10**9)
        body += record(
            {"op": b"\x02", **fields, "sec": struct.pack("<I", sec), "nsec": struct.pack("<I", nsec)}, message.data
        )
    return body


def _state_log() -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        model, log = Path(folder) / "model.sdf", Path(folder) / "run.log"
        model.write_bytes(seed("model.sdf"))
        simulation = trundle.load(model)
        recorder = start_state_log(log, simulation, simulation.world, Diagnostics())
        simulation.add_hook(recorder, period_ns=recorder.period_ns)
        simulation.run(0.1)
        recorder.close()
        return log.read_bytes()


def _convert_log(file: Path) -> None:
    convert(str(file), "glb", {}, Diagnostics(), start=file.parent)


TARGETS = {
    "bag": Target(
        open=_bags("r.bag"),
        seeds=lambda: [_written("r.bag", kind) for kind in ("none", "bz2", "lz4")],
        words=(b"#ROSBAG V2.0\n", b"op=\x02", b"op=\x03", b"op=\x04", b"op=\x05", b"op=\x06", b"op=\x07", b"conn=",
        b"index_pos="),
    ),
    "rosrecord": Target(
        open=_bags("r.bag"), seeds=lambda: [_rosrecord()], words=(b"#ROSRECORD V1.2\n", b"op=\x01", b"op=\x04",
        b"def="),
    ),
    "mcap": Target(
        open=_bags("r.mcap"),
        seeds=lambda: [_written("r.mcap", kind) for kind in ("none", "lz4", "zstd")],
        words=(b"\x89MCAP0\r\n", b"ros1", b"ros1msg", b"lz4", b"zstd"),
    ),
    "state-log": Target(open=reads_file("run.log", _convert_log), seeds=lambda: [_state_log()]),
}  # fmt: skip
