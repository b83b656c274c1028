"""Finder of the plugin of a <plugin filename="…">.

Searched in this order: a library that was compiled with the development kit; Trundle's own by Gazebo's file name;
installed ones (entry points of the group "trundle.plugins", named by file name); a user's Python file: `librp2w.so`
means `rp2w.py` beside the model, else on TRUNDLE_PLUGIN_PATH, else on GAZEBO_PLUGIN_PATH.
"""

import importlib
import importlib.util
import os
import sys
from collections.abc import Callable, Mapping
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any, TypeVar, cast

from trundle.base.diagnostics import DescriptionError, Source
from trundle.robots.model import PluginTag
from trundle.robots.packages import HELD_SUFFIX
from trundle.robots.parameters import TagParameters

from .compiled.library import foreign_library, plugin_library
from .gazebo_ros.namespaces import WITHOUT_EFFECT
from .plugin import Hooks, Plugin, VisualPlugin, WorldPlugin

if TYPE_CHECKING:
    from importlib.metadata import EntryPoints

    from .gazebo_ros.plugin_names import PluginNames

BUILTIN: dict[str, str] = {
    "libActorPlugin.so": "trundle.gazebo.plugins.gazebo.actor:WanderingActor",
    "libBuoyancyPlugin.so": "trundle.gazebo.plugins.gazebo.buoyancy:Buoyancy",
    "libDiffDrivePlugin.so": "trundle.gazebo.plugins.gazebo.diff_drive:DiffDrive",
    "libHarnessPlugin.so": "trundle.gazebo.plugins.gazebo.harness:Harness",
    "libInitialVelocityPlugin.so": "trundle.gazebo.plugins.gazebo.initial_velocity:InitialVelocity",
    "libJointControlPlugin.so": "trundle.gazebo.plugins.gazebo.joint_control:JointControl",
    "libJointTrajectoryPlugin.so": "trundle.gazebo.plugins.gazebo.joint_trajectory:JointTrajectory",
    "libKeysToCmdVelPlugin.so": "trundle.gazebo.plugins.gazebo.keys_to_cmd_vel:KeysToCmdVel",
    "libKeysToJointsPlugin.so": "trundle.gazebo.plugins.gazebo.keys_to_joints:KeysToJoints",
    "libLiftDragPlugin.so": "trundle.gazebo.plugins.gazebo.lift_drag:LiftDrag",
    "libLinkPlot3DPlugin.so": "trundle.gazebo.plugins.gazebo.link_plot_3d:LinkPlot3D",
    "libRandomVelocityPlugin.so": "trundle.gazebo.plugins.gazebo.random_velocity:RandomVelocity",
    "libSimpleTrackedVehiclePlugin.so": "trundle.gazebo.plugins.gazebo.simple_tracked_vehicle:SimpleTrackedVehicle",
    "libSkidSteerDrivePlugin.so": "trundle.gazebo.plugins.gazebo.skid_steer_drive:SkidSteerDrive",
    "libWheelSlipPlugin.so": "trundle.gazebo.plugins.gazebo.wheel_slip:WheelSlip",
    "libWheelTrackedVehiclePlugin.so": "trundle.gazebo.plugins.gazebo.wheel_tracked_vehicle:WheelTrackedVehicle",
    "libWindPlugin.so": "trundle.gazebo.plugins.gazebo.wind:Wind",
    "libfetch_gazebo_plugin.so": "trundle.gazebo.plugins.fetch:FetchGazebo",
    "libgazebo_grasp_fix.so": "trundle.gazebo.plugins.grasp_fix:GraspFix",
    "libgazebo_mimic_joint_plugin.so": "trundle.gazebo.plugins.mimic_joint:MimicJoint",
    "libgazebo_ros_control.so": "trundle.gazebo.plugins.ros_control:GazeboRosControl",
    "libgazebo_ros_diff_drive.so": "trundle.gazebo.plugins.gazebo_ros.diff_drive:DiffDrive",
    "libgazebo_ros_f3d.so": "trundle.gazebo.plugins.gazebo_ros.f3d:F3D",
    "libgazebo_ros_force.so": "trundle.gazebo.plugins.gazebo_ros.force:Force",
    "libgazebo_ros_force_based_move.so": "trundle.gazebo.plugins.hector_gazebo.force_based_move:ForceBasedMove",
    "libgazebo_ros_ft_sensor.so": "trundle.gazebo.plugins.gazebo_ros.ft_sensor:FtSensor",
    "libgazebo_ros_imu.so": "trundle.gazebo.plugins.gazebo_ros.imu:Imu",
    "libgazebo_ros_joint_pose_trajectory.so": (
        "trundle.gazebo.plugins.gazebo_ros.joint_pose_trajectory:JointPoseTrajectory"
    ),
    "libgazebo_ros_joint_state_publisher.so": (
        "trundle.gazebo.plugins.gazebo_ros.joint_state_publisher:JointStatePublisher"
    ),
    "libgazebo_ros_kobuki.so": "trundle.gazebo.plugins.kobuki:Kobuki",
    "libgazebo_ros_link_attacher.so": "trundle.gazebo.plugins.link_attacher:LinkAttacher",
    "libgazebo_ros_p3d.so": "trundle.gazebo.plugins.gazebo_ros.p3d:P3D",
    "libgazebo_ros_planar_move.so": "trundle.gazebo.plugins.gazebo_ros.planar_move:PlanarMove",
    "libgazebo_ros_skid_steer_drive.so": "trundle.gazebo.plugins.gazebo_ros.skid_steer_drive:SkidSteerDrive",
    "libgazebo_ros_tricycle_drive.so": "trundle.gazebo.plugins.gazebo_ros.tricycle_drive:TricycleDrive",
    "libgazebo_ros_vacuum_gripper.so": "trundle.gazebo.plugins.gazebo_ros.vacuum_gripper:VacuumGripper",
    "libgazebo_ros_wheel_slip.so": "trundle.gazebo.plugins.gazebo_ros.wheel_slip:RosWheelSlip",
    "libhector_gazebo_ros_baro.so": "trundle.gazebo.plugins.hector_gazebo.baro:Baro",
    "libhector_gazebo_ros_gps.so": "trundle.gazebo.plugins.hector_gazebo.gps:Gps",
    "libhector_gazebo_ros_imu.so": "trundle.gazebo.plugins.hector_gazebo.imu:Imu",
    "libhector_gazebo_ros_magnetic.so": "trundle.gazebo.plugins.hector_gazebo.magnetic:Magnetic",
    "librealsense_gazebo_plugin.so": "trundle.gazebo.plugins.realsense:RealSense",
    "libridgeback_ros_force_based_move.so": "trundle.gazebo.plugins.ridgeback_force_based_move:RidgebackForceBasedMove",
    "libroboticsgroup_gazebo_mimic_joint_plugin.so": "trundle.gazebo.plugins.mimic_joint:MimicJoint",
    "libroboticsgroup_upatras_gazebo_mimic_joint_plugin.so": "trundle.gazebo.plugins.mimic_joint:MimicJoint",
    "librobotnik_force_based_move.so": "trundle.gazebo.plugins.robotnik_force_based_move:RobotnikForceBasedMove",
    "librotors_gazebo_controller_interface.so": "trundle.gazebo.plugins.rotors.interfaces:ControllerInterface",
    "librotors_gazebo_imu_plugin.so": "trundle.gazebo.plugins.rotors.imu:Imu",
    "librotors_gazebo_motor_model.so": "trundle.gazebo.plugins.rotors.motor_model:MotorModel",
    "librotors_gazebo_multirotor_base_plugin.so": "trundle.gazebo.plugins.rotors.multirotor_base:MultirotorBase",
    "librotors_gazebo_odometry_plugin.so": "trundle.gazebo.plugins.rotors.odometry:Odometry",
    "librotors_gazebo_ros_interface_plugin.so": "trundle.gazebo.plugins.rotors.interfaces:GazeboRosInterface",
    "libunitreeDrawForcePlugin.so": "trundle.gazebo.plugins.unitree.draw_force:DrawForce",
    "libwarthog_suspension_plugin.so": "trundle.gazebo.plugins.warthog_suspension:WarthogSuspension",
}
"""File name → "module:Class", imported on use."""

