"""Package of a robot for MoveIt, of its URDF."""

import os
from collections.abc import Mapping
from pathlib import Path

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.planning.setup_assistant import TRIALS, DescriptionSource, moveit_config, write_moveit_config
from trundle.robots.load_input import load_input
from trundle.robots.packages import Packages

from .scaffold_files import check_name


def write_moveit_package(
    urdf: str,
    name: str,
    parent: Path,
    environment: Mapping[str, str],
    report: Diagnostics,
    *,
    trials: int = TRIALS,
) -> list[Path]:
    """Write a package NAME with groups, kinematics, controllers and launch files; return the paths.

    Args:
        urdf: URDF or xacro: a path, or package://NAME/FILE.
        name: name of the package.
        parent: folder to write to.
        environment: environment variables that locate packages.
        report: collects findings.
        trials: number of random states in which collisions are looked for.

    Raises:
        DescriptionError: the file cannot be read.
        UsageError: no URDF, no arm in it, an invalid name, or a folder that exists or cannot be written.
    """
    check_name(name, is_camel_case=False)
    folder = parent / name
    if os.path.lexists(folder):
        raise UsageError(f"{folder} exists; nothing is written")
    start = Path(urdf) if os.path.isfile(urdf) else Path.cwd()
    packages = Packages(environment, start=start)
    loaded = load_input(urdf, report, packages=packages, start=start)
    if loaded.robot is None or loaded.urdf is None:
        raise UsageError(f"{urdf} is no URDF; MoveIt plans for robots in URDF")
    package, path = _package_path(urdf, packages)
    source = DescriptionSource(robot=loaded.robot, text=loaded.urdf, package=package, path=path)
    texts = moveit_config(source, name, packages=packages, report=report, trials=trials)
    return write_moveit_config(texts, folder)


def _package_path(urdf: str, packages: Packages) -> tuple[str, str]:
    """Return a file's package and its path there; empty: no package contains it."""
    scheme, _, rest = urdf.partition("://")
    if scheme == "package":
        package, _, path = rest.partition("/")
        return package, path
    file = Path(urdf).resolve()
    around = [
        (name, folder.resolve()) for name, folder in packages.ros_packages().items() if folder.resolve() in file.parents
    ]
    if not around:
        return "", ""
    name, folder = max(around, key=lambda found: len(found[1].parts))
    return name, file.relative_to(folder).as_posix()
