"""Reference of the Python API: public names, their docstrings, read by mkdocstrings, and a line of an example each."""

import re
from functools import cache
from pathlib import Path

_DOCS = Path(__file__).parents[1]
_EXAMPLES = ("python.md", "howto/programs.md", "howto/*.md", "start.md")
"""Pages with examples, the first ones first."""
_SHAPES = "add_box add_sphere add_cylinder add_capsule add_mesh"

PUBLIC: dict[str, dict[str, str]] = {
    "Functions": dict.fromkeys(("load", "sweep", "dataset", "read_state_log"), ""),
    "A simulation": {
        "Simulation": "seed report models time_ns time_s step_ns run step reset save restore snapshot "
        "contacts spawn delete rename add_hook remove_hook on_reset on_change post",
        "LoadedSimulation": "camera camera_names sensor sensor_names profile view picture film record plot "
        "ros_master_uri make_node close",
        "SavedSimulation": "",
        "Snapshot": "time_ns poses twists joint_positions joint_velocities joint_efforts axes_of",
        "Contacts": "bodies collisions positions normals forces torques depths among",
        "Contact": "collisions position normal depth force",
        "StrideProfile": "read",
    },
    "Models, links, joints": {
        "ModelHandle": "name model links joints base pose twist set_pose set_twist reset link joint "
        "apply_wrench joint_names joint_positions joint_velocities jacobian mass_matrix bias_forces inverse_dynamics",
        "LinkHandle": "name index is_valid pose twist set_pose set_twist apply_wrench applied_wrench add_wrench",
        "JointHandle": "name index is_valid position velocity effort positions velocities efforts reaction "
        "is_driven set_position set_velocity command_position command_velocity command_effort",
    },
    "Shown, filmed, recorded": {
        "View": "url is_open is_watched is_paused speed real_time_factor sync close",
        "Film": "file frame_count close",
        "Recording": "file close",
        "Plot": "names units times_s save close",
        "StateLog": "links joints sdf times_s poses positions",
    },
    "Cameras and sensors": {
        "CameraHandle": "name size render",
        "CameraImage": "time_ns rgb depth segmentation names mask",
        "SensorHandle": "name type rate_hz read",
        **dict.fromkeys(
            (
                "AltimeterReading",
                "CameraReading",
                "ContactReading",
                "ForceTorqueReading",
                "GpsReading",
                "ImuReading",
                "LogicalCameraReading",
                "MagnetometerReading",
                "PressureReading",
                "RangeReading",
                "RfidReading",
                "SonarReading",
                "WirelessReading",
            ),
            "*",
        ),
    },
    "Poses, twists, wrenches": {
        "Pose": "position quaternion from_rpy inverse transform_point transform_vector rpy as_list",
        "Twist": "linear angular as_list",
        "Wrench": "force torque",
    },
    "Worlds and models built in code": {
        "World": f"add_model add_ground_plane add_light {_SHAPES} to_sdf save",
        "Model": f"add_link add_joint add_plugin {_SHAPES} to_sdf save",
        "Link": f"{_SHAPES} add_sensor set_inertial",
        "Joint": "add_force_torque_sensor",
        **dict.fromkeys(
            (
                "JointAxis",
                "Surface",
                "CameraOptics",
                "Distortion",
                "PixelIntrinsics",
                "Projection",
                "Lens",
                "RangeScan",
                "ScanAxis",
                "ImuNoise",
                "OrientationReference",
                "GpsNoise",
                "ForceTorque",
                "Altimeter",
                "AirPressure",
                "AirSpeed",
                "LogicalCamera",
                "Magnetometer",
                "Sonar",
                "Transceiver",
                "Noise",
            ),
            "*",
        ),
    },
    "Plugins": {
        "Plugin": "period_ns load before_step after_step reset",
        "WorldPlugin": "load",
        "VisualPlugin": "load",
        "PluginTag": "name filename node",
        "TagParameters": "number integer numbers vector flag text texts attribute section sections",
    },
    "Sweeps and data sets": {
        "SweepResult": "folder counts total rate interrupted table done summary",
        "DatasetResult": "folder done total rate failed interrupted summary",
    },
    "Errors and warnings": {
        "TrundleError": "id missing_packages",
        "UsageError": "",
        "DescriptionError": "",
        "MeshError": "",
        "SimulationUnstableError": "",
        "TrundleWarning": "",
        "Diagnostics": "findings warnings errors",
        "Diagnostic": "severity at what id sentence",
        "Source": "file line",
    },
}
"""Section → name in `trundle` → its public members; `*` for all fields."""
_MADE = ("Poses, twists, wrenches", "Worlds and models built in code")
"""Sections whose classes users make; those of the others come from calls, and their constructors are internal."""
PACKAGES: dict[str, str] = {
    "trundle.ros": "Node Publisher Subscription Transform TransformBroadcaster open_bag",
    "trundle.gym": "make make_vec train score JointPositions JointVelocities LinkPose LinkPosition LinkTwist Computed "
    "LidarRanges CameraPicture EffortAction VelocityAction PositionAction TwistAction Task SimulationEnv "
    "SimulationVectorEnv WorldStates MlpPolicy Iteration",
    "trundle.spatial": "quaternion_from_rpy rpy_from_quaternion quaternion_from_axis_angle quaternion_product rotate "
    "slerp compose_rows invert_rows transform_points rotate_vectors matrix_from_quaternion quaternion_from_matrix",
}
"""Package → its public names."""

