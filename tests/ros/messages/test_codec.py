"""Messages as bytes: valid values are written, invalid ones named, and any input is read safely."""

import gc
import mmap
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from trundle.ros import MessageError, Messages

LONG = 40_000


@pytest.fixture(scope="module")
def messages() -> Messages:
    return Messages()


def _message(messages: Messages, kind: str, field: str, value: Any) -> Any:
    message = messages.new(kind)
    setattr(message, field, value)
    return message


def _length(size: int) -> bytes:
    return size.to_bytes(4, "little")


# long arrays


@pytest.mark.parametrize(
    ("kind", "field", "dtype", "pieces"),
    [
        ("sensor_msgs/Image", "data", "u1", 2),
        ("sensor_msgs/PointCloud2", "data", "u1", 3),  # is_dense follows
        ("nav_msgs/OccupancyGrid", "data", "i1", 2),
        ("nav_msgs/OccupancyGrid", "data", "u1", 2),
        ("sensor_msgs/LaserScan", "intensities", "<f4", 2),
        ("sensor_msgs/LaserScan", "ranges", "<f4", 3),  # intensities follow
        ("std_msgs/Float64MultiArray", "data", "<f8", 2),
    ],
)
def test_a_frame_holds_a_long_array_without_a_copy(
    messages: Messages, kind: str, field: str, dtype: str, pieces: int
) -> None:
    array = (np.arange(LONG) % 100).astype(dtype)
    message, codec = _message(messages, kind, field, array), messages.codec(kind)

    framed = codec.frame(message)

    written = codec.write(message)
    assert len(framed) == pieces
    assert b"".join(framed) == _length(len(written)) + written
    assert [isinstance(piece, bytes) for piece in framed] == [i != 1 for i in range(pieces)]
    assert np.shares_memory(np.frombuffer(framed[1], "u1"), array)
    assert memoryview(framed[1]).readonly
    assert getattr(message, field) is array


def test_one_of_two_long_arrays_is_not_copied(messages: Messages) -> None:
    scan = _message(messages, "sensor_msgs/LaserScan", "ranges", np.ones(LONG, "f4"))
    scan.intensities = np.ones(LONG, "f4")

    framed = messages.codec("sensor_msgs/LaserScan").frame(scan)

    assert len(framed) == 3  # limits the buffers per system call
    assert b"".join(framed)[4:] == messages.serialize(scan)


def test_a_long_array_of_a_nested_message_is_not_copied(messages: Messages) -> None:
    image = messages.new("stereo_msgs/DisparityImage")
    image.image.data = np.ones(LONG, "u1")

    framed = messages.codec("stereo_msgs/DisparityImage").frame(image)

    assert len(framed) == 3
    assert b"".join(framed)[4:] == messages.serialize(image)


@pytest.mark.parametrize(
    "array",
    [
        np.arange(LONG, dtype=">f4"),
        np.arange(2 * LONG, dtype="<f4")[::2],
        np.arange(LONG, dtype="<f8"),
        np.arange(LONG, dtype="<i4"),
        [float(i) for i in range(LONG)],
    ],
    ids=["another byte order", "gaps", "another size", "another type", "a list"],
)
def test_an_array_of_another_layout_or_type_is_converted(messages: Messages, array: Any) -> None:
    kind = "sensor_msgs/LaserScan"

    written = messages.serialize(_message(messages, kind, "intensities", array))

    assert messages.deserialize(written, kind).intensities.tolist() == list(array)


def test_an_image_array_with_rows_is_written_like_a_flat_one(messages: Messages) -> None:
    flat, rows = (
        messages.serialize(_message(messages, "sensor_msgs/Image", "data", pixels))
        for pixels in (np.arange(60, dtype="u1"), np.arange(60, dtype="u1").reshape(4, 5, 3))
    )
    assert flat == rows


