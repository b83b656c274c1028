"""Reader selection for a file, folder or URI."""

import os
import re
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from urllib.parse import unquote

from trundle.base.diagnostics import (
    DescriptionError,
    Diagnostics,
    Source,
    UnknownArgumentError,
    did_you_mean,
    similar_file,
)
from trundle.base.files import is_stream, read_stream, read_text
from trundle.base.xmlnode import ReadBudget, XmlNode, parse_xml, read_xml
from trundle.robots.model import Model
from trundle.robots.packages import Packages, model_file, refuse_ros2, refuse_ros2_language, refuse_template

from .loaded import LoadedDescription
from .sdf import DEEPEST

# Each reader is imported on first use.
_XACRO = "<xacro:"
"""Marker of an unexpanded file; many expanded files keep the namespace, but not this."""
_INDIGO = re.compile(
    r"<(?:include\b[^<>]*\bfilename|(?:property|macro|insert_block)\b[^<>]*\bname|if\b[^<>]*\bvalue)\s*="
)
"""Tags of Indigo's xacro, which had no prefix."""


def load(
    source: str,
    report: Diagnostics,
    *,
    packages: Packages,
    seed: int = 0,
    arguments: Mapping[str, str] = MappingProxyType({}),
) -> LoadedDescription:
    """Read a description: SDF, URDF or xacro.

    Args:
        source: path, folder with model.config, model://NAME, package://NAME/FILE, or the name of a world, such as
            empty.world; relative URIs in a pipe start in the working directory.
        report: receives warnings and notes.
        packages: resolves URIs.
        seed: seed of random placement in SDF.
        arguments: xacro arguments.

    Raises:
        DescriptionError: the description cannot be interpreted.
        UnknownArgumentError: the file has no such argument.
        UsageError: no such model.
    """
    loaded = _load(_find(source, packages), report, packages=packages, seed=seed, arguments=arguments)
    packages.warn_of_finds(report, Source(source))
    return loaded


def _load(
    path: Path, report: Diagnostics, *, packages: Packages, seed: int, arguments: Mapping[str, str]
) -> LoadedDescription:
    if is_stream(path):
        return _load_stream(path, report, packages=packages, seed=seed)
    if os.path.isdir(path):
        path = model_file(path, report)
    refuse_template(path)
    refuse_ros2_language(path, is_launch=False)
    packages = packages.around(path)
    if path.suffix == ".xacro":
        text = _expanded(path, packages, report, arguments=arguments)
        return load_urdf(text, f"{path} (expanded)", path, packages, report)
    root = read_xml(path, report=report, max_depth=DEEPEST)
    text = read_text(path) if root.tag == "robot" else ""
    is_xacro = "xmlns:xacro" in text
    if arguments and not is_xacro:
        message = f"not a xacro file, it has no arguments: {', '.join(arguments)}"
        raise UnknownArgumentError(Source(str(path)), message, "unknown-argument", name=next(iter(arguments)))
    if root.tag == "robot":
        if is_xacro:
            text = _expanded(path, packages, report, arguments=arguments)
        return load_urdf(text, str(path), path, packages, report)
    budget = ReadBudget()
    budget.add_file(path, os.stat(path).st_size, root.at)
    return load_sdf(root, path, packages, report, seed=seed, budget=budget)


def _load_stream(path: Path, report: Diagnostics, *, packages: Packages, seed: int) -> LoadedDescription:
    name = "<stdin>" if path.name == "stdin" else "<pipe>"
    try:
        data = read_stream(path)
    except OSError as error:
        raise DescriptionError(Source(str(path)), f"cannot be read: {error.strerror}", "unreadable-file") from None
    return load_text(data, name=name, folder=Path.cwd(), packages=packages, report=report, seed=seed)


def load_text(
    text: str | bytes, *, name: str, folder: Path, packages: Packages, report: Diagnostics, seed: int = 0
) -> LoadedDescription:
    """Read a description from text: SDF, URDF or xacro.

    Args:
        text: the whole document.
        name: file name in messages.
        folder: base of relative URIs.
        packages: resolves URIs.
        report: receives warnings and notes.
        seed: seed of random placement in SDF.

    Raises:
        DescriptionError: the description cannot be interpreted.
    """
    root = parse_xml(text, name=name, report=report, max_depth=DEEPEST)
    if root.tag != "robot":
        return load_sdf(root, folder / name, packages, report, seed=seed)
    text = text if isinstance(text, str) else text.decode(errors="replace")
    if _XACRO in text or ("xmlns:xacro" in text and _INDIGO.search(text)):
        path = Path(os.path.relpath(folder / name))  # the name in messages is relative to the working folder
        text, name = _expanded(path, packages, report, text.encode()), f"{name} (expanded)"
    return load_urdf(text, name, folder / name, packages, report)