_INTRO = """# Python API

[From Python](../python.md) shows how these are used, [Six programs](../howto/programs.md) are complete ones.
Lengths are in metres, angles in radians, times in seconds (`…_s`, floats) or nanoseconds (`…_ns`, integers),
quaternions are w x y z; `a_from_b` turns coordinates in b into coordinates in a. Where a pose, a vector or a wrench is
an argument, tuples, lists and arrays are taken, too. All errors that a user can mend are `trundle.TrundleError`.
"""


def page() -> str:
    """Return a heading for each section, and the signature, docstring and an example of each name and member."""
    parts = [_INTRO]
    for title, names in PUBLIC.items():
        parts.append(f"## {title}\n")
        for name, members in names.items():
            made = title in _MADE and name not in ("Link", "Joint")
            parts.append(_directive(f"trundle.{name}", 3, members=members == "*", constructor=made))
            parts.append(_example_block(name))
            for member in () if members == "*" else members.split():
                parts.append(_directive(f"trundle.{name}.{member}", 4))
                parts.append(_example_block(member, is_member=True))
    for package, names in PACKAGES.items():
        parts.append(f"## {package} {{ #{package.replace('.', '-')} }}\n")
        for name in names.split():
            parts.append(_directive(f"{package}.{name}", 3, members=True, constructor=True))
            parts.append(_example_block(name))
    return "\n".join(parts)


def _directive(path: str, level: int, *, members: bool = False, constructor: bool = False) -> str:
    options = {
        "heading_level": level,
        "members": members,
        "merge_init_into_class": constructor,
        "show_bases": False,
    }
    lines = [f"      {option}: {str(value).lower()}" for option, value in options.items()]
    return "\n".join([f"::: {path}", "    options:", *lines, ""])


def _example_block(name: str, *, is_member: bool = False) -> str:
    line = example_of(name, is_member=is_member)
    return f"**Example:**\n\n```python\n{line}\n```\n" if line else ""


def example_of(name: str, *, is_member: bool = False) -> str | None:
    """Return the first line of the documentation's programs that uses a name, or a member of a class."""
    use = re.compile(rf"\.{name}\b|\bdef {name}\b" if is_member else rf"\b{name}\b")
    return next((line for line in _lines() if use.search(line)), None)


@cache
def _lines() -> list[str]:
    """Return the lines of code on the pages with examples."""
    lines: list[str] = []
    for pattern in _EXAMPLES:
        for page in sorted(_DOCS.glob(pattern)):
            text = page.read_text()
            stripped = map(str.strip, text.splitlines())
            lines += [line[4:].strip() for line in stripped if line.startswith((">>> ", "... "))]
            for block in re.findall(r"^```python[^\n]*\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
                lines += [line.strip() for line in block.splitlines() if not line.strip().startswith(("#", '"""'))]
    return [line.partition("  #")[0].rstrip() for line in dict.fromkeys(lines) if line]
