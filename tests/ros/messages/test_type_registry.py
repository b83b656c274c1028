"""Invalid definitions: one sentence with file and line, in bounded memory, and nothing is registered."""

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

from trundle.ros import MessageError, Messages

FILES = {
    "Itself.msg": "int32 x\nItself a\n",
    "Left.msg": "Right b\n",
    "Right.msg": "# back\n\nLeft a\n",
    "Listed.msg": "Listed[] a\n",
    "Negative.msg": "int32 ok\nint32[-1] x\n",
    "Long.msg": "int32[10000000000] x\n",
    "Wide.msg": "bool ok\nfloat64[200000000] x\n",
    "Deep.msg": "Deeper[100000] x\n",
    "Deeper.msg": "float64[100000] x\n",
    "Objects.msg": "std_msgs/Empty[900000000] x\n",
    "Nameless.msg": "int32\n",
    "Twice.msg": "int32 a\nstring b\nfloat32 a\n",
    "Both.msg": "int32 A=1\nint32 A\n",
    "Unknown.msg": "int32 a\n\nnope/Thing t  # of a package that is not there\n",
    "Range.msg": "int32 ok\nuint8 A=300\n",
    "Value.msg": "int32 A=x\n",
    "Array.msg": "int32[3] A=5\n",
    "Digit.msg": "int32 1x\n",
    "Open.msg": "int32[3 x\n",
    "Words.msg": "int32[a] x\n",
    "Lines.msg": "int32[3][4] x\n",
    "Underscore.msg": "int32 __class__\n",
    "Binary.msg": "\0\1\2",
    "Many.msg": "".join(f"int32 f{i}\n" for i in range(6000)),
    "Endless.msg": "string S=" + "x" * 2_000_000,
    "Good.msg": "int32 class\nint32 self\nint32 None\nfloat64[3] x # m\r\nHeader header\nduration[] d\nGood2[2] g\n",
    "Good2.msg": "string S=a # b\nfloat32 INF=1e999\n",
}
SENTENCES = {
    "Itself": "Itself.msg:2: p/Itself contains itself: p/Itself > p/Itself",
    "Left": "Left.msg:1: p/Left contains itself: p/Left > p/Right > p/Left",
    "Right": "Right.msg:3: p/Right contains itself: p/Right > p/Left > p/Right",
    "Listed": "Listed.msg:1: p/Listed contains itself: p/Listed > p/Listed",
    "Negative": "Negative.msg:2: an array has from 0 to 1000000000 elements, not -1",
    "Long": "Long.msg:1: an array has from 0 to 1000000000 elements, not 10000000000",
    "Wide": "Wide.msg:2: a p/Wide takes 1600000129 bytes when it is empty, more than the 1000000000 of a connection",
    "Deep": "Deep.msg:1: a p/Deep takes 80012800128 bytes when it is empty, more than",
    "Objects": "Objects.msg:1: a p/Objects takes 57600000128 bytes",
    "Nameless": "Nameless.msg:1: not a field: 'int32'; fields are written TYPE NAME, like float64 x or int32[3] x",
    "Twice": "Twice.msg:3: duplicate name 'a'; line 1 defines it first",
    "Both": "Both.msg:2: duplicate name 'A'; line 1 defines it first",
    "Unknown": "Unknown.msg:3: no message type 'nope/Thing'; no messages of a package 'nope' are known",
    "Range": "Range.msg:2: 300 is not in the range of uint8, 0 to 255",
    "Value": "Value.msg:1: 'x' is not a constant of type int32",
    "Array": "Array.msg:1: not a field: 'int32[3] A=5'",
    "Digit": "Digit.msg:1: not a field: 'int32 1x'",
    "Open": "Open.msg:1: not a field: 'int32[3 x'",
    "Words": "Words.msg:1: not a field: 'int32[a] x'",
    "Lines": "Lines.msg:1: not a field: 'int32[3][4] x'",
    "Underscore": "Underscore.msg:1: not a field: 'int32 __class__'",
    "Binary": r"Binary.msg:1: not a field: '\x00\x01\x02'",
    "Many": "Many.msg:5001: more than 5000 fields and constants",
    "Endless": "Endless.msg:1: cannot be read: larger than 1000000 bytes, the largest file read",
    "Folder": "Folder.msg:1: cannot be read: it is a folder, not a file",
    "Pipe": "Pipe.msg:1: cannot be read: it is a pipe, not a regular file",
}


