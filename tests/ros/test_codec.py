"""Messages as bytes: long arrays stay where they are, and what goes out is the same."""

from typing import Any

import numpy as np
import pytest

from trundle.ros import MessageError, Messages

LONG = 40_000


@pytest.fixture(scope="module")
def messages() -> Messages:
    return Messages()


def _message(messages: Messages, kind: str, field: str, array: Any) -> Any:
    message = messages.new(kind)
    setattr(message, field, array)
    return message


@pytest.mark.parametrize(
    ("kind", "field", "dtype", "pieces"),
    [
        ("sensor_msgs/Image", "data", "u1", 2),
        ("sensor_msgs/PointCloud2", "data", "u1", 3),  # is_dense comes behind
        ("nav_msgs/OccupancyGrid", "data", "i1", 2),
        ("sensor_msgs/LaserScan", "intensities", "<f4", 2),
        ("sensor_msgs/LaserScan", "ranges", "<f4", 1),  # intensities, of any length, come behind
        ("std_msgs/Float64MultiArray", "data", "<f8", 2),
    ],
)
def test_pieces_are_the_bytes_and_the_array_itself(
    messages: Messages, kind: str, field: str, dtype: str, pieces: int
) -> None:
    array = (np.arange(LONG) % 100).astype(dtype)
    message, codec = _message(messages, kind, field, array), messages.codec(kind)

    written = codec.write_pieces(message, room=4)

    assert len(written) == pieces
    assert b"".join(written)[4:] == bytes(codec.write(message))
    assert any(np.shares_memory(np.frombuffer(piece, "u1"), array) for piece in written) == (pieces > 1)
    assert getattr(message, field) is array


@pytest.mark.parametrize(
    "array",
    [
        np.arange(LONG, dtype=">f4"),
        np.arange(2 * LONG, dtype="<f4")[::2],
        np.arange(LONG, dtype="<f8"),
        [float(i) for i in range(LONG)],
    ],
    ids=["another byte order", "gaps", "another type", "a list"],
)
def test_an_array_that_lies_otherwise_is_written_whole(messages: Messages, array: Any) -> None:
    kind = "sensor_msgs/LaserScan"

    written = messages.codec(kind).write_pieces(_message(messages, kind, "intensities", array))

    assert len(written) == 1
    assert messages.deserialize(written[0], kind).intensities.tolist() == list(array)


def test_a_short_array_is_copied(messages: Messages) -> None:
    message = _message(messages, "sensor_msgs/Image", "data", np.zeros(300, "u1"))

    assert len(messages.codec("sensor_msgs/Image").write_pieces(message)) == 1


@pytest.mark.parametrize(("size", "pieces"), [(0, 1), (300, 1), (LONG, 3)])
def test_a_frame_begins_with_its_length(messages: Messages, size: int, pieces: int) -> None:
    message = _message(messages, "sensor_msgs/PointCloud2", "data", np.ones(size, "u1"))

    framed = messages.codec("sensor_msgs/PointCloud2").frame(message)

    assert len(framed) == pieces
    assert isinstance(framed[0], bytes)
    written = bytes(messages.serialize(message))
    assert b"".join(framed) == len(written).to_bytes(4, "little") + written


def test_bytes_behind_a_message_are_refused(messages: Messages) -> None:
    with pytest.raises(MessageError, match="5 bytes are no std_msgs/UInt32: it ends after 4"):
        messages.deserialize(bytes(5), "std_msgs/UInt32")