@pytest.mark.parametrize(("size", "pieces"), [(0, 1), (300, 1), (LONG, 3)])
def test_a_frame_begins_with_its_length(messages: Messages, size: int, pieces: int) -> None:
    message = _message(messages, "sensor_msgs/PointCloud2", "data", np.ones(size, "u1"))

    framed = messages.codec("sensor_msgs/PointCloud2").frame(message)

    assert len(framed) == pieces
    assert isinstance(framed[0], bytes)
    written = messages.serialize(message)
    assert b"".join(framed) == _length(len(written)) + written


# field values


@pytest.mark.parametrize(
    ("kind", "value", "data"),
    [
        ("std_msgs/UInt8", 255, b"\xff"),
        ("std_msgs/UInt8", True, b"\1"),
        ("std_msgs/Int8", np.int64(-3), b"\xfd"),
        ("std_msgs/UInt64", 2**64 - 1, b"\xff" * 8),
        ("std_msgs/UInt64", np.uint64(2**64 - 1), b"\xff" * 8),
        ("std_msgs/Int64", -(2**63), b"\0" * 7 + b"\x80"),
        ("std_msgs/Bool", np.bool_(True), b"\1"),
        ("std_msgs/Bool", 3, b"\1"),
        ("std_msgs/Float32", 1, b"\0\0\x80\x3f"),
        ("std_msgs/Float32", np.float32(1), b"\0\0\x80\x3f"),
        ("std_msgs/Float64", Fraction(1, 2), b"\0\0\0\0\0\0\xe0\x3f"),
        ("std_msgs/Float64", np.float64(1), b"\0\0\0\0\0\0\xf0\x3f"),
        ("std_msgs/Float64", np.int32(1), b"\0\0\0\0\0\0\xf0\x3f"),
        ("std_msgs/String", "é", b"\2\0\0\0\xc3\xa9"),
        ("std_msgs/String", np.str_("a"), b"\1\0\0\0a"),
    ],
)
def test_a_field_accepts_convertible_values(messages: Messages, kind: str, value: Any, data: bytes) -> None:
    assert messages.serialize(_message(messages, kind, "data", value)) == data


@pytest.mark.parametrize(
    ("kind", "value", "reason"),
    [
        ("std_msgs/UInt8", 256, "field 'data' is a uint8 \\(0 to 255\\), got 256"),
        ("std_msgs/UInt8", -1, "got -1"),
        ("std_msgs/UInt8", 10**30, "got 10000"),
        ("std_msgs/Int8", 128, "got 128"),
        ("std_msgs/Int64", 2**63, "got 9223372036854775808"),
        ("std_msgs/UInt64", -1, "got -1"),
        ("std_msgs/UInt64", 2**64, "got 18446744073709551616"),
        ("std_msgs/UInt32", 1.0, "field 'data' is a uint32, got 1.0"),
        ("std_msgs/Float64", "1", "field 'data' is a float64, got '1'"),
        ("std_msgs/Float64", None, "got None"),
        ("std_msgs/Float32", 1e39, "cannot serialize a std_msgs/Float32: 'data' is more than a float32 holds"),
        ("std_msgs/Float64", 10**400, "cannot serialize a std_msgs/Float64: int too large"),
        ("std_msgs/String", b"a", "field 'data' is a string"),
        ("std_msgs/String", "\ud800", "cannot serialize a std_msgs/String: .*surrogates"),
        ("std_msgs/Float64MultiArray", ["a"], "field 'data\\[0\\]' is a float64, got 'a'"),
        ("std_msgs/Float64MultiArray", np.float64(3), "field 'data' is a list of float64"),
        ("std_msgs/Float64MultiArray", None, "field 'data' is a list of float64"),
    ],
)
def test_an_invalid_value_is_reported_with_its_field(messages: Messages, kind: str, value: Any, reason: str) -> None:
    message = _message(messages, kind, "data", value)
    with pytest.raises(MessageError, match=reason):
        messages.serialize(message)


