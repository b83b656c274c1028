"""ROS names: legality, resolution, command-line arguments and names made from SDF's."""

import pytest

from trundle.robots.names import (
    anonymous_name,
    canonical_name,
    is_legal_base_name,
    is_legal_name,
    join_names,
    parent_namespace,
    parse_arguments,
    resolve_name,
    ros_name,
    ros_names,
)


@pytest.mark.parametrize("name", ["", "/", "/a/b", "~x", "chatter", "a1_/b"])
def test_names_the_original_accepts_are_legal(name: str) -> None:
    assert is_legal_name(name)


@pytest.mark.parametrize("name", ["1a", "a b", "a::b", "a//b", "_x", "a-b", "ä"])
def test_names_the_original_refuses_are_not_legal(name: str) -> None:
    assert not is_legal_name(name)


def test_a_base_name_has_no_namespace() -> None:
    assert is_legal_base_name("driver_2")
    assert not is_legal_base_name("robot/driver")


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("/abs", "/abs"),
        ("rel", "/ns/rel"),
        ("~priv", "/ns/node/priv"),
        ("~/priv", "/ns/node/priv"),
        ("a//b/", "/ns/a/b"),
        ("", "/ns/"),
    ],
)
def test_names_resolve_as_in_the_original(written: str, expected: str) -> None:
    assert resolve_name(written, "/ns/node") == expected


def test_remapping_applies_to_the_resolved_name() -> None:
    assert resolve_name("scan", "/ns/node", {"/ns/scan": "/front/scan"}) == "/front/scan"


def test_namespaces_join_and_split() -> None:
    assert join_names("/ns", "x") == "/ns/x"
    assert join_names("/ns/", "/x") == "/x"
    assert parent_namespace("/a/b") == "/a/"
    assert parent_namespace("/b") == "/"
    assert canonical_name("//a/b/") == "/a/b"


def test_a_command_line_is_sorted_into_what_ros_reads_and_the_rest() -> None:
    command_line = [
        "-v",
        "scan:=/front/scan",
        "__name:=laser",
        "_rate:=[1, 2]",
        "__ns:=/r",
        "__unknown:=x",
        "file.yaml",
    ]

    arguments = parse_arguments(command_line)

    assert arguments.remappings == {"scan": "/front/scan"}
    assert arguments.params == {"rate": "[1, 2]"}
    assert (arguments.name, arguments.namespace) == ("laser", "/r")
    assert arguments.rest == ("-v", "file.yaml")


def test_an_anonymous_name_is_legal() -> None:
    assert is_legal_base_name(anonymous_name("rostopic"))


@pytest.mark.parametrize(
    ("sdf", "ros"),
    [
        ("rp2w", "rp2w"),
        ("robot::arm::link 1", "robot/arm/link_1"),
        ("2nd wheel", "n_2nd_wheel"),
        ("_hidden", "n__hidden"),
        ("", "unnamed"),
        ("größe", "gr__e"),
    ],
)
def test_sdf_names_become_legal_by_one_rule(sdf: str, ros: str) -> None:
    assert ros_name(sdf) == ros
    assert is_legal_name(ros)


def test_names_that_would_meet_stay_distinct() -> None:
    assert ros_names(["left arm", "left_arm", "left-arm"]) == {
        "left arm": "left_arm_2",
        "left_arm": "left_arm",
        "left-arm": "left_arm_3",
    }