_SENSORS = "trundle.gazebo.plugins.gazebo_ros"
SENSOR_PLUGINS: dict[str, str] = {
    "libgazebo_ros_block_laser.so": f"{_SENSORS}.block_laser:attach",
    "libgazebo_ros_bumper.so": f"{_SENSORS}.bumper:attach",
    "libgazebo_ros_camera.so": f"{_SENSORS}.camera:attach",
    "libgazebo_ros_depth_camera.so": f"{_SENSORS}.depth_camera:attach_depth_camera",
    "libgazebo_ros_gpu_laser.so": f"{_SENSORS}.laser:attach",
    "libgazebo_ros_imu_sensor.so": f"{_SENSORS}.imu_sensor:attach",
    "libgazebo_ros_laser.so": f"{_SENSORS}.laser:attach",
    "libgazebo_ros_multicamera.so": f"{_SENSORS}.camera:attach",
    "libgazebo_ros_openni_kinect.so": f"{_SENSORS}.depth_camera:attach",
    "libgazebo_ros_range.so": f"{_SENSORS}.range:attach",
    "libgazebo_ros_ray_sensor.so": f"{_SENSORS}.laser:attach_ray_sensor",
    "libgazebo_ros_thermal_camera.so": "trundle.gazebo.plugins.hector_gazebo.thermal:attach",
    "libgazebo_ros_triggered_camera.so": f"{_SENSORS}.camera:attach_triggered",
    "libgazebo_ros_triggered_multicamera.so": f"{_SENSORS}.camera:attach_triggered",
    "libgazebo_ros_velodyne_gpu_laser.so": f"{_SENSORS}.velodyne_laser:attach",
    "libgazebo_ros_velodyne_laser.so": f"{_SENSORS}.velodyne_laser:attach",
    "libhector_gazebo_ros_sonar.so": "trundle.gazebo.plugins.hector_gazebo.sonar:attach",
    "libunitreeFootContactPlugin.so": "trundle.gazebo.plugins.unitree.foot_contact:attach",
}
"""File name → "module:function" of sensor plugins, which publish a sensor's readings."""