def test_an_array_of_wrong_length_is_reported(messages: Messages) -> None:
    message = _message(messages, "sensor_msgs/CameraInfo", "K", np.zeros(8))
    with pytest.raises(MessageError, match="field 'K' has exactly 9 elements, got 8"):
        messages.serialize(message)


def test_a_matrix_is_accepted_as_an_array(messages: Messages) -> None:
    message = _message(messages, "sensor_msgs/CameraInfo", "K", np.eye(3))
    assert messages.deserialize(messages.serialize(message), "sensor_msgs/CameraInfo").K.tolist() == [
        1,
        0,
        0,
        0,
    ] * 2 + [1]


@pytest.mark.parametrize("names", [("a", "b"), {"a": 1, "b": 2}.keys(), np.array(["a", "b"])])
def test_a_list_field_accepts_any_sized_iterable(messages: Messages, names: Any) -> None:
    message = _message(messages, "sensor_msgs/JointState", "name", names)
    assert messages.deserialize(messages.serialize(message), "sensor_msgs/JointState").name == ["a", "b"]


class _ShrinkingTransform:
    """Transform that removes others from its list while it is written."""

    def __init__(self, transforms: list[Any], keeps: int, real: Any) -> None:
        self.transforms, self.keeps, self.real = transforms, keeps, real

    def __getattr__(self, name: str) -> Any:
        del self.transforms[self.keeps :]
        gc.collect()
        return getattr(self.real, name)


@pytest.mark.parametrize("keeps", [0, 1])
def test_a_message_that_changes_during_serialization_is_written_safely(messages: Messages, keeps: int) -> None:
    transforms: list[Any] = []
    transforms += [
        _ShrinkingTransform(transforms, keeps, messages.new("geometry_msgs/TransformStamped")),
        object(),
        object(),
    ]
    message = _message(messages, "tf2_msgs/TFMessage", "transforms", transforms)
    if keeps:
        with pytest.raises(MessageError, match="a geometry_msgs/TransformStamped is needed"):
            messages.serialize(message)
    else:
        assert messages.serialize(message) == _length(0)  # the list is empty by then


# hostile bytes


def test_arrays_are_views_of_the_buffer_they_were_read_from(messages: Messages) -> None:
    data = messages.serialize(_message(messages, "sensor_msgs/Image", "data", np.arange(60, dtype="u1")))
    writable = bytearray(data)

    pixels, writable_pixels = (
        messages.deserialize(memoryview(buffer), "sensor_msgs/Image").data for buffer in (data, writable)
    )

    assert not pixels.flags.writeable
    assert np.shares_memory(pixels, np.frombuffer(data, "u1"))
    assert writable_pixels.flags.writeable
    assert np.shares_memory(writable_pixels, np.frombuffer(writable, "u1"))


def test_a_mapped_file_is_read(messages: Messages, tmp_path: Path) -> None:
    message = _message(messages, "sensor_msgs/JointState", "position", np.arange(7.0))
    (tmp_path / "message").write_bytes(messages.serialize(message))
    with (tmp_path / "message").open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        read = messages.deserialize(memoryview(data), "sensor_msgs/JointState")
        assert read.position.tolist() == list(range(7))
        del read