@pytest.fixture
def messages(tmp_path: Path) -> Messages:
    """Store with a package of these files."""
    for folder in ("msg/Folder.msg", "srv", "action"):
        (tmp_path / folder).mkdir(parents=True)
    for name, text in FILES.items():
        (tmp_path / "msg" / name).write_text(text, newline="")
    os.mkfifo(tmp_path / "msg/Pipe.msg")
    (tmp_path / "srv/Bad.srv").write_text("int32 a\n---\n\nint32 b\nint32[-1] c\n")
    (tmp_path / "srv/Self.srv").write_text("# asked\nSelfRequest a\n---\nint32 b\n")
    (tmp_path / "srv/Folder.srv").mkdir()
    (tmp_path / "action/Go.action").write_text("int32 a\n---\nint32 b\n---\nint32 c\nint32[x] d\n")
    messages = Messages()
    messages.add_package("p", tmp_path)
    return messages


@pytest.mark.parametrize(("name", "sentence"), SENTENCES.items(), ids=SENTENCES)
def test_an_invalid_definition_is_reported_with_file_and_line(
    messages: Messages, tmp_path: Path, name: str, sentence: str
) -> None:
    for call in (messages.md5, messages.fields, messages.codec, messages.new):
        with pytest.raises(MessageError) as refused:
            call(f"p/{name}")
        assert str(refused.value).startswith(f"{tmp_path}/msg/{sentence}")
        assert "\n" not in str(refused.value)
        assert len(str(refused.value)) < 1000
    assert not messages.has(f"p/{name}")


def test_valid_types_of_the_package_stay_usable(messages: Messages) -> None:
    assert list(messages.fields("p/Good")) == ["class", "self", "None", "x", "header", "d", "g"]
    message = messages.new("p/Good", {"class": 1, "None": 2, "x": [1, 2, 3]})
    assert messages.deserialize(messages.serialize(message), "p/Good").class_ == 1


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("Bad", "srv/Bad.srv:5: an array has from 0 to 1000000000 elements, not -1"),
        ("Self", "srv/Self.srv:2: p/SelfRequest contains itself: p/SelfRequest > p/SelfRequest"),
        ("Folder", "srv/Folder.srv:1: cannot be read: it is a folder, not a file"),
    ],
)
def test_an_invalid_service_is_reported_with_file_and_line(
    messages: Messages, tmp_path: Path, name: str, sentence: str
) -> None:
    with pytest.raises(MessageError) as refused:
        messages.service(f"p/{name}")
    assert str(refused.value) == f"{tmp_path}/{sentence}"


def test_an_invalid_action_is_reported_with_file_and_line(messages: Messages, tmp_path: Path) -> None:
    with pytest.raises(MessageError) as refused:
        messages.md5("p/GoAction")
    assert str(refused.value).startswith(f"{tmp_path}/action/Go.action:6: not a field: 'int32[x] d'")


def test_too_deeply_nested_messages_are_refused(messages: Messages, tmp_path: Path) -> None:
    for i in range(2000):
        (tmp_path / f"msg/D{i}.msg").write_text(f"D{i + 1} d\n")
    with pytest.raises(MessageError, match=r"/msg/D100\.msg:1: more than 100 nested messages"):
        messages.md5("p/D0")
    assert not messages.has("p/D1")


def test_invalid_definitions_of_peers_are_refused() -> None:
    messages = Messages()
    for text in ("Own a", "uint8[-1] a", "a/B[900000000] b\n" + "=" * 80 + "\nMSG: a/B\nfloat64 x", "x" * 3_000_000):
        with pytest.raises(MessageError, match="the definition of a/Own cannot be read: line 1: "):
            messages.add_definition("a/Own", text)
    for name in ("a/B:\n  pass\nprint('run')\nclass C", "a/B c", "a/", "/", "a/b/c"):
        with pytest.raises(MessageError, match="is not a message type; types are written package/Name"):
            messages.add(name, "int32 x")


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux enforces RLIMIT_AS")
def test_memory_is_bounded(messages: Messages, tmp_path: Path) -> None:
    """The limit of 2 GB of addresses is mostly used by the libraries."""
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>")
    for name in ("Deep", "Objects", "Endless"):
        done = subprocess.run(
            [sys.executable, "-m", "trundle", "msg", "show", f"p/{name}"],
            env={**os.environ, "ROS_PACKAGE_PATH": str(tmp_path)},
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (2 * 10**9, 2 * 10**9)),
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 1
        assert done.stderr.startswith(f"trundle msg: error: {tmp_path}/msg/{SENTENCES[name]}")
        assert done.stdout == ""
