"""Messages of old types, led through update rules to those of today."""

from pathlib import Path
from typing import Any

import pytest
from tests.ros.bags.old_bags import OLD_HEADER, OLD_POINT, SEPARATOR, rule

from trundle.ros import (
    GeneratedRule,
    MessageClass,
    MessageClasses,
    Messages,
    MigrationError,
    Migrator,
    RuleFile,
    missing_rules,
)
from trundle.ros.migration.times import Duration, Time

POINT = "geometry_msgs/Point"
STAMPED = "geometry_msgs/PointStamped"
OLD_STAMPED = f"Header header\nPoint point{OLD_HEADER}{SEPARATOR}{POINT}\n{OLD_POINT}"


def _class(kind: str, text: str) -> MessageClass:
    return MessageClasses.from_definition(kind, text).message_class(kind)


@pytest.fixture
def migrator(tmp_path: Path) -> Any:
    """Make a migrator of a rule file's text; its warnings are in `said`."""

    def make(text: str = "", *, is_forced: bool = False) -> Migrator:
        path = tmp_path / "rules.bmr"
        path.write_text(text)
        make.said = []
        return Migrator([RuleFile(path)], Messages(), warn=make.said.append, is_forced=is_forced)

    return make


def _migrated(migrator: Migrator, kind: str, text: str, fields: dict[str, Any]) -> Any:
    """A message after its migration, and its type."""
    old = _class(kind, text)
    new = migrator.target(old)
    assert new is not None
    data = migrator.convert_bytes(old.classes.write(kind, fields), old, new)
    return Messages().deserialize(data, new.kind)


def _missing(migrator: Migrator, kind: str, text: str) -> list[tuple[str, str | None]]:
    old = _class(kind, text)
    rules = missing_rules([step.rule for step in migrator.path(old, migrator.target(old))])
    return [(rule.old_class.kind, rule.new_class and rule.new_class.kind) for rule in rules]


def test_fields_of_the_same_name_need_no_rule(migrator: Any) -> None:
    text = "float64 z\nfloat64 x\nfloat64 y\n"
    assert _missing(migrator(), POINT, text) == []
    assert _migrated(migrator(), POINT, text, {"x": 1, "y": 2, "z": 3}) == Messages().new(POINT, [1, 2, 3])


def test_a_type_within_that_changed_is_what_is_missing(migrator: Any) -> None:
    assert _missing(migrator(), STAMPED, OLD_STAMPED) == [("std_msgs/Header", "std_msgs/Header"), (POINT, POINT)]
    with pytest.raises(MigrationError, match="rules lead from"):
        _migrated(migrator(), POINT, OLD_POINT, {})


def test_rules_for_types_within_hold_wherever_they_are(migrator: Any) -> None:
    header = "uint32 seq\ntime stamp\nstring frame_id\n"
    rules = migrator(
        rule(
            "a",
            ("std_msgs/Header", "time stamp\nstring frame\n"),
            ("std_msgs/Header", header),
            "new_msg.stamp = old_msg.stamp",
            "new_msg.frame_id = old_msg.frame.upper()",
        )
        + rule("b", (POINT, OLD_POINT), (POINT, "float64 x\nfloat64 y\nfloat64 z\n"), "new_msg.z = old_msg.x")
    )
    fields = {"header": {"stamp": {"secs": 5, "nsecs": 6}, "frame": "map"}, "point": {"x": 2}}

    message = _migrated(rules, STAMPED, OLD_STAMPED, fields)

    assert (message.header.stamp.sec, message.header.stamp.nanosec, message.header.frame_id) == (5, 6, "MAP")
    assert (message.point.x, message.point.z) == (0.0, 2.0)


def test_force_follows_what_nobody_completed(migrator: Any) -> None:
    fields = {"header": {"frame": "map"}, "point": {"x": 2, "y": 3}}
    message = _migrated(migrator(is_forced=True), STAMPED, OLD_STAMPED, fields)
    assert (message.header.frame_id, message.point.x, message.point.y, message.point.z) == ("", 2.0, 3.0, 0.0)