@pytest.mark.parametrize(
    ("kind", "data", "reason"),
    [
        ("std_msgs/UInt32", bytes(5), "5 bytes are not a std_msgs/UInt32: it ends after 4"),
        ("std_msgs/UInt32", bytes(3), "3 bytes are not a std_msgs/UInt32: they end within 'data'"),
        ("std_msgs/Empty", b"0", "it ends after 0"),
        ("std_msgs/String", b"\2\0\0\0\xc3", "they end within 'data'"),
        ("std_msgs/String", b"\1\0\0\0\xc3", "utf-8"),
        ("std_msgs/String", b"\3\0\0\0\xed\xa0\x80", "utf-8"),
        ("sensor_msgs/Image", b"\xff" * 24, "they end within 'frame_id'"),
        ("tf2_msgs/TFMessage", b"\xff" * 200, "they end within 'transforms'"),
        ("std_msgs/Float64MultiArray", bytes(8) + b"\xff" * 4, "they end within 'data'"),
        ("std_msgs/UInt8", memoryview(bytes(8))[::2], "not C-contiguous"),
    ],
)
def test_invalid_bytes_are_refused(messages: Messages, kind: str, data: bytes, reason: str) -> None:
    with pytest.raises(MessageError, match=reason):
        messages.deserialize(data, kind)


def test_a_long_list_of_empty_messages_is_refused() -> None:
    """Such a list consists of its length alone, so that the size of the data does not limit the memory."""
    messages = Messages()
    messages.add("x_msgs/Nothings", "std_msgs/Empty[] all")
    messages.add("x_msgs/Many", "std_msgs/Empty[1000] all")
    messages.add("x_msgs/TooMany", "x_msgs/Many[1000] all")
    data = messages.serialize(messages.new("x_msgs/Nothings", {"all": [{}] * 3}))

    assert data == _length(3)
    assert len(messages.deserialize(data, "x_msgs/Nothings").all) == 3
    with pytest.raises(MessageError, match="too many messages without bytes"):
        messages.deserialize(_length(2**32 - 1), "x_msgs/Nothings")
    assert len(messages.deserialize(b"", "x_msgs/Many").all) == 1000
    with pytest.raises(MessageError, match="x_msgs/TooMany has no layout: 'all' holds too many"):
        messages.codec("x_msgs/TooMany")


def test_empty_messages_are_counted_over_the_whole_message() -> None:
    messages = Messages()
    messages.add("x_msgs/Byte", "uint8 value\nstd_msgs/Empty[1000] nothings")
    messages.add("x_msgs/Bytes", "x_msgs/Byte[] all")
    assert len(messages.deserialize(_length(1) + b"\7", "x_msgs/Bytes").all[0].nothings) == 1000
    with pytest.raises(MessageError, match="too many messages without bytes"):
        messages.deserialize(_length(100) + bytes(100), "x_msgs/Bytes")


def test_a_type_that_contains_itself_is_refused() -> None:
    messages = Messages()
    with pytest.raises(MessageError, match="x_msgs/Self contains itself"):
        messages.add("x_msgs/Self", "x_msgs/Self[] inner")
    with pytest.raises(MessageError, match="x_msgs/Self contains itself"):
        messages.codec("x_msgs/Self")


def test_a_field_named_like_a_python_keyword_is_written() -> None:
    messages = Messages()
    messages.add("x_msgs/Word", "uint8 from\nuint8 None")
    data = messages.serialize(messages.new("x_msgs/Word", {"from": 1, "None": 2}))
    assert data == b"\1\2"
    assert messages.deserialize(data, "x_msgs/Word").from_ == 1


def test_refused_messages_leak_no_memory(messages: Messages) -> None:
    scan = messages.new("nav_msgs/Path", {"poses": [{"header": {"frame_id": "a long name of a frame"}}] * 4})
    data = messages.serialize(scan)
    invalid = [
        _message(messages, "sensor_msgs/JointState", "name", ["x" * 50, 3]),
        messages.new("sensor_msgs/JointState"),
    ]
    invalid[1].position = ["x"]

    def refuse_all() -> None:
        for size in range(len(data)):
            with pytest.raises(MessageError):
                messages.deserialize(data[:size], "nav_msgs/Path")
        for message in invalid:
            with pytest.raises(MessageError):
                messages.serialize(message)

    def blocks() -> int:
        gc.collect()
        return sys.getallocatedblocks()

    refuse_all()
    before = blocks()
    for _ in range(5):
        refuse_all()
    assert blocks() - before < len(data)
