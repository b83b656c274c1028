"""`trundle bag check` and `fix` with rule files, exchanged with rosbag."""

import os
import re
from pathlib import Path
from typing import Any

import pytest
from tests.ros.bags.old_bags import OLD_HEADER, OLD_POINT, SEPARATOR, Content, rule, write_old_bag

from trundle.ros import BagConnection, BagMessage, Messages, create_bag, open_bag

POINT = "geometry_msgs/Point"
NEW_POINT = "float64 x\nfloat64 y\nfloat64 z\n"
RULE = rule("a", (POINT, OLD_POINT), (POINT, NEW_POINT), "new_msg.z = old_msg.x + 1")
STAMPED = f"Header header\nPoint point{OLD_HEADER}{SEPARATOR}{POINT}\n{NEW_POINT}"
POSES = (
    f"Header header\nPose[] poses{OLD_HEADER}{SEPARATOR}geometry_msgs/Pose\nPoint position\n"
    f"{SEPARATOR}{POINT}\n{NEW_POINT}"
)
JOINTS = "Header header\nstring[] name\nfloat64[] position\nfloat64[3] velocity\nfloat32[] effort"
PACKAGE = """<package format="2"><name>old_rules</name><version>1.0.0</version><description>Rules.</description>
<maintainer email="me@example.com">me</maintainer><license>MIT</license><depend>rosbag</depend>
<export><rosbag migration_rule_file="rules/points.bmr"/></export></package>
"""
BAGS: dict[str, Content] = {
    "new field": [("/p", POINT, OLD_POINT, [{"x": i, "y": -i} for i in range(3)])],
    "nested types": [
        ("/s", "geometry_msgs/PointStamped", STAMPED, [{"header": {"stamp": {"secs": 4}, "frame": "map"}}]),
        ("/a", "geometry_msgs/PoseArray", POSES, [{"poses": [{"position": {"x": i}}] * i} for i in range(3)]),
    ],
    "changed fields": [
        ("/c", "std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\n", [{"r": 0.5}]),
        ("/j", "sensor_msgs/JointState", JOINTS + OLD_HEADER, [{"name": ["a", "b"], "velocity": [1, 2, 3]}]),
        ("/d", "std_msgs/MultiArrayDimension", "int32 A=5\nstring label\nuint32 size\nuint32 stride\n", [{"size": 3}]),
        ("/i", "sensor_msgs/CompressedImage", f"Header header\nuint8[] data{OLD_HEADER}", [{"data": b"abc"}]),
    ],
    "unchanged": [("/t", "std_msgs/String", "string data\n", [{"data": "x"}])],
}


@pytest.fixture
def old(tmp_path: Path) -> Path:
    return write_old_bag(tmp_path / "old.bag", BAGS["new field"])


def _fields(path: Path, topic: str) -> list[Any]:
    messages = Messages()
    with open_bag(path) as bag:
        return [
            messages.deserialize(message.data, message.connection.type)
            for message in bag.messages(lambda connection: connection.topic == topic)
        ]


def _contents(path: Path) -> list[Any]:
    with open_bag(path) as bag:
        return [
            (m.stamp_ns, m.connection.topic, m.connection.type, m.connection.md5sum, m.data) for m in bag.messages()
        ]


def test_rules_are_generated_completed_and_applied(graph: Any, old: Path, tmp_path: Path) -> None:
    rules, new = tmp_path / "rules.bmr", tmp_path / "new.bag"
    before = old.read_bytes()
    code, out, _ = graph.trundle("bag", "fix", str(old), str(new))
    assert (code, "    1 rules missing:\n" in out, new.exists()) == (1, True, False)
    code, out, _ = graph.trundle("bag", "check", str(old), "-g", str(rules))
    assert (code, out.endswith(f"\nThe necessary rule files have been written to: {rules}\n")) == (0, True)
    code, _, error = graph.trundle("bag", "fix", str(old), str(new), str(rules))
    assert (code, "valid is False; complete its update" in error, new.exists()) == (1, True, False)

    rules.write_text(rules.read_text().replace("valid = False", "valid = True").replace("z = 0", "z = old_msg.x + 5"))
    code, out, _ = graph.trundle("bag", "check", str(old), str(rules))
    assert (code, out.endswith("\nAll rules defined.  Bag is ready to be migrated\n")) == (1, True)
    assert graph.trundle("bag", "fix", str(old), str(new), str(rules)) == (0, "Bag migrated successfully.\n", "")
    assert [(m.x, m.y, m.z) for m in _fields(new, "/p")] == [(0, 0, 5), (1, -1, 6), (2, -2, 7)]
    assert graph.trundle("bag", "check", str(new)) == (0, "Bag file does not need any migrations.\n", "")
    assert old.read_bytes() == before


