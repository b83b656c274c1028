"""The references of commands, elements, plugins, nodes and controllers agree with the code."""

import argparse
import re
import sys
from collections.abc import Iterator
from typing import Any
from xml.etree import ElementTree

import pytest
from tests.docs_blocks import ROOT

from trundle.app.cli.main import COMMANDS, make_parser
from trundle.gazebo.nodes import BUILTIN_NODES
from trundle.gazebo.nodes.catalog import NODELETS
from trundle.gazebo.plugins import BUILTIN, SENSOR_PLUGINS
from trundle.gazebo.plugins.ros_control.catalog import CONTROLLERS

if not (ROOT / "docs/generate").is_dir():
    pytest.skip("the documentation is not part of the sdist", allow_module_level=True)
sys.path.insert(0, str(ROOT / "docs"))

from generate import catalogs, diagnostics, elements, tags
from generate.declarations import Declarations, Endpoint
from generate.element_spec import read_spec

_EXAMPLE = re.compile(r"^```xml\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_NOT_LISTED = {
    *("element_id", "action"),  # of <experimental:params>, which names any element
    *("solver", "dt", "k_velocity"),  # inside an element without effect
    "export",  # of package.xml
}


def _arguments(parser: argparse.ArgumentParser) -> Iterator[tuple[str, argparse.Action]]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for subparser in action.choices.values():
                yield from _arguments(subparser)
        elif action.help != argparse.SUPPRESS:
            yield parser.prog, action


@pytest.mark.parametrize("command", COMMANDS)
def test_every_argument_of_a_command_has_a_meaning(command: str) -> None:
    without = [(program, action.dest) for program, action in _arguments(make_parser(command)) if not action.help]
    assert without == []


def test_the_attributes_of_roslaunch_are_those_of_the_readers() -> None:
    listed = {row.path for row in read_spec("roslaunch") if row.attribute}
    read = tags.read_roslaunch_attributes()
    refused = {f"machine@{name}" for name in ("ros-root", "ros-package-path", "ros-ip", "ros-hostname")}
    refused |= {f"test@{name}" for name in ("output", "respawn", "respawn_delay", "required")}

    assert read - refused == listed - {"launch@deprecated"}  # which its reader asks for alone


def test_the_attributes_of_xacro_are_those_of_its_package() -> None:
    listed = {row.path for row in read_spec("xacro") if row.attribute}

    assert tags.read_xacro_attributes() - listed == set()
    assert {path for path in listed if path.startswith(("xacro:macro@", "xacro:if@", "xacro:include@"))} == {
        path
        for path in tags.read_xacro_attributes()
        if path.startswith(("xacro:macro@", "xacro:if@", "xacro:include@"))
    }


@pytest.mark.parametrize("kind", ["sdf", "urdf"])
def test_what_the_readers_ask_for_is_in_the_reference(kind: str) -> None:
    inventory = elements.read_inventory(elements.HERE / f"every_element.{kind}")
    page = elements.page(kind)
    ignored = {tag for _, tag in inventory.ignored}
    names = {name for table in (inventory.children, inventory.attributes) for row in table.values() for name in row}

    listed = set(re.findall(r"[@/>]([\w:.-]+)(?= @|</code>)", page))
    assert names - ignored - listed - _NOT_LISTED == set()


def test_an_element_is_read_has_no_effect_or_is_not_supported() -> None:
    inventory = elements.read_inventory(elements.HERE / "every_element.sdf")
    rows = {row.path: row for row in read_spec("sdf")}

    def treatment(path: str) -> str:
        return elements.treatment(rows[path], inventory)

    assert treatment("inertial/mass") == "read"
    assert treatment("surface/friction/ode/mu2") == "read"
    assert treatment("surface/contact/ode/soft_cfm") == "no effect"
    assert treatment("model/gripper") == "not supported"


@pytest.mark.parametrize("page", [lambda: elements.page("sdf"), lambda: elements.page("urdf"), tags.roslaunch_page])
def test_examples_of_elements_are_well_formed(page: Any) -> None:
    examples = _EXAMPLE.findall(page())

    assert len(examples) > 8
    for example in examples:
        ElementTree.fromstring(example.replace("<xacro:", "<").replace("</xacro:", "</"))


def test_parameters_topics_and_defaults_come_from_the_calls() -> None:
    declared = Declarations(catalogs.load(BUILTIN["libgazebo_ros_diff_drive.so"]))

    assert declared.parameters["wheelSeparation"][1:] == ("number", "0.34")
    assert declared.parameters["publishWheelTF"][1:] == ("true or false", "false")
    assert declared.parameters["commandTopic"][1:] == ("text", "cmd_vel")
    assert Endpoint("publishes", "joint_states", "sensor_msgs/JointState") in declared.endpoints


def test_settings_that_are_structs_are_listed() -> None:
    declared = Declarations(catalogs.load(BUILTIN_NODES["amcl", "amcl"]))

    assert declared.parameters["min_particles"][1:] == ("integer", "100")
    assert Endpoint("subscribes", "scan", "sensor_msgs/LaserScan") in declared.endpoints


@pytest.mark.slow
def test_every_name_of_a_catalog_is_on_its_page() -> None:
    nodes, plugins, controllers = catalogs.nodes_page(), catalogs.plugins_page(), catalogs.controllers_page()

    assert [f"{p}/{t}" for p, t in BUILTIN_NODES if f"{p}/{t}" not in nodes] == []
    assert [name for name in NODELETS if name not in nodes] == []
    assert [name for name in (*BUILTIN, *SENSOR_PLUGINS) if name not in plugins] == []
    assert [name for name in CONTROLLERS if name not in controllers] == []


@pytest.mark.slow
def test_the_page_of_diagnostics_has_each_id_with_its_messages() -> None:
    page = diagnostics.page()

    assert "### joint-physics { #joint-physics }" in page
    assert "leaves no freedom; rigid" in page.partition("### joint-physics")[2].partition("### ")[0]
