"""<transmission> by the rules of transmission_interface's parser: invalid ones are left out, the others are used."""

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.gazebo.plugins.ros_control.transmissions import DrivenJoint, read_transmissions

TYPE = "<type>transmission_interface/SimpleTransmission</type>"
EFFORT = "<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>"
MOTOR = '<actuator name="m"/>'
LAST = f'<transmission name="last">{TYPE}<joint name="z">{EFFORT}</joint>{MOTOR}</transmission>'


def read(transmission: str, rest: str = "") -> tuple[list[str], list[str]]:
    """Return the driven joints and warnings of a robot with two transmissions."""
    report = Diagnostics()
    joints = read_transmissions(f'<robot name="r">\n{transmission}{LAST}{rest}</robot>', "r", report)
    return [driven.name for driven in joints], report.warnings


@pytest.mark.parametrize(
    ("transmission", "message"),
    [
        (f'<transmission>{TYPE}<joint name="a">{EFFORT}</joint>{MOTOR}</transmission>', "a transmission has no name"),
        (f'<transmission name="">{TYPE}<joint name="a">{EFFORT}</joint>{MOTOR}</transmission>', "has no name"),
        (f'<transmission name="t"><joint name="a">{EFFORT}</joint>{MOTOR}</transmission>', "'t' has no <type>"),
        (f'<transmission name="t"><type/><joint name="a">{EFFORT}</joint>{MOTOR}</transmission>', "has no <type>"),
        (f'<transmission name="t">{TYPE}{MOTOR}</transmission>', "'t' has no <joint>"),
        (f'<transmission name="t">{TYPE}<joint name="a">{EFFORT}</joint></transmission>', "'t' has no <actuator>"),
        (f'<transmission name="t">{TYPE}<joint name="a">{EFFORT}</joint><actuator/></transmission>', "without a name"),
        (
            f'<transmission name="t">{TYPE}<joint>{EFFORT}</joint><joint name="a">{EFFORT}</joint>{MOTOR}'
            "</transmission>",
            "'t' has a <joint> without a name",
        ),
        (f'<transmission name="t">{TYPE}<joint name="a"/>{MOTOR}</transmission>', "has no <hardwareInterface>"),
        (
            f'<transmission name="t">{TYPE}<joint name="a"><hardwareInterface/></joint>{MOTOR}</transmission>',
            "has no <hardwareInterface>",
        ),
        (
            f'<transmission name="t">{TYPE}<joint name="a">{EFFORT}</joint><joint name="b">{EFFORT}</joint>{MOTOR}'
            "</transmission>",
            "'t' has 2 joints, but gazebo_ros_control drives one joint per transmission",
        ),
    ],
)
def test_a_transmission_that_the_parser_drops_is_left_out(transmission: str, message: str) -> None:
    joints, (warning,) = read(transmission)

    assert joints == ["z"]
    assert warning.startswith("r:2: warning: ")
    assert message in warning
    assert warning.endswith("; it is left out")


def test_hardware_of_a_robots_own_drives_each_joint_of_a_differential() -> None:
    wrist = f'<joint name="a">{EFFORT}</joint><joint name="b">{EFFORT}</joint>{MOTOR}'
    kind = "<type>transmission_interface/DifferentialTransmission</type>"
    report = Diagnostics()
    urdf = f'<robot name="r"><transmission name="wrist">{kind}{wrist}</transmission>{LAST}</robot>'

    joints = read_transmissions(urdf, "r", report, drives_groups=True)

    assert joints == [DrivenJoint(name, "EffortJointInterface") for name in ("a", "b", "z")]
    assert report.warnings == []


def test_a_joint_with_an_empty_name_is_left_out_alone() -> None:
    joints, (warning,) = read(
        f'<transmission name="t">{TYPE}<joint name="">{EFFORT}</joint><joint name="a">{EFFORT}</joint>{MOTOR}'
        "</transmission>"
    )

    assert joints == ["a", "z"]
    assert "the name is empty" in warning


def test_a_joint_without_an_interface_does_not_count_as_a_second_joint() -> None:
    joints, (warning,) = read(
        f'<transmission name="t">{TYPE}<joint name="a">{EFFORT}</joint><joint name="b"/>{MOTOR}</transmission>'
    )

    assert joints == ["a", "z"]
    assert "joint 'b' has no <hardwareInterface>" in warning


def test_unknown_elements_and_a_second_interface_are_no_fault() -> None:
    second = "<hardwareInterface>VelocityJointInterface</hardwareInterface>"
    report = Diagnostics()
    text = (
        f'<robot name="r"><transmission name="t">{TYPE}<motorTorqueConstant>1</motorTorqueConstant>'
        f'<joint name="a"><role>x</role>{EFFORT}{second}</joint>{MOTOR}<!-- -- --><leverArm/></transmission></robot>'
    )

    assert read_transmissions(text, "r", report) == [DrivenJoint("a", "EffortJointInterface")]
    syntax, interfaces = report.warnings
    assert "'--' within a comment (column " in syntax
    assert interfaces.endswith("has 2 <hardwareInterface> elements; the first one is used")


def test_malformed_xml_is_refused() -> None:
    with pytest.raises(DescriptionError, match="not well-formed XML"):
        read("", rest="<joint>")
