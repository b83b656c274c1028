"""Reference of the Python API: the public names by package; mkdocstrings reads their docstrings."""

PUBLIC: dict[str, tuple[str, ...]] = {
    "trundle": ("load",),
    "trundle.sim.simulation": (
        "Simulation",
        "ModelHandle",
        "LinkHandle",
        "JointHandle",
        "Snapshot",
        "BeforeStep",
        "AfterStep",
        "SavedSimulation",
        "StateLog",
        "read_state_log",
    ),
    "trundle.spatial": ("Pose", "Twist", "Wrench"),
    "trundle.base.diagnostics": (
        "TrundleError",
        "UsageError",
        "DescriptionError",
        "Diagnostics",
        "Diagnostic",
        "Source",
    ),
    "trundle.gazebo.plugins": ("Plugin", "WorldPlugin", "VisualPlugin", "Hooks"),
    "trundle.robots.parameters": ("TagParameters", "Parameters"),
    "trundle.robots.model": ("World", "Model", "Link", "Joint", "JointAxis", "Inertial", "Surface", "Sensor"),
    "trundle.sim.physics": ("Contact", "SimulationUnstableError"),
    "trundle.ros": ("Node", "Publisher", "Subscription", "Transform", "TransformBroadcaster"),
}
"""Package → names."""

_INTRO = """# Python API

[From Python](../python.md) shows how these are used.
Lengths are in metres, angles in radians, quaternions are w x y z;
`a_from_b` turns coordinates in b into coordinates in a.
"""


def page() -> str:
    """Return a heading for each package, and the docstrings of its public names."""
    parts = [_INTRO]
    for package, names in PUBLIC.items():
        parts.append(f"## {package} {{ #{package.replace('.', '-')} }}\n")
        parts += [f"::: {package}.{name}\n    options:\n      heading_level: 3\n" for name in names]
    return "\n".join(parts)