def test_rules_follow_one_another_and_rename(migrator: Any) -> None:
    parts = f"old/Part[] parts\ntime t\n{SEPARATOR.lstrip()}old/Part\nstring name\n"
    pieces = f"old/Piece[] parts\ntime t\n{SEPARATOR.lstrip()}old/Piece\nstring label\n"
    text = (
        rule("a", ("old/A", "int32 x\n"), ("old/A", "int32 x\nint32 y\n"), "new_msg.x, new_msg.y = old_msg.x, 2")
        + rule(
            "b",
            ("old/A", "int32 x\nint32 y\n"),
            ("old/A", parts),
            "new_msg.parts = [self.get_new_class('Part')(f'p{i}') for i in range(old_msg.x * old_msg.y)]",
            "new_msg.t = type(new_msg.t)(old_msg.x, 5)",
            more="order = 1",
        )
        + rule(
            "c",
            ("old/A", parts),
            ("old/B", pieces),
            "self.migrate_array(old_msg.parts, new_msg.parts, 'Piece')",
            "new_msg.t = old_msg.t + (old_msg.t - old_msg.t)",
            more="order, migrated_types = 2, [('Part', 'Piece')]",
        )
        + rule("d", ("old/Part", "string name\n"), ("old/Piece", "string label\n"), "new_msg.label = old_msg.name * 2")
        + rule(
            "e",
            ("old/B", pieces),
            ("sensor_msgs/JointState", Messages().definition("sensor_msgs/JointState")),
            "new_msg.name = [part.label for part in old_msg.parts]",
            "new_msg.header.stamp = old_msg.t",
        )
    )
    message = _migrated(migrator(text), "old/A", "int32 x\n", {"x": 2})
    assert (message.name, message.header.stamp.sec) == (["p0p0", "p1p1", "p2p2", "p3p3"], 2)
    assert _migrated(migrator(text), "old/B", pieces, {"parts": [{"label": "x"}]}).name == ["x"]
    assert migrator.said == []


def test_a_type_nobody_knows_leads_nowhere(migrator: Any) -> None:
    assert _missing(migrator(), "old/A", "int32 x\n") == [("old/A", None)]
    renamed = rule("a", ("old/A", "int32 x\n"), ("new/A", "int32 x\n"), "new_msg.x = old_msg.x")
    assert _missing(migrator(renamed), "old/A", "int32 x\n") == [("new/A", None)]
    assert _missing(migrator(renamed), "old/A", "int64 x\n") == [("new/A", None)]


@pytest.mark.parametrize(
    ("more", "complaint"),
    [
        ([("x", "old/A", "")], "has order 0 already; this rule is ignored"),
        ([("x", "old/B", "order = 1"), ("y", "old/C", "order = 2")], "renames old/A already; this rule is ignored"),
        ([("x", "old/B", "order = 0")], "a rule that renames comes last"),
        ([("x", "old/B", "order = 1"), ("y", "old/A", "order = 2")], "renames old/A at order 1, before this one"),
    ],
)
def test_rules_that_contradict_are_left_out(migrator: Any, more: list[tuple[str, str, str]], complaint: str) -> None:
    text = rule("a", ("old/A", "int32 x\n"), ("old/A", "int32 y\n"))
    migrator(text + "".join(rule(n, ("old/A", "int32 y\n"), (kind, "int32 y\n"), more=m) for n, kind, m in more))
    assert len(migrator.said) == 1
    assert complaint in migrator.said[0]


def test_names_that_go_round_in_a_circle_are_left_out(migrator: Any) -> None:
    there = rule("a", ("old/A", "int32 x\n"), ("old/B", "int32 x\n"))
    migrator(there + rule("b", ("old/B", "int32 x\n"), ("old/A", "int32 x\n")))
    assert "old/A is renamed back to old/B" in migrator.said[0]


def test_a_generated_rule_runs_as_it_is_written(migrator: Any) -> None:
    """The rule's text, marked as valid, has the effect of the forced rule."""
    kind, text = "sensor_msgs/JointState", "uint8[] name\nfloat64[3] velocity\nfloat64[] position\nint32 OLD=1\n"
    old = _class(kind, text + "string gone\ntime[2] effort\n")
    rules = migrator()
    (written,) = missing_rules([step.rule for step in rules.path(old, rules.target(old))])
    assert isinstance(written, GeneratedRule)
    assert "# effort was time[2] and is float64[]\n        new_msg.effort = []\n" in written.text()
    assert "# constant OLD has changed" in written.text()

    message = _migrated(migrator(written.text().replace("valid = False", "valid = True")), kind, old.definition, {})

    assert (message.name, list(message.position), list(message.effort)) == ([], [], [])