_MODEL_SENSOR_PLUGINS = {"librealsense_gazebo_plugin.so": "trundle.gazebo.plugins.realsense:find_attach"}
"""File name → "module:function" of model plugins that publish the readings of the model's sensors."""

_COSMETIC = frozenset(
    {
        "libAmbientOcclusionVisualPlugin.so",
        "libBlinkVisualPlugin.so",
        "libHeightmapLODPlugin.so",
        "libReflectancePlugin.so",
        "libShaderParamVisualPlugin.so",
        "libgazebo_ros_video.so",
    }
)
"""Visual plugins of Gazebo that change only how a visual is drawn."""

GROUP = "trundle.plugins"

_OWNERS: dict[type[Hooks], str] = {Plugin: "model", VisualPlugin: "visual", WorldPlugin: "world"}
_Kind = TypeVar("_Kind", bound=Hooks)


def find_plugin(tag: PluginTag, environment: Mapping[str, str]) -> tuple[type[Plugin], str]:
    """Return the class of a model's plugin, and its origin for messages.

    Raises:
        DescriptionError: not found, with the folders searched; or the user's file does not load, with its line.
    """
    return _find(tag, environment, Plugin)


def find_visual_plugin(tag: PluginTag, environment: Mapping[str, str]) -> tuple[type[VisualPlugin], str]:
    """Return the class of a visual's plugin and its origin; see `find_plugin`."""
    return _find(tag, environment, VisualPlugin)


def require_plugin(tag: PluginTag, environment: Mapping[str, str]) -> None:
    """Look for the plugin of a model, a visual or the world, and load nothing.

    Raises:
        DescriptionError: not found, with the folders searched.
    """
    filename = _base_name(tag)
    if filename not in BUILTIN and not _entry_points(filename) and plugin_library(tag, environment) is None:
        _python_file(tag, environment)


