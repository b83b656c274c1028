"""Headers of .proto files, as text."""

from pathlib import Path

import pytest

from trundle.ros.sdk.proto_file import ProtoError
from trundle.ros.sdk.proto_header import main, proto_header


def header(folder: Path, text: str, **imported: str) -> str:
    """Return the header of a file, beside those that it imports."""
    for name, content in imported.items():
        (folder / f"{name}.proto").write_text(content)
    (folder / "mine.proto").write_text(text)
    return proto_header(folder / "mine.proto", [folder])


def test_fields_have_the_types_of_cpp(tmp_path: Path) -> None:
    text = header(
        tmp_path,
        """
        syntax = "proto2"; package a.b;   // a comment
        import "vector3d.proto";
        message Sample { required double Value = 1; /* two
          lines */ repeated sint64 many = 2 [packed=true]; optional string class = 3 [default = "x; y"];
          optional gazebo.msgs.Vector3d at = 4; repeated Inner inner = 5;
          message Inner { optional bytes data = 1; optional bool on = 2 [default = true]; } reserved 7, 8 to 9; }
        """,
    )

    assert "namespace a {\nnamespace b {\n" in text
    fields = [line.strip() for line in text.splitlines() if "TRUNDLE_" in line]
    assert fields == [
        "TRUNDLE_FIELD(std::string, data)",
        "TRUNDLE_FIELD_FROM(bool, on, true)",
        "TRUNDLE_WHOLE(Inner)",
        "TRUNDLE_FIELD(double, value)",
        "TRUNDLE_FIELDS(int64_t, many)",
        'TRUNDLE_FIELD_FROM(std::string, class_, "x; y")',
        "TRUNDLE_MESSAGE(::gazebo::msgs::Vector3d, at)",
        "TRUNDLE_MESSAGES(::a::b::Sample::Inner, inner)",
        "TRUNDLE_WHOLE(Sample)",
    ]


def test_messages_come_after_those_that_they_have(tmp_path: Path) -> None:
    mine = 'import "other.proto"; message A { optional B b = 1; } message B { optional other.C c = 1; }'
    text = header(tmp_path, mine, other=_OTHER)

    assert '#include "other.pb.h"' in text
    assert text.index("class B {") < text.index("class A {")


_OTHER = "package other; message C { enum Kind { FIRST = 3; } optional Kind kind = 1; }"


def test_an_enumeration_begins_with_its_first_value(tmp_path: Path) -> None:
    assert "TRUNDLE_FIELD_FROM(::other::C::Kind, kind, ::other::C::FIRST)" in header(tmp_path, _OTHER)
    assert "enum Kind { FIRST = 3 };" in header(tmp_path, _OTHER)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("message A { optional B b = 1; }", "mine.proto:1: no message B; it is neither imported nor Gazebo's here"),
        ("\nmessage A { oneof x { int32 a = 1; } }", "mine.proto:2: oneof are not in messages of plugins here"),
        ("message A { map<string, int32> a = 1; }", "map fields are not in messages of plugins here"),
        ("service S { }", "mine.proto:1: services are not in messages of plugins here"),
        ("message A { optional A a = 1; }", "message A has itself as a field"),
        ("message A { optional B b = 1; } message B { optional A a = 1; }", "message A has itself as a field"),
        ("message A {", "mine.proto:1: the file ends in the middle of a declaration"),
        ("message A { required int32 ", "the file ends in the middle of a declaration"),
        ("message A { optional int32 a: 1; }", "mine.proto:1: ':' is where '=' belongs"),
        ("message A.B { }", "'A.B' is not a name in C++"),
        ("package x.class; message A { }", "'class' is not a name in C++"),
        ("enum E { A = abort(); }", "this is not a number"),
        ('message A { optional int32 a = 1 [default = "x"]; }', "is not a default of int32 that is known here"),
        ("message A { \x00 }", "mine.proto:1: '\\x00' is not part of a .proto file"),
        ("message A {" * 40 + "}" * 40, "messages are nested too deeply"),
    ],
)
def test_what_is_missing_is_said(text: str, expected: str, tmp_path: Path) -> None:
    with pytest.raises(ProtoError) as error:
        header(tmp_path, text)

    assert expected in str(error.value)


def test_a_wrong_file_is_an_error_of_the_compiler(tmp_path: Path) -> None:
    (tmp_path / "bad.proto").write_text('message "A" {\n')
    (tmp_path / "good.proto").write_text("message A { }")

    assert main(str(tmp_path / "out"), str(tmp_path / "bad.proto"), str(tmp_path / "good.proto")) == 0
    assert (tmp_path / "out/bad.pb.h").read_text().startswith('#error "')
    assert "class A {" in (tmp_path / "out/good.pb.h").read_text()
    assert (tmp_path / "out/good.pb.cc").read_text() == '#include "good.pb.h"\n'
