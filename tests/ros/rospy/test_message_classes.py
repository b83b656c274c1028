"""Message classes: definitions as in rosbags, serialization, and errors."""

import io
from importlib import import_module
from typing import Any

import pytest

from trundle.ros import Messages
from trundle.ros.errors import DefinitionError, MessageError
from trundle.ros.rospy.finder import install
from trundle.ros.rospy.message_sources import _BUNDLES, find_definitions
from trundle.ros.rospy.message_spec import parse_message

install()
classes: Any = import_module("trundle.ros.rospy.message_classes")  # imports genpy, importable after install()


def test_shipped_definitions_have_the_md5_sums_of_rosbags() -> None:
    messages = Messages()
    names = [
        f"{path.stem}/{name}" for path in _BUNDLES.glob("*.txt") for name in find_definitions(path.stem).names("msg")
    ]
    assert len(names) > 150
    assert {name: classes.message_class(name)._md5sum for name in names} == {name: messages.md5(name) for name in names}


@pytest.mark.parametrize(
    "name", ["std_srvs/SetBool", "gazebo_msgs/SpawnModel", "nav_msgs/GetPlan", "tf2_msgs/FrameGraph"]
)
def test_shipped_services_have_the_md5_sums_of_rosbags(name: str) -> None:
    assert classes.service_class(name)._md5sum == Messages().service(name).md5sum


def test_long_arrays_are_not_copied_unless_they_may_change() -> None:
    from trundle.ros.rospy.message_methods import frame

    image = classes.message_class("sensor_msgs/Image")
    pixels = bytes(100_000)
    pieces = frame(image(data=pixels))
    assert len(pieces) > 1
    assert isinstance(pieces[1], memoryview)
    assert pieces[1].obj is pixels
    assert len(frame(image(data=bytearray(pixels)))) == 1


def test_text_that_is_not_utf_8_is_replaced() -> None:
    string = classes.message_class("std_msgs/String")
    assert string().deserialize(b"\x02\0\0\0a\xff").data == "a\ufffd"
    buff = io.BytesIO()
    string("ü").serialize(buff)
    assert string().deserialize(buff.getvalue()).data == "ü"


@pytest.mark.parametrize("text", ["what is this", "int32 a\nint32 a", "int32[-1] a", "float b", "int32 X=a"])
def test_invalid_definitions_are_refused(text: str) -> None:
    if text == "float b":  # an unknown message type
        with pytest.raises(MessageError, match="no message type 'p/float'"):
            classes.classes_from_text("p/T", text)
        return
    with pytest.raises(DefinitionError):
        parse_message("p/T", text)


def test_a_message_that_contains_itself_is_refused() -> None:
    with pytest.raises(MessageError, match="contains itself"):
        classes.classes_from_text("p/T", "p/T[] inner\n")
