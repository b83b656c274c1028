"""What a message replaces: transforms by child frame, others by publisher."""

import struct

from trundle.page.clients.message_keys import MessageKeys

TF = "tf2_msgs/TFMessage"


def _transforms(*children: str) -> bytes:
    """Return a serialized tf2_msgs/TFMessage."""
    data = struct.pack("<I", len(children))
    for child in children:
        parent, name = b"odom", child.encode()
        data += struct.pack(f"<IIII{len(parent)}s", 1, 2, 3, len(parent), parent)
        data += struct.pack(f"<I{len(name)}s7d", len(name), name, *range(7))
    return data


def test_transforms_are_told_apart_by_their_child_frames() -> None:
    assert MessageKeys(TF, "/gazebo", _transforms("base", "wheel"))() == {b"base", b"wheel"}
    assert MessageKeys(TF, "/gazebo", memoryview(_transforms("räder")))() == {"räder".encode()}
    assert MessageKeys(TF, "/gazebo", _transforms())() == frozenset()


def test_other_messages_are_told_apart_by_their_publisher() -> None:
    assert MessageKeys("sensor_msgs/JointState", "/arm", b"")() == {"/arm"}


def test_damaged_transforms_are_told_apart_by_their_publisher() -> None:
    whole = _transforms("base", "wheel")

    for end in range(len(whole)):
        assert MessageKeys(TF, "/gazebo", whole[:end])() == {"/gazebo"}


def test_a_huge_count_of_transforms_is_refused_at_once() -> None:
    assert MessageKeys(TF, "/gazebo", struct.pack("<I", 2**32 - 1) + bytes(1000))() == {"/gazebo"}
