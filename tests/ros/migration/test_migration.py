"""Messages of old types, migrated by update rules to current ones."""

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


class MigratorFactory:
    """Makes a migrator from a rule file's text; `warnings` holds the warnings of the last one."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self.warnings: list[str] = []

    def __call__(self, text: str = "", *, is_forced: bool = False) -> Migrator:
        self._path.write_text(text)
        self.warnings = []
        return Migrator([RuleFile(self._path)], Messages(), warn=self.warnings.append, is_forced=is_forced)


@pytest.fixture
def migrator(tmp_path: Path) -> MigratorFactory:
    return MigratorFactory(tmp_path / "rules.bmr")


def _migrated(migrator: Migrator, kind: str, text: str, fields: dict[str, Any]) -> Any:
    """Return a message after its migration."""
    old = _class(kind, text)
    new = migrator.target(old)
    assert new is not None
    data = migrator.convert_bytes(old.classes.write(kind, fields), old, new)
    return Messages().deserialize(data, new.kind)


def _missing(migrator: Migrator, kind: str, text: str) -> list[tuple[str, str | None]]:
    old = _class(kind, text)
    rules = missing_rules([step.rule for step in migrator.path(old, migrator.target(old))])
    return [(rule.old_class.kind, rule.new_class and rule.new_class.kind) for rule in rules]


def test_fields_of_the_same_name_need_no_rule(migrator: MigratorFactory) -> None:
    text = "float64 z\nfloat64 x\nfloat64 y\n"
    assert _missing(migrator(), POINT, text) == []
    assert _migrated(migrator(), POINT, text, {"x": 1, "y": 2, "z": 3}) == Messages().new(POINT, [1, 2, 3])


def test_rules_for_changed_nested_types_are_missing(migrator: MigratorFactory) -> None:
    assert _missing(migrator(), STAMPED, OLD_STAMPED) == [("std_msgs/Header", "std_msgs/Header"), (POINT, POINT)]
    with pytest.raises(MigrationError, match="rules lead from"):
        _migrated(migrator(), POINT, OLD_POINT, {})


def test_rules_for_nested_types_apply_in_every_message(migrator: MigratorFactory) -> None:
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


def test_a_forced_migrator_applies_incomplete_rules(migrator: MigratorFactory) -> None:
    fields = {"header": {"frame": "map"}, "point": {"x": 2, "y": 3}}
    message = _migrated(migrator(is_forced=True), STAMPED, OLD_STAMPED, fields)
    assert (message.header.frame_id, message.point.x, message.point.y, message.point.z) == ("", 2.0, 3.0, 0.0)


def test_rules_are_chained_and_rename_types(migrator: MigratorFactory) -> None:
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
    assert migrator.warnings == []


def test_an_unknown_type_has_no_target(migrator: MigratorFactory) -> None:
    assert _missing(migrator(), "old/A", "int32 x\n") == [("old/A", None)]
    renamed = rule("a", ("old/A", "int32 x\n"), ("new/A", "int32 x\n"), "new_msg.x = old_msg.x")
    assert _missing(migrator(renamed), "old/A", "int32 x\n") == [("new/A", None)]
    assert _missing(migrator(renamed), "old/A", "int64 x\n") == [("new/A", None)]


@pytest.mark.parametrize(
    ("more", "reason"),
    [
        ([("x", "old/A", "")], "has order 0 already; this rule is ignored"),
        ([("x", "old/B", "order = 1"), ("y", "old/C", "order = 2")], "renames old/A already; this rule is ignored"),
        ([("x", "old/B", "order = 0")], "a rule that renames comes last"),
        ([("x", "old/B", "order = 1"), ("y", "old/A", "order = 2")], "renames old/A at order 1, before this one"),
    ],
)
def test_contradicting_rules_are_ignored_with_a_warning(
    migrator: MigratorFactory, more: list[tuple[str, str, str]], reason: str
) -> None:
    text = rule("a", ("old/A", "int32 x\n"), ("old/A", "int32 y\n"))
    migrator(text + "".join(rule(n, ("old/A", "int32 y\n"), (kind, "int32 y\n"), more=m) for n, kind, m in more))
    assert len(migrator.warnings) == 1
    assert reason in migrator.warnings[0]


def test_circular_renames_are_ignored_with_a_warning(migrator: MigratorFactory) -> None:
    forward = rule("a", ("old/A", "int32 x\n"), ("old/B", "int32 x\n"))
    migrator(forward + rule("b", ("old/B", "int32 x\n"), ("old/A", "int32 x\n")))
    assert "old/A is renamed back to old/B" in migrator.warnings[0]


def test_the_text_of_a_generated_rule_runs(migrator: MigratorFactory) -> None:
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
def test_definitions_are_quoted_in_a_generated_rule(migrator: MigratorFactory, text: str) -> None:
    old = _class(POINT, f"float64 x\n{text}")
    rules = migrator()
    (written,) = missing_rules([step.rule for step in rules.path(old, rules.target(old))])
    assert isinstance(written, GeneratedRule)
    migrator(written.text().replace("valid = False", "valid = True"))


@pytest.mark.parametrize(
    ("text", "reason"),
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
def test_an_invalid_rule_file_is_reported_in_one_sentence(migrator: MigratorFactory, text: str, reason: str) -> None:
    with pytest.raises(MigrationError) as caught:
        migrator(text)
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("new_msg.q = 1", "rules.bmr:7: AttributeError"),
        ("new_msg.z = 'a'", "rules.bmr:6: a: field 'z' is a float64, got 'a'"),
        ("self.migrate(old_msg, new_msg)", "rules.bmr:7: ('Point', 'Point') is not in migrated_types"),
        ("self.get_new_class('Nix')", "rules.bmr:7: KeyError: 'Nix'"),
        ("raise SystemExit(0)", "rules.bmr:7: SystemExit"),
    ],
)
def test_a_failing_rule_is_reported_in_one_sentence(migrator: MigratorFactory, line: str, reason: str) -> None:
    new = (POINT, "float64 x\nfloat64 y\nfloat64 z\n")
    with pytest.raises(MigrationError) as caught:
        _migrated(migrator(rule("a", (POINT, OLD_POINT), new, line)), POINT, OLD_POINT, {})
    assert reason in str(caught.value)


def test_rule_messages_have_genpys_interface() -> None:
    text = "int32 ONE=1\nstring WORD=a b\nuint8[] raw\nfloat32[2] pair\nbool[] flags\nstring[] names\ntime[] times\n"
    cls = _class("old/A", f"{text}old/B[] within\nduration long\nint32 class\n{SEPARATOR.lstrip()}old/B\nint8 x\n")
    data = cls.classes.write(
        "old/A",
        {"raw": b"ab", "pair": [1, 2], "flags": [True], "names": ["n"], "times": [{"secs": 1}], "within": [{"x": 3}]},
    )
    message: Any = cls()
    assert (message.raw, message.pair, message.flags, message.long) == (b"", [0, 0], [], Duration())

    message.deserialize(data)

    assert (message.ONE, message.WORD, getattr(message, "class")) == (1, "a b", 0)
    assert (message.raw, message.pair, message.flags, message.names) == (b"ab", (1.0, 2.0), [True], ["n"])
    assert (message.times, message.within[0].x, message._type) == ([Time(1)], 3, "old/A")
    with pytest.raises(TypeError, match="has 8 fields"):
        cls(1)
    with pytest.raises(AttributeError, match="no field 'nix'"):
        cls(nix=1)


def test_roslib_header_is_read_as_std_msgs_header() -> None:
    """REP 100 moved roslib/Header to std_msgs."""
    text = f"Header header\n{SEPARATOR.lstrip()}roslib/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
    assert _class("old/A", text).kinds == {"header": "std_msgs/Header"}


def test_time_arithmetic() -> None:
    assert Time(1, 5) - Time(0, 6) == Duration(0, 999_999_999)
    assert Time.from_sec(1.5) + Duration(0, -500_000_000) == Time(1)
    assert (Duration(-1.5).to_nsec(), abs(-Duration(2)) / 2) == (-1_500_000_000, Duration(1))
    assert Time() < Time(0, 1)
    assert not Time()
