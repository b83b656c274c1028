"""Pictures of cameras in runs without ROS, as sensor_msgs/Image."""

import struct
from collections.abc import Sequence

from ..clients.frames import Buffer
from .channels import StreamChannel
from .streams import IMAGE_HEADER

TYPE = "sensor_msgs/Image"
_U32 = struct.Struct("<I")
_STAMP = struct.Struct("<III")
"""Sequence number, seconds, nanoseconds."""
_SIZE = struct.Struct("<II")
_STEP = struct.Struct("<BII")
"""Big endian flag, bytes per row, bytes of all rows."""
_ENCODINGS = {1: b"mono8", 3: b"rgb8", 4: b"rgba8"}
_NS = 1_000_000_000


class CameraChannel(StreamChannel):
    """Topic of a camera whose pixels come from a mailbox."""

    def __init__(self, topic: str, *, schema: str) -> None:
        """Create it; `schema` is the definition of sensor_msgs/Image."""
        super().__init__(topic, encoding="ros1", period_s=0.0, schema_name=TYPE, schema=schema)
        self._frame_id = topic.strip("/").rpartition("/")[0].replace("/", "_").encode()
        self._sequence = 0

    def encode_change(self, message: bytes) -> Sequence[Buffer]:
        self._sequence = (self._sequence + 1) % 2**32
        return super().encode_change(message) and self.encode_whole()

    def encode_whole(self) -> Sequence[Buffer]:
        if not self._newest:
            return ()
        time_ns, height, width, channels = IMAGE_HEADER.unpack_from(self._newest)
        pixels = memoryview(self._newest)[IMAGE_HEADER.size :]
        header = b"".join((
            _STAMP.pack(self._sequence, *divmod(time_ns, _NS)),
            _text(self._frame_id),
            _SIZE.pack(height, width),
            _text(_ENCODINGS[channels]),
            _STEP.pack(0, width * channels, len(pixels)),
        ))  # fmt: skip
        return (header, pixels)


def _text(value: bytes) -> bytes:
    return _U32.pack(len(value)) + value
