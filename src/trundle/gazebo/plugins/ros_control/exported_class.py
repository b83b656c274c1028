"""Classes of ros_control that packages export as plugins, in libraries compiled with the development kit."""

import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from trundle.base.diagnostics import DescriptionError
from trundle.base.files import read_file
from trundle.base.xmlnode import parse_xml
from trundle.robots.packages import Packages
from trundle.robots.parameters import ParamError

from ..compiled import has_mark

_MARK = b"_ZN12class_loader4impl13registerClass"
"""Symbol of the kit's class_loader, which every library with plugins uses; the original's has another name."""
_SUFFIX = ".dylib" if sys.platform == "darwin" else ".so"
_BASES = {
    "controller_interface": "controller_interface::ControllerBase",
    "gazebo_ros_control": "gazebo_ros_control::RobotHWSim",
}


class ExportedClass(NamedTuple):
    """Class that a package exports."""

    name: str
    """Name by which it is loaded, such as my_package/MyController."""
    type: str
    """C++ class."""
    package: str
    description: Path
    """Its plugin description."""
    library: Path | None
    """Library compiled with the development kit; None: there is none."""


def exported_classes(kind: str, environment: Mapping[str, str], starts: list[Path]) -> dict[str, ExportedClass]:
    """Return the classes that packages export, by name; descriptions that cannot be read are left out.

    Args:
        kind: package of the base class: controller_interface or gazebo_ros_control.
        environment: variables that locate packages and libraries.
        starts: files whose workspaces are searched, before ROS_PACKAGE_PATH.
    """
    packages: dict[str, Path] = {}
    for start in starts:
        for name, folder in Packages(environment, start=start).ros_packages().items():
            packages.setdefault(name, folder)
    classes: dict[str, ExportedClass] = {}
    for package, folder in packages.items():
        for description in _descriptions(folder, kind):
            for found in _read(package, folder, description, _BASES[kind], environment):
                classes.setdefault(found.name, found)
    return classes


def library_of(found: ExportedClass) -> Path:
    """Return a class's library.

    Raises:
        ParamError: it is not compiled.
    """
    if found.library is None:
        raise ParamError(
            f"{found.name} is a class in C++ of package {found.package} ({found.description}), whose library is not "
            "compiled with Trundle's development kit; catkin_make compiles it"
        )
    return found.library


def _descriptions(folder: Path, kind: str) -> Iterator[Path]:
    manifest = folder / "package.xml"
    try:
        text = read_file(manifest)
        if kind.encode() not in text:
            return
        export = parse_xml(text, name=str(manifest)).find("export")
    except (OSError, DescriptionError):
        return
    for tag in [] if export is None else export.all(kind):
        if value := tag.attribute("plugin"):
            yield folder / value.replace("${prefix}/", "").replace("${prefix}", ".")


def _read(
    package: str, folder: Path, description: Path, base: str, environment: Mapping[str, str]
) -> Iterator[ExportedClass]:
    try:
        root = parse_xml(read_file(description), name=str(description))
    except (OSError, DescriptionError):
        return
    for library in root.all("library") if root.tag == "class_libraries" else [root]:
        path = library.attribute("path") or ""
        for node in library.all("class"):
            kind = node.attribute("type") or ""
            if node.attribute("base_class_type") == base and kind:
                name = node.attribute("name") or kind
                yield ExportedClass(name, kind, package, description, _library(path, folder, environment))


def _library(path: str, folder: Path, environment: Mapping[str, str]) -> Path | None:
    """Return the first of a description's libraries, as pluginlib looks for it, that the kit has compiled."""
    name = f"{os.path.basename(path).removesuffix(_SUFFIX)}{_SUFFIX}"
    prefixes = environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    folders = [Path(prefix, "lib") for prefix in prefixes if prefix]
    for parent in folder.resolve().parents:
        folders += [parent / "devel/lib", parent / "install/lib", parent / "lib"]
    return next((file for entry in folders if has_mark(file := entry / name, _MARK)), None)