def find_user_file(tag: PluginTag, environment: Mapping[str, str]) -> Path | None:
    """Return the user's file that a plugin would run, a library or Python; None for Trundle's, installed and missing
    ones.
    """
    if (library := plugin_library(tag, environment)) is not None:
        return library
    if _base_name(tag) in BUILTIN or _entry_points(_base_name(tag)):
        return None
    try:
        return _python_file(tag, environment)
    except DescriptionError:
        return None


def find_held_file(tag: PluginTag, environment: Mapping[str, str]) -> Path | None:
    """Return the uploaded code file that a plugin would run once a user approves it; None: no such file."""
    if _base_name(tag) in BUILTIN or _entry_points(_base_name(tag)):
        return None
    name = f"{python_file_name(_base_name(tag))}{HELD_SUFFIX}"
    return next((file for folder in _folders(tag, environment) if (file := folder / name).is_file()), None)


def is_cosmetic(tag: PluginTag, environment: Mapping[str, str]) -> bool:
    """True for Gazebo's visual plugins that change only how a visual is drawn; Trundle runs those that are compiled."""
    return _base_name(tag) in _COSMETIC and plugin_library(tag, environment) is None


def find_world_plugin(tag: PluginTag, environment: Mapping[str, str]) -> tuple[type[WorldPlugin], str]:
    """Return the class of a world's plugin and its origin; see `find_plugin`."""
    return _find(tag, environment, WorldPlugin)


def is_sensor_plugin(tag: PluginTag, environment: Mapping[str, str]) -> bool:
    """True if the plugin is Trundle's, or in a compiled library; loads nothing."""
    return _base_name(tag) in SENSOR_PLUGINS or plugin_library(tag, environment) is not None


def find_sensor_plugin(tag: PluginTag) -> "Callable[[Any, TagParameters, PluginNames], None] | None":
    """Return the function that publishes a sensor's readings as its plugin does; None: no such plugin."""
    target = SENSOR_PLUGINS.get(_base_name(tag))
    if target is None:
        return None
    publish = _import_object(target)

    def attach(sensor: Any, parameters: TagParameters, names: "PluginNames") -> None:
        publish(sensor, parameters, names)
        parameters.ignore(*WITHOUT_EFFECT)
        parameters.report_unread()

    return attach


def find_model_sensor_plugin(tag: PluginTag, sensor: str) -> "Callable[[Any, TagParameters, PluginNames], None] | None":
    """Return the function by which a model's plugin publishes a sensor's readings; None: it does not publish them."""
    target = _MODEL_SENSOR_PLUGINS.get(_base_name(tag))
    return None if target is None else _import_object(target)(tag, sensor)


def _base_name(tag: PluginTag) -> str:
    return PurePosixPath(tag.filename.replace("\\", "/")).name


def _find(tag: PluginTag, environment: Mapping[str, str], kind: type[_Kind]) -> tuple[type[_Kind], str]:
    filename = _base_name(tag)
    library = plugin_library(tag, environment)
    if library is not None:
        return _compiled_class(library, kind), f"{library}, in C++"
    if filename in BUILTIN:
        return _check_kind(_import_object(BUILTIN[filename]), kind, tag), f"Trundle's own {filename}"
    for entry_point in _entry_points(filename):
        package = entry_point.dist.name if entry_point.dist else "installed"
        return _check_kind(entry_point.load(), kind, tag), f"{entry_point.value} ({package})"
    path = _python_file(tag, environment)
    return _load_file(path, kind), str(path)


def _compiled_class(library: Path, kind: type[_Kind]) -> type[_Kind]:
    from . import compiled  # lazy: most robots have none

    if issubclass(kind, WorldPlugin):
        found = compiled.compiled_world_plugin(library)
    elif issubclass(kind, VisualPlugin):
        found = compiled.compiled_visual_plugin(library)
    else:
        found = compiled.compiled_model_plugin(library)
    assert issubclass(found, kind)
    return cast("type[_Kind]", found)


def _entry_points(filename: str) -> "EntryPoints":
    from importlib.metadata import entry_points  # slow to load, and most robots have only plugins of Trundle

    return entry_points(group=GROUP, name=filename)