@pytest.mark.parametrize("text", ['# """ quoted\n', "# a path: C:\\nix\\x\n", '# ends with a quote: "'])
def test_a_text_is_quoted_so_that_it_reads_the_same(migrator: Any, text: str) -> None:
    old = _class(POINT, f"float64 x\n{text}")
    rules = migrator()
    (written,) = missing_rules([step.rule for step in rules.path(old, rules.target(old))])
    assert isinstance(written, GeneratedRule)
    migrator(written.text().replace("valid = False", "valid = True"))


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("class x(:\n", "rules.bmr:1: invalid syntax"),
        ("import nothing_of_that_name\n", "rules.bmr:1: ModuleNotFoundError"),
        ("\nimport sys\nsys.exit(0)\n", "rules.bmr:3: SystemExit: 0"),
        ("def f():\n    return 1 / 0\nf()\n", "rules.bmr:2: ZeroDivisionError"),
        (rule("a", ("A", ""), ("B", "")), "rules.bmr:6: a: old_type is a type such as std_msgs/String, got 'A'"),
        (rule("a", ("a/A", "x y z"), ("a/B", "")), "a/A cannot be read: line 1: not a field: 'x y z'"),
        (rule("a", ("a/A", ""), ("a/B", ""), more="migrated_types = ['x']"), "a list of pairs of types, got 'x' in it"),
        (rule("a", ("a/A", ""), ("a/B", ""), more="order = 'x'"), "order is a number, got 'x'"),
        (rule("a", ("a/A", ""), ("a/B", ""), more="valid = False"), "rules.bmr:6: a: valid is False"),
    ],
)
def test_what_is_wrong_with_a_rule_file_is_one_sentence(migrator: Any, text: str, complaint: str) -> None:
    with pytest.raises(MigrationError) as caught:
        migrator(text)
    assert complaint in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("new_msg.q = 1", "rules.bmr:7: AttributeError"),
        ("new_msg.z = 'a'", "rules.bmr:6: a: field 'z' is a float64, got 'a'"),
        ("self.migrate(old_msg, new_msg)", "rules.bmr:7: ('Point', 'Point') is not in migrated_types"),
        ("self.get_new_class('Nix')", "rules.bmr:7: KeyError: 'Nix'"),
        ("raise SystemExit(0)", "rules.bmr:7: SystemExit"),
    ],
)
def test_what_a_rule_does_wrong_is_one_sentence(migrator: Any, line: str, complaint: str) -> None:
    new = (POINT, "float64 x\nfloat64 y\nfloat64 z\n")
    with pytest.raises(MigrationError) as caught:
        _migrated(migrator(rule("a", (POINT, OLD_POINT), new, line)), POINT, OLD_POINT, {})
    assert complaint in str(caught.value)


def test_messages_are_as_genpy_has_them() -> None:
    text = "int32 ONE=1\nstring WORD=a b\nuint8[] raw\nfloat32[2] pair\nbool[] flags\nstring[] names\ntime[] times\n"
    made = _class("old/A", f"{text}old/B[] within\nduration long\nint32 class\n{SEPARATOR.lstrip()}old/B\nint8 x\n")
    data = made.classes.write(
        "old/A",
        {"raw": b"ab", "pair": [1, 2], "flags": [True], "names": ["n"], "times": [{"secs": 1}], "within": [{"x": 3}]},
    )
    message: Any = made()
    assert (message.raw, message.pair, message.flags, message.long) == (b"", [0, 0], [], Duration())

    message.deserialize(data)

    assert (message.ONE, message.WORD, getattr(message, "class")) == (1, "a b", 0)
    assert (message.raw, message.pair, message.flags, message.names) == (b"ab", (1.0, 2.0), [True], ["n"])
    assert (message.times, message.within[0].x, message._type) == ([Time(1)], 3, "old/A")
    with pytest.raises(TypeError, match="has 8 fields"):
        made(1)
    with pytest.raises(AttributeError, match="no field 'nix'"):
        made(nix=1)


def test_the_header_of_before_2010_is_todays() -> None:
    """REP 100 moved roslib/Header to std_msgs."""
    text = f"Header header\n{SEPARATOR.lstrip()}roslib/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
    assert _class("old/A", text).kinds == {"header": "std_msgs/Header"}


def test_times_compute() -> None:
    assert Time(1, 5) - Time(0, 6) == Duration(0, 999_999_999)
    assert Time.from_sec(1.5) + Duration(0, -500_000_000) == Time(1)
    assert (Duration(-1.5).to_nsec(), abs(-Duration(2)) / 2) == (-1_500_000_000, Duration(1))
    assert Time() < Time(0, 1)
    assert not Time()
