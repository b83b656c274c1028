"""Package NAME_moveit_config of a robot, with the files of MoveIt's setup assistant."""

import os
import re
from collections.abc import Mapping
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

from msgspec import Struct

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.base.xmlnode import parse_xml
from trundle.planning.robot_model import robot_model, write_srdf
from trundle.robots.packages import Packages
from trundle.robots.robot import Robot

from .collision_pairs import TRIALS, find_disabled_pairs
from .configuration import Interface, configuration, controller_names
from .group_finder import find_groups
from .semantics import semantics

_TEMPLATES = Path(__file__).with_name("templates")
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_LAUNCH = (
    "demo.launch",
    "demo_gazebo.launch",
    "gazebo.launch",
    "gdb_settings.gdb",
    "fake_moveit_controller_manager.launch.xml",
    "move_group.launch",
    "moveit.rviz",
    "moveit_planning_execution.launch",
    "moveit_rviz.launch",
    "ompl_planning_pipeline.launch.xml",
    "planning_context.launch",
    "planning_pipeline.launch.xml",
    "ros_control_moveit_controller_manager.launch.xml",
    "ros_controllers.launch",
    "sensor_manager.launch.xml",
    "simple_moveit_controller_manager.launch.xml",
    "trajectory_execution.launch.xml",
)
_RENAMED = {
    "pilz_industrial_motion_planner_planning_pipeline.launch.xml": "pilz_planning_pipeline.launch.xml",
    "@NAME@_moveit_sensor_manager.launch.xml": "robot_sensor_manager.launch.xml",
}
_INTERFACES: dict[str, Interface] = {
    "EffortJointInterface": "effort",
    "VelocityJointInterface": "velocity",
    "PositionJointInterface": "position",
}


class DescriptionSource(Struct, frozen=True, kw_only=True):
    """Robot's description."""

    robot: Robot
    text: str
    """URDF, expanded."""
    package: str = ""
    """ROS package of its file; empty: the package of the configuration gets a copy."""
    path: str = ""
    """Path of its file in the package, with /."""

    @property
    def is_xacro(self) -> bool:
        """True if the file has to be expanded."""
        return self.path.endswith(".xacro")


def moveit_config(
    source: DescriptionSource,
    package: str,
    *,
    packages: Packages | None = None,
    report: Diagnostics,
    trials: int = TRIALS,
) -> dict[str, str]:
    """Return path → text of a package.

    Args:
        source: robot.
        package: name of the package.
        packages: finds meshes, for collisions.
        report: collects findings.
        trials: number of random states in which collisions are looked for.

    Raises:
        UsageError: no arm was found, or a name that launch files cannot hold.
    """
    bare = robot_model(source.robot, None, None, report)
    found = find_groups(bare)
    if not found.arms:
        moving = ", ".join(repr(joint.name) for joint in bare.joints if joint.variables) or "none"
        raise UsageError(f"robot {bare.name!r} has no arm, a chain of three or more joints; joints that move: {moving}")
    disabled = find_disabled_pairs(bare, packages=packages, report=report, trials=trials)
    srdf = semantics(bare, found, disabled)
    model = robot_model(source.robot, srdf, None, report)
    name = bare.name if _NAME.fullmatch(bare.name) else re.sub(r"[^A-Za-z0-9_-]", "_", f"robot_{bare.name}")
    _refuse_substitution(bare.root_link, source.path)
    loaded = _loaded(source, package, name)
    values = {
        "@PACKAGE@": package,
        "@NAME@": name,
        "@ROBOT_TEXT@": escape(bare.name),
        "@ROOT@": model.model_frame if model.joints[0].variables else bare.root_link,
        "@ARM@": found.arms[0].name,
        "@DESCRIPTION@": f'<param if="$(arg load_robot_description)" name="$(arg robot_description)" {loaded}/>',
        "@GAZEBO_DESCRIPTION@": f'<param name="robot_description" {loaded}/>',
        "@CONTROLLERS@": " ".join(controller_names(srdf)),
        "@TRANSFORM@": _transform(bare.root_link, [joint.type for joint in srdf.virtual_joints]),
        "@DEPENDS@": f"  <exec_depend>{source.package}</exec_depend>\n" if source.package else "",
    }
    files = {
        "package.xml": "package.xml",
        "CMakeLists.txt": "CMakeLists.txt",
        **{f"launch/{name}": name for name in _LAUNCH},
        **{f"launch/{name}": template for name, template in _RENAMED.items()},
    }
    texts = {_filled(path, values): _filled(_template(template), values) for path, template in files.items()}
    texts[f"config/{name}.srdf"] = write_srdf(srdf)
    texts.update({f"config/{file}": text for file, text in configuration(model, srdf, _interface(source)).items()})
    if not source.package:
        texts[f"config/{name}.urdf"] = source.text
    texts[".setup_assistant"] = _setup_assistant(source, package, name)
    return texts


def write_moveit_config(texts: Mapping[str, str], folder: Path) -> list[Path]:
    """Write a package; return the paths.

    Raises:
        UsageError: the folder exists or cannot be written; then nothing is written.
    """
    if os.path.lexists(folder):
        raise UsageError(f"{folder} exists; nothing is written")
    try:
        for path, text in texts.items():
            file = folder / path
            file.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(file, text, replace=False)
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None
    return [folder / path for path in texts]


def _template(name: str) -> str:
    return (_TEMPLATES / f"{name}.in").read_text(encoding="utf-8")


def _filled(text: str, values: Mapping[str, str]) -> str:
    for variable, value in values.items():
        text = text.replace(variable, value)
    return text


def _refuse_substitution(*names: str) -> None:
    """Refuse names that roslaunch would substitute, or that would end an attribute."""
    for name in names:
        if "$(" in name or "'" in name or '"' in name:
            raise UsageError(f"{name!r} cannot be in a launch file, whose $(…) and quotes have a meaning")


def _loaded(source: DescriptionSource, package: str, name: str) -> str:
    """Return the attribute of a <param> that loads the URDF."""
    if not source.package:
        return f'textfile="$(find {package})/config/{name}.urdf"'
    file = f"$(find {source.package})/{source.path}"
    quoted = quoteattr(f"xacro '{file}'")
    return f"command={quoted}" if source.is_xacro else f"textfile={quoteattr(file)}"


def _transform(root: str, virtual: list[str]) -> str:
    """Return the node that holds the root link in the world, where it is fixed there."""
    if virtual != ["fixed"]:
        return ""
    args = quoteattr(f"0 0 0 0 0 0 world {root}")
    return (
        '  <node name="virtual_joint_broadcaster_0" pkg="tf2_ros" type="static_transform_publisher"\n'
        f"        args={args}/>\n"
    )


def _interface(source: DescriptionSource) -> Interface:
    """Return what the first <transmission> commands; position without any."""
    root = parse_xml(source.text, name=source.robot.at.file)
    for transmission in root.all("transmission"):
        for joint in transmission.all("joint"):
            for node in joint.all("hardwareInterface"):
                name = node.text.rpartition("/")[2]
                if name in _INTERFACES:
                    return _INTERFACES[name]
    return "position"


def _setup_assistant(source: DescriptionSource, package: str, name: str) -> str:
    """Return the file by which MoveIt's setup assistant opens the package again."""
    return f"""moveit_setup_assistant_config:
  URDF:
    package: {source.package or package}
    relative_path: {source.path or f"config/{name}.urdf"}
    xacro_args: ""
  SRDF:
    relative_path: config/{name}.srdf
  CONFIG:
    author_name: You
    author_email: you@example.com
    generated_timestamp: 0
"""