def test_rules_are_appended_to_a_rule_file(graph: Any, tmp_path: Path) -> None:
    old = write_old_bag(tmp_path / "old.bag", [*BAGS["new field"], *BAGS["changed fields"]])
    rules = tmp_path / "rules.bmr"
    assert graph.trundle("bag", "check", str(old), "-a", "-g", str(rules))[0] == 2
    rules.write_text(RULE)
    assert graph.trundle("bag", "check", str(old), "-g", str(rules))[0] == 2
    assert graph.trundle("bag", "check", str(old), "-a")[0] == 2
    assert graph.trundle("bag", "check", str(old), "-a", "-g", str(rules))[0] == 0
    assert rules.read_text().startswith(RULE)
    assert POINT not in re.findall(r'old_type = "(.*)"', rules.read_text())
    rules.write_text(rules.read_text().replace("valid = False", "valid = True"))
    text = rules.read_text()
    code, out, _ = graph.trundle("bag", "check", str(old), "-a", "-g", str(rules))
    assert (code, f"No additional rule files needed to be generated.  {rules} not created." in out) == (0, True)
    assert rules.read_text() == text


def test_force_sets_new_fields_to_0(graph: Any, old: Path, tmp_path: Path) -> None:
    new = tmp_path / "new.bag"
    assert graph.trundle("bag", "fix", "--force", str(old), str(new)) == (0, "Bag migrated successfully.\n", "")
    assert [(m.x, m.y, m.z) for m in _fields(new, "/p")] == [(0, 0, 0), (1, -1, 0), (2, -2, 0)]


def test_a_wrong_definition_is_ignored_if_the_md5sums_are_equal(graph: Any, tmp_path: Path) -> None:
    old, new = tmp_path / "old.bag", tmp_path / "new.bag"
    for md5sum, code in ((Messages().md5("std_msgs/String"), 0), ("0" * 32, 1)):
        old.unlink(missing_ok=True)
        with create_bag(old) as out:
            connection = BagConnection(topic="/a", type="std_msgs/String", md5sum=md5sum, definition="Nix x\n")
            out.write(BagMessage(connection, 10**18, b"\1\0\0\0x"))
        assert graph.trundle("bag", "fix", str(old), str(new))[0] == code
    assert [message.data for message in _fields(new, "/a")] == ["x"]


def test_the_new_name_of_a_type_is_prompted_for(graph: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    old = write_old_bag(tmp_path / "old.bag", [("/v", "gone/Vector", "float64 x\nfloat64 y\nfloat64 z\n", [{"y": 2}])])
    rules, new, answers = tmp_path / "rules.bmr", tmp_path / "new.bag", iter(["nix/Nix", "geometry_msgs/Vector3"])

    def answer(_: str) -> str:
        return next(answers)

    monkeypatch.setattr("builtins.input", answer)
    code, out, _ = graph.trundle("bag", "check", str(old), "-g", str(rules))
    assert (code, "'nix/Nix' could not be found in your system." in out) == (0, True)
    assert graph.trundle("bag", "fix", str(old), str(new), str(rules))[0] == 0
    assert [m.y for m in _fields(new, "/v")] == [2.0]
    assert graph.trundle("bag", "fix", "--force", str(old), str(new))[0] == 0
    assert [kind for _, _, kind, *_ in _contents(new)] == ["gone/Vector"]


def test_without_an_answer_no_rule_file_is_written(graph: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    old = write_old_bag(tmp_path / "old.bag", [("/v", "gone/Vector", "float64 x\n", [{}])])

    def end(_: str) -> str:
        raise EOFError

    monkeypatch.setattr("builtins.input", end)
    code, _, error = graph.trundle("bag", "check", str(old), "-g", str(tmp_path / "rules.bmr"))
    assert (code, error) == (1, "ERROR: no type was entered to migrate gone/Vector to; no rules are written\n")
    assert not (tmp_path / "rules.bmr").exists()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (RULE.replace("+ 1", "+ nix"), "rules.bmr:7: NameError: name 'nix' is not defined"),
        (RULE.replace("+ 1", "+"), "rules.bmr:7: invalid syntax"),
        (RULE.replace("old_msg.x + 1", "'a'"), "rules.bmr:6: a: field 'z' is a float64, got 'a'"),
    ],
)
def test_a_failing_rule_leaves_the_files_unchanged(
    graph: Any, old: Path, tmp_path: Path, text: str, message: str
) -> None:
    rules, new = tmp_path / "rules.bmr", tmp_path / "new.bag"
    rules.write_text(text)
    before = old.read_bytes()
    code, out, error = graph.trundle("bag", "fix", str(old), str(new), str(rules))
    assert (code, out, error) == (1, "", f"ERROR: {tmp_path}/{message}\n")
    assert (old.read_bytes(), sorted(os.listdir(tmp_path))) == (before, ["old.bag", "rules.bmr"])
    new.write_text("something else")
    assert graph.trundle("bag", "fix", str(old), str(new), str(rules))[0] == 1
    assert new.read_text() == "something else"


