"""Generated C++ headers: names, constants and traits, as text."""

from pathlib import Path

import pytest

from trundle.ros import Messages
from trundle.ros.errors import MessageError
from trundle.ros.sdk import Headers, kit_sources
from trundle.ros.sdk.headers import included
from trundle.ros.sdk.message_header import message_header, service_header


@pytest.fixture(scope="module")
def messages() -> Messages:
    return Messages()


def test_a_header_has_gencpps_names_and_the_types_sum(messages: Messages) -> None:
    text = message_header(messages, "geometry_msgs/PoseStamped")

    assert "#include <geometry_msgs/Pose.h>\n#include <std_msgs/Header.h>" in text
    assert "struct PoseStamped_ {" in text
    assert "typedef boost::shared_ptr< ::geometry_msgs::PoseStamped const> PoseStampedConstPtr;" in text
    assert f'return "{messages.md5("geometry_msgs/PoseStamped")}";' in text
    assert "struct HasHeader< ::geometry_msgs::PoseStamped_<ContainerAllocator> > : TrueType" in text
    assert "IsFixedSize" not in text, "a header's frame_id has any length"
    assert "IsFixedSize" in message_header(messages, "geometry_msgs/Pose")


def test_only_a_first_header_is_the_messages_header() -> None:
    """roscpp writes a message's number into its first four bytes, which would be those of another field."""
    messages = Messages()
    messages.add("demo/Late", "string name\nstd_msgs/Header header\n")
    messages.add("demo/First", "std_msgs/Header header\nstring name\n")

    assert "HasHeader" not in message_header(messages, "demo/Late")
    assert "HasHeader" in message_header(messages, "demo/First")


def test_constants_keep_their_types_and_their_text() -> None:
    messages = Messages()
    messages.add(
        "demo/Limits",
        'uint8 MAX=0xFF\nint64 LOW=-9000000000\nbool ON=True\nfloat64 FAR=inf\nstring NAME= say "a\\b" ?? µ # too\n',
    )

    text = message_header(messages, "demo/Limits")

    assert "enum { MAX = 255u };" in text
    assert "enum { LOW = -9000000000LL };" in text
    assert "enum { ON = 1 };" in text
    assert "::FAR = __builtin_inf();" in text
    assert '::NAME = "say \\"a\\\\b\\" \\077\\077 \\302\\265 # too";' in text


def test_a_service_has_three_headers_and_its_own_sum(messages: Messages) -> None:
    service = messages.service("std_srvs/SetBool")

    text = service_header(service)
    request = message_header(messages, service.request, of_service=service)

    assert "#include <std_srvs/SetBoolRequest.h>" in text
    assert text.count(service.md5sum) == 1
    assert request.count(service.md5sum) == 1
    assert request.count(messages.md5(service.request)) == 1


def test_headers_are_written_for_a_package_and_for_what_it_includes(tmp_path: Path) -> None:
    package = tmp_path / "demo"
    for folder, name, text in (
        ("msg", "Track.msg", "geometry_msgs/Point32[] points\nSpeed speed\n"),
        ("msg", "Speed.msg", "float32 v\n"),
        ("action", "Go.action", "int32 to\n---\n---\n"),
        (
            "src",
            "go.cpp",
            '#include <ros/ros.h>\n#include "nav_msgs/Odometry.h"\n  #  include <std_srvs/EmptyResponse.h>\n',
        ),
    ):
        (package / folder).mkdir(parents=True, exist_ok=True)
        (package / folder / name).write_text(text)
    own, shared = tmp_path / "own", tmp_path / "shared"

    headers = Headers({"demo": package}, own, shared, provided=kit_sources())
    files = headers.write_package("demo")
    headers.write_included([package])

    assert {path.name for path in files} == {"Track.msg", "Speed.msg", "Go.action"}
    assert (own / "demo/GoActionFeedback.h").exists()
    names = {str(path.relative_to(shared)) for path in shared.rglob("*.h")}
    assert {"geometry_msgs/Point32.h", "actionlib_msgs/GoalID.h", "nav_msgs/Odometry.h", "std_srvs/Empty.h"} <= names
    assert not (shared / "ros").exists(), "the kit has them"
    before = (own / "demo/Track.h").stat().st_mtime_ns
    Headers({"demo": package}, own, shared, provided=kit_sources()).write_package("demo")
    assert (own / "demo/Track.h").stat().st_mtime_ns == before, "else all would be compiled again"


def test_an_invalid_definition_is_named(tmp_path: Path) -> None:
    (tmp_path / "demo/msg").mkdir(parents=True)
    (tmp_path / "demo/msg/Bad.msg").write_text("float64 x\nno_such/Type y\n")

    with pytest.raises(MessageError, match="no_such/Type"):
        Headers({"demo": tmp_path / "demo"}, tmp_path, tmp_path, provided=kit_sources()).write_package("demo")


def test_includes_are_read_from_sources_alone(tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src/a.hpp").write_text("#include <std_msgs/String.h>\n// #include <std_msgs/Bool.h>\n")
    (tmp_path / "src/b.txt").write_text("#include <std_msgs/Int8.h>\n")
    (tmp_path / "build").mkdir()
    (tmp_path / "build/c.cpp").write_text("#include <std_msgs/Int8.h>\n")

    assert included(tmp_path) == {("std_msgs", "String")}
