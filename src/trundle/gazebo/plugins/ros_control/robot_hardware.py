"""A robot's own hardware in C++, in place of gazebo_ros_control's default: a RobotHWSim of a user's package."""

import os
from pathlib import Path
from xml.sax.saxutils import escape

from msgspec.structs import replace

from trundle.base.xmlnode import parse_xml
from trundle.robots.model import PluginTag
from trundle.robots.parameters import ParamError
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation

from ..compiled import CompiledPlugins, start_ros
from ._compiled_control import CompiledRobot, kit_folder, open_library
from .exported_class import ExportedClass, exported_classes, library_of
from .hardware import INTERFACE_NUMBERS, JointHardware
from .transmissions import Interface


def find_hardware(kind: str, sim: Simulation, model: ModelHandle) -> ExportedClass | None:
    """Return the class of a <robotSimType> if a package exports it, in a library compiled with the development kit."""
    starts = [Path(model.model.at.file), Path(sim.world.at.file)]
    found = exported_classes("gazebo_ros_control", os.environ, starts).get(kind)
    return None if found is None or found.library is None else found


def load_hardware(
    sim: Simulation, model: ModelHandle, node: Node, tag: PluginTag, found: ExportedClass, *, namespace: str, urdf: str
) -> CompiledRobot:
    """Load a RobotHWSim, and call its initSim.

    Args:
        sim: the simulation.
        model: model that it drives.
        node: node of the plugin.
        tag: element of gazebo_ros_control.
        found: its class.
        namespace: namespace of the robot.
        urdf: robot's description.

    Raises:
        ParamError: it cannot be loaded.
        DescriptionError: its initSim failed.
    """
    try:
        library = open_library(str(library_of(found)))
        start_ros(library, node)
        own = Path(kit_folder(library), f"libgazebo_ros_control{library_of(found).suffix}")
        words = {"class": found.type, "namespace": namespace, "urdf": urdf}
        text = "".join(f"<{name}>{escape(value)}</{name}>" for name, value in words.items())
        element = parse_xml(f"<plugin>{text}</plugin>", name=tag.at.file)
        CompiledPlugins.of(sim).load(own, replace(tag, node=element), model.name, node)
        node.log.info(f"hardware {found.name}: {found.library}, in C++")
        return CompiledRobot.of_model(library, model.name)
    except RuntimeError as error:
        raise ParamError(f"{found.library}: {' '.join(str(error).split())}") from None


def connect_joints(robot: CompiledRobot, model: ModelHandle, *, lag_s: float) -> dict[str, JointHardware]:
    """Return the hardware's joints that the model has, which read and write the hardware's numbers."""
    interfaces: dict[int, Interface] = {number: name for name, number in INTERFACE_NUMBERS.items()}
    joints: dict[str, JointHardware] = {}
    handles = {joint.name: joint for joint in model.joints}
    for name, number in robot.names:
        handle = handles.get(name)
        if handle is not None and handle.is_driven:
            joints[name] = JointHardware(handle, interfaces[number], None, lag_s=lag_s)
            robot.connect(name, joints[name])
    return joints