def load_sdf(
    root: XmlNode,
    path: Path,
    packages: Packages,
    report: Diagnostics,
    *,
    seed: int = 0,
    budget: ReadBudget | None = None,
) -> LoadedDescription:
    """Read a parsed SDF file at `path`; `seed` is for random placement, `budget` for included files.

    Raises:
        DescriptionError: not an SDF.
    """
    from .sdf import Context, name_missing_attributes, read_root, read_version, rewrite_old_style

    if root.tag == "launch":
        refuse_ros2(root)
        raise DescriptionError(
            root.at, "a launch file, not a robot or a world; `trundle launch` starts it", "wrong-root"
        )
    if root.tag == "gazebo" and root.attribute("reference") is not None:
        raise DescriptionError(
            root.at, "<gazebo reference=…> is a part of a URDF to include, not a robot", "wrong-root"
        )
    if root.tag not in ("sdf", "gazebo"):
        raise DescriptionError(
            root.at, f"<{root.tag}> starts neither an SDF (<sdf>) nor a URDF (<robot>)", "wrong-root"
        )
    version = read_version(root, report)
    if version < (1, 2):
        report.info(
            root.at, f"SDF {version}: values written as attributes are read as the elements of SDF 1.2", "old-sdf"
        )
        rewrite_old_style(root)
    if root.tag == "gazebo":
        report.warn(
            root.at, "<gazebo> was the root element until SDF 1.2; Gazebo refuses the file: it needs <sdf>", "old-sdf"
        )
    name_missing_attributes(root, version, report)

    def read_urdf(file: Path, robot: XmlNode) -> Model:
        text = read_text(file)
        if _XACRO in text:
            raise DescriptionError(
                robot.at, "a xacro file cannot be included; `trundle xacro` expands it", "xacro-include"
            )
        (model,) = load_urdf(text, str(file), file, packages, report).world.models
        return model

    context = Context(
        version=version,
        folder=path.parent,
        packages=packages,
        report=report,
        including=(path.resolve(),),
        read_urdf=read_urdf,
        seed=seed,
        budget=budget or ReadBudget(),
    )
    world, has_world = read_root(root, context)
    return LoadedDescription(kind="world" if has_world else "model", world=world)


def load_urdf(text: str, name: str, path: Path, packages: Packages, report: Diagnostics) -> LoadedDescription:
    """Read an expanded URDF; `path` is its file, `name` its name in messages.

    Raises:
        DescriptionError: urdfdom would refuse the robot.
    """
    from trundle.robots.robot import read_robot

    from .urdf import lower_robot

    root = parse_xml(text, name=name, report=report)
    robot = read_robot(root, report)
    world = lower_robot(robot, root, folder=path.parent, packages=packages, report=report)
    return LoadedDescription(kind="urdf", world=world, robot=robot, urdf=text)


def _expanded(
    path: Path,
    packages: Packages,
    report: Diagnostics,
    data: bytes | None = None,
    *,
    arguments: Mapping[str, str] = MappingProxyType({}),
) -> str:
    from .xacro.expand import expand_xacro

    return expand_xacro(path, arguments, packages=packages, report=report, data=data, needs_all=True)


def _find(source: str, packages: Packages) -> Path:
    if source.startswith("model://"):
        return packages.find_model(source.removeprefix("model://").strip("/"))
    if source.startswith("package://"):
        return packages.resolve(source, folder=Path.cwd(), at=Source(source))
    if source.startswith("file://"):
        return Path(unquote(source.removeprefix("file://")))
    path = Path(os.path.expanduser(source))
    if os.path.exists(path):
        return path
    world = None if path.is_absolute() else packages.find_world(source)
    if world is not None:
        return world
    bundled = ", ".join(packages.worlds())
    hint = ""
    if path.suffix == ".world":
        hint = f"; worlds that come with Trundle: {bundled}; others are searched along GAZEBO_RESOURCE_PATH"
    suggestion = similar_file(str(path)) or did_you_mean(source, packages.worlds())
    raise DescriptionError(Source(source), f"no such file or folder{suggestion}{hint}", "missing-file")