def _python_file(tag: PluginTag, environment: Mapping[str, str]) -> Path:
    """Return the user's Python file of a plugin that is neither Trundle's nor installed."""
    filename = _base_name(tag)
    folders = _folders(tag, environment)
    for folder in folders:
        path = folder / python_file_name(filename)
        if os.path.isfile(path):
            return path
    if filename in SENSOR_PLUGINS:
        raise _misplaced(tag, "sensor")
    missing = (
        f"plugin {tag.name!r}: no {filename}{_foreign_hint(tag, environment)}; Trundle runs C++ of its kit and Python"
    )
    if "ros2_control" in filename:
        raise DescriptionError(
            tag.at,
            f"plugin {tag.name!r}: {filename} is ROS 2's; ROS 1's is libgazebo_ros_control.so, with <transmission>",
            "ros2-plugin",
        )
    searched = f"looked for {python_file_name(filename)} in {', '.join(map(str, folders))}"
    raise DescriptionError(tag.at, f"{missing}: {searched}{_compiled_hint(tag, environment)}", "missing-plugin")


def _foreign_hint(tag: PluginTag, environment: Mapping[str, str]) -> str:
    library = foreign_library(tag, environment)
    return "" if library is None else f" ({library} is for Gazebo itself: compile it again in `trundle shell`)"


def _compiled_hint(tag: PluginTag, environment: Mapping[str, str]) -> str:
    from .cpp_hint import compiled_plugin  # lazy: only for what is missing

    return compiled_plugin(_base_name(tag), Path(tag.at.file), environment)


def _check_kind(plugin_class: type[Hooks], kind: type[_Kind], tag: PluginTag) -> type[_Kind]:
    if not issubclass(plugin_class, kind):
        raise _misplaced(tag, next(name for base, name in _OWNERS.items() if issubclass(plugin_class, base)))
    return plugin_class


def _misplaced(tag: PluginTag, owner: str) -> DescriptionError:
    message = f"plugin {tag.name!r} ({tag.filename}) is a {owner}'s; it belongs into a <{owner}>"
    return DescriptionError(tag.at, message, "misplaced-plugin")


def python_file_name(filename: str) -> str:
    """`librp2w.so` → `rp2w.py`, the file name of a user's Python plugin that replaces it."""
    stem = PurePosixPath(filename).stem
    if filename.endswith(".so"):
        stem = stem.removeprefix("lib")
    return f"{stem}.py"


def _folders(tag: PluginTag, environment: Mapping[str, str]) -> list[Path]:
    folders = [Path(tag.at.file).resolve().parent]
    for variable in ("TRUNDLE_PLUGIN_PATH", "GAZEBO_PLUGIN_PATH"):
        folders += [Path(entry) for entry in environment.get(variable, "").split(os.pathsep) if entry]
    return folders


def _import_object(path: str) -> Any:
    module, _, name = path.partition(":")
    return getattr(importlib.import_module(module), name)


def _load_file(path: Path, kind: type[_Kind]) -> type[_Kind]:
    name = f"trundle_plugin_{path.stem}_{abs(hash(path))}"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None, path
    assert spec.loader is not None, path
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses and pickle look the module up
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        raise DescriptionError(
            _error_source(path, error), f"plugin not loaded: {describe(error)}", "plugin-file"
        ) from error
    classes = [
        value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, kind) and value.__module__ == name
    ]
    if len(classes) != 1:
        names = ", ".join(repr(c.__name__) for c in classes) or "none"
        raise DescriptionError(
            Source(str(path)), f"a plugin file defines one subclass of {kind.__name__}; here: {names}", "plugin-file"
        )
    return classes[0]


def describe(error: Exception) -> str:
    """Type and text of an exception."""
    return f"{type(error).__name__}: {error}"


def _error_source(path: Path, error: Exception) -> Source:
    """Return the deepest line of the user's file in the traceback."""
    if isinstance(error, SyntaxError):
        return Source(str(path), error.lineno)
    line: int | None = None
    trace = error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(path):
            line = trace.tb_lineno
        trace = trace.tb_next
    return Source(str(path), line)