def test_rules_of_packages_are_reported_and_can_be_disabled(
    graph: Any, old: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "src/old_rules"
    (package / "rules").mkdir(parents=True)
    (package / "package.xml").write_text(PACKAGE)
    (package / "rules/points.bmr").write_text(RULE)
    new = str(tmp_path / "new.bag")
    monkeypatch.setenv("ROS_PACKAGE_PATH", "")
    monkeypatch.chdir(package)  # rules of the working directory do not run
    assert graph.trundle("bag", "fix", str(old), new)[0] == 1
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    assert graph.trundle("bag", "fix", "-n", str(old), new)[0] == 1
    code, out, error = graph.trundle("bag", "fix", str(old), new)
    assert (code, out) == (0, "Bag migrated successfully.\n")
    assert error == f"Using the rules of package old_rules: {package}/rules/points.bmr\n"
    assert [m.z for m in _fields(Path(new), "/p")] == [1, 2, 3]


def test_the_export_of_a_rosbuild_manifest_is_read(
    graph: Any, old: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "src/older_rules"
    package.mkdir(parents=True)
    depend = '<depend package="rosbagmigration"/>'
    export = '<export><rosbagmigration rule_file="points.bmr"/></export>'
    (package / "manifest.xml").write_text(f"<package>{depend}{export}</package>")
    (package / "points.bmr").write_text(RULE)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    assert graph.trundle("bag", "fix", str(old), str(tmp_path / "new.bag"))[0] == 0
    (package / "manifest.xml").write_text(f"<package>{export}</package>")
    assert graph.trundle("bag", "fix", str(old), str(tmp_path / "new.bag"))[0] == 1


def _complete_rules(path: Path) -> Path:
    path.write_text(path.read_text().replace("valid = False", "valid = True"))
    return path


@pytest.mark.slow
@pytest.mark.real_ros
@pytest.mark.parametrize("name", BAGS)
def test_output_and_messages_are_equal_to_rosbag(graph: Any, original: Any, tmp_path: Path, name: str) -> None:
    old = write_old_bag(tmp_path / "old.bag", BAGS[name])
    original_rules, trundle_rules = tmp_path / "rosbag.bmr", tmp_path / "trundle.bmr"
    assert graph.trundle("bag", "check", "-n", str(old))[1] == original("rosbag", "check", "-n", str(old))
    expected = original("rosbag", "check", "-n", "-g", str(original_rules), str(old))
    expected = expected.replace("rosbag.bmr", "trundle.bmr")
    assert graph.trundle("bag", "check", "-n", "-g", str(trundle_rules), str(old))[1] == expected
    for rules in (original_rules, trundle_rules):
        arguments = [str(_complete_rules(rules))] if rules.exists() else []
        original("rosbag", "fix", "-n", str(old), str(tmp_path / "a.bag"), *arguments)
        assert graph.trundle("bag", "fix", "-n", str(old), str(tmp_path / "b.bag"), *arguments)[0] == 0
        assert _contents(tmp_path / "b.bag") == _contents(tmp_path / "a.bag")
    checked = original("rosbag", "check", "-n", str(tmp_path / "b.bag"))
    assert checked.endswith("Bag file does not need any migrations.\n") or "ready to be migrated" in checked
